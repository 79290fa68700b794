"""V as the greatest of weighted terms, for two families of terms.

Distances, one for each side of each variable: V = max w_j (x_j - e_j), v_j e_j (e_j - x_j)/x_j,
whose sublevel sets are boxes.  If all e_j are equal and the weights are 1, this is e times the part
metric, max (x_j/e_j, e_j/x_j) - 1, which falls along sublinear and mixed monotone maps.

Sums of absolute values of linear forms, for maps that are affine in pieces.  The weights are linear
in the parameters, and may differ on the two sides of a form.

Sources: Krause and Nussbaum, A limit set trichotomy for self-mappings of normal cones in Banach
spaces, Nonlinear Analysis 20 (1993); Kruse and Nesemann, Global asymptotic stability in some
discrete dynamical systems, J. Mathematical Analysis and Applications 235 (1999).
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial

import numpy as np

from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import CandidateProof, either
from juggleproof.map_stability.functions.candidates import (
    Setting,
    bounded_below,
    losses,
    small_balls,
)
from juggleproof.map_stability.functions.templates import (
    Function,
    SizesOfForms,
    lyapunov_functions,
    signed,
)
from juggleproof.map_stability.maps import Map, bounds
from juggleproof.map_stability.premise_searches import proof_by_signs
from juggleproof.map_stability.samples import Arrays, Floats, Samples, after
from juggleproof.map_stability.terms import (
    as_factor,
    atoms,
    column,
    holds,
    renamed,
    value,
    written,
)
from juggleproof.search.decrease_proofs.by_products import proof_by_products
from juggleproof.statements.language import MapRule


def distances(setting: Setting) -> Iterator[tuple[str, ...]]:
    """Yield the distances of the state variables above the point, then those below it: as they are,
    then those below it over the distances to lower bounds of the space, then also those above it
    over the distances to upper bounds.
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
    """The gap times (the point's distance to the bound)/(the state's distance to the bound)."""
    if name not in bound:
        return gap
    text = as_factor(bound[name])
    return f"{renamed(text, {one: f'{one}_point' for one in system.state})}*({gap})/{text}"


def part_metric_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """Yield the candidates for distances that samples do not refute."""
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
        every = losses(
            setting, samples, shares, "value", far, limits.VALUE_POWERS, share=limits.PART_LEFT
        )
        best = sorted(every, key=lambda one: one[0])[: limits.TRIED]
        for rank, _, loss, least in best if best and best[0][0] < limits.MOST_WORST_PART else ():
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
    """Weights under which V falls at all samples; empty if none are found.  One weight after the
    other is changed as long as the greatest share of V that is left becomes smaller.
    """
    here, there, samples = values(setting, texts)
    if not here.size:
        return ()

    def fit(weights: Sequence[Fraction]) -> tuple[float, float]:
        """The share of the samples at which V falls, and the mean logarithm of its least falls."""
        scale = np.array([float(w) for w in weights])[:, None]
        left = (scale * there).max(axis=0) / (scale * here).max(axis=0)
        worst = samples.least(np.maximum(1 - left, limits.ROUNDING), setting.count)
        return float(np.mean(left < 1 - limits.ROUNDING)), float(
            np.log(worst[np.isfinite(worst)]).mean()
        )

    n, weights = len(setting.system.state), [Fraction(1)] * len(texts)
    best = fit(weights)
    both = [(j, j + n) for j in range(n)]
    for group in (both + [(j,) for j in range(2 * n)]) * limits.SWEEPS:
        for weight in map(Fraction, limits.WEIGHTS):
            changed = [weight if j in group else w for j, w in enumerate(weights)]
            now = fit(changed)
            if now > (best[0], best[1] + 0.05):
                weights, best = changed, now
    return tuple(weights) if best[0] == 1 else ()


# -------------------------------------------------------------------------------------------------
# Sums of absolute values.


