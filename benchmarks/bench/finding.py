"""A rational point where the fraction of a problem is nearly greatest: floating point finds it, its
value is computed exactly.

In plain floats, since the problems are small: to load NumPy takes longer than all the rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import product
from math import inf

from benchmarks.bench.problems import Problem
from certificates.search.plain_polynomials import simple_points

Point = tuple[Fraction, ...]
Floats = list[float]
AXES = 3  # at a time: 27 places
STEPS, AHEAD = 200, 8
DAMPING, LEAST, MOST, FACTOR = 1e-3, 1e-18, 1e9, 8  # Levenberg's
NOISE = 2.0**-52
CLOSE = 1e-9  # what floating point tells apart for certain


def best_point(problem: Problem, slack: Fraction) -> tuple[Point, Fraction]:
    """A point of the box and the value there, which no point found exceeds by more than `slack`."""
    quotient = _Quotient(problem)
    value, place = quotient.greatest_near(float(slack))
    best: tuple[Point, Fraction] | None = None
    near = value - max(2 * float(slack), CLOSE)
    for point in simple_points(place, problem.box):
        if quotient.at([float(v) for v in point]) < near:
            continue  # too simple
        exact = problem.at(point)
        if exact is not None and (best is None or exact > best[1]):
            best = point, exact
        if best is not None and best[1] >= Fraction(value) - slack:
            break
    if best is None:
        raise ArithmeticError(f"{problem.name}: no point of the box has a value")
    return best


class _Quotient:
    """over/under in floating point, on the box."""

    def __init__(self, problem: Problem) -> None:
        self.low, self.high = ([float(pair[k]) for pair in problem.box] for k in (0, 1))
        self.monomials = [
            (e, float(problem.over.get(e, 0)), float(problem.under.get(e, 0)))
            for e in dict.fromkeys([*problem.over, *problem.under])
        ]
        self.most = max(max(e) for e, _, _ in self.monomials)

    def greatest_near(self, slack: float) -> tuple[float, Floats]:
        """(value, place) where the value no longer rises by much of the slack, from a start among
        the box's corners and middles.

        At a place where over/under = m, a damped Newton step for m under - over, kept in the box,
        leads to a greater value: Dinkelbach's iteration, a step at a time.  Source: Dinkelbach, On
        nonlinear fractional programming, Management Science 13 (1967).
        """
        value, x = self.start()
        damping, before = DAMPING, 0.0
        for _ in range(STEPS):
            slope, bend, noise = self.excess(x, value)
            free = [
                i
                for i, s in enumerate(slope)
                if s < 0 and x[i] < self.high[i] or s > 0 and x[i] > self.low[i]
            ]
            scale, gained = max(max(map(abs, row)) for row in bend) or 1.0, 0.0
            while free and damping < MOST and not gained > 0:
                step = solved(
                    [
                        [bend[i][j] + (damping * scale if i == j else 0.0) for j in free]
                        for i in free
                    ],
                    [slope[i] for i in free],
                )
                if step is not None:
                    moved = x[:]
                    for i, change in zip(free, step):
                        moved[i] = min(max(x[i] - change, self.low[i]), self.high[i])
                    after = self.at(moved)
                    gained = after - value
                    if (
                        not gained > 0
                        and sum(slope[i] * change for i, change in zip(free, step)) <= noise
                    ):
                        break  # a shorter step would gain even less
                damping = max(damping / FACTOR, LEAST) if gained > 0 else damping * FACTOR
            if not gained > 0:
                break
            x, value = moved, after
            if before and gained * min(gained / before, 1.0) <= slack / AHEAD:
                break  # gains go down at least so fast
            before = gained
        return value, x

    def start(self) -> tuple[float, Floats]:
        """(value, place), the best of all ends and middles of few axes at a time, from the middle
        of the box until nothing is gained.
        """
        ends = list(
            zip(self.low, [(low + high) / 2 for low, high in zip(self.low, self.high)], self.high)
        )
        best, place, gained = -inf, [middle for _, middle, _ in ends], True
        while gained:
            gained = False
            for k in range(0, len(ends), AXES):
                few = ends[k : k + AXES]
                value, moved = max(
                    (self.at(moved), moved)
                    for moved in (
                        [*place[:k], *chosen, *place[k + len(few) :]] for chosen in product(*few)
                    )
                )
                if value > best:
                    best, place, gained = value, moved, len(ends) > AXES
        return best, place

    def at(self, x: Sequence[float]) -> float:
        """The value at a place; -infinity where under is not positive."""
        over = under = 0.0
        for exponents, c, d in self.monomials:
            part = 1.0
            for v, e in zip(x, exponents):
                if e:
                    part *= v**e
            over += c * part
            under += d * part
        return over / under if under > 0 else -inf

    def excess(self, x: Floats, value: float) -> tuple[Floats, list[Floats], float]:
        """Gradient and Hessian of value * under - over at a place, and what rounding may change in
        it.
        """
        axes = range(len(x))
        powers = [[v**e for e in range(self.most + 1)] for v in x]
        slope, bend, noise = [0.0 for _ in axes], [[0.0 for _ in axes] for _ in axes], 0.0
        for exponents, c, d in self.monomials:
            factors = [table[e] for table, e in zip(powers, exponents)]
            noise += (abs(value * d) + abs(c)) * abs(_product(factors, 1.0))
            for i in axes:
                e = exponents[i]
                if not e:
                    continue
                others = factors[:]
                others[i] = e * powers[i][e - 1]
                slope[i] += _product(others, value * d - c)
                for j in range(i + 1, len(x)):
                    f = exponents[j]
                    if f:
                        kept, others[j] = others[j], f * powers[j][f - 1]
                        bend[i][j] += _product(others, value * d - c)
                        others[j] = kept
                if e > 1:
                    others[i] = e * (e - 1) * powers[i][e - 2]
                    bend[i][i] += _product(others, value * d - c)
        for i in axes:
            for j in range(i):
                bend[i][j] = bend[j][i]
        return slope, bend, NOISE * noise


def _product(factors: Floats, total: float) -> float:
    for factor in factors:
        total *= factor
    return total


def solved(matrix: list[Floats], right: Floats) -> Floats | None:
    """The solution of a symmetric system by Cholesky's method without roots; None where the matrix
    is not positive definite.

    >>> solved([[4.0, 2.0], [2.0, 3.0]], [8.0, 8.0])
    [1.0, 2.0]
    >>> solved([[1.0, 2.0], [2.0, 1.0]], [1.0, 1.0])
    """
    size, rows, found = len(right), [row[:] for row in matrix], right[:]
    for k in range(size):
        if not rows[k][k] > 0:
            return None
        for i in range(k + 1, size):
            factor = rows[i][k] / rows[k][k]
            for j in range(k, size):
                rows[i][j] -= factor * rows[k][j]
            found[i] -= factor * found[k]
    for k in reversed(range(size)):
        found[k] = (found[k] - sum(rows[k][j] * found[j] for j in range(k + 1, size))) / rows[k][k]
    return found
