"""Proofs from facts that are named, if need be by cases of a sign."""

from __future__ import annotations

import pytest

from juggleproof.certificates import checker
from juggleproof.map_stability.premise_searches import proof_from_few_facts, proof_without_next
from juggleproof.statements.states import proves

BELOW = """statement m/below
forall x_point x_gap other distance
given x_point > 0
given other > 0
given distance >= 0
given -distance <= x_gap and x_gap <= distance
given distance <= x_point/2
given x_point + x_gap > 0
show -x_gap/(x_point + x_gap) <= {}*distance/x_point
"""
USED = ("x_point", "x_gap + x_point")


def statement(constant: str) -> checker.Statement:
    return checker.read_statements(BELOW.format(constant))["m/below"]


@pytest.mark.parametrize("signs", [[], ["2*x_gap + x_point"]])
def test_a_distance_over_a_bound_is_small_close_to_the_point_holds(signs: list[str]) -> None:
    premise = statement("2")
    proof = proof_from_few_facts(premise, {}, USED, signs)
    assert proof is not None and proves(premise, proof, {})


@pytest.mark.parametrize("signs", [[], ["2*x_gap + x_point"]])
def test_rejects_a_bound_that_is_too_small(signs: list[str]) -> None:
    assert proof_from_few_facts(statement("3/2"), {}, USED, signs) is None


def test_a_proof_fails_without_a_bound_on_the_distance() -> None:
    premise = checker.read_statements(
        BELOW.format("2").replace("given distance <= x_point/2\n", "")
    )["m/below"]
    assert proof_from_few_facts(premise, {}, USED, ["2*x_gap + x_point"]) is None


STAGE = """statement m/stage
forall e x
range e > 0 and 1 - e > 0
given x > 0
given 1 + x^4 > 0
given 3*e - 2*x > 0
let x_next = x*(e^4 + 1)/(1 + x^4)
given x_next > 0
show {}*e - 2*x_next > 0
"""


@pytest.mark.exhaust
def test_what_is_given_of_the_next_state_is_left_out_holds() -> None:
    premise = checker.read_statements(STAGE.format("3"))["m/stage"]
    proof = proof_without_next(premise, {})
    assert proof is not None and proves(premise, proof, {})


def test_rejects_a_stage_that_orbits_leave() -> None:
    premise = checker.read_statements(STAGE.format("2"))["m/stage"]
    assert proof_without_next(premise, {}) is None
