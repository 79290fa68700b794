"""The place of a claim, as a reader of the paper finds it: the number of an equation, or a count
from the last numbered one.
"""

from __future__ import annotations

import re
from functools import cache

from juggleproof.judging.claims import Claim
from juggleproof.papers.ledger import LedgerRow, load_ledger

COUNTED = {"sentence": "sentence", "display": "display", "tablerow": "row of the table"}
FORMULAS = ("display", "inline")


def place_of(claim: Claim) -> str:
    """The section of a claim, with its equation, or its sentence, display or table row counted from
    the last numbered equation.

    A sentence that a display interrupts counts as several, as it does in the ledger; headings do
    not count.
    """
    own = not re.match(r"[A-Z0-9]", claim.section)
    section = claim.section if own else f"section {claim.section}"
    where = f"equation {claim.place}" if claim.place.startswith("(") else claim.place
    if claim.place.startswith("line"):
        where = _counted(claim) or where
    return ", ".join(part for part in (section, re.sub(r"(,| and) line \d+", "", where)) if part)


def _counted(claim: Claim) -> str:
    rows, of_claim = load_rows(), rows_of_claims().get(claim.id, [])
    here = [i for i in of_claim if rows[i].section == claim.section]
    line = int(re.findall(r"\d+", claim.place)[0])
    above = [i for i in here if rows[i].line <= line and rows[i].kind not in FORMULAS]
    if not of_claim:
        return ""
    if above:  # the claim's line decides, not an earlier row that also asserts it
        last = [i for i in above if rows[i].line == rows[above[-1]].line]
        at = min(last, key=lambda i: is_heading(rows[i]))
    else:
        at = (here or of_claim)[0]
    while rows[at].kind not in COUNTED:  # an inline formula stands in the sentence before it
        at -= 1
    row = rows[at]
    before = [i for i in rows_of_sections()[row.section] if i < at]
    number, start = "", min(before, default=at)
    for i in before:
        if i in numbers():
            number, start = numbers()[i], i + 1
    alike = [one for one in rows[start : at + 1] if one.kind == row.kind and not is_heading(one)]
    counted = f"{COUNTED[row.kind]} {len(alike)}" + (f" after {number}" if number else "")
    counted = "heading" if is_heading(row) else counted
    return counted if here else f"section {row.section}, {counted}"


def is_heading(row: LedgerRow) -> bool:
    """Whether the row is the heading of a section or of a part of a table; the first sentence of a
    section is one, even if it has claims.
    """
    return row.reason == "heading" or row.key.endswith("-s01")


@cache
def load_rows() -> tuple[LedgerRow, ...]:
    """The rows of the ledger."""
    return tuple(load_ledger())


@cache
def rows_of_claims() -> dict[str, list[int]]:
    """The indices of the rows of each claim."""
    found: dict[str, list[int]] = {}
    for i, row in enumerate(load_rows()):
        for name in dict.fromkeys(row.claims):
            found.setdefault(name, []).append(i)
    return found


@cache
def rows_of_sections() -> dict[str, list[int]]:
    """The indices of the rows of each section."""
    found: dict[str, list[int]] = {}
    for i, row in enumerate(load_rows()):
        found.setdefault(row.section, []).append(i)
    return found


@cache
def numbers() -> dict[int, str]:
    """The number of an equation by the index of the row that ends it: the last display of the
    claims that are named for the equation.
    """
    last: dict[str, int] = {}
    for i, row in enumerate(load_rows()):
        for name in row.claims if row.kind == "display" else ():
            number = re.fullmatch(r"eq-(\d+)[a-z]?", name)
            if number:
                last[f"({number[1]})"] = i
    return {i: number for number, i in last.items()}
