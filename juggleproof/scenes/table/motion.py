"""A ball on a table that moves periodically, in floats: flights, impacts, rest and launch.

Units: time in periods T of the table, heights in g T^2, velocities in g T; the phase is that of the
wave.  The table's height is the sum over k of w_k Gamma sin(2 pi k t)/(2 pi)^2, so that a sine has
the peak acceleration Gamma in units of gravity.  What is found here is simulated, not proved.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import acos, inf, isfinite, pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.table.curves import birth

CLOSE = 1e-13  # a height above the table that counts as an impact
FAST = 30.0  # a squared speed, or an acceleration; above it, CLOSE is raised in proportion
NEAR = 0.01  # what counts as at the bounce, in phase and speed
REST = 1e-9  # of velocities: slower, a ball rests, or is launched where the table falls away
LEAVE = 1e-3  # how long after a launch floats see the ball above the table
MOST_ADVANCES = 10_000
MOST = 200  # flights, after which nothing is said
SAMPLES = 4096  # of a period, between which launches are looked for

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Table:
    """A periodic table under a ball with restitution alpha; wave: the weights of the harmonics."""

    alpha: float
    gamma: float
    wave: tuple[float, ...] = (1.0,)

    def __post_init__(self) -> None:
        if not 0 <= self.alpha < 1:
            raise SceneError(f"restitution {self.alpha:g}: give a number from 0 to below 1")
        if not (0 < self.gamma < inf and self.wave and all(map(isfinite, self.wave))):
            raise SceneError("a table needs a drive above 0, and finite weights of its harmonics")

    def derivative(self, t: Floats, order: int) -> Floats:
        """The height of the table (order 0), its velocity or its acceleration, shape as t."""
        total = np.zeros_like(t)
        for k, weight in enumerate(self.wave, 1):
            turn = 2 * pi * k
            wave = np.cos(turn * t) if order % 2 else np.sin(turn * t)
            total += weight * turn**order * (-wave if order == 2 else wave)
        return self.gamma * total / (2 * pi) ** 2

    def falls(self, t: Floats) -> NDArray[np.bool_]:
        """Whether the table falls away from a ball that rests on it."""
        return -self.derivative(t, 2) > 1

    @cached_property
    def fall(self) -> float:
        """A bound of |F''|, F the height of a flying ball above the table."""
        return 1 + self.gamma * sum(abs(w) * k * k for k, w in enumerate(self.wave, 1))

    @cached_property
    def top(self) -> float:
        """A bound of the table's height."""
        return self.gamma * sum(map(abs, self.wave)) / (2 * pi) ** 2

    @cached_property
    def launches(self) -> Floats:
        """The phases at which the table begins to fall away from a ball at rest."""
        times = np.arange(SAMPLES + 1) / SAMPLES
        falls = self.falls(times)
        found = np.flatnonzero(falls[1:] & ~falls[:-1])
        low, high = times[found], times[found + 1]
        for _ in range(60):
            middle = (low + high) / 2
            above = self.falls(middle)
            low, high = np.where(above, low, middle), np.where(above, middle, high)
        return high


def landing(
    table: Table, start: Floats, velocity: Floats, drive: Floats | float = 1.0
) -> tuple[Floats, Floats]:
    """(durations, closing speeds) of the flights that leave the table with these velocities, each
    shape (n,); drive: how many times as far the table moves under each ball.

    By conservative advancement: from a time with F > 0 a step is the least time in which F can
    vanish, since F'' >= -fall; a ball above the whole table goes to where it comes down to its top.
    So no zero is passed over, and steps before a zero shrink as Newton's do.  The height at the end
    is at most CLOSE, raised for fast balls, so that the time is wrong by about CLOSE/speed.  A ball
    that leaves with the velocity of a table that falls away is looked at after LEAVE.
    """
    times = np.broadcast_to(drive, start.shape)
    slope = velocity - times * table.derivative(start, 1)
    fall = 1 + times * (table.fall - 1)
    wait = np.where(slope < REST, LEAVE, 2 * slope / fall)
    close = CLOSE * np.maximum(1.0, (velocity**2 + fall) / FAST)
    height = times * table.derivative(start, 0)
    flights = np.array([start, velocity, times, height, fall, close, wait])
    flying = np.arange(len(start))
    durations, speeds = np.zeros((2, len(start)))
    for _ in range(MOST_ADVANCES):
        start, velocity, times, height, fall, close, duration = flights
        upward = velocity - duration
        ball = height + (velocity - duration / 2) * duration
        low = ball - times * table.derivative(start + duration, 0)
        slope = upward - times * table.derivative(start + duration, 1)
        up = low > close
        if not up.all():
            ends = flying[~up]
            durations[ends], speeds[ends] = duration[~up], np.maximum(0.0, -slope[~up])
            flights, flying = flights[:, up], flying[up]
            if not len(flying):
                return durations, speeds
            fall, times = flights[4], flights[2]
            slope, low, upward, ball = slope[up], low[up], upward[up], ball[up]
        above = np.maximum(0.0, ball - times * table.top)
        steps = (slope + np.sqrt(slope * slope + 2 * fall * low)) / fall
        down = np.where(above > 0, upward + np.sqrt(upward * upward + 2 * above), 0.0)
        flights[-1] += np.maximum(steps, down)
    raise SceneError("a flight does not end: the ball comes too close to the table too often")


