"""The paper's bounds and ours beside the worst of a stated finite set of exact orbits.

The set, for one alpha and one u (u^2 twice the energy in units of r^2): the flights that end with
closing speed w = u - 1 + j/8, j = 1 .. 16, each from its first state.  j = 16 strikes on the ground
at u, as if thrown up from the ground.  Times are in periods; a flight that has all the energy of u
lasts u periods, which is tau_w of (25).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import partial

from certificates.terms import ClaimError, Term, real
from proofs.paper.outside import worst_wait
from proofs.paper.vocabulary import derived
from proofs.theorem import quantities
from proofs.theorem.counts import LEVEL_OF_R, PRINTED_LOSS, TRUE_LOSS
from proofs.theorem.definition import CORE, SPACE
from proofs.theorem.exact import least_integer, linear_in, sign_with_root, value_of
from proofs.theorem.orbits import Move, State, flown, moves
from proofs.theorem.region import FACTOR, TO_THE_REGION

PHASES = 16


@dataclass(frozen=True)
class Entry:
    """When an orbit enters R: after so many impacts, at this time, seen at this sample."""

    impacts: int
    time: Fraction
    sample: int
    start: State


def root_square(alpha: Fraction) -> Fraction:
    """s^2, by its definition in the descent to R."""
    return value_of(dict(TO_THE_REGION.roots)["s"], {"alpha": alpha})


def first_states(alpha: Fraction, u: Fraction) -> list[State]:
    """The states of the set: at the impact by energy and closing speed, then as many periods back
    as there are.
    """
    found = []
    for j in range(1, PHASES + 1):
        w = u - 1 + Fraction(2 * j, PHASES)
        at_impact = State(alpha, (u**2 - (w - 1) ** 2) / 4, w)

        def leaves(k: int, at_impact: State = at_impact) -> bool:
            return not flown(at_impact, -k - 1).is_in(SPACE)

        found.append(flown(at_impact, -least_integer(leaves)))
    return found


def in_region(state: State) -> bool:
    """Whether the state belongs to R: its energy is at most the level."""
    return state.speed_squared <= 2 * value_of(LEVEL_OF_R, state.point())


def entry_into_region(start: State) -> Entry:
    """Where the orbit of a state outside R enters it."""
    impacts, last = 0, None
    for move in moves(start):
        if last is not None and in_region(move.state):
            return Entry(impacts, _time_of_impact(last), move.start, start)
        if move.impact:
            impacts, last = impacts + 1, move
    raise ClaimError("the orbit is too long to be followed")


def _time_of_impact(move: Move) -> Fraction:
    return move.start + value_of(derived("normal_collision_time"), move.state.point())


def entry_into_core(start: State) -> int:
    """The first sample in the trap within 1 of e_1."""
    return next(move.start for move in moves(start) if move.state.is_in(CORE))


def bracket(loss: Term, alpha: Fraction, u: Fraction) -> tuple[int, int]:
    """The bracket of (26) with this least loss, which is linear in s: rounded down, and rounded
    up.
    """
    constant, slope = linear_in(loss, "s", {"alpha": alpha})
    above, square = u**2 / 2 - value_of(LEVEL_OF_R, {"alpha": alpha}), root_square(alpha)

    def reaches(n: int) -> int:
        return sign_with_root(n * constant - above, n * slope, square)

    up = least_integer(lambda n: reaches(n) >= 0)
    return up - (reaches(up) != 0), up


def worst_flight(u: Fraction) -> Fraction:
    """tau_w of (25) in periods."""
    period = value_of(derived("period"), {"r": Fraction(1), "g": Fraction(1)})
    return value_of(worst_wait, {"u": u, "g": Fraction(1)}) / period


def periods_to_region(state: State) -> int:
    """The number of periods that `theorem-region` tells: the least integer not below its rank, in
    which s and u are roots.
    """
    here, square = state.point(), root_square(state.alpha)
    c0, c1, c2 = (value_of(FACTOR, {**here, "s": Fraction(k)}) for k in (0, 1, 2))
    curve = (c2 - 2 * c1 + c0) / 2
    constant, slope = (
        c0 + curve * square,
        c1 - c0 - curve,
    )  # FACTOR is a square in s, and s^2 a number
    rest = value_of(
        TO_THE_REGION.rank - FACTOR * real("u"), {**here, "u": Fraction(0), "s": Fraction(0)}
    )
    one, other = (
        (constant**2 + slope**2 * square) * state.speed_squared,
        2 * constant * slope * state.speed_squared,
    )

    def enough(n: int) -> bool:
        return n >= rest and sign_with_root((n - rest) ** 2 - one, -other, square) >= 0

    return least_integer(enough, 0)


@dataclass(frozen=True)
class IntoRegion:
    """One row: bounds on impacts, time and samples until R is entered, and the worst of the set."""

    alpha: Fraction
    u: Fraction
    true: tuple[int, int]
    printed: tuple[int, int]
    flight: Fraction
    impacts: Entry
    time: Entry
    sample: Entry
    ours: int


def into_region(alpha: Fraction, u: Fraction) -> IntoRegion:
    """The row of this alpha and energy, which lies outside R."""
    starts = first_states(alpha, u)
    entries = [entry_into_region(start) for start in starts]
    return IntoRegion(
        alpha,
        u,
        bracket(TRUE_LOSS, alpha, u),
        bracket(PRINTED_LOSS, alpha, u),
        worst_flight(u),
        max(entries, key=lambda entry: entry.impacts),
        max(entries, key=lambda entry: entry.time),
        max(entries, key=lambda entry: entry.sample),
        max(map(periods_to_region, starts)),
    )


@dataclass(frozen=True)
class IntoCore:
    """One row: certified periods until the trap and within 1 of e_1, by the theorem's rank and by
    the sharper one, and the worst of the set.
    """

    alpha: Fraction
    u: Fraction
    by_rank: int
    sharper: int
    worst: int


def into_core(alpha: Fraction, u: Fraction) -> IntoCore:
    """The row of this alpha below 1/3 and this energy."""
    starts = first_states(alpha, u)
    return IntoCore(
        alpha,
        u,
        max(quantities.by_the_theorem(start).core for start in starts),
        max(quantities.best_way(start).bound.core for start in starts),
        max(map(entry_into_core, starts)),
    )


def energies(alpha: Fraction) -> list[Fraction]:
    """u outside R: the greatest in 16ths for which the bracket is 1, with either loss, and 10 and
    100 times the least integer there.
    """
    level = 2 * value_of(LEVEL_OF_R, {"alpha": alpha})
    least = least_integer(lambda u: u * u > level)
    first = least_integer(lambda k: k * k > level * PHASES**2)

    def exceeds(loss: Term, k: int) -> bool:
        return bracket(loss, alpha, Fraction(k, PHASES))[1] > 1

    ones = [least_integer(partial(exceeds, loss), first) - 1 for loss in (TRUE_LOSS, PRINTED_LOSS)]
    return sorted(
        {
            *(Fraction(k, PHASES) for k in ones if k >= first),
            Fraction(10 * least),
            Fraction(100 * least),
        }
    )
