"""Basins: which share of the impacts tends to the bounce, where not every motion does."""

from __future__ import annotations

import random
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from juggleproof.certificates.checker import Work
from juggleproof.certificates.sine.cells import UNRANKED, WHOLE, read_levels
from juggleproof.certificates.sine.checker import (
    Certificate,
    check_folder,
    check_line,
    outcome,
    read_statement,
)
from juggleproof.command.main import run
from juggleproof.scenes.table.curves import gamma_of
from juggleproof.scenes.table.motion import Table, bounce_phase, flights_to_bounce
from juggleproof.sine.search import find_certificate, line_of
from tests.certificates.sine.states import STEPS

Q = Fraction
ALPHA, G = Q(3, 10), Q(13, 100)  # where another motion attracts too
CELLS = 6_000
PAIR = "for all alpha in [3/10, 3/10] and g in [13/100, 13/100]"
STABLE = "the period-one bounce is stable and"


@pytest.fixture(scope="module")
def basin() -> Certificate:
    found = find_certificate((ALPHA, ALPHA), (G, G), 256, 16, CELLS)
    assert found.certificate is not None and found.cells <= CELLS
    return found.certificate


def test_a_share_is_certified_and_no_more_holds(basin: Certificate) -> None:
    proves, _ = check_line(line_of(basin))
    assert proves is not None
    for share, word in (("1/8", "certified"), ("1/7", "unknown"), ("1", "unknown")):
        text = f"{STABLE} at least {share} of the impacts with closing speed below 6/5 tend to it"
        assert outcome(read_statement(f"{text} {PAIR}"), [proves])[0] == word
    whole = read_statement(f"{STABLE} every motion tends to it {PAIR}")
    assert outcome(whole, [proves])[0] == "unknown"


def test_states_of_ranked_cells_come_to_the_bounce_when_simulated_holds(
    basin: Certificate,
) -> None:
    source = random.Random(4)
    levels = read_levels(basin, Work(STEPS))
    cells = [
        (level.grid, i, row)
        for level in levels
        for i in level.cells
        for row in level.rows(i, WHOLE)
        if level.ranks[i][row] != UNRANKED
    ]
    drawn = [source.choice(cells) for _ in range(500)]
    phases = np.array([(i + source.random()) / grid.columns for grid, i, _ in drawn])
    speeds = np.array([(row + source.random()) / grid.per_unit for grid, _, row in drawn])
    table = Table(float(ALPHA), gamma_of(float(ALPHA), float(G)))
    phases = (phases + bounce_phase(table.alpha, table.gamma)) % 1
    counts = flights_to_bounce(table, phases, speeds, 200)
    assert ((counts >= 0) & (counts <= 200)).all()


def test_rejects_a_rank_for_any_cell_without_one(basin: Certificate) -> None:
    source = random.Random(5)
    places = [place for place, rank in enumerate(basin.ranks) if rank == UNRANKED]
    refused = 0
    for place in source.sample(places, 12):
        ranks = bytearray(basin.ranks)
        ranks[place] = UNRANKED - 1
        refused += check_line(line_of(basin._replace(ranks=bytes(ranks))))[0] is None
    # one could have a rank only where all its flights land in cells with ranks: the search gave it
    assert refused == 12


@pytest.mark.exhaust
def test_the_command_finds_a_share_for_a_pair(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = ["--alpha", "0.3", "--gamma", "1.8785", "--basin", "1"]
    asked = ["certify", "sine", *options, "--jobs", "1", "--store", str(tmp_path)]
    assert run([*asked, "--budget", "6000"]) == 0
    first, cells, shares, _ = capsys.readouterr().out.splitlines()
    ends = "for all alpha in [3/10, 3/10] and Gamma in [3757/2000, 3757/2000]"
    begins = f"certified: {STABLE} at least "
    assert first.startswith(begins) and first.endswith(f"below 1 tend to it {ends}")
    share = Q(first[len(begins) :].partition(" ")[0])
    assert Q(1, 10) < share < Q(19, 100)
    assert shares.startswith(f"certified: {float(share):.2%} of these impacts; simulated, at alpha")
    assert check_folder(str(tmp_path)) == [(first.partition(": ")[2], "certified", "")]
    assert run([*asked, "--budget", "6000"]) == 0
    again = capsys.readouterr().out.splitlines()
    assert again[0] == first and again[1].startswith("0 cells")
    assert run(["certify", "sine", *options[:4], "--store", str(tmp_path)]) == 1
    assert capsys.readouterr().out.startswith("refuted: ")  # the other bounce is one too


def test_an_unstable_bounce_has_no_basin(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = ["--alpha", "0.05", "--gamma", "3.5", "--basin", "--store", str(tmp_path)]
    assert run(["certify", "sine", *options]) == 1
    told = capsys.readouterr().out.splitlines()
    assert (
        told[0] == f"refuted: {STABLE[:-4]} for all alpha in [1/20, 1/20] and Gamma in [7/2, 7/2]"
    )
    assert "one of its multipliers is below -1" in told[1]
