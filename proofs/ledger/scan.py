"""Rebuild, from the text of the paper, the ordered list of all it prints in sections 2.2 to 4.4 and
the appendices.

An item is a display, an inline formula or a piece of prose: a sentence, a sentence of a footnote, a
caption, a table row.  A sentence that a display, a page turn or a footnote interrupts gives one
item for each of its pieces, and mathematics that the transcription left without dollar signs stays
in its sentence.  Lines that hold nothing but an equation number or a stray mark of punctuation
belong to the display before them and are no items.

The list keeps a line number and a digest of each item, never its words:

    python -m proofs.ledger.scan PAPER        print key, line, kind and digest of every item
"""

from __future__ import annotations

import hashlib
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

KINDS = {
    "display": "d",
    "inline": "i",
    "sentence": "s",
    "note": "n",
    "caption": "c",
    "tablerow": "t",
}
SCOPE = ("2.2", "2.3", "3", "4", "A", "B")

NUMBERED = re.compile(r"\s*(?:APPENDIX )?(\d(?:\.\d){0,2}|[AB](?:\.\d){0,2})\.\s+(?=\S)")
NUMBER_AT_THE_END = re.compile(
    r"\s([AB]\.\d)\.\s*$"
)  # the transcription puts one heading's number after its words
# What opens or closes a section without a number: section 4.2 has lost its heading.
UNNUMBERED = {re.compile(r"\s*References\s*$"): "", re.compile(r"\s*Proposition 1\."): "4.2"}
CAPTION = re.compile(r"\s*(?:Figure \d+ (?=[A-Z#\u0370-\u03ff])|Table II )")
FOOTNOTE = re.compile(r"\s*(?:[⁰¹²³⁴-⁹]+|\$\^\{\^\{\d+\}\}\$)\s")
NOT_PROSE = re.compile(r"\s*(?:\(\d+\))?\s*[.,]?\s*$")
BLOCK = re.compile(r"\$\$.*?\$\$|(?:(?!\$\$)[^\n])+", re.DOTALL)
INLINE = re.compile(r"\$(.+?)\$")
SENTENCE_END = re.compile(r"""[.?!][)"”]*[⁰¹²³⁴-⁹]*\s+(?=[A-Z\\("“\x00\u0370-\u03ffℓ])""")


@dataclass(frozen=True)
class Item:
    """One thing the paper prints: where it stands, what kind of thing it is, and a digest of its
    text.
    """

    key: str
    section: str
    line: int
    kind: str
    text: str = field(repr=False)

    @property
    def digest(self) -> str:
        """The first 16 hexadecimal digits of the SHA-256 of the text, runs of white space counted
        as one space.

        >>> kept = Item("3-s01", "3", 7, "sentence", "a  b ")
        >>> kept.digest == Item("3-s01", "3", 7, "sentence", "a b").digest
        True
        """
        return hashlib.sha256(" ".join(self.text.split()).encode()).hexdigest()[:16]


def scan(paper: str) -> list[Item]:
    """Every item of the paper in printed order; a sentence comes before the inline formulas that
    stand in it.

    >>> demo = "2.2. The Ball\\nIt falls. So $x>0$.\\n$$y$$\\n (4)"
    >>> [(item.key, item.line, item.kind) for item in scan(demo)]  # doctest: +NORMALIZE_WHITESPACE
    [('2.2-s01', 1, 'sentence'), ('2.2-s02', 2, 'sentence'), ('2.2-s03', 2, 'sentence'),
     ('2.2-i01', 2, 'inline'),
     ('2.2-d01', 3, 'display')]
    """
    items: list[Item] = []
    counts: dict[tuple[str, str], int] = {}
    for section, line, kind, text in _pieces(paper):
        number = counts[section, kind] = counts.get((section, kind), 0) + 1
        items.append(Item(f"{section}-{KINDS[kind]}{number:02d}", section, line, kind, text))
    return items


def _pieces(paper: str) -> Iterator[tuple[str, int, str, str]]:
    """Section, line, kind and text of every item."""
    for section, line, block in _blocks(paper):
        if block.startswith("$$"):
            yield section, line, "display", block[2:-2]
        elif not NOT_PROSE.match(block):
            kind = _kind_of_prose(block)
            for sentence in _sentences(
                FOOTNOTE.sub("", block) if kind == "note" else block, whole=kind == "tablerow"
            ):
                yield section, line, kind, sentence
                for formula in INLINE.finditer(sentence):
                    yield section, line, "inline", formula[1]


def _blocks(paper: str) -> Iterator[tuple[str, int, str]]:
    """Section, first line and text of every display and of every line of prose between displays,
    within the scope.
    """
    if paper.count("$$") % 2:
        raise ValueError(
            f"the paper holds {paper.count('$$')} double dollars: some display is never closed"
        )
    section, line, counted = "", 1, 0
    for found in BLOCK.finditer(paper):
        block, start = found[0], found.start()
        line, counted = line + paper.count("\n", counted, start), start
        if not block.startswith("$$"):
            section, block = _section_opened_by(block, section)
        if section.startswith(SCOPE) and block.strip():
            yield section, line, block


def _section_opened_by(line: str, section: str) -> tuple[str, str]:
    """The section that holds this line, and the line without its section number."""
    if number := NUMBERED.match(line):
        return number[1], line[number.end() :]
    if trailing := NUMBER_AT_THE_END.search(line):
        return trailing[1], line[: trailing.start()]
    for pattern, opened in UNNUMBERED.items():
        if pattern.match(line):
            return opened, line
    return section, line


def _kind_of_prose(block: str) -> str:
    if CAPTION.match(block):
        return "caption"
    if "\t" in block:
        return "tablerow"
    return "note" if FOOTNOTE.match(block) else "sentence"


def _sentences(block: str, whole: bool) -> Iterator[str]:
    """The sentences of a block; inline formulas are hidden first, so that no dot inside one ends a
    sentence.
    """
    if whole:
        yield block
        return
    hidden = INLINE.sub(lambda formula: "\x00" * len(formula[0]), block)
    start = 0
    for end in [found.end() for found in SENTENCE_END.finditer(hidden)] + [len(block)]:
        if block[start:end].strip():
            yield block[start:end]
        start = end


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        print("usage: python -m proofs.ledger.scan PAPER", file=sys.stderr)
        return 2
    for item in scan(Path(arguments[0]).read_text(encoding="utf-8")):
        print(item.key, item.line, item.kind, item.digest, sep="\t")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
