"""Impacts of corners, and the forces that hold a block on the table."""

from __future__ import annotations

from math import cos, sin, sqrt

from juggleproof.scenes.part.body import (
    CHECKED,
    CLOSINGS,
    CONES,
    CORNER,
    CORNER_Y,
    DONE,
    EDGE_X,
    EDGE_Y,
    EDGES,
    FACE,
    FLIGHT,
    FRICTION,
    GAINS,
    GYRATION,
    IMPACTS,
    JAMMED,
    LARGEST_REMOVED,
    MODE,
    MOMENT,
    OMEGA,
    PIVOT,
    PULLS,
    REACH,
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
    compiled,
    corner_x,
    corner_y,
    face_angle,
    first_angle,
    flat_angle,
    inlined,
    last_corner,
    lowest,
    next_corner,
    table_glide,
    table_height,
    table_lift,
    table_push,
    table_rise,
)

# -------------------------------------------------------------------------------------------------
# One corner.
#
# Wang and Mason's five contact modes (1992) with Poisson's restitution, as
# `juggleproof.symbolic.corner_impact` derives them.
#
# The formulas stand here once more so that they can be compiled; a test compares them, exactly,
# with the derived ones in every mode.

(
    SLIDING,
    STICKING_IN_COMPRESSION,
    STICKING_IN_RESTITUTION,
    REVERSED_IN_COMPRESSION,
    REVERSED_IN_RESTITUTION,
) = range(5)
JAMMING = -1


@inlined
def mode_of(
    S0: float, C0: float, B1: float, B2: float, B3: float, e: float, mu: float, sigma: int
) -> int:
    """The mode of an impact in which the corner slides in the direction sigma at first; C0 < 0.  It
    is JAMMING if friction keeps the corner from leaving.

    P_d and P_q are the closing rate times sigma S0, and the stopping rate times -C0.
    """
    closing, stopping = B2 + sigma * mu * B3, mu * B1 + sigma * B3
    if closing <= 0:
        return JAMMING
    P_d, P_q = closing * (sigma * S0), stopping * -C0
    if P_d >= (1 + e) * P_q:
        return SLIDING
    holds = mu * B1 >= abs(B3)
    if P_d <= P_q:
        return STICKING_IN_COMPRESSION if holds else REVERSED_IN_COMPRESSION
    return STICKING_IN_RESTITUTION if holds else REVERSED_IN_RESTITUTION


@inlined
def first_slide(S0: float, B1: float, B3: float, mu: float) -> int:
    """The direction in which the corner slides at first, 1 or -1; where S0 = 0, the one in which
    friction fails to hold it.
    """
    if S0 > 0 or S0 == 0 and B3 < 0:
        return 1
    return -1


@inlined
def impulse(
    mode: int,
    S0: float,
    C0: float,
    B1: float,
    B2: float,
    B3: float,
    e: float,
    mu: float,
    sigma: int,
) -> tuple[float, float]:
    """The impulse (P_x, P_y) at the corner, per unit of mass (m/s), in a mode of `mode_of`."""
    if mode == STICKING_IN_COMPRESSION:
        P_y = (1 + e) * -(B1 * C0 + B3 * S0) / (B1 * B2 - B3 * B3)
    elif mode == REVERSED_IN_COMPRESSION:
        P_y = (
            (1 + e)
            * -(C0 + 2 * sigma * mu * B3 * S0 / (B3 + sigma * mu * B1))
            / (B2 - sigma * mu * B3)
        )
    else:
        P_y = (1 + e) * -C0 / (B2 + sigma * mu * B3)
    if mode == SLIDING:
        return -sigma * mu * P_y, P_y
    if mode == STICKING_IN_COMPRESSION or mode == STICKING_IN_RESTITUTION:
        return (B3 * P_y - S0) / B1, P_y
    return sigma * mu * (P_y - 2 * S0 / (B3 + sigma * mu * B1)), P_y


# -------------------------------------------------------------------------------------------------
# Holding forces.
#
# What holds a block that stays on the table: the force at one corner, which sticks or slides, and
# when it lets go.
#
# The corner's acceleration is (B1 F - B3 N + drag - omega^2 x, B2 N - B3 F - g - omega^2 y), as
# impulses change its velocity (`juggleproof.symbolic.corner_impact`); the table's is subtracted.
# SLIDE of a state is the direction of sliding, 0 where the corner or face sticks; CORNER the
# corner, or the edge that lies on the table; in flight the one that was the lowest.


