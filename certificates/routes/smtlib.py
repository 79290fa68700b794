"""Statements as SMT-LIB 2 text for other solvers: `unsat` everywhere means that the statement
holds.

Denominators are cleared before anything is written, so that a solver's own x/0 never enters; the
text is the same from run to run.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from certificates.routes.polynomials import Atom, Formula, Polynomial
from certificates.routes.questions import TRUSTED, Denial, Question, questions
from certificates.routes.smt_terms import number_checks, recurrence, symbol


def script(statement: Any, earlier: Mapping[str, Any] | None = None) -> str:
    """The whole statement as one script: a check for each of its questions, each begun by a reset,
    so that scripts may be joined.

    Formula: the statement holds <=> every check answers unsat.
    Source: SMT-LIB 2.6, logics QF_NRA, NRA, QF_NIA, QF_NIRA, UFNIRA.

    >>> from certificates.routes.questions import read_statement
    >>> text = "statement demo/square\\nforall x\\ngiven x > 1\\nshow x^2/2 >= x - 1/2"
    >>> print(script(read_statement(text)))
    ; statement demo/square: it holds if and only if every check below answers unsat
    <BLANKLINE>
    ; goal: a solution refutes the statement
    (reset)
    (set-logic QF_NRA)
    (declare-const x Real)
    (assert (> (+ x (- 1)) 0))
    (assert (> (+ (* (- 1) x x) (* 2 x) (- 1)) 0))
    (check-sat)
    <BLANKLINE>
    """
    rows = [
        f"; statement {statement.name}: it holds if and only if every check below answers unsat"
    ]
    if statement.kind == "sharp":
        rows.append(
            "; sharp range: inside it every named statement holds, outside it one of them fails at"
            " every parameter"
        )
    if statement.kind in TRUSTED.ORBIT_RULES and statement.kind != "iterates":
        rows[0] += ", which are the premises of its rule, beside the statements that it names"
        for premise in TRUSTED.premises_of(statement, earlier or {}).values():
            rows += script(premise).splitlines()[1:]
        return "\n".join(rows) + "\n"
    for question in questions(statement, earlier):
        asked = (
            recurrence(statement)
            if statement.kind == "iterates"
            else [*declarations(question), *assertions(question)]
        )
        rows += _check(question.part, _meaning(question), logic(question), asked)
    for name, (polynomial, low, high) in statement.get("number"):
        for meaning, asked in number_checks(name, polynomial, low, high):
            rows += _check(f"number {name}", meaning, "QF_NRA", asked)
    return "\n".join(rows) + "\n"


def _check(part: str, meaning: str, in_logic: str, asked: Sequence[str]) -> list[str]:
    return ["", f"; {part}: {meaning}", "(reset)", f"(set-logic {in_logic})", *asked, "(check-sat)"]


def question_text(question: Question) -> str:
    """One question as declarations and assertions, without a check: what is sent to a solver."""
    return "\n".join([*declarations(question), *assertions(question)]) + "\n"


def _meaning(question: Question) -> str:
    if question.part == "outside":
        return "a solution is a parameter outside the range at which all the named statements hold"
    if question.part == "recurrence":
        return (
            "a solution is a point at which P(0) is not the identity or the map does not lead from"
            " P(K) to P(K + 1)"
        )
    return (
        "a solution refutes the statement"
        if question.refutes
        else "a solution shows that this line does not follow from those before"
    )


def logic(question: Question) -> str:
    """The SMT-LIB logic that the question belongs to; there is none with quantifiers and both sorts
    but without functions.
    """
    arithmetic = (
        "NRA"
        if not question.integers
        else "NIA"
        if question.integers >= set(question.names)
        else "NIRA"
    )
    return (
        ("UF" if arithmetic == "NIRA" else "") + arithmetic
        if question.quantified
        else f"QF_{arithmetic}"
    )


def declarations(question: Question) -> list[str]:
    """A constant for every variable that occurs and that no denial binds."""
    return [
        f"(declare-const {symbol(name)} {_sort(question, name)})"
        for name in question.occurring()
        if name not in question.bound
    ]


def assertions(question: Question) -> list[str]:
    """Everything assumed, then every denial, one to a line."""
    rows = [f"(assert {write_formula(formula, question.integers)})" for formula in question.assumed]
    return rows + [f"(assert {_denial(question, denial)})" for denial in question.denials]


def _denial(question: Question, denial: Denial) -> str:
    body = write_formula(denial.formula, question.integers)
    for word, names in (("exists", denial.chosen), ("forall", denial.bound)):
        if names:
            body = (
                f"({word}"
                f" ({' '.join(f'({symbol(name)} {_sort(question, name)})' for name in names)})"
                f" {body})"
            )
    return body


def _sort(question: Question, name: str) -> str:
    return "Int" if name in question.integers else "Real"


def write_formula(formula: Formula, integers: frozenset[str] = frozenset()) -> str:
    """The formula as an s-expression."""
    if isinstance(formula, bool):
        return "true" if formula else "false"
    if isinstance(formula, Atom):
        text = (
            f"({'=' if formula.relation == '!=' else formula.relation}"
            f" {write_polynomial(formula.poly, integers)} 0)"
        )
        return f"(not {text})" if formula.relation == "!=" else text
    return f"({formula.op} {' '.join(write_formula(part, integers) for part in formula.parts)})"


def write_polynomial(poly: Polynomial, integers: frozenset[str] = frozenset()) -> str:
    """The polynomial times its denominator as a sum of monomials; a relation to 0 is the same for
    it.

    A variable that is an integer is read as a real wherever a real variable stands beside it in the
    polynomial.
    """
    mixed = any(poly.names[i] not in integers for i in poly.used)
    terms = []
    for exponents, c in poly.terms:
        factors = [
            _variable(n, n in integers and mixed)
            for n, e in zip(poly.names, exponents)
            for _ in range(e)
        ]
        number = str(c) if c >= 0 else f"(- {-c})"
        factors = factors if c == 1 and factors else [number, *factors]
        terms.append(factors[0] if len(factors) == 1 else f"(* {' '.join(factors)})")
    return terms[0] if len(terms) == 1 else f"(+ {' '.join(terms)})" if terms else "0"


def _variable(name: str, lifted: bool) -> str:
    return f"(to_real {symbol(name)})" if lifted else symbol(name)
