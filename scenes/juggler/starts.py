"""Where orbits start: points, grids, the boundary of R, random states, arrays; each an exact rational state, told as floats on demand.

All in normal form: x the height in units of r T, w the closing speed in units of r; x >= 0.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from scenes.errors import SceneError
from scenes.juggler.formulas import formulas, region

Number: TypeAlias = int | float | str | Fraction  # a float means the binary number that it is
Floats: TypeAlias = NDArray[np.float64]
Axis: TypeAlias = tuple[Number, Number, int]  # from, to, how many
MOST = 10**8  # starts of one scene
BITS = 14000  # of a numerator or denominator that is given; Python writes numbers of up to 4300 digits


def rational(value: Number, name: str) -> Fraction:
    """The number exactly; SceneError for what is none.

    >>> rational("1/3", "x"), rational(0.5, "x")
    (Fraction(1, 3), Fraction(1, 2))
    """
    try:
        found = Fraction(value)
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        raise SceneError(f"{name} = {str(value)[:40]} is no finite number; give an integer, a fraction or a finite float") from None
    if max(found.numerator.bit_length(), found.denominator.bit_length()) > BITS:
        raise SceneError(f"{name} is longer than {BITS} bits; choose a shorter number")
    return found


def height(value: Number, name: str = "x") -> Fraction:
    """A height, which is at least 0."""
    found = rational(value, name)
    if found < 0:
        raise SceneError(f"{name} = {_short(found)} is below the table; a state has {name} >= 0")
    return found


def counted(value: int, name: str, least: int, most: int) -> int:
    """A whole number within its bounds."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not least <= value <= most:
        raise SceneError(f"{name} = {str(value)[:40]} is not a whole number from {least} to {most}")
    return int(value)


def _short(value: Fraction) -> str:
    return str(value) if max(value.numerator.bit_length(), value.denominator.bit_length()) < 64 else "a long fraction"


def nearest(value: Fraction) -> tuple[float, float]:
    """A float next to the number, and a bound on their difference, itself rounded up; infinities for what is beyond the floats.

    >>> nearest(Fraction(1, 2)), 0 < nearest(Fraction(1, 3))[1] < 2**-54
    ((0.5, 0.0), True)
    """
    try:
        found = float(value)
    except OverflowError:
        return math.inf, math.inf
    missed = abs(value - Fraction(found))
    return found, math.nextafter(float(missed), math.inf) if missed else 0.0


class Starts(Protocol):
    """Starting states by number, from 0 to count - 1."""

    @property
    def count(self) -> int:
        """How many there are."""

    def exact(self, index: int) -> tuple[Fraction, Fraction]:
        """The state (x, w) of this number."""

    def block(self, low: int, high: int) -> tuple[Floats, Floats, Floats, Floats]:
        """x, w as floats and bounds on what their rounding missed, each of shape (high - low,)."""


