"""Statements that are certified one after another, each candidate within counted work."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from juggleproof.certificates import checker
from juggleproof.judging.searches.unproved_premises import why
from juggleproof.map_stability import limits
from juggleproof.map_stability.premise_searches import proof_without_next
from juggleproof.map_stability.terms import conjuncts
from juggleproof.search.certificate import search_certificate, search_proof
from juggleproof.search.closing import SQUARED
from juggleproof.statements.cases import ANYWHERE
from juggleproof.statements.language import MapRule
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.nodes import Proof as Premise
from juggleproof.statements.states import state_of
from juggleproof.statements.vote import VoteBudget as Votes
from juggleproof.statements.work import Budget, Exhausted, unfolded
from juggleproof.votes.z3 import vote_and_model

EFFORTS = (1, 2, SQUARED)
VOTE = Votes(rlimit=limits.VOTE)
Report = Callable[[str], None]
Search = Callable[[checker.Statement, dict[str, checker.Statement]], Premise | None]


@dataclass(frozen=True)
class CandidateProof:
    """Statements that are certified together or not at all.  One of them has a function V, whose
    premises have searches of their own; `budget` is the counted work for each, or 0; `rank` is
    small where V is simple and its constants fit samples well.
    """

    rules: tuple[MapRule, ...]
    searches: Mapping[str, Search] = field(default_factory=dict)
    rank: float = 0.0
    budget: int = 0

    @property
    def rule(self) -> MapRule:
        """The statement with a function V."""
        return next(one for one in self.rules if "value" in dict(one.rows))


def either(*searches: Search) -> Search:
    """A search that makes these searches in order, until one of them finds a proof."""

    def search(premise: checker.Statement, known: dict[str, checker.Statement]) -> Premise | None:
        found = (one(premise, known) for one in searches)
        return next((proof for proof in found if proof is not None), None)

    return search


@dataclass
class ProvedStatements:
    """Statements with certificates, in order."""

    rules: list[MapRule] = field(default_factory=list)
    certificates: dict[str, Certificate] = field(default_factory=dict)
    known: dict[str, checker.Statement] = field(default_factory=dict)
    budget: int = (
        limits.PREMISE_WORK
    )  # of a premise that has no smaller one; smaller ones grow in proportion
    fault: str = ""  # why the last statement was not certified, if it was not
    open: tuple[str, str, checker.Statement] | None = None  # the last premise without a proof
    work: int = 0  # the work that was spent on premises
    most: int = limits.MAP_WORK  # the most work that may be spent
    # each premise without a proof: its largest budget, and whether the search used it up
    sought: dict[str, tuple[int, bool]] = field(default_factory=dict)

    def add(
        self,
        rule: MapRule,
        efforts: Sequence[int] = EFFORTS,
        budget: int = limits.PREMISE_WORK,
        searches: Mapping[str, Search] | None = None,
    ) -> bool:
        """Return whether one more statement is certified; `fault` says why it is not.  The searches
        are made first, for the premises that they name.
        """
        self.fault = self._fault(rule, efforts, budget, searches or {})
        return not self.fault

    def _fault(
        self, rule: MapRule, efforts: Sequence[int], budget: int, searches: Mapping[str, Search]
    ) -> str:
        text = "\n\n".join(one.text() for one in [*self.rules, rule])
        proofs: dict[str, Premise] = {}
        self.open = None
        try:
            statement = checker.read_statements(text)[rule.name]
            premises = checker.premises_of(statement, self.known)
            # the premises that fail most often come first
            for name in sorted(premises, key=lambda name: not name.startswith("falls")):
                proof = searches[name](premises[name], self.known) if name in searches else None
                work = budget * self.budget // limits.PREMISE_WORK
                each = efforts if name.startswith(("falls", "grows")) else (*efforts, *EFFORTS)
                if name.startswith("stage"):
                    proof = self.proof_of(premises[name], (1, 2), work)
                    proof = proof or proof_without_next(premises[name], self.known)
                proof = proof or self.proof_of(premises[name], list(dict.fromkeys(each)), work)
                if proof is None:
                    self.open = statement.kind, name, premises[name]
                    return f"no proof of the premise {name} was found"
                proofs[name] = proof
        except checker.Rejected as fault:
            return str(fault)
        found: Certificate = {"certified": {name: proofs[name] for name in premises}}
        outcome, reason = checker.check_one(statement, found, self.known, self.known)
        if outcome != "certified":
            return str(reason)
        self.rules.append(rule)
        self.certificates[rule.name] = found
        self.known[rule.name] = statement
        return ""

    def grant(self, work: int) -> None:
        """Allow this much more work, in proportion to the budget."""
        self.most = max(self.most, self.work + work * self.budget // limits.PREMISE_WORK)

    def free_name(self, name: str) -> str:
        """The name, with a number where a statement has it already."""
        count = sum(one == name or one.startswith(f"{name}-") for one in self.known)
        return f"{name}-{count + 1}" if count else name

    def domain(self) -> str:
        """Return for which parameters the last statement with a domain holds."""
        rows = (dict(rule.rows) for rule in reversed(self.rules))
        return next(each["domain"] for each in rows if "domain" in each)

    def takes(
        self, candidate: CandidateProof, efforts: Sequence[int], budget: int, report: Report
    ) -> bool:
        """Return whether all statements of a candidate are certified; else none is added.  Efforts
        and budget are for the statement with a function V, which the report names.
        """
        count = len(self.rules)
        for rule in candidate.rules:
            if rule is candidate.rule:
                self.add(rule, efforts, candidate.budget or budget, candidate.searches)
                report(f"{function_of(rule)}: {self.fault or 'certified'}")
            else:
                self.add(rule)
            if self.fault:
                self.keep(count)
                return False
        return True

    def add_all(self, rules: Sequence[MapRule]) -> bool:
        """Return whether all of these statements are certified; else none is added."""
        count = len(self.rules)
        if all(self.add(rule) for rule in rules):
            return True
        self.keep(count)
        return False

    def keep(self, count: int) -> None:
        """Keep the first `count` statements, and remove the others."""
        for rule in self.rules[count:]:
            del self.certificates[rule.name], self.known[rule.name]
        del self.rules[count:]

    def why(self) -> str:
        """Return what Z3 says of the last premise without a proof, and its text."""
        if self.open is None:
            return ""
        kind, name, premise = self.open
        _, cut = self.sought.get(premise.text(), (0, True))
        line = why(kind, name, premise, vote_and_model(premise, budget=VOTE), self.budget, cut)
        return f"{line.removesuffix(', or a lemma')}\n{premise.text()}"

    def proof_of(
        self, premise: checker.Statement, efforts: Sequence[int], budget: int
    ) -> Premise | None:
        """Return a proof of one premise, or None."""
        found, cut = self.proof_and_end(premise, efforts, budget)
        text = premise.text()
        if found is None and budget >= self.sought.get(text, (0, True))[0]:
            self.sought[text] = budget, cut
        return found

    def proof_and_end(
        self, premise: checker.Statement, efforts: Sequence[int], budget: int
    ) -> tuple[Premise | None, bool]:
        """Return a proof or None, and whether the search ended for want of budget."""
        if terms_of_pairs(premise) // 16 > budget:
            return None, True  # the first program would be too large
        cut = False
        for count, effort in enumerate(efforts):
            if self.work >= self.most:
                return None, True
            asked = count == 1 and budget >= limits.LONG_SEARCH
            if asked and vote_and_model(premise, budget=VOTE)[1] is not None:
                return None, False
            if effort == SQUARED and premise.get("exists"):
                continue  # there are no squares to find
            part, proof = Budget(budget), None
            try:
                proof = search_proof(premise, self.known, part, effort=effort)
            except Exhausted:
                cut = True
            self.work += (budget - part.left) * (limits.SQUARES_COST if effort == SQUARED else 1)
            if proof is not None:
                return proof, cut
        return None, cut


def terms_of_pairs(premise: checker.Statement) -> int:
    """Return the number of terms in the products of two facts with which the search for a premise
    without cases begins.
    """
    if premise.get("exists"):
        return 0
    unfolding = unfolded(premise)
    state = state_of(unfolding).assume(unfolding.goal(False))
    return 0 if state.choices else sum(len(poly.terms) for poly, _ in state.facts) ** 2 // 2


def function_of(rule: MapRule) -> str:
    """The function of a candidate, and its loss."""
    values = "; ".join(text for keyword, text in rule.rows if keyword == "value")
    greatest = f"the greatest of {values}" if "; " in values else values
    return f"V = {greatest}, loss {dict(rule.rows)['loss']}"


def beyond(given: str, domain: str, parameters: Sequence[str]) -> str:
    """Return the conditions of the domain that are not certified to follow from the given one.
    Conditions on divisors may be among them: they were found at samples, which miss end points.
    """
    before, open_ = conjuncts(given), []
    facts = [f"given {one}" for one in before]
    for condition in conjuncts(domain):
        if condition in before or condition == ANYWHERE:
            continue
        if not is_certified([f"forall {' '.join(parameters)}", *facts, f"show {condition}"]):
            open_.append(condition)
    return " and ".join(open_)


def is_certified(lines: Sequence[str], budget: int = limits.PREMISE_WORK) -> bool:
    """Return whether a certificate for the statement of these lines is found, and the checker
    takes it.
    """
    try:
        statement = checker.read_statements("\n".join(["statement a/a", *lines]))["a/a"]
        found = search_certificate(statement, {}, Budget(budget))
    except (checker.Rejected, Exhausted):  # it divides by what may be 0, or is too large
        return False
    return checker.check_one(statement, found, {}, {})[0] == "certified"
