"""Quadratic Lyapunov functions for maps with saturation, a maximum or an absolute value of linear
terms, with the loss c V/(1 + V): far from the point such maps may move by no more than a constant.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np
import sympy

from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import CandidateProof
from juggleproof.map_stability.functions.candidates import Setting, bounded_below, small_balls
from juggleproof.map_stability.functions.templates import (
    Function,
    best_weights,
    margins,
    quadratic_templates,
    rounded,
)
from juggleproof.map_stability.premise_searches import proof_by_signs
from juggleproof.map_stability.samples import Floats
from juggleproof.map_stability.terms import (
    Expr,
    atoms,
    expression,
    holds,
    symbols,
    value,
    written,
)


def saturated_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """The candidates for quadratic forms that fall at samples, with a loss c V/(1 + V).  Their
    premises are searched for by the cases of signs.
    """
    system = setting.system
    template = next(quadratic_templates(system, setting.piece, ()))
    if len(system.pieces) == 1:
        return
    for scale in scales(setting):
        rows, _ = margins(template, system, setting.states.points, scale)
        every = np.concatenate([rows, margins(template, system, setting.tests, scale)[0]])
        weights = weights_with_missed(rows, every)
        found = iter(()) if weights is None else rounded(weights, every)
        for numbers in itertools.islice(found, limits.TRIED):
            yield from candidates_for(setting, template.terms(numbers)[0])


def scales(setting: Setting) -> Iterator[str]:
    """Yield 1, then the terms that go to 0 at an end of the domain, where V may cease to fall."""
    yield "1"
    for bound, strict in atoms(setting.domain):
        at = np.asarray(value(written(bound), setting.parameters), float)
        if strict and 0 < at.min() < limits.SMALL_BOUND * at.max():
            yield written(bound)


def weights_with_missed(rows: Floats, every: Floats) -> Floats | None:
    """Return weights for these rows; in each turn the rows that they miss are added."""
    for _ in range(limits.TURNS if len(rows) else 0):
        weights = best_weights(rows)
        missed = np.zeros(0) if weights is None else every @ weights <= 0
        if not missed.any():
            return weights
        rows = np.concatenate([rows, every[missed]])
    return None


def candidates_for(setting: Setting, term: str) -> Iterator[CandidateProof]:
    """The candidates for one function.

    Where V falls by c V in the pieces that reach the point and by c in the others, it falls by
    c V/(1 + V) in all.
    """
    system, samples, function = setting.system, setting.states, Function((term,))
    count = len(samples.which)
    here, there = function.along(system, samples.points, count)
    size = np.sum([samples.points[f"{one}_gap"] ** 2 for one in system.state], axis=0)
    fits = np.isfinite(here) & np.isfinite(there) & (size > 1e-10)
    shares, reach = np.full(count, np.inf), []
    for guard, _ in system.pieces:
        inside = np.broadcast_to(holds(guard, samples.points), (count,)) & fits
        reach.append(bool((here[inside] < limits.SMALL_VALUE).any()))
        shares[inside] = (here - there)[inside] / (here[inside] if reach[-1] else 1)
    floor = samples.least(np.where(fits, here / np.where(fits, size, 1), np.inf), setting.count)
    lowest = bounded_below(floor, setting.products, 1)
    ball = next(small_balls(setting, function), None)
    if not lowest or ball is None:
        return
    least = samples.least(shares, setting.count) / 2
    for _, drop in bounded_below(least, setting.products, limits.TRIED):
        constant = written(expression(drop) * expression(lowest[0][1]) / 2)
        signs = {
            "least": least_signs(setting, term, expression(lowest[0][1])),
            **falls_signs(setting, term, reach, expression(drop)),
        }
        searches = {name: partial(proof_by_signs, signs=one) for name, one in signs.items()}
        loss, far = f"({drop})*value/(1 + value)", f"({constant})*distance^2/(1 + level)"
        yield setting.candidate(function, loss, far, ball, searches=searches)


# -------------------------------------------------------------------------------------------------
# The polynomials whose signs prove it.


def numerator(setting: Setting, term: Expr) -> str:
    """The term times its denominator, and without factors that are positive."""
    above = sympy.numer(sympy.together(sympy.expand(term)))
    constant, factors = sympy.factor_list(above)
    rest = [sympy.Integer(1 if constant > 0 else -1)]
    for factor, power in factors:
        names = {str(symbol) for symbol in factor.free_symbols}
        if names <= setting.constants.keys():
            at = np.asarray(value(written(factor), setting.constants), float)
            if (at > 0).all() or (at < 0).all():
                rest += [] if (at > 0).all() or power % 2 == 0 else [sympy.Integer(-1)]
                continue
        rest.append(factor**power)
    return written(sympy.expand(sympy.prod(rest)))


def least_signs(setting: Setting, term: str, steepness: Expr) -> list[str]:
    """Return V less a bound that is < 0 at the point, and V less a bound in the distance."""
    distance, level = symbols(["distance", "value"])
    squares = sum(gap**2 for gap in symbols([f"{one}_gap" for one in setting.system.state]))
    bounds = [
        expression(term) - steepness * (squares - distance**2 / 4),
        level - steepness * distance**2 / 2,
    ]
    return [numerator(setting, bound) for bound in bounds]


def falls_signs(
    setting: Setting, term: str, reach: Sequence[bool], drop: Expr
) -> dict[str, list[str]]:
    """Return for the premise of each piece V(s) - V(f(s)) less c V(s), or less c if the piece does
    not reach the point; `drop` is c.
    """
    system = setting.system
    names = [f"{one}_point" for one in system.state]
    point = symbols(names) if setting.have else list(map(expression, setting.point.terms))
    gaps = symbols([f"{one}_gap" for one in system.state])
    put = {s: e + gap for s, e, gap in zip(symbols(system.state), point, gaps)}
    found, here = {}, expression(term)
    for k, images in enumerate(system.images):
        nexts = [(image - e).subs(put, simultaneous=True) for image, e in zip(images, point)]
        there = here.subs(dict(zip(gaps, nexts)), simultaneous=True)
        more = here - there - drop * (here if reach[k] else 1)
        found[f"falls-{k + 1}-1"] = [numerator(setting, more)]
    return found
