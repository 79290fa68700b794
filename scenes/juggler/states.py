"""Starting states by number: listed, on a grid, on the boundary of R, random, in arrays; each an
exact rational state, told as floats on demand.

All in normal form: x the height in units of r T, w the closing speed in units of r; x >= 0.
Whatever the number of states, only those asked for are made.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from scenes.juggler.formulas import formulas
from scenes.juggler.given import nearest

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
        """x, w as floats and bounds on what their rounding missed, each of shape (high - low,)."""


def _converted(
    states: Sequence[tuple[Fraction, Fraction]],
) -> tuple[Floats, Floats, Floats, Floats]:
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
class Even:
    """So many numbers from the first to the last, equally far apart, each made when it is asked
    for.
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
        """The numbers at these places as floats, and bounds on what their rounding missed."""
        some, back = np.unique(places, return_inverse=True)
        pairs = np.array([nearest(self[place]) for place in some.tolist()])[back]
        return pairs[:, 0].copy(), pairs[:, 1].copy()


@dataclass(frozen=True)
class Grid:
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
    """Floats of a seeded generator, uniform over a box; state i comes of draws 2 i and 2 i + 1,
    whatever block it is asked in.
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
        return (
            self.x[low:high].copy(),
            self.w[low:high].copy(),
            np.zeros(high - low),
            np.zeros(high - low),
        )
