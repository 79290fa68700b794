"""How much the suite tries of what is too long to be tried whole: a share; with
JUGGLEPROOF_MUTANTS=many, as `make exhaust` sets it, more.
"""

from __future__ import annotations

import os
from typing import TypeVar

Amount = TypeVar("Amount")
MANY = os.environ.get("JUGGLEPROOF_MUTANTS") == "many"


def share(few: Amount, many: Amount) -> Amount:
    """The first of two amounts, with `many` the second."""
    return many if MANY else few
