"""Orbits with a proved error: numbers in float64 with running bounds, orbits in Arb balls, and
millions of orbits in float64 at once.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

import numpy as np
from flint import arb, ctx, fmpq
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler.compiled_map import formulas, nearest
from juggleproof.scenes.juggler.exact import Exact, Rational, as_fraction, lifted, lowest
from juggleproof.scenes.juggler.starts import Goal, Scene
from juggleproof.scenes.juggler.track import Sample, Stop, Track, advance, begin

# -------------------------------------------------------------------------------------------------
# Numbers in float64 with bounds.
#
# Arrays of float64 with a proved bound on their distance to the exact numbers (running error
# analysis: Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 3.3).
#
# A `Bounded` is an array v of floats and an array e >= 0 of floats with |exact - v| <= e, entry by
# entry.  Let u = 2^-53 be the unit roundoff, fl a rounded result (IEEE 754 binary64, to nearest,
# with gradual underflow), and X = x + dx, Y = y + dy the exact numbers, |dx| <= e_x, |dy| <= e_y.
#
# - Sum, z = fl(x + y): |fl(a) - a| <= u |fl(a)|, and sums do not underflow inexactly.  So |X + Y -
#   z| <= e_x + e_y + u |z|.
# - Product, z = fl(x y): the same, and 2^-1075 more where it underflows.  So |X Y - z| <= |x| e_y +
#   |y| e_x + e_x e_y + u |z| + 2^-1075.
# - Quotient, z = fl(x/y), where |y| > e_y: X/Y - x/y = (dx - (x/y) dy)/Y and |x/y| <= |z| (1 + 2 u)
#   + 2^-1074. So |X/Y - z| <= (e_x + (|z| (1 + 2 u) + 2^-1074) e_y)/(|y| - e_y) + u |z| + 2^-1075;
#   infinite elsewhere.
# - The bounds are themselves computed in floats: sums, products and quotients of numbers >= 0, at
#   most 9 roundings deep, so that what is computed is at least (1 - u)^9 times the bound less what
#   underflows; |y| - e_y is first lowered by 4 u |y|, which is more than its rounding, and 2^-1065
#   is added to what is divided by it.  Each bound is multiplied by 1 + 2^-49 = 1 + 16 u and 2^-1065
#   is added: more than (1 - u)^-10, and more than all underflows (each at most 2^-1075, fewer than
#   8).
#
# An overflow makes v infinite or not a number, and e too: no comparison then holds, and the sign is
# not decided.  Numbers that come in are whole numbers below 2^53, which are exact, or have their
# distance to the exact number as their bound.

Floats: TypeAlias = NDArray[np.float64]  # of any shape, () for a single number
Booleans: TypeAlias = NDArray[np.bool_]
Places: TypeAlias = Booleans | NDArray[np.int64] | slice
U = 2.0**-53
UP, TINY = 1 + 2.0**-49, 2.0**-1065
EXACT: Floats = np.array(0.0)  # the bound of what is not rounded


def _raised(bound: Floats) -> Floats:
    """The bound, made larger than all roundings of its own computation."""
    return bound * UP + TINY


@dataclass(frozen=True, slots=True)
class Bounded:
    """Floats v and bounds e on their distance to the exact numbers, of one shape."""

    v: Floats
    e: Floats

    @staticmethod
    def of(value: Fraction) -> Bounded:
        """The float next to a rational, with a bound on their difference."""
        rounded, missed = nearest(value)
        return Bounded(np.array(rounded), np.array(missed))

    def __add__(self, other: Bounded | int | Floats) -> Bounded:
        two = _bounded(other)
        z = self.v + two.v
        return Bounded(z, _raised(self.e + two.e + U * abs(z)))

    __radd__ = __add__

    def __neg__(self) -> Bounded:
        return Bounded(-self.v, self.e)

    def __abs__(self) -> Bounded:
        return Bounded(abs(self.v), self.e)

    def __sub__(self, other: Bounded | int | Floats) -> Bounded:
        two = _bounded(other)
        z = self.v - two.v
        return Bounded(z, _raised(self.e + two.e + U * abs(z)))

    def __rsub__(self, other: int | Floats) -> Bounded:
        return _bounded(other) - self

    def __mul__(self, other: Bounded | int | Floats) -> Bounded:
        two = _bounded(other)
        z = self.v * two.v
        return Bounded(
            z, _raised(abs(self.v) * two.e + abs(two.v) * self.e + self.e * two.e + U * abs(z))
        )

    __rmul__ = __mul__

    def __truediv__(self, other: Bounded | int | Floats) -> Bounded:
        two = _bounded(other)
        z = self.v / two.v
        size = abs(two.v)
        least = (size - two.e) - 4 * U * size
        bound = _raised(
            (self.e + (abs(z) * (1 + 2 * U) + TINY) * two.e + TINY)
            / np.where(least > 0, least, np.nan)
            + U * abs(z)
        )
        return Bounded(z, np.where(least > 0, bound, np.inf))

    def is_positive(self) -> Booleans:
        """Where the exact number is proved to be positive."""
        return np.asarray(self.v > self.e)

    def is_negative(self) -> Booleans:
        """Where the exact number is proved to be negative."""
        return np.asarray(-self.v > self.e)

    def at(self, places: Places) -> Bounded:
        """The entries at these places."""
        return Bounded(self.v[places], self.e[places])

    def put(self, places: Places, values: Bounded) -> None:
        """Puts values in at these places."""
        self.v[places], self.e[places] = values.v, values.e


def _bounded(value: Bounded | int | Floats) -> Bounded:
    """A whole number below 2^53, or whole floats, as exact; raises OverflowError above that."""
    if isinstance(value, Bounded):
        return value
    if isinstance(value, int) and abs(value) >= 2**53:
        raise OverflowError(f"{value} is no float")
    return Bounded(np.asarray(value, np.float64), EXACT)


def powers(value: Bounded, exponents: NDArray[np.int64]) -> Bounded:
    """The number, one for all, to each of the whole exponents >= 0, shape (n,), by squaring."""
    power = Bounded(np.ones(len(exponents)), np.zeros(len(exponents)))
    left = exponents.copy()
    while left.any():
        odd = (left & 1) == 1
        power.put(odd, power.at(odd) * value)
        left >>= 1
        if left.any():
            value = value * value
    return power


# -------------------------------------------------------------------------------------------------
# Orbits in balls.
#
# Orbits in balls that are proved to hold the exact state, at a precision that is raised until every
# branch is decided.
#
# Each number is an Arb ball (python-flint): a midpoint and a radius, whose arithmetic encloses. If
# the ball of the margin w - x holds 0, its sign is settled by the exact orbit from the rational
# start, as long as its numbers stay about as short as the balls; otherwise the orbit begins again
# with twice the bits.
# So a state counts as on x = w only where that is proved, and nothing is guessed.  In the trap
# the closed form holds for any number of periods at once.

BITS = 128  # to begin with
MOST_BITS = 2**21
RADIUS = Fraction(1, 10**30)
EXACT_SHARE = 8  # exact numbers may be this many times as long as the balls


class _MoreBits(Stop):
    """The branch is to be decided with more bits."""


class EnclosedOrbits:
    """Balls of the present precision, with the exact orbit for what they cannot decide."""

    def __init__(self, alpha: Fraction, checkpoint: Track[Rational], bits: int) -> None:
        self.alpha, self.checkpoint, self.bits = alpha, checkpoint, bits

    def lift(self, value: Fraction) -> arb:
        return arb(lifted(value))

    def sign(self, value: arb) -> int | None:
        return 1 if value > 0 else -1 if value < 0 else None

    def middle(self, value: arb) -> fmpq:
        if not value.is_finite():
            raise _MoreBits("undecided")
        return value.mid().fmpq()

    def power(self, alpha: arb, exponent: int) -> arb:
        return (-alpha) ** exponent

    def check(self, track: Track[arb]) -> None:
        """Nothing has to stop: a ball that has grown too wide fails at the next sign."""

    def decide(self, track: Track[arb]) -> int:
        """The sign of the margin by the exact orbit, which is followed to this period; the ball is
        taken anew from there.
        """
        exact = Exact(self.alpha, EXACT_SHARE * self.bits)
        try:
            advance(
                self.checkpoint,
                exact,
                Goal(track.here.periods),
                formulas().fixed(lifted(self.alpha)),
            )
        except Stop:
            raise _MoreBits("undecided") from None
        here = self.checkpoint.here
        track.here = Sample(here.periods, here.impacts, arb(lowest(here.x)), arb(lowest(here.w)))
        return exact.sign(formulas().margin(here.x, here.w))


def radius_of(ball: arb) -> Fraction:
    """The radius of a ball, exactly."""
    return as_fraction(ball.rad().fmpq())


def _wide(track: Track[arb], radius: Fraction) -> bool:
    samples = track.samples if track.samples is not None else [track.here]
    most = lifted(radius)
    return not all(
        part.is_finite() and part.rad().fmpq() <= most for one in samples for part in (one.x, one.w)
    )


def follow(
    alpha: Fraction,
    start: tuple[Fraction, Fraction],
    goal: Goal,
    keep: bool,
    bits: int,
    radius: Fraction,
    most_bits: int,
    show: Callable[[Track[arb]], None],
    report: Callable[[Track[arb]], None] | None = None,
) -> None:
    """Follows the orbit in balls of at first `bits` and at most `most_bits` bits.  `show` is called
    with every track that is begun; the last one holds the result.
    """
    first = Sample(0, 0, *start)
    checkpoint = begin(Exact(alpha), alpha, first, False)
    before = ctx.prec
    try:
        while True:
            ctx.prec = bits
            arithmetic = EnclosedOrbits(alpha, checkpoint, bits)
            track = begin(arithmetic, alpha, _exactly(checkpoint), keep)
            track.edges = checkpoint.edges
            show(track)
            try:
                advance(
                    track,
                    arithmetic,
                    goal,
                    tuple(map(arithmetic.lift, formulas().fixed(alpha))),
                    report,
                )
                if not _wide(track, radius):
                    return
            except Stop:
                pass
            if 2 * bits > most_bits:
                track.end = "undecided"
                return
            bits *= 2
            if keep:  # all states again, with the smaller radius
                checkpoint = begin(Exact(alpha), alpha, first, False)
    finally:
        ctx.prec = before


def _exactly(track: Track[Rational]) -> Sample[Fraction]:
    return Sample(
        track.here.periods, track.here.impacts, as_fraction(track.here.x), as_fraction(track.here.w)
    )


# -------------------------------------------------------------------------------------------------
# Orbits in float64 with bounds.
#
# Millions of orbits at once in float64, each with a proved bound on its error; what the bound
# cannot decide is listed, not guessed.
#
# The states of a chunk move together: in each round by a whole flight and an impact, or by the
# closed form once they are in the trap.  Every number is a `Bounded`, so that the bound of each
# state accounts for the rounding of its start, for that of alpha, and for every operation.  A
# branch is taken only where the margin w - x is further from 0 than its bound; where it is not, the
# orbit stops, and its state and period are kept.

CHUNK = 1 << 14  # states that move together: their temporaries stay in the processor's cache
ROUND_MEMORY = 64 * 8 * CHUNK  # bytes of the temporaries of one chunk: at most 64 are alive
HISTORY_MEMORY = 1 << 30
MOST_PERIODS = 1 << 52  # counted; whole floats
NOT_DONE, REACHED, TRAP, UNDECIDED = range(4)
# of results: float64, int64, uint8, or text for whole numbers that are longer
Column: TypeAlias = NDArray[np.generic]
ENDS = ("", "reached", "trap", "undecided", "too long")  # the last in exact arithmetic only


@dataclass
class Ensemble:
    """Where each orbit stands: arrays of shape (n,), in normal form; `history` has shape (n, steps
    + 1, 4): x, w and their bounds, or is absent.
    """

    x: Floats
    w: Floats
    error_x: Floats
    error_w: Floats
    periods: NDArray[np.int64]
    impacts: NDArray[np.int64]
    end: NDArray[np.uint8]
    history: Floats | None = None
    done: int = 0  # states before this one are followed to their ends

    @staticmethod
    def empty(count: int, goal: Goal, keep: bool) -> Ensemble:
        """Room for this many orbits; raises SceneError if all states of all orbits would take too
        much memory.
        """
        if keep and bytes_needed(count, goal.steps, True) > HISTORY_MEMORY:
            room = f"more than {HISTORY_MEMORY >> 20} MB"
            raise SceneError(
                f"all states of {count} orbits of {goal.steps} steps take {room}; keep the ends"
                " only, or ask for fewer"
            )
        history = np.full((count, goal.steps + 1, 4), np.nan) if keep else None
        x, w, error_x, error_w = (np.empty(count) for _ in range(4))
        return Ensemble(
            x,
            w,
            error_x,
            error_w,
            np.zeros(count, np.int64),
            np.zeros(count, np.int64),
            np.zeros(count, np.uint8),
            history,
        )


def bytes_needed(count: int, steps: int, keep: bool = False) -> int:
    """The bytes that `follow_fast` holds at most, beside the program itself: 49 for each state, one
    chunk's temporaries, and the history if asked for.

    >>> bytes_needed(10**6, 10**9) < 60_000_000
    True
    """
    return 49 * count + ROUND_MEMORY + (32 * count * (steps + 1) if keep else 0)


def refuse_flushing() -> None:
    """Raises SceneError on a processor whose floats have no gradual underflow."""
    if float(np.float64(2.0**-1074) * np.float64(1.0)) == 0:
        raise SceneError(
            "this processor is set to flush small floats to 0, under which no bound holds"
        )


def follow_fast(
    scene: Scene,
    goal: Goal,
    ensemble: Ensemble,
    report: Callable[[int, int], None] | None = None,
    chunk: int = CHUNK,
) -> None:
    """Follows all orbits of the scene, chunk by chunk, in place; raises SceneError on a processor
    whose floats have no gradual underflow.
    """
    refuse_flushing()
    count = scene.starts.count
    fixed = [Bounded.of(part) for part in formulas().fixed(scene.alpha)]
    with np.errstate(all="ignore"):
        for low in range(0, count, chunk):
            high = min(low + chunk, count)
            _Chunk(
                scene.alpha,
                goal,
                ensemble,
                low,
                scene.starts.block(low, high),
                (fixed[0], fixed[1]),
            ).run()
            ensemble.done = high
            if report is not None:
                report(high, count)


class _Chunk:
    """The orbits from number `low` on that are not at their ends; `at` are their numbers."""

    def __init__(
        self,
        alpha: Fraction,
        goal: Goal,
        ensemble: Ensemble,
        low: int,
        block: tuple[Floats, Floats, Floats, Floats],
        fixed: tuple[Bounded, Bounded],
    ) -> None:
        self.alpha, self.goal, self.all, self.fixed = Bounded.of(alpha), goal, ensemble, fixed
        x, w, error_x, error_w = block
        self.x, self.w = Bounded(x, error_x), Bounded(w, error_w)
        self.at = np.arange(low, low + len(x))
        self.periods, self.impacts = np.zeros(len(x), np.int64), np.zeros(len(x), np.int64)

    def run(self) -> None:
        self._keep(np.ones(len(self.at), np.bool_))
        while len(self.at):
            self._round()

    @property
    def left(self) -> NDArray[np.int64]:
        """How many steps of the goal are left, for each orbit."""
        return self.goal.steps - (self.periods if self.goal.unit == "periods" else self.impacts)

    def _round(self) -> None:
        """One round: orbits that are at their end leave; those with an impact have it; those that
        fly go on to their next impact, as far as that is certain.
        """
        map_ = formulas()
        margin = map_.margin(self.x, self.w)
        strikes, flies = margin.is_positive(), margin.is_negative()
        here, after = map_.trap_margins(self.alpha, self.w)
        trapped = strikes & here.is_positive() & after.is_positive()
        end = np.where(strikes | flies, NOT_DONE, UNDECIDED)
        end[self.periods >= MOST_PERIODS] = UNDECIDED
        end[self.left <= 0] = REACHED
        if self.goal.until_trap:
            end[trapped] = TRAP
        elif self.all.history is None:
            leaps = trapped & (end == NOT_DONE)
            self._leap(leaps)
            end[leaps] = REACHED
        stays = end == NOT_DONE
        self._leave(end, stays)
        self._strike(strikes[stays])
        self._fly(flies[stays])

    def _leap(self, who: NDArray[np.bool_]) -> None:
        if not who.any():
            return
        x, w, left = self.x.at(who), self.w.at(who), self.left[who]
        power = powers(-self.alpha, left)
        # whole floats are exact below 2^53
        number = Bounded(left.astype(np.float64), np.where(left < 1 << 53, 0.0, left * 2.0**-52))
        x, w = formulas().impact_power(x, w, *self.fixed, number, power)
        self.x.put(who, x)
        self.w.put(who, w)
        self.periods[who] += left
        self.impacts[who] += left

    def _leave(self, end: NDArray[np.int64], stays: NDArray[np.bool_]) -> None:
        if stays.all():
            return
        gone, to = ~stays, self.at[~stays]
        for whole, part in (
            (self.all.x, self.x.v),
            (self.all.w, self.w.v),
            (self.all.error_x, self.x.e),
            (self.all.error_w, self.w.e),
            (self.all.periods, self.periods),
            (self.all.impacts, self.impacts),
            (self.all.end, end),
        ):
            whole[to] = part[gone]
        self.x, self.w, self.at = self.x.at(stays), self.w.at(stays), self.at[stays]
        self.periods, self.impacts = self.periods[stays], self.impacts[stays]

    def _strike(self, who: NDArray[np.bool_]) -> None:
        if not who.any():
            return
        x, w = formulas().impact(self.alpha, self.x.at(who), self.w.at(who))
        self.x.put(who, x)
        self.w.put(who, w)
        self.periods[who] += 1
        self.impacts[who] += 1
        self._keep(who)

    def _fly(self, who: NDArray[np.bool_]) -> None:
        if not who.any():
            return
        x, w = self.x.at(who), self.w.at(who)
        length = certain_flights(x, w)
        if self.goal.unit == "periods":
            np.minimum(length, self.left[who], out=length)
            if self.all.history is not None:
                length[:] = 1
        x, w = formulas().flight(x, w, Bounded(length.astype(np.float64), EXACT))
        self.x.put(who, x)
        self.w.put(who, w)
        self.periods[who] += length
        if self.goal.unit == "periods":
            self._keep(who)

    def _keep(self, who: NDArray[np.bool_]) -> None:
        """Adds the states to the history; its places are periods, or impacts."""
        if self.all.history is not None:
            slot = (self.periods if self.goal.unit == "periods" else self.impacts)[who]
            rows = np.stack([self.x.v[who], self.w.v[who], self.x.e[who], self.w.e[who]], axis=1)
            self.all.history[self.at[who], slot] = rows


def certain_flights(x: Bounded, w: Bounded) -> NDArray[np.int64]:
    """For states that are proved to fly on: a number K >= 1 of periods that certainly have no
    impact, the whole flight where the bound decides it; all of shape (n,).

    The margin after k periods is a convex parabola in k, negative at k = 0: if it is proved not to
    be positive at K - 1, it is not positive in between.
    """
    map_ = formulas()
    b, square = map_.end_of_flight(x, w)
    guess = np.floor((np.sqrt(np.maximum(square.v, 0)) - b.v) / 2) + 1
    guess = np.fmax(np.fmin(guess, MOST_PERIODS / 4), 1)  # 1 where it is not a number
    length = np.ones(len(guess))
    for guessed in (
        np.floor(guess * (1 - 2.0**-20)),
        guess - 1,
        guess,
    ):  # the last that is certain stays
        guessed = np.maximum(guessed, 1)
        sure = map_.margin(*map_.flight(x, w, Bounded(guessed - 1, EXACT))).is_negative()
        length = np.where(sure & (guessed > length), guessed, length)
    return length.astype(np.int64)
