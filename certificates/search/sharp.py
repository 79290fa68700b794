"""Sharp ranges: exactly for which values of one parameter statements hold; ends by elimination,
verdicts by Z3, then certificates.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from flint import fmpq

from certificates import checker
from certificates.statements import SharpRange
from certificates.terms import Formula, Term, disjunction

from .algebraic import AlgebraicNumber, simplest_between
from .budget import Budget, Exhausted, accepted
from .condition import Condition, evaluate
from .elimination import candidate_numbers
from .ranges import Line, condition_of, isolated, polynomial_term
from .sharp_certificate import sharp_certificate
from .sharp_lines import QUICK, Lines, Undecided, Verdicts
from .violations import Violation

EVERYWHERE = 2_500_000  # units of work for proofs on the whole domain
VERDICTS = 2_000_000  # units of work for the verdicts along the line
NOWHERE = 300_000  # units of work for one family on the whole domain
PROBES = (
    fmpq(1, 2),
    fmpq(1, 10),
    fmpq(9, 10),
)  # where a statement has to fail before a family on the whole domain is tried
Known = Mapping[str, checker.Statement]


@dataclass
class Range:
    """A sharp range as found: its statement, its end points, and its certificate, or the reason why
    there is none.
    """

    statement: SharpRange | None = None
    ends: list[AlgebraicNumber] = field(default_factory=list)
    certificate: list[Any] | None = None
    failure: str = ""
    line: Line | None = None


def find_sharp_range(
    statements: Sequence[checker.Statement],
    parameter: str,
    domain: Formula,
    name: str,
    known: Known,
    budget: Budget,
    certify: bool = True,
) -> Range:
    """The set of one parameter on which all the statements hold, its ends, and a certificate for
    `checker.check_sharp`.
    """
    tree, result = (
        checker.parse(str(domain)),
        Range(failure="the budget ran out before the verdicts were known"),
    )
    try:
        violations = [Violation.of(s, tree, units=True) for s in statements]
        probed = {
            v.name: [v.absent(parameter, at, budget, QUICK) for at in PROBES] for v in violations
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
                find_everywhere(statements, parameter, domain, name, known, budget)
                if whole
                else find_nowhere(statements, parameter, domain, name, known, budget, failing)
            )
            if simple is not None:
                return simple
        for line, verdicts in Lines(violations, parameter, tree, budget.part(VERDICTS)).guesses():
            stated = stated_range(name, statements, parameter, domain, line)
            result = Range(stated, list(line.simplified().numbers), line=line)
            if certify:
                result.certificate, result.failure = _certified(
                    read(stated), statements, parameter, line, verdicts, known, budget
                )
            if not result.failure:
                return result
    except Undecided as reason:
        return Range(failure=str(reason))
    except Exhausted:
        pass
    return result


def stated_range(
    name: str, statements: Sequence[checker.Statement], parameter: str, domain: Formula, line: Line
) -> SharpRange:
    """The range as a statement; its `number` lines account for every root in the domain of the
    polynomials in its condition.
    """
    simple = line.simplified()
    numbers: list[tuple[str, Term, Fraction, Fraction]] = []
    for poly in dict.fromkeys(tuple(n.coefficients) for n in simple.numbers if not n.is_rational):
        for low, high in isolated(poly, domain, parameter):
            numbers.append((f"c{len(numbers) + 1}", polynomial_term(poly, parameter), low, high))
    return SharpRange(
        name,
        tuple(s.name for s in statements),
        (parameter,),
        domain,
        condition_of(simple, parameter, domain),
        tuple(numbers),
    )


def find_everywhere(
    statements: Sequence[checker.Statement],
    parameter: str,
    domain: Formula,
    name: str,
    known: Known,
    budget: Budget,
) -> Range | None:
    """The whole domain, where all statements are proved on it with a part of the work; None where
    they are not.
    """
    stated, line = (
        SharpRange(name, tuple(s.name for s in statements), (parameter,), domain, domain),
        Line((), (True,)),
    )
    verdicts: Verdicts = {s.name: (True,) for s in statements}
    try:
        certificate, _ = _certified(
            read(stated), statements, parameter, line, verdicts, known, budget.part(EVERYWHERE)
        )
    except Exhausted:
        return None
    return None if certificate is None else Range(stated, [], certificate, line=line)


def find_nowhere(
    statements: Sequence[checker.Statement],
    parameter: str,
    domain: Formula,
    name: str,
    known: Known,
    budget: Budget,
    failing: Sequence[str],
) -> Range | None:
    """The empty range, where one family breaks a statement on the whole domain; None where a short
    search finds none.
    """
    stated = SharpRange(
        name, tuple(s.name for s in statements), (parameter,), domain, disjunction([])
    )
    statement, line = read(stated), Line((), (False,))
    for one in (s for s in statements if s.name in failing):
        try:
            certificate, _ = _certified(
                statement,
                statements,
                parameter,
                line,
                {s.name: (s is not one,) for s in statements},
                known,
                budget.part(NOWHERE),
            )
        except Exhausted:
            continue
        if certificate is not None:
            return Range(stated, [], certificate, line=line)
    return None


def search_sharp(
    statement: checker.Statement,
    known: Known,
    statements: Mapping[str, checker.Statement],
    budget: Budget,
) -> list[Any] | None:
    """A certificate for a sharp range that is already stated, in one parameter, or None."""
    (names,), (over,), (domain,), (condition,) = (
        statement.get(keyword) for keyword in ("sharp", "over", "domain", "holds")
    )
    if len(over) != 1 or any(name not in statements for name in names):
        return None
    chosen = [statements[name] for name in names]
    context = checker.Context()
    context.declare(over[0])
    claimed = Condition.of(context, context.formula(condition))
    own = candidate_numbers(claimed.polys, over[0])
    try:
        for line, verdicts in Lines(
            [Violation.of(s, domain, units=True) for s in chosen], over[0], domain, budget, own
        ).guesses():
            if _agrees(line, claimed, over[0]):
                return _certified(statement, chosen, over[0], line, verdicts, known, budget)[0]
    except (Exhausted, Undecided):
        pass
    return None


def read(statement: SharpRange) -> checker.Statement:
    """The statement as the checker reads it."""
    return next(iter(checker.read_statements(statement.text()).values()))


def _certified(
    statement: checker.Statement,
    statements: Sequence[checker.Statement],
    parameter: str,
    line: Line,
    verdicts: Verdicts,
    known: Known,
    budget: Budget,
) -> tuple[list[Any] | None, str]:
    certificate, failure = sharp_certificate(
        statement, statements, parameter, line, verdicts, known, budget
    )
    named = {s.name: s for s in statements}
    if certificate is not None and not accepted(
        checker.check_sharp, statement, certificate, dict(known), named
    ):
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
        if (
            evaluate(claimed.tree, {k: (p(middle) > 0) - (p(middle) < 0) for k, p in polys.items()})
            != verdict
        ):
            return False
    return True
