"""The same statements by our search with its check, and by peers: Z3 alone, cvc5, QEPCAD B and
Coq's nra; absent ones are named.

    python -m juggleproof.benchmarks.peers [--every 20] [--seconds 10]

A peer's answer is no certificate; ours is checked, and that time is counted.  Exit 1 where two
answers contradict each other, or one of them the stored certificate.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import signal
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from typing import Literal

from flint import fmpz_mpoly

from juggleproof.benchmarks.processes import Clock
from juggleproof.certificates import checker
from juggleproof.certificates.search.certificate import search_certificate
from juggleproof.certificates.store import DEFAULT, Store
from juggleproof.certificates.votes.questions import (
    Atom,
    Formula,
    Question,
    join,
    questions,
)
from juggleproof.certificates.votes.smtlib import script
from juggleproof.certificates.work import Budget, Exhausted

Answer = Literal["holds", "fails", "unsettled", "not expressible"]

# -------------------------------------------------------------------------------------------------
# Formulas in the notation of Coq and of QEPCAD B.


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
# Coq's nra on the questions of a statement: the givens and the denial of the goal lead to False.
#
# Real numbers only, and no quantifiers, which nra does not have.  It refutes nothing.

HEAD = """From Coq Require Import Reals Psatz.
Open Scope R_scope.
Ltac split_up := repeat match goal with
  | H : _ /\\ _ |- _ => destruct H | H : _ \\/ _ |- _ => destruct H
  | H : False |- _ => contradiction end.
"""


def has_coq() -> bool:
    """Whether the compiler is there (Debian package coq)."""
    return shutil.which("coqc") is not None


def coq_nra(statement: checker.Statement, seconds: float) -> Answer:
    """Whether coqc accepts the goals of the statement, each by nra in every case."""
    goals = [goal(question) for question in questions(statement)]
    if None in goals:
        return "not expressible"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "goal.v"
        path.write_text(HEAD + "".join(text for text in goals if text), encoding="utf-8")
        output = Clock(seconds).output_of(["coqc", "-q", str(path)], "")
        return "holds" if output is not None and path.with_suffix(".vo").exists() else "unsettled"


def goal(question: Question) -> str | None:
    """The question as a goal; p <> 0 is p < 0 or p > 0, since nra does not read it; None where it
    has integers or quantifiers.

    >>> from juggleproof.certificates.votes.questions import read_statement
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
    return f"Goal {over}{' -> '.join([*lines, 'False'])}.\nProof. intros; split_up; nra. Qed.\n"


# -------------------------------------------------------------------------------------------------
# QEPCAD B on the questions of a statement, each a prenex formula: there is a point, such that for
# all values of the bound variables, the givens and the denial of the goal hold.
#
# The answer FALSE to every question means that the statement holds.  Source of the format: QEPCAD B
# 1.74, `qepcad -h` and its help file.

CELLS = (2_000_000, 100_000_000)  # of memory for lists; setting up the second takes 1 s
TOO_FEW = "Too few cells"


def has_qepcad() -> bool:
    """Whether the program is there (Debian package qepcad)."""
    return shutil.which("qepcad") is not None


def qepcad(statement: checker.Statement, seconds: float) -> Answer:
    """QEPCAD's answer to the questions in turn, as one program each, which is how it is used."""
    clock, asked, answers = Clock(seconds), questions(statement), list[str]()
    texts = [prenex(question) for question in asked]
    for text in texts:
        if text is None:
            return "not expressible"
        for cells in CELLS:
            output = clock.output_of(["qepcad", "-noecho", f"+N{cells}"], text) or ""
            if TOO_FEW not in output:
                break
        match = re.search(r"An equivalent quantifier-free formula:\s+(TRUE|FALSE)\s", output)
        answers.append(match[1] if match else "")
    if any(answer == "TRUE" and question.refutes for answer, question in zip(answers, asked)):
        return "fails"
    return "holds" if answers == ["FALSE"] * len(asked) else "unsettled"


def prenex(question: Question) -> str | None:
    """The input for one question; None where it has integers, or a second alternation of
    quantifiers.

    >>> from juggleproof.certificates.votes.questions import read_statement
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


# -------------------------------------------------------------------------------------------------
# Z3 alone and cvc5 on the SMT-LIB script that `juggleproof export smt2` writes.

CVC5 = """import cvc5, sys
for check in sys.stdin.read().split('(reset)')[1:]:
    solver = cvc5.Solver()
    parser = cvc5.InputParser(solver)
    parser.setStringInput(cvc5.InputLanguage.SMT_LIB_2_6, check, 'check')
    while not (command := parser.nextCommand()).isNull():
        print(command.invoke(solver, parser.getSymbolManager()), end='')
"""


def z3_command() -> str | None:
    """The program that comes with the Python package, or the one on the path."""
    return shutil.which("z3", path=os.path.dirname(sys.executable)) or shutil.which("z3")


def has_cvc5() -> bool:
    """Whether cvc5's Python package is there."""
    return find_spec("cvc5") is not None


def z3(statement: checker.Statement, seconds: float) -> Answer:
    """Z3's answer to the whole script."""
    return _answer([str(z3_command()), "-in"], statement, seconds)


def cvc5(statement: checker.Statement, seconds: float) -> Answer:
    """cvc5's answer to the whole script."""
    return _answer([sys.executable, "-c", CVC5], statement, seconds)


