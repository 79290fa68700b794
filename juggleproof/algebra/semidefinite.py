"""The semidefinite program of sums of squares: solved in floats as a hint, rounded to rationals
that meet its equations exactly, and taken apart into squares.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm

import numpy as np
from flint import fmpq, fmpz_mat, fmpz_mpoly, nmod_mat
from numpy.typing import NDArray

from juggleproof.algebra import limits
from juggleproof.algebra.polynomials import Monomial
from juggleproof.statements.work import Budget

# -------------------------------------------------------------------------------------------------
# Semidefinite feasibility in floats: a hint at sums of squares, which exact arithmetic and the
# checker have to confirm.
#
# An infeasible primal-dual interior-point method (Helmberg, Rendl, Vanderbei and Wolkowicz 1996;
# Kojima, Shindoh and Hara 1997). Its steps are counted, so that it ends after the same work
# everywhere.
#
# Clarabel 0.11 was measured in its place: the same verdicts, 0.12 s against 0.67 s for 26 programs;
# but it needs SciPy, 143 MB and 0.14 s a process, and its LAPACK too is the machine's.

Floats = NDArray[np.float64]


def feasible(
    blocks: list[Floats], free: Floats, right: Floats, budget: Budget, trace: float, last: float
) -> list[Floats] | None:
    """Positive semidefinite X_k with sum A_k X_k + free m = right for some m, as floats; None where
    the steps lead to none.  Raises Exhausted where the budget ends.

    Shapes: A_k (rows, n_k, n_k), free (rows, columns), right (rows,), X_k (n_k, n_k).  The cost is
    `trace` times the trace, and the steps end where the duality gap is below `last`.  With a cost
    of the trace, X tends to a simple solution; with hardly any, to the middle of all solutions:
    where all of them are singular, X is nearly so, and its small eigenvalues show their common
    kernel.
    """
    if free.shape[1]:
        budget.spend(20 + len(right) ** 3 // 8000)
        values, left = np.linalg.eigh(free @ free.T)
        rest = left[:, values <= limits.DEPENDENT * max(1.0, values.max(initial=0.0))].T
        blocks, right = [np.tensordot(rest, block, 1) for block in blocks], rest @ right
    independent = _independent(blocks, right, budget)
    if independent is None:
        return None
    blocks, right = independent
    rows, sizes = len(right), [block.shape[1] for block in blocks]
    if not rows or not sizes:
        return None
    # most programs have many small matrices: those of one size are worked on at once
    places = [[k for k, n in enumerate(sizes) if n == size] for size in sorted(set(sizes))]
    stacks = [np.array([blocks[k] for k in own]) for own in places]
    flat = [stack.swapaxes(0, 1).reshape(rows, -1) for stack in stacks]
    cost = sum(rows * n**3 + rows * rows * n * n for n in sizes) + rows**3
    total, y = sum(sizes), np.zeros(rows)
    primal, dual = (
        [10 * np.tile(np.eye(stack.shape[-1]), (len(stack), 1, 1)) for stack in stacks]
        for _ in range(2)
    )
    best: list[Floats] | None = None
    for _ in range(limits.DUAL_STEPS):
        budget.spend(50 + cost // 4000)
        mu = _product(primal, dual) / total
        missing = right - sum((a @ x.ravel() for a, x in zip(flat, primal)), np.zeros(rows))
        if np.abs(missing).max() < limits.ENOUGH * (1 + np.abs(right).max()):
            best = primal
        if mu < last:
            break
        try:
            with np.errstate(all="ignore"):
                moved = _step(stacks, flat, primal, dual, y, missing, mu, trace)
        except np.linalg.LinAlgError:
            break
        if moved is None:
            break
        primal, dual, y = moved
        # by weak duality, `trace` times the trace of every solution is no less than right y
        if float(right @ y) > limits.LARGE * max(trace, limits.HARDLY):
            break
        if max(float(np.abs(x).max()) for x in primal) > limits.LARGE:
            break
    if best is None:
        return None
    found = dict(pair for own, stack in zip(places, best) for pair in zip(own, stack))
    return [found[k] for k in range(len(sizes))]


def _independent(
    blocks: list[Floats], right: Floats, budget: Budget
) -> tuple[list[Floats], Floats] | None:
    """The same equations as orthonormal rows, without those that follow from others, in the shapes
    of `feasible`; None where they contradict one another.
    """
    budget.spend(20 + len(right) ** 3 // 8000)
    whole = np.hstack([block.reshape(len(right), -1) for block in blocks])
    values, left = np.linalg.eigh(whole @ whole.T)
    kept = values > limits.DEPENDENT * max(1.0, values.max(initial=0.0))
    change = left[:, kept].T / np.sqrt(values[kept, None])
    if np.abs(right - left[:, kept] @ (left[:, kept].T @ right)).max() > 1e-7:
        return None
    return [np.tensordot(change, block, 1) for block in blocks], change @ right


def _step(
    stacks: list[Floats],
    flat: list[Floats],
    primal: list[Floats],
    dual: list[Floats],
    y: Floats,
    missing: Floats,
    mu: float,
    trace: float,
) -> tuple[list[Floats], list[Floats], Floats] | None:
    """One step with a predictor and a corrector; None where it makes no way.

    Shapes, for each size n with m matrices: their A_k as `stacks` (m, rows, n, n) and `flat` (rows,
    m n^2), `primal` and `dual` (m, n, n); `y` and `missing`, which is what the equations miss,
    (rows,).  Source: Mehrotra, SIAM J. Optimization 2 (1992).
    """
    rows = len(y)
    inverse = list(map(np.linalg.inv, dual))
    system, base, slack = np.zeros((rows, rows)), missing.copy(), []
    centre = np.zeros(rows)
    for stack, a, x, z, back in zip(stacks, flat, primal, dual, inverse):
        size = x.shape[-1]
        left, right = x[:, None], back[:, None]
        image = left @ stack @ right if size > 1 else left * stack * right
        system += image.swapaxes(0, 1).reshape(rows, -1) @ a.T
        rest = trace * np.eye(size) - (a.T @ y).reshape(x.shape) - z
        slack.append(rest)
        base += a @ (x + x @ rest @ back).ravel()
        centre += a @ back.ravel()
    system = (system + system.T) / 2
    system += 1e-13 * np.trace(system) / rows * np.eye(rows)

    def direction(target: float, second: list[Floats]) -> tuple[list[Floats], list[Floats], Floats]:
        right = base - target * centre
        right = right + sum((a @ s.ravel() for a, s in zip(flat, second)), np.zeros(rows))
        dy: Floats = np.asarray(np.linalg.solve(system, right), dtype=np.float64)
        dz: list[Floats] = [rest - (a.T @ dy).reshape(rest.shape) for rest, a in zip(slack, flat)]
        dx = [
            -x + target * back - x @ d @ back - s
            for x, back, d, s in zip(primal, inverse, dz, second)
        ]
        return [(d + d.swapaxes(1, 2)) / 2 for d in dx], dz, dy

    dx, dz, _ = direction(0.0, [0 * x for x in primal])
    ahead, behind = min(1.0, _room(primal, dx)), min(1.0, _room(dual, dz))
    there = _product(
        [x + ahead * a for x, a in zip(primal, dx)], [z + behind * b for z, b in zip(dual, dz)]
    ) / sum(x[..., 0].size for x in primal)
    target = mu * min(1.0, max(0.05, (max(there, 0.0) / mu) ** 2))
    dx, dz, dy = direction(target, [a @ b @ back for a, b, back in zip(dx, dz, inverse)])
    ahead, behind = min(1.0, 0.95 * _room(primal, dx)), min(1.0, 0.95 * _room(dual, dz))
    if not np.isfinite(dy).all() or max(ahead, behind) < 1e-6:
        return None
    after: Floats = y + behind * dy
    slacks: list[Floats] = [z + behind * d for z, d in zip(dual, dz)]
    return [x + ahead * d for x, d in zip(primal, dx)], slacks, after


def _product(one: list[Floats], other: list[Floats]) -> float:
    """The sum of the traces of the products of symmetric matrices."""
    return sum(float((x * z).sum()) for x, z in zip(one, other))


def _room(points: list[Floats], directions: list[Floats]) -> float:
    """How far one can go from positive definite X along D and stay positive semidefinite.

    Formula: -1 / (least eigenvalue of L^-1 D L^-T), X = L L^T, over all pairs (X, D) of the shape
    (n, n).  Raises LinAlgError where an X is not positive definite.
    """
    least = 0.0
    for x, d in zip(points, directions):
        lower = np.linalg.inv(np.linalg.cholesky(x))
        found = np.linalg.eigvalsh(lower @ d @ lower.swapaxes(1, 2))
        least = min(least, *found[:, 0].tolist())
    return -1.0 / least if least < -1e-12 else 1e9


# -------------------------------------------------------------------------------------------------
# Gram matrices from floats to exact squares: the image of a matrix as rationals, and LDL^T.


def rational_image(vectors: Floats, tolerance: float = limits.TOLERANCE) -> list[list[int]] | None:
    """A basis of the space that the columns of a matrix of the shape (n, columns) span, as rows of
    small integers, in echelon form; None where none is within the tolerance.
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
        if any(abs(float(f) - float(c)) > tolerance for f, c in zip(fractions, line)):
            return None
        common = lcm(*(f.denominator for f in fractions))
        result.append([int(f * common) for f in fractions])
    return result


