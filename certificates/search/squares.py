"""Polynomials worth squaring, or telling the sign of: candidates read off the facts of a
problem.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from flint import fmpz_mpoly

from .polynomials import Ring, total_degree

MOST = 6  # of the candidates of one kind


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


def factors(poly: fmpz_mpoly) -> list[tuple[fmpz_mpoly, int]]:
    """The irreducible factors with their exponents; none of a constant."""
    return [] if not poly or poly.is_constant() else [(p, int(e)) for p, e in poly.factor()[1]]


def squares(
    ring: Ring, facts: Sequence[fmpz_mpoly], parameter: int, most: int = MOST
) -> list[fmpz_mpoly]:
    """Candidates for squares, cheapest first: repeated factors, critical lines, variables,
    differences of variables.
    """
    pool = Pool()
    used = [v for v in range(ring.size) if v != parameter and any(p.degrees()[v] for p in facts)]
    for poly in facts:
        if total_degree(poly) > 1:
            for factor, exponent in factors(poly):
                if exponent > 1:
                    pool.add(factor)
    for poly in reversed(facts):
        for v in used:
            if poly.degrees()[v] == 2:
                for factor, _ in factors(poly.derivative(v)):
                    if factor.degrees()[v]:
                        pool.add(factor)
    for v in used:
        pool.add(ring.gens[v])
    for v, w in combinations(used, 2):
        pool.add(ring.gens[v] - ring.gens[w])
        pool.add(ring.gens[v] + ring.gens[w])
    return pool.polys[:most]


def resultants(
    ring: Ring, facts: Sequence[fmpz_mpoly], parameter: int, most: int = MOST
) -> list[fmpz_mpoly]:
    """Factors of resultants of two facts in a variable that is linear in one of them, smallest
    first.
    """
    pool = Pool()
    for v in range(ring.size):
        if v == parameter:
            continue
        having = [p for p in facts if p.degrees()[v]]
        for p, q in combinations(having, 2):
            if min(p.degrees()[v], q.degrees()[v]) == 1:
                for factor, _ in factors(p.resultant(q, v)):
                    pool.add(factor)
    found = [
        p for p in pool.polys if any(p.degrees()[v] for v in range(ring.size) if v != parameter)
    ]
    found.sort(key=lambda p: (len(p), total_degree(p)))
    return found[:most]
