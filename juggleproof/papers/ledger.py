"""The paper item by item: the reasons for which an item needs no claim, the list of items rebuilt
from the paper, and the ledger read and checked.
"""

from __future__ import annotations

import hashlib
import re
import sys
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from juggleproof.folders import LEDGER

# -------------------------------------------------------------------------------------------------
# The reasons for which an item of the paper needs no claim: a closed list.

# An item that asserts something about the paper's system has claims; one that asserts nothing has
# one of these reasons.
REASONS = {
    "heading": "names a section, a proof or a part of a table",
    "names": "gives or recalls a name or notation, or is a formula that only names a thing",
    "background": "tells of uses or the work of others, and nothing of the paper's own system",
    "narrative": "says what the text does or hopes, or judges without stating anything exact",
    "modelling-assumption": "sets up the model and cannot follow from anything",
    "figure-or-table": "says what a figure or table shows",
    "reference": "only points to another place",
    "connective": "joins two formulas and adds nothing to them",
}
# These two are followed by the key of another item.
REASONS_WITH_KEY = {
    "part-of": "is a piece of that item, which carries the claims",
    "repeats": "the transcription prints that earlier item again at the same place",
}


# -------------------------------------------------------------------------------------------------
# The ordered list of all items of the paper except its references, made from its text; the items
# before section 1 (title, abstract, key words) are section 0.
#
# An item is a display, an inline formula or a piece of prose: a sentence, a sentence of a footnote,
# a caption, a table row. A sentence that a display, a page turn or a footnote interrupts gives one
# item for each of its pieces, and mathematics that the transcription left without dollar signs
# stays in its sentence. Lines that hold nothing but an equation number or a stray mark of
# punctuation belong to the display before them and are no items.
#
# The list keeps a line number and a digest of each item, never its words:
#
# python -m juggleproof.papers.ledger PAPER        print key, line, kind and digest of every
# item

KINDS = {
    "display": "d",
    "inline": "i",
    "sentence": "s",
    "note": "n",
    "caption": "c",
    "tablerow": "t",
}

NUMBERED = re.compile(r"\s*(?:APPENDIX )?(\d(?:\.\d){0,2}|[AB](?:\.\d){0,2})\.\s+(?=\S)")
NUMBER_AT_THE_END = re.compile(
    r"\s([AB]\.\d)\.\s*$"
)  # the transcription puts one heading's number after its words
# Lines without a number that open or close a section: section 4.2 has lost its heading.
UNNUMBERED = {re.compile(r"\s*References\s*$"): "", re.compile(r"\s*Proposition 1\."): "4.2"}
CAPTION = re.compile(r"\s*(?:Figure \d+ (?=[A-Z#\u0370-\u03ff])|Table II? (?=[A-Z]))")
FOOTNOTE = re.compile(r"\s*(?:[⁰¹²³⁴-⁹]+|\$\^\{\^\{\d+\}\}\$)\s*")
NOT_PROSE = re.compile(r"\s*(?:\(\d+\))?\s*[.,]?\s*$")
BLOCK = re.compile(r"\$\$.*?\$\$|(?:(?!\$\$)[^\n])+", re.DOTALL)
INLINE = re.compile(r"\$(.+?)\$")
SENTENCE_END = re.compile(r"""[.?!][)"”]*[⁰¹²³⁴-⁹]*\s+(?=[A-Z\\("“\x00\u0370-\u03ffℓ])""")


@dataclass(frozen=True)
class PaperItem:
    """One item of the paper: its key, section and line, its kind, and its text."""

    key: str
    section: str
    line: int
    kind: str
    text: str = field(repr=False)

    @property
    def digest(self) -> str:
        """The first 16 hexadecimal digits of the SHA-256 of the text, runs of white space counted
        as one space.

        >>> kept = PaperItem("3-s01", "3", 7, "sentence", "a  b ")
        >>> kept.digest == PaperItem("3-s01", "3", 7, "sentence", "a b").digest
        True
        """
        return hashlib.sha256(" ".join(self.text.split()).encode()).hexdigest()[:16]


def scan(paper: str) -> list[PaperItem]:
    """Every item of the paper in printed order; a sentence comes before the inline formulas that
    stand in it.

    >>> demo = "2.2. The Ball\\nIt falls. So $x>0$.\\n$$y$$\\n (4)"
    >>> [(item.key, item.line, item.kind) for item in scan(demo)]  # doctest: +NORMALIZE_WHITESPACE
    [('2.2-s01', 1, 'sentence'), ('2.2-s02', 2, 'sentence'), ('2.2-s03', 2, 'sentence'),
     ('2.2-i01', 2, 'inline'),
     ('2.2-d01', 3, 'display')]
    """
    items: list[PaperItem] = []
    counts: dict[tuple[str, str], int] = {}
    for section, line, kind, text in _pieces(paper):
        number = counts[section, kind] = counts.get((section, kind), 0) + 1
        items.append(PaperItem(f"{section}-{KINDS[kind]}{number:02d}", section, line, kind, text))
    return items


