"""A block that pivots on one corner, which sticks or slides: Runge and Kutta's steps of fourth order in (X, V_X, theta, omega).

Height and vertical speed follow from the corner's place on the table.  What ends a phase (the table falls away, friction fails, sliding stops, the
next corner comes down) is looked for at the end of every step and then bracketed.
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
    V_X,
    V_Y,
    Floats,
    X,
    Y,
    corner_x,
    corner_y,
    table_glide,
    table_height,
    table_place,
    table_rise,
)
from scenes.part.compiling import compiled
from scenes.part.contact import first_turn, hold, turning
from scenes.part.strike import strike
from scenes.part.turns import note_turn

Moved = tuple[float, float, float, float]  # X, V_X, theta, omega

LASTS, LETS_GO, SLIPS, STOPS, LANDS = range(5)
MOST_STEPS = 1_000_000  # of one pivot
LEAST_STEP = 1e-10  # seconds
BISECTIONS = 36
FLAT = 1e-14  # radians


@compiled
def pivoted(p: Floats, t: float, x: float, vx: float, theta: float, omega: float, i: int, slide: float, h: float) -> Moved:
    """(X, V_X, theta, omega) after a step of h."""
    f1, n1 = hold(p, t, theta, omega, i, slide)
    a1 = turning(p, theta, i, f1, n1)
    theta2, omega2 = theta + h / 2 * omega, omega + h / 2 * a1
    f2, n2 = hold(p, t + h / 2, theta2, omega2, i, slide)
    a2 = turning(p, theta2, i, f2, n2)
    theta3, omega3 = theta + h / 2 * omega2, omega + h / 2 * a2
    f3, n3 = hold(p, t + h / 2, theta3, omega3, i, slide)
    a3 = turning(p, theta3, i, f3, n3)
    theta4, omega4 = theta + h * omega3, omega + h * a3
    f4, n4 = hold(p, t + h, theta4, omega4, i, slide)
    a4 = turning(p, theta4, i, f4, n4)
    after = theta + h * (omega + h / 6 * (a1 + a2 + a3))
    spin = omega + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
    if slide != 0:
        return x + h * (vx + h / 6 * (f1 + f2 + f3)), vx + h / 6 * (f1 + 2 * f2 + 2 * f3 + f4), after, spin
    c, s = cos(after), sin(after)
    foot = x + corner_x(p, i, cos(theta), sin(theta)) - table_place(p, t)  # where the corner sticks on the table
    return foot + table_place(p, t + h) - corner_x(p, i, c, s), table_glide(p, t + h) + spin * corner_y(p, i, c, s), after, spin


@compiled
def ending(p: Floats, t: float, vx: float, theta: float, omega: float, i: int, slide: float, turn: float) -> int:
    """What no longer holds of the phase: LASTS where everything does."""
    if theta < turn * QUARTER - FLAT or theta > (turn + 1) * QUARTER + FLAT:
        return LANDS
    along, normal = hold(p, t, theta, omega, i, slide)
    if normal <= 0:
        return LETS_GO
    if slide == 0:
        return SLIPS if abs(along) > p[FRICTION] * normal else LASTS
    S = vx - omega * corner_y(p, i, cos(theta), sin(theta)) - table_glide(p, t)
    return STOPS if slide * S < 0 else LASTS


@compiled
def pivot(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves a pivoting block on until it leaves its corner or the next one strikes, or to the time `until`."""
    i, slide = int(z[CORNER]), z[SLIDE]
    t, x, vx, theta, omega = z[TIME], z[X], z[V_X], z[THETA], z[OMEGA]
    turn = first_turn(i, theta)
    ended, code = LASTS, NO_PROGRESS
    notes[CONTACTS] += 1
    for _ in range(MOST_STEPS):
        h = min(p[STEP], until - t)
        x2, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, h)
        ended = ending(p, t + h, vx2, theta2, omega2, i, slide, turn)
        if ended != LASTS:
            early, late = 0.0, h
            for _ in range(BISECTIONS):
                h = (early + late) / 2
                x3, vx3, theta3, omega3 = pivoted(p, t, x, vx, theta, omega, i, slide, h)
                found = ending(p, t + h, vx3, theta3, omega3, i, slide, turn)
                if found == LASTS:
                    early, x2, vx2, theta2, omega2 = h, x3, vx3, theta3, omega3
                else:
                    late, ended = h, found
                    if early == 0:
                        x2, vx2, theta2, omega2 = x3, vx3, theta3, omega3
                if late - early < LEAST_STEP * (1 if early == 0 else 1e-3):
                    break
            h = early if early > 0 else late
            if ended == LETS_GO:
                h = late
                x2, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, h)
        note_turn(p, notes, t, theta, t + h, theta2)
        t, x, vx, theta, omega = t + h, x2, vx2, theta2, omega2
        if ended == STOPS:
            vx = omega * corner_y(p, i, cos(theta), sin(theta)) + table_glide(p, t)
            slide = 0.0
            along, normal = hold(p, t, theta, omega, i, 0.0)
            if abs(along) > p[FRICTION] * normal:
                ended = SLIPS
        if ended == SLIPS:
            along, normal = hold(p, t, theta, omega, i, 0.0)
            slide = -1.0 if along > 0 else 1.0
            along, normal = hold(p, t, theta, omega, i, slide)
            if normal <= 0:
                ended = LETS_GO
        if ended == LETS_GO or ended == LANDS or t >= until:
            code = DONE
            break
    c, s = cos(theta), sin(theta)
    z[TIME], z[X], z[V_X], z[THETA], z[OMEGA] = t, x, vx, theta, omega
    z[Y], z[V_Y] = table_height(p, t) - corner_y(p, i, c, s), table_rise(p, t) - omega * corner_x(p, i, c, s)
    z[SLIDE] = slide
    if ended == LETS_GO or ended == LANDS:
        z[MODE] = FLIGHT
    return strike(p, z, notes) if ended == LANDS else code
