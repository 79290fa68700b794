"""QEPCAD B on the questions of a statement, each a prenex formula: there is a point, such that for
all bound values, all of it is so.

The answer FALSE to every question means that the statement holds.  Source of the format: QEPCAD B
1.74, `qepcad -h` and its help file.
"""

from __future__ import annotations

import re
import shutil
from typing import Any

from benchmarks.running import Answer, Clock
from certificates.routes.polynomials import Atom, Formula, Polynomial, join
from certificates.routes.questions import Question, questions

CELLS = (
    2_000_000,
    100_000_000,
    # of memory for lists; setting up the second takes 1 s, so it is tried only where the first is
    # too
    # small
)
TOO_FEW = "Too few cells"
RELATIONS = {">": ">", ">=": ">=", "=": "=", "!=": "/="}


def has_qepcad() -> bool:
    """Whether the program is there (Debian package qepcad)."""
    return shutil.which("qepcad") is not None


def qepcad(statement: Any, seconds: float) -> Answer:
    """QEPCAD's answer to the questions in turn, as one program each, which is how it is used."""
    clock, asked, answers = Clock(seconds), questions(statement), list[str]()
    texts = [prenex(question) for question in asked]
    for text in texts:
        if text is None:
            return "not expressible"
        for cells in CELLS:
            said = clock.output_of(["qepcad", "-noecho", f"+N{cells}"], text) or ""
            if TOO_FEW not in said:
                break
        found = re.search(r"An equivalent quantifier-free formula:\s+(TRUE|FALSE)\s", said)
        answers.append(found[1] if found else "")
    if any(answer == "TRUE" and question.refutes for answer, question in zip(answers, asked)):
        return "fails"
    return "holds" if answers == ["FALSE"] * len(asked) else "unsettled"


def prenex(question: Question) -> str | None:
    """The input for one question; None where it has integers, or a second alternation of
    quantifiers.

    >>> from certificates.routes.questions import read_statement
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
    formula = write(
        join("and", [*question.assumed, *(denial.formula for denial in question.denials)]), short
    )
    return (
        f"[ {question.statement} {question.part} ]\n({','.join(short.values())})\n0\n{quantifiers}["
        f" {formula} ].\nfinish\n"
    )


def write(formula: Formula, short: dict[str, str]) -> str:
    """The formula in QEPCAD's signs."""
    if isinstance(formula, bool):
        return "0 = 0" if formula else "0 = 1"
    if isinstance(formula, Atom):
        return f"{polynomial(formula.poly, short)} {RELATIONS[formula.relation]} 0"
    return (
        "["
        + (" /\\ " if formula.op == "and" else " \\/ ").join(
            write(part, short) for part in formula.parts
        )
        + "]"
    )


def polynomial(poly: Polynomial, short: dict[str, str]) -> str:
    """The polynomial times its denominator, which changes no relation to 0; a product is written by
    a space.
    """
    text = ""
    for exponents, c in poly.terms:
        powers = [
            short[n] if e == 1 else f"{short[n]}^{e}" for n, e in zip(poly.names, exponents) if e
        ]
        factors = " ".join(powers if abs(c) == 1 and powers else [str(abs(c)), *powers])
        text += (" - " if c < 0 else " + ") + factors if text else ("- " if c < 0 else "") + factors
    return text or "0"
