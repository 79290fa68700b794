"""A fixed point with a part of the domain: what licenses divisions there, and samples of both."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import sympy

from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import beyond, is_certified
from juggleproof.map_stability.functions.candidates import Setting
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.points import FixedPoint
from juggleproof.map_stability.samples import around, licence, region, with_point_licences
from juggleproof.map_stability.terms import atoms, expression, renamed, symbols, value, written
from juggleproof.statements.cases import conjunction


def known_of(setting: Setting) -> tuple[str, ...]:
    """Return what premises have to know of a point with roots or parameters in divisors: it is a
    fixed point, and it lies on one side of the guard and of the bounds of the space.
    """
    system, point, piece = setting.system, setting.point, setting.piece
    terms = [expression(term) for term in point.terms]
    divisors = [sympy.denom(sympy.together(term)) for term in terms]
    if all(divisor.is_number for divisor in divisors) and not point.roots:
        return ()
    names = {name: f"{name}_point" for name in system.state}
    lines = []
    for name, image in zip(system.state, system.images[piece]):
        above, below = sympy.fraction(sympy.together(image))
        left = f"{name}_point" if below == 1 else f"{name}_point*({written(below)})"
        lines.append(f"{left} = {written(above)}")
    if not system.derivatives[piece].free_symbols.isdisjoint(symbols(system.state)):
        for name, term in zip(system.state, terms):  # the equations have other solutions
            above, below = sympy.fraction(term)
            lines.append(f"{name}_point*({written(below)}) = {written(above)}")
    guard, _ = system.pieces[piece]
    points = setting.states.points
    for poly, _ in atoms(conjunction(system.space, guard)):
        if poly.free_symbols & set(symbols(system.state)):
            at_point = points | {name: points[name + "_point"] for name in system.state}
            with np.errstate(all="ignore"):
                at = np.asarray(value(written(poly), at_point), float)
                worst = float(np.min(at, initial=np.inf))
            strict = worst > 0 and is_certified([*setting.head, f"show {written(poly)} > 0"])
            lines.append(f"{written(poly)} {'>' if strict else '>='} 0")
    return tuple(dict.fromkeys(renamed(line, names) for line in lines))


def setting_of(system: Map, fixed: FixedPoint, domain: str, by_samples: bool = False) -> Setting:
    """The setting of a search over the parameters in a domain.  The domain is made to say that a
    parameter is positive at all samples, if that follows from it or `by_samples` is true.
    """
    point = fixed.point
    domain = with_point_licences(domain, point)
    parameters = region(domain, system.parameters, limits.PARAMETERS)
    for name in system.parameters:  # so that constants may divide by it
        positive = conjunction(domain, licence(expression(name), domain))
        if (parameters[name] > 0).all():
            if by_samples or not beyond(domain, positive, system.parameters):
                domain = positive
    states = around(system, point, parameters, limits.STATES)
    bare = Setting(system, point, fixed.piece, (), domain, parameters, states)
    return replace(bare, have=known_of(bare))
