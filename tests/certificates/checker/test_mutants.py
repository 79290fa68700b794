"""The tests beside this file, and the short stored certificates, notice every mutant of the checker
but those that say the same.

What is marked tries a fixed share, with JUGGLEPROOF_MUTANTS=many a larger one.  `make exhaust`
tries all of them, a file at a time, by `python -m tests.certificates.checker.mutate`.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest

from tests.certificates.checker.mutate import MUTANTS, equivalent, judge_all
from tests.share import share

SHARE = share(700, 100)  # of this number of mutants one is tried
DOCS = Path(__file__).resolve().parents[3] / "docs" / "adding-a-rule.md"
KEYS = [one.key for one in MUTANTS]


def digest(text: str) -> int:
    return int(hashlib.sha256(text.encode()).hexdigest()[:8], 16)


def test_every_mutant_has_a_key_of_its_own_holds() -> None:
    assert len(set(KEYS)) == len(KEYS) > 1500


def test_every_equivalent_mutant_is_a_mutant_with_a_reason_holds() -> None:
    known = equivalent()
    assert set(known) <= set(KEYS)
    assert all(known.values())


@pytest.mark.exhaust
def test_every_mutant_is_noticed_unless_it_is_equivalent_holds() -> None:
    known = equivalent()
    chosen = [k for k, key in enumerate(KEYS) if key not in known and digest(key) % SHARE == 0]
    found = {key: one for key, one, _ in judge_all(chosen, follow=False)}
    assert all(found.values()) and len(found) > 1


def test_the_score_counts_the_mutants_holds() -> None:
    (row,) = [line for line in DOCS.read_text().splitlines() if line.startswith("| 2,")]
    mutants, noticed, same = (int(cell.replace(",", "")) for cell in row.strip("| ").split(" | "))
    assert mutants == len(KEYS) == noticed + same
    assert same == len(equivalent())
