"""Questions of a statement in the notation of Coq and of QEPCAD B."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from flint import fmpz_mpoly

from juggleproof.votes.questions import Atom, Formula, Question, join

# -------------------------------------------------------------------------------------------------
# Formulas in the notation of a program.


@dataclass(frozen=True)
class Notation:
    """How a program writes truth values, brackets, products, powers, and a polynomial's relation to
    0.
    """

    true: str
    false: str
    brackets: str
    times: str
    power: Callable[[str, int], str]
    relations: Mapping[str, str]

    def formula(self, formula: Formula, short: Mapping[str, str]) -> str:
        """The formula, its variables by their short names."""
        if isinstance(formula, bool):
            return self.true if formula else self.false
        if isinstance(formula, Atom):
            return self.relations[formula.relation].format(self.polynomial(formula.poly, short))
        parts = [self.formula(part, short) for part in formula.parts]
        inner = (" /\\ " if formula.op == "and" else " \\/ ").join(parts)
        return self.brackets[0] + inner + self.brackets[1]

    def polynomial(self, poly: fmpz_mpoly, short: Mapping[str, str]) -> str:
        """The polynomial, with short names in place of those of its ring."""
        text, names = "", [short.get(name, name) for name in poly.context().names()]
        for exponents, c in zip(poly.monoms(), poly.coeffs()):
            powers = [self.power(n, e) for n, e in zip(names, exponents) if e]
            size = [] if abs(c) == 1 and powers else [str(abs(c))]
            factors = self.times.join([*size, *powers])
            sign = (" - " if c < 0 else " + ") if text else ("- " if c < 0 else "")
            text += sign + factors
        return text or "0"


COQ = Notation(
    "True",
    "False",
    "()",
    "*",
    lambda name, exponent: "*".join([name] * exponent),
    {">": "{0} > 0", ">=": "{0} >= 0", "=": "{0} = 0", "!=": "({0} < 0 \\/ {0} > 0)"},
)
QEPCAD = Notation(
    "0 = 0",
    "0 = 1",
    "[]",
    " ",
    lambda name, exponent: name if exponent == 1 else f"{name}^{exponent}",
    {">": "{0} > 0", ">=": "{0} >= 0", "=": "{0} = 0", "!=": "{0} /= 0"},
)

# -------------------------------------------------------------------------------------------------
# Coq's nra and psatz on the questions of a statement: the givens and the denial of the goal lead to
# False.
#
# Real numbers only, and no quantifiers, which these tactics do not have.  They refute nothing.

HEAD = """From Coq Require Import Reals Psatz.
Open Scope R_scope.
Ltac split_up := repeat match goal with
  | H : _ /\\ _ |- _ => destruct H | H : _ \\/ _ |- _ => destruct H
  | H : False |- _ => contradiction end.
"""


def goal(question: Question, tactic: str = "nra") -> str | None:
    """The question as a goal; p <> 0 is p < 0 or p > 0, since nra does not read it; None where it
    has integers or quantifiers.

    >>> from juggleproof.votes.questions import questions, read_statement
    >>> text = "statement a/b\\nforall x\\ngiven x != 0\\nshow x^2/2 > 0"
    >>> print(goal(questions(read_statement(text))[0]))
    Goal forall v0 : R, (v0 < 0 \\/ v0 > 0) -> - v0*v0 >= 0 -> False.
    Proof. intros; split_up; nra. Qed.
    <BLANKLINE>
    """
    if question.integers & set(question.occurring()) or question.quantified:
        return None
    short = {name: f"v{i}" for i, name in enumerate(question.occurring())}
    lines = [
        COQ.formula(formula, short)
        for formula in (*question.assumed, *(denial.formula for denial in question.denials))
    ]
    over = f"forall {' '.join(short.values())} : R, " if short else ""
    return (
        f"Goal {over}{' -> '.join([*lines, 'False'])}.\nProof. intros; split_up; {tactic}. Qed.\n"
    )


# -------------------------------------------------------------------------------------------------
# QEPCAD B on the questions of a statement, each a prenex formula: there is a point, such that for
# all values of the bound variables, the givens and the denial of the goal hold.
#
# The answer FALSE to every question means that the statement holds.  Source of the format: QEPCAD B
# 1.74, `qepcad -h` and its help file.


def prenex(question: Question) -> str | None:
    """The input for one question; None where it has integers, or a second alternation of
    quantifiers.

    >>> from juggleproof.votes.questions import questions, read_statement
    >>> text = "statement a/b\\nforall x\\ngiven x > 0\\nexists y\\nshow y^2 = x/2"
    >>> asked = questions(read_statement(text))
    >>> print(prenex(asked[0]))
    [ a/b goal ]
    (v0,v1)
    0
    (E v0)(A v1)[ [v0 > 0 /\\ v0 - 2 v1^2 /= 0] ].
    finish
    <BLANKLINE>
    """
    if question.integers & set(question.occurring()) or any(
        denial.chosen for denial in question.denials
    ):
        return None
    free = [name for name in question.occurring() if name not in question.bound] or ["none"]
    bound = [name for name in question.names if name in question.bound]
    short = {name: f"v{i}" for i, name in enumerate([*free, *bound])}
    quantifiers = "".join(
        f"({'A' if name in question.bound else 'E'} {v})" for name, v in short.items()
    )
    formula = QEPCAD.formula(
        join("and", [*question.assumed, *(denial.formula for denial in question.denials)]), short
    )
    return (
        f"[ {question.statement} {question.part} ]\n({','.join(short.values())})\n0\n{quantifiers}["
        f" {formula} ].\nfinish\n"
    )
