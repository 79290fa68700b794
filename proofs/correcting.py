"""Corrects a claim that is refuted: the first candidate print, or the true assertion nearby, whose
statements are all certified.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from certificates import checker
from certificates.statements import AnyStatement, SharpRange
from certificates.terms import ClaimError
from proofs.claims import Body, as_body, assertions, named_statements
from proofs.corrections import Candidate, candidates
from proofs.hypotheses import read

if TYPE_CHECKING:
    from proofs.judging import Judge


def correct(judge: Judge) -> None:
    """Keeps the first correction that is certified; what an earlier run found is tried first, of
    whichever kind.
    """
    claim, found = judge.claim, judge.found
    remembered = (judge.options.findings.get(claim.id) or {}).get("correction")
    if remembered and remembered["kind"] == "nearby" and _nearby_is_certified(judge):
        return
    first = (remembered["kind"], remembered["text"]) if remembered else None
    for candidate in candidates(claim, first) if claim.printed else ():
        if _certifies(judge, candidate):
            found.correction = {
                "kind": candidate.kind,
                "change": candidate.change,
                "text": candidate.text,
                "possible transcription error": candidate.possible_transcription_error,
            }
            return
    if not (remembered and remembered["kind"] == "nearby"):
        _nearby_is_certified(judge)


def _nearby_is_certified(judge: Judge) -> bool:
    """Whether the claim names a true assertion nearby that is certified; if so it is the
    correction.
    """
    if judge.claim.nearby is None:
        return False
    text, state = judge.claim.nearby
    if not _certifies_body(judge, as_body(state(), judge.claim.id)):
        return False
    judge.found.correction = {
        "kind": "nearby",
        "change": "a true assertion nearby",
        "text": text,
        "possible transcription error": False,
    }
    return True


def _certifies(judge: Judge, candidate: Candidate) -> bool:
    """Whether the claim, read with this print, is certified; if so its statements are kept as
    ID/corrected...
    """
    try:
        return _certifies_body(judge, judge.claim.body(candidate.printed))
    except (ClaimError, checker.Rejected):
        return False


def _certifies_body(judge: Judge, body: Body) -> bool:
    """Whether every statement of a corrected body is certified; if so they are kept."""
    try:
        statements = [
            _renamed(part, f"{judge.claim.id}/corrected.{part.name.split('/')[1]}")
            for prefix, assertion in assertions(body)
            for part in named_statements("x", prefix, assertion)
        ]
        if not all(_is_stored_certified(judge, part) for part in statements) and any(
            judge.is_refuted_by_sampling(read(part.text(), part.name)) for part in statements
        ):
            return False
    except (ClaimError, checker.Rejected):
        return False
    trial = judge.trial()
    try:
        for part in statements:
            if trial.settle(part) != "certified":
                return False
    except (
        ClaimError
    ):  # a candidate that contradicts itself, or divides by what may vanish, corrects nothing
        return False
    found, tried = judge.found, trial.found
    found.statements += tried.statements
    found.certificates.update(tried.certificates)
    found.outcomes.update(tried.outcomes)
    for name, text in tried.statements:
        found.votes[name] = judge.votes(name, text, tried.outcomes[name])
    found.reused += tried.reused
    return True


def _is_stored_certified(judge: Judge, statement: AnyStatement) -> bool:
    """Whether the store holds this very statement, and the checker accepted its proof there: no
    point can then refute it.
    """
    store, name = judge.options.store, statement.name
    return (
        store is not None
        and store.texts.get(name) == statement.text()
        and judge.options.checked.get(name) == "certified"
    )


def _renamed(statement: AnyStatement, name: str) -> AnyStatement:
    if isinstance(statement, SharpRange):
        raise ClaimError("a sharp range cannot be renamed")
    return replace(statement, name=name)
