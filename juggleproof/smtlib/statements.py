"""The statement of a problem: for all reals, not all of the assertions hold.

Where a script divides, conditions that keep the divisor from 0 must come first: the assertions
without divisions are then givens, and a divisor that none of them licenses gets a `have` line,
which the certificate proves.  A divisor that may vanish is multiplied out, with a name for the
quotient: in SMT-LIB, x/0 may have any value, but the same one for the same x.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TypeVar, cast

from juggleproof.certificates import checker
from juggleproof.search.small_proofs.searches_in_turn import search_proof
from juggleproof.smtlib import limits
from juggleproof.smtlib.script import Problem, our_name
from juggleproof.statements.formulas import Expression
from juggleproof.statements.language import (
    Formula,
    Line,
    Statement,
    Term,
    conjunction,
    different,
    equal,
    implies,
    names_in,
    real,
)
from juggleproof.statements.work import Budget

Shape = TypeVar("Shape", bound=Expression)


def statement_of(problem: Problem, name: str) -> Statement:
    """The statement that no point satisfies the assertions.

    >>> from .script import read_problems
    >>> text = "(declare-const x Real)(assert (not (=> (> x 0) (> (/ 1 x) 0))))(check-sat)"
    >>> print(statement_of(read_problems(text, "f")[0], "f/check-1").text())
    statement f/check-1
    forall x
    given x > 0
    show 1/x > 0

    Formula, where d may vanish: (d != 0 => q*d = t) and, for all pairs, (d_i = 0 and d_j = 0 and
    t_i = t_j => q_i = q_j), with q in place of t/d.

    >>> text = "(declare-const x Real)(assert (= (/ 1 x) 0))(check-sat)"
    >>> print(statement_of(read_problems(text, "f")[0], "f/check-1").text())
    statement f/check-1
    forall x quotient
    show not (implies(x != 0, quotient*x = 1) and quotient = 0)
    """
    lets, meant = with_meanings(problem, [formula for _, formula in problem.assertions])
    parts = [part for formula in meant for part in conjuncts(formula)]
    whole = [part for part in parts if next(divisions(part), None) is None]
    divided = [part for part in parts if next(divisions(part), None) is not None]
    forall = used(problem, parts, lets)
    haves: list[Line] = []
    quotients: dict[Term, Term] = {}
    for k in range(len(divided)):
        divided[k] = _replaced(divided[k], quotients)
        for quotient in divisions(divided[k]):
            quotient = _replaced(quotient, quotients)
            if quotient.op != "/":
                continue
            _, below = quotient.operands
            lines = [*lets, *(("given", part) for part in whole), *haves]
            licence = _licence(Statement(name, forall, tuple(lines)), below)
            if licence is not None:
                haves += licence
                continue
            named = our_name("quotient", {*(one.name for one in problem.variables), *forall})
            forall = (*forall, named)
            whole += _definition(real(named), quotient, quotients)
            quotients[quotient] = real(named)
        divided[k] = _replaced(divided[k], quotients)
    whole += [part for part in divided if next(divisions(part), None) is None]
    divided = [part for part in divided if next(divisions(part), None) is not None]
    if not divided:
        return Statement(name, forall, lets, Formula("not", conjunction(whole)))
    givens: list[Line] = [("given", part) for part in whole]
    return Statement(name, forall, (*lets, *givens, *haves), _negation(conjunction(divided)))


def denial(problem: Problem, name: str, formulas: Sequence[Formula]) -> Statement:
    """The statement that some formulas do not hold at once, without givens."""
    lets, _ = with_meanings(problem, formulas)
    return Statement(
        name, used(problem, formulas, lets), lets, Formula("not", conjunction(formulas))
    )


def with_meanings(
    problem: Problem, formulas: Sequence[Formula]
) -> tuple[tuple[Line, ...], list[Formula]]:
    """The lines `let` of the names that occur in formulas, in order; and the formulas, together
    with those that are asserted of such names.
    """
    whole = dict.fromkeys(formulas)
    left: list[Term | Formula] = list(formulas)
    occurring: set[str] = set()
    while left:
        for name in names_in(left.pop()) & problem.meanings.keys() - occurring:
            occurring.add(name)
            meaning = problem.meanings[name]
            left.append(meaning)
            if isinstance(meaning, Formula):
                whole[meaning] = None
    lets = [(name, problem.meanings[name]) for name in problem.meanings if name in occurring]
    return tuple(("let", (k, said)) for k, said in lets if isinstance(said, Term)), list(whole)


def givens(statement: Statement) -> list[Formula]:
    """The formulas of the lines `given`."""
    return [
        formula
        for keyword, formula in statement.lines
        if keyword == "given" and isinstance(formula, Formula)
    ]


def conjuncts(formula: Formula) -> Iterator[Formula]:
    """The formulas whose conjunction is equivalent to this one, by its connectives.

    >>> x, y = map(real, "xy")
    >>> print(*conjuncts(Formula("not", implies((x > 0) & (y > 0), x < y))), sep="; ")
    x > 0; y > 0; not x < y
    """
    inner = formula.parts[0] if formula.op == "not" else formula
    if formula.op == "and":
        parts: Sequence[Formula] = formula.parts
    elif formula.op == "not" and inner.op == "or":
        parts = [_negation(part) for part in inner.parts]
    elif formula.op == "not" and inner.op == "implies":
        parts = [inner.parts[0], _negation(inner.parts[1])]
    elif formula.op == "not" and inner.op == "not":
        parts = inner.parts
    else:
        yield formula
        return
    for part in parts:
        yield from conjuncts(part)


def _negation(formula: Formula) -> Formula:
    return formula.parts[0] if formula.op == "not" else Formula("not", formula)


def used(problem: Problem, formulas: Sequence[Formula], lets: Sequence[Line]) -> tuple[str, ...]:
    """The variables that occur, in the script's order, then other names except those of `let`."""
    given = dict(said for _, said in lets if isinstance(said, tuple))
    occurring = {name for one in (*formulas, *given.values()) for name in names_in(one)}
    occurring -= given.keys()
    declared = [variable.name for variable in problem.variables]
    return (
        *(name for name in declared if name in occurring),
        *sorted(occurring.difference(declared)),
    )


