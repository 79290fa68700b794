"""The searches for one claim: certificates of its statements, and votes on them."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from juggleproof.certificates import checker
from juggleproof.judging import limits
from juggleproof.judging.evaluating import at_simple_values, is_simple
from juggleproof.judging.orbit_rules import premises_of
from juggleproof.judging.searches.unproved_premises import why
from juggleproof.judging.strength import refuted_more_strongly, strength_of
from juggleproof.search.certificate import search_certificate, search_premises
from juggleproof.search.closing import Hints, search_closing
from juggleproof.search.points import search_values
from juggleproof.statements.language import (
    NO_ROLES,
    AnyStatement,
    ClaimError,
    Formula,
    Iterates,
    MapRule,
    Roles,
    Statement,
    Term,
    disjunction,
)
from juggleproof.statements.nodes import Certificate, Counterexample, Values
from juggleproof.statements.states import SearchState, state_of
from juggleproof.statements.vote import Vote
from juggleproof.statements.vote import VoteBudget as Asking
from juggleproof.statements.work import Budget, Exhausted, read, unfolded
from juggleproof.votes.casting import cast_votes
from juggleproof.votes.z3 import Model, vote_and_model


@dataclass
class ClaimSearch:
    """The searches for the statements of one claim; the checker believes nothing that they find.

    `known` has the certified statements that proofs may use, `outcomes` the outcomes of all settled
    statements, `premises` the premises of the rules that were searched, `unproved` the texts of
    those without a proof.  A trial settles a candidate for the correction of the claim.
    """

    budget: int
    hints: Hints | None
    roots: Collection[Term]
    assumed: Sequence[Formula]
    roles: Roles
    known: dict[str, checker.Statement]
    outcomes: Mapping[str, str]
    premises: dict[str, dict[str, checker.Statement]]
    unproved: dict[str, list[str]]
    is_trial: bool

    def certificate(
        self, statement: AnyStatement, parsed: checker.Statement, confirm: bool, where: str
    ) -> Certificate:
        """A certificate by a search, or the reason why there is none; with `confirm` the checker
        confirms each node before the search goes on.

        Raises ClaimError where the hypotheses contradict one another, or do not keep a denominator
        from vanishing.
        """
        budget = self.budget
        if isinstance(statement, (Iterates, MapRule)):
            lemmas = getattr(statement, "lemmas", {})
            return self._certificate_of_rule(parsed, lemmas, confirm, where)
        certificate: Certificate
        try:
            certificate = search_certificate(
                parsed,
                self.known,
                Budget(budget),
                self.hints,
                confirm,
                roles=self.roles,
            )
        except Exhausted:
            certificate = {"unknown": f"the budget of {budget} units ran out"}
        if isinstance(statement, Statement) and not self.is_trial:
            certificate = self._in_simple_values(statement, certificate)
            certificate = self._by_the_strongest(statement, certificate)
        if "certified" not in certificate and isinstance(statement, Statement):
            if not self.is_trial:
                outcome = "refuted" if "refuted" in certificate else "unknown"
                refuse_vacuous(
                    statement, outcome, self.known, budget // limits.TRIAL_SHARE, self.roles
                )
        return certificate

    def _in_simple_values(self, statement: Statement, certificate: Certificate) -> Certificate:
        """A refutation in simple rationals, if a search with the parameter at a simple value finds
        one that the checker accepts; else the certificate unchanged.
        """
        found, parameter = certificate.get("refuted"), self.roles.parameter
        if not isinstance(found, Counterexample) or is_simple(found):
            return certificate
        if parameter not in found.terms:
            return certificate
        for one in at_simple_values(statement, parameter, self.roots):
            budget = Budget(self.budget // limits.TRIAL_SHARE)
            try:
                there = search_certificate(
                    read(one.text(), one.name), self.known, budget, roles=self.roles
                ).get("refuted")
            except Exhausted:
                continue
            if isinstance(there, Counterexample) and is_simple(there):
                simple: Certificate = {"refuted": there._replace(node=("close",))}
                parsed = read(statement.text(), statement.name)
                if checker.check_one(parsed, simple, self.known, {})[0] == "refuted":
                    return simple
        return certificate

    def _by_the_strongest(self, statement: Statement, certificate: Certificate) -> Certificate:
        """A refutation within what the section assumes, and strict where the goal is, if a search
        finds one that the checker accepts; else the certificate unchanged.
        """
        found = certificate.get("refuted")
        if not isinstance(found, Counterexample) or found.adjoined:
            return certificate
        parsed = read(statement.text(), statement.name)
        point = {name: Fraction(text) for name, text in found.terms.items()}
        own = strength_of(statement.text(), point, self.assumed)
        for stronger in refuted_more_strongly(statement, self.assumed, own):
            work = self.budget // limits.TRIAL_SHARE
            there = self._counterexample(read(stronger.text(), stronger.name), work, (0, 1))
            if isinstance(there, Counterexample) and not there.adjoined:
                strong: Certificate = {"refuted": there._replace(node=("close",))}
                if checker.check_one(parsed, strong, self.known, {})[0] == "refuted":
                    return strong
        return certificate

    def _counterexample(
        self, parsed: checker.Statement, work: int, efforts: Sequence[int]
    ) -> Values | None:
        """A counterexample by short searches, each with this work; None where they find none, or
        run out.
        """
        start = SearchState(checker.Context())
        for effort in efforts:
            try:
                values = search_values(
                    parsed,
                    start,
                    "counterexample",
                    {},
                    self.known,
                    Budget(work),
                    effort=effort,
                    roles=self.roles,
                )
            except Exhausted:
                continue
            if values is not None:
                return values
        return None

    def _certificate_of_rule(
        self,
        rule: checker.Statement,
        lemmas: Mapping[str, Sequence[str]],
        confirm: bool,
        where: str,
    ) -> Certificate:
        """A proof of each premise of a map rule, or the reasons why some have none; with `confirm`
        the checker confirms each before the search goes on.

        Raises ClaimError where the premises cannot be generated, and for a lemma that belongs to no
        premise, or cannot be read.
        """
        stated = {**self.outcomes, **self.known}
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

        budget = self.budget
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
        self.unproved[rule.name] = [premises[name].text() for name in reasons]
        count = f"{len(reasons)} of the {len(premises)} premises of `{rule.kind}` at {where}:"
        between = "\n  " if len(reasons) > 1 else " "
        return {"unknown": between.join([count, *reasons.values()])}

    def is_refuted_by_sampling(self, parsed: checker.Statement) -> bool:
        """Whether a quick search at sample points finds a counterexample; it proves nothing."""
        if parsed.kind != "universal":
            return False
        unfolded(parsed)
        return self._counterexample(parsed, limits.QUICK_WORK, (0,)) is not None

    def certificate_of_inclusion(self, parsed: checker.Statement) -> Certificate:
        """The certificate that a quick search finds; `unknown` where it finds none."""
        try:
            return search_certificate(parsed, {}, Budget(limits.QUICK_WORK))
        except Exhausted:
            return {"unknown": "a quick search found none"}

    def votes(
        self, name: str, text: str, outcome: str, routes: Sequence[str], budget: Asking
    ) -> tuple[Vote, ...]:
        """The votes of these routes on a statement, cast now."""
        return cast_votes(read(text, name), outcome, routes, budget)


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
