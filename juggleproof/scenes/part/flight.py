"""Free flight, and the first corner that meets the table: conservative advancement (Mirtich 1996),
which cannot step over a meeting.

A block turns in a step by no more than its sharpest turn from edge to edge, so that only two
corners can be the lowest: the one that is, and the next as it turns, where it turns so far.  The
gap of a corner at time s of a flight is accelerated by -M at least, where M = g + A_y W_y^2 +
omega^2 rho, and by push + jerk s - K s^2/2 at least, where push and jerk are derivatives now and K
= A_y W_y^4 + omega^4 rho bounds the next one.  Each step goes no further than to the first root of
a parabola below the gap, raised by 9/10 of the tolerance; so no gap falls below the tolerance's
negative, rounding included.  Where a corner comes down so near to the table that its derivatives
tell to a hundredth of the tolerance when it is there, the flight ends there.  If a corner in the
table comes down so slowly that they do not tell this, the flight ends where it comes down through
the height from which it set out, if that was in the table, else through 0.  So a corner that
rattles, with hops below the tolerance, does not sink with every hop.
"""

from __future__ import annotations

from math import cos, sin, sqrt

from juggleproof.scenes.part.body import (
    A_Y,
    CORNER,
    CORNER_Y,
    DONE,
    DRIVE,
    EDGE_X,
    EDGE_Y,
    EDGES,
    LEAST_GAP,
    LEAST_TURN,
    MOMENT,
    OMEGA,
    PHASE_Y,
    REACH,
    SINE,
    SINKS,
    SIZE,
    SMALL_TURN,
    STEPS,
    THETA,
    TIME,
    TOLERANCE,
    TOO_MANY_STEPS,
    V_X,
    V_Y,
    W_Y,
    Floats,
    G,
    X,
    Y,
    compiled,
    corner_x,
    corner_y,
    inlined,
    last_corner,
    lowest,
    next_corner,
    shaken,
    table_height,
    table_lift,
    table_rise,
    turned,
)

MOST_STEPS = 1_000_000  # of one flight
NEWTON = 0.1  # how far from a straight line a gap may be until it is 0
CLOSE = 0.01  # of the tolerance: to which the end of a flight is found where it can be
# of the size of block and table: without that, many hops would sink by the rounding of heights
ROUNDED = 4e-16
AFRESH = 32  # steps after which sines are computed afresh, not turned on
# of the time at which a corner comes down to a height, the second in seconds
MOST_GUESSES, TIME_RESOLUTION = 100, 1e-14


@inlined
def safe_step(value: float, rate: float, fall: float) -> float:
    """How long value + rate s - fall s^2/2 stays at least 0, from value >= 0 on; fall > 0.

    >>> safe_step(1.0, 0.0, 2.0), safe_step(3.0, -1.0, 4.0), safe_step(0.0, 2.0, 4.0)
    (1.0, 1.0, 1.0)
    """
    root = sqrt(rate * rate + 2 * fall * value)
    if rate >= 0:
        return (rate + root) / fall
    return 2 * value / (root - rate)


@inlined
def sure_step(
    value: float,
    rate: float,
    push: float,
    jerk: float,
    fall: float,
    bend: float,
    step: float,
) -> float:
    """A time, at most `step`, for which a gap surely stays at least 0.  The gap is value >= 0 now,
    changes by `rate`, and is accelerated by at least -fall, and by at least
    push + jerk s - bend s^2/2.

    >>> sure_step(1.0, 0.0, -2.0, 0.0, 10.0, 0.0, 5.0), sure_step(1.0, 0.0, 0.0, 1.0, 2.0, 9.0, 5.0)
    (1.0, 1.0)
    """
    # a guess of the step: to the root of a straight line, or of the parabola as it is now
    if rate < 0:
        step = min(step, value / -rate)
    elif push < 0:
        step = min(step, -(rate + sqrt(rate * rate - 2 * push * value)) / push)
    # what bounds the acceleration is concave: it is least at an end of the step
    steepest = min(max(-push, (bend / 2 * step - jerk) * step - push), fall)
    return min(step, safe_step(value, rate, steepest)) if steepest > 0 else step


