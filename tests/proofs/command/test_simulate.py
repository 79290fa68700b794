"""`juggleproof simulate juggler`: tables, files, one line for what is wrong, and what is done is
kept where it is interrupted.
"""

from __future__ import annotations

import csv
import io
import os
import signal
import time
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from juggleproof.proofs.command import simulate
from juggleproof.proofs.command.main import run
from juggleproof.scenes.juggler.bounded import CHUNK

START = ["--alpha", "1/3", "--state", "x=1,w=2"]


def output(capsys: pytest.CaptureFixture[str], *arguments: str, code: int = 0) -> str:
    assert run(["simulate", "juggler", *arguments]) == code
    return capsys.readouterr().out


def test_known_orbits_hold(capsys: pytest.CaptureFixture[str]) -> None:
    assert "87       3        0.081  0.335  0      in the trap" in output(
        capsys, "--alpha", "3/10", "--state", "x=1000,w=-41", "--until-trap"
    )
    edge = output(
        capsys, "--alpha", "1/3", "--state", "x=0,w=3", "--steps", "4", "--arithmetic", "enclosed"
    )
    assert "on x = w: 2 states, exactly" in edge
    floats = output(
        capsys, "--alpha", "1/3", "--state", "x=0,w=3", "--steps", "4", "--arithmetic", "fast"
    )
    assert "undecided: 0 (period 1)" in floats and "branch undecided" in floats
    assert "nothing proved" in output(capsys, *START, "--arithmetic", "mp") and "unknown" in output(
        capsys, *START, "--arithmetic", "mp"
    )
    physical = output(
        capsys,
        "--alpha",
        "1/3",
        "--state",
        "beta=0,v=-4",
        "--r",
        "2",
        "--g",
        "10",
        "--steps",
        "1",
        "--units",
        "physical",
    )
    assert "beta" in physical and "0.8" in physical
    assert output(capsys, *START, "--impacts", "--keep", "--steps", "3").count("\n") == 6
    assert "0.875" in output(capsys, "--alpha", "1/3", "--state", "x=0,w=3", "--times", "0:2:5")


def test_words_hold(capsys: pytest.CaptureFixture[str]) -> None:
    found = output(capsys, "--alpha", "1/2", "--words", "--longest", "4")
    assert "e_2" in found and "on x = w" in found and found.count("attracts near") == 2
    assert "exists for no alpha" in output(capsys, "--word", "1,2")


def test_a_word_is_told_with_its_orbit_where_it_exists_and_where_it_attracts_holds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    found = output(capsys, "--word", "2")
    assert (
        "exists for 1/3 <= alpha < 1\n" in found
        and "attracts near states for 1/3 < alpha < 1\n" in found
    )
    assert "2*(3*alpha - 1)/(alpha + 1)^2" in found and "4/(alpha + 1)" in found
    assert "1       4/9  8/3" in output(capsys, "--word", "2", "--alpha", "1/2")
    assert "at alpha = 1/3, exactly; a state lies on x = w" in output(
        capsys, "--word", "2", "--alpha", "1/3"
    )
    assert "at alpha = 1/4 no orbit has this word" in output(
        capsys, "--word", "2", "--alpha", "1/4"
    )


