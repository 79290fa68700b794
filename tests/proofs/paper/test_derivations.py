"""The derivations that a claim lists are the derived expressions that its statements contain."""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from pathlib import Path

from juggleproof.certificates.language import origins_in, reals, substitute
from juggleproof.proofs.paper import paper_claims
from juggleproof.proofs.paper.derivations import Origin, derivations_of, derived, derived_vector

ROOT = Path(__file__).resolve().parents[3]


def listed() -> dict[str, list[str]]:
    return {
        claim.id: sorted(one.function for one in derivations_of(claim.body()))
        for claim in paper_claims()
    }


def test_listed_derivations_are_the_ones_that_statements_contain_holds() -> None:
    """For every claim; what a statement contains is found by marks, in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-m", "tests.proofs.paper.marked_derivations"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    contained, found = json.loads(done.stdout), listed()
    assert sum(map(bool, found.values())) > 200
    assert found == contained


def test_the_energy_gain_lists_what_it_states_holds() -> None:
    (claim,) = (claim for claim in paper_claims() if claim.id == "eq-37")
    names = [one.function for one in derivations_of(claim.body())]
    assert names == ["total_energy", "f1", "largest_energy_change"]


def test_an_origin_stays_with_its_term_holds() -> None:
    """Through substitution and pickling, and without making terms differ."""
    v, y = reals("v y")
    energy, made = derived("total_energy"), Origin("total_energy")
    moved = substitute(energy, {"v": v + y, "beta": y}) + 1
    assert list(origins_in(moved)) == [made]
    assert list(origins_in(pickle.loads(pickle.dumps(moved)))) == [made]
    assert list(origins_in([derived_vector("launch_state").component(2) > v])) == [
        Origin("launch_state")
    ]
    plain = v**2 / 2 + 0
    assert plain.made_by(made) == plain and hash(plain.made_by(made)) == hash(plain)
    assert list(origins_in(plain)) == []
