"""A scene of the juggler, and what is to be followed of its orbits."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from scenes.errors import SceneError
from scenes.juggler.given import Number, brief, counted, positive, restitution
from scenes.juggler.states import Starts

Unit = Literal["periods", "impacts"]
MOST_STEPS = 10**18


@dataclass(frozen=True)
class Scene:
    """Restitution, launch speed of the table, gravity, and starting states; made by `scene`."""

    alpha: Fraction
    r: Fraction
    g: Fraction
    starts: Starts


def scene(alpha: Number, starts: Starts, r: Number = 1, g: Number = 1) -> Scene:
    """A scene: 0 < alpha < 1, r > 0 and g > 0; numbers are exact, floats the binary numbers that
    they are.

    >>> from scenes.juggler import point
    >>> scene("1/3", point(0, 3)).alpha
    Fraction(1, 3)
    """
    if not isinstance(starts, Starts):
        raise SceneError(
            f"starts = {brief(starts)} are no starting states; give point(x, w), grid(..),"
            " random(..) or another of this package"
        )
    return Scene(restitution(alpha), positive(r, "r"), positive(g, "g"), starts)


@dataclass(frozen=True)
class Goal:
    """How far an orbit is followed: so many periods, or impacts; or until it is in the trap, if
    that comes first.
    """

    steps: int
    unit: Unit = "periods"
    until_trap: bool = False

    def left(self, periods: int, impacts: int) -> int:
        """How many of its steps are left."""
        return self.steps - (periods if self.unit == "periods" else impacts)


def goal(steps: int, impacts: bool = False, until_trap: bool = False) -> Goal:
    """The goal; SceneError for a number of steps below 0."""
    return Goal(
        counted(steps, "steps", 0, MOST_STEPS), "impacts" if impacts else "periods", until_trap
    )
