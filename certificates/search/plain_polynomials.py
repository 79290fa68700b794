"""Polynomials and boxes as plain data, and what is computed of them exactly; nothing here loads
NumPy.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from math import ceil, floor
from typing import Any

Exponents = tuple[int, ...]
Terms = Mapping[Exponents, Fraction]  # a polynomial: its coefficients, none of them 0
Box = Sequence[tuple[Fraction, Fraction]]
LETTERS = "abcdefghijklmnopqrstuvwxyz"  # the axes of a box, in the text of a tree
DENOMINATORS = (1, 2, 12, 120, 1000, 10**4, 10**6, 10**8, 10**10, 10**13, 10**16, 10**20)


def value_at(terms: Terms, point: Sequence[Fraction]) -> Fraction:
    """The exact value at a point."""
    powers = (
        [
            [x**e for e in range(1 + max(exponents[i] for exponents in terms))]
            for i, x in enumerate(point)
        ]
        if terms
        else []
    )
    total = Fraction(0)
    for exponents, c in terms.items():
        for table, e in zip(powers, exponents):
            c = c * table[e] if e else c
        total += c
    return total


def derivative(part: Mapping[Exponents, Any], axis: int) -> dict[Exponents, Any]:
    """The derivative along an axis."""
    return {
        (*e[:axis], e[axis] - 1, *e[axis + 1 :]): c * e[axis] for e, c in part.items() if e[axis]
    }


def simple_points(x: Iterable[float], box: Box) -> Iterator[tuple[Fraction, ...]]:
    """Rational points of the box near x, the simplest first."""
    seen = set()
    for most in DENOMINATORS:
        point = tuple(
            min(max(Fraction(float(v)).limit_denominator(most), low), high)
            for v, (low, high) in zip(x, box)
        )
        if point not in seen:
            seen.add(point)
            yield point


def rounded_up(value: Fraction, unit: Fraction) -> Fraction:
    """The least multiple of the unit that is not below the value."""
    return ceil(value / unit) * unit


def rounded_down(value: Fraction, unit: Fraction) -> Fraction:
    """The greatest multiple of the unit that is not above the value."""
    return floor(value / unit) * unit
