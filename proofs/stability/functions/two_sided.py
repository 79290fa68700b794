"""Maps of one variable: the distance to the point e above it, and below it the distance times a
power of (e - l)/(s - l), for a lower bound l of the space, or the same with an upper bound:

    V = max(s - e, (e - s) ((e - l)/(s - l))^k),

of degree less than the squares of these.  By what share a side falls is a quotient, whose values at
the point and at the ends of the space are what the loss is sought among.  Where the map is affine
in pieces, the distances with a weight on each side: V = max(u (s - e), v (e - s)), which falls
where what is above the point comes below it to less than u/v times the distance, and what is below
it above it to less than v/u times.
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
from juggleproof.certificates.cases import conjunction
from juggleproof.certificates.nodes import Proof
from juggleproof.certificates.search.falls.by_factors import proof_by_factors
from juggleproof.certificates.search.falls.by_products import proof_by_products
from juggleproof.proofs.stability.certifying import Candidate, Search
from juggleproof.proofs.stability.functions.candidates import (
    Setting,
    bounded_below,
    losses,
    small_balls,
)
from juggleproof.proofs.stability.functions.envelopes import SIZES, equation_of
from juggleproof.proofs.stability.functions.equations import (
    at_parameters,
    factors_of,
    with_equations,
)
from juggleproof.proofs.stability.functions.norms import is_affine
from juggleproof.proofs.stability.functions.templates import Function
from juggleproof.proofs.stability.samples import Arrays, Floats, Samples, after, ends_of, licence
from juggleproof.proofs.stability.terms import (
    Expr,
    as_factor,
    atoms,
    expression,
    holds,
    renamed,
    symbols,
    written,
)

POWERS = (0, 1, 2)
TRIED = 2  # losses of a function
SHAPES = ((1, 0), (1, 1))  # (k, j) for losses V^k/(1 + V)^j
SLOW_SHAPES = ((2, 1), (3, 2))  # where the multiplier is 1
CLOSE = 1e-6  # of the distance to an end, what is not looked at
FAR = 1e4  # times the rounding of the point
FEW = 0.25  # of the parameters
EPSILON = float(np.finfo(float).eps)
MOST_TERMS = 6  # of which the products are tried as constants
FEW_COLUMNS = 1500  # of a program of products
MOST_POINTS = 3000  # at which signs of factors are looked at
LONGEST = 80  # constant, in characters


@dataclass(frozen=True)
class Side:
    """The distance to the point on one of its sides, as it is or over a power of a bound of the
    space, which it tends to infinity at.
    """

    sign: int  # 1 above the point, -1 below
    bound: str
    power: int

    def term(self, state: str) -> str:
        """The distance, times a power of the bound at the point by the bound at the state."""
        gap = f"{state}_gap" if self.sign > 0 else f"-{state}_gap"
        if not self.power:
            return gap
        at_point = as_factor(renamed(self.bound, {state: f"{state}_point"}))
        to = "" if self.power == 1 else f"^{self.power}"
        return f"{at_point}{to}*({gap})/{as_factor(self.bound)}{to}"


@dataclass(frozen=True)
class Sides:
    """A function of two sides, or of the same with weights."""

    rank: float  # small where it is simple
    function: Function
    sides: tuple[Side, ...] = ()


def two_sided_candidates(setting: Setting) -> Iterator[Candidate]:
    """The candidates that samples do not refute, with searches for the premises that V falls, and
    by how much at least.
    """
    if len(setting.system.state) > 1:
        return
    setting, put = solved(setting)
    setting = replace(setting, states=states_of(setting))
    gap = f"{setting.system.state[0]}_gap"
    roots = [root for root, _ in setting.point.roots]
    unknowns = [*map(str, put), *roots]
    for each in functions(setting):
        samples, count = setting.states, len(each.function.terms)
        known = samples.points | {"value": each.function.at(samples.points, len(samples.which))}
        step = 1 + len(samples.which) // MOST_POINTS
        search = partial(
            proof_that_it_falls,
            terms=range(count),
            unknowns=unknowns,
            roots=roots,
            gap=gap,
            points={name: values[::step] for name, values in known.items()},
        )
        searches: dict[str, Search] = {
            f"falls-{k + 1}-{i + 1}": search
            for k in range(len(setting.system.pieces))
            for i in range(count if put else 0)
        }
        if put:
            searches["least"] = partial(
                proof_by_products, terms=range(count), unknowns=unknowns, squares=(), signs=()
            )
        best = sorted(candidates_for(setting, each, put), key=lambda one: one.rank)
        for one in best[:TRIED]:
            yield replace(one, rank=one.rank + each.rank, searches=searches)


def proof_that_it_falls(
    premise: checker.Statement,
    known: dict[str, checker.Statement],
    terms: Sequence[int],
    unknowns: Sequence[str],
    roots: Sequence[str],
    gap: str,
    points: Arrays,
) -> Proof | None:
    """A proof by products of what is positive, or by the signs of factors."""
    gaps = [gap]
    found = proof_by_products(premise, known, terms, unknowns, gaps, gaps, FEW_COLUMNS)
    for left_out in dict.fromkeys((tuple(unknowns), tuple(roots))):
        found = found or proof_by_factors(premise, known, left_out, gap, points)
    return found


def solved(setting: Setting) -> tuple[Setting, dict[Expr, Expr]]:
    """What to put for a parameter or the point, from the equation of the point; and the setting,
    whose premises know this equation, and what the domain says of the parameter then.
    """
    if is_affine(setting.system):
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
    """Whether no coefficient of a polynomial is negative."""
    names = sorted(term.free_symbols, key=str)
    return not names or all(c >= 0 for c in sympy.Poly(term, *names).coeffs())


def functions(setting: Setting) -> Iterator[Sides]:
    """The functions to try."""
    state = setting.system.state[0]
    every = [
        [Side(sign, bound, power) for power in POWERS if bound or not power]
        for sign, bound in zip((1, -1), ends(setting))
    ]
    for over, under in product(*every):
        used = [as_factor(one.bound) for one in (over, under) if one.power]
        terms = (over.term(state), under.term(state))
        function = Function(terms, divisor="*".join(used) or "1")
        yield Sides(over.power + under.power, function, (over, under))
    if is_affine(setting.system) and len(setting.system.pieces) > 1:
        yield from (Sides(0.0, function) for function in weighted(setting))


def ends(setting: Setting) -> tuple[str, str]:
    """What is > 0 in the space and falls, or grows, at the point for all parameters: an upper
    bound, and a lower one; nothing where there is none.
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
    """The distances with weights on each side, where one slope d alone takes states from a side to
    the other, and slopes c back: d, and 1 - (the product of all 1 - c d)/2 on the other side, which
    is between 1 and each of c d.
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
    """The slopes, as terms in the parameters, of the pieces that take states on this side of the
    point to the other.
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


