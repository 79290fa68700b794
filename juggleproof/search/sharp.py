"""Sharp ranges with their certificates."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from flint import fmpq, fmpq_poly

from juggleproof.algebra.numbers import (
    AlgebraicNumber,
    exact,
    polynomial_text,
    real_roots,
    simplest_between,
    with_one_change,
)
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.certificate import search_point, search_proof
from juggleproof.search.closing import search_closing
from juggleproof.search.families import cover
from juggleproof.search.ranges import (
    CutDomain,
    Undecided,
    VerdictLines,
    Verdicts,
    Violation,
    condition_of,
    ends_of,
    isolated,
    polynomial_term,
)
from juggleproof.search.samples import base_samples
from juggleproof.search.scales import with_scales
from juggleproof.search.witness_terms import TermTask
from juggleproof.statements.language import (
    NO_ROLES,
    Formula,
    Roles,
    SharpRange,
    Term,
    disjunction,
)
from juggleproof.statements.nodes import Certificate, Proof, Sharp, Values, by_sign
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted, unfolded

# -------------------------------------------------------------------------------------------------
# The certificate of a sharp range: counterexamples on every interval outside on which one
# statement fails, then proofs inside.

Known = Mapping[str, checker.Statement]


@dataclass(frozen=True)
class RangeSearch:
    """The statements whose range is sought or certified, and what their proofs may use."""

    statements: Sequence[checker.Statement]
    known: Known
    roles: Roles

    def proofs_inside(
        self, statement: checker.Statement, budget: Budget
    ) -> tuple[dict[str, Proof] | None, str]:
        """({name: proof}, "") where the condition holds, or (None, which proof is missing); it is
        left to the caller to have the proofs checked.

        Raises Exhausted where the budget ends.
        """
        (domain,), (condition,) = statement.get("domain"), statement.get("holds")
        inside: dict[str, Proof] = {}
        for each in self.statements:
            proof = None
            for effort, part in (
                (1, min(limits.EASY_PROOF_WORK, budget.left // 3)),
                (2, budget.left),
            ):
                try:
                    proof = proof or search_proof(
                        each,
                        dict(self.known),
                        budget.part(part),
                        sharp=[domain, condition],
                        effort=effort,
                        confirm=False,
                        roles=self.roles,
                    )
                except Exhausted:
                    if effort == 2:
                        raise
            if proof is None:
                return None, f"no proof of {each.name} inside the range"
            inside[each.name] = proof
        return inside, ""

    def points(self, statement: checker.Statement, budget: Budget) -> dict[str, Values] | None:
        """{name: a point of the domain that meets what the statement is given}; None where one was
        not found.

        Raises Exhausted where the budget ends.
        """
        points: dict[str, Values] = {}
        for each in self.statements:
            known, domains = dict(self.known), [*statement.get("domain")]
            point = search_point(each, known, budget, self.roles, domains)
            if point is None:
                return None
            points[each.name] = point
        return points

    def outside_state(self, statement: checker.Statement) -> SearchState:
        """The state that assumes the domain and not the condition."""
        (over,), (domain,), (condition,) = (
            statement.get(keyword) for keyword in ("over", "domain", "holds")
        )
        state = SearchState(checker.Context())
        for parameter in over:
            state.context.declare(parameter, parameter in whole_parameters(over, self.statements))
        state.assume(state.context.formula(domain))
        state.assume(checker.negate(state.context.formula(condition)))
        return state

    def family(
        self,
        each: checker.Statement,
        state: SearchState,
        domain: ast.expr,
        budget: Budget,
        depth: int,
    ) -> Values | None:
        """A family of counterexamples to one statement on a part of the domain."""
        base = {name: state.context.values[name] for name in state.context.index}
        scaled = with_scales(self.roles, unfolded(each, [domain]))
        known = dict(self.known)
        task = TermTask(each, "counterexample", base, known, budget, [domain], roles=scaled)
        return cover(task, state, base_samples(state, budget, scaled), depth=depth)

    def checked(self, statement: checker.Statement, certificate: Sharp) -> bool:
        """Whether the checker accepts the certificate."""
        settled: Certificate = {"certified": certificate}
        named = {each.name: each for each in self.statements}
        return not checker.check_one(statement, settled, dict(self.known), named)[1]


def whole_parameters(
    over: Sequence[str], statements: Sequence[checker.Statement]
) -> frozenset[str]:
    """The parameters that are integers in the statements."""
    return frozenset(
        p for p in over if any(p in line for each in statements for line in each.get("integer"))
    )


@dataclass(frozen=True)
class LineSearch(RangeSearch):
    """The same along a line of one parameter."""

    parameter: str

    def certified(
        self, statement: checker.Statement, line: CutDomain, verdicts: Verdicts, budget: Budget
    ) -> tuple[Sharp | None, str]:
        """(certificate, "") that the checker accepts, or (None, what could not be certified);
        nothing is raised where the budget ends.
        """
        (domain,) = statement.get("domain")
        try:
            points = self.points(statement, budget)
            part = budget.part(limits.SHARP_WORK)
            outside = self.outside(self.outside_state(statement), line, verdicts, domain, part)
        except Exhausted:
            points = outside = None
        if outside is None or points is None:
            return None, "no family of counterexamples outside the range"
        try:
            inside, failure = self.proofs_inside(statement, budget)
        except Exhausted:
            return None, "the budget ran out"
        if inside is None:
            return None, failure
        certificate = inside, outside, points
        if not self.checked(statement, certificate):
            return None, "the checker does not accept the certificate"
        return certificate, ""

    def outside(
        self,
        state: SearchState,
        line: CutDomain,
        verdicts: Verdicts,
        domain: ast.expr,
        budget: Budget,
    ) -> Values | None:
        """Families of counterexamples where the line has failures, cut where no single one serves;
        None where one is missing.
        """
        failing = [k for k, verdict in enumerate(line.verdicts) if not verdict]
        if not failing:
            node = search_closing(state, dict(self.known), budget, 2)
            return None if node is None else ("empty", node)
        for each in sorted(self.statements, key=lambda one: one.name):
            if not any(verdicts[each.name][k] for k in failing):
                values = self.family(each, state, domain, budget, 4)
                if values is not None:
                    return values
        cut = _cut(line, failing, verdicts, self.parameter, domain)
        if cut is None:
            return None
        text, pieces = cut
        cases: list[Values] = []
        for branch, piece in zip(state.by_sign(text), pieces):
            own = tuple(verdict or k not in piece for k, verdict in enumerate(line.verdicts))
            values = self.outside(branch, CutDomain(line.numbers, own), verdicts, domain, budget)
            if values is None:
                return None
            cases.append(values)
        return by_sign(text, cases)


def _cut(
    line: CutDomain,
    failing: Sequence[int],
    verdicts: Mapping[str, Sequence[bool]],
    parameter: str,
    domain: ast.expr,
) -> tuple[str, list[set[int]]] | None:
    """A polynomial of degree 1 or that of a number, and which cells and numbers lie below, on and
    above its sign change.
    """
    cells = set(range(len(line.verdicts)))
    gaps = [k for k in cells if failing[0] < k < failing[-1] and line.verdicts[k]]
    opened = [k for k in gaps if k % 2 == 0]
    if opened:
        # A rational inside an open cell on which all statements hold.
        k = opened[len(opened) // 2]
        value = simplest_between(line.numbers[k // 2 - 1]._high, line.numbers[k // 2]._low)
        text = polynomial_text([-int(value.p), int(value.q)], parameter)
        return text, [{i for i in cells if i < k}, set(), {i for i in cells if i > k}]
    changes = [k for k in failing if k % 2 and failing[0] < k < failing[-1]] or gaps
    if not changes:
        changes = [k for k in failing if k % 2] if len(failing) > 1 else []
    if not changes:
        return None
    k = changes[len(changes) // 2]
    number = line.numbers[k // 2]
    if not _separates(number, line, failing, ends_of(domain, parameter)):
        return None
    rising = number.sign_of(_derivative(number)) > 0
    below, above = {i for i in cells if i < k}, {i for i in cells if i > k}
    return number.polynomial_text(parameter), [
        below if rising else above,
        {k},
        above if rising else below,
    ]


def _separates(
    number: AlgebraicNumber,
    line: CutDomain,
    failing: Sequence[int],
    ends: tuple[Fraction | None, Fraction | None],
) -> bool:
    """Whether the number's polynomial has no other root among the failing cells and numbers."""
    low = line.numbers[failing[0] // 2 - 1] if failing[0] >= 2 else ends[0]
    high = line.numbers[failing[-1] // 2] if failing[-1] // 2 < len(line.numbers) else ends[1]
    others = [r for r in real_roots(fmpq_poly(number.poly)) if r != number]
    return not any((low is None or low < r) and (high is None or r < high) for r in others)


def _derivative(number: AlgebraicNumber) -> fmpq_poly:
    return fmpq_poly(number.poly).derivative()


# -------------------------------------------------------------------------------------------------
# Sharp ranges: exactly for which values of one parameter statements hold; ends by elimination,
# verdicts by Z3, then certificates.


@dataclass
class Range:
    """A sharp range as found: its statement, its end points, and its certificate, or the reason why
    there is none.
    """

    statement: SharpRange | None = None
    ends: list[AlgebraicNumber] = field(default_factory=list)
    certificate: Sharp | None = None
    failure: str = ""
    line: CutDomain | None = None


def find_sharp_range(
    statements: Sequence[checker.Statement],
    parameter: str,
    domain: Formula,
    name: str,
    known: Known,
    budget: Budget,
    certify: bool = True,
    roles: Roles = NO_ROLES,
) -> Range:
    """The set of one parameter on which all the statements hold, its ends, and a certificate for
    `checker.check_one`; with the reason as its `failure` where the budget ends, or one of the three
    is not found.
    """
    tree, result = (
        checker.parse(str(domain)),
        Range(failure="the budget ran out before the verdicts were known"),
    )
    roles = among(roles, {parameter: (domain,)})
    search = LineSearch(statements, known, roles, parameter)
    try:
        violations = [Violation.of(s, tree, roles) for s in statements]
        probes = probes_of(*ends_of(tree, parameter))
        probed = {
            v.name: [v.absent(parameter, at, budget, limits.Z3_GUESS_WORK) for at in probes]
            for v in violations
        }
        if certify:
            failing = [
                name
                for name, verdicts in probed.items()
                if all(verdict is False for verdict in verdicts)
            ]
            whole = not any(
                verdict is False for verdicts in probed.values() for verdict in verdicts
            )
            simple = (
                find_everywhere(search, domain, name, budget)
                if whole
                else find_nowhere(search, domain, name, budget, failing)
            )
            if simple is not None:
                return simple
        for line, verdicts in VerdictLines(
            violations, parameter, tree, budget.part(limits.SHARP_WORK)
        ).guesses():
            stated = stated_range(name, statements, parameter, domain, line)
            result = Range(stated, list(line.simplified().numbers), line=line)
            if certify:
                result.certificate, result.failure = search.certified(
                    read(stated), line, verdicts, budget
                )
            if not result.failure:
                return result
    except Undecided as reason:
        return Range(failure=str(reason))
    except Exhausted:
        pass
    return result


def among(roles: Roles, domains: Mapping[str, tuple[Formula, ...]]) -> Roles:
    """The roles, with parameters of a range that they do not know among theirs."""
    return replace(
        roles,
        domains={
            **roles.domains,
            **{name: ends for name, ends in domains.items() if name not in roles.domains},
        },
    )


def probes_of(low: Fraction | None, high: Fraction | None) -> list[fmpq]:
    """Three values between the ends of a domain; where it has no end, as if it were one long.

    >>> [str(value) for value in probes_of(Fraction(2), None)]
    ['5/2', '21/10', '29/10']
    """
    start = low if low is not None else high - 1 if high is not None else Fraction(0)
    length = high - start if high is not None else Fraction(1)
    return [exact(start) + exact(length * part) for part in limits.PROBES]


def stated_range(
    name: str,
    statements: Sequence[checker.Statement],
    parameter: str,
    domain: Formula,
    line: CutDomain,
) -> SharpRange:
    """The range as a statement; it has a `number` line for every root in the domain of the
    polynomials in its condition.
    """
    simple = line.simplified()
    numbers: list[tuple[str, Term, Fraction, Fraction]] = []
    for poly in dict.fromkeys(tuple(n.coefficients) for n in simple.numbers if not n.is_rational):
        for low, high in isolated(poly, domain, parameter):
            ends = with_one_change(fmpq_poly(list(poly)), low, high)
            numbers.append((f"c{len(numbers) + 1}", polynomial_term(poly, parameter), *ends))
    return SharpRange(
        name,
        tuple(s.name for s in statements),
        (parameter,),
        domain,
        condition_of(simple, parameter, domain),
        tuple(numbers),
    )


def find_everywhere(search: LineSearch, domain: Formula, name: str, budget: Budget) -> Range | None:
    """The whole domain, where all statements are proved on it with a part of the work; None where
    they are not.
    """
    names = tuple(each.name for each in search.statements)
    stated = SharpRange(name, names, (search.parameter,), domain, domain)
    line = CutDomain((), (True,))
    verdicts: Verdicts = dict.fromkeys(names, (True,))
    part = budget.part(limits.SHARP_WORK)
    certificate, _ = search.certified(read(stated), line, verdicts, part)
    return None if certificate is None else Range(stated, [], certificate, line=line)


def find_nowhere(
    search: LineSearch, domain: Formula, name: str, budget: Budget, failing: Sequence[str]
) -> Range | None:
    """The empty range, where one family breaks a statement on the whole domain; None where a short
    search finds none.
    """
    names = tuple(each.name for each in search.statements)
    stated = SharpRange(name, names, (search.parameter,), domain, disjunction([]))
    line = CutDomain((), (False,))
    for one in (each for each in names if each in failing):
        verdicts: Verdicts = {each: (each != one,) for each in names}
        part = budget.part(limits.FAMILY_WORK)
        certificate, _ = search.certified(read(stated), line, verdicts, part)
        if certificate is not None:
            return Range(stated, [], certificate, line=line)
    return None


def read(statement: SharpRange) -> checker.Statement:
    """The statement as the checker reads it."""
    return next(iter(checker.read_statements(statement.text()).values()))
