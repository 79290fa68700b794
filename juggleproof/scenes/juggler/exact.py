"""Orbits in exact rationals, not in lowest terms where that is faster, and in mpmath numbers."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable
from fractions import Fraction
from math import isqrt
from typing import TypeAlias

from flint import fmpq, fmpz
from mpmath import MPContext, mpf

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler.compiled_map import formulas
from juggleproof.scenes.juggler.track import Sample, Stop, Track

# -------------------------------------------------------------------------------------------------
# Rationals not in lowest terms.
#
# Rationals top / (rest q^k) that are not brought to lowest terms, q being the denominator of alpha.
#
# An impact multiplies by alpha, so that on an orbit only k grows: sums and products of such numbers
# need no greatest common divisor, which would take most of the time where the numbers have
# thousands of digits.  The powers of q that pile up above and below are taken out now and then.

RECENT = 16  # powers that are kept


class Powers:
    """The powers q^k.  Recent ones are kept, so that the next takes one short product."""

    def __init__(self, q: int) -> None:
        self.q, self.recent = fmpz(q), {0: fmpz(1)}

    def __getitem__(self, k: int) -> fmpz:
        power = self.recent.get(k)
        if power is None:
            before = self.recent.get(k - 1)
            power = self.recent[k] = self.q**k if before is None else before * self.q
            if len(self.recent) > RECENT:
                self.recent.pop(next(iter(self.recent)))
        return power


class Ratio:
    """The number top / (rest q^k), rest > 0.  It can be added, subtracted and multiplied with its
    like and with whole numbers; with an fmpq the result is an fmpq.

    >>> some = Ratio.of(fmpq(3, 56), Powers(10))
    >>> some.top, some.rest, some.k, lowest(3 - some * some - 1)
    (375, 7, 3, 6263/3136)
    """

    __slots__ = ("k", "powers", "rest", "top")

    def __init__(self, top: fmpz, rest: fmpz, k: int, powers: Powers) -> None:
        self.top, self.rest, self.k, self.powers = top, rest, k, powers

    @staticmethod
    def of(value: fmpq, powers: Powers) -> Ratio:
        """The fmpq with the least k for which `rest` has no factor in common with q."""
        common = value.q.gcd(pow(powers.q, value.q.bit_length(), value.q))
        k = bisect_left(
            range(common.bit_length()), True, key=lambda k: not pow(powers.q, k, common)
        )
        return Ratio(value.p * (powers[k] // common), value.q // common, k, powers)

    def bottom(self) -> fmpz:
        """rest q^k."""
        return self.rest * self.powers[self.k]

    def bits(self) -> int:
        """The bits of top or of bottom, whichever has more."""
        return int(
            max(self.top.height_bits(), self.rest.height_bits() + self.powers[self.k].height_bits())
        )

    def _plus(self, other: Rational | int, sign: int) -> Rational:
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

    def __add__(self, other: Rational | int) -> Rational:
        return self._plus(other, 1)

    def __sub__(self, other: Rational | int) -> Rational:
        return self._plus(other, -1)

    def __neg__(self) -> Ratio:
        return Ratio(-self.top, self.rest, self.k, self.powers)

    def __rsub__(self, other: Rational | int) -> Rational:
        return (-self)._plus(other, 1)

    def __mul__(self, other: Rational | int) -> Rational:
        if isinstance(other, int):
            return Ratio(self.top * other, self.rest, self.k, self.powers)
        if not isinstance(other, Ratio):
            return lowest(self) * other if isinstance(other, fmpq) else NotImplemented
        return Ratio(self.top * other.top, self.rest * other.rest, self.k + other.k, self.powers)

    __radd__, __rmul__ = __add__, __mul__


Rational: TypeAlias = Ratio | fmpq  # of an exact orbit


def lowest(value: Rational) -> fmpq:
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


# -------------------------------------------------------------------------------------------------
# Orbits in exact rationals.
#
# Numbers are python-flint's fmpq, which from a few dozen digits on are faster than Fraction, and
# from a few hundred on `Ratio`s, which are faster still; results are given as Fraction.  They grow
# by the length of alpha with every impact, also in the trap, where the closed form is exact too.
# They stay within a stated length, or the orbit ends there.

MOST_BITS = 2**23  # of a numerator or denominator on an orbit
# bits from which on `Ratio`s are faster; bits from which on an fmpq, such as a start, stays one
FEW_BITS, MANY_BITS = 2**10, 2**16
PLACES = 64  # binary places of a number that only guesses are made from


def lifted(value: Fraction) -> fmpq:
    """The rational as python-flint's."""
    return fmpq(value.numerator, value.denominator)


