"""Maps of one variable: the distance to the point e above it, and below it the distance times a
power of (e - l)/(s - l), for a lower bound l of the space, or the same with an upper bound:

    V = max(s - e, (e - s) ((e - l)/(s - l))^k),

of degree less than the squares of these.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import product

import numpy as np

from juggleproof.certificates.language import MapRule
from juggleproof.proofs.stability.envelopes import SIZES, equation_of
from juggleproof.proofs.stability.given import as_factor, bounds, holds, renamed
from juggleproof.proofs.stability.part_metric import rows_of
from juggleproof.proofs.stability.samples import Samples, ends_of
from juggleproof.proofs.stability.templates import Function
from juggleproof.proofs.stability.values import Setting

POWERS = (0, 1, 2)
TRIED = 2  # losses of a function


def two_sided_rules(setting: Setting, on: str, name: str) -> Iterator[tuple[float, MapRule]]:
    """Statements `lyapunov` that samples do not refute, each with a number that is small where it
    is simple and fits well.
    """
    system = setting.system
    if len(system.state) > 1:
        return
    if setting.point.roots:
        setting = replace(setting, have=equation_of(setting))
    setting = replace(setting, states=states_of(setting))
    (state,) = system.state
    sides = [
        [(distance(state, gap, bound.get(state, ""), power), power, bound) for power in POWERS]
        for gap, bound in zip((f"{state}_gap", f"-{state}_gap"), reversed(bounds(system)))
    ]
    for over, under in product(*sides):
        if over[0] and under[0]:
            used = [as_factor(bound[state]) for _, power, bound in (over, under) if power]
            function = Function((over[0], under[0]), divisor="*".join(used) or "1")
            best = sorted(rows_of(setting, function, Fraction(1)), key=lambda one: one[0])
            for rank, rows in best[:TRIED]:
                yield rank + over[1] + under[1], setting.rule(name, function, [("on", on), *rows])


def distance(state: str, gap: str, bound: str, power: int) -> str:
    """The distance, times a power of that of the point to the bound by that of the state; nothing
    where there is no bound.
    """
    if not power:
        return gap
    at_point = as_factor(renamed(bound, {state: f"{state}_point"}))
    to = "" if power == 1 else f"^{power}"
    return f"{at_point}{to}*({gap})/{as_factor(bound)}{to}" if bound else ""


def states_of(setting: Setting) -> Samples:
    """States of the space at distances of all sizes from the point and from the ends of the space,
    in units of the point's distance to an end.
    """
    (state,) = setting.system.state
    point = setting.constants[f"{state}_point"]
    reach = [end - point for end in ends_of(setting.system.space, state) if end is not None]
    reach += [-one for one in reach or [np.ones(setting.count)]]
    gaps = np.concatenate([np.outer(one, [*SIZES, *(1 - SIZES)]) for one in reach], axis=1)
    which = np.repeat(np.arange(setting.count), gaps.shape[1])
    points = {name: values[which] for name, values in setting.constants.items()}
    points |= {f"{state}_gap": gaps.ravel(), state: gaps.ravel() + point[which]}
    inside = np.broadcast_to(holds(setting.system.space, points), which.shape)
    return Samples(points, which).where(inside)
