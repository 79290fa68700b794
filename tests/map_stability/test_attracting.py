"""Strategies try their candidates in order, and a candidate is certified whole or not at all."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from juggleproof.map_stability.attracting import Strategy
from juggleproof.map_stability.certifying import CandidateProof, either
from juggleproof.map_stability.functions.candidates import Setting
from juggleproof.map_stability.functions.norms import norm_candidates
from tests.map_stability.maps import at_point, map_of, of_its_map


@pytest.fixture(scope="module")
def halving() -> Setting:
    return at_point(map_of("state x\npiece x/2"))


def weaker(one: CandidateProof, rank: float) -> CandidateProof:
    """The candidate with a loss that is too large."""
    rows = tuple((key, "value" if key == "loss" else text) for key, text in one.rule.rows)
    return replace(one, rules=(replace(one.rule, rows=rows),), rank=rank)


def test_candidates_of_least_rank_are_tried_first_holds(halving: Setting) -> None:
    good = next(norm_candidates(halving))
    every = [weaker(good, 2.0), weaker(good, 1.0), replace(good, rank=3.0)]
    for best, settles in ((2, False), (3, True)):
        said: list[str] = []
        proof = of_its_map(halving)
        strategy = Strategy(lambda _: every, (1,), 10_000, best=best)
        assert strategy.settles(proof, halving, said.append) is settles
        assert len(said) == best and said[0].endswith("no proof of the premise falls-1-1 was found")


def test_rejects_a_candidate_one_of_whose_statements_fails(halving: Setting) -> None:
    good, proof = next(norm_candidates(halving)), of_its_map(halving)
    both = replace(good, rules=(good.rule, halving.attraction("attracts", "descends")))
    assert not proof.takes(both, (1,), 10_000, print) and len(proof.rules) == 1
    assert proof.fault and set(proof.known) == set(proof.certificates) == {"m/map"}
    assert proof.takes(good, (1,), 10_000, print) and proof.fault == ""


def test_the_first_search_that_finds_a_proof_ends_it_holds() -> None:
    asked: list[str] = []

    def search(name: str, found: Any) -> Any:
        def one(premise: object, known: object) -> Any:
            asked.append(name)
            return found

        return one

    both: Any = either(search("a", None), search("b", "proof"), search("c", "late"))
    assert both(None, {}) == "proof" and asked == ["a", "b"]


def test_a_strategy_for_affine_maps_has_no_candidates_for_others_holds() -> None:
    setting = at_point(map_of("state x\nspace x > 0\npiece (x + 2/x)/2"))
    asked: list[Setting] = []

    def candidates(one: Setting) -> list[CandidateProof]:
        asked.append(one)
        return []

    for affine in (True, False):
        strategy = Strategy(candidates, affine=affine)
        assert not strategy.settles(of_its_map(setting), setting, print)
        assert bool(asked) is not affine
