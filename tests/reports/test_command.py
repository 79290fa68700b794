"""`juggleproof report --format html` writes the page, or says in one line why it cannot, and leaves
nothing half-written.
"""

from __future__ import annotations

from pathlib import Path
from typing import NoReturn

import pytest

from juggleproof.command import formats
from juggleproof.command.main import run
from juggleproof.judging import extras
from juggleproof.reports import page
from juggleproof.reports.contents import Contents
from juggleproof.statements.language import ClaimError
from tests.reports.runs import contents, drawn, made_of, some_contents


def fault(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert run(["report", *arguments]) == 2
    shown = capsys.readouterr()
    assert shown.out == "" and shown.err.startswith("juggleproof: ") and shown.err.count("\n") == 1
    return shown.err


@pytest.mark.exhaust
def test_page_is_written_and_its_path_printed_holds(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made_of(monkeypatch, contents)
    monkeypatch.setattr(formats, "pictures", lambda contents: drawn())
    assert run(["report", "--format", "html", "-o", str(tmp_path / "new" / "folder")]) == 0
    path = tmp_path / "new" / "folder" / "juggleproof.html"
    assert capsys.readouterr().out == f"{path}\n"
    assert [one.name for one in path.parent.iterdir()] == [
        path.name
    ] and path.read_bytes().startswith(b"<!DOCTYPE html>")


def test_several_formats_are_made_from_claims_judged_once_holds(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    judged = list[Contents]()

    def gathered() -> Contents:
        judged.append(contents())
        return judged[-1]

    made_of(monkeypatch, gathered)
    given = ["--format", "json", "--format", "badge", "--format", "markdown", "-o", str(tmp_path)]
    assert run(["report", *given]) == 0 and len(judged) == 1
    names = ["juggleproof.json", "juggleproof-badge.json", "juggleproof.md"]
    assert capsys.readouterr().out.splitlines() == [str(tmp_path / name) for name in names]
    assert "--format word: choose from" in fault(capsys, "--format", "json", "--format", "word")


def test_rejects_a_folder_that_cannot_be_made(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("as it was", encoding="utf-8")
    assert "not a folder" in fault(
        capsys, "--format", "html", "-o", str(tmp_path / "file" / "below")
    )
    assert (tmp_path / "file").read_text(encoding="utf-8") == "as it was"


def test_missing_library_is_named_and_nothing_written_holds(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def absent(name: str) -> NoReturn:
        raise ImportError(name)

    made_of(monkeypatch, contents)
    monkeypatch.setattr(formats, "pictures", lambda contents: ())
    monkeypatch.setattr(extras, "import_module", absent)
    assert "jinja2 is needed for this report" in fault(
        capsys, "--format", "html", "-o", str(tmp_path / "there")
    )
    assert not (tmp_path / "there").exists()


def test_figures_are_left_out_where_matplotlib_is_absent_holds(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made_of(monkeypatch, some_contents)
    monkeypatch.setattr(formats.importlib.util, "find_spec", lambda name: None)
    assert run(["report", "--format", "html", "-o", str(tmp_path)]) == 0
    assert "figures are left out" in capsys.readouterr().err
    page = (tmp_path / "juggleproof.html").read_text(encoding="utf-8")
    assert 'id="figures"' not in page and page.count("<figure") == page.count('id="figure-motion"')


def test_rejects_a_formula_that_cannot_be_shown() -> None:
    from dataclasses import replace

    first = contents().entries[0]
    broken = replace(first, claim=replace(first.claim, printed=r"\unheard{x}"))
    with pytest.raises(ClaimError, match="cannot be shown as MathML"):
        page.build(replace(contents(), entries=(broken,), rules=()))
