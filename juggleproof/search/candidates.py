"""Simple values for one variable: the ones that a reader likes best, and the simplest in every
interval where a condition holds.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Union

from flint import fmpq, fmpq_mpoly, fmpq_poly

from juggleproof.algebra.conditions import Condition, evaluate
from juggleproof.algebra.numbers import (
    AlgebraicNumber,
    exact,
    fraction,
    real_roots,
    sign,
    simplest_between,
)
from juggleproof.search import limits
from juggleproof.statements.language import Roles

Value = Union[fmpq, AlgebraicNumber]

FAVOURITES = tuple(map(exact, limits.FAVOURITES))
FAVOURITE_PARAMETERS = tuple(map(exact, limits.FAVOURITE_PARAMETERS))


def favourites(name: str, integral: bool, roles: Roles) -> tuple[fmpq, ...]:
    """The values to try first for a variable of this name; between 0 and 1 for the parameter."""
    if name == roles.parameter:
        return FAVOURITE_PARAMETERS
    return tuple(v for v in FAVOURITES if v.q == 1) if integral else FAVOURITES


class Cells:
    """The real line cut at the roots of some polynomials in one variable."""

    def __init__(self, polys: Mapping[int, fmpq_poly]) -> None:
        self.polys = dict(polys)

    @cached_property
    def roots(self) -> list[AlgebraicNumber]:
        """The distinct roots in increasing order, their intervals apart."""
        roots: list[AlgebraicNumber] = []
        for poly in self.polys.values():
            for root in real_roots(poly):
                if root not in roots:
                    roots.append(root)
        roots.sort()
        separate(roots)
        return roots

    def intervals(self) -> list[tuple[fmpq, fmpq]]:
        """The ends of the open cells, as `cells_between` has them."""
        return cells_between(self.roots)

    def signs(self, at: Value) -> dict[int, int]:
        """The sign of every polynomial at a value, found where it is asked for."""
        return SignsAtValue(self.polys, at)


class SignsAtValue(dict[int, int]):
    """The signs of polynomials at a value; most conditions are decided by a few of them."""

    def __init__(self, polys: Mapping[int, fmpq_poly], at: Value) -> None:
        super().__init__()
        self.polys, self.at = polys, at

    def __missing__(self, k: int) -> int:
        at = self.at
        self[k] = found = (
            at.sign_of(self.polys[k])
            if isinstance(at, AlgebraicNumber)
            else sign(self.polys[k](at))
        )
        return found


def cells_between(roots: Sequence[AlgebraicNumber]) -> list[tuple[fmpq, fmpq]]:
    """Rational ends strictly inside, or at, the ends of every open cell; the unbounded cells are
    cut two units beyond.
    """
    if not roots:
        return [(fmpq(-2), fmpq(2))]
    inner = [(left._high, right._low) for left, right in zip(roots, roots[1:])]
    first, last = roots[0]._low, roots[-1]._high
    return [(first - 2, first), *inner, (last, last + 2)]


def separate(roots: list[AlgebraicNumber]) -> None:
    """Refines increasing distinct numbers until their intervals are apart, with room in between."""
    for left, right in zip(roots, roots[1:]):
        while left._high >= right._low:
            left.refine()
            right.refine()
    for root in roots:
        if not root.is_rational and len(roots) > 0:
            root.narrow(_gap(roots, root))


def _gap(roots: list[AlgebraicNumber], root: AlgebraicNumber) -> Fraction:
    k = next(i for i, r in enumerate(roots) if r is root)
    distances = [
        abs(fraction(other._low - root._low)) for i, other in enumerate(roots) if abs(i - k) == 1
    ]
    return min([Fraction(1, 16), *(distance / 64 for distance in distances)])


def spread(low: fmpq, high: fmpq) -> Iterator[fmpq]:
    """Ever more rationals strictly between two, the simplest first: the interval is cut at each in
    turn.
    """
    queue = [(low, high)]
    while queue:
        low, high = queue.pop(0)
        middle = simplest_between(low, high)
        yield middle
        queue += [(low, middle), (middle, high)]


def whole_between(low: fmpq, high: fmpq) -> Iterator[fmpq]:
    """The integers strictly between two rationals, from below; the first few."""
    first = fmpq(low.floor()) + 1
    for k in range(4):
        if first + k < high:
            yield first + k


def solutions(
    condition: Condition, name: str, integral: bool, count: int, irrational: bool, roles: Roles
) -> list[Value]:
    """Values of the one variable left that meet the condition: favourites, the simplest of every
    open cell, then roots.
    """
    cells = Cells(condition.in_one_variable(name))
    found: list[Value] = []

    def offer(value: fmpq) -> bool:
        if value not in found and evaluate(condition.tree, cells.signs(value)):
            found.append(value)
            return True
        return False

    for value in favourites(name, integral, roles)[: 8 + count]:
        offer(value)
        if len(found) >= count:
            return found
    for low, high in cells.intervals():
        if low < high:
            middle = (
                next(whole_between(low, high), None) if integral else simplest_between(low, high)
            )
            if middle is not None:
                offer(middle)
    for root in cells.roots:
        if root.is_rational:
            value = root._low
            if not integral or value.q == 1:
                offer(value)
        elif irrational and not integral and evaluate(condition.tree, cells.signs(root)):
            found.append(root)
    return found[: max(count, 1)]


def trials(condition: Condition, name: str, integral: bool, count: int, roles: Roles) -> list[fmpq]:
    """Values to try for a variable that others still depend on, among those that meet the relations
    about it alone.
    """
    place = condition.ring.variable_to_index(name)
    own = [(p, relation) for p, relation in condition.facts() if _only(p, place)]
    if not own:
        return list(favourites(name, integral, roles)[:count])
    alone = Condition(
        condition.ring,
        [p for p, _ in own],
        ("and", [(k, relation) for k, (_, relation) in enumerate(own)]),
    )
    cells = Cells(alone.in_one_variable(name))
    meets = [v for v in favourites(name, integral, roles) if evaluate(alone.tree, cells.signs(v))]
    found = meets[:count]
    if len(found) < count:
        for low, high in cells.intervals():
            inner = (
                next(whole_between(low, high), None)
                if integral
                else simplest_between(low, high)
                if low < high
                else None
            )
            if inner is None or not evaluate(alone.tree, cells.signs(inner)):
                continue
            for value in whole_between(low, high) if integral else spread(low, high):
                if value not in found:
                    found.append(value)
                if len(found) >= count:
                    return found
        for root in cells.roots:
            if (
                root.is_rational
                and root._low not in found
                and evaluate(alone.tree, cells.signs(root))
            ):
                found.append(root._low)
    return found[:count]


def _only(poly: fmpq_mpoly, place: int) -> bool:
    degrees = poly.degrees()
    return bool(degrees[place]) and not any(e for i, e in enumerate(degrees) if i != place)
