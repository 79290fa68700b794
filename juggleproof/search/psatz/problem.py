"""The facts of a leaf made ready for a search."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

import numpy as np
from flint import fmpz_mpoly
from numpy.typing import NDArray

from juggleproof.algebra.box_trees import tree_above_zero
from juggleproof.algebra.numbers import fraction, univariate
from juggleproof.algebra.polynomials import (
    Keys,
    Packing,
    Ring,
    Row,
    constant_of,
    total_degree,
    used_in,
)
from juggleproof.search import limits
from juggleproof.search.psatz.candidates import Pool, resultants, squares
from juggleproof.search.psatz.facts import (
    BoundedVariable,
    Fact,
    Factors,
    Reduction,
    Scaling,
    ShownSigns,
    Signed,
    Sum,
    sides_of,
    times,
)
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget

# -------------------------------------------------------------------------------------------------
# What a search starts from.


@dataclass
class Source:
    """What the search started from: lowered facts (numerators), their denominators, and which are
    not known to be positive.
    """

    ring: Ring
    scaling: Scaling
    polys: list[fmpz_mpoly]  # numerators of all facts, with the scales of the state
    lowered: list[fmpz_mpoly]
    dens: list[int]
    relations: list[str]
    scale_facts: dict[
        int, tuple[int, int]
    ]  # scale variable -> (number of the fact c * variable > 0, c)


# -------------------------------------------------------------------------------------------------
# The facts of a state made ready for a search: scales set to 1, equations used up, each fact once
# and primitive.


class LeafProblem:
    """What a leaf of a proof has to contradict; `whole`, with the facts too that seem only to
    define a root, or are of high degree; `high`, with the latter; without `quotients`, equations
    give only what they need not divide for.

    >>> from juggleproof.certificates import checker
    >>> context = checker.Context()
    >>> for name in ("r", "x", "y"):
    ...     context.declare(name)
    >>> formula = context.formula(checker.parse("r > 0 and x >= r and 2*y = x + r and y < r"))
    >>> problem = LeafProblem(SearchState(context).assume(formula), Ring(("r", "x", "y")))
    >>> [(str(fact.poly), fact.strict) for fact in problem.facts]
    [('x - 1', False), ('-x + 1', True)]
    """

    def __init__(
        self,
        state: SearchState,
        ring: Ring,
        whole: bool = False,
        quotients: bool = True,
        high: bool = False,
    ) -> None:
        self.ring = ring
        polys = [ring.read(poly) for poly, _ in state.facts]
        relations = [relation for _, relation in state.facts]
        scale_facts: dict[int, tuple[int, int]] = {}
        for index, (poly, relation) in enumerate(zip(polys, relations)):
            if (
                relation == ">"
                and len(poly) == 1
                and poly.total_degree() == 1
                and poly.leading_coefficient() > 0
            ):
                scale_facts.setdefault(
                    poly.degrees().index(1), (index, int(poly.leading_coefficient()))
                )
        scaling = Scaling(ring, [p for p in polys if p], sorted(scale_facts))
        lowered = [scaling.lower(poly) for poly in polys]
        self.source = Source(
            ring,
            scaling,
            polys,
            lowered,
            [poly.den for poly, _ in state.facts],
            relations,
            scale_facts,
        )
        self.idle: set[int] = set() if whole else idle_facts(lowered, relations)
        if not whole and not high:
            self.idle |= high_facts(lowered)
        equations = [
            (k, p)
            for k, p in enumerate(lowered)
            if relations[k] == "=" and p and k not in self.idle
        ]
        signed = [
            Signed(k, p, relations[k] == ">")
            for k, p in enumerate(lowered)
            if relations[k] in (">", "!=")
        ]
        integers = frozenset(
            k for k, name in enumerate(ring.names) if name in state.context.integers
        )
        kept = integers | self._bounded_variables(lowered, relations)
        self.reduction = Reduction(ring, equations, signed if equations and quotients else [], kept)
        self.facts: list[Fact] = []
        self.rows: dict[int, tuple[fmpz_mpoly, Keys, NDArray[np.float64]]] = {}
        self.contradiction: Fact | None = None
        for index, (poly, relation) in enumerate(zip(lowered, relations)):
            if relation != "=" and index not in self.idle:
                self._take(index, poly, relation)
        self.bounded = self._most_common_bounded()

    @staticmethod
    def _bounded_variables(polys: list[fmpz_mpoly], relations: list[str]) -> frozenset[int]:
        """The variables that facts in them alone bound on both sides."""
        sides: set[tuple[int, bool]] = set()
        for poly, relation in zip(polys, relations):
            if relation in (">", ">=") and len(poly) < 3 and poly.total_degree() == 1:
                degrees = [int(d) for d in poly.degrees()]
                if sum(degrees) == 1:
                    sides.add(
                        (
                            degrees.index(1),
                            (constant_of(poly.derivative(degrees.index(1))) or 0) > 0,
                        )
                    )
        return frozenset(v for v, up in sides if up and (v, False) in sides)

    def _take(self, index: int, poly: fmpz_mpoly, relation: str) -> None:
        """Adds the fact as it stands after the eliminations, unless it is there already or is
        trivial.
        """
        counts, rest = self.reduction.reduce(poly)
        own: Factors = ((index, 1),)
        if relation == "!=":
            rest, own, counts = rest * rest, ((index, 2),), tuple(2 * n for n in counts)
        strict, value = relation != ">=", constant_of(rest)
        if value is not None:
            if value < 0 or value == 0 and strict:
                self.contradiction = Fact(rest, strict, own, counts, Fraction(1))
            return
        content = abs(int(rest.content()))
        self.add(
            Fact(rest / content if content > 1 else rest, strict, own, counts, Fraction(content))
        )

    def add(self, fact: Fact) -> None:
        """Adds a fact unless the same polynomial is there already, at least as strict."""
        for place, known in enumerate(self.facts):
            if known.poly == fact.poly:
                if fact.strict and not known.strict:
                    self.facts[place] = fact
                return
        self.facts.append(fact)

    def signs(self) -> ShownSigns:
        """The signs that the facts show at sight."""
        return ShownSigns(self.facts, self.bounded)

    def polys(self) -> list[fmpz_mpoly]:
        """The polynomials of the equations left and of the facts."""
        return [equation.poly for equation in self.reduction.left] + [
            fact.poly for fact in self.facts
        ]

    def content(self) -> Hashable:
        """What a search for a combination depends on."""
        facts = tuple((str(fact.poly), fact.strict) for fact in self.facts)
        equations = tuple(str(equation.poly) for equation in self.reduction.left)
        before = (
            tuple(str(p) for k, p in enumerate(self.source.lowered) if k not in self.idle)
            if self.reduction.steps
            else ()
        )
        return self.ring.names, facts, equations, self.bounded, before

    def row(self, poly: fmpz_mpoly, packing: Packing) -> Row:
        """A polynomial as arrays; its exponents are read once."""
        known = self.rows.get(id(poly))
        if known is None:
            known = self.rows[id(poly)] = (
                poly,
                np.array(poly.monoms(), dtype=np.int64),
                np.array(list(map(int, poly.coeffs())), dtype=np.float64),
            )
        return known[1] @ packing.weights, known[2]

    def goal_facts(self) -> list[int] | None:
        """The facts in the variables of the last one alone; None where that is all of them, or few
        are.
        """
        if len(self.facts) < limits.FACTS_IN_TURN:
            return None
        own = [bool(d) for d in self.facts[-1].poly.degrees()]
        found = [
            k
            for k, fact in enumerate(self.facts)
            if all(mine or not d for mine, d in zip(own, fact.poly.degrees()))
        ]
        return found if len(found) < len(self.facts) else None

    # -------------------------------------------------------- bounded variables

    def _most_common_bounded(self) -> BoundedVariable | None:
        """The variable bounded on both sides that occurs in most facts."""
        low, high = sides_of(self.facts)
        occurs = [
            sum(map(bool, degrees)) for degrees in zip(*(fact.degrees for fact in self.facts))
        ]
        both = [v for v in low if v in high]
        best = max(both, key=lambda v: (occurs[v], -v), default=None)
        return None if best is None else BoundedVariable(best, low[best], high[best])

    def implied_by_bounds(self, index: int, bounded: BoundedVariable) -> bool:
        """Whether a fact is one of the bounds, or in the bounded variable alone and implied by
        them.
        """
        if index in (bounded.low, bounded.high):
            return True
        poly, v = self.facts[index].poly, bounded.variable
        if used_in(poly) != (v,):
            return False
        ends = (self.facts[k].end(v) for k in (bounded.low, bounded.high))
        return tree_above_zero(map(fraction, univariate(poly, v).coeffs()), *ends) is not None

    # -------------------------------------------------------- candidates and divided facts

    def candidates(self, kind: str, most: int = limits.MOST_PER_KIND) -> list[fmpz_mpoly]:
        """Polynomials worth squaring: read off the facts before and after the eliminations, and
        reduced.
        """
        parameter = self.bounded.variable if self.bounded else -1
        find = {"squares": squares, "resultants": resultants}[kind]
        pool = Pool()
        if self.reduction.steps:
            before = [
                p
                for k, p in enumerate(self.source.lowered)
                if p and not p.is_constant() and k not in self.idle
            ]
            for poly in find(self.ring, before, parameter, most):
                pool.add(self.reduction.reduce(poly)[1])
        for poly in find(self.ring, self.polys(), parameter, most):
            pool.add(poly)
        return pool.polys

    def unsigned_factors(self) -> list[fmpz_mpoly]:
        """The irreducible factors of equations left, and those of facts that have no sign at sight,
        smallest first.
        """
        signs, pool = self.signs(), Pool()
        for equation in self.reduction.left:
            found = self.ring.factors(equation.poly)
            for factor, _ in found if len(found) > 1 else ():
                pool.add(factor)
        count = len(pool.polys)
        for fact in self.facts:
            if total_degree(fact.poly) > 1:
                for factor, _ in self.ring.factors(fact.poly):
                    if factor != fact.poly and factor != -fact.poly and not signs.of(factor)[0]:
                        pool.add(factor)
        return sorted(pool.polys[:count], key=size) + sorted(pool.polys[count:], key=size)

    def variables_and_differences(self) -> list[fmpz_mpoly]:
        """Variables of no known sign, and differences of two variables of one weight, but for the
        bounded variable.
        """
        used = [v for v in range(self.ring.size) if any(poly.degrees()[v] for poly in self.polys())]
        used = [v for v in used if self.bounded is None or v != self.bounded.variable]
        signs, alike, gens = self.signs(), self.source.scaling.alike, self.ring.gens
        alone = [gens[v] for v in used if not signs.of(gens[v])[0]]
        return alone + [gens[v] - gens[w] for v, w in combinations(used, 2) if alike(v, w)]

    def homogeneous_text(self, poly: fmpz_mpoly) -> str:
        """The text of a polynomial of the problem as one of the state, homogeneous with scales."""
        scaling = self.source.scaling
        return str(scaling.lift(poly, scaling.largest(poly)) if scaling.scales else poly)

    def divide(self) -> bool:
        """Replaces facts that have a positive factor by what is left without it; whether there were
        any.
        """
        signs = self.signs()
        changed = []
        for place, fact in enumerate(self.facts):
            if total_degree(fact.poly) < 2 or fact.multiplier is not None:
                continue
            multiplier: Sum = [(Fraction(1), ())]
            rest, positive = fact.poly, 1
            for factor, exponent in self.ring.factors(fact.poly):
                sign, found = signs.of(factor)
                for _ in range(exponent if found else 0):
                    rest, positive, multiplier = (
                        rest / factor,
                        positive * sign,
                        times(multiplier, found),
                    )
            if (
                len(multiplier) == 1
                and multiplier[0][1] == ()
                or rest.is_constant()
                and positive * int(rest.leading_coefficient()) > 0
            ):
                continue
            rest = rest * positive
            content = abs(int(rest.content()))
            scale = fact.scale * content
            changed.append(
                (
                    place,
                    Fact(rest / content, fact.strict, fact.factors, fact.counts, scale, multiplier),
                )
            )
        for place, fact in changed:
            self.facts[place] = fact
        self.bounded = self._most_common_bounded()
        return bool(changed)


def size(poly: fmpz_mpoly) -> tuple[int, int]:
    """Small polynomials first."""
    return total_degree(poly), len(poly)


def idle_facts(polys: Sequence[fmpz_mpoly], relations: Sequence[str]) -> set[int]:
    """The facts that only define a root, where the root occurs nowhere else: root >= 0 and
    root^2 = term.
    """
    idle: set[int] = set()
    while True:
        degrees = {
            k: [int(d) for d in p.degrees()] for k, p in enumerate(polys) if p and k not in idle
        }
        found: set[int] = set()
        for k, own in degrees.items():
            for variable, degree in enumerate(own):
                if relations[k] == "=" and degree == 2 and not found:
                    others = [i for i, d in degrees.items() if d[variable] and i != k]
                    if others and all(
                        sum(degrees[i]) == 1
                        and relations[i] == ">="
                        and polys[i].leading_coefficient() > 0
                        for i in others
                    ):
                        found = {k, *others}
        if not found:
            return idle
        idle |= found


def high_facts(polys: Sequence[fmpz_mpoly]) -> set[int]:
    """The facts of one variable whose degree is high, and twice that of all facts of several: their
    products with these would be most of a program, and few proofs need one.

    >>> a, x = Ring(("a", "x")).gens
    >>> high_facts([a**20 - 2, a**3 - 1, x - a**9]), high_facts([a**20 - 2, x - a**10])
    ({0}, set())
    """
    high = {
        k: p
        for k, p in enumerate(polys)
        if total_degree(p) > limits.HIGH_DEGREE and len(used_in(p)) == 1
    }
    if not high:  # as for nearly all states
        return set()
    most = max((total_degree(p) for p in polys if len(used_in(p)) > 1), default=0)
    return {k for k, p in high.items() if total_degree(p) > 2 * most}


# -------------------------------------------------------------------------------------------------
# Whether a problem seems to have a point: floating samples that are moved uphill, so that hopeless
# proofs are not tried.
#
# A point found here proves nothing; it only ends the search for a proof that cannot exist.

Array = NDArray[np.float64]


class FactValues:
    """The facts of a problem as arrays, ready to be evaluated at many points."""

    def __init__(self, problem: LeafProblem) -> None:
        self.used = sorted(
            {v for fact in problem.facts for v, d in enumerate(fact.poly.degrees()) if d}
        )
        place = {v: k for k, v in enumerate(self.used)}
        monomials: dict[tuple[int, ...], int] = {}
        entries: list[tuple[int, int, float]] = []
        for row, fact in enumerate(problem.facts):
            coefficients = [int(coefficient) for coefficient in fact.poly.coeffs()]
            longer = max(0, max(map(int.bit_length, coefficients), default=0) - limits.FLOAT_BITS)
            for monomial, coefficient in zip(fact.poly.monoms(), coefficients):
                column = monomials.setdefault(
                    tuple(int(monomial[v]) for v in self.used), len(monomials)
                )
                entries.append((row, column, float(coefficient >> longer)))
        self.powers = np.array(list(monomials), dtype=np.int64).reshape(
            len(monomials), len(self.used)
        )
        self.matrix = np.zeros((len(problem.facts), len(monomials)))
        for row, column, value in entries:
            self.matrix[row, column] += value
        self.top = int(self.powers.max(initial=0))
        self.range = None
        if problem.bounded is not None and problem.bounded.variable in place:
            bounded = problem.bounded
            low, high = (
                float(problem.facts[k].end(bounded.variable)) for k in (bounded.low, bounded.high)
            )
            self.range = place[bounded.variable], low, high

    def least(self, points: Array) -> Array:
        """At every point the least of the facts, each divided by the sum of the absolute values of
        its terms; of points (p, n), for the n variables in use, p values.
        """
        table = np.ones((self.top + 1, *points.shape))
        for k in range(1, self.top + 1):
            table[k] = table[k - 1] * points
        terms = np.ones((len(points), len(self.powers)))
        for v in range(len(self.used)):
            terms *= table[self.powers[:, v], :, v].T
        sums, sizes = terms @ self.matrix.T, np.abs(terms) @ np.abs(self.matrix).T
        result: Array = (sums / np.maximum(sizes, 1e-300)).min(axis=1)
        return result


def has_interior_point(problem: LeafProblem, budget: Budget) -> bool:
    """Whether a floating point was found at which every fact is positive by a margin; never where
    an equation is left.
    """
    if problem.reduction.left or not problem.facts or len(problem.facts) > 40:
        return False
    values = FactValues(problem)
    budget.spend(200 + limits.POINTS * limits.POINT_ROUNDS * len(values.powers) // 20)
    random = np.random.default_rng(11)
    shape = limits.POINTS, len(values.used)
    points = random.normal(size=shape) * np.exp(random.normal(size=shape))
    if values.range is not None:
        column, low, high = values.range
        points[:, column] = low + (high - low) * random.random(limits.POINTS)
    width = 0.5
    for _ in range(limits.POINT_ROUNDS):
        score = values.least(points)
        best = np.argsort(-score, kind="stable")[: limits.POINTS_KEPT]
        if score[best[0]] > limits.POINT_MARGIN:
            return True
        parents = np.repeat(points[best], limits.POINTS // limits.POINTS_KEPT, axis=0)
        moves = random.normal(size=parents.shape) * (random.random(parents.shape) < 0.5) * width
        points = parents * (1 + moves) + moves * random.random((len(parents), 1)) * 0.3
        points[: limits.POINTS_KEPT] = parents[:: limits.POINTS // limits.POINTS_KEPT]
        width *= 0.6
    return False