def _pieces(paper: str) -> Iterator[tuple[str, int, str, str]]:
    """Section, line, kind and text of every item."""
    for section, line, block in _blocks(paper):
        if block.startswith("$$"):
            yield section, line, "display", block[2:-2]
        elif not NOT_PROSE.match(block):
            kind = _kind_of_prose(block)
            for sentence in _sentences(
                FOOTNOTE.sub("", block, 1) if kind == "note" else block, whole=kind == "tablerow"
            ):
                yield section, line, kind, sentence
                for formula in INLINE.finditer(sentence):
                    yield section, line, "inline", formula[1]


def _blocks(paper: str) -> Iterator[tuple[str, int, str]]:
    """Section, first line and text of every display and of every line of prose between displays,
    without the references.
    """
    if paper.count("$$") % 2:
        raise ValueError(
            f"the paper holds {paper.count('$$')} double dollars: some display is never closed"
        )
    section, line, counted = "0", 1, 0
    for found in BLOCK.finditer(paper):
        block, start = found[0], found.start()
        line, counted = line + paper.count("\n", counted, start), start
        if not block.startswith("$$"):
            section, block = _section_opened_by(block, section)
        if section and block.strip():
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
        print("usage: python -m juggleproof.papers.ledger PAPER", file=sys.stderr)
        return 2
    for item in scan(Path(arguments[0]).read_text(encoding="utf-8")):
        print(item.key, item.line, item.kind, item.digest, sep="\t")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))


# -------------------------------------------------------------------------------------------------
# The ledger: each item in order has existing claims or a reason from the closed list.

ROWS = LEDGER / "rows.tsv"
COLUMNS = ("key", "line", "kind", "digest", "claims", "reason")
KEY = re.compile(r"((?:\d|[AB])(?:\.\d){0,2})-([a-z])(\d{2,})", re.ASCII)
LINE = re.compile(r"[1-9]\d*", re.ASCII)
DIGEST = re.compile(r"[0-9a-f]{16}", re.ASCII)


class LedgerError(ValueError):
    """An error in the ledger; the message is one line that names the row and the remedy."""


@dataclass(frozen=True)
class LedgerRow:
    """A row of the ledger: an item of the paper with its claims, or with the reason why it has
    none; exactly one of `claims` and `reason` is not empty.
    """

    key: str
    line: int
    kind: str
    digest: str
    claims: tuple[str, ...] = ()
    reason: str = ""

    @property
    def section(self) -> str:
        """The section that the key names.

        >>> LedgerRow("A.3.1-d04", 694, "display", "0" * 16, ("sA.3.1-35",)).section
        'A.3.1'
        """
        return self.key.rpartition("-")[0]


def load_ledger(path: Path = ROWS) -> list[LedgerRow]:
    """The rows of the ledger in the paper's order, checked as far as the ledger alone allows."""
    lines = path.read_text(encoding="utf-8").split("\n")
    if lines[0].split("\t") != list(COLUMNS):
        raise LedgerError(f"{path.name}: the first line must name the columns {', '.join(COLUMNS)}")
    if lines[-1]:
        raise LedgerError(
            f"{path.name}: the last row does not end with a newline; the file may be cut short"
        )
    rows = [_row(line, f"{path.name}:{number}") for number, line in enumerate(lines[1:-1], start=2)]
    check_rows(rows)
    return rows


def check_rows(rows: Sequence[LedgerRow]) -> None:
    """Raises LedgerError unless the rows are in order, each has claims or a reason, and the reasons
    are from the closed list.
    """
    if not rows:
        raise LedgerError("the ledger has no rows: rebuild it from the paper")
    _check_order(rows)
    settled: dict[str, LedgerRow] = {row.key: row for row in rows}
    earlier: set[str] = set()
    for row in rows:
        if bool(row.claims) == bool(row.reason):
            fault = "claims and a reason" if row.claims else "neither claims nor a reason"
            raise LedgerError(f"{row.key}: the row has {fault}; give exactly one of the two")
        if len(set(row.claims)) < len(row.claims):
            raise LedgerError(f"{row.key}: a claim is named twice; name each once")
        if row.reason:
            _check_reason(row, settled, earlier)
        earlier.add(row.key)


