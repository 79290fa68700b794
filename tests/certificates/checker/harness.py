"""Cases for the checker: a statement, a certificate, and the outcome, or why it is rejected."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Kind, Rejected
from juggleproof.certificates.checker.settling import unique

Json = Any
# a kind; with how the offender begins; with the place
Expected = str | Kind | tuple[Kind, str] | tuple[Kind, str, str]
OPEN = ["psatz", [], []]  # a node that closes nothing: whatever reaches it is rejected
CLOSE = ["close"]


@dataclass(frozen=True)
class Case:
    """One certificate for the last statement of a text; `earlier` holds the certificates of those
    before it.
    """

    defect: str
    text: str
    certificate: Json
    expected: Expected = "certified"
    earlier: dict[str, Json] = field(default_factory=dict)


def lines(*rows: str, name: str = "rule/case") -> str:
    """The text of one statement."""
    return "\n".join([f"statement {name}", *rows, ""])


def proof(
    node: Json, *steps: Json, at: dict[str, str] | None = None, name: str = "rule/case"
) -> Json:
    """A certificate: `node` closes "premises and not goals", `steps` the obligations; the point's
    terms meet the premises at once.
    """
    return {"certified": ["proof", list(steps), node], "point": [name, [], at or {}, CLOSE]}


def witness(
    found: Json, *steps: Json, at: dict[str, str] | None = None, name: str = "rule/case"
) -> Json:
    """A certificate for a statement with `exists`."""
    return {"certified": ["witness", list(steps), found], "point": [name, [], at or {}, CLOSE]}


def refuted(
    at: dict[str, str],
    premises: Json = CLOSE,
    goals: Json = CLOSE,
    adjoined: Json = (),
    name: str = "rule/case",
) -> Json:
    """A counterexample."""
    return {"refuted": [name, list(adjoined), at, premises, goals]}


def refused(reason: Rejected | None, expected: Expected) -> bool:
    """Whether the reason is the one expected: its kind, how its offender begins, and its place."""
    kind, offender, place = (*(expected if isinstance(expected, tuple) else (expected,)), "", "")[
        :3
    ]
    return (
        reason is not None
        and reason.kind is kind
        and reason.offender.startswith(offender)
        and (not place or reason.place == place)
    )


def verdict(text: str, certificates: dict[str, Json]) -> dict[str, tuple[str, Rejected | None]]:
    """{name: (outcome, reason)} for every statement of a text, each checked after those before
    it.
    """
    known: dict[str, Any] = {}
    earlier: dict[str, Any] = {}
    found: dict[str, tuple[str, Rejected | None]] = {}
    for name, statement in checker.read_statements(text).items():
        certificate = json.loads(json.dumps(certificates[name]), object_pairs_hook=unique)
        found[name] = checker.check_one(statement, certificate, known, earlier)
        earlier[name] = statement
        if found[name][0] == "certified":
            known[name] = statement
    return found


def judge(case: Case) -> tuple[str, Rejected | None]:
    """(outcome, reason) of the last statement of a case; none of those before it may be
    rejected.
    """
    try:
        found = verdict(case.text, case.earlier | {_last(case.text): case.certificate})
    except checker.Rejected as reason:
        return "unreadable", reason
    *before, last = found.values()
    if any(outcome == "rejected" for outcome, _ in before):
        raise ValueError(f"{case.defect}: an earlier statement is rejected: {before}")
    return last


def _last(text: str) -> str:
    return [row for row in text.splitlines() if row.startswith("statement ")][-1].removeprefix(
        "statement "
    )
