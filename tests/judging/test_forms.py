"""What the forms add to a statement: abbreviations once and in order, and the side conditions of
divisions.
"""

from __future__ import annotations

from fractions import Fraction

from juggleproof.certificates import checker
from juggleproof.judging.forms import Vocabulary, always
from juggleproof.statements.language import reals

a, b, x, y = reals("a b x y")


def test_an_abbreviation_made_from_another_is_written_once_after_it_holds() -> None:
    statement = always(
        a + b > 0,
        given=[y > 0],
        label="demo/main",
        vocabulary=Vocabulary(abbreviations={"a": b + 1, "b": x / y}),
    )
    assert statement.text().splitlines()[3:5] == ["let b = x/y", "let a = b + 1"]
    checker.Unfolding(checker.read_statements(statement.text())["demo/main"], checker.Context())


def test_side_condition_has_the_sign_of_the_vocabularys_sample_holds() -> None:
    def condition(**sample: Fraction) -> str:
        return (
            always(1 / (x - y) > 0, given=[x > y + 1], vocabulary=Vocabulary(sample=sample))
            .text()
            .splitlines()[3]
        )

    assert condition(x=Fraction(3)) == "have x - y > 0"
    assert condition(x=Fraction(1)) == "have x - y < 0"
