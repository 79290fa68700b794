"""Quotients of polynomials in base variables and adjoined roots: the terms that a search proposes
for unknown variables.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import isqrt
from typing import Any

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from .condition import ZERO, coefficients_in, places, valued

Sample = Mapping[str, fmpq]
MARKS = tuple(fmpq(31 * k + 17, 7 * k + 3) for k in range(80))
SPARE = ("root1", "root2")  # names in the ring for square roots that a search adjoins


@dataclass(frozen=True)
class Quotient:
    """top / bottom, polynomials in the base variables and the adjoined ones."""

    top: fmpq_mpoly
    bottom: fmpq_mpoly

    @staticmethod
    def reduced(top: fmpq_mpoly, bottom: fmpq_mpoly) -> Quotient:
        """The same quotient without common factors, its bottom with leading coefficient 1."""
        if bottom.total_degree() > 0:
            common = top.gcd(bottom)
            if common.total_degree() > 0:
                top, bottom = top / common, bottom / common
        lead = bottom.leading_coefficient()
        return Quotient(top, bottom) if lead == 1 else Quotient(top / lead, bottom / lead)

    def at(self, sample: Sample) -> fmpq | None:
        """The value at a sample of the base; None where the bottom vanishes."""
        top = valued(self.top, sample)
        if self.bottom == 1:
            return top
        bottom = valued(self.bottom, sample)
        return None if not bottom or top is None else top / bottom

    @cached_property
    def used(self) -> frozenset[int]:
        """The numbers of the variables that occur."""
        return frozenset(
            i
            for i, d in enumerate(zip(self.top.degrees(), self.bottom.degrees()))
            if d[0] > 0 or d[1] > 0
        )

    def within(self, point: Point) -> fmpq | None:
        """The value at a point; None where the bottom vanishes or a value is missing."""
        if not self.used <= point.known:
            return None
        if self.bottom == 1:
            return self.top(*point.values)
        bottom = self.bottom(*point.values)
        return self.top(*point.values) / bottom if bottom else None

    def plus(self, other: Quotient) -> Quotient:
        """The sum of two quotients."""
        if other.bottom == 1:
            return Quotient.reduced(self.top + other.top * self.bottom, self.bottom)
        return Quotient.reduced(
            self.top * other.bottom + other.top * self.bottom, self.bottom * other.bottom
        )

    def mark(self) -> tuple[Any, ...]:
        """The same for the same quotient, and but by an unlikely chance no other's."""
        point = MARKS[: len(places(self.top.context()))]
        top, bottom = self.top(*point), self.bottom(*point)
        return int(top.p), int(top.q), int(bottom.p), int(bottom.q)

    def size(self) -> tuple[int, int]:
        """How long it is to read."""
        coefficients = [*self.top.coeffs(), *self.bottom.coeffs()]
        return int(self.top.total_degree() + self.bottom.total_degree()), sum(
            int(c.height_bits()) + 2 for c in coefficients
        )


@dataclass(frozen=True)
class Point:
    """Values of all variables of a ring in their order, 0 where none is known, and the numbers of
    those that are.
    """

    values: list[fmpq]
    known: frozenset[int]

    @staticmethod
    def of(ring: fmpq_mpoly_ctx, given: Mapping[str, fmpq]) -> Point:
        """The point that a mapping by names gives."""
        place = places(ring)
        return Point(
            [given.get(name, ZERO) for name in place], frozenset(place[name] for name in given)
        )


@dataclass
class Root:
    """An adjoined root: the variable that stands for it, and its polynomial."""

    name: str
    poly: fmpq_mpoly


@dataclass
class Choice:
    """Values of all unknowns, the roots adjoined for them, and the samples on which they serve."""

    values: dict[str, Quotient]
    roots: list[Root]
    serves: list[int]
    ring: fmpq_mpoly_ctx


def root_values(roots: Sequence[Root], sample: Sample) -> dict[str, fmpq]:
    """Rational values close to the adjoined roots at a sample; the larger root of each equation."""
    values: dict[str, fmpq] = {}
    for root in roots:
        given = {**sample, **values}
        parts = [valued(c, given) for c in coefficients_in(root.poly, root.name)]
        if len(parts) != 3 or any(c is None for c in parts):
            return values
        half = -parts[1] / 2  # type: ignore[operator]
        under = half * half - parts[0]
        if under < 0:
            return values
        scaled = under * (fmpq(4) ** 200)
        near = fmpq(isqrt(int(scaled.floor())), 1) / (fmpq(2) ** 200)
        values[root.name] = half + near
    return values


def reduced_by(root: Root, poly: fmpq_mpoly) -> fmpq_mpoly:
    """The polynomial modulo the equation of an adjoined root: linear in it."""
    lower, parts = coefficients_in(root.poly, root.name), coefficients_in(poly, root.name)
    while len(parts) > 2:
        lead = parts.pop()
        parts[-1] = parts[-1] - lead * lower[1]
        parts[-2] = parts[-2] - lead * lower[0]
    gen = poly.context().gen(poly.context().variable_to_index(root.name))
    return parts[0] + parts[1] * gen if len(parts) == 2 else parts[0]


def square_roots(
    factor: fmpq_mpoly, name: str, roots: Sequence[Root]
) -> tuple[list[Quotient], Root | None]:
    """Both zeros of a polynomial of degree 2 in a variable, and the square root to be adjoined for
    them, if none at hand serves.
    """
    c, b, a = coefficients_in(factor, name)
    ring = factor.context()
    scale, factors = (b * b - 4 * a * c).factor()
    outer, inner = ring.constant(1), ring.constant(1)
    for part, power in factors:
        outer, inner = outer * part ** (power // 2), inner * part ** (power % 2)
    # scale * inner is what stands under the root; its square factors go outside.
    top, bottom = int(scale.p), int(scale.q)
    square = next(
        (
            k
            for k in range(min(isqrt(abs(top * bottom)), 1000), 0, -1)
            if (top * bottom) % (k * k) == 0
        ),
        1,
    )
    outer, inner = outer * fmpq(square, bottom), inner * fmpq(top * bottom // (square * square))
    taken = [root for root in roots if coefficients_in(root.poly, root.name)[0] == -inner]
    free = [spare for spare in SPARE if spare not in [root.name for root in roots]]
    if not taken and not free:
        return [], None
    if taken:
        root, fresh = taken[0], None
    else:
        gen = ring.gen(ring.variable_to_index(free[0]))
        root = fresh = Root(free[0], gen * gen - inner)
    gen = ring.gen(ring.variable_to_index(root.name))
    return [Quotient.reduced(-b + sign * outer * gen, 2 * a) for sign in (1, -1)], fresh


def insert(value: Quotient, name: str, known: Quotient) -> Quotient:
    """The quotient with another in place of a variable."""
    tops, bottoms = coefficients_in(value.top, name), coefficients_in(value.bottom, name)
    degree = max(len(tops), len(bottoms)) - 1
    if degree == 0:
        return value

    def cleared(parts: list[fmpq_mpoly]) -> fmpq_mpoly:
        total = value.top.context().constant(0)
        for k, c in enumerate(parts):
            total += c * known.top**k * known.bottom ** (degree - k)
        return total

    return Quotient(cleared(tops), cleared(bottoms))
