"""Covers a rectangle of parameters by boxes, each with a certificate; not believed."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from .checker import (
    Box,
    Rectangle,
    check_line,
    g_at,
)
from .flights import Interval
from .search import find_certificate, line_of

START = Fraction(1, 200), Fraction(1, 50)  # the widths of the boxes that are tried first
# of a box that is wider: so many columns, and rows of a unit of speed
GRIDS = ((Fraction(3, 1000), 512, 32), (Fraction(1, 1000), 1024, 64), (Fraction(1, 4000), 2048, 64))


class Tried(NamedTuple):
    """box: of (alpha, g); line: its certificate, as the checker took it, or "" for the reason."""

    box: Box
    line: str
    reason: str
    cells: int


def grid_of(box: Box) -> tuple[int, int] | None:
    """The columns and rows of a unit of speed on which a box is tried; None where it is so narrow
    that it is given up.
    """
    width = max(end - start for start, end in box)
    for least, columns, per_unit in GRIDS:
        if width > least:
            return columns, per_unit
    return None


def try_box(box: Box) -> Tried:
    """Looks for a certificate of the theorem for a box, and has the checker read it."""
    columns, per_unit = grid_of(box) or (0, 0)
    found = find_certificate(*box, columns, per_unit)
    if found.certificate is None:
        return Tried(box, "", found.reason, found.cells)
    line = line_of(found.certificate)
    proved, reason = check_line(line)
    return Tried(box, line if proved else "", reason, found.cells)


def g_between(rectangle: Rectangle, alpha: Interval) -> Interval:
    """Bounds of g for an interval of alpha within the rectangle."""
    low, high = rectangle.values
    if rectangle.drive == "g":
        return low, high
    ends = g_at(alpha[0], low, up=False), g_at(alpha[1], high, up=True)
    return (
        Fraction(int(ends[0] * 10**6), 10**6), -(-ends[1] * 10**6 // 1) / Fraction(10**6)
    )  # fmt: skip


def cut(interval: Interval, width: Fraction) -> list[Interval]:
    """The interval in the fewest equal parts no wider than this."""
    low, high = interval
    parts = max(1, -int(-(high - low) / width // 1))
    ends = [low + (high - low) * n / parts for n in range(parts + 1)]
    return list(zip(ends, ends[1:]))


def first_boxes(rectangle: Rectangle) -> list[Box]:
    """Boxes that cover the rectangle."""
    return [
        (alpha, g)
        for alpha in cut(rectangle.alpha, START[0])
        for g in cut(g_between(rectangle, alpha), START[1])
    ]


def halves(rectangle: Rectangle, box: Box) -> Iterator[Box]:
    """A box cut across its longer side, but for what is outside the rectangle."""
    alpha, g = box
    if alpha[1] - alpha[0] > g[1] - g[0]:
        parts = [(half, g) for half in cut(alpha, (alpha[1] - alpha[0]) / 2)]
    else:
        parts = [(alpha, half) for half in cut(g, (g[1] - g[0]) / 2)]
    for one_alpha, one_g in parts:
        low, high = g_between(rectangle, one_alpha)
        low, high = max(low, one_g[0]), min(high, one_g[1])
        if low < high:
            yield one_alpha, (low, high)
