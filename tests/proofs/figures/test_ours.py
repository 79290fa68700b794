"""Our figures: the trap with ranks and orbits, and the ranges."""

from __future__ import annotations

from fractions import Fraction

import pytest
from sympy import Rational, sqrt

from juggleproof import symbolic
from juggleproof.proofs.figures.certified import what_the_trap_shows
from juggleproof.proofs.figures.ours import (
    LEVELS,
    MOST_NAMED,
    STARTS,
    TICKS,
    Row,
    footnote,
    grouped,
    inside,
    names,
    normal_step,
    orbit_into,
    rank_level,
    sides,
    verdicts,
)
from juggleproof.symbolic.algebra import alpha, w, x
from tests.proofs.figures.drawn import ROWS, figure, points

# -------------------------------------------------------------------------------------------------
# The trap, the rank's levels and the orbits of their figure are exact.

RANK, (ROOT, SQUARE), TRAP = what_the_trap_shows()
QUARTER = {alpha: Rational(1, 4)}


def rank(at: tuple[float, float]) -> float:
    place = {x: at[0], w: at[1]}
    return float(RANK.subs(ROOT, sqrt(SQUARE)).subs(place))


def test_levels_have_their_rank_holds() -> None:
    for level in LEVELS:
        for place in points("fig-trap", f"rank-{level}"):
            assert rank(place) == pytest.approx(level) and place[0] > -1e-9


def test_orbits_are_those_of_the_derived_map_and_end_in_the_trap_holds() -> None:
    for start in STARTS:
        orbit = orbit_into(TRAP, start)
        for here, there in zip(orbit, orbit[1:]):
            place = {x: Rational(here[0]), w: Rational(here[1]), **QUARTER}
            branch = (
                symbolic.normal_f1()
                if symbolic.normal_margin().subs(place) > 0
                else symbolic.normal_f2()
            )
            assert tuple(entry.subs(place) for entry in branch) == tuple(map(Rational, there))
            assert not inside(TRAP, *here) and here[0] >= 0
        assert inside(TRAP, *orbit[-1]) and inside(TRAP, *normal_step(*orbit[-1]))


def test_sides_bound_the_trap_holds() -> None:
    corners = {start for start, _, _ in sides(TRAP)}
    assert corners == {
        (Fraction(0), Fraction(0)),
        (Fraction(4), Fraction(4)),
        (Fraction(0), Fraction(4)),
    }
    assert {(start, stop): left_out for start, stop, left_out in sides(TRAP)} == {
        ((0, 0), (4, 4)): True,
        ((4, 4), (0, 4)): True,
        ((0, 4), (0, 0)): False,
    }
    middle = [sum(corner[k] for corner in corners) / 3 for k in (0, 1)]
    assert (
        inside(TRAP, *middle)
        and not inside(TRAP, Fraction(1), Fraction(1))
        and inside(TRAP, Fraction(0), Fraction(1))
    )


def test_orbit_fails_without_a_trap_to_fall_into() -> None:
    with pytest.raises(ValueError, match="not in the trap"):
        orbit_into([(x - 100, True)], STARTS[0])


def test_rejects_a_rank_whose_root_would_be_negative() -> None:
    with pytest.raises(ValueError, match="negative"):
        rank_level(-2 * ROOT + (1 - w) / 2, ROOT, SQUARE, 3)


def test_rejects_what_is_no_parabola() -> None:
    with pytest.raises(ValueError, match="not a parabola"):
        rank_level(ROOT + w**2, ROOT, SQUARE, 3)


# -------------------------------------------------------------------------------------------------
# The figure of ranges shows every row: in a bar, or in its footnote.

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
