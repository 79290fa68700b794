"""Every mutant of the second checker is noticed by what the tests beside this file look at, but
those of terms that are redundant.

A share is tried, or, with JUGGLEPROOF_MUTANTS=all, every one.
"""

from __future__ import annotations

import hashlib
import os

import pytest

from tests.certificates.sine.mutants import Mutant, mutated, noticed, read

ALL = os.environ.get("JUGGLEPROOF_MUTANTS") == "all"
SHARE = 128  # one mutant in so many
MUTANTS, REDUNDANT = read()


def chosen(mutants: list[Mutant]) -> list[Mutant]:
    digests = [hashlib.sha256(one.name.encode()).digest() for one in mutants]
    return [one for one, digest in zip(mutants, digests) if ALL or digest[0] % SHARE == 0]


def test_every_mutant_is_one_change_of_the_text_holds() -> None:
    assert len({one.name for one in MUTANTS + REDUNDANT}) == len(MUTANTS + REDUNDANT) > 200
    for one in MUTANTS[::SHARE]:
        assert mutated(one)


@pytest.mark.parametrize("mutant", chosen(MUTANTS), ids=lambda one: str(one.name))
def test_a_mutant_is_noticed_holds(mutant: Mutant) -> None:
    assert noticed(mutant)


@pytest.mark.parametrize("mutant", REDUNDANT, ids=lambda one: str(one.name))
def test_a_redundant_term_changes_nothing_holds(mutant: Mutant) -> None:
    assert not noticed(mutant) if ALL else mutated(mutant)
