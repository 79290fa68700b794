"""A block whose face lies on the table: it sticks or slides, until the table falls away, friction
fails, sliding stops, or the block tips.

All in closed form but for the times at which friction fails or sliding stops; these come, like the
end of a flight, from below.
"""

from __future__ import annotations

from math import asin, cos, floor, pi, sin

from scenes.part.body import (
    A_X,
    A_Y,
    CONTACTS,
    CORNER,
    DONE,
    FLIGHT,
    FRICTION,
    HALF_LONG,
    HALF_SHORT,
    MODE,
    NO_PROGRESS,
    PHASE_X,
    PHASE_Y,
    SLIDE,
    THETA,
    TIME,
    V_X,
    V_Y,
    W_X,
    W_Y,
    Floats,
    G,
    X,
    Y,
    corner_x,
    corner_y,
    table_glide,
    table_height,
    table_lift,
    table_place,
    table_push,
    table_rise,
)
from scenes.part.compiling import compiled
from scenes.part.flight import safe_step
from scenes.part.strike import stay
from scenes.part.turns import note_turn

MOST_PHASES, MOST_STEPS = 100_000, 1_000_000
SPEED_NEAR, FORCE_NEAR = 1e-12, 1e-9  # to what a stop and a slip are found, in m/s and m/s^2
LEAST_FALL = 1e-3  # keeps steps finite where nothing changes
LONGEST_PIECE = 1.0  # seconds of one call, so that MOST_STEPS bound the work of any of them


@compiled
def lift_off(p: Floats, t: float) -> float:
    """When the table next falls faster than g, now where it does; 1e300 where it never does."""
    if p[G] + table_lift(p, t) <= 0:
        return t
    if p[A_Y] * p[W_Y] * p[W_Y] <= p[G]:
        return 1e300
    ends = asin(p[G] / (p[A_Y] * p[W_Y] * p[W_Y]))
    phase = p[W_Y] * t + p[PHASE_Y]
    turns = floor((phase - ends) / (2 * pi))
    return t + (2 * pi * (turns + 1) + ends - phase) / p[W_Y]


@compiled
def margin(p: Floats, t: float, grip: float, way: float) -> tuple[float, float]:
    """How far friction `grip` N is from what sticking needs against a push to the side `way`, and
    how fast that changes.
    """
    wy, wx = p[W_Y], p[W_X]
    value = grip * (p[G] + table_lift(p, t)) - way * table_push(p, t)
    rate = -grip * p[A_Y] * wy**3 * cos(wy * t + p[PHASE_Y]) + way * p[A_X] * wx**3 * cos(
        wx * t + p[PHASE_X]
    )
    return value, rate


@compiled
def slip_time(p: Floats, t: float, end: float, grip: float) -> float:
    """The first time up to `end` at which sticking needs more than `grip` times the normal force;
    `end` where there is none.
    """
    fall = grip * abs(p[A_Y]) * p[W_Y] ** 4 + abs(p[A_X]) * p[W_X] ** 4 + LEAST_FALL
    first = True
    for _ in range(MOST_STEPS):
        step = end - t
        for way in (-1.0, 1.0):
            value, rate = margin(p, t, grip, way)
            if value < -FORCE_NEAR and first or value <= FORCE_NEAR and rate < 0 and not first:
                return t
            step = min(step, safe_step(max(value + FORCE_NEAR, 0.0), rate, fall))
        if t + step >= end:
            return end
        if t + step == t and not first:  # as near as times can be told apart
            return t
        first = False
        t += step
    return -1.0


@compiled
def stop_time(p: Floats, t: float, end: float, slide: float, S: float) -> float:
    """The first time up to `end` at which a face that slides at S stops; `end` where there is
    none.
    """
    mu, wy, wx = p[FRICTION], p[W_Y], p[W_X]
    fall = mu * abs(p[A_Y]) * wy**3 + abs(p[A_X]) * wx**3 + LEAST_FALL
    start, rise, glide = t, table_rise(p, t), table_glide(p, t)
    first = True
    for _ in range(MOST_STEPS):
        speed = slide * (S - table_glide(p, t) + glide) - mu * (
            p[G] * (t - start) + table_rise(p, t) - rise
        )
        rate = -slide * table_push(p, t) - mu * (p[G] + table_lift(p, t))
        if speed <= SPEED_NEAR and rate < 0 and not first:
            return t
        step = safe_step(max(speed + SPEED_NEAR, 0.0), rate, fall)
        if t + step >= end:
            return end
        if t + step == t and not first:  # as near as times can be told apart
            return t
        first = False
        t += step
    return -1.0


@compiled
def lie(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves a block that lies on a face on until it leaves it, or to the time `until`."""
    t, x, vx, slide = z[TIME], z[X], z[V_X], z[SLIDE]
    upright = int(z[CORNER]) % 2 == 0
    half, tall = (p[HALF_SHORT], p[HALF_LONG]) if upright else (p[HALF_LONG], p[HALF_SHORT])
    mu = p[FRICTION]
    tips = mu * tall > half
    grip = half / tall if tips else mu
    began, leaves = t, lift_off(p, t)
    end = min(until, leaves, t + LONGEST_PIECE)
    push, tipped, code = 0.0, False, NO_PROGRESS
    notes[CONTACTS] += 1
    for _ in range(MOST_PHASES):
        if slide == 0:
            after = slip_time(p, t, end, grip)
            if after < 0:
                break
            x, vx = x + table_place(p, after) - table_place(p, t), table_glide(p, after)
            t = after
            if t < end:
                push = table_push(p, t)
                tipped = tips
                slide = 0.0 if tips else -1.0 if push > 0 else 1.0
        elif tips:
            push, tipped = -slide, True
        else:
            after = stop_time(p, t, end, slide, vx - table_glide(p, t))
            if after < 0:
                break
            h, rise = after - t, table_rise(p, t)
            x += vx * h - slide * mu * (
                p[G] * h * h / 2 + table_height(p, after) - table_height(p, t) - rise * h
            )
            vx -= slide * mu * (p[G] * h + table_rise(p, after) - rise)
            t = after
            if t < end:
                push = table_push(p, t)
                vx = table_glide(p, t)
                slide = (
                    0.0
                    if abs(push) <= mu * (p[G] + table_lift(p, t))
                    else -1.0
                    if push > 0
                    else 1.0
                )
        if t >= end or tipped:
            code = DONE
            break
    note_turn(p, notes, began, z[THETA], t, z[THETA])
    z[TIME], z[X], z[V_X], z[SLIDE] = t, x, vx, slide
    z[Y], z[V_Y] = table_height(p, t) + tall, table_rise(p, t)
    if tipped:
        tip(p, z, push)
    elif t >= leaves:
        z[MODE] = FLIGHT
    return code


@compiled
def tip(p: Floats, z: Floats, push: float) -> None:
    """Stands a block that tips on its corner: the left one where friction pushes it to the
    right.
    """
    c, s = cos(z[THETA]), sin(z[THETA])
    for i in range(4):
        if corner_y(p, i, c, s) < 0 and corner_x(p, i, c, s) * push < 0:
            stay(p, z, i)
