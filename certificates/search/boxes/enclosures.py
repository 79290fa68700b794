"""A lower bound of a polynomial on a box with its proof, close to the value at a point that floats
propose.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from juggleproof.certificates.language import ClaimError
from juggleproof.certificates.nodes import Node
from juggleproof.certificates.search.boxes.branching import ROUNDING, Branching, Tree
from juggleproof.certificates.search.boxes.small import (
    Box,
    Exponents,
    Terms,
    derivative,
    rounded_down,
    rounded_up,
    simple_points,
    value_at,
)
from juggleproof.certificates.search.boxes.squares import program_around
from juggleproof.certificates.search.psatz.sums_of_squares import search_squares
from juggleproof.certificates.work import Budget

# -------------------------------------------------------------------------------------------------
# Points where a polynomial is small on a box, found in floating point: nothing here is believed,
# every value is computed again exactly.

Array = NDArray[np.float64]
STEPS = 200
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
        for _ in range(STEPS):
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
# A lower bound of a polynomial on a box, with its proof, within a width of the value at a rational
# point: the searches, in order.

Point = tuple[Fraction, ...]
BySquares = Callable[
    [Fraction], Node | None
]  # a node, by squares times facts, that the polynomial is at least so much
Prove = Callable[
    [Fraction, Node], bool
]  # whether the checker accepts that the polynomial is at least so much, by this node
SIMPLE = 10**6  # the denominator of a value that may be the minimum itself
QUICK = 300  # boxes before squares are tried
SQUARES = 100_000_000  # units of work for squares
FINE = Fraction(1, 10**13)  # a width for which floating point has no point good enough
LADDER = [Fraction(10) ** -k for k in range(-3, 17)]  # of widths
NEAR, FAR = Fraction(1, 10**9), Fraction(1, 10**4)  # how far below it a simple value may be
SIMPLEST = (1, 60, 1000, SIMPLE)  # its denominator
SHARE = 8  # of the width, which the value at the point and its rounding may each take


@dataclass(frozen=True)
class Bounds:
    """min >= low by the node, and min <= high at the point; `reached` says whether high - low is
    within the width that was asked for.
    """

    low: Fraction
    high: Fraction
    point: Point
    node: Node
    boxes: int
    reached: bool


@dataclass(frozen=True)
class Problem:
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
        self.unit = _decimal_below(width / SHARE) if width else Fraction(0)
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
            and value >= self.value - float(self.width) / SHARE
        ):
            return
        value, x = self.polynomial.descend(x, self.low, self.high)
        if value >= self.value:
            return
        self.value = value
        enough = Fraction(value) + (
            self.width / SHARE if self.width else Fraction(1, 10**11) * (1 + abs(int(value)))
        )
        for point in simple_points(x, self.box):
            if self._take(point) <= enough:
                break
        if 0 < self.width < FINE:
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
            if self.unit and self.exact.denominator > SIMPLE
            else self.exact
        )
        return high - self.width, high


def _decimal_below(value: Fraction) -> Fraction:
    unit = Fraction(1)
    while unit > value:
        unit /= 10
    return unit


def search_enclosure(
    problem: Problem, width: Fraction, budget: int, prove: Prove, by_squares: BySquares
) -> Bounds:
    """A bound from below within `width` of the value at a point where the budget of boxes allows,
    else the best that it came to, also when other widths are asked for.

    So no width fails where a wider one is reached with a quarter of the boxes, nor where a narrower
    one is with few: from wide to narrow as far as they are reached, then narrower ones.

    Raises ClaimError where the polynomial is too large for the checker.
    """
    found = _search_width(problem, width, budget, prove, by_squares)
    for other in () if found.reached else LADDER:
        if found.high - found.low <= width or found.boxes > 2 * budget:
            break
        if width <= other < found.high - found.low:
            more = _search_width(problem, other, max(1, budget // 4), prove, by_squares)
            found = _both(found, more, width)
            if not more.reached:
                break
    for other in (*LADDER, Fraction(0)):
        if found.high - found.low <= width or found.boxes > 2 * budget:
            break
        if other < width:
            more = _search_width(problem, other, min(budget, 4 * QUICK), prove, by_squares)
            found = _both(found, more, width)
    return found


def _both(first: Bounds, second: Bounds, width: Fraction) -> Bounds:
    """The better bound of each side."""
    below = max(first, second, key=lambda one: one.low)
    above = min(first, second, key=lambda one: one.high)
    reached, boxes = above.high - below.low <= width, first.boxes + second.boxes
    return Bounds(below.low, above.high, above.point, below.node, boxes, reached)


def _search_width(
    problem: Problem, width: Fraction, budget: int, prove: Prove, by_squares: BySquares
) -> Bounds:
    """The bounds that one search comes to.

    Trees first, in floating point unless the width is too small for it, then in integers; squares
    around the best point where boxes are slow.
    """
    best, done, squares_left = Best(problem.terms, problem.box, width), 0, budget >= QUICK
    kept: Bounds | None = None
    floats = width >= 64 * ROUNDING * max(map(abs, problem.terms.values()))
    while budget:
        for exact in (False, True) if floats else (True,):
            branching = Branching(
                problem.terms, problem.box, lambda: best.bounds[0], best.offer, exact
            )
            most = min(budget, branching.affordable())
            tree = branching.run(min(QUICK, most))
            if not tree.reached and squares_left:
                squares_left = False
                kept = _squares(problem, best, done + tree.boxes, prove, by_squares)
                if kept and kept.reached:
                    return kept
            tree = branching.run(most)
            done += tree.boxes
            found = (_reached if tree.reached else _unfinished)(
                best, tree, done, ("boxes", problem.goal, problem.facts, tree.text), prove
            )
            if found:
                return _both(kept, found, width) if kept else found
        budget //= 4  # the checker's own count of work may have ended first
    raise ClaimError(
        "the polynomial is too large: the checker's counted work ends before its Bernstein"
        " coefficients are known"
    )


def _squares(
    problem: Problem, best: Best, done: int, prove: Prove, by_squares: BySquares
) -> Bounds | None:
    """Squares that show that the value at the best point is the minimum, or a simple number just
    below it; or, for a positive width, that the minimum is within the width of it.
    """
    low, high = best.bounds
    simple = _simple_below(best)
    centres = [
        (best.exact, best.exact, best.point),
        *([(low, high, _shorter(best, best.width / SHARE))] if best.width else []),
    ]
    for bound, top, point in centres:
        program = program_around(
            problem.terms,
            problem.box,
            point,
            problem.names,
            problem.facts,
            problem.goal,
            value_at(problem.terms, point) - bound,
        )
        node = search_squares([program], Budget(SQUARES)) if program else None
        if node and prove(bound, node):
            return Bounds(bound, top, best.point, node, done, True)
        node = by_squares(simple) if bound == best.exact and simple is not None else None
        if node and simple is not None and prove(simple, node):
            reached = best.exact - simple <= best.width
            return Bounds(simple, best.exact, best.point, node, done, reached)
    return None


def _simple_below(best: Best) -> Fraction | None:
    """A number of small denominator at the value at the best point, or just below it."""
    near = (1 + abs(best.exact)) * min(max(NEAR, best.width), FAR)
    for most in SIMPLEST:
        simple = best.exact.limit_denominator(most)
        if simple <= best.exact <= simple + near:
            return simple
    return None


def _shorter(best: Best, slack: Fraction) -> Point:
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


def _reached(best: Best, tree: Tree, done: int, node: Node, prove: Prove) -> Bounds | None:
    """What a tree that reached its aim shows: the minimum itself where that is the simple value at
    the point, else a bound within the width.
    """
    low, high = best.bounds
    if low < high and best.exact.denominator <= SIMPLE and prove(best.exact, node):
        return Bounds(best.exact, best.exact, best.point, node, done, True)
    return Bounds(low, high, best.point, node, done, True) if prove(low, node) else None


def _unfinished(best: Best, tree: Tree, done: int, node: Node, prove: Prove) -> Bounds | None:
    """What the leaves of a tree show that did not reach its aim, rounded down until the checker
    accepts it.
    """
    for digits in (40, 12, 6, 0):
        low = rounded_down(tree.bound, Fraction(1, 10**digits)) - Fraction(1, 10**digits)
        if prove(low, node):
            return Bounds(low, best.exact, best.point, node, done, best.exact - low <= best.width)
    return None


# -------------------------------------------------------------------------------------------------
# A bound that is asked: that a polynomial is nowhere negative, or everywhere positive, on a box.


def search_positive(problem: Problem, weakly: bool, most: int, budget: Budget) -> Node | None:
    """A node of a tree of at most `most` boxes, or of squares, that closes p < 0, or p <= 0 where
    not `weakly`; None where p has such a value at a point, or none was found.

    Squares close p < 0 also where p <= 0 is asked: then a number is added to them.

    Raises Exhausted where the budget ends.
    """
    best = Best(problem.terms, problem.box, Fraction(0))

    def target() -> Fraction:
        """A number that all coefficients are to reach; any, where there is no such number."""
        return best.exact / 16 if best.exact > 0 and not weakly else min(best.exact, Fraction(0))

    def is_open() -> bool:
        return best.exact > 0 or weakly and not best.exact

    tried = False
    for exact in (False, True):
        branching = Branching(problem.terms, problem.box, target, best.offer, exact)
        boxes, cost = 1, 2 + branching.numbers.root.size // 200
        for most_here in (min(QUICK, most), min(most, branching.affordable())):
            tree = branching.run(most_here) if is_open() else None
            if tree is None or not is_open():
                return None
            budget.spend((tree.boxes - boxes) * cost)
            boxes = tree.boxes
            if tree.reached:
                return "boxes", problem.goal, problem.facts, tree.text
            node = None if tried else _squares_above(problem, best, target(), budget)
            tried = True
            if node is not None:
                return node
    return None


def _squares_above(
    problem: Problem, best: Best, bound: Fraction, budget: Budget
) -> Node | None:
    """Squares that show that p is at least the bound, by the fact -p > 0, or -p >= 0 where the
    bound is positive.
    """
    point = best.point if best.exact == bound else _shorter(best, (best.exact - bound) / SHARE)
    gap = value_at(problem.terms, point) - bound
    program = program_around(
        problem.terms, problem.box, point, problem.names, problem.facts, problem.goal, gap
    )
    node = search_squares([program], budget) if program else None
    if node is None or node[0] != "psatz":
        return None
    own = ((problem.goal, 1),)
    more = [
        (str(Fraction(c) * bound), (), "1") for c, factors, _ in node[1] if factors == own and bound
    ]
    return "psatz", [*node[1], *more], []
