"""Every hypothesis of every certified statement is needed, or its presence is explained: the table
hypotheses.txt says which, and is right.

`make test` checks a fixed sample of the rows; with JUGGLEPROOF_MUTANTS=all (as CI sets it) every
counterexample is put to the checker and every hypothesis that is not needed is searched for again.
`python -m tests.proofs.paper.hypothesis_table` brings the table up to date.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from multiprocessing import get_context

from tests.proofs.paper.hypothesis_table import (
    LICENSES,
    NEEDED,
    NOT_NEEDED,
    REASONS,
    TABLE,
    UNDECIDED,
    Hypothesis,
    Row,
    Table,
    certified,
    checked,
    digest,
    given_reasons,
    hypotheses,
    is_meant,
    is_not_needed,
    is_refuted,
    read_table,
    search_need,
    with_reasons,
    write_table,
)

ALL = os.environ.get("JUGGLEPROOF_MUTANTS") == "all"
CHECKED, SEARCHED = (1, 1) if ALL else (6, 60)  # one row in so many
MOST_UNDECIDED = 0.05
STALE = "run `python -m tests.proofs.paper.hypothesis_table`"
SQUARE = "statement demo/square\nforall x y\ngiven x > 1 and y > 0\ngiven y != 2\nshow x^2/y > x/y"


@cache
def table() -> Table:
    return read_table(TABLE.read_text())


def rows() -> Iterator[tuple[str, str, Hypothesis, Row]]:
    """(statement, its text, hypothesis, what the table says); statements that differ in nothing but
    their name count once.
    """
    seen = set()
    for name, (mark, said) in table().items():
        if mark not in seen:
            seen.add(mark)
            yield from (
                (name, certified()[name], one, row)
                for one, row in zip(hypotheses(certified()[name]), said, strict=True)
            )


def some(share: int, *needs: str) -> list[tuple[str, str, Hypothesis, Row]]:
    """One row in so many of those with such a need; which ones depends on nothing but the texts."""
    return [
        one
        for one in rows()
        if one[3].need in needs
        and int(hashlib.sha256(f"{one[0]} {one[2].said}".encode()).hexdigest()[:8], 16) % share == 0
    ]


def is_as_checked(job: tuple[str, str, Hypothesis, Row]) -> bool:
    return checked(*job)


def is_as_searched(job: tuple[str, str, Hypothesis, Row]) -> bool:
    return is_not_needed(job[1], job[2])


def first_wrong(test: object, jobs: list[tuple[str, str, Hypothesis, Row]]) -> str:
    with ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("fork")) as pool:
        for right, (name, _, one, row) in zip(pool.map(test, jobs, chunksize=4), jobs):
            if not right:
                return f"{name}: {one.said}: not {row.need} {row.why}"
    return ""


def test_table_is_that_of_the_stored_statements_holds() -> None:
    assert [(name, mark) for name, (mark, _) in table().items()] == [
        (name, digest(text)) for name, text in certified().items()
    ], STALE
    for name, (_, said) in table().items():
        assert [row.said for row in said] == [one.said for one in hypotheses(certified()[name])], (
            f"{name}: {STALE}"
        )
    assert write_table(with_reasons(table())) == TABLE.read_text(), STALE


def test_hypotheses_are_needed_where_the_table_says_so_holds() -> None:
    jobs = some(CHECKED, NEEDED, LICENSES)
    assert len(jobs) > (1_000 if ALL else 150)
    assert not first_wrong(is_as_checked, jobs)


def test_hypotheses_are_not_needed_where_the_table_says_so_holds() -> None:
    jobs = some(SEARCHED, NOT_NEEDED)
    assert len(jobs) > (600 if ALL else 8)
    assert not first_wrong(is_as_searched, jobs)


def test_every_hypothesis_that_is_not_needed_is_explained_holds() -> None:
    loose = [
        f"{name}: {row.said}"
        for name, (_, said) in table().items()
        for row in said
        if row.need == NOT_NEEDED and row.why.partition(":")[0] not in REASONS
    ]
    assert not loose, (
        f"{len(loose)} hypotheses are not needed: remove them from their claims, or say why they"
        " stand there:\n" + "\n".join(loose)
    )


def test_few_are_undecided_holds() -> None:
    every = [row for _, said in table().values() for row in said]
    undecided = [row for row in every if row.need == UNDECIDED]
    assert len(undecided) <= MOST_UNDECIDED * len(every), f"{len(undecided)} of {len(every)}"


def test_every_given_reason_is_used_holds() -> None:
    idle = [
        key
        for key in given_reasons()
        if not any(
            row.need in (NOT_NEEDED, UNDECIDED) and is_meant(row.said, key[1])
            for row in table().get(key[0], ("", []))[1]
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
