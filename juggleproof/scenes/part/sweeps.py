"""Any two parameters of a scene over a grid: from when on all of 91 blocks lie; and one parameter:
from where on a drive leaves no part on stated faces.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from math import pi

import numpy as np

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part.columns import Column, Shown, graphs
from juggleproof.scenes.part.ensemble import Job, advanced, fresh_notes, run_jobs
from juggleproof.scenes.part.onsets import (
    ANGLES,
    MOST_POINTS,
    Row,
    ensembles_in_words,
    jittered,
    jittered_phases,
    onset_columns,
    row_of,
)
from juggleproof.scenes.part.resting import ANY_ANGLE, Starts, orientation, wilson
from juggleproof.scenes.part.setting import Array, Scene, changed, refuse_long, standing

# -------------------------------------------------------------------------------------------------
# Parameters.


@dataclass(frozen=True)
class Parameter:
    """A number of a scene that is swept: its name there, its unit, and how much of it one such unit
    is.
    """

    field: str
    unit: str
    scale: float

    def set_in(self, setting: Scene, value: float) -> Scene:
        """The scene with another value, given in the unit; SceneError for one out of range."""
        return changed(setting, **{self.field: self.scale * value})


def parameters(peak: float = 1.0) -> Mapping[str, Parameter]:
    """What can be swept, by name: of the motion along the table, and `-up`; `peak` is how much of
    an amplitude is the scene's, 1/2 where it is from peak to peak.
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


Grid = Mapping[str, Sequence[float]]


def _of(grid: Grid, count: int, peak: float) -> list[Parameter]:
    """The parameters of a grid; SceneError where these are not so many, or unknown."""
    known = parameters(peak)
    if len(grid) != count or set(grid) - set(known):
        raise SceneError(
            f"a sweep of {', '.join(grid) or 'nothing'}: choose {count} of {', '.join(known)}"
        )
    points = int(np.prod([len(values) for values in grid.values()]))
    if not 0 < points <= MOST_POINTS:
        raise SceneError(f"a sweep of {points} points is outside 1 .. {MOST_POINTS}")
    return [known[name] for name in grid]


