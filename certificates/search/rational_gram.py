"""Gram matrices from floats to exact squares: the image of a matrix as rationals, and LDL^T."""

from __future__ import annotations

from fractions import Fraction
from math import lcm

import numpy as np
from flint import fmpq

from .semidefinite import Array

# to a rational with a small denominator: eigenvectors of singular matrices are no better known
NEAR = 2e-3


def rational_image(vectors: Array, near: float = NEAR) -> list[list[int]] | None:
    """A basis of the space that the columns span, as small integers, in echelon form; None where
    none is near.
    """
    work, pivots = vectors.T.copy(), []
    for row in range(len(work)):
        size = np.abs(work[row:])
        at = int(np.argmax(size.max(axis=0) > 0.3 * size.max()))
        best = row + int(np.argmax(size[:, at]))
        if abs(work[best, at]) < 1e-7:
            return None
        work[[row, best]] = work[[best, row]]
        work[row] /= work[row, at]
        for other in range(len(work)):
            if other != row:
                work[other] -= work[other, at] * work[row]
        pivots.append(at)
    result = []
    for line in work:
        fractions = [Fraction(float(c)).limit_denominator(60) for c in line]
        if any(abs(float(f) - float(c)) > near for f, c in zip(fractions, line)):
            return None
        common = lcm(*(f.denominator for f in fractions))
        result.append([int(f * common) for f in fractions])
    return result


def as_squares(gram: list[list[Fraction]]) -> list[tuple[Fraction, list[int]]] | None:
    """(c, row) with gram = sum c * row row^T, every c > 0, by LDL^T; None where the matrix is not
    positive semidefinite.

    >>> as_squares([[Fraction(1), Fraction(-1)], [Fraction(-1), Fraction(1)]])
    [(Fraction(1, 1), [1, -1])]
    """
    size = len(gram)
    near = np.array([[float(c) for c in row] for row in gram])
    if size and np.linalg.eigvalsh(near)[0] < -1e-6 * np.abs(near).max():
        return None  # told by floats where it is plain; exact arithmetic decides the rest
    rest, squares = [[fmpq(c.numerator, c.denominator) for c in row] for row in gram], []
    for k in range(size):
        head = rest[k][k]
        if head < 0 or head == 0 and any(rest[k][k:]):
            return None
        if head == 0:
            continue
        line = [c / head for c in rest[k]]
        common = lcm(*(int(c.q) for c in line))
        squares.append(
            (Fraction(int(head.p), int(head.q) * common**2), [int(c * common) for c in line])
        )
        for i in range(k + 1, size):
            factor = rest[i][k]
            if factor:
                for j in range(k, size):
                    rest[i][j] -= factor * line[j]
        rest[k] = [fmpq(0)] * size
        for i in range(k + 1, size):
            rest[i][k] = fmpq(0)
    return squares
