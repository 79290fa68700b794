"""Interval branch and bound, in Arb's balls and in mpmath's intervals, by the same steps.  It is
rigorous, but leaves nothing that one could check.

A box is done where the excess is certainly >= 0, by its natural extension or by its mean-value
form; a variable in which it is monotone is put to its end; else the axis is halved along which
slope times side is largest.  Source: Moore, Kearfott, Cloud, Introduction to Interval Analysis
(2009).

Each kind of number loads its library when it is first made: the time of a first answer has this.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Protocol, Union

from juggleproof.algebra.box_trees import Terms
from juggleproof.benchmarks.bench.answers import SHARE, Answer, BoundQuestion, GaveUp, best_point

if TYPE_CHECKING:
    from flint import arb
    from mpmath.ctx_iv import ivmpf

Ball = Union["arb", "ivmpf"]  # a number that encloses
BITS = 128
Side = tuple[Fraction, Fraction]  # both ends are equal if the variable is put to an end


class Intervals(Protocol):
    """Numbers that enclose, of one library."""

    def over(self, low: Fraction, high: Fraction) -> Ball:
        """A number that encloses [low, high]."""
        ...

    def least(self, value: Ball) -> Ball:
        """Its lower end."""
        ...

    def most(self, value: Ball) -> Ball:
        """Its upper end."""
        ...


class Arb:
    """python-flint's balls."""

    def __init__(self) -> None:
        from flint import arb, ctx, fmpq

        ctx.prec = BITS
        self._arb, self._fmpq = arb, fmpq

    def _of(self, value: Fraction) -> arb:
        return self._arb(self._fmpq(value.numerator, value.denominator))

    def over(self, low: Fraction, high: Fraction) -> arb:
        return self._of(low) if low == high else self._of(low).union(self._of(high))

    def least(self, value: arb) -> arb:
        return value.lower()

    def most(self, value: arb) -> arb:
        return value.upper()


class Mpmath:
    """mpmath's intervals."""

    def __init__(self) -> None:
        from mpmath import iv

        iv.prec = BITS
        self._iv = iv

    def over(self, low: Fraction, high: Fraction) -> ivmpf:
        first, last = (self._iv.mpf(value.numerator) / value.denominator for value in (low, high))
        return self._iv.mpf([first.a, last.b])

    def least(self, value: ivmpf) -> ivmpf:
        return value.a

    def most(self, value: ivmpf) -> ivmpf:
        return value.b


class EnclosedBound:
    """A polynomial and its slopes on boxes."""

    def __init__(self, terms: Terms, size: int, numbers: Intervals) -> None:
        self.numbers = numbers
        slopes = [
            {(*e[:i], e[i] - 1, *e[i + 1 :]): c * e[i] for e, c in terms.items() if e[i]}
            for i in range(size)
        ]
        self.parts = [
            [(numbers.over(c, c), [(i, k) for i, k in enumerate(e) if k]) for e, c in part.items()]
            for part in (terms, *slopes)
        ]
        self.most = [max((e[i] for e in terms), default=0) for i in range(size)]
        self.zero = numbers.over(Fraction(0), Fraction(0))

    def powers(self, sides: Sequence[Side]) -> list[list[Ball]]:
        """The powers of each variable, as products: quicker here than powers of rational ends, and
        no box has a variable of both signs.
        """
        table: list[list[Ball]] = []
        for side, most in zip(sides, self.most):
            row = [None, self.numbers.over(*side)]
            for k in range(2, most + 1):
                row.append(row[k // 2] * row[k - k // 2])
            table.append(row)
        return table

    def value(self, part: int, powers: list[list[Ball]]) -> Ball:
        """The polynomial (part 0) or its slope along axis part - 1."""
        total = self.zero
        for c, factors in self.parts[part]:
            for i, k in factors:
                c = c * powers[i][k]
            total = total + c
        return total


def never_negative(terms: Terms, box: tuple[Side, ...], numbers: Intervals) -> int | None:
    """The number of boxes that show that the polynomial is >= 0 on the box; None if it is not, or
    if it is undecided at a point.
    """
    excess, boxes, stack = EnclosedBound(terms, len(box), numbers), 0, [box]
    while stack:
        sides, boxes = stack.pop(), boxes + 1
        powers = excess.powers(sides)
        value = excess.value(0, powers)
        if numbers.least(value) >= 0:
            continue
        if numbers.most(value) < 0:
            return None
        free = [i for i, (low, high) in enumerate(sides) if low < high]
        if not free:
            return None
        slopes = {i: excess.value(1 + i, powers) for i in free}
        faces = {
            i: sides[i][0] if numbers.least(slope) >= 0 else sides[i][1]
            for i, slope in slopes.items()
            if numbers.least(slope) >= 0 or numbers.most(slope) <= 0
        }
        if faces:
            stack.append(
                tuple((faces[i], faces[i]) if i in faces else side for i, side in enumerate(sides))
            )
        elif not _by_mean_value(excess, sides, slopes, numbers):
            axis = max(
                free,
                key=lambda i: (
                    (abs(numbers.most(slopes[i])) + abs(numbers.least(slopes[i])))
                    * float(sides[i][1] - sides[i][0])
                ),
            )
            low, high = sides[axis]
            middle = (low + high) / 2
            stack += [
                sides[:axis] + (half,) + sides[axis + 1 :]
                for half in ((low, middle), (middle, high))
            ]
    return boxes


def _by_mean_value(
    excess: EnclosedBound, sides: Sequence[Side], slopes: Mapping[int, Ball], numbers: Intervals
) -> bool:
    middles = [(low + high) / 2 for low, high in sides]
    value = excess.value(0, excess.powers([(middle, middle) for middle in middles]))
    for i, slope in slopes.items():
        value = value + slope * numbers.over(sides[i][0] - middles[i], sides[i][1] - middles[i])
    return bool(numbers.least(value) >= 0)


def _enclosed(make: Callable[[], Intervals], problem: BoundQuestion, width: Fraction) -> Answer:
    low = best_point(problem, width / SHARE)[1]
    high = low + width * (SHARE - 1) / SHARE
    boxes = never_negative(problem.excess(high), problem.box, make())
    if boxes is None:
        raise GaveUp("undecided at a point")
    return Answer(low, high, f"{boxes} boxes")


def arb_boxes(problem: BoundQuestion, width: Fraction) -> Answer:
    """Branch and bound in Arb's balls."""
    return _enclosed(Arb, problem, width)


def mpmath_boxes(problem: BoundQuestion, width: Fraction) -> Answer:
    """Branch and bound in mpmath's intervals."""
    return _enclosed(Mpmath, problem, width)
