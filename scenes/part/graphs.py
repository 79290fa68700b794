"""Graphs of results: angle against time, a quantity over two parameters, shares with their
intervals.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.figures.drawing import (
    Plane,
    Sides,
    blank,
    raster,
    spaced,
    styled,
    svg,
    ticks,
)
from juggleproof.scenes.figures.lines import joined, straight
from juggleproof.scenes.figures.look import B1, B2, BAND, INK, KEPT, LOSS, R

Array = NDArray[np.float64]
Title = tuple[str, str]  # what is shown, and in smaller letters how it was found
COLOURS = tuple(look.colour for look in (B1, B2, R, BAND, LOSS, KEPT))
SOON, LATE = np.array([222.0, 235.0, 247.0]), np.array([8.0, 48.0, 107.0])
CHAOTIC, UNSETTLED = B2.colour, "#D8D8D8"
LEFT, BOTTOM, TOP, LINE = 52.0, 44.0, 44.0, 15.0  # points
SHADES = 5  # of a key


def _plane(
    size: tuple[float, float], right: float, across: Sides, up: Sides, title: Title
) -> Plane:
    """A plane in a new figure of this size in points, so much of it left free at the right."""
    width, height = size
    box = (
        LEFT / width,
        BOTTOM / height,
        1 - (LEFT + right) / width,
        1 - (BOTTOM + TOP) / height,
    )
    plane = Plane(blank(width / 72, height / 72), box, across, up)
    plane.words((LEFT, height - 10), title[0], ha="left", fontsize=11)
    plane.words((LEFT, height - 26), title[1], ha="left", fontsize=8)
    return plane


def _legend(plane: Plane, entries: Sequence[tuple[str, str]]) -> None:
    """Colours and what they mean, at the right."""
    right, top = plane.left + plane.width, plane.bottom + plane.height
    own = Plane(plane.figure, (0, 0, 1, 1), (0, 1), (0, 1))
    for line, (colour, text) in enumerate(entries):
        y = top - LINE * (line + 0.5)
        own.dots([((right + 12) / own.width, y / own.height)], f"key-{line}", 8, "s", colour=colour)
        own.words((right + 20, y), text, ha="left", va="center_baseline", fontsize=8.5)


def as_svg(figure: Figure, slug: str) -> bytes:
    """The figure as SVG, on white, so that it can be read on a dark page."""
    figure.set_facecolor("white")
    return svg(figure, slug)


@styled
def angles(
    times: Array, paths: Sequence[Array], names: Sequence[str], rests: Sequence[float], title: Title
) -> Figure:
    """The angles of parts, in degrees, against time, in seconds; dashed, the angles at which one
    rests, of each turn that is seen.  Up to six parts are told apart by colour.
    """
    low, high = (float(end(np.array(paths))) for end in (np.min, np.max))
    middle, half = (low + high) / 2, max(1.1 * (high - low) / 2, 50.0)
    across, up = (float(times[0]), float(times[-1])), (middle - half, middle + half)
    if not across[0] < across[1]:
        raise SceneError("one time makes no picture; give two at least")
    few = len(paths) <= len(COLOURS)
    plane = _plane((560, 300), 130 if few else 14, across, up, title)
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
        _legend(plane, [(COLOURS[k], name[:22]) for k, name in enumerate(names)])
    return plane.figure


Axis = tuple[str, Sequence[float]]  # a name with its unit, and evenly spaced values that grow


@styled
def onset_map(
    across: Axis, up: Axis, onsets: Array, chaotic: NDArray[np.bool_], title: Title
) -> Figure:
    """Onsets in seconds, shape (across, up), inf where there is none, as a coloured cell each;
    those that are chaotic in a colour of their own.
    """
    sides = _sides(across[1]), _sides(up[1])
    plane = _plane((560, 360), 150, sides[0], sides[1], title)
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
    _legend(plane, [*shades, *counts.items()])
    return plane.figure


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
    places: Sequence[float],
    found: Sequence[tuple[float, float, float]],
    label: str,
    title: Title,
    names: Mapping[float, str] | None = None,
    mark: tuple[float, str] | None = None,
) -> Figure:
    """Shares, with the low and the high end of their intervals, over places, which have names or
    are numbers; and a mark at one of them.
    """
    step = min(np.diff(places), default=1.0)
    across = (places[0] - step, places[-1] + step)
    plane = _plane((560, 280), 20, across, (0, 1), title)
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
    return plane.figure
