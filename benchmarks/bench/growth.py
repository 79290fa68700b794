"""Work that grows by one number at a time: variables of a bound, states of an ensemble; and the
slope of seconds against size.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import sympy

import symbolic
from benchmarks.bench.answers import Strayed
from benchmarks.bench.problems import Problem
from benchmarks.bench.questions import ALPHAS, as_terms, bounding, denial, truth_at_ends
from proofs.encoding import from_sympy
from symbolic.algebra import lowest_terms
from symbolic.symbols import alpha, r, w, x

TOP = Fraction(4)  # of the closing speeds, beyond where the energy change is greatest
VARIABLE_WIDTH = Fraction(1, 1000)
STATE_STEPS, SEED = 100, 1


def balls(count: int) -> tuple[Problem, Fraction]:
    """The most energy that so many balls gain together, each struck as it leaves the table (x = 0):
    count + 1 variables; and the closed form.

    The polynomial is sum_i Delta E(0, w_i) on ALPHAS x [0, TOP]^count, its maximum is count Delta
    E_max.
    """
    speeds = sympy.symbols([f"w{i + 1}" for i in range(count)])
    change = symbolic.normal_energy_change().xreplace({x: sympy.S.Zero})
    total = sum((change.xreplace({w: speed}) for speed in speeds), start=sympy.S.Zero)
    names = ("alpha", *map(str, speeds))
    box = (ALPHAS, *((Fraction(0), TOP) for _ in speeds))
    one = {(0,) * len(names): Fraction(1)}
    over = as_terms(sympy.Poly(total, alpha, *speeds))
    givens = [
        side
        for name, (low, high) in zip(names, box)
        for side in (f"{low} <= {name}", f"{name} <= {high}")
    ]
    statement = bounding(f"{count}-balls", " ".join(names), givens, str(from_sympy(total)), "1", 1)
    truth = truth_at_ends(lowest_terms(symbolic.delta_E_max() / r**2), 1) * count
    return Problem(f"{count}-balls", names, box, over, one, 1, statement, denial(statement)), truth


@dataclass(frozen=True)
class Ensemble:
    """Random states for one alpha, all followed for STATE_STEPS periods."""

    alpha: Fraction = Fraction(3, 10)


def ensemble(work: Ensemble, size: Fraction) -> Strayed:
    """So many states in float64 with their bounds; the answer is the largest bound, the note counts
    what is undecided.
    """
    import numpy as np

    from scenes.juggler import orbit, random, scene

    found: Any = orbit(scene(work.alpha, random(int(size), seed=SEED)), "fast", STATE_STEPS)
    here = found.ensemble
    decided = here.end == 1
    bound = float(np.maximum(here.error_x, here.error_w)[decided].max(initial=0.0))
    return Strayed(Fraction(bound), Fraction(bound), f"{len(found.undecided)} undecided")


def slope(sizes: Sequence[float], seconds: Sequence[float]) -> float | None:
    """The slope of the line through log seconds against log sizes, by least squares; None where
    there are not two sizes.

    >>> round(slope([1, 10, 100], [2.0, 20.0, 200.0]), 6)
    1.0
    """
    if len(set(sizes)) < 2:
        return None
    xs, ys = [math.log(size) for size in sizes], [math.log(one) for one in seconds]
    middle, level = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((a - middle) * (b - level) for a, b in zip(xs, ys)) / sum(
        (a - middle) ** 2 for a in xs
    )
