"""The evaluator of statement texts against Python's own evaluation of the same text, and what it
refuses.
"""

from __future__ import annotations

import re
from fractions import Fraction
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.proofs.reports.comparison import drawn, unknowns
from tests.proofs.reports.corpus import TEXTS
from tests.proofs.reports.nodes import NotRead, names_in
from tests.proofs.reports.statement_text import evaluate_statement_text, read_statement_text

VALUES = {
    "alpha": Fraction(1, 8),
    "x": Fraction(11),
    "w": Fraction(13),
    "r": Fraction(3),
    "v": Fraction(-5),
    "dE_max": Fraction(2),
}


def by_python(text: str, values: dict[str, Fraction]) -> object:
    """The value as Python finds it, with ^ and = as in mathematics."""
    integers = re.sub(r"\b\d+\b", r"Fraction(\g<0>)", text)
    source = re.sub(r"(?<![<>!])=", "==", integers.replace("^", "**"))
    known = {"Fraction": Fraction, "implies": lambda a, b: not a or b, "iff": lambda a, b: a == b}
    return eval(source, {"__builtins__": {}}, {**known, **values})  # the texts are our own


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("-x^2", -121),
        ("(-x)^2", 121),
        ("-1^2*x", -11),
        ("x - w - r", -5),
        ("x - -w", 24),
        ("x/w/r", Fraction(11, 39)),
        ("x/w*r", Fraction(33, 13)),
        ("2*-x", -22),
        ("x^0", 1),
        ("sqrt(2*(1 + alpha))", Fraction(3, 2)),
        ("x < w", True),
        ("x < w <= 13", True),
        ("not x < w", False),
        ("not x < w or x = 11", True),
        ("x = w or x < w and w < x", False),
        ("x != w and not w < x", True),
        ("iff(x < w, w < x)", False),
        ("implies(w < x, x = w)", True),
        ("alpha^2*r^2/2 - v <= dE_max and not x < w", False),
        ("x, -w", (11, -13)),
        ("(x, w)", (11, 13)),
    ],
)
def test_text_has_this_value_holds(text: str, expected: object) -> None:
    found = evaluate_statement_text(text, VALUES)
    assert found == expected and type(found) is not int


@pytest.mark.parametrize("text", TEXTS)
def test_every_statement_has_the_value_that_python_finds_holds(text: str) -> None:
    tree = read_statement_text(text)
    point = drawn(unknowns(tree, tree)[0], [], Random(text))
    assert {name.printed for name in names_in(tree)} <= set(point)
    assert evaluate_statement_text(text, point) == by_python(text, point)


SOME = st.sampled_from(("x", "w", "r", "2", "3", "alpha"))
TERMS = st.recursive(
    SOME,
    lambda inner: (
        st.tuples(inner, st.sampled_from((" + ", " - ", "*")), inner).map("".join)
        | inner.map("-{}".format)
        | inner.map("({})".format)
        | st.tuples(SOME | inner.map("({})".format), st.sampled_from(("^0", "^2", "^3"))).map(
            "".join
        )
    ),
    max_leaves=8,
)
RELATED = st.tuples(
    TERMS, st.sampled_from((" < ", " <= ", " = ", " != ", " > ", " >= ")), TERMS
).map("".join)
FORMULAS = st.recursive(
    RELATED,
    lambda inner: (
        st.tuples(inner, st.sampled_from((" and ", " or ")), inner).map("".join)
        | inner.map("not {}".format)
        | inner.map("({})".format)
        | st.tuples(st.sampled_from(("iff", "implies")), inner, inner).map(
            lambda parts: f"{parts[0]}({parts[1]}, {parts[2]})"
        )
    ),
    max_leaves=6,
)


@settings(deadline=None, max_examples=300)
@given(TERMS | FORMULAS)
def test_any_text_has_the_value_that_python_finds_holds(text: str) -> None:
    assert evaluate_statement_text(text, VALUES) == by_python(text, VALUES)


@pytest.mark.parametrize(
    "text",
    ["", "x +", "2x", "x w", "x(w)", "x^w", "x^-1", "x^2^3", "x == w", "x ** 2", "0.5", "(x", "x)",
     "x < w and", "and x", "not x", "x and w",
     "(x < w) < r", "x = not w < r", "iff(x < w)", "implies(x < w, x < r, w < r)", "iff", "+x",
     "1_000", "007", "sin(x)", "x < (w, r)",
     "lambda", "x; w"],
)  # fmt: skip
def test_rejects_what_is_not_in_the_language(text: str) -> None:
    with pytest.raises(NotRead):
        read_statement_text(text)


def test_rejects_a_name_without_a_value() -> None:
    with pytest.raises(NotRead, match="no one value"):
        evaluate_statement_text("x + y", VALUES)
