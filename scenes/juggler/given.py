"""Numbers as they are given: taken exactly and within their ranges, or refused in one line with the
value and what is allowed.
"""

from __future__ import annotations

import math
import re
from fractions import Fraction
from typing import TypeAlias

import numpy as np

from scenes.errors import SceneError

Number: TypeAlias = int | float | str | Fraction  # a float means the binary number that it is
BITS = (
    14000  # of a numerator or denominator that is given; Python writes numbers of up to 4300 digits
)
_LONG_POWER = re.compile(
    r"e[+-]?[\d_]{6,}", re.IGNORECASE
)  # Fraction would write all its digits out
_FINITE = "is no finite number; give an integer, a fraction or a finite float"


def rational(value: Number, name: str) -> Fraction:
    """The number exactly; SceneError for what is none.

    >>> rational("1/3", "x"), rational(0.5, "x")
    (Fraction(1, 3), Fraction(1, 2))
    """
    too_long = SceneError(f"{name} is longer than {BITS} bits; choose a shorter number")
    if isinstance(value, (np.integer, np.floating)):
        value = value.item()
    if isinstance(value, bool) or not isinstance(value, (int, float, str, Fraction)):
        raise SceneError(f"{name} = {brief(value)} {_FINITE}")
    if isinstance(value, str) and (len(value) > BITS or _LONG_POWER.search(value)):
        raise too_long
    try:
        found = Fraction(value)
    except (ValueError, OverflowError, ZeroDivisionError):
        raise SceneError(f"{name} = {brief(value)} {_FINITE}") from None
    if max(found.numerator.bit_length(), found.denominator.bit_length()) > BITS:
        raise too_long
    return found


def height(value: Number, name: str = "x") -> Fraction:
    """A height, which is at least 0."""
    found = rational(value, name)
    if found < 0:
        raise SceneError(f"{name} = {brief(found)} is below the table; a state has {name} >= 0")
    return found


def positive(value: Number, name: str) -> Fraction:
    """The launch speed r or gravity g, which are greater than 0."""
    found = rational(value, name)
    if found <= 0:
        raise SceneError(
            f"{name} = {brief(found)} is not positive; the launch speed r and gravity g are"
        )
    return found


def restitution(alpha: Number) -> Fraction:
    """The restitution, strictly between 0 and 1."""
    found = rational(alpha, "alpha")
    if not 0 < found < 1:
        raise SceneError(
            f"alpha = {brief(found)} is not between 0 and 1; the restitution has 0 < alpha < 1"
        )
    return found


def counted(value: int, name: str, least: int, most: int) -> int:
    """A whole number within its bounds."""
    if (
        isinstance(value, bool)
        or not isinstance(value, (int, np.integer))
        or not least <= value <= most
    ):
        raise SceneError(f"{name} = {brief(value)} is not a whole number from {least} to {most}")
    return int(value)


def brief(value: object) -> str:
    """What was given, in one line of 40 signs at most.

    >>> brief(Fraction(1, 3)), brief(10**5000), brief("a\\nb")
    ('1/3', 'a number of 16610 bits', 'a b')
    """
    if isinstance(value, (int, Fraction)):
        bits = max(value.numerator.bit_length(), value.denominator.bit_length())
        return str(value) if bits <= 132 else f"a number of {bits} bits"
    return "".join(sign if sign.isprintable() else " " for sign in str(value)[:40])


def nearest(value: Fraction) -> tuple[float, float]:
    """A float next to the number, and a bound on their difference, itself rounded up; infinities
    for what is beyond the floats.

    >>> nearest(Fraction(1, 2)), 0 < nearest(Fraction(1, 3))[1] < 2**-54
    ((0.5, 0.0), True)
    """
    try:
        found = float(value)
    except OverflowError:
        return math.inf, math.inf
    missed = abs(value - Fraction(found))
    return found, math.nextafter(float(missed), math.inf) if missed else 0.0