def _answer(command: list[str], statement: checker.Statement, seconds: float) -> Answer:
    output = Clock(seconds).output_of(command, script(statement)) or ""
    answers = [line for line in output.split() if line in ("sat", "unsat", "unknown")]
    asked = questions(statement)
    if any(answer == "sat" and question.refutes for answer, question in zip(answers, asked)):
        return "fails"
    return "holds" if answers == ["unsat"] * len(asked) else "unsettled"


# -------------------------------------------------------------------------------------------------
# Ours, and the comparison.

TRIVIAL = "statement peers/start\nforall x\ngiven x > 0\nshow x + 1 > 0"
WORDS: dict[str, Answer] = {"certified": "holds", "refuted": "fails"}
NOTES = """\
settled: of the statements that the method can express (no integers for QEPCAD B; neither \
integers nor quantifiers for nra).
median, total: seconds of those, the limit where nothing was settled in time; start: seconds \
for x > 0 => x + 1 > 0.  Every peer is a
process of its own; our search and check run in this one.  nra proves, but refutes nothing."""


@dataclass
class Method:
    """A way to settle statements, and its answers with their seconds, by the statement's name."""

    title: str
    settle: Callable[[checker.Statement, float], Answer]
    present: bool = True
    package: str = ""
    answers: dict[str, tuple[Answer, float]] = field(default_factory=dict)

    def run(self, name: str, statement: checker.Statement, seconds: float) -> None:
        """Asks about one statement; an answer that comes too late does not count."""
        began = time.perf_counter()
        answer = self.settle(statement, seconds)
        took = time.perf_counter() - began
        self.answers[name] = (
            "unsettled" if took > seconds and answer != "not expressible" else answer,
            took,
        )

    def row(self, start: float) -> str:
        """The method's line in the table."""
        asked = [
            (answer, took) for answer, took in self.answers.values() if answer != "not expressible"
        ]
        settled, seconds = (
            [answer for answer, _ in asked if answer != "unsettled"],
            [took for _, took in asked] or [0.0],
        )
        return (
            f"{self.title:26} {len(settled):4}/{len(asked):<4} {settled.count('holds'):6}"
            f" {settled.count('fails'):6} {len(self.answers) - len(asked):15}"
            f" {statistics.median(seconds):9.3f} {sum(seconds):9.2f} {start:8.3f}"
        )


def ours(statement: checker.Statement, seconds: float) -> Answer:
    """The checker's verdict on the certificate that our search finds; nothing else is believed."""

    def late(*_: object) -> None:
        raise TimeoutError

    held = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        found = search_certificate(statement, {}, Budget(int(seconds * 1_000_000)))
        outcome = checker.check_one(statement, found, {}, {})[0]
    except (Exhausted, TimeoutError):
        return "unsettled"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, held)
    return WORDS.get(outcome, "unsettled")


def methods() -> list[Method]:
    """Ours and every peer, present or not."""
    return [
        Method("juggleproof, with its check", ours),
        Method("Z3 alone", z3, z3_command() is not None, "z3 (pip install z3-solver)"),
        Method("cvc5", cvc5, has_cvc5(), "cvc5 (pip install cvc5)"),
        Method("QEPCAD B", qepcad, has_qepcad(), "QEPCAD B (Debian package qepcad)"),
        Method("Coq's nra", coq_nra, has_coq(), "coqc (Debian package coq)"),
    ]


def contradictions(
    name: str, stored: Mapping[str, object] | None, asked: Sequence[Method]
) -> list[str]:
    """One line where the stored certificate and the methods do not all say the same of a
    statement.
    """
    words: dict[str, Answer] = {method.title: method.answers[name][0] for method in asked}
    if stored is not None:
        words["the stored certificate"] = next(
            (word for key, word in WORDS.items() if key in stored), "unsettled"
        )
    if {"holds", "fails"} <= set(words.values()):
        return [
            f"CONTRADICTION about {name}: "
            + "; ".join(f"{title}: {word}" for title, word in words.items())
        ]
    return []


def main() -> int:
    """Runs every method that is present on the sample; prints the table, what contradicts, and what
    is absent.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--every", type=int, default=20, help="one statement in so many")
    parser.add_argument(
        "--seconds", type=float, default=10.0, help="limit for each statement and method"
    )
    options = parser.parse_args()
    store = Store(DEFAULT)
    statements = checker.read_statements("\n\n".join(store.texts.values()))
    names = [name for name, statement in statements.items() if statement.kind == "universal"][
        :: options.every
    ]
    present, wrong = [method for method in methods() if method.present], list[str]()
    print(f"{len(names)} statements, {options.seconds:g} s for each")
    print(
        f"{'method':26} {'settled':>9} {'true':>6} {'false':>6} {'not expressible':>15}"
        f" {'median s':>9} {'total s':>9} {'start s':>8}"
    )
    (trivial,) = checker.read_statements(TRIVIAL).values()
    for method in present:
        method.settle(trivial, options.seconds)  # once before, so that files are in memory
        began = time.perf_counter()
        method.settle(trivial, options.seconds)
        start = time.perf_counter() - began
        for name in names:
            method.run(name, statements[name], options.seconds)
        print(method.row(start), flush=True)
    for name in names:
        wrong += contradictions(name, store.certificate(name, store.texts[name]), present)
    print(NOTES)
    for method in present:
        left = [name for name, (answer, _) in method.answers.items() if answer == "unsettled"]
        print(f"unsettled by {method.title}: {', '.join(left) or 'none'}")
    print(
        "absent: "
        + (", ".join(method.package for method in methods() if not method.present) or "none")
    )
    print("\n".join(wrong) or "no two answers contradict each other")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
