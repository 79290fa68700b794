"""Blocks on a still table: on which face each comes to rest, and at which starting angle the two
are parted.

Both are decided by geometry: a block that starts at rest on a corner falls to the side on which its
centre is, and that is parted at atan(a/b). The paper says that 0 to 26 degrees go to 0 and 27 to 90
degrees to 90; so the sides that it shows are as 1 to 2.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from math import atan, degrees, floor, radians

from scenes.errors import SceneError
from scenes.part import body
from scenes.part.ensemble import run
from scenes.part.setting import Scene, standing

DEGREES = tuple(range(91))
LAST_UPRIGHT, FIRST_LYING = 26, 27  # of the paper, in degrees
WIDTH = 1e-9  # degrees
MOST_HALVINGS = 60
LONGEST = 64.0  # seconds until all are at rest


@dataclass(frozen=True)
class Split:
    """Where blocks end that start at 0 to 90 degrees; starting angles, in degrees, that end at 0
    and at 90; and atan(a/b), which parts them.
    """

    ends: tuple[int, ...]
    upright: float
    lying: float
    exact: float

    def as_printed(self) -> bool:
        """Whether 0 to 26 degrees end at 0, and 27 to 90 degrees at 90."""
        return self.ends == (0,) * (LAST_UPRIGHT + 1) + (90,) * (len(DEGREES) - FIRST_LYING)


def no_vibration(setting: Scene, executor: Executor | None = None) -> Split:
    """The split of a scene's block on a still table, bisected to 1e-9 degrees between the two
    neighbours that end apart.

    >>> block = Scene(0.01, 0.02, 0.5, 0.3, 0, 0, 0, 0, 0, 0, 9.81, 1e-12, 1e-3, "rest")
    >>> found = no_vibration(block)
    >>> found.as_printed(), found.upright < found.exact < found.lying, round(found.lying, 6)
    (True, True, 26.565051)
    """
    still = replace(setting, A_x=0.0, f_x=0.0, phase_x=0.0, A_y=0.0, f_y=0.0, phase_y=0.0)
    ends = ends_of(still, DEGREES, executor)
    first = ends.count(0)
    if ends != [0] * first + [90] * (len(ends) - first) or first in (0, len(ends)):
        raise SceneError(
            f"the blocks from 0 to 90 degrees are not parted once: {first} end upright,"
            f" {len(ends) - first} lying"
        )
    low, high = float(first - 1), float(first)
    for _ in range(MOST_HALVINGS):
        if high - low <= WIDTH:
            break
        middle = (low + high) / 2
        if ends_of(still, [middle])[0] == 90:
            high = middle
        else:
            low = middle
    return Split(tuple(ends), low, high, degrees(atan(setting.a / setting.b)))


def ends_of(still: Scene, starts: Sequence[float], executor: Executor | None = None) -> list[int]:
    """The angle, 0 or 90 degrees, at which blocks come to rest that start at these angles, in
    degrees; SceneError where one does not.
    """
    states, notes, until = standing(still, [radians(start) for start in starts]), None, 1.0
    while until <= LONGEST:
        done = run(still, states, until, notes=notes, executor=executor)
        states, notes, until = done.states, done.notes, 2 * until
        if (states[:, body.MODE] == body.FACE).all():
            return [90 * (floor(turns + 0.5) % 2) for turns in states[:, body.THETA] / body.QUARTER]
    moving = next(start for start, mode in zip(starts, states[:, body.MODE]) if mode != body.FACE)
    raise SceneError(
        f"the block that starts at {moving:g} degrees is not at rest after {LONGEST:g} s; e ="
        f" {still.e:g} is too near to 1"
    )


def in_words(found: Split) -> str:
    """Where blocks end on a still table, and where they part.

    >>> found = Split((0,) * 27 + (90,) * 64, 26.56, 26.57, 26.565)
    >>> print(in_words(found))  # doctest: +NORMALIZE_WHITESPACE
    Without vibration 27 blocks, 0 to 26 degrees, end upright, and 64, 27 to 90 degrees, lie, as the
    paper says. The two part
    between 26.5600000000 and 26.5700000000 degrees; atan(a/b) is 26.5650000000 degrees.
    """
    up, count = found.ends.index(90), len(found.ends)
    printed = (
        "as the paper says" if found.as_printed() else "where the paper says 0 to 26 and 27 to 90"
    )
    return (
        f"Without vibration {up} blocks, 0 to {up - 1} degrees, end upright, and {count - up}, {up}"
        f" to {count - 1} degrees, lie, {printed}. The two part between {found.upright:.10f} and"
        f" {found.lying:.10f} degrees; atan(a/b) is {found.exact:.10f} degrees."
    )
