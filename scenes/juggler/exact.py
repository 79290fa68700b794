"""Orbits in exact rationals.

Numbers are python-flint's fmpq, which from a few dozen digits on are faster than Fraction, and from
a few hundred on `Ratio`s, which are faster still; results are told as Fraction.  They grow by the
length of alpha with every impact, also in the trap, where the closed form is exact too.  They stay
within a stated length, or the orbit ends there.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import isqrt
from typing import Any

from flint import fmpq, fmpz

from scenes.errors import SceneError
from scenes.juggler.formulas import formulas
from scenes.juggler.ratios import Powers, Ratio, lowest, shortened
from scenes.juggler.track import Sample, Stop, Track

MOST_BITS = 2**23  # of a numerator or denominator on an orbit
FEW_BITS, MANY_BITS = (
    2**10,
    2**16,
)  # from where on `Ratio`s are faster; from where on an fmpq, such as a start, is left as it is
PLACES = 64  # binary, of what only guesses are made from


def lifted(value: Fraction) -> Any:
    """The rational as python-flint's."""
    return fmpq(value.numerator, value.denominator)


def told(value: Any) -> Fraction:
    """A rational of an exact orbit, or of python-flint, as a Fraction.

    >>> told(lifted(Fraction(-2, 3)))
    Fraction(-2, 3)
    """
    value = lowest(value)
    return _coprime(int(value.p), int(value.q))


def _of_coprime() -> Callable[[int, int], Fraction]:
    """Fraction without its greatest common divisor, which takes seconds for a million digits and is
    1 here: fmpq is in lowest terms.
    """
    quick: Callable[[int, int], Fraction] | None = getattr(
        Fraction, "_from_coprime_ints", None
    )  # from Python 3.12 on
    if quick is not None:
        return quick
    whole: Any = Fraction
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

    def lift(self, value: Fraction) -> Any:
        return lifted(value)

    def sign(self, value: Any) -> int | None:
        top = value.top if isinstance(value, Ratio) else value
        return int(top > 0) - int(top < 0)

    def middle(self, value: Any) -> Any:
        """The number cut off after 64 binary places, which takes no greatest common divisor."""
        top, bottom = (
            (value.top, value.bottom()) if isinstance(value, Ratio) else (value.p, value.q)
        )
        return fmpq((top << PLACES) // bottom, fmpz(1) << PLACES)

    def power(self, value: Any, exponent: int) -> Any:
        base = lowest(value)
        if exponent * base.height_bits() > self.most_bits:
            raise Stop("too long")
        self.due = self.most_bits  # this is the last move
        return base**exponent

    def check(self, track: Track) -> None:
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

    def _shorten(self, track: Track) -> None:
        """Makes long numbers `Ratio`s, takes out what they have in common with q, and makes those
        fmpq that are short then.
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

    def settle(self, track: Track) -> int:
        raise AssertionError("exact numbers have signs")


def _bits(track: Track) -> int:
    return max(
        part.bits() if isinstance(part, Ratio) else part.height_bits() for part in track.here[2:]
    )


def finished(sample: Sample) -> Sample:
    """The sample with numbers of python-flint, in lowest terms."""
    return sample._replace(x=lowest(sample.x), w=lowest(sample.w))


def strikes(x: Fraction, w: Fraction) -> bool:
    """Whether the period that starts at this state has an impact, by (7): x < w.

    >>> strikes(Fraction(1), Fraction(1))
    False
    """
    return bool(formulas().margin(x, w) > 0)


def impact(alpha: Fraction, x: Fraction, w: Fraction) -> tuple[Fraction, Fraction]:
    """f1, by (10): the state after a period with an impact.

    >>> impact(Fraction(1, 2), Fraction(1), Fraction(2))
    (Fraction(1, 2), Fraction(1, 1))
    """
    there: tuple[Fraction, Fraction] = formulas().impact(alpha, x, w)
    return there


def flight(x: Fraction, w: Fraction, periods: int) -> tuple[Fraction, Fraction]:
    """f2 so many times, by (12): the state after so many periods without an impact.

    >>> flight(Fraction(3), Fraction(-3), 2)
    (Fraction(7, 1), Fraction(1, 1))
    """
    there: tuple[Fraction, Fraction] = formulas().flight(x, w, periods)
    return there


def flight_length(x: Fraction, w: Fraction) -> int:
    """How many periods without an impact follow: the least K >= 0 with K^2 + K (w + 1) + w - x > 0.

    >>> flight_length(Fraction(1), Fraction(1))
    1
    >>> flight_length(Fraction(10) ** 300, Fraction(1)) - 10**150
    0
    """
    if strikes(x, w):
        return 0
    b, square = formulas().end_of_flight(x, w)
    length = max(
        (isqrt(square // 1) - b) // 2 + 1, 1
    )  # not above the length, and at most one below
    while not strikes(*flight(x, w, length)):
        length += 1
    if length > 1 and strikes(*flight(x, w, length - 1)):
        raise SceneError("the closed form of a flight does not tell its end")
    return int(length)


def later(alpha: Fraction, x: Fraction, w: Fraction, periods: int) -> tuple[Fraction, Fraction]:
    """f1 so many times: f1^n(e_1 + (p, q)) = e_1 + (-alpha)^n (p - n q, q); an orbit of f from a
    state of the trap.

    >>> alpha, x, w = Fraction(1, 2), Fraction(0), Fraction(1)
    >>> later(alpha, x, w, 2) == impact(alpha, *impact(alpha, x, w))
    True
    """
    there: tuple[Fraction, Fraction] = formulas().later(
        x, w, *formulas().fixed(alpha), periods, (-alpha) ** periods
    )
    return there
