"""JUnit, Markdown and the badge."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import pytest
from markdown_it import MarkdownIt

from juggleproof.judging.register import load_register
from juggleproof.reports.ci import (
    BAD,
    GOOD,
    LIMIT,
    as_junit,
    badge,
    code,
    escaped,
    markdown,
)
from juggleproof.reports.errata import WRONG
from juggleproof.reports.results import RunResults
from tests.reports.runs import FALSE, HOLDS, OPEN, contents, own, paper, refuted

# -------------------------------------------------------------------------------------------------
# The JUnit report counts rightly, has the usual attributes only, and skips nothing.

ROOT = Path(__file__).resolve().parents[2]
# What the schema that Jenkins publishes, and others follow, allows of what is used here; and `file`
# and `line`, as pytest's older form has them, which others read.
ATTRIBUTES = {
    "testsuites": {"name", "time", "tests", "failures", "disabled", "errors"},
    "testsuite": {
        "name",
        "tests",
        "failures",
        "errors",
        "time",
        "disabled",
        "skipped",
        "timestamp",
        "hostname",
        "id",
        "package",
    },
    "testcase": {"name", "classname", "file", "line", "assertions", "time", "status"},
    "failure": {"type", "message"},
    "error": {"type", "message"},
    "system-out": set(),
}
INSIDE = {
    "testsuites": {"testsuite"},
    "testsuite": {"testcase"},
    "testcase": {"failure", "error", "system-out"},
}


def read(results: RunResults, seconds: Mapping[str, float] | None = None) -> ElementTree.Element:
    content = as_junit(results, seconds)
    assert content == as_junit(results, seconds) and content.startswith(b"<?xml")
    root = ElementTree.fromstring(content)
    assert root.tag == "testsuites"
    for node in root.iter():
        assert set(node.attrib) <= ATTRIBUTES[node.tag], node.tag
        assert {child.tag for child in node} <= INSIDE.get(node.tag, set()), node.tag
    suite = root[0]
    cases = list(suite)
    for counted in (root, suite):
        assert int(counted.attrib["tests"]) == len(cases)
        assert int(counted.attrib["failures"]) == sum(
            case.find("failure") is not None for case in cases
        )
        assert int(counted.attrib["errors"]) == sum(
            case.find("error") is not None for case in cases
        )
    assert suite.attrib["skipped"] == "0" and root.find(".//skipped") is None
    assert all(
        case.get("name")
        and case.get("classname")
        and len(case.findall("failure") + case.findall("error")) <= 1
        for case in cases
    )
    return suite


def messages(suite: ElementTree.Element, kind: str) -> dict[str, str]:
    return {
        str(case.get("name")): str(node.get("message"))
        for case in suite
        for node in case.findall(kind)
    }


@pytest.mark.exhaust
def test_paper_as_registered_has_no_failure_holds() -> None:
    suite = read(paper())
    assert (
        len(suite) == len(load_register())
        and not messages(suite, "failure")
        and not messages(suite, "error")
    )


def test_a_claim_that_is_gone_is_a_failure_of_the_register_holds() -> None:
    suite = read(paper({**load_register(), "gone": {"verdict": "gap"}}))
    (case,) = suite.findall("testcase[@name='gone']")
    assert case.attrib["classname"] == "proofs.register"
    assert case.find("failure") is not None


def test_accepted_change_is_no_failure_holds() -> None:
    register = {**load_register(), "gone": {"verdict": "gap"}, "eq-2": {"verdict": "holds"}}
    accepted = paper(register, accepted=True)
    assert not messages(read(accepted), "failure")
    assert "accepted into the register" in markdown(accepted)


def test_unknown_is_an_error_holds(tmp_path: Path) -> None:
    suite = read(own(tmp_path, OPEN))
    assert messages(suite, "error") == {
        "open": "unknown: neither proved nor refuted; open/main is open: 1 of the 3 premises of"
        f" `map` at {tmp_path / 'mine.py'}:12: stays-1, piece 1 takes the space into itself: false"
        " at a = 1, x = 1/2, where x_next <= 1 comes to 3/2 <= 1"
    } and not messages(suite, "failure")


def test_false_claim_of_ones_own_is_a_failure_holds(tmp_path: Path) -> None:
    suite = read(own(tmp_path, FALSE))
    assert set(messages(suite, "failure")) == {"above", "negative-square"} and not messages(
        suite, "error"
    )
    assert messages(suite, "failure")["above"] == (
        "false; above/main fails at x = 1/2: x^2 is 1/4, less than x, 1/2."
    )


def test_case_names_file_and_line_and_its_class_is_the_file_holds(tmp_path: Path) -> None:
    for case in read(paper()):
        text = (ROOT / case.attrib["file"]).read_text(encoding="utf-8")
        begins = text.splitlines()[int(case.attrib["line"]) - 1]
        assert "@" in begins or "def " in begins or "lambda" in begins, begins
        assert case.attrib["classname"].replace(".", "/") + ".py" == case.attrib["file"]
    suite = read(own(tmp_path, FALSE))
    assert [case.attrib["file"] for case in suite] == [str(tmp_path / "mine.py")] * 3
    lines = (tmp_path / "mine.py").read_text(encoding="utf-8").splitlines()
    for case in suite:
        assert lines[int(case.attrib["line"]) - 1] == f"@claim({case.attrib['name']!r})"
        assert case.attrib["classname"] == "mine"


def test_times_stand_only_where_they_are_asked_for_holds(tmp_path: Path) -> None:
    results = own(tmp_path, FALSE)
    assert "time" not in read(results).attrib and b"time=" not in as_junit(results)
    seconds = {"squares": 0.25, "above": 1.5, "negative-square": 0.0004}
    suite = read(results, seconds)
    times = [case.attrib["time"] for case in suite]
    assert times == ["0.250", "1.500", "0.000"] and suite.attrib["time"] == "1.750"


def test_true_claims_of_ones_own_pass_holds(tmp_path: Path) -> None:
    suite = read(own(tmp_path, HOLDS))
    assert len(suite) == 1 and not messages(suite, "failure") and not messages(suite, "error")


def test_rejected_statement_is_an_error_holds() -> None:
    stated = refuted().statements[0].name
    errors = messages(
        read(paper(rejected=[(stated, "the sum is not 0"), ("elsewhere/main", "no such kind")])),
        "error",
    )
    assert set(errors) == {stated.split("/")[0], "elsewhere/main"}
    assert (
        f"the checker rejects {stated}: the sum is not 0" in errors[stated.split("/")[0]]
        and "no such kind" in errors["elsewhere/main"]
    )


def test_docstring_that_xml_cannot_hold_is_written_all_the_same_holds(tmp_path: Path) -> None:
    assert len(read(own(tmp_path, ("squares",), says="a\x01b\ud800c ]]> <&"))) == 1


# -------------------------------------------------------------------------------------------------
# The summary shows every text as it stands, says the most important first, and keeps to its limit.

NASTY = (
    "a|b",
    "<script>alert(1)</script>",
    "`code` ``two``",
    "*bold* _it_ ~~no~~",
    "[link](http://x.org) ![i](y)",
    "# no heading",
    "a\nb\n\n- c",
    "&amp; &lt;",
    r"\frac{1}{2} \| \\",
    "$x$ $$y$$",
    "</details>",
    "<!-- hidden",
    "--- | ---",
    "1. one",
    "@someone",
    "|",
    "`",
    "\\",
    "a`|`b",
)


class _Read(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.cells: list[str] = []

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.tags.append(tag)
        if tag in ("td", "th", "p"):
            self.cells.append("")

    def handle_data(self, data: str) -> None:
        if self.cells:
            self.cells[-1] += data


def rendered(text: str) -> _Read:
    reader = _Read()
    reader.feed(MarkdownIt("commonmark").enable(["table", "strikethrough"]).render(text))
    reader.cells = [cell.strip() for cell in reader.cells]
    return reader


@pytest.mark.parametrize("text", NASTY)
def test_text_in_a_cell_is_shown_as_it_stands_holds(text: str) -> None:
    read = rendered(f"| a | b |\n| --- | --- |\n| {escaped(text)} | end |\n")
    assert read.cells == ["a", "b", " ".join(text.split()), "end"]
    assert set(read.tags) == {"table", "thead", "tbody", "tr", "th", "td"}


@pytest.mark.parametrize("text", NASTY)
def test_code_is_shown_as_it_stands_holds(text: str) -> None:
    read = rendered(f"so: {code(text)} end")
    assert read.cells == [f"so: {' '.join(text.split())} end"] and read.tags == ["p", "code"]


def test_dollars_and_ats_are_no_marks_of_github_holds() -> None:
    assert "$" not in escaped("$x$") and "@" not in escaped("@someone")


def headings(text: str) -> list[str]:
    return [line for line in text.splitlines() if line.startswith("#")]


def test_summary_of_the_paper_says_that_nothing_changed_holds() -> None:
    results = paper()
    text = markdown(results)
    assert (
        headings(text)[0] == "# The theorem is proved"
        and "\n## Changes of verdicts since the register\n\nNo change.\n" in text
    )
    assert f"{len(load_register())} claims: " in text and "Unknown" not in text
    assert text == markdown(results) == markdown(contents())
    read = rendered(text)
    assert read.tags.count("tr") == len(results.claims) + 1 and all(
        any(one.id == cell for cell in read.cells) for one in results.claims
    )
    for one in results.claims:
        assert (one.group in WRONG) == (f"- **{escaped(one.id)}**" in text)


def test_lost_theorem_is_told_first_holds() -> None:
    lost = replace(
        paper(), theorem="theorem: NOT proved; a/b is not certified, and t/exactly rests on it"
    )
    assert headings(markdown(lost))[
        0
    ] == "# The theorem is NOT proved" and "a/b is not certified" in markdown(lost)
    assert headings(markdown(replace(lost, theorem="")))[0] == "# The theorem is NOT proved"


def test_unknown_and_rejected_come_first_holds(tmp_path: Path) -> None:
    text = markdown(own(tmp_path, OPEN))
    assert headings(text) == ["# 1 of 2 claims holds", "## Unknown (1): neither proved nor refuted"]
    stated = refuted().statements[0].name
    found = headings(markdown(paper(rejected=[(stated, "the sum | is not 0")])))
    assert [one.split(" (")[0] for one in found[:4]] == [
        "# The theorem is proved",
        "## Unknown",
        "## Rejected by the checker",
        "## Changes of verdicts since the register",
    ]


def test_false_claim_of_ones_own_is_told_with_its_counterexample_holds(tmp_path: Path) -> None:
    text = markdown(own(tmp_path, FALSE))
    assert (
        "- **above**: false; It says so.; fails at `x = 1/2`" in text
        and "register" not in text
        and "paper" not in text
    )


def test_summary_keeps_to_the_limit_and_tells_what_is_left_out_holds() -> None:
    one = refuted()
    many = RunResults(
        tuple(
            replace(one, id=f"claim-{number}", says="é" * 5000, detail="x" * 5000)
            for number in range(2000)
        ),
        own=True,
    )
    text = markdown(many)
    assert len(text.encode()) <= LIMIT and text.count("<details>") == text.count("</details>")
    assert "lines are left out" in text and "(5010 characters)" in text
    assert "left out" not in markdown(paper())


# -------------------------------------------------------------------------------------------------
# The badge says what the verdicts say, in red where something is wrong.


def read_badge(results: RunResults) -> tuple[str, bool]:
    """What the badge says, and whether it is green."""
    content = badge(results)
    assert content == badge(results) and content.endswith(b"}\n")
    shown = json.loads(content)
    assert set(shown) == {"schemaVersion", "label", "message", "color"}
    assert shown["schemaVersion"] == 1 and shown["label"] == "juggleproof"
    assert shown["color"] in (GOOD, BAD)
    return shown["message"], shown["color"] == GOOD


def test_badge_of_the_paper_is_green_holds() -> None:
    unknown = sum(entry["verdict"] == "unknown" for entry in load_register().values())
    assert read_badge(paper()) == (
        f"theorem proved, {len(load_register())} claims, {unknown} unknown",
        True,
    )
    assert badge(contents()) == badge(paper())


def test_badge_is_red_where_something_is_wrong_holds(tmp_path: Path) -> None:
    register = {**load_register(), "eq-2": {"verdict": "holds"}}
    unknown = sum(entry["verdict"] == "unknown" for entry in register.values())
    stated = refuted().statements[0].name
    for results, part in (
        (paper(register), "1 changed"),
        (replace(paper(), theorem=""), "theorem NOT proved"),
        (paper(rejected=[(stated, "no")]), f"{unknown + 1} unknown"),
        (own(tmp_path, OPEN), "1 of 2 holds, 1 unknown"),
    ):
        message, is_green = read_badge(results)
        assert part in message and not is_green
    assert read_badge(own(tmp_path, HOLDS)) == ("1 of 1 holds, 0 unknown", True)


def test_what_is_not_stated_is_no_error_and_what_is_stated_and_open_is_holds() -> None:
    open_claims = [one for one in paper().claims if one.verdict == "unknown"]
    assert open_claims and not any(one.is_open for one in open_claims)
    assert "## Unknown" not in markdown(paper())
    stated = replace(open_claims[0], detail="")
    assert stated.is_open
    others = tuple(one for one in paper().claims if one.id != stated.id)
    lost = replace(paper(), claims=(*others, stated))
    assert "## Unknown (1)" in markdown(lost) and not read_badge(lost)[1]
    assert stated.id in messages(read(lost), "error")
