"""A block in lasting contact: which way up it is, a face that lies on the table, and a corner on
which it pivots.
"""

from __future__ import annotations

from math import asin, cos, floor, pi, sin

from juggleproof.scenes.part.body import (
    A_X,
    A_Y,
    AT_SIDES,
    CONTACTS,
    CORNER,
    DONE,
    DRIVE,
    FALLS,
    FLIGHT,
    FRICTION,
    GYRATION,
    LAST_LYING,
    LAST_UPRIGHT,
    MODE,
    MOMENT,
    OMEGA,
    PHASE_X,
    PHASE_Y,
    RISES,
    SIDES,
    SINCE,
    SINE,
    SLIDE,
    STEP,
    STEPS,
    THETA,
    TIME,
    TOLERANCE,
    TOO_MANY_STEPS,
    TURN,
    V_X,
    V_Y,
    W_X,
    W_Y,
    Floats,
    G,
    X,
    Y,
    compiled,
    corner_x,
    corner_y,
    face_angle,
    first_angle,
    inlined,
    next_corner,
    shaken,
    table_glide,
    table_height,
    table_lift,
    table_place,
    table_push,
    table_rise,
)
from juggleproof.scenes.part.flight import safe_step
from juggleproof.scenes.part.strike import foot, hold, stay, strike

# -------------------------------------------------------------------------------------------------
# Which way up.
#
# What is noted of a block: whether the face on which it would come to lie from its present angle is
# a lowest one, since when, and how often that changed.
#
# The sides of two faces meet at the angle at which a block, tilted on a corner, has its centre
# above that corner: for a rectangle, at atan(a/b) from upright.  These angles are stored from
# AT_SIDES on, beginning at -pi; then, for the side below each, whether its face is a lowest one.


@compiled
def side(p: Floats, theta: float) -> int:
    """The number of the side on which a block is; it grows by 1 whenever theta passes from one to
    the next.
    """
    count, at = int(p[SIDES]), int(p[AT_SIDES])
    around = floor(theta * (1 / TURN) + 0.5)
    rest, k = theta - around * TURN, 0
    while k < count and p[at + k] <= rest:
        k += 1
    return int(around) * count + k


@compiled
def side_angle(p: Floats, number: int) -> float:
    """The angle at which a side ends and the next begins."""
    count = int(p[SIDES])
    around = number // count
    return around * TURN + p[int(p[AT_SIDES]) + number - around * count]


@compiled
def is_lying(p: Floats, number: int) -> bool:
    """Whether the face of a side is a lowest one."""
    count = int(p[SIDES])
    return p[int(p[AT_SIDES]) + count + number % count] != 0


@inlined
def note_turn(p: Floats, notes: Floats, t0: float, theta0: float, t1: float, theta1: float) -> None:
    """Notes the sides that a block was on from t0 to t1, turning evenly."""
    count, at = int(p[SIDES]), int(p[AT_SIDES])
    around = floor(theta0 * (1 / TURN) + 0.5)
    rest, k = theta0 - around * TURN, 0
    while k < count and p[at + k] <= rest:
        k += 1
    start = p[at + k - 1] if k > 0 else p[at + count - 1] - TURN
    end = p[at + k] if k < count else p[at] + TURN
    if start <= theta1 - around * TURN < end:  # still on that side
        here = p[at + count + (k if k < count else 0)] != 0
        notes[LAST_LYING if here else LAST_UPRIGHT] = t1
        return
    before, after = int(around) * count + k, side(p, theta1)
    lying = is_lying(p, after)
    if before != after:
        step = 1 if after > before else -1
        for k in range(before, after, step):
            lay = is_lying(p, k)
            if lay == is_lying(p, k + step):
                continue
            angle = side_angle(p, k if step == 1 else k - 1)
            last = min(max(t0 + (t1 - t0) * (angle - theta0) / (theta1 - theta0), t0), t1)
            if last >= notes[SINCE]:
                notes[RISES if lay else FALLS] += 1
            notes[LAST_LYING if lay else LAST_UPRIGHT] = last
    notes[LAST_LYING if lying else LAST_UPRIGHT] = t1


# -------------------------------------------------------------------------------------------------
# On a face.
#
# A block whose face lies on the table: it sticks or slides, until the table falls away, friction
# fails, sliding stops, or the block tips.
#
# All is in closed form except the times at which friction fails or sliding stops; these are
# approached from below, like the end of a flight.

