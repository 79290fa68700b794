"""The JSON of a run is what its schema describes, and the schema refuses what no run writes."""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from juggleproof.command import report
from juggleproof.judging.register import load_register
from juggleproof.reports import pages
from juggleproof.reports.ci import badge, markdown
from juggleproof.reports.contents import (
    SCHEMA,
    SCHEMA_FILE,
    TOOLS,
    as_json,
    gather,
    results_of,
)
from juggleproof.reports.results import RunResults
from tests.reports.runs import FALSE, OPEN, contents, made_of, own, paper

Document = dict[str, Any]  # as JSON has it
DESCRIBED = json.loads(SCHEMA_FILE.read_text(encoding="utf-8"))
ERRATUM = "eq-2"


@cache
def validator() -> Draft202012Validator:
    Draft202012Validator.check_schema(DESCRIBED)
    return Draft202012Validator(DESCRIBED)


def written(results: RunResults) -> Document:
    content = as_json(results)
    assert content.isascii() and content == as_json(results)
    return json.loads(content)


def claim(data: Document, name: str) -> Document:
    return next(one for one in data["claims"] if one["id"] == name)


def test_pages_count_certificates_as_reports_do_holds() -> None:
    rows = (line.split(" | ") for line in pages.results().splitlines() if "<a id=" in line)
    counted = {row[0].partition("</a>")[2]: row[3] for row in rows}
    votes = r"(?:, )?(?:z3|boxes) \d+/\d+"
    assert counted == {
        one.claim.id: re.sub(votes, "", one.settled_by) for one in contents().entries
    }


def test_run_of_the_paper_is_as_described_holds() -> None:
    results = paper()
    data = written(results)
    validator().validate(data)
    assert (
        data["schema"] == SCHEMA
        and data["subject"] == "paper"
        and data["exit"] == 0
        and data["theorem"]["proved"]
    )
    assert (
        set(data["tools"]) == {"juggleproof", "python", *TOOLS}
        and data["tools"]["juggleproof"] != "unknown"
    )
    assert (
        data["counts"]["claims"] == len(data["claims"]) == len(load_register())
        and data["changes"] == []
    )
    assert data["counts"]["statements"] == sum(len(one["statements"]) for one in data["claims"])
    assert claim(data, "eq-26")["sharp"]["ceiling"] == "0 < alpha < 1" and claim(data, "eq-10")[
        "sharp"
    ] == {"": "0 < alpha < 1"}
    assert claim(data, ERRATUM)["correction"]["possible_transcription_error"] is True
    assert any(
        " = " in stated["counterexample"]
        for stated in claim(data, ERRATUM)["statements"]
        if stated["outcome"] == "refuted"
    )


def test_sharp_ranges_stand_by_reading_holds() -> None:
    for one in paper().claims:
        ranges = one.sharp_by_reading()
        assert "; ".join(
            f"{name}: {text}" if name else text for name, text in ranges.items()
        ) == one.sharp.replace("no alpha", ""), one.id


@pytest.mark.exhaust
def test_report_gathers_what_a_run_comes_to_holds() -> None:
    """As the command gathers it, in processes of its own."""
    assert gather() == contents()


