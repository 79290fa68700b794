"""`juggleproof simulate part` for designers of feeders: what it prints and writes, and one line for
every wish that cannot be carried out.
"""

from __future__ import annotations

import csv
import os
import signal
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from juggleproof.command import simulate_feeder
from juggleproof.command.main import run
from juggleproof.scenes.part import scene
from juggleproof.scenes.part.resting import between, orientation

pytest.importorskip("numba")
READING = ["--e", "0.7", "--mu", "0.08", "--amplitudes", "peak", "--phase", "0"]
SMALL = ["simulate", "part", *READING, "--horizon", "0.2", "--ensembles", "1"]
TRAJECTORY = ["--trajectory", "--state", "theta=20", "--state", "theta=50,y=40,omega=90"]
MAP = ["--sweep", "frequency=15:60:2,amplitude=1:2:3"]
CLEAR = ["--clear", "0,2", "--sweep", "amplitude=0.5:1:2", "--parts", "20"]

BAD = [
    (["--trajectory"], "--trajectory: which parts? give --state theta=30, or --parts 5"),
    (["--trajectory", "--parts", "1001"], "--parts 1001 is outside 1 .. 1000"),
    (["--trajectory", "--parts", "0"], "parts = 0 is outside"),
    (["--trajectory", "--state", "x=1"], "has no theta; write theta=.., and x=..,y=.. (mm)"),
    (["--trajectory", "--state", "theta=1,z=2"], "'z=2' is no component of a state; write theta"),
    (["--trajectory", "--state", "theta=0,y=1"], "puts the lowest corner"),
    ([*TRAJECTORY, "--state", "theta=20"], "one start is given twice"),
    ([*TRAJECTORY, "--parts", "3"], "--state and --parts do not go together"),
    ([*TRAJECTORY, "--times", "0:1"], "--times: '0:1' is not FROM:TO:COUNT"),
    ([*TRAJECTORY, "--times", "0:1:1.5"], "a count of 1.5 is not a whole number from 1 to 1000000"),
    ([*TRAJECTORY, "--check"], "--check goes with table I"),
    ([*TRAJECTORY, "--orientation"], "do not go together; give one of them"),
    ([*TRAJECTORY, "--keep", "done"], "--keep done goes with table I"),
    ([*TRAJECTORY, "-o", "f.xls"], "f.xls: the name is to end in .csv, .npz, .parquet or .svg"),
    ([*TRAJECTORY, "-o", "/dev/null/f.csv"], "cannot be written"),
    (["--state", "theta=1"], "--state goes with --trajectory"),
    (["--still", "--parts", "3"], "--parts goes with --trajectory or --orientation or --clear"),
    (["--orientation", "--times", "0:1:2"], "--times goes with --trajectory"),
    (["--orientation", "--angles", "90:0"], "angles from 90 to 0: give ends that grow"),
    (["--orientation", "--angles", "0:1:2"], "'0:1:2' is not FROM:TO, nor a list such as 0,30,90"),
    (["--orientation", "--angles", "up"], "--angles = 'up' is no number"),
    (["--orientation", "--horizon", "-1"], "time = -1 s is outside 0 .. 100000"),
    (["--clear", "0"], "--clear: over which drives? give --sweep amplitude=FROM:TO:COUNT"),
    (["--clear", "up", "--sweep", "amplitude=0:1:2"], "--clear 'up' is no list of faces such as"),
    (["--clear", "4", "--sweep", "amplitude=0:1:2"], "faces 4: choose from 0 to 3"),
    (["--clear", "0", "--sweep", "width=0:1:2"], "a sweep of width: choose 1 of e, mu, frequency"),
    (["--sweep", "frequency=1:2:2,depth=0:1:2"], "choose 2 of e, mu, frequency, amplitude"),
    (["--sweep", "frequency=1:2:2,frequency=0:1:2"], "frequency is given twice"),
    (["--sweep", "frequency=1:2,amplitude=0:1:2"], "--sweep frequency: '1:2' is not FROM:TO:COUNT"),
    (["--sweep", "e=0.5:0.6:2,amplitude=0:1:2"], "--sweep takes e itself, not by --e"),
    (["--sweep", "frequency=5:-1:2,amplitude=0:1:2"], "f_x = -1 is below 0"),
]


