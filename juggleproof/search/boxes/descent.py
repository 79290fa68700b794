"""Points of a box where a polynomial is small, as floats propose them; its value there is exact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from juggleproof.algebra.box_trees import (
    Box,
    Exponents,
    Terms,
    derivative,
    rounded_down,
    rounded_up,
    simple_points,
    value_at,
)
from juggleproof.search import limits

# -------------------------------------------------------------------------------------------------
# Points where a polynomial is small on a box, found in floating point: nothing here is believed,
# every value is computed again exactly.

Array = NDArray[np.float64]
NOISE = 2.0**-52


class FloatPolynomial:
    """Value, gradient and Hessian, all from one pass over the monomials of the polynomial and of
    its derivatives.
    """

    def __init__(self, terms: Mapping[Exponents, Fraction | float], size: int) -> None:
        self.size = size
        self.pairs = [(i, j) for i in range(size) for j in range(i, size)]
        own = {e: float(c) for e, c in terms.items()}
        slopes = [derivative(own, i) for i in range(size)]
        parts = [own, *slopes, *(derivative(slopes[i], j) for i, j in self.pairs)]
        monomials = {e: k for k, e in enumerate(dict.fromkeys(e for part in parts for e in part))}
        self.exponents = np.array(list(monomials) or [(0,) * size], dtype=np.int64)
        self.most = int(self.exponents.max(initial=0))
        self.matrix = np.zeros((len(parts), len(self.exponents)))
        for row, part in enumerate(parts):
            for e, c in part.items():
                self.matrix[row, monomials[e]] = c

    def values(self, x: Array, rows: int | None = None) -> Array:
        """The value, then the slopes, then the second derivatives at x: the first `rows` of them.

        Shapes, for n variables: x (n,); all of the values (1 + n + n (n + 1) / 2,).
        """
        values: Array = self.matrix[:rows] @ self._monomials(x)
        return values

    def _monomials(self, x: Array) -> Array:
        table = np.ones((self.size, self.most + 1))
        for k in range(1, self.most + 1):
            table[:, k] = table[:, k - 1] * x
        values: Array = table[np.arange(self.size), self.exponents].prod(axis=1)
        return values

    def noise(self, x: Array) -> float:
        """What rounding may change in the value there."""
        return NOISE * float(np.abs(self.matrix[0]) @ np.abs(self._monomials(x)))

    def __call__(self, x: Array) -> float:
        return float(self.values(x, 1)[0])

    def descend(self, x: Array, low: Array, high: Array) -> tuple[float, Array]:
        """(value, point) where a damped Newton method, kept in the box, comes to rest; the damping
        is Levenberg's.
        """
        x = np.clip(x, low, high)
        value, damping = self(x), 1e-3
        for _ in range(limits.DESCENT_STEPS):
            data = self.values(x)
            slope, bend = data[1 : 1 + self.size], np.zeros((self.size, self.size))
            for (i, j), second in zip(self.pairs, data[1 + self.size :]):
                bend[i, j] = bend[j, i] = second
            free = ~(((x <= low) & (slope > 0)) | ((x >= high) & (slope < 0)))
            if not free.any() or not np.abs(slope[free]).max() > 0:
                break
            scale, found = max(float(np.abs(bend).max()), 1e-300), False
            while damping < 1e9 and not found:
                step = np.zeros(self.size)
                step[free] = self._step(bend[np.ix_(free, free)], slope[free], damping * scale)
                moved = np.clip(x - step, low, high)
                after = self(moved)
                found = after < value
                damping = max(damping / 8, 1e-18) if found else damping * 8
                if not found and float(slope @ step) <= self.noise(x):
                    break  # a shorter step would gain even less
            if not found:
                break
            x, value = moved, after
        return value, x

    @staticmethod
    def _step(bend: Array, slope: Array, damping: float) -> Array:
        if len(slope) == 1:  # the same, without the cost of a call to LAPACK
            step: Array = slope / (bend[0] + damping + max(0.0, -2 * float(bend[0, 0])))
            return step
        least = float(np.linalg.eigvalsh(bend)[0])
        damped = bend + (damping + max(0.0, -2 * least)) * np.eye(len(slope))
        step = np.linalg.solve(damped, slope).astype(np.float64, copy=False)
        return step


def polished(
    terms: Terms,
    polynomial: FloatPolynomial,
    x: Array,
    box: Sequence[tuple[Fraction, Fraction]],
    bits: int,
) -> list[Fraction]:
    """The stationary point next to x, in the coordinates that are not at an end of the box, to so
    many bits: exact gradients, a fixed Hessian.
    """
    point = [min(max(Fraction(float(v)), low), high) for v, (low, high) in zip(x, box)]
    free = [i for i, (v, (low, high)) in enumerate(zip(point, box)) if low < v < high]
    slopes = [derivative(terms, i) for i in free]
    data, bend = polynomial.values(x)[1 + polynomial.size :], np.zeros((len(free), len(free)))
    for (i, j), second in zip(polynomial.pairs, data):
        if i in free and j in free:
            bend[free.index(i), free.index(j)] = bend[free.index(j), free.index(i)] = second
    for _ in range(bits // 8 if free else 0):
        gradient = [value_at(slope, point) for slope in slopes]
        scale = max(map(abs, gradient))
        if scale * 2**bits < 1:
            break
        step = np.linalg.lstsq(bend, np.array([float(g / scale) for g in gradient]), rcond=1e-12)[0]
        for i, change in zip(free, step):
            moved = Fraction(round((point[i] - Fraction(float(change)) * scale) * 2**bits), 2**bits)
            point[i] = min(max(moved, box[i][0]), box[i][1])
    return point


# -------------------------------------------------------------------------------------------------
# A polynomial on a box, and the best point so far.

Point = tuple[Fraction, ...]


@dataclass(frozen=True)
class BoxProblem:
    """A polynomial on a box, and how a certificate speaks of it: the numbers of the facts low <= x
    and x <= high, and of the goal's negation.
    """

    terms: Terms
    box: Box
    names: list[str]
    facts: list[tuple[int, int]]
    goal: int


class Best:
    """The best point so far, and the bounds that follow from it."""

    def __init__(self, terms: Terms, box: Box, width: Fraction) -> None:
        self.terms, self.box, self.width = terms, box, width
        self.polynomial = FloatPolynomial(terms, len(box))
        self.low, self.high = (np.array([float(pair[k]) for pair in box]) for k in (0, 1))
        self.value = float("inf")
        self.unit = _decimal_below(width / limits.WIDTH_SHARE) if width else Fraction(0)
        self.point: Point = tuple(low for low, _ in box)
        self.exact = value_at(terms, self.point)
        self.bounds = self._bounds()
        for place in (0.5, 0.25, 0.75):
            self.offer((place,) * len(box))

    def offer(self, place: Sequence[float]) -> None:
        """Takes a point of the unit box: where the polynomial is smaller than anywhere before, it
        goes down from there.
        """
        x = self.low + (self.high - self.low) * np.array(place)
        value = self.polynomial(x)
        if (
            value >= self.value - 1e-12 * (1 + abs(self.value))
            and value >= self.value - float(self.width) / limits.WIDTH_SHARE
        ):
            return
        value, x = self.polynomial.descend(x, self.low, self.high)
        if value >= self.value:
            return
        self.value = value
        enough = Fraction(value) + (
            self.width / limits.WIDTH_SHARE
            if self.width
            else Fraction(1, 10**11) * (1 + abs(int(value)))
        )
        for point in simple_points(x, self.box):
            if self._take(point) <= enough:
                break
        if 0 < self.width < limits.LEAST_WIDTH:
            bits = 2 * (1 / self.width).numerator.bit_length()
            for some in (bits // 4, bits // 2, bits):
                self._take(polished(self.terms, self.polynomial, x, self.box, some))

    def _take(self, point: Sequence[Fraction]) -> Fraction:
        exact = value_at(self.terms, point)
        if exact < self.exact:
            self.exact, self.point = exact, tuple(point)
            self.bounds = self._bounds()
        return exact

    def _bounds(self) -> tuple[Fraction, Fraction]:
        high = (
            rounded_up(self.exact, self.unit)
            if self.unit and self.exact.denominator > limits.SIMPLE
            else self.exact
        )
        return high - self.width, high


def _decimal_below(value: Fraction) -> Fraction:
    unit = Fraction(1)
    while unit > value:
        unit /= 10
    return unit


def shorter(best: Best, slack: Fraction) -> Point:
    """A point whose value is at most `slack` above the best one's, with short binary numbers:
    around it squares are shorter.
    """
    for bits in range(2, 200, 2):
        unit = Fraction(1, 2**bits)
        point = tuple(
            min(max(rounded_down(x + unit / 2, unit), low), high)
            for x, (low, high) in zip(best.point, best.box)
        )
        if value_at(best.terms, point) <= best.exact + slack:
            return point
    return best.point
