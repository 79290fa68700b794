"""Where a claim stands, as a reader of the paper finds it: by the number of an equation, or counted
from the last one.
"""

from __future__ import annotations

import re
from functools import cache

from juggleproof.proofs.claims import Claim
from juggleproof.proofs.ledger.ledger import Row, load_ledger

COUNTED = {"sentence": "sentence", "display": "display", "tablerow": "row of the table"}


def place_of(claim: Claim) -> str:
    """The section, and the equation or what is counted from the last numbered one.

    A sentence that a display interrupts counts as several, as it does in the ledger.
    """
    own = not re.match(r"[A-Z0-9]", claim.section)
    section = claim.section if own else f"section {claim.section}"
    where = f"equation {claim.place}" if claim.place.startswith("(") else claim.place
    if claim.place.startswith("line"):
        where = _counted(claim.id) or where
    return ", ".join(part for part in (section, where) if part)


def _counted(claim_id: str) -> str:
    rows = load_rows()
    at = next((i for i, row in enumerate(rows) if claim_id in row.claims), None)
    if at is None:
        return ""
    while rows[at].kind not in COUNTED:  # an inline formula stands in the sentence before it
        at -= 1
    row = rows[at]
    before = [i for i in range(at) if rows[i].section == row.section]
    number, start = "", min(before, default=at)
    for i in before:
        if i in numbers():
            number, start = numbers()[i], i + 1
    count = sum(rows[i].kind == row.kind for i in range(start, at + 1))
    return f"{COUNTED[row.kind]} {count}" + (f" after {number}" if number else "")


@cache
def load_rows() -> tuple[Row, ...]:
    """The rows of the ledger."""
    return tuple(load_ledger())


@cache
def numbers() -> dict[int, str]:
    """The rows that end a numbered equation, with its number: the last displays of the claims that
    are named for it.
    """
    last: dict[str, int] = {}
    for i, row in enumerate(load_rows()):
        for name in row.claims if row.kind == "display" else ():
            number = re.fullmatch(r"eq-(\d+)[a-z]?", name)
            if number:
                last[f"({number[1]})"] = i
    return {i: number for number, i in last.items()}
