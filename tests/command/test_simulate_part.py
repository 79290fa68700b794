"""`juggleproof simulate part`: what it prints and writes, and one line for every wish that cannot
be carried out.
"""

from __future__ import annotations

import csv
import os
import re
import signal
import time
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from itertools import count
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from juggleproof.command import simulate_part
from juggleproof.command.main import run
from juggleproof.scenes.part import scene
from juggleproof.scenes.part.onsets import PAPER, OnsetRow, discrepancies
from juggleproof.scenes.part.readings import STATED, SimulatedReading, chosen, read, recorded
from juggleproof.scenes.part.resting import between, orientation
from tests.command.running import Done

pytest.importorskip("numba")
SMALL = ["simulate", "part", "--ensembles", "2", "--horizon", "0.05"]
SWEPT = [*SMALL, "--horizon", "0.1"]

FIGURE = ["--figure", "f.svg"]
ORIENTATION = ["--orientation", "--parts", "20"]
CLEAR = ["--clear", "0,2", "--sweep", "amplitude=0.5:1:2", "--parts", "20"]
READING = ["--e", "0.7", "--mu", "0.08", "--amplitudes", "peak", "--phase", "0"]
SHORT = [*SMALL, *READING, "--horizon", "0.2"]

BAD = [
    (["--mu", "-0.1"], "mu = -0.1 is below 0"),
    (["--mu", "4/3"], "mu = 1.33333 is not below 4/3: from there on a corner can jam"),
    (["--e", "-1e-9"], "e = -1e-09 is outside [0, 1]"),
    (["--e", "nan"], "e = 'nan' is no number"),
    (["--e", "one"], "e = 'one' is no number"),
    (["--face", "3x4"], "--face '3x4': choose from 2x4, 1x2, 1x4"),
    (["--amplitudes", "rms"], "--amplitudes 'rms': choose from peak, peak-to-peak"),
    (["--launch", "thrown"], "launch = 'thrown': choose 'rest' or 'table'"),
    ([*FIGURE, "--vibration", "30"], "--vibration '30' is not HERTZ:MILLIMETRES"),
    ([*FIGURE, "--vibration", "-3:1"], "f_x = -3 is below 0"),
    (["--vibration", "15:2"], "--vibration goes with --figure, --orientation or --clear"),
    ([*FIGURE, "--vibration", "15:2", "--along", "30:1"], "--vibration and --along do not go"),
    (["--jobs", "0"], "--jobs 0 is outside 1 .. 1024"),
    (["--phase", "90,"], "phase = '' is no number"),
    (["--phase", "0,north"], "phase = 'north' is no number"),
    (["--sweep", "e=0:1:2,mu=0:0:1"], "horizon = 0.05 s is below 0.1 s"),
    (["--sweep", "e=0:1:2"], "--sweep e: choose e and mu, or readings"),
    (
        ["--sweep", "frequency=1:2:2,mu=0:0:1"],
        "--sweep frequency, mu: choose e and mu, or readings",
    ),
    (["--sweep", "e=0:1:2,mu=0:1"], "--sweep mu: '0:1' is not FROM:TO:COUNT"),
    (["--sweep", "e=0:1:0,mu=0:1:2"], "a count of 0 is not a whole number from 1 to 1000"),
    (["--sweep", "e=0:1:2,mu=0:0:1", "--e", "0.5"], "--sweep takes e itself, not by --e"),
    (["--still", "--sweep", "e=0:1:2,mu=0:0:1"], "do not go together"),
    (["--still", "--keep", "done"], "--keep done goes with table I"),
    (["--keep", "/dev/null/done"], "no folder to keep chunks in"),
    (["-o", "table.svg"], "table.svg: the name is to end in .csv or .npz"),
    (["-o", "/dev/null/table.csv"], "cannot be written"),
    (["--shape", "0,0 4,0 4,2"], "--shape goes with --figure, --orientation or --clear"),
    ([*FIGURE, "--shape", "0,0 4 4,2"], "--shape: '4' is not X,Y"),
    ([*FIGURE, "--shape", "0,0 4,e 4,2"], "--shape: '4,e' is no corner"),
    ([*FIGURE, "--shape", "no such.txt"], "no such.txt: no such file"),
    ([*FIGURE, "--shape", "0,0 4,0 4,2", "--face", "2x4"], "--face and --shape do not go together"),
    ([*FIGURE, "--shape", "0,0 4,0 4,2", "--mu", "1.3"], "mu = 1.3 is not below 0.821426"),
    ([*FIGURE, "--along", "30"], "'30' is not HERTZ:MILLIMETRES[:DEGREES]"),
    ([*FIGURE, "--away", "30:4000"], "a harmonic of 2 m, 30 Hz and 0 rad is out of range"),
    (["--figure", "f.txt"], "f.txt: the name is to end in .svg or .pdf"),
    ([*ORIENTATION, "--check"], "--check goes with table I"),
    ([*ORIENTATION, "--still"], "do not go together; give one of them"),
    ([*ORIENTATION, "--keep", "done"], "--keep done goes with table I"),
    ([*ORIENTATION, "-o", "f.npz"], "f.npz: the name is to end in .csv or .svg"),
    ([*ORIENTATION, "-o", "/dev/null/f.csv"], "cannot be written"),
    (["--orientation", "--parts", "0"], "parts = 0 is outside"),
    (["--still", "--parts", "3"], "--parts goes with --orientation or --clear"),
    (["--orientation", "--angles", "90:0"], "angles from 90 to 0: give ends that grow"),
    (["--orientation", "--angles", "0:1:2"], "'0:1:2' is not FROM:TO, nor a list such as 0,30,90"),
    (["--orientation", "--angles", "up"], "--angles = 'up' is no number"),
    (["--orientation", "--horizon", "-1"], "time = -1 s is outside 0 .. 100000"),
    (["--clear", "0"], "--clear: over which drives? give --sweep amplitude=FROM:TO:COUNT"),
    (["--clear", "up", "--sweep", "amplitude=0:1:2"], "--clear 'up' is no list of faces such as"),
    (["--clear", "4", "--sweep", "amplitude=0:1:2"], "faces 4: choose from 0 to 3"),
    (["--clear", "0", "--sweep", "width=0:1:2"], "a sweep of width: choose 1 of e, mu, frequency"),
    (["--clear", "0", "--sweep", "e=0:1:2,e=0:1:2"], "e is given twice"),
    (["--clear", "0", "--sweep", "e=0:1:2", "--e", "0.5"], "--sweep takes e itself, not by --e"),
    (["--clear", "0", "--sweep", "frequency=-1:2:2"], "f_x = -1 is below 0"),
]


