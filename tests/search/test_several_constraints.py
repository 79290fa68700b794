"""Constraints over a box that have no common point are answered unsat; with one, they are sat."""

from __future__ import annotations

import pytest

from juggleproof.smtlib.answering import ScriptQuestion, answer

UNIT = "x >= 0 and x <= 1 and y >= 0 and y <= 1"
APART = {
    "two curves": f"{UNIT} and x^2 + y^2 >= 1 and x + y <= 99/100",
    "an equation": "x*(2 - x) >= 0 and y*(2 - y) >= 0 and x^3 + y^3 = 3*x*y and x + y >= 31/10",
    "sides in products": "(x - 1)*(3 - x) >= 0 and (y + 1)*(2 - y) >= 0 and x*y^2 - x >= 93/10",
    "a square for a side": "x^2 <= 2 and y^2 < 3 and x^3*y > 5 and x + y <= 4",
    "a ball": "x^2 + y^2 <= 1/2 and 100*(y - x^2)^2 + (1 - x)^2 <= 1/10",
    "a ball off the origin": "(x - 3)^2 + 2*(y + 1)^2 <= 1/4 and x*y >= -1",
    "cases": f"{UNIT} and (x*y >= 3/4 or x^2 + y^2 <= 1/8) and x + y >= 7/10 and x + y <= 17/10",
}
TOGETHER = {
    "two curves": f"{UNIT} and x^2 + y^2 >= 1 and x + y <= 11/10",
    "cases": f"{UNIT} and (x*y >= 3/4 or x^2 + y^2 <= 1/8) and x + y >= 7/10 and x + y <= 9/5",
    "no side above": "x >= 0 and x <= 1 and y >= 0 and x*y >= 2 and y >= x",
}


def word(text: str) -> str:
    return answer(ScriptQuestion("f/c", (f"statement f/c\nforall x y\nshow not ({text})",))).word


@pytest.mark.parametrize("name", APART)
def test_constraints_without_a_common_point_contradict_holds(name: str) -> None:
    assert word(APART[name]) == "unsat"


@pytest.mark.parametrize("name", TOGETHER)
def test_constraints_contradict_fails_without_their_distance(name: str) -> None:
    assert word(TOGETHER[name]) == "sat"
