"""Where orbits start: points, grids, the boundary of R, random states, arrays, made of what is
given, or refused in one line.

In normal form, x the height in units of r T and w the closing speed in units of r, or in the
paper's units, beta and v; heights are at least 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt
from typing import Any, TypeAlias

import numpy as np

from scenes.errors import SceneError
from scenes.juggler.formulas import formulas, region
from scenes.juggler.given import (
    Number,
    brief,
    counted,
    height,
    nearest,
    positive,
    rational,
    restitution,
)
from scenes.juggler.states import Array, Drawn, Even, Floats, Grid, Listed, OnBoundary

Axis: TypeAlias = tuple[Number, Number, int]  # from, to, how many
Side: TypeAlias = tuple[Number, Number]  # from, to
MOST = 10**8  # starts of one scene


def point(x: Number, w: Number) -> Listed:
    """One state.

    >>> point(0, "3/2").exact(0)
    (Fraction(0, 1), Fraction(3, 2))
    """
    return Listed(((height(x), rational(w, "w")),))


def listed(states: Sequence[tuple[Number, Number]]) -> Listed:
    """States one by one, at least one."""
    if not isinstance(states, (Sequence, np.ndarray)) or len(states) == 0:
        raise SceneError("no states are given; give one at least, as a list of pairs (x, w)")
    for pair in states:
        if isinstance(pair, str) or not hasattr(pair, "__len__") or len(pair) != 2:
            raise SceneError(f"{brief(pair)} is no state; give pairs (x, w)")
    return Listed(tuple((height(x), rational(w, "w")) for x, w in states))


def physical(beta: Number, v: Number, r: Number, g: Number) -> Listed:
    """One state in the paper's units: height beta and upward speed v of the ball when the table is
    lowest; launch speed r > 0, gravity g > 0.

    >>> physical(1, "-1/2", 2, 4).exact(0)
    (Fraction(1, 2), Fraction(5, 4))
    """
    return Listed(
        (
            formulas().scaled(
                height(beta, "beta"), rational(v, "v"), positive(r, "r"), positive(g, "g")
            ),
        )
    )


def axis(low: Number, high: Number, count: int, name: str) -> Even:
    """So many numbers from low to high, equally far apart."""
    first, last = rational(low, name), rational(high, name)
    counted(count, f"the number of {name}", 1, MOST)
    if count > 1 and last <= first:
        raise SceneError(
            f"{name} runs from {brief(first)} to {brief(last)}; the second is to be the greater"
        )
    return Even(first, last, int(count))


def _grid_of(heights: Axis, speeds: Axis, names: tuple[str, str]) -> Grid:
    (low, high, count), (low_speed, high_speed, count_speeds) = (
        _parts(one, 3, name) for one, name in zip((heights, speeds), names)
    )
    found = Grid(
        axis(low, high, count, names[0]), axis(low_speed, high_speed, count_speeds, names[1])
    )
    height(found.heights.first, names[0])
    counted(found.count, "the number of states", 1, MOST)
    return found


def _parts(given: Any, count: int, name: str) -> Any:
    """What an axis or a side is given by: from, to, and for an axis how many."""
    if not isinstance(given, (tuple, list)) or len(given) != count:
        told = "an axis has from, to and how many" if count == 3 else "a side has from and to"
        raise SceneError(f"{name} = {brief(given)} has not {count} parts; {told}")
    return given


def grid(x: Axis, w: Axis) -> Grid:
    """A grid of heights (from, to, how many) and closing speeds (likewise).

    >>> grid((0, 1, 3), (-1, 1, 2)).exact(3)
    (Fraction(1, 2), Fraction(1, 1))
    """
    return _grid_of(x, w, ("x", "w"))


def physical_grid(beta: Axis, v: Axis, r: Number, g: Number) -> Grid:
    """The same in the paper's units, as those of `physical`; v runs first, upwards, so that w = 1 -
    v/r falls.

    >>> grid = physical_grid((0, 1, 3), (-1, 1, 2), r=2, g=4)
    >>> grid.exact(2) == physical("1/2", -1, r=2, g=4).exact(0)
    True
    """
    given = _grid_of(beta, v, ("beta", "v"))
    units = positive(r, "r"), positive(g, "g")
    (x, w), (x_last, w_last) = (
        formulas().scaled(*ends, *units)
        for ends in (
            (given.heights.first, given.speeds.first),
            (given.heights.last, given.speeds.last),
        )
    )
    return Grid(Even(x, x_last, len(given.heights)), Even(w, w_last, len(given.speeds)))


def random(count: int, seed: int, x: Side = (0, 10), w: Side = (-5, 5)) -> Drawn:
    """So many states, uniform over a box of heights and closing speeds, whose ends are the floats
    next to those given.
    """
    counted(count, "the number of states", 1, MOST)
    counted(seed, "seed", 0, 2**64 - 1)
    heights, speeds = (
        tuple(nearest(end)[0] for end in _side(one, name)) for one, name in ((x, "x"), (w, "w"))
    )
    for name, (low, high) in (("x", heights), ("w", speeds)):
        if not -1e307 <= low <= high <= 1e307:
            raise SceneError(f"{name} runs from {low} to {high}; neither end may be beyond 1e307")
    height(heights[0])
    return Drawn(int(count), int(seed), (heights[0], heights[1]), (speeds[0], speeds[1]))


def _side(given: Side, name: str) -> tuple[Fraction, Fraction]:
    low, high = (rational(end, name) for end in _parts(given, 2, name))
    if high < low:
        raise SceneError(
            f"{name} runs from {brief(low)} to {brief(high)}; the second is to be the greater"
        )
    return low, high


def physical_box(beta: Side, v: Side, r: Number, g: Number) -> tuple[Side, Side]:
    """The sides x and w, for `random`, of a box in the paper's units.

    >>> physical_box((0, 4), (-1, 1), r=2, g=4)
    ((Fraction(0, 1), Fraction(2, 1)), (Fraction(1, 2), Fraction(3, 2)))
    """
    units = positive(r, "r"), positive(g, "g")
    low, high = zip(_side(beta, "beta"), _side(v, "v"))
    height(low[0], "beta")
    (x, w), (x_last, w_last) = formulas().scaled(*low, *units), formulas().scaled(*high, *units)
    return (x, x_last), (w_last, w)


def arrays(x: Floats, w: Floats) -> Array:
    """Arrays of the same shape (n,), finite, with x >= 0."""
    try:
        xs, ws = np.asarray(x), np.asarray(w)
    except ValueError:
        raise SceneError("x or w is no array; give two arrays of one shape (n,), n >= 1") from None
    if xs.ndim != 1 or xs.shape != ws.shape or not 1 <= len(xs) <= MOST:
        raise SceneError(
            f"x and w have the shapes {xs.shape} and {ws.shape}; give two arrays of one shape (n,),"
            " n >= 1"
        )
    if xs.dtype != np.float64 or ws.dtype != np.float64:
        raise SceneError(f"x and w are of {xs.dtype} and {ws.dtype}; give float64")
    for name, values in (("x", xs), ("w", ws)):
        if not np.isfinite(values).all():
            raise SceneError(
                f"{name} = {values[~np.isfinite(values)][0]} is no finite number; give finite"
                " floats"
            )
    if (xs < 0).any():
        raise SceneError(f"x = {xs[xs < 0][0]} is below the table; a state has x >= 0")
    return Array(xs, ws)


def boundary(alpha: Number, count: int) -> OnBoundary:
    """So many exact states on the boundary of R: half of them on its energy level, half on the side
    x = 0 (the odd one on the level).

    On the level w runs over rationals within it, and x = (E - (1 - w)^2/2)/2 is rational too.

    >>> formulas().energy(*boundary("1/3", 3).exact(0)), region()(Fraction(1, 3))
    (Fraction(3, 1), Fraction(3, 1))
    """
    at = restitution(alpha)
    counted(count, "the number of states", 2, 10**6)
    level = region()(at)
    fine = 10**6
    reach = Fraction(
        isqrt(int(2 * level * fine**2)), fine
    )  # at most the root of 2 E, so that x >= 0
    added = formulas().energy(Fraction(1), Fraction(1)) - formulas().energy(
        Fraction(0), Fraction(1)
    )
    return OnBoundary(level, reach, added, int(count))
