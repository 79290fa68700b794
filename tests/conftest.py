"""The suite neither reads nor writes the user's kept figures, unless a test asks for a folder of
its own; kernels are compiled once for all tests; Ctrl-C is heard, also where the shell that started
the suite ignores it.
"""

import os
import signal
from pathlib import Path

os.environ["JUGGLEPROOF_CACHE"] = "off"
os.environ.setdefault(
    "NUMBA_CACHE_DIR", str(Path(__file__).resolve().parents[1] / ".pytest_cache" / "machine-code")
)
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
pytest_plugins = ["pytester"]
