"""Polynomials to square, or to make cases of by sign: candidates read off a problem's facts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import comb

from flint import fmpz_mpoly

from juggleproof.algebra.polynomials import Ring, total_degree
from juggleproof.search import limits


class Pool:
    """Primitive polynomials, each once, up to sign."""

    def __init__(self) -> None:
        self.polys: list[fmpz_mpoly] = []

    def add(self, poly: fmpz_mpoly) -> None:
        """Keeps a polynomial that is not constant and was not kept before."""
        if not poly or poly.is_constant():
            return
        poly = poly / int(poly.content())
        poly = -poly if poly.leading_coefficient() < 0 else poly
        if all(poly != known for known in self.polys):
            self.polys.append(poly)


def squares(
    ring: Ring, facts: Sequence[fmpz_mpoly], parameter: int, most: int = limits.MOST_PER_KIND
) -> list[fmpz_mpoly]:
    """Candidates for squares, cheapest first: repeated factors, critical lines, variables,
    differences of variables.
    """
    pool = Pool()
    for poly in _worth_squaring(ring, facts, parameter):
        pool.add(poly)
        if len(pool.polys) == most:
            break
    return pool.polys


def _worth_squaring(
    ring: Ring, facts: Sequence[fmpz_mpoly], parameter: int
) -> Iterator[fmpz_mpoly]:
    used = [v for v in range(ring.size) if v != parameter and any(p.degrees()[v] for p in facts)]
    for poly in facts:
        if total_degree(poly) > 1:
            for factor, exponent in ring.factors(poly):
                if exponent > 1:
                    yield factor
    for poly in reversed(facts):
        for v in used:
            if poly.degrees()[v] == 2:
                for factor, _ in ring.factors(poly.derivative(v)):
                    if factor.degrees()[v]:
                        yield factor
    for v in used:
        yield ring.gens[v]
    for v, w in combinations(used, 2):
        yield ring.gens[v] - ring.gens[w]
        yield ring.gens[v] + ring.gens[w]


def longest(poly: fmpz_mpoly) -> int:
    """The binary digits of the largest coefficient."""
    return max((int(c).bit_length() for c in poly.coeffs()), default=0)


def digits(poly: fmpz_mpoly) -> int:
    """The terms of a polynomial, or the square of its degree if that is more, times the binary
    digits of its largest coefficient.

    >>> x, y = Ring(("x", "y")).gens
    >>> digits(8 * x**2 - y)
    16
    """
    return max(len(poly), total_degree(poly) ** 2) * longest(poly)


def products(linear: fmpz_mpoly, other: fmpz_mpoly, v: int) -> int:
    """Terms times digits of what makes their resultant in the variable: a power of the linear one,
    as high as the degree of the other, times that.
    """
    degree = int(other.degrees()[v])
    terms = comb(len(linear) + degree - 1, degree) * len(other)
    return terms * (degree * longest(linear) + longest(other))


def resultants(
    ring: Ring, facts: Sequence[fmpz_mpoly], parameter: int, most: int = limits.MOST_PER_KIND
) -> list[fmpz_mpoly]:
    """Factors of resultants of two facts in a variable that is linear in one of them, smallest
    first; none where there are too many pairs, and none of those that are too large, as the time
    that these take is not counted.
    """
    pool = Pool()
    pairs = [
        (p, q, v)
        for v in range(ring.size)
        if v != parameter
        for p, q in combinations([p for p in facts if p.degrees()[v]], 2)
        if min(p.degrees()[v], q.degrees()[v]) == 1
    ]
    for p, q, v in pairs if len(pairs) <= limits.MOST_PAIRS else ():
        linear, other = sorted((p, q), key=lambda poly: poly.degrees()[v])
        if products(linear, other, v) <= limits.MOST_PRODUCTS:
            resultant = p.resultant(q, v)
            for factor, _ in (
                ring.factors(resultant) if digits(resultant) <= limits.MOST_DIGITS else ()
            ):
                pool.add(factor)
    found = [
        p for p in pool.polys if any(p.degrees()[v] for v in range(ring.size) if v != parameter)
    ]
    found.sort(key=lambda p: (len(p), total_degree(p)))
    return found[:most]
