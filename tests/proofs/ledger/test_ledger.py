"""The ledger is whole and in order, and each way of spoiling it is refused with its own message."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from juggleproof.proofs.ledger.ledger import (
    REASONS,
    REASONS_WITH_KEY,
    ROWS,
    UNPRINTED,
    LedgerError,
    Row,
    check_claims,
    check_rows,
    load_ledger,
)

Rows = list[Row]


@pytest.fixture(scope="module")
def rows() -> Rows:
    return load_ledger()


def all_claims(rows: Rows) -> set[str]:
    return {claim for row in rows for claim in row.claims}


def test_the_ledger_loads_and_reaches_from_2_2_to_the_last_table(rows: Rows) -> None:
    assert (rows[0].key, rows[-1].section) == ("2.2-s01", "B.7")
    assert len(all_claims(rows)) > 100


def test_every_display_has_claims_but_two_that_name_components_and_a_lone_equation_number(
    rows: Rows,
) -> None:
    assert [row.key for row in rows if row.kind == "display" and row.reason] == [
        "2.3-d01",
        "2.3-d02",
        "3.2-d08",
    ]


def test_no_reason_of_the_closed_list_is_idle(rows: Rows) -> None:
    assert {row.reason.partition(" ")[0] for row in rows} - {""} == set(REASONS) | set(
        REASONS_WITH_KEY
    )


def test_the_ledger_holds_digests_and_never_a_sentence() -> None:
    cells = [line.split("\t") for line in ROWS.read_text().split("\n")[:-1]]
    assert {len(cell.split()) for row in cells for cell in row[:4]} == {1}
    assert max(len(row[5].split()) for row in cells) <= 2


def spoil(rows: Rows, at: int, **changes: object) -> Rows:
    return [*rows[:at], replace(rows[at], **changes), *rows[at + 1 :]]  # type: ignore[arg-type]


def index_of(rows: Rows, key: str) -> int:
    return [row.key for row in rows].index(key)


SPOILED: list[tuple[str, Callable[[Rows], Rows]]] = [
    ("neither claims nor a reason", lambda rows: spoil(rows, 3, claims=(), reason="")),
    ("claims and a reason", lambda rows: spoil(rows, 3, claims=("eq-1",), reason="names")),
    ("not in the closed list", lambda rows: spoil(rows, 3, claims=(), reason="obvious")),
    ("takes nothing after it", lambda rows: spoil(rows, 3, claims=(), reason="names 2.2-s01")),
    ("needs the key", lambda rows: spoil(rows, 3, claims=(), reason="part-of")),
    ("needs the key", lambda rows: spoil(rows, 3, claims=(), reason="repeats 9.9-s01")),
    ("has no claims either", lambda rows: spoil(rows, 3, claims=(), reason="repeats 2.2-s01")),
    ("comes later", lambda rows: spoil(rows, 3, claims=(), reason="repeats B.4-d01")),
    ("named twice", lambda rows: spoil(rows, 3, claims=("eq-1", "eq-1"), reason="")),
    ("does not stand for the kind", lambda rows: spoil(rows, 3, kind="display")),
    ("does not stand for the kind", lambda rows: spoil(rows, 3, kind="theorem")),
    ("is no key", lambda rows: spoil(rows, 3, key="here")),
    ("is number 4", lambda rows: spoil(rows, 3, key="2.2-s09")),
    ("comes after line", lambda rows: spoil(rows, 3, line=1)),
    ("is number", lambda rows: rows[:3] + rows[4:]),
    ("is number", lambda rows: rows[:4] + rows[3:]),
    ("already closed", lambda rows: [*rows, rows[index_of(rows, "3.2-d01")]]),
    ("no rows", lambda rows: []),
]


@pytest.mark.parametrize("message, spoiled", SPOILED, ids=range(len(SPOILED)))
def test_a_spoiled_ledger_is_refused(
    rows: Rows, message: str, spoiled: Callable[[Rows], Rows]
) -> None:
    with pytest.raises(LedgerError, match=message) as refusal:
        check_rows(spoiled(rows))
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("old, new, message", [
    ("\n", "", "columns"),
    ("line\t", "", "must name the columns"),
    ("\t103\t", "\t1O3\t", "no line number"),
    ("\tsentence\t", "\tsentence\tx", "no digest"),
    ("s2.2.1-B1 ", "s2.2.1-B1  ", "single spaces"),
    ("heading\n", "\n", "neither claims nor a reason"),
])  # fmt: skip
def test_a_ledger_file_that_does_not_parse_is_refused(
    tmp_path: Path, old: str, new: str, message: str
) -> None:
    spoiled = tmp_path / "rows.tsv"
    spoiled.write_text(ROWS.read_text().replace(old, new, 1))
    with pytest.raises(LedgerError, match=message):
        load_ledger(spoiled)


def test_a_ledger_file_that_is_cut_short_is_refused(tmp_path: Path) -> None:
    spoiled = tmp_path / "rows.tsv"
    spoiled.write_text(ROWS.read_text()[:-1])
    with pytest.raises(LedgerError, match="cut short"):
        load_ledger(spoiled)


def test_claims_and_rows_must_name_each_other(rows: Rows) -> None:
    register = all_claims(rows) | set(UNPRINTED)
    check_claims(rows, register)
    with pytest.raises(LedgerError, match="no claim is called eq-1;"):
        check_claims(rows, register - {"eq-1"})
    with pytest.raises(LedgerError, match="the claim eq-99 stands in no row"):
        check_claims(rows, register | {"eq-99"})
    unprinted = min(UNPRINTED)
    with pytest.raises(LedgerError, match="listed as unprinted"):
        check_claims(spoil(rows, 3, claims=(unprinted,), reason=""), register)
