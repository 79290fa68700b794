"""Boxes that every orbit enters, such as those of a map that saturates.  The guards of the pieces
bound the next state, step by step.  If the map has one rational piece, the values of its images at
the ends of one box bound the next: for example 0 < x/(1 + y) if x > 0 and y > 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np
import sympy

from juggleproof.map_stability import limits
from juggleproof.map_stability.functions.candidates import Setting
from juggleproof.map_stability.maps import HIGH, LOW, Map, Side, ends_of_space
from juggleproof.map_stability.samples import SEED, Arrays, Floats, around
from juggleproof.map_stability.terms import (
    Expr,
    atoms,
    column,
    conjuncts,
    expression,
    holds,
    symbols,
    written,
)
from juggleproof.statements.cases import conjunction
from juggleproof.statements.language import MapRule


def boxes_of(system: Map) -> list[str]:
    """Return bounds that hold one step after any state of the space, then those after two steps,
    and so on until no step gives new ones.

    >>> from juggleproof.map_stability.maps import read_rows
    >>> rows = [("state", "x y"), ("piece", "max(-1, min(1, x + y)), x/2")]
    >>> boxes_of(read_rows("clipped", rows))
    ['x <= 1 and x >= -1', 'x <= 1 and x >= -1 and y <= 1/2 and y >= -1/2']
    """
    found: list[str] = []
    inside, known = system.space, {bound for bound, _ in atoms(system.space)}
    state = symbols(system.state)
    for _ in range(len(state) + 1):
        rows = []
        for place, name in enumerate(system.state):
            for side, relation in ((1, "<="), (-1, ">=")):
                end = _end(system, place, side, inside)
                if end is not None and sympy.expand(side * (end - state[place])) not in known:
                    rows.append(f"{name} {relation} {written(end)}")
        box = conjunction(*rows)
        if not rows or found and box == found[-1]:
            break
        found.append(box)
        inside = conjunction(system.space, box)
    return found


def _end(system: Map, place: int, side: int, inside: str) -> Expr | None:
    """Return the upper end of a coordinate of the next state, or the lower one if `side` is -1;
    None if the guards of a piece give none.
    """
    ends = []
    for (guard, _), images in zip(system.pieces, system.images):
        known = {bound for bound, _ in atoms(conjunction(inside, guard))}
        ends.append(_ends(system, images[place], side, known))
    numbers = [[end for end in each if end.is_Rational] for each in ends]
    if all(numbers):
        return side * max(min(side * end for end in each) for each in numbers)
    common = set.intersection(*map(set, ends))
    return min(common, key=str) if common else None


def _ends(system: Map, image: Expr, side: int, known: set[Expr]) -> list[Expr]:
    """Return terms in the parameters that bound the image, each by one fact `bound >= 0`."""
    state = set(symbols(system.state))
    if not image.free_symbols & state:
        return [image]
    found = []
    for bound in known:
        for one in bound.free_symbols & state & image.free_symbols:
            slopes = sympy.diff(bound, one), sympy.diff(image, one)
            share = sympy.cancel(-side * slopes[1] / slopes[0])
            if share.is_Rational and share > 0:
                rest = sympy.expand(side * image + share * bound)
                if not rest.free_symbols & state:
                    found.append(side * rest)
    return found


def within(setting: Setting, box: str) -> Setting:
    """Return the setting with states of the box only."""
    system = replace(setting.system, space=conjunction(setting.system.space, box))
    states = around(system, setting.point, setting.parameters, limits.STATES)
    return replace(setting, system=system, states=states, outer=setting.system.space)


def entering_rules(setting: Setting, boxes: Sequence[str]) -> list[MapRule]:
    """The statements that every orbit enters the last box, if there is one, and that the point
    attracts the whole space.
    """
    space = setting.system.space
    stages = (space, *(conjunction(space, box) for box in boxes))
    return [
        setting.descent("descends", "map", "0", *stages),
        setting.attraction("attracts", "descends"),
    ]


# -------------------------------------------------------------------------------------------------
# Parts of the space that every orbit enters, each the space of a map with the same piece.


def spaces_entered(setting: Setting, far: bool) -> list[str]:
    """Return parts of the space, each within the one before.  Every orbit is in the first part
    after one step, in the second after two, and so on.  No image reaches an end of a part; if
    `far`, the ends are the limits of the images.
    """
    system, found = setting.system, [setting.system.space]
    bounded: dict[Side, str] = {}
    if len(system.pieces) > 1:
        return []
    for _ in system.state:
        ends, points = ends_of_space(system, found[-1]), states_at_ends(setting, found[-1])
        known = atoms(found[-1])
        rows: dict[Side, str] = {}
        for side in product(range(len(system.state)), (LOW, HIGH)):
            row = "" if side in bounded else _bound(system, side, ends, points, far)
            rows |= {side: row} if row and atoms(row)[0] not in known else {}
        if not rows:
            break
        bounded |= rows
        said = {poly for poly, _ in atoms(conjunction(*rows.values()))}
        kept = (
            part for part in conjuncts(found[-1]) if not {poly for poly, _ in atoms(part)} & said
        )
        found.append(conjunction(*rows.values(), *kept))  # the new bounds come first
    return found[1:]


def _bound(system: Map, side: Side, ends: dict[Side, Expr], points: Arrays, far: bool) -> str:
    """Return a new bound of the next value of a variable on one side, as a formula, or an empty
    text.
    """
    (place, sign), end = side, ends.get(side)
    image = system.images[0][place]
    if far:
        limit = limit_of(system, image, sign, ends, points)
        end = None if limit == end else limit
    if end is None or not end.is_rational_function():
        return ""
    beyond = sign * (_at(end, points) - _at(image, points))
    attained = bool((beyond == 0).any())
    if (beyond < 0).any() or attained and not far:
        return ""
    relation = (">" if sign == LOW else "<") + ("=" if attained else "")
    return f"{system.state[place]} {relation} {written(end)}"


def limit_of(
    system: Map, image: Expr, sign: int, ends: dict[Side, Expr], points: Arrays
) -> Expr | None:
    """Return the least value of a rational term, or the greatest, at the ends of its variables;
    None if the term is not monotone in one of them, or has no limit.
    """
    for place, one in enumerate(symbols(system.state)):
        slope = _at(sympy.diff(image, one), points)
        if slope.min() < 0 < slope.max():
            return None
        above, below = sympy.fraction(sympy.together(image))
        end = ends.get((place, sign if slope.max() > 0 else -sign))
        if end is None:  # far out
            degree = sympy.degree(below, one)
            if sympy.degree(above, one) > degree:
                return None
            above, below = (
                sympy.Poly(part, one).coeff_monomial(one**degree) for part in (above, below)
            )
        divisor = sympy.expand(below.subs(one, end) if end is not None else below)
        if divisor == 0:
            return None
        image = sympy.cancel((above.subs(one, end) if end is not None else above) / divisor)
    return image


def states_at_ends(setting: Setting, space: str) -> Arrays:
    """States of the space, many of them at an end of it."""
    rng, points = np.random.default_rng(SEED), dict(setting.states.points)
    for (place, _), end in ends_of_space(setting.system, space).items():
        name = setting.system.state[place]
        points[name] = np.where(
            rng.random(len(points[name])) < limits.END_SHARE, _at(end, points), points[name]
        )
    inside = np.broadcast_to(holds(space, points), next(iter(points.values())).shape)
    return {name: values[inside] for name, values in points.items()}


def _at(term: Expr, points: Arrays) -> Floats:
    count = len(next(iter(points.values())))
    return column(written(term), points, count)


def radius_of(setting: Setting, space: str) -> str:
    """A term below the distances d of the point to the ends that this part of the space adds:
    1/(2 sum 1/d), which is less than each d.
    """
    at = dict(zip(symbols(setting.system.state), map(expression, setting.point.terms)))
    known, states = atoms(setting.system.space), states_at_ends(setting, setting.system.space)
    ends = {
        sympy.cancel(poly.subs(at))
        for poly, strict in atoms(space)
        if (poly, strict) not in known and not (_at(poly, states) > 0).all()
    }
    return written(sympy.factor(1 / (2 * sum(1 / end for end in ends)))) if ends else "1"


def rules_into(setting: Setting, spaces: Sequence[str]) -> list[MapRule]:
    """The statements that every orbit enters the last of the spaces, and that the point attracts
    all states, since it attracts those of that space.
    """
    stages = (setting.system.space, *spaces)
    return [
        setting.descent("descends-1", "map-1", "0", spaces[-1]),
        setting.attraction("attracts-1", "descends-1"),
        setting.descent("descends", "map", "0", *stages),
        setting.attraction("attracts", "descends", "attracts-1", radius_of(setting, spaces[-1])),
    ]
