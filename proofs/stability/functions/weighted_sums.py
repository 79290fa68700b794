"""Sums of absolute values of linear forms, of weights that are linear in the parameters, one for
each side of a form where that is needed: for maps that are affine in pieces.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from juggleproof.certificates.language import MapRule
from juggleproof.certificates.search.falls.by_products import proof_by_products
from juggleproof.proofs.stability.certifying import Search
from juggleproof.proofs.stability.functions.templates import (
    Function,
    Sides,
    lyapunov_functions,
)
from juggleproof.proofs.stability.functions.values import (
    Setting,
    bounded_below,
    small_balls,
)
from juggleproof.proofs.stability.given import (
    Map,
    as_factor,
    atoms,
    column,
    holds,
    value,
    written,
)
from juggleproof.proofs.stability.samples import Arrays, around, region

TRIED = 2  # of each kind
WORST = 4.0  # rank that is tried
CLOSE = 0.1  # share of the greatest value
THINNED = 4  # one state in so many, for a first program
Signs = dict[str, list[str]]  # for a premise, polynomials whose signs are its cases


def weighted_sum_rules(
    setting: Setting, on: str, name: str
) -> Iterator[tuple[MapRule, Signs, dict[str, Search]]]:
    """The statements `lyapunov` of such sums that fall at samples, each with the signs of the forms
    as the cases of its premises, and with searches for these.
    """
    system = setting.system
    gaps = tuple(f"{one}_gap" for one in system.state)
    factors = ("1", *system.parameters)
    wide = around(system, setting.point, region(setting.domain, system.parameters, 500), 20, on)
    states, tests = (with_axes(system, one.points) for one in (setting.states, wide))
    states = {one: values[::THINNED] for one, values in states.items()}
    pairs = itertools.product(range(len(system.pieces)), range(2 ** len(gaps)))
    names = ["bounded", "loss", "least", *(f"falls-{k + 1}-{j + 1}" for k, j in pairs)]
    signs = {name: list(gaps) for name in names}
    by_products = partial(
        proof_by_products,
        terms=range(2 ** len(gaps)),
        unknowns=[f"{one}_point" for one in system.state if setting.have],
        squares=(),
        signs=gaps,
    )
    tried: set[MapRule] = set()
    for scaled, even in itertools.product(scales(setting), (True, False)):
        template, ranked = Sides(gaps, factors, even), {}
        found = itertools.chain.from_iterable(
            lyapunov_functions(template, system, states, tests, scale) for scale in scaled
        )
        for numbers in found:
            function = template.function(numbers)
            for rank, rows in rows_of(setting, function, scaled):
                rule = setting.rule(name, function, [("on", on), *rows])
                if rank < WORST and rule not in tried:
                    ranked[rule] = rank
        for rule in sorted(ranked, key=lambda one: ranked[one])[:TRIED]:
            tried.add(rule)
            yield rule, signs, dict.fromkeys(names, by_products)


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


def rows_of(
    setting: Setting, function: Function, scaled: Sequence[str]
) -> Iterator[tuple[float, list[tuple[str, str]]]]:
    """The lines but `on` and `value`, each with a number that is small where they fit well."""
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
            yield (
                rank,
                [
                    ("loss", f"{drop}value"),
                    ("least", f"{drop}{as_factor(steep[0][1])}*distance"),
                    ("upper", ball[1]),
                    ("radius", ball[0]),
                ],
            )
