"""Whether a problem seems to have a point: floating samples that are moved uphill, so that hopeless
proofs are not tried.

A point found here proves nothing; it only ends the search for a proof that cannot exist.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .budget import Budget
from .problem import Problem

SAMPLES, ROUNDS, KEPT, MARGIN = 160, 5, 8, 1e-6
Array = np.ndarray[Any, np.dtype[np.float64]]


class Values:
    """The facts of a problem as arrays, ready to be evaluated at many points."""

    def __init__(self, problem: Problem) -> None:
        self.exponents: list[Array] = []
        self.used = sorted(
            {v for fact in problem.facts for v, d in enumerate(fact.poly.degrees()) if d}
        )
        place = {v: k for k, v in enumerate(self.used)}
        monomials: dict[tuple[int, ...], int] = {}
        entries: list[tuple[int, int, float]] = []
        for row, fact in enumerate(problem.facts):
            for monomial, coefficient in zip(fact.poly.monoms(), fact.poly.coeffs()):
                column = monomials.setdefault(
                    tuple(int(monomial[v]) for v in self.used), len(monomials)
                )
                entries.append((row, column, float(int(coefficient))))
        self.powers = np.array(list(monomials), dtype=np.int64).reshape(
            len(monomials), len(self.used)
        )
        self.matrix = np.zeros((len(problem.facts), len(monomials)))
        for row, column, value in entries:
            self.matrix[row, column] += value
        self.top = int(self.powers.max(initial=0))
        self.range = None
        if problem.bounded is not None and problem.bounded.variable in place:
            bounded = problem.bounded
            low, high = (
                float(problem.facts[k].end(bounded.variable)) for k in (bounded.low, bounded.high)
            )
            self.range = place[bounded.variable], low, high

    def least(self, points: Array) -> Array:
        """At every point the least of the facts, each divided by the sum of the absolute values of
        its terms.
        """
        table = np.ones((self.top + 1, *points.shape))
        for k in range(1, self.top + 1):
            table[k] = table[k - 1] * points
        terms = np.ones((len(points), len(self.powers)))
        for v in range(len(self.used)):
            terms *= table[self.powers[:, v], :, v].T
        sums, sizes = terms @ self.matrix.T, np.abs(terms) @ np.abs(self.matrix).T
        result: Array = (sums / np.maximum(sizes, 1e-300)).min(axis=1)
        return result


def has_interior_point(problem: Problem, budget: Budget) -> bool:
    """Whether a floating point was found at which every fact is positive by a margin; never where
    an equation is left.
    """
    if problem.reduction.left or not problem.facts or len(problem.facts) > 40:
        return False
    values = Values(problem)
    budget.spend(200 + SAMPLES * ROUNDS * len(values.powers) // 20)
    random = np.random.default_rng(11)
    shape = SAMPLES, len(values.used)
    points = random.normal(size=shape) * np.exp(random.normal(size=shape))
    if values.range is not None:
        column, low, high = values.range
        points[:, column] = low + (high - low) * random.random(SAMPLES)
    width = 0.5
    for _ in range(ROUNDS):
        score = values.least(points)
        best = np.argsort(-score, kind="stable")[:KEPT]
        if score[best[0]] > MARGIN:
            return True
        parents = np.repeat(points[best], SAMPLES // KEPT, axis=0)
        moves = random.normal(size=parents.shape) * (random.random(parents.shape) < 0.5) * width
        points = parents * (1 + moves) + moves * random.random((len(parents), 1)) * 0.3
        points[:KEPT] = parents[:: SAMPLES // KEPT]
        width *= 0.6
    return False