@pytest.mark.parametrize(("options", "reason"), BAD, ids=[" ".join(options) for options, _ in BAD])
def test_rejects_a_wish_that_cannot_be_carried_out(
    options: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([*SMALL, *options]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1 and reason in lines[0]


def test_rejects_parquet_without_pyarrow_before_it_runs(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert run([*SMALL, *TRAJECTORY, "-o", "f.parquet"]) == 2
    told = capsys.readouterr()
    assert told.out == "" and told.err.count("\n") == 1
    assert "pyarrow is needed for Parquet; install it with pip install pyarrow" in told.err


@pytest.mark.parametrize("wish", [TRAJECTORY, MAP, CLEAR, ["--orientation", "--parts", "20"]])
def test_columns_and_pictures_are_written_holds(
    wish: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    for name in ("f.csv", "f.npz", "f.svg"):
        assert run([*SMALL, *wish, "-o", str(tmp_path / name)]) == 0
        assert f"{tmp_path / name}: " in capsys.readouterr().out
    rows = list(csv.reader((tmp_path / "f.csv").open()))
    arrays = np.load(tmp_path / "f.npz")
    assert [head.partition(" [")[0] for head in rows[0]] == list(arrays)
    assert all(len(arrays[name]) == len(rows) - 1 for name in arrays)
    assert (tmp_path / "f.svg").read_bytes().startswith(b"<?xml")


def test_trajectories_are_told_by_part_holds(capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*SMALL, *TRAJECTORY, "--times", "0:0.1:11"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("2 parts at 11 times from 0 to 0.1 s; table: 60 Hz 0.2 mm up")
    assert [line.split()[:2] for line in lines[2:]] == [
        ["theta=20", "20.0000"],
        ["theta=50,y=40,omega=90", "50.0000"],
    ]
    assert run([*SMALL, "--trajectory", "--parts", "3", "--angles", "10:20"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[:2] for line in lines[2:]] == [["part", str(k)] for k in range(3)]
    assert all(10 < float(line.split()[2]) < 20 for line in lines[2:])


def test_orientation_is_told_with_intervals_holds(capsys: pytest.CaptureFixture[str]) -> None:
    wish = ["--orientation", "--parts", "50", "--angles", "0:90", "--vibration", "15:2"]
    assert run([*SMALL, *wish]) == 0
    lines = capsys.readouterr().out.splitlines()
    block = scene(e=0.7, mu=0.08, f_x=15.0, A_x=2e-3)
    found = orientation(block, between(0, 90), parts=50, shaken=0.2)
    for face, line in enumerate(lines[2:6]):
        told = [float(one) for one in line.split()]
        assert told[0] == face and told[3] == found.counts[face]
        assert np.allclose(told[4:], found.share(face), rtol=1e-5)
    assert lines[6] == "low, high: 95 % for the probability of the face alone, after Wilson"


def test_the_least_drive_is_told_holds(capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*SMALL, *CLEAR, "--angles", "90"]) == 0
    assert (
        "amplitude 0.5 mm is the least of the grid that clears faces 0, 2, there and at all 1"
        in capsys.readouterr().out
    )


def test_an_interrupted_map_keeps_the_points_that_are_done_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def report(done: int, of: int) -> None:
        if done == 4:
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(5)  # in which the signal comes

    monkeypatch.setattr(simulate_feeder, "progress", lambda: report)
    path = tmp_path / "map.csv"
    assert run([*SMALL, *MAP, "-o", str(path)]) == 130
    told = capsys.readouterr()
    assert told.err == "juggleproof: interrupted; 4 points are done\n"
    assert f"{path}: 4 rows written" in told.out and len(path.read_text().splitlines()) == 5
