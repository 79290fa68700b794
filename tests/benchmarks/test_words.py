"""The search for words of flights that no impact has finds those of the claims."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from juggleproof.benchmarks import words
from juggleproof.benchmarks.words import (
    NEXT_TO,
    find_words,
    is_enough,
    last_of,
    restitutions,
    search_for,
    written,
)
from juggleproof.proofs.restitution.settling import RANGES
from juggleproof.symbolic import normal_periodic_impact
from tests.rows import each_row

BEYOND = "restitution-beyond-five-sevenths"


@pytest.mark.exhaust
@each_row("name", ["restitution-to-three-fifths", "restitution-two-thirds", BEYOND])
def test_words_of_the_claims_are_those_found_holds(name: str) -> None:
    assert search_for(RANGES[name]) == (RANGES[name].runs, RANGES[name].never)


def test_words_are_found_again_below_a_half_holds() -> None:
    runs, never = find_words(restitutions(Fraction(1, 3), Fraction(1, 2)), 2, [])
    assert written(runs) == "1 22" and written(never) == ""


def test_words_are_enough_fails_without_flights_that_may_be_repeated() -> None:
    chosen = RANGES[BEYOND]
    words = [tuple(map(int, one)) for one in (*chosen.runs.split(), *chosen.never.split())]
    assert is_enough(words, [chosen.repeated], chosen.longest - 1)
    assert not is_enough(words, [], chosen.longest - 1)


def test_search_ends_next_to_where_the_repeated_flights_come_back_holds() -> None:
    last = last_of(RANGES[BEYOND])
    assert last == Fraction(72863, 10**5)
    height = normal_periodic_impact(RANGES[BEYOND].repeated)[0]
    assert height.subs("alpha", last) < 0 <= height.subs("alpha", last + NEXT_TO)


def test_words_fail_without_room_for_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(words, "LONGEST", 3)
    with pytest.raises(ValueError, match="words of 3 flights are too short"):
        find_words([Fraction(7, 10)], 5, [])


def test_table_is_printed_beside_what_is_found_holds(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    chosen = RANGES["restitution-to-three-fifths"]
    monkeypatch.setattr(words, "RANGES", {"a": chosen, "b": replace(chosen, never="13")})
    words.main()
    first, *_, second, _, _ = capsys.readouterr().out.splitlines()
    assert first.startswith("a: as stated") and second.startswith("b: differs")
