"""A run of claims by the library: what it writes does not depend on who does the work, and a store
that it changes is checked again.
"""

from __future__ import annotations

import shutil
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.language import ClaimError
from juggleproof.certificates.store import DEFAULT
from juggleproof.proofs.claims import Claim
from juggleproof.proofs.judging import Judgement
from juggleproof.proofs.paper import paper_claims
from juggleproof.proofs.run import Options, run

# Readings, misprints corrected in each way, a recurrence, a gap, what follows from a theorem.
CHOSEN = ("s2.2.1-B1", "eq-2", "eq-11", "s3.5.1-composite", "sA.3.2-sup3", "sB.1-so-that", "eq-26")


@pytest.fixture
def options(tmp_path: Path) -> Options:
    """A copy of the store."""
    shutil.copytree(DEFAULT, tmp_path / "store")
    return Options(tmp_path / "store", jobs=1, only=CHOSEN)


def content(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_a_run_does_not_depend_on_who_works_and_keeps_the_store_holds(options: Options) -> None:
    before, heard = content(options.store), list[str]()

    def hear(claim: Claim, judgement: Judgement) -> None:
        assert claim.id == judgement.id
        heard.append(claim.id)

    alone = run(paper_claims(), options, hear)
    assert [one.id for one in alone.judgements] == heard and set(heard) == set(CHOSEN)
    assert alone.rejected == [] and alone.outcomes["eq-2/main"] == "refuted"
    assert content(options.store) == before
    assert run(paper_claims(), replace(options, jobs=2)).judgements == alone.judgements
    with ThreadPoolExecutor(1) as pool:
        assert run(paper_claims(), options, executor=pool).judgements == alone.judgements
    assert content(options.store) == before


def test_a_store_that_a_run_changes_is_checked_again_holds(
    options: Options, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen, check = list[int](), checker.check_folder

    def counted(where: str) -> Any:
        results = check(where)
        seen.append(sum(outcome == "rejected" for _, outcome, _ in results))
        return results

    monkeypatch.setattr(checker, "check_folder", counted)
    options = replace(options, routes=("exact",), only=("s2.2.1-B1",))
    run(paper_claims(), options)
    assert seen == [0]
    (options.store / "s2.2.1-B1.json").write_text("{}\n", encoding="utf-8")
    assert run(paper_claims(), options).rejected == []
    assert seen[1] > 0 and seen[2:] == [0]


@pytest.mark.parametrize("routes", [(), ("z3",), ("exact", "magic")])
def test_rejects_routes_without_the_exact_one_or_unknown(routes: tuple[str, ...]) -> None:
    with pytest.raises(ClaimError, match="choose from exact, z3, boxes"):
        Options(Path("store"), routes)


def test_rejects_a_claim_that_is_not_there(options: Options) -> None:
    with pytest.raises(ClaimError, match="--only 38000: no such claim"):
        run(paper_claims(), replace(options, only=("38000",)))


def test_a_claim_is_named_by_the_papers_number_holds(options: Options) -> None:
    done = run(paper_claims(), replace(options, routes=("exact",), only=("(2)", "eq 11")))
    assert [one.id for one in done.claims] == ["eq-2", "eq-11"]
