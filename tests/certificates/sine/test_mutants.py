"""Every mutant of the second checker is noticed by what the tests beside this file look at.

A share is tried here, with JUGGLEPROOF_MUTANTS=many a larger one.  `make exhaust` tries all of
them, by `python -m tests.certificates.sine.mutants`.
"""

from __future__ import annotations

import ast
import hashlib

from tests.certificates.sine.mutants import Mutant, noticed, read, text_of
from tests.rows import each_row
from tests.share import share

SHARE = share(128, 4)  # of this number of mutants one is tried
MUTANTS = read()


def chosen(mutants: list[Mutant]) -> list[Mutant]:
    digests = [hashlib.sha256(one.name.encode()).digest() for one in mutants]
    return [one for one, digest in zip(mutants, digests) if digest[0] % SHARE == 0]


def test_every_mutant_is_one_change_of_the_text_holds() -> None:
    assert len({one.name for one in MUTANTS}) == len(MUTANTS) > 200
    for one in MUTANTS[:: share(8, 1)]:
        assert ast.parse(text_of(one))


@each_row("mutant", chosen(MUTANTS))
def test_a_mutant_is_noticed_holds(mutant: Mutant) -> None:
    assert noticed(mutant)
