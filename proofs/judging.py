"""Judges one claim: states it, finds or reuses certificates, has the checker settle them, corrects
what is refuted, finds sharp ranges.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from importlib.metadata import version
from typing import Any

from juggleproof.certificates import checker
from juggleproof.certificates.language import (
    AnyStatement,
    ClaimError,
    Iterates,
    MapRule,
    SharpRange,
    Statement,
)
from juggleproof.certificates.store import Store
from juggleproof.certificates.votes.vote import Vote, cast_votes, compare
from juggleproof.certificates.work import Budget, Exhausted
from juggleproof.proofs.claims import (
    Argument,
    Assertion,
    Body,
    Claim,
    Following,
    Readings,
    Verdict,
    assertions,
    named_statements,
    outcome_of,
    verdict_of,
)
from juggleproof.proofs.derivations import Derivation, behind, body_and_derivations
from juggleproof.proofs.forms import (
    has_whole_range,
    read,
    refuse_what_says_nothing,
    speaks_of_range,
)
from juggleproof.proofs.kept import record_of
from juggleproof.proofs.rules import range_of_rule

DEFAULT_BUDGET = 2_000_000
QUICK_BUDGET = 150_000
TRIAL = 10  # a candidate correction, or a look for a contradiction, gets this part of the budget
NOT_FOUND = "not found"
SHARP = 3  # a sharp range takes many proofs and families, each with this part of the budget at most


@dataclass(frozen=True)
class Options:
    """How to judge: which routes vote, how much counted work a statement may take, and what an
    earlier run found.

    `checked` is what the checker said of the stored statements, by name, when it read the whole
    store at the start of this run.
    """

    routes: tuple[str, ...] = ("exact", "z3", "boxes")
    budget: int = DEFAULT_BUDGET
    store: Store | None = None
    findings: Mapping[str, Any] = field(default_factory=dict)
    lemmas: Mapping[str, str] = field(default_factory=dict)
    checked: Mapping[str, str] = field(default_factory=dict)

    def only(self, claim: Claim) -> Options:
        """What these options say of one claim, with the stored certificates read, so that no folder
        is needed.
        """
        used = {claim.id, *(name.split("/")[0] for name in claim.hints.get("uses", ()))}
        ours = {name: said for name, said in self.checked.items() if name.split("/")[0] in used}
        findings = {claim.id: self.findings[claim.id]} if claim.id in self.findings else {}
        return replace(
            self,
            store=self.store.only(used) if self.store else None,
            findings=findings,
            checked=ours,
            lemmas={
                name: text
                for name, text in self.lemmas.items()
                if name in claim.hints.get("uses", ())
            },
        )


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
    recorded: dict[str, Any] = field(default_factory=dict)
    rests_on: tuple[str, ...] = ()  # map rules, as a rule of other claims
    by_rules: Verdict = field(
        default_factory=lambda: Verdict("unknown")
    )  # the verdict if they are certified
    follows: bool = False
    reused: int = 0
    record: Any = None

    def finding(self) -> dict[str, Any]:
        """What a later run may try first: the correction and the votes."""
        data: dict[str, Any] = {
            "sharp": {prefix: one["text"] for prefix, one in self.sharp.items()}
        }
        tried = {prefix: one["tried"] for prefix, one in self.sharp.items() if "tried" in one}
        if tried:
            data["not found"] = tried
        if self.correction:
            data["correction"] = self.correction
        if self.recorded:
            data["votes"] = self.recorded
        return data


def judge(claim: Claim, options: Options) -> Judgement:
    """The judgement on one claim.

    Raises ClaimError, one line that names the claim, where it cannot be stated; Disagreement where
    a route contradicts the checker.
    """
    try:
        return Judge(claim, options).run()
    except (checker.Rejected, ClaimError) as problem:
        text = str(problem)
        raise ClaimError(
            f"{claim.where}: " + (text if text.startswith(claim.id) else f"{claim.id}: {text}")
        ) from None


class Judge:
    """One claim on its way to a judgement."""

    def __init__(self, claim: Claim, options: Options) -> None:
        self.claim, self.options, self.found = claim, options, Judgement(claim.id)
        self.known: dict[str, checker.Statement] = {}
        self.derivations: list[Derivation] = []
        self.is_trial = False

    def run(self) -> Judgement:
        claim, found = self.claim, self.found
        for name in (
            name for name in claim.hints.get("uses", ()) if name.split("/")[0] != claim.id
        ):
            self.known[name] = read(self.options.lemmas[name], name)
        body = self.body()
        for prefix, assertion in assertions(body):
            self.settle_all(prefix, assertion)
        found.verdict = verdict_of(claim.id, body, found.outcomes)
        if (
            found.verdict.word == "false"
            and (claim.printed or claim.true_nearby)
            and isinstance(body, (Assertion, Readings))
        ):
            self.correct()
            found.verdict = verdict_of(
                claim.id, body, found.outcomes, corrected=found.correction is not None
            )
        if isinstance(body, (Following, Argument)):
            found.rests_on, found.follows = body.rests_on, isinstance(body, Following)
            found.by_rules = verdict_of(
                claim.id, body, {**found.outcomes, **dict.fromkeys(body.rests_on, "certified")}
            )
        for prefix, assertion in assertions(body):
            if (
                not found.follows
            ):  # what stands beside a conclusion of map rules has no range of its own
                self.find_sharp_range(prefix, assertion)
        self.record(body)
        return found

    def record(self, body: Body) -> None:
        """Notes what a later run can know the claim again by."""
        record = record_of(
            self.claim, body, self.found.statements, self.found.votes, self.found.correction
        )
        if record:
            used = [one.function for one in self.derivations]
            self.found.record = {
                **record,
                "derivations": used,
                "behind": [one.data() for one in behind(self.derivations)],
            }

    def body(self) -> Body:
        """What the claim asserts; the derivations that it uses are noted."""
        body, self.derivations = body_and_derivations(self.claim)
        return body

    def settle_all(self, prefix: str, assertion: Assertion) -> None:
        for statement in named_statements(self.claim.id, prefix, assertion):
            self.settle(statement)

    def settle(self, statement: AnyStatement) -> str:
        """The outcome of one statement, by a stored certificate that is still valid or by a
        search.
        """
        name, text = statement.name, statement.text()
        certificate = self.options.store.certificate(name, text) if self.options.store else None
        outcome = self.stored_outcome(name, text, certificate)
        self.found.reused += outcome != "rejected"
        if outcome == "rejected":
            parsed = read(text, name)
            certificate = self.search(statement, parsed, confirm=False)
            outcome = self.check(parsed, certificate)
            if outcome == "rejected":
                certificate = self.search(statement, parsed, confirm=True)
                outcome = self.check(parsed, certificate)
            if outcome == "rejected":
                certificate, outcome = {"unknown": "the search found no certificate"}, "unknown"
        self.keep(name, text, certificate, outcome)
        if isinstance(statement, Statement):
            self.found.votes[name] = self.votes(name, text, outcome)
        if isinstance(statement, MapRule) and outcome == "certified":
            self.known[name] = read(text, name)
            for premise in checker.premises_of(self.known[name], self.known).values():
                self.found.votes[premise.name] = self.votes(premise.name, premise.text(), outcome)
        elif outcome == "certified" and name in self.claim.hints.get("uses", ()):
            self.known[name] = read(text, name)
        return outcome

    def stored_outcome(self, name: str, text: str, certificate: Any) -> str:
        """What the checker said of the stored certificate when it read the store; asked again where
        it rejected it there, or read other lemmas.
        """
        if certificate is None:
            return "rejected"
        stored = self.options.store.texts if self.options.store else {}
        as_stored = all(
            stored.get(one.name) == one.text() for one in self.known.values()
        )  # else what it rests on is not what was read there
        outcome = self.options.checked.get(name, "rejected") if as_stored else "rejected"
        return outcome if outcome != "rejected" else self.check(read(text, name), certificate)

    def votes(self, name: str, text: str, outcome: str) -> Sequence[Vote]:
        """One vote a route; a vote that an earlier run recorded on this very text, with these
        tools, is not cast again.
        """
        routes = [route for route in self.options.routes if route != "exact"]
        earlier = (self.options.findings.get(self.claim.id) or {}).get("votes", {}).get(name)
        if (
            earlier
            and earlier.get("on") == _voted_on(text)
            and set(routes) <= {one["route"] for one in earlier["votes"]}
        ):
            recorded = [
                Vote(one["route"], one["answer"], one["detail"])
                for one in earlier["votes"]
                if one["route"] in routes
            ]
            compare(name, outcome, recorded)
            self.found.recorded[name] = earlier
            return recorded
        cast = self.cast(name, text, outcome, routes) if routes else ()
        if set(routes) == {"z3", "boxes"}:
            self.found.recorded[name] = {
                "on": _voted_on(text),
                "votes": [
                    {"route": vote.route, "answer": vote.answer, "detail": str(vote)}
                    for vote in cast
                ],
            }
        return cast

    def cast(self, name: str, text: str, outcome: str, routes: Sequence[str]) -> Sequence[Vote]:
        return cast_votes(read(text, name), outcome, routes, None)

    def search(self, statement: AnyStatement, parsed: checker.Statement, confirm: bool) -> Any:
        if isinstance(statement, (Iterates, MapRule)):
            from juggleproof.certificates.search.certificate import search_map_rule

            return search_map_rule(
                parsed, self.known, self.options.budget, self.claim.hints.get("premises")
            )
        from juggleproof.certificates.search.certificate import search_certificate

        try:
            found = search_certificate(
                parsed,
                self.known,
                Budget(self.options.budget),
                self.claim.hints.get("search"),
                confirm,
            )
        except Exhausted:
            found = {"unknown": f"the budget of {self.options.budget} units ran out"}
        if "certified" not in found and isinstance(statement, Statement) and not self.is_trial:
            refuse_what_says_nothing(
                statement, next(iter(found)), self.known, self.options.budget // TRIAL
            )
        return found

    def check(self, statement: checker.Statement, certificate: Any) -> str:
        outcome, _ = checker.check_one(statement, certificate, self.known, {})
        return str(outcome)

    def keep(self, name: str, text: str, certificate: Any, outcome: str) -> None:
        self.found.statements.append((name, text))
        self.found.certificates[name] = certificate
        self.found.outcomes[name] = outcome

    # -------------------------------------------------------------- corrections

    def correct(self) -> None:
        """The first candidate print that the same claim certifies; an earlier finding is tried
        first.
        """
        from juggleproof.proofs.correcting import correct

        correct(self)

    def trial(self) -> Judge:
        """A judge of the same claim that settles what may correct it, with less work."""
        trial = Judge(
            self.claim,
            replace(self.options, routes=("exact",), budget=self.options.budget // TRIAL),
        )
        trial.known, trial.is_trial = self.known, True
        return trial

    def is_refuted_by_sampling(self, parsed: checker.Statement) -> bool:
        from juggleproof.certificates.search.points import search_found
        from juggleproof.certificates.work import unfolded

        if parsed.kind != "universal":
            return False
        unfolded(parsed)
        start: checker.State = checker.State(checker.Context())
        return (
            search_found(
                parsed, start, "counterexample", {}, self.known, Budget(QUICK_BUDGET), effort=0
            )
            is not None
        )

    # -------------------------------------------------------------- sharp ranges

    def find_sharp_range(self, prefix: str, assertion: Assertion) -> None:
        """The set of parameters in the whole domain on which the assertion holds, settled on both
        sides by the checker.

        Statements that are certified with the whole range 0 < alpha < 1 hold on all of it: the
        others decide.
        """
        rules = [
            part.name
            for part in named_statements(self.claim.id, prefix, assertion)
            if isinstance(part, MapRule)
        ]
        if rules:
            text = (
                range_of_rule(rules[-1], dict(self.found.statements))
                if self.found.outcomes[rules[-1]] == "certified"
                else ""
            )
            if text:
                self.found.sharp[prefix] = {"text": text, "by": rules[-1:]}
            return
        parts = [
            part
            for part in named_statements(self.claim.id, prefix, assertion)
            if isinstance(part, Statement)
        ]
        ranged = [part for part in parts if speaks_of_range(part)]
        if (
            not ranged
            or outcome_of(self.claim.id, prefix, assertion, self.found.outcomes) == "unknown"
        ):
            return
        always_false = [
            part.name
            for part in parts
            if part not in ranged and self.found.outcomes[part.name] == "refuted"
        ]
        if always_false:  # refuted whatever alpha is
            self.found.sharp[prefix] = {"text": "nowhere", "by": always_false}
            return
        open_parts = [
            part
            for part in ranged
            if not (has_whole_range(part) and self.found.outcomes[part.name] == "certified")
        ]
        everywhere = [part.name for part in ranged if part not in open_parts]
        if not open_parts:
            self.found.sharp[prefix] = {"text": "0 < alpha < 1", "by": everywhere}
            return
        over = tuple(
            name
            for name in self.claim.parameters
            if all(name in part.forall for part in open_parts)
        )
        if not over:
            return
        name = f"{self.claim.id}/{prefix}sharp"
        stored = self.options.store.texts.get(name) if self.options.store else None
        if stored is not None and stored.splitlines()[1] == "sharp " + " ".join(
            part.name for part in open_parts
        ):
            certificate = (
                self.options.store.certificate(name, stored) if self.options.store else None
            )
            remembered = (
                (self.options.findings.get(self.claim.id) or {}).get("sharp", {}).get(prefix)
            )
            if (
                remembered
                and self.sharp_outcome(name, stored, certificate, open_parts) == "certified"
            ):
                self.keep(name, stored, certificate, "certified")
                self.found.sharp[prefix] = {"text": remembered, "by": [name, *everywhere]}
                self.found.reused += 1
                return
        tried = _voted_on(
            f"{self.options.budget}\n" + "\n".join(part.text() for part in open_parts)
        )
        remembered = (
            (self.options.findings.get(self.claim.id) or {}).get("not found", {}).get(prefix)
        )
        if remembered == tried:
            self.found.sharp[prefix] = {"text": NOT_FOUND, "by": [], "tried": tried}
            return
        result = self.search_sharp(name, open_parts, over)
        if result is None:
            self.found.sharp[prefix] = {"text": NOT_FOUND, "by": [], "tried": tried}
            return
        sharp, found, shown = result
        certificate = {"certified": found}
        earlier = {part.name: read(part.text(), part.name) for part in open_parts}
        outcome, reason = checker.check_one(
            read(sharp.text(), name), certificate, self.known, earlier
        )
        if outcome == "certified":
            self.keep(name, sharp.text(), certificate, outcome)
            self.found.sharp[prefix] = {"text": shown, "by": [name, *everywhere]}
        else:
            self.found.sharp[prefix] = {"text": f"not found ({reason})", "by": []}

    def search_sharp(
        self, name: str, ranged: Sequence[Statement], over: Sequence[str]
    ) -> tuple[SharpRange, Any, str] | None:
        """The sharp range with its certificate and how it is told, if the search finds one."""
        from juggleproof.proofs.ranges import search_sharp_range

        return search_sharp_range(name, ranged, over, self.known, SHARP * self.options.budget)

    def sharp_outcome(
        self, name: str, stored: str, certificate: Any, ranged: Sequence[Statement]
    ) -> str:
        """What the checker said of a stored sharp range; it is asked again where a statement that
        is ranged over is not as stored.
        """
        texts = self.options.store.texts if self.options.store else {}
        if self.options.checked.get(name) == "certified" and all(
            texts.get(part.name) == part.text() for part in ranged
        ):
            return "certified"
        return str(
            checker.check_one(
                read(stored, name),
                certificate,
                self.known,
                {one.name: read(one.text(), one.name) for one in ranged},
            )[0]
        )


@cache
def _tools() -> str:
    return " ".join(version(tool) for tool in ("z3-solver", "python-flint", "mpmath"))


def _voted_on(text: str) -> str:
    """What a vote is about: the text of the statement, and the versions of the tools that voted."""
    return hashlib.sha256(f"{_tools()}\n{text}".encode()).hexdigest()[:16]