def as_fraction(value: Rational) -> Fraction:
    """A rational of an exact orbit, or of python-flint, as a Fraction.

    >>> as_fraction(lifted(Fraction(-2, 3)))
    Fraction(-2, 3)
    """
    quotient = lowest(value)
    return _coprime(int(quotient.p), int(quotient.q))


def _of_coprime() -> Callable[[int, int], Fraction]:
    """Fraction without its greatest common divisor, which takes seconds for a million digits and is
    1 here: fmpq is in lowest terms.
    """
    # from Python 3.12 on
    quick: Callable[[int, int], Fraction] | None = getattr(Fraction, "_from_coprime_ints", None)
    if quick is not None:
        return quick
    whole: Callable[..., Fraction] = Fraction
    try:
        whole(1, 2, _normalize=False)
    except TypeError:
        return Fraction
    return lambda top, bottom: whole(top, bottom, _normalize=False)


_coprime = _of_coprime()


class Exact:
    """Rationals: every sign is decided."""

    def __init__(self, alpha: Fraction, most_bits: int = MOST_BITS) -> None:
        self.alpha, self.powers = lifted(alpha), Powers(alpha.denominator)
        self.most_bits, self.due = most_bits, FEW_BITS

    def lift(self, value: Fraction) -> Rational:
        return lifted(value)

    def sign(self, value: Rational) -> int:
        top = value.top if isinstance(value, Ratio) else value
        return int(top > 0) - int(top < 0)

    def middle(self, value: Rational) -> fmpq:
        """The number cut off after 64 binary places, which takes no greatest common divisor."""
        top, bottom = (
            (value.top, value.bottom()) if isinstance(value, Ratio) else (value.p, value.q)
        )
        return fmpq((top << PLACES) // bottom, fmpz(1) << PLACES)

    def power(self, alpha: Rational, exponent: int) -> Rational:
        base = -lowest(alpha)
        if exponent * base.height_bits() > self.most_bits:
            raise Stop("too long")
        self.due = self.most_bits  # this is the last move
        return base**exponent

    def check(self, track: Track[Rational]) -> None:
        bits = _bits(track)
        if bits > self.due and (bits < MANY_BITS or isinstance(track.here.x, Ratio)):
            self._shorten(track)
            bits = _bits(track)
            self.due = max(2 * bits, FEW_BITS)
        if (
            bits > self.most_bits
            and max(lowest(part).height_bits() for part in track.here[2:]) > self.most_bits
        ):
            raise Stop("too long")

    def _shorten(self, track: Track[Rational]) -> None:
        """Turns long numbers into `Ratio`s, takes out common powers of q, and turns those that are
        then short into fmpq.
        """
        x, w = (
            shortened(part if isinstance(part, Ratio) else Ratio.of(part, self.powers))
            for part in track.here[2:]
        )
        if max(x.bits(), w.bits()) > FEW_BITS // 2:
            track.here, track.alpha = (
                track.here._replace(x=x, w=w),
                Ratio.of(self.alpha, self.powers),
            )
        else:
            track.here, track.alpha = track.here._replace(x=lowest(x), w=lowest(w)), self.alpha

    def decide(self, track: Track[Rational]) -> int:
        raise AssertionError("exact numbers have signs")


def _bits(track: Track[Rational]) -> int:
    return max(
        part.bits() if isinstance(part, Ratio) else part.height_bits() for part in track.here[2:]
    )


def finished(sample: Sample[Rational]) -> Sample[Rational]:
    """The sample with numbers of python-flint, in lowest terms."""
    return sample._replace(x=lowest(sample.x), w=lowest(sample.w))


def strikes(x: Fraction, w: Fraction) -> bool:
    """Whether the period that starts at this state has an impact, by (7): x < w.

    >>> strikes(Fraction(1), Fraction(1))
    False
    """
    return formulas().margin(x, w) > 0


def impact(alpha: Fraction, x: Fraction, w: Fraction) -> tuple[Fraction, Fraction]:
    """f1, by (10): the state after a period with an impact.

    >>> impact(Fraction(1, 2), Fraction(1), Fraction(2))
    (Fraction(1, 2), Fraction(1, 1))
    """
    return formulas().impact(alpha, x, w)


def flight(x: Fraction, w: Fraction, periods: int) -> tuple[Fraction, Fraction]:
    """The power of f2, by (12): the state after this number of periods without an impact.

    >>> flight(Fraction(3), Fraction(-3), 2)
    (Fraction(7, 1), Fraction(1, 1))
    """
    return formulas().flight(x, w, periods)


def flight_length(x: Fraction, w: Fraction) -> int:
    """How many periods without an impact follow: the least K >= 0 with K^2 + K (w + 1) + w - x > 0;
    raises SceneError where the closed form does not give it.

    >>> flight_length(Fraction(1), Fraction(1))
    1
    >>> flight_length(Fraction(10) ** 300, Fraction(1)) - 10**150
    0
    """
    if strikes(x, w):
        return 0
    b, square = formulas().end_of_flight(x, w)
    # not above the length, and at most one below
    length = max((isqrt(square // 1) - b) // 2 + 1, 1)
    while not strikes(*flight(x, w, length)):
        length += 1
    if length > 1 and strikes(*flight(x, w, length - 1)):
        raise SceneError("the closed form of a flight does not give its end")
    return length


def impact_power(
    alpha: Fraction, x: Fraction, w: Fraction, periods: int
) -> tuple[Fraction, Fraction]:
    """The power of f1: f1^n(e_1 + (p, q)) = e_1 + (-alpha)^n (p - n q, q) for n periods.  From a
    state of the trap this is an orbit of f.

    >>> alpha, x, w = Fraction(1, 2), Fraction(0), Fraction(1)
    >>> impact_power(alpha, x, w, 2) == impact(alpha, *impact(alpha, x, w))
    True
    """
    power = (-alpha) ** periods
    return formulas().impact_power(x, w, *formulas().fixed(alpha), periods, power)


# -------------------------------------------------------------------------------------------------
# Orbits in mpmath numbers.
#
# Numbers with a given number of digits: fast at any precision, and nothing is proved.
#
# Branches are decided by the rounded state.  The length of a flight is that of the rounded state
# exactly, by whole square roots.

DIGITS = 50


class HighPrecision:
    """Numbers of a context of its own, so that mpmath's global precision is left alone."""

    def __init__(self, digits: int = DIGITS) -> None:
        self.context = MPContext()
        self.context.dps = digits

    def lift(self, value: Fraction) -> mpf:
        return self.context.mpf(value.numerator) / value.denominator

    def sign(self, value: mpf) -> int:
        return int(value > 0) - int(value < 0)

    def middle(self, value: mpf) -> fmpq:
        """The rounded number as a rational, which it is."""
        sign, mantissa, exponent, _ = value._mpf_
        top = fmpz(-mantissa if sign else mantissa)
        return (
            fmpq(top * fmpz(2) ** exponent, 1) if exponent >= 0 else fmpq(top, fmpz(2) ** -exponent)
        )

    def power(self, alpha: mpf, exponent: int) -> mpf:
        return (-alpha) ** exponent

    def check(self, track: Track[mpf]) -> None:
        """Nothing has to stop."""

    def decide(self, track: Track[mpf]) -> int:
        raise AssertionError("rounded numbers have signs")