@pytest.mark.parametrize(
    ("wanted", "name", "build"),
    [
        ("json", "juggleproof.json", as_json),
        ("markdown", "juggleproof.md", lambda results: markdown(results).encode()),
        ("badge", "juggleproof-badge.json", badge),
    ],
)
def test_report_writes_what_a_run_would_holds(
    wanted: str,
    name: str,
    build: Callable[[RunResults], bytes],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    made_of(monkeypatch, contents)
    assert report.report([wanted], tmp_path / "new") == 0
    assert [path.name for path in (tmp_path / "new").iterdir()] == [name] and (
        tmp_path / "new" / name
    ).read_bytes() == build(paper())
    assert capsys.readouterr().out == f"{tmp_path / 'new' / name}\n"


def test_own_file_with_a_false_claim_is_as_described_holds(tmp_path: Path) -> None:
    data = written(own(tmp_path, FALSE))
    validator().validate(data)
    assert (data["subject"], data["exit"], data["theorem"], data["changes"]) == (
        "file",
        1,
        None,
        [],
    )
    assert (
        claim(data, "above")["verdict"] == "false"
        and claim(data, "above")["statements"][0]["counterexample"] == "x = 1/2"
    )
    assert claim(data, "negative-square")["statements"][0]["counterexample"].startswith(
        "every value"
    )


def test_unknown_is_as_described_and_no_refutation_holds(tmp_path: Path) -> None:
    data = written(own(tmp_path, OPEN))
    validator().validate(data)
    assert (
        data["exit"] == 1
        and data["counts"]["verdicts"]["unknown"] == 1
        and data["counts"]["verdicts"]["false"] == 0
    )
    assert claim(data, "open")["statements"][0] == {
        **claim(data, "open")["statements"][0],
        "outcome": "unknown",
        "counterexample": None,
    }


def test_changes_tell_before_and_after_holds() -> None:
    register = load_register()
    register["gone"], register[ERRATUM] = {"verdict": "gap"}, {"verdict": "holds"}
    del register["eq-1"]
    data = written(paper(register))
    validator().validate(data)
    found = {one["claim"]: (one["before"], one["after"]) for one in data["changes"]}
    assert (
        set(found) == {"gone", ERRATUM, "eq-1"}
        and data["exit"] == 1
        and data["counts"]["changes"] == 3
    )
    assert found["gone"] == ({"verdict": "gap"}, None) and found["eq-1"] == (
        None,
        {"verdict": "holds"},
    )
    assert found[ERRATUM][0] == {"verdict": "holds"} and found[ERRATUM][1]["verdict"] == "misprint"
    assert "verdict was holds, is misprint" in claim(data, ERRATUM)["change"]["text"]


def test_claim_whose_statement_is_rejected_is_unknown_holds() -> None:
    name = "eq-1"
    stated = next(one for one in paper().claims if one.id == name).statements[0].name
    data = written(paper(rejected=[(stated, "the sum is not 0")]))
    validator().validate(data)
    assert data["exit"] == 1 and data["rejected"] == [
        {"statement": stated, "reason": "the sum is not 0"}
    ]
    assert claim(data, name)["verdict"] == "unknown" and data["counts"]["outcomes"]["rejected"] == 1
    assert (
        data["changes"][0]["claim"] == name and data["changes"][0]["after"]["verdict"] == "unknown"
    )


def test_docstring_that_no_file_can_hold_is_written_all_the_same_holds(tmp_path: Path) -> None:
    data = written(own(tmp_path, ("squares",), says="a\x01b\ud800c"))
    validator().validate(data)
    assert data["claims"][0]["says"] == "a\ufffdb\ufffdc"


def parts(schema: object) -> Iterator[tuple[str, Document]]:
    """Every property of every object that the schema describes."""
    if isinstance(schema, dict):
        for name, one in (
            schema.get("properties", {}).items() if "additionalProperties" in schema else ()
        ):
            yield name, one
        for one in schema.values():
            yield from parts(one)
    elif isinstance(schema, list):
        for one in schema:
            yield from parts(one)


def test_every_field_is_described_holds() -> None:
    found = list(parts(DESCRIBED))
    assert len(found) > 60
    for name, one in found:
        assert one.get("description", "").endswith("."), name


def test_every_object_of_a_run_is_closed_holds() -> None:
    def closed(schema: object) -> Iterator[bool]:
        if isinstance(schema, dict):
            if (
                schema.get("type") == "object"
                and "properties" in schema
                and "description" in schema
            ):
                yield schema.get("additionalProperties") is False and set(
                    schema["required"]
                ) <= set(schema["properties"])
            for one in schema.values():
                yield from closed(one)
        elif isinstance(schema, list):
            for one in schema:
                yield from closed(one)

    found = list(closed(DESCRIBED))
    assert len(found) > 8 and all(found)


def change(*path: str | int, to: object) -> Callable[[Document], None]:
    def edit(data: Document) -> None:
        for step in path[:-1]:
            data = data[step]
        data[path[-1]] = to

    return edit


def drop(*path: str | int) -> Callable[[Document], None]:
    def edit(data: Document) -> None:
        for step in path[:-1]:
            data = data[step]
        del data[path[-1]]

    return edit


WRONG = {
    "the schema of before": change("schema", to=1),
    "another schema's name": change("$schema", to="https://example.org/schema"),
    "no tools": drop("tools"),
    "a number for a version": change("tools", "sympy", to=1),
    "a word that is no verdict": change("claims", 0, "verdict", to="true"),
    "a negative count": change("counts", "verdicts", "holds", to=-1),
    "no count of what is unknown": drop("counts", "verdicts", "unknown"),
    "a field that is not described": change("date", to="today"),
    "a field of a claim that is not described": change("claims", 0, "seconds", to=1),
    "a claim without sentence": change("claims", 0, "says", to=""),
    "a sharp range that is no text": change("claims", 0, "sharp", to={"": 1}),
    "a refutation without counterexample": change(
        "claims", 1, "statements", 0, "counterexample", to=None
    ),
    "a counterexample to what is certified": change(
        "claims", 0, "statements", 0, "counterexample", to="x = 1"
    ),
    "a vote that certifies": change("claims", 0, "statements", 0, "votes", to={"z3": "certified"}),
    "a statement without text": change("claims", 0, "statements", 0, "text", to=""),
    "a misprint without correction": change("claims", 1, "verdict", to="misprint"),
    "an unknown claim among the errata": change("claims", 1, "verdict", to="unknown"),
    "a claim that holds though a statement is rejected": change(
        "claims", 0, "statements", 0, "outcome", to="rejected"
    ),
    "success though something is rejected": lambda data: data.update(
        exit=0, rejected=[{"statement": "a/b", "reason": "wrong"}]
    ),
    "an exit of 2": change("exit", to=2),
    "a theorem of a file": change("theorem", to={"proved": True, "text": "theorem: proved"}),
    "a change of a file": change(
        "changes",
        to=[{"claim": "a", "before": None, "after": {"verdict": "holds"}, "text": "a: new"}],
    ),
    "a change without before": change(
        "claims", 0, "change", to={"claim": "a", "after": None, "text": "a"}
    ),
}


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Document:
    data = written(own(tmp_path_factory.mktemp("own"), FALSE))
    assert validator().is_valid(data)
    return data


@pytest.mark.parametrize("defect", sorted(WRONG))
def test_rejects_document_with(defect: str, good: Document) -> None:
    bad = copy.deepcopy(good)
    WRONG[defect](bad)
    assert not validator().is_valid(bad)


def test_results_are_taken_as_they_are_holds() -> None:
    results = paper()
    assert results_of(results) is results
