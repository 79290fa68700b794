"""Products of bounds along the monomials of the last fact contradict it, and the checker takes it;
not where a hypothesis is dropped.
"""

from __future__ import annotations

import pytest

from juggleproof.algebra.polynomials import Ring
from juggleproof.certificates import checker
from juggleproof.search.psatz.by_monomials import search_by_monomials
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.statements.nodes import Node
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted
from tests.rows import each_row

NAMES = ("a", "u", "v", "x", "y", "d")
BOUNDS = (
    "0 < a and a < 3/10 and -1 <= u and u <= 1 and -1 <= v and v <= 1"
    " and -d <= x and x <= d and -d <= y and y <= d"
)
SUM = "a*u*x + a*v*y > 2*d/3"


def found(text: str, budget: int = 10**5) -> Node | None:
    context = checker.Context()
    for name in NAMES:
        context.declare(name)
    state = SearchState(context).assume(context.formula(checker.parse(text)))
    node = search_by_monomials(LeafProblem(state, Ring(NAMES)), Budget(budget))
    assert node is None or state.is_closed_by(node, {})
    return node


@each_row(
    "text",
    [
        f"{BOUNDS} and {SUM}",
        f"{BOUNDS} and d^2 + d*y = 0 and {SUM} - d^2 - d*y",  # an equation is added once
        "0 <= a and a <= 1 and 0 <= x and x <= 1 and a*x^3 > 1",
    ],
)
def test_bounds_of_each_term_contradict_the_sum_holds(text: str) -> None:
    node = found(text)
    assert node is not None and node[0] == "psatz"


@each_row(
    "text",
    [
        f"{BOUNDS} and a*u*x + a*v*y > d/2",  # 3/5 d is reached
        f"{BOUNDS.replace('and u <= 1', '')} and {SUM}",
        "0 <= x and x <= 1 and 0 <= y and y <= 1 and x*y > 1",  # left to pairs of facts
        " and ".join(f"{n} >= 0 and {n} <= 1" for n in NAMES) + " and a^4*u^4*x^4 > 1",  # too many
    ],
)
def test_bounds_of_each_term_are_found_fails_without_a_hypothesis(text: str) -> None:
    assert found(text) is None


def test_the_work_is_counted_holds() -> None:
    with pytest.raises(Exhausted):
        found(f"{BOUNDS} and {SUM}", budget=10)
