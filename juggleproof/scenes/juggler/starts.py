"""Scenes of the juggler, and the states from which orbits start."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Literal, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler.compiled_map import (
    Number,
    brief,
    counted,
    formulas,
    height,
    nearest,
    positive,
    rational,
    region,
    restitution,
)

# -------------------------------------------------------------------------------------------------
# Starting states by number.
#
# They are listed, on a grid, on the boundary of R, random, or in arrays.  Each is an exact rational
# state, in floats on demand.
#
# All in normal form: x the height in units of r T, w the closing speed in units of r; x >= 0.
# Whatever the number of states, only those asked for are made.

Floats: TypeAlias = NDArray[np.float64]


@runtime_checkable
class Starts(Protocol):
    """Starting states by number, from 0 to count - 1."""

    @property
    def count(self) -> int:
        """How many there are."""

    def exact(self, index: int) -> tuple[Fraction, Fraction]:
        """The state (x, w) of this number."""

    def block(self, low: int, high: int) -> tuple[Floats, Floats, Floats, Floats]:
        """x, w as floats and bounds on their rounding, each of shape (high - low,)."""


def _converted(
    states: Sequence[tuple[Fraction, Fraction]],
) -> tuple[Floats, Floats, Floats, Floats]:
    pairs = [(*nearest(x), *nearest(w)) for x, w in states]
    x, missed_x, w, missed_w = np.array(pairs, dtype=np.float64).reshape(-1, 4).T.copy()
    return x, w, missed_x, missed_w


@dataclass(frozen=True)
class Listed:
    """States given one by one."""

    states: tuple[tuple[Fraction, Fraction], ...]

    @property
    def count(self) -> int:
        return len(self.states)

    def exact(self, index: int) -> tuple[Fraction, Fraction]:
        return self.states[index]

    def block(self, low: int, high: int) -> tuple[Floats, Floats, Floats, Floats]:
        return _converted(self.states[low:high])


@dataclass(frozen=True)
class Even:
    """Numbers from the first to the last, `count` of them, equally far apart; each is made when it
    is asked for.
    """

    first: Fraction
    last: Fraction
    count: int

    def __len__(self) -> int:
        return self.count

    def __getitem__(self, place: int) -> Fraction:
        return self.first + (self.last - self.first) * Fraction(place, max(self.count - 1, 1))

    def __iter__(self) -> Iterator[Fraction]:
        return map(self.__getitem__, range(self.count))

    def floats(self, places: NDArray[np.int64]) -> tuple[Floats, Floats]:
        """The numbers at these places as floats, and bounds on their rounding."""
        some, back = np.unique(places, return_inverse=True)
        pairs = np.array([nearest(self[place]) for place in some.tolist()])[back]
        return pairs[:, 0].copy(), pairs[:, 1].copy()


@dataclass(frozen=True)
class StartGrid:
    """All pairs of heights and closing speeds; the speed runs first."""

    heights: Even
    speeds: Even

    @property
    def count(self) -> int:
        return len(self.heights) * len(self.speeds)

    def exact(self, index: int) -> tuple[Fraction, Fraction]:
        return self.heights[index // len(self.speeds)], self.speeds[index % len(self.speeds)]

    def block(self, low: int, high: int) -> tuple[Floats, Floats, Floats, Floats]:
        at = np.arange(low, high)
        x, missed_x = self.heights.floats(at // len(self.speeds))
        w, missed_w = self.speeds.floats(at % len(self.speeds))
        return x, w, missed_x, missed_w


@dataclass(frozen=True)
class OnBoundary:
    """States on the boundary of R, each made when it is asked for: first those on the energy level,
    1 +/- reach at most in w, then those at x = 0.

    The energy is linear in x, and one unit of height adds `added` to it.
    """

    level: Fraction
    reach: Fraction
    added: Fraction
    count: int

    def exact(self, index: int) -> tuple[Fraction, Fraction]:
        on_level = self.count - self.count // 2
        if index >= on_level:
            return Fraction(0), self._speed(index - on_level, self.count // 2)
        w = self._speed(index, on_level)
        return (self.level - formulas().energy(Fraction(0), w)) / self.added, w

    def _speed(self, place: int, of: int) -> Fraction:
        return 1 + self.reach * Fraction(2 * place + 1 - of, of)

    def block(self, low: int, high: int) -> tuple[Floats, Floats, Floats, Floats]:
        return _converted([self.exact(index) for index in range(low, high)])


@dataclass(frozen=True)
class Drawn:
    """Floats of a seeded generator, uniform over a box; state i comes from draws 2 i and 2 i + 1,
    whatever block it is asked for in.
    """

    count: int
    seed: int
    x: tuple[float, float]
    w: tuple[float, float]

    def exact(self, index: int) -> tuple[Fraction, Fraction]:
        x, w, _, _ = self.block(index, index + 1)
        return Fraction(float(x[0])), Fraction(float(w[0]))

    def block(self, low: int, high: int) -> tuple[Floats, Floats, Floats, Floats]:
        generator = np.random.PCG64(self.seed)
        generator.advance(2 * low)
        drawn = np.random.Generator(generator).random((high - low, 2))
        x, w = (a + (b - a) * drawn[:, column] for column, (a, b) in enumerate((self.x, self.w)))
        return np.maximum(x, 0.0), w, np.zeros(high - low), np.zeros(high - low)


@dataclass(frozen=True)
class FloatStarts:
    """Arrays of floats, which are taken as the binary numbers that they are."""

    x: Floats
    w: Floats

    @property
    def count(self) -> int:
        return len(self.x)

    def exact(self, index: int) -> tuple[Fraction, Fraction]:
        return Fraction(float(self.x[index])), Fraction(float(self.w[index]))

    def block(self, low: int, high: int) -> tuple[Floats, Floats, Floats, Floats]:
        return (
            self.x[low:high].copy(),
            self.w[low:high].copy(),
            np.zeros(high - low),
            np.zeros(high - low),
        )


# -------------------------------------------------------------------------------------------------
# A scene of the juggler, and what is to be followed of its orbits.

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
    they are.  Raises SceneError for other numbers.

    >>> from juggleproof.scenes.juggler import point
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
    """How far an orbit is followed: for a number of periods, or of impacts; or until it is in the
    trap, if that comes first.
    """

    steps: int
    unit: Unit = "periods"
    until_trap: bool = False

    def left(self, periods: int, impacts: int) -> int:
        """The number of its steps that are left."""
        return self.steps - (periods if self.unit == "periods" else impacts)


def goal(steps: int, impacts: bool = False, until_trap: bool = False) -> Goal:
    """The goal; raises SceneError for a number of steps below 0."""
    return Goal(
        counted(steps, "steps", 0, MOST_STEPS), "impacts" if impacts else "periods", until_trap
    )


# -------------------------------------------------------------------------------------------------
# Starts made of what is given: points, grids, the boundary of R, random states, arrays.
#
# In normal form, x the height in units of r T and w the closing speed in units of r, or in the
# paper's units, beta and v; heights are at least 0.

Axis: TypeAlias = tuple[Number, Number, int]  # from, to, how many
Side: TypeAlias = tuple[Number, Number]  # from, to
MOST = 10**8  # starts of one scene


def point(x: Number, w: Number) -> Listed:
    """One state; raises SceneError for x < 0 and for what is no number.

    >>> point(0, "3/2").exact(0)
    (Fraction(0, 1), Fraction(3, 2))
    """
    return Listed(((height(x), rational(w, "w")),))


def listed(states: Sequence[tuple[Number, Number]]) -> Listed:
    """States (x, w) one by one, at least one; raises SceneError for others."""
    if not isinstance(states, (Sequence, np.ndarray)) or len(states) == 0:
        raise SceneError("no states are given; give one at least, as a list of pairs (x, w)")
    for pair in states:
        if isinstance(pair, str) or not hasattr(pair, "__len__") or len(pair) != 2:
            raise SceneError(f"{brief(pair)} is no state; give pairs (x, w)")
    return Listed(tuple((height(x), rational(w, "w")) for x, w in states))


def physical(beta: Number, v: Number, r: Number, g: Number) -> Listed:
    """One state in the paper's units: height beta and upward speed v of the ball when the table is
    lowest; launch speed r > 0, gravity g > 0.

    >>> physical(1, "-1/2", 2, 4).exact(0)
    (Fraction(1, 2), Fraction(5, 4))
    """
    return Listed(
        (
            formulas().scaled(
                height(beta, "beta"), rational(v, "v"), positive(r, "r"), positive(g, "g")
            ),
        )
    )


def axis(low: Number, high: Number, count: int, name: str) -> Even:
    """Numbers from low to high, `count` of them, equally far apart; raises SceneError for none."""
    first, last = rational(low, name), rational(high, name)
    counted(count, f"the number of {name}", 1, MOST)
    if count > 1 and last <= first:
        raise SceneError(
            f"{name} runs from {brief(first)} to {brief(last)}; the second is to be the greater"
        )
    return Even(first, last, int(count))


def _grid_of(heights: Axis, speeds: Axis, names: tuple[str, str]) -> StartGrid:
    for one, name in zip((heights, speeds), names):
        _refuse_other_parts(one, 3, name)
    (low, high, count), (low_speed, high_speed, count_speeds) = heights, speeds
    states = StartGrid(
        axis(low, high, count, names[0]), axis(low_speed, high_speed, count_speeds, names[1])
    )
    height(states.heights.first, names[0])
    counted(states.count, "the number of states", 1, MOST)
    return states


def _refuse_other_parts(given: object, count: int, name: str) -> None:
    """Raises SceneError unless the parts are from and to, and for an axis how many."""
    if not isinstance(given, (tuple, list)) or len(given) != count:
        wanted = "an axis has from, to and how many" if count == 3 else "a side has from and to"
        raise SceneError(f"{name} = {brief(given)} has not {count} parts; {wanted}")


def grid(x: Axis, w: Axis) -> StartGrid:
    """A grid of heights (from, to, how many) and closing speeds (likewise); raises SceneError for
    others.

    >>> grid((0, 1, 3), (-1, 1, 2)).exact(3)
    (Fraction(1, 2), Fraction(1, 1))
    """
    return _grid_of(x, w, ("x", "w"))


def physical_grid(beta: Axis, v: Axis, r: Number, g: Number) -> StartGrid:
    """The same in the paper's units, as those of `physical`; v runs first, upwards, so that w = 1 -
    v/r falls.

    >>> grid = physical_grid((0, 1, 3), (-1, 1, 2), r=2, g=4)
    >>> grid.exact(2) == physical("1/2", -1, r=2, g=4).exact(0)
    True
    """
    given = _grid_of(beta, v, ("beta", "v"))
    units = positive(r, "r"), positive(g, "g")
    (x, w), (x_last, w_last) = (
        formulas().scaled(*ends, *units)
        for ends in (
            (given.heights.first, given.speeds.first),
            (given.heights.last, given.speeds.last),
        )
    )
    return StartGrid(Even(x, x_last, len(given.heights)), Even(w, w_last, len(given.speeds)))


def random(count: int, seed: int, x: Side = (0, 10), w: Side = (-5, 5)) -> Drawn:
    """This many states, uniform over a box of heights and closing speeds, whose ends are the floats
    next to those given; raises SceneError for a box or a number out of range.
    """
    counted(count, "the number of states", 1, MOST)
    counted(seed, "seed", 0, 2**64 - 1)
    heights, speeds = (
        tuple(nearest(end)[0] for end in _side(one, name)) for one, name in ((x, "x"), (w, "w"))
    )
    for name, (low, high) in (("x", heights), ("w", speeds)):
        if not -1e307 <= low <= high <= 1e307:
            raise SceneError(f"{name} runs from {low} to {high}; neither end may be beyond 1e307")
    height(heights[0])
    return Drawn(int(count), int(seed), (heights[0], heights[1]), (speeds[0], speeds[1]))


def _side(given: Side, name: str) -> tuple[Fraction, Fraction]:
    _refuse_other_parts(given, 2, name)
    low, high = (rational(end, name) for end in given)
    if high < low:
        raise SceneError(
            f"{name} runs from {brief(low)} to {brief(high)}; the second is to be the greater"
        )
    return low, high


def physical_box(beta: Side, v: Side, r: Number, g: Number) -> tuple[Side, Side]:
    """The sides x and w, for `random`, of a box in the paper's units.

    >>> physical_box((0, 4), (-1, 1), r=2, g=4)
    ((Fraction(0, 1), Fraction(2, 1)), (Fraction(1, 2), Fraction(3, 2)))
    """
    units = positive(r, "r"), positive(g, "g")
    low, high = zip(_side(beta, "beta"), _side(v, "v"))
    height(low[0], "beta")
    (x, w), (x_last, w_last) = formulas().scaled(*low, *units), formulas().scaled(*high, *units)
    return (x, x_last), (w_last, w)


def arrays(x: Floats, w: Floats) -> FloatStarts:
    """States from arrays of the same shape (n,) and of float64, finite, with x >= 0; raises
    SceneError for others.
    """
    try:
        xs, ws = np.asarray(x), np.asarray(w)
    except ValueError:
        raise SceneError("x or w is no array; give two arrays of one shape (n,), n >= 1") from None
    if xs.ndim != 1 or xs.shape != ws.shape or not 1 <= len(xs) <= MOST:
        raise SceneError(
            f"x and w have the shapes {xs.shape} and {ws.shape}; give two arrays of one shape (n,),"
            " n >= 1"
        )
    if xs.dtype != np.float64 or ws.dtype != np.float64:
        raise SceneError(f"x and w are of {xs.dtype} and {ws.dtype}; give float64")
    for name, values in (("x", xs), ("w", ws)):
        if not np.isfinite(values).all():
            raise SceneError(
                f"{name} = {values[~np.isfinite(values)][0]} is no finite number; give finite"
                " floats"
            )
    if (xs < 0).any():
        raise SceneError(f"x = {xs[xs < 0][0]} is below the table; a state has x >= 0")
    return FloatStarts(xs, ws)


def boundary(alpha: Number, count: int) -> OnBoundary:
    """Exact states on the boundary of R (23), from 2 to 10^6 of them: half on its energy level,
    half on the side x = 0; if the number is odd, one more on the level.

    On the level w runs over rationals within it, and x = (E - (1 - w)^2/2)/2 is rational too.

    >>> formulas().energy(*boundary("1/3", 3).exact(0)), region()(Fraction(1, 3))
    (Fraction(3, 1), Fraction(3, 1))
    """
    at = restitution(alpha)
    counted(count, "the number of states", 2, 10**6)
    level = region()(at)
    fine = 10**6
    # at most the root of 2 E, so that x >= 0
    reach = Fraction(isqrt(int(2 * level * fine**2)), fine)
    added = formulas().energy(Fraction(1), Fraction(1)) - formulas().energy(
        Fraction(0), Fraction(1)
    )
    return OnBoundary(level, reach, added, int(count))
