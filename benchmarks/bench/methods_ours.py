"""Our method: a box tree of exact Bernstein coefficients, and the checker's word for it; the time of both counts."""

from __future__ import annotations

import json
from fractions import Fraction

from benchmarks.bench.answers import Answer, GaveUp
from benchmarks.bench.finding import Point, best_point
from benchmarks.bench.problems import Problem
from certificates import checker
from certificates.search.box_tree import Branching

SHARE = 8  # of the width, which the value at the point may take
FEW, MANY = 8, 20000  # boxes: for width 0, which needs few or fails, and for the width that is asked for


def bernstein(problem: Problem, width: Fraction) -> Answer:
    """Certifies that the value at a rational point is attained, and that nothing exceeds it by more than the width, or at all where that succeeds."""
    point, low = best_point(problem, width / SHARE)
    for high, budget in ((low, FEW), (low + width * (SHARE - 1) / SHARE, MANY)):
        tree = Branching(problem.excess(high), problem.box, lambda: Fraction(0), lambda place: None, True).run(budget)
        if tree.reached:
            size = _checked(problem, point, low, high, tree.text)
            return Answer(low, high, f"{tree.boxes} boxes, {size} bytes")
    raise GaveUp(f"{MANY} boxes")


def _checked(problem: Problem, point: Point, low: Fraction, high: Fraction, tree: str) -> int:
    """The bytes of the certificates that the checker accepts, read back from what would be stored; ArithmeticError where it rejects one."""
    text = problem.of_box(high) + "\n" + attained(problem, low)
    size = len(problem.names)
    first, second = checker.read_statements(text).values()
    corner = {name: str(low) for name, (low, _) in zip(problem.names, problem.box)}
    node = ["boxes", 2 * size, [[2 * k, 2 * k + 1] for k in range(size)], tree]
    stored = json.dumps([
        {"certified": ["proof", [], node], "point": [first.name, [], corner, ["close"]]},
        {"certified": ["witness", [], [second.name, [], {name: str(value) for name, value in zip(problem.names, point)}, ["close"]]],
         "point": [second.name, [], {}, ["close"]]}])
    for statement, certificate in zip((first, second), json.loads(stored)):
        outcome, reason = checker.check_one(statement, certificate, {}, {})
        if outcome != "certified":
            raise ArithmeticError(f"the checker says of {statement.name}: {outcome} {reason}")
    return len(stored)


def attained(problem: Problem, low: Fraction) -> str:
    """The statement that some point of the box, where the denominator is positive, has at least this value."""
    inside = " and ".join(f"{first} <= {name} and {name} <= {last}" for name, (first, last) in zip(problem.names, problem.box))
    return "\n".join([f"statement bench/{problem.name}-attained", "exists " + " ".join(problem.names),
                      f"show {inside} and {problem.text(problem.under)} > 0 and {problem.text(problem.excess(low))} <= 0", ""])
