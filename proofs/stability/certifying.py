"""Statements that are certified one after another, each candidate within counted work."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from juggleproof.certificates import checker
from juggleproof.certificates.cases import ANYWHERE
from juggleproof.certificates.language import MapRule
from juggleproof.certificates.nodes import Certificate
from juggleproof.certificates.nodes import Proof as Premise
from juggleproof.certificates.search.certificate import search_certificate, search_proof
from juggleproof.certificates.search.closing import SQUARED
from juggleproof.certificates.states import state_of
from juggleproof.certificates.vote import Budget as Votes
from juggleproof.certificates.votes.z3 import vote_and_model
from juggleproof.certificates.work import Budget, Exhausted, unfolded
from juggleproof.proofs.searches.unproved_premises import why
from juggleproof.proofs.stability.by_sign import proof_by_signs
from juggleproof.proofs.stability.few_facts import proof_without_next
from juggleproof.proofs.stability.given import (
    conjuncts,
)

BUDGET = 2_000_000  # counted work for a premise
LOCAL_BUDGET, ENVELOPE_BUDGET = 200_000, 4_000_000  # the same, close to the point; of an envelope
MOST_WORK, MORE_WORK = 12_000_000, 2_000_000  # on a map; after that, for refutations and in part
EFFORTS = (1, 2, SQUARED)
LONG_SEARCH = 300_000  # units of work, before which Z3 is asked for a counter-model
QUICK = Votes(rlimit=20_000)  # some 20 ms
FULL = Votes(rlimit=50_000)  # for the reason why a premise is open
SQUARES_COST = 8  # of a unit of work at the effort of squares
Report = Callable[[str], None]
Search = Callable[[checker.Statement, dict[str, checker.Statement]], Premise | None]


@dataclass
class Proof:
    """Statements with certificates, in order."""

    rules: list[MapRule] = field(default_factory=list)
    certificates: dict[str, Certificate] = field(default_factory=dict)
    known: dict[str, checker.Statement] = field(default_factory=dict)
    budget: int = BUDGET  # of a premise where nothing less is said; what is less grows with it
    open: tuple[str, str, checker.Statement] | None = None  # the last premise without a proof
    work: int = 0  # that was spent on premises
    most: int = MOST_WORK  # of it
    # premises without a proof: the largest budget, and whether the search ended for want of it
    sought: dict[str, tuple[int, bool]] = field(default_factory=dict)

    def add(
        self,
        rule: MapRule,
        efforts: Sequence[int] = EFFORTS,
        budget: int = BUDGET,
        signs: Mapping[str, Sequence[str]] | None = None,
        searches: Mapping[str, Search] | None = None,
    ) -> str:
        """Certifies one more statement; the premise that is open, or nothing.  signs: for some
        premises, polynomials whose signs are the cases of a proof; searches: for some, what is
        tried first.
        """
        text = "\n\n".join(one.text() for one in [*self.rules, rule])
        proofs: dict[str, Premise] = {}
        self.open = None
        try:
            statement = checker.read_statements(text)[rule.name]
            premises = checker.premises_of(statement, self.known)
            # those first that fail most often
            for name in sorted(premises, key=lambda name: not name.startswith("falls")):
                proof = None
                if searches and name in searches:
                    proof = searches[name](premises[name], self.known)
                if proof is None and signs and name in signs:
                    proof = proof_by_signs(premises[name], self.known, signs[name])
                work = budget * self.budget // BUDGET
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
        """Lets so much more work be spent, which grows with the budget."""
        self.most = max(self.most, self.work + work * self.budget // BUDGET)

    def free_name(self, name: str) -> str:
        """The name, with a number where a statement has it already."""
        count = sum(one == name or one.startswith(f"{name}-") for one in self.known)
        return f"{name}-{count + 1}" if count else name

    def domain(self) -> str:
        """For which parameters the last statement with a domain holds."""
        rows = (dict(rule.rows) for rule in reversed(self.rules))
        return next(each["domain"] for each in rows if "domain" in each)

    def add_all(
        self,
        rules: Sequence[MapRule],
        efforts: Sequence[int],
        report: Report,
        signs: Mapping[str, Sequence[str]] | None = None,
        searches: Mapping[str, Search] | None = None,
    ) -> bool:
        """Certifies all of these statements, or none; signs, searches: for premises of those with
        a V.
        """
        count = len(self.rules)
        for rule in rules:
            if dict(rule.rows).get("value"):
                budget = BUDGET // 4 if searches else ENVELOPE_BUDGET
                fault = tried(self, rule, efforts, budget, report, signs, searches)
            else:
                fault = self.add(rule)
            if fault:
                self.keep(count)
                return False
        return True

    def keep(self, count: int) -> None:
        """Leaves the first `count` statements only."""
        for rule in self.rules[count:]:
            del self.certificates[rule.name], self.known[rule.name]
        del self.rules[count:]

    def why(self) -> str:
        """What Z3 says of the last premise without a proof, and its text."""
        if self.open is None:
            return ""
        kind, name, premise = self.open
        _, cut = self.sought.get(premise.text(), (0, True))
        line = why(kind, name, premise, vote_and_model(premise, budget=FULL), self.budget, cut)
        return f"{line.removesuffix(', or a lemma')}\n{premise.text()}"

    def proof_of(
        self, premise: checker.Statement, efforts: Sequence[int], budget: int
    ) -> Premise | None:
        """A proof of one premise, if one is found."""
        found, cut = self.proof_and_end(premise, efforts, budget)
        text = premise.text()
        if found is None and budget >= self.sought.get(text, (0, True))[0]:
            self.sought[text] = budget, cut
        return found

    def proof_and_end(
        self, premise: checker.Statement, efforts: Sequence[int], budget: int
    ) -> tuple[Premise | None, bool]:
        """The same, and whether the search ended for want of budget."""
        if terms_of_pairs(premise) // 16 > budget:
            return None, True  # the first program would be too large
        cut = False
        for count, effort in enumerate(efforts):
            if self.work >= self.most:
                return None, True
            asked = count == 1 and budget >= LONG_SEARCH
            if asked and vote_and_model(premise, budget=QUICK)[1] is not None:
                return None, False
            if effort == SQUARED and premise.get("exists"):
                continue  # there are no squares to find
            part, proof = Budget(budget), None
            try:
                proof = search_proof(premise, self.known, part, effort=effort)
            except Exhausted:
                cut = True
            self.work += (budget - part.left) * (SQUARES_COST if effort == SQUARED else 1)
            if proof is not None:
                return proof, cut
        return None, cut


def terms_of_pairs(premise: checker.Statement) -> int:
    """How many terms the products of two facts have that a premise without cases begins with."""
    if premise.get("exists"):
        return 0
    unfolding = unfolded(premise)
    state = state_of(unfolding).assume(unfolding.goal(False))
    return 0 if state.choices else sum(len(poly.terms) for poly, _ in state.facts) ** 2 // 2


def tried(
    proof: Proof,
    rule: MapRule,
    efforts: Sequence[int],
    budget: int,
    report: Report,
    signs: Mapping[str, Sequence[str]] | None = None,
    searches: Mapping[str, Search] | None = None,
) -> str:
    """Tries to certify a candidate."""
    fault = proof.add(rule, efforts, budget, signs, searches)
    report(f"{function_of(rule)}: {fault or 'certified'}")
    return fault


def signs_of(rule: MapRule) -> dict[str, list[str]]:
    """The sign of a function of one term as the cases of the premise that it is not negative."""
    return {"bounded": [text for keyword, text in rule.rows if keyword == "value"]}


def function_of(rule: MapRule) -> str:
    """The function of a candidate, and its loss."""
    values = "; ".join(text for keyword, text in rule.rows if keyword == "value")
    greatest = f"the greatest of {values}" if "; " in values else values
    return f"V = {greatest}, loss {dict(rule.rows)['loss']}"


def beyond(given: str, domain: str, parameters: Sequence[str]) -> str:
    """What the domain asks of the parameters that the checker does not certify to hold on the given
    one: a licence rests on samples, which miss an end point.
    """
    before, open_ = conjuncts(given), []
    facts = [f"given {one}" for one in before]
    for condition in conjuncts(domain):
        if condition in before or condition == ANYWHERE:
            continue
        if not is_certified([f"forall {' '.join(parameters)}", *facts, f"show {condition}"]):
            open_.append(condition)
    return " and ".join(open_)


def is_certified(lines: Sequence[str], budget: int = BUDGET) -> bool:
    """Whether a certificate for the statement of these lines is found, and the checker takes it."""
    try:
        statement = checker.read_statements("\n".join(["statement a/a", *lines]))["a/a"]
        found = search_certificate(statement, {}, Budget(budget))
    except (checker.Rejected, Exhausted):  # it divides by what may be 0, or is too large
        return False
    return checker.check_one(statement, found, {}, {})[0] == "certified"
