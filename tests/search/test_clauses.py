"""Disjunctions led by conflicts, and points where some variables have few values."""

from __future__ import annotations

import random

from juggleproof.algebra.conditions import Condition
from juggleproof.certificates import checker
from juggleproof.search.closing import Closing, search_closing
from juggleproof.search.hints.clauses import search_by_conflicts
from juggleproof.search.hints.few_values import LinearQuestion, point_by_few_values
from juggleproof.statements.language import NO_ROLES
from juggleproof.statements.nodes import Node
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget
from tests.rows import each_row


def state(names: str, *formulas: str) -> SearchState:
    """The state that assumes some formulas over these variables."""
    context = checker.Context()
    for name in names.split():
        context.declare(name)
    assumed = SearchState(context)
    for formula in formulas:
        assumed.assume(context.formula(checker.parse(formula)))
    return assumed


def closed_by_conflicts(assumed: SearchState) -> Node | None:
    """The node by which conflicts close a state."""
    budget = Budget(3 * 10**6)
    closing = Closing({}, budget, 1)
    return search_by_conflicts(assumed, lambda few: closing.leaf(few, 0), budget)


def leaves(node: Node) -> int:
    """How many nodes stand at the ends of cases."""
    return sum(map(leaves, node[2])) if node[0] == "cases" else 1


def pigeons(holes: int) -> tuple[str, list[str]]:
    """One number more than there are holes, no two of them close."""
    names = [f"x{k}" for k in range(holes + 1)]
    formulas = [" or ".join(f"{name} = {k}" for k in range(holes)) for name in names]
    apart = [f"({a} - {b})^2 > 1/2" for k, a in enumerate(names) for b in names[:k]]
    return " ".join(names), formulas + apart


def clauses(seed: int) -> tuple[str, list[str]]:
    """Variables that are at most -1 or at least 1, in random clauses of signs and products."""
    source = random.Random(seed)
    names = [f"x{k}" for k in range(5)]
    formulas = [f"{name} <= -1 or {name} >= 1" for name in names]
    for _ in range(28):
        parts = []
        for name in source.sample(names, 3):
            other = source.choice([one for one in names if one != name])
            sign = source.choice("<>")
            parts.append(source.choice([f"{name} {sign} 0", f"{name}*{other} {sign} 0"]))
        formulas.append(" or ".join(parts))
    return " ".join(names), formulas


def test_pigeons_are_closed_by_conflicts_holds() -> None:
    names, formulas = pigeons(4)
    assumed = state(names, *formulas)
    node = closed_by_conflicts(assumed)
    assert node is not None
    assert assumed.is_closed_by(node, {})


def test_a_conflict_without_disjunctions_splits_none_holds() -> None:
    # ten disjunctions have nothing to do with it, one more has
    names = " ".join(f"x{k}" for k in range(10)) + " y z"
    idle = [f"x{k} < 0 or x{k} > 1" for k in range(10)]
    assumed = state(names, *idle, "y > 1 or y < -1 or y*z > 3", "y^2 + z^2 < 1")
    node = search_closing(assumed, {}, Budget(10**6), 1)
    assert node is not None
    assert assumed.is_closed_by(node, {})
    assert leaves(node) == 3


def test_nested_disjunctions_are_closed_by_conflicts_holds() -> None:
    assumed = state(
        "x y",
        "x > 2 or (x < -2 and (y > 1 or y < -1)) or (x = 0 and y = 3)",
        "x^2 + y^2 < 4",
        "x*y > 0 or x*y < 0 or y > 5",
    )
    node = closed_by_conflicts(assumed)
    assert node is not None
    assert assumed.is_closed_by(node, {})


def test_conflicts_fail_without_a_fact_that_they_need() -> None:
    names, formulas = pigeons(3)
    assert closed_by_conflicts(state(names, *formulas[:-1])) is None


@each_row("seed", (0, 6))
def test_random_clauses_are_closed_or_have_a_point_holds(seed: int) -> None:
    names, formulas = clauses(seed)
    assumed = state(names, *formulas)
    node = closed_by_conflicts(assumed)
    condition = Condition.of(assumed.context, checker.join("and", assumed.formulas))
    point = point_by_few_values(condition, Budget(10**6), NO_ROLES)
    assert (node is None) != (point is None)
    if node is not None:
        assert assumed.is_closed_by(node, {})
    if point is not None:
        assert condition.substituted(point).tree is True


def chain(steps: int, goal: str) -> Condition:
    """x moves by a speed times a time, with one of two speeds at each step."""
    names = ["x0"] + [f"{kind}{k}" for k in range(1, steps + 1) for kind in "xvt"]
    formulas = ["x0 = 0", goal]
    for k in range(1, steps + 1):
        formulas.append(f"x{k} = x{k - 1} + v{k}*t{k} and t{k} > 0 and t{k} <= 1")
        formulas.append(f"(v{k} >= 1 and v{k} <= 2) or (v{k} = -3 and x{k - 1} >= 1)")
    assumed = state(" ".join(names), *formulas)
    return Condition.of(assumed.context, checker.join("and", assumed.formulas))


@each_row("goal", ["x6*x6 = 121", "x6 < -1", "x6*x3 < -1 and x5 > 1"])
def test_few_values_and_a_linear_rest_reach_a_goal_holds(goal: str) -> None:
    condition = chain(6, goal)
    point = point_by_few_values(condition, Budget(10**6), NO_ROLES)
    assert point is not None
    assert condition.substituted(point).tree is True


def test_few_values_fail_without_a_point() -> None:
    assert point_by_few_values(chain(6, "x6*x6 = 169"), Budget(10**6), NO_ROLES) is None


def test_a_product_is_none_where_no_value_is_its_factor() -> None:
    condition = chain(1, "x1 = 1")
    question = LinearQuestion(condition, {"v1": []})
    assert question.asked(Budget(10**6)) == (None, ["v1"])
