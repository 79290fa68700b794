"""Pictures of orbits: ball and table against time, or the states of many orbits in the plane of x
and w.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import ceil, floor, log10

import numpy as np
from matplotlib.figure import Figure

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.figures.arcs import straight
from juggleproof.scenes.figures.drawing import Plane, blank, styled, svg, ticks
from juggleproof.scenes.figures.look import B1
from juggleproof.scenes.juggler.bounded import ENDS, Column
from juggleproof.scenes.juggler.orbits import Orbits, heights
from juggleproof.scenes.juggler.starts import Scene

MOST_PERIODS, A_PERIOD, MOST_DOTS = 40, 32, 5000


def of_one(orbits: Orbits) -> bytes:
    """Ball and table of the only start over the periods asked for, 40 at most, as SVG."""
    periods = max(1, min(MOST_PERIODS, orbits.goal.steps))
    return svg(against_time(orbits.scene, periods), "orbit")


def of_many(arrays: Mapping[str, Column]) -> bytes:
    """Where orbits stand, or all that was kept of them, as SVG; from the arrays of `as_arrays`."""
    return svg(in_the_plane(arrays), "orbits")


def spaced(low: float, high: float) -> list[float]:
    """Round numbers within these ends, three to eight of them.

    >>> spaced(0, 40), spaced(-0.2, 0.9)
    ([0.0, 10.0, 20.0, 30.0, 40.0], [-0.2, 0.0, 0.2, 0.4, 0.6, 0.8])
    """
    power = floor(log10(high - low)) - 1
    step = (
        next(part for part in (1, 2, 5, 10, 20) if (high - low) / (part * 10.0**power) <= 7)
        * 10.0**power
    )
    return [
        round(k * step, max(0, -power))
        for k in range(ceil(low / step - 1e-9), floor(high / step + 1e-9) + 1)
    ]


@styled
def against_time(scene: Scene, periods: int) -> Figure:
    """Heights in units of r T against time in periods."""
    units = Scene(scene.alpha, Fraction(1), Fraction(2), scene.starts)  # in which r T = T = 1
    path = heights(units, [Fraction(k, A_PERIOD) for k in range(periods * A_PERIOD + 1)])
    top = 1.05 * max(max(float(one.ball) for one in path), 0.25)
    figure = blank(6.4, 3.2)
    plane = Plane(figure, (0.1, 0.16, 0.87, 0.8), (0, periods), (-0.02 * top, top))
    plane.frame(
        ticks(spaced(0, periods)),
        ticks(spaced(0, top)),
        r"$t\,/\,T$",
        r"height$\,/\,(\dot\rho_0 T)$",
        26,
    )
    times = [float(one.time) for one in path]
    for name, values, look in (
        ("table", [float(one.table) for one in path], None),
        ("ball", [float(one.ball) for one in path], B1),
    ):
        points = list(zip(times, values))
        plane.line([straight(a, b) for a, b in zip(points, points[1:])], name, look, linewidth=1.2)
    return figure


@styled
def in_the_plane(arrays: Mapping[str, Column]) -> Figure:
    """The states in normal form, undecided ones with a cross; 5000 at most, taken evenly;
    SceneError where there are none.
    """
    xs, ws = arrays["x"], arrays["w"]
    undecided = np.broadcast_to(
        (arrays["end"] == ENDS.index("undecided")).reshape(-1, *[1] * (xs.ndim - 1)), xs.shape
    )
    finite = np.flatnonzero(np.abs(xs) + np.abs(ws) < 1e300)
    drawn = np.unravel_index(finite[:: -(-len(finite) // MOST_DOTS) or 1], xs.shape)
    states = [
        (float(x), float(w), bool(odd)) for x, w, odd in zip(xs[drawn], ws[drawn], undecided[drawn])
    ]
    if not states:
        raise SceneError("no state is near enough to be drawn; choose a table instead")
    known = [(x, w) for x, w, _ in states]
    figure = blank(5.2, 4.4)
    lows, highs = ([pick(one[place] for one in known) for place in (0, 1)] for pick in (min, max))
    rooms = [0.05 * (high - low) or 0.5 for low, high in zip(lows, highs)]
    across, up = ((low - room, high + room) for low, high, room in zip(lows, highs, rooms))
    plane = Plane(figure, (0.13, 0.13, 0.84, 0.84), across, up)
    plane.frame(ticks(spaced(*across)), ticks(spaced(*up)), r"$x$", r"$w$", 30)
    for odd, name, size, marker in ((False, "states", 1.6, "o"), (True, "undecided", 4.0, "x")):
        some = [(x, w) for x, w, one in states if one is odd]
        if some:
            plane.dots(some, name, size, marker)
    return figure
