"""Periodic orbits by their words: they come back exactly, exist where the exact ranges say, and no
other does.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler import orbit, point, scene
from juggleproof.scenes.juggler.periodic import (
    exists_for,
    family,
    longest_flight,
    orbit_of,
    search_words,
    where,
    words,
)
from juggleproof.symbolic.algebra import alpha as symbol
from tests.rows import each_row

alphas = st.fractions(Fraction(1, 30), Fraction(29, 30), max_denominator=30)


@given(alpha=alphas, word=st.lists(st.integers(1, 6), min_size=1, max_size=4).map(tuple))
def test_orbit_of_a_word_comes_back_exactly_holds(alpha: Fraction, word: tuple[int, ...]) -> None:
    found = orbit_of(word, alpha)
    if found is None:
        return
    x, w = found.impacts[0]
    kept = orbit(scene(alpha, point(x, w)), "exact", sum(word), keep=True).history(0)
    assert (kept[-1].x, kept[-1].w) == (x, w) and kept[-1].impacts == len(word)
    assert found.inside == all(row.x != row.w for row in kept) and found.radius < 1


@each_row("K", range(1, 7))
def test_e_K_exists_from_its_threshold_on_holds(K: int) -> None:
    start = Fraction(K - 1, K + 1)
    assert [str(one) for one in exists_for((K,))] == [
        f"{start} <= alpha < 1" if K > 1 else "0 < alpha < 1"
    ]
    if K > 1:
        at_end, before, after = (
            orbit_of((K,), start + Fraction(step, 1000)) for step in (0, -1, 1)
        )
        assert at_end is not None and not at_end.inside and at_end.attracts is None
        assert before is None and after is not None and after.attracts


def test_family_is_the_orbit_at_every_alpha_holds() -> None:
    for word, alpha in product([(1,), (2,), (3,)], [Fraction(3, 5), Fraction(7, 9)]):
        found = orbit_of(word, alpha)
        assert found is not None
        here = [
            tuple(
                Fraction(int(v.p), int(v.q))
                for v in (entry.subs(symbol, f"{alpha}") for entry in place)
            )
            for place in family(word)
        ]
        assert tuple(here) == found.impacts


def test_below_a_third_only_e_1_holds() -> None:
    for alpha in (Fraction(1, 100), Fraction(1, 4), Fraction(333, 1000)):
        assert longest_flight(alpha) == 1
        assert [found.word for found in search_words(alpha, 12)] == [(1,)]
    assert [found.word for found in search_words(Fraction(1, 3), 8)] == [(1,), (2,)]


def test_above_a_third_the_short_words_are_those_of_the_fixed_points_holds() -> None:
    for alpha, most in (
        (Fraction(2, 5), 2),
        (Fraction(1, 2), 3),
        (Fraction(3, 5), 4),
        (Fraction(3, 4), 7),
    ):
        assert longest_flight(alpha) == most
        assert [found.word for found in search_words(alpha, 4)] == [
            (K,) for K in range(1, most + 1)
        ]
    for word in ((1, 2), (1, 3), (2, 3), (1, 1, 2)):
        assert exists_for(word) == ()


def test_longer_flights_than_the_limit_do_not_exist_holds() -> None:
    for alpha in (Fraction(1, 3), Fraction(1, 2), Fraction(7, 10)):
        beyond = [
            word
            for word in words(2, longest_flight(alpha) + 3)
            if max(word) > longest_flight(alpha)
        ]
        assert beyond and all(orbit_of(word, alpha) is None for word in beyond)


def test_ranges_are_exact_holds() -> None:
    assert [str(one) for one in where([2 * symbol**2 - 1])] == [
        "0.707107 (root of 2*alpha^2 - 1) <= alpha < 1"
    ]
    assert [str(one) for one in where([], [(3 * symbol - 1) * (2 * symbol - 1)])] == [
        "0 < alpha < 1/3",
        "1/2 < alpha < 1",
    ]
    assert [str(one) for one in where([(3 * symbol - 1) * (2 * symbol - 1)])] == [
        "0 < alpha <= 1/3",
        "1/2 <= alpha < 1",
    ]
    assert where([], [-1 - symbol]) == [] and [str(one) for one in where([])] == ["0 < alpha < 1"]
    assert [str(one) for one in where([1 - 3 * symbol, 3 * symbol - 1])] == ["alpha = 1/3"]


def test_rejects_words_that_are_none() -> None:
    for word in ((), (0,), (1, -2), (True,), tuple(range(1, 20))):
        with pytest.raises(SceneError, match="whole number|flights"):
            orbit_of(word, Fraction(1, 2))
    with pytest.raises(SceneError, match="more than"):
        search_words(Fraction(9, 10), 12)
