"""The statement about the table that moves as a sine that the store beside this file keeps, what
the second checker says of the store, and what a folder of certificates says.
"""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

from juggleproof.certificates.checker import Rejected, load
from juggleproof.certificates.sine.cells import UNRANKED, Attraction, Certificate
from juggleproof.certificates.sine.checker import (
    CERTIFICATES,
    STATEMENTS,
    Rectangle,
    check_folder,
    read_line,
    read_statement,
)
from juggleproof.certificates.sine.flights import Refused
from juggleproof.folders import folder_of

STORE = folder_of("juggleproof.certificates.sine") / "store"
WIDE = STORE.with_name("wide")
STATEMENT = (
    "the period-one bounce is stable and every motion tends to it for all"
    " alpha in [49/1000, 51/1000] and Gamma in [619/200, 621/200]"
)


def boxes_in(folder: Path) -> list[Attraction]:
    """The boxes of the theorem whose certificates stand in a folder.  Whether the checker takes
    them is not asked here.
    """
    lines = map(read_line, load(str(folder / CERTIFICATES)).splitlines())
    return [
        Attraction(one.grid.alpha, one.grid.g, one.grid.per_unit, (Fraction(1),) * one.grid.rows)
        for one in lines
        if isinstance(one, Certificate) and UNRANKED not in one.ranks
    ]


def wide_rectangles() -> list[Rectangle]:
    """The rectangles of the wide cover.  Those of short intervals of alpha come first, since they
    hold most of the others for most boxes in g.
    """
    lines = WIDE.joinpath(STATEMENTS).read_text().splitlines()
    return sorted(map(read_statement, lines), key=lambda one: one.alpha[1] - one.alpha[0])


def stored_outcomes() -> list[tuple[str, str, str]]:
    """(sentence or line, outcome, reason): of each stored statement, of each line of certificates
    that is rejected, or of the store where it cannot be read.
    """
    try:
        return check_folder(str(STORE))
    except (Refused, Rejected) as reason:
        return [(STORE.name, "rejected", str(reason))]