def test_grids_and_boxes_in_physical_units_hold(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    units, path = (
        ["--alpha", "1/3", "--r", "2", "--g", "4", "--units", "physical", "--steps", "0"],
        tmp_path / "starts.csv",
    )
    output(capsys, *units, "--grid", "beta=0:4:3,v=-1:1:2", "-o", str(path))
    rows = list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8"))))
    assert [(row["beta"], row["v"]) for row in rows] == [
        ("0", "-1"),
        ("0", "1"),
        ("2", "-1"),
        ("2", "1"),
        ("4", "-1"),
        ("4", "1"),
    ]
    output(capsys, *units, "--random", "50", "--box", "beta=1:4,v=-1:1/2", "-o", str(path))
    rows = list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8"))))
    heights, speeds = ([Fraction(row[name]) for row in rows] for name in ("beta", "v"))
    assert (
        1 <= min(heights) < 2
        and 3 < max(heights) <= 4
        and -1 <= min(speeds) < 0
        and 0 < max(speeds) <= Fraction(1, 2)
    )


def test_hard_cases_are_printed_holds(capsys: pytest.CaptureFixture[str]) -> None:
    found = output(capsys, "--hard-cases")
    assert (
        found.count("WRONG BRANCH") == 3
        and "undecided at period 1" in found
        and "50 on x = w" in found
    )


@pytest.mark.parametrize("kind", ["exact", "enclosed", "mp", "fast"])
def test_files_hold_what_the_table_says(
    kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    start = ["--alpha", "3/10", "--grid", "x=0:3:4,w=-2:2:3", "--steps", "9", "--arithmetic", kind]
    files = [tmp_path / name for name in ("a.csv", "a.npz", "b.csv", "b.npz")]
    for path in files:
        assert "12 of 12 orbits written" in output(capsys, *start, "-o", str(path))
    assert (
        files[0].read_bytes() == files[2].read_bytes()
        and files[1].read_bytes() == files[3].read_bytes()
    )
    rows = list(csv.DictReader(io.StringIO(files[0].read_text(encoding="utf-8"))))
    arrays = np.load(files[1])
    assert len(rows) == 12 == len(arrays["x"]) and str(arrays["alpha"]) == "3/10"
    for row, x in zip(rows, arrays["x"]):
        assert abs(Fraction(row["x"]) - Fraction(float(x))) < Fraction(1, 10**12)


def test_pictures_are_written_holds(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    for name, start in (
        ("one", START),
        ("many", ["--alpha", "1/3", "--random", "200", "--arithmetic", "fast"]),
        (
            "edge",
            ["--alpha", "1/3", "--state", "x=0,w=3", "--state", "x=1,w=2", "--arithmetic", "fast"],
        ),
    ):
        path = tmp_path / f"{name}.svg"
        output(capsys, *start, "-o", str(path))
        first = path.read_bytes()
        output(capsys, *start, "-o", str(path))
        assert first == path.read_bytes() and first.startswith(b"<?xml") and b"<svg" in first
    assert b"undecided" in first


WRONG = {
    "no alpha": (["--state", "x=0,w=3"], "--alpha is missing"),
    "alpha": (["--alpha", "2", "--state", "x=0,w=3"], "alpha = 2 is not between 0 and 1"),
    "rounded": (["--alpha", "0.3", "--state", "x=0,w=3"], "write it exactly, as 3/10"),
    "no start": (["--alpha", "1/3"], "no start is given"),
    "two starts": ([*START, "--random", "5"], "--state and --random do not go together"),
    "below": (["--alpha", "1/3", "--state", "x=-1,w=3"], "below the table"),
    "half a state": (["--alpha", "1/3", "--state", "x=1"], "not both components"),
    "steps": ([*START, "--steps", "-1"], "steps = -1"),
    "steps text": ([*START, "--steps", "many"], "not a whole number"),
    "arithmetic": ([*START, "--arithmetic", "float"], "'float' is not one of"),
    "precision": ([*START, "--arithmetic", "mp", "--precision", "1"], "precision = 1"),
    "units": ([*START, "--units", "feet"], "choose from normal, physical"),
    "format": ([*START, "-o", "orbit.txt"], "end in one of .csv, .npz, .svg"),
    "folder": ([*START, "-o", "/proc/none/orbit.csv"], "name another file"),
    "grid": (["--alpha", "1/3", "--grid", "x=0:1,w=0:1:2"], "FROM:TO:COUNT"),
    "grid names": (["--alpha", "1/3", "--grid", "x=0:1:2"], "has not x and w"),
    "grid mixed": (
        ["--alpha", "1/3", "--grid", "x=0:1:2,v=0:1:2"],
        "has not x and w, nor beta and v",
    ),
    "grid twice": (
        ["--alpha", "1/3", "--grid", "x=0:1:2,w=0:1:2,x=0:2:2"],
        "--grid: x is given twice",
    ),
    "box twice": (
        ["--alpha", "1/3", "--random", "3", "--box", "x=0:1,w=0:1,w=1:2"],
        "--box: w is given twice",
    ),
    "box beta": (
        ["--alpha", "1/3", "--random", "3", "--box", "beta=-1:1,v=0:1"],
        "beta = -1 is below the table",
    ),
    "alpha negative": (
        ["--alpha", "-1/3", "--state", "x=0,w=3"],
        "alpha = -1/3 is not between 0 and 1",
    ),
    "alpha -inf": (["--alpha", "-inf", "--state", "x=0,w=3"], "alpha = '-inf' is no number"),
    "times negative": (
        ["--alpha", "1/3", "--state", "x=0,w=3", "--times", "-1:2:4"],
        "time = -1 is before the start",
    ),
    "times of many": (
        ["--alpha", "1/3", "--random", "3", "--times", "0:2:4"],
        "times of 3 starts; give one start",
    ),
    "many times": (
        ["--alpha", "1/3", "--state", "x=0,w=3", "--times", "0:2:10^8"],
        "the number of times = 100000000",
    ),
    "times to a file": (
        ["--alpha", "1/3", "--state", "x=0,w=3", "--times", "0:2:4", "-o", "times.csv"],
        "--times and --output do not go together",
    ),
    "start of a word": (["--word", "2", "--random", "3"], "--word and --random do not go together"),
    "no word": (["--word", ""], "a flight = '' is no number"),
    "no times": (
        ["--alpha", "1/3", "--state", "x=0,w=3", "--times", ""],
        "'' is not FROM:TO:COUNT",
    ),
    "component": (
        ["--alpha", "1/3", "--state", "x=0,w=3,r=2"],
        "'r=2' is no component of a state; write x=..,w=.. or beta=..,v=..\n",
    ),
    "digits": ([*START, "--steps", "\u0663"], "is not a whole number"),
    "steps long": (
        [*START, "--steps", "1" + 39 * "0"],
        "steps = 1000000000000000000000000000000000000000 is not a whole number from 0 to",
    ),
    "word": (["--word", "1,x"], "is no number"),
    "lists": (["--words", "--hard-cases"], "do not go together"),
    "r": ([*START, "--r", "0"], "r = 0"),
}


@pytest.mark.parametrize("name", WRONG)
def test_rejects_bad_input_in_one_line(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    arguments, reason = WRONG[name]
    try:
        code = run(["simulate", "juggler", *arguments])
    except SystemExit as end:
        code = int(end.code or 0)
    found = capsys.readouterr()
    assert (
        code == 2 and reason in found.err and len(found.err.splitlines()) == 1 and not found.out
    ), found


@pytest.mark.parametrize(
    ("kind", "start", "after", "count"),
    [
        ("exact", ["--random", "50", "--alpha", "99/100", "--steps", "30"], 7, 7),
        ("mp", ["--random", "50", "--alpha", "99/100", "--steps", "30"], 3, 3),
        ("fast", ["--random", "100000", "--alpha", "9/10", "--steps", "3"], 2, 2 * CHUNK),
        ("enclosed", ["--state", "x=1,w=-4", "--alpha", "99/100", "--steps", "100000000"], 2, 1),
    ],
)
def test_interrupt_keeps_what_is_done_holds(
    kind: str,
    start: list[str],
    after: int,
    count: int,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    path, calls = tmp_path / "part.csv", []

    def report(done: int, of: int) -> None:
        calls.append((done, of))
        if len(calls) == after:
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(5)  # in which the signal comes

    monkeypatch.setattr(simulate, "progress", lambda: report)
    assert run(["simulate", "juggler", *start, "--arithmetic", kind, "-o", str(path)]) == 130
    found = capsys.readouterr()
    assert (
        "interrupted" in found.err
        and len(found.err.splitlines()) == 1
        and f"{count} of" in found.err
        and "orbits written" in found.out
    )
    rows = list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8"))))
    assert len(rows) == count and rows[0]["end"] == ("" if kind == "enclosed" else "reached")
    if kind == "enclosed":  # the one orbit, as far as it went: 2048 moves
        assert int(rows[0]["periods"]) >= 2048 and rows[0]["error of x"]
