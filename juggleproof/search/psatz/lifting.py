"""Identities of a reduced problem turned into identities between the facts of the state, as the
checker reads them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm, prod

from flint import fmpz_mpoly

from juggleproof.algebra.polynomials import degree_in, pseudo_divide, total_degree
from juggleproof.search import limits
from juggleproof.search.psatz.facts import (
    Fact,
    Factors,
    Reduction,
    Sum,
    merge,
    power,
    times,
)
from juggleproof.search.psatz.problem import LeafProblem, Source
from juggleproof.statements.nodes import Cofactor, Node, Product, Psatz

MonomialCofactor = tuple[int, tuple[int, ...]]  # an equation left, and the exponents of a monomial


def powers_of(chosen: tuple[int, ...]) -> Factors:
    """A product of facts, each with its exponent."""
    return tuple((k, chosen.count(k)) for k in sorted(set(chosen)))


@dataclass
class LiftedTerm:
    """coefficient * product of facts * root^2, in the numbers and polynomials of the state with its
    scales set to 1.
    """

    coefficient: Fraction
    factors: Factors
    root: fmpz_mpoly


def lift(
    problem: LeafProblem,
    used: list[tuple[tuple[Factors, int], Fraction]],
    cofactors: list[tuple[MonomialCofactor, Fraction]],
    roots: list[fmpz_mpoly],
) -> Node | None:
    """The node of an identity between the problem's facts and the equations left."""
    ring, facts = problem.ring, problem.facts
    divided: dict[int, int] = {}  # facts with a multiplier -> the largest exponent in use
    for (factors, _), _ in used:
        for k, e in factors:
            if facts[k].multiplier is not None:
                divided[k] = max(divided.get(k, 0), e)
    terms: list[LiftedTerm] = []
    for (factors, root), c in used:
        have = dict(factors)
        whole: Sum = [(c, factors)]
        for k, most in divided.items():
            for _ in range(most - have.get(k, 0)):
                whole = times(whole, facts[k].multiplier or [])
        for value, product in whole:
            terms.append(term(problem, value, product, roots[root] if root >= 0 else ring.one))
    common = lcm(
        1, *(c.denominator for _, c in cofactors), *(t.coefficient.denominator for t in terms)
    )
    extra = ring.one  # what the terms have been multiplied by
    scale = Fraction(common)
    for k, most in divided.items():
        poly, unit = sum_of(problem, facts[k].multiplier or [])
        extra, scale = extra * poly**most, scale * unit**most
    terms = [
        LiftedTerm(t.coefficient * common * scale.denominator, t.factors, t.root) for t in terms
    ]
    scale *= scale.denominator
    owed: dict[int, fmpz_mpoly] = {}
    used_equations = sorted({place for (place, _), _ in cofactors})
    left = [problem.reduction.left[place] for place in used_equations]
    multiples = [with_sign(problem.source, one.multiple, one.factors) for one in left]
    for at, (place, equation) in enumerate(zip(used_equations, left)):
        own = [(monomial, c) for (where, monomial), c in cofactors if where == place]
        # every term is multiplied by all multiples: an equation's own multiple is part of its
        # combination
        others = (multiple for other, (multiple, _, _) in enumerate(multiples) if other != at)
        cofactor = extra * prod(others, start=ring.one) * multiples[at][2]
        whole_cofactor = ring.zero
        clear = lcm(1, *(Fraction(c * scale).denominator for _, c in own))
        if clear != 1:
            return None
        for monomial, c in own:
            whole_cofactor = whole_cofactor + ring.ctx.from_dict({monomial: int(c * scale)})
        for k, part in equation.combination.items():
            owed[k] = owed.get(k, ring.zero) + part * whole_cofactor * cofactor
    shared = merge(*(factors for _, factors, _ in multiples))
    terms = [LiftedTerm(t.coefficient, merge(t.factors, shared), t.root) for t in terms]
    return finish(problem.source, problem.reduction, terms, owed)


def term(
    problem: LeafProblem, coefficient: Fraction, product: Factors, root: fmpz_mpoly
) -> LiftedTerm:
    """A product of the problem's facts in terms of the state's facts."""
    factors: Factors = ()
    for k, e in product:
        fact: Fact = problem.facts[k]
        factors, coefficient = merge(factors, power(fact.factors, e)), coefficient / fact.scale**e
        for step, n in zip(problem.reduction.steps, fact.counts):
            factors, coefficient = (
                merge(factors, power(step.lead_factors, n * e)),
                coefficient * step.lead_scale ** (n * e),
            )
    return LiftedTerm(coefficient, factors, root)


def sum_of(problem: LeafProblem, total: Sum) -> tuple[fmpz_mpoly, Fraction]:
    """(p, c) with c * p the value of a sum over the problem's facts."""
    common = lcm(*(c.denominator for c, _ in total))
    poly = problem.ring.zero
    for c, factors in total:
        poly = poly + prod(
            (problem.facts[k].poly ** e for k, e in factors), start=problem.ring.one
        ) * int(c * common)
    return poly, Fraction(1, common)


def with_sign(
    source: Source, multiple: fmpz_mpoly, factors: Factors
) -> tuple[fmpz_mpoly, Factors, fmpz_mpoly]:
    """A product of facts, and these, and what it is times the product given: squared where a fact
    in it has no known sign.
    """
    if any(source.relations[k] == "!=" for k, _ in factors):
        return multiple * multiple, power(factors, 2), multiple
    return multiple, factors, source.ring.one


