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

from juggleproof.command.juggler import command as simulate
from juggleproof.command.main import run
from juggleproof.scenes.juggler import orbit, point, scene
from juggleproof.scenes.juggler.bounded import CHUNK

START = ["--alpha", "1/3", "--state", "x=1,w=2"]


def output(capsys: pytest.CaptureFixture[str], *arguments: str, code: int = 0) -> str:
    assert run(["simulate", "juggler", *arguments]) == code
    return capsys.readouterr().out


def test_known_orbits_hold(capsys: pytest.CaptureFixture[str]) -> None:
    assert "87       3        81/1000  67/200  0      in the trap" in output(
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
    assert "without a bound of the error" in output(
        capsys, *START, "--arithmetic", "mp"
    ) and "unknown" in output(capsys, *START, "--arithmetic", "mp")
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
    assert "beta" in physical and "4/5" in physical
    assert output(capsys, *START, "--impacts", "--keep", "--steps", "3").count("\n") == 6
    assert "7/8" in output(capsys, "--alpha", "1/3", "--state", "x=0,w=3", "--times", "0:2:5")


def test_decimals_are_exact_and_so_is_what_an_exact_orbit_prints_holds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    start = ["--state", "beta=2,v=-1", "--g", "9.81", "--units", "physical", "--keep"]
    assert (
        output(capsys, "--alpha", "0.3", *start, "--steps", "2").splitlines()[3:]
        == output(capsys, "--alpha", "3/10", *start, "--g", "981/100", "--steps", "2").splitlines()[
            3:
        ]
    )
    kept = output(capsys, "--alpha", "1/3", "--state", "x=1,w=2", "--keep", "--steps", "25")
    printed = [line.split()[3:5] for line in kept.splitlines()[2:]]
    rows = orbit(scene("1/3", point(1, 2)), steps=25, keep=True).history(0)
    assert printed == [[str(row.x), str(row.w)] for row in rows] and len(printed) == 26
    long = output(capsys, "--alpha", "3/10", "--state", "x=1,w=2", "--steps", "60")
    assert "~0.355029585799  ~1.53846153846" in long
    assert "~: rounded to 12 digits from an exact number of more than 100 signs\n" in long


def test_words_hold(capsys: pytest.CaptureFixture[str]) -> None:
    found = output(capsys, "--alpha", "1/2", "--words", "--longest", "4")
    assert "e_2" in found and "on x = w" in found and found.count("near states tend") == 2
    assert "exists for no alpha" in output(capsys, "--word", "1,2")


def test_a_word_is_told_with_its_orbit_where_it_exists_and_where_it_attracts_holds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    found = output(capsys, "--word", "2")
    assert (
        "exists for 1/3 <= alpha < 1\n" in found
        and "near states tend to it for 1/3 < alpha < 1\n" in found
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
    grid, drawn = ["--grid", "x=0:3:20,w=-2:4:20"], set[str]()
    for name, start, printed in (
        ("orbit", [*START, "--steps", "7"], "orbit.svg: written\n"),
        ("orbit", ["--alpha", "0.5", "--state", "beta=1,v=1", "--g", "9.81"], "orbit.svg"),
        ("basin", ["--alpha", "1/2", *grid], "alpha = 1/2: 400 orbits in float64"),
        ("basin", ["--alpha", "1/2", *grid, "--units", "physical"], "e_2"),
        ("bifurcation", ["--alpha", "1/5:3/5:5", *grid], "e_2"),
        ("bifurcation", [*START[2:], "--alpha", "1/5:3/5:5", "--units", "physical"], "e_1"),
    ):
        path = tmp_path / f"{name}.svg"
        wanted = [*start, "--picture", name, "-o", str(path)]
        assert printed in output(capsys, *wanted)
        first = path.read_bytes()
        if name not in drawn:
            output(capsys, *wanted)
        drawn.add(name)
        assert first == path.read_bytes() and len(first) < 150_000
        assert (b"data:image/png" in first) == (name != "orbit") and b"<svg" in first


def test_bifurcation_tells_from_which_alpha_on_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    told = output(
        capsys,
        *["--picture", "bifurcation", "--alpha", "1/60:1/2:30", "--grid", "x=0:4:12,w=-2:4:12"],
        *["-o", str(tmp_path / "b.svg")],
    ).splitlines()
    assert told[0].startswith("30 alpha, from 1/60 to 1/2: 4320 orbits in float64 with error")
    assert told[0].endswith("undecided: 0")
    lines = {line.split()[0]: line.split()[2:] for line in told[2:]}
    assert lines["e_1"] == ["1/60", "1/2"] and Fraction(lines["e_2"][0]) > Fraction(1, 3)
    assert Fraction(lines["e_2"][0]) < Fraction(2, 5) and lines["e_2"][1] == "1/2"


def test_an_interrupted_picture_is_not_written_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("matplotlib")
    from juggleproof.command.juggler import pictures

    def report(done: int, of: int) -> None:
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(5)  # in which the signal comes

    monkeypatch.setattr(pictures, "progress", lambda: report)
    path = tmp_path / "basin.svg"
    wanted = ["--alpha", "1/2", "--picture", "basin", "-o", str(path)]
    assert run(["simulate", "juggler", *wanted]) == 130
    assert capsys.readouterr().err == "juggleproof: interrupted; no file was written\n"
    assert not path.exists()


PICTURE = ["--picture", "orbit", "-o", "orbit.svg"]
WRONG = {
    "no alpha": (["--state", "x=0,w=3"], "--alpha is missing"),
    "alpha": (["--alpha", "2", "--state", "x=0,w=3"], "alpha = 2 is not between 0 and 1"),
    "no number": (["--alpha", "0.3.1", "--state", "x=0,w=3"], "is no number; write it as 3/10"),
    "no start": (["--alpha", "1/3"], "no start is given"),
    "two starts": ([*START, "--random", "5"], "--state and --random do not go together"),
    "half a state": (["--alpha", "1/3", "--state", "x=1"], "not both components"),
    "steps text": ([*START, "--steps", "many"], "not a whole number"),
    "arithmetic": ([*START, "--arithmetic", "float"], "'float' is not one of"),
    "units": ([*START, "--units", "feet"], "choose from normal, physical"),
    "format": ([*START, "-o", "orbit.txt"], "end in .csv or .npz"),
    "picture of what": (
        [*START, "-o", "orbit.svg"],
        "orbit.svg is a picture; say which by --picture orbit, basin or bifurcation",
    ),
    "no such picture": (
        [*START, "--picture", "dots", "-o", "orbit.svg"],
        "--picture 'dots': choose from orbit, basin or bifurcation",
    ),
    "picture without a file": ([*START, "--picture", "orbit"], "needs a file; give -o F.svg"),
    "picture in a table": (
        [*START, "--picture", "orbit", "-o", "orbit.csv"],
        "orbit.csv: the name is to end in .svg",
    ),
    "picture and arithmetic": (
        [*START, *PICTURE, "--arithmetic", "fast"],
        "--picture orbit and --arithmetic do not go together",
    ),
    "picture and keep": ([*START, *PICTURE, "--keep"], "and --keep do not go together"),
    "basin and steps": (
        ["--alpha", "1/2", "--picture", "basin", "-o", "b.svg", "--steps", "3"],
        "--picture basin and --steps do not go together",
    ),
    "picture and words": ([*PICTURE, "--words"], "do not go together"),
    "picture without alpha": (PICTURE, "--alpha is missing"),
    "picture without a start": ([*PICTURE, "--alpha", "1/2"], "no start is given"),
    "basin of a state": (
        [*START, "--picture", "basin", "-o", "b.svg"],
        "a grid of at least 2 by 2 states; give --grid",
    ),
    "too many orbits": (
        ["--alpha", "1/2", "--grid", "x=0:1:3000,w=0:1:3000", "--picture", "basin", "-o", "b.svg"],
        "outside 1 .. 4000000 orbits; give fewer",
    ),
    "bifurcation at one alpha": (
        [*START, "--picture", "bifurcation", "-o", "b.svg"],
        "--alpha: '1/3' is not FROM:TO:COUNT",
    ),
    "bifurcation of one alpha": (
        ["--alpha", "1/3:1/2:1", "--picture", "bifurcation", "-o", "b.svg"],
        "the number of alpha = 1 is not a whole number from 2 to 2000",
    ),
    "bifurcation of a boundary": (
        ["--boundary", "9", "--picture", "bifurcation", "-o", "b.svg"],
        "--boundary depends on alpha; give --state, --grid or --random",
    ),
    "beyond the floats": (
        ["--alpha", "1/3", "--state", "x=10^400,w=0", *PICTURE],
        "numbers beyond 10^308 cannot be drawn; give smaller ones",
    ),
    "many periods": ([*START, *PICTURE, "--steps", "50"], "give from 1 to 40"),
    "many balls": (
        ["--alpha", "1/3", "--random", "9", *PICTURE],
        "9 starts cannot be drawn; give 6 at most",
    ),
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
    "alpha negative": (
        ["--alpha", "-1/3", "--state", "x=0,w=3"],
        "alpha = -1/3 is not between 0 and 1",
    ),
    "alpha -inf": (["--alpha", "-inf", "--state", "x=0,w=3"], "alpha = '-inf' is no number"),
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
    "word": (["--word", "1,x"], "is no number"),
    "lists": (["--words", "--hard-cases"], "do not go together"),
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
