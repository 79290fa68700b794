"""Orbits in mpmath numbers of so many digits: fast to ask for any precision, and nothing is proved.

Branches are decided by the rounded state.  The length of a flight is that of the rounded state
exactly, by whole square roots.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from flint import fmpq, fmpz
from mpmath import MPContext

from scenes.juggler.track import Track

DIGITS = 50


class HighPrecision:
    """Numbers of a context of its own, so that mpmath's global precision is left alone."""

    def __init__(self, digits: int = DIGITS) -> None:
        self.context = MPContext()
        self.context.dps = digits

    def lift(self, value: Fraction) -> Any:
        return self.context.mpf(value.numerator) / value.denominator

    def sign(self, value: Any) -> int | None:
        return int(value > 0) - int(value < 0)

    def middle(self, value: Any) -> Any:
        """The rounded number as a rational, which it is."""
        sign, mantissa, exponent, _ = value._mpf_
        top = fmpz(-mantissa if sign else mantissa)
        return (
            fmpq(top * fmpz(2) ** exponent, 1) if exponent >= 0 else fmpq(top, fmpz(2) ** -exponent)
        )

    def power(self, value: Any, exponent: int) -> Any:
        return value**exponent

    def check(self, track: Track) -> None:
        """Nothing has to stop."""

    def settle(self, track: Track) -> int:
        raise AssertionError("rounded numbers have signs")
