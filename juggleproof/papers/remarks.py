"""Remarks on the paper's notation and citations: the meanings of each symbol, by section, and the
equations and sections that are cited.

names.tsv        a row for each meaning of a name: the name as the reader of prints spells it, the
                 sections in which it has the meaning, and the meaning; a star after a section says
                 that no print there has the name: it is in prose, or the transcription mangles it
citations.tsv    a row for each item of the ledger that cites an equation or a section: the item's
                 key, what it cites, and a remark where that does not support what it is cited for
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from juggleproof.folders import LEDGER
from juggleproof.judging.claims import Claim
from juggleproof.papers.ledger import LedgerError, PaperItem
from juggleproof.reading.tree import Name, Tree, spelled

NAMES, CITATIONS = (LEDGER / f"{name}.tsv" for name in ("names", "citations"))
PROSE = "*"  # after a section in which no print has the name
CITED = re.compile(
    r"\((\d{1,2})\)|[Ss]ection ((?:\d|[AB])(?:\.\d)*)"
)  # an equation by its number, or a section


class Meant(NamedTuple):
    """One meaning of a name, and the sections in which it has it."""

    name: str
    sections: tuple[str, ...]
    meaning: str


class Citation(NamedTuple):
    """The citations of one item of the paper, and the remark on them, if there is one."""

    key: str
    cited: tuple[str, ...]
    remark: str


def meanings(path: Path = NAMES) -> list[Meant]:
    """The meanings of the names, in the order of the file; none where the paper has no file."""
    if not path.is_file():
        return []
    return [Meant(name, tuple(at.split()), text) for name, at, text in _rows(path, Meant._fields)]


def citations(path: Path = CITATIONS) -> list[Citation]:
    """The citations, in the order of the paper."""
    return [
        Citation(key, tuple(cited.split()), text)
        for key, cited, text in _rows(path, Citation._fields)
    ]


def _rows(path: Path, columns: Sequence[str]) -> Iterator[tuple[str, str, str]]:
    """The rows of a table of three columns; raises LedgerError, one line, for any other file."""
    head, *lines = path.read_text(encoding="utf-8").splitlines()
    if head.split("\t") != list(columns):
        raise LedgerError(f"{path.name}: the first line must name the columns {', '.join(columns)}")
    for number, line in enumerate(lines, start=2):
        cells = line.split("\t")
        if len(cells) != 3:
            raise LedgerError(f"{path.name}:{number}: {len(cells)} columns instead of 3")
        yield cells[0], cells[1], cells[2]


# -------------------------------------------------------------------------------------------------
# The names of the prints, by section; and the check that the table has these and no others.


def names_of(tree: object) -> Iterator[str]:
    r"""The names in a tree, also in subscripts, except for letters that only label.

    >>> from juggleproof.reading.parser import parse
    >>> sorted(set(names_of(parse(r"A_{-\xi_1} r_0 = \overline b_k"))))
    ['A_{...}', '\\overline{b}_{k}', '\\xi_{1}', 'r_{0}']
    """
    if isinstance(tree, Name):
        yield spelled(tree)
        for one in tree.subscripts:
            if not _is_label(one):
                yield from names_of(one)
    elif isinstance(tree, tuple):
        for one in tree:
            yield from names_of(one)
    elif isinstance(tree, Tree):
        for field in tree.__dataclass_fields__:
            yield from names_of(getattr(tree, field))


def _is_label(tree: Tree) -> bool:
    """Whether a subscript is only a lower-case letter or word."""
    return (
        isinstance(tree, Name)
        and not tree.subscripts
        and tree.base.isalpha()
        and tree.base.islower()
    )


def printed_names(claims: Iterable[Claim]) -> set[tuple[str, str]]:
    """Each name of a print with the section of the print."""
    return {
        (name, claim.section)
        for claim in claims
        if claim.printed
        for part in claim.read_print().parts
        for name in names_of(part.tree)
    }


def check_names(table: Sequence[Meant], printed: set[tuple[str, str]]) -> None:
    """Raises LedgerError, one line, for a name of a print that the table lacks, and for a name of
    the table in a section where no print has it.
    """
    listed = {(row.name, section) for row in table for section in row.sections}
    held = {(name, section) for name, section in listed if not section.endswith(PROSE)}
    for name, section in sorted(printed - held):
        raise LedgerError(f"{NAMES.name}: {name} is printed in section {section}; add its meaning")
    for name, section in sorted(held - printed):
        raise LedgerError(
            f"{NAMES.name}: no print of section {section} has {name}; write {section}{PROSE} if"
            " prose does"
        )


def check_citations(table: Sequence[Citation], items: Sequence[PaperItem]) -> None:
    """Raises LedgerError, one line, unless the table has each citation of the paper, in order."""
    found = [(item.key, cited_in(item.text)) for item in items if item.kind not in _FORMULAS]
    wanted = [one for one in found if one[1]]
    held = [(row.key, row.cited) for row in table]
    for one, other in zip(wanted, held):
        if one != other:
            raise LedgerError(f"{CITATIONS.name}: {other} stands where the paper has {one}")
    if len(wanted) != len(held):
        raise LedgerError(
            f"{CITATIONS.name}: {len(held)} rows, but the paper has {len(wanted)} that cite"
        )


_FORMULAS = ("display", "inline")


def cited_in(text: str) -> tuple[str, ...]:
    """The equations and sections that a sentence cites.

    >>> cited_in("By (1) and section 3.4, as in Appendix section A.1")
    ('(1)', '3.4', 'A.1')
    """
    return tuple(f"({one[1]})" if one[1] else one[2] for one in CITED.finditer(text))


# -------------------------------------------------------------------------------------------------
# The remarks.


def ambiguous_names(table: Sequence[Meant]) -> dict[str, list[Meant]]:
    """The names with more than one meaning, each with its meanings."""
    by_name: dict[str, list[Meant]] = {}
    for row in table:
        by_name.setdefault(row.name, []).append(row)
    return {name: rows for name, rows in by_name.items() if len(rows) > 1}


def remarks() -> str:
    """The remarks as two tables of Markdown: symbols, and citations."""
    lines = ["## Symbols with more than one meaning", ""]
    lines += ["| symbol | meaning | sections |", "| --- | --- | --- |"]
    for name, rows in ambiguous_names(meanings()).items():
        for row in rows:
            at = ", ".join(one.removesuffix(PROSE) for one in row.sections)
            lines.append(f"| ${name}$ | {row.meaning} | {at} |")
    lines += ["", "## Citations that do not carry what they are cited for", ""]
    lines += ["| where | cites | remark |", "| --- | --- | --- |"]
    for one in citations():
        if one.remark:
            section = one.key.rpartition("-")[0]
            lines.append(f"| {section} | {', '.join(one.cited)} | {one.remark} |")
    return "\n".join(lines)
