"""The statement about the table that moves as a sine that the store beside this file keeps, and
what the second checker says of the store.
"""

from __future__ import annotations

from pathlib import Path

from ..checker import Rejected
from .checker import check_folder
from .flights import Refused

STORE = Path(__file__).resolve().parent / "store"
STATEMENT = (
    "the period-one bounce is stable and every motion tends to it for all"
    " alpha in [49/1000, 51/1000] and Gamma in [619/200, 621/200]"
)


def stored_outcomes() -> list[tuple[str, str, str]]:
    """(sentence or line, outcome, reason): of each stored statement, of each line of certificates
    that is rejected, or of the store where it cannot be read.
    """
    try:
        return check_folder(str(STORE))
    except (Refused, Rejected) as reason:
        return [(STORE.name, "rejected", str(reason))]
