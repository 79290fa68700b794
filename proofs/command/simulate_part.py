"""`juggleproof simulate part`: table I, a sweep, the still table, figure 2 and its animation."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Mapping
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import BinaryIO

from juggleproof.certificates.language import ClaimError
from juggleproof.proofs.command.outputs import clear, fault_of, progress, written_aside
from juggleproof.proofs.extras import needed
from juggleproof.proofs.reports import part as part_tables
from juggleproof.proofs.reports.part import keep_results
from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part.animation import HORIZON, animation
from juggleproof.scenes.part.drive import Harmonics, Record, harmonics, read_record
from juggleproof.scenes.part.ensemble import in_words, no_vibration
from juggleproof.scenes.part.layout import ANGLES
from juggleproof.scenes.part.onsets import (
    PAPER,
    Interrupted,
    Table,
    as_csv,
    as_npz,
    table_one,
)
from juggleproof.scenes.part.readings import (
    AMPLITUDES,
    FACES,
    Point,
    Reading,
    Stage,
    Task,
    as_json,
    chosen,
    finals,
    neighbours,
    recorded,
    screened,
    stage,
    sweep,
)
from juggleproof.scenes.part.setting import Launch, Scene, scene
from juggleproof.scenes.part.shape import Polygon, polygon

SINES = ("A_x", "f_x", "phase_x", "A_y", "f_y", "phase_y")
OTHERS = ("shape", "tilt", "along", "away", "drive")
MOST_BYTES = 100_000_000  # of a file of corners or of a record
WISHES = ("sweep", "still", "figure", "animation")
SUFFIXES = {
    "figure": (".svg", ".pdf"),
    "animation": (".html",),
    "sweep": (".json",),
    "table": (".csv", ".npz"),
}


class PartOptions(argparse.Namespace):
    """What `juggleproof simulate part` takes."""

    sweep: str | None
    still: bool
    figure: Path | None
    animation: Path | None
    e: str | None
    mu: str | None
    face: str | None
    amplitudes: str | None
    phase: str | None
    launch: Launch
    vibration: str
    shape: str | None
    tilt: str
    along: str | None
    away: str | None
    drive: Path | None
    ensembles: int
    horizon: str
    seed: int
    tolerance: str
    rest_speed: str
    jobs: int | None
    check: bool
    keep: Path | None
    output: Path | None


def command(parsed: argparse.Namespace) -> int:
    """Runs the scene of the part; returns the exit code."""
    return part(PartOptions(**vars(parsed)))


def part(options: PartOptions) -> int:
    """Runs what is asked for; 0, 1 where --check found a guarantee broken, 130 where it was
    interrupted.
    """
    needed("numba", "scene", "part")
    wishes = [name for name in WISHES if getattr(options, name)] or ["table"]
    if len(wishes) > 1:
        raise ClaimError(f"--{wishes[0]} and --{wishes[1]} do not go together; give one of them")
    if options.keep is not None and wishes[0] != "table":
        raise ClaimError(f"--keep {options.keep} goes with table I")
    for name in OTHERS:
        if wishes[0] not in ("figure", "animation") and getattr(options, name) not in (None, "0"):
            raise ClaimError(
                f"--{name} goes with --figure or --animation; table I, sweeps and --still are of"
                " the paper's block and table"
            )
    _refuse_unwritable(options, wishes[0])
    with _threads(options.jobs) as executor:
        return DONE_BY[wishes[0]](options, executor)


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


def _number(text: str, name: str) -> float:
    """A number of physics, such as 0.7, 1e-3 or 2/3."""
    try:
        return float(Fraction(text)) if len(text) <= 60 else math.nan
    except (ValueError, ZeroDivisionError, OverflowError):
        raise ClaimError(
            f"{name} = {text[:40]!r} is no number; write it as 0.7, 1e-3 or 2/3"
        ) from None


def _known(text: str, name: str, known: Mapping[str, object]) -> str:
    if text not in known:
        raise ClaimError(f"{name} {text[:40]!r}: choose from {', '.join(known)}")
    return text


def _reading(options: PartOptions) -> Reading:
    """The reading of the options; what is not given is as in the most likely one that is stored."""
    likely = chosen(recorded()).reading
    along, up = likely.phase_x, likely.phase_y
    if options.phase is not None:
        first, both, second = options.phase.partition(",")
        along, up = _number(first, "phase"), _number(second if both else first, "phase")
    return Reading(
        _known(options.face or likely.face, "--face", FACES),
        _known(options.amplitudes or likely.amplitudes, "--amplitudes", AMPLITUDES),
        along,
        up,
        likely.e if options.e is None else _number(options.e, "e"),
        likely.mu if options.mu is None else _number(options.mu, "mu"),
    )


def _setting(options: PartOptions, reading: Reading) -> Scene:
    """The scene of the options under a reading."""
    frequency, amplitude = _vibration(options.vibration)
    contact = {
        "tolerance": _number(options.tolerance, "tolerance"),
        "rest_speed": _number(options.rest_speed, "rest speed"),
    }
    plain = reading.scene(
        options.launch, A_x=reading.peak * amplitude, f_x=frequency, **contact
    )
    if options.shape is not None and options.face is not None:
        raise ClaimError("--face and --shape do not go together; give one of them")
    if all(getattr(options, name) in (None, "0") for name in OTHERS):
        return plain
    shape = None if options.shape is None else _shape(options.shape)
    drive = _drive(options, reading)
    return scene(
        **({"a": plain.a, "b": plain.b} if shape is None else {}),
        **({name: getattr(plain, name) for name in SINES} if drive is None else {}),
        e=reading.e,
        mu=reading.mu,
        launch=options.launch,
        shape=shape,
        tilt=math.radians(_number(options.tilt, "tilt")),
        drive=drive,
        **contact,
    )


def _shape(text: str) -> Polygon:
    """The polygon of corners in centimetres, as they stand or in a file."""
    given, name = text, "--shape"
    if not set(text) <= set("0123456789+-.,/eE \t\n"):
        given, name = _read(Path(text)), text
    corners = []
    for corner in given.split():
        pieces = corner.split(",")
        if len(pieces) != 2:
            raise ClaimError(f"{name}: {corner[:40]!r} is not X,Y; write '0,0 4,0 4,2 0,2'")
        corners.append([_exact(piece, f"{name}: {corner[:40]!r}") / 100 for piece in pieces])
    return polygon(corners)


def _exact(text: str, name: str) -> Fraction:
    """A number as it is written."""
    try:
        if len(text) <= 60 and abs(float(Fraction(text))) < 1e6:
            return Fraction(text)
    except (ValueError, ZeroDivisionError, OverflowError):
        pass
    raise ClaimError(f"{name} is no corner; write numbers as 0.7, 1e-3 or 2/3")


def _read(path: Path) -> str:
    """The text of a file."""
    try:
        if path.stat().st_size > MOST_BYTES:
            raise ClaimError(f"{path}: more than {MOST_BYTES // 10**6} MB")
        return path.read_text(encoding="utf-8")
    except OSError as fault:
        raise ClaimError(f"{path}: {(fault.strerror or 'no file').lower()}") from None
    except UnicodeDecodeError:
        raise ClaimError(f"{path}: no text") from None


def _drive(options: PartOptions, reading: Reading) -> Harmonics | Record | None:
    """How the table moves where it is no single sine along each axis; a harmonic without a phase
    starts at 0, the axis that is not given as in the reading.
    """
    if options.drive is not None:
        if options.along is not None or options.away is not None:
            raise ClaimError("--drive goes without --along and --away; give one of them")
        try:
            return read_record(_read(options.drive), 1e-3)
        except SceneError as fault:
            raise ClaimError(f"{options.drive}: {fault}") from None
    if options.along is None and options.away is None:
        return None
    along = options.along or f"{options.vibration}:{reading.phase_x}"
    away = options.away or f"60:0.2:{reading.phase_y}"
    return harmonics(*(_sines(text, reading.peak) for text in (along, away)))


def _sines(text: str, peak: float) -> list[tuple[float, float, float]]:
    """Harmonics as they are written, in metres, hertz and radians."""
    found = []
    for one in text.split(","):
        pieces = one.split(":")
        if len(pieces) not in (2, 3):
            raise ClaimError(f"{one[:40]!r} is not HERTZ:MILLIMETRES[:DEGREES], such as 30:1:90")
        hertz, size, phase = (_number(piece, "a harmonic") for piece in (*pieces, "0")[:3])
        found.append((peak * size / 1000, hertz, math.radians(phase)))
    return found


def _vibration(text: str) -> tuple[float, float]:
    pieces = text.split(":")
    if len(pieces) != 2:
        raise ClaimError(f"--vibration {text[:40]!r} is not HERTZ:MILLIMETRES, such as 30:1")
    return _number(pieces[0], "the frequency"), _number(pieces[1], "the amplitude") / 1000


def _table(options: PartOptions, executor: Executor | None) -> int:
    reading, interrupted = _reading(options), False
    setting = _setting(options, reading)
    try:
        computed = table_one(
            setting,
            ensembles=options.ensembles,
            horizon=_number(options.horizon, "horizon"),
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
        print(
            f"{options.output}: {len(computed.rows)} rows of {options.ensembles} ensembles written"
        )
    broken = options.check and part_tables.violations(computed.run, setting)
    return 130 if interrupted else int(broken)


def _writer(path: Path) -> Callable[[Table, BinaryIO], None]:
    return as_csv if path.suffix == ".csv" else as_npz


def _axis(text: str, name: str) -> list[float]:
    """The numbers of FROM:TO:COUNT, rounded to ten digits."""
    pieces = text.split(":")
    if len(pieces) != 3:
        raise ClaimError(f"--sweep {name}: {text[:40]!r} is not FROM:TO:COUNT")
    low, high, count = (
        _number(pieces[0], name),
        _number(pieces[1], name),
        _number(pieces[2], f"the count of {name}"),
    )
    if not 1 <= count <= 1000 or count != int(count):
        raise ClaimError(
            f"--sweep {name}: a count of {pieces[2][:20]} is not a whole number from 1 to 1000"
        )
    return [round(low + (high - low) * k / max(count - 1, 1), 10) for k in range(int(count))]


def _sweep(options: PartOptions, executor: Executor | None) -> int:
    if options.e is not None or options.mu is not None:
        raise ClaimError("--sweep takes e and mu itself, not by --e and --mu")
    whole = options.sweep == "readings"
    stages: list[Stage] = []
    wanted, interrupted = [screened(), neighbours()] if whole else [_grid(options)], False
    print(part_tables.POINT_HEADS)
    while wanted and not interrupted:
        tasks, points = wanted.pop(0), list[Point]()

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
        if whole and len(stages) == 2:
            wanted.append(finals([one.points for one in stages]))
    if stages and stages[-1].points:
        print(part_tables.likeliest(stages))
    if options.output is not None and stages:
        with written_aside(options.output) as file:
            file.write(as_json(stages).encode())
        print(f"{options.output}: {sum(len(one.points) for one in stages)} points written")
    return 130 if interrupted else 0


def _grid(options: PartOptions) -> list[Task]:
    """The points of a grid of restitution and friction, all else as the options say."""
    grid = options.sweep or ""
    axes = {
        name.strip(): text for name, _, text in (piece.partition("=") for piece in grid.split(","))
    }
    if set(axes) != {"e", "mu"}:
        raise ClaimError(
            f"--sweep {grid[:40]!r} has not e and mu; write e=FROM:TO:COUNT,mu=FROM:TO:COUNT, or"
            " readings"
        )
    plain, horizon = _reading(options), _number(options.horizon, "horizon")
    readings = [
        replace(plain, e=e, mu=mu)
        for e, mu in product(_axis(axes["e"], "e"), _axis(axes["mu"], "mu"))
    ]
    return [
        Task(one, _setting(options, one), options.ensembles, options.seed, horizon)
        for one in readings
    ]


def _still(options: PartOptions, executor: Executor | None) -> int:
    print(in_words(no_vibration(_setting(options, _reading(options)), executor)))
    return 0


def _drawn(options: PartOptions, executor: Executor | None) -> int:
    setting = _setting(options, _reading(options))
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