@compiled
def hold(
    p: Floats, t: float, theta: float, omega: float, i: int, slide: float
) -> tuple[float, float, float]:
    """The force (F, N) per unit of mass (m/s^2) at corner i that keeps it on the table, sliding in
    the direction `slide`, or sticking where that is 0; third, the angular acceleration by this
    force (rad/s^2).
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


# -------------------------------------------------------------------------------------------------
# Corners that meet the table.
#
# Impacts, one after another, until no corner that touches approaches; then how the block goes on.
#
# The corner that approaches fastest is struck first.  Where two approach alike, as when a face
# lands flat, one impulse acts midway between them, so that the mirror image of an orbit is an
# orbit.  A corner slower than the rest speed v is struck without restitution and stays.  A face
# whose two corners are slower than v comes to lie: turning and closing are taken away, and sliding
# if it is slower than v.  This takes at most v^2 (2 + k^2/w^2)/2 of kinetic energy, w half the
# face's length, if the centre is above the face, and adds none.  Coming to rest moves a corner by
# at most two tolerances.

MOST_IMPACTS = 10_000  # at one time
ROUNDED_HOP = 1e-7  # of the speed of a corner that turns: its hops are lost in rounding
STILL = 1e-12  # metres a second: closing speeds below are rounding
ROUNDED_SPEED = 2e-15  # of all speeds: the same where these are large
# relative rounding that the guarantees are counted with, and that of a difference of speeds
SLACK, ROUNDING = 1e-12, 1e-14


@compiled
def energy(p: Floats, across: float, up: float, omega: float) -> float:
    """The kinetic energy of these speeds in the table's frame, in joules per kilogram."""
    return (across * across + up * up + p[GYRATION] * omega * omega) / 2


@inlined
def rest_speed(p: Floats, omega: float) -> float:
    """The speed (m/s) below which a corner stays: the scene's, or a greater one if the block turns
    so fast that hops would be lost in rounding (see `Scene.least_rest_speed`).
    """
    turning = abs(omega) * p[REACH]
    return max(p[REST_SPEED], turning * max(ROUNDED_HOP, 4 * abs(omega) * MOMENT))


@inlined
def strike_at(
    p: Floats, z: Floats, x: float, y: float, glide: float, rise: float, notes: Floats
) -> int:
    """Carries out one impact at a place of the block; returns DONE, or JAMMED.  Counts what the
    impact law excludes; the count must stay 0.
    """
    k2, mu = p[GYRATION], p[FRICTION]
    S0, C0 = z[V_X] - z[OMEGA] * y - glide, z[V_Y] + z[OMEGA] * x - rise
    B1, B2, B3 = 1 + y * y / k2, 1 + x * x / k2, x * y / k2
    e = p[RESTITUTION] if -C0 >= rest_speed(p, z[OMEGA]) else 0.0
    sigma = first_slide(S0, B1, B3, mu)
    mode = mode_of(S0, C0, B1, B2, B3, e, mu, sigma)
    if mode == JAMMING:
        return JAMMED
    P_x, P_y = impulse(mode, S0, C0, B1, B2, B3, e, mu, sigma)
    across, up, spin = z[V_X] + P_x, z[V_Y] + P_y, z[OMEGA] + (x * P_y - y * P_x) / k2
    notes[IMPACTS] += 1
    if p[CHECKED] != 0:
        before = energy(p, z[V_X] - glide, z[V_Y] - rise, z[OMEGA])
        after = energy(p, across - glide, up - rise, spin)
        terms = abs(S0) - C0 + abs(rise) + abs(z[V_Y]) + abs(z[OMEGA] * x)
        rounded = ROUNDING * (abs(z[V_X]) + abs(glide) + abs(z[V_Y]) + abs(rise)) * sqrt(before)
        notes[PULLS] += P_y < 0
        notes[CONES] += abs(P_x) > mu * P_y + SLACK * (abs(P_x) + P_y)
        notes[GAINS] += after - before > SLACK * before + rounded
        notes[CLOSINGS] += up + spin * x - rise < -SLACK * terms
    z[V_X], z[V_Y], z[OMEGA] = across, up, spin
    return DONE


@compiled
def strike(p: Floats, z: Floats, notes: Floats) -> int:
    """Carries out impacts at all corners that touch, until none approaches; then the block flies,
    pivots, or rests on a face.  Returns DONE, or why it gave up.
    """
    t = z[TIME]
    c, s = cos(z[THETA]), sin(z[THETA])
    return strike_all(p, z, c, s, table_height(p, t), table_rise(p, t), table_lift(p, t), notes)


