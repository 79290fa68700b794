"""Free flight, and the first corner that meets the table: conservative advancement (Mirtich 1996),
which cannot step over a meeting.

A block turns by no more than a quarter in a step, so that only two corners can be the lowest: the
one that is, and the next as it turns, where it turns so far.  The gap of a corner at time s of a
flight is accelerated by -M at least, where M = g + A_y W_y^2 + omega^2 rho, and by push + jerk s
- K s^2/2 at least, where push and jerk are derivatives now and K = A_y W_y^4 + omega^4 rho bounds
the next. Each step goes no further than to the first root of a parabola below the gap, raised by
9/10 of the tolerance; so no gap falls below the tolerance's negative, rounding included.  Where a
corner comes down so near to the table that its derivatives tell to a hundredth of the tolerance
when it is there, the flight ends there.  Where a corner in the table comes down so slowly that they
do not, it is below the height from which it set out, if that was in the table, or below 0: the
flight ends where it came through that, so that a corner that rattles, with hops below the
tolerance, does not sink with every one of them.
"""

from __future__ import annotations

from math import cos, sin, sqrt

from juggleproof.scenes.part.body import (
    A_Y,
    DONE,
    HALF_LONG,
    HALF_SHORT,
    LEAST_GAP,
    MOMENT,
    OMEGA,
    PHASE_Y,
    QUARTER,
    REACH,
    SINKS,
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
    table_height,
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


@compiled
def safe_step(value: float, rate: float, fall: float) -> float:
    """How long value + rate s - fall s^2/2 stays at least 0, from value >= 0 on; fall > 0.

    >>> safe_step(1.0, 0.0, 2.0), safe_step(3.0, -1.0, 4.0), safe_step(0.0, 2.0, 4.0)
    (1.0, 1.0, 1.0)
    """
    root = sqrt(rate * rate + 2 * fall * value)
    if rate >= 0:
        return (rate + root) / fall
    return 2 * value / (root - rate)


@compiled
def sure_step(
    value: float,
    rate: float,
    push: float,
    jerk: float,
    fall: float,
    bend: float,
    step: float,
) -> float:
    """How long, at most `step`, a gap stays at least 0 for sure that is value >= 0, changes by
    `rate`, and is accelerated by -fall at least, and by push + jerk s - bend s^2/2 at least.

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


@compiled
def lands_after(
    gap: float, rate: float, push: float, jerk: float, bend: float, close: float
) -> float:
    """When a gap is 0 that is near it and falls, from now on, in seconds; 1e300 where its terms to
    the third order do not tell that to `close`.

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
def comes_down(p: Floats, z: Floats, sx: float, sy: float, late: float) -> float:
    """A time of the flight from which on a corner is below the table, or where it set out if that
    was in the table, but for a rounding by which it rises, and comes down; at most `late`, by which
    it does.  A hop that is lost in rounding ends where it is highest.

    By Newton's steps from the later end of a bracket, which for a gap that is concave stay on that
    side; half of the bracket where one leaves it.
    """
    a, b = p[HALF_SHORT], p[HALF_LONG]
    start = z[Y] + (sx * a * sin(z[THETA]) + sy * b * cos(z[THETA])) - table_height(p, z[TIME])
    height = min(start + ROUNDED * (p[REACH] + p[A_Y]), 0.0)
    early, s = 0.0, late
    for _ in range(MOST_GUESSES):
        angle, phase = z[THETA] + z[OMEGA] * s, p[W_Y] * (z[TIME] + s) + p[PHASE_Y]
        c, d = cos(angle), sin(angle)
        gap = z[Y] + (z[V_Y] - p[G] / 2 * s) * s - p[A_Y] * sin(phase) + (sx * a * d + sy * b * c)
        rate = (
            z[V_Y] - p[G] * s - p[A_Y] * p[W_Y] * cos(phase) + z[OMEGA] * (sx * a * c - sy * b * d)
        )
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


Landing = tuple[int, float, float, float, float]


@compiled
def fly(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves a flying block on until a corner meets the table, or to the time `until`; DONE, or why
    it gave up.

    The first step is taken even where a corner touches: the last impact made it leave, and the gap
    cannot fall below the tolerance's negative.
    """
    return land(p, z, until, notes)[0]


@compiled
def land(p: Floats, z: Floats, until: float, notes: Floats) -> Landing:
    """The same; with cosine and sine of theta, and of the table's phase, where the flight ends."""
    t, y, theta, rise, omega = z[TIME], z[Y], z[THETA], z[V_Y], z[OMEGA]
    a, b, tolerance, W = p[HALF_SHORT], p[HALF_LONG], p[TOLERANCE], p[W_Y]
    high, fast = p[A_Y], p[A_Y] * W
    half_g, reach, spin = p[G] / 2, until - t, omega * omega
    fall = p[G] + abs(fast) * W + spin * p[REACH]
    bend = abs(fast) * W * W * W + spin * spin * p[REACH]
    quarter = QUARTER / abs(omega) if omega != 0 else reach
    c, d = cos(theta), sin(theta)
    u, v = cos(W * t + p[PHASE_Y]), sin(W * t + p[PHASE_Y])
    least, s, advance = notes[LEAST_GAP], 0.0, 0.0
    ended, steps = TOO_MANY_STEPS, 0
    while steps < MOST_STEPS:
        centre, falling = y + (rise - half_g * s) * s - high * v, rise - p[G] * s - fast * u
        pushed, jerked = fast * W * v - p[G], fast * W * W * u
        # the lowest corner, of two that are equally low the one that will be
        sx = -1.0 if d > 0 or d == 0 and omega * c > 0 else 1.0
        sy = -1.0 if c > 0 or c == 0 and omega * d < 0 else 1.0
        advance = min(reach - s, quarter)
        back = 1e300
        for nearness in range(2):
            if nearness == 1:  # the next as the block turns, if it turns so far
                across = (c * d > 0) == (omega > 0)
                if abs(omega) * min(advance, back) < abs(c if across else d):
                    break
                sx, sy = sx if across else -sx, -sy if across else sy
            up = sx * a * d + sy * b * c
            turning = omega * (sx * a * c - sy * b * d)
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
                        back = min(back, comes_down(p, z, sx, sy, s) - s)
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
            u, v = cos(W * (t + s) + p[PHASE_Y]), sin(W * (t + s) + p[PHASE_Y])
        else:
            c, d = turned(c, d, around)
            u, v = turned(u, v, on)
        if ended == DONE:
            break
    z[TIME], z[X], z[THETA] = until if s >= reach else t + s, z[X] + z[V_X] * s, theta + omega * s
    z[Y], z[V_Y] = y + (rise - half_g * s) * s, rise - p[G] * s
    notes[STEPS] += steps
    notes[LEAST_GAP] = min(least, z[Y] - a * abs(d) - b * abs(c) - high * v)
    notes[SINKS] += notes[LEAST_GAP] < -tolerance
    return ended, c, d, u, v
