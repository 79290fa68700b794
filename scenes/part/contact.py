"""What holds a block that stays on the table: the force at one corner, which sticks or slides, and
when it lets go.

The corner's acceleration is (B1 F - B3 N - omega^2 x, B2 N - B3 F - g - omega^2 y), as impulses
change its velocity (`symbolic.contact`); the table's is subtracted.  SLIDE of a state is the
direction of sliding, 0 where the corner or face sticks; CORNER the corner, or the number of quarter
turns of the face.
"""

from __future__ import annotations

from math import cos, floor, sin

from scenes.part.body import (
    FRICTION,
    GYRATION,
    QUARTER,
    Floats,
    G,
    corner_x,
    corner_y,
    table_lift,
    table_push,
)
from scenes.part.compiling import compiled


@compiled
def hold(
    p: Floats, t: float, theta: float, omega: float, i: int, slide: float
) -> tuple[float, float, float]:
    """The force (F, N) per unit of mass at corner i that keeps it on the table, sliding in the
    direction `slide`, or sticking where that is 0.

    Third, the angular acceleration by this force.
    """
    c, s = cos(theta), sin(theta)
    x, y = corner_x(p, i, c, s), corner_y(p, i, c, s)
    k2 = p[GYRATION]
    B1, B2, B3 = 1 + y * y / k2, 1 + x * x / k2, x * y / k2
    down = p[G] + omega * omega * y + table_lift(p, t)
    if slide != 0:
        normal = down / (B2 + slide * p[FRICTION] * B3)
        along = -slide * p[FRICTION] * normal
    else:
        across = omega * omega * x + table_push(p, t)
        full = B1 * B2 - B3 * B3
        along, normal = (B2 * across + B3 * down) / full, (B1 * down + B3 * across) / full
    return along, normal, (x * normal - y * along) / k2


@compiled
def first_turn(i: int, theta: float) -> float:
    """The number of quarter turns, near theta, from which on corner i is the lowest, for one
    quarter turn.
    """
    start = (4 - i) % 4
    return start + 4 * floor((theta - QUARTER * start - QUARTER / 2) / (4 * QUARTER) + 0.5)
