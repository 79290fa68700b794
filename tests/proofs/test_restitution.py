"""The claims on restitutions from 1/3 on: what they say of exact orbits, and that they are lost
without any of their hypotheses.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache

from juggleproof.certificates import checker
from juggleproof.judging import limits
from juggleproof.proofs.restitution.below_a_half import EXCEPTIONS, TO_ONE_OR_TWO
from juggleproof.proofs.restitution.impacts import BOX, THERE, WEIGHTS, before
from juggleproof.proofs.restitution.settling import RANGES, Restitutions
from juggleproof.proofs.restitution.unequal import (
    BORN,
    DIES,
    FLIGHTS,
    PERIODS,
    on_the_orbit,
)
from juggleproof.proofs.theorem.definition import holds_at, value_of
from juggleproof.proofs.theorem.orbits import ExactState, step
from juggleproof.reading.values import Vector
from juggleproof.search.certificate import search_certificate
from juggleproof.statements.language import term
from juggleproof.statements.work import Budget, read
from tests.rows import each_row
from tests.stored import STORE, statements

# (statement, what is changed in it, into what): each is false
FALSE = {
    "as-it-begins": ("restitution-e-K-none/no-two-flights", "(K + 1) < K - 1", "(K + 1) <= K - 1"),
    "beyond": ("restitution-e-K/impacts", "/(4*(1", "/(1*(1"),
    "elastic": ("restitution-flights/in-flight-between", "n <= K - 2", "n <= K - 1"),
    "whole": ("restitution-e-K-begins/impacts-that-lead-to-it", "integer K n", "integer K"),
    "below-the-table": ("restitution-e-K-begins/flights-that-lead-to-it", "given 0 <= x\n", ""),
    "no-less": ("restitution-flights/near-between", "n + 2", "n + 1"),
    "at-its-end": ("restitution-e-K-none/is-an-impact", "K <= (", "K < ("),
    "too-far": ("restitution-e-K-begins/near-its-flight-flies", "<= 1/4", "<= 2"),
    "an-early-impact": ("restitution-e-K-begins/near-its-end-flies", "1 - 1/4", "1 - 4"),
    "too-large": ("restitution-unequal/impact-7", "1/2000", "1/100"),
    "no-room": ("restitution-unequal/stays-above", "43*alpha^8*rho", "42*alpha^8*rho"),
    "nor-there": ("restitution-unequal/still-strikes", "47*alpha^9*rho", "46*alpha^9*rho"),
    "on-the-table": ("restitution-unequal-room/both", "alpha > 73/100", "alpha > 72/100"),
    "too-late": ("restitution-unequal-ends/both", "alpha < 31/40", "alpha < 32/40"),
}
# (map rule, what is changed in it, into what): its certificate serves no more
WEAKENED = [
    ("restitution-e-K/contracts", "K - 1 < alpha*(K + 1)", "K - 1 <= alpha*(K + 1)"),
    ("restitution-e-K/map", "alpha < 1 and ", "alpha < 2 and "),
    ("restitution-e-K/contracts", "rate (1 + alpha)/2", "rate alpha"),
    ("restitution-e-K/contracts", "size (1 - alpha)", "size (1/2 - alpha)"),
    ("restitution-e-K/contracts", "point (", "point 1 + ("),
    ("restitution-to-a-half/impacts", "w >= 5", "w >= 6"),
    ("restitution-to-a-half/descends", "2*alpha < 1", "2*alpha <= 1"),
    ("restitution-to-a-half/descends", "rank 24*u", "rank u"),
    ("restitution-to-a-half/e-2", "3*alpha > 1", "3*alpha >= 1"),
    ("restitution-to-a-half/map", "alpha*w - alpha*x", "alpha*w - x"),
    ("restitution-to-a-half/returns", "word 1 2 2", "word 1 2 1"),
    ("restitution-half/impacts", " and (x - 0)^2 + (w - (-2))^2 > 0", ""),
    ("restitution-half/map", " and (x - 0)^2 + (w - (-2))^2 > 0", ""),
    ("restitution-to-three-fifths/settles", "never 2 1 2\n", ""),
    ("restitution-to-three-fifths/settles", "word 1 1 1", "word 1 1"),
    ("restitution-to-three-fifths/settles", "never 2 1 1 2", "never 2 2 1 1"),
    ("restitution-to-three-fifths/descends", "rank 24*u", "rank 8*u"),
    ("restitution-to-three-fifths/descends", "5*alpha < 3", "5*alpha <= 3"),
    ("restitution-to-three-fifths/e-2", "size 100", "size 1"),
    ("restitution-to-three-fifths/returns", "word 1 2 2\n", "word 1 2 1\n"),
    ("restitution-three-fifths/impacts", " and (x - 0)^2 + (w - 5)^2 > 0", ""),
    ("restitution-beyond-five-sevenths/descends", "10000*alpha < 7287", "alpha < 3/4"),
    ("restitution-beyond-five-sevenths/settles", "never 1 1 1 2 2\n", ""),
    ("restitution-beyond-five-sevenths/settles", "word 3 2 2 2 1 1 2 3 3 2 2 3", "word 3 2 2 2"),
    ("restitution-beyond-five-sevenths/settles", "rank (26*alpha^12*w", "rank (25*alpha^12*w"),
    ("restitution-beyond-five-sevenths/until-another-orbit-begins", "7*alpha > 5", "alpha > 0"),
    ("restitution-unequal/comes-back", "word 1 1 1 2", "word 1 1 2 1"),
    ("restitution-unequal/comes-back", "alpha < 1553/2000", "alpha < 1"),
    ("restitution-unequal/contracts", "rate 2*alpha^12", "rate alpha^12"),
]


@cache  # a rule stands in several rows
def outcome(name: str, text: str) -> str:
    """The checker's, of this text with the certificate that is stored for the statement."""
    statement = checker.read_statements(text)[name]
    known = {one: there for one, there in statements().items() if one[:12] == "restitution-"}
    return checker.check_one(statement, STORE.certificate(name, STORE.texts[name]), known, {})[0]


