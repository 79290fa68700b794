"""A statement that goes on from one before it is unfolded as it is alone; work that is left out
because it was done before is counted all the same.
"""

from __future__ import annotations

import pytest

from juggleproof.certificates import checker
from juggleproof.search.closing import Closing
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Unfolded, unfolded

FIRST = "forall x y n\ngiven x > 0\ngiven y/x < 2\nlet z = x + y/x"
SECOND = {
    "another goal": f"{FIRST}\nshow z > 0",
    "a line more": f"{FIRST}\ngiven z^2 > y/x\nhave z > x/7\nshow x = 1",
    "the same": f"{FIRST}\ngiven z > 1\nshow z > y",
    "no line": "forall u\nshow u^2 >= 0",
    "an integer": FIRST.replace("n\n", "n\ninteger n\n") + "\nshow n > 0",
    "another first line": FIRST.replace("y n", "n y") + "\nshow z > 0",
    "less": "forall x y n\ngiven x > 0\ngiven y/x < 2\nshow y < 2*x",
}


def read(lines: str, definition: str = "") -> checker.Statement:
    return checker.read_statements(f"{definition}statement a/b\n{lines}")["a/b"]


def shown(unfolding: checker.Unfolding) -> tuple[object, ...]:
    context = unfolding.context

    def written(formula: checker.Formula) -> object:
        if isinstance(formula, bool):
            return formula
        if formula[0] == "atom":
            return context.show(formula[1]), formula[2]
        return (formula[0], *map(written, formula[1]))

    return (
        [*map(written, unfolding.premises)],
        [(count, written(one)) for count, one in unfolding.obligations],
        [*map(written, unfolding.goals)],
        (unfolding.variables, unfolding.universal, context.index, context.integers),
        context.values.keys(),
        written(context.formula(checker.parse("x + 1/x > y or x = 3")))
        if {"x", "y"} <= unfolding.variables
        else None,
    )


@pytest.mark.parametrize("name", SECOND)
def test_what_goes_on_from_another_statement_is_as_alone_holds(name: str) -> None:
    before, statement = Unfolded(read(f"{FIRST}\ngiven z > 1\nshow z > y")), read(SECOND[name])
    kept = shown(before)
    assert shown(Unfolded(statement, before=before)) == shown(
        checker.Unfolding(statement, checker.Context())
    )
    assert shown(before) == kept


def test_a_line_goes_on_fails_without_the_same_meaning() -> None:
    """The text is the same; a definition makes something else of it."""
    lines = "forall x\ngiven f(x) > 0\nshow x > 0"
    one, other = (read(lines, f"define f(v) := {body}\n\n") for body in ("v + 1", "v - 1"))
    assert one.texts == other.texts
    assert shown(unfolded(one))[0] == [("x + 1", ">")]
    assert shown(unfolded(other))[0] == [("x - 1", ">")]


def test_statements_one_after_another_spend_their_own_work_holds() -> None:
    before = Unfolded(read(f"{FIRST}\nshow z > 0"))
    before.context.work.spend(before.context.work.left)
    assert len(Unfolded(read(f"{FIRST}\nshow z > y"), before=before).premises) == 2


def test_a_form_that_was_not_found_is_counted_again_holds() -> None:
    context = checker.Context()
    for name in ("a", "x", "y"):
        context.declare(name)
    text = "a >= 0 and a <= 1 and a*x^2 + x*y - y^2 > 0 and x > y and y > 0 - x"
    state = SearchState(context).assume(context.formula(checker.parse(text)))
    left = []
    for _ in range(3):
        closing = Closing({}, Budget(10**6), 2)
        assert closing.forms(state) is None
        left.append(closing.budget.left)
    assert left[0] == left[1] == left[2] < 10**6
