"""Quadratic forms with parameters in a box: a search certifies every statement of `forms.txt`, and
refutes those whose names end in -false; most are closed as forms alone.
"""

from __future__ import annotations

from fractions import Fraction
from math import prod
from pathlib import Path

import pytest
from flint import fmpq_poly

from juggleproof.algebra.polynomials import Ring, value_at
from juggleproof.certificates import checker
from juggleproof.search.certificate import search_certificate, search_proof
from juggleproof.search.psatz.forms import search_forms
from juggleproof.search.psatz.parameters import bounds, split_variables
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.statements.nodes import Node
from juggleproof.statements.states import SearchState, state_of
from juggleproof.statements.work import Budget, Exhausted
from tests.rows import each_row

STATEMENTS = checker.read_statements((Path(__file__).parent / "forms.txt").read_text())
BUDGET = 200_000
# characters of the node at most, of those that need nothing else
SIZES = {
    "forms/box": 1000,
    "forms/point-by-equations": 1500,
    "forms/other-piece": 3000,
    "forms/bound-on-one-side": 10_000,
    "forms/large-numbers": 10_000,
}


def negated(name: str, text: str = "") -> SearchState:
    """What a proof of the statement has to contradict."""
    statements = checker.read_statements(f"statement {name}\n{text}") if text else STATEMENTS
    unfolding = checker.Unfolding(statements[name], checker.Context())
    return state_of(unfolding).assume(unfolding.goal(False))


def node_of(name: str) -> Node | None:
    state = negated(name)
    return search_forms(state, Ring(tuple(state.context.index)), Budget(BUDGET))


@each_row("name", SIZES)
def test_forms_are_closed_alone_holds(name: str) -> None:
    node = node_of(name)
    assert node is not None and negated(name).is_closed_by(node, {})
    assert len(str(node)) < SIZES[name]


@each_row("name", STATEMENTS)
def test_true_forms_are_certified_and_false_ones_refuted_holds(name: str) -> None:
    found = search_certificate(STATEMENTS[name], {}, Budget(2 * 10**6))
    assert ("refuted" if name.endswith("-false") else "certified") in found


@each_row("name", ["forms/vertex-false", "forms/guard-false"])
def test_false_forms_stay_open_holds(name: str) -> None:
    assert node_of(name) is None


def test_the_products_of_bounds_are_a_basis_holds() -> None:
    for name in ("forms/bound-on-one-side", "forms/box"):
        state = negated(name)
        problem = LeafProblem(state, Ring(tuple(state.context.index)))
        (axis, *_) = bounds(problem).values()
        point = [Fraction(2, 7)] * problem.ring.size
        for exponent in range(4):
            total = sum(
                c
                * prod(
                    value_at(problem.facts[k].poly, point) ** e for k, e in axis.factors(place, 3)
                )
                for place, c in enumerate(
                    axis.coefficients(problem.facts, fmpq_poly([0] * exponent + [1]), 3)
                )
            )
            assert total == Fraction(2, 7) ** exponent


def test_a_box_has_a_width_holds() -> None:
    state = negated("t/t", "forall a g\nrange 0 <= a and a <= 0\nshow a*g <= g^2")
    problem = LeafProblem(state, Ring(tuple(state.context.index)))
    assert [(axis.low, axis.high) for axis in bounds(problem).values()] == [(0, None)]


def test_variables_without_bounds_are_no_parameters_holds() -> None:
    state = negated("forms/other-piece")
    problem = LeafProblem(state, Ring(tuple(state.context.index)), quotients=False)
    found = split_variables(problem, problem.facts[-1].poly, bounds(problem))
    assert found is not None
    names = [[problem.ring.names[v] for v in part] for part in found]
    assert names[0] == ["a", "b"] and set(names[1]) == {"p", "g", "h"}


def test_the_work_is_bounded_holds() -> None:
    state = negated("forms/other-piece")
    with pytest.raises(Exhausted):
        search_forms(state, Ring(tuple(state.context.index)), Budget(100))


def test_a_search_for_a_proof_uses_forms_holds() -> None:
    proof = search_proof(STATEMENTS["forms/box"], {}, Budget(10**6), effort=1)
    assert proof is not None and proof[0] == "proof"
