"""Every token of every print of the paper's claims matters.

`make test` tries a share of the changes of each token, in one claim in eight, with
JUGGLEPROOF_MUTANTS=many (as CI sets it) all of them in all claims.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import zip_longest
from pathlib import Path
from typing import Any

from juggleproof.certificates import checker
from juggleproof.judging.claims import Claim, assertions, named_statements
from juggleproof.papers.paper import opened
from juggleproof.reading.edits import mutations
from juggleproof.reading.meaning import read
from juggleproof.statements.language import ClaimError, Statement
from tests.rows import each_row
from tests.share import share

# -------------------------------------------------------------------------------------------------
# The judged content of a claim: its statements as formulas over polynomials, apart from how they
# are written.


def content(claim: Claim, latex: str) -> Iterator[Any]:
    """What would be judged if the claim's print were this LaTeX, part by part; equal parts mean the
    same statements.

    Raises ClaimError where the print is refused and checker.Rejected where the statement is.
    """
    body = claim.body(read(latex))
    yield type(body).__name__, getattr(body, "proved_by", "")
    for prefix, assertion in assertions(body):
        for part in named_statements(claim.id, prefix, assertion):
            if isinstance(part, Statement):
                yield unfolded(part.name, part.text(), str(part.show)), part.exists
            else:
                checker.read_statements(part.text())
                yield part.text()


@cache
def unfolded(name: str, text: str, show: str) -> tuple[Any, ...]:
    """The name of a statement and its formulas; most changes leave most statements of a claim."""
    story = checker.Unfolding(checker.read_statements(text)[name], checker.Context())
    goals = normal(list(story.goals))
    # an identity folds to a constant, its relation with it
    said = show if goals in (("True",), ("False",)) else ""
    return name, normal(list(story.premises)), goals, relations(said)


def relations(text: str) -> list[str]:
    """The relation signs of a formula's text, in order."""
    return re.findall(r"<=|>=|!=|[<>=]", text)


def normal(formula: Any) -> Any:
    """A formula with each polynomial as its sorted integer coefficients, up to a positive factor
    (any factor for equations).
    """
    if isinstance(formula, bool):
        return formula
    if isinstance(formula, list):
        return tuple(sorted(map(repr, map(normal, formula))))
    if formula[0] == "atom":
        content_, primitive = formula[1].primitive()
        sign = 1 if content_ > 0 or formula[2] in ("=", "!=") else -1
        return formula[2], tuple(sorted((m, sign * c) for m, c in primitive.terms.items()))
    return formula[0], tuple(sorted(map(repr, map(normal, formula[1]))))


# -------------------------------------------------------------------------------------------------
# Every token of every print matters: a change is refused, changes what is judged, or is reviewed as
# meaning the same.

SHARE = share(30, 1)
Change = tuple[str, str]  # what is changed, after its column, and the changed print
REVIEWED = Path(__file__).with_name("changes_that_mean_the_same.tsv")


@cache
def claims() -> dict[str, Claim]:
    return {claim.id: claim for claim in opened().claims() if claim.printed}


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


def share_of(changes: Iterable[Change]) -> Iterator[Change]:
    """One in so many of the changes of each token, and of each token at least one."""
    of_tokens: dict[str, list[Change]] = {}
    for change in changes:
        of_tokens.setdefault(change[0].partition(":")[0], []).append(change)
    for place, own in enumerate(of_tokens.values()):
        yield from own[place % min(SHARE, len(own)) :: SHARE]


def unnoticed(claim: Claim) -> list[Change]:
    """The changes of a print that are neither refused nor change what is judged."""
    same = []
    unfolded.cache_clear()
    original = list(content(claim, claim.printed))
    for change, latex in share_of(mutations(claim.printed)):
        try:
            pairs = zip_longest(content(claim, latex), original)
            if all(one == other for one, other in pairs):
                same.append((change, latex))
        except (ClaimError, checker.Rejected) as refusal:
            assert str(refusal), (claim.id, change)
    return same


@each_row("claim_id", sorted(claims())[:: share(8, 1)])
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


def test_share_has_a_change_of_every_token_holds() -> None:
    for claim in claims().values():
        every = list(mutations(claim.printed))
        tokens = {change.partition(":")[0] for change, _ in every}
        assert {change.partition(":")[0] for change, _ in share_of(every)} == tokens