def divisions(expression: Expression) -> Iterator[Term]:
    """The quotients in a term or formula, inner ones first, except those by a nonzero number."""
    for part in expression.args:
        if isinstance(part, Expression):
            yield from divisions(part)
    if isinstance(expression, Term) and expression.op == "/":
        _, below = expression.operands
        if below.op != "num" or below.value == 0:
            yield expression


def _licence(before: Statement, below: Term) -> list[Line] | None:
    """The `have` line that keeps a divisor from 0; [] if it needs none, None if none is proved."""
    try:
        unfolding = checker.Unfolding(_read(before), checker.Context())
        unfolding.context.reciprocal(checker.parse(str(below)))
        return []
    except checker.Rejected as reason:
        if reason.kind is not checker.Kind.DIVISION:  # it vanishes everywhere, or is too large
            return None
    for sign in (below > 0, below < 0, different(below, 0)):
        goal = Statement(before.name, before.forall, before.lines, sign)
        with suppress(checker.Rejected):  # the divisor itself has a divisor that may be 0
            if search_proof(_read(goal), {}, Budget(limits.SIDE_WORK), 1) is not None:
                return [("have", sign)]
    return None


def _definition(named: Term, quotient: Term, quotients: Mapping[Term, Term]) -> list[Formula]:
    """The formulas that hold for a named quotient, also with the quotients named before."""
    above, below = quotient.operands
    same = [
        implies(
            conjunction([equal(below, 0), equal(other.operands[1], 0), equal(above, numerator)]),
            equal(named, value),
        )
        for other, value in quotients.items()
        for numerator in other.operands[:1]
    ]
    return [implies(different(below, 0), equal(named * below, above)), *same]


def _replaced(expression: Shape, quotients: Mapping[Term, Term]) -> Shape:
    """The expression with the names of quotients in place of the quotients."""
    args = tuple(
        _replaced(part, quotients) if isinstance(part, Expression) else part
        for part in expression.args
    )
    changed: Expression = type(expression)(expression.op, *args)
    if isinstance(changed, Term):
        changed = quotients.get(changed, changed)
    return cast(Shape, changed)  # a term for a term, a formula for a formula


def _read(statement: Statement) -> checker.Statement:
    return checker.read_statements(statement.text())[statement.name]
