"""The table of displays in displays.txt: as printed, and as transcribed beside the restored
print.
"""

from __future__ import annotations

from pathlib import Path


def _blocks() -> list[tuple[str, str]]:
    text = Path(__file__).with_name("displays.txt").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    blocks = "\n".join(lines).split("== ")[1:]
    return [(where, body.strip()) for where, _, body in (block.partition("\n") for block in blocks)]


AS_PRINTED = [(where, body) for where, body in _blocks() if "~~" not in body]
RESTORED = [
    (where, garbled.strip(), print_.strip())
    for where, body in _blocks()
    if "~~" in body
    for garbled, _, print_ in [body.partition("~~")]
]
ALL = AS_PRINTED + [(where, print_) for where, _, print_ in RESTORED]
