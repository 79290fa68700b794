"""A block that pivots on one corner, which sticks or slides: steps in (X, V_X, theta, omega), from
one phase to the next.

Height and vertical speed follow from the corner's height over the table, which stays what it was,
at most two tolerances: to put it at 0 could add energy, and keep a block that rattles from coming
to rest.  What ends a phase (the table falls away, friction fails, sliding stops, the next corner
comes down) is looked for at the end of every step and then bracketed.
"""

from __future__ import annotations

from math import cos, sin

from scenes.part.body import (
    CONTACTS,
    CORNER,
    DONE,
    FLIGHT,
    FRICTION,
    MODE,
    NO_PROGRESS,
    OMEGA,
    QUARTER,
    SLIDE,
    STEP,
    THETA,
    TIME,
    TOLERANCE,
    V_X,
    V_Y,
    Floats,
    X,
    Y,
    corner_x,
    corner_y,
    table_glide,
    table_height,
    table_rise,
)
from scenes.part.compiling import compiled
from scenes.part.contact import first_turn, hold
from scenes.part.ending import LANDS, LASTS, LETS_GO, SLIPS, STOPS, end_of, ending, pace, pivoted
from scenes.part.strike import strike
from scenes.part.turns import note_turn

MOST_STEPS = 1_000_000  # of one pivot
LEAST_STEP = 1e-10  # seconds: how long a phase lasts that would end at once


@compiled
def pivot(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves a pivoting block on until it leaves its corner or the next one strikes, or to the time
    `until`.
    """
    i, slide = int(z[CORNER]), z[SLIDE]
    t, x, vx, theta, omega = z[TIME], z[X], z[V_X], z[THETA], z[OMEGA]
    turn = first_turn(i, theta)
    gap = z[Y] + corner_y(p, i, cos(theta), sin(theta)) - table_height(p, t)
    ended, code = LASTS, NO_PROGRESS
    notes[CONTACTS] += 1
    for _ in range(MOST_STEPS):
        h = min(p[STEP] * pace(p, theta, i, slide), until - t)
        x2, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, h)
        ended = ending(p, t + h, vx2, theta2, omega2, i, slide, turn)
        if ended != LASTS:
            early, late, ended = end_of(p, t, x, vx, theta, omega, i, slide, turn, h, ended)
            if ended == LANDS or ended == LETS_GO:
                h = late
            else:
                h = max(early, min(h, LEAST_STEP))
            x2, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, h)
        if ended == LANDS:
            theta2 = (turn if theta2 < (turn + 0.5) * QUARTER else turn + 1) * QUARTER
        note_turn(p, notes, t, theta, t + h, theta2)
        t, x, vx, theta, omega = min(t + h, until), x2, vx2, theta2, omega2
        if ended == STOPS:
            vx = omega * corner_y(p, i, cos(theta), sin(theta)) + table_glide(p, t)
            slide = 0.0
            along, normal, _ = hold(p, t, theta, omega, i, 0.0)
            if abs(along) > p[FRICTION] * normal:
                ended = SLIPS
        if ended == SLIPS:
            along, normal, _ = hold(p, t, theta, omega, i, 0.0)
            slide = -1.0 if along > 0 else 1.0
            along, normal, _ = hold(p, t, theta, omega, i, slide)
            if normal <= 0:
                ended = LETS_GO
        if ended == LETS_GO or ended == LANDS or t >= until:
            code = DONE
            break
    if ended == LETS_GO:
        gap = max(gap, -p[TOLERANCE] / 2)  # see `strike`
    c, s = cos(theta), sin(theta)
    z[TIME], z[X], z[V_X], z[THETA], z[OMEGA] = t, x, vx, theta, omega
    z[Y], z[V_Y] = (
        table_height(p, t) + gap - corner_y(p, i, c, s),
        table_rise(p, t) - omega * corner_x(p, i, c, s),
    )
    z[SLIDE] = slide
    if ended == LETS_GO or ended == LANDS:
        z[MODE] = FLIGHT
    return strike(p, z, notes) if ended == LANDS else code
