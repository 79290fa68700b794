"""Rationals top / (rest q^k) that are not brought to lowest terms, q being the denominator of
alpha.

An impact multiplies by alpha, so that on an orbit only k grows: sums and products of such numbers
need no greatest common divisor, which would take most of the time where the numbers have thousands
of digits.  What has piled up of q above and below is taken out now and then.
"""

from __future__ import annotations

from bisect import bisect_left
from typing import Any

from flint import fmpq, fmpz

RECENT = 16  # powers that are kept


class Powers:
    """q^k, the recent ones kept: the next is one short product away."""

    def __init__(self, q: int) -> None:
        self.q, self.recent = fmpz(q), {0: fmpz(1)}

    def __getitem__(self, k: int) -> Any:
        found = self.recent.get(k)
        if found is None:
            before = self.recent.get(k - 1)
            found = self.recent[k] = self.q**k if before is None else before * self.q
            if len(self.recent) > RECENT:
                self.recent.pop(next(iter(self.recent)))
        return found


class Ratio:
    """top / (rest q^k), rest > 0; adds, subtracts and multiplies with its like and with whole
    numbers, and with fmpq as an fmpq.

    >>> some = Ratio.of(fmpq(3, 56), Powers(10))
    >>> some.top, some.rest, some.k, lowest(3 - some * some - 1)
    (375, 7, 3, 6263/3136)
    """

    __slots__ = ("k", "powers", "rest", "top")

    def __init__(self, top: Any, rest: Any, k: int, powers: Powers) -> None:
        self.top, self.rest, self.k, self.powers = top, rest, k, powers

    @staticmethod
    def of(value: Any, powers: Powers) -> Ratio:
        """The fmpq over as small a power of q as there is, and what has no factor of q."""
        common = value.q.gcd(pow(powers.q, value.q.bit_length(), value.q))
        k = bisect_left(
            range(common.bit_length()), True, key=lambda k: not pow(powers.q, k, common)
        )
        return Ratio(value.p * (powers[k] // common), value.q // common, k, powers)

    def bottom(self) -> Any:
        """rest q^k."""
        return self.rest * self.powers[self.k]

    def bits(self) -> int:
        """The bits of top or of bottom, whichever has more."""
        return int(
            max(self.top.height_bits(), self.rest.height_bits() + self.powers[self.k].height_bits())
        )

    def _plus(self, other: Any, sign: int) -> Any:
        if isinstance(other, int):
            return Ratio(self.top + sign * other * self.bottom(), self.rest, self.k, self.powers)
        if not isinstance(other, Ratio):
            return lowest(self) + sign * other if isinstance(other, fmpq) else NotImplemented
        one, two, rest, k = self.top, other.top, self.rest, self.k
        if self.k < other.k:
            one, k = one * self.powers[other.k - self.k], other.k
        elif other.k < self.k:
            two *= self.powers[self.k - other.k]
        if self.rest != other.rest:
            rest = self.rest * other.rest // self.rest.gcd(other.rest)
            one, two = one * (rest // self.rest), two * (rest // other.rest)
        return Ratio(one + two if sign > 0 else one - two, rest, k, self.powers)

    def __add__(self, other: Any) -> Any:
        return self._plus(other, 1)

    def __sub__(self, other: Any) -> Any:
        return self._plus(other, -1)

    def __neg__(self) -> Ratio:
        return Ratio(-self.top, self.rest, self.k, self.powers)

    def __rsub__(self, other: Any) -> Any:
        return (-self)._plus(other, 1)

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, int):
            return Ratio(self.top * other, self.rest, self.k, self.powers)
        if not isinstance(other, Ratio):
            return lowest(self) * other if isinstance(other, fmpq) else NotImplemented
        return Ratio(self.top * other.top, self.rest * other.rest, self.k + other.k, self.powers)

    __radd__, __rmul__ = __add__, __mul__


def lowest(value: Any) -> Any:
    """The number as an fmpq, which is in lowest terms; an fmpq as it is."""
    return fmpq(value.top, value.bottom()) if isinstance(value, Ratio) else value


def shortened(value: Ratio) -> Ratio:
    """The number without the powers of q that top and bottom have in common.

    >>> shortened(Ratio(fmpz(3000), fmpz(7), 5, Powers(10))).k
    2
    """
    top, k = value.top, value.k
    if not top:
        return Ratio(top, fmpz(1), 0, value.powers)
    step = 1 << k.bit_length()
    while step:
        if step <= k:
            quotient, left = divmod(top, value.powers.q**step)
            if not left:
                top, k = quotient, k - step
        step //= 2
    return Ratio(top, value.rest, k, value.powers)
