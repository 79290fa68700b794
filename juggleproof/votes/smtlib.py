"""Statements and their questions as SMT-LIB 2 text for Z3 and other solvers."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence

from flint import fmpz_mpoly

from juggleproof.algebra import trees
from juggleproof.algebra.polynomials import used_in
from juggleproof.certificates import checker
from juggleproof.statements.formulas import ClaimError
from juggleproof.votes.questions import (
    Atom,
    Denial,
    Formula,
    VoteQuestion,
    questions,
)

# -------------------------------------------------------------------------------------------------
# Terms of a statement as SMT-LIB text without expanding them: what a recurrence and an algebraic
# end point are asked in.
#
# Expanded by the checker, a recurrence that holds is 0 = 0 and leaves a solver nothing to ask; as
# it stands, it does.

OPERATORS: Mapping[type, str] = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}

# words that a solver reads as its own: an underscored spelling keeps the variable apart from them
TAKEN = frozenset(
    "abs div mod ite let forall exists par as xor distinct true false pi euler e exp log sin cos"
    " tan to_real to_int is_int is match select store assert push pop reset exit model".split()
)


def symbol(name: str) -> str:
    """The name as an SMT-LIB symbol that no theory has taken; names of statements hold no `!`."""
    return name + "!" if name in TAKEN else name


def write_term(tree: ast.expr, values: Mapping[str, str]) -> str:
    """The term with these texts in place of its names; a whole power as a product.  Raises KeyError
    for a name without a text.

    >>> write_term(ast.parse("x**2/2 - K", mode="eval").body, {"x": "(+ y 1)", "K": "0"})
    '(- (/ (* (+ y 1) (+ y 1)) 2) 0)'
    """
    if isinstance(tree, ast.Constant):
        return str(tree.value)
    if isinstance(tree, ast.Name):
        return values[tree.id]
    if isinstance(tree, ast.UnaryOp):
        return f"(- {write_term(tree.operand, values)})"
    if not isinstance(tree, ast.BinOp):
        raise ClaimError(f"{ast.unparse(tree)!r} is not a term")
    left = write_term(tree.left, values)
    if isinstance(tree.op, ast.Pow):
        exponent = ast.literal_eval(tree.right)
        return f"(* {' '.join([left] * exponent)})" if exponent > 1 else left if exponent else "1"
    return f"({OPERATORS[type(tree.op)]} {left} {write_term(tree.right, values)})"


def recurrence(statement: checker.Statement) -> list[str]:
    """P(0) is not the identity, or map(P(K)) is not P(K + 1); for all real K, where what is meant
    is an integer: it is an identity.
    """
    (variables,), ((arguments, images),), ((count, powers),) = (
        statement.get(keyword) for keyword in ("forall", "iterates", "after")
    )
    images, powers = ([checker.parse(text) for text in terms] for terms in (images, powers))
    symbols = {name: symbol(name) for name in variables}
    k = count[0]

    def image(trees: Sequence[ast.expr], changes: Mapping[str, str]) -> list[str]:
        values = {**symbols, **changes}
        for name, tree in statement.get("let"):
            values[name] = write_term(tree, values)
        return [write_term(tree, values) for tree in trees]

    pairs = [
        *zip(image(powers, {k: "0"}), (symbols[name] for name in arguments)),
        *zip(
            image(images, dict(zip(arguments, image(powers, {})))),
            image(powers, {k: f"(+ {symbols[k]} 1)"}),
        ),
    ]
    fails = " ".join(f"(not (= {left} {right}))" for left, right in pairs)
    return [
        *(f"(declare-const {symbols[name]} Real)" for name in variables),
        f"(assert (or {fails}))",
    ]


def number_checks(
    name: str, polynomial: ast.expr, low: ast.expr, high: ast.expr
) -> list[tuple[str, list[str]]]:
    """(what a solution means, assertions) of the checks that an algebraic number is one: the
    polynomial has exactly one root between the ends: its signs at them are opposite, and no
    two roots lie there.
    """
    (variable,) = {node.id for node in ast.walk(polynomial) if isinstance(node, ast.Name)}
    ends, roots = [write_term(end, {}) for end in (low, high)], [symbol(name), name + "!second"]
    at = {point: write_term(polynomial, {variable: point}) for point in (*ends, *roots)}
    return [
        (
            (
                "a solution shows that the ends are out of order, or that the signs at them are not"
                " opposite"
            ),
            [f"(assert (or (>= {ends[0]} {ends[1]}) (>= (* {at[ends[0]]} {at[ends[1]]}) 0)))"],
        ),
        (
            "a solution is a second root between the ends",
            [
                *(f"(declare-const {root} Real)" for root in roots),
                *(f"(assert (= {at[root]} 0))" for root in roots),
                (
                    f"(assert (and (<= {ends[0]} {roots[0]}) (< {roots[0]} {roots[1]}) (<="
                    f" {roots[1]} {ends[1]})))"
                ),
            ],
        ),
    ]


# -------------------------------------------------------------------------------------------------
# Statements as SMT-LIB 2 text for other solvers: `unsat` everywhere means that the statement
# holds.
#
# Denominators are cleared before anything is written, so that a solver's own x/0 never enters; the
# text is the same from run to run.


def script(
    statement: checker.Statement, earlier: Mapping[str, checker.Statement] | None = None
) -> str:
    """The whole statement as one script: a check for each of its questions, each begun by a reset,
    so that scripts may be joined.

    Formula: the statement holds <=> every check answers unsat.
    Source: SMT-LIB 2.6, logics QF_NRA, NRA, QF_NIA, QF_NIRA, UFNIRA.

    >>> from juggleproof.votes.questions import read_statement
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
    if statement.kind in checker.orbit_rules() and statement.kind != "iterates":
        rows[0] += ", which are the premises of its rule, beside the statements that it names"
        for premise in checker.premises_of(statement, earlier or {}).values():
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


