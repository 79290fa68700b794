"""`juggleproof simulate juggler`: orbits of a scene, as a table, a file or a picture."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import BinaryIO

from juggleproof.command.juggler import tables
from juggleproof.command.outputs import clear, fault_of, progress, written_aside
from juggleproof.judging.extras import needed
from juggleproof.reports.tables import components, exact
from juggleproof.scenes.juggler.compiled_map import counted, restitution
from juggleproof.scenes.juggler.orbits import Orbits, prepare
from juggleproof.scenes.juggler.starts import (
    Axis,
    Scene,
    Starts,
    axis,
    boundary,
    grid,
    listed,
    physical,
    physical_box,
    physical_grid,
    random,
    scene,
)
from juggleproof.scenes.juggler.tables import NAMES, as_csv, as_npz
from juggleproof.statements.language import ClaimError

NORMAL, PHYSICAL = NAMES["normal"], NAMES["physical"]
FORMATS = (".csv", ".npz")
STEPS, IMPACTS_TO_TRAP = 20, 1000
NO_ALPHA = "--alpha is missing; give the restitution, such as --alpha 3/10"
Writer = Callable[[Orbits, BinaryIO], None]
STARTS = ("state", "grid", "boundary", "random")
LISTS: dict[str, tuple[str, ...]] = {
    "hard_cases": (),
    "words": ("alpha",),
    "word": ("alpha",),
    "times": ("alpha", *STARTS),
    "picture": ("alpha", *STARTS, "output"),
}  # the lists, each with the options that it takes


class JugglerOptions(argparse.Namespace):
    """The options of `juggleproof simulate juggler`."""

    alpha: str | None
    r: str
    g: str
    state: list[str] | None
    grid: str | None
    boundary: int | None
    random: int | None
    seed: int
    box: str
    arithmetic: str
    precision: int | None
    steps: int | None
    impacts: bool
    until_trap: bool
    keep: bool
    times: str | None
    units: str
    output: Path | None
    words: bool
    longest: int
    flight: int | None
    word: str | None
    hard_cases: bool
    picture: str | None


def command(parsed: argparse.Namespace) -> int:
    """Runs the scene of the juggler; returns the exit code."""
    return juggler(JugglerOptions(**vars(parsed)))


def juggler(options: JugglerOptions) -> int:
    """Prints the orbits of the paper's map, or one of `LISTS`; returns the exit code.  Raises
    ClaimError for options that do not go together, and for a missing one.
    """
    _refuse_what_does_not_go_together(options)
    if options.hard_cases:
        return tables.hard_cases()
    if options.word is not None:
        flights = tuple(_whole(part, "a flight") for part in options.word.split(","))
        return tables.word(
            flights, None if options.alpha is None else exact(options.alpha, "alpha")
        )
    if options.picture is not None:
        return _picture(options, options.picture)
    if options.alpha is None:
        raise ClaimError(NO_ALPHA)
    alpha = exact(options.alpha, "alpha")
    if options.words:
        return tables.words(alpha, options.longest, options.flight)
    setting = scene(alpha, starts(options, alpha), *_units(options))
    if options.times is not None:
        low, high, count = _axis(options.times, "times", 3)
        return tables.times(setting, low, high, count)
    return _follow(options, setting)


def _refuse_what_does_not_go_together(options: JugglerOptions) -> None:
    """Raises ClaimError for two of `LISTS` at once, and for options that have no effect on the one
    that is chosen.
    """
    lists = [name for name in LISTS if getattr(options, name) not in (None, False)]
    if not lists:
        return
    others = [
        name
        for name in ("alpha", *STARTS, "output")
        if getattr(options, name) is not None and name not in LISTS[lists[0]]
    ]
    if lists[1:] + others:
        one, two = (name.replace("_", "-") for name in (lists[0], (lists[1:] + others)[0]))
        raise ClaimError(f"--{one} and --{two} do not go together; leave one of them out")


def starts(options: JugglerOptions, alpha: Fraction) -> Starts:
    """The starting states of the options; raises ClaimError where the options give none, or two
    kinds.
    """
    given = [name for name in STARTS if getattr(options, name) is not None]
    if len(given) != 1:
        fault = (
            " and ".join(f"--{name}" for name in given) + " do not go together"
            if given
            else "no start is given"
        )
        raise ClaimError(f"{fault}; give one of --state, --grid, --boundary and --random")
    if options.boundary is not None:
        return boundary(alpha, options.boundary)
    if options.random is not None:
        names, (low, high, _), (slow, quick, _) = _axes(options.box, "box", 2)
        sides = (
            physical_box((low, high), (slow, quick), *_units(options))
            if names == PHYSICAL
            else ((low, high), (slow, quick))
        )
        return random(options.random, options.seed, *sides)
    if options.grid is not None:
        names, heights, speeds = _axes(options.grid, "grid", 3)
        return (
            physical_grid(heights, speeds, *_units(options))
            if names == PHYSICAL
            else grid(heights, speeds)
        )
    return listed([_state(text, options) for text in options.state or ()])


def _state(text: str, options: JugglerOptions) -> tuple[Fraction, Fraction]:
    given = components(text, (*NORMAL, *PHYSICAL))
    if set(given) == {"beta", "v"}:
        x, w = physical(given["beta"], given["v"], *_units(options)).exact(0)
    elif set(given) == {"x", "w"}:
        x, w = given["x"], given["w"]
    else:
        raise ClaimError(
            f"{text[:40]} has not both components of a state; write x=..,w=.. or beta=..,v=.."
        )
    return x, w


def _units(options: JugglerOptions) -> tuple[Fraction, Fraction]:
    return exact(options.r, "r"), exact(options.g, "g")


def _axis(text: str, name: str, parts: int) -> Axis:
    pieces = text.split(":")
    if len(pieces) != parts:
        raise ClaimError(
            f"{name}: {text[:40]!r} is not {'FROM:TO:COUNT' if parts == 3 else 'FROM:TO'}"
        )
    count = _whole(pieces[2], f"the count of {name}") if parts == 3 else 1
    return exact(pieces[0], name), exact(pieces[1], name), count


def _whole(text: str, name: str) -> int:
    value = exact(text, name)
    if value.denominator != 1:
        raise ClaimError(f"{name} = {text.strip()[:40]} is not a whole number")
    return int(value)


def _axes(text: str, option: str, parts: int) -> tuple[tuple[str, str], Axis, Axis]:
    """The names of both components, and the axis of each."""
    axes: dict[str, Axis] = {}
    for part in text.split(","):
        name, _, rest = part.partition("=")
        name = name.strip()
        if name in axes:
            raise ClaimError(f"--{option}: {name[:20]} is given twice; give each component once")
        axes[name] = _axis(rest, f"--{option} {name[:20]}", parts)
    for names in (NORMAL, PHYSICAL):
        if set(axes) == set(names):
            return names, axes[names[0]], axes[names[1]]
    raise ClaimError(
        f"--{option} {text[:40]!r} has not x and w, nor beta and v; write x=..,w=.. or beta=..,v=.."
    )


def _follow(options: JugglerOptions, setting: Scene) -> int:
    writer = _writer(options)
    steps, impacts = options.steps, options.impacts
    if steps is None:
        steps, impacts = (IMPACTS_TO_TRAP, True) if options.until_trap else (STEPS, impacts)
    orbits = prepare(
        setting,
        options.arithmetic,
        steps,
        impacts=impacts,
        until_trap=options.until_trap,
        keep=options.keep,
        precision=options.precision,
    )
    interrupted = False
    try:
        orbits.run(progress())
    except KeyboardInterrupt:
        interrupted = True
    clear()
    tables.orbits(orbits, options.units)
    if writer is not None and options.output is not None:
        with written_aside(options.output) as file:
            writer(orbits, file)
        print(f"{options.output}: {orbits.followed} of {len(orbits)} orbits written")
    if interrupted:
        print(
            f"juggleproof: interrupted; {orbits.followed} of {len(orbits)} orbits were begun, and"
            " what was done of them is told",
            file=sys.stderr,
        )
    return 130 if interrupted else 0


def _writer(options: JugglerOptions) -> Writer | None:
    """The function that writes the output file, whose path is checked before the run."""
    units = _checked_units(options)
    path = options.output
    if path is None:
        return None
    if path.suffix == ".svg":
        raise ClaimError(f"--output {path} is a picture; say which by --picture {_OR}")
    _refuse_unwritable(path, FORMATS)
    write = as_csv if path.suffix == ".csv" else as_npz
    return lambda orbits, file: write(orbits, file, units)


def _checked_units(options: JugglerOptions) -> str:
    units = options.units
    if units not in tables.UNITS:
        raise ClaimError(f"--units {units[:40]}: choose from {', '.join(tables.UNITS)}")
    return units


def _refuse_unwritable(path: Path, suffixes: Sequence[str]) -> None:
    if path.suffix not in suffixes:
        raise ClaimError(f"--output {path}: the name is to end in {' or '.join(suffixes)}")
    fault = fault_of(path)
    if fault:
        raise ClaimError(f"--output {path}: {fault}; name another file")


# -------------------------------------------------------------------------------------------------
# Pictures.

# the default starts and alpha of a picture
PICTURES: dict[str, dict[str, str | int]] = {
    "orbit": {},
    "basin": {"grid": "x=0:8:400,w=-6:6:400"},
    "bifurcation": {"random": 100, "alpha": "1/400:399/400:399"},
}
MOST_ALPHAS = 2000  # columns of a picture
_OR = "orbit, basin or bifurcation"
# the options that only tables take, with their values when they are not given
OF_TABLES = {
    "arithmetic": "exact",
    "precision": None,
    "impacts": False,
    "until_trap": False,
    "keep": False,
}


def _picture(options: JugglerOptions, wanted: str) -> int:
    """Draws a picture; raises ClaimError for options that have no effect on it."""
    if wanted not in PICTURES:
        raise ClaimError(f"--picture {wanted[:40]!r}: choose from {_OR}")
    others = OF_TABLES if wanted == "orbit" else {**OF_TABLES, "steps": None}
    for name, absent in others.items():
        if getattr(options, name) != absent:
            raise ClaimError(
                f"--picture {wanted} and --{name.replace('_', '-')} do not go together; leave one"
                " of them out"
            )
    units, path = _checked_units(options), options.output
    if path is None:
        raise ClaimError(f"--picture {wanted} needs a file; give -o F.svg")
    _refuse_unwritable(path, (".svg",))
    needed("matplotlib", "picture")
    from juggleproof.command.juggler import pictures

    given = any(getattr(options, name) is not None for name in STARTS)
    for name, value in PICTURES[wanted].items():
        if getattr(options, name) is None and (name == "alpha" or not given):
            setattr(options, name, value)
    if options.alpha is None:
        raise ClaimError(NO_ALPHA)
    if wanted == "bifurcation":
        if options.boundary is not None:
            raise ClaimError("--boundary depends on alpha; give --state, --grid or --random")
        low, high, count = _axis(options.alpha, "--alpha", 3)
        counted(count, "the number of alpha", 2, MOST_ALPHAS)
        alphas = [*axis(low, high, count, "alpha")]
        setting = scene(alphas[0], starts(options, alphas[0]), *_units(options))
        restitution(alphas[-1])
        return pictures.bifurcation(alphas, setting, units, path)
    alpha = exact(options.alpha, "alpha")
    setting = scene(alpha, starts(options, alpha), *_units(options))
    if wanted == "basin":
        return pictures.basin(setting, units, path)
    return pictures.orbit(setting, STEPS if options.steps is None else options.steps, units, path)
