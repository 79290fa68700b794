"""Points that equations alone determine, and points where sets touch: floats are refined by
Newton's steps, and short integer relations tell their algebraic numbers.

Source: Kannan, Lenstra, Lovasz, Polynomial factorization and nonrandomness of bits of algebraic and
some transcendental numbers, Mathematics of Computation 50 (1988).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations

from flint import arb, ctx, fmpq, fmpq_mpoly, fmpq_poly, fmpz_mat
from flint import arb_mat as BallMatrix

from juggleproof.algebra.conditions import Condition, places, valued
from juggleproof.algebra.number_field import at_elements
from juggleproof.algebra.numbers import determinant, exact, real_roots
from juggleproof.search import limits
from juggleproof.search.hints.models import approximate_points
from juggleproof.search.samples import Assignment
from juggleproof.statements.work import Budget


def isolated_points(
    condition: Condition, names: Sequence[str], budget: Budget
) -> Iterator[Assignment]:
    """Points near approximate ones at which equations, and inequalities as equations that seem to
    be attained, hold exactly; the others are left to whoever uses them.
    """
    variables = [name for name in names if name in condition.variables()]
    if not 1 < len(variables) <= limits.ISOLATED_VARIABLES:
        return
    seen: list[dict[str, fmpq_poly]] = []
    for guide in approximate_points(condition, names, budget):
        tight = [
            poly
            for poly, relation in condition.facts()
            if relation == "="
            or relation == ">="
            and abs(valued(poly, guide) or 0) < exact(limits.ATTAINED)
        ]
        for equations in (tight, tight + minors(tight, variables)):
            if len(equations) < len(variables):
                continue
            budget.spend(20_000)
            point = refined(equations, variables, guide)
            found = recognised(equations, variables, point) if point else None
            if found is not None and found.values not in seen:
                seen.append(found.values)
                others = {name: fmpq_poly([1]) for name in names if name not in found.values}
                yield Assignment({**others, **found.values}, found.number)
            if found is not None:
                break


def minors(equations: Sequence[fmpq_mpoly], variables: Sequence[str]) -> list[fmpq_mpoly]:
    """The largest minors of the Jacobian, which vanish where the sets of the equations touch.

    >>> from flint import Ordering, fmpq_mpoly_ctx
    >>> x, y = fmpq_mpoly_ctx.get(["x", "y"], Ordering.lex).gens()
    >>> minors([x**2 + y**2 - 1, 2 * x * y - 1], ["x", "y"])
    [4*x^2 - 4*y^2]
    """
    if not 1 < len(equations) <= len(variables):
        return []
    place = places(equations[0].context())
    slopes = [[poly.derivative(place[name]) for name in variables] for poly in equations]
    return [
        determinant([[row[k] for k in columns] for row in slopes], equations[0] ** 0)
        for columns in combinations(range(len(variables)), len(equations))
    ]


def refined(
    equations: Sequence[fmpq_mpoly], variables: Sequence[str], guide: Mapping[str, fmpq]
) -> list[fmpq] | None:
    """The point to which Newton's steps lead, to many bits; None where they end nowhere."""
    place = places(equations[0].context())
    size, count = len(variables), len(equations)
    slopes = [[poly.derivative(place[name]) for name in variables] for poly in equations]
    point = [guide[name] for name in variables]
    with ctx.workprec(limits.ISOLATED_BITS):
        for _ in range(limits.ISOLATED_STEPS):
            at = dict(zip(variables, point))
            jacobian = BallMatrix(count, size, [arb(valued(p, at)) for row in slopes for p in row])
            missed = BallMatrix(count, 1, [arb(valued(poly, at)) for poly in equations])
            across = jacobian.transpose()
            try:
                step = (across * jacobian).solve(across * missed)
            except (ZeroDivisionError, ValueError):
                return None
            point = [value - rounded(step[k, 0]) for k, value in enumerate(point)]
        at = dict(zip(variables, point))
        near = fmpq(1, 1 << (limits.ISOLATED_BITS // 2))
        return point if all(abs(valued(poly, at) or fmpq(0)) < near for poly in equations) else None


def rounded(value: arb) -> fmpq:
    """A rational close to the middle of a ball."""
    man, exp = value.mid().man_exp()
    number = fmpq(int(man)) * fmpq(2) ** int(exp)
    return fmpq((number * (1 << limits.ISOLATED_BITS)).floor(), 1 << limits.ISOLATED_BITS)


def recognised(
    equations: Sequence[fmpq_mpoly], variables: Sequence[str], point: Sequence[fmpq]
) -> Assignment | None:
    """The point in one number field, with the equations exactly true; None where none was seen."""
    for combination in limits.COMBINATIONS:
        theta = sum((c * value for c, value in zip(combination, point)), fmpq(0))
        modulus = minimal_polynomial(theta)
        if modulus is None:
            continue
        number = min(real_roots(modulus), key=lambda root: abs(root.approximation() - theta))
        modulus = fmpq_poly(number.poly)
        powers = [theta**k for k in range(int(modulus.degree()))]
        values: dict[str, fmpq_poly] = {}
        for name, value in zip(variables, point):
            relation = short_relation([value, *powers])
            if relation is None or relation[0] == 0:
                break
            values[name] = fmpq_poly([fmpq(-c, relation[0]) for c in relation[1:]])
        else:
            names = places(equations[0].context())
            at = [values.get(name, fmpq_poly()) for name in names]
            if not any(at_elements(poly, at, modulus) for poly in equations):
                if number.is_rational:
                    exact = {n: fmpq_poly([v(number.approximation())]) for n, v in values.items()}
                    return Assignment(exact)
                return Assignment(values, number)
    return None


def minimal_polynomial(value: fmpq) -> fmpq_poly | None:
    """A polynomial of low degree and short coefficients with a root close to a number."""
    for degree in limits.ISOLATED_DEGREES:
        relation = short_relation([value**k for k in range(degree + 1)])
        if relation is not None:
            return fmpq_poly(relation)
    return None


def short_relation(values: Sequence[fmpq]) -> list[int] | None:
    """Short integers whose sum with these numbers nearly vanishes; None where there are none.

    >>> short_relation([fmpq(1), fmpq(3, 2)])
    [3, -2]
    >>> short_relation([fmpq(1), 1 + fmpq(1, 10**30)]) is None
    True
    """
    size, scale = len(values), 1 << (limits.ISOLATED_BITS // 2)
    rows = [
        [*(int(j == k) for j in range(size)), int((value * scale).floor())]
        for k, value in enumerate(values)
    ]
    reduced = fmpz_mat(rows).lll()
    first = [int(reduced[0, k]) for k in range(size + 1)]
    return first[:-1] if max(map(abs, first)) < 1 << limits.SHORT else None
