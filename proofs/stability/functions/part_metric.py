"""Greatest of weighted distances, one for each side of each variable: V = max w_j (x_j - e_j),
v_j e_j (e_j - x_j)/x_j, whose sublevel sets are boxes.  Where all e_j are equal and the weights are
1 this is e times the part metric, max (x_j/e_j, e_j/x_j) - 1, which sublinear and mixed monotone
maps make less.

Sources: Krause and Nussbaum, A limit set trichotomy for self-mappings of normal cones in Banach
spaces, Nonlinear Analysis 20 (1993); Kruse and Nesemann, Global asymptotic stability in some
discrete dynamical systems, J. Mathematical Analysis and Applications 235 (1999).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

import numpy as np

from juggleproof.proofs.stability.certifying import Candidate
from juggleproof.proofs.stability.functions.candidates import Setting, losses, small_balls
from juggleproof.proofs.stability.functions.templates import Function, signed
from juggleproof.proofs.stability.maps import Map, bounds
from juggleproof.proofs.stability.samples import Floats, Samples, after
from juggleproof.proofs.stability.terms import as_factor, renamed, value

WEIGHTS = tuple(Fraction(n, d) for n, d in ((1, 1), (9, 10), (3, 4), (2, 3), (1, 2), (1, 4)))
SWEEPS = 3  # over all weights
POWERS = (0, 1)  # of 1 + V, that the loss is divided by
HALF = 0.375  # of the loss at samples: facts bound the point less closely than they do
WORST = 8.0  # rank that is tried
CLOSE = 1e-9  # relative rounding of a value


def distances(setting: Setting) -> Iterator[tuple[str, ...]]:
    """The distances of the state variables above the point, then those below: plain; unbounded
    where the state goes to 0 (a lower bound); unbounded at upper bounds too.
    """
    system = setting.system
    low, high = bounds(system)
    every = []
    for over, under in (({}, {}), ({}, low), (high, low)):
        above = [_over(system, name, f"{name}_gap", over) for name in system.state]
        below = [_over(system, name, f"-{name}_gap", under) for name in system.state]
        every.append((*above, *below))
    yield from dict.fromkeys(every)


def _over(system: Map, name: str, gap: str, bound: Mapping[str, str]) -> str:
    """The distance times that of the point to a bound, by that of the state."""
    if name not in bound:
        return gap
    text = as_factor(bound[name])
    return f"{renamed(text, {one: f'{one}_point' for one in system.state})}*({gap})/{text}"


def part_metric_candidates(setting: Setting) -> Iterator[Candidate]:
    """The candidates that samples do not refute."""
    if len(setting.system.state) == 1:
        return  # for which `two_sided` has more
    low, _ = bounds(setting.system)
    for kind, texts in enumerate(distances(setting)):
        weights = _weights(setting, texts)
        if not weights:
            continue
        terms = (t if w == 1 else f"{signed(w)}*{t}" for w, t in zip(weights, texts))
        function = Function(tuple(terms), divisor="*".join(low.values()) if kind else "1")
        ball = next(small_balls(setting, function), None)
        if ball is None:
            continue
        here, there, samples = values(setting, function.terms)
        before, now = here.max(axis=0), there.max(axis=0)
        far = "distance" if min(weights) == 1 else f"{signed(min(weights))}*distance"
        shares = (before - now) / before, 1 + before
        every = losses(setting, samples, shares, "value", far, POWERS, share=HALF)
        best = sorted(every, key=lambda one: one[0])[:2]
        for rank, _, loss, least in best if best and best[0][0] < WORST else ():
            rank += kind + len(set(weights)) / 4
            yield setting.candidate(function, loss, least, ball, rank=rank)


def values(setting: Setting, texts: Sequence[str]) -> tuple[Floats, Floats, Samples]:
    """The terms at samples and at the next states, (terms, count) each."""
    samples = setting.states
    size = len(samples.which)
    with np.errstate(all="ignore"):
        here, there = (
            np.stack([np.broadcast_to(value(text, points), (size,)) for text in texts])
            for points in (samples.points, after(setting.system, samples.points))
        )
    fits = np.isfinite(here).all(axis=0) & np.isfinite(there).all(axis=0)
    fits &= here.max(axis=0) > 1e-6
    return here[:, fits], there[:, fits], samples.where(fits)


def _weights(setting: Setting, texts: Sequence[str]) -> tuple[Fraction, ...]:
    """Weights under which all samples fall, those of the least greatest share that is left, as
    changes of one after the other find them; empty where there are none.
    """
    here, there, samples = values(setting, texts)
    if not here.size:
        return ()

    def fit(weights: Sequence[Fraction]) -> tuple[float, float]:
        """The share of the samples that fall, and how far they do."""
        scale = np.array([float(w) for w in weights])[:, None]
        left = (scale * there).max(axis=0) / (scale * here).max(axis=0)
        worst = samples.least(np.maximum(1 - left, CLOSE), setting.count)
        return float(np.mean(left < 1 - CLOSE)), float(np.log(worst[np.isfinite(worst)]).mean())

    n, weights = len(setting.system.state), [Fraction(1)] * len(texts)
    best = fit(weights)
    both = [(j, j + n) for j in range(n)]
    for group in (both + [(j,) for j in range(2 * n)]) * SWEEPS:
        for weight in WEIGHTS:
            changed = [weight if j in group else w for j, w in enumerate(weights)]
            now = fit(changed)
            if now > (best[0], best[1] + 0.05):
                weights, best = changed, now
    return tuple(weights) if best[0] == 1 else ()
