"""Points of many variables: some take one of few values each, so that the rest is linear, and Z3
decides clauses, values and the linear rest at once.

Source: Borralleras, Lucas, Oliveras, Rodriguez-Carbonell, Rubio, SAT modulo linear arithmetic for
solving polynomial constraints, Journal of Automated Reasoning 48 (2012).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from math import lcm

import z3
from flint import fmpq, fmpq_mpoly

from juggleproof.algebra.conditions import Condition, places
from juggleproof.search import limits
from juggleproof.search.candidates import trials
from juggleproof.search.hints.asking import formula_text, session_of
from juggleproof.statements.language import Roles
from juggleproof.statements.work import Budget


def point_by_few_values(
    condition: Condition, budget: Budget, roles: Roles
) -> dict[str, fmpq] | None:
    """A point that meets the condition, with values for the variables that occur; None where none
    was found.

    Variables that linear facts contradict get more values, until none is left that could help.
    """
    terms = sum(len(condition.polys[k]) for k in condition.used())
    size = terms * len(places(condition.ring))
    budget.spend(size)
    counts = dict.fromkeys(covering(condition), limits.FIRST_VALUES)
    while True:
        budget.spend(size)
        question = LinearQuestion(
            condition,
            {name: trials(condition, name, False, n, roles) for name, n in counts.items()},
        )
        found, guilty = question.asked(budget)
        more = [name for name in guilty if counts[name] < limits.MOST_VALUES]
        if found is not None or not more:
            return found
        for name in more:
            counts[name] *= 2


def covering(condition: Condition) -> list[str]:
    """Variables without which every term is linear, those of most products first.

    >>> from juggleproof.certificates import checker
    >>> context = checker.Context()
    >>> for name in "xyz":
    ...     context.declare(name)
    >>> formula = context.formula(checker.parse("x*y + y*z + z^2 = 1"))
    >>> covering(Condition.of(context, formula))
    ['z', 'x']
    """
    names = list(places(condition.ring))
    products = {
        powers
        for k in condition.used()
        for powers in condition.polys[k].monoms()
        if sum(powers) > 1
    }
    chosen: list[str] = []
    while products:
        counts = Counter(i for powers in sorted(products) for i, e in enumerate(powers) if e)
        squares = {i for powers in products for i, e in enumerate(powers) if e > 1}
        best = min(counts, key=lambda i: (i not in squares, -counts[i], i))
        chosen.append(names[best])
        without = {tuple(0 if i == best else e for i, e in enumerate(p)) for p in products}
        products = {powers for powers in without if sum(powers) > 1}
    return chosen


class LinearQuestion:
    """A condition for a solver of linear arithmetic: every product has a name, and where its first
    factor takes one of its values, it is that value times the product of the others.
    """

    def __init__(self, condition: Condition, values: Mapping[str, Sequence[fmpq]]) -> None:
        self.condition, self.values = condition, values
        self.names = list(places(condition.ring))
        self.order = {name: k for k, name in enumerate(values)}
        self.products: dict[tuple[str, ...], str] = {}
        self.used = [name for name in self.names if name in condition.variables()]
        self.rows: list[str] = [f"(declare-const |{name}| Real)" for name in self.used]
        for name, few in values.items():
            own = [self.selector(name, k) for k in range(len(few))]
            self.rows += [f"(declare-const {one} Bool)" for one in (*own, self.guard(name))]
            self.rows += [
                f"(assert (=> {one} (= |{name}| {number(value)})))" for one, value in zip(own, few)
            ]
            self.rows.append(f"(assert (=> {self.guard(name)} (or false {' '.join(own)})))")
        body = formula_text(condition, self.term)
        self.rows.append(f"(assert {body})")

    def guard(self, name: str) -> str:
        """The Boolean by which a variable is held to its values."""
        return f"held{self.order[name]}"

    def selector(self, name: str, k: int) -> str:
        """The Boolean by which a variable takes its k-th value."""
        return f"takes{self.order[name]}with{k}"

    def asked(self, budget: Budget) -> tuple[dict[str, fmpq] | None, list[str]]:
        """A point, or the variables whose values are to blame; neither where Z3 gives up."""
        session = session_of(budget)
        solver = z3.SolverFor("QF_LRA", ctx=session.context)
        solver.set("rlimit", limits.Z3_VALUES_WORK)
        solver.from_string("\n".join(self.rows))
        held = {self.guard(name): name for name in self.values}
        result = str(solver.check(*[z3.Bool(one, session.context) for one in held]))
        budget.charge(
            5000
            + len(self.rows)
            + session.work(solver, limits.Z3_VALUES_WORK) // limits.Z3_LINEAR_STEPS
        )
        if result == "unsat":
            return None, sorted(held[str(one)] for one in solver.unsat_core())
        if result != "sat":
            return None, []
        model = solver.model()
        values = {
            name: model.eval(z3.Real(name, session.context), model_completion=True)
            for name in self.used
        }
        return {
            name: fmpq(value.numerator_as_long(), value.denominator_as_long())
            for name, value in values.items()
        }, []

    def term(self, poly: fmpq_mpoly) -> str:
        """A positive multiple of a polynomial, linear in the names of products."""
        scale = lcm(1, *(int(c.q) for c in poly.coeffs()))
        parts = []
        for powers, c in zip(poly.monoms(), poly.coeffs()):
            factors = [name for name, e in zip(self.names, powers) for _ in range(e)]
            factors.sort(key=lambda name: self.order.get(name, len(self.order)))
            parts.append(
                f"(* {number(c * scale)} {self.product(tuple(factors))})"
                if factors
                else number(c * scale)
            )
        return f"(+ 0.0 {' '.join(parts)})"

    def product(self, factors: tuple[str, ...]) -> str:
        """The name of a product, whose first factors have few values."""
        first, *others = factors
        if not others:
            return f"|{first}|"
        if factors not in self.products:
            rest = self.product(tuple(others))
            name = self.products[factors] = f"product{len(self.products)}"
            self.rows.append(f"(declare-const {name} Real)")
            self.rows += [
                f"(assert (=> {self.selector(first, k)} (= {name} (* {number(value)} {rest}))))"
                for k, value in enumerate(self.values[first])
            ]
        return self.products[factors]


def number(value: fmpq) -> str:
    """A rational as an s-expression."""
    size = f"{abs(value.p)}.0" if value.q == 1 else f"(/ {abs(value.p)}.0 {value.q}.0)"
    return size if value >= 0 else f"(- {size})"