def _named(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name


def _fixed(setting: Scene, grid: Collection[str]) -> str:
    """What is not swept, in words.

    >>> from juggleproof.scenes.part.setting import scene
    >>> _fixed(scene(e=0.7, mu=0.08, f_x=30.0), ["e", "amplitude"])
    'mu = 0.08, 60 Hz 0.2 mm up, 30 Hz along'
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
    kept = ([words for name, words in part if name not in grid] for part in parts)
    return ", ".join(" ".join(words) for words in kept if words not in ([], ["up"], ["along"]))


# -------------------------------------------------------------------------------------------------
# Onsets over two parameters.


@dataclass(frozen=True)
class OnsetMap(Shown):
    """For each pair of two parameters, the second running faster, the onsets of its ensembles."""

    setting: Scene
    grid: Grid
    units: tuple[str, ...]
    rows: tuple[Row, ...]

    def values(self) -> Array:
        """The pairs, shape (points, 2)."""
        first, second = self.grid.values()
        return np.array([(one, other) for one in first for other in second])[: len(self.rows)]

    def counts(self) -> tuple[int, int, int]:
        """How many points settle, are chaotic, and are neither: their median is later than the
        run is long.
        """
        chaotic = sum(row.is_chaotic() for row in self.rows)
        settled = sum(np.isfinite(row.quantile(0.5)) and not row.is_chaotic() for row in self.rows)
        return int(settled), chaotic, len(self.rows) - int(settled) - chaotic

    def title(self) -> str:
        settled, chaotic, other = self.counts()
        ensembles = ensembles_in_words(len(self.rows[0].chaotic))
        horizon = self.rows[0].horizon
        return (
            f"From when on all {ANGLES} blocks lie over {' and '.join(self.grid)}: {len(self.rows)}"
            f" points of {ensembles}, {horizon:g} s each: {settled} settle, {chaotic} are"
            f" chaotic, {other} have not settled"
        )

    def columns(self) -> Sequence[Column]:
        """A row a point: its two parameters, and its onsets."""
        return (
            *(
                Column(name, unit, values)
                for name, unit, values in zip(self.grid, self.units, self.values().T)
            ),
            *onset_columns(self.rows),
        )

    def picture(self) -> bytes:
        """The medians as colours; SceneError for a map that is not whole."""
        shape = [len(values) for values in self.grid.values()]
        if len(self.rows) != shape[0] * shape[1]:
            raise SceneError(f"{len(self.rows)} of {shape[0] * shape[1]} points are not drawn")
        drawing = graphs()
        first, second = (
            (_named(name, unit), values)
            for (name, values), unit in zip(self.grid.items(), self.units)
        )
        ensembles = ensembles_in_words(len(self.rows[0].chaotic))
        horizon = self.rows[0].horizon
        drawn: bytes = drawing.onset_map(
            first,
            second,
            np.array([row.quantile(0.5) for row in self.rows]).reshape(shape),
            np.array([row.is_chaotic() for row in self.rows]).reshape(shape),
            (
                f"From when on all {ANGLES} blocks lie",
                f"{len(self.rows)} points, the median of {ensembles} of {horizon:g} s each;"
                f" {_fixed(self.setting, self.grid)}",
            ),
        )
        return drawn


def onset_map(
    setting: Scene,
    grid: Grid,
    *,
    ensembles: int = 4,
    horizon: float = 12.0,
    seed: int = 1,
    peak: float = 1.0,
    executor: Executor | None = None,
    report: Callable[[int, int], None] | None = None,
) -> OnsetMap:
    """From when on all of 91 blocks lie, as in a row of table I, over a grid of two parameters
    (`parameters`), the rest as in the scene.  SceneError for numbers out of range; where it is
    interrupted, `InterruptedMap` with what is done.

    >>> from juggleproof.scenes.part.setting import scene
    >>> grid = {"frequency": [15.0, 30.0], "amplitude": [1.0]}
    >>> found = onset_map(scene(e=0.7, mu=0.08), grid, ensembles=1, horizon=0.01)
    >>> found.counts(), found.values().tolist()
    ((0, 0, 2), [[15.0, 1.0], [30.0, 1.0]])
    """
    swept = _of(grid, 2, peak)
    refuse_long(setting, horizon, "horizon")
    if horizon == 0:
        raise SceneError("horizon = 0 s leaves no time to settle in")
    angles, phases = jittered(ensembles, seed), jittered_phases(ensembles, seed)
    jobs: list[Job] = []
    first, second = grid.values()
    for one in first:
        for other in second:
            here = swept[1].set_in(swept[0].set_in(setting, one), other)
            refuse_long(here, horizon, "horizon")
            for angle, moved in zip(angles, phases):
                shaken = changed(here, phase_x=here.phase_x + float(moved))
                states, notes = standing(shaken, angle), fresh_notes(ANGLES, horizon / 2)
                p = shaken.parameters(False)
                jobs.append(Job(p, states, horizon, notes, len(jobs) * ANGLES))
    done: list[tuple[Array, Array]] = []

    def found() -> OnsetMap:
        notes = [one for _, one in done]
        rows = tuple(
            row_of((here.f_x, here.A_x, None), notes[k : k + ensembles], horizon)
            for k in range(0, len(notes) - ensembles + 1, ensembles)
        )
        return OnsetMap(setting, grid, tuple(one.unit for one in swept), rows)

    try:
        run_jobs(advanced, jobs, executor, report, done)
    except KeyboardInterrupt:
        if len(done) < ensembles:
            raise
        raise InterruptedMap(found()) from None
    return found()


class InterruptedMap(KeyboardInterrupt):
    """An interrupted sweep; `map` has the points all of whose ensembles were done by then."""

    def __init__(self, done: OnsetMap) -> None:
        self.map = done


# -------------------------------------------------------------------------------------------------
# The least drive that clears faces.


@dataclass(frozen=True)
class Clearing(Shown):
    """How many of the parts rest on the stated faces, or on none, for each value of a parameter."""

    setting: Scene
    faces: tuple[int, ...]
    name: str
    unit: str
    values: tuple[float, ...]
    left: tuple[int, ...]
    parts: int
    starts: Starts
    shaken: float

    def least(self) -> float | None:
        """The least value of the grid from which on, there and at every larger one, no part is left
        on the faces; None where parts are left at the largest.
        """
        clear = None
        for value, left in zip(reversed(self.values), reversed(self.left)):
            if left:
                break
            clear = value
        return clear

    def islands(self) -> list[float]:
        """Values that leave none, though a larger one does: clearing is not monotone there."""
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
        return (
            f"Parts left on {', '.join(map(str, self.faces))} over {self.name}: {len(self.values)}"
            f" values, {self.parts} parts each that start {self.starts.in_words()}, shaken for"
            f" {self.shaken:g} s; {_fixed(self.setting, [self.name])}"
        )

    def columns(self) -> Sequence[Column]:
        found = np.array(self.shares())
        return (
            Column(self.name, self.unit, np.array(self.values)),
            Column("left", "", np.array(self.left)),
            Column("parts", "", np.full(len(self.values), self.parts)),
            *(Column(name, "", found[:, k]) for k, name in enumerate(("share", "low", "high"))),
        )

    def picture(self) -> bytes:
        drawing, least = graphs(), self.least()
        drawn: bytes = drawing.shares(
            "clearing",
            self.values,
            self.shares(),
            _named(self.name, self.unit),
            (
                f"Parts left on face{'s' * (len(self.faces) > 1)}"
                f" {', '.join(map(str, self.faces))} after {self.shaken:g} s",
                f"{len(self.values)} values, {self.parts} parts each that start"
                f" {self.starts.in_words()}; bars: 95 %; {_fixed(self.setting, [self.name])}",
            ),
            None,
            None if least is None else (least, f"clear from {least:g} on"),
        )
        return drawn


def clearing(
    setting: Scene,
    faces: Sequence[int],
    grid: Grid,
    *,
    starts: Starts = ANY_ANGLE,
    parts: int = 200,
    shaken: float = 12.0,
    seed: int = 1,
    peak: float = 1.0,
    executor: Executor | None = None,
    report: Callable[[int, int], None] | None = None,
) -> Clearing:
    """How many parts of a distribution of starts are left on the faces at each value of one
    parameter, the rest as in the scene; a part that lies on no face at the end counts as left.
    Every value has the same starts.  SceneError for a face that there is not, and numbers out of
    range.
    """
    (swept,) = _of(grid, 1, peak)
    ((name, values),) = grid.items()
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
