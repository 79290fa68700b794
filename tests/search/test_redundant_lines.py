"""One more line that follows from the others, or that says nothing, loses no proof."""

from __future__ import annotations

import pytest

from juggleproof.smtlib.answering import ScriptQuestion, answer
from tests.rows import each_row

PROBLEMS = {
    "a form": "x^4*y^2 + x^2*y^4 + z^6 - 3*x^2*y^2*z^2 < 0",
    "a polynomial": "x^2*y^2*(x^2 + y^2 - 1) + 1/27 < 0 and z = z",
    "a box": "0 <= x and x <= 1 and y^2 <= 1 and x^2*y >= 1/2 and x + y <= 6/5 and z > x",
    "an equation": "x^2 + y^2 = 1 and x*y > 1/2 and z >= 0",
    "linear": "x + y <= 1 and y + z <= 1 and x + z <= 1 and x + y + z > 3/2",
    "cases": "(x > 1 and y > x or y > 2 and x > y) and x*y <= 1 and z^2 >= 0",
}
LINES = {
    "a square": "(x - 1/3)^2 + z^2 >= 0",
    "a large box": " and ".join(f"-9 <= {name} and {name} <= 9" for name in "xyz"),
    "another variable": "t > 0",
    "an empty choice": "(x >= 0 or x < 0)",
}


PAIRS = [(name, line) for name in PROBLEMS for line in LINES]


@pytest.mark.parametrize(
    ("name", "line"),
    # each problem with one line, each line with some problem
    [
        pytest.param(*pair, marks=[pytest.mark.exhaust] * (k % 4 != k // 4 % 4))
        for k, pair in enumerate(PAIRS)
    ],
)
def test_a_redundant_line_loses_no_proof_holds(name: str, line: str) -> None:
    text = f"statement f/c\nforall x y z t\nshow not ({PROBLEMS[name]} and {LINES[line]})"
    assert answer(ScriptQuestion("f/c", (text,))).word == "unsat"


@each_row("name", PROBLEMS)
def test_all_lines_said_twice_lose_no_proof_holds(name: str) -> None:
    text = f"statement f/c\nforall x y z\nshow not ({PROBLEMS[name]} and {PROBLEMS[name]})"
    assert answer(ScriptQuestion("f/c", (text,))).word == "unsat"
