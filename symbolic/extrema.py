"""Maximum of a function of (x, w) on a set, exactly for all 0 < alpha < 1, by comparing all
candidates.

Candidates are the points where the function is stationary inside, along each boundary curve
(Lagrange), and the corners where two curves meet. Every function and constraint here is linear in
x, so a curve gives x as a function of w.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

from sympy import Expr, Poly

from symbolic.algebra import DerivationError, lowest_terms, root_of
from symbolic.signs import reduced, sign_for_lossy_impacts, simplest_roots
from symbolic.symbols import w, x


class Candidate(NamedTuple):
    """A point (x, w) with the value there and the constraints that hold with equality by its
    construction.
    """

    x: Expr
    w: Expr
    value: Expr
    active: tuple[Expr, ...]


def candidates(objective: Expr, constraints: Sequence[Expr]) -> list[Candidate]:
    """The stationary points inside, along each curve constraint = 0, and the corners that satisfy
    all constraints >= 0.

    >>> candidates(w - x, [x, 1 - w, w])
    [Candidate(x=0, w=1, value=1, active=(x, 1 - w)), Candidate(x=0, w=0, value=0, active=(x, w))]
    """
    _refuse_stationary_inside(objective)
    points: list[tuple[Expr, Expr, tuple[Expr, ...]]] = []
    for curve in constraints:
        points += [(*point, (curve,)) for point in _stationary_along(objective, curve)]
    for first, second in combinations(constraints, 2):
        points += [(*point, (first, second)) for point in _meeting_points(first, second)]
    return [
        Candidate(reduced(px), reduced(pw), reduced(objective.subs({x: px, w: pw})), active)
        for px, pw, active in points
        if all(sign_for_lossy_impacts(_at(g, px, pw)) >= 0 for g in constraints if g not in active)
    ]


def greatest(found: Sequence[Candidate]) -> Candidate:
    """The candidate of the greatest value for all 0 < alpha < 1; DerivationError where the order
    depends on alpha.

    >>> greatest(candidates(w - x, [x, 1 - w, w])).value
    1
    """
    if not found:
        raise DerivationError("no candidate satisfies the constraints")
    best = found[0]
    for candidate in found[1:]:
        if sign_for_lossy_impacts(candidate.value - best.value) > 0:
            best = candidate
    return best


def falls_without_bound(objective: Expr) -> bool:
    """Whether the objective tends to minus infinity at infinity in the wedge 0 <= x <= w.

    There it is enough that it decreases in x and is, along x = 0, a quadratic in w with negative
    leading coefficient.

    >>> falls_without_bound(w - x - w**2), falls_without_bound(w - x)
    (True, False)
    """
    along = Poly(objective.xreplace({x: 0}), w)
    slope = Poly(objective, x).nth(1)
    return (
        Poly(objective, x).degree() == 1
        and sign_for_lossy_impacts(slope) < 0
        and along.degree() == 2
        and sign_for_lossy_impacts(along.LC()) < 0
    )


def _refuse_stationary_inside(objective: Expr) -> None:
    slope = lowest_terms(objective.diff(x))
    if slope.has(x, w) or sign_for_lossy_impacts(slope) == 0:
        raise DerivationError(f"may be stationary inside: {objective}")


def _stationary_along(objective: Expr, curve: Expr) -> list[tuple[Expr, Expr]]:
    if not curve.has(x):
        # Along w = constant the objective is strictly monotone in x, so nothing is stationary.
        return []
    height = root_of(curve, x)
    slope = Poly(lowest_terms(objective.xreplace({x: height}).diff(w)), w)
    if slope.degree() < 1:
        if slope.is_zero or sign_for_lossy_impacts(slope.nth(0)) == 0:
            raise DerivationError(f"constant along a boundary curve: {curve}")
        return []
    return [(height.subs(w, speed), speed) for speed in simplest_roots(slope)]


def _meeting_points(first: Expr, second: Expr) -> list[tuple[Expr, Expr]]:
    if not first.has(x):
        first, second = second, first
    if not first.has(x):
        return []  # two lines w = constant
    height = root_of(first, x)
    speeds = simplest_roots(Poly(lowest_terms(second.subs(x, height)), w))
    return [(height.subs(w, speed), speed) for speed in speeds]


def _at(expression: Expr, height: Expr, speed: Expr) -> Expr:
    return expression.subs({x: height, w: speed})
