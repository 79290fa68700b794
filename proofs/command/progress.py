"""How far a long run is, told on a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable


def progress() -> Callable[[int, int], None] | None:
    """Tells how far a run is, on a terminal only."""
    if not sys.stderr.isatty():
        return None
    last = [-1]

    def tell(done: int, of: int) -> None:
        part = 1000 * done // max(of, 1)
        if part != last[0]:
            last[0] = part
            print(f"\r{done} of {of}", end="", file=sys.stderr, flush=True)

    return tell


def clear() -> None:
    """Takes the line of progress away."""
    if sys.stderr.isatty():
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)
