"""Solvers that answer whether the supremum exceeds a bound: Z3, cvc5, QEPCAD B, and coq-interval,
which proves that it does not.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from pathlib import Path

from juggleproof.benchmarks.bench.answers import (
    SHARE,
    Answer,
    BoundQuestion,
    GaveUp,
    best_point,
    horner,
)
from juggleproof.benchmarks.processes import output_of

# -------------------------------------------------------------------------------------------------
# The excess of a problem as a goal for Coq's tactic interval (Debian package libcoq-interval).

HEAD = "From Coq Require Import Reals.\nFrom Interval Require Import Tactic.\nOpen Scope R_scope.\n"
BITS, DEPTH = 100, 60


@cache
def has_coq_interval() -> bool:
    """Whether the compiler and the library are installed."""
    coqc = shutil.which("coqc")
    if coqc is None:
        return False
    where = subprocess.run(
        [coqc, "-where"], capture_output=True, text=True, check=False
    ).stdout.strip()
    folders = [
        Path(where) / "user-contrib",
        *map(Path, filter(None, os.environ.get("COQPATH", "").split(":"))),
    ]
    return any((folder / "Interval" / "Tactic.vo").exists() for folder in folders)


def goal(problem: BoundQuestion, bound: Fraction) -> str:
    """The goal that the excess is >= 0 on the box, by bisection of all variables, with slopes along
    the last.

    >>> from fractions import Fraction as F
    >>> one = BoundQuestion("half", ("p",), ((F(0), F(1)),), {(1,): F(1)}, {(0,): F(2)}, 1, "", "")
    >>> print(goal(one, F(1)).splitlines()[-2])
    Goal forall v0 : R, 0/1 <= v0 <= 1/1 -> 0 <= 2/1 + v0*(-1/1).
    """
    short = [f"v{i}" for i in range(len(problem.names))]
    sides = "".join(
        f"{_number(low)} <= {v} <= {_number(high)} -> "
        for v, (low, high) in zip(short, problem.box)
    )
    excess = horner(problem.excess(bound), short, _number)
    halved = ", ".join(f"i_bisect {v}" for v in short)
    return (
        f"{HEAD}Goal forall {' '.join(short)} : R, {sides}0 <= {excess}.\nProof. intros; interval"
        f" with ({halved}, i_autodiff {short[-1]}, i_prec {BITS}, i_depth {DEPTH}). Qed.\n"
    )


def _number(value: Fraction) -> str:
    return f"{value.numerator}/{value.denominator}"


def proves(text: str, seconds: float) -> bool:
    """Whether coqc accepts the goal."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "goal.v"
        path.write_text(text, encoding="utf-8")
        return (
            output_of(["coqc", "-q", str(path)], "", seconds) is not None
            and path.with_suffix(".vo").exists()
        )


# -------------------------------------------------------------------------------------------------
# Questions to solvers: by bisection, and one question just above the value at a point.
#
# An enclosure made of such answers is worth as much as the solver's word; none leaves a proof that
# is checked here.

START = Fraction(4)  # every supremum asked for lies between -4 and 4, which is asked too
ENOUGH = 3600.0  # CPU seconds: fewer are left to the process that asks
Exceeds = Callable[[BoundQuestion, Fraction], bool]


def bisected(exceeds: Exceeds, problem: BoundQuestion, width: Fraction) -> Answer:
    """Halves the range until it is as narrow as the width; raises GaveUp if the supremum is not in
    [-START, START].
    """
    low, high, asked = -START, START, 2
    if not exceeds(problem, low) or exceeds(problem, high):
        raise GaveUp("the supremum is not between -4 and 4")
    while high - low > width:
        middle, asked = (low + high) / 2, asked + 1
        low, high = (middle, high) if exceeds(problem, middle) else (low, middle)
    return Answer(low, high, f"{asked} questions")


def asked_once(exceeds: Exceeds, problem: BoundQuestion, width: Fraction) -> Answer:
    """Asks one question, a little above the value at a point, which floating point finds and exact
    arithmetic evaluates; raises GaveUp if the supremum exceeds it.
    """
    low = best_point(problem, width / SHARE)[1]
    high = low + width * (SHARE - 1) / SHARE
    if exceeds(problem, high):
        raise GaveUp("the point found is not good enough")
    return Answer(low, high, "1 question")


def _decided(answer: str) -> bool:
    if answer not in ("sat", "unsat"):
        raise GaveUp(answer or "no answer")
    return answer == "sat"


def by_z3(problem: BoundQuestion, bound: Fraction) -> bool:
    """Z3's nlsat, in this process, which is its fastest way."""
    import z3

    solver = z3.Tactic("qfnra-nlsat").solver()
    solver.from_string(problem.asked(bound))
    return _decided(str(solver.check()))


def by_cvc5(problem: BoundQuestion, bound: Fraction, proof: bool = False) -> bool:
    """cvc5, in this process; if asked to, it writes its proof, in its own format.  Raises GaveUp if
    it does not decide, or writes none.
    """
    import cvc5

    solver = cvc5.Solver()
    solver.setOption("produce-proofs", "true" if proof else "false")
    parser = cvc5.InputParser(solver)
    parser.setStringInput(
        cvc5.InputLanguage.SMT_LIB_2_6,
        f"(set-logic QF_NRA)\n{problem.asked(bound)}(check-sat)\n",
        "question",
    )
    output = ""
    while not (command := parser.nextCommand()).isNull():
        output += str(command.invoke(solver, parser.getSymbolManager()))
    exceeds = _decided(output.strip())
    if proof and not exceeds and not solver.proofToString(solver.getProof()[0]):
        raise GaveUp("no proof")
    return exceeds


def by_cvc5_with_proof(problem: BoundQuestion, bound: Fraction) -> bool:
    """cvc5, which writes its proof where nothing exceeds the bound."""
    return by_cvc5(problem, bound, True)


def by_qepcad(problem: BoundQuestion, bound: Fraction) -> bool:
    """QEPCAD B, which is used as a program that is started for each question."""
    from juggleproof.benchmarks.bench.qepcad import fails

    answer = fails(problem.of_set(bound))
    if answer is None:
        raise GaveUp("no answer")
    return answer


def by_coq_interval(problem: BoundQuestion, bound: Fraction) -> bool:
    """Coq's tactic interval proves that nothing on the box exceeds the bound; it refutes nothing.
    Its proof is checked by Coq's kernel.  Raises GaveUp if there is none.
    """
    if not proves(goal(problem, bound), ENOUGH):
        raise GaveUp("no proof")
    return False
