"""Counted work, and a cache of unfolded statements, which all searches share."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from copy import copy
from itertools import takewhile
from typing import Any

from juggleproof.certificates import checker

# -------------------------------------------------------------------------------------------------
# Counted work: every search spends from a budget, so that it ends after the same work on every
# machine.


class Exhausted(Exception):
    """The counted work of a search is used up."""


class Budget:
    """A number of units of work, a few microseconds each; a part's spending counts for the whole.

    >>> whole = Budget(100)
    >>> part = whole.part(30)
    >>> part.spend(20)
    >>> whole.left, part.left
    (80, 10)
    """

    def __init__(self, units: int, whole: Budget | None = None) -> None:
        self.left, self.whole = units, whole

    def spend(self, amount: int) -> None:
        """Takes `amount` units, for work ahead.  Where fewer are left, raises Exhausted and takes
        none, so that smaller work can still be done.
        """
        if amount > self.left:
            raise Exhausted
        if self.whole is not None:
            self.whole.spend(amount)
        self.left -= amount

    def charge(self, amount: int) -> None:
        """Takes `amount` units, for work that was done.  Where fewer are left, takes these and
        raises Exhausted.
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
# Unfolded statements, kept: the searches for points, proofs and witnesses share the checker's
# unfolding of a text.

MOST = 32
# by ids of a statement and trees; an unfolding keeps these objects, so no other can get their ids
_kept: dict[tuple[int, ...], Unfolded] = {}


class Unfolded(checker.Unfolding):
    """An unfolding that reuses the one before it where both statements begin with the same lines,
    as premises of one map rule do.
    """

    def __init__(
        self,
        statement: checker.Statement,
        sharp: Sequence[ast.expr] | None = None,
        before: Unfolded | None = None,
    ) -> None:
        self.statement, self.sharp = statement, [*(sharp or [])]
        # the unfolding after each line; the first of these come from the unfolding before
        self.after: list[dict[str, Any]] = (
            [] if before is None else before.after[: self._shared(before)]
        )
        self.lines_to_skip = len(self.after)
        super().__init__(statement, checker.Context(), sharp)

    def _shared(self, before: Unfolded) -> int:
        """The number of lines at the beginning that both statements share."""
        one, other = self.statement, before.statement
        if before.sharp != self.sharp or one.get("integer") != other.get("integer"):
            return 0
        pairs = zip(zip(one.texts, one.lines), zip(other.texts, other.lines))
        return len([*takewhile(lambda pair: same(*pair), pairs)])

    def line(self, *said: Any) -> None:
        """Unfolds one line; the shared lines are copied together, at the last of them."""
        self.lines_to_skip -= 1
        if self.lines_to_skip < 0:
            super().line(*said)
            self.after.append(_copied(self.__dict__))
        elif not self.lines_to_skip:
            last = self.after[-1]
            last["context"].work.refill(checker.MAX_WORK)  # each unfolding has the full work
            self.__dict__.update(_copied(last))


ADDED = ("premises", "obligations", "goals", "variables", "universal")


def _copied(parts: Mapping[str, Any]) -> dict[str, Any]:
    """A copy of what lines have added to an unfolding; later lines do not change it."""
    return {"context": checker.Context(parts["context"]), **{n: copy(parts[n]) for n in ADDED}}


def same(one: object, other: object) -> bool:
    """Whether two lines, or two trees, are equal."""
    if one is other:
        return True
    if isinstance(one, ast.AST):
        names = one._fields
        return type(one) is type(other) and all(
            same(getattr(one, name), getattr(other, name)) for name in names
        )
    if isinstance(one, (list, tuple)) and isinstance(other, (list, tuple)):
        return len(one) == len(other) and all(map(same, one, other))
    return one == other


def read(text: str, name: str) -> checker.Statement:
    """The statement as the checker reads it."""
    return checker.read_statements(text)[name]


def unfolded(
    statement: checker.Statement, sharp: Sequence[ast.expr] | None = None
) -> checker.Unfolding:
    """The statement's variables, premises, obligations and goals in a context of its own, which
    callers must not change.  `sharp` has the domain of a sharp range, and its condition where that
    is assumed.

    >>> text = "statement a/b\\nforall x\\ngiven x > 1\\nshow x > 0"
    >>> unfolding = unfolded(checker.read_statements(text)["a/b"])
    >>> unfolding.universal, len(unfolding.premises)
    (['x'], 1)
    """
    key = (id(statement), *map(id, sharp or ()))
    if key not in _kept:
        before = next(reversed(_kept.values()), None)
        unfolding = Unfolded(statement, sharp, before)
        while len(_kept) >= MOST:
            del _kept[next(iter(_kept))]
        _kept[key] = unfolding
    return _kept[key]