def state_at(alpha: Fraction, place: Vector, **more: Fraction | int) -> ExactState:
    """The state of this place, a vector of alpha and of what is given."""
    point = {"alpha": alpha, **{name: Fraction(value) for name, value in more.items()}}
    x, w = (value_of(term(entry), point) for entry in place.entries)
    return ExactState(alpha, x, w)


def flights(state: ExactState, count: int) -> tuple[tuple[int, ...], ExactState]:
    """The periods of the next flights from an impact on, and the impact after them."""
    lengths: list[int] = []
    for _ in range(count):
        assert state.strikes and state.x >= 0
        state, periods = step(state), 1
        while not state.strikes:
            state, periods = step(state), periods + 1
        lengths.append(periods)
    return tuple(lengths), state


@each_row("name", FALSE)
def test_claims_on_restitution_fail_without_a_hypothesis(name: str) -> None:
    statement, old, new = FALSE[name]
    assert old in STORE.texts[statement]
    changed = read(STORE.texts[statement].replace(old, new), statement)
    found = search_certificate(changed, {}, Budget(limits.DEFAULT_BUDGET))
    assert checker.check_one(changed, found, {}, {})[0] == "refuted"


@each_row(("name", "old", "new"), WEAKENED)
def test_rejects_a_weakened_map_rule(name: str, old: str, new: str) -> None:
    assert old in STORE.texts[name]
    assert outcome(name, STORE.texts[name]) == "certified"
    assert outcome(name, STORE.texts[name].replace(old, new)) == "rejected"


@each_row(("K", "above"), [(1, 9), (2, 1000), (3, 3), (5, 2)])
def test_the_box_of_a_fixed_point_is_followed_by_exact_orbits_holds(K: int, above: int) -> None:
    least = Fraction(K - 1, K + 1)
    alpha = least + (1 - least) / above
    centre = state_at(alpha, THERE, K=K)
    assert flights(centre, 1) == ((K,), centre)
    radius = (1 - alpha) * (alpha * (K + 1) - (K - 1)) / (4 * (1 + alpha) ** 2)
    wide = radius * value_of(WEIGHTS[0], {"alpha": alpha, "K": Fraction(K)})
    for left, down in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
        corner = ExactState(alpha, centre.x + left * wide, centre.w + down * radius)
        assert holds_at(BOX, {**corner.point(), "K": Fraction(K)})
        lengths, after = flights(corner, 3)
        assert lengths == (K, K, K)
        assert abs(after.w - centre.w) == alpha**3 * radius