MOST_STEPS = 1_000_000  # of one call; a pivot goes on in the next
SPEED_RESOLUTION, FORCE_RESOLUTION = 1e-12, 1e-9  # of a stop, in m/s, and of a slip, in m/s^2
LEAST_FALL = 1e-3  # keeps steps finite where nothing changes
LONGEST_PIECE = 1.0  # seconds of one call, so that MOST_STEPS bound the work of any of them


@compiled
def lift_off(p: Floats, t: float, end: float, notes: Floats) -> float:
    """The time (s) at which the table next falls faster than g: t if it does so then, 1e300 if it
    does not up to `end`, -1 if that took too many steps.
    """
    if p[G] + table_lift(p, t) <= 0:
        return t
    if p[A_Y] * p[W_Y] * p[W_Y] <= p[G]:
        return 1e300
    if p[DRIVE] == SINE:
        ends = asin(p[G] / (p[A_Y] * p[W_Y] * p[W_Y]))
        phase = p[W_Y] * t + p[PHASE_Y]
        turns = floor((phase - ends) / (2 * pi))
        return t + (2 * pi * (turns + 1) + ends - phase) / p[W_Y]
    fall = p[A_Y] * p[W_Y] ** 4 + LEAST_FALL
    for _ in range(MOST_STEPS):
        notes[STEPS] += 1
        value, rate = p[G] + table_lift(p, t), shaken(p, t, 1, 3)
        if value <= FORCE_RESOLUTION and rate < 0:
            return t
        step = safe_step(max(value + FORCE_RESOLUTION, 0.0), rate, fall)
        if t + step >= end:
            return 1e300
        if t + step == t:  # the next float
            return t
        t += step
    return -1.0


@compiled
def face_margin(p: Floats, t: float, grip: float, way: float) -> tuple[float, float]:
    """The margin by which friction `grip` N exceeds what sticking needs against a push to the side
    `way`, and the rate at which it changes.
    """
    value = grip * (p[G] + table_lift(p, t)) - way * table_push(p, t)
    if p[DRIVE] != SINE:
        return value, grip * shaken(p, t, 1, 3) - way * shaken(p, t, 0, 3)
    wy, wx = p[W_Y], p[W_X]
    rate = -grip * p[A_Y] * wy**3 * cos(wy * t + p[PHASE_Y]) + way * p[A_X] * wx**3 * cos(
        wx * t + p[PHASE_X]
    )
    return value, rate


@compiled
def slip_time(
    p: Floats, t: float, end: float, left: float, right: float, notes: Floats
) -> tuple[float, float]:
    """The first time up to `end` at which sticking needs more than `right` times the normal force
    to the right, or `left` times it to the left, and the side, 1 or -1.  The time is `end` if there
    is none, -1 if it took too many steps.
    """
    grip = max(abs(left), abs(right))
    fall = grip * abs(p[A_Y]) * p[W_Y] ** 4 + abs(p[A_X]) * p[W_X] ** 4 + LEAST_FALL
    first = True
    for _ in range(MOST_STEPS):
        notes[STEPS] += 1
        step = end - t
        nearest, side = 1e300, 1.0
        for way in (-1.0, 1.0):
            value, rate = face_margin(p, t, right if way > 0 else left, way)
            if (
                value < -FORCE_RESOLUTION
                and first
                or value <= FORCE_RESOLUTION
                and rate < 0
                and not first
            ):
                return t, way
            if value < nearest:
                nearest, side = value, way
            step = min(step, safe_step(max(value + FORCE_RESOLUTION, 0.0), rate, fall))
        if t + step >= end:
            return end, 0.0
        if t + step == t and not first:  # the next float
            return t, side
        first = False
        t += step
    return -1.0, 0.0


@compiled
def stop_time(p: Floats, t: float, end: float, slide: float, S: float, notes: Floats) -> float:
    """The first time up to `end` at which a face that slides at S stops; `end` if there is none, -1
    if it took too many steps.
    """
    mu, wy, wx = p[FRICTION], p[W_Y], p[W_X]
    fall = mu * abs(p[A_Y]) * wy**3 + abs(p[A_X]) * wx**3 + LEAST_FALL
    start, rise, glide = t, table_rise(p, t), table_glide(p, t)
    first = True
    for _ in range(MOST_STEPS):
        notes[STEPS] += 1
        speed = slide * (S - table_glide(p, t) + glide) - mu * (
            p[G] * (t - start) + table_rise(p, t) - rise
        )
        rate = -slide * table_push(p, t) - mu * (p[G] + table_lift(p, t))
        if speed <= SPEED_RESOLUTION and rate < 0 and not first:
            return t
        step = safe_step(max(speed + SPEED_RESOLUTION, 0.0), rate, fall)
        if t + step >= end:
            return end
        if t + step == t and not first:  # the next float
            return t
        first = False
        t += step
    return -1.0


