"""The flight enclosure holds what an independent solver finds, and its numbers are as close as they
say.
"""

from __future__ import annotations

import pytest
from flint import arb, ctx

from juggleproof.certificates.checker import Rejected, Work
from juggleproof.certificates.sine import flights
from tests.certificates.sine import bounds, states
from tests.certificates.sine.bounds import broken_bounds, missed_zeros, roundings
from tests.certificates.sine.impacts import PRECISION
from tests.certificates.sine.states import CODE, STEPS, box, escapes
from tests.rows import each_row
from tests.share import share

SHARE = share(60, 2_500)  # of impacts, for each grid
GRIDS = range(len(states.GRIDS))
BOUNDED = range(len(bounds.GRIDS))


@each_row("grid", GRIDS)
def test_first_impacts_are_in_the_enclosure_holds(grid: int) -> None:
    looked, outside = escapes(CODE, states.GRIDS[grid], SHARE, seed=grid)
    assert looked >= SHARE and not outside


@each_row("grid", BOUNDED)
def test_bounds_hold_at_all_corners_of_cells_and_boxes(grid: int) -> None:
    assert not broken_bounds(CODE, bounds.GRIDS[grid], share(15, 100), seed=grid)


def test_walks_find_the_first_zero_of_a_known_height_holds() -> None:
    count = share(200, 4000)
    looked, missed = missed_zeros(CODE, count, seed=3)
    assert looked > count / 2 and not missed


@each_row("grid", GRIDS)
def test_roundings_stay_far_below_what_is_added_for_them_holds(grid: int) -> None:
    assert roundings(CODE, states.GRIDS[grid], 20, seed=grid) < 30 < 100 <= flights.SLACK / 2


@each_row("count", [32, 64, 16384])
def test_sines_are_within_a_unit_holds(count: int) -> None:
    ctx.prec = PRECISION
    table = flights.sines(count)
    assert len(table) == count
    for j, value in enumerate(table):
        sine = (arb(2 * j) / count).sin_pi() * flights.ONE
        assert abs(sine - value) < 1


def test_pi_is_within_512_units_and_twice_it_is_rounded_down_holds() -> None:
    ctx.prec = 200
    fine = flights.pi_times(1 << flights.FINE)
    assert abs(arb.pi() * arb(2) ** flights.FINE - fine) < 512
    assert arb(flights.PI2) < 2 * arb.pi() * flights.ONE < arb(flights.PI2 + 1)


def test_a_column_lands_as_its_rows_do_one_by_one_holds() -> None:
    grid = box("1/20", "197/1000", 64, 16, 22)
    there = flights.Flights(grid, Work(STEPS))
    for i in range(0, 64, 7):
        walk = flights.Walk(there, i)
        for row, landings in there.column(i, range(22)):
            alone = walk.landings(row, i)
            assert {m for m, _, _ in landings} <= {m for m, _, _ in alone}


def test_rejects_a_flight_that_is_too_long() -> None:
    there = flights.Flights(box("1/2", "1/5", 16, 1, 64), Work(STEPS))
    with pytest.raises(flights.Refused, match="a flight without an end"):
        flights.Walk(there, 0).landings(63, 0)


def test_rejects_a_cell_that_lands_nowhere() -> None:
    # the rows end far below the strip: what lands above them is not listed
    there = flights.Flights(box("1/2", "1/5", 64, 1024, 8), Work(STEPS))
    with pytest.raises(flights.Refused, match="a cell without a landing"):
        for i in range(64):
            list(there.column(i, range(8)))


def test_flights_within_a_period_land_faster_than_1_but_never_than_4_holds() -> None:
    # so that the rows of a saddle's flight have to go up to 4
    there = flights.Flights(box("1/2", "1", 32, 16, 64), Work(STEPS))
    lands = [one for i in range(32) for one in flights.Walk(there, i).landings(2, i) if one[0] < 33]
    assert max(lowest for _, lowest, _ in lands) >= 16
    assert max(highest for _, _, highest in lands) < 63


def test_work_runs_out_holds() -> None:
    there = flights.Flights(box("1/20", "197/1000", 64, 16, 22), Work(2 * 64 + 10))
    with pytest.raises(Rejected):
        list(there.column(0, range(22)))
