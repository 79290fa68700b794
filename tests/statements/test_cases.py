"""Lines about maps as a person writes them: the cases of abs, max and min, and decimals, say the
same at every state.
"""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.map_stability.terms import holds, value
from juggleproof.statements.cases import exact, with_cases
from juggleproof.statements.language import ClaimError, MapRule
from tests.rows import each_row

NUMBERS = st.fractions(-3, 3, max_denominator=4)


def line(keyword: str, text: str) -> list[str]:
    return [row for _, row in with_cases(MapRule("a/b", ((keyword, text),))).rows]


@given(NUMBERS, NUMBERS)
def test_the_cases_of_a_formula_are_those_of_python_holds(x: Fraction, y: Fraction) -> None:
    (text,) = line("stage", "max(abs(x), y) <= 1.5 or min(x, y) > 0.5")
    said = max(abs(x), y) <= Fraction(3, 2) or min(x, y) > Fraction(1, 2)
    assert holds(text, {"x": x, "y": y}) == said


@given(NUMBERS, NUMBERS)
def test_the_greatest_of_the_lines_of_a_rank_is_the_rank_holds(x: Fraction, y: Fraction) -> None:
    rows = [row.split(" -> ") for row in line("rank", "y >= -1 -> max(2*abs(x), y) - min(x, 1)")]
    here = {"x": x, "y": y}
    values = [value(term, here) for guard, term in rows if holds(guard, here)]
    assert values == ([max(2 * abs(x), y) - min(x, 1)] if y >= -1 else [])


def test_a_piece_without_a_guard_applies_everywhere_holds() -> None:
    assert line("piece", "x/2, y") == ["0 < 1 -> x/2, y"]
    assert line("piece", "x > 0 -> x/2, y") == ["x > 0 -> x/2, y"]


def test_decimals_are_exact_and_names_stay_holds() -> None:
    assert exact("0.1*x1 + .25 - 3") == "(1/10)*x1 + (1/4) - 3"
    assert line("map", "model-1.5/map") == ["model-1.5/map"]
    assert line("rate", "0.75") == ["(3/4)"]


def test_what_has_nothing_of_this_is_the_same_rule_holds() -> None:
    rule = MapRule("a/b", (("domain", "a > 0"), ("piece", "x > 0 -> x/2"), ("rank", "x")))
    assert with_cases(rule) is rule


@each_row(
    ("text", "says"),
    [
        ("abs(x, y)", "a/b: the line `rank abs(x, y)`: abs(x, y): abs takes one term, max and min"),
        ("max(" + ", ".join(f"x + {k}" for k in range(70)) + ")", "more than 64 cases"),
    ],
)
def test_rejects_a_line_without_cases(text: str, says: str) -> None:
    with pytest.raises(ClaimError) as fault:
        line("rank", text)
    assert says in str(fault.value)
