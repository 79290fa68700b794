"""README.md and the pages of docs, with the blocks of code that stand in them."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
BLOCK = re.compile(r'^```(\w+)(?: title="([^"]+)")?\n(.*?)^```$', re.M | re.S)


class Block(NamedTuple):
    """A block of code: its language, the file that it is said to be, or nothing, and its text."""

    language: str
    title: str
    text: str


def text_of(page: Path) -> str:
    return page.read_text(encoding="utf-8")


def blocks(page: Path) -> list[Block]:
    text = text_of(page)
    found = [Block(*one.groups(default="")) for one in BLOCK.finditer(text)]
    assert len(found) == len(re.findall(r"^```", text, re.M)) / 2, f"{page.name}: a block is open"
    return found


def code(page: Path, language: str) -> list[str]:
    return [block.text for block in blocks(page) if block.language == language]


def name(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()
