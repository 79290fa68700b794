"""`juggleproof export smt2`: one statement, one claim, several, or the whole paper; a solver reads
what is written in one go.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from juggleproof.certificates.language import ClaimError
from juggleproof.certificates.store import DEFAULT, Store
from juggleproof.proofs.command.show import export_smt2


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


def test_export_of_the_whole_paper_writes_every_statement_holds(tmp_path: Path) -> None:
    assert export_smt2([], tmp_path) == 0
    written = {path.name for path in tmp_path.iterdir()}
    assert written == {name.replace("/", ".") + ".smt2" for name in Store(DEFAULT).texts}
    assert all(path.read_text(encoding="utf-8").count("(check-sat)") for path in tmp_path.iterdir())


def test_rejects_export_of_an_unknown_name() -> None:
    with pytest.raises(ClaimError, match="eq-999: no such claim; did you mean eq-9"):
        export_smt2(["eq-3", "eq-999"], None)
