"""The results of a run for machines: JSON and JUnit, with tool versions, without dates or times."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.metadata import version
from xml.etree import ElementTree

from certificates.store import canonical
from proofs.claims import Claim
from proofs.command import table
from proofs.judging import Judgement

SCHEMA = 1
TOOLS = ("sympy", "mpmath", "z3-solver", "python-flint", "highspy")


def as_json(claims: Sequence[Claim], judgements: Sequence[Judgement]) -> bytes:
    """{"schema", "tools", "claims": [{id, place, says, printed, verdict, correction, sharp, statements: {name: outcome}}]}."""
    entries = [{
        "id": claim.id, "section": claim.section, "place": claim.place, "says": claim.says, "printed": claim.printed,
        "verdict": judgement.verdict.word, "detail": judgement.verdict.detail, "correction": judgement.correction,
        "sharp": {prefix.rstrip("."): one["text"] for prefix, one in judgement.sharp.items()}, "statements": judgement.outcomes,
        "votes": {name: {vote.route: vote.answer for vote in cast} for name, cast in judgement.votes.items() if cast},
    } for claim, judgement in zip(claims, judgements)]
    return canonical({"schema": SCHEMA, "tools": {tool: version(tool) for tool in TOOLS}, "claims": entries})


def as_junit(claims: Sequence[Claim], judgements: Sequence[Judgement]) -> bytes:
    """One test case a claim; an `unknown` is an error, never skipped; a verdict on the paper is no failure of the run."""
    unknown = sum(judgement.verdict.word == "unknown" for judgement in judgements)
    suite = ElementTree.Element("testsuite", name="juggleproof", tests=str(len(claims)), errors=str(unknown), failures="0")
    for claim, judgement in zip(claims, judgements):
        case = ElementTree.SubElement(suite, "testcase", classname=f"paper.{claim.section or 'own'}", name=claim.id)
        if judgement.verdict.word == "unknown":
            ElementTree.SubElement(case, "error", message=judgement.verdict.detail or "undecided")
        ElementTree.SubElement(case, "system-out").text = table.verdict_text(claim, judgement)
    ElementTree.indent(suite)
    text: bytes = ElementTree.tostring(suite, encoding="utf-8", xml_declaration=True)
    return text + b"\n"
