"""Maps of one variable that decrease, and whose second iterate is closer to the point e.  V is the
distance on one side of e; on the other it is the distance of the next state, with a weight c > 1:

    V = max(s - e, c (f(s) - e))    or    V = max(e - s, c (e - f(s))).

V falls to V/c from the other side, and to c |f(f(s)) - e| from the one side.  Such a map has no
cycle but e if and only if f(f(s)) is closer to e than s is, for all s.

Source: W. A. Coppel, The solution of equations by iteration, Mathematical Proceedings of the
Cambridge Philosophical Society 51 (1955).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import sympy
from numpy.typing import NDArray

from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import CandidateProof
from juggleproof.map_stability.functions.candidates import (
    Setting,
    bounded_below,
    losses,
    small_balls,
)
from juggleproof.map_stability.functions.equations import at_parameters
from juggleproof.map_stability.functions.templates import Function
from juggleproof.map_stability.functions.two_sided import (
    falling_searches,
    is_clear,
    products_of_shares,
    solved,
    states_of,
    with_licences,
)
from juggleproof.map_stability.samples import licence
from juggleproof.map_stability.terms import Expr, as_factor, symbols, written
from juggleproof.statements.cases import conjunction


def licensed_space(setting: Setting) -> str:
    """The space, with the facts that license the divisors of the map's images."""
    system, space = setting.system, setting.system.space
    for factor, _ in sympy.factor_list(sympy.denom(sympy.together(_image(setting))))[1]:
        if factor.free_symbols & set(symbols(system.state)):
            space = conjunction(space, licence(factor, conjunction(setting.domain, space)))
    return space


def second_iterate_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """The candidates that samples do not refute, on the space where the map's images divide by
    nothing that is 0, those first whose loss fits best, with searches for the premises that V
    falls.
    """
    if len(setting.system.state) > 1 or setting.system.is_affine:
        return
    space = licensed_space(setting)
    setting = setting if space == setting.system.space else setting.inside(space)
    setting, put = solved(setting)
    slope = slope_of(setting, put)
    if not (at_parameters(setting, slope) > 0).all():
        return
    samples = states_of(setting)
    setting = replace(setting, states=samples.where(is_exact(setting)[samples.which]))
    found = []
    for sign in (1, -1):
        for k, mean in enumerate(limits.MEANS):
            function = function_of(setting, slope, sign, mean)
            searches = falling_searches(setting, put, function)
            for one in candidates_for(setting, slope, function):
                found.append(replace(one, rank=one.rank + k / 4, searches=searches))
    yield from sorted(found, key=lambda one: one.rank)[: limits.TRIED_OF_FAMILY]


def _image(setting: Setting) -> Expr:
    (image,) = setting.system.images[setting.piece]
    return image


def is_exact(setting: Setting) -> NDArray[np.bool_]:
    """Return at which parameters the point is a fixed point up to rounding, since weights of V may
    be small close to it; all parameters if these are few.
    """
    ((state,), known) = setting.system.state, setting.constants
    point = known[f"{state}_point"]
    with np.errstate(all="ignore"):
        (image,) = setting.system.next(known | {state: point})
    exact = np.asarray(np.abs(image - point) <= limits.ROUNDING * np.abs(point))
    return exact if exact.mean() > limits.FEW else np.ones(setting.count, bool)


def slope_of(setting: Setting, put: dict[Expr, Expr]) -> Expr:
    """Return -f'(e), the slope with which the map decreases at the point."""
    (state,), (point,) = symbols(setting.system.state), setting.point_names
    return sympy.factor(-sympy.diff(_image(setting), state).subs(state, point).xreplace(put))


def function_of(setting: Setting, slope: Expr, sign: int, mean: tuple[int, int]) -> Function:
    """V, scaled so that its weights are polynomials; sign: 1 for the distance above the point."""
    over, under = sympy.fraction(slope)
    if at_parameters(setting, under).max() < 0:
        over, under = -over, -under
    plain, many = mean
    near, far = sympy.expand(plain * under + many * over), (plain + many) * under
    near, far = (sympy.factor(one / sympy.gcd(near, far)) for one in (near, far))
    (state,) = setting.system.state
    sides = (f"{state}_gap", f"({written(_image(setting))} - {state}_point)")
    minus = "" if sign > 0 else "-"
    terms = (f"{minus}{as_factor(written(c))}*{one}" for c, one in zip((near, far), sides))
    return Function(tuple(terms))


def candidates_for(setting: Setting, slope: Expr, function: Function) -> Iterator[CandidateProof]:
    """The candidates for one function."""
    samples, (state,) = setting.states, setting.system.state
    here, there = function.along(setting.system, samples.points, len(samples.which))
    ball = next(small_balls(setting, function), None)
    clear = is_clear(setting, here, there)
    samples, here, there = samples.where(clear), here[clear], there[clear]
    if ball is None or not len(here) or not (there < here).all():
        return
    steep = here / np.abs(samples.points[f"{state}_gap"])
    known = [*setting.products, *products_of_shares(setting, [1 - slope, 1 + slope])]
    shares = (here - there) / here, 1 + here
    for _, far in bounded_below(samples.least(steep, setting.count), known, 1):
        least = f"{as_factor(far)}*distance"
        for rank, constant, loss, at_least in losses(
            setting, samples, shares, "value", least, products=known
        ):
            licensed = with_licences(with_licences(setting, constant), far)
            yield licensed.candidate(function, loss, at_least, ball, rank=rank)
