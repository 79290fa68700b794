"""`juggleproof simulate table`: a ball on a table that moves as a sine, as events or a picture."""

from __future__ import annotations

import argparse
from fractions import Fraction
from itertools import takewhile
from pathlib import Path

import numpy as np
from rich.console import Console

from juggleproof.command.outputs import fault_of
from juggleproof.judging.extras import needed
from juggleproof.reports.tables import components, draw, exact
from juggleproof.scenes.table.motion import Table, events
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import write_file

LARGE = 10**9
MOST_EVENTS = 200  # events that are printed
CERTIFICATES = "juggleproof.command.sine"  # loaded where certificates are drawn
ALPHAS, GAMMAS = "0:0.3", "1.8:4.2"  # the default ranges of the map of attractors
TOP = 21 / 16  # the greatest closing speed in the picture of a basin without a certificate


class TableOptions(argparse.Namespace):
    """The options of `juggleproof simulate table`."""

    alpha: str | None
    gamma: str | None
    wave: str
    state: list[str] | None
    periods: int
    picture: str | None
    output: Path | None


def command(parsed: argparse.Namespace) -> int:
    """Follows the orbits, or draws them; returns the exit code."""
    return table(TableOptions(**vars(parsed)))


def table(options: TableOptions) -> int:
    """Prints the events of each orbit, or draws a picture; returns 0.  Raises ClaimError or
    SceneError, one line, for a scene that cannot be simulated.
    """
    wave = (
        (1.0,)
        if options.wave == "sine"
        else tuple(number(one, "--wave") for one in options.wave.split(","))
    )
    if options.picture == "attractors":
        return _map(options, wave)
    if options.alpha is None or options.gamma is None:
        raise ClaimError("simulate table: needs --alpha A and --gamma G")
    under = Table(number(options.alpha, "--alpha"), number(options.gamma, "--gamma"), wave)
    starts = [state(text) for text in options.state or ["phase=0,speed=0"]]
    if options.picture is not None:
        return _picture(options, under, starts)
    if options.output is not None:
        raise ClaimError("-o: is for --picture; leave it out")
    for phase, speed in starts:
        own = float(under.derivative(np.array(phase), 1))
        seen = takewhile(
            lambda one: one.time <= options.periods, events(under, phase, own + under.alpha * speed)
        )
        rows = [
            (one.kind, f"{one.time:.6f}", f"{one.time % 1:.6f}", f"{one.speed:.6f}")
            for one, _ in zip(seen, range(MOST_EVENTS))
        ]
        print(f"simulated, from an impact at phase {phase:g} with closing speed {speed:g}:")
        draw(("event", "time", "phase", "closing speed"), rows, Console(highlight=False))
    return 0


def number(text: str, name: str) -> float:
    """The float of a number that is written such as 0.05 or 1/20."""
    return in_floats(exact(text, name), name)


def in_floats(exactly: Fraction, name: str) -> float:
    """The number as a float; raises ClaimError where it is too large to be simulated."""
    if abs(exactly) >= LARGE:
        raise ClaimError(f"{name} is too large to be simulated; give less than {LARGE}")
    return float(exactly)


def state(text: str) -> tuple[float, float]:
    """Phase and closing speed of an impact that is written phase=..,speed=.."""
    given = components(text, ("phase", "speed"), "phase=..,speed=..")
    if len(given) < 2:
        raise ClaimError(f"--state {text[:40]}: write it as phase=0.1,speed=0.5")
    if given["speed"] < 0:
        raise ClaimError(f"--state {text[:40]}: a closing speed is not below 0")
    return float(given["phase"] % 1), in_floats(given["speed"], "speed")


def _picture(options: TableOptions, under: Table, starts: list[tuple[float, float]]) -> int:
    if options.picture not in ("orbit", "basin"):
        raise ClaimError(f"--picture {options.picture}: draw orbit, basin or attractors")
    output = _drawn_to(options)
    pictures = needed("juggleproof.scenes.table.pictures", "picture")
    if options.picture == "orbit":
        write_file(output, pictures.orbit(under, starts, options.periods))
    else:
        _only_for_a_sine(options, under.wave)
        certified = needed(CERTIFICATES, "picture").certified_for(under.alpha, under.gamma)
        top = TOP if certified is None else float(certified[0])
        ranks = None if certified is None else certified[1:]
        write_file(output, pictures.basin(under, top, ranks))
    print(f"wrote {output}")
    return 0


def _map(options: TableOptions, wave: tuple[float, ...]) -> int:
    _only_for_a_sine(options, wave)
    output = _drawn_to(options)
    sine = needed(CERTIFICATES, "picture")
    alpha = sine.interval(options.alpha or ALPHAS, "--alpha")
    gamma = sine.interval(options.gamma or GAMMAS, "--gamma")
    for ends, option in (alpha, "--alpha"), (gamma, "--gamma"):
        in_floats(ends[1], option)
    pictures = needed("juggleproof.scenes.table.cover", "picture")
    drawn = pictures.attractor_map(*map(sine.in_floats, (alpha, gamma)), sine.wide_boxes())
    write_file(output, drawn)
    print(f"wrote {output}")
    return 0


def _drawn_to(options: TableOptions) -> Path:
    """The output file of a picture; raises ClaimError without one that can be written."""
    if options.output is None:
        raise ClaimError("--picture: needs -o F.svg")
    if fault := fault_of(options.output):
        raise ClaimError(f"-o {options.output}: {fault}; name another file")
    return options.output


def _only_for_a_sine(options: TableOptions, wave: tuple[float, ...]) -> None:
    if wave != (1.0,):
        raise ClaimError(f"--picture {options.picture}: is for --wave sine")
