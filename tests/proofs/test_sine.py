"""The claim `sine`: its sentence is the stored one, and it stands on what the second checker says
of the store.
"""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

import pytest

from juggleproof.certificates import checker
from juggleproof.judging import limits
from juggleproof.judging.claims import CheckedApart, claims_in
from juggleproof.judging.judge import judge
from juggleproof.judging.judgement import Judgement, Resources
from juggleproof.proofs.sine import everywhere
from juggleproof.reports.results import results_of_run
from juggleproof.search.certificate import search_certificate
from juggleproof.sine import stored
from juggleproof.sine.stored import STATEMENT, STORE, stored_outcomes
from juggleproof.statements.store import DEFAULT, Store
from juggleproof.statements.work import Budget, read
from tests.command.running import run
from tests.judging.stores import part_of_store
from tests.rows import each_row

(CLAIM,) = claims_in([everywhere.__name__])
REGISTERED = {"sine": {"verdict": "holds", "detail": "by the second checker"}}


def judged() -> Judgement:
    return judge(CLAIM, Resources())


def settled(*found: tuple[str, str, str]) -> tuple[str, str]:
    """Verdict and detail where the other checker says this of two sentences."""
    body = CheckedApart(("one", "two"), "the other", lambda: found, "nothing")
    return body.verdict().word, body.verdict().detail


# (statement, what is changed in it, into what): each is false
FALSE = {
    "at-doubling": ("sine-stable/real", "and G < (", "and G <= ("),
    "before-birth": ("sine-stable/real", "G > 0 and G <", "G <"),
    "elastic": ("sine-stable/complex", "range alpha < 1", "range alpha <= 1"),
    "without-the-drive": ("sine-birth/none-below", "show Gamma >=", "show Gamma >"),
    "without-a-fall": ("sine-other/saddle", "given G > 0", "given G >= 0"),
    "plastic": ("sine-other/saddle", "show m >= 0", "show m > 0"),
    "without-order": ("sine-other/saddle", "given m <= k\n", ""),
    "product": ("sine-multipliers/product", " = alpha^2", " = alpha"),
    "upwards": ("sine-bounces/speed", "2*V = -1", "2*V = 1"),
    "at-once": ("sine-bounces/closing", "/(2*pi) > 0", "/(2*pi) > 1"),
}


@pytest.fixture
def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the second checker's store, which is read in its place."""
    copy = tmp_path / "sine"
    shutil.copytree(STORE, copy)
    monkeypatch.setattr(stored, "STORE", copy)
    return copy


def tamper(store: Path, name: str, old: str, new: str) -> None:
    text = (store / name).read_text()
    assert text.count(old) == 1
    (store / name).write_text(text.replace(old, new))


def test_the_claim_holds_by_the_second_checker() -> None:
    assert stored_outcomes() == [(STATEMENT, "certified", "")]
    assert (judged().verdict.word, judged().verdict.detail) == ("holds", "by the second checker")
    assert judged().outcomes == {}  # no statement of the first checker


def test_the_sentence_has_the_numbers_of_the_statement_holds() -> None:
    numbers = re.findall(r"\d+/\d+", STATEMENT)
    assert numbers == re.findall(r"\d+/\d+", CLAIM.says)
    alpha, gamma = (tuple(map(Fraction, numbers[i : i + 2])) for i in (0, 2))
    assert alpha[0] < Fraction(1, 20) < alpha[1] and gamma[0] < Fraction(31, 10) < gamma[1]


def test_sentences_of_another_checker_come_to_a_verdict_holds() -> None:
    both = [("one", "certified", ""), ("two", "certified", "")]
    assert settled(*both) == ("holds", "by the other")
    assert settled(both[0], ("two", "refuted", "")) == ("false", "refuted by the other: two")
    assert settled(*both, ("three", "unknown", "not asked"))[0] == "holds"


@each_row(
    ("found", "detail"),
    [
        ([("one", "certified", "")], "two: unknown: it is not stored"),
        ([("one", "certified", ""), ("two", "unknown", "a gap")], "two: unknown: a gap"),
        (
            [("one", "certified", ""), ("two", "certified", ""), ("line 3", "rejected", "no")],
            "line 3: rejected: no",
        ),
    ],
)
def test_sentences_of_another_checker_fail_without_a_certificate(
    found: Sequence[tuple[str, str, str]], detail: str
) -> None:
    assert settled(*found) == ("unknown", f"not certified by the other: {detail}")


@each_row("name", FALSE)
def test_claims_on_bounces_fail_without_a_hypothesis(name: str) -> None:
    statement, old, new = FALSE[name]
    text = Store(DEFAULT).texts[statement]
    assert text.count(old) == 1
    changed = read(text.replace(old, new), statement)
    found = search_certificate(changed, {}, Budget(limits.DEFAULT_BUDGET))
    assert checker.check_one(changed, found, {}, {})[0] == "refuted"


TAMPERED = [
    ("statements.txt", "49/1000", "48/1000", "it is not stored"),
    ("statements.txt", "51/1000", "49/1000", "it is not stored"),  # smaller, and certified
    ("certificates.jsonl", '"49/1000"', '"50/1000"', "unknown: "),
    ("certificates.jsonl", '"ranks": "eN', '"ranks": "eM', "rejected: "),
    ("certificates.jsonl", ", 15, 16,", ", 15, 17,", "rejected: "),
    ("statements.txt", "the period-one", "The period-one", "rejected: not a statement"),
]


@pytest.mark.parametrize(("name", "old", "new", "why"), TAMPERED)
def test_rejects_a_tampered_store(store: Path, name: str, old: str, new: str, why: str) -> None:
    tamper(store, name, old, new)
    judgement = judged()
    assert judgement.verdict.word == "unknown" and why in judgement.verdict.detail
    assert "\n" not in judgement.verdict.detail
    results = results_of_run([CLAIM], [judgement], REGISTERED, partial=True)
    assert results.exit == 1 and "verdict was holds, is unknown" in str(results.changes[0])


def test_rejects_a_store_that_is_gone(store: Path) -> None:
    shutil.rmtree(store)
    assert judged().verdict.word == "unknown"
    assert judged().verdict.detail.startswith("not certified by the second checker: sine: rejected")


def test_certify_and_check_tell_a_tampered_store_holds(
    store: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    own = part_of_store(tmp_path / "store", lambda claim: claim.startswith("sine-"))
    monkeypatch.setattr("juggleproof.command.check.DEFAULT", own)
    arguments = ("certify", "--only", "sine", "--jobs", "1", "--store", str(own), "--json")
    done = run(*arguments, str(tmp_path / "true.json"))
    assert done.returncode == 0 and f"sine: certified by the second checker: {STATEMENT}" in (
        done.stdout
    )
    (told,) = json.loads((tmp_path / "true.json").read_text())["claims"]
    assert (told["id"], told["verdict"], told["detail"]) == ("sine", *REGISTERED["sine"].values())
    assert run("check").returncode == 0
    tamper(store, "certificates.jsonl", '"ranks": "eN', '"ranks": "eM')
    for command in (("check",), (*arguments, str(tmp_path / "false.json"))):
        done = run(*command)
        assert done.returncode == 1 and not done.stderr
        assert re.search("^sine: NOT certified; .* line 1: rejected: ", done.stdout, re.MULTILINE)
        assert "Traceback" not in done.stdout
    (told,) = json.loads((tmp_path / "false.json").read_text())["claims"]
    assert told["verdict"] == "unknown"
