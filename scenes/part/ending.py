"""The steps of a block that pivots on one corner, and the moment at which its phase ends: by Runge
and Kutta, and by a safeguarded secant.

A phase ends where a margin falls to 0: the angle to the table of the next corner, the normal force,
the friction left, the speed of sliding.
"""

from __future__ import annotations

from math import cos, sin

from scenes.part.body import (
    FRICTION,
    GYRATION,
    QUARTER,
    Floats,
    corner_x,
    corner_y,
    table_glide,
    table_place,
)
from scenes.part.compiling import compiled
from scenes.part.contact import hold

Moved = tuple[float, float, float, float]  # X, V_X, theta, omega

LASTS, LETS_GO, SLIPS, STOPS, LANDS = range(5)
NEAR = 1e-13  # seconds: to what the end of a phase is found
MOST_GUESSES = 200
FLAT = 1e-14  # radians


@compiled
def pivoted(
    p: Floats,
    t: float,
    x: float,
    vx: float,
    theta: float,
    omega: float,
    i: int,
    slide: float,
    h: float,
) -> Moved:
    """(X, V_X, theta, omega) after a step of h, of fourth order."""
    f1, _, a1 = hold(p, t, theta, omega, i, slide)
    theta2, omega2 = theta + h / 2 * omega, omega + h / 2 * a1
    f2, _, a2 = hold(p, t + h / 2, theta2, omega2, i, slide)
    theta3, omega3 = theta + h / 2 * omega2, omega + h / 2 * a2
    f3, _, a3 = hold(p, t + h / 2, theta3, omega3, i, slide)
    theta4, omega4 = theta + h * omega3, omega + h * a3
    f4, _, a4 = hold(p, t + h, theta4, omega4, i, slide)
    after = theta + h * (omega + h / 6 * (a1 + a2 + a3))
    spin = omega + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
    if slide != 0:
        return (
            x + h * (vx + h / 6 * (f1 + f2 + f3)),
            vx + h / 6 * (f1 + 2 * f2 + 2 * f3 + f4),
            after,
            spin,
        )
    c, s = cos(after), sin(after)
    foot = (
        x + corner_x(p, i, cos(theta), sin(theta)) - table_place(p, t)
    )  # where the corner sticks on the table
    return (
        foot + table_place(p, t + h) - corner_x(p, i, c, s),
        table_glide(p, t + h) + spin * corner_y(p, i, c, s),
        after,
        spin,
    )


@compiled
def pace(p: Floats, theta: float, i: int, slide: float) -> float:
    """The part of the usual step that is right here: near jamming the force at a sliding corner
    changes as fast as 1/(B2 +- mu B3) is large.
    """
    if slide == 0:
        return 1.0
    c, s = cos(theta), sin(theta)
    x, y = corner_x(p, i, c, s), corner_y(p, i, c, s)
    return min(1.0, 1 + x * (x + slide * p[FRICTION] * y) / p[GYRATION])


@compiled
def margin(
    p: Floats,
    ended: int,
    t: float,
    vx: float,
    theta: float,
    omega: float,
    i: int,
    slide: float,
    turn: float,
) -> float:
    """How far a phase is from ending in this way; `turn` is the number of quarter turns from which
    on corner i is the lowest.
    """
    if ended == LANDS:
        return min(theta - turn * QUARTER, (turn + 1) * QUARTER - theta) + FLAT
    if ended == STOPS:
        return slide * (vx - omega * corner_y(p, i, cos(theta), sin(theta)) - table_glide(p, t))
    along, normal, _ = hold(p, t, theta, omega, i, slide)
    return normal if ended == LETS_GO else p[FRICTION] * normal - abs(along)


@compiled
def ending(
    p: Floats, t: float, vx: float, theta: float, omega: float, i: int, slide: float, turn: float
) -> int:
    """What no longer holds of the phase: LASTS where everything does."""
    if margin(p, LANDS, t, vx, theta, omega, i, slide, turn) < 0:
        return LANDS
    if margin(p, LETS_GO, t, vx, theta, omega, i, slide, turn) <= 0:
        return LETS_GO
    last = SLIPS if slide == 0 else STOPS
    return last if margin(p, last, t, vx, theta, omega, i, slide, turn) < 0 else LASTS


@compiled
def end_of(
    p: Floats,
    t: float,
    x: float,
    vx: float,
    theta: float,
    omega: float,
    i: int,
    slide: float,
    turn: float,
    h: float,
    ended: int,
) -> tuple[float, float, int]:
    """Two lengths of a step, NEAR apart, between which the phase first ends, the first 0 where it
    ends at once; and how it ends.

    Of a step of h, after which it has ended.  Guesses by the Illinois method; halves instead where
    the bracket is longer than a third as many halvings would have left it.
    """
    early, late, allowed, side = 0.0, h, 8 * h, 0
    above = margin(p, ended, t, vx, theta, omega, i, slide, turn)
    _, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, late)
    below = margin(p, ended, t + late, vx2, theta2, omega2, i, slide, turn)
    for _ in range(MOST_GUESSES):
        if late - early <= NEAR:
            break
        guess = (early + late) / 2
        if above > 0 and below < 0 and late - early < allowed:
            secant = late - below * (late - early) / (below - above)
            guess = min(max(secant, early + NEAR / 2), late - NEAR / 2)
        allowed *= 0.8
        _, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, guess)
        found = ending(p, t + guess, vx2, theta2, omega2, i, slide, turn)
        if found == LASTS:
            early, above = guess, margin(p, ended, t + guess, vx2, theta2, omega2, i, slide, turn)
            below = below / 2 if side > 0 else below
            side = 1
            continue
        late, below = guess, margin(p, found, t + guess, vx2, theta2, omega2, i, slide, turn)
        above = above / 2 if side < 0 else above
        side = -1
        if found != ended:
            ended, side = found, 0
            _, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, early)
            above = margin(p, ended, t + early, vx2, theta2, omega2, i, slide, turn)
    return early, late, ended
