"""Orbits in balls that are proved to hold the exact state, at a precision that is raised until
every branch is decided.

Each number is an Arb ball (python-flint): a midpoint and a radius, whose arithmetic encloses.  The
margin w - x of a ball that holds 0 is settled by the exact orbit from the rational start, as long
as that stays about as short as the balls; otherwise the orbit begins again with twice the bits. So
a state is said to lie on x = w only where that is proved, and nothing is guessed.  In the trap the
closed form holds for any number of periods at once.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from flint import arb, ctx

from scenes.juggler.exact import Exact, lifted, told
from scenes.juggler.formulas import formulas
from scenes.juggler.ratios import lowest
from scenes.juggler.setting import Goal
from scenes.juggler.track import Sample, Stop, Track, advance, begin

BITS = 128  # to begin with
MOST_BITS = 2**21
RADIUS = Fraction(1, 10**30)
EXACT_SHARE = 8  # exact numbers may be so many times as long as the balls


class _Again(Stop):
    """More bits are needed."""


class Enclosed:
    """Balls of the present precision, with the exact orbit at hand for what they cannot tell."""

    def __init__(self, alpha: Fraction, checkpoint: Track, bits: int) -> None:
        self.alpha, self.checkpoint, self.bits = alpha, checkpoint, bits

    def lift(self, value: Fraction) -> Any:
        return arb(lifted(value))

    def sign(self, value: Any) -> int | None:
        return 1 if value > 0 else -1 if value < 0 else None

    def middle(self, value: Any) -> Any:
        if not value.is_finite():
            raise _Again("undecided")
        return value.mid().fmpq()

    def power(self, value: Any, exponent: int) -> Any:
        return value**exponent

    def check(self, track: Track) -> None:
        """Nothing has to stop: a ball that has grown too wide fails at the next sign."""

    def settle(self, track: Track) -> int:
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
            raise _Again("undecided") from None
        here = self.checkpoint.here
        track.here = Sample(here.periods, here.impacts, arb(lowest(here.x)), arb(lowest(here.w)))
        sign = exact.sign(formulas().margin(here.x, here.w))
        return 0 if sign is None else sign


def radius_of(ball: Any) -> Fraction:
    """The radius of a ball, exactly."""
    return told(ball.rad().fmpq())


def _wide(track: Track, radius: Fraction) -> bool:
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
    show: Callable[[Track], None],
    report: Callable[[Track], None] | None = None,
) -> None:
    """Follows the orbit; `show` is given every track that is begun, the last of which holds the
    result.
    """
    first = Sample(0, 0, *start)
    checkpoint = begin(Exact(alpha), alpha, first, False)
    before = ctx.prec
    try:
        while True:
            ctx.prec = bits
            arithmetic = Enclosed(alpha, checkpoint, bits)
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


def _exactly(track: Track) -> Sample:
    return Sample(track.here.periods, track.here.impacts, told(track.here.x), told(track.here.w))
