"""What the pictures of the table have in common: a plane with axes and a title, ticks, lines."""

from __future__ import annotations

from collections.abc import Sequence

from juggleproof.scenes.figures.arcs import Arc, Point, straight
from juggleproof.scenes.figures.drawing import Plane, Sides, blank, ticks

LEFT, BOTTOM, TOP = 48.0, 44.0, 48.0  # points
LETTERS = 8.0


def axes(
    size: tuple[float, float], right: float, across: Sides, up: Sides, title: tuple[str, str]
) -> Plane:
    """A plane in a new figure of this size in points, so much of it left free at the right."""
    width, height = size
    box = (
        LEFT / width,
        BOTTOM / height,
        1 - (LEFT + right) / width,
        1 - (BOTTOM + TOP) / height,
    )
    plane = Plane(blank(width / 72, height / 72), box, across, up)
    plane.words((LEFT, height - 10), title[0], ha="left", fontsize=11)
    plane.words((LEFT, height - 26), title[1], ha="left", fontsize=LETTERS)
    return plane


def spaced(sides: Sides) -> dict[float, str]:
    """Three to seven round numbers within these ends, as ticks."""
    low, high = sides
    step = next(
        part * 10.0**power
        for power in range(-6, 4)
        for part in (1, 2, 5)
        if (high - low) / (part * 10.0**power) <= 7
    )
    first = -int(-low / step) if low < 0 else int(low / step) + (low > 0)
    return ticks(round(k * step, 9) for k in range(first, int(high / step + 1e-9) + 1))


def joined(points: Sequence[Point]) -> list[Arc]:
    """The segments between points."""
    return [straight(a, b) for a, b in zip(points, points[1:])]
