"""Results for CI: a badge, a JUnit report, and the Markdown of a job's summary."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from pathlib import PurePath
from xml.etree import ElementTree

from juggleproof.folders import FOLDER, REGISTER
from juggleproof.judging.conclusions import PROVED, REFUTED
from juggleproof.judging.register import FIELDS, Change
from juggleproof.papers.paper import opened
from juggleproof.reports.contents import Contents, results_of
from juggleproof.reports.errata import GROUPS, WRONG
from juggleproof.reports.results import (
    ClaimResult,
    RunResults,
    columns,
    writable,
)

# -------------------------------------------------------------------------------------------------
# A badge for a page: a summary of the verdicts, as the JSON that shields.io draws.

LABEL = "juggleproof"
GOOD, BAD = "brightgreen", "red"


def badge(contents: Contents | RunResults) -> bytes:
    """The badge in the schema of shields.io's endpoint (https://shields.io/badges/endpoint-badge),
    the same bytes for the same verdicts.
    """
    message, color = message_of(results_of(contents))
    shown = {"schemaVersion": 1, "label": LABEL, "message": message, "color": color}
    return (json.dumps(shown) + "\n").encode()


def message_of(results: RunResults) -> tuple[str, str]:
    """The message and its colour: red where the theorem is not proved, a stated claim is unknown, a
    statement is rejected, or a verdict is not as registered.
    """
    count, unknown = len(results.claims), results.verdicts()["unknown"]
    claims = f"{count} claim{'' if count == 1 else 's'}, {unknown} unknown"
    if results.own:
        holds = results.verdicts()["holds"]
        return (
            f"{holds} of {count} {'holds' if holds == 1 else 'hold'}, {unknown} unknown",
            BAD if results.exit else GOOD,
        )
    has_theorem = opened().theorem is not None
    words = [f"theorem {'' if results.is_proved else 'NOT '}{PROVED}"] if has_theorem else []
    words.append(claims)
    if results.changes and not results.accepted:
        words.append(f"{len(results.changes)} changed")
    if results.rejected:
        words.append(f"{len(results.rejected)} rejected")
    is_open = any(one.is_open for one in results.claims)
    lacks = has_theorem and not results.is_proved
    return ", ".join(words), BAD if results.exit or is_open or lacks else GOOD


# -------------------------------------------------------------------------------------------------
# The results as a JUnit report, which CI systems show: each claim is a test case, and nothing is
# ever skipped.
#
# A claim of the paper is a failure where its verdict differs from the register, a user's claim
# where it does not hold. An unknown claim, and a statement that the checker rejects, is an error.


def as_junit(contents: Contents | RunResults, seconds: Mapping[str, float] | None = None) -> bytes:
    """The report as XML: each claim has its file and line, and a class that is named after the
    file; `time` is there only if the seconds of the claims are given, by id.
    """
    results = results_of(contents)
    changes = results.change_of()
    suite = ElementTree.Element("testsuite")
    for one in results.claims:
        file, line = one.source
        _case(
            suite,
            class_name(file),
            one.id,
            *_failure(one, changes.get(one.id), results),
            out=verdict_line(one),
            more={"file": file, "line": str(line)}
            | ({"time": f"{seconds[one.id]:.3f}"} if seconds else {}),
        )
    judged = {one.id for one in results.claims}
    for gone in (change for change in results.changes if change.claim not in judged):
        _case(
            suite,
            class_name(f"{FOLDER.name}/{REGISTER.name}"),
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
    attributes = {"name": "juggleproof"} | {name: str(n) for name, n in counted.items()}
    if seconds:
        attributes["time"] = f"{sum(seconds.values()):.3f}"
    suite.attrib = attributes
    root = ElementTree.Element("testsuites", attributes)
    del root.attrib["skipped"]
    root.append(suite)
    ElementTree.indent(root)
    text: bytes = ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
    return text + b"\n"


def class_name(file: str) -> str:
    """The class of a file's claims: its path with dots, or its name where the path is absolute.

    >>> class_name("claims/mine.py"), class_name("/tmp/mine.py")
    ('claims.mine', 'mine')
    """
    path = PurePath(file).with_suffix("")
    return path.name if path.is_absolute() else ".".join(path.parts)


def _case(
    suite: ElementTree.Element,
    classname: str,
    name: str,
    kind: str,
    message: str,
    out: str = "",
    more: Mapping[str, str] | None = None,
) -> None:
    attributes = {"classname": classname, "name": name, **(more or {})}
    case = ElementTree.SubElement(
        suite, "testcase", {name: writable(text) for name, text in attributes.items()}
    )
    if kind:
        lines = writable(message).splitlines()
        ElementTree.SubElement(
            case, kind, message="; ".join(lines[:2]), type=kind
        ).text = "\n".join(lines)
    if out:
        ElementTree.SubElement(case, "system-out").text = out


def _failure(one: ClaimResult, change: Change | None, results: RunResults) -> tuple[str, str]:
    """The kind, "failure", "error" or empty, and the message: what differs from the register, then
    where the claim fails.
    """
    changed = (
        ""
        if change is None
        else f"{'new' if change.before is None else 'changed'} since the register: {change}"
    )
    if one.is_open:
        detail = "; ".join(part for part in (one.detail, changed) if part)
        return "error", "\n".join([f"unknown: {detail or NEITHER}", *fails_at(one)])
    if results.own and one.verdict != "holds":
        return "failure", failing(one)
    if changed and not results.accepted:
        return "failure", "\n".join([changed, *fails_at(one)])
    return "", ""


NEITHER = f"neither {PROVED} nor {REFUTED}"


def verdict_line(one: ClaimResult) -> str:
    """The verdict, and how the claim was settled."""
    return f"{one.verdict_text}{f'; {one.detail}' if one.detail else ''}; {one.settled_by}"


def failing(one: ClaimResult) -> str:
    """The reason why a claim does not hold: its verdict with detail, then where statements fail."""
    return "\n".join([one.verdict_text + (f": {one.detail}" if one.detail else ""), *fails_at(one)])


def fails_at(one: ClaimResult) -> list[str]:
    """A line for each refuted statement, with its counterexample, and for each open statement, with
    the reason.
    """
    return [
        f"{stated.name} fails at {stated.at}" + (f": {stated.words}" if stated.words else "")
        if stated.at
        else f"{stated.name} is open: {stated.words or stated.outcome}"
        for stated in one.statements
        if stated.outcome != "certified"
    ]


# -------------------------------------------------------------------------------------------------
# The results as Markdown for the summary of a CI job, under GitHub's limit of a megabyte; the list
# of all claims is folded.
#
# The order is: unknown claims, statements that the checker rejects, changes since the register,
# errors with their corrections.

LIMIT = 1_000_000  # bytes; GitHub refuses a summary above 1024 * 1024
LONGEST = 2_000  # characters of one text
ROOM = 2_000  # bytes kept for the lines at the end, which say how many lines are left out


def markdown(contents: Contents | RunResults) -> str:
    """The summary of a run or of a report's contents."""
    results = results_of(contents)
    page = _Page()
    page.add([*_head(results), *_unknown(results), *_rejected(results), *_changes(results)])
    page.add(_errata(results))
    page.add(["<details><summary>Every claim</summary>", ""])
    page.add(
        _table(
            [
                columns(not results.own),
                *(
                    (
                        one.id,
                        one.locator.removeprefix("section "),
                        _verdict(one),
                        one.settled_by,
                        one.sharp,
                    )
                    for one in results.claims
                ),
            ]
        )
    )
    page.end(["", "</details>"])
    return "\n".join(page.lines) + "\n"


