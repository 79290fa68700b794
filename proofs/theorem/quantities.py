"""What the theorem certifies of one state, in exact numbers, and its bounds beside the worst of
stated orbits.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import partial

from juggleproof.proofs.paper.names import derived
from juggleproof.proofs.paper.regions import worst_wait
from juggleproof.proofs.theorem.definition import (
    BELOW_A_THIRD,
    CORE,
    IN_THE_TRAP,
    NEARBY,
    SPACE,
    TO_THE_POINT,
    TRAP,
    ceiling,
    holds_at,
    least_integer,
    linear_in,
    sign_with_root,
    value_of,
)
from juggleproof.proofs.theorem.orbits import (
    GROWTH,
    LEVEL_OF_R,
    LITTLE,
    PRINTED_LOSS,
    RANK_THERE,
    RATE,
    TO_LITTLE_ENERGY,
    TRUE_LOSS,
    WITH_W,
    ExactState,
    OrbitMove,
    flown,
    moves,
)
from juggleproof.proofs.theorem.stability import EXCEPTIONS, FACTOR, OTHERS, THIRD, TO_THE_REGION
from juggleproof.statements.language import ClaimError, Term, real

# -------------------------------------------------------------------------------------------------
# What the theorem certifies of one state, in exact numbers: steps into the trap and to within 1 of
# e_1, and distances from there on.
#
# By the rule `descends` the k-th stage is reached at every integer N >= rank + k - 1. By
# `theorem-sharper`, for any W, the energies u <= W - 1 are reached at every integer N >= a rank
# with a smaller factor, and from there the theorem's rank is at most 5 (W - 1)/2.

TO_TRAP, TO_CORE = (
    TO_THE_POINT.stages.index(stage) for stage in (TRAP, CORE)
)  # steps after the rank is used up


@dataclass(frozen=True)
class StepBound:
    """Counts of steps after which the state is certainly in the trap, and in the trap within 1 of
    e_1.
    """

    trap: int
    core: int


@dataclass(frozen=True)
class Sharper:
    """The same by way of little energy: u <= W - 1 after `to_little` steps, and the theorem's rank
    at most `then` there.
    """

    W: int
    to_little: int
    then: int

    @property
    def bound(self) -> StepBound:
        """Both parts together, with the steps from stage to stage."""
        return StepBound(self.to_little + self.then + TO_TRAP, self.to_little + self.then + TO_CORE)


def steps_by_rank(rank: Term, state: ExactState, **more: int) -> int:
    """The least integer that is not below the rank, which is linear in u, at the state."""
    constant, factor = linear_in(rank, "u", state.point(**more))
    return ceiling(constant, factor, state.speed_squared)


def attracted(alpha: Fraction) -> bool:
    """Whether the theorem says that every orbit tends to e_1."""
    return holds_at(BELOW_A_THIRD, {"alpha": alpha})


def converges(state: ExactState) -> bool:
    """Whether a descent to e_1 is certified from this state: for alpha < 1/3, and for alpha = 1/3
    from all states but three.
    """
    return attracted(state.alpha) or holds_at(THIRD, state.point()) and state.is_in(OTHERS.space)


def is_exception(state: ExactState) -> bool:
    """Whether alpha = 1/3 and the state is one of the three that do not tend to e_1."""
    return holds_at(THIRD, state.point()) and any(
        (state.x, state.w) == (e.entries[0], e.entries[1]) for e in EXCEPTIONS
    )


def by_the_theorem(state: ExactState) -> StepBound:
    """The counts that the theorem's own rank tells."""
    steps = steps_by_rank(TO_THE_POINT.rank, state)
    return StepBound(steps + TO_TRAP, steps + TO_CORE)


def via_little_energy(state: ExactState, W: int) -> Sharper:
    """The counts by way of u <= W - 1, for an integer W that the claim allows."""
    here = state.point(W=W)
    if not all(holds_at(allowed, here) for allowed in WITH_W.positive):
        raise ClaimError(
            f"W = {W} is too small for alpha = {state.alpha}: W > 2/(1 - alpha) is needed"
        )
    already = holds_at(LITTLE, here)
    to_little = 0 if already else steps_by_rank(TO_LITTLE_ENERGY.rank, state, W=W)
    return Sharper(W, to_little, ceiling(value_of(RANK_THERE, here), Fraction(0), Fraction(0)))


