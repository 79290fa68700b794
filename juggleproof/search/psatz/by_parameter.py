"""One leaf: facts that are linear in all variables but one, a parameter between two bounds.

Where such facts f_0 .. f_m contradict one another, a sum of multiples l_i f_i with l_i > 0 has no
variable but the parameter, and is < 0 between the bounds.  The l_i are the minors of the matrix of
the coefficients, up to a common factor, which is left out; as polynomials in the parameter they and
the sum have Bernstein forms with coefficients >= 0.

Source: Motzkin's transposition theorem, and Cramer's rule.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, islice
from math import prod

import numpy as np
from flint import fmpq, fmpq_poly, fmpz_mpoly

from juggleproof.algebra.numbers import determinant, exact, fraction
from juggleproof.search import limits
from juggleproof.search.psatz.facts import BoundedVariable, Factors, merge
from juggleproof.search.psatz.lifting import lift
from juggleproof.search.psatz.parameters import bounds
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.statements.nodes import Node
from juggleproof.statements.work import Budget

Coefficients = Sequence[fmpq_poly]  # of a fact: of each variable but the parameter, then of 1


@dataclass(frozen=True)
class BoundProduct:
    """A number > 0 times powers of bounds, times the square of a power of the parameter."""

    number: Fraction
    factors: Factors
    power: int


def search_by_parameter(problem: LeafProblem, budget: Budget) -> Node | None:
    """The node of such a contradiction; None where the facts are not of this kind, or no few of
    them contradict one another in this way.

    Raises Exhausted where the budget ends.
    """
    axes = [axis for axis in bounds(problem).values() if isinstance(axis, BoundedVariable)]
    if problem.reduction.left or len(axes) != 1:
        return None
    (between,) = axes
    rows = linear_rows(problem, between.variable)
    if rows is None:
        return None
    used, roots = contradiction(problem, between, rows, budget) or ([], [])
    return lift(problem, used, [], roots) if used else None


def linear_rows(problem: LeafProblem, parameter: int) -> dict[int, Coefficients] | None:
    """The coefficients of the facts in which other variables occur, by their numbers; None where
    one is not linear in them, or there are many.
    """
    polys = problem.polys()
    others = [
        v
        for v in range(len(problem.ring.names))
        if v != parameter and any(poly.degrees()[v] for poly in polys)
    ]
    if not 0 < len(others) <= limits.MOST_OTHERS:
        return None
    rows: dict[int, Coefficients] = {}
    for k, fact in enumerate(problem.facts):
        row = row_of(fact.poly, others, parameter)
        if row is None:
            return None
        if any(row[:-1]):
            rows[k] = row
    return rows


def row_of(poly: fmpz_mpoly, others: Sequence[int], parameter: int) -> Coefficients | None:
    """The coefficients of a polynomial that is linear in the others; None for any other."""
    found = [dict[int, int]() for _ in range(len(others) + 1)]
    for monomial, c in zip(poly.monoms(), poly.coeffs()):
        own = [place for place, v in enumerate(others) if monomial[v]]
        if len(own) > 1 or any(monomial[others[place]] > 1 for place in own):
            return None
        found[own[0] if own else -1][int(monomial[parameter])] = int(c)
    return [
        fmpq_poly([by_power.get(k, 0) for k in range(max(by_power, default=0) + 1)])
        for by_power in found
    ]


Used = list[tuple[tuple[Factors, int], Fraction]]


def contradiction(
    problem: LeafProblem, between: BoundedVariable, rows: dict[int, Coefficients], budget: Budget
) -> tuple[Used, list[fmpz_mpoly]] | None:
    """A sum of products that vanishes, by as few facts as there are."""
    low, high = (problem.facts[k].end(between.variable) for k in (between.low, between.high))
    inside = [exact(low + (high - low) * part) for part in limits.MINORS_AT]
    left = limits.MOST_SETS
    sets: list[tuple[tuple[int, ...], bool]] = []
    for size in range(2, len(next(iter(rows.values()), ())) + 1):
        some = [*islice(combinations(rows, size), left)]
        left -= len(some)
        sets += zip(some, seen_to_contradict(rows, some, inside) if some else ())
    for chosen, seen in sets:
        budget.spend(1)
        if not seen:
            continue
        multiples = multiples_of([rows[k] for k in chosen], inside)
        if multiples is None:
            continue
        total = sum((m * rows[k][-1] for m, k in zip(multiples, chosen)), fmpq_poly([]))
        if any(total(at) > 0 for at in inside):
            continue
        budget.spend(limits.FORM_WORK)
        parts = identity(problem, between, [*zip(multiples, chosen)], total)
        if parts is not None:
            powers = sorted({part.power for _, part in parts if part.power})
            used = [
                (
                    (merge(own, part.factors), powers.index(part.power) if part.power else -1),
                    part.number,
                )
                for own, part in parts
            ]
            return used, [problem.ring.ctx.gen(between.variable) ** power for power in powers]
    return None


def seen_to_contradict(
    rows: dict[int, Coefficients], sets: Sequence[tuple[int, ...]], inside: Sequence[fmpq]
) -> list[bool]:
    """For each of these sets of as many facts, whether floats see multiples that are positive, with
    a sum that is a number and not positive, at the middle of the parameter: exact minors take long.
    """
    middle = inside[len(inside) // 2]
    values = np.array([[float(fraction(one(middle))) for one in row] for row in rows.values()])
    values /= np.abs(values).max(axis=1, keepdims=True)
    place = {fact: k for k, fact in enumerate(rows)}
    matrices = values[np.array([[place[fact] for fact in chosen] for chosen in sets])]
    count, size, width = matrices.shape
    seen = np.zeros(count, dtype=bool)
    for columns in combinations(range(width - 1), size - 1):
        part = matrices[:, :, columns]
        others = [[j for j in range(size) if j != k] for k in range(size)]
        minors = np.stack([np.linalg.det(part[:, rest]) for rest in others], axis=1)
        minors *= (-1.0) ** np.arange(size)
        sums = np.einsum("ck,ckv->cv", minors, matrices)
        alone = (np.abs(sums[:, :-1]) < limits.MINOR_ROUNDING).all(axis=1)
        for sign in (1, -1):
            positive = (sign * minors > limits.MINOR).all(axis=1)
            seen |= positive & alone & (sign * sums[:, -1] < limits.MINOR_ROUNDING)
    return [bool(one) for one in seen]


def multiples_of(rows: Sequence[Coefficients], inside: Sequence[fmpq]) -> list[fmpq_poly] | None:
    """Polynomials, > 0 at these places, whose sum of products with the rows has no variable but
    the parameter; None where there are none, or not one such line of them.
    """
    variables = range(len(rows[0]) - 1)
    for columns in combinations(variables, len(rows) - 1):
        found = []
        for k in range(len(rows)):
            others = [[row[v] for v in columns] for j, row in enumerate(rows) if j != k]
            found.append(determinant(others, fmpq_poly([1])) * (-1) ** k)
        if not any(found):
            continue
        if not all(found):
            return None
        signs = {(one(at) > 0) - (one(at) < 0) for one in found for at in inside}
        if len(signs) > 1 or 0 in signs:
            return None
        if any(sum((m * row[v] for m, row in zip(found, rows)), fmpq_poly([])) for v in variables):
            return None
        common = found[0]
        for one in found[1:]:
            common = common.gcd(one)
        # primitive, of one sign: the common factor may have changed it
        found = [one // common for one in found]
        scale = prod((one.denom() for one in found), start=1)
        if found[0](inside[0]) < 0:
            scale = -scale
        return [one * scale for one in found]
    return None


def identity(
    problem: LeafProblem,
    between: BoundedVariable,
    multiples: Sequence[tuple[fmpq_poly, int]],
    total: fmpq_poly,
) -> list[tuple[Factors, BoundProduct]] | None:
    """The terms of the sum of these multiples of facts, and of what has to be added to it for 0;
    None where one of the polynomials has no form as a sum of such terms.
    """
    for least in (True, False):  # squares of powers of the parameter are not known to be > 0
        terms: list[tuple[Factors, BoundProduct]] = []
        for poly, fact in [*multiples, (-total, None)]:
            apart = least or fact is not None
            parts = [*nonnegative(problem, between, poly, apart)] if poly else []
            if poly and not parts:
                return None
            terms += [(() if fact is None else ((fact, 1),), part) for part in parts]
        for own, part in terms:
            factors = merge(own, part.factors)
            if not part.power and all(problem.facts[k].strict for k, _ in factors):
                return terms
    return None


def nonnegative(
    problem: LeafProblem, between: BoundedVariable, poly: fmpq_poly, apart: bool
) -> Iterator[BoundProduct]:
    """A polynomial in the parameter as a sum of parts: an even power of it `apart`, in Bernstein's
    form; no parts where none of the degrees tried has one without negative numbers.
    """
    coefficients = poly.coeffs()
    power = next(k for k, c in enumerate(coefficients) if c) // 2 if apart else 0
    rest = fmpq_poly(coefficients[2 * power :])
    for degree in range(rest.degree(), rest.degree() + limits.HIGHER):
        values = between.coefficients(problem.facts, rest, degree)
        if min(values) >= 0:
            for k, value in enumerate(values):
                if value:
                    yield BoundProduct(value, between.factors(k, degree), power)
            return
