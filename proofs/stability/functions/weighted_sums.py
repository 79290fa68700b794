"""Sums of absolute values of linear forms, of weights that are linear in the parameters, one for
each side of a form where that is needed: for maps that are affine in pieces.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from juggleproof.certificates.language import MapRule
from juggleproof.certificates.search.falls.by_products import proof_by_products
from juggleproof.proofs.stability.certifying import Candidate, either
from juggleproof.proofs.stability.functions.candidates import Setting, bounded_below, small_balls
from juggleproof.proofs.stability.functions.templates import Function, Sides, lyapunov_functions
from juggleproof.proofs.stability.maps import Map
from juggleproof.proofs.stability.premise_searches import proof_by_signs
from juggleproof.proofs.stability.samples import Arrays, around, region
from juggleproof.proofs.stability.terms import as_factor, atoms, column, holds, value, written

TRIED = 2  # of each kind
WORST = 4.0  # rank that is tried
CLOSE = 0.1  # share of the greatest value
THINNED = 4  # one state in so many, for a first program


def weighted_sum_candidates(setting: Setting) -> Iterator[Candidate]:
    """The candidates for such sums that fall at samples.  Their premises are searched for by
    products, then by the cases of the signs of the forms.
    """
    system = setting.system
    gaps = tuple(f"{one}_gap" for one in system.state)
    factors = ("1", *system.parameters)
    wide = around(system, setting.point, region(setting.domain, system.parameters, 500), 20)
    states, tests = (with_axes(system, one.points) for one in (setting.states, wide))
    states = {one: values[::THINNED] for one, values in states.items()}
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
        template = Sides(gaps, factors, even)
        ranked: dict[MapRule, Candidate] = {}
        found = itertools.chain.from_iterable(
            lyapunov_functions(template, system, states, tests, scale) for scale in scaled
        )
        for numbers in found:
            for one in candidates_for(setting, template.function(numbers), scaled):
                if one.rank < WORST and one.rule not in seen:
                    ranked[one.rule] = replace(one, searches=searches)
        for one in sorted(ranked.values(), key=lambda one: one.rank)[:TRIED]:
            seen.add(one.rule)
            yield one


def scales(setting: Setting) -> list[list[str]]:
    """What the loss is to go to 0 with, the likeliest first: what goes to 0 at the ends that the
    domain adds to that of the map, or nothing; then also what does at those of the map's.
    """
    given = atoms(setting.system.domain)
    added: list[str] = []
    own: list[str] = []
    for bound in atoms(setting.domain):
        at = np.asarray(value(written(bound[0]), setting.constants), float)
        if 0 < at.min() < CLOSE * at.max():
            (own if bound in given else added).append(written(bound[0]))
    return [every for every in (added or ["1"], own) if every]


def with_axes(system: Map, points: Arrays) -> Arrays:
    """The states, and those of the space that differ from the point in one coordinate: the edges of
    sublevel sets.
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


def candidates_for(
    setting: Setting, function: Function, scaled: Sequence[str]
) -> Iterator[Candidate]:
    """The candidates for a function, whose loss goes to 0 with one of the terms."""
    samples = setting.states
    count = len(samples.which)
    here, there = function.along(setting.system, samples.points, count)
    far = np.max([np.abs(samples.points[f"{one}_gap"]) for one in setting.system.state], axis=0)
    fits = np.isfinite(here) & np.isfinite(there) & (far > 1e-6)
    samples, here, there, far = samples.where(fits), here[fits], there[fits], far[fits]
    ball = next(small_balls(setting, function), None)
    steep = bounded_below(samples.least(here / far, setting.count), setting.products, 1)
    if ball is None or not steep:
        return
    for scale in scaled:
        size = column(scale, setting.constants, setting.count)
        shares = samples.least((here - there) / here, setting.count) / size
        for rank, constant in bounded_below(shares, setting.products, 1):
            drop = "" if constant == "1" else f"{as_factor(constant)}*"
            drop += "" if scale == "1" else f"{as_factor(scale)}*"
            least = f"{drop}{as_factor(steep[0][1])}*distance"
            yield setting.candidate(function, f"{drop}value", least, ball, rank=rank)
