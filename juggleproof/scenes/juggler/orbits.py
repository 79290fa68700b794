"""The orbits of a scene in any arithmetic, and the motion of ball and table between samples."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache
from typing import NamedTuple, TypeAlias

import numpy as np
from flint import arb, fmpq
from mpmath import mpf

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler import bounded, exact
from juggleproof.scenes.juggler.compiled_map import (
    Number,
    brief,
    compiled,
    counted,
    formulas,
    rational,
)
from juggleproof.scenes.juggler.exact import flight, flight_length, impact
from juggleproof.scenes.juggler.starts import MOST_STEPS, Goal, Scene, goal
from juggleproof.scenes.juggler.track import Arithmetic, Sample, Stop, Track, advance, begin
from juggleproof.symbolic import ball_after_collision, collision_time, fly, period, state, table_at
from juggleproof.symbolic.algebra import alpha, beta, r, t, v

# -------------------------------------------------------------------------------------------------
# The motion between samples: heights of ball and table at any times, exactly.

MOST_IMPACTS = 10**4  # before the last of the times
MOST_TIMES = 10**6


class Heights(NamedTuple):
    """At a time: the heights of ball and table."""

    time: Fraction
    ball: Fraction
    table: Fraction


@cache
def _formulas() -> tuple[Callable[..., Fraction], ...]:
    """Period, time of collision, height of the table, of the ball before and after the collision,
    in the paper's units.
    """
    after = fly(ball_after_collision(), t - collision_time())
    return (
        compiled("period", "r g", period(), first=r),
        compiled("collision_time", "beta v r g", collision_time(), first=beta),
        compiled("table", "t r g", table_at()[0], first=t),
        compiled("before", "t beta v r g", fly(state(beta, v), t)[0], first=t),
        compiled("after", "t alpha beta v r g", after[0], first=alpha),
    )


def heights(scene: Scene, times: Sequence[Number], index: int = 0) -> list[Heights]:
    """The heights of ball and table at times >= 0, in the units of r and g, for the start of this
    number; raises SceneError for a time or a number out of range.

    The table is at its lowest at time 0, as at every sample.  Source: (1), the table's launch of
    section 3.1, (6) and (8).

    >>> from juggleproof.scenes.juggler import point, scene
    >>> path = heights(scene("1/3", point(0, 3), r=1, g=2), (0, "1/2", 1, "3/2", 2))
    >>> [str(one.ball) for one in path]
    ['0', '3/4', '1', '3/4', '0']
    """
    length, struck_at, table, before, after = _formulas()
    whole = length(scene.r, scene.g)
    if isinstance(times, str) or not hasattr(times, "__len__") or len(times) > MOST_TIMES:
        raise SceneError(f"times are to be a list of at most {MOST_TIMES} numbers >= 0")
    asked = sorted({_time(one) for one in times})
    x, w = scene.starts.exact(counted(index, "index", 0, scene.starts.count - 1))
    path: dict[Fraction, Heights] = {}
    passed, struck = 0, 0
    for time in asked:
        now = int(time / whole // 1)
        while passed < now:
            free = min(flight_length(x, w), now - passed)
            if free:
                passed, (x, w) = passed + free, flight(x, w, free)
            else:
                passed, (x, w), struck = passed + 1, impact(scene.alpha, x, w), struck + 1
                if struck > MOST_IMPACTS:
                    raise SceneError(
                        f"time {brief(time)} comes after more than {MOST_IMPACTS} impacts; choose"
                        " an earlier one"
                    )
        height, speed = formulas().unscaled(x, w, scene.r, scene.g)
        within = time - now * whole
        hit = formulas().margin(x, w) > 0 and within > struck_at(height, speed, scene.r, scene.g)
        ball = (
            after(within, scene.alpha, height, speed, scene.r, scene.g)
            if hit
            else before(within, height, speed, scene.r, scene.g)
        )
        path[time] = Heights(time, ball, table(within, scene.r, scene.g))
    return [path[_time(one)] for one in times]


def _time(value: Number) -> Fraction:
    time = rational(value, "time")
    if time < 0:
        raise SceneError(f"time = {brief(time)} is before the start; times are >= 0")
    return time


# -------------------------------------------------------------------------------------------------
# The orbits of a scene.  The result of `orbit` is filled as it goes: an interrupted run keeps what
# is done.

ARITHMETICS = ("exact", "enclosed", "mp", "fast")
MOST_TRACKS, MOST_KEPT = 10**6, 4 * 10**6  # as single numbers, of a kilobyte each
Report = Callable[[int, int], None]  # how many states are done, of how many
# a number of the arithmetics exact, enclosed, mp and fast, as rows and as tracks hold it
Value: TypeAlias = Fraction | arb | mpf | float
Unfinished: TypeAlias = exact.Rational | Fraction | arb | mpf
Error: TypeAlias = Fraction | float


class OrbitRow(NamedTuple):
    """Where one orbit stands: its start's number, periods and impacts passed, the state in numbers
    of the arithmetic, a bound on its error, its end.

    `error` bounds the distance of x and w from the true ones; None where nothing is
    proved (mp).  `end` is "reached" (the steps asked for), "trap" (only with until_trap),
    "undecided" (the branch at this state), "too long" (the exact numbers), or "" (not followed
    to its end).
    """

    start: int
    periods: int
    impacts: int
    x: Value
    w: Value
    error: tuple[Error, Error] | None
    end: str


@dataclass
class Orbits:
    """The orbits of a scene as far as they are followed: by `tracks`, or in fast arithmetic by an
    `ensemble` of arrays.
    """

    scene: Scene
    arithmetic: str
    goal: Goal
    keep: bool
    precision: int
    radius: Fraction = bounded.RADIUS
    most_bits: int = 0
    tracks: list[Track[Unfinished]] = field(default_factory=list)
    ensemble: bounded.Ensemble | None = None

    def __len__(self) -> int:
        return self.scene.starts.count

    @property
    def followed(self) -> int:
        """How many orbits have at least been begun; the others have no row."""
        return self.ensemble.done if self.ensemble is not None else len(self.tracks)

    def run(self, report: Report | None = None) -> Orbits:
        """Follows all orbits; may be interrupted, and then holds what was done."""
        if self.arithmetic == "fast":
            self.ensemble = bounded.Ensemble.empty(len(self), self.goal, self.keep)
            bounded.follow_fast(self.scene, self.goal, self.ensemble, report)
            return self
        for index in range(len(self)):
            start = self.scene.starts.exact(index)
            self.tracks.append(Track(self.scene.alpha, Sample(0, 0, *start)))
            self._follow(start, self._reporter(report))
            if report is not None:
                report(index + 1, len(self))
        return self

    def _show(self, track: Track[Unfinished]) -> None:
        self.tracks[-1] = track

    def _reporter(self, report: Report | None) -> Callable[[Track[Unfinished]], None] | None:
        if report is None or len(self) > 1:
            return None
        return lambda track: report(
            self.goal.steps - max(self.goal.left(track.here.periods, track.here.impacts), 0),
            self.goal.steps,
        )

    def _follow(
        self,
        start: tuple[Fraction, Fraction],
        report: Callable[[Track[Unfinished]], None] | None,
    ) -> None:
        alpha = self.scene.alpha
        if self.arithmetic == "enclosed":
            bounded.follow(
                alpha,
                start,
                self.goal,
                self.keep,
                self.precision,
                self.radius,
                self.most_bits,
                self._show,
                report,
            )
            return
        numbers: Arithmetic[Unfinished] = (
            exact.Exact(alpha, self.most_bits)
            if self.arithmetic == "exact"
            else exact.HighPrecision(self.precision)
        )
        track = begin(numbers, alpha, Sample(0, 0, *start), self.keep)
        self._show(track)
        try:
            advance(track, numbers, self.goal, formulas().fixed(numbers.lift(alpha)), report)
        except Stop as stop:
            track.end = stop.end
        if self.arithmetic == "exact":
            track.here = exact.finished(track.here)
            track.samples = track.samples and [exact.finished(sample) for sample in track.samples]

    def row(self, index: int) -> OrbitRow:
        """Where the orbit of this number stands; raises SceneError where it was not followed."""
        if (
            isinstance(index, bool)
            or not isinstance(index, (int, np.integer))
            or not 0 <= index < self.followed
        ):
            raise SceneError(
                f"orbit {brief(index)} is not among the {self.followed} that were followed"
            )
        if self.ensemble is not None:
            e = self.ensemble
            return OrbitRow(
                index,
                int(e.periods[index]),
                int(e.impacts[index]),
                float(e.x[index]),
                float(e.w[index]),
                (float(e.error_x[index]), float(e.error_w[index])),
                bounded.ENDS[e.end[index]],
            )
        return self._row(index, self.tracks[index].here, self.tracks[index].end)

    def _row(self, index: int, here: Sample[Unfinished], end: str) -> OrbitRow:
        x, w = _finished(here.x), _finished(here.w)
        error: tuple[Error, Error] | None = None
        if isinstance(x, Fraction):  # exact, or a start that has not moved yet
            error = (Fraction(0), Fraction(0))
        elif self.arithmetic == "enclosed":
            error = (bounded.radius_of(here.x), bounded.radius_of(here.w))
        return OrbitRow(index, here.periods, here.impacts, x, w, error, end)

    def history(self, index: int) -> list[OrbitRow]:
        """All states of the orbit of this number that were kept: one a period, or one after each
        impact; raises SceneError where none were.

        In fast arithmetic only that one is counted, and the other count is -1.
        """
        self.row(index)
        if not self.keep:
            raise SceneError("only the ends of orbits were kept; ask for keep=True")
        if self.ensemble is None:
            return [self._row(index, sample, "") for sample in self.tracks[index].samples or []]
        rows = []
        for step, (x, w, error_x, error_w) in enumerate(
            [] if self.ensemble.history is None else self.ensemble.history[index].tolist()
        ):
            if x == x:  # what was not reached is not a number
                periods, impacts = (step, -1) if self.goal.unit == "periods" else (-1, step)
                rows.append(OrbitRow(index, periods, impacts, x, w, (error_x, error_w), ""))
        return rows

    @property
    def undecided(self) -> list[tuple[int, int]]:
        """The number of each orbit with a state whose branch was not decided, and the period of
        that state.
        """
        return list(self.each_undecided())

    def each_undecided(self) -> Iterator[tuple[int, int]]:
        """The same, one by one."""
        if self.ensemble is not None:
            undecided = (self.ensemble.end[: self.followed] == bounded.UNDECIDED).nonzero()[0]
            yield from ((int(index), int(self.ensemble.periods[index])) for index in undecided)
        yield from (
            (index, track.here.periods)
            for index, track in enumerate(self.tracks)
            if track.end == "undecided"
        )

    def counts(self) -> dict[str, int]:
        """How many orbits have each end."""
        if self.ensemble is not None:
            counts = {
                name: int((self.ensemble.end[: self.followed] == code).sum())
                for code, name in enumerate(bounded.ENDS)
            }
        else:
            counts = {
                name: sum(track.end == name for track in self.tracks) for name in bounded.ENDS
            }
        return {name: counts[name] for name in (*bounded.ENDS[1:], "") if counts[name]}


def _finished(value: Unfinished) -> Value:
    """A number as rows hold it: Fraction of exact numbers; the ball of an enclosure and the mpf of
    mp as they are.
    """
    return exact.as_fraction(value) if isinstance(value, (exact.Ratio, fmpq)) else value


def _refuse_many(count: int, arithmetic: str, steps: int, keep: bool) -> None:
    """Raises SceneError for more orbits or kept states than can be held as single numbers; fast
    arithmetic has limits of its own.
    """
    if arithmetic == "fast":
        return
    if count > MOST_TRACKS:
        raise SceneError(
            f"{count} starts in {arithmetic} arithmetic; at most {MOST_TRACKS} can be held, and"
            " fast arithmetic takes more"
        )
    if keep and count * (counted(steps, "steps", 0, MOST_STEPS) + 1) > MOST_KEPT:
        raise SceneError(
            f"all states of {count} orbits of {steps} steps are more than {MOST_KEPT}; keep the"
            " ends only, or ask for fewer"
        )


def prepare(
    scene: Scene,
    arithmetic: str = "exact",
    steps: int = 100,
    *,
    impacts: bool = False,
    until_trap: bool = False,
    keep: bool = False,
    precision: int | None = None,
    radius: Number = bounded.RADIUS,
    most_bits: int | None = None,
) -> Orbits:
    """The orbits that `orbit` follows, before anything is followed; raises SceneError, one line,
    for what cannot be followed.
    """
    if not isinstance(scene, Scene):
        raise SceneError(f"scene = {brief(scene)} is no scene; give scene(alpha, starts)")
    if arithmetic not in ARITHMETICS:
        raise SceneError(
            f"arithmetic = {brief(arithmetic)!r} is not one of {', '.join(ARITHMETICS)}"
        )
    if precision is not None and arithmetic in ("exact", "fast"):
        raise SceneError(
            f"precision = {brief(precision)} has no meaning in {arithmetic} arithmetic; it goes"
            " with enclosed (bits) and mp (digits)"
        )
    _refuse_many(scene.starts.count, arithmetic, steps, keep)
    digits = {"enclosed": bounded.BITS, "mp": exact.DIGITS}.get(arithmetic, 2)
    width = rational(radius, "radius")
    if width <= 0:
        raise SceneError(
            f"radius = {brief(width)} is not positive; an enclosure has a positive radius"
        )
    most = (
        most_bits
        if most_bits is not None
        else exact.MOST_BITS
        if arithmetic == "exact"
        else bounded.MOST_BITS
    )
    return Orbits(
        scene,
        arithmetic,
        goal(steps, impacts, until_trap),
        keep,
        counted(digits if precision is None else precision, "precision", 2, 10**6),
        width,
        counted(most, "most_bits", 2, 2**32),
    )


def orbit(
    scene: Scene,
    arithmetic: str = "exact",
    steps: int = 100,
    *,
    impacts: bool = False,
    until_trap: bool = False,
    keep: bool = False,
    precision: int | None = None,
    radius: Number = bounded.RADIUS,
    most_bits: int | None = None,
    report: Report | None = None,
) -> Orbits:
    """The orbits of all states of a scene under f (10, 12): f1 where x < w (7), f2 elsewhere.

    arithmetic "exact": rationals.  "enclosed": balls that hold the exact state, of at most
    `radius`, from `precision` bits up to `most_bits`. "mp": mpmath with `precision` digits, nothing
    proved.  "fast": float64 with a proved bound for each state, undecided states listed. steps:
    periods, or impacts if `impacts`; with `until_trap` an orbit ends in the trap, if that comes
    first.  keep: all states, not the ends only. States are (x, w), in units of r T and r.  Errors:
    SceneError (a ValueError), one line with the value and the allowed range.

    >>> from juggleproof.scenes.juggler import point, scene
    >>> row = orbit(scene("1/3", point(0, 3)), steps=3).row(0)
    >>> row.x, row.w, row.periods, row.impacts
    (Fraction(1, 1), Fraction(1, 1), 3, 2)
    >>> # (1, 1) lies on x = w, which no float bound can decide
    >>> orbit(scene("1/3", point(0, 3)), "fast", steps=3).undecided
    [(0, 1)]
    """
    return prepare(
        scene,
        arithmetic,
        steps,
        impacts=impacts,
        until_trap=until_trap,
        keep=keep,
        precision=precision,
        radius=radius,
        most_bits=most_bits,
    ).run(report)