@each_row("K", [2, 3, 7])
def test_states_that_lead_to_a_fixed_point_where_it_begins_holds(K: int) -> None:
    alpha = Fraction(K - 1, K + 1)
    orbit = [state_at(alpha, before(term(periods)), K=K) for periods in range(K + 1)]
    assert orbit[0] == state_at(alpha, THERE, K=K)
    assert step(orbit[0]) == orbit[K - 1]
    assert [step(state) for state in orbit[1:]] == orbit[:-1]


def test_every_orbit_tends_to_one_of_two_fails_without_the_exceptions() -> None:
    half = Fraction(1, 2)
    states = [state_at(half, place) for place in EXCEPTIONS]
    assert flights(states[0], 2) == ((3, 3), states[0])
    last = TO_ONE_OR_TWO.stages[-1]
    assert not any(holds_at(last, state.point()) for state in states)
    near = ExactState(half, states[0].x + Fraction(1, 100), states[0].w)
    assert 3 not in flights(near, 8)[0][1:]


@each_row("name", RANGES)
def test_words_that_no_state_has_are_in_no_exact_orbit_holds(name: str) -> None:
    chosen = RANGES[name]
    alpha = (2 * chosen.least + 3 * chosen.most) / 5
    runs = chosen.runs.split()
    ended = set()
    for count in range(12):
        start = ExactState(alpha, Fraction(count % 4, 5), Fraction(2 + 3 * count, 5))
        text = "".join(map(str, flights(start, 24)[0]))
        # the first flights may be those of a fast impact
        assert not any(word in text[4:] for word in chosen.never.split())
        ended.add(next(run for run in runs if text.endswith(run)))
    assert len(ended) > 1


@each_row("name", [name for name, one in RANGES.items() if one.least == one.most])
def test_exceptions_tend_to_the_orbit_that_begins_holds(name: str) -> None:
    chosen = RANGES[name]
    states = [state_at(chosen.least, place) for place in chosen.exceptions()]
    assert flights(states[0], 2) == ((chosen.longest,) * 2, states[0])
    assert step(states[0]) in states and all(step(state) in states for state in states[1:])


def test_there_are_exceptions_fails_without_a_range_that_begins() -> None:
    half = Fraction(1, 2)
    assert not Restitutions(half, Fraction(3, 5), Fraction(7), 24, "11 22", "").exceptions()
    assert not Restitutions(half, half, Fraction(7), 24, "11 22 33", "").exceptions()


def room_at(alpha: Fraction) -> Fraction:
    """The greatest rho with the room that the claim asks for, the strict one by a little."""
    born, dies = (state_at(alpha, on_the_orbit(count)) for count in (BORN, DIES))
    return min(born.x / (43 * alpha**8), (dies.w - dies.x) / (48 * alpha**9), Fraction(1, 2000))


@each_row("alpha", [Fraction(3, 4), Fraction(72864, 10**5), Fraction(77649, 10**5)])
def test_orbit_of_unequal_flights_comes_back_holds(alpha: Fraction) -> None:
    away = room_at(alpha)
    start = state_at(alpha, on_the_orbit(0))
    assert flights(start, len(FLIGHTS)) == (FLIGHTS, start)
    for count in range(len(FLIGHTS)):
        assert flights(start, count)[1] == state_at(alpha, on_the_orbit(count))
    for left, down in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
        corner = ExactState(alpha, start.x + left * PERIODS * away, start.w + down * away)
        lengths, after = flights(corner, len(FLIGHTS))
        assert lengths == FLIGHTS
        assert abs(after.w - start.w) == alpha**12 * away
        assert abs(after.x - start.x) <= 2 * alpha**12 * PERIODS * away
