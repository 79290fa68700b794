"""Polynomials on a box as tensors of Bernstein coefficients, in floating point or in exact
integers, by the same steps.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from math import comb, lcm
from typing import Any

import numpy as np

from .plain_polynomials import Box, Terms

Array = Any
BEFORE: Any = [(slice(None),) * axis for axis in range(26)]  # the axes before one, in an index


def bernstein_tensor(terms: Terms, box: Box) -> tuple[Array, int]:
    """(integers, unit): the Bernstein coefficients on the box are integers / unit, one axis a
    variable, as an array of Python ints.

    x^e on [a, b], in degree n, has as its j-th coefficient sum_k C(n - j, e - k) C(j, k) a^(e - k)
    b^k / C(n, e).
    """
    size = len(box)
    degrees = [max(e[i] for e in terms) for i in range(size)]
    unit = lcm(*(c.denominator for c in terms.values()))
    tensor: Array = np.zeros([n + 1 for n in degrees], dtype=object)
    for exponents, c in terms.items():
        tensor[exponents] = int(c * unit)
    for axis in range(
        size - 1, -1, -1
    ):  # what is not yet spread out is mostly 0, and one slice an exponent
        matrix, scale = _axis_matrix(degrees[axis], *box[axis])
        unit *= scale
        tensor = _along(matrix, tensor, axis)
    return tensor, unit


def _along(matrix: list[list[int]], tensor: Array, axis: int) -> Array:
    slices = [part_of(tensor, axis, e) for e in range(tensor.shape[axis])]
    used = [e for e, part in enumerate(slices) if part.any()]
    result = np.zeros(tensor.shape, dtype=object)
    for j, row in enumerate(matrix):
        for e in used:
            if row[e]:
                result[(*BEFORE[axis], j)] += row[e] * slices[e]
    return result


def part_of(tensor: Array, axis: int, index: int) -> Array:
    """The part of a tensor with this index along an axis, an array also where it is one number."""
    return tensor[(*BEFORE[axis], index, ...)]


def _axis_matrix(n: int, low: Fraction, high: Fraction) -> tuple[list[list[int]], int]:
    d, whole = lcm(low.denominator, high.denominator), lcm(*(comb(n, e) for e in range(n + 1)))
    a, b = int(low * d), int(high * d)
    rows = [
        [
            whole
            // comb(n, e)
            * d ** (n - e)
            * sum(comb(n - j, e - k) * comb(j, k) * a ** (e - k) * b**k for k in range(e + 1))
            for e in range(n + 1)
        ]
        for j in range(n + 1)
    ]
    return rows, whole * d**n


@lru_cache(256)
def halving(n: int, exact: bool) -> tuple[Array, Array]:
    """The matrices that take coefficients of degree n to those on the lower and on the upper half,
    times 2^n where exact.
    """
    lower = np.array(
        [[comb(j, k) * 2 ** (n - j) if k <= j else 0 for k in range(n + 1)] for j in range(n + 1)],
        dtype=object,
    )
    upper = lower[::-1, ::-1].copy()
    return (lower, upper) if exact else ((lower / 2**n).astype(float), (upper / 2**n).astype(float))


def along_first(matrix: Array, tensor: Array, axis: int) -> Array:
    """The matrix applied along an axis, which becomes the first one."""
    moved = np.moveaxis(tensor, axis, 0)
    return (matrix @ moved.reshape(len(moved), -1)).reshape(moved.shape)
