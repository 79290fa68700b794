"""A rational point where the fraction of a problem is nearly greatest: floating point finds it, its value is computed exactly."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import numpy as np
from numpy.typing import NDArray

from benchmarks.bench.problems import Problem, Terms, combined
from certificates.search.float_minimum import FloatPolynomial, simple_points

Array = NDArray[np.float64]
Point = tuple[Fraction, ...]
PLACES = (0.0, 0.5, 1.0)
ROUNDS, AHEAD = 60, 8
CLOSE = 1e-9  # what floating point tells apart for certain


def best_point(problem: Problem, slack: Fraction) -> tuple[Point, Fraction]:
    """A point of the box and the value there, which no point found exceeds by more than `slack`.

    Dinkelbach's iteration: where over/under >= m, the least m under - over tells a better point, until nothing is gained.
    Source: Dinkelbach, On nonlinear fractional programming, Management Science 13 (1967).
    """
    low, high = (np.array([float(pair[k]) for pair in problem.box]) for k in (0, 1))
    places = np.array(list(product(PLACES, repeat=len(problem.box))))
    quotient = _Quotient(problem)
    value, place = quotient.greatest(low + (high - low) * places)
    before = 0.0
    for _ in range(ROUNDS):
        _, x = quotient.excess(value).descend(place, low, high)
        better, x = quotient.greatest(x[None])
        gained = better - value
        if not gained > 0:
            break
        value, place = better, x
        next_gain = gained * (gained / before) ** 2 if before else gained  # gains go down as squares do
        if next_gain <= float(slack) / AHEAD:
            break
        before = gained
    best: tuple[Point, Fraction] | None = None
    near = value - max(2 * float(slack), CLOSE)
    for point in simple_points(place, problem.box):
        if quotient.greatest(np.array([point], dtype=float))[0] < near:
            continue  # too simple
        exact = problem.at(point)
        if exact is not None and (best is None or exact > best[1]):
            best = point, exact
        if best is not None and best[1] >= Fraction(value) - slack:
            break
    if best is None:
        raise ArithmeticError(f"{problem.name}: no point of the box has a value")
    return best


class _Quotient:
    """over/under in floating point."""

    def __init__(self, problem: Problem) -> None:
        self.over, self.under = ({e: float(c) for e, c in terms.items()} for terms in (problem.over, problem.under))
        monomials = list(dict.fromkeys([*self.over, *self.under]))
        self.exponents = np.array(monomials)
        self.matrix = np.array([[part.get(e, 0.0) for e in monomials] for part in (self.over, self.under)])

    def excess(self, bound: float) -> FloatPolynomial:
        """bound * under - over."""
        return FloatPolynomial(combined(self.under, bound, self.over), self.exponents.shape[1])

    def greatest(self, points: Array) -> tuple[float, Array]:
        """The greatest value at these points, and where."""
        over, under = self.matrix @ (points[:, None, :] ** self.exponents).prod(axis=2).T
        found = np.divide(over, under, out=np.full(len(points), -np.inf), where=under > 0)
        best = int(found.argmax())
        return float(found[best]), points[best]


def values(terms: Terms, points: Array) -> Array:
    """The values of a polynomial at many points, in floating point."""
    total = np.zeros(len(points))
    for exponents, c in terms.items():
        part = np.full(len(points), float(c))
        for axis, e in enumerate(exponents):
            for _ in range(e):
                part *= points[:, axis]
        total += part
    return total
