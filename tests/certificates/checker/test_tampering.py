"""Changed certificates and changed statements: whatever is still accepted is still true, by the
second reading at sample points.
"""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Iterator
from typing import Any

import pytest

from juggleproof.certificates import checker
from tests.certificates.checker.claims import contradiction
from tests.certificates.checker.harness import Case, Json, verdict
from tests.certificates.checker.rules import TABLES

AT_LIMITS = {  # each check takes long
    "as many terms as may be",
    "the highest degree",
    "the longest number",
    "the longest denominator",
    "a denominator of the greatest length",
}
CASES = {
    rule: [
        case
        for case in module.ACCEPTED
        if case.expected != "unknown" and case.defect not in AT_LIMITS
    ]
    for rule, module in TABLES.items()
    if rule != "definitions"  # the second reading has none: see test_definitions
}
SEEN: dict[str, object] = {}


def replaced(data: Json, path: list[Any], value: Json) -> Json:
    changed = copy.deepcopy(data)
    place = changed
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return changed


def places(data: Json, path: list[Any]) -> Iterator[tuple[list[Any], Json]]:
    items = (
        data.items()
        if isinstance(data, dict)
        else enumerate(data)
        if isinstance(data, list)
        else []
    )
    for key, value in items:
        yield [*path, key], value
        yield from places(value, [*path, key])


MOST = 40  # changes tried of one certificate, evenly spread


def tampered(certificate: Json) -> list[Json]:
    """Changes of every place of a certificate: digits and indices, signs, keys and entries removed,
    doubled or swapped.
    """
    changes = list(changes_somewhere(certificate))
    chosen = changes[:: 1 + len(changes) // MOST]
    return [replaced([certificate], path, change)[0] for path, change in chosen]


def changes_somewhere(certificate: Json) -> Iterator[tuple[list[Any], Json]]:
    """Places, and what is put there."""
    for path, value in places([certificate], []):
        if isinstance(value, int):
            changes: list[Json] = [value + 1, value - 1, -value, True, str(value), value + 0.5]
        elif isinstance(value, str):
            changes = [
                re.sub(r"\d", lambda d: str((int(d[0]) + 1) % 10), value),
                f"-({value})",
                value + " + 1",
                f"1/({value})",
                value.upper(),
            ]
            changes += [f"({value})^2", None]
        elif isinstance(value, list):
            changes = [
                value[:-1],
                value[1:],
                value[::-1],
                [*value, *value[-1:]],
                [*value[:1], *value],
                [],
            ]
            changes += [*value, {}, [0], None]
        else:
            changes = [{k: v for k, v in value.items() if k != gone} for gone in value]
            changes += [
                {**value, "extra": "0"},
                dict(zip(value, [*list(value.values())[1:], *list(value.values())[:1]])),
            ]
        for change in changes:
            if type(change) is not type(value) or change != value:
                yield path, change


SWAPS = [
    ("<=", "<"),
    ("<", "<="),
    (">=", ">"),
    (">", ">="),
    ("<", ">"),
    (">", "<"),
    ("!=", "="),
    (" = ", " != "),
    (" + ", " - "),
    (" - ", " + "),
    ("and", "or"),
    ("or", "and"),
    ("implies", "iff"),
    ("iff", "implies"),
    ("x", "y"),
    ("y", "x"),
    ("x", "(x + 1)"),
    ("n", "(n + 1)"),
    ("not ", ""),
]


def altered(text: str) -> Iterator[str]:
    """Every statement that differs by one mark in the last statement of a text, or by a line left
    out.
    """
    rows = text.strip().splitlines()
    last = max(k for k, row in enumerate(rows) if row.startswith("statement "))
    for k in range(last + 1, len(rows)):
        keyword, _, rest = rows[k].partition(" ")
        for change in sorted(one_mark(rest)):
            if change != rest:
                yield "\n".join([*rows[:k], f"{keyword} {change}", *rows[k + 1 :], ""])
        yield "\n".join([*rows[:k], *rows[k + 1 :], ""])


def one_mark(rest: str) -> set[str]:
    changes = {
        rest[: m.start()] + swap + rest[m.end() :]
        for old, swap in SWAPS
        for m in re.finditer(re.escape(old), rest)
    }
    for m in re.finditer(r"\d+", rest):
        changes |= {
            rest[: m.start()] + str(value) + rest[m.end() :]
            for value in (int(m[0]) + 1, abs(int(m[0]) - 1))
        }
    return changes


def last_of(case: Case, text: str, certificate: Json) -> tuple[str, str, str]:
    """(name, outcome, text) of the last statement; a text that cannot be read is rejected."""
    name = [row for row in text.splitlines() if row.startswith("statement ")][-1].removeprefix(
        "statement "
    )
    try:
        outcome, _ = verdict(text, case.earlier | {name: certificate})[name]
    except checker.Rejected:
        outcome = "rejected"
    return name, outcome, "statement " + text.split("statement ")[-1]


def wrong(text: str, outcome: str, certificate: Json, whole: str) -> object:
    """A point at which an accepted certificate is wrong; what a plain proof claims depends on the
    statement alone.
    """
    plain = outcome == "certified" and list(certificate["certified"])[:1] == ["proof"]
    key = json.dumps([whole, outcome, None if plain else certificate])
    if key not in SEEN:
        earlier = {
            block.split("\n")[0]: "statement " + block for block in whole.split("statement ")[1:]
        }
        SEEN[key] = contradiction(text, outcome, certificate, earlier)
    return SEEN[key]


@pytest.mark.parametrize("rule", sorted(CASES))
def test_a_changed_certificate_proves_the_same_statement_or_nothing(rule: str) -> None:
    rejected = 0
    for case in CASES[rule]:
        for certificate in tampered(case.certificate):
            _, outcome, text = last_of(case, case.text, certificate)
            rejected += outcome == "rejected"
            if outcome not in ("rejected", "unknown"):
                assert outcome == case.expected
                assert wrong(text, outcome, certificate, case.text) is None, (text, certificate)
    assert rejected > 3 * len(CASES[rule])


@pytest.mark.parametrize("rule", sorted(CASES))
def test_a_changed_statement_is_rejected_unless_it_is_true(rule: str) -> None:
    rejected = 0
    for case in CASES[rule]:
        for changed in altered(case.text):
            _, outcome, text = last_of(case, changed, case.certificate)
            rejected += outcome == "rejected"
            if outcome != "rejected":
                assert wrong(text, outcome, case.certificate, changed) is None, (
                    text,
                    case.certificate,
                )
    assert rejected > len(CASES[rule])


def test_the_second_reading_knows_a_wrong_outcome() -> None:
    found = {"certified": 0, "refuted": 0}
    for case in (case for cases in CASES.values() for case in cases):
        for changed in list(altered(case.text))[::3]:
            text = "statement " + changed.split("statement ")[-1]
            try:
                found[case.expected] += (
                    wrong(text, case.expected, case.certificate, changed) is not None
                )
            except (ValueError, KeyError, ZeroDivisionError, IndexError):
                continue  # a change that is no statement any more
    assert found["certified"] > 100
    assert found["refuted"] > 5
