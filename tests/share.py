"""How much the suite tries of what is too long to be tried whole: a share; with
JUGGLEPROOF_MUTANTS=many, as CI sets it, more; with JUGGLEPROOF_MUTANTS=all, which takes hours, all.
"""

from __future__ import annotations

import os
from typing import TypeVar

Amount = TypeVar("Amount")
ALL = os.environ.get("JUGGLEPROOF_MUTANTS") == "all"
MANY = ALL or os.environ.get("JUGGLEPROOF_MUTANTS") == "many"


def share(few: Amount, many: Amount, everything: Amount) -> Amount:
    """The first of three amounts, with `many` the second, with `all` the third."""
    return everything if ALL else many if MANY else few
