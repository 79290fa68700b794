"""One leaf of a proof: facts that contradict one another, shown by a positive combination that
vanishes identically.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from fractions import Fraction
from math import prod

from flint import fmpz_mpoly

from .budget import Budget
from .combination import Combination, Node
from .lifting import Term, finish
from .polynomials import constant_of
from .problem import Problem
from .reduction import merge, power

MOST_FOR_TRIPLES = 10
MOST_FAILED = 5000
_failed: dict[
    tuple[Hashable, int, int, str], int
] = {}  # (facts, stage) -> the work that it takes to find nothing
# (products of facts, extra Bernstein degree, kind of squares; or "near": no squares, and only facts
# in the goal's variables)
Stage = tuple[int, int, str]
QUICK: tuple[Stage, ...] = ((1, 0, ""),)
FIRST: tuple[Stage, ...] = ((2, 0, ""),)
USUAL: tuple[Stage, ...] = ((2, 2, "near"), (2, 2, ""), (1, 0, "squares"))
SQUARES: tuple[Stage, ...] = ((1, 2, "squares"), (1, 2, "resultants"))
TRIPLES: tuple[Stage, ...] = ((3, 2, ""),)
DEEP: tuple[Stage, ...] = (
    (2, 4, ""),
    (2, 2, "squares"),
    (2, 2, "resultants"),
    (2, 4, "resultants"),
)


def close_by_equations(problem: Problem) -> Node | None:
    """Closes a state whose equations are contradictory, or make a fact false or a nonzero
    polynomial zero.
    """
    ring, reduction = problem.ring, problem.reduction
    fact, equation = problem.contradiction, reduction.contradiction
    if fact is not None:
        value = constant_of(fact.poly) or 0
        pairs = list(zip(reduction.steps, fact.counts))
        factors = merge(fact.factors, *(power(step.lead_factors, n) for step, n in pairs))
        scale = prod((step.lead_scale**n for step, n in pairs), start=Fraction(1))
        terms = [Term(scale, factors, ring.one)] + (
            [Term(Fraction(-value), (), ring.one)] if value else []
        )
        return finish(problem.source, reduction, terms, {})
    if equation is not None:
        value = constant_of(equation.poly) or 0
        # multiple * value = sum of combination, so multiple^2 * value^2 is a sum of equations, and
        # positive
        owed = {k: -c * equation.multiple * value for k, c in equation.combination.items()}
        return finish(
            problem.source,
            reduction,
            [Term(Fraction(value * value), power(equation.factors, 2), ring.one)],
            owed,
        )
    return None


def search(problem: Problem, stages: Sequence[Stage], budget: Budget) -> Node | None:
    """The first node that one of the stages finds."""
    if not problem.facts and not problem.reduction.left:
        return None
    key = problem.content()
    roots: dict[str, list[fmpz_mpoly]] = {"": []}
    for degree, bernstein, kind in stages:
        stage = (key, degree, bernstein, kind)
        if (
            stage in _failed
            # the same facts come back, in other cases and at greater effort: the work counts, but
            # is
            # not done again
        ):
            budget.spend(_failed[stage])
            continue
        left = budget.left
        near = problem.near_goal() if kind == "near" else None
        if kind not in roots:
            roots[kind] = problem.candidates(kind) if kind != "near" else []
        same = (
            bernstein == 2
            and degree == 2
            and problem.bounded is None
            and not problem.reduction.left
        )
        if near is None if kind == "near" else not roots[kind] if kind else same:
            continue  # nothing that a smaller stage did not have
        if degree > 2 and len(problem.facts) > MOST_FOR_TRIPLES:
            continue
        node = Combination(problem, degree, bernstein, roots[kind], near).node(budget)
        if node is not None:
            return node
        if len(_failed) >= MOST_FAILED:
            _failed.clear()
        _failed[stage] = left - budget.left
    return None
