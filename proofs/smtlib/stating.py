"""States a problem in our language: for all reals, not all of the assertions hold.

Where the script divides, what keeps a divisor from 0 has to come first: the assertions without
divisions are then givens, and a divisor that none of them licenses gets a `have` line, which the
certificate proves.  SMT-LIB lets x/0 be anything, so a divisor that may vanish is refused.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from certificates import checker
from certificates.search.budget import Budget
from certificates.search.certificate import search_proof
from certificates.statements import Line, Statement
from certificates.terms import ClaimError, Formula, Term, conjunction, different, names_in

from .script import Problem

SIDE_BUDGET = 100_000


def statement_of(problem: Problem, name: str) -> Statement:
    """The statement that no point meets the assertions.

    >>> from .script import read_problems
    >>> text = "(declare-const x Real)(assert (> x 0))(assert (< (/ 1 x) 0))(check-sat)"
    >>> print(statement_of(read_problems(text, "f")[0], "f/check-1").text())
    statement f/check-1
    forall x
    given x > 0
    show not 1/x < 0

    Raises ClaimError, one line, for a division by what may vanish.
    """
    parts = [
        (line, part)
        for line, formula in problem.assertions
        for part in (formula.args if formula.op == "and" else (formula,))
    ]
    divided = [(line, part) for line, part in parts if next(divisors(part), None) is not None]
    whole = [part for _, part in parts if next(divisors(part), None) is None]
    if not divided:
        return denial(problem, name, whole)
    lines: list[Line] = [("given", part) for part in whole]
    forall = used(problem, [part for _, part in parts])
    for line, part in divided:
        for below in divisors(part):
            lines += _licence(problem, line, Statement(name, forall, tuple(lines)), below)
    return Statement(
        name, forall, tuple(lines), Formula("not", conjunction(part for _, part in divided))
    )


def denial(problem: Problem, name: str, formulas: Sequence[Formula]) -> Statement:
    """The statement that some formulas do not hold at once, without givens."""
    return Statement(name, used(problem, formulas), (), Formula("not", conjunction(formulas)))


def givens(statement: Statement) -> list[Formula]:
    """What the statement assumes."""
    return [
        said
        for keyword, said in statement.lines
        if keyword == "given" and isinstance(said, Formula)
    ]


def used(problem: Problem, formulas: Sequence[Formula]) -> tuple[str, ...]:
    """The variables that occur, in the order of the script."""
    occurring = {name for formula in formulas for name in names_in(formula)}
    return tuple(variable.name for variable in problem.variables if variable.name in occurring)


def divisors(thing: Term | Formula) -> Iterator[Term]:
    """What is divided by, inner divisors first; not numbers other than 0."""
    for part in thing.args:
        if isinstance(part, (Term, Formula)):
            yield from divisors(part)
    if thing.op == "/" and not (thing.args[1].op == "num" and thing.args[1].args[0]):
        yield thing.args[1]


def _licence(problem: Problem, line: int, before: Statement, below: Term) -> list[Line]:
    """The `have` line that keeps a divisor from 0, if it needs one."""
    story = checker.Unfolding(_read(before), checker.Context())
    try:
        story.context.reciprocal(checker.parse(str(below)))
        return []
    except checker.Rejected:
        pass
    for sign in (below > 0, below < 0, different(below, 0)):
        said = Statement(before.name, before.forall, before.lines, sign)
        if search_proof(_read(said), {}, Budget(SIDE_BUDGET), effort=1) is not None:
            return [("have", sign)]
    raise ClaimError(
        f"{problem.file}:{line}: division by {below}, which may vanish; assert before it that this"
        " is not 0, or multiply it out"
    )


def _read(statement: Statement) -> checker.Statement:
    parsed: checker.Statement = checker.read_statements(statement.text())[statement.name]
    return parsed