def rested(table: Table, time: Floats, velocity: Floats) -> tuple[NDArray[np.bool_], Floats]:
    """(which balls rest; when each is launched: inf for never, its own time if it flies)."""
    rests = (velocity - table.derivative(time, 1) < REST) & ~table.falls(time)
    if not len(table.launches):
        return rests, np.where(rests, inf, time)
    phases = np.append(table.launches, table.launches[0] + 1)
    phase = time % 1.0
    wait = phases[np.searchsorted(phases, phase)] - phase
    return rests, np.where(rests, time + wait, time)


class Event(NamedTuple):
    """What happens at a time: impact (with its closing speed), rest or launch (0)."""

    kind: str
    time: float
    speed: float


def events(table: Table, start: float, velocity: float) -> Iterator[Event]:
    """The impacts of a ball that leaves the table at a time with a velocity, and where it rests and
    is launched; for ever, but for a rest without end.
    """
    time, up = np.array([start]), np.array([velocity])
    while True:
        rests, after = rested(table, time, up)
        if rests[0]:
            yield Event("rest", float(time[0]), 0.0)
            if after[0] == inf:
                return
            time, up = after, table.derivative(after, 1)
            yield Event("launch", float(time[0]), 0.0)
        duration, speed = landing(table, time, up)
        time = time + duration
        up = table.derivative(time, 1) + table.alpha * speed
        yield Event("impact", float(time[0]), float(speed[0]))


def bounce_phase(alpha: float, gamma: float) -> float:
    """The phase of a sine at the impacts of the bounce; raises SceneError if there is no bounce."""
    least = birth(alpha)
    if gamma < least:
        raise SceneError(
            f"Gamma = {gamma:g} is below pi (1 - alpha)/(1 + alpha) = {least:g}: no bounce of one"
            " period; give more"
        )
    return acos(least / gamma) / (2 * pi)


def at_bounce(
    alpha: Floats | float, bounce: Floats | float, phase: Floats, speed: Floats
) -> NDArray[np.bool_]:
    """Which impacts are NEAR those of the bounce of one period, in phase and closing speed."""
    gap = np.abs((phase - bounce + 0.5) % 1.0 - 0.5)
    near: NDArray[np.bool_] = (gap < NEAR) & (np.abs(speed - 1 / (1 + alpha)) < NEAR)
    return near


def flights_to_bounce(table: Table, phase: Floats, speed: Floats, most: int) -> NDArray[np.int64]:
    """After how many flights a ball that hits a sine at this phase with this closing speed comes to
    the bounce of one period, for two impacts in a row; `most` + 1 where it does not by then, -1
    where it rests for ever.
    """
    bounce = bounce_phase(table.alpha, table.gamma)
    count = np.full(len(phase), most + 1)
    going = np.arange(len(phase))
    time, up = phase, table.derivative(phase, 1) + table.alpha * speed
    was = np.zeros(len(phase), dtype=bool)
    for number in range(1, most + 2):
        rests, after = rested(table, time, up)
        ends = np.isinf(after)
        count[going[ends]] = -1
        time = after[~ends]
        up = np.where(rests[~ends], table.derivative(time, 1), up[~ends])
        going, was = going[~ends], was[~ends]
        duration, hit = landing(table, time, up)
        time = (time + duration) % 1.0
        up = table.derivative(time, 1) + table.alpha * hit
        here = at_bounce(table.alpha, bounce, time, hit)
        left = ~(here & was)
        count[going[~left]] = number - 1
        going, time, up, was = going[left], time[left], up[left], here[left]
        if not len(going):
            break
    return count


def flights_by_state(table: Table, top: float, rows: int, columns: int) -> NDArray[np.int64]:
    """`flights_to_bounce` from the middles of cells of phase and closing speed up to `top`, shape
    (rows, columns).
    """
    phase, speed = np.meshgrid(
        (np.arange(columns) + 0.5) / columns, (np.arange(rows) + 0.5) / rows * top
    )
    return flights_to_bounce(table, phase.ravel(), speed.ravel(), MOST).reshape(phase.shape)
