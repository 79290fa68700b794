"""`juggleproof simulate part`: table I, a sweep, the still table, figure 2; the faces on which
parts rest, and the least drive that clears faces.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import BinaryIO

from rich.console import Console

from juggleproof.command.outputs import clear, fault_of, progress, written_aside
from juggleproof.command.simulate_scene import (
    SceneOptions,
    number,
    others,
    reading_of,
    setting_of,
)
from juggleproof.judging.extras import needed
from juggleproof.reports import part as part_tables
from juggleproof.reports.part import keep_results
from juggleproof.reports.tables import draw, whole
from juggleproof.scenes.part.ensemble import in_words, no_vibration
from juggleproof.scenes.part.onsets import (
    PAPER,
    Interrupted,
    OnsetTable,
    as_csv,
    as_npz,
    ensembles_in_words,
    table_one,
)
from juggleproof.scenes.part.readings import (
    AlikeReadings,
    ReadingOutcome,
    SimulatedReading,
    as_json,
    finals,
    nearer,
    screened,
    stage,
    sweep,
)
from juggleproof.scenes.part.resting import (
    ANY_ANGLE,
    Clearing,
    Orientation,
    RestingStarts,
    between,
    clearing,
    listed,
    orientation,
    write_csv,
)
from juggleproof.statements.language import ClaimError

WISHES = ("clear", "orientation", "sweep", "still", "figure")
PAPERS = ("table", "sweep", "still")  # runs with the paper's block and table
FEEDERS = ("orientation", "clear")  # runs with parts that start at any angles
READINGS = "readings"  # the sweep over all readings that table I leaves open
PICTURE = ".svg"
SUFFIXES = {
    "figure": (PICTURE, ".pdf"),
    "sweep": (".json",),
    "table": (".csv", ".npz"),
    "orientation": (".csv", PICTURE),
    "clear": (".csv", PICTURE),
}
MOST_VALUES = 1000  # values of a parameter in a sweep


class PartOptions(SceneOptions):
    """The options of `juggleproof simulate part`."""

    sweep: str | None
    orientation: bool
    clear: str | None
    still: bool
    figure: Path | None
    parts: int | None
    angles: str | None
    ensembles: int
    horizon: str
    seed: int
    check: bool
    jobs: int | None
    keep: Path | None
    output: Path | None


def command(parsed: argparse.Namespace) -> int:
    """Runs the scene of the part; returns the exit code."""
    return part(PartOptions(**vars(parsed)))


def part(options: PartOptions) -> int:
    """Runs the part's scene; returns 0, or 1 where --check found a guarantee broken, or 130 where
    the run was interrupted.
    """
    needed("numba", "scene", "part")
    wishes = [name for name in WISHES if getattr(options, name) not in (None, False)] or ["table"]
    if wishes[:2] == ["clear", "sweep"]:
        wishes.remove("sweep")  # with --clear it is a sweep of the drive
    if len(wishes) > 1:
        raise ClaimError(f"--{wishes[0]} and --{wishes[1]} do not go together; give one of them")
    _refuse_left_out(options, wishes[0])
    _refuse_unwritable(options, wishes[0])
    with _threads(options.jobs) as executor:
        return DONE_BY[wishes[0]](options, executor)


def _refuse_left_out(options: PartOptions, wish: str) -> None:
    """Raises ClaimError for an option that has no effect in this run."""
    if options.keep is not None and wish != "table":
        raise ClaimError(f"--keep {options.keep} goes with table I")
    if options.check and wish in FEEDERS:
        raise ClaimError("--check goes with table I")
    if wish in PAPERS and others(options):
        raise ClaimError(
            f"--{others(options)[0]} goes with --figure, --orientation or --clear; table I, its"
            " sweeps and --still are of the paper's block and table"
        )
    for name in ("parts", "angles"):
        if getattr(options, name) is not None and wish not in FEEDERS:
            raise ClaimError(f"--{name} goes with --orientation or --clear")
    for name in ("e", "mu"):
        if getattr(options, name) is not None and name in axes(options.sweep or ""):
            raise ClaimError(f"--sweep takes {name} itself, not by --{name}")


def _threads(jobs: int | None) -> AbstractContextManager[Executor | None]:
    if jobs is None:
        return nullcontext(None)
    if not 1 <= jobs <= 1024:
        raise ClaimError(f"--jobs {jobs} is outside 1 .. 1024")
    return ThreadPoolExecutor(jobs)


def _refuse_unwritable(options: PartOptions, wish: str) -> None:
    """Raises ClaimError for a file that could not be written after the run."""
    path = options.output
    if wish == "figure":
        if path is not None:
            raise ClaimError(
                f"--output {path} goes with table I or a sweep; --figure names its own file"
            )
        path = options.figure
    if path is None:
        return
    if wish == "still":
        raise ClaimError(f"--output {path} goes with table I or a sweep")
    if path.suffix not in SUFFIXES[wish]:
        raise ClaimError(f"{path}: the name is to end in {' or '.join(SUFFIXES[wish])}")
    if path.suffix == PICTURE:
        needed("matplotlib", "picture")
    fault = fault_of(path)
    if fault:
        raise ClaimError(f"{path}: {fault}; name another file")


# -------------------------------------------------------------------------------------------------
# Numbers and grids, as they are written.


def axis(text: str, name: str) -> list[float]:
    """The numbers of FROM:TO:COUNT, rounded to ten digits."""
    pieces = text.split(":")
    if len(pieces) != 3:
        raise ClaimError(f"{name}: {text[:40]!r} is not FROM:TO:COUNT")
    low, high, count = (
        number(pieces[0], name),
        number(pieces[1], name),
        number(pieces[2], f"the count of {name}"),
    )
    if not 1 <= count <= MOST_VALUES or count != int(count):
        raise ClaimError(
            f"{name}: a count of {pieces[2][:20]} is not a whole number from 1 to {MOST_VALUES}"
        )
    return [round(low + (high - low) * k / max(count - 1, 1), 10) for k in range(int(count))]


def axes(text: str) -> dict[str, str]:
    """The names of --sweep with the text of each, in the order given."""
    found: dict[str, str] = {}
    for piece in text.split(","):
        name, _, rest = (part.strip() for part in piece.partition("="))
        if name in found:
            raise ClaimError(f"--sweep: {name[:20]} is given twice; give each parameter once")
        found[name] = rest
    return found


def grid_of(text: str) -> dict[str, list[float]]:
    """The values of each parameter of --sweep."""
    return {name: axis(rest, f"--sweep {name[:20]}") for name, rest in axes(text).items()}


# -------------------------------------------------------------------------------------------------
# Table I, its sweeps, the still table and figure 2.


def _table(options: PartOptions, executor: Executor | None) -> int:
    reading, interrupted = reading_of(options), False
    setting = setting_of(options, reading)
    try:
        computed = table_one(
            setting,
            ensembles=options.ensembles,
            horizon=number(options.horizon, "horizon"),
            seed=options.seed,
            peak=reading.peak,
            executor=executor,
            report=progress(),
            check=options.check,
            keep=options.keep,
        )
        clear()
        # before anything is printed, since the reader of a pipe may end
        keep_results(setting, computed, reading.amplitudes, options.seed)
    except Interrupted as stop:
        clear()
        computed, interrupted = stop.table, True
        print(
            f"juggleproof: interrupted; {len(computed.rows)} of {len(PAPER)} rows are done",
            file=sys.stderr,
        )
    part_tables.table(computed, setting, reading.amplitudes)
    if options.output is not None:
        with written_aside(options.output) as file:
            _writer(options.output)(computed, file)
        each = ensembles_in_words(options.ensembles)
        print(f"{options.output}: {len(computed.rows)} rows of {each} written")
    broken = options.check and part_tables.violations(computed.run, setting)
    return 130 if interrupted else int(broken)


def _writer(path: Path) -> Callable[[OnsetTable, BinaryIO], None]:
    return as_csv if path.suffix == ".csv" else as_npz


def _sweep(options: PartOptions, executor: Executor | None) -> int:
    whole = options.sweep == READINGS
    stages: list[AlikeReadings] = []
    tasks, interrupted = screened() if whole else _grid(options), False
    following = [nearer, finals] if whole else []
    print(part_tables.POINT_HEADS)
    while tasks and not interrupted:
        points = list[ReadingOutcome]()

        def report(_done: int, _of: int, points: list[ReadingOutcome] = points) -> None:
            if points[-1].likelihoods:
                print(part_tables.point(points[-1]), flush=True)

        try:
            sweep(tasks, executor, report, points)
        except KeyboardInterrupt:
            interrupted = True
            print(f"juggleproof: interrupted; {len(points)} points are done", file=sys.stderr)
        if points:
            stages.append(stage(tasks, points))
        tasks = following.pop(0)(points) if following else []
    if stages and stages[-1].points:
        print(part_tables.likeliest(stages))
    if options.output is not None and stages:
        with written_aside(options.output) as file:
            file.write(as_json(stages).encode())
        print(f"{options.output}: {sum(len(one.points) for one in stages)} points written")
    return 130 if interrupted else 0


def _grid(options: PartOptions) -> list[SimulatedReading]:
    """The points of a grid of restitution and friction; all else is as in the options."""
    grid = grid_of(options.sweep or "")
    if set(grid) != {"e", "mu"}:
        raise ClaimError(
            f"--sweep {', '.join(grid)[:40]}: choose e and mu, or readings; one parameter goes with"
            " --clear"
        )
    plain, horizon = reading_of(options), number(options.horizon, "horizon")
    readings = [replace(plain, e=e, mu=mu) for e, mu in product(grid["e"], grid["mu"])]
    return [
        SimulatedReading(one, setting_of(options, one), options.ensembles, options.seed, horizon)
        for one in readings
    ]


def _still(options: PartOptions, executor: Executor | None) -> int:
    print(in_words(no_vibration(setting_of(options, reading_of(options)), executor)))
    return 0


def _drawn(options: PartOptions, executor: Executor | None) -> int:
    from juggleproof.scenes.part.picture import figure_two

    setting, path = setting_of(options, reading_of(options)), options.figure or Path()
    with written_aside(path) as file:
        figure_two(setting, file, path.suffix[1:])
    print(f"{path}: written")
    return 0


# -------------------------------------------------------------------------------------------------
# The faces on which parts rest, and the least drive that clears faces.


def _orientation(options: PartOptions, executor: Executor | None) -> int:
    found = orientation(
        setting_of(options, reading_of(options)),
        _starts(options),
        parts=1000 if options.parts is None else options.parts,
        shaken=number(options.horizon, "horizon"),
        seed=options.seed,
        executor=executor,
        report=progress(),
    )
    clear()
    _told(found)
    print("low, high: 95 % for the probability of the face alone, after Wilson")
    if found.moving:
        print(f"{found.moving} parts lie on no face 64 s after the table has stopped")
    _written(found, options.output)
    return 0


def _clear(options: PartOptions, executor: Executor | None) -> int:
    reading = reading_of(options)
    setting = setting_of(options, reading)
    if options.sweep is None:
        raise ClaimError("--clear: over which drives? give --sweep amplitude=FROM:TO:COUNT")
    texts = (options.clear or "").split(",")
    try:
        faces = [whole(one.strip()) for one in texts]
    except argparse.ArgumentTypeError:
        raise ClaimError(f"--clear {options.clear!r:.40} is no list of faces such as 0,2") from None
    found = clearing(
        setting,
        faces,
        grid_of(options.sweep),
        starts=_starts(options),
        parts=200 if options.parts is None else options.parts,
        shaken=number(options.horizon, "horizon"),
        seed=options.seed,
        peak=reading.peak,
        executor=executor,
        report=progress(),
    )
    clear()
    _told(found)
    for line in found.in_words():
        print(line)
    _written(found, options.output)
    return 0


def _starts(options: PartOptions) -> RestingStarts:
    text = options.angles
    if text is None:
        return ANY_ANGLE
    if ":" in text:
        pieces = text.split(":")
        if len(pieces) != 2:
            raise ClaimError(f"--angles {text[:40]!r} is not FROM:TO, nor a list such as 0,30,90")
        return between(number(pieces[0], "--angles"), number(pieces[1], "--angles"))
    return listed([number(one, "--angles") for one in text.split(",")])


def _told(result: Orientation | Clearing) -> None:
    """Prints the title and the columns."""
    print(f"{result.title()}.  Simulated: no certificate.")
    columns = result.columns()
    rows = [
        [f"{value:.6g}" if isinstance(value, float) else str(value) for value in row]
        for row in zip(*(one.values.tolist() for one in columns))
    ]
    draw([one.head() for one in columns], rows, Console(highlight=False))


def _written(result: Orientation | Clearing, path: Path | None) -> None:
    """Writes the picture or the columns to a file."""
    if path is None:
        return
    drawn = result.picture() if path.suffix == PICTURE else None
    with written_aside(path) as file:
        if drawn is not None:
            file.write(drawn)
        else:
            write_csv(result.columns(), file)
    rows = f"{len(result.columns()[0].values)} rows " if drawn is None else ""
    print(f"{path}: {rows}written")


DONE_BY: dict[str, Callable[[PartOptions, Executor | None], int]] = {
    "table": _table,
    "sweep": _sweep,
    "still": _still,
    "figure": _drawn,
    "orientation": _orientation,
    "clear": _clear,
}