def candidates_for(setting: Setting, sides: Sides, put: dict[Expr, Expr]) -> Iterator[Candidate]:
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
    if steep.min(initial=1.0) < 1 - CLOSE:
        for _, bound in bounded_below(samples.least(steep, setting.count), setting.products, 1):
            far = f"{as_factor(bound)}*distance"
    terms = shares(setting, sides, put)
    slow = bool(terms) and not terms[0]
    known = [*setting.products, *products_of_shares(setting, terms)]
    for power, divided in SLOW_SHAPES if slow else SHAPES:
        size, least = ("value", far) if power == 1 else (f"value^{power}", f"({far})^{power}")
        falls = (here - there) / here**power, 1 + here
        for rank, constant, loss, at_least in losses(
            setting, samples, falls, size, least, (divided,), known
        ):
            licensed = with_licences(setting, constant)
            yield licensed.candidate(function, loss, at_least, near, rank=rank)


def is_clear(setting: Setting, here: Floats, there: Floats) -> NDArray[np.bool_]:
    """At which samples rounding does not say whether V falls: those of parameters of which that is
    so at all samples, if these are not few.
    """
    (state,), samples = setting.system.state, setting.states
    size = np.abs(samples.points[state]) + np.abs(samples.points[f"{state}_point"])
    rounding = FAR * EPSILON * size / np.abs(samples.points[f"{state}_gap"])
    clear = np.asarray(np.abs(here - there) > rounding * here)
    every = np.ones(setting.count, bool)
    every[samples.which[~clear]] = False
    return clear & every[samples.which] if every.mean() > FEW else clear


def ball(setting: Setting, sides: Sides) -> tuple[str, str] | None:
    """A radius within which no linear bound that V divides by is less than half of what it is at
    the point, and what V is at most there, by the distance; None where there is no such bound.
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


def shares(setting: Setting, sides: Sides, put: dict[Expr, Expr]) -> list[Expr]:
    """By what share of V its terms fall at the point, for states on the same side of it and on the
    other, and at the ends of the space, where V goes over from one side to the same.
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
    for one in dict.fromkeys([*used, *several][:MOST_TERMS]):
        above, below = map(written, sympy.fraction(one))
        text = above if below == "1" else f"{as_factor(above)}/({below})"
        if len(text) <= LONGEST:
            found.append((text, at_parameters(setting, one)))
    return found


def with_licences(setting: Setting, constant: str) -> Setting:
    """The setting whose premises know what is positive in the constant: of the parameters where
    they know nothing else of the point.
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
    sizes = [one for one in (*SIZES, *(1 - SIZES), 1.0) if abs(one) > CLOSE]
    gaps = np.concatenate([np.outer(one, sizes) for one in reach], axis=1)
    units = np.concatenate([SIZES, -SIZES])
    gaps = np.concatenate([gaps, *(end - point[:, None] + units for end in known)], axis=1)
    which = np.repeat(np.arange(setting.count), gaps.shape[1])
    points = {name: values[which] for name, values in setting.constants.items()}
    points |= {f"{state}_gap": gaps.ravel(), state: gaps.ravel() + point[which]}
    inside = np.broadcast_to(holds(setting.system.space, points), which.shape)
    at = {name: setting.constants[name] for name in setting.system.parameters}
    rounding = np.abs(setting.system.next({**at, state: point})[0] - point)
    rounding = np.maximum(rounding, EPSILON * np.abs(point))
    return Samples(points, which).where(inside & (np.abs(gaps.ravel()) > FAR * rounding[which]))
