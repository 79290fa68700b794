"""Every statement of `statements.txt` is proved, but for those whose names end in -false: they have
no proof.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import pytest

from juggleproof.certificates import checker
from juggleproof.search.certificate import search_certificate, search_proof
from juggleproof.search.closing import Hints, search_closing
from juggleproof.statements.nodes import Proof
from juggleproof.statements.states import proves, state_of
from juggleproof.statements.work import Budget, Exhausted
from tests.rows import each_row

STATEMENTS = checker.read_statements((Path(__file__).parent / "statements.txt").read_text())
BUDGET = 3_000_000


@cache
def proof_of(name: str) -> Proof | None:
    return search_proof(STATEMENTS[name], {}, Budget(BUDGET))


LONG = {"orbit/leslie-gower-contracts", "orbit/lozi-falls", "corner/strict-at-itself-false"}
LONG |= {"orbit/henon-contracts", "orbit/lozi-size", "orbit/quadratic-contracts", "stable/impact"}


def assert_proved_if_true(name: str) -> None:
    proof = proof_of(name)
    assert (proof is None) == name.endswith("-false")
    if proof is not None:
        assert proves(STATEMENTS[name], json.loads(json.dumps(proof)), {})


@each_row("name", [name for name in STATEMENTS if name not in LONG])
def test_true_statements_are_proved_and_false_ones_are_not(name: str) -> None:
    assert_proved_if_true(name)


@pytest.mark.exhaust
@pytest.mark.parametrize("name", sorted(LONG))
def test_what_takes_long_is_proved_if_it_is_true(name: str) -> None:
    assert_proved_if_true(name)


@each_row("name", ["rank/falls", "region/f-r-physical", "integers/floor"])
def test_the_same_certificate_comes_out_every_time(name: str) -> None:
    again = search_proof(STATEMENTS[name], {}, Budget(BUDGET))
    assert json.dumps(again) == json.dumps(proof_of(name))


def test_a_false_statement_is_refuted() -> None:
    certificate = search_certificate(STATEMENTS["region/p-false"], {}, Budget(BUDGET))
    assert list(certificate) == ["refuted"]
    outcome, reason = checker.check_one(STATEMENTS["region/p-false"], certificate, {}, {})
    assert (outcome, reason) == ("refuted", None)


def test_a_true_statement_is_certified_with_a_point() -> None:
    certificate = search_certificate(STATEMENTS["map/h-invariant"], {}, Budget(BUDGET))
    assert sorted(certificate) == ["certified", "point"]
    assert checker.check_one(STATEMENTS["map/h-invariant"], certificate, {}, {}) == (
        "certified",
        None,
    )


def test_too_small_a_budget_ends_as_unknown() -> None:
    with pytest.raises(Exhausted):
        search_proof(STATEMENTS["rank/falls"], {}, Budget(1000))
    assert search_certificate(STATEMENTS["rank/falls"], {}, Budget(1000)) == {
        "unknown": "the budget of counted work ran out"
    }


def test_a_hint_brings_in_an_earlier_statement() -> None:
    text = """
statement h/lemma
forall y
given y > 0
show y^9 + y^4 + 1 > y

statement h/uses
forall z
given z^2 + z > 2 and z > 0
show (z^2 + z - 2)^9 + (z^2 + z - 2)^4 + 3 > z^2 + z
"""
    known = checker.read_statements(text)
    unfolding = checker.Unfolding(known["h/uses"], checker.Context())
    state = state_of(unfolding).assume(unfolding.goal(False))
    hints = Hints((("h/lemma", {"y": "z^2 + z - 2"}),))
    node = search_closing(state, {"h/lemma": known["h/lemma"]}, Budget(BUDGET), 1, hints)
    assert node is not None and node[:3] == ("use", "h/lemma", {"y": "z^2 + z - 2"})
    assert state.is_closed_by(node, {"h/lemma": known["h/lemma"]})


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("digits", "budget"),
    # the last builds a semidefinite relaxation too
    [(160, 20_000), pytest.param(320, 300_000, marks=pytest.mark.exhaust)],
)
def test_coefficients_too_large_for_floats_end_as_unknown(digits: int, budget: int) -> None:
    large = 10**digits
    text = f"forall x y z\ngiven {large}*x + y > {3 * large + 1}*z^2\ngiven {large}*z > y^3 + x"
    text += f"\ngiven x*y*z > 1\nshow x > 0 and {large}*x*y^2 > 1 - {large}*z*x"
    (statement,) = checker.read_statements(f"statement a/large\n{text}").values()
    assert "certified" not in search_certificate(statement, {}, Budget(budget))
