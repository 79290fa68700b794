"""On which face parts come to rest: probabilities for a distribution of starts, with intervals.

Parts start with their lowest corner on the table, are shaken for some time, and then the table
stops at once: each part goes on as fast as it was, and falls on a still table until it lies.  So
every part has a face on which it rests, also where the vibration never lets it lie.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from math import sqrt
from statistics import NormalDist

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body
from juggleproof.scenes.part.columns import Column, Shown, graphs
from juggleproof.scenes.part.ensemble import run
from juggleproof.scenes.part.layout import vibration
from juggleproof.scenes.part.setting import Array, Scene, centre_heights, standing
from juggleproof.scenes.part.shape import geometry

Report = Callable[[int, int], None]
Interval = tuple[float, float]
CONFIDENCE = 0.95
MOST_PARTS = 1_000_000
JITTER = 1e-6  # degrees, either way, of starts that are drawn from a list
SETTLING = (1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0)  # seconds on the still table, until all lie
MOVING = -1  # instead of a face, for a part that does not lie by then

# -------------------------------------------------------------------------------------------------
# The face at the end, starts, and intervals.


def resting_faces(
    setting: Scene, states: Array, executor: Executor | None = None
) -> NDArray[np.int64]:
    """The face on which each part, of states (n, 10), comes to rest where the table stops at once;
    MOVING for a part that does not lie after 64 s.
    """
    still = replace(setting, A_x=0.0, A_y=0.0, drive=None)
    p = setting.parameters().tolist()
    after = states.copy()
    after[:, body.MODE :] = 0.0  # in flight: what lies is as fast as the table was
    for k, t in enumerate(states[:, body.TIME].tolist()):
        after[k, body.Y] -= body.table_height(p, t)
        after[k, body.X] -= body.table_place(p, t)
    least = centre_heights(setting, after[:, body.THETA])
    after[:, body.Y] = np.maximum(after[:, body.Y], least)  # what sank by less than the tolerance
    after[:, body.TIME] = 0.0
    for until in SETTLING:
        going = after[:, body.MODE] != body.FACE
        if not going.any():
            break
        after[going] = run(still, after[going], until, executor=executor).states
    faces = after[:, body.CORNER].astype(np.int64)
    return np.where(after[:, body.MODE] == body.FACE, faces, MOVING)


@dataclass(frozen=True)
class Starts:
    """A distribution of starting angles, in degrees: even over an interval, or over a list, where
    each is moved by at most a millionth of a degree, for equal starts have equal ends.
    """

    angles: tuple[float, ...]
    even: bool

    def drawn(self, parts: int, seed: int) -> Array:
        """So many angles, in radians, drawn independently; SceneError for another number."""
        if not 1 <= parts <= MOST_PARTS:
            raise SceneError(f"parts = {parts} is outside 1 .. {MOST_PARTS}")
        draws = np.random.default_rng(seed)
        if self.even:
            low, high = self.angles
            even: Array = np.radians(draws.uniform(low, high, parts))
            return even
        moved = draws.uniform(-JITTER, JITTER, parts)
        some: Array = np.radians(draws.choice(np.array(self.angles), parts) + moved)
        return some

    def in_words(self) -> str:
        """The distribution in words.

        >>> between(0, 360).in_words(), listed([0, 90]).in_words()
        ('evenly from 0 to 360 degrees', 'from 0, 90 degrees')
        """
        if self.even:
            return "evenly from {:g} to {:g} degrees".format(*self.angles)
        first = ", ".join(f"{one:g}" for one in self.angles[:6])
        return f"from {first}{', ..' if len(self.angles) > 6 else ''} degrees"


def between(low: float, high: float) -> Starts:
    """Angles that are even over an interval, in degrees; SceneError for one without width."""
    if not -360 <= low < high <= 360:
        raise SceneError(
            f"angles from {low:g} to {high:g}: give ends that grow, within -360 .. 360"
        )
    return Starts((float(low), float(high)), True)


def listed(angles: Sequence[float]) -> Starts:
    """Angles of a list, in degrees, each as probable as the others; SceneError for an empty one."""
    if not angles or not all(-360 <= one <= 360 for one in angles):
        raise SceneError("angles: give at least one, within -360 .. 360 degrees")
    return Starts(tuple(map(float, angles)), False)


ANY_ANGLE = between(0, 360)


def wilson(hits: int, count: int, confidence: float = CONFIDENCE) -> Interval:
    """The interval of Wilson (1927) for a probability of which `hits` of `count` independent trials
    tell: (p + z^2/2n -+ z sqrt(p (1 - p)/n + z^2/4n^2))/(1 + z^2/n), with p = hits/n.

    >>> [round(end, 4) for end in wilson(8, 10)], [round(end, 4) for end in wilson(0, 100)]
    ([0.4902, 0.9433], [0.0, 0.037])
    """
    z = NormalDist().inv_cdf((1 + confidence) / 2)
    share, part = hits / count, z * z / count
    half = sqrt(share * (1 - share) * part + part * part / 4)
    low, high = ((share + part / 2 + way * half) / (1 + part) for way in (-1, 1))
    return (low if hits else 0.0), (high if hits < count else 1.0)


# -------------------------------------------------------------------------------------------------
# Orientation.


@dataclass(frozen=True)
class Orientation(Shown):
    """On how many of the parts each face is below at the end; and how many lie on none."""

    setting: Scene
    starts: Starts
    shaken: float
    counts: tuple[int, ...]
    moving: int

    def parts(self) -> int:
        """How many parts there were."""
        return sum(self.counts) + self.moving

    def share(self, face: int) -> tuple[float, float, float]:
        """The share of the parts that rest on a face, and the interval of its probability."""
        return self.counts[face] / self.parts(), *wilson(self.counts[face], self.parts())

    def title(self) -> str:
        return (
            f"{self.parts()} parts that start {self.starts.in_words()}, shaken for"
            f" {self.shaken:g} s; {vibration(self.setting)}"
        )

    def columns(self) -> Sequence[Column]:
        around = np.array(self.setting.polygon().corners)
        sides = np.hypot(*(np.roll(around, -1, axis=0) - around).T)
        found = np.array([self.share(face) for face in range(len(self.counts))])
        return (
            Column("face", "", np.arange(len(self.counts))),
            Column("length", "m", sides),
            Column("theta", "degrees", 360 * np.array(geometry(self.setting.polygon()).turns)),
            Column("parts", "", np.array(self.counts)),
            Column("share", "", found[:, 0]),
            Column("low", "", found[:, 1]),
            Column("high", "", found[:, 2]),
        )

    def picture(self) -> bytes:
        drawing, count = graphs(), len(self.counts)
        note = f"{self.parts()} parts that start {self.starts.in_words()}"
        none = f"; {self.moving} rest on none" if self.moving else ""
        drawn: bytes = drawing.shares(
            "orientation",
            range(count),
            [self.share(face) for face in range(count)],
            "face on which parts rest",
            (
                f"On which face parts rest after {self.shaken:g} s; {note}",
                f"{vibration(self.setting)}; bars: 95 %{none}",
            ),
            {k: f"{k}: {1e3 * side:g} mm" for k, side in enumerate(self.columns()[1].values)},
        )
        return drawn


def orientation(
    setting: Scene,
    starts: Starts = ANY_ANGLE,
    *,
    parts: int = 1000,
    shaken: float = 12.0,
    seed: int = 1,
    executor: Executor | None = None,
    report: Report | None = None,
) -> Orientation:
    """How often parts, drawn from a distribution of starts, come to rest on each face after being
    shaken for so many seconds, none at all for 0; `report` as in `run`.  SceneError for numbers out
    of range.

    >>> from juggleproof.scenes.part.setting import scene
    >>> orientation(scene(e=0.5, mu=0.3), listed([90]), parts=4, shaken=0.0).counts
    (0, 0, 0, 4)
    """
    states = standing(setting, starts.drawn(parts, seed))
    if shaken != 0:
        states = run(setting, states, shaken, executor=executor, report=report).states
    faces = resting_faces(setting, states, executor)
    counts = [int((faces == face).sum()) for face in range(len(setting.polygon().corners))]
    return Orientation(setting, starts, shaken, tuple(counts), int((faces == MOVING).sum()))
