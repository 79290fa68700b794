"""The motion between samples: heights of ball and table at any times, exactly, by the flights,
impacts and parabolas that the map is derived from.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from typing import NamedTuple

from scenes.errors import SceneError
from scenes.juggler.exact import flight, flight_length, impact
from scenes.juggler.formulas import Compiled, compiled, formulas
from scenes.juggler.given import Number, brief, counted, rational
from scenes.juggler.setting import Scene
from symbolic import ball_after_collision, collision_time, fly, period, state, table_at
from symbolic.symbols import alpha, beta, r, t, v

MOST_IMPACTS = 10**4  # before the last of the times
MOST_TIMES = 10**6


class Heights(NamedTuple):
    """At a time: the heights of ball and table."""

    time: Fraction
    ball: Fraction
    table: Fraction


@cache
def _formulas() -> tuple[Compiled, Compiled, Compiled, Compiled, Compiled]:
    """Period, time of collision, height of the table, of the ball before and after the collision,
    in the paper's units.
    """
    after = fly(ball_after_collision(), t - collision_time())
    return (
        compiled("period", "r g", period(), first=r),
        compiled("collision_time", "beta v r g", collision_time(), first=beta),
        compiled("table", "t r g", table_at()[0], first=t),
        compiled("before", "t beta v r g", fly(state(beta, v), t)[0], first=t),
        compiled("after", "t alpha beta v r g", after[0], first=alpha),
    )


def heights(scene: Scene, times: Sequence[Number], index: int = 0) -> list[Heights]:
    """The heights of ball and table at times >= 0, in the units of r and g, for the start of this
    number.

    The table is at its lowest at time 0, as at every sample.  Source: (1), the table's launch of
    section 3.1, (6) and (8).

    >>> from scenes.juggler import point, scene
    >>> path = heights(scene("1/3", point(0, 3), r=1, g=2), (0, "1/2", 1, "3/2", 2))
    >>> [str(one.ball) for one in path]
    ['0', '3/4', '1', '3/4', '0']
    """
    length, struck_at, table, before, after = _formulas()
    whole = length(scene.r, scene.g)
    if isinstance(times, str) or not hasattr(times, "__len__") or len(times) > MOST_TIMES:
        raise SceneError(f"times are to be a list of at most {MOST_TIMES} numbers >= 0")
    asked = sorted({_time(one) for one in times})
    x, w = scene.starts.exact(counted(index, "index", 0, scene.starts.count - 1))
    found: dict[Fraction, Heights] = {}
    passed, struck = 0, 0
    for time in asked:
        now = int(time / whole // 1)
        while passed < now:
            free = min(flight_length(x, w), now - passed)
            if free:
                passed, (x, w) = passed + free, flight(x, w, free)
            else:
                passed, (x, w), struck = passed + 1, impact(scene.alpha, x, w), struck + 1
                if struck > MOST_IMPACTS:
                    raise SceneError(
                        f"time {brief(time)} comes after more than {MOST_IMPACTS} impacts; choose"
                        " an earlier one"
                    )
        height, speed = formulas().unscaled(x, w, scene.r, scene.g)
        within = time - now * whole
        hit = formulas().margin(x, w) > 0 and within > struck_at(height, speed, scene.r, scene.g)
        ball = (
            after(within, scene.alpha, height, speed, scene.r, scene.g)
            if hit
            else before(within, height, speed, scene.r, scene.g)
        )
        found[time] = Heights(time, ball, table(within, scene.r, scene.g))
    return [found[_time(one)] for one in times]


def _time(value: Number) -> Fraction:
    time = rational(value, "time")
    if time < 0:
        raise SceneError(f"time = {brief(time)} is before the start; times are >= 0")
    return time
