"""The motion of a table that is no single sine: a sum of harmonics along each axis, with bounds of
the derivatives, on which flights rely.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from juggleproof.scenes.errors import SceneError

Sine = tuple[float, float, float]  # metres, hertz, radians
Pair = tuple[float, float]
MOST_SINES = 32
LARGEST, FASTEST, MOST_PHASE = 1.0, 1e4, 100.0  # metres, hertz, radians
UP = 1 + 1e-12  # the factor by which bounds are rounded up


@dataclass(frozen=True)
class Harmonics:
    """Sines along the table and away from it; made by `harmonics`."""

    along: tuple[Sine, ...]
    away: tuple[Sine, ...]

    def numbers(self) -> list[float]:
        """The drive as the kernels take it."""
        found: list[float] = []
        for axis in (self.along, self.away):
            found.append(len(axis))
            for A, f, phase in axis:
                found += [A, 2 * math.pi * f, phase]
        return found

    def bounds(self) -> tuple[Pair, Pair]:
        """(A, W) of each axis such that A W^k bounds the derivatives from the second on: W is the
        highest frequency, and A W^2 the sum of the accelerations.

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
        """The greatest distance of the table's height from 0, in metres."""
        return sum(abs(A) for A, _, _ in self.away)

    def rounded(self, until: float) -> float:
        """A bound of the rounding of the table's height until a time, in metres."""
        return sum(
            abs(A) * (2 * math.pi * f * until + abs(phase)) for A, f, phase in self.away
        ) * float(np.finfo(float).eps)

    def in_words(self) -> str:
        """The drive in words, in one line."""
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