def finish(
    source: Source,
    reduction: Reduction,
    terms: Sequence[LiftedTerm],
    cofactors: dict[int, fmpz_mpoly],
) -> Psatz | None:
    """The node ("psatz", products, equations) for an identity that holds modulo the reduction's
    equations; None if it does not lift.

    `cofactors` belong to the state's own equations; what the eliminated equations owe is found by
    division.
    """
    ring, lowered = source.ring, source.lowered
    common = lcm(1, *(t.coefficient.denominator for t in terms))
    terms = [LiftedTerm(t.coefficient * common, t.factors, t.root) for t in terms]
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
            terms = [
                LiftedTerm(t.coefficient * step.lead_scale**count, t.factors, t.root) for t in terms
            ]
            owed = {k: c * step.lead**count for k, c in owed.items()}
        multiple, factors, more = with_sign(source, step.multiple, step.multiple_factors)
        owed = {k: c * multiple for k, c in owed.items()}
        for k, c in step.combination.items():
            owed[k] = owed.get(k, ring.zero) - quotient * more * c
        extra = merge(extra, factors)
        total = rest * multiple
    for _ in range(limits.SIMPLIFICATIONS if total else 0):
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
            scale *= content
            multiple, factors, more = with_sign(source, equation.multiple, equation.factors)
            terms = [LiftedTerm(t.coefficient * scale, t.factors, t.root) for t in terms]
            owed = {k: c * multiple * scale for k, c in owed.items()}
            for k, c in equation.combination.items():
                owed[k] = owed.get(k, ring.zero) - quotient * more * c
            extra, total = merge(extra, factors), rest * multiple * content
        if not total:
            break
    if total:
        return None
    terms = [LiftedTerm(t.coefficient, merge(t.factors, extra), t.root) for t in terms]
    owed = {k: c for k, c in owed.items() if c}
    return written(source, *without_common_facts(source, terms, owed))


def without_common_facts(
    source: Source, terms: Sequence[LiftedTerm], owed: dict[int, fmpz_mpoly]
) -> tuple[Sequence[LiftedTerm], dict[int, fmpz_mpoly]]:
    """The identity divided by the facts that all its terms have in common, as often as they divide
    the cofactors.
    """
    for k, _ in terms[0].factors if terms else ():
        if source.relations[k] == "!=":
            continue  # even powers only have a sign
        for _ in range(min(dict(t.factors).get(k, 0) for t in terms)):
            parts = {at: divmod(cofactor, source.lowered[k]) for at, cofactor in owed.items()}
            if any(rest for _, rest in parts.values()):
                break
            owed = {at: quotient for at, (quotient, _) in parts.items()}
            terms = [LiftedTerm(t.coefficient, lessened(t.factors, k), t.root) for t in terms]
    return terms, owed


def lessened(factors: Factors, fact: int) -> Factors:
    """A product of facts divided by one of them.

    >>> lessened(((0, 2), (3, 1)), 3)
    ((0, 2),)
    """
    return tuple((k, e - (k == fact)) for k, e in factors if k != fact or e > 1)


def written(source: Source, terms: Sequence[LiftedTerm], owed: dict[int, fmpz_mpoly]) -> Psatz:
    """The node of an identity between lowered facts, every term brought to one weight by powers of
    the scales.
    """
    scaling = source.scaling
    content = shortest_divisor([int(t.coefficient) for t in terms], list(owed.values()))
    weights = [scaling.largest(poly) for poly in source.polys] if scaling.scales else []
    parts: list[tuple[Fraction, Factors, fmpz_mpoly, tuple[int, ...]]] = []
    for t in terms:
        root, weight = t.root, (0,) * len(scaling.scales)
        if scaling.scales:
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
        if scaling.scales
        else []
    )
    target = tuple(map(max, zip(*wanted)))
    products: list[Product] = []
    for coefficient, powers, root, weight in parts:
        for place, have, want in zip(scaling.scales, weight, target):
            fact, leading = source.scale_facts[place]
            if want > have:
                coefficient *= Fraction(source.dens[fact], leading) ** (want - have)
                powers = merge(powers, ((fact, want - have),))
        products.append((str(coefficient), powers, str(root)))
    equations: list[Cofactor] = []
    for k, c in sorted(owed.items()):
        if scaling.scales:
            c = scaling.lift(c, tuple(want - have for want, have in zip(target, weights[k])))
        factor = Fraction(source.dens[k], content)
        equations.append((k, scaled_text(c, factor)))
    return "psatz", products, equations


def shortest_divisor(weights: Sequence[int], cofactors: Sequence[fmpz_mpoly]) -> int:
    """By what an identity in whole numbers is divided, so that it has the fewest digits: what all
    have in common; or where that leaves long numbers, which come of fractions with many
    denominators, one of them, which leaves such fractions.

    >>> shortest_divisor([4, 6], [])
    2
    """
    shared = gcd(*weights, *(int(c.content()) for c in cofactors))
    if max(weights, default=0).bit_length() - shared.bit_length() < limits.LONG_NUMBER:
        return shared
    every = [*weights, *(int(c) for poly in cofactors for c in poly.coeffs())]

    def digits(divisor: int) -> int:
        parts = [gcd(number, divisor).bit_length() for number in every]
        long = divisor.bit_length()
        return sum(number.bit_length() + long - 2 * part for number, part in zip(every, parts))

    return min(shared, *set(weights), key=lambda one: (digits(one), one))


def scaled_text(poly: fmpz_mpoly, factor: Fraction) -> str:
    """The text of a polynomial times a rational."""
    poly = poly * factor.numerator
    den = factor.denominator
    shared = gcd(den, int(poly.content())) if poly else 1
    poly, den = poly / shared, den // shared
    return str(poly) if den == 1 else f"1/{den}*({poly})"