@inlined
def lands_after(
    gap: float, rate: float, push: float, jerk: float, bend: float, close: float
) -> float:
    """The time in seconds, from now on, at which a gap near 0 that falls is 0; 1e300 if its terms
    up to the third order do not give the gap to within `close`.

    >>> lands_after(0.01, -1.0, 0.0, 0.0, 0.0, 1e-9), lands_after(1.0, -1.0, -2.0, 0.0, 0.0, 1e-9)
    (0.01, 1e+300)
    """
    scale = -1 / rate
    late = gap * scale
    unknown = bend / 24 * late * late * late * late
    if unknown > close:
        return 1e300
    for _ in range(3):
        late = (gap + late * late * (push / 2 + jerk * (1 / 6) * late)) * scale
    missed = gap + late * (rate + late * (push / 2 + jerk * (1 / 6) * late))
    return late if abs(missed) + 2 * unknown <= close else 1e300


@compiled
def comes_down(p: Floats, z: Floats, i: int, late: float) -> float:
    """The time of the flight at which corner i comes down through the table, or through the height
    from which it set out if that was in the table, up to rounding; at most `late`, when it has come
    down.  A hop that is lost in rounding ends where it is highest.

    It is found by Newton's steps from the later end of a bracket; for a concave gap they stay on
    that side.  If a step leaves the bracket, the bracket is halved.
    """
    start = z[Y] + corner_y(p, i, cos(z[THETA]), sin(z[THETA])) - table_height(p, z[TIME])
    height = min(start + ROUNDED * p[SIZE], 0.0)
    early, s = 0.0, late
    for _ in range(MOST_GUESSES):
        angle, t = z[THETA] + z[OMEGA] * s, z[TIME] + s
        c, d = cos(angle), sin(angle)
        gap = z[Y] + (z[V_Y] - p[G] / 2 * s) * s - table_height(p, t) + corner_y(p, i, c, d)
        rate = z[V_Y] - p[G] * s - table_rise(p, t) + z[OMEGA] * corner_x(p, i, c, d)
        if gap < height and rate < 0:
            late = s
        else:
            early = s
        if late - early <= TIME_RESOLUTION:
            break
        guess = s + (height - gap) / rate if rate < 0 else early
        if gap < height and s - guess <= TIME_RESOLUTION and guess <= s:
            break
        s = guess if early < guess < late else (early + late) / 2
    return max(late, MOMENT)


Two = tuple[int, float, float, float, float, float, float]


@inlined
def lowest_two(p: Floats, low: int, omega: float) -> Two:
    """The corner that is the lowest after this one as the block turns; the places of both from the
    centre at theta = 0, and the direction of the edge between them.
    """
    second = last_corner(p, low) if omega > 0 else next_corner(p, low)
    at, other = EDGES + 4 * low, EDGES + 4 * second
    edge = other if omega > 0 else at
    return (
        second,
        p[at],
        p[at + CORNER_Y],
        p[other],
        p[other + CORNER_Y],
        p[edge + EDGE_X],
        p[edge + EDGE_Y],
    )


Landing = tuple[int, float, float, float, float, float]


