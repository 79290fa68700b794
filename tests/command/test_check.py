"""`juggleproof check`: a folder is believed for what its statements say, not for their names."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from juggleproof.certificates import checker
from juggleproof.command.check import check
from juggleproof.judging.claims import stated_texts
from juggleproof.papers.paper import opened
from juggleproof.proofs.theorem import DIGEST, THEOREM
from juggleproof.reports.tree import digest_of, with_all_below
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import CERTIFICATES, STATEMENTS, Store, certificate_lines
from tests.certificates.checker.maps import SUBTRACT, searched
from tests.judging.stores import part_of_store

ANOTHER = SUBTRACT.replace("demo/", "theorem-in-units/")


def write(folder: Path, text: str, certificates: dict[str, object]) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / STATEMENTS).write_text(text)
    (folder / CERTIFICATES).write_bytes(certificate_lines(certificates))
    return folder


@pytest.fixture
def stored(tmp_path: Path) -> Path:
    """What is stored of the theorem, and of all that it rests on."""
    return part_of_store(tmp_path / "store", THEOREM.split("/")[0].__eq__)


def test_the_stored_theorem_is_proved_holds(
    stored: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the folder that is taken where none is named; of the whole one the bare checker says in
    test_claims that every statement is settled.
    """
    monkeypatch.setattr("juggleproof.command.check.DEFAULT", stored)
    assert check(None) == 0
    assert "\ntheorem: proved by exact certificates: " in capsys.readouterr().out


def test_the_digest_is_of_what_the_sources_state_holds() -> None:
    """Where the theorem is stated anew on purpose, the digest changes with it."""
    (claim,) = (one for one in opened().claims() if one.id == THEOREM.split("/")[0])
    texts = stated_texts(claim)
    rules = checker.read_statements("\n\n".join(texts.values()))
    names = with_all_below(THEOREM, rules)
    assert len(names) == 6 and digest_of(texts[name] for name in names) == DIGEST


@pytest.mark.parametrize("text", [ANOTHER, f"statement {THEOREM}\nshow 0 < 1\n"])
def test_rejects_another_statement_of_the_theorems_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str
) -> None:
    proof = {"certified": ["proof", [], ["close"]], "point": [THEOREM, [], {}, ["close"]]}
    certificates = searched(text) if text == ANOTHER else {THEOREM: proof}
    assert check(write(tmp_path, text, certificates)) == 1
    shown = capsys.readouterr().out
    assert "0 unknown, 0 rejected\ntheorem: NOT proved; theorem-in-units/exactly, or what" in shown


def test_rejects_a_theorem_whose_line_is_set_in(
    stored: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Else the checker would see a theorem where the line on it sees none."""
    path = stored / STATEMENTS
    path.write_text(path.read_text().replace(f"statement {THEOREM}\n", f"  statement {THEOREM}\n"))
    with pytest.raises(ClaimError, match="the wrong shape:   statement theorem-in-units/exactly"):
        check(stored)
    with pytest.raises(ClaimError, match="the wrong shape"):
        Store(stored)
    assert not capsys.readouterr().out


@pytest.mark.parametrize("last", [f"\nstatement {THEOREM}", f"\n# a comment\nstatement {THEOREM}"])
def test_rejects_an_open_theorem_right_below_another_statement(
    stored: Path, capsys: pytest.CaptureFixture[str], last: str
) -> None:
    path = stored / STATEMENTS
    head, *tail = path.read_text().split(f"\n\nstatement {THEOREM}\n")
    assert len(tail) == 1
    path.write_text(head + last + "\n" + tail[0])
    assert check(stored) == 0
    assert "\ntheorem: proved" in capsys.readouterr().out
    lines = (stored / CERTIFICATES).read_text().splitlines(keepends=True)
    (stored / CERTIFICATES).write_text("".join(one for one in lines if THEOREM not in one[:40]))
    assert check(stored) == 1
    assert f"theorem: NOT proved; {THEOREM} is not certified" in capsys.readouterr().out


def test_rejects_a_theorem_without_a_statement_that_it_rests_on(
    stored: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = stored / STATEMENTS
    map_, *others = re.findall(r"statement theorem-in-units/\S+\n(?:[^\n]+\n)+", path.read_text())
    path.write_text(path.read_text().replace(map_, map_.replace("-units/map", "-units/chart")))
    assert others and check(stored) == 1
    assert "theorem: NOT proved; theorem-in-units/exactly, or what" in capsys.readouterr().out


def test_rejects_a_theorem_that_rests_on_itself(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = f"statement {THEOREM}\nattraction {THEOREM}\nescape {THEOREM}\n"
    assert check(write(tmp_path, text, {THEOREM: {"certified": {}}})) == 1
    assert "theorem: NOT proved" in capsys.readouterr().out


def test_rejects_a_store_whose_theorem_is_open(
    stored: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = stored / CERTIFICATES
    lines = [json.loads(line) for line in path.read_text().splitlines()]
    path.write_bytes(
        certificate_lines({n: {"unknown": ""} if n == THEOREM else c for n, c in lines})
    )
    assert check(stored) == 1
    assert f"theorem: NOT proved; {THEOREM} is not certified" in capsys.readouterr().out


def test_an_open_statement_is_told_by_the_exit_code_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = write(tmp_path, "statement a/b\nshow 0 < 1\n", {"a/b": {"unknown": "not tried"}})
    assert check(folder) == 1
    assert capsys.readouterr().out == (
        "1 statements: 0 certified, 0 refuted, 1 unknown, 0 rejected\n"
    )
