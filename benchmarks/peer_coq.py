"""Coq's nra on the questions of a statement: what is assumed, and the denial of what is shown, lead
to False.

Real numbers only, and nothing that is said to exist: such a question is not expressible for nra,
which has no quantifiers.  It refutes nothing.
"""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from typing import Any

from benchmarks.running import Answer, Clock
from certificates.routes.polynomials import Atom, Formula, Polynomial
from certificates.routes.questions import Question, questions

HEAD = """From Coq Require Import Reals Psatz.
Open Scope R_scope.
Ltac split_up := repeat match goal with
  | H : _ /\\ _ |- _ => destruct H | H : _ \\/ _ |- _ => destruct H
  | H : False |- _ => contradiction end.
"""


def has_coq() -> bool:
    """Whether the compiler is there (Debian package coq)."""
    return shutil.which("coqc") is not None


def coq_nra(statement: Any, seconds: float) -> Answer:
    """Whether coqc accepts the goals of the statement, each by nra in every case."""
    goals = [goal(question) for question in questions(statement)]
    if None in goals:
        return "not expressible"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "goal.v"
        path.write_text(HEAD + "".join(text for text in goals if text), encoding="utf-8")
        said = Clock(seconds).output_of(["coqc", "-q", str(path)], "")
        return "holds" if said is not None and path.with_suffix(".vo").exists() else "unsettled"


def goal(question: Question) -> str | None:
    """The question as a goal; p <> 0 is p < 0 or p > 0, since nra does not read it.

    >>> from certificates.routes.questions import read_statement
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
        write(formula, short)
        for formula in (*question.assumed, *(denial.formula for denial in question.denials))
    ]
    over = f"forall {' '.join(short.values())} : R, " if short else ""
    return f"Goal {over}{' -> '.join([*lines, 'False'])}.\nProof. intros; split_up; nra. Qed.\n"


def write(formula: Formula, short: dict[str, str]) -> str:
    """The formula in Coq's signs."""
    if isinstance(formula, bool):
        return "True" if formula else "False"
    if isinstance(formula, Atom):
        text = polynomial(formula.poly, short)
        return (
            f"({text} < 0 \\/ {text} > 0)"
            if formula.relation == "!="
            else f"{text} {formula.relation} 0"
        )
    return (
        "("
        + (" /\\ " if formula.op == "and" else " \\/ ").join(
            write(part, short) for part in formula.parts
        )
        + ")"
    )


def polynomial(poly: Polynomial, short: dict[str, str]) -> str:
    """The polynomial times its denominator, which changes no relation to 0."""
    text = ""
    for exponents, c in poly.terms:
        powers = [short[n] for n, e in zip(poly.names, exponents) for _ in range(e)]
        factors = "*".join(powers if abs(c) == 1 and powers else [str(abs(c)), *powers])
        text += (" - " if c < 0 else " + ") + factors if text else ("- " if c < 0 else "") + factors
    return text or "0"
