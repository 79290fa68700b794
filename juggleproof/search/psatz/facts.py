"""Facts of a state: scales, equations used up, signs at sight."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from math import prod
from operator import le, mul

from flint import fmpq_poly, fmpz_mat, fmpz_mpoly

from juggleproof.algebra.numbers import by_ends, univariate
from juggleproof.algebra.polynomials import (
    Gradings,
    Ring,
    constant_of,
    degree_in,
    pseudo_divide,
    total_degree,
)

# -------------------------------------------------------------------------------------------------
# Equations used up: variables that an equation gives are eliminated, and identities in what is
# left are lifted back.

Factors = tuple[tuple[int, int], ...]  # (number of a fact, exponent)
Combination = dict[int, fmpz_mpoly]  # number of an equation -> cofactor


@dataclass
class EliminationStep:
    """One eliminated variable: multiple * (lead * variable - rest) = sum of combination, where lead
    and multiple are products of facts.
    """

    variable: int
    lead: fmpz_mpoly
    rest: fmpz_mpoly
    form: fmpz_mpoly
    combination: Combination
    lead_factors: Factors
    lead_scale: Fraction  # lead / product of its factors
    multiple: fmpz_mpoly
    multiple_factors: Factors


@dataclass
class Signed:
    """A fact as the search uses it: nonzero for certain, and positive unless `sign` is 0."""

    index: int
    poly: fmpz_mpoly
    positive: bool


@dataclass
class Equation:
    """multiple * poly = sum of combination, where multiple is a product of facts that are not
    zero.
    """

    poly: fmpz_mpoly
    combination: Combination
    multiple: fmpz_mpoly
    factors: Factors


def merge(*parts: Factors) -> Factors:
    """The product of powers of facts."""
    total: dict[int, int] = {}
    for part in parts:
        for index, exponent in part:
            total[index] = total.get(index, 0) + exponent
    return tuple(sorted(total.items()))


def power(factors: Factors, exponent: int) -> Factors:
    """A power of a product of facts."""
    return tuple((index, e * exponent) for index, e in factors) if exponent else ()


def implies(equation: fmpz_mpoly, other: fmpz_mpoly) -> bool:
    """Whether the other one is a multiple of higher degree."""
    return (
        total_degree(equation) < total_degree(other)
        and all(map(le, equation.degrees(), other.degrees()))
        and not divmod(other, equation)[1]
    )


class Reduction:
    """The eliminations of a state in order, and the equations that are left."""

    def __init__(
        self,
        ring: Ring,
        equations: Sequence[tuple[int, fmpz_mpoly]],
        signed: Sequence[Signed],
        kept: frozenset[int] = frozenset(),
    ) -> None:
        self.ring, self.signed, self.kept, self.steps = ring, signed, kept, list[EliminationStep]()
        self.left = [
            Equation(poly, {index: ring.one}, ring.one, ())
            for index, poly in equations
            if not any(implies(other, poly) for _, other in equations)
        ]
        self.contradiction: Equation | None = None
        while self.left and self._divide_one():
            pass
        while self.contradiction is None and self._eliminate_one():
            pass

    def _eliminate_one(self) -> bool:
        """Eliminates one variable by the cheapest equation; False when no equation gives one."""
        best: tuple[tuple[int, ...], Equation, int, fmpz_mpoly, fmpz_mpoly, Factors] | None = None
        for place, equation in enumerate(self.left):
            for variable, degree in enumerate(equation.poly.degrees()):
                if (
                    degree != 1
                    or variable in self.kept
                    and len(equation.poly) > 2
                    and 2 in equation.poly.degrees()
                ):
                    continue  # a parameter given by a root is better kept than the root
                lead = equation.poly.derivative(variable)
                value = constant_of(lead)
                if best is not None and best[0][0] == 0 and value is None:
                    continue
                found = () if value is not None else self.product(lead)
                if found is None:
                    continue
                rank = (
                    int(value is None),
                    int(variable in self.kept),
                    len(equation.poly),
                    -variable,
                    place,
                )
                if best is None or rank < best[0]:
                    rest = lead * self.ring.gens[variable] - equation.poly
                    best = (rank, equation, variable, lead, rest, found)
        if best is None:
            return self._divide_one()
        _, equation, variable, lead, rest, factors = best
        self.left.remove(equation)
        combination = equation.combination
        scale = self.ratio(lead, factors)
        if scale < 0:
            lead, rest, scale, combination = (
                -lead,
                -rest,
                -scale,
                {k: -c for k, c in combination.items()},
            )
        form = lead * self.ring.gens[variable] - rest
        step = EliminationStep(
            variable,
            lead,
            rest,
            form,
            combination,
            factors,
            scale,
            equation.multiple,
            equation.factors,
        )
        self.steps.append(step)
        self.left = [self._reduced(other, step) for other in self.left]
        self._tidy()
        return True

    def _reduced(self, equation: Equation, step: EliminationStep) -> Equation:
        count, quotient, rest = pseudo_divide(
            equation.poly, step.variable, self.ring.gens[step.variable], step.lead, step.rest
        )
        if not count:
            return equation
        # lead^n poly = quotient form + rest; times both multiples: a statement about the
        # combinations
        scale = step.lead**count * step.multiple
        combination = {k: c * scale for k, c in equation.combination.items()}
        for k, c in step.combination.items():
            combination[k] = combination.get(k, self.ring.zero) - quotient * equation.multiple * c
        return Equation(
            rest,
            combination,
            equation.multiple * step.multiple,
            merge(equation.factors, step.multiple_factors),
        )

    def _tidy(self) -> None:
        """Drops trivial equations and keeps one that is false."""
        self.left = [equation for equation in self.left if equation.poly]
        for equation in self.left:
            if equation.poly.is_constant():
                self.contradiction = equation

    def _divide_one(self) -> bool:
        """Divides one equation by factors that are not zero; False when there are none."""
        for place, equation in enumerate(self.left):
            if equation.poly.is_constant():
                self.contradiction = equation
                return False
            rest, multiple, factors = equation.poly, equation.multiple, equation.factors
            for fact in self.signed:
                while not fact.poly.is_constant():
                    quotient, remainder = divmod(rest, fact.poly)
                    if remainder or not quotient:
                        break
                    rest, multiple, factors = (
                        quotient,
                        multiple * fact.poly,
                        merge(factors, ((fact.index, 1),)),
                    )
            if len(factors) > len(equation.factors) or factors != equation.factors:
                self.left[place] = Equation(rest, equation.combination, multiple, factors)
                self._tidy()
                return self.contradiction is None
        return False

    def basis(self) -> list[Equation]:
        """Equations left with pairwise coprime leading monomials: a Groebner basis of the ideal
        that they generate.
        """
        chosen: list[Equation] = []
        used: set[int] = set()
        for equation in sorted(self.left, key=lambda e: (len(e.poly), e.poly.total_degree())):
            leading = {v for v, e in enumerate(equation.poly.monoms()[0]) if e}
            if not leading & used:
                chosen.append(equation)
                used |= leading
        return chosen

    def product(self, poly: fmpz_mpoly) -> Factors | None:
        """The facts whose product is the polynomial up to a rational factor, where all are
        positive; None where there are none.
        """
        factors: Factors = ()
        rest = poly
        for fact in self.signed:
            while fact.positive and not fact.poly.is_constant() and not rest.is_constant():
                quotient, remainder = divmod(rest, fact.poly)
                if remainder or not quotient:
                    quotient, remainder = divmod(rest.primitive()[1], fact.poly.primitive()[1])
                    if remainder or not quotient:
                        break
                rest, factors = quotient, merge(factors, ((fact.index, 1),))
        return factors if rest.is_constant() else None

    def ratio(self, poly: fmpz_mpoly, factors: Factors) -> Fraction:
        """The rational by which a polynomial differs from a product of facts."""
        polys = {fact.index: fact.poly for fact in self.signed}
        below = prod(
            int(polys[index].leading_coefficient()) ** exponent for index, exponent in factors
        )
        return Fraction(int(poly.leading_coefficient()), below)

    def reduce(self, poly: fmpz_mpoly) -> tuple[tuple[int, ...], fmpz_mpoly]:
        """(n, r) with prod lead^n * poly = r modulo the equations, the eliminated variables gone
        from r.
        """
        counts = []
        for step in self.steps:
            count = 0
            if degree_in(poly, step.variable):
                count, _, poly = pseudo_divide(
                    poly, step.variable, self.ring.gens[step.variable], step.lead, step.rest
                )
            counts.append(count)
        return tuple(counts), poly


# -------------------------------------------------------------------------------------------------
# Scales: positive variables that a change of physical units makes 1, and identities lifted back by
# powers of them.

Weight = tuple[int, ...]  # one entry for each scale


class Scaling:
    """Gradings under which every polynomial of a state is homogeneous, each with a positive
    variable of weight 1: its scale.

    >>> ring = Ring(("r", "v", "w"))
    >>> r, v, w = ring.gens
    >>> scaling = Scaling(ring, [r**2 - v**2, r * w - v * w], [0])
    >>> scaling.scales, str(scaling.lower(r**2 - v**2)), str(scaling.lift(1 - v, (2,)))
    ((0,), '-v^2 + 1', 'r^2 - r*v')
    """

    def __init__(self, ring: Ring, polys: Sequence[fmpz_mpoly], positive: Sequence[int]) -> None:
        self.ring, self.polys, self.positive = ring, polys, tuple(positive)
        none: Gradings = ((), [], {}, [])
        # weights of every variable, and the values of the scales
        self.scales, self.weights, self.values, _ = self._found if positive else none
        self.of_scale = list(zip(*self.weights))  # the weights of all variables, for every scale

    @cached_property
    def _found(self) -> Gradings:
        """The scales with their weights and values, and the gradings of all polynomials."""
        differences = frozenset[tuple[int, ...]]().union(*map(self._differences, self.polys))
        known, key = self.ring.scalings, (differences, self.positive)
        if key not in known:  # most states of a search have the same scales
            known[key] = self._chosen(self._gradings(differences))
        return known[key]

    def _differences(self, poly: fmpz_mpoly) -> frozenset[tuple[int, ...]]:
        """The first monomial less each of the others."""
        known = self.ring.differences.get(id(poly))
        if known is None:
            first, *others = poly.monoms()
            found = frozenset(tuple(a - b for a, b in zip(first, other)) for other in others)
            known = self.ring.differences[id(poly)] = (
                poly,
                found,
            )  # holding the polynomial keeps its id from being used again
        return known[1]

    def _gradings(self, differences: frozenset[tuple[int, ...]]) -> list[list[int]]:
        """A basis of all gradings under which such polynomials are homogeneous."""
        size = self.ring.size
        if not differences:
            return [[int(i == k) for k in range(size)] for i in range(size)]
        basis, rank = fmpz_mat(sorted(differences)).nullspace()
        return [[int(c) for c in line] for line in zip(*basis.tolist())][:rank]

    def _chosen(self, gradings: list[list[int]]) -> Gradings:
        """As many scales as have a grading each."""
        candidates = [k for k in self.positive if any(row[k] for row in gradings)]
        for count in range(min(len(gradings), len(candidates)), 0, -1):
            for scales in combinations(candidates, count):
                weights = self._weights(scales, gradings)
                if weights is not None:
                    return scales, weights, dict.fromkeys(scales, 1), gradings
        return (), [], {}, gradings

    def _weights(self, scales: tuple[int, ...], gradings: list[list[int]]) -> list[Weight] | None:
        """Integer weights of all variables by which each of these scales has a grading of its own;
        None where there are none.
        """
        size = self.ring.size
        others = [k for k in range(size) if k not in scales]
        for first in others if len(scales) < len(gradings) else others[:1] or [-1]:
            order = [*scales, *(k for k in (first, *(k for k in others if k != first)) if k >= 0)]
            table, den, rank = fmpz_mat([[row[k] for k in order] for row in gradings]).rref()
            lines, den = (
                [[int(c) for c in line] for line in table.tolist()[: len(scales)]],
                int(den),
            )
            if (
                rank >= len(scales)
                and all(c % den == 0 for line in lines for c in line)
                and all(
                    lines[i][j] == (den if i == j else 0)
                    for i in range(len(scales))
                    for j in range(len(scales))
                )
            ):
                place = {variable: k for k, variable in enumerate(order)}
                return [tuple(line[place[k]] // den for line in lines) for k in range(size)]
        return None

    def alike(self, v: int, w: int) -> bool:
        """Whether two variables may be compared: every grading gives them the same weight."""
        return all(row[v] == row[w] for row in self._found[3])

    def lower(self, poly: fmpz_mpoly) -> fmpz_mpoly:
        """The polynomial with every scale set to 1."""
        if not self.scales:
            return poly
        key = id(poly), self.scales
        if key not in self.ring.lowered:
            self.ring.lowered[key] = poly, poly.subs(self.values)
        return self.ring.lowered[key][1]

    def of_monomial(self, monomial: Sequence[int]) -> Weight:
        """The weight of one monomial."""
        return tuple(int(sum(map(mul, monomial, weights))) for weights in self.of_scale)

    def largest(self, poly: fmpz_mpoly) -> Weight:
        """The least weight to which a lowered polynomial can be lifted."""
        monomials = poly.monoms()
        return tuple(
            max((int(sum(map(mul, monomial, weights))) for monomial in monomials), default=0)
            for weights in self.of_scale
        )

    def lift(self, poly: fmpz_mpoly, weight: Weight) -> fmpz_mpoly:
        """The homogeneous polynomial of this weight which lowers to the given one."""
        if not self.scales:
            return poly
        terms = {}
        for monomial, coefficient in zip(poly.monoms(), poly.coeffs()):
            exponents = [int(e) for e in monomial]
            for place, have, want in zip(self.scales, self.of_monomial(monomial), weight):
                exponents[place] += want - have
            terms[tuple(exponents)] = coefficient
        return self.ring.ctx.from_dict(terms)


# -------------------------------------------------------------------------------------------------
# Facts as a search uses them, and polynomials whose sign they show at sight.

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

    @cached_property
    def degrees(self) -> tuple[int, ...]:
        """The degree in each variable."""
        return tuple(map(int, self.poly.degrees()))

    def slope(self, variable: int) -> int:
        """The slope a of a bound a*z + b."""
        return constant_of(self.poly.derivative(variable)) or 1

    def end(self, variable: int) -> Fraction:
        """Where a bound a*z + b vanishes."""
        rest = next(
            (c for monomial, c in zip(self.poly.monoms(), self.poly.coeffs()) if not any(monomial)),
            0,
        )
        return Fraction(-int(rest), self.slope(variable))


@dataclass(frozen=True)
class Axis:
    """A variable with a fact low = a*z + b that bounds it below, a > 0, and a fact high = d - c*z
    that bounds it above; one of them may be missing.
    """

    variable: int
    low: int | None
    high: int | None

    def factors(self, k: int, degree: int) -> Factors:
        """The k-th of the products of powers of the bounds: a basis of the polynomials of at most
        this degree.
        """
        powers = [(self.low, k), (self.high, degree - k if self.low is not None else k)]
        return merge(tuple((fact, e) for fact, e in powers if fact is not None and e))

    def coefficients(self, facts: Sequence[Fact], poly: fmpq_poly, degree: int) -> list[Fraction]:
        """The coefficients of a polynomial in the variable, in this basis."""
        low, high = (
            None
            if k is None
            else (facts[k].end(self.variable), Fraction(abs(facts[k].slope(self.variable))))
            for k in (self.low, self.high)
        )
        return by_ends(poly, degree, low, high)


@dataclass(frozen=True)
class BoundedVariable(Axis):
    """A variable that is bounded on both sides."""

    low: int
    high: int


def sides_of(facts: Sequence[Fact]) -> tuple[dict[int, int], dict[int, int]]:
    """The facts that alone bound variables below, and above: the tightest of each, by its
    variable.
    """
    low: dict[int, int] = {}
    high: dict[int, int] = {}
    for k, fact in enumerate(facts):
        if sum(fact.degrees) == 1:
            variable = fact.degrees.index(1)
            side, above = (low, True) if fact.slope(variable) > 0 else (high, False)
            known = side.setdefault(variable, k)
            if known == k:
                continue
            ends = facts[known].end(variable), fact.end(variable)
            if not facts[known].strict if ends[0] == ends[1] else (ends[1] > ends[0]) == above:
                side[variable] = k
    return low, high


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


class ShownSigns:
    """Polynomials whose sign the facts show at sight, as positive sums of products of facts."""

    def __init__(self, facts: Sequence[Fact], bounded: BoundedVariable | None) -> None:
        self.facts, self.bounded = facts, bounded
        self.at_least_zero: dict[int, int] = {}  # variable -> fact
        for k, fact in enumerate(facts):
            if (
                len(fact.poly) == 1
                and sum(fact.degrees) == 1
                and fact.poly.leading_coefficient() > 0
            ):
                self.at_least_zero[fact.degrees.index(1)] = k

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
        degree, facts, v = int(poly.degrees()[bounded.variable]), self.facts, bounded.variable
        if not degree or degree != sum(map(int, poly.degrees())):
            return []
        if facts[bounded.low].end(v) >= facts[bounded.high].end(v):
            return []
        coefficients = bounded.coefficients(facts, univariate(poly, v), degree)
        found = [(c, bounded.factors(k, degree)) for k, c in enumerate(coefficients) if c]
        strict = any(all(facts[i].strict for i, _ in own) for _, own in found)
        return found if min(coefficients) >= 0 and strict else []
