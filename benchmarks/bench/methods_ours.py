"""Our method: a box tree of exact Bernstein coefficients, and the checker's word for it; the time
of both counts.
"""

from __future__ import annotations

import json
from fractions import Fraction

from benchmarks.bench.answers import Answer, GaveUp
from benchmarks.bench.finding import Point, best_point
from benchmarks.bench.problems import Problem
from certificates import checker
from certificates.search.small_tree import search_tree

SHARE = 8  # of the width, which the value at the point may take
FEW, MANY = (
    8,
    20000,
)  # boxes: for width 0, which needs few or fails, and for the width that is asked for


def bernstein(problem: Problem, width: Fraction) -> Answer:
    """Certifies that the value at a rational point is attained, and that nothing exceeds it by more
    than the width, or at all where that succeeds.
    """
    point, low = best_point(problem, width / SHARE)
    wider = low + width * (SHARE - 1) / SHARE
    for high, most in ([(low, FEW)] if can_be_a_corner(problem, point) else []) + [(wider, MANY)]:
        tree = search_tree(problem.excess(high), problem.box, most)
        if tree is not None:
            size = _checked(problem, point, low, high, tree)
            return Answer(low, high, f"{len(tree)} letters, {size} bytes")
    raise GaveUp(f"{MANY} boxes")


def can_be_a_corner(problem: Problem, point: Point) -> bool:
    """Whether few halvings lead to boxes with the point at a corner: only there is a Bernstein
    coefficient the value at the point.
    """
    places = [(x - low) / (high - low) for x, (low, high) in zip(point, problem.box)]
    return all(2**FEW % place.denominator == 0 for place in places)


def _checked(problem: Problem, point: Point, low: Fraction, high: Fraction, tree: str) -> int:
    """The bytes of the certificate that the checker accepts, read back from what would be stored;
    ArithmeticError where it rejects it.
    """
    (statement,) = checker.read_statements(problem.of_box(low, high)).values()
    excess, size = problem.excess(high), len(problem.names)
    bounds = [[2 * k, 2 * k + 1] for k in range(size) if any(e[k] for e in excess)]
    node = [
        "boxes",
        2 * size + (1 if any(map(any, problem.under)) else 0) + 1,
        bounds,
        tree,
    ]  # a denominator that is constant is no fact
    found = [
        statement.name,
        [],
        {name: str(value) for name, value in zip(problem.names, point)},
        ["close"],
    ]
    stored = json.dumps({"certified": ["proof", [], node], "point": found})
    outcome, reason = checker.check_one(statement, json.loads(stored), {}, {})
    if outcome != "certified":
        raise ArithmeticError(f"the checker says of {statement.name}: {outcome} {reason}")
    return len(stored)
