"""Functions of one variable with a distance on each side of the point e: above it the distance, and
below it the distance times a power of (e - l)/(s - l), for a lower bound l of the space, or the
same with an upper bound:

    V = max(s - e, (e - s) ((e - l)/(s - l))^k).

Their degree is less than that of their squares.  The share by which a side falls is a quotient; its
values at the point and at the ends of the space make the constants of a loss.  For maps that are
affine in pieces the distances have a weight on each side: V = max(u (s - e), v (e - s)).  It falls
if states above the point come below it to less than u/v times the distance, and states below it
come above it to less than v/u times the distance.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations_with_replacement, product

import numpy as np
import sympy
from numpy.typing import NDArray

from juggleproof.certificates import checker
from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import CandidateProof, Search
from juggleproof.map_stability.functions.candidates import (
    Setting,
    bounded_below,
    losses,
    small_balls,
)
from juggleproof.map_stability.functions.envelopes import equation_of
from juggleproof.map_stability.functions.equations import (
    at_parameters,
    factors_of,
    with_equations,
)
from juggleproof.map_stability.functions.templates import Function
from juggleproof.map_stability.samples import Arrays, Floats, Samples, after, ends_of, licence
from juggleproof.map_stability.terms import (
    Expr,
    as_factor,
    atoms,
    expression,
    holds,
    renamed,
    symbols,
    written,
)
from juggleproof.search.decrease_proofs.by_factors import proof_by_factors
from juggleproof.search.decrease_proofs.by_products import proof_by_products
from juggleproof.statements.cases import conjunction
from juggleproof.statements.nodes import Proof

EPSILON = float(np.finfo(float).eps)


@dataclass(frozen=True)
class SideDistance:
    """The distance to the point on one of its sides, as it is, or over a power of a bound of the
    space; at the bound it tends to infinity.
    """

    sign: int  # 1 above the point, -1 below
    bound: str
    power: int

    def term(self, state: str) -> str:
        """The distance times (the bound at the point/the bound at the state)^power."""
        gap = f"{state}_gap" if self.sign > 0 else f"-{state}_gap"
        if not self.power:
            return gap
        at_point = as_factor(renamed(self.bound, {state: f"{state}_point"}))
        to = "" if self.power == 1 else f"^{self.power}"
        return f"{at_point}{to}*({gap})/{as_factor(self.bound)}{to}"


@dataclass(frozen=True)
class TwoSides:
    """A function of two sides, which may have weights."""

    rank: float  # small where it is simple
    function: Function
    sides: tuple[SideDistance, ...] = ()


def two_sided_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """The candidates that samples do not refute, with searches for the premises that V falls, and
    by how much at least.
    """
    if len(setting.system.state) > 1:
        return
    setting, put = solved(setting)
    setting = replace(setting, states=states_of(setting))
    unknowns = [*map(str, put), *(root for root, _ in setting.point.roots)]
    for each in functions(setting):
        searches: dict[str, Search] = {}
        if put:
            terms = range(len(each.function.terms))
            searches = falling_searches(setting, put, each.function)
            searches["least"] = partial(
                proof_by_products, terms=terms, unknowns=unknowns, squares=(), signs=()
            )
        best = sorted(candidates_for(setting, each, put), key=lambda one: one.rank)
        for one in best[: limits.TRIED]:
            yield replace(one, rank=one.rank + each.rank, searches=searches)


def falling_searches(
    setting: Setting, put: dict[Expr, Expr], function: Function
) -> dict[str, Search]:
    """Return the searches for the premises that V falls."""
    samples, roots = setting.states, [root for root, _ in setting.point.roots]
    known = samples.points | {"value": function.at(samples.points, len(samples.which))}
    step = 1 + len(samples.which) // limits.MOST_SIGNS
    terms = range(len(function.terms))
    search = partial(
        proof_that_it_falls,
        terms=terms,
        unknowns=[*map(str, put), *roots],
        roots=roots,
        gap=f"{setting.system.state[0]}_gap",
        points={name: values[::step] for name, values in known.items()},
    )
    pieces = range(len(setting.system.pieces))
    return {f"falls-{k + 1}-{i + 1}": search for k in pieces for i in terms}


def proof_that_it_falls(
    premise: checker.Statement,
    known: dict[str, checker.Statement],
    terms: Sequence[int],
    unknowns: Sequence[str],
    roots: Sequence[str],
    gap: str,
    points: Arrays,
) -> Proof | None:
    """Return a proof by products of positive terms, or by the signs of factors."""
    gaps = [gap]
    found = proof_by_products(premise, known, terms, unknowns, gaps, gaps, limits.MOST_COLUMNS)
    for left_out in dict.fromkeys((tuple(unknowns), tuple(roots))):
        found = found or proof_by_factors(premise, known, left_out, gap, points)
    return found


def solved(setting: Setting) -> tuple[Setting, dict[Expr, Expr]]:
    """Return the setting and a term for a parameter, or for the point, from the equation of the
    point.  The premises know this equation, and what the domain says of the parameter with it.
    """
    if setting.system.is_affine:
        return setting, {}
    found, put = with_equations(setting)
    if not setting.have:
        return setting, put
    if not any("=" in line for line in found.have):
        return replace(setting, have=equation_of(setting)), {}
    lines = []
    for bound, strict in atoms(setting.domain):
        if bound.free_symbols & set(put):
            above, below = sympy.fraction(sympy.together(bound.xreplace(put)))
            above = sympy.factor(above if at_parameters(setting, below).min() > 0 else -above)
            if not is_positive(above):
                lines += [f"{written(one)} > 0" for one in factors_of(found, [above]) if strict]
    return replace(found, have=tuple(dict.fromkeys([*found.have, *lines]))), put


def is_positive(term: Expr) -> bool:
    """Return whether no coefficient of a polynomial is negative."""
    names = sorted(term.free_symbols, key=str)
    return not names or all(c >= 0 for c in sympy.Poly(term, *names).coeffs())


def functions(setting: Setting) -> Iterator[TwoSides]:
    """The functions to try."""
    state = setting.system.state[0]
    every = [
        [SideDistance(sign, bound, power) for power in limits.SIDE_POWERS if bound or not power]
        for sign, bound in zip((1, -1), ends(setting))
    ]
    for over, under in product(*every):
        used = [as_factor(one.bound) for one in (over, under) if one.power]
        terms = (over.term(state), under.term(state))
        function = Function(terms, divisor="*".join(used) or "1")
        yield TwoSides(over.power + under.power, function, (over, under))
    if setting.system.is_affine and len(setting.system.pieces) > 1:
        yield from (TwoSides(0.0, function) for function in weighted(setting))


def ends(setting: Setting) -> tuple[str, str]:
    """Return an upper bound of the space and a lower one: terms that are > 0 in the space, and fall
    or grow at the point for all parameters.  A bound that is missing is empty.
    """
    (state,) = symbols(setting.system.state)
    found = {1: "", -1: ""}
    for bound, strict in atoms(setting.system.space):
        if strict and bound.has(state) and bound.is_polynomial():
            slope = sympy.diff(bound, state).subs(state, expression(setting.point.terms[0]))
            with np.errstate(all="ignore"):
                signs = set(np.sign(at_parameters(setting, slope)))
            if signs == {1.0} or signs == {-1.0}:
                side = 1 if signs == {-1.0} else -1
                found[side] = found[side] or written(bound)
    return found[1], found[-1]


def weighted(setting: Setting) -> Iterator[Function]:
    """Yield the distances with a weight on each side, if a single slope d takes states from one
    side to the other, and slopes c take them back.  The weight is d on the one side, and on the
    other 1 - (the product of all 1 - c d)/2, which is between 1 and each c d.
    """
    gap = f"{setting.system.state[0]}_gap"
    slopes = {side: crossing(setting, side) for side in (1, -1)}
    for side in (1, -1):
        if len(slopes[side]) == 1 and slopes[-side]:
            (other,) = slopes[side]
            less = sympy.prod([1 - one * other for one in slopes[-side]])
            near, far = (as_factor(written(one)) for one in (other, sympy.expand(1 - less / 2)))
            over, under = (near, far) if side == 1 else (far, near)
            yield Function((f"{over}*{gap}", f"-{under}*{gap}"))


def crossing(setting: Setting, side: int) -> list[Expr]:
    """Return the slopes of the pieces that take states on this side of the point to the other
    side.
    """
    system, points = setting.system, setting.states.points
    gap = f"{system.state[0]}_gap"
    (state,) = symbols(system.state)
    crosses = (side * points[gap] > 0) & (side * after(system, points)[gap] < 0)
    return list(
        dict.fromkeys(
            -sympy.diff(image, state)
            for (guard, _), (image,) in zip(system.pieces, system.images)
            if (crosses & holds(guard, points)).any()
        )
    )


def candidates_for(
    setting: Setting, sides: TwoSides, put: dict[Expr, Expr]
) -> Iterator[CandidateProof]:
    """The candidates for a function, for losses of several shapes."""
    samples, function, (state,) = setting.states, sides.function, setting.system.state
    here, there = function.along(setting.system, samples.points, len(samples.which))
    near = ball(setting, sides) or next(small_balls(setting, function), None)
    if near is None:
        return
    clear = is_clear(setting, here, there)
    samples, here, there = samples.where(clear), here[clear], there[clear]
    if not len(here) or not (there < here).all():
        return
    steep = here / np.abs(samples.points[f"{state}_gap"])
    far = "distance"
    if steep.min(initial=1.0) < 1 - limits.END_CLOSE:
        for _, bound in bounded_below(samples.least(steep, setting.count), setting.products, 1):
            far = f"{as_factor(bound)}*distance"
    terms = shares(setting, sides, put)
    slow = bool(terms) and not terms[0]
    known = [*setting.products, *products_of_shares(setting, terms)]
    for power, divided in limits.SLOW_LOSS_SHAPES if slow else limits.LOSS_SHAPES:
        size, least = ("value", far) if power == 1 else (f"value^{power}", f"({far})^{power}")
        falls = (here - there) / here**power, 1 + here
        for rank, constant, loss, at_least in losses(
            setting, samples, falls, size, least, (divided,), known
        ):
            licensed = with_licences(setting, constant)
            yield licensed.candidate(function, loss, at_least, near, rank=rank)


def is_clear(setting: Setting, here: Floats, there: Floats) -> NDArray[np.bool_]:
    """Return at which samples rounding does not hide whether V falls.  Parameters with a sample
    that is hidden are left out, if enough others are left.
    """
    (state,), samples = setting.system.state, setting.states
    size = np.abs(samples.points[state]) + np.abs(samples.points[f"{state}_point"])
    rounding = limits.POINT_ROUNDINGS * EPSILON * size / np.abs(samples.points[f"{state}_gap"])
    clear = np.asarray(np.abs(here - there) > rounding * here)
    every = np.ones(setting.count, bool)
    every[samples.which[~clear]] = False
    return clear & every[samples.which] if every.mean() > limits.FEW else clear


def ball(setting: Setting, sides: TwoSides) -> tuple[str, str] | None:
    """Return a radius within which each linear bound that V divides by is at least half of its
    value at the point, and a bound of V there by the distance; None if V divides by no such bound.
    """
    (state,) = symbols(setting.system.state)
    at = expression(setting.point.terms[0]) if not setting.have else setting.point_names[0]
    total, most = sympy.Integer(0), 0
    for side in sides.sides:
        if side.power:
            bound = expression(side.bound)
            slope = sympy.diff(bound, state)
            if slope.has(state):
                return None
            total += -side.sign * slope / bound.subs(state, at)
            most = max(most, side.power)
    return (written(sympy.factor(1 / (2 * total))), str(2**most)) if most else None


def shares(setting: Setting, sides: TwoSides, put: dict[Expr, Expr]) -> list[Expr]:
    """Return the shares of V by which its terms fall at the point, from either side, and at the
    ends of the space.
    """
    if not sides.sides or not put:
        return []
    (state,), (image,) = symbols(setting.system.state), setting.system.images[setting.piece]
    (point,) = setting.point_names
    slope = sympy.diff(image, state).subs(state, point).xreplace(put)
    found = [sympy.factor(1 - slope), sympy.factor(1 + slope)]
    for side in sides.sides:
        term = (state - point) / (expression(side.bound) ** side.power if side.power else 1)
        ratio = sympy.cancel((term.subs(state, image) / term).xreplace(put))
        above, below = (sympy.Poly(part, state) for part in sympy.fraction(ratio))
        for bound, _ in atoms(setting.system.space):
            slope = sympy.diff(bound.xreplace(put), state)
            if slope != 0 and not slope.has(state):
                (end,) = sympy.solve(bound.xreplace(put), state)
                if below.eval(end) != 0:
                    found.append(sympy.factor(1 - above.eval(end) / below.eval(end)))
        if above.degree() <= below.degree():
            same = above.degree() == below.degree()
            found.append(sympy.factor(1 - (above.LC() / below.LC() if same else 0)))
    return list(dict.fromkeys(found))


def products_of_shares(setting: Setting, terms: Sequence[Expr]) -> list[tuple[str, Floats]]:
    """The terms that are positive at all parameters, and products of two of them."""
    used = [one for one in terms if one.free_symbols and (at_parameters(setting, one) > 0).all()]
    several = [sympy.factor(a * b) for a, b in combinations_with_replacement(used, 2)]
    found = []
    for one in dict.fromkeys([*used, *several][: limits.MOST_SHARES]):
        above, below = map(written, sympy.fraction(one))
        text = above if below == "1" else f"{as_factor(above)}/({below})"
        if len(text) <= limits.MOST_CONSTANT:
            found.append((text, at_parameters(setting, one)))
    return found


def with_licences(setting: Setting, constant: str) -> Setting:
    """Return the setting whose premises know that the factors of the constant are positive; if they
    know nothing of the point, its domain says so.
    """
    facts = conjunction(setting.domain, *setting.have)
    known = {str(bound) for bound, strict in atoms(facts) if strict}
    every = factors_of(setting, [expression(constant)])
    open_ = [one for one in every if one.free_symbols and str(sympy.expand(one)) not in known]
    if setting.have:
        return replace(setting, have=(*setting.have, *(f"{written(one)} > 0" for one in open_)))
    _, below = sympy.fraction(sympy.together(expression(constant)))
    for one in factors_of(setting, [below]):
        if one.free_symbols:
            domain = conjunction(setting.domain, licence(one, setting.domain))
            setting = replace(setting, domain=domain)
    return setting


def states_of(setting: Setting) -> Samples:
    """States of the space at distances of all sizes from the point and from the ends of the space,
    in units of the point's distance to an end, and the ends; from an end also in units of 1.
    """
    (state,) = setting.system.state
    point = setting.constants[f"{state}_point"]
    known = [end for end in ends_of(setting.system.space, state) if end is not None]
    reach = [end - point for end in known]
    reach += [-one for one in reach or [np.ones(setting.count)]]
    sizes = [
        one for one in (*limits.SIZES, *(1 - limits.SIZES), 1.0) if abs(one) > limits.END_CLOSE
    ]
    gaps = np.concatenate([np.outer(one, sizes) for one in reach], axis=1)
    units = np.concatenate([limits.SIZES, -limits.SIZES])
    gaps = np.concatenate([gaps, *(end - point[:, None] + units for end in known)], axis=1)
    which = np.repeat(np.arange(setting.count), gaps.shape[1])
    points = {name: values[which] for name, values in setting.constants.items()}
    points |= {f"{state}_gap": gaps.ravel(), state: gaps.ravel() + point[which]}
    inside = np.broadcast_to(holds(setting.system.space, points), which.shape)
    at = {name: setting.constants[name] for name in setting.system.parameters}
    rounding = np.abs(setting.system.next({**at, state: point})[0] - point)
    rounding = np.maximum(rounding, EPSILON * np.abs(point))
    return Samples(points, which).where(
        inside & (np.abs(gaps.ravel()) > limits.POINT_ROUNDINGS * rounding[which])
    )
