"""Facts that are linear in all variables but a parameter: few of them, with minors as multipliers,
contradict one another, and the checker takes it.
"""

from __future__ import annotations

import pytest

from juggleproof.algebra.polynomials import Ring
from juggleproof.certificates import checker
from juggleproof.search.psatz.by_parameter import search_by_parameter
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.statements.nodes import Node
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted
from tests.rows import each_row

NAMES = ("t", "x", "y")


def state_of(text: str) -> SearchState:
    context = checker.Context()
    for name in NAMES:
        context.declare(name)
    return SearchState(context).assume(context.formula(checker.parse(text)))


def found(text: str, budget: int = 10**5) -> Node | None:
    state = state_of(text)
    node = search_by_parameter(LeafProblem(state, Ring(NAMES)), Budget(budget))
    assert node is None or state.is_closed_by(node, {})
    return node


@each_row(
    ("text", "most"),
    [
        ("t > 1 and t < 2 and x >= t*y and y >= 1 and x < t", 5),
        # powers of the parameter are squares, as far as they are even
        ("t > 1 and t < 2 and y >= 1 and x >= t^8*y and x < 0", 4),
        ("t > 0 and t < 1 and x > t^3 and x < t^5", 8),
        ("t >= 0 and t <= 1 and x + t*y >= 2 and x - t*y >= 3 - 4*t*(1 - t) and x < 1", 8),
    ],
)
def test_few_facts_contradict_one_another_holds(text: str, most: int) -> None:
    node = found(text)
    assert node is not None and node[0] == "psatz" and len(node[1]) <= most


@each_row(
    "text",
    [
        "t > 1 and t < 2 and x >= t*y and y >= 1 and x <= 2",  # they have a common point
        "t > 1 and t < 2 and x^2 < 0",  # not linear
        "t > 1 and x > 2*t and x < t",  # the parameter has one bound
        "t > 1 and t < 2 and y > 1 and y < 2 and x*t > 1 and x < 0",  # two parameters
        "t >= 0 and t <= 1 and x >= t and x <= t - t^2*(1 - t)",  # nothing is strict
        "t > 1 and t < 2 and t > 3",  # no other variable
    ],
)
def test_few_facts_are_found_fails_without_a_hypothesis(text: str) -> None:
    assert found(text) is None


def test_rejects_a_budget_that_is_too_small() -> None:
    with pytest.raises(Exhausted):
        found("t > 1 and t < 2 and x >= t*y and y >= 1 and x < t", 0)
