"""The record of a review: each claim that holds was compared with the passage of the paper by a
reader who had not written it; `review.tsv` has what the print asserts, what is certified, and
whether these are equal.  A claim that changes has to be read again.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

from juggleproof.judging.claims import Claim, stated_texts
from juggleproof.judging.register import load_register
from juggleproof.papers.paper import opened

TABLE = Path(__file__).with_name("review.tsv")
HEAD = ["claim", "digest", "the print asserts", "certified", "judgement"]
JUDGEMENTS = ("equal", "stronger", "weaker: ")


def digest(claim: Claim) -> str:
    """Of the print, the sentence, and the statements."""
    text = "\n".join([claim.printed, claim.says, *stated_texts(claim).values()])
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def rows() -> list[list[str]]:
    head, *lines = TABLE.read_text(encoding="ascii").splitlines()
    assert head.split("\t") == HEAD
    return [line.split("\t") for line in lines]


def test_every_claim_that_holds_was_compared_with_its_print_as_it_is_now_holds() -> None:
    register = load_register()
    held = {
        claim.id: digest(claim)
        for claim in opened().claims()
        if register[claim.id]["verdict"] == "holds"
    }
    assert {claim: read for claim, read, *_ in rows()} == held


def test_every_row_says_what_was_compared_holds() -> None:
    for claim, _, asserts, certified, judgement in rows():
        assert asserts and certified, claim
        assert judgement.startswith(JUDGEMENTS), claim
