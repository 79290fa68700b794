"""Asking Z3: a vote on whether a condition can be met, and a model of it.  No answer of Z3 is
believed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from math import lcm
from weakref import WeakKeyDictionary

import z3
from flint import fmpq, fmpq_mpoly, fmpq_poly, fmpz_poly

from juggleproof.algebra import trees
from juggleproof.algebra.conditions import Condition
from juggleproof.algebra.numbers import AlgebraicNumber, exact
from juggleproof.search import limits
from juggleproof.search.candidates import Value
from juggleproof.statements.work import Budget


@dataclass
class SolverAnswer:
    """The answer "sat", "unsat" or "unknown", with a value of every variable that occurs where it
    is "sat".
    """

    verdict: str
    model: dict[str, Value] = field(default_factory=dict)


def ask(
    condition: Condition,
    budget: Budget,
    integers: Iterable[str] = (),
    resources: int = limits.Z3_WORK,
    model: bool = False,
    unreachable: tuple[Condition, Sequence[str]] | None = None,
) -> SolverAnswer:
    """Z3's answer within a fixed amount of its own work.

    `unreachable`, a condition with some of its variables, asks besides that no values of these meet
    it.
    """
    if condition.tree is False or condition.tree is True and unreachable is None:
        return SolverAnswer("sat" if condition.tree else "unsat")
    names = [name for name in condition.ring.names() if name in condition.variables()]
    whole = frozenset(integers) & set(names)
    session = session_of(budget)
    solver = (
        z3.Solver(ctx=session.context)
        if whole
        else z3.Tactic("nlqsat" if unreachable else "qfnra-nlsat", ctx=session.context).solver()
    )
    solver.set("rlimit", resources)
    rows = [f"(declare-const |{name}| {_sort(name, whole)})" for name in names]
    written = partial(_term, integers=whole)
    rows.append(f"(assert {formula_text(condition, written)})")
    if unreachable is not None:
        goal = unreachable[0]
        inner = goal.variables()
        bound = [f"(|{name}| {_sort(name, whole)})" for name in unreachable[1] if name in inner]
        rows += [
            f"(declare-const |{name}| {_sort(name, whole)})"
            for name in sorted(inner - set(names) - set(unreachable[1]))
        ]
        text = f"(not {formula_text(goal, written)})"
        rows.append(
            f"(assert (forall ({' '.join(bound)}) {text}))" if bound else f"(assert {text})"
        )
    solver.from_string("\n".join(rows))
    result = str(solver.check())
    budget.charge(5000 + min(session.work(solver, resources), resources))
    if result != "sat" or not model:
        return SolverAnswer(result if result in ("sat", "unsat") else "unknown")
    values = solver.model()
    found = {declared.name(): values[declared] for declared in values.decls()}
    return SolverAnswer(
        result, {name: _value(found[name]) if name in found else fmpq(0) for name in names}
    )


def conflict(
    atoms: Sequence[tuple[fmpq_mpoly, str]], budget: Budget, resources: int
) -> list[int] | None:
    """The numbers of some of these relations to 0 that Z3 thinks contradict one another for real
    variables: all of them where it does not know; None where it thinks that they have a point.
    """
    session = session_of(budget)
    names = sorted({name for poly, _ in atoms for name in poly.context().names()})
    rows = [f"(declare-const |{name}| Real)" for name in names]
    rows += [f"(assert {_atom(_term(poly, frozenset()), relation)})" for poly, relation in atoms]
    solver = z3.Tactic("qfnra-nlsat", ctx=session.context).solver()
    solver.set("rlimit", resources)
    solver.set("unsat_core", True)
    for k, formula in enumerate(z3.parse_smt2_string("\n".join(rows), ctx=session.context)):
        solver.assert_and_track(formula, z3.Bool(f"atom{k}", session.context))
    result = str(solver.check())
    budget.charge(500 + min(session.work(solver, resources), resources) // 10)
    if result == "unsat":
        return sorted(int(str(one).removeprefix("atom")) for one in solver.unsat_core())
    return None if result == "sat" else list(range(len(atoms)))


class SolverSession:
    """A context of Z3 that the questions of one search share, since it takes longer to make one
    than to answer most of them.
    """

    def __init__(self) -> None:
        self.context, self.before = (
            z3.Context(),
            0,
        )  # the context's counter goes on from question to question

    def work(self, solver: z3.Solver, resources: int) -> int:
        """What Z3 has spent since it was asked for the last time."""
        statistics = solver.statistics()
        total = next(
            (int(statistics.get_key_value(k)) for k in statistics.keys() if k == "rlimit count"),
            None,
        )
        if total is None:
            return resources // 10
        spent, self.before = total - self.before, total
        return max(0, spent)


_sessions: WeakKeyDictionary[Budget, SolverSession] = WeakKeyDictionary()


def session_of(budget: Budget) -> SolverSession:
    """The session of the whole search that a budget belongs to."""
    whole = budget
    while whole.whole is not None:
        whole = whole.whole
    if whole not in _sessions:
        _sessions[whole] = SolverSession()
    return _sessions[whole]


def _sort(name: str, integers: frozenset[str]) -> str:
    return "Int" if name in integers else "Real"


def formula_text(condition: Condition, term: Callable[[fmpq_mpoly], str]) -> str:
    """A condition as an s-expression, its polynomials written by `term`."""
    return trees.written(condition.tree, lambda one: _atom(term(condition.polys[one[0]]), one[1]))


def _atom(term: str, relation: str) -> str:
    """A relation of a term to 0 as an s-expression."""
    text = f"({'=' if relation == '!=' else relation} {term} 0.0)"
    return f"(not {text})" if relation == "!=" else text


def _term(poly: fmpq_mpoly, integers: frozenset[str]) -> str:
    """A polynomial times its denominator; a relation to 0 is the same for it."""
    names = [
        f"(to_real |{name}|)" if name in integers else f"|{name}|"
        for name in poly.context().names()
    ]
    scale = lcm(1, *(int(c.q) for c in poly.coeffs()))
    total = []
    for powers, c in zip(poly.monoms(), poly.coeffs()):
        number = int(c * scale)
        factors = [
            f"{number}.0" if number >= 0 else f"(- {-number}.0)",
            *(name for name, e in zip(names, powers) for _ in range(e)),
        ]
        total.append(f"(* {' '.join(factors)})" if len(factors) > 1 else factors[0])
    return f"(+ {' '.join(total)})" if len(total) > 1 else total[0] if total else "0.0"


def _value(value: z3.ExprRef) -> Value:
    if z3.is_algebraic_value(value):
        coefficients = [int(str(c)) for c in value.poly()]
        # Z3's polynomial need not be irreducible: the factor that changes its sign on the enclosure
        # is the one of the root.
        for precision in (10, 40, 160):
            decimal = value.approx(precision)
            middle = Fraction(decimal.numerator_as_long(), decimal.denominator_as_long())
            radius = Fraction(2, 10**precision)
            low, high = exact(middle - radius), exact(middle + radius)
            hits = [
                f
                for f, _ in fmpz_poly(coefficients).factor()[1]
                if fmpq_poly(f)(low) * fmpq_poly(f)(high) < 0
            ]
            if len(hits) == 1:
                factor = hits[0] if hits[0].leading_coefficient() > 0 else -hits[0]
                return AlgebraicNumber(factor, low, high)
        raise ValueError("an algebraic value without an isolating interval")
    if z3.is_int_value(value):
        return fmpq(value.as_long())
    return fmpq(value.numerator_as_long(), value.denominator_as_long())
