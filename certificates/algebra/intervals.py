"""Enclosures of a polynomial on a box, in either of two interval arithmetics: natural and mean
value form, intersected.

A box is a tuple of dyadic sides (m, r, e): the interval [(m - r) 2^e, (m + r) 2^e].  No comparison
of intervals is used here but by `surely`, whose answer False means "undecided" and nothing else.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager
from fractions import Fraction
from functools import cached_property
from importlib import import_module
from typing import Any

from juggleproof.certificates.votes.questions import Atom, Polynomial

Side = tuple[int, int, int]
Box = tuple[Side, ...]
PRECISION = 64


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


def working_precision() -> AbstractContextManager[Any]:
    """A context in which balls carry 64 bits, whatever is set outside: so votes do not depend on
    what ran before.
    """
    context: AbstractContextManager[Any] = import_module("flint").ctx.workprec(PRECISION)
    return context


class Balls:
    """python-flint's `arb`: midpoint and radius.  An undecided comparison is False there, whichever
    way it is asked.
    """

    name = "arb"

    def __init__(self) -> None:
        flint: Any = import_module("flint")
        self.arb, self.arf = flint.arb, flint.arf

    def side(self, side: Side) -> Any:
        m, r, e = side
        return self.arb(self.arf((m, e)), self.arf((r, e)))

    def point(self, side: Side) -> Any:
        return self.arb(self.arf((side[0], side[2])))

    def integer(self, value: int) -> Any:
        return self.arb(value)

    def below_zero(self, value: Any) -> bool:
        return (value < 0) is True

    def at_most_zero(self, value: Any) -> bool:
        return (value <= 0) is True

    def ends(self, value: Any) -> tuple[Fraction, Fraction] | None:
        """Exact rational ends of the enclosure; None where it is not finite."""
        if not value.is_finite():
            return None
        return _dyadic(value.lower()), _dyadic(value.upper())

    def size(self, value: Any) -> Any:
        """An upper bound of the absolute value, for choices only."""
        return value.abs_upper()


class Ends:
    """`mpmath.iv`: two ends.  An undecided comparison is None there, so only `is True` decides."""

    name = "mpmath.iv"

    def __init__(self) -> None:
        self.iv: Any = import_module("mpmath").ctx_iv.MPIntervalContext()
        self.iv.prec = PRECISION

    def side(self, side: Side) -> Any:
        low, high = ends(side)
        return self.iv.mpf([self._exact(low).a, self._exact(high).b])

    def point(self, side: Side) -> Any:
        return self._exact(ends((side[0], 0, side[2]))[0])

    def _exact(self, value: Fraction) -> Any:
        return self.iv.mpf(value.numerator) / self.iv.mpf(value.denominator)

    def integer(self, value: int) -> Any:
        return self.iv.mpf(value)

    def below_zero(self, value: Any) -> bool:
        return (value < 0) is True

    def at_most_zero(self, value: Any) -> bool:
        return (value <= 0) is True

    def ends(self, value: Any) -> tuple[Fraction, Fraction] | None:
        """Exact rational ends of the enclosure; None where it is not finite."""
        low, high = (_from_mpf(raw) for raw in value._mpi_)
        return None if low is None or high is None else (low, high)


def _dyadic(value: Any) -> Fraction:
    man, exp = value.man_exp() if hasattr(value, "man_exp") else value.mid().man_exp()
    return int(man) * Fraction(2) ** int(exp)


def _from_mpf(raw: tuple[int, Any, int, int]) -> Fraction | None:
    sign, man, exp, _ = raw
    if not man and exp:
        return None  # an infinity or nan: mantissa 0 with an exponent that marks it
    return (-1 if sign else 1) * int(man) * Fraction(2) ** int(exp)


Kernel = Balls | Ends


class Placed:
    """One box in one arithmetic: the powers of its sides and of its middle, computed when they are
    asked for.
    """

    def __init__(self, kernel: Kernel, box: Box) -> None:
        self.kernel, self.box = kernel, box
        self.tables: tuple[dict[int, list[Any]], dict[int, list[Any]]] = ({}, {})

    def powers(self, needed: Sequence[tuple[int, int]], at_middle: bool) -> dict[int, list[Any]]:
        """Lists of 1, x_i, x_i^2, ... up to the degrees needed; powers are products, because arb(0,
        1)**2 is nan.
        """
        table = self.tables[at_middle]
        for i, degree in needed:
            if i not in table:
                table[i] = [
                    self.kernel.integer(1),
                    self.kernel.point(self.box[i]) if at_middle else self.kernel.side(self.box[i]),
                ]
            row = table[i]
            while len(row) <= degree:
                row.append(row[-1] * row[1])
        return table

    def around(self, value: Any, slopes: dict[int, Any], ends: dict[int, int] | None = None) -> Any:
        """value + sum slope_i (x_i - c_i) over the box, where c_i is the middle, or the low (-1) or
        high (1) end of the side.
        """
        for i, slope in slopes.items():
            _, r, e = self.box[i]
            value = value + slope * self.kernel.side((-r * ends.get(i, 0) if ends else 0, r, e))
        return value

    def point(self, ends: dict[int, int]) -> Placed:
        """The point with these ends of the sides, or their middles, as a box whose middle it is."""
        return Placed(
            self.kernel,
            tuple((m + r * ends.get(i, 0), 0, e) for i, (m, r, e) in enumerate(self.box)),
        )

    def half(self, i: int) -> float:
        """Half the i-th side, for choices only."""
        _, r, e = self.box[i]
        return float(r * 2.0**e)


Prepared = tuple[list[tuple[int, int]], list[tuple[Any, list[tuple[int, int]]]]]


def _prepare(kernel: Kernel, poly: Polynomial) -> Prepared:
    """The degree in each variable that occurs, and the terms as (coefficient, [(variable,
    exponent)]).
    """
    terms = [
        (kernel.integer(c), [(i, e) for i, e in enumerate(exponents) if e])
        for exponents, c in poly.terms
    ]
    return [(i, poly.degrees[i]) for i in poly.used], terms


class Fact:
    """An atom made ready for many boxes."""

    def __init__(self, kernel: Kernel, fact: Atom) -> None:
        self.kernel, self.atom = kernel, fact
        self.terms = _prepare(kernel, fact.poly)
        self.bound = (
            sum(fact.poly.degrees) == 1
        )  # x > c: the box itself says it but for its edge, so no cut is made for its sake

    @cached_property
    def slopes(self) -> list[tuple[int, Prepared]]:
        """The partial derivatives by the variables that occur."""
        poly = self.atom.poly
        return [(i, _prepare(self.kernel, poly.derivative(i))) for i in poly.used]

    def natural(self, placed: Placed) -> Any:
        """The polynomial's enclosure on the box, term by term."""
        return _evaluate(self.kernel, self.terms, placed, False)

    def at(self, placed: Placed) -> Any:
        """The polynomial's enclosure at the middle of the box."""
        return _evaluate(self.kernel, self.terms, placed, True)

    def centred(self, placed: Placed) -> tuple[Any, dict[int, Any], Any]:
        """The mean value form p(m) + sum p_i(box) (x_i - m_i), the enclosures p_i(box) for the
        sides that are no points, and p(m).
        """
        at_middle = _evaluate(self.kernel, self.terms, placed, True)
        slopes = {
            i: _evaluate(self.kernel, slope, placed, False)
            for i, slope in self.slopes
            if placed.box[i][1]
        }
        return placed.around(at_middle, slopes), slopes, at_middle

    @cached_property
    def curvatures(self) -> dict[int, Fact]:
        """The partial derivatives as facts of their own, for enclosures of second order."""
        return {
            i: Fact(self.kernel, Atom(self.atom.poly.derivative(i), ">="))
            for i in self.atom.poly.used
        }

    def sharp_slopes(self, placed: Placed) -> dict[int, Any]:
        """Enclosures of the partial derivatives on the box by their own mean value forms, where
        these are narrower.
        """
        found = {}
        for i, slope in self.curvatures.items():
            if placed.box[i][1]:
                natural, centred = slope.natural(placed), slope.centred(placed)[0]
                found[i] = min(natural, centred, key=lambda value: float(value.rad()))
        return found

    def fails(self, value: Any) -> bool:
        """Whether the fact surely fails for every number in the enclosure; False says nothing."""
        kernel, relation = self.kernel, self.atom.relation
        if relation == ">":
            return kernel.at_most_zero(value)
        if relation == ">=":
            return kernel.below_zero(value)
        return relation == "=" and (kernel.below_zero(value) or kernel.below_zero(-value))

    def holds(self, value: Any) -> bool:
        """Whether the fact surely holds for every number in the enclosure; False says nothing."""
        kernel, relation = self.kernel, self.atom.relation
        if relation == ">":
            return kernel.below_zero(-value)
        if relation == ">=":
            return kernel.at_most_zero(-value)
        return relation == "!=" and (kernel.below_zero(value) or kernel.below_zero(-value))


def _evaluate(kernel: Kernel, prepared: Prepared, placed: Placed, at_middle: bool) -> Any:
    needed, terms = prepared
    powers = placed.powers(needed, at_middle)
    total: Any = None
    for c, factors in terms:
        for i, e in factors:
            c = c * powers[i][e]
        total = c if total is None else total + c
    return kernel.integer(0) if total is None else total


def split(box: Box, i: int) -> tuple[Box, Box]:
    """The two halves of the box along the i-th side; their ends are dyadic again."""
    m, r, e = box[i]
    if r % 2:
        m, r, e = 2 * m, 2 * r, e - 1
    first, second = (m - r // 2, r // 2, e), (m + r // 2, r // 2, e)
    return (*box[:i], first, *box[i + 1 :]), (*box[:i], second, *box[i + 1 :])


def widest(box: Box, among: Sequence[int]) -> int:
    """The widest of the sides named."""
    return max(among, key=lambda i: (box[i][1] * Fraction(2) ** box[i][2], -i))
