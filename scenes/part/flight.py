"""Free flight, and the first corner that meets the table: conservative advancement (Mirtich 1996),
which cannot step over a meeting.

The gap of a corner at time s of a flight is at least gap + rate s - M s^2/2, where M = g + A_y
W_y^2 + omega^2 rho bounds how fast its rate can fall. Each step goes to the first root of that
parabola, raised by 9/10 of the tolerance, over all four corners; so no gap falls below the
tolerance's negative, rounding included.  From there one step of Newton's puts the corner on the
table, to second order in the tolerance, where it comes down fast enough for that.  Where it does
not, it is below the height from which it set out, if that was in the table, or below 0: the flight
ends where it came through that, so that a corner that rattles, with hops below the tolerance, does
not sink with every one of them.
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
)

MOST_STEPS = 1_000_000  # of one flight
NEWTON = 0.1  # how far from a straight line a gap may be over a step of Newton's
# metres: the roots of corners whose gaps at the end of a step differ by no more are all computed,
# so that the order of the corners does not matter
EQUAL_GAPS = 1e-15
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
def comes_down(p: Floats, z: Floats, i: int, late: float) -> float:
    """A time of the flight from which on corner i is below the table, or where it set out if that
    was in the table; at most `late`, by which it is.

    By Newton's steps from the later end of a bracket, which for a gap that is concave stay on that
    side; half of the bracket where one leaves it.
    """
    a, b = p[HALF_SHORT], p[HALF_LONG]
    sx, sy = -1.0 if i == 0 or i == 3 else 1.0, -1.0 if i < 2 else 1.0
    height = min(
        z[Y] + (sx * a * sin(z[THETA]) + sy * b * cos(z[THETA])) - table_height(p, z[TIME]), 0.0
    )
    early, s = 0.0, late
    for _ in range(MOST_GUESSES):
        angle, phase = z[THETA] + z[OMEGA] * s, p[W_Y] * (z[TIME] + s) + p[PHASE_Y]
        c, d = cos(angle), sin(angle)
        gap = z[Y] + (z[V_Y] - p[G] / 2 * s) * s - p[A_Y] * sin(phase) + (sx * a * d + sy * b * c)
        rate = (
            z[V_Y] - p[G] * s - p[A_Y] * p[W_Y] * cos(phase) + z[OMEGA] * (sx * a * c - sy * b * d)
        )
        if gap < height:
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


@compiled
def fly(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves a flying block on until a corner meets the table, or to the time `until`; DONE, or why
    it gave up.

    The first step is taken even where a corner touches: the last impact made it leave, and the gap
    cannot fall below the tolerance's negative.
    """
    t, y, theta, rise, omega = z[TIME], z[Y], z[THETA], z[V_Y], z[OMEGA]
    a, b, tolerance = p[HALF_SHORT], p[HALF_LONG], p[TOLERANCE]
    half_g, reach = p[G] / 2, until - t
    fall = p[G] + abs(p[A_Y]) * p[W_Y] * p[W_Y] + omega * omega * sqrt(a * a + b * b)
    least, s, first = notes[LEAST_GAP], 0.0, True
    ended = TOO_MANY_STEPS
    for _ in range(MOST_STEPS):
        notes[STEPS] += 1
        angle = theta + omega * s
        c, d = cos(angle), sin(angle)
        phase = p[W_Y] * (t + s) + p[PHASE_Y]
        centre = y + (rise - half_g * s) * s - p[A_Y] * sin(phase)
        falling = rise - p[G] * s - p[A_Y] * p[W_Y] * cos(phase)
        step = reach - s
        met, back = False, step
        for i in range(4):
            sx, sy = -1.0 if i == 0 or i == 3 else 1.0, -1.0 if i < 2 else 1.0
            gap = centre + (sx * a * d + sy * b * c)
            rate = falling + omega * (sx * a * c - sy * b * d)
            least = min(least, gap)
            if gap <= tolerance and rate < 0 and not first:
                met = True
                if fall * abs(gap) < NEWTON * rate * rate:
                    back = min(back, -gap / rate)
                elif gap < 0:
                    back = min(back, min(comes_down(p, z, i, s) - s, 0.0))
                else:
                    back = min(back, 0.0)
            above = max(gap + 0.9 * tolerance, 0.1 * tolerance)
            if above + (rate - fall * step / 2) * step < EQUAL_GAPS:
                step = min(step, safe_step(above, rate, fall))
        first = False
        if met:
            s += max(min(back, step), min(MOMENT - s, 0.0))
            ended = DONE
            break
        s += step
        if s >= reach:
            s = reach
            ended = DONE
            break
    z[TIME], z[X], z[THETA] = until if s >= reach else t + s, z[X] + z[V_X] * s, theta + omega * s
    z[Y], z[V_Y] = y + (rise - half_g * s) * s, rise - p[G] * s
    notes[LEAST_GAP] = least
    return ended
