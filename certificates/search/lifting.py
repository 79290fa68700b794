"""Identities of the reduced problem turned into identities between the facts of the state, as the
checker reads them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm, prod

from flint import fmpz_mpoly

from .polynomials import Ring, degree_in, pseudo_divide, total_degree
from .reduction import Factors, Reduction, merge, power
from .scaling import Scaling

SWEEPS = 8


@dataclass
class Term:
    """coefficient * product of facts * root^2, in the numbers and polynomials of the state with its
    units set to 1.
    """

    coefficient: Fraction
    factors: Factors
    root: fmpz_mpoly


@dataclass
class Source:
    """What the search started from: lowered facts (numerators), their denominators, and which are
    not known to be positive.
    """

    ring: Ring
    scaling: Scaling
    polys: list[fmpz_mpoly]  # numerators of all facts, in the state's own units
    lowered: list[fmpz_mpoly]
    dens: list[int]
    relations: list[str]
    unit_facts: dict[
        int, tuple[int, int]
    ]  # unit variable -> (number of the fact c * variable > 0, c)


def finish(
    source: Source, reduction: Reduction, terms: Sequence[Term], cofactors: dict[int, fmpz_mpoly]
) -> list[object] | None:
    """The node ["psatz", products, equations] for an identity that holds modulo the reduction's
    equations; None if it does not lift.

    `cofactors` belong to the state's own equations; what the eliminated equations owe is found by
    division.
    """
    ring, lowered = source.ring, source.lowered
    common = lcm(1, *(t.coefficient.denominator for t in terms))
    terms = [Term(t.coefficient * common, t.factors, t.root) for t in terms]
    owed = {k: c * common for k, c in cofactors.items()}
    extra: Factors = ()
    total = ring.zero
    for t in terms:
        product = t.root * t.root * int(t.coefficient)
        for index, exponent in t.factors:
            product = product * lowered[index] ** exponent
        total = total + product
    for k, c in owed.items():
        total = total + c * lowered[k]
    for step in reduction.steps:
        if not degree_in(total, step.variable):
            continue
        quotient, rest = divmod(total, step.form)
        if rest:
            count, quotient, rest = pseudo_divide(
                total, step.variable, ring.gens[step.variable], step.lead, step.rest
            )
            if step.lead_factors:
                extra = merge(extra, power(step.lead_factors, count))
            terms = [Term(t.coefficient * step.lead_scale**count, t.factors, t.root) for t in terms]
            owed = {k: c * step.lead**count for k, c in owed.items()}
        multiple, factors = step.multiple, step.multiple_factors
        if any(
            source.relations[index] == "!=" for index, _ in factors
        ):  # an even power, for want of a sign
            quotient, multiple, factors = (
                quotient * multiple,
                multiple * multiple,
                power(factors, 2),
            )
        owed = {k: c * multiple for k, c in owed.items()}
        for k, c in step.combination.items():
            owed[k] = owed.get(k, ring.zero) - quotient * c
        extra = merge(extra, factors)
        total = rest * multiple
    for _ in range(SWEEPS if total else 0):
        for equation in reduction.basis():
            # total * scale = quotient * poly + rest, with a scale that makes every division of
            # coefficients exact
            content = int(equation.poly.content())
            poly = equation.poly / content
            leading = abs(int(poly.leading_coefficient()))
            scale = leading ** (total_degree(total) + 1) if leading != 1 else 1
            quotient, rest = divmod(total * scale, poly)
            if not quotient:
                continue
            multiple, factors, scale = equation.multiple, equation.factors, scale * content
            if any(source.relations[index] == "!=" for index, _ in factors):
                quotient, multiple, factors = (
                    quotient * multiple,
                    multiple * multiple,
                    power(factors, 2),
                )
            terms = [Term(t.coefficient * scale, t.factors, t.root) for t in terms]
            owed = {k: c * multiple * scale for k, c in owed.items()}
            for k, c in equation.combination.items():
                owed[k] = owed.get(k, ring.zero) - quotient * c
            extra, total = merge(extra, factors), rest * multiple * content
        if not total:
            break
    if total:
        return None
    terms = [Term(t.coefficient, merge(t.factors, extra), t.root) for t in terms]
    return written(source, terms, {k: c for k, c in owed.items() if c})


def written(source: Source, terms: Sequence[Term], owed: dict[int, fmpz_mpoly]) -> list[object]:
    """The node of an identity between lowered facts, every term brought to one weight by powers of
    the units.
    """
    scaling, content = source.scaling, 0
    for t in terms:
        content = gcd(content, t.coefficient.numerator)
    for c in owed.values():
        content = gcd(content, int(c.content()))
    weights = [scaling.largest(poly) for poly in source.polys] if scaling.units else []
    parts: list[tuple[Fraction, Factors, fmpz_mpoly, tuple[int, ...]]] = []
    for t in terms:
        root, weight = t.root, (0,) * len(scaling.units)
        if scaling.units:
            own = scaling.largest(root)
            root = scaling.lift(root, own)
            weight = tuple(
                2 * w + sum(e * weights[i][k] for i, e in t.factors) for k, w in enumerate(own)
            )
        dens = prod(source.dens[i] ** e for i, e in t.factors)
        parts.append((t.coefficient / content * dens, t.factors, root, weight))
    wanted = [part[3] for part in parts]
    wanted += (
        [tuple(map(sum, zip(scaling.largest(c), weights[k]))) for k, c in owed.items()]
        if scaling.units
        else []
    )
    target = tuple(map(max, zip(*wanted)))
    products: list[object] = []
    for coefficient, factors, root, weight in parts:
        for unit, have, want in zip(scaling.units, weight, target):
            fact, leading = source.unit_facts[unit]
            if want > have:
                coefficient *= Fraction(source.dens[fact], leading) ** (want - have)
                factors = merge(factors, ((fact, want - have),))
        products.append([str(coefficient), [list(pair) for pair in factors], str(root)])
    equations: list[object] = []
    for k, c in sorted(owed.items()):
        if scaling.units:
            c = scaling.lift(c, tuple(want - have for want, have in zip(target, weights[k])))
        factor = Fraction(source.dens[k], content)
        equations.append([k, scaled_text(c, factor)])
    return ["psatz", products, equations]


def scaled_text(poly: fmpz_mpoly, factor: Fraction) -> str:
    """The text of a polynomial times a rational."""
    poly = poly * factor.numerator
    den = factor.denominator
    shared = gcd(den, int(poly.content())) if poly else 1
    poly, den = poly / shared, den // shared
    return str(poly) if den == 1 else f"1/{den}*({poly})"
