"""`juggleproof simulate part`: table I, a sweep, the still table, figure 2 and its animation."""

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

from juggleproof.command import simulate_feeder as feeder
from juggleproof.command.outputs import clear, fault_of, progress, written_aside
from juggleproof.command.simulate_scene import number, others, reading_of, setting_of
from juggleproof.judging.extras import needed
from juggleproof.reports import part as part_tables
from juggleproof.reports.part import keep_results
from juggleproof.scenes.part.animation import HORIZON, animation
from juggleproof.scenes.part.ensemble import in_words, no_vibration
from juggleproof.scenes.part.layout import ANGLES
from juggleproof.scenes.part.onsets import (
    PAPER,
    Interrupted,
    Table,
    as_csv,
    as_npz,
    ensembles_in_words,
    table_one,
)
from juggleproof.scenes.part.readings import (
    Point,
    Stage,
    Task,
    as_json,
    finals,
    nearer,
    screened,
    stage,
    sweep,
)
from juggleproof.statements.language import ClaimError

WISHES = ("clear", "trajectory", "orientation", "sweep", "still", "figure", "animation")
PAPERS = ("table", "sweep", "still")  # of the paper's block and table
READINGS = "readings"  # a sweep over all that table I leaves open
SUFFIXES = {
    "figure": (".svg", ".pdf"),
    "animation": (".html",),
    "sweep": (".json",),
    "table": (".csv", ".npz"),
}


class PartOptions(feeder.FeederOptions):
    """What `juggleproof simulate part` takes."""

    still: bool
    figure: Path | None
    animation: Path | None
    jobs: int | None
    keep: Path | None


def command(parsed: argparse.Namespace) -> int:
    """Runs the scene of the part; returns the exit code."""
    return part(PartOptions(**vars(parsed)))


def part(options: PartOptions) -> int:
    """Runs what is asked for; 0, 1 where --check found a guarantee broken, 130 where it was
    interrupted.
    """
    needed("numba", "scene", "part")
    wishes = [name for name in WISHES if getattr(options, name) not in (None, False)] or ["table"]
    if wishes[:2] == ["clear", "sweep"]:
        wishes.remove("sweep")  # of the drive
    if len(wishes) > 1:
        raise ClaimError(f"--{wishes[0]} and --{wishes[1]} do not go together; give one of them")
    if options.keep is not None and wishes[0] != "table":
        raise ClaimError(f"--keep {options.keep} goes with table I")
    wish = "map" if wishes == ["sweep"] and not _of_table_one(options) else wishes[0]
    if wish in PAPERS and others(options):
        raise ClaimError(
            f"--{others(options)[0]} goes with --figure, --animation, --trajectory, --orientation,"
            " --clear or a sweep of others than e and mu; table I, its sweeps and --still are of"
            " the paper's block and table"
        )
    feeder.refuse_left_out(options, wish)
    if wish in feeder.DONE_BY:
        feeder.refuse_unwritable(options.output)
    else:
        _refuse_unwritable(options, wish)
    with _threads(options.jobs) as executor:
        return (DONE_BY | feeder.DONE_BY)[wish](options, executor)


def _of_table_one(options: PartOptions) -> bool:
    """Whether a sweep is of table I: over e and mu, which all of its rows have in common, or over
    all that it leaves open.
    """
    grid = options.sweep
    return grid is not None and (grid == READINGS or set(feeder.axes(grid)) == {"e", "mu"})


def _threads(jobs: int | None) -> AbstractContextManager[Executor | None]:
    if jobs is None:
        return nullcontext(None)
    if not 1 <= jobs <= 1024:
        raise ClaimError(f"--jobs {jobs} is outside 1 .. 1024")
    return ThreadPoolExecutor(jobs)


def _refuse_unwritable(options: PartOptions, wish: str) -> None:
    path = options.output
    if wish in ("figure", "animation"):
        if path is not None:
            raise ClaimError(
                f"--output {path} goes with table I or a sweep; --{wish} names its own file"
            )
        path = getattr(options, wish)
    if path is None:
        return
    if wish == "still":
        raise ClaimError(f"--output {path} goes with table I or a sweep")
    if path.suffix not in SUFFIXES[wish]:
        raise ClaimError(f"{path}: the name is to end in {' or '.join(SUFFIXES[wish])}")
    fault = fault_of(path)
    if fault:
        raise ClaimError(f"{path}: {fault}; name another file")


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
        # before anything is printed, to a reader who may not stay
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


def _writer(path: Path) -> Callable[[Table, BinaryIO], None]:
    return as_csv if path.suffix == ".csv" else as_npz


def _sweep(options: PartOptions, executor: Executor | None) -> int:
    if options.e is not None or options.mu is not None:
        raise ClaimError("--sweep takes e and mu itself, not by --e and --mu")
    whole = options.sweep == READINGS
    stages: list[Stage] = []
    tasks, interrupted = screened() if whole else _grid(options), False
    following = [nearer, finals] if whole else []
    print(part_tables.POINT_HEADS)
    while tasks and not interrupted:
        points = list[Point]()

        def report(_done: int, _of: int, points: list[Point] = points) -> None:
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


def _grid(options: PartOptions) -> list[Task]:
    """The points of a grid of restitution and friction, all else as the options say."""
    grid = feeder.grid_of(options.sweep or "")
    plain, horizon = reading_of(options), number(options.horizon, "horizon")
    readings = [replace(plain, e=e, mu=mu) for e, mu in product(grid["e"], grid["mu"])]
    return [
        Task(one, setting_of(options, one), options.ensembles, options.seed, horizon)
        for one in readings
    ]


def _still(options: PartOptions, executor: Executor | None) -> int:
    print(in_words(no_vibration(setting_of(options, reading_of(options)), executor)))
    return 0


def _drawn(options: PartOptions, executor: Executor | None) -> int:
    setting = setting_of(options, reading_of(options))
    if options.figure is not None:
        needed("matplotlib")
        from juggleproof.scenes.part.picture import figure_two

        with written_aside(options.figure) as file:
            figure_two(setting, file, options.figure.suffix[1:])
    if options.animation is not None:
        with written_aside(options.animation) as file:
            animation(setting, ANGLES, HORIZON, file, executor)
    print(f"{options.figure or options.animation}: written")
    return 0


DONE_BY: dict[str, Callable[[PartOptions, Executor | None], int]] = {
    "table": _table,
    "sweep": _sweep,
    "still": _still,
    "figure": _drawn,
    "animation": _drawn,
}
