"""The figures of simulations are what the scenes compute."""

from __future__ import annotations

import importlib.util
import math
from pathlib import Path

import pytest

from juggleproof.proofs.simulations import figures as module
from juggleproof.proofs.simulations.compute import (
    ALPHAS,
    figure_two,
    onsets,
    still_table,
    time_to_region,
)
from juggleproof.proofs.simulations.figures import Figures, figures
from juggleproof.scenes.part.onsets import table_one
from juggleproof.scenes.part.readings import TableReading, chosen, recorded
from juggleproof.statements.language import ClaimError
from tests.judging.loading import loaded_anew

ENSEMBLES = 4  # of the 24 that are kept


@pytest.fixture(scope="module")
def kept() -> Figures:
    return figures()


@pytest.fixture(scope="module")
def reading(kept: Figures) -> TableReading:
    if importlib.util.find_spec("numba") is None:
        pytest.skip("numba is not installed; the extra part has it")
    assert TableReading(**kept["reading"]) == chosen(recorded()).reading
    return TableReading(**kept["reading"])


def test_times_to_the_region_are_exact_holds(kept: Figures) -> None:
    assert [time_to_region(alpha) for alpha in ALPHAS] == kept["region"]
    assert all(one["greatest"] <= 1 for one in kept["region"])  # (26) is a bound


def test_the_still_table_parts_the_blocks_where_it_did_holds(
    kept: Figures, reading: TableReading
) -> None:
    now = still_table(reading.scene())
    assert (now["upright"], now["lying"]) == (kept["still"]["upright"], kept["still"]["lying"])
    assert now["between"] == pytest.approx(kept["still"]["between"], abs=1e-8)


def test_figure_2_is_within_its_scatter_holds(kept: Figures, reading: TableReading) -> None:
    now, then = figure_two(reading, ENSEMBLES), kept["frame"]
    for name in ("upright", "apart"):
        low, high = min(then[name]), max(then[name])
        assert low - 4 <= min(now[name]) and max(now[name]) <= high + 4
    assert max(now["late"]) <= max(then["late"]) + 4


@pytest.mark.exhaust
def test_table_1_is_within_its_scatter_holds(kept: Figures, reading: TableReading) -> None:
    now = onsets(table_one(reading.scene(), ensembles=ENSEMBLES, peak=reading.peak))
    for row, then in zip(now, kept["table"], strict=True):
        same = ("frequency", "amplitude", "paper")
        assert [row[name] for name in same] == [then[name] for name in same]
        for name in ("chaotic", "censored"):
            assert abs(row[name] - ENSEMBLES * then[name] / kept["ensembles"]) <= 2
        low, median, high = (
            math.inf if onset is None else onset
            for onset in (then["low"], row["median"], then["high"])
        )
        assert low <= median <= high


def test_reading_the_figures_loads_no_scene_holds() -> None:
    loaded = loaded_anew()
    assert "juggleproof.proofs.simulations.figures" in loaded.modules
    assert not [name for name in loaded.modules if name == "numba" or "scenes.part" in name]


@pytest.mark.parametrize("text", [None, "", "{"])
def test_rejects_figures_that_cannot_be_read(
    text: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record = tmp_path / "figures.json"
    if text is not None:
        record.write_text(text)
    monkeypatch.setattr(module, "RECORD", record)
    figures.cache_clear()
    with pytest.raises(ClaimError, match=r"figures\.json: \w+; restore it"):
        figures()
    figures.cache_clear()
