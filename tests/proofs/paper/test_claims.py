"""The claims, the ledger, the register, the store and the pages fit together."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from juggleproof.certificates import checker
from juggleproof.command import explain
from juggleproof.judging.claims import NOT_FORMALISED, VERDICTS
from juggleproof.judging.register import changes, load_register
from juggleproof.papers.ledger import check_claims, load_ledger
from juggleproof.papers.paper import opened
from juggleproof.reports import pages
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import DEFAULT, Store
from tests.rows import each_row

ROOT = Path(__file__).resolve().parents[3]


def test_ledger_names_the_claims_there_are_holds() -> None:
    check_claims(load_ledger(), {claim.id for claim in opened().claims()}, opened().unprinted)


def test_register_has_every_claim_holds() -> None:
    register = load_register()
    assert set(register) == {claim.id for claim in opened().claims()}
    assert {entry["verdict"] for entry in register.values()} <= set(VERDICTS)


def test_unknown_claims_await_a_theorem_or_have_no_statement_holds() -> None:
    store = Store(DEFAULT)
    stated = {name.split("/")[0] for name in store.texts}
    for claim, entry in load_register().items():
        detail = entry.get("detail", "")
        assert (
            entry["verdict"] != "unknown"
            or detail.startswith("awaits ")
            or (detail.startswith(NOT_FORMALISED) and claim not in stated)
        ), claim


def test_what_a_simulation_shows_has_figures_and_no_statement_holds() -> None:
    store = Store(DEFAULT)
    stated = {name.split("/")[0] for name in store.texts}
    simulated = {
        claim: entry["detail"]
        for claim, entry in load_register().items()
        if entry["verdict"] == "simulated"
    }
    assert simulated and not simulated.keys() & stated
    assert all(re.search(r"\d", figures) for figures in simulated.values())
    apart = {"table-1"}
    assert {
        name for name in simulated if simulated[name].startswith("does not agree with the print: ")
    } == apart
    agree = {name for name in simulated if simulated[name].startswith("agrees with the print: ")}
    assert agree == simulated.keys() - apart


@pytest.mark.exhaust
def test_bare_checker_settles_every_stored_statement_holds() -> None:
    """It names each that is rejected, and counts the others."""
    done = subprocess.run(
        [sys.executable, "-I", "-S", "certificates/checker"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    texts = Store(DEFAULT).texts
    read = checker.read_statements((DEFAULT / checker.STATEMENTS).read_text(encoding="utf-8"))
    assert texts and set(read) == set(texts)
    line = re.search(
        r"^(\d+) statements: (\d+) certified, (\d+) refuted, 0 unknown, 0 rejected$",
        done.stdout,
        re.MULTILINE,
    )
    assert line and int(line[1]) == int(line[2]) + int(line[3]) == len(texts)


@each_row("page", pages.PAGES)
def test_pages_show_the_register_holds(page: str) -> None:
    assert pages.regenerated(page) == (ROOT / page).read_text(encoding="utf-8"), (
        "run juggleproof certify --accept, which writes what is generated"
    )


@pytest.mark.parametrize("text", ["", "# Results\n", f"{pages.END}\n"])
def test_rejects_a_page_without_marks(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pages, "ROOT", tmp_path)
    (tmp_path / "README.md").write_text(text, encoding="utf-8")
    with pytest.raises(ClaimError, match="README.md: the marks .* put them back"):
        pages.regenerated("README.md")


def test_repeated_prints_name_an_earlier_claim_holds() -> None:
    seen: set[str] = set()
    for claim in opened().claims():
        assert not claim.repeats or claim.repeats in seen, (
            f"{claim.id} repeats {claim.repeats}, which is no earlier claim"
        )
        seen.add(claim.id)


def test_change_of_verdict_shows_before_and_after_holds() -> None:
    before, after = (
        {"a": {"verdict": "holds"}, "b": {"verdict": "gap"}},
        {"a": {"verdict": "false"}},
    )
    assert changes(before, after, partial=True) == ["a: verdict was holds, is false"]
    assert len(changes(before, after, partial=False)) == 2


def test_no_sentence_of_a_claim_names_a_verdict_holds() -> None:
    for claim in opened().claims():
        assert claim.says.endswith((".", "?", ")")), claim.id


def test_every_kind_of_claim_is_explained_holds(capsys: pytest.CaptureFixture[str]) -> None:
    for claim in [
        *opened().claims()[::60],
        *(c for c in opened().claims() if c.id in ("eq-10", "eq-37", "sA.3.2-sup3")),
    ]:
        assert explain.explain(claim.id) == 0
        told = capsys.readouterr().out
        assert claim.id in told and "verdict" in told and "Term(" not in told, claim.id


@pytest.mark.parametrize("number", ["37", "(37)", "eq 37"])
def test_a_claim_is_explained_by_the_papers_number_holds(
    number: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert explain.explain(number) == 0
    assert capsys.readouterr().out.startswith("eq-37   section A.2, equation (37)\n")


def test_rejects_a_claim_that_is_not_there_with_what_may_be_meant() -> None:
    with pytest.raises(ClaimError, match="sA.3.2-sup: no such claim; did you mean sA.3.2-sup1"):
        explain.explain("sA.3.2-sup")
    with pytest.raises(ClaimError, match="`juggleproof list` names them"):
        explain.explain("(370)")
