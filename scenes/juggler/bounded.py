"""Arrays of float64 with a proved bound on their distance to the exact numbers (running error
analysis).

A `Bounded` is an array v of floats and an array e >= 0 of floats with |exact - v| <= e, entry by
entry.  Let u = 2^-53 be the unit roundoff, fl a rounded result (IEEE 754 binary64, to nearest, with
gradual underflow), and X = x + dx, Y = y + dy the exact numbers, |dx| <= e_x, |dy| <= e_y.

- Sum, z = fl(x + y): |fl(a) - a| <= u |fl(a)|, and sums do not underflow inexactly.  So |X + Y - z|
<= e_x + e_y + u |z|.
- Product, z = fl(x y): the same, and 2^-1075 more where it underflows.  So |X Y - z| <= |x| e_y +
|y| e_x + e_x e_y + u |z| + 2^-1075.
- Quotient, z = fl(x/y), where |y| > e_y: X/Y - x/y = (dx - (x/y) dy)/Y and |x/y| <= |z| (1 + 2 u) +
2^-1074.
  So |X/Y - z| <= (e_x + (|z| (1 + 2 u) + 2^-1074) e_y)/(|y| - e_y) + u |z| + 2^-1075; infinite
  elsewhere.
- The bounds are themselves computed in floats: sums, products and quotients of numbers >= 0, at
most 9 roundings deep, so that what is computed is at
  least (1 - u)^9 times the bound less what underflows; |y| - e_y is first lowered by 4 u |y|, which
  is more than its rounding, and 2^-1065 is added to what is divided by it.  Each bound is
  multiplied by 1 + 2^-49 = 1 + 16 u and 2^-1065 is added: more than (1 - u)^-10, and more than all
  underflows (each at most 2^-1075, fewer than 8).

An overflow makes v infinite or not a number, and e too: no comparison then holds, and the sign is
not decided.  Numbers that come in are whole numbers below 2^53, which are exact, or have their
distance to the exact number as their bound.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from scenes.juggler.given import nearest

Floats: TypeAlias = NDArray[np.float64]
Booleans: TypeAlias = NDArray[np.bool_]
U = 2.0**-53
UP, TINY = 1 + 2.0**-49, 2.0**-1065


def _raised(bound: Any) -> Any:
    """The bound, made larger than all roundings of its own computation."""
    return bound * UP + TINY


@dataclass(frozen=True, slots=True)
class Bounded:
    """Floats v and bounds e on their distance to the exact numbers, of one shape."""

    v: Any
    e: Any

    @staticmethod
    def of(value: Fraction) -> Bounded:
        """The float next to a rational, with what it misses."""
        found, missed = nearest(value)
        return Bounded(np.float64(found), np.float64(missed))

    def __add__(self, other: Bounded | int | Any) -> Bounded:
        two = _bounded(other)
        z = self.v + two.v
        return Bounded(z, _raised(self.e + two.e + U * abs(z)))

    __radd__ = __add__

    def __neg__(self) -> Bounded:
        return Bounded(-self.v, self.e)

    def __sub__(self, other: Bounded | int | Any) -> Bounded:
        two = _bounded(other)
        z = self.v - two.v
        return Bounded(z, _raised(self.e + two.e + U * abs(z)))

    def __rsub__(self, other: int | Any) -> Bounded:
        return _bounded(other) - self

    def __mul__(self, other: Bounded | int | Any) -> Bounded:
        two = _bounded(other)
        z = self.v * two.v
        return Bounded(
            z, _raised(abs(self.v) * two.e + abs(two.v) * self.e + self.e * two.e + U * abs(z))
        )

    __rmul__ = __mul__

    def __truediv__(self, other: Bounded | int | Any) -> Bounded:
        two = _bounded(other)
        z = self.v / two.v
        size = abs(two.v)
        least = (size - two.e) - 4 * U * size
        bound = _raised(
            (self.e + (abs(z) * (1 + 2 * U) + TINY) * two.e + TINY)
            / np.where(least > 0, least, np.nan)
            + U * abs(z)
        )
        return Bounded(z, np.where(least > 0, bound, np.inf))

    def is_positive(self) -> Booleans:
        """Where the exact number is proved to be positive."""
        return np.asarray(self.v > self.e)

    def is_negative(self) -> Booleans:
        """Where the exact number is proved to be negative."""
        return np.asarray(-self.v > self.e)

    def at(self, places: Any) -> Bounded:
        """The entries at these places."""
        return Bounded(self.v[places], self.e[places])

    def put(self, places: Any, values: Bounded) -> None:
        """Puts entries in at these places."""
        self.v[places], self.e[places] = values.v, values.e


def _bounded(value: Bounded | int | Any) -> Bounded:
    """A whole number below 2^53, or whole floats, as exact."""
    if isinstance(value, Bounded):
        return value
    if isinstance(value, int) and abs(value) >= 2**53:
        raise OverflowError(f"{value} is no float")
    return Bounded(value, 0.0)


def powers(value: Bounded, exponents: NDArray[np.int64]) -> Bounded:
    """The number, one for all, to each of the whole exponents >= 0, by squaring."""
    found = Bounded(np.ones(len(exponents)), np.zeros(len(exponents)))
    left = exponents.copy()
    while left.any():
        odd = (left & 1) == 1
        found.put(odd, found.at(odd) * value)
        left >>= 1
        if left.any():
            value = value * value
    return found