@pytest.mark.parametrize(("options", "reason"), BAD, ids=[" ".join(options) for options, _ in BAD])
def test_rejects_a_wish_that_cannot_be_carried_out(
    options: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([*SMALL, *options]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1 and reason in lines[0]


def test_figure_of_a_shape_on_a_table_of_harmonics_is_drawn_holds(tmp_path: Path) -> None:
    (tmp_path / "corners.txt").write_text("0,0\n3,0\n1,4\n")
    shape = ["--shape", str(tmp_path / "corners.txt"), "--mu", "0.3"]
    shape += ["--away", "60:0.2,120:0.05"]
    path = tmp_path / "f.svg"
    assert run(["simulate", "part", "--figure", str(path), *shape]) == 0
    path_data = path.read_text()
    groups = re.findall(r'id="fig-2-(?:lying|upright)-0".*?d="([^"]*)"', path_data, re.DOTALL)
    drawn = "".join(groups)
    assert (drawn.count("M"), drawn.count("L")) == (91, 3 * 91)  # triangles


def test_friction_is_bounded_by_the_shape_not_by_the_papers_block_holds(tmp_path: Path) -> None:
    hexagon = [*SMALL, "--figure", str(tmp_path / "f.svg"), "--shape", "0,0 2,0 3,2 2,4 0,4 -1,2"]
    assert run([*hexagon, "--mu", "1.4"]) == 0
    assert run([*hexagon, "--mu", "1.47"]) == 2


def test_table_is_told_with_what_it_assumes_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    written = {}
    for name in ("table.csv", "table.npz"):
        for jobs in "12":
            path = tmp_path / jobs / name
            path.parent.mkdir(exist_ok=True)
            assert run([*SMALL, "--check", "--jobs", jobs, "-o", str(path)]) == 0
            written[jobs, name] = path.read_bytes()
        assert written["1", name] == written["2", name]
    output = capsys.readouterr().out
    assert all(f"{f:g} Hz {1000 * a:g} mm" in output for f, a, _ in PAPER)
    assert all(
        word in output
        for word in ("given", "inferred", "chosen", "0 impulses that pull", "0 energy gained")
    )
    lines = list(csv.DictReader((tmp_path / "1" / "table.csv").open()))
    assert len(lines) == 12 and all(
        one["onset [s]"] == "" for one in lines
    )  # nothing settles in so short a run, and nothing is dropped
    assert all({one["censored"], one["chaotic"]} == {"0", "1"} for one in lines)
    arrays = np.load(tmp_path / "1" / "table.npz")
    assert (
        arrays["onset"].shape == (6, 2)
        and np.isinf(arrays["onset"]).all()
        and arrays["theta"].shape == (6, 2, 91)
    )


def test_sweep_is_recorded_and_the_most_likely_pair_told_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "sweep.json"
    assert run([*SWEPT, "--sweep", "e=0.6:0.8:2,mu=0:0.5:2", "-o", str(path)]) == 0
    (record,) = read(path.read_text())
    assert [(point.reading.e, point.reading.mu) for point in record.points] == [
        (0.6, 0.0),
        (0.6, 0.5),
        (0.8, 0.0),
        (0.8, 0.5),
    ]
    assert (record.ensembles, record.seed, record.horizon) == (2, 1, 0.1)
    best = max(record.points, key=lambda point: point.likelihood)
    output = capsys.readouterr().out
    assert f"e = {best.reading.e:g}, mu = {best.reading.mu:g}, onset by the" in output
    assert f"log-likelihood {best.likelihood:.2f}; " in output


def test_the_search_of_readings_is_written_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """All three stages, each cut to two readings and 0.1 s."""

    def cut(
        tasks: Callable[..., list[SimulatedReading]], seed: int
    ) -> Callable[..., list[SimulatedReading]]:
        return lambda *done: [
            SimulatedReading(*task[:2], 1, seed, 0.1) for task in tasks(*done)[:2]
        ]

    for seed, name in enumerate(("screened", "nearer", "finals")):
        monkeypatch.setattr(simulate_part, name, cut(getattr(simulate_part, name), seed))
    written = []
    for jobs in "12":
        path = tmp_path / f"{jobs}.json"
        assert run([*SMALL, "--jobs", jobs, "--sweep", "readings", "-o", str(path)]) == 0
        written.append(path.read_bytes())
        stages = read(path.read_text())
        assert [(one.seed, one.tried, len(one.points)) for one in stages] == [
            (seed, 2, 2) for seed in range(3)
        ]
        assert [one.reading for one in stages[2].points] == [*STATED]
        assert capsys.readouterr().out.count("2x4  peak") == 6
    assert written[0] == written[1]


def test_stored_sweep_gives_the_reading_of_the_scene_holds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    best = chosen(recorded()).reading
    assert run([*SMALL, "--ensembles", "1"]) == 0
    output = capsys.readouterr().out
    output = " ".join(output.split())
    for name, value in (
        ("restitution e", f"{best.e:g}"),
        ("friction mu", f"{best.mu:g}"),
        ("amplitudes", best.amplitudes),
        ("phases at the start", f"{best.phase_x:g} along, {best.phase_y:g} up, in degrees"),
    ):
        assert f"{name} {value} inferred a most likely reading of the stored search" in output


@pytest.mark.parametrize(
    ("phase", "told"), [("90", "90 along, 90 up"), ("-90,0", "-90 along, 0 up")]
)
def test_phase_turns_both_axes_holds(
    phase: str, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([*SMALL, "--ensembles", "1", f"--phase={phase}"]) == 0
    output = " ".join(capsys.readouterr().out.split())
    assert f"phases at the start {told}, in degrees chosen an option of this run" in output


def row(paper: float | None, onsets: list[float], chaotic: tuple[bool, ...]) -> OnsetRow:
    return OnsetRow(15.0, 2e-3, paper, np.array(onsets), chaotic, 12.0)


def test_difference_from_the_paper_is_told_holds() -> None:
    settled, wild = row(4.0, [3.0, 4.0, 5.0], (False,) * 3), row(None, [np.inf] * 3, (True,) * 3)
    late = row(2.0, [3.0, np.inf, np.inf], (False, False, True))
    assert discrepancies((settled, wild)) == []
    assert discrepancies((late,)) == ["15 Hz 2 mm: 2 s in the paper, outside of 3 to inf s"]
    assert discrepancies((row(None, [3.0] * 3, (False,) * 3),)) == [
        "15 Hz 2 mm: chaotic in the paper, 0 of 3 ensembles are chaotic here"
    ]
    assert discrepancies((row(4.0, [np.inf] * 3, (True,) * 3),)) == [
        "15 Hz 2 mm: 4 s in the paper, 3 of 3 ensembles are chaotic here"
    ]
    assert (late.censored(), wild.censored(), late.quantile(0.33), late.quantile(0.5)) == (
        1,
        0,
        3.0,
        np.inf,
    )


def test_still_table_is_told_holds(capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*SMALL, "--still", "--e", "0.7", "--mu", "0.08"]) == 0
    output = capsys.readouterr().out
    assert (
        "27 blocks, 0 to 26 degrees, end upright, and 64, 27 to 90 degrees, lie, as the paper says"
        in output
        and "26.56505117" in output
    )


@pytest.mark.parametrize("name", ["f.svg", "f.pdf"])
def test_pictures_are_written_holds(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    begins = {"svg": b"<?xml", "pdf": b"%PDF"}[name[2:]]
    assert run([*SMALL, "--figure", str(tmp_path / name), "--e", "0.7", "--mu", "0.08"]) == 0
    assert (tmp_path / name).read_bytes().startswith(
        begins
    ) and "written" in capsys.readouterr().out


@pytest.mark.parametrize("wish", [CLEAR, ORIENTATION])
def test_columns_and_pictures_are_written_holds(
    wish: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    for name in ("f.csv", "f.svg"):
        assert run([*SHORT, *wish, "-o", str(tmp_path / name)]) == 0
        assert f"{tmp_path / name}: " in capsys.readouterr().out
    rows = list(csv.reader((tmp_path / "f.csv").open()))
    assert len(rows) == (5 if wish == ORIENTATION else 3)
    assert {len(row) for row in rows} == {len(rows[0])}
    assert (tmp_path / "f.svg").read_bytes().startswith(b"<?xml")


def test_orientation_is_told_with_intervals_holds(capsys: pytest.CaptureFixture[str]) -> None:
    wish = ["--orientation", "--parts", "50", "--angles", "0:90", "--vibration", "15:2"]
    assert run([*SHORT, *wish]) == 0
    lines = capsys.readouterr().out.splitlines()
    block = scene(e=0.7, mu=0.08, f_x=15.0, A_x=2e-3)
    found = orientation(block, between(0, 90), parts=50, shaken=0.2)
    for face, line in enumerate(lines[2:6]):
        told = [float(one) for one in line.split()]
        assert told[0] == face and told[3] == found.counts[face]
        assert np.allclose(told[4:], found.share(face), rtol=1e-5)
    assert lines[6] == "low, high: 95 % for the probability of the face alone, after Wilson"


def test_the_least_drive_is_told_holds(capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*SHORT, *CLEAR, "--angles", "90"]) == 0
    assert (
        "amplitude 0.5 mm is the least of the grid that clears faces 0, 2, there and at all 1"
        in capsys.readouterr().out
    )


def run_interrupted(after: int, folder: Path, arguments: list[str]) -> None:
    """Runs the command in a child that hears Ctrl-C, whatever the shell does, and gets it after so
    many reports; ends the child.
    """
    signal.signal(signal.SIGINT, signal.default_int_handler)
    calls = count(1)
    line = simulate_part.part_tables.point  # of a sweep

    def report(*_: object) -> None:
        if next(calls) == after:
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(20)

    def point(one: Any) -> str:
        report()
        return line(one)

    simulate_part.progress = lambda: report
    simulate_part.part_tables.point = point
    with open(folder / "out", "w") as out, open(folder / "err", "w") as err:
        with redirect_stdout(out), redirect_stderr(err):
            code = run(arguments)
    os._exit(code)


def interrupted(folder: Path, after: int, *options: str) -> Done:
    child = get_context("fork").Process(
        target=run_interrupted, args=(after, folder, [*SMALL, *options])
    )
    child.start()
    child.join()
    texts = [(folder / name).read_text(encoding="utf-8") for name in ("out", "err")]
    return Done(child.exitcode or 0, *texts)


def test_an_interrupted_table_keeps_the_rows_that_are_done_holds(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    whole = tmp_path / "whole.csv"
    assert run([*SMALL, "-o", str(whole)]) == 0
    done = interrupted(tmp_path, 5, "-o", str(path))  # of 6 rows of 2 ensembles
    assert done.returncode == 130, done.stderr
    assert done.stderr == "juggleproof: interrupted; 2 of 6 rows are done\n"
    assert f"{path}: 2 rows of 2 ensembles written" in done.stdout
    assert "15 Hz 4 mm" in done.stdout and "30 Hz" not in done.stdout
    assert path.read_text().splitlines() == whole.read_text().splitlines()[:5]


def test_an_interrupt_before_the_first_row_writes_nothing_holds(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    done = interrupted(tmp_path, 1, "-o", str(path))
    assert done.returncode == 130 and not done.stdout and not path.exists()
    assert done.stderr == "juggleproof: interrupted; no file was written\n"


def test_an_interrupted_sweep_keeps_the_points_that_are_done_holds(tmp_path: Path) -> None:
    path = tmp_path / "sweep.json"
    grid = ["--sweep", "e=0.6:0.8:2,mu=0:0.5:2", "--horizon", "0.1"]
    done = interrupted(tmp_path, 3, *grid, "-o", str(path))
    assert done.returncode == 130
    assert done.stderr == "juggleproof: interrupted; 3 points are done\n"
    assert f"{path}: 3 points written" in done.stdout and "most likely" in done.stdout
    (record,) = read(path.read_text())
    assert [point.reading.mu for point in record.points] == [0.0, 0.5, 0.0]
