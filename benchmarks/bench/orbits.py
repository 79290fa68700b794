"""Orbits and ensembles of the juggler as work to be measured: the state after a number of periods
in each arithmetic of the scene, and in float64 alone.

The distance from the exact state is computed untimed: a method on an orbit answers by a function
that computes it.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import numpy as np
from flint import arb, ctx, fmpq
from mpmath import mpf
from mpmath.libmp import to_rational

from juggleproof.benchmarks.bench.answers import GaveUp, OrbitQuestion, Start, Strayed
from juggleproof.scenes import juggler
from juggleproof.scenes.juggler.compiled_map import formulas
from juggleproof.scenes.juggler.orbits import Orbits, Value
from juggleproof.scenes.juggler.track import Sample

STATE_STEPS, SEED = 100, 1
BITS = 256  # of a distance, rounded up
DIGITS = 50


STARTS = {
    one.name: one
    for one in (
        Start(
            "orbit",
            "the orbit of x = 1000, w = -41 for alpha = 3/10, which ends in the trap",
            Fraction(3, 10),
            Fraction(1000),
            Fraction(-41),
        ),
        Start(
            "orbit-edge",
            "the orbit of x = 4/3, w = 3 for alpha = 3/7, which meets x = w exactly, where f jumps",
            Fraction(3, 7),
            Fraction(4, 3),
            Fraction(3),
        ),
    )
}
Later = Callable[[], Strayed]


def _followed(start: Start, arithmetic: str, steps: int, precision: int | None = None) -> Orbits:
    scene = juggler.scene(start.alpha, juggler.point(start.x, start.w))
    orbits: Orbits = juggler.orbit(scene, arithmetic, steps, precision=precision)
    if orbits.counts() != {"reached": 1}:
        raise GaveUp(", ".join(orbits.counts()))
    return orbits


def _away(start: Start, steps: int, x: fmpq, w: fmpq, bound: fmpq | None) -> Strayed:
    """How far (x, w), in rationals of python-flint, is from the exact state, in the sup norm."""
    true = _followed(start, "exact", steps).tracks[0].here
    distance = max(abs(x - true.x), abs(w - true.w))
    kept, ctx.prec = ctx.prec, BITS
    above = arb(distance).upper().fmpq() if distance else fmpq(0)
    ctx.prec = kept
    return Strayed(
        Fraction(int(above.p), int(above.q)),
        None if bound is None else Fraction(int(bound.p), int(bound.q)),
        beyond=bound is not None and distance > bound,
    )


def exact(start: Start, size: Fraction) -> Later:
    """Exact rationals, against which the others are measured."""
    here: Sample[fmpq] = _followed(start, "exact", int(size)).tracks[0].here
    return lambda: Strayed(
        Fraction(0), Fraction(0), f"{max(here.x.height_bits(), here.w.height_bits())} bits"
    )


def enclosed(start: Start, size: Fraction) -> Later:
    """Arb balls; their radius is the bound."""
    here: Sample[arb] = _followed(start, "enclosed", int(size)).tracks[0].here

    def later() -> Strayed:
        x, w = (arb(value) for value in (here.x, here.w))
        radius = max(x.rad().upper().fmpq(), w.rad().upper().fmpq())
        return _away(start, int(size), x.mid().fmpq(), w.mid().fmpq(), radius)

    return later


def fast(start: Start, size: Fraction) -> Later:
    """float64 with its running bound."""
    row = _followed(start, "fast", int(size)).row(0)
    return lambda: _away(
        start, int(size), _of_float(row.x), _of_float(row.w), max(map(_of_float, row.error or ()))
    )


def mp(start: Start, size: Fraction) -> Later:
    """mpmath: nothing is proved."""
    here: Sample[mpf] = _followed(start, "mp", int(size), precision=DIGITS).tracks[0].here

    def later() -> Strayed:
        x, w = (fmpq(*map(int, to_rational(value._mpf_))) for value in (here.x, here.w))
        return _away(start, int(size), x, w, None)

    return later


def floats(start: Start, size: Fraction) -> Later:
    """float64 period by period, as one writes it down: rounding may change any branch."""
    map_of, alpha, x, w = formulas(), float(start.alpha), float(start.x), float(start.w)
    for _ in range(int(size)):
        x, w = map_of.impact(alpha, x, w) if map_of.margin(x, w) > 0 else map_of.flight(x, w, 1)
    return lambda: _away(start, int(size), _of_float(x), _of_float(w), None)


def _of_float(value: Value) -> fmpq:
    return fmpq(*float(value).as_integer_ratio())


def ensemble(work: OrbitQuestion, size: Fraction) -> Strayed:
    """Random states in float64 with their bounds; the answer is the largest bound, the note counts
    undecided states.
    """
    scene = juggler.scene(work.alpha, juggler.random(int(size), seed=SEED))
    orbits = juggler.orbit(scene, "fast", STATE_STEPS)
    here = orbits.ensemble
    decided = here.end == 1
    bound = float(np.maximum(here.error_x, here.error_w)[decided].max(initial=0.0))
    return Strayed(Fraction(bound), Fraction(bound), f"{len(orbits.undecided)} undecided")
