"""What files may cost the second checker: all work is counted before it is done."""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest

from juggleproof.certificates.checker import Work
from juggleproof.certificates.sine import cells, checker
from juggleproof.certificates.sine.checker import CERTIFICATES, STATEMENTS
from juggleproof.certificates.sine.flights import MAX_CELLS, MAX_COLUMNS, Flights
from tests.certificates.sine.lines import refuting
from tests.certificates.sine.states import STEPS
from tests.rows import each_row

TRUE = (
    "the period-one bounce is stable and every motion tends to it for all alpha in [1/20, 1/20]"
    " and g in [1/5, 1/5]"
)


def boxed(
    columns: int, rows: int, ranks: bytes, packed: Callable[[bytes], bytes] | None = None
) -> str:
    """A line that certifies nothing, of cells of these ranks."""
    data = (packed or zlib.compress)(ranks)
    ends = {"alpha": ["1/20", "1/20"], "g": ["1/5", "1/5"], "grid": [columns, 1, rows]}
    rest = {"trap": [1, 1, 2, "1"], "arc": [0, 1], "ranks": base64.b64encode(data).decode()}
    return json.dumps({**ends, **rest})


def empty_blocks(_: bytes) -> bytes:
    """A stream of a million blocks with nothing in them."""
    return b"\x78\x9c" + b"\0\0\0\xff\xff" * 10**6


# (a hostile line, what is counted of it at least)
LINES: dict[str, tuple[str, int]] = {
    "long tables": (boxed(MAX_COLUMNS, 1, b"\1" * MAX_COLUMNS), 3 * MAX_COLUMNS),
    "long tables of a saddle": (
        refuting("saddle", "1/20", "1/5", MAX_COLUMNS, 128),
        2 * MAX_COLUMNS,
    ),
    "many cells": (boxed(MAX_COLUMNS, 64, b"\1" * MAX_CELLS), MAX_CELLS + 2 * MAX_COLUMNS),
    "cells that are cut twice": (
        boxed(1024, 16, b"\xff" * 2**14 + b"\xff" * 2**16 + b"\1" * 2**18),
        2**14 + 2**16 + 2**18 + 2 * (1024 + 2048 + 4096),
    ),
    "ranks of more cells": (boxed(16, 1, b"\1" * MAX_CELLS), 680),
    "blocks without ranks": (boxed(16, 1, b"", empty_blocks), 6_600_000 // 4),
    "many letters": ("[" * 10**6, 10**6 // 4),
    "many keys": ("{" + ",".join(f'"{k}":1' for k in range(10**5)) + "}", 240_000),
    "long numbers": ("[" + ("9" * 4000 + ",") * 1000 + "1]", 4 * 10**6 // 4),
}


@each_row("name", LINES)
def test_what_a_line_costs_is_counted_holds(name: str) -> None:
    line, least = LINES[name]
    work = Work(STEPS)
    assert checker.check_line(line, work)[0] is None
    assert least <= STEPS - work.left <= 2 * least + len(line)


@each_row("name", LINES)
def test_rejects_a_line_that_costs_more_than_is_left(name: str) -> None:
    line, least = LINES[name]
    assert checker.check_line(line, Work(min(least, 10 + len(line) // 4) - 1)) == (
        None,
        "too much work",
    )


@pytest.mark.exhaust
def test_no_table_is_made_that_is_not_paid_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of 300 boxes with the longest tables, where there is work for ten."""
    made: list[int] = []

    def counted(*given: object) -> Flights:
        made.append(1)
        return Flights(*given)  # type: ignore[arg-type]

    monkeypatch.setattr(cells, "Flights", counted)
    monkeypatch.setattr(cells, "absorbing_strip", lambda _: checker.require(False, "short"))
    line = boxed(MAX_COLUMNS, 1, b"\1" * MAX_COLUMNS)
    (tmp_path / STATEMENTS).write_text(f"{TRUE}\n")
    (tmp_path / CERTIFICATES).write_text(f"{line}\n" * 300)
    whole = Work(STEPS)
    checker.check_line(line, whole)
    made.clear()
    outcomes = checker.check_folder(str(tmp_path), 10 * (STEPS - whole.left))
    assert len(made) <= 11
    assert [why for _, _, why in outcomes] == ["short"] * 10 + ["too much work"] * 291


def test_lines_that_are_refused_are_read_up_to_a_thousand_holds(tmp_path: Path) -> None:
    (tmp_path / STATEMENTS).write_text(f"{TRUE}\n")
    (tmp_path / CERTIFICATES).write_text("\n" * 10**6)
    outcomes = checker.check_folder(str(tmp_path))
    assert len(outcomes) == checker.MAX_REFUSED + 2
    assert [word for _, word, _ in outcomes[-2:]] == ["rejected", "unknown"]


def test_shares_of_rows_are_counted_holds() -> None:
    """For each statement those of each box, before they are added up."""
    sides = (Fraction(1, 20),) * 2, (Fraction(1, 5),) * 2
    box = cells.Attraction(*sides, 1, (Fraction(1),) * 8192)
    work = Work(STEPS)
    assert checker.outcome(checker.read_statement(TRUE), [box] * 3, work) == ("certified", "")
    assert STEPS - work.left >= 3 * 8192
