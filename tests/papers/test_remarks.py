"""The tables of names and citations have what the prints and the paper have."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from juggleproof.papers import remarks as table
from juggleproof.papers.ledger import LedgerError, load_ledger, scan
from juggleproof.papers.paper import opened
from juggleproof.papers.remarks import (
    Citation,
    Meant,
    ambiguous_names,
    check_citations,
    check_names,
    citations,
    meanings,
    printed_names,
)

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def printed() -> set[tuple[str, str]]:
    return printed_names(opened().claims())


def test_the_table_has_every_name_of_a_print_holds(printed: set[tuple[str, str]]) -> None:
    assert len(printed) > 300
    check_names(meanings(), printed)


def test_rejects_a_table_that_lacks_a_name_or_has_one_too_many(
    printed: set[tuple[str, str]],
) -> None:
    rows = meanings()
    lacking = [row for row in rows if row.name != r"\gamma"]
    with pytest.raises(LedgerError, match=r"\\gamma is printed in section 2\.2\.2; add"):
        check_names(lacking, printed)
    with pytest.raises(LedgerError, match=r"no print of section 4\.4 has \\gamma; write 4\.4\*"):
        check_names([*rows, Meant(r"\gamma", ("4.4",), "gravity")], printed)


def test_a_name_with_two_meanings_has_them_apart_holds() -> None:
    found = ambiguous_names(meanings())
    assert {"K", "R", "b", "f", "x", "u_{2}", r"\chi", r"\mathcal{H}"} <= set(found)
    for name, rows in found.items():
        assert len({row.meaning for row in rows}) == len(rows), name


def test_every_citation_is_of_an_item_and_a_remark_names_claims_that_are_there_holds() -> None:
    rows, known = {row.key for row in load_ledger()}, {claim.id for claim in opened().claims()}
    for one in citations():
        assert one.key in rows and one.cited, one.key
        named = re.findall(r"(?:s[\dAB][\w.]*|prop-\d|eq)-[\w-]+", one.remark)
        assert set(named) <= known, one.key
    assert sum(bool(one.remark) for one in citations()) > 10


def test_the_table_has_every_citation_of_the_paper_holds() -> None:
    named = os.environ.get("JUGGLEPROOF_PAPER")
    paper = Path(named) if named else ROOT.parent / "shared" / "paper.txt"
    if not named and not paper.is_file():
        pytest.skip("the paper is not at hand: set JUGGLEPROOF_PAPER to its text")
    check_citations(citations(), scan(paper.read_text(encoding="utf-8")))


def test_rejects_citations_that_are_not_the_papers() -> None:
    items = scan("3.4. By (1) and section 3.1.\nAs in (2).\nNothing.\n")
    rows = [Citation("3.4-s01", ("(1)", "3.1"), ""), Citation("3.4-s02", ("(2)",), "")]
    check_citations(rows, items)
    with pytest.raises(LedgerError, match="1 rows, but the paper has 2"):
        check_citations(rows[:1], items)
    with pytest.raises(LedgerError, match=r"3\.4-s02.*stands where the paper has"):
        check_citations([rows[0], Citation("3.4-s02", ("(3)",), "")], items)


@pytest.mark.parametrize("text, message", [
    ("name\tsections\n", "must name the columns name, sections, meaning"),
    ("name\tsections\tmeaning\nK\t4.3\n", r"names\.tsv:2: 2 columns instead of 3"),
])  # fmt: skip
def test_rejects_a_table_that_does_not_parse(text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "names.tsv").write_text(text)
    with pytest.raises(LedgerError, match=message):
        meanings(tmp_path / "names.tsv")


def test_the_remarks_show_each_meaning_and_each_remark_holds() -> None:
    text = table.remarks()
    for rows in ambiguous_names(meanings()).values():
        assert all(row.meaning in text for row in rows)
    assert all(one.remark in text for one in citations())