def as_squares(gram: list[list[Fraction]]) -> list[tuple[Fraction, list[int]]] | None:
    """(c, row) with gram = sum c * row row^T, every c > 0, by LDL^T; None where the matrix is not
    positive semidefinite.  Source: Golub and Van Loan, Matrix Computations, 4.1.

    >>> as_squares([[Fraction(1), Fraction(-1)], [Fraction(-1), Fraction(1)]])
    [(Fraction(1, 1), [1, -1])]
    """
    size = len(gram)
    approximate = np.array([[float(c) for c in row] for row in gram])
    if size and np.linalg.eigvalsh(approximate)[0] < -1e-6 * np.abs(approximate).max():
        return None  # floats see what is far from it; exact arithmetic decides the rest
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


# -------------------------------------------------------------------------------------------------
# The linear equations on the entries of Gram matrices: solved in floats, rounded, and met
# exactly.

Entry = tuple[int, int, int]  # block, row, column
PRIME = (1 << 61) - 1


@dataclass
class GramBlock:
    """A polynomial that is multiplied by a sum of squares of combinations of the basis.

    `strict` where it is known to be positive, not only not negative; then the basis is 1.
    """

    poly: fmpz_mpoly
    strict: bool
    basis: list[fmpz_mpoly]


class LinearEquations:
    """The equations on the entries of the blocks' Gram matrices, and on the multipliers of the
    cofactors: sum_k poly_k * basis_k^T G_k basis_k + sum m_j * cofactor_j = 0.

    There is one for each monomial, and one that sets the sum of the strict terms to `total`.
    Source: Powers and Woermann, J. Pure and Applied Algebra 127 (1998).
    """

    def __init__(
        self, blocks: Sequence[GramBlock], cofactors: Sequence[fmpz_mpoly], total: Fraction
    ) -> None:
        self.blocks, self.total, more = blocks, total, list(cofactors)
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

    def solve(self, budget: Budget, trace: float, last: float) -> list[Floats] | None:
        """Gram matrices in floats, one for each block, each times its scale, of the shape (n, n)
        for a basis of n; None where `feasible` has none, or numbers are too large for floats.
        `trace` and `last` are its own.
        """
        try:
            blocks, free, tops = self._in_floats()
        except OverflowError:
            return None
        # a small row is to hold as well as a large one
        sizes = np.max(
            [
                np.abs(part).reshape(self.rows, -1).max(axis=1, initial=0.0)
                for part in (*blocks, free)
            ],
            axis=0,
        )
        blocks = [block / sizes[:, None, None] for block in blocks]
        free /= sizes[:, None]
        right = np.zeros(self.rows)
        right[-1] = float(self.total) / sizes[-1]
        grams = feasible(blocks, free, right, budget, trace, last)
        if grams is None:
            return None
        if free.shape[1]:
            rest = right - sum(
                (block.reshape(self.rows, -1) @ gram.ravel() for block, gram in zip(blocks, grams)),
                np.zeros(self.rows),
            )
            self.multipliers = (np.linalg.lstsq(free, rest, rcond=None)[0] / tops).tolist()
        return grams

    def _in_floats(self) -> tuple[list[Floats], Floats, list[float]]:
        """The blocks' columns, those of the equations' multipliers, each divided by its largest
        entry, and these entries; OverflowError where one is too large.
        """
        blocks = [
            np.zeros((self.rows, len(block.basis), len(block.basis))) for block in self.blocks
        ]
        for (k, i, j), column in zip(self.entries, self.terms):
            scale, half = self.scales[k], 1 if i == j else 2
            for row, c in column.items():
                value = c * scale.denominator / scale.numerator / half
                blocks[k][row, i, j] += value
                if i != j:
                    blocks[k][row, j, i] += value
        free = np.zeros((self.rows, len(self.terms) - self.count))
        tops = [max(map(abs, column.values())) for column in self.terms[self.count :]]
        for at, (column, top) in enumerate(zip(self.terms[self.count :], tops)):
            for row, c in column.items():
                free[row, at] = c / top
        return blocks, free, list(map(float, tops))

    @cached_property
    def scales(self) -> list[Fraction]:
        """By what the entries of each block are multiplied in floats, so that its product has a
        size of 1: a power of 2, near the largest coefficient; for strict ones what makes their sum
        1.
        """
        return [
            1 / self.total
            if block.strict
            else Fraction(1 << max(int(c).bit_length() for c in block.poly.coeffs()) - 1)
            for block in self.blocks
        ]

    def rounded(
        self, grams: list[Floats], denominator: int
    ) -> Iterator[tuple[dict[Entry, Fraction], list[Fraction]]]:
        """Exact entries near the floating ones that meet all equations, and multipliers of the
        equations: at most three of them.

        The entries are rounded, and what is then missing is made up for: by the entries that stand
        in one equation only, or by as few entries as there are equations, which keeps denominators
        short, and by the shortest vector in the entries.
        """
        start = [
            Fraction(round(float(grams[k][i, j]) * denominator), denominator) / self.scales[k]
            for k, i, j in self.entries
        ]
        start += [Fraction(round(m * denominator), denominator) for m in self.multipliers]
        strict = [at for at, (k, _, _) in enumerate(self.entries) if self.blocks[k].strict]
        if len(strict) == 1:
            start[strict[0]] = self.total
        missing = [-c for c in self.combination(start)]
        missing[-1] += self.total
        for correction in (self.spread, self.basic, self.shortest) if any(missing) else ():
            change = correction(missing)
            if change is not None:
                exact = [a + b for a, b in zip(start, change)]
                yield dict(zip(self.entries, exact)), exact[self.count :]
        if not any(missing):
            yield dict(zip(self.entries, start)), start[self.count :]

    def combination(self, values: Sequence[Fraction]) -> list[Fraction]:
        """The left side of every equation at these values."""
        common = lcm(*(value.denominator for value in values))
        left = [0] * self.rows
        for value, column in zip(values, self.terms):
            whole = value.numerator * (common // value.denominator)
            for row, c in column.items() if whole else ():
                left[row] += c * whole
        return [Fraction(value, common) for value in left]

    def spread(self, missing: list[Fraction]) -> list[Fraction] | None:
        """What is missing in each equation, spread over the entries that stand in no other; None
        where it has no such entry.
        """
        change = [Fraction(0)] * len(self.terms)
        for row, value in enumerate(missing):
            if value:
                own = self.alone.get(row, [])
                size = sum(c * c for _, c in own)
                if not size:
                    return None
                for k, c in own:
                    change[k] = value * c / size
        return change

    @cached_property
    def alone(self) -> dict[int, list[tuple[int, int]]]:
        """For each equation the columns that stand in no other, with their coefficients."""
        columns: dict[int, list[tuple[int, int]]] = {}
        for k, column in enumerate(self.terms):
            if len(column) == 1:
                ((row, c),) = column.items()
                columns.setdefault(row, []).append((k, c))
        return columns

    def basic(self, missing: list[Fraction]) -> list[Fraction] | None:
        """A vector whose combination of the columns is what is missing, and which is 0 but in as
        many columns as there are independent equations: those that stand in few equations.
        """
        columns, square = self.basis
        found = self._combined(square, missing)
        if found is None:
            return None
        change = [Fraction(0)] * len(self.terms)
        for column, value in zip(columns, found):
            change[column] = value
        return change if self.combination(change) == missing else None

    def shortest(self, missing: list[Fraction]) -> list[Fraction] | None:
        """The shortest vector whose combination of the columns is what is missing."""
        _, kept, square = self.independent
        found = self._combined(square, missing, kept)
        return found if found is not None and self.combination(found) == missing else None

    def _combined(
        self, square: fmpz_mat, missing: list[Fraction], kept: fmpz_mat | None = None
    ) -> list[Fraction] | None:
        """x with square * x = missing in the independent equations, or kept^T x; None where there
        is none.
        """
        scale = lcm(*(m.denominator for m in missing))
        right = fmpz_mat([[int(missing[row] * scale)] for row in self.independent[0]])
        try:
            above, below = _solved(square, right)
        except ZeroDivisionError:
            return None
        found = above if kept is None else kept.transpose() * above
        return [Fraction(int(found[k, 0]), below * scale) for k in range(found.nrows())]

    @cached_property
    def basis(self) -> tuple[list[int], fmpz_mat]:
        """Columns that are independent, as many as there are independent equations, those with few
        and small coefficients first, and the square matrix of both.
        """
        _, kept, _ = self.independent
        order = sorted(
            range(len(self.terms)), key=lambda k: (sum(map(abs, self.terms[k].values())), k)
        )
        table = kept.table()
        pivots = _pivots(fmpz_mat([[row[k] for k in order] for row in table]))
        columns = sorted(order[at] for at in pivots)
        return columns, fmpz_mat([[row[k] for k in columns] for row in table])

    @cached_property
    def independent(self) -> tuple[list[int], fmpz_mat, fmpz_mat]:
        """Rows that are independent of one another, the matrix of these, and it times its
        transpose.
        """
        table = [[0] * len(self.terms) for _ in range(self.rows)]
        for at, column in enumerate(self.terms):
            for row, c in column.items():
                table[row][at] = c
        pivots = _pivots(fmpz_mat(table).transpose())
        kept = fmpz_mat([table[row] for row in pivots])
        return pivots, kept, kept * kept.transpose()


def _pivots(matrix: fmpz_mat) -> list[int]:
    """The columns that are no combination of those before them, modulo a large prime."""
    reduced, rank = nmod_mat(matrix, PRIME).rref()
    pivots, at = list[int](), 0
    for row in range(rank):
        while not int(reduced[row, at]):
            at += 1
        pivots.append(at)
    return pivots


def _solved(matrix: fmpz_mat, right: fmpz_mat) -> tuple[fmpz_mat, int]:
    """(n, d) with matrix * n = d * right."""
    solution = matrix.solve(right)
    common = lcm(*(int(solution[k, 0].q) for k in range(solution.nrows())))
    return fmpz_mat([[int(solution[k, 0] * common)] for k in range(solution.nrows())]), common
