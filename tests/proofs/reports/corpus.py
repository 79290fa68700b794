"""The terms and formulas that the stored statements hold, each once: what reports print."""

from __future__ import annotations

from pathlib import Path

STATEMENTS = Path(__file__).resolve().parents[3] / "certificates" / "store" / "statements.txt"
SAYING = (
    "range given have with show domain holds space rank stage on rate radius size point weights"
    " start".split()
)


def texts() -> list[str]:
    found: dict[str, None] = {}
    for line in STATEMENTS.read_text(encoding="utf-8").splitlines():
        keyword, _, rest = line.strip().partition(" ")
        if keyword == "let":
            found[rest.split(" = ")[1]] = None
        elif keyword in SAYING:
            found[rest] = None
    return list(found)


TEXTS = texts()
