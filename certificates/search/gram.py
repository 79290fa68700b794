"""Positive definite Gram matrices with given coefficients: found in floating point, then rounded to
exact rationals.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from .plain_polynomials import Exponents

Array = Any
Polynomial = dict[Exponents, Fraction]
Matrix = list[list[Fraction]]
STEPS = 80
BITS = (4, 7, 10, 14, 20, 28, 36)  # after the point, of a rounded entry
CENTRED = 1e-8


@dataclass(frozen=True)
class Block:
    """sum G_ij multiplier b_i b_j, for the monomials b of the basis, each times its scale: a
    positive definite G is sought.
    """

    multiplier: Polynomial
    basis: tuple[Exponents, ...]
    scales: tuple[Fraction, ...]

    def parts(self) -> Iterator[tuple[int, int, Polynomial]]:
        """(i, j, multiplier b_i b_j) for all i, j."""
        for i, a in enumerate(self.basis):
            for j, b in enumerate(self.basis):
                scale = self.scales[i] * self.scales[j]
                yield (
                    i,
                    j,
                    {tuple(map(sum, zip(e, a, b))): c * scale for e, c in self.multiplier.items()},
                )


def product(p: Polynomial, q: Polynomial) -> Polynomial:
    """p times q."""
    total: Polynomial = {}
    for monomial, c in q.items():
        for e, value in p.items():
            both = tuple(map(sum, zip(e, monomial)))
            total[both] = total.get(both, Fraction(0)) + c * value
    return {e: c for e, c in total.items() if c}


def inner(p: Polynomial, blocks: Sequence[Block]) -> list[Array] | None:
    """Matrices of the blocks whose sum is p to rounding, with the least eigenvalue as large as it
    gets; None where it is not positive.

    It follows the central path of: minimise t, where the matrices plus t are positive definite and
    have the sum p. Source: Boyd and Vandenberghe, Convex Optimization, 11.4 (phase I).
    """
    rows = {
        e: k
        for k, e in enumerate(
            sorted({e for block in blocks for _, _, part in block.parts() for e in part})
        )
    }
    if any(e not in rows for e in p):
        return None
    scales = [max(abs(float(c)) for c in block.multiplier.values()) for block in blocks]
    forms = [np.zeros((len(rows), len(block.basis), len(block.basis))) for block in blocks]
    for block, form, scale in zip(blocks, forms, scales):
        for i, j, part in block.parts():
            for e, c in part.items():
                form[rows[e], i, j] += float(c) / scale
    size = max(abs(float(c)) for c in p.values())
    sought = np.zeros(len(rows))
    for e, c in p.items():
        sought[rows[e]] = float(c) / size
    norms = np.max(
        [np.abs(form).max(axis=(1, 2)) for form in forms if form.size], axis=0
    )  # a small row is to hold as well as a large one
    found = _follow([form / norms[:, None, None] for form in forms], sought / norms)
    return None if found is None else [gram * size / scale for gram, scale in zip(found, scales)]


def _follow(forms: list[Array], sought: Array) -> list[Array] | None:
    flat = np.concatenate([form.reshape(len(sought), -1) for form in forms], axis=1)
    start = np.linalg.lstsq(flat, sought, rcond=1e-12)[0]
    if np.abs(flat @ start - sought).max() > CENTRED:
        return None
    ends = np.cumsum([0] + [form.shape[1] ** 2 for form in forms])
    grams = [
        start[first:last].reshape(form.shape[1:])
        for first, last, form in zip(ends, ends[1:], forms)
    ]
    lift = 1 - min(float(np.linalg.eigvalsh((gram + gram.T) / 2)[0]) for gram in grams)
    grams = [(gram + gram.T) / 2 + lift * np.eye(len(gram)) for gram in grams]
    units = sum(np.trace(form, axis1=1, axis2=2) for form in forms)
    best, pull = None, 1.0
    for _ in range(STEPS):
        values = sum(np.tensordot(form, gram, axes=2) for form, gram in zip(forms, grams))
        system = np.zeros((len(sought) + 1, len(sought) + 1))
        system[:-1, -1] = system[-1, :-1] = units
        for form, gram in zip(forms, grams):
            system[:-1, :-1] += (
                form.reshape(len(sought), -1) @ (gram @ form @ gram).reshape(len(sought), -1).T
            )
        solved = np.linalg.lstsq(system, np.append(values, pull), rcond=1e-15)[0]
        steps = [
            gram - gram @ np.tensordot(solved[:-1], form, axes=1) @ gram
            for form, gram in zip(forms, grams)
        ]
        reach = min(_reach(gram, step) for gram, step in zip(grams, steps))
        length = min(1.0, 0.8 * reach)
        grams = [gram + length * (step + step.T) / 2 for gram, step in zip(grams, steps)]
        lift += length * float(solved[-1])
        least = min(float(np.linalg.eigvalsh(gram)[0]) for gram in grams)
        if not np.isfinite(lift) or least <= 0:
            break
        if least > lift and (best is None or least - lift > best[0] * 1.05):
            best = (least - lift, [gram - lift * np.eye(len(gram)) for gram in grams])
        elif best is not None and length == 1.0:
            break
        pull *= 4 if length == 1.0 or reach > 2 else 1.5
    return None if best is None else best[1]


def _reach(gram: Array, step: Array) -> float:
    """How many such steps lead to the edge of the cone."""
    root = np.linalg.inv(np.linalg.cholesky(gram))
    least = float(np.linalg.eigvalsh(root @ ((step + step.T) / 2) @ root.T)[0])
    return 1e9 if least >= 0 else -1 / least


def rounded(
    p: Polynomial, blocks: Sequence[Block], grams: Sequence[Array], spare: Sequence[int]
) -> list[Matrix] | None:
    """Rational matrices, positive definite, with exactly the sum p: the first block makes up for
    what rounding the others leaves.

    `spare` names blocks whose entry (0, 0) takes what is left of a monomial that the first block
    cannot have.
    """
    home: dict[Exponents, list[tuple[int, int]]] = {}
    for i, a in enumerate(blocks[0].basis):
        for j in range(i, len(blocks[0].basis)):
            home.setdefault(tuple(map(sum, zip(a, blocks[0].basis[j]))), []).append((i, j))
    for bits in BITS:
        exact = [
            [
                [Fraction(round(float(c) * 2**bits), 2**bits) for c in row]
                for row in (gram + gram.T) / 2
            ]
            for gram in grams
        ]
        left = _left(p, blocks, exact)
        for k in spare:
            ((monomial, c),) = blocks[k].multiplier.items()
            if monomial in left and monomial not in home:
                exact[k][0][0] += left.pop(monomial) / c
        if any(e not in home for e in left):
            continue
        for e, c in left.items():
            share = c / sum(1 if i == j else 2 for i, j in home[e])
            for i, j in home[e]:
                exact[0][i][j] += share / (blocks[0].scales[i] * blocks[0].scales[j])
                exact[0][j][i] = exact[0][i][j]
        if all(
            min(np.linalg.eigvalsh(np.array(gram, dtype=float))[:1], default=1) > 0
            for gram in exact
        ) and all(map(squares, exact)):
            return exact
    return None


def _left(p: Polynomial, blocks: Sequence[Block], grams: Sequence[Matrix]) -> Polynomial:
    left = dict(p)
    for block, gram in zip(blocks, grams):
        for i, j, part in block.parts():
            for e, c in part.items():
                left[e] = left.get(e, Fraction(0)) - c * gram[i][j]
    return {e: c for e, c in left.items() if c}


def squares(gram: Matrix) -> list[tuple[Fraction, list[Fraction]]] | None:
    """G = sum d l l^T with d > 0, by elimination; None where G is not positive definite.  An empty
    G has no squares.
    """
    rest, found = [list(row) for row in gram], []
    for k in range(len(gram)):
        pivot = rest[k][k]
        if pivot <= 0:
            return None
        row = [c / pivot for c in rest[k]]
        found.append((pivot, row))
        for i in range(k + 1, len(gram)):
            if rest[i][k]:
                rest[i] = [x - rest[k][i] * y for x, y in zip(rest[i], row)]
        for i in range(k + 1, len(gram)):
            rest[i][k] = Fraction(0)
    return found
