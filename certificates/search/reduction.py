"""Equations used up: variables that an equation gives are eliminated, and identities in what is
left are lifted back.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod

from flint import fmpz_mpoly

from .polynomials import Ring, constant_of, degree_in, pseudo_divide

Factors = tuple[tuple[int, int], ...]  # (number of a fact, exponent)
Combination = dict[int, fmpz_mpoly]  # number of an equation -> cofactor


@dataclass
class Step:
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


class Reduction:
    """The eliminations of a state in order, and the equations that are left."""

    def __init__(
        self,
        ring: Ring,
        equations: Sequence[tuple[int, fmpz_mpoly]],
        signed: Sequence[Signed],
        kept: frozenset[int] = frozenset(),
    ) -> None:
        self.ring, self.signed, self.kept, self.steps = ring, signed, kept, list[Step]()
        self.left = [Equation(poly, {index: ring.one}, ring.one, ()) for index, poly in equations]
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
        step = Step(
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

    def _reduced(self, equation: Equation, step: Step) -> Equation:
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
        """Drops equations that say nothing and notes one that is false."""
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
