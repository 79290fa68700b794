"""A report that was kept is written again only where the checkers say the same of the same store in
this run, and all that it is made of is the same.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from juggleproof.command import formats, report
from juggleproof.command.main import run
from juggleproof.judging import report_cache
from juggleproof.judging.checked import Checked
from juggleproof.judging.claims import CheckedApart
from juggleproof.papers.paper import opened
from juggleproof.sine.stored import stored_outcomes
from juggleproof.statements.store import CERTIFICATES, DEFAULT, Store
from tests.judging.stores import part_of_store

CLAIMS = ("eq-37", "s2.2.1-H")  # which holds, and has a statement that is refuted
SAYS = "juggleproof-badge.json"
Made = Callable[[], tuple[bytes, int]]


@pytest.fixture
def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A store of two claims, which the command reads; what it keeps has a folder of its own."""
    folder = part_of_store(tmp_path / "store", CLAIMS.__contains__)
    monkeypatch.setattr(report, "DEFAULT", folder)
    monkeypatch.setattr(report, "stored_outcomes", list)
    monkeypatch.setattr("os.cpu_count", lambda: 1)  # in this process
    monkeypatch.setenv(report_cache.VARIABLE, str(tmp_path / "kept"))
    return folder


@pytest.fixture
def made(store: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Made:
    """Makes a report of what the checker says of each statement, as a badge; what stands there, and
    how often the store has been judged.
    """
    judged = list[Checked]()

    def gather(checked: Checked) -> SimpleNamespace:
        judged.append(checked)
        texts = Store(store).texts
        shown = [SimpleNamespace(name=name, text=texts[name], outcome=o) for name, o, _ in checked]
        return SimpleNamespace(entries=[SimpleNamespace(statements=shown)])

    def badge(shown: SimpleNamespace, place: Path) -> tuple[dict[str, bytes], list[str]]:
        said = {one.name: one.outcome for entry in shown.entries for one in entry.statements}
        return {SAYS: json.dumps(said).encode()}, []

    def make() -> tuple[bytes, int]:
        (tmp_path / SAYS).unlink(missing_ok=True)
        assert run(["report", "--format", "badge", "-o", str(tmp_path)]) == 0
        return (tmp_path / SAYS).read_bytes(), len(judged)

    monkeypatch.setattr(formats, "gather", gather)
    monkeypatch.setitem(formats.FORMATS, "badge", badge)
    return make


def tampered(store: Path) -> None:
    """Empties every proof that is stored."""
    path = store / CERTIFICATES
    lines = [json.loads(line) for line in path.read_bytes().splitlines()]
    for line in lines:
        line[1] = {"certified": {}} if "certified" in line[1] else line[1]
    path.write_text("".join(json.dumps(line, separators=(",", ":")) + "\n" for line in lines))


def test_a_report_is_made_once_of_the_same_store_holds(
    made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    first, _ = made()
    assert set(json.loads(first).values()) == {"certified", "refuted"}
    assert made() == (first, 1)
    assert capsys.readouterr().out == 2 * f"{tmp_path / SAYS}\n"


def test_rejects_what_was_kept_of_another_store(made: Made, store: Path) -> None:
    """A certificate that is spoiled shows at once, and no longer where it is whole again."""
    whole = (store / CERTIFICATES).read_bytes()
    first, _ = made()
    tampered(store)
    second, judged = made()
    assert "rejected" in json.loads(second).values() and judged == 2
    (store / CERTIFICATES).write_bytes(whole)
    assert made() == (first, 2)


def spoil(patch: pytest.MonkeyPatch, store: Path) -> None:
    (one,) = (store.parent / "kept").glob("badge-*.json")
    one.write_bytes(one.read_bytes().replace(b'"data":"', b'"data":"AA', 1))


CHANGES: dict[str, Callable[[pytest.MonkeyPatch, Path], object]] = {
    "of the second checker": lambda patch, store: patch.setattr(
        report, "stored_outcomes", lambda: [("all", "rejected", "")]
    ),
    "of a file beside the certificates": lambda patch, store: (store / "findings").write_text("{}"),
    "of a library": lambda patch, store: patch.setattr(
        report_cache, "version_of", lambda tool: "another"
    ),
    "of the sources": lambda patch, store: patch.setattr(report_cache, "SOURCES", ("symbolic",)),
    "of the scene": lambda patch, store: report_cache.keep("part-" + 64 * "0", [{"run": "1"}]),
    "of what is kept": spoil,
    "of the folder": lambda patch, store: patch.setenv(report_cache.VARIABLE, "off"),
    "of matplotlib": lambda patch, store: patch.setattr(report, "find_spec", lambda name: None),
}


@pytest.mark.parametrize("change", CHANGES)
def test_rejects_what_was_kept_before_a_change(
    change: str, made: Made, store: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first, _ = made()
    CHANGES[change](monkeypatch, store)
    assert made() == (first, 2)


def test_the_key_reads_templates_and_data_holds() -> None:
    names = [path.name for _, path in report_cache.sources("*")]
    assert {"page.html.j2", "style.css", "register.json", "rows.tsv", "sweep.json"} <= {*names}
    assert not any(name.endswith(".pyc") for name in names)


def test_a_second_checker_is_asked_for_each_claim_that_one_settles_holds() -> None:
    apart = [
        body for body in (one.body() for one in opened().claims()) if isinstance(body, CheckedApart)
    ]
    assert [body.outcomes for body in apart] == [stored_outcomes]


def test_rejects_keeping_what_was_found_in_this_run() -> None:
    """A certificate that the store lacks is searched again by the next report."""
    texts = Store(DEFAULT).texts
    checked = [(name, "certified", "") for name in [*texts][:3]]
    shown = [SimpleNamespace(name=name, text=texts[name], outcome=o) for name, o, _ in checked]
    contents = SimpleNamespace(entries=[SimpleNamespace(statements=shown)])
    assert report.settles(checked, contents)
    assert not report.settles(checked[1:], contents)
    assert not report.settles([(checked[0][0], "rejected", ""), *checked[1:]], contents)
    shown[0].text += " "
    assert not report.settles(checked, contents)


@pytest.mark.parametrize("name", ["../outside", "/outside", "figures/../outside", ""])
def test_rejects_kept_files_that_lie_outside(
    name: str, store: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    report_cache.keep("badge-" + 64 * "0", [{"name": name, "data": ""}])
    assert report.kept_files("badge-" + 64 * "0") == {}
