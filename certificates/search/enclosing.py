"""A lower bound of a polynomial on a box, with its proof, within a width of the value at a rational
point: the searches, in order.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from certificates.terms import ClaimError

from .box_tree import ROUNDING, Branching, Tree
from .float_minimum import FloatPolynomial, polished
from .plain_polynomials import Box, Terms, rounded_down, rounded_up, simple_points, value_at
from .sum_of_squares import search_squares

Point = tuple[Fraction, ...]
Node = list[Any]
Prove = Callable[
    [Fraction, Node], bool
]  # whether the checker accepts that the polynomial is at least so much, by this node
SIMPLE = 10**6  # the denominator of a value that may be the minimum itself
QUICK = 300  # boxes before squares are tried
FINE = Fraction(1, 10**13)  # a width for which floating point has no point good enough
SHARE = 8  # of the width, which the value at the point and its rounding may each take


@dataclass(frozen=True)
class Found:
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
    facts: list[list[int]]
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
        near = Fraction(value) + (
            self.width / SHARE if self.width else Fraction(1, 10**11) * (1 + abs(int(value)))
        )
        for point in simple_points(x, self.box):
            if self._take(point) <= near:
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


def search_enclosure(problem: Problem, width: Fraction, budget: int, prove: Prove) -> Found:
    """A bound from below within `width` of the value at a point where the budget of boxes allows,
    else the best that it came to.

    Trees first, in floating point unless the width is too small for it, then in integers; squares
    around the best point where boxes are slow.
    """
    best, done, squares_left = Best(problem.terms, problem.box, width), 0, budget >= QUICK
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
                found = _squares(problem, best, done + tree.boxes, prove)
                if found:
                    return found
            tree = branching.run(most)
            done += tree.boxes
            found = (_reached if tree.reached else _unfinished)(
                best, tree, done, ["boxes", problem.goal, problem.facts, tree.text], prove
            )
            if found:
                return found
        budget //= 4  # the checker's own count of work may have ended first
    raise ClaimError(
        "the polynomial is too large: the checker's counted work ends before its Bernstein"
        " coefficients are known"
    )


def _squares(problem: Problem, best: Best, done: int, prove: Prove) -> Found | None:
    """Squares that show that the value at the best point is the minimum; or, for a positive width,
    that the minimum is near it.
    """
    low, high = best.bounds
    for bound, top, point in [
        (best.exact, best.exact, best.point),
        *([(low, high, _shorter(best))] if best.width else []),
    ]:
        node = search_squares(
            problem.terms,
            problem.box,
            point,
            problem.names,
            problem.facts,
            problem.goal,
            value_at(problem.terms, point) - bound,
        )
        if node and prove(bound, node):
            return Found(bound, top, best.point, node, done, True)
    return None


def _shorter(best: Best) -> Point:
    """A point about as good as the best one, with short binary numbers: around it squares are
    shorter.
    """
    for bits in range(2, 200, 2):
        unit = Fraction(1, 2**bits)
        point = tuple(
            min(max(rounded_down(x + unit / 2, unit), low), high)
            for x, (low, high) in zip(best.point, best.box)
        )
        if value_at(best.terms, point) <= best.exact + best.width / SHARE:
            return point
    return best.point


def _reached(best: Best, tree: Tree, done: int, node: Node, prove: Prove) -> Found | None:
    """What a tree that reached its aim shows: the minimum itself where that is the simple value at
    the point, else a bound within the width.
    """
    low, high = best.bounds
    if low < high and best.exact.denominator <= SIMPLE and prove(best.exact, node):
        return Found(best.exact, best.exact, best.point, node, done, True)
    return Found(low, high, best.point, node, done, True) if prove(low, node) else None


def _unfinished(best: Best, tree: Tree, done: int, node: Node, prove: Prove) -> Found | None:
    """What the leaves of a tree show that did not reach its aim, rounded down until the checker
    accepts it.
    """
    for digits in (40, 12, 6, 0):
        low = rounded_down(tree.bound, Fraction(1, 10**digits)) - Fraction(1, 10**digits)
        if prove(low, node):
            return Found(low, best.exact, best.point, node, done, best.exact - low <= best.width)
    return None
