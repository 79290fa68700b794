"""Where a condition can change its verdict as one parameter moves: candidate numbers from iterated
resultants and discriminants.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from flint import fmpq_mpoly

from .algebraic import AlgebraicNumber, real_roots
from .budget import Budget, Exhausted
from .condition import Condition, coefficients_in, constant_of, replace, univariate

# a polynomial with more terms than this is dropped: the candidates are then too few, which
# certificates would show
TERMS = 4000


def border_polynomials(
    conditions: Sequence[tuple[Condition, Condition | None]],
    parameters: Sequence[str],
    budget: Budget,
) -> list[fmpq_mpoly]:
    """Irreducible polynomials in the parameters on whose roots the projections of the conditions
    can change.

    A second condition beside one is what further variables, bound in it alone, should meet: it is
    projected first.
    """
    found: list[fmpq_mpoly] = []
    for condition, inner in conditions:
        outer: list[fmpq_mpoly] = []
        if inner is not None:
            own = condition.variables() | set(parameters)
            outer = projected(inner, own, budget)
        for poly in projected(condition, set(parameters), budget, outer):
            if poly not in found:
                found.append(poly)
    return sorted(found, key=lambda p: (p.total_degree(), len(p), str(p)))


def candidate_numbers(polys: Iterable[fmpq_mpoly], parameter: str) -> list[AlgebraicNumber]:
    """The real roots of polynomials in the one parameter, in increasing order, each once."""
    found: list[AlgebraicNumber] = []
    for poly in polys:
        for root in real_roots(univariate(poly, parameter)):
            if root not in found:
                found.append(root)
    return sorted(found)


def projected(
    condition: Condition, parameters: set[str], budget: Budget, more: Sequence[fmpq_mpoly] = ()
) -> list[fmpq_mpoly]:
    """Irreducible polynomials in the parameters on whose roots the projection of one condition can
    change.
    """
    condition, borders = without_equations(condition, parameters, budget, more)
    equations = [p for p, relation in condition.facts() if relation == "="]
    polys = _factors([*(condition.polys[k] for k in condition.used()), *borders])
    names = list(condition.ring.names())
    left = [
        n for i, n in enumerate(names) if n not in parameters and any(p.degrees()[i] for p in polys)
    ]
    while left:
        # The variable that is cheapest to eliminate: of least degree, in the fewest polynomials.
        name = min(left, key=lambda n: _cost(polys, names.index(n)))
        left.remove(name)
        polys, equations = _eliminate(polys, equations, name, budget)
    return polys


def _cost(polys: Sequence[fmpq_mpoly], place: int) -> tuple[int, int, int]:
    degrees = [p.degrees()[place] for p in polys if p.degrees()[place]]
    return (max(degrees, default=0), len(degrees), sum(len(p) for p in polys if p.degrees()[place]))


def without_equations(
    condition: Condition, parameters: set[str], budget: Budget, more: Sequence[fmpq_mpoly]
) -> tuple[Condition, list[fmpq_mpoly]]:
    """The condition after every equation linear in a variable is solved for it; where its
    coefficient vanishes is a border.
    """
    borders: list[fmpq_mpoly] = list(more)
    while True:
        best: tuple[tuple[int, int], str, fmpq_mpoly, fmpq_mpoly] | None = None
        names = condition.ring.names()
        for poly, relation in condition.facts():
            if relation != "=":
                continue
            for i, degree in enumerate(poly.degrees()):
                if degree == 1 and names[i] not in parameters:
                    rest, slope = coefficients_in(poly, names[i])
                    others = {names[j] for j, e in enumerate(slope.degrees()) if e}
                    if others <= parameters:
                        size = (len(slope), len(rest))
                        if best is None or size < best[0]:
                            best = size, names[i], -rest, slope
        if best is None:
            return condition, borders
        _, name, top, bottom = best
        budget.spend(500)
        borders = [replace(p, name, top, bottom) for p in borders]
        borders += [] if constant_of(bottom) is not None else [bottom]
        condition = condition.replaced(name, top, bottom)


def _eliminate(
    polys: list[fmpq_mpoly], equations: list[fmpq_mpoly], name: str, budget: Budget
) -> tuple[list[fmpq_mpoly], list[fmpq_mpoly]]:
    """The projection along one variable: coefficients, discriminants and resultants; only those
    with an equation where there is one.
    """
    place = polys[0].context().variable_to_index(name)
    mixed = [p for p in polys if p.degrees()[place]]
    result = [p for p in polys if not p.degrees()[place]]
    pivots = [p for p in mixed if any((e % p) == 0 for e in equations if e != 0)]
    pivot = (
        min(pivots, key=lambda p: (p.degrees()[place], len(p)))
        if len(equations) and pivots
        else None
    )
    owned = [e for e in equations if pivot is not None and (e % pivot) == 0]
    whole = pivot is not None and all(
        sum(1 for f, _ in e.factor()[1] if f.degrees()[place]) == 1 for e in owned[:1]
    )
    fresh: list[fmpq_mpoly] = []
    firsts = [pivot] if whole and pivot is not None else mixed
    for p in firsts:
        parts = coefficients_in(p, name)
        fresh.append(parts[-1])
        if len(parts) > 2:
            _spend(budget, p, p)
            fresh.append(p.discriminant(name))
            fresh += _vanishing(parts)
    if whole and pivot is not None:
        pairs = [(pivot, q) for q in mixed if q is not pivot]
    else:
        pairs = [(p, q) for i, p in enumerate(mixed) for q in mixed[:i]]
    new_equations = [e for e in equations if not e.degrees()[place]]
    for p, q in pairs:
        _spend(budget, p, q)
        resultant = p.resultant(q, name)
        fresh.append(resultant)
        if whole and any((e % q) == 0 for e in equations if e != 0 and e not in owned):
            new_equations.append(resultant)
    return _factors([*result, *fresh]), [e for e in new_equations if e != 0]


def _vanishing(parts: Sequence[fmpq_mpoly]) -> list[fmpq_mpoly]:
    """Lower coefficients, as long as all above can vanish together."""
    found: list[fmpq_mpoly] = []
    for part in reversed(parts[1:]):
        if constant_of(part) is not None and part != 0:
            return found
        if part != 0:
            found.append(part)
    return found


def _spend(budget: Budget, p: fmpq_mpoly, q: fmpq_mpoly) -> None:
    budget.spend(100 + 4 * len(p) * len(q))
    if len(p) * len(q) > TERMS * TERMS:
        raise Exhausted


def _factors(polys: Iterable[fmpq_mpoly]) -> list[fmpq_mpoly]:
    """The distinct irreducible factors that are no constants, each with leading coefficient 1; too
    large ones are left out.
    """
    found: dict[str, fmpq_mpoly] = {}
    for poly in polys:
        if poly == 0 or poly.is_constant() or len(poly) > TERMS:
            continue
        for factor, _ in poly.factor()[1]:
            monic = factor / factor.leading_coefficient()
            found.setdefault(str(monic), monic)
    return list(found.values())
