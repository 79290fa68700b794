"""Maps of one variable: the distance to the point e above it, and below it the distance times a
power of (e - l)/(s - l), for a lower bound l of the space, or the same with an upper bound:

    V = max(s - e, (e - s) ((e - l)/(s - l))^k),

of degree less than the squares of these; where the map is affine in pieces, the distances with a
weight on each side: V = max(u (s - e), v (e - s)).  It falls where what is above the point comes
below it to less than u/v times the distance, and what is below it above it to less than v/u times.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product

import numpy as np
import sympy

from juggleproof.certificates.language import MapRule
from juggleproof.proofs.stability.functions.envelopes import SIZES, equation_of
from juggleproof.proofs.stability.functions.norms import is_affine
from juggleproof.proofs.stability.functions.templates import Function
from juggleproof.proofs.stability.functions.values import Setting, bounded_below, small_balls
from juggleproof.proofs.stability.given import (
    Expr,
    as_factor,
    bounds,
    holds,
    renamed,
    symbols,
    written,
)
from juggleproof.proofs.stability.samples import Samples, after, ends_of

POWERS = (0, 1, 2)
TRIED = 2  # losses of a function
CLOSE = 1e-6  # of the distance to an end, what is not looked at
FAR = 1e4  # times the rounding of the point


def two_sided_rules(setting: Setting, on: str, name: str) -> Iterator[tuple[float, MapRule]]:
    """Statements `lyapunov` that samples do not refute, each with a number that is small where it
    is simple and fits well.
    """
    if len(setting.system.state) > 1:
        return
    if setting.point.roots:
        setting = replace(setting, have=equation_of(setting))
    setting = replace(setting, states=states_of(setting))
    for kind, function in functions(setting):
        best = sorted(constants(setting, function), key=lambda one: one[0])
        for rank, rows in best[:TRIED]:
            yield rank + kind, setting.rule(name, function, [("on", on), *rows])


def functions(setting: Setting) -> Iterator[tuple[float, Function]]:
    """The functions to try, each with a number that is small where it is simple."""
    system = setting.system
    (state,) = system.state
    sides = [
        [(distance(state, gap, bound.get(state, ""), power), power, bound) for power in POWERS]
        for gap, bound in zip((f"{state}_gap", f"-{state}_gap"), reversed(bounds(system)))
    ]
    for over, under in product(*sides):
        if over[0] and under[0]:
            used = [as_factor(bound[state]) for _, power, bound in (over, under) if power]
            yield over[1] + under[1], Function((over[0], under[0]), divisor="*".join(used) or "1")
    if is_affine(system) and len(system.pieces) > 1:
        yield from ((0.0, function) for function in weighted(setting))


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


def distance(state: str, gap: str, bound: str, power: int) -> str:
    """The distance, times a power of that of the point to the bound by that of the state; nothing
    where there is no bound.
    """
    if not power:
        return gap
    at_point = as_factor(renamed(bound, {state: f"{state}_point"}))
    to = "" if power == 1 else f"^{power}"
    return f"{at_point}{to}*({gap})/{as_factor(bound)}{to}" if bound else ""


def constants(
    setting: Setting, function: Function
) -> Iterator[tuple[float, list[tuple[str, str]]]]:
    """The lines but `on` and `value`, for losses of a share of V and of V/(1 + V)."""
    samples = setting.states
    here, there = function.along(setting.system, samples.points, len(samples.which))
    radius, upper = next(small_balls(setting, function), ("", ""))
    if not radius or not (there < here).all():
        return
    steep = here / np.abs(samples.points[f"{setting.system.state[0]}_gap"])
    far = "distance"
    if steep.min(initial=1.0) < 1 - CLOSE:
        for _, bound in bounded_below(samples.least(steep, setting.count), setting.products, 1):
            far = f"{as_factor(bound)}*distance"
    for power, divide in enumerate(("", "/(1 + {})")):
        least = samples.least((here - there) / here * (1 + here) ** power, setting.count)
        for rank, constant in bounded_below(least, setting.products):
            start = "" if constant == "1" else f"({constant})*"
            rows = [
                ("loss", start + "value" + divide.format("value")),
                ("least", start + far + divide.format("level")),
                ("upper", upper),
                ("radius", radius),
            ]
            yield rank + power / 4, rows


def states_of(setting: Setting) -> Samples:
    """States of the space at distances of all sizes from the point and from the ends of the space,
    in units of the point's distance to an end.
    """
    (state,) = setting.system.state
    point = setting.constants[f"{state}_point"]
    reach = [end - point for end in ends_of(setting.system.space, state) if end is not None]
    reach += [-one for one in reach or [np.ones(setting.count)]]
    sizes = [one for one in (*SIZES, *(1 - SIZES)) if abs(one) > CLOSE]
    gaps = np.concatenate([np.outer(one, sizes) for one in reach], axis=1)
    which = np.repeat(np.arange(setting.count), gaps.shape[1])
    points = {name: values[which] for name, values in setting.constants.items()}
    points |= {f"{state}_gap": gaps.ravel(), state: gaps.ravel() + point[which]}
    inside = np.broadcast_to(holds(setting.system.space, points), which.shape)
    at = {name: setting.constants[name] for name in setting.system.parameters}
    rounding = np.abs(setting.system.next({**at, state: point})[0] - point)
    return Samples(points, which).where(inside & (np.abs(gaps.ravel()) > FAR * rounding[which]))
