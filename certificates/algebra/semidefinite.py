"""Positive definite Gram matrices with given coefficients: found in floating point, then rounded
to.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any

import numpy as np
from flint import fmpq

from juggleproof.certificates.search.small_boxes import Exponents
from juggleproof.certificates.work import Budget

# -------------------------------------------------------------------------------------------------
# Positive definite Gram matrices with given coefficients: found in floating point, then rounded to
# exact rationals.

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


# -------------------------------------------------------------------------------------------------
# Semidefinite feasibility in floats: a hint at sums of squares, which exact arithmetic and the
# checker have to confirm.
#
# An infeasible primal-dual interior-point method (Helmberg, Rendl, Vanderbei and Wolkowicz 1996;
# Kojima, Shindoh and Hara 1997). Its steps are counted, so that it ends after the same work
# everywhere.

Floats = np.ndarray[Any, np.dtype[np.float64]]
DUAL_STEPS = 60
ENOUGH = 1e-6  # what equations may miss
SMALL = 1e-13  # an eigenvalue of equations that depend on others


def feasible(
    blocks: list[Floats], free: Floats, right: Floats, budget: Budget, trace: float, last: float
) -> list[Floats] | None:
    """Positive semidefinite X_k with sum A_k X_k + free m = right for some m, as floats; None where
    the steps lead to none.

    A_k has the shape (rows, n_k, n_k).  With a cost of the trace, X tends to a simple solution;
    with hardly any, to the middle of all solutions: where all of them are singular, X is nearly so,
    and its small eigenvalues show their common kernel.
    """
    if free.shape[1]:
        budget.spend(20 + len(right) ** 3 // 8000)
        values, left = np.linalg.eigh(free @ free.T)
        rest = left[:, values <= SMALL * max(1.0, values.max(initial=0.0))].T
        blocks, right = [np.tensordot(rest, block, 1) for block in blocks], rest @ right
    independent = _independent(blocks, right, budget)
    if independent is None:
        return None
    blocks, right = independent
    rows, sizes = len(right), [block.shape[1] for block in blocks]
    if not rows or not sizes:
        return None
    flat = [block.reshape(rows, -1) for block in blocks]
    cost = sum(rows * n**3 + rows * rows * n * n for n in sizes) + rows**3
    total = sum(sizes)
    primal, dual, y = (
        [10 * np.eye(n) for n in sizes],
        [10 * np.eye(n) for n in sizes],
        np.zeros(rows),
    )
    best: list[Floats] | None = None
    for _ in range(DUAL_STEPS):
        budget.spend(50 + cost // 4000)
        mu = sum(float((x * z).sum()) for x, z in zip(primal, dual)) / total
        missing = right - sum((a @ x.ravel() for a, x in zip(flat, primal)), np.zeros(rows))
        if np.abs(missing).max() < ENOUGH * (1 + np.abs(right).max()):
            best = primal
        if mu < last:
            return best
        try:
            with np.errstate(all="ignore"):
                moved = _step(blocks, flat, primal, dual, y, missing, mu, trace)
        except np.linalg.LinAlgError:
            return best
        if moved is None:
            return best
        primal, dual, y = moved
        if max(float(np.abs(x).max()) for x in primal) > 1e9:
            return best
    return best


def _independent(
    blocks: list[Floats], right: Floats, budget: Budget
) -> tuple[list[Floats], Floats] | None:
    """The same equations as orthonormal rows, without those that follow from others; None where
    they contradict one another.
    """
    budget.spend(20 + len(right) ** 3 // 8000)
    whole = np.hstack([block.reshape(len(right), -1) for block in blocks])
    values, left = np.linalg.eigh(whole @ whole.T)
    kept = values > SMALL * max(1.0, values.max(initial=0.0))
    change = left[:, kept].T / np.sqrt(values[kept, None])
    if np.abs(right - left[:, kept] @ (left[:, kept].T @ right)).max() > 1e-7:
        return None
    return [np.tensordot(change, block, 1) for block in blocks], change @ right


def _step(
    blocks: list[Floats],
    flat: list[Floats],
    primal: list[Floats],
    dual: list[Floats],
    y: Floats,
    missing: Floats,
    mu: float,
    trace: float,
) -> tuple[list[Floats], list[Floats], Floats] | None:
    """One step with a predictor and a corrector; None where it makes no way."""
    rows = len(y)
    inverse = [np.linalg.inv(z) for z in dual]
    system, base, slack = np.zeros((rows, rows)), missing.copy(), []
    centre = np.zeros(rows)
    for block, a, x, z, back in zip(blocks, flat, primal, dual, inverse):
        system += (x @ block @ back).reshape(rows, -1) @ a.T
        rest = trace * np.eye(len(x)) - (a.T @ y).reshape(x.shape) - z
        slack.append(rest)
        base += a @ (x + x @ rest @ back).ravel()
        centre += a @ back.ravel()
    system = (system + system.T) / 2
    system += 1e-13 * np.trace(system) / rows * np.eye(rows)

    def direction(
        target: float, second: list[Floats] | None
    ) -> tuple[list[Floats], list[Floats], Floats]:
        right = base - target * centre
        if second is not None:
            right = right + sum((a @ s.ravel() for a, s in zip(flat, second)), np.zeros(rows))
        dy: Floats = np.asarray(np.linalg.solve(system, right), dtype=np.float64)
        dz: list[Floats] = [rest - (a.T @ dy).reshape(rest.shape) for rest, a in zip(slack, flat)]
        dx = [-x + target * back - x @ d @ back for x, back, d in zip(primal, inverse, dz)]
        if second is not None:
            dx = [d - s for d, s in zip(dx, second)]
        return [(d + d.T) / 2 for d in dx], dz, dy

    dx, dz, _ = direction(0.0, None)
    ahead, behind = min(1.0, _room(primal, dx)), min(1.0, _room(dual, dz))
    there = sum(
        float(((x + ahead * a) * (z + behind * b)).sum())
        for x, a, z, b in zip(primal, dx, dual, dz)
    ) / sum(map(len, primal))
    target = mu * min(1.0, max(0.05, (max(there, 0.0) / mu) ** 2))
    dx, dz, dy = direction(target, [a @ b @ back for a, b, back in zip(dx, dz, inverse)])
    ahead, behind = min(1.0, 0.95 * _room(primal, dx)), min(1.0, 0.95 * _room(dual, dz))
    if not np.isfinite(dy).all() or max(ahead, behind) < 1e-6:
        return None
    after: Floats = y + behind * dy
    slacks: list[Floats] = [z + behind * d for z, d in zip(dual, dz)]
    return [x + ahead * d for x, d in zip(primal, dx)], slacks, after


def _room(points: list[Floats], directions: list[Floats]) -> float:
    """How far one can go and stay in the cone."""
    least = 0.0
    for x, d in zip(points, directions):
        lower = np.linalg.inv(np.linalg.cholesky(x))
        least = min(least, float(np.linalg.eigvalsh(lower @ d @ lower.T)[0]))
    return -1.0 / least if least < -1e-12 else 1e9


# -------------------------------------------------------------------------------------------------
# Gram matrices from floats to exact squares: the image of a matrix as rationals, and LDL^T.

# to a rational with a small denominator: eigenvectors of singular matrices are no better known
NEAR = 2e-3


def rational_image(vectors: Floats, near: float = NEAR) -> list[list[int]] | None:
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
