"""Sharp ranges: exactly for which values of one parameter statements hold; ends by elimination, verdicts by Z3, then certificates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from flint import fmpq, fmpq_poly

from certificates import checker
from certificates.statements import SharpRange
from certificates.terms import Formula, disjunction

from .algebraic import AlgebraicNumber, simplest_between
from .budget import Budget, Exhausted, accepted
from .candidates import FAVOURITE_PARAMETERS, UNITS, separate
from .condition import Condition, evaluate, multivariate, ring_of
from .elimination import border_polynomials, candidate_numbers
from .ranges import Line, condition_of, polynomial_term, separators
from .sharp_certificate import sharp_certificate
from .solver import RESOURCES, ask

NOWHERE = 300_000  # units of work for one family on the whole domain
QUICK, PROBES = 100_000, (fmpq(1, 2), fmpq(1, 10), fmpq(9, 10))  # Z3's work, and where a statement has to fail before that is tried
Known = Mapping[str, checker.Statement]
Verdicts = dict[str, tuple[bool, ...]]


@dataclass
class Range:
    """A sharp range as found: its statement, its end points, and its certificate, or the reason why there is none."""

    statement: SharpRange | None = None
    ends: list[AlgebraicNumber] = field(default_factory=list)
    certificate: list[Any] | None = None
    failure: str = ""
    line: Line | None = None


@dataclass(frozen=True)
class Violation:
    """What a point at which a statement fails meets: the premises, and no values of the bound variables that meet the goals."""

    name: str
    condition: Condition
    goal: Condition | None
    bound: tuple[str, ...]
    integers: tuple[str, ...]

    @staticmethod
    def of(statement: checker.Statement, domain: Any, units: bool) -> Violation:
        """The violations of a statement in a domain, in units of r and g unless told otherwise."""
        story = checker.Unfolding(statement, checker.Context(), [domain])
        premises = list(story.premises)
        ones = {name: fmpq(1) for name in UNITS & story.variables} if units else {}
        ring = ring_of(story.context)
        exists = tuple(sorted(story.variables - set(story.universal)))
        whole = premises if exists else [*premises, story.goal(False)]
        condition = Condition.of(story.context, checker.join("and", whole), ring).substituted(ones)
        goal = Condition.of(story.context, story.goal(True), ring).substituted(ones) if exists else None
        return Violation(statement.name, condition, goal, exists, tuple(sorted(story.integers)))

    def absent(self, parameter: str, at: fmpq | AlgebraicNumber, budget: Budget, resources: int = RESOURCES) -> bool | None:
        """Z3's verdict at one value of the parameter: True where there is no violation, None where it has none."""
        condition, goal = self.condition, self.goal
        if isinstance(at, AlgebraicNumber) and at.is_rational:
            at = at._low
        if isinstance(at, AlgebraicNumber):
            ring = condition.ring
            gen = ring.gen(ring.variable_to_index(parameter))
            modulus = multivariate(fmpq_poly(at.poly), ring, parameter)
            here = Condition(ring, [modulus, gen - at._low, at._high - gen], ("and", [(0, "="), (1, ">"), (2, ">")]))
            condition = condition.conjoined(here)
        else:
            condition = condition.substituted({parameter: at})
            goal = goal.substituted({parameter: at}) if goal is not None else None
        unreachable = (goal, self.bound) if goal is not None else None
        verdict = ask(condition, budget, self.integers, resources, unreachable=unreachable).verdict
        return {"sat": False, "unsat": True}.get(verdict)


def find_sharp_range(statements: Sequence[checker.Statement], parameter: str, domain: Formula, name: str, known: Known, budget: Budget,
                     certify: bool = True) -> Range:
    """The set of one parameter on which all the statements hold, its ends, and a certificate for `checker.check_sharp`."""
    try:
        violations = [Violation.of(s, checker.parse(str(domain)), units=True) for s in statements]
        failing = [v.name for v in violations if all(v.absent(parameter, at, budget, QUICK) is False for at in PROBES)]
        never = find_nowhere(statements, parameter, domain, name, known, budget, failing) if certify else None
        if never is not None:
            return never
        line, verdicts = _line(violations, parameter, checker.parse(str(domain)), budget)
    except Exhausted:
        return Range(failure="the budget ran out before the verdicts were known")
    if line is None:
        return Range(failure=verdicts)
    simple = line.simplified()
    numbers = []
    for k, number in enumerate(n for n in simple.numbers if not n.is_rational):
        low, high = separators(number)
        numbers.append((f"c{k + 1}", polynomial_term(number.coefficients, parameter), low, high))
    condition = condition_of(simple, parameter, domain)
    statement = SharpRange(name, tuple(s.name for s in statements), (parameter,), domain, condition, tuple(numbers))
    result = Range(statement, list(simple.numbers), line=line)
    if certify:
        result.certificate, result.failure = _certified(read(statement), statements, parameter, line, verdicts, known, budget)
    return result


def find_nowhere(statements: Sequence[checker.Statement], parameter: str, domain: Formula, name: str, known: Known, budget: Budget,
                 failing: Sequence[str]) -> Range | None:
    """The empty range, where one family breaks a statement on the whole domain; None where a short search finds none."""
    stated = SharpRange(name, tuple(s.name for s in statements), (parameter,), domain, disjunction([]))
    statement, line = read(stated), Line((), (False,))
    for one in (s for s in statements if s.name in failing):
        try:
            certificate, _ = _certified(statement, statements, parameter, line, {s.name: (s is not one,) for s in statements}, known,
                                        budget.part(NOWHERE))
        except Exhausted:
            continue
        if certificate is not None:
            return Range(stated, [], certificate, line=line)
    return None


