"""Coordinates around a point in which a polynomial that is least there shows where its Hessian is
singular; exact.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from .gram import Polynomial, product
from .plain_polynomials import Exponents, Terms

Linear = list[Fraction]


def unit(size: int, i: int) -> Exponents:
    """The exponents of the i-th variable."""
    return tuple(int(k == i) for k in range(size))


def substituted(terms: Terms, values: Sequence[Polynomial]) -> Polynomial:
    """The polynomial with a polynomial in place of each variable."""
    total: Polynomial = {}
    powers: dict[tuple[int, int], Polynomial] = {}
    for exponents, c in terms.items():
        part: Polynomial = {(0,) * len(values): c}
        for i, e in enumerate(exponents):
            if e and (i, e) not in powers:
                power = values[i]
                for _ in range(e - 1):
                    power = product(power, values[i])
                powers[i, e] = power
            part = product(part, powers[i, e]) if e else part
        for monomial, value in part.items():
            total[monomial] = total.get(monomial, Fraction(0)) + value
    return {e: c for e, c in total.items() if c}


def adapted_forms(p: Polynomial, free: Sequence[int], size: int) -> tuple[list[Linear], list[int]]:
    """Linear forms that serve as coordinates, and the numbers of those that only complete the range
    of the Hessian of the free variables.
    """
    units = [[Fraction(int(i == k)) for k in range(size)] for i in range(size)]
    rows = [
        [_second(p, i, j, size) if j in free else Fraction(0) for j in range(size)] for i in free
    ]
    if _rank(rows) == len(free):
        return units, []
    forms: list[Linear] = []
    kernel: list[int] = []
    for k, row in enumerate([*rows, *units]):
        if _rank([*forms, row]) > len(forms):
            if k >= len(rows) and k - len(rows) in free:
                kernel.append(len(forms))
            scale = next(c for c in row if c)
            forms.append([c / scale for c in row])
    return forms, kernel


def _second(p: Polynomial, i: int, j: int, size: int) -> Fraction:
    exponents = tuple(a + b for a, b in zip(unit(size, i), unit(size, j)))
    return p.get(exponents, Fraction(0)) * (2 if i == j else 1)


def _rank(rows: Sequence[Linear]) -> int:
    rest, rank = [list(row) for row in rows], 0
    for k in range(len(rest[0]) if rest else 0):
        pivot = next((i for i in range(rank, len(rest)) if rest[i][k]), None)
        if pivot is not None:
            rest[rank], rest[pivot] = rest[pivot], rest[rank]
            for i in range(rank + 1, len(rest)):
                rest[i] = [x - rest[i][k] / rest[rank][k] * y for x, y in zip(rest[i], rest[rank])]
            rank += 1
    return rank


def inverse(rows: Sequence[Linear]) -> list[Linear]:
    """The inverse of a matrix that has one, by elimination."""
    size = len(rows)
    rest = [[*row, *(Fraction(int(i == k)) for k in range(size))] for i, row in enumerate(rows)]
    for k in range(size):
        pivot = next(i for i in range(k, size) if rest[i][k])
        rest[k], rest[pivot] = rest[pivot], rest[k]
        rest[k] = [c / rest[k][k] for c in rest[k]]
        for i in range(size):
            if i != k and rest[i][k]:
                rest[i] = [x - rest[i][k] * y for x, y in zip(rest[i], rest[k])]
    return [row[size:] for row in rest]
