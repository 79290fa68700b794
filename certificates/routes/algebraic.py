"""Real algebraic numbers by polynomial and isolating interval, and exact signs of polynomials at
them: for models that solvers return.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Union

from certificates.routes.polynomials import Atom, Formula, Polynomial, truth

MOST_BITS = 1 << 14


@dataclass(frozen=True)
class Root:
    """The only root of the squarefree polynomial sum c_k x^k (integers, constant first) with low <
    root < high; no end is a root.

    >>> root_number([-2, 0, 1], 2)
    Root(coefficients=(-2, 0, 1), low=Fraction(0, 1), high=Fraction(4, 1))
    """

    coefficients: tuple[int, ...]
    low: Fraction
    high: Fraction

    def to(self, bits: int) -> tuple[Fraction, Fraction]:
        """An enclosure of width at most 2^-bits, by bisection on the change of sign."""
        low, high = self.low, self.high
        rising = _value(self.coefficients, high) > 0
        while (high - low) * (1 << bits) > 1:
            middle = (low + high) / 2
            value = _value(self.coefficients, middle)
            if value == 0:
                return middle, middle
            low, high = (low, middle) if (value > 0) == rising else (middle, high)
        return low, high

    def __str__(self) -> str:
        poly = Polynomial(
            ("z",),
            tuple(((k,), c) for k, c in sorted(enumerate(self.coefficients), reverse=True) if c),
        )
        low, high = self.to(12)
        return f"the root of {poly} in [{low}, {high}]"


Exact = Union[Fraction, Root]


def root_number(coefficients: Sequence[int], number: int) -> Exact:
    """The number-th real root, from the smallest up and counted from 1; a Fraction where bisection
    meets it.

    Source: Sturm's theorem.  Raises ValueError where the polynomial has a multiple root or too few
    real roots.
    """
    chain = _sturm([Fraction(c) for c in coefficients])
    if len(chain[-1]) != 1:
        raise ValueError("the polynomial has a multiple root")
    bound = Fraction(1)
    while bound <= 1 + max(abs(Fraction(c, coefficients[-1])) for c in coefficients[:-1]):
        bound *= 2
    low, high = -bound, bound
    left = _changes(chain, low)
    if not 1 <= number <= left - _changes(chain, high):
        raise ValueError("the polynomial has no such real root")
    while True:
        # between low and high lie the roots first + 1 .. last, and `number` is among them
        first, last = left - _changes(chain, low), left - _changes(chain, high)
        if last - first == 1 and low * high >= 0:
            return Root(tuple(coefficients), low, high)
        middle = (low + high) / 2
        below = left - _changes(chain, middle)  # roots in (-bound, middle]
        if _value(coefficients, middle) == 0:
            if below == number:
                return middle
            middle = _beside(chain, coefficients, middle, high if below < number else low)
            below = left - _changes(chain, middle)
        low, high = (low, middle) if below >= number else (middle, high)


def _beside(
    chain: list[list[Fraction]], coefficients: Sequence[int], root: Fraction, end: Fraction
) -> Fraction:
    """A point between a rational root and the end with no other root in between."""
    step = (end - root) / 2
    while (
        abs(_changes(chain, root) - _changes(chain, root + step)) > int(step < 0)
        or _value(coefficients, root + step) == 0
    ):
        step /= 2
    return root + step


def _value(coefficients: Sequence[int], at: Fraction) -> int:
    """The polynomial's value times a positive number: its sign."""
    n, d, total, scale = at.numerator, at.denominator, 0, 1
    for c in reversed(coefficients):
        total = total * n + c * scale
        scale *= d
    return total


def _sturm(p: list[Fraction]) -> list[list[Fraction]]:
    chain = [p, [k * c for k, c in enumerate(p)][1:]]
    while len(chain[-1]) > 1:
        rest, q = list(chain[-2]), chain[-1]
        while len(rest) >= len(q):
            factor, shift = rest[-1] / q[-1], len(rest) - len(q)
            rest = [c - factor * q[k - shift] if k >= shift else c for k, c in enumerate(rest)][:-1]
            while rest and rest[-1] == 0:
                rest.pop()
        if not rest:
            break
        chain.append([-c for c in rest])
    return chain


def _changes(chain: list[list[Fraction]], at: Fraction) -> int:
    signs = []
    for p in chain:
        value = Fraction(0)
        for c in reversed(p):
            value = value * at + c
        if value:
            signs.append(value > 0)
    return sum(a != b for a, b in zip(signs, signs[1:]))


def sign_at(poly: Polynomial, point: Sequence[Exact]) -> int | None:
    """The sign (-1, 0 or 1) of the polynomial at a point of rational and algebraic numbers; None
    where that takes too many bits.

    Formula: with integer coefficients, L = prod lead_i^deg_i and M >= |P| at all conjugates, D the
    product of the degrees:
    P(a) = 0 or |P(a)| >= (L M)^(1 - D) / L, because L P(a) is an algebraic integer of degree at
    most D.
    """
    for i, value in enumerate(point):
        if isinstance(value, Fraction) and i in poly.used:
            poly = poly.with_value(i, value)
    roots = {i: root for i in poly.used if isinstance(root := point[i], Root)}
    if not roots:
        total = sum(c for _, c in poly.terms)
        return (total > 0) - (total < 0)
    if not poly.terms:
        return 0
    cauchy = {
        i: 1 + max(-(-abs(c) // abs(r.coefficients[-1])) for c in r.coefficients[:-1])
        for i, r in roots.items()
    }
    size = sum(abs(c) * prod(cauchy[i] ** e[i] for i in roots) for e, c in poly.terms)
    lead = prod(abs(r.coefficients[-1]) ** poly.degrees[i] for i, r in roots.items())
    degree = prod(len(r.coefficients) - 1 for r in roots.values())
    bits, enough = 32, (lead * size).bit_length() * (degree - 1) + lead.bit_length() + 1
    while bits <= MOST_BITS:
        low, high = _range(poly, {i: r.to(bits) for i, r in roots.items()})
        if low > 0 or high < 0:
            return 1 if low > 0 else -1
        if max(high, -low) * (1 << enough) < 1:
            return 0
        bits *= 2
    return None


def _range(
    poly: Polynomial, ends: dict[int, tuple[Fraction, Fraction]]
) -> tuple[Fraction, Fraction]:
    low = high = Fraction(0)
    for exponents, c in poly.terms:
        a = b = Fraction(c)
        for i, (below, above) in ends.items():
            for _ in range(exponents[i]):
                corners = (a * below, a * above, b * below, b * above)
                a, b = min(corners), max(corners)
        low, high = low + a, high + b
    return low, high


def truth_at(formula: Formula, point: Sequence[Exact]) -> bool | None:
    """The exact truth value of the formula at the point; None where a sign takes too many bits."""

    def decide(fact: Atom) -> bool | None:
        sign = sign_at(fact.poly, point)
        return None if sign is None else fact.holds(sign)

    return truth(formula, decide)
