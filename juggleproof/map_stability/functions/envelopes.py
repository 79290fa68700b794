"""Maps of one variable with one piece: Lyapunov functions whose values are the same at a state and
at its image under a fractional linear involution, which envelopes the map.

Source: P. Cull, Stability of discrete one-dimensional population models, Bulletin of Mathematical
Biology 50 (1988).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import product

import numpy as np
import sympy

from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import CandidateProof
from juggleproof.map_stability.functions.candidates import Setting, bounded_below, inverse
from juggleproof.map_stability.functions.templates import Function
from juggleproof.map_stability.premise_searches import proof_by_signs
from juggleproof.map_stability.samples import (
    Arrays,
    Floats,
    Samples,
    around,
    region,
    with_licences,
    with_point_licences,
)
from juggleproof.map_stability.terms import (
    Expr,
    as_factor,
    atoms,
    column,
    conjuncts,
    expression,
    holds,
    symbols,
    value,
    written,
)
from juggleproof.statements.cases import ANYWHERE, conjunction
from juggleproof.statements.language import MapRule


@dataclass(frozen=True)
class Envelope:
    """The involution for a lower bound l of the space, the point e, d = e - l and a number b >= 0:

        s -> e - d (s - e)/(d + (1 - b) (s - e)).

    It takes l to the state where upper = 0.  Here lower = s - l, and upper is a positive multiple
    of d - b (s - e), or 1 if b = 0.
    """

    lower: str
    upper: str
    reach: str  # d

    def function(self, state: str) -> Function:
        """V = (s - e)^2/((s - l) (d - b (s - e))), which the involution leaves as it is."""
        other = self.reach if self.upper == "1" else self.upper
        return Function((f"{state}_gap^2/({as_factor(self.lower)}*{as_factor(other)})",))


def envelopes(setting: Setting) -> Iterator[Envelope]:
    """The involutions to try, for each lower bound of the space that is linear in the state."""
    system = setting.system
    (state,) = symbols(system.state)
    point = expression(setting.point.terms[0])
    for poly, strict in atoms(system.space):
        if not strict or not poly.is_polynomial() or sympy.diff(poly, state) != 1:
            continue
        reach = poly.subs(state, point)
        named = poly.subs(state, *symbols([f"{state}_point"])) if setting.point.roots else reach
        for slope in slopes(setting, reach):
            upper = sympy.numer(sympy.together(reach - slope * (state - point)))
            if not upper.has(state):
                yield Envelope(written(poly), "1", written(named))
            elif not setting.point.roots:  # which a map cannot name
                at_point = value(written(upper.subs(state, point)), setting.parameters)
                if np.all(np.less(at_point, 0)):
                    upper = -upper
                yield Envelope(written(poly), written(sympy.expand(upper)), written(named))


def slopes(setting: Setting, reach: Expr) -> list[Expr]:
    """The values of b to try: 0; then b = 1 - d f''/2 as a term, and its value at the least of the
    multipliers; then the numbers SLOPES.  If f' = -1 at the point, the involution with the second
    b has the same second derivative there as the map f.
    """
    (state,) = symbols(setting.system.state)
    point = expression(setting.point.terms[0])
    (image,) = setting.system.images[setting.piece]
    known = setting.constants
    matched, slope = (
        sympy.factor(sympy.cancel(term.subs(state, point)))
        for term in (1 - reach * sympy.diff(image, state, 2) / 2, sympy.diff(image, state))
    )
    with np.errstate(all="ignore"):
        at, multiplier = (column(written(term), known, setting.count) for term in (matched, slope))
    found = [sympy.Integer(0)]
    if (at > 0).all():
        found.append(matched)
    flip = at[np.argmin(multiplier)]
    if 0 < flip < 100:
        found.append(sympy.Rational(flip).limit_denominator(12))
    return list(dict.fromkeys([*found, *map(sympy.Integer, limits.SLOPES)]))


def envelope_candidates(setting: Setting, closed: bool = False) -> Iterator[CandidateProof]:
    """The candidates by which the point attracts every state of the map's space, without those that
    samples refute.  `closed`: the multiplier may be -1 at some of the parameters.
    """
    system = setting.system
    if len(system.state) > 1 or len(system.pieces) > 1:
        return
    setting = replace(setting, domain=spare_domain(setting))
    setting = replace(setting, have=equation_of(setting) if setting.point.roots else ())
    for envelope in sorted(set(envelopes(setting)), key=lambda one: (len(one.upper), one.upper)):
        if envelope.upper == "1":
            yield from candidates_for(setting, envelope, closed)
            continue
        inside = spare_space(setting, envelope)
        smaller = replace(system, space=inside, domain=setting.domain)
        within = replace(setting, system=smaller, map="inner")
        found = list(candidates_for(within, envelope, closed))
        entering = entrance(setting, envelope) if found else []
        for one in found if entering else ():
            rules = (
                smaller.rule(f"{system.name}/inner"),
                one.rule,
                setting.descent("inner-descends", "inner", "0", ANYWHERE),
                setting.attraction("inner-attracts", "inner-descends"),
                *entering,
            )
            yield replace(one, rules=rules)


def equation_of(setting: Setting) -> tuple[str, ...]:
    """Return what premises have to know of a point with a root: its irreducible equation, which
    follows from f(e) = e, and the bounds of the space.
    """
    system = setting.system
    (state,) = symbols(system.state)
    name = f"{state}_point"
    known, lines = setting.constants, []
    gap = sympy.together(system.images[setting.piece][0] - state)
    for equation, _ in sympy.factor_list(sympy.numer(gap))[1]:
        if equation.has(state):
            term = equation.subs(state, sympy.Symbol(name, real=True))
            if np.median(np.abs(value(written(term), known))) < limits.NEARLY_FIXED:
                lines.append(f"{written(term)} = 0")
    for bound, strict in atoms(system.space):
        if bound.has(state):
            term = written(bound.subs(state, sympy.Symbol(name, real=True)))
            lines.append(f"{term} {'>' if strict else '>='} 0")
    return tuple(lines)


def below(setting: Setting, least: Floats, most: int) -> list[tuple[float, str]]:
    """Return terms in the parameters below `least`; terms of higher powers if there are no
    others.
    """
    found = bounded_below(least, setting.products, most)
    return found or bounded_below(least, setting.higher_products, most)


def spare_domain(setting: Setting) -> str:
    """The domain without conditions that follow from the others at samples: each fact more makes
    proofs harder to find.
    """
    system, kept = setting.system, conjuncts(setting.domain)
    divisors = {f"{name} > 0" for name in system.parameters}
    for part in [one for one in kept if one not in divisors]:
        rest = conjunction(*(one for one in kept if one != part))
        if rest != ANYWHERE and implied(part, region(rest, system.parameters, limits.STATES_MANY)):
            kept.remove(part)
    system = with_licences(replace(system, domain=conjunction(*kept)))
    return with_point_licences(system.domain, setting.point)


def spare_space(setting: Setting, envelope: Envelope) -> str:
    """The space where upper > 0, without bounds that follow from it at samples."""
    system = setting.system
    kept = [*conjuncts(system.space), f"{envelope.upper} > 0"]
    for part in kept[:-1]:
        rest = conjunction(*(one for one in kept if one != part))
        states = around(system, setting.point, setting.parameters, limits.STATES_MANY, rest)
        if implied(part, states.points):
            kept.remove(part)
    return conjunction(*kept)


def implied(part: str, points: Arrays) -> bool:
    """Return whether a formula holds at all samples, and there are some."""
    return len(next(iter(points.values()), ())) > 0 and bool(np.all(holds(part, points)))


def candidates_for(setting: Setting, envelope: Envelope, closed: bool) -> Iterator[CandidateProof]:
    """The candidates whose loss is a constant times V, or times (s - e)^2 V where `closed`."""
    (state,) = setting.system.state
    function = envelope.function(state)
    samples = states_of(setting, envelope)
    here, there = function.along(setting.system, samples.points, len(samples.which))
    clear = np.abs(here - there) > limits.FALL_ROUNDING * here  # else floats do not tell
    here, there, samples = here[clear], there[clear], samples.where(clear)
    square = samples.points[f"{state}_gap"] ** 2
    if not len(here) or not (there < here).all() or closed and envelope.upper == "1":
        return
    bounded = envelope.upper != "1"
    shares = (here - there) / here / (square if closed else 1)
    sizes = here / square
    count = setting.count
    order, size = (4, f"{state}_gap^2*value") if closed else (2, "value")
    near = room(setting, envelope) / 2
    searches = {"bounded": partial(proof_by_signs, signs=[f"{state}_gap"])}
    wide = f"1/(2*{as_factor(envelope.reach)}^2)"  # V (2 + V) >= (s - e)^2/d^2
    for (_, radius), (_, least), (_, loss) in product(
        below(setting, near, 1),
        below(setting, samples.least(sizes, count), 1) if bounded else [(0.0, wide)],
        below(setting, samples.least(shares, count), 2),
    ):
        far = f"{as_factor(loss)}*{as_factor(least)}*distance^{order}"
        ball = radius, steepness(setting, function, radius)
        drop, far = f"{as_factor(loss)}*{size}", far if bounded else f"{far}/(1 + level)"
        if ball[1]:
            yield setting.candidate(function, drop, far, ball, ANYWHERE, searches=searches)


def steepness(setting: Setting, function: Function, radius: str) -> str:
    """A bound of V(s)/|s - e| where |s - e| <= radius; an empty text if none is found."""
    (state,) = setting.system.state
    known = setting.constants
    size = column(radius, known, setting.count)
    least = np.full(setting.count, np.inf)
    for gap in (size, -size):
        points = known | {state: known[f"{state}_point"] + gap, f"{state}_gap": gap}
        least = np.minimum(least, size / function.at(points, setting.count))
    found = below(setting, least, 1)
    return inverse(found[0][1]) if found else ""


def room(setting: Setting, envelope: Envelope) -> Floats:
    """The distance from the point to the bound l of the space, or to the state where upper = 0 if
    that is less, for each of the parameters.
    """
    point = setting.constants[f"{setting.system.state[0]}_point"]
    found = np.abs(zero_of(setting, envelope.lower) - point)
    if envelope.upper != "1":
        found = np.minimum(found, np.abs(zero_of(setting, envelope.upper) - point))
    return found


def states_of(setting: Setting, envelope: Envelope) -> Samples:
    """States of the space at distances of all sizes from the bound l, from the point, and from the
    state where upper = 0.
    """
    (state,) = setting.system.state
    low, point = zero_of(setting, envelope.lower), setting.constants[f"{state}_point"]
    each = [low[:, None] + np.outer(point - low, limits.SIZES)]
    near = np.outer(point - low, limits.SIZES[limits.SIZES < 1])
    each += [point[:, None] + near, point[:, None] - near]
    if envelope.upper != "1":
        end = zero_of(setting, envelope.upper)
        reach = np.outer(end - point, limits.SIZES[limits.SIZES < 1])
        each += [end[:, None] + reach, end[:, None] - reach]
    states = np.concatenate(each, axis=1)
    which = np.repeat(np.arange(setting.count), states.shape[1])
    points = {name: values[which] for name, values in setting.constants.items()}
    points |= {state: states.ravel(), f"{state}_gap": states.ravel() - point[which]}
    inside = np.broadcast_to(holds(setting.system.space, points), which.shape)
    return Samples(points, which).where(inside)


def zero_of(setting: Setting, text: str) -> Floats:
    """The state at which a term is 0 that is linear in it, for each of the parameters."""
    (state,) = symbols(setting.system.state)
    (end,) = sympy.solve(expression(text), state)
    found = np.asarray(value(written(end), setting.parameters), float)
    return np.broadcast_to(found, (setting.count,))


def entrance(setting: Setting, envelope: Envelope) -> list[MapRule]:
    """The statements that orbits enter the part of the space where upper > 0, and that the point,
    which attracts that part, attracts the whole; none if no constants are found.
    """
    system = setting.system
    (state,) = system.state
    samples = states_of(setting, envelope)
    outside = samples.where(~holds(f"{envelope.upper} > 0", samples.points))
    at_end = setting.constants | {state: zero_of(setting, envelope.upper)}
    (image,) = system.images[setting.piece]
    fall = written(sympy.factor(symbols([state])[0] - image))  # a difference of floats is rounded
    falls = [
        column(fall, points, count)
        for points, count in ((outside.points, len(outside.which)), (at_end, setting.count))
    ]
    steps = [(0.0, "")]
    if len(falls[0]):
        least = np.minimum(outside.least(falls[0], setting.count), falls[1])
        steps = below(setting, least, 1)
    radii = below(setting, room(setting, envelope) / 2, 1)
    if not radii or not steps:
        return []
    rank = f"{as_factor(envelope.lower)}*{as_factor(inverse(steps[0][1]))}" if steps[0][1] else "0"
    return [
        setting.descent("descends", "map", rank, f"{envelope.upper} > 0"),
        setting.attraction("attracts", "descends", "inner-attracts", radii[0][1]),
    ]
