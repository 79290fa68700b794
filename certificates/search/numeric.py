"""Points in floats that nearly meet a condition, by damped Gauss-Newton steps from counted starts:
a guide to exact ones, and no more.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from flint import fmpq, fmpq_mpoly

from .budget import Budget
from .condition import Condition, Tree, places

Array = np.ndarray[Any, np.dtype[np.float64]]
STARTS, STEPS = 12, 40
MARGINS = (0.2, 0.02, 0.001)  # by how much inequalities are to be met, ever less


class Residual:
    """What a polynomial misses of its relation, with the gradient."""

    def __init__(self, poly: fmpq_mpoly, relation: str, variables: Sequence[int]) -> None:
        self.relation = relation
        self.powers = np.array(
            [[m[v] for v in variables] for m in poly.monoms()], dtype=np.int64
        ).reshape(-1, len(variables))
        values = [float(int(c.p) / int(c.q)) for c in poly.coeffs()]
        self.values = np.array(values) / max(map(abs, values), default=1.0)

    def at(self, point: Array, margin: float) -> tuple[float, Array]:
        """The residual and its gradient at a point."""
        table = point[None, :] ** self.powers
        whole = table.prod(axis=1) @ self.values
        gradient = np.array(
            [
                (
                    self.values
                    * self.powers[:, v]
                    * point[v] ** np.maximum(self.powers[:, v] - 1, 0)
                    * np.delete(table, v, axis=1).prod(axis=1)
                ).sum()
                for v in range(len(point))
            ]
        )
        if self.relation == "=":
            return float(whole), gradient
        if self.relation == "!=":
            return 0.0, np.zeros(len(point))
        short = margin - float(whole)
        return (short, -gradient) if short > 0 else (0.0, np.zeros(len(point)))


def near_points(
    condition: Condition, names: Sequence[str], budget: Budget
) -> Iterator[dict[str, fmpq]]:
    """Points near which the condition may be met, as rationals; other alternatives of `or` are
    taken from start to start.
    """
    variables = [name for name in names if name in condition.variables()]
    at = [places(condition.ring)[name] for name in variables]
    random = np.random.default_rng(11)
    for _ in range(STARTS if variables else 0):
        atoms = list(_alternative(condition.tree, random))
        residuals = [Residual(condition.polys[k], relation, at) for k, relation in atoms]
        start = random.normal(0.0, 1.5, len(variables))
        for margin in MARGINS:
            point = _descended(residuals, start, margin, budget)
            if point is not None:
                yield {
                    name: fmpq(round(float(value) * 2**40), 2**40)
                    for name, value in zip(variables, point)
                }
                break


def _alternative(tree: Tree, random: Any) -> Iterator[tuple[int, str]]:
    if isinstance(tree, bool):
        return
    if isinstance(tree[0], int):
        yield tree
    elif tree[0] == "and":
        for part in tree[1]:
            yield from _alternative(part, random)
    else:
        yield from _alternative(tree[1][int(random.integers(len(tree[1])))], random)


def _descended(
    residuals: Sequence[Residual], point: Array, margin: float, budget: Budget
) -> Array | None:
    """The point to which the steps lead, if all residuals vanish there."""
    damping = 1e-2
    with np.errstate(all="ignore"):
        value, jacobian = _all(residuals, point, margin)
        for _ in range(STEPS):
            budget.spend(10 + 6 * len(residuals) * (1 + len(point) // 3))
            size = float(value @ value)
            if not np.isfinite(size):
                return None
            if size < 1e-20:
                return point
            step = np.linalg.solve(
                jacobian.T @ jacobian + damping * np.eye(len(point)), -jacobian.T @ value
            )
            there, slope = _all(residuals, point + step, margin)
            if float(there @ there) < size:
                point, value, jacobian, damping = (
                    point + step,
                    there,
                    slope,
                    max(damping / 5, 1e-12),
                )
            else:
                damping *= 6
            if damping > 1e8:
                return None
    return None


def _all(residuals: Sequence[Residual], point: Array, margin: float) -> tuple[Array, Array]:
    pairs = [residual.at(point, margin) for residual in residuals]
    return np.array([value for value, _ in pairs]), np.array(
        [gradient for _, gradient in pairs]
    ).reshape(len(pairs), len(point))
