"""Parameters of a goal: products of their bounds, and which of its variables are parameters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from math import comb

from flint import fmpq_poly, fmpz_mpoly

from juggleproof.algebra.numbers import bernstein, fraction
from juggleproof.algebra.polynomials import constant_of, degree_in
from juggleproof.search.psatz.facts import Factors
from juggleproof.search.psatz.problem import Problem

MOST_BOUNDED = 10  # variables with bounds, of which some are the parameters


@dataclass(frozen=True)
class Axis:
    """A parameter with the numbers of the facts low <= parameter, parameter <= high; one of them
    may be missing.
    """

    variable: int
    low: int | None
    high: int | None

    def factors(self, k: int, degree: int) -> Factors:
        """The k-th of the products of powers of the bounds: a basis of the polynomials of at most
        this degree.
        """
        powers = [(self.low, k), (self.high, degree - k if self.low is not None else k)]
        return tuple((fact, e) for fact, e in powers if fact is not None and e)

    def row(self, problem: Problem, exponent: int, degree: int) -> list[Fraction]:
        """The coefficients of parameter^exponent in this basis."""
        size = {
            fact: abs(constant_of(problem.facts[fact].poly.derivative(self.variable)) or 1)
            for fact in (self.low, self.high)
            if fact is not None
        }
        if self.low is not None and self.high is not None:
            low, high = (problem.facts[k].end(self.variable) for k in (self.low, self.high))
            values = bernstein(fmpq_poly([0] * exponent + [1]), low, high, degree)
            return [
                fraction(b)
                * comb(degree, k)
                / (high - low) ** degree
                / size[self.low] ** k
                / size[self.high] ** (degree - k)
                for k, b in enumerate(values)
            ]
        (fact,) = size
        end, sign = problem.facts[fact].end(self.variable), 1 if self.high is None else -1
        return [
            comb(exponent, k) * end ** (exponent - k) * Fraction(sign, size[fact]) ** k
            if k <= exponent
            else Fraction(0)
            for k in range(degree + 1)
        ]


def bounds(problem: Problem) -> dict[int, Axis]:
    """The variables that facts in them alone bound, with the tightest bounds."""
    low: dict[int, int] = {}
    high: dict[int, int] = {}
    for k, fact in enumerate(problem.facts):
        degrees = [int(d) for d in fact.poly.degrees()]
        if sum(degrees) != 1:
            continue
        v = degrees.index(1)
        above = (constant_of(fact.poly.derivative(v)) or 0) > 0
        side = low if above else high
        if v not in side or (fact.end(v) > problem.facts[side[v]].end(v)) == above:
            side[v] = k
    for v in {*low} & {*high}:
        if problem.facts[low[v]].end(v) >= problem.facts[high[v]].end(v):
            del high[v]  # a box needs a width
    return {v: Axis(v, low.get(v), high.get(v)) for v in sorted({*low, *high})}


def degree_in_all(poly: fmpz_mpoly, variables: Sequence[int]) -> int:
    """The total degree in some of the variables."""
    return max((sum(int(m[v]) for v in variables) for m in poly.monoms()), default=0)


def split_variables(
    problem: Problem, goal: fmpz_mpoly, axes: dict[int, Axis]
) -> tuple[list[int], list[int]] | None:
    """(parameters, others), so that the goal is of degree 2 at most in the others, if possible of
    degree 2 in each term; None where there are none.
    """
    degrees = [int(d) for d in goal.degrees()]
    used = {v for poly in problem.polys() for v, d in enumerate(poly.degrees()) if d}
    both = {v for v, axis in axes.items() if axis.low is not None and axis.high is not None}
    fixed = [v for v in sorted(used) if not degrees[v] and v in both]
    open_ = [v for v in axes if degrees[v]]
    if len(open_) > MOST_BOUNDED:
        return None
    monomials = [[int(e) for e in m] for m in goal.monoms()]
    best: tuple[tuple[int, bool, int], tuple[int, ...]] | None = None
    for count in range(len(open_) + 1):
        for chosen in combinations(open_, count):
            rest = [v for v in range(len(degrees)) if v not in chosen]
            heights = {sum(m[v] for v in rest) for m in monomials}
            rank = sum(v not in both for v in chosen), heights != {2}, count
            if max(heights) <= 2 and (best is None or rank < best[0]):
                best = rank, chosen
    if best is None:
        return None
    parameters = sorted({*best[1], *fixed})
    for v in fixed:  # what facts have squared, and in no higher term, is no parameter to them
        rest = [w for w in sorted(used) if w == v or w not in parameters]
        polys = [poly for poly in problem.polys() if degree_in(poly, v)]
        if max(degree_in(p, v) for p in polys) == 2 >= max(degree_in_all(p, rest) for p in polys):
            parameters.remove(v)
    return parameters, [v for v in sorted(used) if v not in parameters]
