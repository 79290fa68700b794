"""QEPCAD B on a statement: each of its questions is a prenex formula, which says that there is a
point at which the givens and the negation of the goal hold.

The answer FALSE to every question means that the statement holds.  Source of the format: QEPCAD B
1.74, `qepcad -h` and its help file.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from flint import fmpz_mpoly

from juggleproof.benchmarks.processes import output_of
from juggleproof.votes.questions import (
    Atom,
    Formula,
    VoteQuestion,
    join,
    questions,
    read_statement,
)

CELLS = (2_000_000, 100_000_000)  # of memory for lists; setting up the second takes 1 s
TOO_FEW = "Too few cells"
RELATIONS = {"!=": "/="}  # those that are written differently


def prenex(question: VoteQuestion) -> str:
    """Return the input for one question about real numbers, without quantifiers.

    >>> text = "statement a/b\\nforall x\\ngiven x > 0\\nshow 2*x^2 != 1/2"
    >>> (asked,) = questions(read_statement(text))
    >>> print(prenex(asked))
    [ a/b goal ]
    (v0)
    0
    (E v0)[ [v0 > 0 /\\ 4 v0^2 - 1 = 0] ].
    finish
    <BLANKLINE>
    """
    short = {name: f"v{i}" for i, name in enumerate(question.occurring() or ["none"])}
    formula = join("and", [*question.assumed, *(denial.formula for denial in question.denials)])
    return (
        f"[ {question.statement} {question.part} ]\n({','.join(short.values())})\n0\n"
        f"{''.join(f'(E {v})' for v in short.values())}[ {_formula(formula, short)} ].\nfinish\n"
    )


def _formula(formula: Formula, short: Mapping[str, str]) -> str:
    """Return the text of a formula, with its variables by their short names."""
    if isinstance(formula, bool):
        return "0 = 0" if formula else "0 = 1"
    if isinstance(formula, Atom):
        relation = RELATIONS.get(formula.relation, formula.relation)
        return f"{_polynomial(formula.poly, short)} {relation} 0"
    sign = " /\\ " if formula[0] == "and" else " \\/ "
    return f"[{sign.join(_formula(part, short) for part in formula[1])}]"


def _polynomial(poly: fmpz_mpoly, short: Mapping[str, str]) -> str:
    """Return the text of a polynomial, with short names in place of those of its ring."""
    text, names = "", [short.get(name, name) for name in poly.context().names()]
    for exponents, c in zip(poly.monoms(), poly.coeffs()):
        powers = [n if e == 1 else f"{n}^{e}" for n, e in zip(names, exponents) if e]
        size = [] if abs(c) == 1 and powers else [str(abs(c))]
        sign = (" - " if c < 0 else " + ") if text else ("- " if c < 0 else "")
        text += sign + " ".join([*size, *powers])
    return text or "0"


def qepcad(text: str) -> str:
    """Return QEPCAD's answer, TRUE or FALSE; an empty text if it gives none within the CPU seconds
    that are left.
    """
    for cells in CELLS:
        output = output_of(["qepcad", "-noecho", f"+N{cells}"], text) or ""
        if TOO_FEW not in output:
            break
    match = re.search(r"An equivalent quantifier-free formula:\s+(TRUE|FALSE)\s", output)
    return match[1] if match else ""


def fails(text: str) -> bool | None:
    """Return whether a statement fails, by QEPCAD; None if it does not decide."""
    asked = questions(read_statement(text))
    answers = [qepcad(prenex(question)) for question in asked]
    if ("TRUE", True) in zip(answers, (question.refutes for question in asked)):
        return True
    return False if set(answers) == {"FALSE"} else None
