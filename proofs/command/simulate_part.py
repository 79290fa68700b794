"""`juggleproof simulate part`: table I, its sweep, the still table, figure 2, its animation."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Mapping
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import BinaryIO, TypeVar

from juggleproof.certificates.language import ClaimError
from juggleproof.proofs.command import simulate_feeder as feeder
from juggleproof.proofs.command.outputs import clear, fault_of, progress, written_aside
from juggleproof.proofs.command.simulate_feeder import axis as _axis
from juggleproof.proofs.command.simulate_feeder import number as _number
from juggleproof.proofs.extras import needed
from juggleproof.proofs.reports import part as part_tables
from juggleproof.proofs.reports.part import keep_results
from juggleproof.scenes.part.animation import HORIZON, animation
from juggleproof.scenes.part.ensemble import in_words, no_vibration
from juggleproof.scenes.part.layout import ANGLES
from juggleproof.scenes.part.onsets import (
    AMPLITUDES,
    FACES,
    PAPER,
    Interrupted,
    Point,
    Table,
    as_csv,
    as_json,
    as_npz,
    chosen,
    recorded,
    sweep,
    table_one,
)
from juggleproof.scenes.part.setting import Launch, Scene, scene

T = TypeVar("T")
WISHES = ("clear", "trajectory", "orientation", "sweep", "still", "figure", "animation")
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
    face: str
    phase: str
    launch: Launch
    vibration: str
    tolerance: str
    rest_speed: str
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
    feeder.refuse_left_out(options, wish)
    if wish in feeder.DONE_BY:
        feeder.refuse_unwritable(options.output)
    else:
        _refuse_unwritable(options, wish)
    with _threads(options.jobs) as executor:
        return (DONE_BY | feeder.DONE_BY)[wish](options, _setting(options), executor)


def _of_table_one(options: PartOptions) -> bool:
    """Whether a sweep is of table I: over e and mu, which all of its rows have in common."""
    return options.sweep is not None and set(feeder.axes(options.sweep)) == {"e", "mu"}


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


def _one_of(text: str, name: str, known: Mapping[str, T]) -> T:
    if text not in known:
        raise ClaimError(f"{name} {text[:40]!r}: choose from {', '.join(known)}")
    return known[text]


def _setting(options: PartOptions) -> Scene:
    """The scene of the options; e and mu, where they are not given, those of the stored sweep."""
    a, b = _one_of(options.face, "--face", FACES)
    peak = _one_of(options.amplitudes, "--amplitudes", AMPLITUDES)
    stored = not _of_table_one(options) and (options.e is None or options.mu is None)
    pair = chosen(recorded()) if stored else Point(0, 0, (), (), 0)
    frequency, amplitude = _vibration(options.vibration)
    return scene(
        a=a,
        b=b,
        e=pair.e if options.e is None else _number(options.e, "e"),
        mu=pair.mu if options.mu is None else _number(options.mu, "mu"),
        A_x=peak * amplitude,
        f_x=frequency,
        phase_x=math.radians(_number(options.phase, "phase")),
        A_y=peak * 2e-4,
        f_y=60.0,
        tolerance=_number(options.tolerance, "tolerance"),
        rest_speed=_number(options.rest_speed, "rest speed"),
        launch=options.launch,
    )


def _vibration(text: str) -> tuple[float, float]:
    pieces = text.split(":")
    if len(pieces) != 2:
        raise ClaimError(f"--vibration {text[:40]!r} is not HERTZ:MILLIMETRES, such as 30:1")
    return _number(pieces[0], "the frequency"), _number(pieces[1], "the amplitude") / 1000


def _table(options: PartOptions, setting: Scene, executor: Executor | None) -> int:
    interrupted = False
    try:
        computed = table_one(
            setting,
            ensembles=options.ensembles,
            horizon=_number(options.horizon, "horizon"),
            seed=options.seed,
            peak=AMPLITUDES[options.amplitudes],
            executor=executor,
            report=progress(),
            check=options.check,
            keep=options.keep,
        )
        clear()
        # before anything is printed, to a reader who may not stay
        keep_results(setting, computed, options.amplitudes, options.seed)
    except Interrupted as stop:
        clear()
        computed, interrupted = stop.table, True
        print(
            f"juggleproof: interrupted; {len(computed.rows)} of {len(PAPER)} rows are done",
            file=sys.stderr,
        )
    part_tables.table(
        computed, setting, options.amplitudes, options.e is None and options.mu is None
    )
    if options.output is not None:
        with written_aside(options.output) as file:
            _writer(options.output)(computed, file)
        print(
            f"{options.output}: {len(computed.rows)} rows of {options.ensembles} ensembles written"
        )
    broken = options.check and part_tables.violations(computed.run, setting)
    return 130 if interrupted else int(broken)


def _writer(path: Path) -> Callable[[Table, BinaryIO], None]:
    return as_csv if path.suffix == ".csv" else as_npz


def _sweep(options: PartOptions, setting: Scene, executor: Executor | None) -> int:
    if options.e is not None or options.mu is not None:
        raise ClaimError("--sweep takes e and mu itself, not by --e and --mu")
    axes = feeder.axes(options.sweep or "")
    horizon = _number(options.horizon, "horizon")
    points: list[Point] = []

    def report(point: Point) -> None:
        points.append(point)
        print(part_tables.point(point), flush=True)

    print(part_tables.POINT_HEADS)
    interrupted = False
    try:
        sweep(
            setting,
            _axis(axes["e"], "--sweep e"),
            _axis(axes["mu"], "--sweep mu"),
            ensembles=options.ensembles,
            horizon=horizon,
            seed=options.seed,
            peak=AMPLITUDES[options.amplitudes],
            executor=executor,
            report=report,
        )
    except KeyboardInterrupt:
        interrupted = True
        print(f"juggleproof: interrupted; {len(points)} points are done", file=sys.stderr)
    if points:
        best = chosen(points)
        print(f"least misfit: e = {best.e:g}, mu = {best.mu:g}, {best.misfit:.3f}")
    if options.output is not None and points:
        with written_aside(options.output) as file:
            file.write(as_json(points, options.ensembles, horizon, options.seed).encode())
        print(f"{options.output}: {len(points)} points written")
    return 130 if interrupted else 0


def _still(options: PartOptions, setting: Scene, executor: Executor | None) -> int:
    print(in_words(no_vibration(setting, executor)))
    return 0


def _drawn(options: PartOptions, setting: Scene, executor: Executor | None) -> int:
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


DONE_BY: dict[str, Callable[[PartOptions, Scene, Executor | None], int]] = {
    "table": _table,
    "sweep": _sweep,
    "still": _still,
    "figure": _drawn,
    "animation": _drawn,
}
