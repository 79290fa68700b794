"""First impacts on a table that moves as a sine, by Arb's balls: nothing of the checker is used.

A flight is swept from its start by intervals of time.  On each, F > 0 by the mean value theorem in
balls, or it is halved; where F falls and is below 0 at its end, the impact is in it.
"""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from flint import arb, ctx, fmpq

PRECISION = 90  # bits
CLOSEST = 2.0**-40  # of an interval: a table that is closer than this decides is a graze
LONGEST = 6.0  # periods


class State(NamedTuple):
    """An impact, and the parameters of the table: phase, closing speed, restitution, g."""

    x: Fraction
    s: Fraction
    alpha: Fraction
    g: Fraction


class Flight(NamedTuple):
    """What an impact begins: the height F(t) of the ball above the table, and its rate."""

    x: arb
    u: arb  # rebound velocity
    v: arb  # of the table
    height: arb  # of the table
    c: arb
    g: arb
    speed: arb  # alpha s

    def table(self, time: arb) -> tuple[arb, arb]:
        """The table's height and velocity, by definition."""
        return table(self.c, self.g, self.x + time)

    def gap(self, time: arb) -> arb:
        return self.height - self.table(time)[0] + self.u * time - time * time / 2

    def rate(self, time: arb) -> arb:
        return self.u - time - self.table(time)[1]

    def lag(self, time: arb) -> arb:
        """1 - S."""
        sine, cosine = (2 * (self.x + time)).sin_cos_pi()
        return 1 - 2 * arb.pi() * (self.c * sine + self.g * cosine)


def exact(value: Fraction) -> arb:
    return arb(fmpq(value.numerator, value.denominator))


def table(c: arb, g: arb, x: arb) -> tuple[arb, arb]:
    sine, cosine = (2 * x).sin_cos_pi()
    return (c * sine + g * cosine) / (2 * arb.pi()), c * cosine - g * sine


def flight(state: State) -> Flight:
    c = exact((1 - state.alpha) / (2 * (1 + state.alpha)))
    x, g, speed = exact(state.x), exact(state.g), exact(state.alpha * state.s)
    height, v = table(c, g, x)
    return Flight(x, v + speed, v, height, c, g, speed)


def between(start: float, end: float) -> arb:
    return arb((start + end) / 2, (end - start) / 2)


def leaves(one: Flight, end: float) -> bool:
    """Whether F > 0 after the start up to `end`: alpha s t - max(1 - S) t^2/2 > 0."""
    lag = one.lag(between(0, end))
    return bool(lag < 0) or bool(one.speed > lag * (end / 2))


def first_impact(state: State) -> tuple[arb, arb] | None:
    """(x1, s1), or None where the ball stays at rest, or a graze is too close to decide."""
    ctx.prec = PRECISION
    one = flight(state)
    step = 2.0**-5
    while not leaves(one, step):
        step /= 2
        if step < CLOSEST:
            return None
    time = step
    while time < LONGEST:
        ball = between(time, time + step)
        middle = arb(time + step / 2)
        rate = one.rate(ball)
        if one.gap(middle) + rate * (ball - middle) > 0:
            time += step
            step = min(2 * step, 2.0**-3)
        elif rate < 0 and one.gap(arb(time + step)) < 0:
            return impact(one, time, time + step)
        elif step < CLOSEST:
            return None
        else:
            step /= 2
    raise ValueError(f"{state}: no impact")


def impact(one: Flight, above: float, below: float) -> tuple[arb, arb]:
    """The zero of a gap that falls, and the closing speed there."""
    decided = True
    while decided and below - above > 2.0**-46:
        middle = (above + below) / 2
        # Newton's step, kept a little on either side, gains more than a half at once
        guess = middle - float(one.gap(arb(middle)).mid()) / float(one.rate(arb(middle)).mid())
        near = max(2.0**-46, (below - above) / 64)
        for cut in (guess - near / 2, guess + near / 2, middle):
            if above < cut < below:
                gap = one.gap(arb(cut))
                if gap > 0:
                    above = cut
                elif gap < 0:
                    below = cut
                else:
                    decided = False  # beyond the precision: the ball is as wide as it is
    time = between(above, below)
    return one.x + time, -one.rate(time)
