"""Every hypothesis of every certified statement is needed, or its presence is explained.

What is marked searches the statements of a fixed sample of claims; with JUGGLEPROOF_MUTANTS=many
(make exhaust) all of them, and writes the table to build/hypotheses.txt. What is expected, the
counts and the names of what is undecided, `python -m tests.proofs.paper.hypothesis_table` brings up
to date.
"""

from __future__ import annotations

from functools import cache

import pytest

from tests.proofs.paper.hypothesis_table import (
    COUNTS,
    OPEN,
    REASONS,
    TABLE,
    Row,
    Table,
    cells,
    certified,
    checked,
    counts,
    given_reasons,
    is_meant,
    is_sampled,
    searched_table,
    undecided,
    write_table,
)
from tests.proofs.paper.search_needs import (
    LICENSES,
    NEEDED,
    NOT_NEEDED,
    UNDECIDED,
    hypotheses,
    is_not_needed,
    is_refuted,
    search_need,
)
from tests.share import MANY

SQUARE = "statement demo/square\nforall x y\ngiven x > 1 and y > 0\ngiven y != 2\nshow x^2/y > x/y"


@cache
def table() -> Table:
    made = searched_table(
        {name: text for name, text in certified().items() if MANY or is_sampled(name)}
    )
    if MANY:
        TABLE.parent.mkdir(exist_ok=True)
        TABLE.write_text(write_table(made), encoding="utf-8")
    return made


@pytest.mark.exhaust
def test_hypotheses_are_as_many_of_each_need_and_reason_as_expected_holds() -> None:
    column = 2 if MANY else 3
    expected = {(row[0], row[1]): int(row[column]) for row in cells(COUNTS)}
    assert counts(table()) == {key: count for key, count in expected.items() if count}
    assert sum(expected.values()) > (3_000 if MANY else 60)
    assert {why for _, why in expected} <= {"", *REASONS}


@pytest.mark.exhaust
def test_hypotheses_are_needed_where_the_table_says_so_holds() -> None:
    for name, (_, rows) in table().items():
        for one, row in zip(hypotheses(certified()[name]), rows, strict=True):
            assert row.said == one.said
            assert row.need not in (NEEDED, LICENSES) or checked(
                name, certified()[name], one, row
            ), f"{name}: {one.said}: not {row.need} {row.why}"


@pytest.mark.exhaust
def test_every_hypothesis_that_is_not_needed_is_explained_holds() -> None:
    loose = [
        f"{name}: {row.said}"
        for name, (_, rows) in table().items()
        for row in rows
        if row.need in (NOT_NEEDED, UNDECIDED) and row.why.partition(":")[0] not in REASONS
    ]
    assert not loose, (
        f"{len(loose)} hypotheses are not needed: remove them from their claims, or say why they"
        " stand there:\n" + "\n".join(loose)
    )


@pytest.mark.exhaust
def test_undecided_are_those_that_are_named_holds() -> None:
    known = {(name, said) for name, said in cells(OPEN)}
    assert undecided(table()) == {one for one in known if one[0] in table()}
    assert known == {one for one in known if one[0] in certified()} and len(known) < 25


@pytest.mark.exhaust
def test_every_given_reason_is_used_holds() -> None:
    idle = [
        key
        for key in given_reasons()
        if key[0] not in certified()
        or key[0] in table()
        and not any(
            row.need in (NOT_NEEDED, UNDECIDED) and is_meant(row.said, key[1])
            for row in table()[key[0]][1]
        )
    ]
    assert not idle, f"reasons for what is needed or gone: {idle}"


def test_search_tells_the_four_needs_apart_holds() -> None:
    needs = {one.said: search_need(SQUARE, one)[:2] for one in hypotheses(SQUARE)}
    assert needs == {"x > 1": (NEEDED, ""), "y > 0": (LICENSES, ""), "y != 2": (NOT_NEEDED, "")}


def test_search_finds_the_division_that_a_hypothesis_keeps_possible_holds() -> None:
    text = "statement demo/have\nforall x\ngiven x > 1\nhave x - 1 > 0\nshow 1/(x - 1) > 0"
    (one,) = hypotheses(text)
    need, fails, refutation = search_need(text, one)
    assert (need, fails) == (NEEDED, "x - 1 > 0")
    assert is_refuted("statement demo/have\nforall x\nshow x - 1 > 0", refutation)


def test_rejects_a_counterexample_that_is_none() -> None:
    first, *_ = hypotheses(SQUARE)
    assert checked("demo/square", SQUARE, first, Row("x > 1", NEEDED, "at x = 1/2, y = 1"))
    assert not checked(
        "demo/square", SQUARE, first, Row("x > 1", NEEDED, "at x = 2, y = 1")
    )  # what is shown holds there
    assert not checked(
        "demo/square", SQUARE, first, Row("x > 1", NEEDED, "at x = 1/2, y = 2")
    )  # another hypothesis fails there
    assert not checked("demo/square", SQUARE, first, Row("x > 1", LICENSES, ""))


def test_rejects_not_needed_of_what_is_needed() -> None:
    first, _, loose = hypotheses(SQUARE)
    assert is_not_needed(SQUARE, loose)
    assert not is_not_needed(SQUARE, first)
