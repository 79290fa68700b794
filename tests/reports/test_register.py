"""A verdict that differs from the register fails, shown before and after; no register, and outputs
that cannot be written, are refused.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import NoReturn
from xml.etree import ElementTree

import pytest

from juggleproof.command import certify
from juggleproof.command.main import run
from juggleproof.judging.claims import Claim
from juggleproof.judging.register import PATH, Change, Register, load_register
from juggleproof.judging.run import Options, Progress, Run
from juggleproof.judging.run import run as run_of_claims
from tests.judging.stores import part_of_store
from tests.reports.runs import FALSE, HOLDS, file_with, paper_run

Certify = Callable[..., int]


def judged(claims: Sequence[Claim], options: Options, progress: Progress) -> Run:
    """The run of the whole paper is judged once: it does not depend on the register."""
    return run_of_claims(claims, options, progress) if options.only else paper_run()[0]


@pytest.fixture
def with_register(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[[str | Register], Certify]:
    """The command with another register, and a part of the store."""

    def prepare(content: str | Register) -> Certify:
        register = tmp_path / "register.json"
        register.write_text(
            content if isinstance(content, str) else json.dumps(content), encoding="utf-8"
        )
        monkeypatch.setattr(certify, "certify", partial(certify.certify, register=register))
        monkeypatch.setattr(certify, "run", judged)
        part_of_store(tmp_path / "store", ("eq-2", "eq-3").__contains__)
        return lambda *more: run(
            ["certify", "--jobs", "1", "--store", str(tmp_path / "store"), *more]
        )

    return prepare


def outputs(folder: Path) -> list[str]:
    return [f"--{option}={folder / f'out.{option}'}" for option in ("json", "junit", "markdown")]


def changed() -> tuple[dict[str, dict[str, str]], dict[str, tuple[str, str]]]:
    """A register that differs from the sources in three ways, and the verdicts before and after."""
    register = load_register()
    register["eq-2"] = {"verdict": "holds"}
    register["vanished"] = {"verdict": "gap", "detail": "step a is false"}
    del register["eq-1"]
    return register, {
        "eq-2": ("holds", "misprint"),
        "vanished": ("gap", "absent"),
        "eq-1": ("absent", "holds"),
    }


def test_changed_verdict_fails_and_is_shown_before_and_after_everywhere_holds(
    with_register: Callable[[str | Register], Certify],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    register, expected = changed()
    assert with_register(register)(*outputs(tmp_path)) == 1
    lines = [
        line
        for line in capsys.readouterr().out.splitlines()
        if line.startswith("differs from the register")
    ]
    assert len(lines) == len(expected)
    for name, (before, after) in expected.items():
        assert any(
            f"{name}: " in line and f"verdict was {before}, is {after}" in line for line in lines
        ), name
    data = json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))
    output = {
        one["claim"]: tuple(
            (one[side] or {"verdict": "absent"})["verdict"] for side in ("before", "after")
        )
        for one in data["changes"]
    }
    assert output == expected and data["exit"] == 1
    suite = ElementTree.parse(tmp_path / "out.junit").getroot()[0]
    failures = {
        case.get("name"): case.find("failure").get("message", "")
        for case in suite
        if case.find("failure") is not None
    }
    assert set(failures) == set(expected) and "eq-2/main fails at " in failures["eq-2"]
    assert all(
        f"verdict was {before}, is {after}" in failures[name]
        for name, (before, after) in expected.items()
    )
    summary = (tmp_path / "out.markdown").read_text(encoding="utf-8")
    assert (
        "since the register (3)" in summary and "| eq-2 | verdict | holds | misprint |" in summary
    )
    assert (
        "| vanished | verdict | gap | no longer in the sources |" in summary
        and "| eq-1 | verdict | not registered | holds |" in summary
    )


def test_reports_of_a_run_are_what_it_writes_holds(
    with_register: Callable[[str | Register], Certify], tmp_path: Path
) -> None:
    given = ["--report=json", "--report=badge", f"--output={tmp_path / 'reports'}"]
    times = [f"--timings={tmp_path / 'out.timings'}"]
    assert with_register(load_register())(*outputs(tmp_path), *given, *times) == 0
    made = {path.name: path for path in (tmp_path / "reports").iterdir()}
    assert set(made) == {"juggleproof.json", "juggleproof-badge.json"}
    assert made["juggleproof.json"].read_bytes() == (tmp_path / "out.json").read_bytes()
    suite = ElementTree.parse(tmp_path / "out.junit").getroot()[0]
    seconds = dict(line.split()[::-1] for line in (tmp_path / "out.timings").open())
    cases = [case for case in suite if case.get("line")]
    assert {case.attrib["name"]: case.attrib["time"] for case in cases} == seconds


def test_selection_leaves_other_claims_of_the_register_alone_holds(
    with_register: Callable[[str | Register], Certify],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    register, _ = changed()
    command = with_register(register)
    assert (
        command("--only", "eq-3", *outputs(tmp_path)) == 0
        and "differs" not in capsys.readouterr().out
    )
    assert json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))["partial"] is True
    assert (
        command("--only", "eq-2") == 1 and "eq-2: correction was absent" in capsys.readouterr().out
    )


def test_accepting_writes_this_register_and_shows_before_and_after_holds(
    with_register: Callable[[str | Register], Certify],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    committed = PATH.read_bytes()
    register, expected = changed()
    assert with_register(register)("--accept", *outputs(tmp_path)) == 0
    output = capsys.readouterr().out
    assert (
        all(f"verdict was {before}, is {after}" in output for before, after in expected.values())
        and "accepted  eq-1" in output
    )
    assert json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))["accepted"] is True
    assert (tmp_path / "register.json").read_bytes() == committed == PATH.read_bytes()


NO_REGISTERS = {
    "not JSON": ('{"eq-1": ', "not a register (JSONDecodeError)"),
    "a list": ("[]", "an object of entries by claim"),
    "not text": ("\udcff", "not a register (UnicodeDecodeError)"),
    "an unknown word": (
        '{"eq-1": {"verdict": "true"}}',
        'eq-1: "true" is no verdict; write one of holds, misprint, false, gap, ambiguous,'
        " simulated, unknown",
    ),
    "no verdict": ('{"eq-1": {"sharp": "nowhere"}}', "eq-1: no verdict; add"),
    "a verdict that is a list": ('{"eq-1": {"verdict": []}}', "eq-1: [] is no verdict"),
    "an entry that is no object": ('{"eq-1": "holds"}', "eq-1: not an object"),
    "an unknown field": ('{"eq-1": {"verdict": "holds", "note": "x"}}', "eq-1: 'note' is no field"),
    "a number": ('{"eq-1": {"verdict": "holds", "sharp": 1}}', "eq-1: sharp is 1; write a text"),
    "a claim twice": (
        '{"eq-1": {"verdict": "holds"}, "eq-1": {"verdict": "gap"}}',
        "eq-1 stands there twice",
    ),
    "a name of two lines": ('{"eq\\n1": 1}', "'eq\\n1': not an object"),
    "depths": ("[" * 100_000, "not a register (RecursionError)"),
}


@pytest.mark.parametrize("defect", sorted(NO_REGISTERS))
def test_rejects_register_with(
    defect: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    content, reason = NO_REGISTERS[defect]
    path = tmp_path / "register.json"
    path.write_bytes(content.encode("utf-8", "surrogateescape"))
    monkeypatch.setattr(certify, "certify", partial(certify.certify, register=path))
    monkeypatch.setattr(certify, "run", _no_run)
    assert run(["certify", "--accept", *outputs(tmp_path)]) == 2
    output = capsys.readouterr()
    assert (
        not output.out
        and len(output.err.splitlines()) == 1
        and f"{path}: " in output.err
        and reason in output.err
    ), output.err
    assert output.err.rstrip().endswith(
        ("restore it from the repository", "restore the file from the repository")
    )
    assert [one.name for one in tmp_path.iterdir()] == ["register.json"]


def _no_run(*_: object) -> NoReturn:
    raise AssertionError("nothing is judged before what was given is known to be right")


def test_absent_register_is_empty_holds(tmp_path: Path) -> None:
    assert load_register(tmp_path / "none.json") == {}


def test_change_names_every_field_holds() -> None:
    assert (
        str(
            Change("a", {"verdict": "holds", "sharp": "nowhere"}, {"verdict": "gap", "detail": "d"})
        )
        == "a: detail was absent, is d; sharp was nowhere, is absent; verdict was holds, is gap"
    )


def bad_path(kind: str, folder: Path) -> Path:
    if kind == "a file for a folder":
        (folder / "plain").write_text("", encoding="utf-8")
        return folder / "plain" / "out"
    if kind == "a pipe":
        os.mkfifo(folder / "pipe")
        return folder / "pipe"
    return {
        "a folder": folder,
        "the claims themselves": folder / "mine.py",
        "a name that is too long": folder / ("x" * 300),
    }[kind]


@pytest.mark.parametrize("option", ["json", "junit", "markdown", "timings"])
@pytest.mark.parametrize(
    "kind",
    [
        "a folder",
        "a file for a folder",
        "a pipe",
        "the claims themselves",
        "a name that is too long",
    ],
)
def test_rejects_output_before_the_run(
    kind: str,
    option: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(certify, "run", _no_run)
    claims = file_with(tmp_path, HOLDS)
    content, path = claims.read_bytes(), bad_path(kind, tmp_path)
    before = sorted(tmp_path.iterdir())
    assert run(["certify", str(claims), f"--{option}={path}"]) == 2
    output = capsys.readouterr()
    assert (
        not output.out
        and len(output.err.splitlines()) == 1
        and f"--{option} {path}: " in output.err
        and output.err.endswith("name another file\n")
    )
    assert sorted(tmp_path.iterdir()) == before and claims.read_bytes() == content


def test_rejects_one_file_for_two_outputs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(certify, "run", _no_run)
    (tmp_path / "b").mkdir()
    assert (
        run(["certify", f"--json={tmp_path / 'a'}", f"--markdown={tmp_path / 'b' / '..' / 'a'}"])
        == 2
    )
    assert "would overwrite what --json writes" in capsys.readouterr().err
    assert [one.name for one in tmp_path.iterdir()] == ["b"]


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser can write everywhere")
def test_rejects_output_in_a_closed_folder(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "closed").mkdir(mode=0o500)
    assert (
        run(
            ["certify", str(file_with(tmp_path, HOLDS)), f"--json={tmp_path / 'closed' / 'a.json'}"]
        )
        == 2
    )
    assert (
        "cannot be written (Permission denied)" in capsys.readouterr().err
        and not (tmp_path / "mine.certificates").exists()
    )


def test_outputs_of_a_run_of_ones_own_file_are_written_again_the_same_holds(tmp_path: Path) -> None:
    claims, folder = file_with(tmp_path, FALSE), tmp_path / "new"
    folder.mkdir()
    contents = []
    for _ in range(3):
        assert run(["certify", "--jobs", "1", str(claims), *outputs(folder)]) == 1
        contents.append({path.name: path.read_bytes() for path in folder.iterdir()})
    assert contents[0] == contents[1] == contents[2]
    assert set(contents[0]) == {
        "out.json",
        "out.junit",
        "out.markdown",
    }


def test_rejected_certificate_of_another_claim_is_in_every_output_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    claims = file_with(tmp_path, ("squares", "open"))
    run(["certify", "--jobs", "1", str(claims)])
    stored = tmp_path / "mine.certificates" / "certificates.jsonl"
    stored.write_bytes(stored.read_bytes().replace(b'"psatz"', b'"magic"'))
    assert run(["certify", "--jobs", "1", str(claims), "--only", "open", *outputs(tmp_path)]) == 1
    assert "rejected by the checker: squares/main" in capsys.readouterr().out
    assert (
        json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))["rejected"][0]["statement"]
        == "squares/main"
    )
    suite = ElementTree.parse(tmp_path / "out.junit").getroot()[0]
    assert suite.get("errors") == "2" and [
        case.get("name") for case in suite if case.find("error") is not None
    ] == ["open", "squares/main"]
    assert "Rejected by the checker (1)" in (tmp_path / "out.markdown").read_text(encoding="utf-8")
