"""Parameters of a goal: their bounds, and which of its variables are parameters."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from flint import fmpz_mpoly

from juggleproof.algebra.polynomials import degree_in
from juggleproof.search import limits
from juggleproof.search.psatz.facts import Axis, BoundedVariable, sides_of
from juggleproof.search.psatz.problem import LeafProblem


def bounds(problem: LeafProblem) -> dict[int, Axis]:
    """The variables that facts in them alone bound, with the tightest bounds."""
    facts, axes = problem.facts, dict[int, Axis]()
    low, high = sides_of(facts)
    for v in sorted({*low, *high}):
        if v not in low or v not in high:
            axes[v] = Axis(v, low.get(v), high.get(v))
        elif facts[low[v]].end(v) >= facts[high[v]].end(v):
            axes[v] = Axis(v, low[v], None)  # a box needs a width
        else:
            axes[v] = BoundedVariable(v, low[v], high[v])
    return axes


def degree_in_all(poly: fmpz_mpoly, variables: Sequence[int]) -> int:
    """The total degree in some of the variables."""
    return max((sum(int(m[v]) for v in variables) for m in poly.monoms()), default=0)


def split_variables(
    problem: LeafProblem, goal: fmpz_mpoly, axes: dict[int, Axis]
) -> tuple[list[int], list[int]] | None:
    """(parameters, others), so that the goal is of degree 2 at most in the others, if possible of
    degree 2 in each term; None where there are none.
    """
    degrees = [int(d) for d in goal.degrees()]
    used = {v for poly in problem.polys() for v, d in enumerate(poly.degrees()) if d}
    both = {v for v, axis in axes.items() if isinstance(axis, BoundedVariable)}
    fixed = [v for v in sorted(used) if not degrees[v] and v in both]
    open_ = [v for v in axes if degrees[v]]
    if len(open_) > limits.MOST_BOUNDED:
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
