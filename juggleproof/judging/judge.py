"""Judges one claim: states it, finds or reuses certificates, has the checker settle them, corrects
a refuted print, finds sharp ranges.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

from juggleproof.certificates import checker
from juggleproof.judging import limits, searches
from juggleproof.judging.claims import (
    REMARK,
    Argument,
    Assertion,
    Body,
    CheckedApart,
    Claim,
    Following,
    Verdict,
    as_body,
    assertions,
    awaited,
    named_statements,
    outcome_of,
    place_in_file,
    verdict_of,
)
from juggleproof.judging.correcting import CorrectedPrint, candidates
from juggleproof.judging.forms import has_whole_range, speaks_of_range
from juggleproof.judging.judgement import (
    Finding,
    Judgement,
    RecordedVotes,
    Resources,
    Sharp,
    digest,
    digest_of_question,
)
from juggleproof.judging.orbit_rules import read_rule
from juggleproof.judging.rule_ranges import range_of_rule, rule_domain, whole_text
from juggleproof.statements.definitions import formula_of
from juggleproof.statements.language import (
    AnyStatement,
    ClaimError,
    MapRule,
    SharpRange,
    Statement,
    conjunction,
    names_in,
    rests_on,
)
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.vote import Vote, VoteBudget, agree
from juggleproof.statements.work import read

NOT_FOUND = "not found"


def judge(claim: Claim, resources: Resources) -> Judgement:
    """The judgement on one claim.

    Raises ClaimError, one line that names the claim, where it cannot be stated; Disagreement where
    a route contradicts the checker.
    """
    one = Judge(claim, resources)
    try:
        return one.run()
    except (checker.Rejected, ClaimError) as problem:
        text = str(problem)
        raise ClaimError(
            f"{one.where}: " + (text if text.startswith(claim.id) else f"{claim.id}: {text}")
        ) from None


class Judge:
    """A judge of one claim, whose judgement grows as statements are settled."""

    def __init__(self, claim: Claim, resources: Resources) -> None:
        self.claim, self.resources, self.judgement = claim, resources, Judgement(claim.id)
        self.known: dict[str, checker.Statement] = {}
        self.premises: dict[str, dict[str, checker.Statement]] = {}  # of rules that were searched
        self.is_trial = self.lacks_lemmas = False
        self.where = claim.where  # file and line of the statement that is being settled

    @cached_property
    def search(self) -> searches.ClaimSearch:
        """The searches for the claim; they are loaded when a search is first needed."""
        return searches.ClaimSearch(
            self.resources.budget,
            self.claim.hints.get("search"),
            self.claim.vocabulary.roots.values(),
            self.claim.assumed,
            self.judgement.roles,
            self.known,
            self.judgement.outcomes,
            self.premises,
            self.judgement.unproved,
            self.is_trial,
        )

    @property
    def finding(self) -> Finding:
        """The finding of an earlier run about the claim."""
        return self.resources.findings.get(self.claim.id) or {}

    def run(self) -> Judgement:
        """The judgement: the claim is stated, each of its statements settled, a refuted print
        corrected, and the sharp ranges found.
        """
        claim, judgement = self.claim, self.judgement
        for name in claim.hints.get("uses", ()):
            if name.split("/")[0] != claim.id:
                self.lacks_lemmas |= name not in self.resources.lemmas
                if name in self.resources.lemmas:
                    self.known[name] = read(self.resources.lemmas[name], name)
        body = self.body()
        judgement.roles = claim.roles(
            [
                part
                for _, assertion in assertions(body)
                for part in assertion.parts
                if isinstance(part, Statement)
            ]
        )
        for prefix, assertion in assertions(body):
            self.settle_all(prefix, assertion)
        judgement.verdict = verdict_of(claim.id, body, judgement.outcomes)
        if isinstance(body, CheckedApart):
            judgement.checked_by = body.checker
        elif judgement.verdict.word == "false" and not isinstance(body, Following):
            self.correct(body)
            correction = judgement.correction
            judgement.verdict = verdict_of(
                claim.id,
                body,
                judgement.outcomes,
                corrected=correction is not None and correction["kind"] != "nearby",
            )
        if isinstance(body, (Following, Argument)):
            judgement.rests_on, judgement.follows = body.rests_on, isinstance(body, Following)
            judgement.awaits = awaited(body)
            judgement.is_conclusion = isinstance(body, Following) and body.is_conclusion
            judgement.by_rules = verdict_of(
                claim.id, body, {**judgement.outcomes, **dict.fromkeys(awaited(body), "certified")}
            )
        if not judgement.follows:  # an assertion beside a conclusion of map rules has no range
            for prefix, assertion in assertions(body):
                sharp = self.find_sharp_range(prefix, assertion)
                if sharp is not None:
                    judgement.sharp[prefix] = sharp
        self.settle_remark()
        return judgement

    def settle_remark(self) -> None:
        """Settles the assertion of the claim's remark; unless it is certified, the verdict becomes
        unknown.
        """
        beside = self.claim.shown_beside()
        if beside is None:
            return
        self.settle_all(REMARK, beside)
        if outcome_of(self.claim.id, REMARK, beside, self.judgement.outcomes) != "certified":
            unshown = Verdict("unknown", "its remark is not certified")
            self.judgement.verdict = self.judgement.by_rules = unshown

    def body(self) -> Body:
        """The body of the claim.

        Raises ClaimError for any exception of a claim function outside of this package.
        """
        try:
            return self.claim.body()
        except (checker.Rejected, ClaimError):
            raise
        except Exception as problem:
            if self.claim.source.startswith("juggleproof."):
                raise
            raise ClaimError(
                f"{self.claim.id} raises {type(problem).__name__}: {problem}; mend its function"
            ) from problem

    def settle_all(self, prefix: str, assertion: Assertion) -> None:
        """Settles the statements of an assertion, in order."""
        for statement in named_statements(self.claim.id, prefix, assertion):
            self.settle(statement)

    def settle(self, statement: AnyStatement) -> str:
        """The outcome of one statement, by a stored certificate that is still valid or by a
        search; a stored `unknown` is searched again, with this budget and the lemmas known now.
        """
        rule, rests = None, list[str]()
        self.where = self.claim.where
        if isinstance(statement, MapRule):
            self.where = self.place_of(statement)
            rule = read_rule(statement)
            rests = rests_on(rule)
        name, text = statement.name, statement.text()
        store = self.resources.store
        certificate: Certificate | None = store.certificate(name, text) if store else None
        if not self.known.keys() >= {*rests}:  # not all rules it rests on are certified
            certificate = None
        outcome = self.stored_outcome(name, text, certificate)
        if certificate is None or outcome in ("rejected", "unknown"):
            parsed = rule or read(text, name)
            for confirm in (False, True):
                certificate = self.search.certificate(statement, parsed, confirm, self.where)
                outcome = self.check(parsed, certificate)
                if outcome != "rejected":
                    break
            else:
                certificate, outcome = {"unknown": "the search found no certificate"}, "unknown"
        self.record(name, text, certificate, outcome)
        if isinstance(statement, Statement):
            self.judgement.votes[name] = self.votes(name, text, outcome)
        if rule and outcome == "certified":
            self.known[name] = rule
            premises = self.premises.get(name) or checker.premises_of(rule, self.known)
            for premise in premises.values():
                self.judgement.votes[premise.name] = self.votes(
                    premise.name, premise.text(), outcome
                )
        elif outcome == "certified" and name in self.claim.hints.get("uses", ()):
            self.known[name] = read(text, name)
        return outcome

    def place_of(self, rule: MapRule) -> str:
        """File and line of a rule, if it stands in the file of the claim; else of the claim."""
        place = place_in_file(*rule.place) if rule.place else ""
        own = self.claim.where.rpartition(":")[0]
        return place if place.rpartition(":")[0] == own else self.claim.where

    def stored_outcome(self, name: str, text: str, certificate: Certificate | None) -> str:
        """The checker's outcome of the stored certificate, from its reading of the store; it is
        asked again where it rejected the certificate there, or the store has other lemmas.
        """
        if certificate is None:
            return "rejected"
        stored = self.resources.store.texts if self.resources.store else {}
        as_stored = not self.lacks_lemmas and all(
            stored.get(one.name) == one.text() for one in self.known.values()
        )  # the checker read the store with these very lemmas
        outcome = self.resources.checked.get(name, "rejected") if as_stored else "rejected"
        return outcome if outcome != "rejected" else self.check(read(text, name), certificate)

    def votes(self, name: str, text: str, outcome: str) -> Sequence[Vote]:
        """One vote of each route: the recorded votes, if they are on the same question and none
        contradicts the outcome; else votes that are cast now.
        """
        routes, budget = (
            [route for route in self.resources.routes if route != "exact"],
            VoteBudget(),
        )
        recorded = self.resources.votes.get(self.claim.id)
        if not routes and not recorded:
            return ()
        on = digest_of_question(text, budget)
        earlier = recorded and recorded.get(on)
        if earlier:
            quoted = _as_votes(earlier, routes)
            if {vote.route for vote in quoted} == {*routes} and agree(name, outcome, quoted):
                self.judgement.recorded[name] = earlier
                return quoted
        if not routes:
            return ()
        votes: RecordedVotes = {
            "on": on,
            "votes": [
                {"route": vote.route, "answer": vote.answer, "detail": str(vote)}
                for vote in self.search.votes(name, text, outcome, routes, budget)
            ],
        }
        self.judgement.recorded[name] = votes
        return _as_votes(votes, routes)

    def check(self, statement: checker.Statement, certificate: Certificate) -> str:
        """The checker's outcome: certified, refuted, unknown or rejected."""
        return checker.check_one(statement, certificate, self.known, {})[0]

    def record(self, name: str, text: str, certificate: Certificate, outcome: str) -> None:
        """Adds a settled statement to the judgement.

        Raises ClaimError where another statement has its name.
        """
        if name in self.judgement.outcomes:
            raise ClaimError(
                f"{name} is the name of two statements, or of one and a sharp range; change a label"
            )
        self.judgement.statements.append((name, text))
        self.judgement.certificates[name] = certificate
        self.judgement.outcomes[name] = outcome

    # -------------------------------------------------------------- corrections

    def correct(self, body: Body) -> None:
        """Keeps the first correction that is certified: the true assertion nearby that the claim
        names, or a candidate print; the one that an earlier run found is tried first.
        """
        if self.nearby_is_certified() or not self.claim.printed or isinstance(body, Argument):
            return
        remembered = self.finding.get("correction")
        first = None if remembered is None else (remembered["kind"], remembered["text"])
        for candidate in candidates(self.claim, first):
            if self.candidate_is_certified(candidate):
                self.judgement.correction = {
                    "kind": candidate.kind,
                    "change": candidate.change,
                    "text": candidate.text,
                    "possible transcription error": candidate.possible_transcription_error,
                }
                return

    def nearby_is_certified(self) -> bool:
        """Whether the claim names a true assertion nearby that is certified; if so, it becomes the
        correction.
        """
        if self.claim.true_nearby is None:
            return False
        text, state = self.claim.true_nearby
        if not self.correction_is_certified(as_body(state(), self.claim.id), named=True):
            return False
        self.judgement.correction = {
            "kind": "nearby",
            "change": "a true assertion nearby",
            "text": text,
            "possible transcription error": False,
        }
        return True

    def candidate_is_certified(self, candidate: CorrectedPrint) -> bool:
        """Whether the claim, read with this print, is certified, and each name in the print has a
        meaning in its section; if so, the statements are kept under the names ID/corrected.LABEL.
        """
        try:
            if candidate.unbound(self.claim):
                return False
            named = candidate.kind == "marks"  # the claim names this candidate
            return self.correction_is_certified(self.claim.body(candidate.printed), named)
        except (ClaimError, checker.Rejected):
            return False

    def correction_is_certified(self, body: Body, named: bool) -> bool:
        """Whether every statement of a corrected body is certified; if so, they are kept.  A
        correction that the claim names gets the whole budget, one of many candidates a part.
        """
        try:
            statements = [
                _renamed(part, f"{self.claim.id}/corrected.{part.name.split('/')[1]}")
                for prefix, assertion in assertions(body)
                for part in named_statements("x", prefix, assertion)
            ]
            if not statements:
                return False
            if not all(map(self.is_stored_certified, statements)) and any(
                self.search.is_refuted_by_sampling(read(part.text(), part.name))
                for part in statements
            ):
                return False
        except (ClaimError, checker.Rejected):
            return False
        trial = self.trial(self.resources.budget // (1 if named else limits.TRIAL_SHARE))
        try:
            if any(trial.settle(part) != "certified" for part in statements):
                return False
        except ClaimError:  # its givens are contradictory, or a divisor may be 0
            return False
        tried = trial.judgement
        for name, text in tried.statements:
            self.record(name, text, tried.certificates[name], tried.outcomes[name])
            self.judgement.votes[name] = self.votes(name, text, tried.outcomes[name])
        return True

    def is_stored_certified(self, statement: AnyStatement) -> bool:
        """Whether the store holds this very statement, and the checker accepted its proof there, so
        that no point can refute it.
        """
        store, name = self.resources.store, statement.name
        return (
            store is not None
            and store.texts.get(name) == statement.text()
            and self.resources.checked.get(name) == "certified"
        )

    def trial(self, budget: int) -> Judge:
        """A judge of the same claim that settles candidates for its correction with this budget."""
        trial = Judge(self.claim, replace(self.resources, routes=("exact",), budget=budget))
        trial.known, trial.is_trial, trial.judgement.roles = self.known, True, self.judgement.roles
        return trial

    # -------------------------------------------------------------- sharp ranges

    def find_sharp_range(self, prefix: str, assertion: Assertion) -> Sharp | None:
        """The set of parameters in the whole domain on which the assertion holds, settled inside
        and outside by the checker; None where the assertion is not about a range, or is open.

        Statements that are certified with the whole domain as their range hold on all of it.  The
        range is that of all others: those about a range, and those that are not certified.
        """
        roles = self.judgement.roles
        sought = self.claim.over(roles)
        domains = {name: roles.domains.get(name, ()) for name in sought or (roles.parameter,)}
        named = named_statements(self.claim.id, prefix, assertion)
        outcomes = self.judgement.outcomes
        rules = [part.name for part in named if isinstance(part, MapRule)]
        if rules:
            return self.sharp_range_of_rule(rules[-1], named)
        parts = [part for part in named if isinstance(part, Statement)]
        ranged = [part for part in parts if speaks_of_range(part, domains)]
        if not ranged or outcome_of(self.claim.id, prefix, assertion, outcomes) == "unknown":
            return None
        others = [part for part in parts if part not in ranged]
        always_false = tuple(
            part.name
            for part in others
            if outcomes[part.name] == "refuted" and not domains.keys() & {*part.forall}
        )
        if always_false:  # refuted whatever the parameters are
            return Sharp("nowhere", always_false)
        open_parts = [
            part
            for part in parts
            if outcomes[part.name] != "certified"
            or part in ranged
            and not has_whole_range(part, domains)
        ]
        everywhere = tuple(part.name for part in ranged if part not in open_parts)
        if not open_parts:
            return Sharp(whole_text(roles), everywhere)
        over = tuple(name for name in sought if all(name in part.forall for part in open_parts))
        if not over:
            return None
        sharp = self.stored_sharp_range(prefix, open_parts, over) or self.new_sharp_range(
            prefix, open_parts, over
        )
        return replace(sharp, by=(*sharp.by, *everywhere)) if sharp.by else sharp

    def sharp_range_of_rule(self, name: str, parts: Sequence[AnyStatement]) -> Sharp | None:
        """The range for which the conclusion of a map rule of this claim is proved; None unless all
        parts of its assertion are certified, and its domain is contained in the domain of each map
        rule among them that it does not rest on.
        """
        if any(self.judgement.outcomes[part.name] != "certified" for part in parts):
            return None
        texts = {**self.resources.lemmas, **dict(self.judgement.statements)}
        rested_on = [name]
        for one in rested_on:
            if one not in texts:  # a rule of a claim that this one does not list in `uses`
                return None
            rows = (row.partition(" ") for row in texts[one].splitlines())
            rested_on += [rest for keyword, _, rest in rows if keyword in checker.NAMED]
        domain = rule_domain(name, texts)[0]
        others = {part.name for part in parts if isinstance(part, MapRule)} - {*rested_on}
        if not all(self.contains(rule_domain(one, texts)[0], domain) for one in sorted(others)):
            return None
        text = range_of_rule(name, texts, self.claim.stated(self.judgement.roles))
        return Sharp(text, (name,)) if text else None

    def contains(self, outer: str, inner: str) -> bool:
        """Whether the checker accepts a quick proof that the outer domain contains the inner one;
        conditions of the outer one that share no variable with the inner one are not asked for.
        """
        if not outer or not inner:
            return not outer
        formula = formula_of(checker.parse(outer))
        parts = formula.parts if formula.op == "and" else (formula,)
        within = [part for part in parts if names_in(part) & checker.names_in(inner)]
        names = sorted(checker.names_in(inner).union(*map(names_in, within)))
        text = f"forall {' '.join(names)}\ngiven {inner}\nshow {conjunction(within)}"
        name = f"{self.claim.id}/contained"
        try:
            parsed = read(f"statement {name}\n{text}", name)
            found = self.search.certificate_of_inclusion(parsed)
        except checker.Rejected:
            return False
        return "certified" in found and self.check(parsed, found) == "certified"

    def stored_sharp_range(
        self, prefix: str, parts: Sequence[Statement], over: Sequence[str]
    ) -> Sharp | None:
        """The stored sharp range of these statements, if the checker accepts it and its domain is
        the whole domain.
        """
        name, store = f"{self.claim.id}/{prefix}sharp", self.resources.store
        text = store.texts.get(name) if store else None
        if store is None or text is None:
            return None
        if text.splitlines()[1] != "sharp " + " ".join(part.name for part in parts):
            return None
        certificate = store.certificate(name, text)
        if certificate is None or self.sharp_outcome(name, text, certificate, parts) != "certified":
            return None
        shown = searches.text_of_range(
            text, parts, over, self.judgement.roles, self.resources.budget
        )
        if shown is None:
            return None
        self.record(name, text, certificate, "certified")
        return Sharp(shown, (name,))

    def new_sharp_range(
        self, prefix: str, parts: Sequence[Statement], over: Sequence[str]
    ) -> Sharp:
        """The sharp range of these statements by a search, unless the same search failed in an
        earlier run.
        """
        name = f"{self.claim.id}/{prefix}sharp"
        tried = digest(f"{self.resources.budget}\n" + "\n".join(part.text() for part in parts))
        if self.finding.get("not found", {}).get(prefix) == tried:
            return Sharp(NOT_FOUND, tried=tried)
        roles, budget = self.judgement.roles, self.resources.budget
        result = searches.search_sharp_range(
            name, parts, over, self.known, limits.SHARP_FACTOR * budget, roles
        )
        if result is None:
            return Sharp(NOT_FOUND, tried=tried)
        sharp, proof = result
        certificate: Certificate = {"certified": proof}
        earlier = {part.name: read(part.text(), part.name) for part in parts}
        outcome, reason = checker.check_one(
            read(sharp.text(), name), certificate, self.known, earlier
        )
        shown = searches.text_of_range(sharp.text(), parts, over, roles, budget)
        if outcome != "certified" or shown is None:
            return Sharp(f"{NOT_FOUND} ({reason or 'not on the whole domain'})")
        self.record(name, sharp.text(), certificate, outcome)
        return Sharp(shown, (name,))

    def sharp_outcome(
        self, name: str, stored: str, certificate: Certificate, ranged: Sequence[Statement]
    ) -> str:
        """The checker's outcome of a stored sharp range; it is asked again where one of the
        statements of the range is not as stored.
        """
        texts = self.resources.store.texts if self.resources.store else {}
        if self.resources.checked.get(name) == "certified" and all(
            texts.get(part.name) == part.text() for part in ranged
        ):
            return "certified"
        earlier = {one.name: read(one.text(), one.name) for one in ranged}
        return checker.check_one(read(stored, name), certificate, self.known, earlier)[0]


def _as_votes(recorded: RecordedVotes, routes: Sequence[str]) -> tuple[Vote, ...]:
    """The recorded votes of these routes."""
    return tuple(
        Vote(one["route"], one["answer"], one["detail"])
        for one in recorded["votes"]
        if one["route"] in routes
    )


def _renamed(statement: AnyStatement, name: str) -> AnyStatement:
    if isinstance(statement, SharpRange):
        raise ClaimError("a sharp range cannot be renamed")
    return replace(statement, name=name)
