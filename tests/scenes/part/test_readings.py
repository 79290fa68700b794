"""The likelihood of a print is that of its definition; a reading is given up only where it is sure
to be unlikely; the stored search is what its seeds give.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import readings
from juggleproof.scenes.part.onsets import PAPER, OnsetRow, table_one
from juggleproof.scenes.part.readings import (
    BANDWIDTH,
    DIGIT,
    ONSETS,
    AlikeReadings,
    ReadingOutcome,
    SimulatedReading,
    TableReading,
    as_good,
    as_json,
    by_rules,
    chosen,
    finals,
    likelihood,
    most_likely,
    most_likely_point,
    nearer,
    point,
    read,
    recorded,
    row_likelihood,
    screened,
    sweep,
    watched,
)
from tests.rows import each_row

LIKELY = TableReading("2x4", "peak-to-peak", -90, -90, 0.875, 0.92)
HORIZON = 12.0


def row(paper: float | None, onsets: Sequence[float], chaotic: int = 0) -> OnsetRow:
    turning = (True,) * chaotic + (False,) * (len(onsets) - chaotic)
    return OnsetRow(30.0, 1e-3, paper, np.array(onsets), turning, HORIZON)


# -------------------------------------------------------------------------------------------------
# Likelihood.


def test_likelihood_is_a_distribution_over_what_could_be_printed_holds() -> None:
    """Over all onsets and "chaotic" it sums to 1, but for the ensembles that are censored."""
    onsets = [2.0, 2.5, 4.0, math.inf, math.inf]  # the fourth is chaotic, the fifth censored
    turning = (False, False, False, True, False)
    grid = np.linspace(math.log(DIGIT), math.log(HORIZON), 4001)

    def of(paper: float | None) -> float:
        return math.exp(
            row_likelihood(OnsetRow(30.0, 1e-3, paper, np.array(onsets), turning, HORIZON))
        )

    density = [of(math.exp(one)) for one in grid]
    total = float(np.trapezoid(density, grid)) + of(None)
    assert total == pytest.approx(1 - 1 / 6, abs=1e-6)


def test_likelihood_falls_with_the_distance_of_the_print_holds() -> None:
    told = [row_likelihood(row(paper, [3.0] * 24)) for paper in (3.0, 3.3, 4.0, 6.0, 11.0)]
    assert told == sorted(told, reverse=True) and told[0] == most_likely(3.0, 24, HORIZON)
    peak = (24 / (BANDWIDTH * math.sqrt(2 * math.pi)) + 0.5 / math.log(120)) / 25
    assert told[0] == pytest.approx(math.log(peak))


def test_no_run_that_is_chaotic_does_not_make_the_print_impossible_holds() -> None:
    never, always = row(None, [3.0] * 24), row(None, [math.inf] * 24, 24)
    assert row_likelihood(never) == pytest.approx(math.log(0.5 / 25))
    assert row_likelihood(always) == most_likely(None, 24, HORIZON) == math.log(24.5 / 25)
    unsettled = row_likelihood(row(4.0, [math.inf] * 24, 24))
    assert unsettled == pytest.approx(math.log(0.5 / math.log(120) / 25))


def test_likelihood_of_a_table_is_the_product_of_its_rows_holds() -> None:
    rows = [row(4.0, [3.0, 4.0]), row(None, [math.inf, 2.0], 1)]
    assert likelihood(rows) == pytest.approx(sum(map(row_likelihood, rows)))


def test_onsets_by_the_three_rules_holds() -> None:
    last = OnsetRow(30.0, 1e-3, 2.1, np.array([3.0, np.inf, np.inf]), (False, True, True), HORIZON)
    by_last, first, stopped = by_rules(last, np.array([2.0, 2.5, np.inf]))
    assert by_last is last
    assert first.onsets.tolist() == [2.0, math.inf, math.inf] and first.chaotic == last.chaotic
    assert stopped.onsets.tolist() == [2.0, 2.5, math.inf]
    assert stopped.chaotic == (False, False, True)


# -------------------------------------------------------------------------------------------------
# Readings.


def test_the_table_starts_at_its_lowest_where_both_phases_are_minus_90_holds() -> None:
    setting = LIKELY.scene(f_x=30.0, A_x=5e-4)
    assert (setting.phase_x, setting.phase_y) == (-math.pi / 2, -math.pi / 2)
    assert (setting.a, setting.b, setting.A_y) == (0.01, 0.02, 1e-4)


def test_the_first_time_is_before_the_last_holds() -> None:
    pytest.importorskip("numba")
    setting = TableReading("2x4", "peak", 0, 0, 0.7, 0.06).scene(f_x=30.0, A_x=2e-3)
    notes, first = watched(setting, np.radians(np.arange(0.0, 91.0, 10.0)), 6.0)
    last = float(notes[:, readings.body.LAST_UPRIGHT].max())
    assert 0.1 <= first <= math.ceil(last * 10) / 10 + 0.1 < 6.0


def test_a_point_is_table_one_of_its_reading_holds() -> None:
    pytest.importorskip("numba")
    one = point(SimulatedReading(LIKELY, LIKELY.scene(), 1, 3, 1.0))
    table = table_one(LIKELY.scene(), ensembles=1, horizon=1.0, seed=3, peak=LIKELY.peak)
    assert one.likelihoods[0] == pytest.approx(likelihood(table.rows), abs=1e-3)
    assert one.chaotic == tuple(sum(row.chaotic) for row in table.rows)
    assert one.impacts == int(table.run.notes[:, readings.body.IMPACTS].sum())


def test_a_reading_is_given_up_only_where_it_is_sure_to_be_unlikely_holds() -> None:
    pytest.importorskip("numba")
    whole = point(SimulatedReading(LIKELY, LIKELY.scene(), 1, 3, 1.0))
    kept = point(SimulatedReading(LIKELY, LIKELY.scene(), 1, 3, 1.0, whole.likelihood - 1e-2))
    given_up = point(SimulatedReading(LIKELY, LIKELY.scene(), 1, 3, 1.0, whole.likelihood + 1e-2))
    assert kept == whole and not given_up.likelihoods and given_up.impacts <= whole.impacts
    assert given_up.likelihood == -math.inf


def test_a_sweep_does_not_depend_on_the_executor_holds() -> None:
    pytest.importorskip("numba")
    tasks = [SimulatedReading(LIKELY, LIKELY.scene(), 1, seed, 0.3) for seed in (1, 2)]
    with ThreadPoolExecutor(2) as executor:
        assert sweep(tasks, executor) == [point(task) for task in tasks]


@each_row(
    ("tasks", "reason"),
    [
        ([], "a sweep of 0 points is outside 1 .. 10000"),
        ([SimulatedReading(LIKELY, LIKELY.scene(), 1, 0, -1.0)], "horizon = -1 s is outside"),
        ([SimulatedReading(LIKELY, LIKELY.scene(), 1, 0, 0.01)], "horizon = 0.01 s is below 0.1 s"),
    ],
)
def test_rejects_a_sweep_that_makes_none(tasks: list[SimulatedReading], reason: str) -> None:
    with pytest.raises(SceneError, match=reason):
        sweep(tasks)


# -------------------------------------------------------------------------------------------------
# The stored search.


def test_the_stored_search_tried_all_that_is_screened_holds() -> None:
    tasks = screened()
    first, near, last = recorded()
    for done, tried in ((first, tasks), (near, nearer(first.points))):
        assert len({task.reading for task in tried}) == len(tried) == done.tried
        assert (done.ensembles, done.seed, done.horizon) == tried[0][2:5]
        assert {one.reading for one in done.points} <= {task.reading for task in tried}
    # one ensemble may give up what 24 find likely, as the page says
    dropped = {task.reading for task in tasks} - {one.reading for one in first.points}
    assert dropped & {one.reading for one in as_good(recorded())}
    kinds = {(one.face, one.amplitudes, one.phase_x, one.phase_y) for one, *_ in tasks}
    assert len(kinds) == 2 * 2 * 3 * 3
    followed = finals(near.points)
    assert [task.reading for task in followed] == [one.reading for one in last.points]
    assert (last.ensembles, last.seed, last.horizon) == followed[0][2:5]
    assert last.impacts == sum(one.impacts for one in last.points)


def test_the_reading_of_the_scene_is_not_told_from_the_most_likely_holds() -> None:
    best = most_likely_point(recorded())
    assert all(one.likelihood <= best.likelihood for one in recorded()[-1].points)
    assert chosen(recorded()).reading == LIKELY
    assert chosen(recorded()).likelihood > best.likelihood - readings.SCATTER
    (other,) = (one for one in recorded()[-1].points if one.reading == readings.STATED[1])
    assert other not in as_good(recorded())


def test_a_record_is_read_as_it_was_written_holds() -> None:
    text = readings.RECORD.read_text(encoding="utf-8")
    assert as_json(read(text)) == text


@pytest.mark.parametrize("text", [None, "", "{", "[]", "[{}]", '[{"points": [{}]}]'])
def test_rejects_a_record_that_cannot_be_read(
    text: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record = tmp_path / "sweep.json"
    if text is not None:
        record.write_text(text)
    monkeypatch.setattr(readings, "RECORD", record)
    recorded.cache_clear()
    with pytest.raises(SceneError, match=r"sweep\.json: the stored sweep cannot be read"):
        recorded()
    recorded.cache_clear()


def test_likeliest_are_those_within_scatter_holds() -> None:
    def at(e: float, lnl: float) -> ReadingOutcome:
        return ReadingOutcome(
            TableReading("2x4", "peak", 0, 0, e, 0.1), (), (), (), (lnl,) * len(ONSETS), 1
        )

    found = AlikeReadings(24, 2, 12.0, 3, 3, (at(0.5, -3.0), at(0.7, -1.9), at(0.8, -1.0)))
    assert most_likely_point([found]).reading.e == 0.8 and chosen([found]).reading.e == 0.7
    assert [one.reading.e for one in as_good([found])] == [0.7, 0.8]
    assert [task.reading.e for task in finals(found.points)] == [0.875, 0.7, 0.8, 0.7, 0.5]
    assert len(PAPER) == 6
