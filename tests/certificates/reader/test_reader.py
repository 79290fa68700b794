"""The third reader has the checker's outcome on every stored certificate, on the tables of rules
and on changes of them.  What concerns the limits on work it is not asked.

`make test` takes a fixed share of the changes; with JUGGLEPROOF_MUTANTS=many (make exhaust) a
larger one.
"""

from __future__ import annotations

import ast
import json
import sys
from collections.abc import Iterator
from functools import cache
from itertools import islice
from pathlib import Path
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.statements.store import DEFAULT
from tests.certificates.checker.harness import Case
from tests.certificates.checker.maps import (
    ASKED,
    COUNT,
    DOUBLE,
    FLIP,
    NEST,
    PUSH,
    SCALE,
    SUBTRACT,
    SWITCH,
    TURN,
    WHOLE,
    searched,
)
from tests.certificates.checker.rules import TABLES
from tests.certificates.checker.test_returns import LOOP
from tests.certificates.checker.test_settles import NEARER, TWO
from tests.certificates.checker.test_tampering import AT_LIMITS, altered, places, tampered
from tests.certificates.reader.orbits import PREMISES
from tests.certificates.reader.settling import (
    load_json,
    outcomes,
    read_certificates,
    read_folder,
    settle,
)
from tests.certificates.reader.statements import Statement, read_statements
from tests.certificates.reader.syntax import Rejected, Tree
from tests.rows import each_row
from tests.share import share

HERE = Path(__file__).parent
LIMITS = {"a number too long", "a denominator too long", *AT_LIMITS}
SHARE = share(40, 10)


@pytest.mark.exhaust  # the reader takes minutes for the store
def test_every_stored_certificate_has_the_checkers_outcome_holds() -> None:
    theirs = {name: outcome for name, outcome, _ in checker.check_folder(str(DEFAULT))}
    assert read_folder(DEFAULT) == theirs
    assert set(theirs.values()) == {"certified", "refuted"}


def by_reader(text: str, certificates: dict[str, Any]) -> str:
    """The outcome of the last statement of a text."""
    try:
        statements = read_statements(text)
        entries = {name: load_json(json.dumps(certificates.get(name))) for name in statements}
        return list(outcomes(statements, entries).values())[-1].split(":")[0]
    except Rejected:
        return "rejected"


def by_checker(text: str, certificates: dict[str, Any]) -> str:
    """The same by the checker."""
    known: dict[str, Any] = {}
    earlier: dict[str, Any] = {}
    outcome = "rejected"
    try:
        for name, statement in checker.read_statements(text).items():
            certificate = json.loads(json.dumps(certificates.get(name)))
            outcome, _ = checker.check_one(statement, certificate, known, earlier)
            earlier[name] = statement
            if outcome == "certified":
                known[name] = statement
    except checker.Rejected:
        return "rejected"
    return outcome


def certificates_of(case: Case) -> dict[str, Any]:
    *_, last = (row for row in case.text.splitlines() if row.startswith("statement "))
    return {**case.earlier, last.removeprefix("statement "): case.certificate}


@each_row("rule", TABLES)
def test_the_tables_hold(rule: str) -> None:
    module = TABLES[rule]
    for case in module.ACCEPTED:
        assert by_reader(case.text, certificates_of(case)) == case.expected, case.defect
    for case in module.REJECTED:
        if case.defect not in LIMITS:
            assert by_reader(case.text, certificates_of(case)) == "rejected", case.defect


def changed(case: Case) -> Iterator[tuple[str, dict[str, Any]]]:
    """The case with one change in its certificate, or in its statement."""
    certificates = certificates_of(case)
    *_, last = certificates
    for certificate in tampered(case.certificate):
        # the checker reads {} where a list is empty
        if json.dumps(certificate).count("{}") <= json.dumps(case.certificate).count("{}"):
            yield case.text, {**certificates, last: certificate}
    for text in altered(case.text):
        yield text, certificates


