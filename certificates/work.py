"""Counted work, and statements unfolded once: what all searches share."""

from __future__ import annotations

import ast
from collections.abc import Sequence

from juggleproof.certificates import checker

# -------------------------------------------------------------------------------------------------
# Counted work: every search spends from a budget, so that it ends after the same work on every
# machine.


class Exhausted(Exception):
    """The counted work of a search is used up."""


class Budget:
    """A number of units of work, a few microseconds each; what a part spends, the whole spends too.

    >>> whole = Budget(100)
    >>> part = whole.part(30)
    >>> part.spend(20)
    >>> whole.left, part.left
    (80, 10)
    """

    def __init__(self, units: int, whole: Budget | None = None) -> None:
        self.left, self.whole = units, whole

    def spend(self, amount: int) -> None:
        """Takes `amount` units, for work ahead; raises Exhausted, and takes none, where fewer are
        left: what is too large leaves the budget to what is smaller.
        """
        if amount > self.left:
            raise Exhausted
        if self.whole is not None:
            self.whole.spend(amount)
        self.left -= amount

    def charge(self, amount: int) -> None:
        """Takes `amount` units, or what is left, for work that was done; raises Exhausted where
        that is less.
        """
        least, budget = min(amount, self.left), self.whole
        while budget is not None:
            least, budget = min(least, budget.left), budget.whole
        self.spend(least)
        if least < amount:
            raise Exhausted

    def part(self, units: int) -> Budget:
        """A smaller budget within this one."""
        return Budget(min(units, self.left), self)


# -------------------------------------------------------------------------------------------------
# Statements unfolded once: the searches for points, proofs and witnesses share what the checker
# makes of a text.

MOST = 32
# by ids; the statement and the trees are kept with it, so that their ids stay theirs
_kept: dict[
    tuple[int, ...], tuple[checker.Unfolding, checker.Statement, Sequence[ast.expr] | None]
] = {}


def read(text: str, name: str) -> checker.Statement:
    """The statement as the checker reads it."""
    return checker.read_statements(text)[name]


def unfolded(
    statement: checker.Statement, sharp: Sequence[ast.expr] | None = None
) -> checker.Unfolding:
    """The statement's variables, premises, obligations and goals in a context of its own; not to be
    changed.  `sharp` has the domain of a sharp range, and its condition where that is assumed.

    >>> text = "statement a/b\\nforall x\\ngiven x > 1\\nshow x > 0"
    >>> unfolding = unfolded(checker.read_statements(text)["a/b"])
    >>> unfolding.universal, len(unfolding.premises)
    (['x'], 1)
    """
    key = (id(statement), *map(id, sharp or ()))
    if key not in _kept:
        while len(_kept) >= MOST:
            del _kept[next(iter(_kept))]
        unfolding = checker.Unfolding(statement, checker.Context(), sharp)
        _kept[key] = unfolding, statement, sharp and list(sharp)
    return _kept[key][0]
