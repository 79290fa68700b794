"""What orbits tend to: as exact iteration says, also on x = w; never guessed."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st
from sympy import ImmutableMatrix, simplify

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler import grid, limits, listed, random
from juggleproof.scenes.juggler.exact import impact
from juggleproof.scenes.juggler.periodic import orbit_of
from juggleproof.symbolic import normal_f1, normal_flight_power
from juggleproof.symbolic.algebra import K, alpha, w, x
from tests.rows import each_row
from tests.scenes.juggler.reference import flights_of, word_of

THIRD, HALF = Fraction(1, 3), Fraction(1, 2)


@each_row(
    ("at", "words"),
    [("1/4", {1}), ("1/2", {1}), ("3/4", {1, 12}), ("17/20", {1, 6, 40})],
)
def test_limits_are_those_of_exact_orbits_holds(at: str, words: set[int]) -> None:
    starts, number = random(60, 5, (0, 6), (-4, 4)), Fraction(at)
    found = limits.limits([number], starts)
    assert {len(found.words[place]) for place in found.which[0]} == words
    for index in range(0, 60, 4):
        assert word_of(number, starts.exact(index)) == found.words[found.which[0, index]]


def test_states_that_floats_cannot_tell_are_decided_exactly_holds() -> None:
    # e_2 at 1/3 and e_3 at 1/2 lie on x = w, one state of each orbit; (4/3, 4) comes to x = w
    states = listed([(0, 3), (Fraction(1, 10), 3)])
    found = limits.limits([THIRD], states)
    assert [found.words[place] for place in found.which[0]] == [(2,), (1,)] and found.exact == 1
    found = limits.limits([HALF], listed([(0, 4)]))
    assert found.words == [(3,)] and found.exact == 1
    found = limits.limits([Fraction(3, 10), Fraction(3, 7)], listed([("4/3", 4), ("4/3", 3)]))
    assert found.exact > 0 and (found.which >= 0).all()


def test_e_1_alone_below_one_third_and_e_2_beside_it_above_holds() -> None:
    alphas = [Fraction(k, 60) for k in range(1, 36)]
    found = limits.limits(alphas, grid((0, 4, 25), (-2, 4, 25)))
    for at, row in zip(alphas, found.which):
        names = {found.words[place] for place in row}
        assert (1,) in names and ((2,) in names) == (at > THIRD or (2,) in names and at == THIRD)
        assert at >= THIRD or names == {(1,)}


def test_matrix_of_an_impact_and_its_flight_is_the_derived_holds() -> None:
    flown = ImmutableMatrix(normal_flight_power()).jacobian([x, w])
    struck = ImmutableMatrix(normal_f1()).jacobian([x, w])
    expected = -alpha * ImmutableMatrix([[1, -K - 1], [0, 1]])
    assert simplify(flown * struck - expected) == ImmutableMatrix.zeros(2, 2)


@given(
    number=st.fractions(Fraction(2, 5), Fraction(19, 20), max_denominator=40),
    periods=st.integers(1, 4),
    away=st.tuples(*[st.fractions(-1, 1, max_denominator=50)] * 2),
)
def test_an_orbit_with_slack_keeps_to_its_word_holds(
    number: Fraction, periods: int, away: tuple[Fraction, Fraction]
) -> None:
    here = orbit_of((periods,), number)
    if here is None:
        return
    state = [base + part for base, part in zip(here.impacts[0], away)]
    if not 0 <= state[0] < state[1]:
        return
    at, *place = (fmpq(part.numerator, part.denominator) for part in (number, *state))
    held = limits.slack(at, *place, [periods], periods, fmpq(0))
    keeps = held.strikes[0] > 0 and (periods == 1 or min(held.flies[0]) >= 0)
    flights = flights_of(number, impact(number, state[0], state[1]), 30)
    assert not keeps or flights == [periods] * 30


def test_slack_is_found_beside_an_orbit_and_not_far_from_it_holds() -> None:
    at = fmpq(1, 2)
    assert min(limits.slack(at, fmpq(1, 2), fmpq(8, 3), [2], 2, fmpq(0)).flies[0]) > 0
    assert min(limits.slack(at, fmpq(0), fmpq(1), [2], 2, fmpq(0)).flies[0]) < 0


def test_an_orbit_that_has_not_settled_is_undecided_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    starts = listed([(100, 0)])
    assert limits.limits([Fraction(9, 10)], starts).which[0, 0] >= 0
    monkeypatch.setattr(limits, "TESTS", (16,))
    found = limits.limits([Fraction(9, 10)], starts)
    assert found.which.tolist() == [[limits.UNDECIDED]] and not found.words


def test_a_run_in_parts_finds_the_same_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    states = grid((0, 4, 20), (-3, 4, 20))
    whole = limits.limits([HALF, Fraction(4, 5)], states)
    monkeypatch.setattr(limits, "CHUNK", 97)
    parts = limits.limits([HALF, Fraction(4, 5)], states)
    names = [[found.words[place] for place in found.which.ravel()] for found in (whole, parts)]
    assert names[0] == names[1] and whole.exact == parts.exact


def test_rejects_too_many_orbits() -> None:
    with pytest.raises(SceneError, match="are outside 1 .. 4000000 orbits; give fewer"):
        limits.limits([HALF], grid((0, 1, 3000), (0, 1, 3000)))


def test_rejects_a_word_twice() -> None:
    rows = np.array([[2, 3, 2, 3, 2, 3, 2, 3], [1, 2, 3, 4, 1, 2, 3, 5]])
    assert [limits.repeats(rows, m).any() for m in (1, 2, 3, 4)] == [False, True, False, False]
