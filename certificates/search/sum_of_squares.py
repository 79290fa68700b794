"""p - p(x*) as squares plus products of squares with the sides of a box, by Gram matrices: proofs
where halving boxes leads nowhere.

p is written in coordinates around the point x*, where every summand vanishes: so a square has no
constant, and where the Hessian is singular, no linear part along its kernel.  Without these two
steps no matrix is definite, and none could be rounded.  What is more degenerate is not found. With
a gap, p - p(x*) + gap, squares have constants, scaled by the root of the gap, and x* need only be
near the minimum. Source: Putinar, Positive polynomials on compact semialgebraic sets (1993); Peyrl
and Parrilo, Theoretical Computer Science 409 (2008).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations_with_replacement
from typing import Any

import numpy as np

from .gram import Block, Matrix, Polynomial, inner, product, rounded, squares
from .linear_forms import Linear, adapted_forms, inverse, substituted, unit
from .plain_polynomials import Box, Exponents, Terms

MOST_VARIABLES, MOST_BASIS = 6, 28
Factors = list[list[int]]  # of a product: facts with exponents


class Around:
    """A polynomial around a point of a box: the part of a sum of squares that is to be found, block
    by block.
    """

    def __init__(
        self,
        terms: Terms,
        box: Box,
        point: Sequence[Fraction],
        facts: list[list[int]],
        gap: Fraction,
    ) -> None:
        self.gap = gap
        self.size, self.box, self.point, self.facts = len(box), box, point, facts
        self.one = (0,) * self.size
        self.half = (max(map(sum, terms)) + 1) // 2
        shifted = substituted(
            terms, [{unit(self.size, i): Fraction(1), self.one: at} for i, at in enumerate(point)]
        )
        shifted.pop(self.one, None)
        if gap:
            shifted[self.one] = gap
        self.slopes = [shifted.get(unit(self.size, i), Fraction(0)) for i in range(self.size)]
        self.forms, kernel = adapted_forms(
            shifted, [i for i, slope in enumerate(self.slopes) if not slope and not gap], self.size
        )
        self.steps = inverse(self.forms)  # x - x* in the coordinates
        self.p = substituted(shifted, [self._linear(step) for step in self.steps])
        self.lines = [unit(self.size, k) for k in range(self.size) if k not in kernel]
        self.blocks: list[Block] = []
        self.factors: list[Factors] = []
        self.held: list[int] = []  # the blocks of sides where the point is held
        self._add(
            {self.one: Fraction(1)},
            [],
            [*([self.one] if gap else []), *self.lines, *self._monomials(2, self.half)],
        )
        for i, (low, high) in enumerate(box):
            if low < high:
                self._add_sides(i, low, high)

    def is_stationary(self) -> bool:
        """Whether p rises, to first order, from the point into the box, or stays level; a gap makes
        up for what falls.
        """
        return self.gap > 0 or all(
            slope == 0 or at == ends[0 if slope > 0 else 1]
            for slope, at, ends in zip(self.slopes, self.point, self.box)
        )

    def _linear(self, coefficients: Linear, constant: Fraction = Fraction(0)) -> Polynomial:
        parts = {unit(self.size, k): c for k, c in enumerate(coefficients) if c}
        return {**parts, self.one: constant} if constant else parts

    def _monomials(self, first: int, last: int) -> list[Exponents]:
        return [
            tuple(sum(k == i for k in chosen) for i in range(self.size))
            for degree in range(first, last + 1)
            for chosen in combinations_with_replacement(range(self.size), degree)
        ]

    def _add(self, multiplier: Polynomial, factors: Factors, basis: list[Exponents]) -> None:
        small = _dyadic_root(self.gap) if self.gap else Fraction(1)
        self.blocks.append(
            Block(
                multiplier,
                tuple(basis),
                tuple(small if monomial == self.one else Fraction(1) for monomial in basis),
            )
        )
        self.factors.append(factors)

    def _add_sides(self, i: int, low: Fraction, high: Fraction) -> None:
        """Squares times (x - low)(high - x), and times the one side where the point is held."""
        above = self._linear(self.steps[i], self.point[i] - low)
        below = self._linear([-c for c in self.steps[i]], high - self.point[i])
        first, last = self.facts[i]
        rest = [*self.lines, *self._monomials(2, self.half - 1)] if self.half > 1 else []
        held = self.slopes[i] and self.point[i] == (low if self.slopes[i] > 0 else high)
        constant = [self.one] if held or self.gap else []
        if constant or rest:
            self._add(product(above, below), [[first, 1], [last, 1]], [*constant, *rest])
        if held:
            self.held.append(len(self.blocks))
            side, fact = (above, first) if self.slopes[i] > 0 else (below, last)
            self._add(side, [[fact, 1]], [self.one, *rest])

    def grams(self) -> list[Matrix] | None:
        """Exact positive definite matrices whose sum is p, where some are found."""
        try:
            found = inner(self.p, self.blocks)
            return None if found is None else rounded(self.p, self.blocks, found, self.held)
        except np.linalg.LinAlgError:
            return None

    def coordinates(self, names: Sequence[str]) -> list[str]:
        """The coordinates as text in the variables."""
        moved = [
            f"({name} {'-' if at > 0 else '+'} {abs(at)})" if at else name
            for name, at in zip(names, self.point)
        ]
        texts = [_text(self._linear(form), moved) for form in self.forms]
        return [text if text in moved else f"({text})" for text in texts]


def search_squares(
    terms: Terms,
    box: Box,
    point: Sequence[Fraction],
    names: Sequence[str],
    facts: list[list[int]],
    goal: int,
    gap: Fraction = Fraction(0),
) -> list[Any] | None:
    """A Positivstellensatz node that closes fact `goal`, p(x*) - gap - p > 0; None where none is
    found.

    `facts` numbers what says low <= x and x <= high, for each variable.
    """
    around = Around(terms, box, point, facts, gap) if len(box) <= MOST_VARIABLES else None
    if around is None or not around.is_stationary() or len(around.blocks[0].basis) > MOST_BASIS:
        return None
    grams = around.grams()
    if grams is None:
        return None
    coordinates, products = around.coordinates(names), [[1, [[goal, 1]], "1"]]
    for block, factors, gram in zip(around.blocks, around.factors, grams):
        for weight, row in squares(gram) or []:
            root = {
                monomial: c * scale
                for monomial, c, scale in zip(block.basis, row, block.scales)
                if c
            }
            products.append([str(weight), factors, _text(root, coordinates)])
    return ["psatz", products, []]


def _dyadic_root(value: Fraction) -> Fraction:
    """A power of 2 near the square root."""
    return Fraction(2) ** ((value.numerator.bit_length() - value.denominator.bit_length()) // 2)


def _text(p: Polynomial, coordinates: Sequence[str]) -> str:
    parts = []
    for exponents, c in p.items():
        factors = [
            text if e == 1 else f"{text}^{e}" for text, e in zip(coordinates, exponents) if e
        ]
        parts.append("*".join([*([str(c)] if c != 1 or not factors else []), *factors]))
    return " + ".join(parts).replace("+ -", "- ")
