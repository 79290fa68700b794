"""Polynomials in one variable on an interval: exact real root counts, by Descartes' rule with
bisection."""

from __future__ import annotations

from fractions import Fraction
from math import comb

from flint import fmpq, fmpq_poly, fmpz_mpoly

from certificates import checker


def univariate(poly: fmpz_mpoly, variable: int) -> fmpq_poly:
    """A polynomial in one variable alone as such."""
    return fmpq_poly(_coefficients(poly, variable))


def _coefficients(poly: fmpz_mpoly, variable: int) -> list[int]:
    found = {int(m[variable]): int(c) for m, c in zip(poly.monoms(), poly.coeffs())}
    return [found.get(k, 0) for k in range(max(found, default=0) + 1)]


def bernstein(poly: fmpq_poly, low: Fraction, high: Fraction, degree: int) -> list[fmpq]:
    """The coefficients b_k with poly = sum b_k comb(n, k) (z - low)^k (high - z)^(n - k) / (high -
    low)^n.

    >>> [str(b) for b in bernstein(fmpq_poly([0, 1]), Fraction(0), Fraction(1), 2)]
    ['0', '1/2', '1']
    """
    start, width = (
        fmpq(low.numerator, low.denominator),
        fmpq((high - low).numerator, (high - low).denominator),
    )
    moved = poly(fmpq_poly([start, width])).coeffs()
    return [
        sum((c * fmpq(comb(k, j), comb(degree, j)) for j, c in enumerate(moved[: k + 1])), fmpq(0))
        for k in range(degree + 1)
    ]


def positive_between(poly: fmpq_poly, low: Fraction, high: Fraction) -> bool:
    """Whether the polynomial is positive on the whole closed interval.

    >>> [positive_between(fmpq_poly([-2, 0, 1]), Fraction(low, 10), Fraction(2)) for low in (14, 15)]
    [False, True]
    """
    if low > high:
        return False
    coefficients = bernstein(poly, low, high, max(poly.degree(), 0))
    if coefficients[0] <= 0 or coefficients[-1] <= 0:
        return False
    if all(b >= 0 for b in coefficients):
        return True
    return (
        low < high
        and checker.count_roots([int(c) for c in poly.numer().coeffs()], low, high, checker.Work())
        == 0
    )
