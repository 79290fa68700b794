"""`juggleproof list` with its options, `errata`, and `export smt2`: one statement, one claim,
several, or the whole paper; a solver reads what is written in one go.
"""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.cells import cell_len
from rich.console import Console
from rich.text import Text

from juggleproof.command import show
from juggleproof.command.listing import list_claims
from juggleproof.command.show import export_smt2
from juggleproof.judging.register import load_register
from juggleproof.papers.paper import opened
from juggleproof.reports.contents import results_of
from juggleproof.reports.results import where_the_proof_breaks
from juggleproof.reports.tables import draw, folded
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import Store
from tests.command import running
from tests.judging.stores import part_of_store
from tests.reports.runs import contents
from tests.rows import each_row


def heads(text: str) -> list[str]:
    return [
        line.split()[2].rstrip(":") for line in text.splitlines() if line.startswith("; statement ")
    ]


def test_export_of_several_ids_is_one_script_holds(capsys: pytest.CaptureFixture[str]) -> None:
    cvc5 = pytest.importorskip("cvc5")
    assert export_smt2(["eq-3", "s4.3.1-DK-negative/sharp", "s2.2.2-group-law"], None) == 0
    text = capsys.readouterr().out
    assert {name.split("/")[0] for name in heads(text)} == {
        "eq-3",
        "s4.3.1-DK-negative",
        "s2.2.2-group-law",
    }
    solver = cvc5.Solver()
    parser = cvc5.InputParser(solver)
    parser.setStringInput(cvc5.InputLanguage.SMT_LIB_2_6, text, "all.smt2")
    answers = []
    while not (command := parser.nextCommand()).isNull():
        answers.append(command.invoke(solver, parser.getSymbolManager()).strip())
    found = [answer for answer in answers if answer]
    assert found == ["unsat"] * text.count("(check-sat)") and len(found) >= len(heads(text))


def test_export_without_ids_writes_every_statement_of_the_store_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a part of the paper's store, with every kind of statement."""
    kept = part_of_store(
        tmp_path / "store", lambda claim: claim.startswith(("theorem", "s2.2", "eq-2"))
    )
    monkeypatch.setattr(show, "DEFAULT", kept)
    out = tmp_path / "out"
    assert export_smt2([], out) == 0
    names = {name.replace("/", ".") + ".smt2" for name in Store(kept).texts}
    assert len(names) > 50 and {path.name for path in out.iterdir()} == names
    assert all(path.read_text(encoding="utf-8").count("(check-sat)") for path in out.iterdir())


def test_the_errata_are_printed_as_they_are_made_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    """How they are made is asked of the reports."""
    monkeypatch.setattr(show, "errata_text", lambda: "Misprints (1)\n\neq-2")
    assert running.run("errata") == (0, "Misprints (1)\n\neq-2\n", "")


def test_rejects_export_of_an_unknown_name() -> None:
    with pytest.raises(ClaimError, match="eq-999: no such claim; did you mean eq-9"):
        export_smt2(["eq-3", "eq-999"], None)


def test_rejects_export_of_a_file_to_other_than_coq() -> None:
    for form in ("smt2", "latex"):
        done = running.run("export", form, "mine.py")
        line = "juggleproof: mine.py: claims of your own are exported to coq only\n"
        assert (done.returncode, done.stdout, done.stderr) == (2, "", line)


def test_rejects_two_theorems_with_one_file(tmp_path: Path) -> None:
    (tmp_path / "two.py").write_text(
        "from juggleproof import MapRule, claim, stability\n"
        + "".join(
            f"\n\n@claim('{name}')\ndef {function}():\n    '''Every orbit tends to 0.'''\n"
            f"    return stability(MapRule('{name}', (('state', 'x'), ('piece', 'x/2'))))\n"
            for name, function in (("a-b", "one"), ("a.b", "other"))
        )
    )
    certified = running.run("certify", str(tmp_path / "two.py"), "--jobs", "1", "--routes", "exact")
    assert certified.returncode == 0
    done = running.run("export", "coq", str(tmp_path / "two.py"), "-o", str(tmp_path / "coq"))
    assert done.returncode == 2 and done.stderr.endswith("have this one name; rename one\n")


def test_claims_of_a_section_and_a_verdict_are_listed_holds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert list_claims("A", "gap", as_json=True) == 0
    listed = json.loads(capsys.readouterr().out)
    register = load_register()
    assert {one["id"] for one in listed} == {
        claim.id
        for claim in opened().claims()
        if claim.section.startswith("A") and register[claim.id]["verdict"] == "gap"
    }
    assert list_claims("A", "gap") == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == [one["id"] for one in listed]
    assert list_claims("A", "gap", long=True) == 0
    sentences = [line.strip() for line in capsys.readouterr().out.splitlines()[1::2]]
    assert sentences == [one["says"] for one in listed]


def test_a_claim_is_listed_in_a_line_of_80_columns_holds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert list_claims() == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(load_register()) and max(map(len, lines)) <= 80


@given(st.text("ab -\n", max_size=60), st.integers(12, 30))
def test_folding_breaks_no_word_and_loses_none_holds(text: str, width: int) -> None:
    shown = folded(text, width)
    assert shown.split() == text.split()
    whole = all(len(word) <= width // 2 for word in text.split())
    assert not whole or all(len(line) <= width for line in shown.splitlines())


def test_where_the_proof_breaks_is_said_in_lines_of_80_columns_holds() -> None:
    results = results_of(contents())
    head, *lines = where_the_proof_breaks(results)
    assert "explain ID" in head and max(map(len, [head, *lines])) <= 80
    broken = [(one.id, one.verdict) for one in results.claims if one.group == "proof"]
    assert [tuple(line.split()[:2]) for line in lines] == broken and len(broken) == 3


@each_row(
    ("section", "verdict", "reason"),
    [("9", "", "--section 9: no claim is of it"), ("", "wrong", "choose from holds, misprint")],
)
def test_rejects_a_section_or_verdict_that_is_none(section: str, verdict: str, reason: str) -> None:
    with pytest.raises(ClaimError, match=reason):
        list_claims(section, verdict)


def test_a_narrow_table_keeps_ids_whole_holds() -> None:
    out = io.StringIO()
    name = "part-sticking-in-restitution-energy"
    rows = [(name, "A.3.2, sentence 12 after (38)", "holds", "word " * 40)]
    draw(("id", "place", "verdict", "says"), rows, Console(file=out, width=80, force_terminal=True))
    assert name in out.getvalue() and "word" in out.getvalue()
    assert all(cell_len(Text.from_ansi(line).plain) <= 80 for line in out.getvalue().splitlines())