def question_text(question: VoteQuestion) -> str:
    """One question as declarations and assertions, without a check: what is sent to a solver."""
    return "\n".join([*declarations(question), *assertions(question)]) + "\n"


def _meaning(question: VoteQuestion) -> str:
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


def logic(question: VoteQuestion) -> str:
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


def declarations(question: VoteQuestion) -> list[str]:
    """A constant for every variable that occurs and that no denial binds."""
    return [
        f"(declare-const {symbol(name)} {_sort(question, name)})"
        for name in question.occurring()
        if name not in question.bound
    ]


def assertions(question: VoteQuestion) -> list[str]:
    """Everything assumed, then every denial, one to a line."""
    rows = [f"(assert {write_formula(formula, question.integers)})" for formula in question.assumed]
    return rows + [f"(assert {_denial(question, denial)})" for denial in question.denials]


def _denial(question: VoteQuestion, denial: Denial) -> str:
    body = write_formula(denial.formula, question.integers)
    for word, names in (("exists", denial.chosen), ("forall", denial.bound)):
        if names:
            body = (
                f"({word}"
                f" ({' '.join(f'({symbol(name)} {_sort(question, name)})' for name in names)})"
                f" {body})"
            )
    return body


def _sort(question: VoteQuestion, name: str) -> str:
    return "Int" if name in question.integers else "Real"


def write_formula(formula: Formula, integers: frozenset[str] = frozenset()) -> str:
    """The formula as an s-expression."""

    def text(fact: Atom) -> str:
        poly = write_polynomial(fact.poly, integers)
        return f"(not (= {poly} 0))" if fact.relation == "!=" else f"({fact.relation} {poly} 0)"

    return trees.written(formula, text)


def write_polynomial(poly: fmpz_mpoly, integers: frozenset[str] = frozenset()) -> str:
    """The polynomial as a sum of monomials.

    A variable that is an integer is read as a real wherever a real variable stands beside it in the
    polynomial.
    """
    names = poly.context().names()
    mixed = any(names[i] not in integers for i in used_in(poly))
    terms = []
    for exponents, coefficient in zip(poly.monoms(), poly.coeffs()):
        c = int(coefficient)
        factors = [
            _variable(n, n in integers and mixed)
            for n, e in zip(names, exponents)
            for _ in range(e)
        ]
        number = str(c) if c >= 0 else f"(- {-c})"
        factors = factors if c == 1 and factors else [number, *factors]
        terms.append(factors[0] if len(factors) == 1 else f"(* {' '.join(factors)})")
    return terms[0] if len(terms) == 1 else f"(+ {' '.join(terms)})" if terms else "0"


def _variable(name: str, lifted: bool) -> str:
    return f"(to_real {symbol(name)})" if lifted else symbol(name)
