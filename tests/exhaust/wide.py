"""The wide cover of the sine, found from nothing, is the stored one to the byte.

python -m tests.exhaust.wide
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from juggleproof.proofs.command.main import run
from juggleproof.proofs.command.sine import WIDE


def main() -> int:
    """Covers its rectangles in a folder of its own; returns 1 where that differs."""
    with tempfile.TemporaryDirectory() as folder:
        exit_code = run(["certify", "sine", "--store", folder])
        stored = {path.name: path.read_bytes() for path in WIDE.iterdir()}
        found = {path.name: path.read_bytes() for path in Path(folder).iterdir()}
    differ = sorted(
        name for name in {*stored, *found} if stored.get(name, b"") != found.get(name, b"")
    )
    for name in differ:
        print(f"certificates/sine/wide/{name} is not what the search finds")
    return int(exit_code != 0 or bool(differ))


if __name__ == "__main__":
    sys.exit(main())
