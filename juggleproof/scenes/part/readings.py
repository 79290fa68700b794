"""What table I of the paper leaves open, how likely its prints are under each reading, the search
that is stored in `sweep.json`, and what a run of table I assumes.

    juggleproof simulate part --sweep readings -o juggleproof/scenes/part/sweep.json

searches anew
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import asdict, dataclass, replace
from functools import cache
from itertools import product
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body
from juggleproof.scenes.part.body import COMPILED
from juggleproof.scenes.part.drive import Harmonics
from juggleproof.scenes.part.ensemble import fresh_notes, run_jobs
from juggleproof.scenes.part.motion import sample_all
from juggleproof.scenes.part.onsets import (
    JITTER,
    MOST_POINTS,
    PAPER,
    OnsetRow,
    jittered,
    jittered_phases,
    row_of,
)
from juggleproof.scenes.part.setting import (
    Array,
    Launch,
    Scene,
    changed,
    refuse_long,
    scene,
    standing,
)
from juggleproof.scenes.part.shape import Polygon

# -------------------------------------------------------------------------------------------------
# Likelihood.
#
# The paper prints one run of each row.  Where a reading is simulated n times, the likelihood of a
# print is the part of runs that are chaotic, or the density of the onsets, in their logarithm, at
# the printed one: a normal kernel for each run.  So that nothing is impossible for want of runs,
# one run more is counted: chaotic by half, and by half with an onset anywhere in the logarithm
# from the paper's last digit to the horizon.

BANDWIDTH = 0.2  # of a kernel, in the logarithm of an onset
DIGIT = 0.1  # seconds: the paper prints tenths


def row_likelihood(row: OnsetRow) -> float:
    """The logarithm of the likelihood of a row's print: ln((c + 1/2)/(n + 1)) where it is chaotic,
    c of n ensembles being so; else ln((sum_i N(ln(print/onset_i); 0.2) + 1/(2 ln(horizon/0.1 s)))
    /(n + 1)), per unit of the logarithm of the onset.

    >>> row = OnsetRow(15.0, 4e-3, None, np.full(3, np.inf), (True, True, False), 12.0)
    >>> round(math.exp(row_likelihood(row)), 6)  # 2.5/4
    0.625
    """
    count = len(row.onsets)
    if row.paper is None:
        return math.log((sum(row.chaotic) + 0.5) / (count + 1))
    settled = np.maximum(row.onsets[np.isfinite(row.onsets)], DIGIT)
    away = np.log(row.paper / settled) / BANDWIDTH
    kernels = np.exp(-(away**2) / 2) / (BANDWIDTH * math.sqrt(2 * math.pi))
    anywhere = 0.5 / math.log(max(row.horizon, 2 * DIGIT) / DIGIT)
    return math.log((float(kernels.sum()) + anywhere) / (count + 1))


def likelihood(rows: Sequence[OnsetRow]) -> float:
    """The logarithm of the likelihood of the prints of some rows: the sum of theirs."""
    return math.fsum(map(row_likelihood, rows))


def most_likely(paper: float | None, count: int, horizon: float) -> float:
    """The greatest possible value of `row_likelihood`, for this number of ensembles."""
    onsets = np.full(count, math.inf if paper is None else paper)
    return row_likelihood(OnsetRow(0.0, 0.0, paper, onsets, (paper is None,) * count, horizon))


# -------------------------------------------------------------------------------------------------
# Readings.
#
# A reading takes "magnitude" as the peak or from peak to peak, and lets the table start at a phase
# on each axis.  An onset has three readings: the last time at which a block is nearer to upright;
# the first at which, looking each tenth of a second, none is; and the same where the run is stopped
# then, so that only a run that never comes to that can be called chaotic.

Rule = Literal["last", "first", "stopped"]
ONSETS: tuple[Rule, ...] = ("last", "first", "stopped")
# half sides in metres of the block's face in the plane
FACES = {"2x4": (0.01, 0.02), "1x2": (0.005, 0.01), "1x4": (0.005, 0.02)}
AMPLITUDES = {"peak": 1.0, "peak-to-peak": 0.5}
ORDER = (0, 2, 4, 5, 3, 1)  # of the rows: those with an onset tell readings apart soonest


@dataclass(frozen=True)
class TableReading:
    """The face in the plane, what an amplitude is, the phases in degrees, restitution and friction:
    all that table I leaves open but the onset.
    """

    face: str
    amplitudes: str
    phase_x: float
    phase_y: float
    e: float
    mu: float

    @property
    def peak(self) -> float:
        """The factor from a printed amplitude to the amplitude."""
        return AMPLITUDES[self.amplitudes]

    def scene(
        self,
        launch: Launch = "rest",
        shape: Polygon | None = None,
        drive: Harmonics | None = None,
        **numbers: float,
    ) -> Scene:
        """The scene with the vertical vibration of table I, and with none along the table unless it
        is given.  A shape replaces the face, a drive both vibrations.  Raises SceneError for
        numbers that make no scene.

        >>> TableReading("1x2", "peak-to-peak", 0, 0, 0.7, 0.08).scene().A_y
        0.0001
        """
        given = {"e": self.e, "mu": self.mu}
        if shape is None:
            given["a"], given["b"] = FACES[self.face]
        if drive is None:
            given |= {"phase_x": math.radians(self.phase_x), "phase_y": math.radians(self.phase_y)}
            given |= {"A_y": self.peak * 2e-4, "f_y": 60.0}
        return scene(launch=launch, shape=shape, drive=drive, **{**given, **numbers})


@dataclass(frozen=True)
class ReadingOutcome:
    """Table I under one reading: each row's median onset in seconds by the last time, None if that
    is late or chaotic; the same by the first time; its number of chaotic ensembles; the logarithm
    of the likelihood by each of `ONSETS`.  All are empty if the reading was given up as unlikely.
    `impacts` is the number of impacts that were computed.
    """

    reading: TableReading
    last: tuple[float | None, ...]
    first: tuple[float | None, ...]
    chaotic: tuple[int, ...]
    likelihoods: tuple[float, ...]
    impacts: int

    @property
    def likelihood(self) -> float:
        """The largest of the three likelihoods; minus infinity if the reading was given up."""
        return max(self.likelihoods, default=-math.inf)


class SimulatedReading(NamedTuple):
    """A reading with its scene, and how it is simulated; it is given up once the logarithm of its
    likelihood is sure to be below `least`.
    """

    reading: TableReading
    setting: Scene
    ensembles: int
    seed: int
    horizon: float
    least: float = -math.inf


def point(task: SimulatedReading) -> ReadingOutcome:
    """Table I under one reading.  Raises SceneError where a block is stuck."""
    starts = list(
        zip(jittered(task.ensembles, task.seed), jittered_phases(task.ensembles, task.seed))
    )
    left = math.fsum(most_likely(paper, task.ensembles, task.horizon) for _, _, paper in PAPER)
    rows: dict[int, tuple[OnsetRow, ...]] = {}
    impacts = 0
    for which in ORDER:
        frequency, amplitude, paper = PAPER[which]
        noted, first = [], []
        for angles, moved in starts:
            shaken = changed(
                task.setting,
                f_x=frequency,
                A_x=task.reading.peak * amplitude,
                phase_x=task.setting.phase_x + float(moved),
            )
            notes, settled = watched(shaken, angles, task.horizon)
            noted.append(notes)
            first.append(settled)
            impacts += int(notes[:, body.IMPACTS].sum())
        rows[which] = by_rules(row_of(PAPER[which], noted, task.horizon), np.array(first))
        left -= most_likely(paper, task.ensembles, task.horizon)
        found = [math.fsum(row_likelihood(row[k]) for row in rows.values()) for k in range(3)]
        if max(found) + left < task.least:
            return ReadingOutcome(task.reading, (), (), (), (), impacts)
    last, early, _ = zip(*(rows[which] for which in range(len(PAPER))))
    return ReadingOutcome(
        task.reading,
        tuple(map(_median, last)),
        tuple(map(_median, early)),
        tuple(sum(row.chaotic) for row in last),
        tuple(round(one, 3) for one in found),
        impacts,
    )


def _median(row: OnsetRow) -> float | None:
    onset = row.quantile(0.5)
    return None if math.isinf(onset) else round(onset, 3)


def watched(setting: Scene, angles: Array, horizon: float) -> tuple[Array, float]:
    """The notes of an ensemble, and the first tenth of a second at which no block is nearer to
    upright; inf where there is none.
    """
    times = np.arange(1, round(horizon / DIGIT) + 1) * DIGIT
    states, notes = standing(setting, angles), fresh_notes(len(angles), horizon / 2)
    seen = np.zeros((len(angles), len(times), body.STATE))
    codes = sample_all(setting.parameters(False), states, times, notes, seen)
    if codes.any():
        raise SceneError(f"a block is stuck at e = {setting.e:g}, mu = {setting.mu:g}")
    turned = np.mod(seen[:, :, body.THETA] + math.pi / 2, math.pi) - math.pi / 2
    lying = (np.abs(turned) > math.atan(setting.a / setting.b)).all(axis=0)
    return notes, float(times[lying.argmax()]) if lying.any() else math.inf


def by_rules(last: OnsetRow, first: Array) -> tuple[OnsetRow, OnsetRow, OnsetRow]:
    """A row by each of `ONSETS`, from that by the last time and the first time of each ensemble."""
    chaotic = np.array(last.chaotic)
    never = tuple(bool(one) for one in chaotic & np.isinf(first))
    early = replace(last, onsets=np.where(chaotic, np.inf, first))
    return last, early, replace(last, onsets=first, chaotic=never)


def sweep(
    tasks: Sequence[SimulatedReading],
    executor: Executor | None = None,
    report: Callable[[int, int], None] | None = None,
    done: list[ReadingOutcome] | None = None,
) -> list[ReadingOutcome]:
    """The points of tasks, in their order, on any executor; `report` and `done` as in `run_jobs`.
    Raises SceneError for no tasks or too many, for a horizon out of range, and without numba.
    """
    if not 0 < len(tasks) <= MOST_POINTS:
        raise SceneError(f"a sweep of {len(tasks)} points is outside 1 .. {MOST_POINTS}")
    for task in tasks:
        refuse_long(task.setting, task.horizon, "horizon")
        if task.horizon < DIGIT:
            raise SceneError(f"horizon = {task.horizon:g} s is below {DIGIT:g} s")
    if not COMPILED:
        raise SceneError("table I is computed by numba; install it with pip install numba")
    return run_jobs(point, tasks, executor, report, done)


# -------------------------------------------------------------------------------------------------
# The search.
#
# First the grid is screened with one ensemble of 6 s for each reading; a reading that is sure to be
# unlikely is given up, mostly after two rows.  Then four ensembles are run for the likeliest and
# for the phases around a reading that is known to fit.  At last the likeliest of these, and the
# stated ones, are followed for 24 ensembles of 12 s.  Each stage has a seed of its own.

RECORD = Path(__file__).with_name("sweep.json")
PHASES = (-90, 0, 90)
RESTITUTIONS = (0, 0.3, 0.5, 0.7, 0.8, 0.875, 0.925, 0.95)
FRICTIONS = (0.02, 0.06, 0.2, 0.5, 0.92, 1.3)
STATED = (
    TableReading("2x4", "peak-to-peak", -90, -90, 0.875, 0.92),
    TableReading("2x4", "peak", 0, 0, 0.7, 0.06),
)
NEAR = ((0.875, 0.92), (0.875, 0.7), (0.85, 0.92))  # restitution and friction
SCREEN = (1, 0, 6.0, -7.0)  # ensembles, seed, horizon in seconds, and when to give up
NEARER = (4, 3, 6.0, -7.0)
FINAL = (24, 2, 12.0)
KEPT, FINALISTS = 60, 8  # of the stage before
SCATTER = 1.0  # of the logarithm of a likelihood by 24 ensembles: smaller differences say nothing


@dataclass(frozen=True)
class AlikeReadings:
    """Readings that were simulated alike: how many, with how many impacts, and the points of those
    that were not given up.
    """

    ensembles: int
    seed: int
    horizon: float
    tried: int
    impacts: int
    points: tuple[ReadingOutcome, ...]


def stage(tasks: Sequence[SimulatedReading], points: Sequence[ReadingOutcome]) -> AlikeReadings:
    """The stage of some tasks, from their points."""
    first = tasks[0]
    kept = tuple(one for one in points if one.likelihoods)
    impacts = sum(one.impacts for one in points)
    return AlikeReadings(first.ensembles, first.seed, first.horizon, len(points), impacts, kept)


def screened() -> list[SimulatedReading]:
    """The tasks of the screen: all restitutions, frictions, faces, amplitudes and phases on each
    axis.
    """
    readings = (
        TableReading(*kind, e, mu)
        for e, mu in product(RESTITUTIONS, FRICTIONS)
        for kind in product(("2x4", "1x2"), ("peak-to-peak", "peak"), PHASES, PHASES)
    )
    return [SimulatedReading(one, one.scene(), *SCREEN) for one in readings]


def nearer(screened: Sequence[ReadingOutcome]) -> list[SimulatedReading]:
    """The tasks of the nearer look: the likeliest of the screen, and the phases at restitutions and
    frictions around the first stated reading.
    """
    about = (
        replace(STATED[0], phase_x=along, phase_y=up, e=e, mu=mu)
        for (e, mu), along, up in product(NEAR, PHASES, PHASES)
    )
    readings = dict.fromkeys((*about, *likeliest(screened, KEPT)))
    return [SimulatedReading(one, one.scene(), *NEARER) for one in readings]


def finals(looked_at: Sequence[ReadingOutcome]) -> list[SimulatedReading]:
    """The tasks of the last stage: the stated readings, and the likeliest of the nearer look."""
    readings = dict.fromkeys((*STATED, *likeliest(looked_at, FINALISTS)))
    return [SimulatedReading(one, one.scene(), *FINAL) for one in readings]


def likeliest(points: Sequence[ReadingOutcome], count: int) -> list[TableReading]:
    """The readings of at most `count` points that were not given up, the likeliest first."""
    kept = sorted((one for one in points if one.likelihoods), key=lambda one: -one.likelihood)
    return [one.reading for one in kept[:count]]


def as_json(stages: Sequence[AlikeReadings]) -> str:
    """A record of a sweep: its stages, with a line for each point."""
    kept = []
    for one in stages:
        head = {name: value for name, value in asdict(one).items() if name != "points"}
        points = ",\n  ".join(
            json.dumps({**asdict(point.reading), **_results(point)}) for point in one.points
        )
        kept.append(f' {json.dumps(head)[:-1]}, "points": [\n  {points}\n ]}}')
    return "[\n" + ",\n".join(kept) + "\n]\n"


def _results(one: ReadingOutcome) -> dict[str, object]:
    return {name: value for name, value in asdict(one).items() if name != "reading"}


def read(text: str) -> tuple[AlikeReadings, ...]:
    """The stages of a record; raises ValueError, KeyError or TypeError for any other text."""
    return tuple(
        AlikeReadings(**{**kept, "points": tuple(map(_point, kept["points"]))})
        for kept in json.loads(text)
    )


def _point(kept: dict[str, object]) -> ReadingOutcome:
    open_ = {name: kept.pop(name) for name in TableReading.__dataclass_fields__}
    results = {
        name: tuple(value) if isinstance(value, list) else value for name, value in kept.items()
    }
    return ReadingOutcome(TableReading(**open_), **results)  # type: ignore[arg-type]  # read from a file


@cache
def recorded() -> tuple[AlikeReadings, ...]:
    """The search that is stored beside this file; the reading of the scene comes from it.
    Raises SceneError where it cannot be read.

    >>> chosen(recorded()) in as_good(recorded())
    True
    """
    try:
        stages = read(RECORD.read_text(encoding="utf-8"))
        if not stages[-1].points:
            raise ValueError("no point")
        return stages
    except (OSError, ValueError, KeyError, TypeError, IndexError) as fault:
        raise SceneError(
            f"{RECORD.name}: the stored sweep cannot be read ({fault}); write it anew by"
            " juggleproof simulate part --sweep readings"
        ) from None


def most_likely_point(stages: Sequence[AlikeReadings]) -> ReadingOutcome:
    """The most likely point of the last stage; the first where several are."""
    return max(stages[-1].points, key=lambda one: one.likelihood)


def as_good(stages: Sequence[AlikeReadings]) -> list[ReadingOutcome]:
    """The points of the last stage that `SCATTER` does not tell from the most likely."""
    least = most_likely_point(stages).likelihood - SCATTER
    return [one for one in stages[-1].points if one.likelihood >= least]


def chosen(stages: Sequence[AlikeReadings]) -> ReadingOutcome:
    """The first of the points that `SCATTER` does not tell from the most likely."""
    return as_good(stages)[0]


# -------------------------------------------------------------------------------------------------
# Assumptions.
#
# What the paper gives of its simulation, what is inferred and what is chosen here.

Standing = Literal["given", "inferred", "chosen"]


@dataclass(frozen=True)
class Assumption:
    """One entry: what it is about, its value in this run, where it comes from, and why."""

    name: str
    value: str
    standing: Standing
    why: str


def assumptions(setting: Scene, amplitudes: str) -> list[Assumption]:
    """All that a run of table I assumes.  A value is inferred if it is that of the reading which
    the stored search suggests, else it is chosen.
    """
    try:
        likely = chosen(recorded()).reading
    except SceneError:  # none is stored, or none that can be read
        likely = None
    inferred = likely.scene() if likely else None
    why = "a most likely reading of the stored search, made with another seed"

    def entry(name: str, value: str, same: bool) -> Assumption:
        if same:
            return Assumption(name, value, "inferred", why)
        return Assumption(name, value, "chosen", "an option of this run")

    def shared(*names: str) -> bool:
        return inferred is not None and all(
            getattr(setting, name) == getattr(inferred, name) for name in names
        )

    return [
        Assumption("block", "1 x 2 x 4 cm, in a vertical plane", "given", "section 2.1"),
        Assumption(
            "face in the plane",
            f"{200 * setting.a:g} x {200 * setting.b:g} cm",
            "inferred",
            "sides of 1 : 2, for the still table parts 26 from 27 degrees; 2 x 4 or 1 x 2 cm",
        ),
        entry("restitution e", f"{setting.e:g}", shared("e")),
        entry("friction mu", f"{setting.mu:g}", shared("mu")),
        Assumption(
            "vertical vibration",
            f"{1000 * setting.A_y:g} mm at {setting.f_y:g} Hz, a sine",
            "given",
            f"table I, 0.2 mm {amplitudes}",
        ),
        entry("amplitudes", amplitudes, likely is not None and amplitudes == likely.amplitudes),
        entry(
            "phases at the start",
            f"{math.degrees(setting.phase_x):g} along, {math.degrees(setting.phase_y):g} up, in"
            " degrees",
            shared("phase_x", "phase_y"),
        ),
        Assumption(
            "starts", "0 to 90 degrees by 1, lowest corner on the table", "given", "section 2.1"
        ),
        Assumption(
            "first speed",
            {"rest": "at rest", "table": "as fast as the table"}[setting.launch],
            "inferred",
            "not told",
        ),
        Assumption(
            "jitter",
            f"at most {JITTER:g} degrees of each start and of each ensemble's phase",
            "chosen",
            "onsets scatter: only ensembles mean anything; who lies forgets its start, no phase",
        ),
        Assumption(
            "impact",
            "five modes, restitution by Poisson",
            "inferred",
            "the paper names Routh, and Wang and Mason; derived anew",
        ),
        Assumption("gravity", f"{setting.g:g} m/s^2", "chosen", ""),
    ]
