"""One leaf: products of bounds along the monomials of the last fact, by a linear program.

A term such as a*u*x is bounded by products of one bound for each of its variables.  Taken for each
monomial by itself these are few, however many variables there are in all.

Source: Sherali and Adams, A hierarchy of relaxations between the continuous and convex hull
representations for zero-one programming problems, SIAM Journal on Discrete Mathematics 3 (1990).
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from math import prod

import numpy as np

from juggleproof.algebra.polynomials import Packing, total_degree
from juggleproof.search import limits
from juggleproof.search.psatz.facts import Factors
from juggleproof.search.psatz.lifting import lift, powers_of
from juggleproof.search.psatz.linear_program import Program, solve
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.statements.nodes import Node
from juggleproof.statements.work import Budget


def search_by_monomials(problem: LeafProblem, budget: Budget) -> Node | None:
    """The node of such a contradiction; None where there is none, or where there are many products.

    Raises Exhausted where the budget ends.
    """
    if not problem.facts or total_degree(problem.facts[-1].poly) < limits.MONOMIALS_DEGREE:
        return None
    found = [*dict.fromkeys(products_along(problem))]
    if not 0 < len(found) <= limits.MONOMIALS_PRODUCTS:
        return None
    program, packing = Program(), Packing(problem.ring, problem.polys())
    for factors in found:
        facts = [problem.facts[k] for k, e in factors for _ in range(e)]
        keys, values = packing.row(prod((fact.poly for fact in facts), start=problem.ring.one))
        strict = np.array([all(fact.strict for fact in facts)])
        program.add(0 * keys, keys, values, strict, np.array([1 + len(facts) + len(keys) / 4]))
    for equation in problem.reduction.left:
        program.add_free(1, *packing.row(equation.poly))
    budget.spend(3 * program.columns)
    solution = solve(program, budget)
    if solution is None:
        return None
    used = [((found[k], -1), c) for k, c in solution[0].items()]
    once = (0,) * problem.ring.size
    return lift(problem, used, [((k, once), c) for k, c in solution[1].items()], [])


def products_along(problem: LeafProblem) -> Iterator[Factors]:
    """The last fact, then products of linear facts, one or none for each variable of one of its
    monomials; nothing more where they are many.
    """
    last = len(problem.facts) - 1
    yield ((last, 1),)
    linear = [k for k in range(last) if total_degree(problem.facts[k].poly) == 1]
    goal, count = problem.facts[last].poly, 0
    for monomial in goal.monoms():
        variables = [v for v, power in enumerate(monomial) for _ in range(int(power))]
        choices = [
            [(), *((k,) for k in linear if problem.facts[k].poly.degrees()[v])] for v in variables
        ]
        count += prod(map(len, choices))
        if count > limits.MONOMIALS_PRODUCTS:
            return
        for chosen in product(*choices):
            yield powers_of(tuple(k for one in chosen for k in one))
