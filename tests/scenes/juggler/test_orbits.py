"""Orbits in four arithmetics, and what is between their samples."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from flint import arb
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler import boundary, grid, listed, orbit, physical, point, random, scene
from juggleproof.scenes.juggler.bounded import RADIUS, radius_of
from juggleproof.scenes.juggler.compiled_map import formulas, region
from juggleproof.scenes.juggler.exact import as_fraction, flight
from juggleproof.scenes.juggler.orbits import OrbitRow, heights
from juggleproof.scenes.juggler.tables import in_units
from tests.rows import each_row

# -------------------------------------------------------------------------------------------------
# Four arithmetics, one orbit: exact, in balls, with digits, and in bounded floats.

alphas = st.fractions(Fraction(1, 50), Fraction(49, 50), max_denominator=50)
positions = st.fractions(0, 40, max_denominator=40)
speeds = st.fractions(-12, 12, max_denominator=40)
steps = st.integers(0, 40)


def holds(ball: OrbitRow, exact: OrbitRow) -> bool:
    return encloses(ball.x, exact.x) and encloses(ball.w, exact.w)


def encloses(ball: arb, exact: Fraction) -> bool:
    return abs(as_fraction(ball.mid().fmpq()) - exact) <= radius_of(ball)


def bound_holds(fast: OrbitRow, exact: OrbitRow) -> bool:
    assert fast.error is not None
    return abs(Fraction(fast.x) - exact.x) <= Fraction(fast.error[0]) and abs(
        Fraction(fast.w) - exact.w
    ) <= Fraction(fast.error[1])


@given(alpha=alphas, x=positions, w=speeds, count=steps, impacts=st.booleans())
def test_all_arithmetics_agree_with_exact_numbers_holds(
    alpha: Fraction, x: Fraction, w: Fraction, count: int, impacts: bool
) -> None:
    setting = scene(alpha, point(x, w))
    exact = orbit(setting, "exact", count, impacts=impacts).row(0)
    enclosed = orbit(setting, "enclosed", count, impacts=impacts)
    balls = enclosed.row(0)
    assert (balls.periods, balls.impacts, balls.end) == (
        exact.periods,
        exact.impacts,
        "reached",
    ) and holds(balls, exact)
    assert balls.error is not None and max(balls.error) <= RADIUS
    fast = orbit(setting, "fast", count, impacts=impacts).row(0)
    assert fast.end in ("reached", "undecided")
    if fast.end == "reached":
        assert (fast.periods, fast.impacts) == (exact.periods, exact.impacts) and bound_holds(
            fast, exact
        )
    else:  # where it stopped it was right, too
        stopped = orbit(setting, "exact", fast.periods).row(0)
        assert stopped.impacts == fast.impacts and bound_holds(fast, stopped)
    digits = orbit(setting, "mp", count, impacts=impacts, precision=60).row(0)
    assert (
        enclosed.tracks[0].edges == orbit(setting, "exact", count, impacts=impacts).tracks[0].edges
    )
    if not enclosed.tracks[0].edges:  # rounded numbers may err on x = w
        assert digits.periods == exact.periods and abs(
            Fraction(str(digits.x)) - exact.x
        ) < Fraction(1, 10**40)


@given(alpha=alphas, x=positions, w=speeds, count=st.integers(0, 12))
def test_whole_flights_and_leaps_equal_single_steps_holds(
    alpha: Fraction, x: Fraction, w: Fraction, count: int
) -> None:
    setting = scene(alpha, point(x, w))
    for arithmetic in ("exact", "enclosed", "fast"):
        by_impacts = orbit(setting, arithmetic, count, impacts=True)
        at = by_impacts.row(0)
        single = orbit(setting, arithmetic, at.periods, keep=True)
        if at.end != "reached" or single.row(0).end != "reached":
            assert arithmetic == "fast"
            continue
        kept = single.history(0)
        assert len(kept) == at.periods + 1
        if arithmetic == "exact":
            assert (kept[-1].x, kept[-1].w) == (at.x, at.w) and kept[-1].impacts == at.impacts
        elif arithmetic == "enclosed":
            assert kept[-1].x.overlaps(at.x) and kept[-1].w.overlaps(at.w)
        else:
            assert kept[-1].error is not None and at.error is not None
            assert abs(kept[-1].x - at.x) <= 1.01 * (kept[-1].error[0] + at.error[0]) + 1e-300


@pytest.mark.exhaust
def test_enclosed_orbits_of_a_million_steps_holds() -> None:
    rows = [
        orbit(scene(alpha, point(x, w)), "enclosed", 10**6).row(0)
        for alpha, x, w in (("3/10", 1000, -41), ("1/2", 3, -2), ("9/10", 0, "1/10"))
    ]
    for row in rows:
        assert (
            (row.end, row.periods) == ("reached", 10**6)
            and row.error is not None
            and max(row.error) <= RADIUS
        )
    whole = rows[0]
    exact = orbit(scene("3/10", point(1000, -41)), "exact", 10**6).row(0)
    assert holds(whole, exact) and (whole.periods, whole.impacts) == (10**6, exact.impacts)
    far = orbit(scene("3/10", point(1000, -41)), "enclosed", 10**18).row(0)
    assert far.periods == 10**18 and far.x.overlaps(arb(60) / 169)


def test_energies_from_tiny_to_huge_hold() -> None:
    for power in (-300, -30, 0, 30, 300):
        setting = scene("3/10", point(Fraction(10) ** power / 2, 1))
        exact, balls = (
            orbit(setting, kind, 4, impacts=True).row(0) for kind in ("exact", "enclosed")
        )
        assert balls.end == "reached" and balls.periods == exact.periods and holds(balls, exact)
    assert exact.periods > 10**150


@given(alpha=alphas, w=st.fractions(-6, 6, max_denominator=6), flown=st.integers(0, 9), count=steps)
def test_every_state_on_the_edge_is_counted_holds(
    alpha: Fraction, w: Fraction, flown: int, count: int
) -> None:
    x, w = flight(w, w, -flown)  # on x = w after so many periods, if they are flown
    if x < 0:
        return
    setting = scene(alpha, point(x, w))
    kept = orbit(setting, "exact", count, keep=True)
    here = sum(
        row.x == row.w for row in kept.history(0)[:-1]
    )  # the last state is not asked for its branch
    assert (
        here
        == kept.tracks[0].edges
        == orbit(setting, "exact", count).tracks[0].edges
        == orbit(setting, "enclosed", count).tracks[0].edges
    )


def test_states_on_the_edge_are_proved_to_be_there_holds() -> None:
    found = orbit(scene("1/3", point(0, 3)), "enclosed", 1000)
    assert found.tracks[0].edges == 500 and (found.row(0).x, found.row(0).w) == (0, 3)
    beside = orbit(scene(Fraction(1, 3) - Fraction(1, 10**300), point(0, 3)), "enclosed", 1000)
    assert (
        beside.tracks[0].edges == 0 and abs(float(beside.row(0).x) - 0.375) < 1e-12
    )  # e_1, not e_2
    # The margin is 10^-3000: far more bits than one begins with, and no edge.
    close = orbit(scene("1/2", point(1 - Fraction(1, 10**3000), 1)), "enclosed", 1, precision=2)
    assert close.tracks[0].edges == 0 and close.row(0).impacts == 1


def test_exact_numbers_that_grow_too_long_end_the_orbit_holds() -> None:
    found = orbit(scene("97/100", point(1, -4)), "exact", 2000, most_bits=1000).row(0)
    assert found.end == "too long" and 0 < found.periods < 2000
    assert orbit(scene("97/100", point(1, -4)), "exact", found.periods).row(0)[1:5] == found[1:5]
    leap = orbit(scene("3/10", point(0, 1)), "exact", 10**18).row(0)
    assert leap.end == "too long" and leap.periods == 0
    short = orbit(scene("97/100", point(1, -4)), "enclosed", 10**4, most_bits=128)
    assert short.row(0).end in ("undecided", "reached") and all(
        period <= 10**4 for _, period in short.undecided
    )


def test_the_trap_ends_an_orbit_where_it_is_entered_holds() -> None:
    for kind in ("exact", "enclosed", "mp", "fast"):
        row = orbit(scene("3/10", point(1000, -41)), kind, 1000, impacts=True, until_trap=True).row(
            0
        )
        assert (row.end, row.periods, row.impacts) == ("trap", 87, 3)
    never = orbit(scene("1/3", point(0, 3)), "exact", 50, impacts=True, until_trap=True).row(0)
    assert never.end == "reached" and never.impacts == 50


def test_boundary_of_the_region_holds() -> None:
    alpha = Fraction(2, 7)
    starts = boundary(alpha, 11)
    level = region()(alpha)
    for index in range(starts.count):
        x, w = starts.exact(index)
        assert x >= 0 and (
            formulas().energy(x, w) == level or (x == 0 and formulas().energy(x, w) < level)
        )
    assert sum(formulas().energy(*starts.exact(index)) == level for index in range(11)) == 6


def test_physical_units_are_the_same_orbit_holds() -> None:
    r, g = Fraction(3), Fraction(49, 5)
    setting = scene("3/10", physical(2, "-1/2", r, g), r, g)
    exact = orbit(setting, "exact", 7)
    there = in_units(exact, exact.row(0), "physical")
    assert formulas().scaled(there.x, there.w, r, g) == (exact.row(0).x, exact.row(0).w)
    for kind in ("enclosed", "fast", "mp"):
        other = orbit(setting, kind, 7)
        row = in_units(other, other.row(0), "physical")
        if kind == "enclosed":
            assert holds(row, there)
        elif kind == "fast":
            assert bound_holds(row, there)
        else:
            assert abs(Fraction(str(row.x)) - there.x) < Fraction(1, 10**40)


@settings(max_examples=20, deadline=None)
@given(data=st.data(), low=st.integers(0, 39), size=st.integers(1, 40))
def test_starts_are_the_same_in_every_block_holds(data: st.DataObject, low: int, size: int) -> None:
    starts = data.draw(
        st.sampled_from(
            [
                random(40, 7),
                grid((0, "10/3", 8), (-1, "1/7", 5)),
                listed([(k, -k) for k in range(40)]),
            ]
        )
    )
    high = min(low + size, 40)
    assume(low < high)
    whole, part = starts.block(0, 40), starts.block(low, high)
    assert all(np.array_equal(one[low:high], other) for one, other in zip(whole, part))
    for index in range(low, high):
        x, w = starts.exact(index)
        assert abs(Fraction(float(whole[0][index])) - x) <= Fraction(float(whole[2][index]))
        assert (
            abs(Fraction(float(whole[1][index])) - w) <= Fraction(float(whole[3][index])) and x >= 0
        )


@each_row("kind", ["exact", "enclosed", "mp", "fast"])
def test_no_steps_leave_the_start_holds(kind: str) -> None:
    row = orbit(scene("1/3", point("1/2", "-1/4")), kind, 0).row(0)
    assert (float(row.x), float(row.w), row.periods, row.end) == (
        0.5,
        -0.25,
        0,
        "reached",
    ) and math.isfinite(float(row.x))


# -------------------------------------------------------------------------------------------------
# Between samples the ball meets the table only where it is struck, and samples are the map's.

restitutions = st.fractions(Fraction(1, 20), Fraction(19, 20), max_denominator=20)


@given(
    alpha=restitutions,
    x=st.fractions(0, 9, max_denominator=9),
    w=st.fractions(-4, 4, max_denominator=9),
    r=st.fractions(Fraction(1, 3), 4, max_denominator=3),
    g=st.fractions(Fraction(1, 3), 10, max_denominator=3),
)
def test_samples_are_the_map_and_the_ball_stays_above_the_table_holds(
    alpha: Fraction, x: Fraction, w: Fraction, r: Fraction, g: Fraction
) -> None:
    setting, length = scene(alpha, point(x, w), r, g), 2 * r / g
    found = heights(setting, [length * Fraction(k, 7) for k in range(5 * 7 + 1)])
    kept = orbit(setting, "exact", 5, keep=True)
    for row in kept.history(0):
        here = found[7 * row.periods]
        assert (here.ball, here.table) == (in_units(kept, row, "physical").x, 0)
    assert all(one.ball >= one.table >= 0 for one in found)


def test_ball_and_table_meet_at_an_impact_holds() -> None:
    # x = 1/2, w = 2 at r = 1, g = 2 (so that T = 1): the table strikes at x/w = 1/4.
    one = heights(scene("1/3", point("1/2", 2), 1, 2), ["1/4"])[0]
    assert one.ball == one.table == Fraction(3, 16)


def test_rejects_times_before_the_start() -> None:
    setting = scene("1/3", point(0, 3))
    for wrong, reason in (
        (-1, "before the start"),
        (float("nan"), "no finite number"),
        ("x", "no finite number"),
    ):
        with pytest.raises(SceneError, match=reason):
            heights(setting, [wrong])
    with pytest.raises(SceneError, match="impacts"):
        heights(setting, [10**9])