@inlined
def strike_all(
    p: Floats,
    z: Floats,
    c: float,
    s: float,
    level: float,
    rise: float,
    lift: float,
    notes: Floats,
) -> int:
    """The same, with cosine and sine of theta, and the table's height, its speed and its
    acceleration upwards.

    Two corners may touch: the lowest, and the other end of the face that is nearest to the table.
    """
    t = z[TIME]
    glide, carried, touch = table_glide(p, t), p[G] + lift > 0, 2 * p[TOLERANCE]
    first = lowest(p, int(z[CORNER]), c, s, 0.0)
    second, edge = next_corner(p, first), first
    before = last_corner(p, first)
    y1, y2, y3 = corner_y(p, first, c, s), corner_y(p, second, c, s), corner_y(p, before, c, s)
    if y3 < y2:
        second, edge, y2 = before, before, y3
    x1, x2 = corner_x(p, first, c, s), corner_x(p, second, c, s)
    z[CORNER] = first
    for _ in range(MOST_IMPACTS):
        rest = rest_speed(p, z[OMEGA])
        still = max(STILL, ROUNDED_SPEED * (abs(z[V_Y]) + abs(z[OMEGA]) * p[REACH]))
        gap1, gap2 = z[Y] + y1 - level, z[Y] + y2 - level
        C1, C2 = z[V_Y] + z[OMEGA] * x1 - rise, z[V_Y] + z[OMEGA] * x2 - rise
        near1, near2 = gap1 <= touch, gap2 <= touch
        if near1 and near2 and carried and abs(C1) < rest and abs(C2) < rest:
            lie_down(p, z, edge, level, rise, notes)
            return DONE
        closing1, closing2 = near1 and C1 < -still, near2 and C2 < -still
        if not closing1 and not closing2:
            z[MODE] = FLIGHT
            still1, still2 = near1 and abs(C1) <= still, near2 and abs(C2) <= still
            if still1 or still2:
                nearer = still1 and (not still2 or gap1 <= gap2)
                stay(p, z, first if nearer else second)
                if z[MODE] == FLIGHT:
                    # a corner without speed that is deeper would end the next flight at once
                    z[Y] += max(-p[TOLERANCE] / 2 - (gap1 if nearer else gap2), 0.0)
            return DONE
        if closing1 and closing2 and C1 == C2:
            x, y = (x1 + x2) / 2, (y1 + y2) / 2
        elif closing1 and (not closing2 or C1 < C2):
            x, y = x1, y1
        else:
            x, y = x2, y2
        if strike_at(p, z, x, y, glide, rise, notes) == JAMMED:
            return JAMMED
    return TOO_MANY_IMPACTS


@compiled
def lie_down(p: Floats, z: Floats, edge: int, level: float, rise: float, notes: Floats) -> None:
    """Lays an edge on the table: the block turns no more, and goes up and down with the table."""
    glide = table_glide(p, z[TIME])
    before = energy(p, z[V_X] - glide, z[V_Y] - rise, z[OMEGA])
    if abs(z[V_X] - glide) < rest_speed(p, z[OMEGA]):
        z[V_X] = glide
    z[THETA], z[OMEGA], z[V_Y] = flat_angle(p, edge, z[THETA]), 0.0, rise
    z[Y] = level + foot(p, edge)[1]
    z[MODE], z[CORNER] = FACE, edge
    z[SLIDE] = slide_of(z[V_X] - glide)
    notes[LARGEST_REMOVED] = max(
        notes[LARGEST_REMOVED], before - energy(p, z[V_X] - glide, 0.0, 0.0)
    )


@compiled
def foot(p: Floats, edge: int) -> tuple[float, float, float]:
    """Of a block that lies on an edge: how far the left end is to the left of the centre, how high
    the centre is, and how far the right end is to the right, in metres.
    """
    at = EDGES + 4 * edge
    end = EDGES + 4 * next_corner(p, edge)
    across, up = p[at + EDGE_X], p[at + EDGE_Y]
    return (
        -(p[at] * across + p[at + CORNER_Y] * up),
        p[at] * up - p[at + CORNER_Y] * across,
        p[end] * across + p[end + CORNER_Y] * up,
    )


@compiled
def slide_of(S: float) -> float:
    """The direction of sliding: 1, -1, or 0 where it is but rounding."""
    return 1.0 if S > STILL else -1.0 if S < -STILL else 0.0


@compiled
def stay(p: Floats, z: Floats, i: int) -> None:
    """Corner i, which touches and does not close, stays on the table where a force holds it there;
    else the block flies.
    """
    turn = first_angle(p, i, z[THETA])
    # two corners touch, and this one is not quite the lowest
    z[THETA] = min(max(z[THETA], face_angle(p, turn)), face_angle(p, turn + 1))
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
