"""The stored statement about the table that moves as a sine, and one line on it."""

from __future__ import annotations

from pathlib import Path

from .checker import check_folder

STORE = Path(__file__).resolve().parent / "store"
LOST = "sine: NOT certified"


def sine_line() -> str:
    """One line: what the second checker certifies from the store beside it, or what is lost.

    Raises Refused or Rejected, one line, where the store cannot be read.
    """
    results = check_folder(str(STORE))
    for name, word, why in results:
        if word != "certified":
            return f"{LOST}; {name}: {word}" + (f": {why}" if why else "")
    return f"sine: certified by the second checker: {'; '.join(name for name, *_ in results)}"
