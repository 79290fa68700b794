"""Boxes with several constraints are closed by cuts; one that has a point is not."""

from __future__ import annotations

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.search.boxes.cuts import close_by_cuts
from juggleproof.certificates.states import State
from juggleproof.certificates.work import Budget, Exhausted
from juggleproof.proofs.smtlib.answering import Question, answer
from tests.rows import each_row

UNIT = "x >= 0 and x <= 1 and y >= 0 and y <= 1"
CLOSED = {
    "two curves": f"{UNIT} and x^2 + y^2 >= 1 and x + y <= 99/100",
    "an equation": "x*(2 - x) >= 0 and y*(2 - y) >= 0 and x^3 + y^3 = 3*x*y and x + y >= 31/10",
    "sides in products": "(x - 1)*(3 - x) >= 0 and (y + 1)*(2 - y) >= 0 and x*y^2 - x >= 93/10",
    "a square for a side": "x^2 <= 2 and y^2 < 3 and x^3*y > 5 and x + y <= 4",
    "a ball": "x^2 + y^2 <= 1/2 and 100*(y - x^2)^2 + (1 - x)^2 <= 1/10",
    "a ball off the origin": "(x - 3)^2 + 2*(y + 1)^2 <= 1/4 and x*y >= -1",
}


def state(text: str) -> State:
    context = checker.Context()
    context.declare("x")
    context.declare("y")
    return State(context).assume(context.formula(checker.parse(text)))


@each_row("name", CLOSED)
def test_constraints_without_a_common_point_are_closed_holds(name: str) -> None:
    one = state(CLOSED[name])
    node = close_by_cuts(one, Budget(10**6))
    assert node is not None and one.is_closed_by(node, {})


def test_constraints_with_a_common_point_stay_open_holds() -> None:
    assert (
        close_by_cuts(state(f"{UNIT} and x^2 + y^2 >= 1 and x + y <= 11/10"), Budget(10**6)) is None
    )


def test_a_box_is_cut_fails_without_a_side() -> None:
    assert (
        close_by_cuts(state("x >= 0 and x <= 1 and y >= 0 and x*y >= 2 and y <= x"), Budget(10**6))
        is None
    )


def test_the_work_is_counted_holds() -> None:
    with pytest.raises(Exhausted):
        close_by_cuts(state(CLOSED["two curves"]), Budget(50))


def test_a_disjunction_over_a_box_is_answered_holds() -> None:
    """Each case is a box of its own; with 17/20 for 7/10 the first case has no point either."""
    text = f"{UNIT} and (x*y >= 3/4 or x^2 + y^2 <= 1/8) and x + y >= 7/10 and x + y <= {{}}"
    words = [
        answer(Question("f/c", (f"statement f/c\nforall x y\nshow not ({text.format(end)})",))).word
        for end in ("17/10", "9/5")
    ]
    assert words == ["unsat", "sat"]
