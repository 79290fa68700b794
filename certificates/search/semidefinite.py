"""Semidefinite feasibility in floats: a hint at sums of squares, which exact arithmetic and the
checker have to confirm.

An infeasible primal-dual interior-point method (Helmberg, Rendl, Vanderbei and Wolkowicz 1996;
Kojima, Shindoh and Hara 1997). Its steps are counted, so that it ends after the same work
everywhere.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .budget import Budget

Array = np.ndarray[Any, np.dtype[np.float64]]
STEPS = 60
ENOUGH = 1e-6  # what equations may miss
SMALL = 1e-13  # an eigenvalue of equations that depend on others


def feasible(
    blocks: list[Array], free: Array, right: Array, budget: Budget, trace: float, last: float
) -> list[Array] | None:
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
    best: list[Array] | None = None
    for _ in range(STEPS):
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
    blocks: list[Array], right: Array, budget: Budget
) -> tuple[list[Array], Array] | None:
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
    blocks: list[Array],
    flat: list[Array],
    primal: list[Array],
    dual: list[Array],
    y: Array,
    missing: Array,
    mu: float,
    trace: float,
) -> tuple[list[Array], list[Array], Array] | None:
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
        target: float, second: list[Array] | None
    ) -> tuple[list[Array], list[Array], Array]:
        right = base - target * centre
        if second is not None:
            right = right + sum((a @ s.ravel() for a, s in zip(flat, second)), np.zeros(rows))
        dy: Array = np.asarray(np.linalg.solve(system, right), dtype=np.float64)
        dz: list[Array] = [rest - (a.T @ dy).reshape(rest.shape) for rest, a in zip(slack, flat)]
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
    after: Array = y + behind * dy
    slacks: list[Array] = [z + behind * d for z, d in zip(dual, dz)]
    return [x + ahead * d for x, d in zip(primal, dx)], slacks, after


def _room(points: list[Array], directions: list[Array]) -> float:
    """How far one can go and stay in the cone."""
    least = 0.0
    for x, d in zip(points, directions):
        lower = np.linalg.inv(np.linalg.cholesky(x))
        least = min(least, float(np.linalg.eigvalsh(lower @ d @ lower.T)[0]))
    return -1.0 / least if least < -1e-12 else 1e9
