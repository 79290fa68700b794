"""Enclosures of a polynomial on a box in Arb's balls: natural interval extension and mean value
form.

A box is a tuple of dyadic sides (m, r, e): the interval [(m - r) 2^e, (m + r) 2^e].  An undecided
comparison of balls is False, whichever way it is asked, so `surely` alone decides; powers are
products, because arb(0, 1)**2 is nan.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from fractions import Fraction
from functools import cached_property

from flint import arb, arf, ctx, fmpz_mpoly

from juggleproof.algebra import limits
from juggleproof.algebra.polynomials import used_in

Side = tuple[int, int, int]
Box = tuple[Side, ...]
Slopes = Mapping[int, arb]  # the number of a variable -> the partial derivative's enclosure


def ends(side: Side) -> tuple[Fraction, Fraction]:
    """The exact ends of a side.

    >>> ends((1, 1, -1))
    (Fraction(0, 1), Fraction(1, 1))
    """
    m, r, e = side
    unit = Fraction(2) ** e
    return (m - r) * unit, (m + r) * unit


def middle(box: Box) -> list[Fraction]:
    """The exact middle of the box."""
    return [m * Fraction(2) ** e for m, _, e in box]


def split(box: Box, i: int) -> tuple[Box, Box]:
    """The two halves of the box along the i-th side; their ends are dyadic again."""
    m, r, e = box[i]
    if r % 2:
        m, r, e = 2 * m, 2 * r, e - 1
    first, second = (m - r // 2, r // 2, e), (m + r // 2, r // 2, e)
    return (*box[:i], first, *box[i + 1 :]), (*box[:i], second, *box[i + 1 :])


def widest(box: Box, among: Sequence[int]) -> int:
    """The number of the widest of the sides named; of equal ones, the first."""
    return max(among, key=lambda i: (box[i][1] * Fraction(2) ** box[i][2], -i))


def working_precision() -> AbstractContextManager[object]:
    """A context in which balls carry 64 bits, whatever is set outside: so votes do not depend on
    what ran before.
    """
    context: AbstractContextManager[object] = ctx.workprec(limits.PRECISION)
    return context


# -------------------------------------------------------------------------------------------------
# Balls.


def ball(side: Side) -> arb:
    """The side as a ball, exactly."""
    m, r, e = side
    return arb(arf((m, e)), arf((r, e)))


def ball_ends(value: arb) -> tuple[Fraction, Fraction] | None:
    """Exact rational ends of the ball; None where it is not finite."""
    if not value.is_finite():
        return None
    return _dyadic(value.lower()), _dyadic(value.upper())


def _dyadic(value: arb) -> Fraction:
    man, exp = value.mid().man_exp()
    return int(man) * Fraction(2) ** int(exp)


def surely(value: arb, relation: str) -> bool | None:
    """Whether number relation 0 holds for every number of the ball (True), or for none (False);
    None where the ball does not decide it.

    >>> [surely(arb(2, 1), r) for r in (">", "=")], surely(arb(0, 1), ">=")
    ([True, False], None)
    """
    if relation == ">":
        return True if value > 0 else False if value <= 0 else None
    if relation == ">=":
        return True if value >= 0 else False if value < 0 else None
    if value > 0 or value < 0:
        return relation == "!="
    return None


# -------------------------------------------------------------------------------------------------
# Polynomials on boxes.


class Placed:
    """One box: the powers of its sides and of its middle, computed when they are asked for."""

    def __init__(self, box: Box) -> None:
        self.box = box
        self.tables: tuple[dict[int, list[arb]], dict[int, list[arb]]] = ({}, {})

    def powers(self, needed: Sequence[tuple[int, int]], at_middle: bool) -> dict[int, list[arb]]:
        """Lists of 1, x_i, x_i^2, ... up to the degrees needed, given as (i, degree)."""
        table = self.tables[at_middle]
        for i, degree in needed:
            if i not in table:
                m, r, e = self.box[i]
                table[i] = [arb(1), ball((m, 0 if at_middle else r, e))]
            row = table[i]
            while len(row) <= degree:
                row.append(row[-1] * row[1])
        return table

    def around(self, value: arb, slopes: Slopes, at: Mapping[int, int] | None = None) -> arb:
        """value + sum slope_i (x_i - c_i) over the box, where c_i is the middle, or the low (-1) or
        high (1) end of the side.
        """
        for i, slope in slopes.items():
            _, r, e = self.box[i]
            value = value + slope * ball((-r * at.get(i, 0) if at else 0, r, e))
        return value

    def point(self, at: Mapping[int, int]) -> Placed:
        """The point with these ends of the sides (-1, 1), or their middles, as a box whose middle
        it is.
        """
        return Placed(tuple((m + r * at.get(i, 0), 0, e) for i, (m, r, e) in enumerate(self.box)))

    def half(self, i: int) -> float:
        """Half the i-th side, for choices only."""
        _, r, e = self.box[i]
        return float(r * 2.0**e)


class Enclosed:
    """A polynomial made ready for many boxes."""

    def __init__(self, poly: fmpz_mpoly) -> None:
        self.poly = poly
        self.terms = [
            (arb(c), [(i, int(e)) for i, e in enumerate(monomial) if e])
            for monomial, c in zip(poly.monoms(), poly.coeffs())
        ]
        degrees = poly.degrees()
        self.used = used_in(poly)
        self.needed = [(i, int(degrees[i])) for i in self.used]

    def _value(self, placed: Placed, at_middle: bool) -> arb:
        powers = placed.powers(self.needed, at_middle)
        total: arb | None = None
        for c, factors in self.terms:
            for i, e in factors:
                c = c * powers[i][e]
            total = c if total is None else total + c
        return arb(0) if total is None else total

    def natural(self, placed: Placed) -> arb:
        """The natural interval extension: the polynomial's enclosure on the box, term by term."""
        return self._value(placed, False)

    def at(self, placed: Placed) -> arb:
        """The polynomial's enclosure at the middle of the box."""
        return self._value(placed, True)

    @cached_property
    def slopes(self) -> dict[int, Enclosed]:
        """The partial derivatives by the variables that occur."""
        return {i: Enclosed(self.poly.derivative(i)) for i in self.used}

    def centred(self, placed: Placed) -> tuple[arb, dict[int, arb], arb]:
        """The mean value form p(m) + sum p_i(box) (x_i - m_i), the enclosures p_i(box) for the
        sides that are no points, and p(m).

        Source: Moore, Kearfott, Cloud, Introduction to Interval Analysis (2009), 6.4.
        """
        at_middle = self.at(placed)
        slopes = {i: slope.natural(placed) for i, slope in self.slopes.items() if placed.box[i][1]}
        return placed.around(at_middle, slopes), slopes, at_middle

    def sharp_slopes(self, placed: Placed) -> dict[int, arb]:
        """Enclosures of the partial derivatives on the box by their own mean value forms, where
        these are narrower.
        """
        enclosures = {}
        for i, slope in self.slopes.items():
            if placed.box[i][1]:
                natural, centred = slope.natural(placed), slope.centred(placed)[0]
                enclosures[i] = min(natural, centred, key=lambda value: float(value.rad()))
        return enclosures