def best_way(state: ExactState) -> Sharper:
    """The integer W with the least sum of both ranks; the sum is convex in W, so that its first
    rise tells.
    """
    first = least_integer(
        lambda W: all(holds_at(allowed, state.point(W=W)) for allowed in WITH_W.positive)
    )

    def rises(W: int) -> bool:
        """Whether rank + 5 (W - 1)/2 is at least as great at W + 1."""
        (c0, f0), (c1, f1) = (
            linear_in(TO_LITTLE_ENERGY.rank, "u", state.point(W=k)) for k in (W, W + 1)
        )
        gain = value_of(RANK_THERE, state.point(W=W + 1)) - value_of(RANK_THERE, state.point(W=W))
        return sign_with_root(c1 - c0 + gain, f1 - f0, state.speed_squared) >= 0

    return via_little_energy(state, least_integer(rises, first))


def certified(state: ExactState) -> StepBound:
    """The smaller of both counts."""
    one, other = by_the_theorem(state), best_way(state).bound
    return StepBound(min(one.trap, other.trap), min(one.core, other.core))


def by_the_rate(alpha: Fraction, periods: int) -> Fraction:
    """The distance from e_1 after k periods of a state of the trap within 1 of it: (2 alpha)^k."""
    return value_of(IN_THE_TRAP.rate, {"alpha": alpha}) ** periods * value_of(IN_THE_TRAP.size, {})


def by_the_closed_form(alpha: Fraction, periods: int) -> Fraction:
    """The same by the closed form: (1 + k) alpha^k."""
    return value_of(GROWTH, {"n": Fraction(periods)}) * value_of(RATE, {"alpha": alpha}) ** periods


def is_nearby(state: ExactState) -> bool:
    """Whether the state belongs to the neighbourhood that e_1 attracts for every alpha < 1."""
    return state.is_in(NEARBY.on)


# -------------------------------------------------------------------------------------------------
# The paper's bounds and ours beside the worst of a stated finite set of exact orbits.
#
# The set, for one alpha and one u (u^2 twice the energy in units of r^2): the flights that end with
# closing speed w = u - 1 + j/8, j = 1 .. 16, each from its first state. j = 16 strikes on the
# ground at u, as if thrown up from the ground. Times are in periods; a flight that has all the
# energy of u lasts u periods, which is tau_w of (25).

PHASES = 16


@dataclass(frozen=True)
class RegionEntry:
    """The entry of an orbit into R: the number of impacts, the time, the sample that shows it."""

    impacts: int
    time: Fraction
    sample: int
    start: ExactState


def root_square(alpha: Fraction) -> Fraction:
    """s^2, by its definition in the descent to R."""
    return value_of(dict(TO_THE_REGION.roots)["s"], {"alpha": alpha})


def first_states(alpha: Fraction, u: Fraction) -> list[ExactState]:
    """The states of the set: at the impact by energy and closing speed, then as many periods back
    as there are.
    """
    found = []
    for j in range(1, PHASES + 1):
        w = u - 1 + Fraction(2 * j, PHASES)
        at_impact = ExactState(alpha, (u**2 - (w - 1) ** 2) / 4, w)

        def leaves(k: int, at_impact: ExactState = at_impact) -> bool:
            return not flown(at_impact, -k - 1).is_in(SPACE)

        found.append(flown(at_impact, -least_integer(leaves)))
    return found


def in_region(state: ExactState) -> bool:
    """Whether the state belongs to R: its energy is at most the level."""
    return state.speed_squared <= 2 * value_of(LEVEL_OF_R, state.point())


def entry_into_region(start: ExactState) -> RegionEntry:
    """Where the orbit of a state outside R enters it."""
    impacts, last = 0, None
    for move in moves(start):
        if last is not None and in_region(move.state):
            return RegionEntry(impacts, _time_of_impact(last), move.start, start)
        if move.impact:
            impacts, last = impacts + 1, move
    raise ClaimError("the orbit is too long to be followed")


def _time_of_impact(move: OrbitMove) -> Fraction:
    return move.start + value_of(derived("normal_collision_time"), move.state.point())


def entry_into_core(start: ExactState) -> int:
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


def periods_to_region(state: ExactState) -> int:
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
    impacts: RegionEntry
    time: RegionEntry
    sample: RegionEntry
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
        max(by_the_theorem(start).core for start in starts),
        max(best_way(start).bound.core for start in starts),
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