@compiled
def fly(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves a flying block on until a corner meets the table, or to the time `until`; returns DONE,
    or why it gave up.

    The first step is taken even where a corner touches: the last impact made it leave, and the gap
    cannot fall below the tolerance's negative.
    """
    return land(p, z, until, notes)[0]


@inlined
def land(p: Floats, z: Floats, until: float, notes: Floats) -> Landing:
    """The same; also returns cosine and sine of theta, and the height of the table, its speed and
    its acceleration upwards, where the flight ends.  CORNER is the lowest corner there.
    """
    t, y, theta, rise, omega = z[TIME], z[Y], z[THETA], z[V_Y], z[OMEGA]
    tolerance, W, sine = p[TOLERANCE], p[W_Y], p[DRIVE] == SINE
    high, fast = p[A_Y], p[A_Y] * W
    half_g, reach, spin = p[G] / 2, until - t, omega * omega
    fall = p[G] + abs(fast) * W + spin * p[REACH]
    bend = abs(fast) * W * W * W + spin * spin * p[REACH]
    furthest = p[LEAST_TURN] / abs(omega) if omega != 0 else reach
    c, d = cos(theta), sin(theta)
    u, v = 0.0, 0.0
    if sine:
        u, v = cos(W * t + p[PHASE_Y]), sin(W * t + p[PHASE_Y])
    least, s, advance = notes[LEAST_GAP], 0.0, 0.0
    ended, steps = TOO_MANY_STEPS, 0
    low = lowest(p, int(z[CORNER]), c, d, omega)
    second, low_x, low_y, next_x, next_y, edge_x, edge_y = lowest_two(p, low, omega)
    lean = edge_x * d + edge_y * c  # the sine of the angle of the edge that comes down
    while True:
        if sine:
            level, speed, lift, jolt = high * v, fast * u, -fast * W * v, -fast * W * W * u
        else:
            level, speed = table_height(p, t + s), table_rise(p, t + s)
            lift, jolt = table_lift(p, t + s), shaken(p, t + s, 1, 3)
        if omega != 0 and omega * lean >= 0:  # it came down: its other end is the lowest corner
            low = second
            second, low_x, low_y, next_x, next_y, edge_x, edge_y = lowest_two(p, low, omega)
            lean = edge_x * d + edge_y * c
        if ended == DONE or steps == MOST_STEPS:
            break
        centre, falling = y + (rise - half_g * s) * s - level, rise - p[G] * s - speed
        pushed, jerked = -lift - p[G], -jolt
        i, across, along = low, low_x, low_y
        advance = min(reach - s, furthest)
        back = 1e300
        for nearness in range(2):
            if nearness == 1:  # the next as the block turns, if it turns so far
                if abs(omega) * min(advance, back) < abs(lean):
                    break
                i, across, along = second, next_x, next_y
            up = across * d + along * c
            turning = omega * (across * c - along * d)
            gap, rate = centre + up, falling + turning
            push, jerk = pushed - spin * up, jerked - spin * turning
            if rate < 0 and (steps > 0 or gap > tolerance):
                if fall * abs(gap) < NEWTON * rate * rate:
                    lands = lands_after(gap, rate, push, jerk, bend, CLOSE * tolerance)
                    if lands == 1e300 and gap <= tolerance:
                        lands = -gap / rate
                    if lands < 1e300:
                        back = min(back, lands)
                        continue
                elif gap <= tolerance:
                    back = min(back, 0.0)
                    if gap < 0:
                        back = min(back, comes_down(p, z, i, s) - s)
                    continue
            if nearness == 0:
                least = min(least, gap)
            above = max(gap + 0.9 * tolerance, 0.1 * tolerance)
            if above + (rate - fall * advance / 2) * advance < 0:
                advance = sure_step(above, rate, push, jerk, fall, bend, advance)
        steps += 1
        if back <= advance:
            advance = max(back, min(MOMENT - s, 0.0))
            ended = DONE
        s += advance
        if s >= reach:
            s = reach
            ended = DONE
        on, around = W * advance, omega * advance
        if max(abs(on), abs(around)) > SMALL_TURN or steps % AFRESH == 0:
            c, d = cos(theta + omega * s), sin(theta + omega * s)
            if sine:
                u, v = cos(W * (t + s) + p[PHASE_Y]), sin(W * (t + s) + p[PHASE_Y])
        else:
            c, d = turned(c, d, around)
            if sine:
                u, v = turned(u, v, on)
        lean = edge_x * d + edge_y * c
    z[TIME], z[THETA] = until if s >= reach else t + s, theta + omega * s
    z[X] += z[V_X] * s
    z[Y], z[V_Y], z[CORNER] = y + (rise - half_g * s) * s, rise - p[G] * s, low
    notes[STEPS] += steps
    notes[LEAST_GAP] = min(least, z[Y] + low_x * d + low_y * c - level)
    notes[SINKS] += notes[LEAST_GAP] < -tolerance
    return ended, c, d, level, speed, lift
