"""The derivations that a claim lists are the derived expressions that its statements contain, and
each derivation names those that it calls.
"""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import pytest

from juggleproof.judging.judgement import Correction, statements_of
from juggleproof.judging.run import findings_in
from juggleproof.papers.derivations import (
    Origin,
    derivations_of,
    derived,
    derived_vector,
)
from juggleproof.papers.paper import opened
from juggleproof.proofs.deriving import made_from
from juggleproof.statements.language import origins_in, reals, substitute
from juggleproof.statements.store import DEFAULT, Store
from tests.proofs.paper.called_derivations import called_derivations

ROOT = Path(__file__).resolve().parents[3]


def corrections() -> dict[str, Correction]:
    """The corrections that are stored, by claim."""
    found = findings_in(DEFAULT)
    return {name: one["correction"] for name, one in found.items() if "correction" in one}


def marked() -> dict[str, list[str]]:
    """What is found by marks, in a process that loads the claims with them."""
    done = subprocess.run(
        [sys.executable, "-m", "tests.proofs.paper.marked_derivations"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    found: dict[str, list[str]] = json.loads(done.stdout)
    return found


@pytest.mark.exhaust  # all is derived anew, twice
def test_listed_derivations_are_the_ones_that_statements_contain_holds() -> None:
    """For every claim; what a statement contains is found by marks, in a process of its own."""
    mended = corrections()
    listed = {
        claim.id: sorted(
            one.function for one in derivations_of(statements_of(claim, mended.get(claim.id)))
        )
        for claim in opened().claims()
    }
    assert sum(map(bool, listed.values())) > 200
    assert listed == marked()


def test_derivations_are_of_the_statements_that_were_judged_holds() -> None:
    """Of every claim all stored statements, but those of sharp ranges, which are found."""
    mended, stored = corrections(), dict[str, set[str]]()
    assert len(mended) > 20
    for name, text in Store(DEFAULT).texts.items():
        _, _, lines = text.partition("\n")
        if not lines.startswith("sharp "):
            stored.setdefault(name.split("/")[0], set()).add(lines)
    for claim in opened().claims():
        own = statements_of(claim, mended.get(claim.id))
        assert {one.text().partition("\n")[2] for one in own} == stored.get(claim.id, set())


@pytest.mark.exhaust
def test_a_derivation_names_the_ones_that_it_calls_holds() -> None:
    """For every derivation behind a claim; what is called is noted in a process of its own."""
    with ProcessPoolExecutor(1, mp_context=get_context("fork")) as pool:
        called = pool.submit(called_derivations).result()
    assert len(called) > 70 and sum(map(len, called.values())) > 100
    assert {name: sorted(made_from(name)) for name in called} == called


def test_corrections_and_remarks_are_derived_too_holds() -> None:
    """The correction of s3.3-e1-closed has the time epsilon_1, and not xi_1; the remark of eq-30
    speaks of the kinetic energy.
    """
    claims = {claim.id: claim for claim in opened().claims()}
    closed, remarked = claims["s3.3-e1-closed"], claims["eq-30"]
    mended = derivations_of(statements_of(closed, corrections()[closed.id]))
    before = {one.function for one in derivations_of(statements_of(closed))}
    after = {one.function for one in mended}
    assert after - before == {"epsilon_1"}
    assert "relative_kinetic_energy" in {
        one.function for one in derivations_of(statements_of(remarked))
    }


def test_the_energy_gain_lists_what_it_states_holds() -> None:
    (claim,) = (claim for claim in opened().claims() if claim.id == "eq-37")
    names = [one.function for one in derivations_of(statements_of(claim))]
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
