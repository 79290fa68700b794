"""Exact intervals whose ends may be infinite, and the values of polynomials on boxes of them.

The numbers are flint's rationals, which are exact too and far quicker than Fraction: regions are
bounded with many of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from importlib import import_module
from math import comb
from typing import Any

from certificates.routes.polynomials import Polynomial

Rational = Any  # flint.fmpq
End = tuple[
    int, Rational
]  # (-1, 0) and (1, 0) are the infinite ends, (0, q) is q: tuples compare as the ends do
Interval = tuple[End, End]


@lru_cache(maxsize=1)
def _fmpq() -> Any:
    return import_module("flint").fmpq


def rational(value: int | Fraction) -> Rational:
    """The same number for flint."""
    return _fmpq()(value.numerator, value.denominator)


def fraction(value: Rational) -> Fraction:
    """The same number for Python."""
    return Fraction(int(value.p), int(value.q))


def zero_end() -> End:
    """The end 0."""
    return (0, _fmpq()(0))


def upper_end(p: Polynomial, box: Sequence[Interval]) -> End:
    """An upper end for the polynomial on the box."""
    return span(p, box)[1]


def span(p: Polynomial, box: Sequence[Interval]) -> Interval:
    """An interval that holds all values of the polynomial on the box.

    Formula: sum c_k x^k for the first unbounded variable x, each c_k bounded first: so 8*a*x - 4*x
    - 4*a^2*x is seen to be -4*(1 - a)^2*x. In one bounded variable, by Bernstein coefficients.
    """
    unbounded = next((i for i in p.used if box[i][0][0] or box[i][1][0]), None)
    if unbounded is not None and len(p.used) > 1:
        total: Interval = (zero_end(), zero_end())
        for k, coefficient in p.collected(unbounded):
            inner = span(coefficient, box)
            total = _plus(total, _times(inner, power_span(box[unbounded], k)) if k else inner)
        return total
    if len(p.used) == 1 and len(p.terms) > 1 and unbounded is None:
        (i,) = p.used
        coefficients = {e[i]: c for e, c in p.terms}
        low, high = _bernstein_range(
            tuple(coefficients.get(k, 0) for k in range(p.degrees[i] + 1)),
            box[i][0][1],
            box[i][1][1],
        )
        return (0, low / p.den), (0, high / p.den)
    return _termwise(p, box)


@lru_cache(maxsize=4096)
def _bernstein_range(
    coefficients: tuple[int, ...], low: Rational, high: Rational
) -> tuple[Rational, Rational]:
    """The least and the largest Bernstein coefficient of a polynomial in one variable on [low,
    high]: they enclose its values there.
    """
    moved = shifted([rational(c) for c in coefficients], low)
    n, scaled = len(moved) - 1, [c * (high - low) ** k for k, c in enumerate(moved)]
    bernstein = [
        sum(
            (scaled[i] * rational(Fraction(comb(j, i), comb(n, i))) for i in range(j + 1)),
            rational(0),
        )
        for j in range(n + 1)
    ]
    return min(bernstein), max(bernstein)


def _termwise(p: Polynomial, box: Sequence[Interval]) -> Interval:
    total: Interval = (zero_end(), zero_end())
    for exponents, c in p.terms:
        term: Interval = ((0, rational(c)), (0, rational(c)))
        for i, e in enumerate(exponents):
            if e:
                term = _times(term, power_span(box[i], e))
        total = _plus(total, term)
    return total


def _plus(a: Interval, b: Interval) -> Interval:
    def end(x: End, y: End, side: int) -> End:
        return (side, rational(0)) if side in (x[0], y[0]) else (x[0] or y[0], x[1] + y[1])

    return end(a[0], b[0], -1), end(a[1], b[1], 1)


def power_span(span: Interval, exponent: int) -> Interval:
    """The interval of x^exponent: even powers of what holds 0 begin at 0."""
    low, high = (_power(end, exponent) for end in span)
    if exponent % 2:
        return low, high
    if span[0] <= zero_end() <= span[1]:
        return zero_end(), max(low, high)
    return min(low, high), max(low, high)


def _power(end: End, exponent: int) -> End:
    return (end[0] ** exponent, end[1]) if end[0] else (0, end[1] ** exponent)


def _times(a: Interval, b: Interval) -> Interval:
    corners = [_product(x, y) for x in a for y in b]
    return min(corners), max(corners)


def _product(a: End, b: End) -> End:
    if not a[0] and not b[0]:
        return (0, a[1] * b[1])
    sign = (a[0] or _sign(a[1])) * (
        b[0] or _sign(b[1])
    )  # 0 times an infinite end is 0: the ends are limits of finite ones
    return (sign, rational(0))


def _sign(value: Rational) -> int:
    return int(value > 0) - int(value < 0)


def shifted(coefficients: Sequence[Rational], by: Rational) -> list[Rational]:
    """The coefficients of u(x + by), constant first."""
    moved = list(coefficients)
    for k in range(len(moved) - 1):
        for j in range(len(moved) - 2, k - 1, -1):
            moved[j] += by * moved[j + 1]
    return moved
