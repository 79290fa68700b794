"""Where two pieces of a line meet: polynomials whose signs tell them apart."""

from __future__ import annotations

from flint import fmpq, fmpq_poly

from .algebraic import AlgebraicNumber, polynomial_text, simplest_between
from .ranges import Interval


def linear_text(value: fmpq, parameter: str) -> str:
    """A polynomial of degree 1 that rises through 0 at a rational."""
    lead = parameter if value.q == 1 else f"{int(value.q)}*{parameter}"
    return (
        lead
        if value == 0
        else f"{lead} - {int(value.p)}"
        if value > 0
        else f"{lead} + {-int(value.p)}"
    )


def cut_between(left: Interval, right: Interval, parameter: str) -> tuple[str, int | None] | None:
    """(a polynomial that rises through the border of two pieces, which of them has the border
    itself; None: neither).
    """
    high, low = left.high, right.low
    if high is None or low is None:
        end = high if high is not None else low
        if end is None:
            return linear_text(fmpq(0), parameter), 0
        value = (
            simplest_between(end._low - 1, end._low)
            if low is None
            else simplest_between(end._high, end._high + 1)
        )
        return linear_text(value, parameter), 0
    if low < high:
        bottom = max(low._high, left.low._high) if left.low is not None else low._high
        return linear_text(simplest_between(bottom, high._low), parameter), 0
    if high < low:
        return linear_text(simplest_between(high._high, low._low), parameter), None
    middle = 0 if left.high_closed else 1 if right.low_closed else None
    if high.is_rational:
        return linear_text(high._low, parameter), middle
    return _rising_text(high, parameter), middle


def _rising_text(number: AlgebraicNumber, parameter: str) -> str:
    """The polynomial of the number with the sign that makes it rise there."""
    rising = number.sign_of(fmpq_poly(number.poly).derivative()) > 0
    if rising:
        return number.polynomial_text(parameter)
    return polynomial_text([-c for c in number.coefficients], parameter)