def _converted(states: Sequence[tuple[Fraction, Fraction]]) -> tuple[Floats, Floats, Floats, Floats]:
    pairs = [(*nearest(one), *nearest(two)) for one, two in states]
    found = np.array(pairs, dtype=np.float64).reshape(-1, 4)
    return found[:, 0].copy(), found[:, 2].copy(), found[:, 1].copy(), found[:, 3].copy()


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
class Grid:
    """All pairs of heights and closing speeds; the speed runs first."""

    heights: tuple[Fraction, ...]
    speeds: tuple[Fraction, ...]

    @property
    def count(self) -> int:
        return len(self.heights) * len(self.speeds)

    def exact(self, index: int) -> tuple[Fraction, Fraction]:
        return self.heights[index // len(self.speeds)], self.speeds[index % len(self.speeds)]

    def block(self, low: int, high: int) -> tuple[Floats, Floats, Floats, Floats]:
        at = np.arange(low, high)
        first, last = low // len(self.speeds), (high - 1) // len(self.speeds) + 1
        xs = np.array([nearest(one) for one in self.heights[first:last]]).reshape(-1, 2)[at // len(self.speeds) - first]
        ws = np.array([nearest(one) for one in self.speeds])[at % len(self.speeds)]
        return xs[:, 0].copy(), ws[:, 0].copy(), xs[:, 1].copy(), ws[:, 1].copy()


@dataclass(frozen=True)
class Drawn:
    """Floats of a seeded generator, uniform over a box; state i comes of draws 2 i and 2 i + 1, whatever block it is asked in."""

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
class Array:
    """Arrays of floats, which are taken as the binary numbers that they are."""

    x: Floats
    w: Floats

    @property
    def count(self) -> int:
        return len(self.x)

    def exact(self, index: int) -> tuple[Fraction, Fraction]:
        return Fraction(float(self.x[index])), Fraction(float(self.w[index]))

    def block(self, low: int, high: int) -> tuple[Floats, Floats, Floats, Floats]:
        return self.x[low:high].copy(), self.w[low:high].copy(), np.zeros(high - low), np.zeros(high - low)


def point(x: Number, w: Number) -> Listed:
    """One state.

    >>> point(0, "3/2").exact(0)
    (Fraction(0, 1), Fraction(3, 2))
    """
    return Listed(((height(x), rational(w, "w")),))


def listed(states: Sequence[tuple[Number, Number]]) -> Listed:
    """States one by one, at least one."""
    if not states:
        raise SceneError("no states are given; give one at least")
    return Listed(tuple((height(x), rational(w, "w")) for x, w in states))


def physical(beta: Number, v: Number, r: Number, g: Number) -> Listed:
    """One state in the paper's units: height beta and upward speed v of the ball when the table is lowest; launch speed r > 0, gravity g > 0.

    >>> physical(1, "-1/2", 2, 4).exact(0)
    (Fraction(1, 2), Fraction(5, 4))
    """
    known = {name: rational(value, name) for name, value in (("r", r), ("g", g))}
    for name, value in known.items():
        if value <= 0:
            raise SceneError(f"{name} = {_short(value)} is not positive; the launch speed r and gravity g are")
    return Listed((formulas().scaled(height(beta, "beta"), rational(v, "v"), known["r"], known["g"]),))


def axis(low: Number, high: Number, count: int, name: str) -> tuple[Fraction, ...]:
    """So many numbers from low to high, equally far apart."""
    start, stop = rational(low, name), rational(high, name)
    counted(count, f"the number of {name}", 1, MOST)
    if count > 1 and stop <= start:
        raise SceneError(f"{name} runs from {_short(start)} to {_short(stop)}; the second is to be the greater")
    return tuple(start + (stop - start) * Fraction(k, max(count - 1, 1)) for k in range(count))


def grid(x: Axis, w: Axis) -> Grid:
    """A grid of heights (from, to, how many) and closing speeds (likewise).

    >>> grid((0, 1, 3), (-1, 1, 2)).exact(3)
    (Fraction(1, 2), Fraction(1, 1))
    """
    for one, name in ((x, "x"), (w, "w")):
        if len(one) != 3:
            raise SceneError(f"{name} = {one} has {len(one)} parts; an axis has from, to and how many")
    height(x[0])
    counted(x[2] * w[2], "the number of states", 1, MOST)
    return Grid(axis(*x, "x"), axis(*w, "w"))


def random(count: int, seed: int, x: tuple[Number, Number] = (0, 10), w: tuple[Number, Number] = (-5, 5)) -> Drawn:
    """So many states, uniform over a box of heights and closing speeds."""
    counted(count, "the number of states", 1, MOST)
    counted(seed, "seed", 0, 2**64 - 1)
    sides = [(nearest(rational(low, name))[0], nearest(rational(high, name))[0]) for name, (low, high) in (("x", x), ("w", w))]
    for name, (low, high) in zip("xw", sides):
        if not -1e307 <= low <= high <= 1e307:
            raise SceneError(f"{name} runs from {low} to {high}; the second is to be the greater, and neither beyond 1e307")
    height(sides[0][0])
    return Drawn(count, seed, *sides)


def arrays(x: Floats, w: Floats) -> Array:
    """Arrays of the same shape (n,), finite, with x >= 0."""
    xs, ws = np.asarray(x), np.asarray(w)
    if xs.ndim != 1 or xs.shape != ws.shape or not 1 <= len(xs) <= MOST:
        raise SceneError(f"x and w have the shapes {xs.shape} and {ws.shape}; give two arrays of one shape (n,), n >= 1")
    if xs.dtype != np.float64 or ws.dtype != np.float64:
        raise SceneError(f"x and w are of {xs.dtype} and {ws.dtype}; give float64")
    for name, values in (("x", xs), ("w", ws)):
        if not np.isfinite(values).all():
            raise SceneError(f"{name} = {values[~np.isfinite(values)][0]} is no finite number; give finite floats")
    if (xs < 0).any():
        raise SceneError(f"x = {xs[xs < 0][0]} is below the table; a state has x >= 0")
    return Array(xs, ws)


def boundary(alpha: Number, count: int) -> Listed:
    """So many exact states on the boundary of R: half of them on its energy level, half on the side x = 0 (the odd one on the level).

    On the level w runs over rationals within it, and x = (E - (1 - w)^2/2)/2 is rational too.

    >>> formulas().energy(*boundary("1/3", 3).exact(0)), region()(Fraction(1, 3))
    (Fraction(3, 1), Fraction(3, 1))
    """
    at = restitution(alpha)
    counted(count, "the number of states", 2, 10**6)
    level = region()(at)
    fine = 10**6
    reach = Fraction(isqrt(int(2 * level * fine**2)), fine)  # at most the root of 2 E, so that x >= 0
    on_level, on_side = count - count // 2, count // 2
    speeds = [1 + reach * Fraction(2 * j + 1 - on_level, on_level) for j in range(on_level)]
    ground = [1 + reach * Fraction(2 * j + 1 - on_side, on_side) for j in range(on_side)]
    # The energy is linear in x: what is missing at x = 0, in units of what one unit of height adds.
    add = formulas().energy(Fraction(1), Fraction(1)) - formulas().energy(Fraction(0), Fraction(1))
    return Listed(tuple([((level - formulas().energy(Fraction(0), speed)) / add, speed) for speed in speeds]
                        + [(Fraction(0), speed) for speed in ground]))


def restitution(alpha: Number) -> Fraction:
    """The restitution, strictly between 0 and 1."""
    found = rational(alpha, "alpha")
    if not 0 < found < 1:
        raise SceneError(f"alpha = {_short(found)} is not between 0 and 1; the restitution has 0 < alpha < 1")
    return found
