"""Exact evaluation of derived expressions, shared by the tests of this folder."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest

Value = Callable[..., Fraction]


@pytest.fixture(scope="session")
def value() -> Value:
    """value(expression, alpha=..., beta=..., ...): the exact number that an expression has at
    rational arguments.
    """
    from sympy import Rational, Symbol

    def evaluate(expression: Any, **arguments: Fraction) -> Fraction:
        exact = {
            Symbol(name): Rational(a.numerator, a.denominator) for name, a in arguments.items()
        }
        found = Rational(expression.xreplace(exact))  # refuses what is not rational
        return Fraction(int(found.p), int(found.q))

    return evaluate
