"""Arcs of parabolas, segments among them, as numbers; loads no SymPy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

Real: TypeAlias = Fraction | float
Place: TypeAlias = tuple[Real, Real]  # a state (beta, v) or (x, w), or a point
Point = tuple[float, float]
Quadratic = tuple[float, float, float]  # coefficients from the constant up


@dataclass(frozen=True)
class Arc:
    """An arc of a parabola: two quadratics of one parameter (coefficients from the constant up),
    from its start to its stop.
    """

    across: Quadratic
    up: Quadratic
    start: float
    stop: float

    def at(self, parameter: float) -> Point:
        """The point with this parameter."""
        return at(self.across, parameter), at(self.up, parameter)

    def slope(self, parameter: float) -> Point:
        """The derivative there."""
        return _slope(self.across, parameter), _slope(self.up, parameter)

    def bezier(self) -> tuple[Point, Point, Point]:
        """Start, control point and stop of the same arc as a quadratic Bezier curve, exactly.

        >>> Arc((0, 1, 0), (0, 0, 1), 0, 2).bezier()
        ((0, 0), (1.0, 0.0), (2, 4))
        """
        half = (self.stop - self.start) / 2
        (x, y), (dx, dy) = self.at(self.start), self.slope(self.start)
        return (x, y), (x + dx * half, y + dy * half), self.at(self.stop)

    def part(self, start: float, stop: float) -> Arc:
        """The part between two parameters."""
        return Arc(self.across, self.up, start, stop)

    def reverse(self) -> Arc:
        """The same arc, run through the other way."""
        return self.part(self.stop, self.start)


def at(quadratic: Quadratic, s: float) -> float:
    """The value of a quadratic."""
    return quadratic[0] + s * (quadratic[1] + s * quadratic[2])


def _slope(quadratic: Quadratic, s: float) -> float:
    return quadratic[1] + 2 * s * quadratic[2]


def straight(start: Place, stop: Place) -> Arc:
    """The segment from one point to another."""
    (a, b), (c, d) = start, stop
    return Arc((float(a), float(c - a), 0.0), (float(b), float(d - b), 0.0), 0.0, 1.0)


def joined(points: Sequence[Place]) -> list[Arc]:
    """The segments from each point to the next."""
    return [straight(a, b) for a, b in zip(points, points[1:])]
