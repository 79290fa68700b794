"""`juggleproof simulate`: orbits of a scene, as a table or a file, with their error."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import BinaryIO

from certificates.terms import ClaimError
from proofs.command import orbit_tables
from proofs.command.numbers import components, exact
from proofs.command.outputs import fault_of, written_aside
from scenes.errors import SceneError
from scenes.juggler.orbits import Orbits, Report, prepare
from scenes.juggler.setting import Scene, scene
from scenes.juggler.starts import Axis, Starts, boundary, grid, listed, physical, random

FORMATS = (".csv", ".npz", ".svg")
STEPS, IMPACTS_TO_TRAP = 20, 1000
Writer = Callable[[Orbits, BinaryIO], None]
STARTS = ("state", "grid", "boundary", "random")


def simulate(options: argparse.Namespace) -> int:
    """Runs a scene; 0, or 130 where it was interrupted.  Raises ClaimError, one line, for what cannot be carried out."""
    scenes: dict[str, Callable[[argparse.Namespace], int]] = {"juggler": juggler, "part": _part}
    try:
        return scenes[options.scene](options)
    except SceneError as problem:
        raise ClaimError(str(problem)) from None


def _part(options: argparse.Namespace) -> int:
    from proofs.command.part import part  # what one scene needs, the other does not load

    return part(options)


def juggler(options: argparse.Namespace) -> int:
    """The orbits of the paper's map, or one of the lists of the juggler."""
    lists = [name for name in ("hard_cases", "words", "word", "times") if getattr(options, name)]
    if len(lists) > 1:
        raise ClaimError(f"--{lists[0].replace('_', '-')} and --{lists[1].replace('_', '-')} do not go together; give one of them")
    if options.hard_cases:
        return orbit_tables.hard_cases()
    if options.word:
        return orbit_tables.word(tuple(_whole(part, "a flight") for part in options.word.split(",")))
    if options.alpha is None:
        raise ClaimError("--alpha is missing; give the restitution, such as --alpha 3/10")
    alpha = exact(options.alpha, "alpha")
    if options.words:
        return orbit_tables.words(alpha, options.longest, options.flight)
    setting = scene(alpha, starts(options), exact(options.r, "r"), exact(options.g, "g"))
    if options.times:
        low, high, count = _axis(options.times, "times", 3)
        return orbit_tables.times(setting, low, high, count)
    return _follow(options, setting)


def starts(options: argparse.Namespace) -> Starts:
    """The starting states that were asked for."""
    given = [name for name in STARTS if getattr(options, name) is not None]
    if len(given) != 1:
        told = " and ".join(f"--{name}" for name in given) + " do not go together" if given else "no start is given"
        raise ClaimError(f"{told}; give one of --state, --grid, --boundary and --random")
    if options.boundary is not None:
        return boundary(exact(options.alpha, "alpha"), options.boundary)
    if options.random is not None:
        x, w = (axis[:2] for axis in _axes(options.box, "box", 2))
        return random(options.random, options.seed, x, w)
    if options.grid is not None:
        return grid(*_axes(options.grid, "grid", 3))
    return listed([_state(text, options) for text in options.state])


def _state(text: str, options: argparse.Namespace) -> tuple[Fraction, Fraction]:
    given = components(text, ("x", "w", "beta", "v"))
    if set(given) == {"beta", "v"}:
        x, w = physical(given["beta"], given["v"], exact(options.r, "r"), exact(options.g, "g")).exact(0)
    elif set(given) == {"x", "w"}:
        x, w = given["x"], given["w"]
    else:
        raise ClaimError(f"{text[:40]} has not both components of a state; write x=..,w=.. or beta=..,v=..")
    return x, w


def _axis(text: str, name: str, parts: int) -> Axis:
    pieces = text.split(":")
    if len(pieces) != parts:
        raise ClaimError(f"{name}: {text[:40]!r} is not {'FROM:TO:COUNT' if parts == 3 else 'FROM:TO'}")
    count = _whole(pieces[2], f"the count of {name}") if parts == 3 else 1
    return exact(pieces[0], name), exact(pieces[1], name), count


def _whole(text: str, name: str) -> int:
    value = exact(text, name)
    if value.denominator != 1:
        raise ClaimError(f"{name} = {text.strip()[:40]} is not a whole number")
    return int(value)


def _axes(text: str, option: str, parts: int) -> tuple[Axis, Axis]:
    found = {}
    for part in text.split(","):
        name, _, rest = part.partition("=")
        found[name.strip()] = _axis(rest, f"--{option} {name.strip()[:20]}", parts)
    if set(found) != {"x", "w"}:
        raise ClaimError(f"--{option} {text[:40]!r} has not x and w; write x=..,w=..")
    return found["x"], found["w"]


def _follow(options: argparse.Namespace, setting: Scene) -> int:
    writer = _writer(options)
    steps, impacts = options.steps, options.impacts
    if steps is None:
        steps, impacts = (IMPACTS_TO_TRAP, True) if options.until_trap else (STEPS, impacts)
    orbits = prepare(setting, options.arithmetic, steps, impacts=impacts, until_trap=options.until_trap, keep=options.keep,
                     precision=options.precision)
    interrupted = False
    try:
        orbits.run(_progress())
    except KeyboardInterrupt:
        interrupted = True
    _clear()
    orbit_tables.orbits(orbits, options.units)
    if writer is not None:
        with written_aside(options.output) as file:
            writer(orbits, file)
        print(f"{options.output}: {orbits.followed} of {len(orbits)} orbits written")
    if interrupted:
        print(f"juggleproof: interrupted; {orbits.followed} of {len(orbits)} orbits were begun, and what was done of them is told", file=sys.stderr)
    return 130 if interrupted else 0


def _writer(options: argparse.Namespace) -> Writer | None:
    """How the file is made, its name and place being checked before the run."""
    units = options.units
    if units not in orbit_tables.UNITS:
        raise ClaimError(f"--units {units[:40]}: choose from {', '.join(orbit_tables.UNITS)}")
    path: Path | None = options.output
    if path is None:
        return None
    if path.suffix not in FORMATS:
        raise ClaimError(f"--output {path}: the name is to end in one of {', '.join(FORMATS)}")
    fault = fault_of(path)
    if fault:
        raise ClaimError(f"--output {path}: {fault}; name another file")
    if path.suffix == ".svg":
        from proofs.reports.extras import needed

        needed("matplotlib")
        from scenes.juggler.picture import picture

        return picture
    from scenes.juggler import tables

    return lambda orbits, file: (tables.as_csv if path.suffix == ".csv" else tables.as_npz)(orbits, file, units)


def _progress() -> Report | None:
    """Tells how far a run is, on a terminal only."""
    if not sys.stderr.isatty():
        return None
    last = [-1]

    def tell(done: int, of: int) -> None:
        part = 1000 * done // max(of, 1)
        if part != last[0]:
            last[0] = part
            print(f"\r{done} of {of}", end="", file=sys.stderr, flush=True)

    return tell


def _clear() -> None:
    if sys.stderr.isatty():
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)
