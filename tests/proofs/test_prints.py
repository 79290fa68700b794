"""Every token of every print matters: a change is refused, changes what is judged, or is reviewed
as meaning the same.
"""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from judged import content

from juggleproof.certificates import checker
from juggleproof.certificates.language import ClaimError
from juggleproof.proofs.claims import Claim
from juggleproof.proofs.paper import paper_claims
from juggleproof.proofs.reading.edits import mutations

REVIEWED = Path(__file__).with_name("changes_that_mean_the_same.tsv")


@cache
def claims() -> dict[str, Claim]:
    return {claim.id: claim for claim in paper_claims() if claim.printed}


def reviewed() -> set[tuple[str, str]]:
    rows = [
        line.split("\t")
        for line in REVIEWED.read_text(encoding="utf-8").splitlines()
        if line and not line.startswith("#")
    ]
    assert all(len(row) == 3 and row[2] for row in rows), (
        "each reviewed change has claim, changed print and reason"
    )
    return {(row[0], row[1]) for row in rows}


def unnoticed(claim: Claim) -> list[tuple[str, str]]:
    """The changes of a print that are neither refused nor change what is judged."""
    same = []
    original = content(claim, claim.printed)
    for change, latex in mutations(claim.printed):
        try:
            if content(claim, latex) == original:
                same.append((change, latex))
        except (ClaimError, checker.Rejected) as refusal:
            assert str(refusal), (claim.id, change)
    return same


@pytest.mark.parametrize("claim_id", sorted(claims()))
def test_every_token_of_the_print_matters_holds(claim_id: str) -> None:
    known = reviewed()
    left = [
        (change, latex)
        for change, latex in unnoticed(claims()[claim_id])
        if (claim_id, latex) not in known
    ]
    assert not left, f"{claim_id}: {len(left)} changes go unnoticed, the first: {left[0]}"


def test_reviewed_changes_are_all_needed_holds() -> None:
    assert all(claim in claims() for claim, _ in reviewed())
