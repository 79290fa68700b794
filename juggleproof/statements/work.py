"""Counted work, and statements unfolded once: what all searches share."""

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
_kept: dict[tuple[int, ...], Unfolded] = {}


class Unfolded(checker.Unfolding):
    """An unfolding that goes on from one before it where both statements begin with the same lines,
    as premises of one map rule do.
    """

    def __init__(
        self,
        statement: checker.Statement,
        sharp: Sequence[ast.expr] | None = None,
        before: Unfolded | None = None,
    ) -> None:
        self.statement, self.sharp = statement, [*(sharp or [])]
        # what was unfolded after each line; the first ones are those of the other
        self.after: list[dict[str, Any]] = (
            [] if before is None else before.after[: self._shared(before)]
        )
        self.lines_to_skip = len(self.after)
        super().__init__(statement, checker.Context(), sharp)

    def _shared(self, before: Unfolded) -> int:
        """How many lines at the beginning are those of the other statement."""
        one, other = self.statement, before.statement
        if before.sharp != self.sharp or one.get("integer") != other.get("integer"):
            return 0
        pairs = zip(zip(one.texts, one.lines), zip(other.texts, other.lines))
        return len([*takewhile(lambda pair: same(*pair), pairs)])

    def line(self, *said: Any) -> None:
        """What one line adds; those that the other one has are taken over at the last of them."""
        self.lines_to_skip -= 1
        if self.lines_to_skip < 0:
            super().line(*said)
            self.after.append(_copied(self.__dict__))
        elif not self.lines_to_skip:
            last = self.after[-1]
            last["context"].work.refill(checker.MAX_WORK)  # what others have spent is not its own
            self.__dict__.update(_copied(last))


ADDED = ("premises", "obligations", "goals", "variables", "universal")


def _copied(parts: Mapping[str, Any]) -> dict[str, Any]:
    """What lines have added to an unfolding, apart from what later ones add."""
    return {"context": checker.Context(parts["context"]), **{n: copy(parts[n]) for n in ADDED}}


def same(one: object, other: object) -> bool:
    """Whether two lines, or two trees, say the same."""
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
    """The statement's variables, premises, obligations and goals in a context of its own; not to be
    changed.  `sharp` has the domain of a sharp range, and its condition where that is assumed.

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
