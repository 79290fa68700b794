"""Floating point without proof: random samples, and an optimiser of SciPy; their error is measured
here, since they give none.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from juggleproof.algebra.box_trees import Terms
from juggleproof.benchmarks.bench.answers import Answer, BoundQuestion
from juggleproof.search.boxes.descent import FloatPolynomial

Array = NDArray[np.float64]
MOST, AT_ONCE = 10**7, 10**5  # samples


def sampling(problem: BoundQuestion, width: Fraction) -> Answer:
    """The greatest of 1/width samples, 10^7 at most, uniform in the box from a fixed seed."""
    random, left, best = np.random.default_rng(1), min(max(int(1 / width), 100), MOST), -np.inf
    low, high = (np.array([float(pair[k]) for pair in problem.box]) for k in (0, 1))
    count = left
    while left > 0:
        points = low + (high - low) * random.random((min(left, AT_ONCE), len(low)))
        best, left = (
            max(best, float((values(problem.over, points) / values(problem.under, points)).max())),
            left - len(points),
        )
    return Answer(Fraction(best), None, f"{count} samples")


def scipy_optimize(problem: BoundQuestion, width: Fraction) -> Answer:
    """SciPy's differential evolution to this tolerance, from a fixed seed, polished."""
    from scipy.optimize import differential_evolution

    over, under = (
        FloatPolynomial(terms, len(problem.box)) for terms in (problem.over, problem.under)
    )

    def loss(x: Array) -> float:
        below = under(x)
        return -over(x) / below if below > 0 else np.inf

    minimum = differential_evolution(
        loss,
        [(float(low), float(high)) for low, high in problem.box],
        tol=float(width),
        atol=float(width),
        seed=1,
    )
    return Answer(Fraction(-float(minimum.fun)), None, f"{minimum.nfev} values")


def values(terms: Terms, points: Array) -> Array:
    """The values of a polynomial at many points, an array of shape (points, variables)."""
    total = np.zeros(len(points))
    for exponents, c in terms.items():
        part = np.full(len(points), float(c))
        for axis, e in enumerate(exponents):
            for _ in range(e):
                part *= points[:, axis]
        total += part
    return total
