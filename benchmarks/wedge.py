"""The share of the wedge that the stored certificates cover.  The wedge is the area, in alpha and
Gamma, between the curve of a second orbit and that of period doubling, from alpha = 0.02 to where
these meet.

    python -m juggleproof.benchmarks.wedge
    python -m juggleproof.benchmarks.wedge --accept     # writes the table into the page

The certificates are read; `python -I -S certificates/sine certificates/sine/wide` checks them.  The
area is added up in floats, as the curves are.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import floor
from typing import NamedTuple

from juggleproof.benchmarks.generated import DOCS, Generated, in_columns
from juggleproof.certificates.sine.checker import Box
from juggleproof.scenes.table.curves import doubling, gamma_of, grazing
from juggleproof.sine.stored import WIDE, boxes_in

TABLE = Generated(DOCS / "sine.md", "wedge")
STEP = Fraction(1, 4000)  # of alpha
ENDS = tuple(map(Fraction, ("0.02", "0.05", "0.1", "0.15", "0.18")))  # they meet before the last


class Area(NamedTuple):
    """Areas in alpha and Gamma: between the curves, and in certified boxes."""

    wedge: float
    certified: float


def area(low: Fraction, high: Fraction, boxes: Sequence[Box]) -> Area:
    """The areas for alpha between two ends, by the middles of steps."""
    wedge = certified = 0.0
    for number in range(int((high - low) / STEP)):
        alpha = low + STEP * number + STEP / 2
        at = float(alpha)
        wedge += doubling(at) - grazing(at)
        for least, most in united([g for ends, g in boxes if ends[0] <= alpha <= ends[1]]):
            certified += gamma_of(at, float(most)) - gamma_of(at, float(least))
    return Area(wedge * float(STEP), certified * float(STEP))


def united(intervals: Sequence[tuple[Fraction, Fraction]]) -> list[tuple[Fraction, Fraction]]:
    """Intervals without common points that have the same union.

    >>> united([(2, 4), (0, 1), (3, 5), (1, 1)])
    [(0, 1), (2, 5)]
    """
    found: list[tuple[Fraction, Fraction]] = []
    for low, high in sorted(intervals):
        if found and low <= found[-1][1]:
            found[-1] = found[-1][0], max(found[-1][1], high)
        else:
            found.append((low, high))
    return found


def rows() -> Iterator[tuple[str, ...]]:
    """The table, with its head."""
    yield "alpha", "certified share of the wedge"
    boxes: list[Box] = [(one.alpha, one.g) for one in boxes_in(WIDE)]
    areas = [area(low, high, boxes) for low, high in zip(ENDS, ENDS[1:])]
    for low, high, one in zip(ENDS, ENDS[1:], areas):
        end = "the end" if high == ENDS[-1] else f"{float(high):g}"
        yield f"{float(low):g} to {end}", percent(one)
    yield "all", percent(Area(*map(sum, zip(*areas))))


def percent(one: Area) -> str:
    """The share that is certified, rounded down."""
    return f"{floor(100 * one.certified / one.wedge)}%"


def table() -> str:
    """The table as the page has it."""
    return in_columns(*rows())


if __name__ == "__main__":
    TABLE.main(table)
