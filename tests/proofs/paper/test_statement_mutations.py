"""A statement with one coefficient, sign, exponent or relation changed: what is still certified
must be true, what is false is refuted.

`make test` takes a fixed sample of the statements; with JUGGLEPROOF_MUTANTS=many (make exhaust)
one certified statement in two is mutated twice. The independent judge shares nothing with the
checker: 10,000 rational points, and Z3 on the negation.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from multiprocessing import get_context
from typing import Any

from juggleproof.certificates import checker
from juggleproof.search.certificate import search_certificate
from juggleproof.statements.store import DEFAULT, Store
from juggleproof.statements.work import Budget, Exhausted
from juggleproof.votes.z3 import vote
from tests.proofs.paper.independent import Independent, iterates_contradiction
from tests.proofs.paper.statement_mutants import mutants
from tests.share import MANY, share

SHARE = share(80, 2)  # one certified statement in so many
MUTANTS_EACH = share(4, 2)
BUDGET = 1_000_000
MUTATED = ("given", "with", "show")


def digest(text: str) -> int:
    return int(hashlib.sha256(text.encode()).hexdigest()[:8], 16)


@cache
def certified() -> dict[str, str]:
    """The certified statements about all values of their variables, with `exists` and integers
    too.
    """
    store = Store(DEFAULT)
    return {
        name: text
        for name, text in store.texts.items()
        if "certified" in (store.certificate(name, text) or {})
        and not any(f"\n{word} " in text for word in ("sharp", "iterates"))
    }


def sample() -> Iterator[tuple[str, str, str]]:
    """(statement, what was changed, mutant): a fixed choice that depends on nothing but the texts;
    of statements that say the same, the first.
    """
    first = {text.partition("\n")[2]: name for name, text in reversed(certified().items())}
    for said, name in reversed(first.items()):
        if digest(name) % SHARE == 0:
            ranked = sorted(
                mutants(certified()[name], MUTATED),
                key=lambda one: (not one[0].startswith("show"), digest(said + one[0])),
            )
            for change, mutant in ranked[:MUTANTS_EACH]:
                yield name, change, mutant


def judged(job: tuple[str, str, str]) -> tuple[str, str, str, str]:
    """(statement, change, what the search and checker say, what the independent judge says)."""
    name, change, mutant = job
    try:
        parsed = checker.read_statements(mutant)[name]
        found = search_certificate(parsed, {}, Budget(BUDGET))
        outcome = checker.check_one(parsed, found, {}, {})[0]
    except checker.Rejected:
        return name, change, "refused", ""
    except Exhausted:
        outcome = "unknown"
    if outcome == "refuted":
        return name, change, outcome, ""
    point = Independent(mutant, witness(found) if outcome == "certified" else None).counterexample(
        10_000 if outcome == "certified" else 2_000
    )
    verdict = (
        "false"
        if point is not None
        else {"holds": "true", "fails": "false"}.get(vote(parsed).answer, "open")
    )
    return name, change, outcome, verdict


def witness(found: Any) -> Any:
    """The values that a certificate names for what exists; None where nothing does."""
    way, _, last = found["certified"]
    return last if way == "witness" else None


@cache
def results() -> list[tuple[str, str, str, str]]:
    with ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("fork")) as pool:
        return list(pool.map(judged, sample(), chunksize=4))


def test_there_are_mutants_holds() -> None:
    assert len(results()) >= (500 if MANY else 20)


def test_certified_mutants_are_true_holds() -> None:
    wrong = [one for one in results() if one[2] == "certified" and one[3] == "false"]
    assert not wrong, f"certified, but false: {wrong[0]}"


def test_false_mutants_are_refuted_exactly_holds() -> None:
    refuted = sum(one[2] == "refuted" for one in results())
    missed = [one for one in results() if one[2] == "unknown" and one[3] == "false"]
    assert refuted >= 0.95 * (refuted + len(missed)), (
        f"{len(missed)} false mutants were not refuted, {refuted} were; the first: {missed[0]}"
    )


def test_every_certified_claim_has_a_refuted_mutant_holds() -> None:
    """A claim all of whose mutants survive says nothing; judged over the claims that the sample
    reaches with every mutant they have.
    """
    said = {name: text.partition("\n")[2] for name, text in certified().items()}
    refuted = {said[name] for name, _, outcome, _ in results() if outcome == "refuted"}
    tried = {said[name] for name, _, _, _ in results()}
    speaking = {name.split("/")[0] for name in said if said[name] in refuted}
    silent = []
    for claim in {name.split("/")[0]: None for name in said if said[name] in tried}:
        if claim in speaking:
            continue
        everything = [
            (n, c, m)
            for n, t in certified().items()
            if n.split("/")[0] == claim
            for c, m in mutants(t, MUTATED)
        ]
        if not any(judged(job)[2] == "refuted" for job in everything):
            silent.append(claim)
    assert not silent, f"no mutant of these claims is refuted, so they say nothing: {silent}"


DONE = {"certified": {"start": ["proof", [], ["close"]], "step": ["proof", [], ["close"]]}}


def test_mutated_iterates_are_certified_exactly_where_they_are_true_holds() -> None:
    """A map or closed form with one mark changed: the checker and the first iterates at rational
    points say the same.
    """
    outcomes = []
    for name, text in Store(DEFAULT).texts.items():
        if "\niterates " in text:
            for change, mutant in mutants(text, ("iterates", "after", "let")):
                outcome, _ = checker.check_one(checker.read_statements(mutant)[name], DONE, {}, {})
                assert (outcome == "certified") == (iterates_contradiction(mutant) is None), (
                    name,
                    change,
                    outcome,
                )
                outcomes.append(outcome)
    assert outcomes.count("rejected") > 20
