"""Figure 2 of the paper, 91 blocks at three times; and shares of parts with their intervals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import cos, sin
from typing import BinaryIO

import numpy as np
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch

from juggleproof.drawing.drawing import (
    Plane,
    Title,
    axes,
    blank,
    on_white,
    pdf,
    polylines,
    spaced,
    styled,
    svg,
    ticks,
)
from juggleproof.drawing.lines import Point, straight
from juggleproof.drawing.look import B1, INK, KEPT, Look
from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body
from juggleproof.scenes.part.ensemble import frames
from juggleproof.scenes.part.layout import (
    ANGLES,
    COLUMNS,
    lying,
    noun,
    pitch,
    place,
    rows,
    vibration,
    ways,
)
from juggleproof.scenes.part.setting import Array, Scene

# -------------------------------------------------------------------------------------------------
# Figure 2.
#
# Where 91 blocks are at the start, after 0.8 and after 3 seconds, as three grids side by side.

SLUG = "fig-2"
TITLE = "Figure 2. Ninety-one blocks on the vibrating table"
FREQUENCY, AMPLITUDE = 30.0, 1e-3  # of the vibration along the table in the paper's figure 2
TIMES = (0.0, 0.8, 3.0)
UPRIGHT = replace(KEPT, hatch="", dashes=(), tint=0.92)
LYING = replace(B1, hatch="", tint=0.3)
WIDTH, LEFT, TOP, BOTTOM, GAP = 7.6, 0.38, 0.48, 0.36, 0.12  # inches


def as_svg(figure: Figure) -> bytes:
    """The figure as an SVG file."""
    return svg(figure, SLUG)


FORMS = {"svg": as_svg, "pdf": pdf}


def as_in_figure_two(setting: Scene, peak: float = 1.0) -> Scene:
    """The scene with the vibration along the table of the paper's figure 2: 30 Hz, and `peak` times
    1 mm as the amplitude.
    """
    return replace(setting, f_x=FREQUENCY, A_x=peak * AMPLITUDE)


def figure_two(setting: Scene, file: BinaryIO, form: str = "svg") -> None:
    """Writes figure 2 for a scene as it is, as SVG or as PDF; `as_in_figure_two` gives the paper's
    vibration.  Raises SceneError for another form.
    """
    if form not in FORMS:
        raise SceneError(f"form = {form[:40]!r}: choose from {', '.join(FORMS)}")
    file.write(FORMS[form](drawn(setting, frames(setting, ANGLES, TIMES))))


def caption(setting: Scene, seen: Array) -> str:
    """The caption below the figure."""
    counts = "; ".join(
        f"after {one[0, body.TIME]:g} s, {int(lying(setting, one).sum())} of {len(one)} are"
        f" {ways(setting)[1]}"
        for one in seen[1:]
    )
    return (
        "The foremost row starts at 0 to 9 degrees from left to right, each row behind it ten"
        f" degrees further, the last block at 90 degrees. {noun(setting).capitalize()} are drawn at"
        " their true angles"
        " and heights above the table, each at its own place: how far a block has drifted along"
        f" the table is left out. Here, {counts}. The paper's figure shows all of them lying after"
        " 3 s."
    )


def alt(setting: Scene, seen: Array) -> str:
    """A description for readers who do not see the figure."""
    counts = ", ".join(
        f"{int((~lying(setting, states)).sum())} at {states[0, body.TIME]:g} s" for states in seen
    )
    upright, lies = ways(setting)
    lean = (
        ", from the upright one at the lower left to the one that lies in the back row"
        if setting.shape is None
        else ""
    )
    return (
        f"{len(seen)} grids of {len(seen[0])} {noun(setting)}, one for each time. At the start the"
        f" {noun(setting)} lean ever more to the left{lean}."
        f" {upright.capitalize()} are {counts}; all others are {lies}."
    )


@styled
def drawn(setting: Scene, seen: Array) -> Figure:
    """The states, shape (times, n, 10), as grids side by side, one for each time."""
    step, count = pitch(setting), rows(seen.shape[1])
    across, up = (-0.62 * step, (COLUMNS - 0.38) * step), (-0.1 * step, (count - 0.2) * step)
    wide = (WIDTH - LEFT) / len(seen) - GAP
    high = wide * (up[1] - up[0]) / (across[1] - across[0])
    height = TOP + high + BOTTOM
    figure = blank(WIDTH, height)
    for k, states in enumerate(seen):
        plane = Plane(
            figure,
            ((LEFT + (wide + GAP) * k) / WIDTH, BOTTOM / height, wide / WIDTH, high / height),
            across,
            up,
        )
        table(plane, setting, len(states), f"table-{k}")
        for look, name, some in (
            (LYING, "lying", lying(setting, states)),
            (UPRIGHT, "upright", ~lying(setting, states)),
        ):
            fill(
                plane,
                [outline(setting, states[block], int(block)) for block in some.nonzero()[0]],
                f"{name}-{k}",
                look,
            )
        middle = plane.left + plane.width / 2
        plane.words(
            (middle, plane.bottom + plane.height),
            rf"$t$ = {states[0, body.TIME]:g} s",
            (0, 4),
            va="bottom",
            fontsize=11,
        )
        if k == 0:
            for row in range(count):
                plane.text(
                    (across[0], row * step),
                    f"{10 * row}°",
                    (-3, 0),
                    ha="right",
                    va="bottom",
                    fontsize=7.5,
                )
    line = vibration(setting).replace("mu", r"$\mu$").replace("; e", r"; $e$")
    plane.words(
        (72 * WIDTH / 2, 72 * height), line[:1].upper() + line[1:], (0, -4), va="top", fontsize=10
    )
    legend(figure, height, ways(setting))
    return figure


def table(plane: Plane, setting: Scene, count: int, name: str) -> None:
    """The table under each row that has blocks."""
    step = pitch(setting)
    plane.line(
        [
            straight(
                (-0.6 * step, row * step),
                ((min(COLUMNS, count - COLUMNS * row) - 0.4) * step, row * step),
            )
            for row in range(rows(count))
        ],
        name,
        linewidth=0.5,
        zorder=0.4,
    )


def outline(setting: Scene, state: Array, block: int) -> list[Point]:
    """The corners, in metres, of a block of state (10,) at its place of the grid."""
    step, p = pitch(setting), setting.parameters()
    column, row = place(block)
    x, y = column * step, row * step + state[body.Y] - body.table_height(p, state[body.TIME])
    c, s = cos(state[body.THETA]), sin(state[body.THETA])
    return [
        (x + body.corner_x(p, i, c, s), y + body.corner_y(p, i, c, s))
        for i in range(len(setting.polygon().corners))
    ]


def legend(figure: Figure, height: float, names: tuple[str, str]) -> None:
    """The legend of the two colours."""
    plane = Plane(figure, (0, 0, 1, 1), (0, 72 * WIDTH), (0, 72 * height))
    for x, look, label, (wide, high) in (
        (170.0, UPRIGHT, names[0], (6.0, 12.0)),
        (320.0, LYING, names[1], (12.0, 6.0)),
    ):
        fill(
            plane,
            [
                [
                    (x - wide / 2, 6.0),
                    (x + wide / 2, 6.0),
                    (x + wide / 2, 6 + high),
                    (x - wide / 2, 6 + high),
                ]
            ],
            None,
            look,
        )
        plane.text((x, 6.0), label, (12, 0), ha="left", va="bottom", fontsize=10)


def fill(plane: Plane, polygons: Sequence[Sequence[Point]], name: str | None, look: Look) -> None:
    """Fills polygons with the tint of a look, and draws their sides in ink, which is light on a
    dark page.
    """
    if polygons:
        outline = polylines([[*corners, corners[0]] for corners in polygons])
        plane.figure.add_artist(
            PathPatch(
                outline,
                gid=name,
                transform=plane.own,
                facecolor=to_rgba(look.colour, look.tint),
                edgecolor=INK,
                linewidth=0.5,
                capstyle="projecting",
            ),
            clip=False,
        )


# -------------------------------------------------------------------------------------------------
# Shares with their intervals.


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
    """A picture of shares, with the low and the high end of their intervals, over places, which
    have names or are numbers; with a mark at one of them.
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
