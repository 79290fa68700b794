"""`juggleproof bench`: speed against error, in one table and plot a question; the engines are in
`benchmarks`, which only a checkout has.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from certificates.terms import ClaimError

FOLDER = Path("juggleproof-bench")


def bench(options: argparse.Namespace) -> int:
    """Runs the benchmark; 1 where an enclosure does not hold the closed form.  Raises ClaimError,
    one line, for what cannot be measured.
    """
    try:
        from benchmarks.bench.run import Run, wish
    except ModuleNotFoundError as error:
        if not str(error.name).startswith("benchmarks"):
            raise
        raise ClaimError(
            "bench needs a checkout, with its folder benchmarks; run it there, or with"
            " PYTHONPATH=CHECKOUT"
        ) from None
    wanted = wish(options.question, options.widths, options.seconds, options.quick)
    folder = options.output or FOLDER
    fault = _fault(folder)
    if fault:
        raise ClaimError(f"-o {folder}: {fault}; name another folder")
    return Run(wanted, folder, _tell).all()


def _fault(folder: Path) -> str:
    """Why files cannot be written there; nothing where they can."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / ".new").write_bytes(b"")
        (folder / ".new").unlink()
    except OSError as error:
        return f"cannot be written ({error.strerror})"
    return ""


def _tell(what: str) -> None:
    """Progress, on a terminal only."""
    if sys.stderr.isatty():
        print(f"\r\x1b[K{what}", end="", file=sys.stderr, flush=True)