def check_claims(
    rows: Iterable[LedgerRow], register: Collection[str], unprinted: Collection[str]
) -> None:
    """Raises LedgerError unless the rows name registered claims only, and every registered claim
    that the paper prints has a row.
    """
    named: set[str] = set()
    for row in rows:
        for claim in row.claims:
            if claim not in register:
                raise LedgerError(
                    f"{row.key}: no claim is called {claim}; write the claim or correct the row"
                )
            named.add(claim)
    for claim in sorted(set(register) - named - set(unprinted)):
        raise LedgerError(
            f"the claim {claim} stands in no row of the ledger: add it to the row of what it judges"
        )
    for claim in sorted(named & set(unprinted)):
        raise LedgerError(
            f"the claim {claim} has a row although it is listed as unprinted: take it off one of"
            " the two"
        )


def check_against_paper(rows: Sequence[LedgerRow], items: Sequence[PaperItem]) -> None:
    """Raises LedgerError unless key, line, kind and digest of the rows are those of the items in
    the paper's text.
    """
    for row, item in zip(
        rows, items, strict=False
    ):  # a difference in length is reported below, if the rest agrees
        for name in ("key", "line", "kind", "digest"):
            held, found = getattr(row, name), getattr(item, name)
            if held != found:
                raise LedgerError(
                    f"{row.key}: the ledger holds {name} {held} where the paper has {found};"
                    " rescan it"
                )
    if len(rows) != len(items):
        raise LedgerError(
            f"the ledger has {len(rows)} rows but the paper has {len(items)} items: rescan it"
        )


def _row(line: str, place: str) -> LedgerRow:
    cells = line.split("\t")
    if len(cells) != len(COLUMNS):
        raise LedgerError(f"{place}: {len(cells)} columns instead of {len(COLUMNS)}")
    key, number, kind, digest, claims, reason = cells
    if not LINE.fullmatch(number):
        raise LedgerError(f"{place}: {number!r} is no line number")
    if not DIGEST.fullmatch(digest):
        raise LedgerError(f"{place}: {digest!r} is no digest of sixteen hexadecimal digits")
    if claims != " ".join(claims.split()):
        raise LedgerError(f"{place}: the claims must be separated by single spaces")
    return LedgerRow(key, int(number), kind, digest, tuple(claims.split()), reason)


def _check_order(rows: Sequence[LedgerRow]) -> None:
    """Raises LedgerError unless keys count upward within section and kind, the rows of a section
    are contiguous, and lines never decrease.
    """
    counts: dict[tuple[str, str], int] = {}
    section, line, closed = "", 0, set[str]()
    for row in rows:
        if not (key := KEY.fullmatch(row.key)):
            raise LedgerError(
                f"{row.key!r} is no key: write section, hyphen, letter of the kind and number"
            )
        if KINDS.get(row.kind) != key[2]:
            raise LedgerError(
                f"{row.key}: the key's letter does not stand for the kind {row.kind!r}"
            )
        if row.section != section:
            closed.add(section)
            section = row.section
        if section in closed:
            raise LedgerError(
                f"{row.key}: section {section} was already closed; keep the rows in the paper's"
                " order"
            )
        expected = counts[section, row.kind] = counts.get((section, row.kind), 0) + 1
        if int(key[3]) != expected:
            raise LedgerError(
                f"{row.key}: the next {row.kind} of section {section} is number {expected}"
            )
        if row.line < line:
            raise LedgerError(
                f"{row.key}: line {row.line} comes after line {line}; keep the rows in the paper's"
                " order"
            )
        line = row.line


def _check_reason(row: LedgerRow, settled: dict[str, LedgerRow], earlier: set[str]) -> None:
    name, _, key = row.reason.partition(" ")
    if name not in REASONS and name not in REASONS_WITH_KEY:
        raise LedgerError(
            f"{row.key}: the reason {name!r} is not in the closed list of"
            " juggleproof/papers/ledger.py"
        )
    if name in REASONS:
        if key:
            raise LedgerError(f"{row.key}: the reason {name!r} takes nothing after it")
    elif key not in settled:
        raise LedgerError(f"{row.key}: {name} needs the key of another row, and {key!r} is none")
    elif not settled[key].claims:
        raise LedgerError(f"{row.key}: {name} {key}, but that row has no claims either")
    elif key not in earlier:
        raise LedgerError(f"{row.key}: {name} {key}, but that row comes later")
