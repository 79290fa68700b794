"""Judges one claim: states it, finds or reuses certificates, has the checker settle them, corrects what is refuted, finds sharp ranges."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from certificates import checker
from certificates.routes.votes import Vote, cast_votes
from certificates.search.budget import Budget
from certificates.search.certificate import search_certificate
from certificates.statements import AnyStatement, Iterates, SharpRange, Statement
from certificates.store import Store
from certificates.terms import ClaimError
from proofs.claims import Assertion, Body, Claim, Readings, assertions, named_statements
from proofs.corrections import Candidate, candidates
from proofs.verdicts import Verdict, outcome_of, verdict_of

DEFAULT_BUDGET = 3_000_000
QUICK_BUDGET = 150_000


@dataclass(frozen=True)
class Options:
    """How to judge: which routes vote, how much counted work a statement may take, and what an earlier run found."""

    routes: tuple[str, ...] = ("exact", "z3", "boxes")
    budget: int = DEFAULT_BUDGET
    store: Store | None = None
    findings: Mapping[str, Any] = field(default_factory=dict)
    lemmas: Mapping[str, str] = field(default_factory=dict)


@dataclass
class Judgement:
    """Everything found about one claim; plain data, so that it passes between processes."""

    id: str
    statements: list[tuple[str, str]] = field(default_factory=list)
    certificates: dict[str, Any] = field(default_factory=dict)
    outcomes: dict[str, str] = field(default_factory=dict)
    votes: dict[str, Sequence[Vote]] = field(default_factory=dict)
    sharp: dict[str, dict[str, Any]] = field(default_factory=dict)
    verdict: Verdict = field(default_factory=lambda: Verdict("unknown"))
    correction: dict[str, Any] | None = None
    corrected_as: dict[str, Any] | None = None
    reused: int = 0

    def finding(self) -> dict[str, Any]:
        """What a later run may try first: the correction and the votes."""
        data: dict[str, Any] = {"sharp": {prefix: one["text"] for prefix, one in self.sharp.items()}}
        if self.correction:
            data["correction"] = self.correction
        return data


def judge(claim: Claim, options: Options) -> Judgement:
    """The judgement on one claim.

    Raises ClaimError, one line that names the claim, where it cannot be stated; Disagreement where a route contradicts the checker.
    """
    try:
        return _Judge(claim, options).run()
    except checker.Rejected as problem:
        raise ClaimError(f"{claim.id}: {problem}") from None
    except ClaimError as problem:
        text = str(problem)
        raise ClaimError(text if text.startswith(claim.id) else f"{claim.id}: {text}") from None


class _Judge:
    def __init__(self, claim: Claim, options: Options) -> None:
        self.claim, self.options, self.found = claim, options, Judgement(claim.id)
        self.known: dict[str, checker.Statement] = {}

    def run(self) -> Judgement:
        claim, found = self.claim, self.found
        for name in claim.hints.get("uses", ()):
            self.known[name] = checker.read_statements(self.options.lemmas[name])[name]
        body = claim.body()
        for prefix, assertion in assertions(body):
            self.settle_all(prefix, assertion)
        found.verdict = verdict_of(claim.id, body, found.outcomes)
        if found.verdict.word == "false" and claim.printed and isinstance(body, (Assertion, Readings)):
            self.correct()
            found.verdict = verdict_of(claim.id, body, found.outcomes, corrected=found.correction is not None)
        for prefix, assertion in assertions(body):
            self.find_sharp_range(prefix, assertion)
        return found

    def settle_all(self, prefix: str, assertion: Assertion) -> None:
        for statement in named_statements(self.claim.id, prefix, assertion):
            self.settle(statement)

    def settle(self, statement: AnyStatement) -> str:
        """The outcome of one statement, by a stored certificate that is still valid or by a search."""
        name, text = statement.name, statement.text()
        parsed = read(text, name)
        certificate = self.options.store.certificate(name, text) if self.options.store else None
        outcome = self.check(parsed, certificate) if certificate is not None else "rejected"
        self.found.reused += outcome != "rejected"
        if outcome == "rejected":
            certificate = self.search(statement, parsed)
            outcome = self.check(parsed, certificate)
            if outcome == "rejected":
                certificate, outcome = {"unknown": "the search found no certificate"}, "unknown"
        self.keep(name, text, certificate, outcome)
        if isinstance(statement, Statement):
            routes = [route for route in self.options.routes if route != "exact"]
            self.found.votes[name] = cast_votes(parsed, outcome, routes, None) if routes else ()
        return outcome

    def search(self, statement: AnyStatement, parsed: checker.Statement) -> Any:
        if isinstance(statement, Iterates):
            return {"certified": []}
        return search_certificate(parsed, self.known, Budget(self.options.budget), self.claim.hints.get("search"))

    def check(self, statement: checker.Statement, certificate: Any) -> str:
        outcome, _ = checker.check_one(statement, certificate, self.known, {})
        return str(outcome)

    def keep(self, name: str, text: str, certificate: Any, outcome: str) -> None:
        self.found.statements.append((name, text))
        self.found.certificates[name] = certificate
        self.found.outcomes[name] = outcome

    # -------------------------------------------------------------- corrections

    def correct(self) -> None:
        """The first candidate print that the same claim certifies; an earlier finding is tried first."""
        remembered = (self.options.findings.get(self.claim.id) or {}).get("correction")
        tries = sorted(candidates(self.claim), key=lambda one: remembered is None or one.text != remembered["text"])
        for candidate in tries:
            if self.certifies(candidate):
                self.found.correction = {"kind": candidate.kind, "change": candidate.change, "text": candidate.text,
                                         "possible transcription error": candidate.possible_transcription_error}
                return

    def certifies(self, candidate: Candidate) -> bool:
        """Whether the claim, read with this print, is certified; if so its statements are kept as ID/corrected..."""
        try:
            body = self.claim.body(candidate.printed)
            statements = [part for _, assertion in _with_prefix(body) for part in assertion]
            parsed = [read(part.text(), part.name) for part in statements]
            if any(self.is_refuted_by_sampling(one) for one in parsed):
                return False
        except (ClaimError, checker.Rejected):
            return False
        trial = _Judge(replace(self.claim, printed=""), self.options)
        trial.known = self.known
        for part in statements:
            renamed = _renamed(part, f"{self.claim.id}/corrected.{part.name.split('/')[1]}")
            if trial.settle(renamed) != "certified":
                return False
        found, tried = self.found, trial.found
        found.statements += tried.statements
        found.certificates.update(tried.certificates)
        found.outcomes.update(tried.outcomes)
        found.votes.update(tried.votes)
        found.reused += tried.reused
        return True

    def is_refuted_by_sampling(self, parsed: checker.Statement) -> bool:
        from certificates.search.points import search_points

        if parsed.kind != "universal":
            return False
        checker.Unfolding(parsed, checker.Context())
        return search_points(parsed, self.known, Budget(QUICK_BUDGET), 0)[1] is not None

    # -------------------------------------------------------------- sharp ranges

    def find_sharp_range(self, prefix: str, assertion: Assertion) -> None:
        """The set of parameters in the whole domain on which the assertion holds, settled on both sides by the checker."""
        parts = [part for part in named_statements(self.claim.id, prefix, assertion) if isinstance(part, Statement)]
        ranged = [part for part in parts if any(keyword == "range" for keyword, _ in part.lines)]
        if not ranged or outcome_of(self.claim.id, prefix, assertion, self.found.outcomes) == "unknown":
            return
        over = tuple(name for name in self.claim.parameters if all(name in part.forall for part in ranged))
        whole = all(_has_whole_range(part) for part in ranged)
        if whole and all(self.found.outcomes[part.name] == "certified" for part in ranged):
            self.found.sharp[prefix] = {"text": "0 < alpha < 1", "by": [part.name for part in ranged]}
            return
        if not over:
            return
        name = f"{self.claim.id}/{prefix}sharp"
        stored = self.options.store.texts.get(name) if self.options.store else None
        earlier = {part.name: read(part.text(), part.name) for part in ranged}
        if stored is not None and stored.splitlines()[1] == "sharp " + " ".join(part.name for part in ranged):
            certificate = self.options.store.certificate(name, stored) if self.options.store else None
            remembered = (self.options.findings.get(self.claim.id) or {}).get("sharp", {}).get(prefix)
            outcome, _ = checker.check_one(read(stored, name), certificate, self.known, earlier)
            if outcome == "certified" and remembered:
                self.keep(name, stored, certificate, outcome)
                self.found.sharp[prefix] = {"text": remembered, "by": [name]}
                self.found.reused += 1
                return
        from certificates.search.sharp import find_sharp_range

        result = find_sharp_range(name, ranged, over, self.known, Budget(4 * self.options.budget), self.claim.hints.get("sharp"))
        if result is None:
            self.found.sharp[prefix] = {"text": "not found", "by": []}
            return
        sharp, certificate, shown = result
        outcome, reason = checker.check_one(read(sharp.text(), name), certificate, self.known, earlier)
        if outcome == "certified":
            self.keep(name, sharp.text(), certificate, outcome)
            self.found.sharp[prefix] = {"text": shown, "by": [name]}
        else:
            self.found.sharp[prefix] = {"text": f"not found ({reason})", "by": []}


def _with_prefix(body: Body) -> list[tuple[str, list[AnyStatement]]]:
    return [(prefix, named_statements("x", prefix, assertion)) for prefix, assertion in assertions(body)]


def _renamed(statement: AnyStatement, name: str) -> AnyStatement:
    if isinstance(statement, SharpRange):
        raise ClaimError("a sharp range cannot be renamed")
    return replace(statement, name=name)


def _has_whole_range(statement: Statement) -> bool:
    return {str(said) for keyword, said in statement.lines if keyword == "range"} == {"alpha > 0", "alpha < 1"}


def read(text: str, name: str) -> checker.Statement:
    """The statement as the checker reads it."""
    statement: checker.Statement = checker.read_statements(text)[name]
    return statement


def ordered_statements(judgements: Sequence[Judgement]) -> list[str]:
    """The texts of all statements in order: claims in the paper's order, each with its corrections and ranges behind it."""
    return [text for judgement in judgements for _, text in judgement.statements]
