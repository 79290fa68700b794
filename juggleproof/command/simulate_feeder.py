"""`juggleproof simulate part`, as designers of feeders use it: trajectories, onsets over two
parameters, the faces on which parts rest, and the least drive that clears faces.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable
from concurrent.futures import Executor
from pathlib import Path

import numpy as np
from rich.console import Console

from juggleproof.command.outputs import clear, fault_of, progress, written_aside
from juggleproof.command.simulate_scene import (
    SceneOptions,
    number,
    reading_of,
    setting_of,
)
from juggleproof.judging.extras import needed
from juggleproof.reports.tables import components, draw, whole
from juggleproof.scenes.part import body
from juggleproof.scenes.part.columns import FORMS, Shown, optional
from juggleproof.scenes.part.ensemble import CONTACT
from juggleproof.scenes.part.resting import (
    ANY_ANGLE,
    Orientation,
    Starts,
    between,
    listed,
    orientation,
)
from juggleproof.scenes.part.setting import Array, Scene, standing
from juggleproof.scenes.part.sweeps import InterruptedMap, clearing, onset_map
from juggleproof.scenes.part.trajectory import Trajectories, start_of, trajectories
from juggleproof.statements.language import ClaimError

PICTURE = ".svg"
PARTS = {"orientation": 1000, "clear": 200}  # where --parts is not given
TIMES = 2001  # of a trajectory over the horizon, where --times is not given
MOST_TIMES, MOST_NAMED = 1_000_000, 1000
STATE = ("theta", "x", "y", "vx", "vy", "omega")
FORM = "theta=.., and x=..,y=.. (mm), vx=..,vy=.. (m/s), omega=.. (degrees a second)"


class FeederOptions(SceneOptions):
    """What these take of the options of `juggleproof simulate part`."""

    sweep: str | None
    trajectory: bool
    orientation: bool
    clear: str | None
    state: list[str] | None
    parts: int | None
    angles: str | None
    times: str | None
    ensembles: int
    horizon: str
    seed: int
    check: bool
    output: Path | None


# -------------------------------------------------------------------------------------------------
# Numbers and grids, as they are written.


def axis(text: str, name: str, most: int = 1000) -> list[float]:
    """The numbers of FROM:TO:COUNT, rounded to ten digits."""
    pieces = text.split(":")
    if len(pieces) != 3:
        raise ClaimError(f"{name}: {text[:40]!r} is not FROM:TO:COUNT")
    low, high, count = (
        number(pieces[0], name),
        number(pieces[1], name),
        number(pieces[2], f"the count of {name}"),
    )
    if not 1 <= count <= most or count != int(count):
        raise ClaimError(
            f"{name}: a count of {pieces[2][:20]} is not a whole number from 1 to {most}"
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
# What is asked for.


def refuse_left_out(options: FeederOptions, wish: str) -> None:
    """Raises ClaimError for an option that the wish would leave out in silence."""
    goes = {
        "state": ("trajectory",),
        "times": ("trajectory",),
        "parts": ("trajectory", "orientation", "clear"),
        "angles": ("trajectory", "orientation", "clear"),
    }
    for name, wishes in goes.items():
        if getattr(options, name) is not None and wish not in wishes:
            raise ClaimError(f"--{name} goes with {' or '.join(f'--{one}' for one in wishes)}")
    if wish not in DONE_BY:
        return
    for name in ("e", "mu"):
        if getattr(options, name) is not None and name in axes(options.sweep or ""):
            raise ClaimError(f"--sweep takes {name} itself, not by --{name}")
    if options.check:
        raise ClaimError("--check goes with table I")
    if options.state is not None and (options.parts, options.angles) != (None, None):
        raise ClaimError("--state and --parts do not go together; leave one of them out")


def refuse_unwritable(path: Path | None) -> None:
    """Raises ClaimError for a file that could not be written after the run."""
    if path is None:
        return
    if path.suffix not in (*FORMS, PICTURE):
        raise ClaimError(f"{path}: the name is to end in {', '.join(FORMS)} or {PICTURE}")
    if path.suffix == ".parquet":
        optional("pyarrow", "Parquet")
    if path.suffix == PICTURE:
        needed("matplotlib", "picture")
    fault = fault_of(path)
    if fault:
        raise ClaimError(f"{path}: {fault}; name another file")


def _written(result: Shown, path: Path | None) -> None:
    """The picture or the columns, in a file."""
    if path is None:
        return
    drawn = result.picture() if path.suffix == PICTURE else None
    with written_aside(path) as file:
        if drawn is not None:
            file.write(drawn)
        else:
            result.write(file, path.suffix)
    rows = f"{len(result.columns()[0].values)} rows " if drawn is None else ""
    print(f"{path}: {rows}written")


def _told(result: Shown) -> None:
    """Title and columns."""
    print(f"{result.title()}.  Simulated: no certificate.")
    columns = result.columns()
    rows = [
        [f"{value:.6g}" if isinstance(value, float) else str(value) for value in row]
        for row in zip(*(one.values.tolist() for one in columns))
    ]
    draw([one.head() for one in columns], rows, Console(highlight=False))


# -------------------------------------------------------------------------------------------------
# Starts.


def _starts(options: FeederOptions) -> Starts:
    text = options.angles
    if text is None:
        return ANY_ANGLE
    if ":" in text:
        pieces = text.split(":")
        if len(pieces) != 2:
            raise ClaimError(f"--angles {text[:40]!r} is not FROM:TO, nor a list such as 0,30,90")
        return between(number(pieces[0], "--angles"), number(pieces[1], "--angles"))
    return listed([number(one, "--angles") for one in text.split(",")])


def _state(setting: Scene, text: str) -> Array:
    given = {name: float(one) for name, one in components(text, STATE, FORM).items()}
    if "theta" not in given:
        raise ClaimError(f"--state {text[:40]!r} has no theta; write {FORM}")
    return start_of(setting, **given)


def _named(options: FeederOptions, setting: Scene) -> dict[str, Array]:
    """The parts to be followed, by their names: what is given of each, or its number."""
    if options.state is not None:
        if len(set(options.state)) < len(options.state):
            raise ClaimError("--state: one start is given twice; parts are named by their starts")
        return {text.strip(): _state(setting, text) for text in options.state}
    if options.parts is None:
        raise ClaimError("--trajectory: which parts? give --state theta=30, or --parts 5")
    if options.parts > MOST_NAMED:
        raise ClaimError(f"--parts {options.parts} is outside 1 .. {MOST_NAMED}")
    drawn = standing(setting, _starts(options).drawn(options.parts, options.seed))
    return {f"part {k}": drawn[k : k + 1] for k in range(len(drawn))}


# -------------------------------------------------------------------------------------------------
# The wishes.


def _trajectory(options: FeederOptions, executor: Executor | None) -> int:
    setting = setting_of(options, reading_of(options))
    horizon = number(options.horizon, "horizon")
    times = (
        np.linspace(0.0, horizon, TIMES)
        if options.times is None
        else np.array(axis(options.times, "--times", MOST_TIMES))
    )
    found = trajectories(setting, _named(options, setting), times, executor)
    print(f"{found.title()}.  Simulated: no certificate.")
    draw(
        ("part", "theta at first", "theta at last", "X at last", "at last"),
        _ends(found),
        Console(highlight=False),
    )
    _written(found, options.output)
    return 0


def _ends(found: Trajectories) -> list[tuple[str, ...]]:
    """A row a part: its angle in degrees at both ends, and where and how it is at the last."""
    rows = []
    for name, first, last in zip(found.names, found.states[0], found.states[-1]):
        angles = (f"{math.degrees(one[body.THETA]):.4f}" for one in (first, last))
        where = f"{1000 * last[body.X]:.4f} mm"
        rows.append((name, *angles, where, CONTACT[last[body.MODE]]))
    return rows


def _map(options: FeederOptions, executor: Executor | None) -> int:
    reading = reading_of(options)
    setting = setting_of(options, reading)
    interrupted = False
    try:
        found = onset_map(
            setting,
            grid_of(options.sweep or ""),
            ensembles=options.ensembles,
            horizon=number(options.horizon, "horizon"),
            seed=options.seed,
            peak=reading.peak,
            executor=executor,
            report=progress(),
        )
        clear()
    except InterruptedMap as stop:
        clear()
        found, interrupted = stop.map, True
        print(f"juggleproof: interrupted; {len(found.rows)} points are done", file=sys.stderr)
    _told(found)
    if not (interrupted and options.output and options.output.suffix == PICTURE):
        _written(found, options.output)
    return 130 if interrupted else 0


def _orientation(options: FeederOptions, executor: Executor | None) -> int:
    setting = setting_of(options, reading_of(options))
    found: Orientation = orientation(
        setting,
        _starts(options),
        parts=PARTS["orientation"] if options.parts is None else options.parts,
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


def _clear(options: FeederOptions, executor: Executor | None) -> int:
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
        parts=PARTS["clear"] if options.parts is None else options.parts,
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


DONE_BY: dict[str, Callable[[FeederOptions, Executor | None], int]] = {
    "trajectory": _trajectory,
    "map": _map,
    "orientation": _orientation,
    "clear": _clear,
}
