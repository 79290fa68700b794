"""One orbit in any arithmetic: flights as wholes by the power of f2, impacts one by one, and the
closed form once it is in the trap.

The trap is the set of states with 0 <= x < w, alpha w < 1 and alpha (2 - alpha w) < 1: the next two
impacts leave closing speeds below 1/alpha. It is invariant and has only impacts, for every 0 <
alpha < 1.  For let (x', w') = (alpha (w - x), 2 - alpha w).  Then 0 < x' <= alpha w < 1 < w', so
that (x', w') has an impact; alpha w' < 1 is the third condition at (x, w); and alpha (2 - alpha w')
< 1 means alpha^2 w' > 2 alpha - 1, that is alpha^3 w < 2 alpha^2 - 2 alpha + 1 = alpha^2 + (1 -
alpha)^2, which follows from alpha w < 1.  For alpha <= 1/2 the third condition follows from w > 0,
and the set is the trap of the theorem; for alpha > 1/2 that one is not invariant.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from math import isqrt
from typing import Generic, Literal, NamedTuple, Protocol

from flint import fmpq

from juggleproof.scenes.juggler.compiled_map import N, formulas
from juggleproof.scenes.juggler.starts import Goal

End = Literal["", "reached", "trap", "undecided", "too long"]


class Arithmetic(Protocol[N]):
    """Numbers, of the kind N, that the formulas are evaluated in."""

    def lift(self, value: Fraction) -> N:
        """The number in this arithmetic."""

    def sign(self, value: N) -> int | None:
        """1, 0 or -1; None where the arithmetic cannot decide it."""

    def middle(self, value: N) -> fmpq:
        """A rational close to the value: the midpoint of a ball."""

    def power(self, alpha: N, exponent: int) -> N:
        """(-alpha)^exponent; raises Stop where it would be too long."""

    def check(self, track: Track[N]) -> None:
        """Called before every move; raises Stop where the arithmetic has to give up or begin
        again.
        """

    def decide(self, track: Track[N]) -> int:
        """The sign of the margin where `sign` does not decide it, by other means; raises Stop where
        there are none.
        """


class Stop(Exception):
    """The orbit is not followed further in this arithmetic: "undecided" or "too long"."""

    def __init__(self, end: End) -> None:
        self.end: End = end


class Sample(NamedTuple, Generic[N]):
    """A state of an orbit, with the numbers of periods and impacts before it."""

    periods: int
    impacts: int
    x: N
    w: N


@dataclass
class Track(Generic[N]):
    """An orbit as far as it has been followed."""

    alpha: N
    here: Sample[N]
    samples: list[Sample[N]] | None = None  # every state, one a step of the goal; only if asked for
    edges: int = 0  # how often the state was proved to lie on x = w
    end: End = ""
    moves: int = field(default=0, repr=False)

    def keep(self) -> None:
        """Adds the present state to the samples, if they are kept."""
        if self.samples is not None:
            self.samples.append(self.here)


def begin(
    arithmetic: Arithmetic[N], alpha: Fraction, start: Sample[Fraction], keep: bool
) -> Track[N]:
    """The track of an exact start."""
    track = Track(
        arithmetic.lift(alpha),
        Sample(start.periods, start.impacts, arithmetic.lift(start.x), arithmetic.lift(start.w)),
    )
    if keep:
        track.samples = []
        track.keep()
    return track


def advance(
    track: Track[N],
    arithmetic: Arithmetic[N],
    goal: Goal,
    fixed: tuple[N, N],
    report: Callable[[Track[N]], None] | None = None,
) -> None:
    """Follows the track until the goal; `fixed` is e_1 in the arithmetic.  Raises Stop with the
    track at the last state that is certain.
    """
    map_ = formulas()
    while True:
        arithmetic.check(track)
        periods, impacts, x, w = track.here
        left = goal.left(periods, impacts)
        if left <= 0 and not goal.until_trap:
            track.end = "reached"
            return
        margin = map_.margin(x, w)
        sign = arithmetic.sign(margin)
        if sign is None:
            sign = arithmetic.decide(track)
            periods, impacts, x, w = track.here
        if sign == 0:
            track.edges += 1
        trapped = sign > 0 and all(
            arithmetic.sign(part) == 1 for part in map_.trap_margins(track.alpha, w)
        )
        if goal.until_trap and (trapped or left <= 0):
            track.end = "trap" if trapped else "reached"
            return
        track.moves += 1
        if report is not None and track.moves % 1024 == 0:
            report(track)
        if trapped and track.samples is None:
            power = arithmetic.power(track.alpha, left)
            track.here = Sample(
                periods + left, impacts + left, *map_.impact_power(x, w, *fixed, left, power)
            )
        elif sign > 0:
            track.here = Sample(periods + 1, impacts + 1, *map_.impact(track.alpha, x, w))
            track.keep()
        else:
            _fly(track, arithmetic, left if goal.unit == "periods" else None)


def _fly(track: Track[N], arithmetic: Arithmetic[N], most: int | None) -> None:
    """Flies on for as many periods as are certain to have no impact, `most` of them at most; for
    one if only the present one is certain.
    """
    map_ = formulas()
    periods, impacts, x, w = track.here
    length = certain_flight(arithmetic, x, w)
    length = length if most is None else min(length, most)
    if track.samples is not None and most is not None:
        for k in range(1, length):
            track.samples.append(Sample(periods + k, impacts, *map_.flight(x, w, k)))
    track.here = Sample(periods + length, impacts, *map_.flight(x, w, length))
    if most is not None:
        track.keep()


def certain_flight(arithmetic: Arithmetic[N], x: N, w: N) -> int:
    """A number K >= 1 of periods without an impact from a state whose margin is not positive; the
    whole flight where the arithmetic can decide it.  Raises Stop where it can decide no K.

    The margin after k periods is a convex parabola in k, not positive at k = 0: where it is not
    positive at K - 1 it is not between.
    """
    map_ = formulas()
    if arithmetic.sign(map_.margin(*map_.flight(x, w, 1))) == 1:
        return 1  # as most flights are
    guess = estimated_flight(arithmetic.middle, x, w)
    for length in (guess + 1, guess, guess - 1):
        if length <= 1:
            return 1
        sign = arithmetic.sign(map_.margin(*map_.flight(x, w, length - 1)))
        if sign is not None and sign <= 0:
            return length if sign else length - 1  # a state on x = w is stopped at, and counted
    raise Stop("undecided")


def estimated_flight(middle: Callable[[N], fmpq], x: N, w: N) -> int:
    """The length of the flight, or a little less or more: 1 + floor((u - 1 - w)/2), or up to one
    less, u^2 = 4 x + (w - 1)^2, at the rational midpoints.
    """
    b, square = (middle(part) for part in formulas().end_of_flight(x, w))
    floor = int(((isqrt(max(int(square.floor()), 0)) - b) / 2).floor())
    return max(floor + 1, 1)
