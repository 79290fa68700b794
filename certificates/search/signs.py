"""Facts as a search uses them, and polynomials whose sign they show at sight."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import comb

from flint import fmpz_mpoly

from .polynomials import constant_of
from .reduction import Factors
from .sturm import bernstein, univariate

Sum = list[
    tuple[Fraction, Factors]
]  # of products of facts of the problem, each with a positive coefficient


@dataclass
class Fact:
    """leads^counts * facts of the state^factors = scale * multiplier * poly modulo the equations;
    poly is primitive, scale > 0.
    """

    poly: fmpz_mpoly
    strict: bool
    factors: Factors
    counts: tuple[int, ...]
    scale: Fraction
    multiplier: Sum | None = None  # a positive sum over other facts; None stands for 1

    def degree(self, variable: int) -> int:
        """The degree in one variable."""
        return int(self.poly.degrees()[variable])

    def end(self, variable: int) -> Fraction:
        """Where a bound a*z + b vanishes."""
        slope = constant_of(self.poly.derivative(variable)) or 1
        rest = next(
            (c for monomial, c in zip(self.poly.monoms(), self.poly.coeffs()) if not any(monomial)),
            0,
        )
        return Fraction(-int(rest), slope)


@dataclass(frozen=True)
class Bounded:
    """A variable with a fact low = a*z + b that bounds it below, a > 0, and a fact high = d - c*z
    that bounds it above.
    """

    variable: int
    low: int
    high: int


def times(a: Sum, b: Sum) -> Sum:
    """The product of two sums of products."""
    total: dict[Factors, Fraction] = {}
    for c, f in a:
        for d, g in b:
            powers = dict(f)
            for k, e in g:
                powers[k] = powers.get(k, 0) + e
            key = tuple(sorted(powers.items()))
            total[key] = total.get(key, Fraction(0)) + c * d
    return [(c, f) for f, c in sorted(total.items())]


class Signs:
    """Polynomials whose sign the facts show at sight, as positive sums of products of facts."""

    def __init__(self, facts: Sequence[Fact], bounded: Bounded | None) -> None:
        self.facts, self.bounded = facts, bounded
        self.at_least_zero: dict[int, int] = {}  # variable -> fact
        for k, fact in enumerate(facts):
            degrees = [int(d) for d in fact.poly.degrees()]
            if len(fact.poly) == 1 and sum(degrees) == 1 and fact.poly.leading_coefficient() > 0:
                self.at_least_zero[degrees.index(1)] = k

    def of(self, poly: fmpz_mpoly) -> tuple[int, Sum]:
        """(sign, positive sum equal to sign * poly) with a strict term; (0, []) where none is
        seen.
        """
        for k, fact in enumerate(self.facts):
            if (
                fact.strict
                and fact.multiplier is None
                and (fact.poly == poly or fact.poly == -poly)
            ):
                return (1 if fact.poly == poly else -1), [(Fraction(1), ((k, 1),))]
        for sign in (1, -1):
            found = self._termwise(poly * sign) or self._between(poly * sign)
            if found:
                return sign, found
        return 0, []

    def _termwise(self, poly: fmpz_mpoly) -> Sum:
        """All coefficients positive in variables that are at least 0."""
        found: Sum = []
        strict = False
        for monomial, coefficient in zip(poly.monoms(), poly.coeffs()):
            used = [(v, int(e)) for v, e in enumerate(monomial) if e]
            if coefficient < 0 or any(v not in self.at_least_zero for v, _ in used):
                return []
            own = tuple(sorted((self.at_least_zero[v], e) for v, e in used))
            strict = strict or all(self.facts[k].strict for k, _ in own)
            found.append((Fraction(int(coefficient)), own))
        return found if strict else []

    def _between(self, poly: fmpz_mpoly) -> Sum:
        """Positive Bernstein coefficients in the bounded variable alone."""
        bounded = self.bounded
        if bounded is None:
            return []
        degree = int(poly.degrees()[bounded.variable])
        if not degree or degree != sum(map(int, poly.degrees())):
            return []
        facts, ends = (
            self.facts,
            [self.facts[k].end(bounded.variable) for k in (bounded.low, bounded.high)],
        )
        width = ends[1] - ends[0]
        slopes = [
            abs(constant_of(facts[k].poly.derivative(bounded.variable)) or 1)
            for k in (bounded.low, bounded.high)
        ]
        if width <= 0:
            return []
        found: Sum = []
        strict = False
        for k, b in enumerate(
            bernstein(univariate(poly, bounded.variable), ends[0], ends[1], degree)
        ):
            if b < 0:
                return []
            own = tuple(
                (i, e) for i, e in sorted(((bounded.low, k), (bounded.high, degree - k))) if e
            )
            if b:
                strict = strict or all(facts[i].strict for i, _ in own)
                value = Fraction(int(b.p), int(b.q)) * comb(degree, k) / width**degree
                found.append((value / slopes[0] ** k / slopes[1] ** (degree - k), own))
        return found if strict else []
