"""Graphs of results: angle against time, a quantity over two parameters, shares with their
intervals.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from juggleproof.drawing.drawing import (
    Sides,
    Title,
    axes,
    key,
    on_white,
    raster,
    spaced,
    styled,
    ticks,
)
from juggleproof.drawing.lines import joined, straight
from juggleproof.drawing.look import B1, B2, BAND, INK, KEPT, LOSS, R
from juggleproof.scenes.errors import SceneError

Array = NDArray[np.float64]
COLOURS = tuple(look.colour for look in (B1, B2, R, BAND, LOSS, KEPT))
SOON, LATE = np.array([222.0, 235.0, 247.0]), np.array([8.0, 48.0, 107.0])
CHAOTIC, UNSETTLED = B2.colour, "#D8D8D8"
SHADES = 5  # of a key


@styled
def angles(
    times: Array, paths: Sequence[Array], names: Sequence[str], rests: Sequence[float], title: Title
) -> bytes:
    """The angles of parts, in degrees, against time, in seconds; dashed, the angles at which one
    rests, of each turn that is seen.  Up to six parts are told apart by colour.
    """
    low, high = (float(end(np.array(paths))) for end in (np.min, np.max))
    middle, half = (low + high) / 2, max(1.1 * (high - low) / 2, 50.0)
    across, up = (float(times[0]), float(times[-1])), (middle - half, middle + half)
    if not across[0] < across[1]:
        raise SceneError("one time makes no picture; give two at least")
    few = len(paths) <= len(COLOURS)
    plane = axes((560, 300), 130 if few else 14, across, up, title)
    quarters = half <= 720
    marks = [90.0 * k for k in range(int(np.ceil(up[0] / 90)), int(np.floor(up[1] / 90)) + 1)]
    plane.frame(
        ticks(spaced(*across)),
        ticks(marks if quarters else spaced(*up)),
        r"$t$ [s]",
        r"$\theta$ [degrees]",
        36,
    )
    turns = range(int(np.floor(up[0] / 360)), int(np.ceil(up[1] / 360)) + 1)
    levels = [one + 360 * turn for turn in turns for one in rests] if quarters else []
    shown = [level for level in levels if up[0] < level < up[1]]
    plane.line(
        [straight((across[0], level), (across[1], level)) for level in shown],
        "rests",
        linewidth=0.4,
        linestyle=(0, (4, 3)),
    )
    for k, path in enumerate(paths):
        plane.line(
            joined([(float(t), float(one)) for t, one in zip(times, path)]),
            f"part-{k}",
            edgecolor=COLOURS[k] if few else INK,
            linewidth=1.1 if few else 0.4,
        )
    if few:
        key(plane, [(COLOURS[k], name[:22]) for k, name in enumerate(names)])
    return on_white(plane.figure, "angles")


Onsets = tuple[str, Array, int, float | None]  # which row, onsets in s, how many chaotic, the print


@styled
def onsets_by_row(rows: Sequence[Onsets], horizon: float, title: Title) -> bytes:
    """The onset of each ensemble, a dot, inf for none; below, how many are chaotic, and the others
    that have none; the onset that the paper prints as a bar, or its "chaotic" in words.
    """
    across, up = (-0.5, len(rows) - 0.5), (0.0, horizon)
    plane = axes((640, 320), 130, across, up, title, bottom=76)
    plane.frame({}, ticks(spaced(*up)), "", "onset [s]", 32)
    printed = [(k, print_) for k, (_, _, _, print_) in enumerate(rows) if print_ is not None]
    plane.line(
        [straight((k - 0.35, onset), (k + 0.35, onset)) for k, onset in printed],
        "printed",
        edgecolor=B2.colour,
        linewidth=2,
    )
    for k, (name, onsets, chaotic, print_) in enumerate(rows):
        settled = np.sort(onsets[np.isfinite(onsets)])
        beside = (np.arange(len(settled)) + 0.5) / max(len(settled), 1) - 0.5  # in their order
        places = [(k + 0.5 * float(x), float(onset)) for x, onset in zip(beside, settled)]
        if places:
            plane.dots(places, f"row-{k}", 3, colour=B1.colour)
        late = len(onsets) - len(settled) - chaotic
        below = (name, f"chaotic: {chaotic}", f"later: {late}")
        for line, text in enumerate(below):
            plane.text((k, 0), text, (0, -12 - 13 * line), ha="center", va="top", fontsize=8.5)
        if print_ is None:
            plane.text(
                (k, horizon), "printed: chaotic", (0, -5), va="top", fontsize=8.5, color=B2.colour
            )
    key(plane, [(B1.colour, "an ensemble"), (B2.colour, "printed in the paper")])
    return on_white(plane.figure, "table-one")


Axis = tuple[str, Sequence[float]]  # a name with its unit, and evenly spaced values that grow


@styled
def onset_map(
    across: Axis, up: Axis, onsets: Array, chaotic: NDArray[np.bool_], title: Title
) -> bytes:
    """Onsets in seconds, shape (across, up), inf where there is none, as a coloured cell each;
    those that are chaotic in a colour of their own.
    """
    sides = _sides(across[1]), _sides(up[1])
    plane = axes((560, 360), 150, sides[0], sides[1], title)
    settled = np.isfinite(onsets) & ~chaotic
    found = onsets[settled]
    least, most = (float(found.min()), float(found.max())) if found.size else (0.0, 1.0)
    part = np.clip((onsets - least) / (most - least or 1.0), 0, 1)[..., None]
    colours = np.where(
        settled[..., None], SOON + (LATE - SOON) * np.nan_to_num(part), _rgb(UNSETTLED)
    )
    colours[chaotic] = _rgb(CHAOTIC)
    raster(plane, colours.round().astype(np.uint8).transpose(1, 0, 2))
    plane.frame(ticks(spaced(*sides[0])), ticks(spaced(*sides[1])), across[0], up[0], 36)
    levels = np.linspace(least, most, SHADES) if least < most else np.array([least])
    shades = (
        [
            (_hex(SOON + (LATE - SOON) * k / max(SHADES - 1, 1)), f"{level:.3g} s")
            for k, level in enumerate(levels)
        ]
        if found.size
        else []
    )
    counts = {
        CHAOTIC: f"chaotic: {int(chaotic.sum())}",
        UNSETTLED: f"not settled: {int((~settled & ~chaotic).sum())}",
    }
    key(plane, [*shades, *counts.items()])
    return on_white(plane.figure, "onsets")


def _sides(values: Sequence[float]) -> Sides:
    """From half a cell before the first value to half a cell after the last."""
    if len(values) < 2 or not values[0] < values[-1]:
        raise SceneError("a map needs two values at least of each parameter, which grow")
    half = (values[-1] - values[0]) / (len(values) - 1) / 2
    return values[0] - half, values[-1] + half


def _rgb(colour: str) -> Array:
    return np.array([float(one) for one in bytes.fromhex(colour[1:])])


def _hex(colour: Array) -> str:
    return "#" + bytes(colour.round().astype(np.uint8)).hex()


@styled
def shares(
    slug: str,
    places: Sequence[float],
    found: Sequence[tuple[float, float, float]],
    label: str,
    title: Title,
    names: Mapping[float, str] | None = None,
    mark: tuple[float, str] | None = None,
) -> bytes:
    """Shares, with the low and the high end of their intervals, over places, which have names or
    are numbers; and a mark at one of them.
    """
    step = min(np.diff(places), default=1.0)
    across = (places[0] - step, places[-1] + step)
    plane = axes((560, 280), 20, across, (0, 1), title)
    plane.frame(names or ticks(spaced(*across)), ticks(spaced(0, 1)), label, "share of parts", 32)
    if mark is not None:
        plane.line(
            [straight((mark[0], 0.0), (mark[0], 1.0))], "mark", linewidth=0.7, linestyle=(0, (4, 3))
        )
        plane.text((mark[0], 1.0), mark[1], (4, -7), ha="left", fontsize=9)
    plane.line(
        [straight((x, low), (x, high)) for x, (_, low, high) in zip(places, found)],
        "intervals",
        edgecolor=B1.colour,
    )
    plane.dots([(x, share) for x, (share, _, _) in zip(places, found)], "shares", colour=B1.colour)
    return on_white(plane.figure, slug)
