"""Judges one claim: states it, finds or reuses certificates, has the checker settle them, corrects
what is refuted, finds sharp ranges.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from juggleproof.certificates import checker
from juggleproof.certificates.definitions import formula_of
from juggleproof.certificates.language import (
    NO_ROLES,
    AnyStatement,
    ClaimError,
    Formula,
    Iterates,
    MapRule,
    Roles,
    SharpRange,
    Statement,
    conjunction,
    disjunction,
    names_in,
    rests_on,
)
from juggleproof.certificates.nodes import Certificate, Counterexample
from juggleproof.certificates.search.certificate import search_certificate, search_premises
from juggleproof.certificates.search.closing import search_closing
from juggleproof.certificates.search.points import search_values
from juggleproof.certificates.states import State, state_of
from juggleproof.certificates.votes.casting import cast_votes
from juggleproof.certificates.votes.vote import Budget as Asking
from juggleproof.certificates.votes.vote import Vote, agree
from juggleproof.certificates.votes.z3 import Model, vote_and_model
from juggleproof.certificates.work import Budget, Exhausted, unfolded
from juggleproof.proofs.claims import (
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
    stated_texts,
    verdict_of,
)
from juggleproof.proofs.correcting import Candidate, candidates
from juggleproof.proofs.evaluating import at_simple_values, is_simple
from juggleproof.proofs.forms import (
    has_whole_range,
    read,
    speaks_of_range,
)
from juggleproof.proofs.judgement import (
    Finding,
    Judgement,
    RecordedVotes,
    Resources,
    Sharp,
    digest,
    digest_of_question,
)
from juggleproof.proofs.orbit_rules import premises_of, read_rule, why
from juggleproof.proofs.ranges import (
    range_of_rule,
    rule_domain,
    search_sharp_range,
    text_of_range,
    whole_text,
)

QUICK_BUDGET = 150_000
TRIAL = 10  # a candidate correction, or a look for a contradiction, gets this part of the budget
NOT_FOUND = "not found"
SHARP = 3  # a sharp range takes many proofs and families, each with this part of the budget at most


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


def settle_by_rules(
    judgements: Sequence[Judgement],
    outcomes: Mapping[str, str],
    texts: Mapping[str, str],
    claims: Mapping[str, Claim],
) -> None:
    """Gives each judgement that rests on map rules or on a claim its verdict and range, now that
    the outcomes of all statements are known, with their texts; the claims state what these should
    be.
    """
    stated = dict[str, str]()
    above = list[str]()

    def stands(name: str) -> bool:
        """Whether the claim holds by the outcomes of its statements as stated, and by what it
        awaits, which is not itself.
        """
        claim = claims.get(name)
        if claim is None or name in above:
            return False
        above.append(name)
        settled = {
            one: outcomes.get(one, "unknown")
            for one, text in stated_texts(claim).items()
            if texts.get(one) == text
        }
        body, beside = claim.body(), claim.shown_beside()
        settled.update((one, "certified") for one in awaited(body) if holds(one))
        above.pop()
        if beside and outcome_of(name, REMARK, beside, settled) != "certified":
            return False
        return verdict_of(name, body, settled).word == "holds"

    def holds(name: str) -> bool:
        """Whether the claim stands, or the rule is certified, and it and all that it rests on are
        rules, and as stated.
        """
        if "/" not in name:
            return stands(name)
        names = [name] if outcomes.get(name) == "certified" else []
        for one in names:
            claim = claims.get(one.split("/")[0])
            if one not in stated and claim is not None:
                stated.update(stated_texts(claim))
            if one not in stated or texts.get(one) != stated[one]:
                return False
            rule = read(stated[one], one)
            if rule.kind not in checker.orbit_rules():
                return False
            names += [each for each in rests_on(rule) if each not in names]
        return bool(names)

    for one in judgements:
        if one.awaits and all(map(holds, one.awaits)):
            one.verdict = one.by_rules
        if one.follows:
            held = one.verdict.word == "holds"
            text = (
                range_of_rule(
                    one.rests_on[-1], texts, _stated(one.roles, claims[one.id]), one.is_conclusion
                )
                if held
                else NOT_FOUND
            )
            one.sharp[""] = Sharp(text, one.rests_on)


def refuse_vacuous(
    statement: Statement,
    outcome: str,
    known: dict[str, checker.Statement],
    budget: int,
    roles: Roles = NO_ROLES,
) -> None:
    """Raises ClaimError where the hypotheses of a statement contradict one another, or do not keep
    a denominator from vanishing.
    """

    def is_refuted(part: Statement) -> bool:
        try:
            return "refuted" in search_certificate(
                read(part.text(), part.name), known, Budget(budget), roles=roles
            )
        except Exhausted:
            return False

    for index, (keyword, formula) in enumerate(statement.lines):
        if keyword == "have" and isinstance(formula, Formula):
            before = Statement(
                statement.name,
                statement.forall,
                statement.lines[:index],
                formula,
                statement.integer,
            )
            if is_refuted(before):
                raise ClaimError(
                    f"{statement.name}: division by what may vanish ({formula} does not follow); "
                    "add a given that keeps it from 0"
                )
    if outcome == "refuted":
        return
    impossible = Statement(
        statement.name, statement.forall, statement.lines, disjunction([]), statement.integer
    )
    unfolding = checker.Unfolding(read(impossible.text(), impossible.name), checker.Context())
    try:
        impossible_for_all = search_closing(state_of(unfolding), known, Budget(budget)) is not None
    except Exhausted:
        impossible_for_all = False
    if impossible_for_all:
        raise ClaimError(
            f"{statement.name}: its hypotheses contradict one another, so it would say nothing;"
            " drop or mend a given"
        )


class Judge:
    """One claim on its way to a judgement."""

    def __init__(self, claim: Claim, resources: Resources) -> None:
        self.claim, self.resources, self.judgement = claim, resources, Judgement(claim.id)
        self.known: dict[str, checker.Statement] = {}
        self.premises: dict[str, dict[str, checker.Statement]] = {}  # of rules that were searched
        self.is_trial = self.lacks_lemmas = False
        self.where = claim.where  # file and line of what is settled

    @property
    def finding(self) -> Finding:
        """What an earlier run found about the claim."""
        return self.resources.findings.get(self.claim.id) or {}

    def run(self) -> Judgement:
        """The claim stated, each of its statements settled, a refuted print corrected, and the
        sharp ranges found.
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
        if not judgement.follows:  # what stands beside a conclusion of map rules has no range
            for prefix, assertion in assertions(body):
                sharp = self.find_sharp_range(prefix, assertion)
                if sharp is not None:
                    judgement.sharp[prefix] = sharp
        self.settle_remark()
        return judgement

    def settle_remark(self) -> None:
        """Settles what the remark of the claim states, which has to be certified."""
        beside = self.claim.shown_beside()
        if beside is None:
            return
        self.settle_all(REMARK, beside)
        if outcome_of(self.claim.id, REMARK, beside, self.judgement.outcomes) != "certified":
            unshown = Verdict("unknown", "its remark is not certified")
            self.judgement.verdict = self.judgement.by_rules = unshown

    def body(self) -> Body:
        """What the claim asserts.

        Raises ClaimError for whatever the function of a claim outside of this package raises.
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
        search; what was unknown is searched again, by this budget and from what is known now.
        """
        rests: list[str] = []
        self.where = self.claim.where
        if isinstance(statement, MapRule):
            self.where = self.place_of(statement)
            rests = rests_on(read_rule(statement))
        name, text = statement.name, statement.text()
        store = self.resources.store
        certificate: Certificate | None = store.certificate(name, text) if store else None
        if not self.known.keys() >= {*rests}:  # what was certified of other rules says nothing
            certificate = None
        outcome = self.stored_outcome(name, text, certificate)
        if certificate is None or outcome in ("rejected", "unknown"):
            parsed = read(text, name)
            certificate = self.search(statement, parsed, confirm=False)
            outcome = self.check(parsed, certificate)
            if outcome == "rejected":
                certificate = self.search(statement, parsed, confirm=True)
                outcome = self.check(parsed, certificate)
            if outcome == "rejected":
                certificate, outcome = {"unknown": "the search found no certificate"}, "unknown"
        self.record(name, text, certificate, outcome)
        if isinstance(statement, Statement):
            self.judgement.votes[name] = self.votes(name, text, outcome)
        if isinstance(statement, MapRule) and outcome == "certified":
            self.known[name] = read(text, name)
            premises = self.premises.get(name) or checker.premises_of(self.known[name], self.known)
            for premise in premises.values():
                self.judgement.votes[premise.name] = self.votes(
                    premise.name, premise.text(), outcome
                )
        elif outcome == "certified" and name in self.claim.hints.get("uses", ()):
            self.known[name] = read(text, name)
        return outcome

    def place_of(self, rule: MapRule) -> str:
        """File and line of a rule, where it stands in the file of the claim; else of the claim."""
        place = place_in_file(*rule.place) if rule.place else ""
        own = self.claim.where.rpartition(":")[0]
        return place if place.rpartition(":")[0] == own else self.claim.where

    def search_rule(
        self, rule: checker.Statement, lemmas: Mapping[str, Sequence[str]], confirm: bool
    ) -> Certificate:
        """A proof of each premise of a map rule, or why some have none; with `confirm` the checker
        confirms each before the search goes on.

        Raises ClaimError where the premises cannot be written, and for a lemma that is for none of
        them, or cannot be read.
        """
        stated = {**self.judgement.outcomes, **self.known}
        premises = premises_of(rule, self.known, stated)
        if isinstance(premises, str):
            return {"unknown": premises}
        self.premises[rule.name] = premises
        for name in lemmas:
            if name not in premises or premises[name].get("exists"):
                raise ClaimError(
                    f"{rule.name}: the line `lemma {name}: ..` names no premise; name one"
                    f" of {', '.join(one for one in premises if one != 'possible')}"
                )
        answers: dict[str, tuple[Vote, Model | None]] = {}

        def is_false(name: str) -> bool:
            answers[name] = vote_and_model(premises[name])
            return answers[name][1] is not None

        budget = self.resources.budget
        try:
            found = dict(search_premises(premises, self.known, budget, lemmas, is_false, confirm))
        except checker.Rejected as reason:
            raise ClaimError(f"{rule.name}: {reason}") from None
        proofs = {name: proof for name, proof in found.items() if proof is not None}
        if proofs.keys() == found.keys():
            return {"certified": proofs}
        reasons = {
            name: why(rule.kind, name, premises[name], answers[name], budget)
            for name in found
            if name not in proofs
        }
        self.judgement.unproved[rule.name] = [premises[name].text() for name in reasons]
        count = f"{len(reasons)} of the {len(premises)} premises of `{rule.kind}` at {self.where}:"
        between = "\n  " if len(reasons) > 1 else " "
        return {"unknown": between.join([count, *reasons.values()])}

    def stored_outcome(self, name: str, text: str, certificate: Certificate | None) -> str:
        """The checker's outcome of the stored certificate when it read the store; it is asked again
        where it rejected the certificate there, or read other lemmas.
        """
        if certificate is None:
            return "rejected"
        stored = self.resources.store.texts if self.resources.store else {}
        as_stored = not self.lacks_lemmas and all(
            stored.get(one.name) == one.text() for one in self.known.values()
        )  # else what it rests on is not what was read there
        outcome = self.resources.checked.get(name, "rejected") if as_stored else "rejected"
        return outcome if outcome != "rejected" else self.check(read(text, name), certificate)

    def votes(self, name: str, text: str, outcome: str) -> Sequence[Vote]:
        """One vote a route: as it is on record, where the very same was asked and no vote
        contradicts the outcome, or else cast now.
        """
        routes, budget = [route for route in self.resources.routes if route != "exact"], Asking()
        on = digest_of_question(text, budget)
        earlier = self.resources.votes.get(self.claim.id, {}).get(on)
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
                for vote in cast_votes(read(text, name), outcome, routes, budget)
            ],
        }
        self.judgement.recorded[name] = votes
        return _as_votes(votes, routes)

    def search(
        self, statement: AnyStatement, parsed: checker.Statement, confirm: bool
    ) -> Certificate:
        """A certificate by a search, or the reason why there is none; with `confirm` the checker
        confirms each node before the search goes on.

        Raises ClaimError where the hypotheses contradict one another, or do not keep a denominator
        from vanishing.
        """
        hints, budget = self.claim.hints, self.resources.budget
        if isinstance(statement, (Iterates, MapRule)):
            return self.search_rule(parsed, getattr(statement, "lemmas", {}), confirm)
        certificate: Certificate
        try:
            certificate = search_certificate(
                parsed,
                self.known,
                Budget(budget),
                hints.get("search"),
                confirm,
                roles=self.judgement.roles,
            )
        except Exhausted:
            certificate = {"unknown": f"the budget of {budget} units ran out"}
        if isinstance(statement, Statement) and not self.is_trial:
            certificate = self.in_simple_values(statement, certificate)
        if "certified" not in certificate and isinstance(statement, Statement):
            if not self.is_trial:
                outcome = "refuted" if "refuted" in certificate else "unknown"
                refuse_vacuous(
                    statement, outcome, self.known, budget // TRIAL, self.judgement.roles
                )
        return certificate

    def in_simple_values(self, statement: Statement, certificate: Certificate) -> Certificate:
        """The counterexample of a refutation in simple rationals, where a search with the parameter
        at a simple value finds one that the checker accepts; else the refutation as it is.
        """
        found, parameter = certificate.get("refuted"), self.judgement.roles.parameter
        if not isinstance(found, Counterexample) or is_simple(found):
            return certificate
        if parameter not in found.terms:
            return certificate
        for one in at_simple_values(statement, parameter, self.claim.vocabulary.roots.values()):
            budget = Budget(self.resources.budget // TRIAL)
            try:
                there = search_certificate(
                    read(one.text(), one.name), self.known, budget, roles=self.judgement.roles
                ).get("refuted")
            except Exhausted:
                continue
            if isinstance(there, Counterexample) and is_simple(there):
                simple: Certificate = {"refuted": there._replace(node=("close",))}
                if self.check(read(statement.text(), statement.name), simple) == "refuted":
                    return simple
        return certificate

    def check(self, statement: checker.Statement, certificate: Certificate) -> str:
        """The checker's outcome: certified, refuted, unknown or rejected."""
        return checker.check_one(statement, certificate, self.known, {})[0]

    def record(self, name: str, text: str, certificate: Certificate, outcome: str) -> None:
        """Adds a settled statement to the judgement.

        Raises ClaimError where its name is that of another one.
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
        names, or a candidate print, of which the one that an earlier run found is tried first.
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
        """Whether the claim names a true assertion nearby that is certified; if so it is the
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

    def candidate_is_certified(self, candidate: Candidate) -> bool:
        """Whether the claim, read with this print, is certified, and each name in it is bound
        where it stands; if so its statements are kept as ID/corrected...
        """
        try:
            if candidate.unbound(self.claim):
                return False
            named = candidate.kind == "marks"  # by the claim, and one only
            return self.correction_is_certified(self.claim.body(candidate.printed), named)
        except (ClaimError, checker.Rejected):
            return False

    def correction_is_certified(self, body: Body, named: bool) -> bool:
        """Whether every statement of a corrected body is certified; if so they are kept.  One that
        the claim names gets all of the budget, one of many candidates a part.
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
                self.is_refuted_by_sampling(read(part.text(), part.name)) for part in statements
            ):
                return False
        except (ClaimError, checker.Rejected):
            return False
        trial = self.trial(self.resources.budget // (1 if named else TRIAL))
        try:
            if any(trial.settle(part) != "certified" for part in statements):
                return False
        except ClaimError:  # it contradicts itself, or divides by what may vanish
            return False
        tried = trial.judgement
        for name, text in tried.statements:
            self.record(name, text, tried.certificates[name], tried.outcomes[name])
            self.judgement.votes[name] = self.votes(name, text, tried.outcomes[name])
        return True

    def is_stored_certified(self, statement: AnyStatement) -> bool:
        """Whether the store holds this very statement, and the checker accepted its proof there: no
        point can then refute it.
        """
        store, name = self.resources.store, statement.name
        return (
            store is not None
            and store.texts.get(name) == statement.text()
            and self.resources.checked.get(name) == "certified"
        )

    def trial(self, budget: int) -> Judge:
        """A judge of the same claim that settles what may correct it, with this budget."""
        trial = Judge(self.claim, replace(self.resources, routes=("exact",), budget=budget))
        trial.known, trial.is_trial, trial.judgement.roles = self.known, True, self.judgement.roles
        return trial

    def is_refuted_by_sampling(self, parsed: checker.Statement) -> bool:
        """Whether a quick search at sample points meets a counterexample; it proves nothing."""
        if parsed.kind != "universal":
            return False
        unfolded(parsed)
        start = State(checker.Context())
        values = search_values(
            parsed,
            start,
            "counterexample",
            {},
            self.known,
            Budget(QUICK_BUDGET),
            effort=0,
            roles=self.judgement.roles,
        )
        return values is not None

    # -------------------------------------------------------------- sharp ranges

    def find_sharp_range(self, prefix: str, assertion: Assertion) -> Sharp | None:
        """The set of parameters in the whole domain on which the assertion holds, settled on both
        sides by the checker; None where it is about no range, or is open itself.

        Statements that are certified with the whole domain as their range hold on all of it: the
        others decide, with all that are about no range and not certified.
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
        parts of its assertion are certified, and the domain of every rule on which it does not rest
        contains its own.
        """
        if any(self.judgement.outcomes[part.name] != "certified" for part in parts):
            return None
        texts = {**self.resources.lemmas, **dict(self.judgement.statements)}
        rested_on = [name]
        for one in rested_on:
            if one not in texts:  # of a claim that this one does not name among what it uses
                return None
            rested_on += rests_on(read(texts[one], one))
        domain = rule_domain(name, texts)[0]
        others = {part.name for part in parts if isinstance(part, MapRule)} - {*rested_on}
        if not all(self.contains(rule_domain(one, texts)[0], domain) for one in sorted(others)):
            return None
        text = range_of_rule(name, texts, _stated(self.judgement.roles, self.claim))
        return Sharp(text, (name,)) if text else None

    def contains(self, outer: str, inner: str) -> bool:
        """Whether the checker accepts a quick proof that one domain contains another, in the
        variables of the other.
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
            found = search_certificate(parsed, {}, Budget(QUICK_BUDGET))
        except (checker.Rejected, Exhausted):
            return False
        return "certified" in found and self.check(parsed, found) == "certified"

    def stored_sharp_range(
        self, prefix: str, parts: Sequence[Statement], over: Sequence[str]
    ) -> Sharp | None:
        """The stored sharp range of these statements, if the checker accepts it and it is on the
        whole domain.
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
        shown = text_of_range(text, parts, over, self.judgement.roles, self.resources.budget)
        if shown is None:
            return None
        self.record(name, text, certificate, "certified")
        return Sharp(shown, (name,))

    def new_sharp_range(
        self, prefix: str, parts: Sequence[Statement], over: Sequence[str]
    ) -> Sharp:
        """The sharp range of these statements by a search, unless the same one failed in an earlier
        run.
        """
        name, budget = f"{self.claim.id}/{prefix}sharp", self.resources.budget
        roles = self.judgement.roles
        tried = digest(f"{budget}\n" + "\n".join(part.text() for part in parts))
        if self.finding.get("not found", {}).get(prefix) == tried:
            return Sharp(NOT_FOUND, tried=tried)
        result = search_sharp_range(name, parts, over, self.known, SHARP * budget, roles)
        if result is None:
            return Sharp(NOT_FOUND, tried=tried)
        sharp, proof = result
        certificate: Certificate = {"certified": proof}
        earlier = {part.name: read(part.text(), part.name) for part in parts}
        outcome, reason = checker.check_one(
            read(sharp.text(), name), certificate, self.known, earlier
        )
        shown = text_of_range(sharp.text(), parts, over, roles, budget)
        if outcome != "certified" or shown is None:
            return Sharp(f"{NOT_FOUND} ({reason or 'not on the whole domain'})")
        self.record(name, sharp.text(), certificate, outcome)
        return Sharp(shown, (name,))

    def sharp_outcome(
        self, name: str, stored: str, certificate: Certificate, ranged: Sequence[Statement]
    ) -> str:
        """The checker's outcome of a stored sharp range; it is asked again where a statement that
        is ranged over is not as stored.
        """
        texts = self.resources.store.texts if self.resources.store else {}
        if self.resources.checked.get(name) == "certified" and all(
            texts.get(part.name) == part.text() for part in ranged
        ):
            return "certified"
        earlier = {one.name: read(one.text(), one.name) for one in ranged}
        return checker.check_one(read(stored, name), certificate, self.known, earlier)[0]


def _stated(roles: Roles, claim: Claim) -> Roles:
    """The roles where the vocabulary of the claim states them; what its statements say of a domain
    says nothing of a map's.
    """
    return roles if claim.vocabulary.domains else NO_ROLES


def _as_votes(recorded: RecordedVotes, routes: Sequence[str]) -> tuple[Vote, ...]:
    """The votes of these routes, as they are recorded."""
    return tuple(
        Vote(one["route"], one["answer"], one["detail"])
        for one in recorded["votes"]
        if one["route"] in routes
    )


def _renamed(statement: AnyStatement, name: str) -> AnyStatement:
    if isinstance(statement, SharpRange):
        raise ClaimError("a sharp range cannot be renamed")
    return replace(statement, name=name)
