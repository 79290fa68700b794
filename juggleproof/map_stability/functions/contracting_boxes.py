"""Boxes around the point that the map takes into smaller boxes of the same shape.  Every orbit
enters one bound of the box after another.  V is the greatest of the distances to the point, each
divided by that of the box's side.

To find a bound, the other variables are put at the ends of the box that move this variable farthest
out.  The bound is first the value at which it then does not change, and is moved outwards.  For two
competing species the upper bounds begin at the capacities; the lower ones, at what a species keeps
while the other is at its capacity.

Sources: H. L. Smith, The discrete dynamics of monotonically decomposable maps, Journal of
Mathematical Biology 53 (2006); M. R. S. Kulenović, O. Merino, A global attractivity result for maps
with invariant boxes, Discrete and Continuous Dynamical Systems B 6 (2006).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations, product

import numpy as np
import sympy

from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import CandidateProof, beyond
from juggleproof.map_stability.functions.candidates import (
    Setting,
    bounded_below,
    inverse,
    positive_factors,
    power_products,
)
from juggleproof.map_stability.functions.equations import at_parameters, with_ends
from juggleproof.map_stability.functions.ratios import (
    has_ratios,
    weighted_distance_candidates,
    without_divisors,
)
from juggleproof.map_stability.functions.templates import Function
from juggleproof.map_stability.maps import HIGH, LOW, Side, ends_of_space
from juggleproof.map_stability.points import roots_of
from juggleproof.map_stability.samples import (
    SEED,
    Floats,
    Samples,
    licence,
)
from juggleproof.map_stability.terms import (
    Expr,
    as_factor,
    atoms,
    column,
    expression,
    holds,
    symbols,
    value,
    written,
)
from juggleproof.statements.cases import conjunction
from juggleproof.statements.language import MapRule

Ends = dict[Side, Expr]  # as terms in the parameters


def contracting_box_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """The candidates by which the point attracts every state; what samples refute is left out."""
    system, known = setting.system, setting
    plain = not (setting.point.roots or setting.outer)
    if not plain or not has_ratios(setting):
        return
    setting = replace(setting, have=())
    box = box_of(setting)
    if box is None:
        return
    point = list(map(expression, setting.point.terms))
    widths = [sympy.factor(side * (end - point[k])) for (k, side), end in box.items()]
    radius, domain = radius_of(setting, widths), setting.domain
    for end in (*box.values(), expression(radius)):
        for factor, _ in sympy.factor_list(sympy.fraction(sympy.together(end))[1])[1]:
            domain = conjunction(domain, licence(factor, domain))
    if beyond(setting.domain, domain, system.parameters):
        return
    setting = replace(setting, domain=domain)
    entered, descents = ends_for(setting), []
    for side, end in box.items():
        step = step_of(setting, entered, side, end)
        if not step:
            return
        entered = entered | {side: end}
        descents.append((step, condition(setting, side, end)))
    space = conjunction(system.space, *(bound for _, bound in descents))
    inside = replace(
        known,
        system=replace(system, space=space),
        domain=domain,
        states=states_of(setting, box),
        map=f"map-{len(box) - 1}",
    )
    every = [
        *(
            replace(one, budget=limits.PREMISE_WORK // 4)
            for one in weighted_distance_candidates(inside)
        ),
        *box_candidates(setting, box, widths, descents[-1][1]),
    ]
    yield from _with_descents(setting, every, radius, descents)


def _with_descents(
    setting: Setting,
    every: Sequence[CandidateProof],
    radius: str,
    descents: Sequence[tuple[str, str]],
) -> Iterator[CandidateProof]:
    """The candidates with a descent for each bound, on a map whose space has the bounds before."""
    system, space = setting.system, setting.system.space
    maps: list[MapRule] = []
    falling: list[MapRule] = []
    attracting: list[MapRule] = []
    names = ["", *(f"-{k}" for k in range(1, len(descents)))]
    for suffix, following, (rank, bound) in zip(names, [*names[1:], ""], descents):
        smaller = replace(system, space=space, domain=setting.domain)
        maps.append(smaller.rule(f"{system.name}/map{suffix}"))
        space = conjunction(space, bound)
        falling.append(setting.descent(f"descends{suffix}", f"map{suffix}", rank, bound))
        within = (f"attracts{following}", radius) if following else ()
        attracting.append(setting.attraction(f"attracts{suffix}", f"descends{suffix}", *within))
    changed = {"map": maps[-1].name, "radius": radius}
    for one in every:
        rows = tuple((key, changed.get(key, text)) for key, text in one.rule.rows)
        inner = replace(one.rule, rows=rows)
        yield replace(one, rules=(*maps[1:], inner, *falling, *reversed(attracting)))


def box_candidates(
    setting: Setting, box: Ends, widths: Sequence[Expr], on: str
) -> Iterator[CandidateProof]:
    """Return the candidates for a V that has the same value on all faces of the box."""
    names = setting.system.state
    weights = list(without_divisors(setting, sympy.Matrix([1 / one for one in widths])))
    terms = [
        f"{as_factor(written(weight))}*{names[k]}_gap"
        if side == HIGH
        else f"-{as_factor(written(weight))}*{names[k]}_gap"
        for (k, side), weight in zip(box, weights)
    ]
    function = Function(tuple(terms))
    samples = states_of(setting, box)
    here, there = function.along(setting.system, samples.points, len(samples.which))
    far = here > limits.BOX_FAR * here.max()
    shares = samples.where(far).least((here - there)[far] / here[far], setting.count)
    products = products_of(setting)
    least, most, size = (
        bounded_below(below_all(setting, every), products, 1)
        for every in (weights, [1 / one for one in weights], widths)
    )
    losses = bounded_below(shares, products)
    for (_, loss), (_, slope), (_, steep), (_, radius) in product(losses, least, most, size):
        drop = f"{as_factor(loss)}*"
        far, ball = f"{drop}{as_factor(slope)}*distance", (radius, inverse(steep))
        yield setting.candidate(function, f"{drop}value", far, ball, on)


def radius_of(setting: Setting, widths: Sequence[Expr]) -> str:
    """A term below all widths w: one that follows the least of them, or 1/(2 sum 1/w)."""
    wide = with_ends(setting)
    for rank, radius in bounded_below(below_all(wide, widths), products_of(wide), 1):
        if rank < limits.LOOSE:
            return radius
    return written(sympy.factor(1 / (2 * sum(1 / width for width in widths))))


def below_all(setting: Setting, terms: Sequence[Expr]) -> Floats:
    """The least of positive terms, at the parameters."""
    found: Floats = np.min([at_parameters(setting, one) for one in terms], axis=0)
    return found


# -------------------------------------------------------------------------------------------------
# The box.


def box_of(setting: Setting) -> Ends | None:
    """The ends of the box, in the order in which orbits enter them."""
    given, at_point = ends_for(setting), ends_at_point(setting)
    sides = [(k, side) for side in (HIGH, LOW) for k in range(len(setting.system.state))]
    every = [side for side in sides if side not in at_point]
    still: Ends = {}
    for _ in every:
        for side in every:
            if side not in still:
                end = still_at(setting, given | still, side)
                still |= {side: end} if end is not None else {}
    if len(still) < len(every):
        return None
    found: Ends = {}
    lower = ends_of_space(setting.system)
    for free in (False, True):
        for _ in every:
            for side in sorted(still, key=lambda side: side[1]):  # the lower ends first
                limit = limit_of(setting, found, side) if side[1] == HIGH else lower.get(side)
                limit = given.get(side) if limit is None else limit
                if limit is None and free:  # nothing limits it: as far up as the space reaches down
                    reach = still[side] - lower.get((side[0], LOW), still[side] - 1)
                    limit = still[side] + (reach if reach != 0 else 1)
                if side not in found and limit is not None:
                    found[side] = sympy.factor((still[side] + limit) / 2)
    return {side: found[side] for side in still} if len(found) == len(every) else None


def ends_for(setting: Setting) -> Ends:
    """The ends of the space that no state is at, and those that the point is at."""
    return ends_of_space(setting.system, strict=True) | ends_at_point(setting)


def ends_at_point(setting: Setting) -> Ends:
    """The ends of the space that the point is at, as 0 is for a species that dies out."""
    point = list(map(expression, setting.point.terms))
    every = ends_of_space(setting.system)
    return {side: end for side, end in every.items() if sympy.cancel(end - point[side[0]]) == 0}


def still_at(setting: Setting, ends: Ends, side: Side) -> Expr | None:
    """Return the value at which the variable does not change, on this side of the point or at it,
    with the others at the ends that move it most to this side; None if there is none, or such an
    end is missing.
    """
    state = symbols(setting.system.state)
    one = state[side[0]]
    image = worst(setting, ends, side, one)
    if image is None:
        return None
    roots = list(roots_of(sympy.numer(sympy.together(image - one)), one))
    found = beside(setting, side, ends.get(side), roots)
    point = expression(setting.point.terms[side[0]])
    return point if found is None and point in roots else found


def limit_of(setting: Setting, found: Ends, side: Side) -> Expr | None:
    """Return the greatest upper end at which the other variables still grow at their lower ends; if
    nothing limits it, the greatest at which they still fall at their upper ends.
    """
    one = symbols(setting.system.state)[side[0]]
    end = ends_of_space(setting.system, strict=True).get(side)
    for direction in (LOW, HIGH):
        every: list[Expr] = []
        for (k, other), there in found.items():
            if k != side[0] and other == direction and slope_of(setting, k, side[0]) == direction:
                ends = {**ends_for(setting), **found, side: one}
                image = worst(setting, ends, (k, direction), there)
                if image is not None:
                    every += roots_of(sympy.numer(sympy.together(image - there)), one)
        limit = beside(setting, side, end, every)
        if limit is not None:
            return limit
    return None


def beside(setting: Setting, side: Side, end: Expr | None, every: Iterable[Expr]) -> Expr | None:
    """Return the first of these terms that is on this side of the point, and inside of the end, at
    all parameters.
    """
    point = setting.constants[f"{setting.system.state[side[0]]}_point"]
    for one in every:
        if any(not power.exp.is_Integer for power in one.atoms(sympy.Pow)):
            continue  # a root, which a map cannot name
        at = at_parameters(setting, one)
        inside = end is None or (side[1] * (at_parameters(setting, end) - at) > 0).all()
        gap = side[1] * (at - point)
        if inside and (gap > -limits.ROUNDING).all() and np.median(gap) > limits.ROUNDING:
            return one
    return None


def slope_of(setting: Setting, image: int, variable: int) -> int | None:
    """Return the sign of an image's derivative by a variable; None if it changes between
    samples.
    """
    system = setting.system
    term = expression(system.pieces[0][1][image])
    slope = sympy.cancel(sympy.diff(term, symbols(system.state)[variable]))
    at = np.asarray(value(written(slope), setting.states.points), float)
    return next((sign for sign in (0, 1, -1) if (np.sign(at) * (sign or 1) == sign**2).all()), None)


def worst(setting: Setting, ends: Ends, side: Side, at: Expr) -> Expr | None:
    """Return the image of a variable at a term, with the others at the ends that move it most to
    this side; None if such an end is missing.
    """
    system, (k, direction) = setting.system, side
    state, put = symbols(system.state), {}
    for other, one in enumerate(state):
        slope = slope_of(setting, k, other)
        if other == k:
            put[one] = at
        elif slope is None or slope and (other, direction * slope) not in ends:
            return None
        elif slope:
            put[one] = ends[other, direction * slope]
    return sympy.cancel(expression(system.pieces[0][1][k]).subs(put, simultaneous=True))


def products_of(setting: Setting) -> list[tuple[str, Floats]]:
    """Products of powers of three of the terms that the domain says to be positive, those that go
    to 0 or grow over it, as text and at the parameters.
    """
    known = setting.parameters
    factors = [
        one
        for one in positive_factors(setting.system, setting.domain, known)
        if np.ptp(np.log(np.asarray(value(one, known), float))) > limits.FEW_FOLD
    ]
    found: dict[str, Floats] = {}
    for few in combinations(factors, min(limits.TOGETHER, len(factors))):
        found |= dict(power_products(few, known, setting.count))
    return list(found.items())


# -------------------------------------------------------------------------------------------------
# How orbits enter it.


def condition(setting: Setting, side: Side, end: Expr) -> str:
    """Return the bound as a formula."""
    return f"{setting.system.state[side[0]]} {'<' if side[1] == HIGH else '>'} {written(end)}"


def step_of(setting: Setting, entered: Ends, side: Side, end: Expr) -> str:
    """A term that falls by 1 in each step of a state beyond the end and inside the ends that are
    entered: a height times a term in the parameters; an empty text if samples refute it.
    """
    (k, direction), system = side, setting.system
    height, one = height_of(setting, entered, side), symbols(system.state)[k]
    if height is None:
        return ""
    limit = entered.get(side)
    samples = states_of(setting, {**entered, (k, -direction): end, side: limit})
    points = samples.points
    image = system.next({name: points[name] for name in system.names})[k]
    text, count = written(height), len(samples.which)
    with np.errstate(all="ignore"):
        falls = column(text, points, count) - column(text, points | {str(one): image}, count)
    fits = np.isfinite(falls)
    least = samples.where(fits).least(falls[fits], setting.count)
    found = bounded_below(least, products_of(setting), 1)
    if not found:
        return ""
    factor = as_factor(inverse(found[0][1]))
    if found[0][0] > limits.LOOSE:
        factor = fall_at(setting, entered, side, end) or factor
    above, below = map(written, sympy.fraction(height))
    return f"{factor}*{as_factor(above)}" if below == "1" else f"{factor}/{as_factor(below)}"


def height_of(setting: Setting, entered: Ends, side: Side) -> Expr | None:
    """The distance of a variable to the lower end of the space; on the lower side its inverse, or,
    where states are at that end, the distance to an upper end that is entered.
    """
    k, direction = side
    one, low = symbols(setting.system.state)[k], (k, LOW)
    lower = ends_of_space(setting.system)[low]
    if direction == HIGH:
        return one - lower
    if low in ends_of_space(setting.system, strict=True):
        return 1 / (one - lower)
    return entered[k, HIGH] - one if (k, HIGH) in entered else None


def fall_at(setting: Setting, entered: Ends, side: Side, end: Expr) -> str:
    """1 over the fall in a step from the end itself, without factors of the fall that are at least
    1; an empty text if the domain does not say that its other factors are positive.
    """
    image, height = worst(setting, entered, side, end), height_of(setting, entered, side)
    if image is None or height is None:
        return ""
    one = symbols(setting.system.state)[side[0]]
    fall = sympy.factor(height.subs(one, end) - height.subs(one, image))
    if fall == 0 or not fall.is_rational_function():
        return ""
    above, below = sympy.fraction(fall)
    constant, factors = sympy.factor_list(above)
    known = {poly for poly, strict in atoms(setting.domain) if strict}
    below, kept = below / abs(constant), []
    for factor, power in factors:
        at = at_parameters(setting, factor)
        one = factor if at.max() > 0 else -factor
        if sympy.expand(one) in known:
            kept.append(f"{as_factor(written(one))}^{power}")
        elif np.abs(at).min() < 1:
            return ""
    below = -below if at_parameters(setting, below).max() < 0 else below
    return f"({as_factor(written(below))}/({'*'.join(kept) or 1}))"


def states_of(setting: Setting, ends: Mapping[Side, Expr | None]) -> Samples:
    """Return states between the ends; many of them are at an end."""
    known = {side: end for side, end in ends.items() if end is not None}
    ends = {**ends_of_space(setting.system), **known}
    rng = np.random.default_rng(SEED + 3)
    which = np.repeat(np.arange(setting.count), limits.STATES_NEAR)
    points = {name: values[which] for name, values in setting.constants.items()}
    for k, name in enumerate(setting.system.state):
        share = rng.choice(limits.BOX_SHARES, len(which))
        share = np.where(share < 0, rng.random(len(which)), share)
        wide = 10 ** (limits.SPREAD * (2 * share - 1)) - 10**-limits.SPREAD
        low, high = (
            None if end is None else at_parameters(setting, end)[which]
            for end in (ends.get((k, LOW)), ends.get((k, HIGH)))
        )
        if low is not None and high is not None:
            points[name] = low + (high - low) * share
        elif low is not None:
            points[name] = low + wide
        else:
            points[name] = wide if high is None else high - wide
        points[f"{name}_gap"] = points[name] - points[f"{name}_point"]
    inside = np.broadcast_to(holds(setting.system.space, points), which.shape)
    return Samples(points, which).where(inside)
