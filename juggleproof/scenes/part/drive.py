"""How the table moves where it is no single sine: a sum of harmonics along each axis, or a record,
interpolated by a cubic spline; with bounds of the derivatives, which flights rely on.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body

Array = NDArray[np.float64]
Sine = tuple[float, float, float]  # metres, hertz, radians
Pair = tuple[float, float]
MOST_SINES, MOST_ROWS = 32, 1_000_000
LARGEST, FASTEST, MOST_PHASE = 1.0, 1e4, 100.0  # metres, hertz, radians
LEAST_GAP = 1e-7  # seconds between two rows of a record
MOST_LIFT = 1e6  # m/s^2, of a record
UP = 1 + 1e-12  # by which bounds are rounded up


@dataclass(frozen=True)
class Harmonics:
    """Sines along the table and away from it; made by `harmonics`."""

    along: tuple[Sine, ...]
    away: tuple[Sine, ...]
    KIND: ClassVar[float] = body.SINES

    def numbers(self) -> list[float]:
        """The drive as the kernels take it."""
        found: list[float] = []
        for axis in (self.along, self.away):
            found.append(len(axis))
            for A, f, phase in axis:
                found += [A, 2 * math.pi * f, phase]
        return found

    def bounds(self) -> tuple[Pair, Pair]:
        """(A, W) of each axis such that A W^k bounds the derivatives from the second on: W the
        highest frequency, A W^2 the sum of the accelerations.

        >>> along, away = harmonics([(1e-3, 10, 0)], [(1e-3, 10, 0), (1e-3, 20, 0)]).bounds()
        >>> round(along[0], 9), round(away[0], 9), round(away[1] / along[1], 9)
        (0.001, 0.00125, 2.0)
        """
        return self._bound(self.along), self._bound(self.away)

    def _bound(self, axis: Sequence[Sine]) -> Pair:
        top = max((f for _, f, _ in axis), default=0.0)
        if top == 0:
            return 0.0, 0.0
        return UP * sum(abs(A) * (f / top) ** 2 for A, f, _ in axis), 2 * math.pi * top

    def highest(self) -> float:
        """How far from 0 the table's height is at most, in metres."""
        return sum(abs(A) for A, _, _ in self.away)

    def rounded(self, until: float) -> float:
        """By how much the table's height is rounded up to a time, in metres."""
        return sum(
            abs(A) * (2 * math.pi * f * until + abs(phase)) for A, f, phase in self.away
        ) * float(np.finfo(float).eps)

    def lasts(self) -> float:
        """Until when it is given, in seconds."""
        return math.inf

    def in_words(self) -> str:
        """The drive in a line."""
        return "; ".join(
            f"{' + '.join(f'{f:g} Hz {1e3 * A:g} mm' for A, f, _ in axis) or 'still'} {way}"
            for axis, way in ((self.away, "up and down"), (self.along, "along"))
        )


def harmonics(along: Sequence[Sine], away: Sequence[Sine]) -> Harmonics:
    """A drive by sines along the table and away from it, (metres, hertz, radians) each; SceneError
    for numbers out of range.

    >>> harmonics([], [(2e-4, 60.0, 0.0)]).in_words()
    '60 Hz 0.2 mm up and down; still along'
    """
    for axis in (along, away):
        if len(axis) > MOST_SINES:
            raise SceneError(f"{len(axis)} harmonics along an axis; at most {MOST_SINES} are taken")
        for A, f, phase in axis:
            if not (abs(A) <= LARGEST and 0 <= f <= FASTEST and abs(phase) <= MOST_PHASE):
                raise SceneError(
                    f"a harmonic of {A:g} m, {f:g} Hz and {phase:g} rad is out of range: at most"
                    f" {LARGEST:g} m, 0 .. {FASTEST:g} Hz and {MOST_PHASE:g} rad"
                )
    return Harmonics(
        *(tuple((float(A), float(f), float(phase)) for A, f, phase in one) for one in (along, away))
    )


# -------------------------------------------------------------------------------------------------
# Records.
#
# Between two rows the table moves as the cubic of the natural spline: twice continuously
# differentiable, its acceleration straight between rows.  So the largest acceleration is that at a
# row, the third derivative is the steepest slope between two, and the fourth is 0: no bound is
# estimated.


