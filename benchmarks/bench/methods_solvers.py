"""Solvers that answer whether something exceeds a bound: by bisection, and by one question just
above the value at a point found for them.

An enclosure made of such answers is worth what the solver's word is worth; none leaves a proof
behind that is checked here.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from benchmarks.bench.answers import Answer, GaveUp
from benchmarks.bench.problems import Problem

SHARE = 8
START = Fraction(4)  # every supremum asked for lies between -4 and 4, which is asked too
ENOUGH = 3600.0  # seconds: the process that asks is ended long before
Exceeds = Callable[[Problem, Fraction], bool]


def bisected(exceeds: Exceeds, problem: Problem, width: Fraction) -> Answer:
    """The range halved until it is as narrow as the width."""
    low, high, asked = -START, START, 2
    if not exceeds(problem, low) or exceeds(problem, high):
        raise GaveUp("the supremum is not between -4 and 4")
    while high - low > width:
        middle, asked = (low + high) / 2, asked + 1
        low, high = (middle, high) if exceeds(problem, middle) else (low, middle)
    return Answer(low, high, f"{asked} questions")


def asked_once(exceeds: Exceeds, problem: Problem, width: Fraction) -> Answer:
    """One question, a little above the value at a point, which floating point finds and exact
    arithmetic evaluates.
    """
    from benchmarks.bench.finding import best_point  # NumPy, which bisection has no need of

    low = best_point(problem, width / SHARE)[1]
    high = low + width * (SHARE - 1) / SHARE
    if exceeds(problem, high):
        raise GaveUp("the point found is not good enough")
    return Answer(low, high, "1 question")


def _decided(answer: str) -> bool:
    if answer not in ("sat", "unsat"):
        raise GaveUp(answer or "no answer")
    return answer == "sat"


def by_z3(problem: Problem, bound: Fraction) -> bool:
    """Z3's nlsat, in this process, which is its fastest way."""
    import z3

    solver = z3.Tactic("qfnra-nlsat").solver()
    solver.from_string(problem.asked(bound))
    return _decided(str(solver.check()))


def by_cvc5(problem: Problem, bound: Fraction, proof: bool = False) -> bool:
    """cvc5, in this process; if asked to, it writes its proof, in its own format."""
    import cvc5

    solver = cvc5.Solver()
    solver.setOption("produce-proofs", "true" if proof else "false")
    parser: Any = cvc5.InputParser(solver)
    parser.setStringInput(
        cvc5.InputLanguage.SMT_LIB_2_6,
        f"(set-logic QF_NRA)\n{problem.asked(bound)}(check-sat)\n",
        "question",
    )
    said = ""
    while not (command := parser.nextCommand()).isNull():
        said += str(command.invoke(solver, parser.getSymbolManager()))
    exceeds = _decided(said.strip())
    if proof and not exceeds and not solver.proofToString(solver.getProof()[0]):
        raise GaveUp("no proof")
    return exceeds


def by_cvc5_with_proof(problem: Problem, bound: Fraction) -> bool:
    """cvc5, which writes its proof where nothing exceeds the bound."""
    return by_cvc5(problem, bound, True)


def by_qepcad(problem: Problem, bound: Fraction) -> bool:
    """QEPCAD B, a program each time, which is how it is used."""
    from benchmarks.peer_qepcad import qepcad
    from certificates.routes.questions import read_statement

    return _decided(
        {"holds": "unsat", "fails": "sat"}.get(
            qepcad(read_statement(problem.of_set(bound)), ENOUGH), ""
        )
    )


def by_coq_interval(problem: Problem, bound: Fraction) -> bool:
    """Coq's tactic interval proves that nothing on the box exceeds the bound; it refutes nothing.
    Its proof is checked by Coq's kernel.
    """
    from benchmarks.bench.coq_interval import goal, proves

    if not proves(goal(problem, bound), ENOUGH):
        raise GaveUp("no proof")
    return False


def z3_bisection(problem: Problem, width: Fraction) -> Answer:
    """Z3 by bisection."""
    return bisected(by_z3, problem, width)


def z3_once(problem: Problem, width: Fraction) -> Answer:
    """Z3, asked once."""
    return asked_once(by_z3, problem, width)


def cvc5_bisection(problem: Problem, width: Fraction) -> Answer:
    """cvc5 by bisection."""
    return bisected(by_cvc5, problem, width)


def cvc5_once(problem: Problem, width: Fraction) -> Answer:
    """cvc5, asked once."""
    return asked_once(by_cvc5, problem, width)


def cvc5_proof_once(problem: Problem, width: Fraction) -> Answer:
    """cvc5, asked once, with its proof."""
    return asked_once(by_cvc5_with_proof, problem, width)


def qepcad_bisection(problem: Problem, width: Fraction) -> Answer:
    """QEPCAD B by bisection."""
    return bisected(by_qepcad, problem, width)


def qepcad_once(problem: Problem, width: Fraction) -> Answer:
    """QEPCAD B, asked once."""
    return asked_once(by_qepcad, problem, width)


def coq_interval_once(problem: Problem, width: Fraction) -> Answer:
    """coq-interval, asked once."""
    return asked_once(by_coq_interval, problem, width)
