"""The pages on statements and certificates name exactly what the checker knows."""

from __future__ import annotations

import re
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.certificates.checker import algebra, language, orbits, rules, settling, text
from juggleproof.statements.store import DEFAULT
from tests.certificates.checker.maps import ASKED
from tests.docs.pages import PAGES, ROOT, code, text_of
from tests.rows import each_row

LANGUAGE = text_of(ROOT / "docs/statement-language.md")
CERTIFICATES = text_of(ROOT / "docs/certificates.md")


def section(text: str, title: str) -> str:
    return text.split(f"\n## {title}\n")[1].split("\n## ")[0]


def first_cells(text: str) -> list[str]:
    """What stands in code in the first cell of every row of the tables."""
    rows = re.findall(r"^\| (`.*?) \|", text, re.M)
    return [cell for row in rows for cell in re.findall(r"`([^`]+)`", row)]


def test_every_keyword_is_explained_holds() -> None:
    keywords = {cell.split()[0] for cell in first_cells(section(LANGUAGE, "Lines"))}
    assert keywords == {"define", *language.LINES}


def test_every_kind_has_its_lines_in_order_holds() -> None:
    kinds = section(LANGUAGE, "Kinds of statements")
    rows = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", kinds, re.M))
    assert set(rows) == set(language.ORDERS)
    for kind, order in language.ORDERS.items():
        assert re.findall(r"`(\w+)`", rows[kind]) == re.findall(r"\w+", order), kind


def test_every_rule_has_a_place_holds() -> None:
    named = re.findall(r"^### `(\w+)`$", section(CERTIFICATES, "Proof rules"), re.M)
    assert named == list(rules.RULES)
    named = re.findall(r"^### `(\w+)`$", section(CERTIFICATES, "Orbit rules"), re.M)
    assert named == list(orbits.ORBIT_RULES)


def test_every_premise_is_listed_holds() -> None:
    page = section(CERTIFICATES, "Orbit rules")
    listed = {
        rule: set(first_cells(page.split(f"\n### `{rule}`\n")[1].split("\n### ")[0]))
        for rule in orbits.ORBIT_RULES
    }
    statements = checker.read_statements(ASKED)
    written: dict[str, set[str]] = {}
    for statement in statements.values():
        for premise in checker.premises_of(statement, statements):
            general = re.sub(r"-\d+-\d+$", "-i-k", premise)
            written.setdefault(statement.kind, set()).add(re.sub(r"-\d+$", "-k", general))
    assert set(written) == set(orbits.ORBIT_RULES)
    for rule, premises in written.items():
        assert premises - {"possible", "inside"} == listed[rule] - {"inside"}, rule


def test_limits_are_the_checkers_holds() -> None:
    limits = {int(number) for number in re.findall(r"\d+", section(LANGUAGE, "Limits"))}
    assert limits == {
        algebra.MAX_DEGREE,
        algebra.MAX_VARIABLES,
        algebra.MAX_TERMS,
        algebra.MAX_BITS,
        settling.MAX_FILE,
        algebra.MAX_WORK,
        settling.MAX_FOLDER_WORK,
        settling.MAX_STATEMENTS,
        text.MAX_TEXT,
    }


SHOWN = [(page, one) for page in PAGES for one in code(page, "statement")]


@each_row(("page", "text"), SHOWN)
def test_a_statement_that_is_shown_is_stored_holds(page: Path, text: str) -> None:
    stored = (DEFAULT / "statements.txt").read_text(encoding="utf-8").split("\n\n")
    assert text.strip() in map(str.strip, stored)


def test_definitions_that_are_shown_are_stored_in_this_order_holds() -> None:
    stored = iter((DEFAULT / "statements.txt").read_text(encoding="utf-8").splitlines())
    shown = [
        line for page in PAGES for text in code(page, "definitions") for line in text.split("\n")
    ]
    assert shown
    for line in filter(None, shown):
        assert line in stored, line
