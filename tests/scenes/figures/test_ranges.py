"""The figure of ranges shows every row: in a bar, or in its footnote."""

from __future__ import annotations

from fractions import Fraction

import pytest

from juggleproof.scenes.figures.ours import (
    MOST_NAMED,
    TICKS,
    Row,
    footnote,
    grouped,
    names,
    verdicts,
)
from tests.scenes.figures.drawn import ROWS, figure, points

THIRD = (Fraction(0), Fraction(1, 3), False, False)


def test_rows_with_one_range_share_a_bar_holds() -> None:
    rows: list[Row] = [
        ("a", "holds", [THIRD]),
        ("b", "false", [THIRD]),
        ("c", "holds", []),
        ("d", "holds", None),
    ]
    groups = grouped(rows)
    assert [(ranges, [row[0] for row in of]) for ranges, of in groups] == [
        ((THIRD,), ["a", "b"]),
        ((), ["c"]),
    ]
    assert verdicts(groups[0]) == ["1 false, 1 holds"] and verdicts(groups[1]) == ["holds"]


def test_claims_are_named_or_counted_holds() -> None:
    few: list[Row] = [(f"claim {k}", "holds", [THIRD]) for k in range(3)]
    many: list[Row] = [(f"claim {k}", "holds", [THIRD]) for k in range(MOST_NAMED + 1)]
    assert " ".join(names(grouped(few)[0])) == "claim 0, claim 1, claim 2"
    assert names(grouped(many)[0]) == [f"{MOST_NAMED + 1} claims and readings"]


def test_what_is_not_drawn_is_said_holds() -> None:
    assert footnote([("d", "holds", None)], 2) == "2 claims do not speak of α. Not drawn: d."
    assert footnote([("a", "holds", [THIRD])], 0) == ""


def test_bars_have_their_ends_holds() -> None:
    assert [row[0] for _, of in grouped(ROWS) for row in of] == [
        "whole",
        "theorem",
        "at one",
        "empty",
    ]
    for index, (low, high) in enumerate([(0, 1), (0, 1 / 3), (0.12, 0.12)]):
        xs = [x for x, _ in points("fig-ranges", f"range-{index}")]
        assert min(xs) == pytest.approx(low, abs=0.02) and max(xs) == pytest.approx(high, abs=0.02)
    assert {x for x, _ in points("fig-ranges", "one-third")} == {1 / 3} and Fraction(1, 3) in TICKS


def test_open_and_closed_ends_are_told_apart_holds() -> None:
    from matplotlib.lines import Line2D

    faces = {
        one.get_gid(): one.get_markerfacecolor() for one in figure("fig-ranges").findobj(Line2D)
    }
    assert (
        faces["range-1-open"] == "none"
        and faces["range-2-closed"] != "none"
        and "range-1-closed" not in faces
    )
