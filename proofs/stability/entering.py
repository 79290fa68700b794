"""Boxes that every orbit enters after so many steps, as where a map saturates: bounds of the next
state by the guards of the pieces, step by step.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy

from juggleproof.certificates.language import MapRule
from juggleproof.proofs.stability.functions.values import Setting
from juggleproof.proofs.stability.given import Expr, Map, atoms, conjunction, symbols, written
from juggleproof.proofs.stability.samples import STATES, around


def boxes_of(system: Map) -> list[str]:
    """For one step after another, bounds that hold of all states so many steps after any state of
    the space, until nothing more is found.

    >>> from juggleproof.proofs.stability.given import read_rows
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
    """The upper end of a coordinate of the next state, or the lower one where `side` is -1; None
    where the guards of some piece give none.
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
    """Terms in the parameters beyond which the image is not, by one of the facts bound >= 0."""
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
    """The same point, with states of the box only."""
    system = replace(setting.system, space=conjunction(setting.system.space, box))
    states = around(system, setting.point, setting.parameters, STATES)
    return replace(setting, system=system, states=states, outer=setting.system.space)


def entering_rules(setting: Setting, boxes: Sequence[str], name: str) -> list[MapRule]:
    """The statements that every orbit enters the last box, if there is one, and that the point
    attracts the whole space.
    """
    stages = [conjunction(setting.system.space, box) for box in boxes]
    return [
        MapRule(
            f"{name}/descends",
            (
                ("map", f"{name}/map"),
                ("domain", setting.domain),
                ("rank", "0"),
                ("stage", setting.system.space),
                *(("stage", stage) for stage in stages),
            ),
        ),
        MapRule(
            f"{name}/attracts",
            (("descent", f"{name}/descends"), ("lyapunov", f"{name}/lyapunov")),
        ),
    ]