def weighted_sum_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """Yield the candidates for sums that fall at samples.  Their premises are searched for by
    products, then by the cases of the signs of the forms.
    """
    system = setting.system
    gaps = tuple(f"{one}_gap" for one in system.state)
    factors = ("1", *system.parameters)
    states, tests = (with_axes(system, one) for one in (setting.states.points, setting.tests))
    states = {one: values[:: limits.THINNED] for one, values in states.items()}
    pairs = itertools.product(range(len(system.pieces)), range(2 ** len(gaps)))
    names = ["bounded", "loss", "least", *(f"falls-{k + 1}-{j + 1}" for k, j in pairs)]
    by_products = partial(
        proof_by_products,
        terms=range(2 ** len(gaps)),
        unknowns=[f"{one}_point" for one in system.state if setting.have],
        squares=(),
        signs=gaps,
    )
    searches = dict.fromkeys(names, either(by_products, partial(proof_by_signs, signs=gaps)))
    seen: set[MapRule] = set()
    for scaled, even in itertools.product(scales(setting), (True, False)):
        template = SizesOfForms(gaps, factors, even)
        ranked: dict[MapRule, CandidateProof] = {}
        found = itertools.chain.from_iterable(
            lyapunov_functions(template, system, states, tests, scale) for scale in scaled
        )
        for numbers in found:
            for one in scaled_candidates(setting, template.function(numbers), scaled):
                if one.rank < limits.MOST_WORST_SUM and one.rule not in seen:
                    ranked[one.rule] = replace(one, searches=searches)
        for one in sorted(ranked.values(), key=lambda one: one.rank)[: limits.TRIED]:
            seen.add(one.rule)
            yield one


def scales(setting: Setting) -> list[list[str]]:
    """Return terms that the loss may go to 0 with.  First come the terms that go to 0 at an end of
    the domain that the map's domain does not have, or 1; then those that do so at an end of the
    map's domain.
    """
    given = atoms(setting.system.domain)
    added: list[str] = []
    own: list[str] = []
    for bound in atoms(setting.domain):
        at = np.asarray(value(written(bound[0]), setting.constants), float)
        if 0 < at.min() < limits.SMALL_SCALE * at.max():
            (own if bound in given else added).append(written(bound[0]))
    return [every for every in (added or ["1"], own) if every]


def with_axes(system: Map, points: Arrays) -> Arrays:
    """Return the states, and states that differ from the point in one coordinate: these are at the
    edges of sublevel sets.
    """
    every = [points]
    for one in system.state:
        moved = dict(points)
        for name in system.state:
            if name != one:
                moved[name], moved[f"{name}_gap"] = points[f"{name}_point"], 0 * points[name]
        inside = np.broadcast_to(holds(system.space, moved), points[one].shape)
        every.append({name: values[inside] for name, values in moved.items()})
    return {name: np.concatenate([one[name] for one in every]) for name in points}


def scaled_candidates(
    setting: Setting, function: Function, scaled: Sequence[str]
) -> Iterator[CandidateProof]:
    """Yield the candidates for a function, whose loss goes to 0 with one of the terms."""
    samples = setting.states
    here, there = function.along(setting.system, samples.points, len(samples.which))
    far = np.max([np.abs(samples.points[f"{one}_gap"]) for one in setting.system.state], axis=0)
    fits = np.isfinite(here) & np.isfinite(there) & (far > 1e-6)
    samples, here, there, far = samples.where(fits), here[fits], there[fits], far[fits]
    ball = next(small_balls(setting, function), None)
    steep = bounded_below(samples.least(here / far, setting.count), setting.products, 1)
    if ball is None or not steep:
        return
    for scale in scaled:
        size = column(scale, setting.constants, setting.count)[samples.which]
        start = "" if scale == "1" else f"{as_factor(scale)}*"
        least = f"{start}{as_factor(steep[0][1])}*distance"
        shares = (here - there) / here / size, 1 + here
        for rank, _, loss, far_off in losses(
            setting, samples, shares, f"{start}value", least, most=1
        ):
            yield setting.candidate(function, loss, far_off, ball, rank=rank)
