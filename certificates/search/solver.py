"""Asking Z3: a vote on whether a condition can be met, and a model of it.  Nothing that Z3 says is believed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import lcm
from typing import Any

import z3
from flint import fmpq, fmpq_mpoly, fmpq_poly, fmpz_poly

from .algebraic import AlgebraicNumber, exact
from .budget import Budget
from .candidates import Value
from .condition import Condition, Tree

RESOURCES = 200_000  # Z3's own unit of work; about a tenth of a second where numbers are rational


@dataclass
class Answer:
    """"sat", "unsat" or "unknown", with a value of every variable that occurs where it is "sat"."""

    verdict: str
    model: dict[str, Value] = field(default_factory=dict)


def ask(condition: Condition, budget: Budget, integers: Iterable[str] = (), resources: int = RESOURCES, model: bool = False,
        unreachable: tuple[Condition, Sequence[str]] | None = None) -> Answer:
    """Z3's answer within a fixed amount of its own work, in a context of its own.

    `unreachable`, a condition with some of its variables, asks besides that no values of these meet it.
    """
    if condition.tree is False or condition.tree is True and unreachable is None:
        return Answer("sat" if condition.tree else "unsat")
    integers = set(integers) & condition.variables()
    context = z3.Context()
    tactic = "nlqsat" if unreachable else "qfnra-nlsat"
    solver = z3.Solver(ctx=context) if integers else z3.Tactic(tactic, ctx=context).solver()
    solver.set("rlimit", resources)
    writer = _Writer(condition, context, integers)
    solver.add(writer.formula(condition.tree))
    if unreachable is not None:
        inner = _Writer(unreachable[0], context, integers)
        bound = [inner.variables[name] for name in unreachable[1] if name in inner.variables]
        goal = z3.Not(inner.formula(unreachable[0].tree))
        solver.add(z3.ForAll(bound, goal) if bound else goal)
    result = str(solver.check())
    statistics = solver.statistics()
    work = next((int(statistics.get_key_value(k)) for k in statistics.keys() if k == "rlimit count"), resources // 10)
    budget.spend(5000 + min(work, resources))
    if result != "sat" or not model:
        return Answer(result if result in ("sat", "unsat") else "unknown")
    values = solver.model()
    return Answer(result, {name: _value(values.eval(variable, model_completion=True)) for name, variable in writer.variables.items()})


class _Writer:
    def __init__(self, condition: Condition, context: Any, integers: Iterable[str]) -> None:
        self.condition, self.context = condition, context
        self.variables = {
            name: z3.Int(name, ctx=context) if name in set(integers) else z3.Real(name, ctx=context)
            for name in condition.ring.names() if name in condition.variables()
        }
        self.terms = {k: self._term(condition.polys[k]) for k in condition.used()}

    def _term(self, poly: fmpq_mpoly) -> Any:
        scale = 1
        for c in poly.coeffs():
            scale = lcm(scale, int(c.q))
        total = []
        names = self.condition.ring.names()
        for powers, c in poly.to_dict().items():
            product = [z3.RealVal(int(c * scale), ctx=self.context)]
            for name, e in zip(names, powers):
                if e:
                    variable = self.variables[name]
                    product += [z3.ToReal(variable) if z3.is_int(variable) else variable] * e
            total.append(z3.Product(product) if len(product) > 1 else product[0])
        return z3.Sum(total) if len(total) > 1 else total[0]

    def formula(self, tree: Tree) -> Any:
        if isinstance(tree, bool):
            return z3.BoolVal(tree, ctx=self.context)
        if isinstance(tree[0], int):
            term = self.terms[tree[0]]
            return {">": lambda: term > 0, ">=": lambda: term >= 0, "=": lambda: term == 0, "!=": lambda: term != 0}[tree[1]]()
        parts = [self.formula(part) for part in tree[1]]
        return z3.And(*parts) if tree[0] == "and" else z3.Or(*parts)


def _value(value: Any) -> Value:
    if z3.is_algebraic_value(value):
        coefficients = [int(str(c)) for c in value.poly()]
        # Z3's polynomial need not be irreducible: the factor that changes its sign on the enclosure is the one of the root.
        for precision in (10, 40, 160):
            near = value.approx(precision)
            middle = Fraction(near.numerator_as_long(), near.denominator_as_long())
            radius = Fraction(2, 10**precision)
            low, high = exact(middle - radius), exact(middle + radius)
            hits = [f for f, _ in fmpz_poly(coefficients).factor()[1] if fmpq_poly(f)(low) * fmpq_poly(f)(high) < 0]
            if len(hits) == 1:
                factor = hits[0] if hits[0].leading_coefficient() > 0 else -hits[0]
                return AlgebraicNumber(factor, low, high)
        raise ValueError("an algebraic value without an isolating interval")
    if z3.is_int_value(value):
        return fmpq(value.as_long())
    return fmpq(value.numerator_as_long(), value.denominator_as_long())
