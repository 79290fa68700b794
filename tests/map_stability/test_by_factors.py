"""A term of a function of one variable falls by the signs of the factors of what contradicts it."""

from __future__ import annotations

import numpy as np
import pytest

from juggleproof.certificates import checker
from juggleproof.map_stability.maps import read_rows
from juggleproof.map_stability.search import search_stability
from juggleproof.search.decrease_proofs.by_factors import proof_by_factors
from juggleproof.statements.states import proves

TEXT = """statement newton/falls
forall e x_gap value
range e > 0
given e + x_gap > 0
given x_gap <= value
given -x_gap*e <= value*(e + x_gap)
given value >= 0
show {}"""
POINTS = {
    "e": np.array([1.0, 2.0, 1.0, 3.0]),
    "x_gap": np.array([0.5, 8.0, -0.5, -2.75]),
    "value": np.array([0.5, 8.0, 1.0, 33.0]),
}


def premise(shown: str) -> checker.Statement:
    return checker.read_statements(TEXT.format(shown))["newton/falls"]


@pytest.mark.parametrize(
    "shown", ["x_gap^2 <= value*(e + x_gap)", "x_gap^3 <= value^2*(e + x_gap)"]
)
def test_what_is_a_product_once_the_bound_is_put_in_holds(shown: str) -> None:
    proof = proof_by_factors(premise(shown), {}, (), "x_gap", POINTS)
    assert proof is not None and proves(premise(shown), proof, {})


def test_what_has_no_sign_but_by_a_square_holds() -> None:
    """x^2 - x e + e^2 > 0 is no sum of products of x and e."""
    statement = premise("x_gap^2*e <= value*(x_gap^2 + e^2)")
    proof = proof_by_factors(statement, {}, (), "x_gap", POINTS)
    assert proof is not None and proves(statement, proof, {})


def test_a_premise_with_a_root_holds() -> None:
    text = TEXT.format("x_gap^2 <= value*(e + x_gap)")
    text = text.replace("range e > 0", "range e > 0\nroot r = sqrt(e + 1)")
    statement = checker.read_statements(text)["newton/falls"]
    points = POINTS | {"r": np.sqrt(POINTS["e"] + 1)}
    proof = proof_by_factors(statement, {}, ("r",), "x_gap", points)
    assert proof is not None and proves(statement, proof, {})


def test_rejects_a_fall_that_is_too_large() -> None:
    shown = "3*x_gap^2 <= value*(e + x_gap)"
    assert proof_by_factors(premise(shown), {}, (), "x_gap", POINTS) is None


@pytest.mark.exhaust
def test_a_factor_that_squares_alone_tell_the_sign_of_holds() -> None:
    """M. C. Mackey, L. Glass, "Oscillation and chaos in physiological control systems", Science
    197, 1977, without delay: (2 - 5 d/4)(1 + x^2) > d e (x + e), as d e (1 + e^2) < 1.
    """
    rows = [("over", "d p"), ("domain", "0 < d and d < 1 and 0 < p and p < 1"), ("state", "x")]
    rows += [("space", "x >= 0"), ("piece", "(1 - d)*x + p/(1 + x^2)")]
    found = search_stability(read_rows("mackey-glass", rows))
    assert found.finding.sentence.startswith("e is stable and attracts every state; here p = ")