@compiled
def lie(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves a block that lies on a face on until it leaves it, or to the time `until`; returns
    DONE, or why it gave up.
    """
    t, x, vx, slide = z[TIME], z[X], z[V_X], z[SLIDE]
    left, tall, right = foot(p, int(z[CORNER]))
    mu = p[FRICTION]
    began, end = t, min(until, t + LONGEST_PIECE)
    leaves = lift_off(p, t, end, notes)
    if leaves < 0:
        return TOO_MANY_STEPS
    end = min(end, leaves)
    # over which end the block tips: friction to the right tips it over the left one
    over, code = 0.0, TOO_MANY_STEPS
    notes[CONTACTS] += 1
    most = notes[STEPS] + MOST_STEPS
    while notes[STEPS] < most:
        notes[STEPS] += 1
        if slide == 0:
            after, way = slip_time(p, t, end, min(mu, right / tall), min(mu, left / tall), notes)
            if after < 0:
                break
            x, vx = x + table_place(p, after) - table_place(p, t), table_glide(p, after)
            t = after
            if t < end:
                if mu * tall > (left if way > 0 else right):
                    over = -way
                else:
                    slide = -1.0 if table_push(p, t) > 0 else 1.0
        elif slide * mu * tall > right or -slide * mu * tall > left:
            over = 1.0 if slide * mu * tall > right else -1.0
        else:
            after = stop_time(p, t, end, slide, vx - table_glide(p, t), notes)
            if after < 0:
                break
            h, rise = after - t, table_rise(p, t)
            fallen = p[G] * h * h / 2 + table_height(p, after) - table_height(p, t) - rise * h
            x += vx * h - slide * mu * fallen
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
        if t >= end or over != 0:
            code = DONE
            break
    note_turn(p, notes, began, z[THETA], t, z[THETA])
    z[TIME], z[X], z[V_X], z[SLIDE] = t, x, vx, slide
    z[Y], z[V_Y] = table_height(p, t) + tall, table_rise(p, t)
    if over != 0:
        edge = int(z[CORNER])
        stay(p, z, edge if over < 0 else next_corner(p, edge))
    elif t >= leaves:
        z[MODE] = FLIGHT
    return code


# -------------------------------------------------------------------------------------------------
# Steps of a pivot.
#
# The steps of a block that pivots on one corner, and the moment at which its phase ends: by Runge
# and Kutta, and by a safeguarded secant.
#
# A phase ends where a margin falls to 0: the angle to the table of the next corner, the normal
# force, the friction left, the speed of sliding.

Moved = tuple[float, float, float, float]  # X, V_X, theta, omega

LASTS, LETS_GO, SLIPS, STOPS, LANDS = range(5)
TIME_RESOLUTION = 1e-13  # seconds, of the end of a phase
MOST_GUESSES = 200


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
    """(X, V_X, theta, omega) after a step of h, by Runge and Kutta's method of fourth order."""
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
    # where the corner sticks on the table
    foot = x + corner_x(p, i, cos(theta), sin(theta)) - table_place(p, t)
    return (
        foot + table_place(p, t + h) - corner_x(p, i, c, s),
        table_glide(p, t + h) + spin * corner_y(p, i, c, s),
        after,
        spin,
    )


@compiled
def step_factor(p: Floats, theta: float, i: int, slide: float) -> float:
    """The share of the usual step that is taken here: near jamming the force at a sliding corner
    changes at a rate in proportion to 1/(B2 +- mu B3).
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
    turn: int,
) -> float:
    """How far a phase is from ending in this way; `turn` is the number of the angle from which on
    corner i is the lowest.
    """
    if ended == LANDS:
        return min(theta - face_angle(p, turn), face_angle(p, turn + 1) - theta)
    if ended == STOPS:
        return slide * (vx - omega * corner_y(p, i, cos(theta), sin(theta)) - table_glide(p, t))
    along, normal, _ = hold(p, t, theta, omega, i, slide)
    return normal if ended == LETS_GO else p[FRICTION] * normal - abs(along)


@compiled
def ending(
    p: Floats, t: float, vx: float, theta: float, omega: float, i: int, slide: float, turn: int
) -> int:
    """The way in which the phase has ended; LASTS if it has not."""
    if margin(p, LANDS, t, vx, theta, omega, i, slide, turn) < 0:
        return LANDS
    if margin(p, LETS_GO, t, vx, theta, omega, i, slide, turn) <= 0:
        return LETS_GO
    last = SLIPS if slide == 0 else STOPS
    return last if margin(p, last, t, vx, theta, omega, i, slide, turn) < 0 else LASTS


@compiled
def end_of_phase(
    p: Floats,
    t: float,
    x: float,
    vx: float,
    theta: float,
    omega: float,
    i: int,
    slide: float,
    turn: int,
    h: float,
    ended: int,
) -> tuple[float, float, int]:
    """Two lengths of a step, TIME_RESOLUTION apart, between which the phase first ends, and how it
    ends; the first is 0 if it ends at once.  After a step of h it has ended.

    Guesses are made by the Illinois method (Dowell and Jarratt, 1971).  The bracket is halved
    instead if it is longer than a third as many halvings would have left it.
    """
    early, late, allowed, side = 0.0, h, 8 * h, 0
    above = margin(p, ended, t, vx, theta, omega, i, slide, turn)
    _, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, late)
    below = margin(p, ended, t + late, vx2, theta2, omega2, i, slide, turn)
    for _ in range(MOST_GUESSES):
        if late - early <= TIME_RESOLUTION:
            break
        guess = (early + late) / 2
        if above > 0 and below < 0 and late - early < allowed:
            secant = late - below * (late - early) / (below - above)
            guess = min(max(secant, early + TIME_RESOLUTION / 2), late - TIME_RESOLUTION / 2)
        allowed *= 0.8
        _, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, guess)
        how = ending(p, t + guess, vx2, theta2, omega2, i, slide, turn)
        if how == LASTS:
            early, above = guess, margin(p, ended, t + guess, vx2, theta2, omega2, i, slide, turn)
            below = below / 2 if side > 0 else below
            side = 1
            continue
        late, below = guess, margin(p, how, t + guess, vx2, theta2, omega2, i, slide, turn)
        above = above / 2 if side < 0 else above
        side = -1
        if how != ended:
            ended, side = how, 0
            _, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, early)
            above = margin(p, ended, t + early, vx2, theta2, omega2, i, slide, turn)
    return early, late, ended


# -------------------------------------------------------------------------------------------------
# On one corner.
#
# A block that pivots on one corner, which sticks or slides: steps in (X, V_X, theta, omega), from
# one phase to the next.
#
# Height and vertical speed follow from the corner's height over the table, which stays what it was,
# at most two tolerances: to put it at 0 could add energy, and keep a block that rattles from coming
# to rest.  What ends a phase (the table falls away, friction fails, sliding stops, the next corner
# comes down) is looked for at the end of every step and then bracketed.

# A phase that ends at once, after one that did so, lasts a MOMENT, so that time passes; it lasts no
# longer, since friction that goes on after sliding has stopped would add energy.


@compiled
def pivot(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves a pivoting block on until it leaves its corner or the next one strikes, or to the time
    `until`; returns DONE, or why it gave up.
    """
    i, slide = int(z[CORNER]), z[SLIDE]
    t, x, vx, theta, omega = z[TIME], z[X], z[V_X], z[THETA], z[OMEGA]
    turn = first_angle(p, i, theta)
    gap = z[Y] + corner_y(p, i, cos(theta), sin(theta)) - table_height(p, t)
    ended, hurried = LASTS, False
    notes[CONTACTS] += 1
    for _ in range(MOST_STEPS):
        notes[STEPS] += 1
        h = min(p[STEP] * step_factor(p, theta, i, slide), until - t)
        x2, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, h)
        ended = ending(p, t + h, vx2, theta2, omega2, i, slide, turn)
        if ended != LASTS:
            early, late, ended = end_of_phase(p, t, x, vx, theta, omega, i, slide, turn, h, ended)
            if ended == LANDS or ended == LETS_GO:
                h = late
            else:
                h = max(early, min(h, MOMENT)) if hurried else early
                hurried = early < MOMENT
            x2, vx2, theta2, omega2 = pivoted(p, t, x, vx, theta, omega, i, slide, h)
        if ended == LANDS:
            start, after = face_angle(p, turn), face_angle(p, turn + 1)
            theta2 = start if theta2 < (start + after) / 2 else after
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
    return strike(p, z, notes) if ended == LANDS else DONE
