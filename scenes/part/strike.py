"""What happens where corners meet the table: impacts, one after another, until no corner that
touches approaches; then how the block goes on.

The corner that approaches fastest is struck first.  Where two approach alike, as when a face lands
flat, one impulse acts midway between them, so that the mirror image of an orbit is an orbit.  A
corner slower than the rest speed v is struck without restitution and stays.  A face whose two
corners are slower than v comes to lie: turning and closing are taken away, and sliding if it is
slower than v, at most v^2 (2 + k^2/w^2)/2 of kinetic energy, w half its length; none is added.
Coming to rest moves a corner by at most two tolerances.
"""

from __future__ import annotations

from math import cos, floor, sin, sqrt

from scenes.part.body import (
    CLOSINGS,
    CONES,
    CORNER,
    DONE,
    FACE,
    FLIGHT,
    FRICTION,
    GAINS,
    GYRATION,
    HALF_LONG,
    HALF_SHORT,
    IMPACTS,
    JAMMED,
    LARGEST_REMOVED,
    MODE,
    OMEGA,
    PIVOT,
    PULLS,
    QUARTER,
    REST_SPEED,
    RESTITUTION,
    SLIDE,
    THETA,
    TIME,
    TOLERANCE,
    TOO_MANY_IMPACTS,
    V_X,
    V_Y,
    Floats,
    G,
    Y,
    corner_x,
    corner_y,
    table_glide,
    table_height,
    table_lift,
    table_rise,
)
from scenes.part.compiling import compiled
from scenes.part.contact import first_turn, hold
from scenes.part.impact import JAMMING, first_slide, impulse, mode_of

MOST_IMPACTS = 10_000  # at one time
STILL = 1e-12  # metres a second: closing speeds below are rounding
SLACK, ROUNDING = (
    1e-12,
    1e-14,
)  # relative rounding that the guarantees are counted with, and that of a difference of speeds


@compiled
def energy(p: Floats, z: Floats, glide: float, rise: float) -> float:
    """The kinetic energy in the table's frame, per unit of mass."""
    across, up = z[V_X] - glide, z[V_Y] - rise
    return (across * across + up * up + p[GYRATION] * z[OMEGA] * z[OMEGA]) / 2


@compiled
def strike_at(
    p: Floats, z: Floats, x: float, y: float, glide: float, rise: float, notes: Floats
) -> int:
    """One impact at a place of the block; DONE, or JAMMED.  Counts what the impact law excludes: it
    must stay 0.
    """
    k2, mu = p[GYRATION], p[FRICTION]
    S0, C0 = z[V_X] - z[OMEGA] * y - glide, z[V_Y] + z[OMEGA] * x - rise
    B1, B2, B3 = 1 + y * y / k2, 1 + x * x / k2, x * y / k2
    e = p[RESTITUTION] if -C0 >= p[REST_SPEED] else 0.0
    sigma = first_slide(S0, B1, B3, mu)
    mode = mode_of(S0, C0, B1, B2, B3, e, mu, sigma)
    if mode == JAMMING:
        return JAMMED
    before, terms = (
        energy(p, z, glide, rise),
        abs(S0) - C0 + abs(rise) + abs(z[V_Y]) + abs(z[OMEGA] * x),
    )
    rounded = ROUNDING * (abs(z[V_X]) + abs(glide) + abs(z[V_Y]) + abs(rise)) * sqrt(before)
    P_x, P_y = impulse(mode, S0, C0, B1, B2, B3, e, mu, sigma)
    z[V_X] += P_x
    z[V_Y] += P_y
    z[OMEGA] += (x * P_y - y * P_x) / k2
    notes[IMPACTS] += 1
    notes[PULLS] += P_y < 0
    notes[CONES] += abs(P_x) > mu * P_y + SLACK * (abs(P_x) + P_y)
    notes[GAINS] += energy(p, z, glide, rise) - before > SLACK * before + rounded
    notes[CLOSINGS] += z[V_Y] + z[OMEGA] * x - rise < -SLACK * terms
    return DONE