class _Page:
    """A page that takes lines while there is room, and counts those that it leaves out."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.room = LIMIT - ROOM
        self.left_out = 0

    def add(self, lines: Iterable[str]) -> None:
        for line in lines:
            self.room -= len(line.encode()) + 1
            if self.room < 0 or self.left_out:
                self.left_out += 1
            else:
                self.lines.append(line)

    def end(self, lines: Iterable[str]) -> None:
        self.lines += lines
        if self.left_out:
            self.lines += [
                "",
                (
                    f"**{self.left_out} lines are left out, for a summary may have a megabyte;"
                    " `--json` writes everything.**"
                ),
            ]


def escaped(text: str) -> str:
    """The text with Markdown's special characters escaped, for a paragraph or a cell.

    >>> escaped("a|b <c> `d` 2*x_1 $5 [e](f)")
    'a\\\\|b \\\\<c\\\\> \\\\`d\\\\` 2\\\\*x\\\\_1 &#36;5 \\\\[e\\\\](f)'
    """
    return (
        re.sub(r"([\\`*_{}\[\]<>#|~!&])", r"\\\1", _one_line(text))
        .replace("$", "&#36;")
        .replace("@", "&#64;")
    )


def code(text: str) -> str:
    """The text as code in a paragraph, between more backticks than it has in a row.

    >>> code("a`b")
    '``a`b``'
    """
    line = _one_line(text)
    fence = "`" * (1 + max((len(run) for run in re.findall("`+", line)), default=0))
    pad = " " if line.startswith("`") or line.endswith("`") else ""
    return f"{fence}{pad}{line}{pad}{fence}" if line else ""


def _one_line(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= LONGEST else f"{line[:LONGEST]}... ({len(line)} characters)"


def _table(rows: Iterable[tuple[str, ...]]) -> Iterable[str]:
    for number, row in enumerate(rows):
        yield f"| {' | '.join(map(escaped, row))} |"
        if not number:
            yield "|" + " --- |" * len(row)


def _head(results: RunResults) -> list[str]:
    theorem = [" ".join(line.split()) for line in results.theorem.splitlines()]
    if not (results.own or theorem or opened().theorem is None):
        theorem = ["theorem: the store does not hold it"]
    counts, outcomes = (
        results.verdicts(),
        {word: n for word, n in results.outcomes().items() if n or word != "rejected"},
    )
    return [
        f"# {_title(results)}",
        "",
        *(escaped(line) + "  " for line in theorem),
        *([""] if theorem else []),
        (
            f"{_many(len(results.claims), 'claim')}{' of a selection' if results.partial else ''}:"
            f" {_counts(counts)}.  "
        ),
        f"{_many(sum(outcomes.values()), 'statement')}: {_counts(outcomes)}.",
        "",
    ]


def _title(results: RunResults) -> str:
    if not results.own and opened().theorem is not None:
        return f"The theorem is {'' if results.is_proved else 'NOT '}{PROVED}"
    holds = results.verdicts()["holds"]
    return f"{holds} of {_many(len(results.claims), 'claim')} {'holds' if holds == 1 else 'hold'}"


def _counts(counts: Mapping[str, int]) -> str:
    return ", ".join(f"{count} {word}" for word, count in counts.items())


def _many(count: int, thing: str) -> str:
    return f"{count} {thing}{'' if count == 1 else 's'}"


def _unknown(results: RunResults) -> list[str]:
    open_claims = [one for one in results.claims if one.is_open]
    if not open_claims:
        return []
    return [
        f"## Unknown ({len(open_claims)}): {NEITHER}",
        "",
        *(
            f"- **{escaped(one.id)}**{_place(one)}:"
            f" {escaped(one.detail or 'no certificate was found')}. {escaped(one.says)}"
            for one in open_claims
        ),
        "",
    ]


def _rejected(results: RunResults) -> list[str]:
    if not results.rejected:
        return []
    return [
        f"## Rejected by the checker ({len(results.rejected)})",
        "",
        *(f"- **{escaped(name)}**: {escaped(reason)}" for name, reason in results.rejected),
        "",
    ]


def _changes(results: RunResults) -> list[str]:
    if results.own:
        return []
    heading = "## Changes of verdicts " + (
        "accepted into the register" if results.accepted else "since the register"
    )
    if not results.changes:
        return [heading, "", "No change.", ""]
    rows = [
        ("claim", "", "before", "after"),
        *(row for change in results.changes for row in _change(change)),
    ]
    return [f"{heading} ({len(results.changes)})", "", *_table(rows), ""]


def _change(change: Change) -> list[tuple[str, str, str, str]]:
    """A row for each field that differs; a row that says so, for a claim that is new or gone."""
    before, after = change.before, change.after
    if before is None or after is None:
        absent = "not registered" if before is None else "no longer in the sources"
        return [
            (
                change.claim,
                "verdict",
                str((before or {}).get("verdict", absent)),
                str((after or {}).get("verdict", absent)),
            )
        ]
    return [
        (change.claim, name, str(before.get(name, "none")), str(after.get(name, "none")))
        for name in FIELDS
        if before.get(name) != after.get(name)
    ]


def _errata(results: RunResults) -> Iterable[str]:
    wrong = [one for one in results.claims if one.group in WRONG]
    if not wrong:
        return
    yield from (
        (
            f"## {'What does not hold' if results.own else 'What the paper prints wrongly'}"
            f" ({len(wrong)})"
        ),
        "",
    )
    for group in WRONG:
        members = [one for one in wrong if one.group == group]
        if not members:
            continue
        if not results.own:
            yield from (f"{GROUPS[group].partition(':')[0]} ({len(members)}):", "")
        yield from (_erratum(one) for one in members)
        yield ""


def _erratum(one: ClaimResult) -> str:
    reasons = [line for line in one.wrong if line != one.verdict_text] or [one.says]
    parts = [
        f"- **{escaped(one.id)}**{_place(one)}: {escaped(one.verdict_text)};"
        f" {escaped('; '.join(reasons))}"
    ]
    if one.correction:
        parts.append(f"corrected: {code(one.correction['text'])}")
    fails = [stated.at for stated in one.statements if stated.at]
    if fails:
        parts.append(f"fails at {code(fails[0])}")
    return "; ".join(parts)


def _place(one: ClaimResult) -> str:
    return f" ({escaped(one.locator)})" if one.locator else ""


def _verdict(one: ClaimResult) -> str:
    return one.verdict_text + (f": {one.detail}" if one.detail else "")