@dataclass(frozen=True)
class Record:
    """Times in seconds from 0 on, and where the table is then, in metres; made by `record`."""

    times: tuple[float, ...]
    along: tuple[float, ...]
    away: tuple[float, ...]
    KIND: ClassVar[float] = body.RECORD

    @cached_property
    def accelerations(self) -> tuple[Array, Array]:
        """The spline's second derivative at each row, along the table and away from it."""
        times = np.asarray(self.times)
        return bent(times, np.asarray(self.along)), bent(times, np.asarray(self.away))

    def numbers(self) -> list[float]:
        """The drive as the kernels take it."""
        along, away = self.accelerations
        return [float(len(self.times)), *self.times, *self.along, *along, *self.away, *away]

    def bounds(self) -> tuple[Pair, Pair]:
        """(A, W) of each axis such that A W^k bounds the derivatives from the second to the fourth,
        with equality in the second and the third.
        """
        along, away = self.accelerations
        return self._bound(along), self._bound(away)

    def _bound(self, accelerations: Array) -> Pair:
        most = float(np.abs(accelerations).max())
        if most == 0:
            return 0.0, 0.0
        W = float(np.abs(np.diff(accelerations) / np.diff(self.times)).max()) / most
        return UP * most / W**2, UP * W

    def highest(self) -> float:
        """How far from 0 the table's height is at most, in metres: a piece of length h is at most
        h^2/8 times the largest acceleration above the line between its ends.
        """
        widest = float(np.diff(self.times).max())
        lift = float(np.abs(self.accelerations[1]).max())
        return float(np.abs(self.away).max()) + lift * widest**2 / 8

    def rounded(self, until: float) -> float:
        """By how much the table's height is rounded up to a time, in metres."""
        steps = np.diff(self.times)
        lift = float(np.abs(self.accelerations[1]).max())
        speed = float(np.abs(np.diff(self.away) / steps).max() + lift * steps.max() / 2)
        return (speed * until + self.highest()) * float(np.finfo(float).eps)

    def lasts(self) -> float:
        """Until when it is given, in seconds."""
        return self.times[-1]

    def in_words(self) -> str:
        """The drive in a line."""
        return f"recorded, {len(self.times)} rows over {self.times[-1]:g} s"


def record(times: Sequence[float], along: Sequence[float], away: Sequence[float]) -> Record:
    """A drive by places at times that grow, in seconds and metres; times are counted from the
    first.  SceneError, one line, where they make none.

    >>> record([1.0, 2.0, 3.0], [0.0, 0.0, 0.0], [0.0, 0.1, 0.0]).accelerations[1].tolist()
    [0.0, -0.30000000000000004, 0.0]
    """
    rows = np.array([times, along, away], dtype=float).T
    if not 3 <= len(rows) <= MOST_ROWS:
        raise SceneError(f"a record of {len(rows)} rows; 3 to {MOST_ROWS} are needed")
    for k, row in enumerate(rows):
        if not np.isfinite(row).all():
            raise SceneError(f"row {k + 1} of the record has a number that is not finite")
        if k and not row[0] - rows[k - 1, 0] >= LEAST_GAP:
            raise SceneError(
                f"the times of a record grow, by {LEAST_GAP:g} s at least: row {k + 1} has"
                f" {row[0]:.9g} s after {rows[k - 1, 0]:.9g} s"
            )
    if np.abs(rows[:, 1:]).max() > LARGEST:
        raise SceneError(f"the record leaves the {LARGEST:g} m about 0; metres are taken")
    rows[:, 0] -= rows[0, 0]
    found = Record(*(tuple(column.tolist()) for column in rows.T))
    for way, lifts in zip(("along the table", "away from it"), found.accelerations):
        if np.abs(lifts).max() > MOST_LIFT:
            raise SceneError(
                f"the record accelerates by {np.abs(lifts).max():.3g} m/s^2 {way}, more than"
                f" {MOST_LIFT:g}; is it smooth, and in metres?"
            )
    return found


def bent(times: Array, places: Array) -> Array:
    """The second derivatives of the natural cubic spline at its knots: they are 0 at both ends, and
    h1 m0/6 + (h1 + h2) m1/3 + h2 m2/6 is how much the slope changes at a knot between pieces of h1
    and h2 (solved by elimination, which is stable as the middle term dominates).
    """
    steps = np.diff(times)
    jumps = np.diff(np.diff(places) / steps).tolist()
    h = steps.tolist()
    pivots, sides = [1.0], [0.0]
    for k, jump in enumerate(jumps):
        factor = h[k] / 6 / pivots[-1] if k else 0.0
        pivots.append((h[k] + h[k + 1]) / 3 - factor * h[k] / 6)
        sides.append(jump - factor * sides[-1])
    found = [0.0] * len(times)
    for k in range(len(jumps), 0, -1):
        found[k] = (sides[k] - h[k] / 6 * found[k + 1]) / pivots[k]
    return np.array(found)


def read_record(text: str, unit: float = 1.0) -> Record:
    """A record of three columns, time in seconds, and x and y in units of so many metres, with or
    without a line of names above them; SceneError that names the line.

    >>> read_record("t,x,y\\n0,0,0\\n1,0,2\\n2,0,0\\n", 1e-3).away
    (0.0, 0.002, 0.0)
    """
    rows: list[list[float]] = []
    for number, row in enumerate(csv.reader(io.StringIO(text)), 1):
        if not row:
            continue
        if len(row) != 3:
            raise SceneError(f"line {number} has {len(row)} columns; time, x and y are needed")
        try:
            rows.append([float(one) for one in row])
        except ValueError:
            if number > 1:
                raise SceneError(
                    f"line {number} has no three numbers: {','.join(row)[:40]!r}"
                ) from None
    if not rows:
        raise SceneError("no rows of time, x and y")
    times, along, away = zip(*rows)
    return record(times, [unit * one for one in along], [unit * one for one in away])
