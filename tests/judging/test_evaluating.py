"""Simple values for counterexamples, and the numbers of a formula at them."""

from __future__ import annotations

from fractions import Fraction

from juggleproof.judging.evaluating import at_simple_values, is_simple, numbers_at, value_at
from juggleproof.proofs.paper.names import always
from juggleproof.statements.language import real
from juggleproof.statements.nodes import Counterexample
from tests.rows import each_row

alpha, s, x = real("alpha"), real("s"), real("x")


@each_row(
    "terms, adjoined, simple",
    [
        ({"x": "-12/7"}, [], True),
        ({"x": "23/98"}, [], False),
        ({"x": "theta"}, [("theta", "theta^2 - 2", "1", "2", ("close",), ("close",))], False),
    ],
)
def test_simple_values_are_small_rationals_holds(
    terms: dict[str, str], adjoined: list[tuple[object, ...]], simple: bool
) -> None:
    found = Counterexample("a/main", adjoined, terms, ("close",), ("close",))  # type: ignore[arg-type]
    assert is_simple(found) == simple


def test_simple_values_make_roots_rational_holds() -> None:
    statement = always(x * s > alpha)
    given = [
        str(one.lines[-1][1]) for one in at_simple_values(statement, "alpha", [2 * (1 + alpha)])
    ]
    assert given == ["alpha = 1/8", "alpha = 7/18", "alpha = 7/25", "alpha = 17/32"]
    plain = [str(one.lines[-1][1]) for one in at_simple_values(statement, "alpha", [])]
    assert plain == ["alpha = 1/2", "alpha = 1/3", "alpha = 2/3", "alpha = 1/4"]


@each_row(
    "text, numbers",
    [
        ("x^2 < x", "4 < 2"),
        ("x > 0 and x < 1", "2 < 1"),
        ("x < 0 or x = 1", "2 < 0 or 2 = 1"),
        ("not x = 2", "yet 2 = 2"),
        ("implies(x > 1, x > 3)", "2 > 1 is true, and 2 > 3 false"),
        ("y < 1", ""),
        ("1/(x - 2) < 1", ""),
    ],
)
def test_numbers_stand_in_the_part_that_fails_holds(text: str, numbers: str) -> None:
    assert numbers_at(text, {"x": Fraction(2)}) == numbers


@each_row("text", ["y", "1/(x - 2)", "x < 1"])
def test_rejects_what_has_no_value(text: str) -> None:
    assert value_at(text, {"x": Fraction(2)}) is None