@compiled
def strike(p: Floats, z: Floats, notes: Floats) -> int:
    """Impacts at all corners that touch, until none approaches; then flight, a pivot or a face at
    rest.  DONE, or why it gave up.
    """
    t, theta = z[TIME], z[THETA]
    c, s = cos(theta), sin(theta)
    glide, rise = table_glide(p, t), table_rise(p, t)
    level, touch = table_height(p, t), 2 * p[TOLERANCE]
    carried = p[G] + table_lift(p, t) > 0
    for _ in range(MOST_IMPACTS):
        touching, slow, resting = 0, 0, -1
        fastest, first, second, lowest = -STILL, -1, -1, 2 * touch
        for i in range(4):
            gap = z[Y] + corner_y(p, i, c, s) - level
            if gap > touch:
                continue
            C = z[V_Y] + z[OMEGA] * corner_x(p, i, c, s) - rise
            touching += 1
            slow += abs(C) < p[REST_SPEED]
            if abs(C) <= STILL and gap < lowest:
                resting, lowest = i, gap
            if C < fastest:
                fastest, first, second = C, i, -1
            elif C == fastest:
                second = i
        if touching == 2 and slow == 2 and carried:
            lie_down(p, z, t, level, rise, notes)
            return DONE
        if first < 0:
            z[MODE] = FLIGHT
            if resting >= 0:
                stay(p, z, resting)
                if z[MODE] == FLIGHT:
                    z[Y] += max(
                        -p[TOLERANCE] / 2 - lowest, 0.0
                    )  # a corner without speed, any deeper, would end the next flight at once
            return DONE
        x, y = corner_x(p, first, c, s), corner_y(p, first, c, s)
        if second >= 0:
            x, y = (x + corner_x(p, second, c, s)) / 2, (y + corner_y(p, second, c, s)) / 2
        if strike_at(p, z, x, y, glide, rise, notes) == JAMMED:
            return JAMMED
    return TOO_MANY_IMPACTS


@compiled
def lie_down(p: Floats, z: Floats, t: float, level: float, rise: float, notes: Floats) -> None:
    """Lays a face on the table: it turns no more, and goes up and down with the table."""
    turns = floor(z[THETA] / QUARTER + 0.5)
    glide = table_glide(p, t)
    before = energy(p, z, glide, rise)
    if abs(z[V_X] - glide) < p[REST_SPEED]:
        z[V_X] = glide
    z[THETA], z[OMEGA], z[V_Y] = turns * QUARTER, 0.0, rise
    z[Y] = level + (p[HALF_LONG] if turns % 2 == 0 else p[HALF_SHORT])
    z[MODE], z[CORNER] = FACE, turns
    z[SLIDE] = slide_of(z[V_X] - glide)
    notes[LARGEST_REMOVED] = max(notes[LARGEST_REMOVED], before - energy(p, z, glide, rise))


@compiled
def slide_of(S: float) -> float:
    """The direction of sliding: 1, -1, or 0 where it is but rounding."""
    return 1.0 if S > STILL else -1.0 if S < -STILL else 0.0


@compiled
def stay(p: Floats, z: Floats, i: int) -> None:
    """Corner i, which touches and does not close, stays on the table where a force holds it there;
    else the block flies.
    """
    turn = first_turn(i, z[THETA])
    z[THETA] = min(
        max(z[THETA], turn * QUARTER), (turn + 1) * QUARTER
    )  # two corners touch, and this one is not quite the lowest
    t, theta, omega = z[TIME], z[THETA], z[OMEGA]
    slide = slide_of(z[V_X] - omega * corner_y(p, i, cos(theta), sin(theta)) - table_glide(p, t))
    along, normal, _ = hold(p, t, theta, omega, i, slide)
    if slide == 0 and abs(along) > p[FRICTION] * normal:
        slide = -1.0 if along > 0 else 1.0
        along, normal, _ = hold(p, t, theta, omega, i, slide)
    if normal > 0:
        z[MODE], z[CORNER], z[SLIDE] = PIVOT, i, slide
    else:
        z[MODE] = FLIGHT
