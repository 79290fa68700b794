"""The results as a JUnit report, which CI systems show: one test case a claim, and nothing is ever
skipped.

Of the paper a verdict is a failure where it differs from the register, whatever it is; of a file of
one's own where the claim does not hold. What is unknown, and what the checker rejects, is an error.
"""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

from proofs.register import Change
from proofs.reports.results import Result, Results, results_of, writable


def as_junit(contents: Any) -> bytes:
    """The report as XML, without times."""
    results = results_of(contents)
    changes = results.change_of()
    suite = ElementTree.Element("testsuite")
    for one in results.claims:
        _case(
            suite,
            (
                f"own.{one.section}"
                if results.own and one.section
                else "own"
                if results.own
                else f"paper.{one.section}"
            ),
            one.id,
            *_told(one, changes.get(one.id), results),
            out=said(one),
        )
    judged = {one.id for one in results.claims}
    for gone in (change for change in results.changes if change.claim not in judged):
        _case(
            suite,
            "paper.gone",
            gone.claim,
            "" if results.accepted else "failure",
            f"the claim is gone from the sources; {gone}",
        )
    for name, reason in results.rejected:
        if name.split("/")[0] not in judged:
            _case(suite, "checker", name, "error", f"rejected by the checker: {reason}")
    counted = {
        "tests": len(suite),
        "failures": len(suite.findall("testcase/failure")),
        "errors": len(suite.findall("testcase/error")),
        "skipped": 0,
    }
    root = ElementTree.Element(
        "testsuites",
        {
            "name": "juggleproof",
            **{name: str(count) for name, count in counted.items() if name != "skipped"},
        },
    )
    suite.attrib = {"name": "juggleproof", **{name: str(count) for name, count in counted.items()}}
    root.append(suite)
    ElementTree.indent(root)
    text: bytes = ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
    return text + b"\n"


def _case(
    suite: ElementTree.Element, classname: str, name: str, kind: str, message: str, out: str = ""
) -> None:
    case = ElementTree.SubElement(suite, "testcase", classname=classname, name=writable(name))
    if kind:
        lines = writable(message).splitlines()
        ElementTree.SubElement(
            case, kind, message="; ".join(lines[:2]), type=kind
        ).text = "\n".join(lines)
    if out:
        ElementTree.SubElement(case, "system-out").text = out


def _told(one: Result, change: Change | None, results: Results) -> tuple[str, str]:
    """failure, error or nothing, and the message: what differs first, then where the claim
    fails.
    """
    changed = (
        ""
        if change is None
        else f"{'new' if change.before is None else 'changed'} since the register: {change}"
    )
    if one.verdict == "unknown":
        return "error", "unknown: " + (one.detail or "neither proved nor refuted") + (
            f"; {changed}" if changed else ""
        )
    if results.own and one.verdict != "holds":
        return "failure", failing(one)
    if changed and not results.accepted:
        return "failure", "\n".join([changed, *fails_at(one)])
    return "", ""


def said(one: Result) -> str:
    """The verdict and how it was settled."""
    return f"{one.verdict_text}{f'; {one.detail}' if one.detail else ''}; {one.settled_by}"


def failing(one: Result) -> str:
    """Why a claim does not hold: the verdict with its detail, then where its statements fail."""
    return "\n".join([one.verdict_text + (f": {one.detail}" if one.detail else ""), *fails_at(one)])


def fails_at(one: Result) -> list[str]:
    """One line for each refuted statement, with the counterexample."""
    return [f"{stated.name} fails at {stated.at}" for stated in one.statements if stated.at]
