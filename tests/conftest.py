"""The suite neither reads nor writes the user's kept figures, unless a test asks for a folder of
its own; kernels are compiled once for all tests.
"""

import os
from pathlib import Path

os.environ["JUGGLEPROOF_CACHE"] = "off"
os.environ.setdefault(
    "NUMBA_CACHE_DIR", str(Path(__file__).resolve().parents[1] / ".pytest_cache" / "machine-code")
)
pytest_plugins = ["pytester"]
