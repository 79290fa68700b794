"""What the theorem certifies of one state, in exact numbers: steps into the trap and to within 1 of
e_1, and distances from there on.

By the rule `descends` the k-th stage is reached at every integer N >= rank + k - 1.  By
`theorem-sharper`, for any W, the energies u <= W - 1 are reached at every integer N >= a rank with
a smaller factor, and from there the theorem's rank is at most 5 (W - 1)/2.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from certificates.terms import ClaimError, Term
from proofs.theorem.closed_form import GROWTH, RATE
from proofs.theorem.definition import BELOW_A_THIRD, CORE, IN_THE_TRAP, NEARBY, TO_THE_POINT, TRAP
from proofs.theorem.exact import (
    ceiling,
    holds_at,
    least_integer,
    linear_in,
    sign_with_root,
    value_of,
)
from proofs.theorem.one_third import EXCEPTIONS, OTHERS, THIRD
from proofs.theorem.orbits import State
from proofs.theorem.sharper import LITTLE, RANK_THERE, TO_LITTLE_ENERGY, WITH_W

TO_TRAP, TO_CORE = (
    TO_THE_POINT.stages.index(stage) for stage in (TRAP, CORE)
)  # steps after the rank is used up


@dataclass(frozen=True)
class Bound:
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
    def bound(self) -> Bound:
        """Both parts together, with the steps from stage to stage."""
        return Bound(self.to_little + self.then + TO_TRAP, self.to_little + self.then + TO_CORE)


def steps_by_rank(rank: Term, state: State, **more: int) -> int:
    """The least integer that is not below the rank, which is linear in u, at the state."""
    constant, factor = linear_in(rank, "u", state.point(**more))
    return ceiling(constant, factor, state.speed_squared)


def attracted(alpha: Fraction) -> bool:
    """Whether the theorem says that every orbit tends to e_1."""
    return holds_at(BELOW_A_THIRD, {"alpha": alpha})


def converges(state: State) -> bool:
    """Whether a descent to e_1 is certified from this state: for alpha < 1/3, and for alpha = 1/3
    from all states but three.
    """
    return attracted(state.alpha) or holds_at(THIRD, state.point()) and state.is_in(OTHERS.space)


def is_exception(state: State) -> bool:
    """Whether alpha = 1/3 and the state is one of the three that do not tend to e_1."""
    return holds_at(THIRD, state.point()) and any(
        (state.x, state.w) == (e.entries[0], e.entries[1]) for e in EXCEPTIONS
    )


def by_the_theorem(state: State) -> Bound:
    """The counts that the theorem's own rank tells."""
    steps = steps_by_rank(TO_THE_POINT.rank, state)
    return Bound(steps + TO_TRAP, steps + TO_CORE)


def via_little_energy(state: State, W: int) -> Sharper:
    """The counts by way of u <= W - 1, for an integer W that the claim allows."""
    here = state.point(W=W)
    if not all(holds_at(allowed, here) for allowed in WITH_W.positive):
        raise ClaimError(
            f"W = {W} is too small for alpha = {state.alpha}: W > 2/(1 - alpha) is needed"
        )
    already = holds_at(LITTLE, here)
    to_little = 0 if already else steps_by_rank(TO_LITTLE_ENERGY.rank, state, W=W)
    return Sharper(W, to_little, ceiling(value_of(RANK_THERE, here), Fraction(0), Fraction(0)))


def best_way(state: State) -> Sharper:
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


def certified(state: State) -> Bound:
    """The smaller of both counts."""
    one, other = by_the_theorem(state), best_way(state).bound
    return Bound(min(one.trap, other.trap), min(one.core, other.core))


def by_the_rate(alpha: Fraction, periods: int) -> Fraction:
    """How near to e_1 a state within 1 of it in the trap is, so many periods later: (2 alpha)^k."""
    return value_of(IN_THE_TRAP.rate, {"alpha": alpha}) ** periods * value_of(IN_THE_TRAP.size, {})


def by_the_closed_form(alpha: Fraction, periods: int) -> Fraction:
    """The same by the closed form: (1 + k) alpha^k."""
    return value_of(GROWTH, {"n": Fraction(periods)}) * value_of(RATE, {"alpha": alpha}) ** periods


def is_nearby(state: State) -> bool:
    """Whether the state belongs to the neighbourhood that e_1 attracts for every alpha < 1."""
    return state.is_in(NEARBY.on)
