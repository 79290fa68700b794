"""The linear equations on the entries of Gram matrices: solved in floats, rounded, and met
exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property
from math import lcm
from typing import Protocol

import numpy as np
from flint import fmpz_mat, fmpz_mpoly, nmod_mat

from .budget import Budget
from .semidefinite import Array, feasible

Monomial = tuple[int, ...]
Entry = tuple[int, int, int]  # block, row, column
PRIME = (1 << 61) - 1


class Sized(Protocol):
    """What the equations need of a block: its product, whether it is strict, and its basis."""

    poly: fmpz_mpoly
    strict: bool
    basis: list[fmpz_mpoly]


class Linear:
    """The equations on the entries of the blocks' Gram matrices, and on the multiples of the
    cofactors.

    There is one for each monomial, and one that sets the sum of the strict terms to 1.
    """

    def __init__(self, blocks: Sequence[Sized], cofactors: Sequence[fmpz_mpoly]) -> None:
        self.blocks, more = blocks, list(cofactors)
        self.entries = [
            (k, i, j)
            for k, block in enumerate(blocks)
            for i in range(len(block.basis))
            for j in range(i + 1)
        ]
        polys = [
            blocks[k].poly * blocks[k].basis[i] * blocks[k].basis[j] * (1 if i == j else 2)
            for k, i, j in self.entries
        ]
        self.count = len(polys)
        rows: dict[Monomial, int] = {}
        self.terms: list[dict[int, int]] = []
        for poly in (*polys, *more):
            self.terms.append(
                {
                    rows.setdefault(m, len(rows)): int(c)
                    for m, c in zip(poly.monoms(), poly.coeffs())
                }
            )
        self.rows = len(rows) + 1
        self.multipliers = [0.0] * len(more)  # of the equations, in floats, when it has been solved
        for (k, _, _), column in zip(self.entries, self.terms):
            if blocks[k].strict:
                column[len(rows)] = 1
        self.size = self.rows * sum(len(block.basis) ** 2 for block in blocks)

    def solve(self, budget: Budget, trace: float, last: float) -> list[Array] | None:
        """Gram matrices in floats."""
        blocks = [
            np.zeros((self.rows, len(block.basis), len(block.basis))) for block in self.blocks
        ]
        for (k, i, j), column in zip(self.entries, self.terms):
            scale = self.scale(k)
            for row, c in column.items():
                blocks[k][row, i, j] += c / scale / (1 if i == j else 2)
                if i != j:
                    blocks[k][row, j, i] += c / scale / 2
        free = np.zeros((self.rows, len(self.terms) - self.count))
        for at, column in enumerate(self.terms[self.count :]):
            size = max(map(abs, column.values()))
            for row, c in column.items():
                free[row, at] = c / size
        right = np.zeros(self.rows)
        right[-1] = 1.0
        found = feasible(blocks, free, right, budget, trace, last)
        if found is None:
            return None
        if free.shape[1]:
            rest = right - sum(
                (block.reshape(self.rows, -1) @ gram.ravel() for block, gram in zip(blocks, found)),
                np.zeros(self.rows),
            )
            sizes = [max(map(abs, column.values())) for column in self.terms[self.count :]]
            self.multipliers = (np.linalg.lstsq(free, rest, rcond=None)[0] / sizes).tolist()
        return [gram / self.scale(k) for k, gram in enumerate(found)]

    def scale(self, block: int) -> float:
        """The largest coefficient of a block's product; strict ones are not scaled, so that their
        sum is 1.
        """
        one = self.blocks[block]
        return 1.0 if one.strict else float(max(abs(int(c)) for c in one.poly.coeffs()))

    def rounded(
        self, grams: list[Array], denominator: int
    ) -> tuple[dict[Entry, Fraction], list[Fraction]] | None:
        """Exact entries near the floating ones that meet all equations, and multipliers of the
        equations; None where there are none.

        The entries are rounded, and corrected by the shortest vector in their columns that makes up
        for what is missing.
        """
        start = [
            Fraction(round(float(grams[k][i, j]) * denominator), denominator)
            for k, i, j in self.entries
        ]
        start += [Fraction(round(m * denominator), denominator) for m in self.multipliers]
        missing = [Fraction(0)] * self.rows
        missing[-1] = Fraction(1)
        for value, column in zip(start, self.terms):
            for row, c in column.items() if value else ():
                missing[row] -= c * value
        if any(missing):
            correction = self.correction(missing)
            if correction is None:
                return None
            start = [a + b for a, b in zip(start, correction)]
        return dict(zip(self.entries, start)), start[self.count :]

    def correction(self, missing: list[Fraction]) -> list[Fraction] | None:
        """The shortest vector whose combination of the columns is what is missing."""
        pivots, kept, square = self.independent
        scale = lcm(*(m.denominator for m in missing))
        try:
            above, below = _solved(
                square, fmpz_mat([[int(missing[row] * scale)] for row in pivots])
            )
        except ZeroDivisionError:
            return None
        result = kept.transpose() * above
        found = [Fraction(int(result[k, 0]), below * scale) for k in range(len(self.terms))]
        left = list(missing)
        for value, column in zip(found, self.terms):
            for row, c in column.items() if value else ():
                left[row] -= c * value
        return None if any(left) else found

    @cached_property
    def independent(self) -> tuple[list[int], fmpz_mat, fmpz_mat]:
        """Rows of which no one follows from the others, the matrix of these, and it times its
        transpose.
        """
        table = [[0] * len(self.terms) for _ in range(self.rows)]
        for at, column in enumerate(self.terms):
            for row, c in column.items():
                table[row][at] = c
        reduced, rank = nmod_mat(fmpz_mat(table).transpose(), PRIME).rref()
        pivots, at = list[int](), 0
        for row in range(rank):
            while not int(reduced[row, at]):
                at += 1
            pivots.append(at)
        kept = fmpz_mat([table[row] for row in pivots])
        return pivots, kept, kept * kept.transpose()


def _solved(matrix: fmpz_mat, right: fmpz_mat) -> tuple[fmpz_mat, int]:
    """(n, d) with matrix * n = d * right."""
    solution = matrix.solve(right)
    common = lcm(*(int(solution[k, 0].q) for k in range(solution.nrows())))
    return fmpz_mat([[int(solution[k, 0] * common)] for k in range(solution.nrows())]), common
