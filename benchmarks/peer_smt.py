"""Z3 alone and cvc5, each in a process of its own, on the SMT-LIB script that
`juggleproof export smt2` writes.
"""

from __future__ import annotations

import os
import shutil
import sys
from importlib.util import find_spec
from typing import Any

from benchmarks.running import Answer, Clock
from certificates.routes.questions import questions
from certificates.routes.smtlib import script

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


def z3(statement: Any, seconds: float) -> Answer:
    """Z3's answer to the whole script."""
    return _answer([str(z3_command()), "-in"], statement, seconds)


def cvc5(statement: Any, seconds: float) -> Answer:
    """cvc5's answer to the whole script."""
    return _answer([sys.executable, "-c", CVC5], statement, seconds)


def _answer(command: list[str], statement: Any, seconds: float) -> Answer:
    said = Clock(seconds).output_of(command, script(statement)) or ""
    answers, asked = (
        [line for line in said.split() if line in ("sat", "unsat", "unknown")],
        questions(statement),
    )
    if any(answer == "sat" and question.refutes for answer, question in zip(answers, asked)):
        return "fails"
    return "holds" if answers == ["unsat"] * len(asked) else "unsettled"