def search_sharp(statement: checker.Statement, known: Known, statements: Mapping[str, checker.Statement], budget: Budget
                 ) -> list[Any] | None:
    """A certificate for a sharp range that is already stated, in one parameter, or None."""
    (names,), (over,), (domain,), (condition,) = (statement.get(keyword) for keyword in ("sharp", "over", "domain", "holds"))
    if len(over) != 1 or any(name not in statements for name in names):
        return None
    chosen = [statements[name] for name in names]
    context = checker.Context()
    context.declare(over[0])
    claimed = Condition.of(context, context.formula(condition))
    own = candidate_numbers(claimed.polys, over[0])
    try:
        line, verdicts = _line([Violation.of(s, domain, units=True) for s in chosen], over[0], domain, budget, own)
    except Exhausted:
        return None
    if line is None or not _agrees(line, claimed, over[0]):
        return None
    return _certified(statement, chosen, over[0], line, verdicts, known, budget)[0]


def read(statement: SharpRange) -> checker.Statement:
    """The statement as the checker reads it."""
    return next(iter(checker.read_statements(statement.text()).values()))


def _certified(statement: checker.Statement, statements: Sequence[checker.Statement], parameter: str, line: Line, verdicts: Verdicts,
               known: Known, budget: Budget) -> tuple[list[Any] | None, str]:
    certificate, failure = sharp_certificate(statement, statements, parameter, line, verdicts, known, budget)
    named = {s.name: s for s in statements}
    if certificate is not None and not accepted(checker.check_sharp, statement, certificate, dict(known), named):
        return None, "the checker does not accept the certificate"
    return certificate, failure


def _agrees(line: Line, claimed: Condition, parameter: str) -> bool:
    """Whether a stated condition has the verdicts of the line."""
    if isinstance(claimed.tree, bool):
        return all(verdict == claimed.tree for verdict in line.verdicts)
    polys = claimed.in_one_variable(parameter)
    for number, verdict in zip(line.numbers, line.verdicts[1::2]):
        if claimed.univariate_truth(parameter, number, polys) != verdict:
            return False
    gaps = zip(line.numbers, line.numbers[1:], line.verdicts[2::2])
    for left, right, verdict in gaps:
        middle = simplest_between(left._high, right._low)
        if evaluate(claimed.tree, {k: (p(middle) > 0) - (p(middle) < 0) for k, p in polys.items()}) != verdict:
            return False
    return True


def _line(violations: Sequence[Violation], parameter: str, domain: Any, budget: Budget, more: Sequence[AlgebraicNumber] = ()
          ) -> tuple[Line | None, Any]:
    """The line of all verdicts together, with each statement's own; or (None, why)."""
    context = checker.Context()
    context.declare(parameter)
    allowed = Condition.of(context, context.formula(domain))
    if isinstance(allowed.tree, bool):
        return None, "the domain says nothing about the parameter"
    pairs = [(v.condition, v.goal) for v in violations]
    borders = [p.project_to_context(allowed.ring) for p in border_polynomials(pairs, [parameter], budget)]
    cells = allowed.in_one_variable(parameter)
    numbers = candidate_numbers([*borders, *allowed.polys], parameter)
    numbers = sorted([*numbers, *(n for n in more if n not in numbers)])
    separate(numbers)
    inner = [n for n in numbers if allowed.univariate_truth(parameter, n, cells)]
    samples = _cell_samples(numbers, len(inner) + 1, allowed, parameter, cells)
    if samples is None:
        return None, "the domain is not one interval"
    each: Verdicts = {}
    for violation in violations:
        cells_of = [violation.absent(parameter, sample, budget) for sample in samples]
        if None in cells_of:
            return None, f"no verdict on {violation.name} at {parameter} = {samples[cells_of.index(None)]}"
        own = [bool(cells_of[0])]
        for number, before, after in zip(inner, cells_of, cells_of[1:]):
            own += [_at_number(violation, parameter, number, bool(before), bool(after), budget), bool(after)]
        each[violation.name] = tuple(own)
    return Line(tuple(inner), tuple(all(v) for v in zip(*each.values()))), each


def _at_number(violation: Violation, parameter: str, number: AlgebraicNumber, before: bool, after: bool, budget: Budget) -> bool:
    """The verdict at a number between two cells; theirs if they agree and Z3 is slow or has none: certificates tell if that is right."""
    if before == after and not number.is_rational:
        if number.poly.degree() > 2:
            return before
        verdict = violation.absent(parameter, number, budget, QUICK)
        return before if verdict is None else verdict
    return violation.absent(parameter, number, budget) or False


def _cell_samples(numbers: Sequence[AlgebraicNumber], count: int, allowed: Condition, parameter: str, cells: Any) -> list[fmpq] | None:
    """A simple rational in every open cell of the domain, which has to be one interval."""
    borders = [(left._high, right._low) for left, right in zip(numbers, numbers[1:])]
    if numbers:
        borders = [(numbers[0]._low - 2, numbers[0]._low), *borders, (numbers[-1]._high, numbers[-1]._high + 2)]
    samples = []
    for bottom, top in borders or [(fmpq(-2), fmpq(2))]:
        nice = [v for v in FAVOURITE_PARAMETERS if bottom < v < top]
        value = nice[0] if nice else simplest_between(bottom, top)
        if allowed.univariate_truth(parameter, value, cells):
            samples.append(value)
    return samples if len(samples) == count else None
