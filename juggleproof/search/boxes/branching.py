"""Bounds on a box, by a tree of halved boxes and their Bernstein coefficients."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from math import comb, gcd, lcm, prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from juggleproof.algebra.box_trees import LETTERS, Box, Terms
from juggleproof.search import limits

# -------------------------------------------------------------------------------------------------
# Polynomials on a box as tensors of Bernstein coefficients, in floating point or in exact
# integers, by the same steps.

Tensor = NDArray[Any]  # of floats, or of Python's integers, by the same steps
NOTHING: Tensor = np.zeros(0)  # the coefficients of a box that is no longer open
BEFORE = [(slice(None),) * axis for axis in range(26)]  # the axes before one, in an index


def bernstein_tensor(terms: Terms, box: Box) -> tuple[Tensor, int]:
    """(integers, unit): the Bernstein coefficients on the box are integers / unit, as an array of
    Python ints of shape (n_1 + 1, .., n_k + 1) for degrees n_i in the k variables.

    x^e on [a, b], in degree n, has as its j-th coefficient sum_k C(n - j, e - k) C(j, k) a^(e - k)
    b^k / C(n, e).
    """
    size = len(box)
    degrees = [max(e[i] for e in terms) for i in range(size)]
    unit = lcm(*(c.denominator for c in terms.values()))
    tensor: Tensor = np.zeros([n + 1 for n in degrees], dtype=object)
    for exponents, c in terms.items():
        tensor[exponents] = int(c * unit)
    for axis in range(
        size - 1, -1, -1
    ):  # what is not yet spread out is mostly 0, and one slice an exponent
        matrix, scale = _axis_matrix(degrees[axis], *box[axis])
        unit *= scale
        tensor = _along(matrix, tensor, axis)
    return tensor, unit


def _along(matrix: list[list[int]], tensor: Tensor, axis: int) -> Tensor:
    slices = [part_of(tensor, axis, e) for e in range(tensor.shape[axis])]
    used = [e for e, part in enumerate(slices) if part.any()]
    result = np.zeros(tensor.shape, dtype=object)
    for j, row in enumerate(matrix):
        for e in used:
            if row[e]:
                result[BEFORE[axis] + (j,)] += row[e] * slices[e]
    return result


def part_of(tensor: Tensor, axis: int, index: int) -> Tensor:
    """The part of a tensor with this index along an axis, an array also where it is one number."""
    part: Tensor = tensor[BEFORE[axis] + (index, ...)]
    return part


def _axis_matrix(n: int, low: Fraction, high: Fraction) -> tuple[list[list[int]], int]:
    d, whole = lcm(low.denominator, high.denominator), lcm(*(comb(n, e) for e in range(n + 1)))
    a, b = int(low * d), int(high * d)
    rows = [
        [
            whole
            // comb(n, e)
            * d ** (n - e)
            * sum(comb(n - j, e - k) * comb(j, k) * a ** (e - k) * b**k for k in range(e + 1))
            for e in range(n + 1)
        ]
        for j in range(n + 1)
    ]
    return rows, whole * d**n


@lru_cache(256)
def halving(n: int, exact: bool) -> tuple[Tensor, Tensor]:
    """The matrices, of shape (n + 1, n + 1), that take coefficients of degree n to those on the
    lower and on the upper half, times 2^n where exact.
    """
    lower = np.array(
        [[comb(j, k) * 2 ** (n - j) if k <= j else 0 for k in range(n + 1)] for j in range(n + 1)],
        dtype=object,
    )
    upper = lower[::-1, ::-1].copy()
    return (lower, upper) if exact else ((lower / 2**n).astype(float), (upper / 2**n).astype(float))


def along_first(matrix: Tensor, tensor: Tensor, axis: int) -> Tensor:
    """The matrix (n, n) applied along an axis of length n, which becomes the first one."""
    moved = np.moveaxis(tensor, axis, 0)
    return (matrix @ moved.reshape(len(moved), -1)).reshape(moved.shape)


# -------------------------------------------------------------------------------------------------
# Branch and bound with Bernstein coefficients, the box of least bound first: a box tree for the
# checker, and the bound that it shows.

Places = list[tuple[int, float, float]]
Improve = Callable[[tuple[float, ...]], None]


@dataclass
class Subbox:
    """A box of the tree: the faces taken on the way to it, its coefficients while it is open, and
    its place in the whole box.
    """

    prefix: str
    tensor: Tensor
    unit: int
    places: Places  # for each axis: the variable, and low and high in [0, 1]
    fixed: dict[int, float]
    bound: Fraction | float
    letter: str = "."
    children: list[Subbox] = field(default_factory=list)


@dataclass
class BoxTree:
    """What a search has come to: the tree as text, a number below all its leaves, how many boxes it
    has, and whether it reached its target.
    """

    text: str
    bound: Fraction
    boxes: int
    reached: bool


class BernsteinArithmetic:
    """The coefficients as integers: Python's, exact, or floats, exact as long as 53 bits hold them
    on their way down the tree.

    A coefficient of a node is the number in its tensor, divided by the node's unit (where exact)
    and by `scale`.
    """

    def __init__(self, terms: Terms, box: Box, exact: bool) -> None:
        tensor, unit = bernstein_tensor(terms, box)
        common = gcd(*tensor.flat) or 1
        self.exact, self.scale = exact, Fraction(unit, common)
        whole = tensor // common
        most = abs(whole).max()
        self.root = whole if exact else whole.astype(float)
        self.bits = int(most).bit_length()
        self.slack = 0.0 if exact else float(most) * limits.TREE_ROUNDING

    def slack_of(self, unit: int) -> float:
        """What a difference of two coefficients of a node may be off by."""
        return 0.0 if self.exact or self.bits + unit.bit_length() <= 53 else self.slack

    def goal(self, target: Fraction) -> Fraction | float:
        """What the least coefficient of a leaf has to reach, in the scale of the nodes."""
        return target * self.scale if self.exact else float(target * self.scale) + self.slack

    def bound(self, goal: Fraction | float) -> Fraction:
        """The number below all coefficients that are at least so much."""
        return (Fraction(goal) - Fraction(self.slack)) / self.scale

    def subbox(self, tensor: Tensor, unit: int, places: Places, fixed: dict[int, float]) -> Subbox:
        """The box, after every face that monotony allows."""
        prefix, axis, slack = "", 0, self.slack_of(unit)
        while axis < tensor.ndim:
            step = tensor[(*BEFORE[axis], slice(1, None))] - tensor[(*BEFORE[axis], slice(0, -1))]
            rises = step.min() >= slack
            if not rises and not step.max() <= -slack:
                axis += 1
                continue
            prefix += LETTERS[axis].upper()
            variable, low, high = places[axis]
            tensor = part_of(tensor, axis, 0 if rises else tensor.shape[axis] - 1)
            places, fixed, axis = (
                places[:axis] + places[axis + 1 :],
                {**fixed, variable: low if rises else high},
                0,
            )
        least = tensor.min()
        return Subbox(
            prefix,
            tensor,
            unit,
            places,
            fixed,
            Fraction(int(least), unit) if self.exact else float(least),
        )

    def halves(self, node: Subbox, axis: int) -> list[Subbox]:
        """The children of a node, which from here on keeps no coefficients."""
        degree = node.tensor.shape[axis] - 1
        variable, low, high = node.places[axis]
        others, middle = node.places[:axis] + node.places[axis + 1 :], (low + high) / 2
        node.letter = LETTERS[axis]
        node.children = [
            self.subbox(
                along_first(matrix, node.tensor, axis),
                node.unit << degree,
                [(variable, *ends), *others],
                node.fixed,
            )
            for matrix, ends in zip(halving(degree, self.exact), ((low, middle), (middle, high)))
        ]
        node.tensor = NOTHING
        return node.children


class Branching:
    """Halves boxes until all coefficients on all leaves are at least `target()`, which may fall
    while `improve` finds better points.

    `improve` receives the place in the unit box where a coefficient is least.  Source: Garloff, The
    Bernstein algorithm, Interval Computations 2 (1993).
    """

    def __init__(
        self, terms: Terms, box: Box, target: Callable[[], Fraction], improve: Improve, exact: bool
    ) -> None:
        self.numbers, self.target, self.improve = (
            BernsteinArithmetic(terms, box, exact),
            target,
            improve,
        )
        self.root = self.numbers.subbox(
            self.numbers.root, 1, [(i, 0.0, 1.0) for i in range(len(box))], {}
        )
        self.boxes, self.heap, self.stuck = 1, [(self.root.bound, 0, self.root)], False

    def affordable(self) -> int:
        """The number of boxes that are worth their products; products of floats are cheaper."""
        shape: tuple[int, ...] = self.numbers.root.shape
        return max(
            1,
            (limits.TREE_PRODUCTS if self.numbers.exact else 100 * limits.TREE_PRODUCTS)
            // (prod(shape) * max(shape)),
        )

    def run(self, budget: int) -> BoxTree:
        """Goes on until the target is reached, there are `budget` boxes, or halving leads
        nowhere.
        """
        goal = self.numbers.goal(self.target())
        while self.heap and self.heap[0][0] < goal and self.boxes < budget and not self.stuck:
            node = self.heap[0][2]
            self.improve(_least_at(node))
            goal = self.numbers.goal(self.target())
            axis = _axis_to_halve(node.tensor)
            self.stuck = (
                axis is None or node.unit.bit_length() > limits.TREE_BITS
            )  # None: every coefficient is a value at a corner
            if node.bound < goal and axis is not None and not self.stuck:
                heapq.heappop(self.heap)
                self._halve(node, axis, goal)
        reached = not self.heap or self.heap[0][0] >= goal
        return BoxTree(
            _text(self.root),
            self.target() if reached else self.numbers.bound(self.heap[0][0]),
            self.boxes,
            reached,
        )

    def _halve(self, node: Subbox, axis: int, goal: Fraction | float) -> None:
        for child in self.numbers.halves(node, axis):
            self.boxes += 1
            if child.bound < goal:
                heapq.heappush(self.heap, (child.bound, self.boxes, child))
            else:
                child.tensor = NOTHING


def _axis_to_halve(tensor: Tensor) -> int | None:
    """The axis with the largest n (n - 1) max |second difference|; none where each has degree 1."""
    best, choice = None, None
    for axis, size in enumerate(tensor.shape):
        if size > 2:
            first, middle, last = (
                tensor[(*BEFORE[axis], slice(k, size - 2 + k))] for k in range(3)
            )
            weight = (size - 1) * (size - 2) * abs(last - 2 * middle + first).max()
            if best is None or weight > best:
                best, choice = weight, axis
    return choice


def _least_at(node: Subbox) -> tuple[float, ...]:
    """Where in the unit box the least coefficient of a box stands."""
    place = dict(node.fixed)
    index = np.unravel_index(int(node.tensor.argmin()), node.tensor.shape)
    for (variable, low, high), k, size in zip(node.places, index, node.tensor.shape):
        place[variable] = low + (high - low) * int(k) / (size - 1)
    return tuple(place[variable] for variable in sorted(place))


def _text(root: Subbox) -> str:
    """The tree in preorder, one character a box; boxes that were left open are leaves."""
    letters, stack = [], [root]
    while stack:
        node = stack.pop()
        letters.append(node.prefix + node.letter)
        stack += node.children[::-1]
    return "".join(letters)
