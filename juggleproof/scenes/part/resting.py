"""The faces on which parts come to rest: probabilities for a distribution of starts, with
intervals; and the least drive that leaves no part on stated faces.

Parts start with their lowest corner on the table, are shaken for some time, and then the table
stops at once: each part goes on as fast as it was, and falls on a still table until it lies.  So
every part has a face on which it rests, even if the vibration never lets it lie.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from importlib import import_module
from math import pi, sqrt
from statistics import NormalDist
from typing import Any, BinaryIO, NamedTuple

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body
from juggleproof.scenes.part.ensemble import run
from juggleproof.scenes.part.layout import vibration
from juggleproof.scenes.part.onsets import MOST_POINTS
from juggleproof.scenes.part.setting import Array, Scene, centre_heights, changed, standing
from juggleproof.scenes.part.shape import geometry

Report = Callable[[int, int], None]
Interval = tuple[float, float]
CONFIDENCE = 0.95
MOST_PARTS = 1_000_000
JITTER = 1e-6  # degrees, either way, of starts that are drawn from a list
SETTLING = (1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0)  # seconds on the still table, until all lie
MOVING = -1  # instead of a face, for a part that does not lie by then

# -------------------------------------------------------------------------------------------------
# Results as named columns, and as pictures.


class Column(NamedTuple):
    """One column: its name, its unit ("" if it has none), and its values, one for each row."""

    name: str
    unit: str
    values: NDArray[Any]

    def head(self) -> str:
        """Name and unit, as the head of a column of text.

        >>> Column("t", "s", np.zeros(1)).head(), Column("part", "", np.zeros(1)).head()
        ('t [s]', 'part')
        """
        return f"{self.name} [{self.unit}]" if self.unit else self.name


def write_csv(columns: Sequence[Column], file: BinaryIO) -> None:
    """Writes a line for each row, with floats to the last bit."""
    text = io.TextIOWrapper(file, encoding="utf-8", newline="", write_through=True)
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow([one.head() for one in columns])
    lines.writerows(zip(*(one.values.tolist() for one in columns)))
    text.detach()


def _shares(*given: object) -> bytes:
    """Return the picture of shares that `picture` draws, which loads matplotlib."""
    drawn: bytes = import_module("juggleproof.scenes.part.picture").shares(*given)
    return drawn


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
    after[:, body.MODE :] = 0.0  # in flight: a block that lies is as fast as the table was
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
class RestingStarts:
    """A distribution of starting angles, in degrees: even over an interval, or over a list, where
    each is moved by at most a millionth of a degree, for equal starts have equal ends.
    """

    angles: tuple[float, ...]
    even: bool

    def drawn(self, parts: int, seed: int) -> Array:
        """Angles in radians, one for each part, drawn independently; raises SceneError for a
        number of parts out of range.
        """
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


def between(low: float, high: float) -> RestingStarts:
    """Angles that are even over an interval, in degrees; raises SceneError if it has no width."""
    if not -360 <= low < high <= 360:
        raise SceneError(
            f"angles from {low:g} to {high:g}: give ends that grow, within -360 .. 360"
        )
    return RestingStarts((float(low), float(high)), True)


def listed(angles: Sequence[float]) -> RestingStarts:
    """Angles of a list, in degrees, each as probable as the others; raises SceneError for an empty
    one.
    """
    if not angles or not all(-360 <= one <= 360 for one in angles):
        raise SceneError("angles: give at least one, within -360 .. 360 degrees")
    return RestingStarts(tuple(map(float, angles)), False)


ANY_ANGLE = between(0, 360)


def wilson(hits: int, count: int, confidence: float = CONFIDENCE) -> Interval:
    """The interval of Wilson (1927) for a probability, from `hits` in n = `count` independent
    trials: (p + z^2/2n -+ z sqrt(p (1 - p)/n + z^2/4n^2))/(1 + z^2/n), with p = hits/n.

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
class Orientation:
    """The number of parts that lie on each face at the end, and of those that lie on none."""

    setting: Scene
    starts: RestingStarts
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
        """Return how many parts there were, their starts, and how they were shaken."""
        return (
            f"{self.parts()} parts that start {self.starts.in_words()}, shaken for"
            f" {self.shaken:g} s; {vibration(self.setting)}"
        )

    def columns(self) -> Sequence[Column]:
        """Return columns with a row for each face: its side, its angle when it lies, its share."""
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
        """Return the shares with their intervals, as SVG."""
        count = len(self.counts)
        note = f"{self.parts()} parts that start {self.starts.in_words()}"
        none = f"; {self.moving} rest on none" if self.moving else ""
        return _shares(
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


def orientation(
    setting: Scene,
    starts: RestingStarts = ANY_ANGLE,
    *,
    parts: int = 1000,
    shaken: float = 12.0,
    seed: int = 1,
    executor: Executor | None = None,
    report: Report | None = None,
) -> Orientation:
    """How often parts, drawn from a distribution of starts, come to rest on each face after being
    shaken for `shaken` seconds, or not at all if that is 0; `report` as in `run`.  Raises
    SceneError for numbers out of range.

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


# -------------------------------------------------------------------------------------------------
# The least drive that clears faces.


@dataclass(frozen=True)
class Parameter:
    """A number of a scene that is swept: its name there, its unit, and the factor from this unit to
    the scene's.
    """

    field: str
    unit: str
    scale: float

    def set_in(self, setting: Scene, value: float) -> Scene:
        """Return the scene with another value, given in the unit; raises SceneError for one out of
        range.
        """
        return changed(setting, **{self.field: self.scale * value})


def parameters(peak: float = 1.0) -> Mapping[str, Parameter]:
    """Return the numbers that can be swept, by name: those of the motion along the table, and with
    `-up` those of the motion up.  The scene's amplitude is `peak` times the value: 1/2 if values
    are from peak to peak.
    """
    return {
        "e": Parameter("e", "", 1.0),
        "mu": Parameter("mu", "", 1.0),
        "frequency": Parameter("f_x", "Hz", 1.0),
        "amplitude": Parameter("A_x", "mm", 1e-3 * peak),
        "phase": Parameter("phase_x", "degrees", pi / 180),
        "frequency-up": Parameter("f_y", "Hz", 1.0),
        "amplitude-up": Parameter("A_y", "mm", 1e-3 * peak),
    }


def _named(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name


def _fixed(setting: Scene, swept: str) -> str:
    """Return what is not swept, in words.

    >>> from juggleproof.scenes.part.setting import scene
    >>> _fixed(scene(e=0.7, mu=0.08, f_x=30.0), "amplitude")
    'e = 0.7, mu = 0.08, 60 Hz 0.2 mm up, 30 Hz along'
    """
    parts = (
        (("e", f"e = {setting.e:g}"),),
        (("mu", f"mu = {setting.mu:g}"),),
        (
            ("frequency-up", f"{setting.f_y:g} Hz"),
            ("amplitude-up", f"{1e3 * setting.A_y:g} mm"),
            ("", "up"),
        ),
        (
            ("frequency", f"{setting.f_x:g} Hz"),
            ("amplitude", f"{1e3 * setting.A_x:g} mm"),
            ("", "along"),
        ),
    )
    kept = ([words for name, words in part if name != swept] for part in parts)
    return ", ".join(" ".join(words) for words in kept if words not in ([], ["up"], ["along"]))


@dataclass(frozen=True)
class Clearing:
    """How many of the parts rest on the stated faces, or on none, for each value of a parameter."""

    setting: Scene
    faces: tuple[int, ...]
    name: str
    unit: str
    values: tuple[float, ...]
    left: tuple[int, ...]
    parts: int
    starts: RestingStarts
    shaken: float

    def least(self) -> float | None:
        """The least value of the grid such that at this value and all larger ones no part is left
        on the faces; None if parts are left at the largest.
        """
        clear = None
        for value, left in zip(reversed(self.values), reversed(self.left)):
            if left:
                break
            clear = value
        return clear

    def islands(self) -> list[float]:
        """Values that leave no part though a larger one leaves some: clearing is not monotone."""
        least = self.least()
        return [
            value
            for value, left in zip(self.values, self.left)
            if not left and (least is None or value < least)
        ]

    def in_words(self) -> list[str]:
        """What was found, in lines: the least drive, on what grid, and how sure it is."""
        least, what = self.least(), f"{self.name} {{:g}}{self.unit and ' '}{self.unit}"
        of = f"face{'s' * (len(self.faces) > 1)} {', '.join(map(str, self.faces))}"
        if least is None:
            lines = [
                f"no {self.name} of the grid clears {of} for good: at"
                f" {what.format(self.values[-1])} {self.left[-1]} of {self.parts} parts are left"
            ]
        else:
            place = self.values.index(least)
            sure = wilson(0, self.parts)[1]
            lines = [
                f"{what.format(least)} is the least of the grid that clears {of}, there and at all"
                f" {len(self.values) - place - 1} larger ones: 0 of {self.parts} parts are left,"
                f" a probability of at most {sure:.2%} at each (95 %, Wilson)"
            ]
            if place:
                lines.append(
                    f"below it, at {what.format(self.values[place - 1])}, {self.left[place - 1]} of"
                    f" {self.parts} are left; nothing was run between the two"
                )
        islands = self.islands()
        if islands:
            lines.append(
                "not monotone: none is left at"
                f" {', '.join(f'{value:g}' for value in islands)}, but at larger ones"
            )
        return lines

    def shares(self) -> list[tuple[float, float, float]]:
        """The share that is left at each value, and the interval of its probability."""
        return [(left / self.parts, *wilson(left, self.parts)) for left in self.left]

    def title(self) -> str:
        """Return the faces and the values, the starts, and what is not swept."""
        return (
            f"Parts left on {', '.join(map(str, self.faces))} over {self.name}: {len(self.values)}"
            f" values, {self.parts} parts each that start {self.starts.in_words()}, shaken for"
            f" {self.shaken:g} s; {_fixed(self.setting, self.name)}"
        )

    def columns(self) -> Sequence[Column]:
        """Return columns with a row for each value: how many parts are left, and their share."""
        found = np.array(self.shares())
        return (
            Column(self.name, self.unit, np.array(self.values)),
            Column("left", "", np.array(self.left)),
            Column("parts", "", np.full(len(self.values), self.parts)),
            *(Column(name, "", found[:, k]) for k, name in enumerate(("share", "low", "high"))),
        )

    def picture(self) -> bytes:
        """Return the shares with their intervals, as SVG."""
        least = self.least()
        return _shares(
            "clearing",
            self.values,
            self.shares(),
            _named(self.name, self.unit),
            (
                f"Parts left on face{'s' * (len(self.faces) > 1)}"
                f" {', '.join(map(str, self.faces))} after {self.shaken:g} s",
                f"{len(self.values)} values, {self.parts} parts each that start"
                f" {self.starts.in_words()}; bars: 95 %; {_fixed(self.setting, self.name)}",
            ),
            None,
            None if least is None else (least, f"clear from {least:g} on"),
        )


def clearing(
    setting: Scene,
    faces: Sequence[int],
    grid: Mapping[str, Sequence[float]],
    *,
    starts: RestingStarts = ANY_ANGLE,
    parts: int = 200,
    shaken: float = 12.0,
    seed: int = 1,
    peak: float = 1.0,
    executor: Executor | None = None,
    report: Report | None = None,
) -> Clearing:
    """How many parts of a distribution of starts are left on the faces at each value of one
    parameter, the rest as in the scene; a part that lies on no face at the end counts as left.
    Every value has the same starts.  Raises SceneError for a face that does not exist, and for
    numbers out of range.
    """
    known = parameters(peak)
    if len(grid) != 1 or set(grid) - set(known):
        raise SceneError(
            f"a sweep of {', '.join(grid) or 'nothing'}: choose 1 of {', '.join(known)}"
        )
    ((name, values),) = grid.items()
    swept = known[name]
    if not 0 < len(values) <= MOST_POINTS:
        raise SceneError(f"a sweep of {len(values)} points is outside 1 .. {MOST_POINTS}")
    if any(one >= other for one, other in zip(values, values[1:])):
        raise SceneError(f"{name}: give values that grow")
    left = []
    for done, value in enumerate(values):
        here = swept.set_in(setting, value)
        found = orientation(here, starts, parts=parts, shaken=shaken, seed=seed, executor=executor)
        if not faces or not set(faces) <= set(range(len(found.counts))):
            raise SceneError(
                f"faces {', '.join(map(str, faces)) or 'none'}: choose from 0 to"
                f" {len(found.counts) - 1}"
            )
        left.append(sum(found.counts[face] for face in set(faces)) + found.moving)
        if report:
            report(done + 1, len(values))
    return Clearing(
        setting,
        tuple(sorted(set(faces))),
        name,
        swept.unit,
        tuple(values),
        tuple(left),
        parts,
        starts,
        shaken,
    )