@each_row("rule", TABLES)
def test_changes_of_the_tables_have_the_checkers_outcome_hold(rule: str) -> None:
    # a statement of which nothing is said is not unfolded by the checker
    cases = [case for case in TABLES[rule].ACCEPTED if case.expected != "unknown"]
    cases = [case for case in cases if case.defect not in LIMITS]
    changes = (change for case in cases for change in changed(case))
    for text, certificates in islice(changes, len(rule) % SHARE, None, SHARE):
        assert by_reader(text, certificates) == by_checker(text, certificates), (text, certificates)


@cache
def stored() -> tuple[dict[str, Statement], dict[str, Any]]:
    statements = read_statements((DEFAULT / "statements.txt").read_text())
    return statements, read_certificates((DEFAULT / "certificates.jsonl").read_text())


def outcome(name: str, entry: Any) -> str:
    """Of one stored statement, where those before it are settled as stored."""
    statements, entries = stored()
    names = list(statements)
    earlier = {one: statements[one] for one in names[: names.index(name)]}
    certified = {one: earlier[one] for one in earlier if "certified" in entries[one]}
    try:
        return settle(statements[name], entry, earlier, certified)
    except Rejected:
        return "rejected"


def test_rejects_stored_sums_with_another_coefficient() -> None:
    count = 0
    for name, entry in islice(stored()[1].items(), 0, None, SHARE):
        lists = (value for _, value in places(entry, []) if isinstance(value, list))
        sums = [value for value in lists if value[:1] == ["psatz"]]
        if sums:
            term = sums[0][1][0]
            old = term[0]
            term[0] = f"{old}1"  # ten times as much and one; or another denominator
            assert outcome(name, entry) == "rejected", name
            term[0] = old
            count += 1
    assert count > 500 // SHARE


def test_rejects_stored_entries_under_another_outcome() -> None:
    for name, entry in islice(stored()[1].items(), 0, None, SHARE):
        other = {"refuted" if part == "certified" else "certified": entry[part] for part in entry}
        assert outcome(name, other) == "rejected", name
        if len(entry) == 2:
            assert outcome(name, {"certified": entry["certified"]}) == "rejected", name


def until(text: str) -> Iterator[str]:
    """The beginnings of a text, up to each of its statements."""
    blocks = text.strip().split("\n\n")
    return ("\n\n".join(blocks[:k]) + "\n" for k in range(1, len(blocks) + 1))


@each_row(
    "text",
    [SUBTRACT, TURN, FLIP, NEST, DOUBLE, PUSH, SWITCH, SCALE, COUNT, WHOLE, TWO, NEARER, LOOP],
)
def test_changes_of_orbit_rules_have_the_checkers_outcome_hold(text: str) -> None:
    certificates = searched(text)
    assert by_reader(text, certificates) == "certified"
    changes = [change for beginning in until(text) for change in altered(beginning)]
    for change in changes[len(text) % SHARE :: SHARE]:
        found = by_reader(change, certificates)
        assert found == by_checker(change, certificates), change


def flat(tree: Tree) -> Tree:
    """The tree without the order in which equal operators are joined."""
    parts = [flat(part) if isinstance(part, tuple) else part for part in tree[1:]]
    if tree[0] in ("and", "or"):
        joined = [part[1:] if part[0] == tree[0] else (part,) for part in parts]
        parts = [part for some in joined for part in some]
    return (tree[0], *parts)


def test_premises_are_those_of_the_checker_hold() -> None:
    statements = read_statements(ASKED)
    own = {}
    for statement in statements.values():
        for premise in PREMISES[statement.kind](statement, statements).values():
            own[premise.name] = premise
    text = (HERE.parent / "checker/premises.txt").read_text()
    theirs = read_statements(text)
    assert own.keys() == theirs.keys()
    for name, premise in theirs.items():
        assert own[name].kind == premise.kind == "universal"
        assert [flat(line) for line in own[name].lines] == [flat(line) for line in premise.lines]


def test_it_shares_no_code_with_the_checker_holds() -> None:
    for path in HERE.glob("*.py"):
        if path.name != Path(__file__).name:
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Import):
                    assert {one.name for one in node.names} <= sys.stdlib_module_names
                elif isinstance(node, ast.ImportFrom):
                    module = str(node.module)
                    alone = module == "flint" or module.startswith("tests.certificates.reader.")
                    assert alone or module.split(".")[0] in sys.stdlib_module_names, path
                    assert module not in ("ast", "fractions")
