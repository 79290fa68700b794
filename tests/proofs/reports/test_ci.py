"""The JUnit report counts rightly, has the usual attributes only, and skips nothing."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

from juggleproof.proofs.register import load_register
from juggleproof.proofs.reports.ci import as_junit
from juggleproof.proofs.reports.results import Results
from tests.proofs.reports.runs import FALSE, HOLDS, OPEN, gathered, own, paper

# What the schema that Jenkins publishes, and others follow, allows of what is used here.
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
    "testcase": {"name", "classname", "assertions", "time", "status"},
    "failure": {"type", "message"},
    "error": {"type", "message"},
    "system-out": set(),
}
INSIDE = {
    "testsuites": {"testsuite"},
    "testsuite": {"testcase"},
    "testcase": {"failure", "error", "system-out"},
}


def read(results: Results) -> ElementTree.Element:
    content = as_junit(results)
    assert content == as_junit(results) and content.startswith(b"<?xml")
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


def found(suite: ElementTree.Element, kind: str) -> dict[str, str]:
    return {
        str(case.get("name")): str(node.get("message"))
        for case in suite
        for node in case.findall(kind)
    }


def test_paper_as_registered_has_no_failure_holds() -> None:
    suite = read(paper())
    assert (
        len(suite) == len(load_register())
        and not found(suite, "failure")
        and not found(suite, "error")
    )


def test_report_and_run_write_the_same_holds() -> None:
    assert as_junit(gathered()) == as_junit(paper())


def test_change_is_a_failure_with_before_and_after_holds() -> None:
    register = load_register()
    register["gone"], register["eq-2"] = {"verdict": "gap"}, {"verdict": "holds"}
    del register["eq-1"]
    suite = read(paper(register))
    failures = found(suite, "failure")
    assert set(failures) == {"gone", "eq-1", "eq-2"} and not found(suite, "error")
    assert (
        "verdict was holds, is misprint" in failures["eq-2"]
        and "eq-2/main fails at " in failures["eq-2"]
    )
    assert (
        "verdict was gap, is absent" in failures["gone"]
        and "verdict was absent, is holds" in failures["eq-1"]
    )
    assert not found(read(paper(register, accepted=True)), "failure")


def test_unknown_is_an_error_holds(tmp_path: Path) -> None:
    suite = read(own(tmp_path, OPEN))
    assert found(suite, "error") == {"open": "unknown: neither proved nor refuted"} and not found(
        suite, "failure"
    )


def test_false_claim_of_ones_own_is_a_failure_holds(tmp_path: Path) -> None:
    suite = read(own(tmp_path, FALSE))
    assert set(found(suite, "failure")) == {"above", "negative-square"} and not found(
        suite, "error"
    )
    assert found(suite, "failure")["above"] == "false; above/main fails at x = 1"


def test_true_claims_of_ones_own_pass_holds(tmp_path: Path) -> None:
    suite = read(own(tmp_path, HOLDS))
    assert len(suite) == 1 and not found(suite, "failure") and not found(suite, "error")


def test_rejected_statement_is_an_error_holds() -> None:
    stated = paper().claims[0].statements[0].name
    errors = found(
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
