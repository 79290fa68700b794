"""The map of an argument: its claims in a circle, section by section, and lines from each claim to
those that it rests on.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby
from math import cos, degrees, dist, pi, sin
from typing import NamedTuple

from matplotlib.figure import Figure
from matplotlib.markers import MarkerStyle
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.transforms import Affine2D

from juggleproof.drawing.drawing import Plane, Style, blank, styled
from juggleproof.drawing.lines import Point
from juggleproof.drawing.look import INK

WIDTH, RADIUS, FOOT = 7.2, 208.0, 22.0  # inches; the rest in points of print
APART = 2  # the gap between two sections, in dots
PULL = 0.7  # how far a line that crosses the circle is drawn to its middle
MARKS = {  # shape and colour (of Okabe and Ito) of each verdict
    "holds": ("o", "#009E73"),
    "misprint": ("s", "#E69F00"),
    "false": ("X", "#D55E00"),
    "gap": ("D", "#CC79A7"),
    "ambiguous": ("^", "#0072B2"),
    "simulated": ("v", "#56B4E9"),
    "unknown": ("P", INK),
}


class Dot(NamedTuple):
    """A claim of the map, with the names of the claims that it rests on."""

    name: str
    section: str
    verdict: str
    rests_on: tuple[str, ...] = ()


@styled
def map_of_argument(dots: Sequence[Dot], theorem: str = "") -> Figure:
    """The map of the claims, section by section; what belongs to the theorem's claim is bold.

    A dot links to the place of its claim in a page.
    """
    sections = list(dict.fromkeys(dot.section for dot in dots))
    dots = sorted(dots, key=lambda dot: sections.index(dot.section))
    figure = blank(WIDTH, WIDTH + FOOT / 72)
    middle = 72 * WIDTH / 2
    plane = Plane(figure, (0, 0, 1, 1), (0, 72 * WIDTH), (0, 72 * WIDTH + FOOT))
    angles = _angles(dots)

    def place(angle: float, radius: float) -> Point:
        return middle + radius * sin(angle), FOOT + middle + radius * cos(angle)

    bold = belonging(dots, theorem)
    for dot in dots:
        for name in dot.rests_on:
            ends = [place(angles[one], RADIUS - 5) for one in (dot.name, name)]
            kept = 1 - PULL * min(1, dist(*ends) / RADIUS)
            control = [
                centre + kept * (sum(pair) / 2 - centre)
                for centre, pair in zip((middle, FOOT + middle), zip(*ends))
            ]
            curve = Path([ends[0], control, ends[1]], [Path.MOVETO, Path.CURVE3, Path.CURVE3])
            weight: Style = (
                {"linewidth": 1.3} if {dot.name, name} <= bold else {"linewidth": 0.6, "alpha": 0.6}
            )
            colour = MARKS[dot.verdict][1]
            figure.add_artist(
                PathPatch(
                    curve,
                    fill=False,
                    edgecolor=colour,
                    transform=plane.points,
                    gid=f"from-{dot.name}-to-{name}",
                    **weight,
                ),
                clip=False,
            )
        size = 3.4 if dot.name in bold else 1.9
        _mark(plane, place(angles[dot.name], RADIUS), dot.verdict, size, dot.name)
    for section, members in groupby(dots, lambda dot: dot.section):
        own = [angles[dot.name] for dot in members]
        _label(plane, place((own[0] + own[-1]) / 2, RADIUS + 8), (own[0] + own[-1]) / 2, section)
    for k, verdict in enumerate(MARKS):
        x = 72 * WIDTH * (k + 0.3) / len(MARKS)
        _mark(plane, (x, 8), verdict, 3)
        plane.words((x + 6, 8), verdict, ha="left", fontsize=9)
    return figure


def _angles(dots: Sequence[Dot]) -> dict[str, float]:
    """The angle of each claim, clockwise from the top."""
    sections = len(list(groupby(dots, lambda dot: dot.section)))
    turn = 2 * pi / max(1, len(dots) + APART * sections)
    found, steps, section = dict[str, float](), 0, None
    for dot in dots:
        steps += APART if dot.section != section else 0
        section = dot.section
        found[dot.name] = turn * steps
        steps += 1
    return found


def belonging(dots: Iterable[Dot], theorem: str) -> set[str]:
    """The theorem's claim, the claims that it rests on, and those that rest on it.

    >>> rests_on = {"a": ("b",), "b": ("c",), "c": (), "d": ("c",)}
    >>> dots = [Dot(name, "1", "holds", below) for name, below in rests_on.items()]
    >>> sorted(belonging(dots, "b")), belonging(dots, "")
    (['a', 'b', 'c'], set())
    """
    below = {dot.name: dot.rests_on for dot in dots}
    if theorem not in below:
        return set()
    above = {name: [one for one, names in below.items() if name in names] for name in below}
    found = set()
    for ways in (below, above):
        waiting = [theorem]
        while waiting:
            name = waiting.pop()
            found.add(name)
            waiting += [one for one in ways[name] if one not in found]
    return found


def _mark(plane: Plane, at: Point, verdict: str, size: float, name: str = "") -> None:
    shape, colour = MARKS[verdict]
    marker = MarkerStyle(shape)
    outline = marker.get_path().transformed(marker.get_transform() + Affine2D().scale(2 * size))
    style: Style = {"facecolor": colour, "edgecolor": "none"}
    if shape == "o":  # the end of a line is round, in a tenth of the bytes of a circle
        outline = Path([(0, -0.2), (0, 0.2)])
        style = {
            "facecolor": "none",
            "edgecolor": colour,
            "linewidth": 2 * size,
            "capstyle": "round",
        }
    if name:
        style["url"] = f"#{name}"
    moved = Affine2D().translate(*at) + plane.points
    plane.figure.add_artist(PathPatch(outline, transform=moved, zorder=4, **style), clip=False)


def _label(plane: Plane, at: Point, angle: float, text: str) -> None:
    """Writes outwards, so that the text stands upright on both sides."""
    left = angle > pi
    plane.words(
        at,
        text,
        rotation=degrees(pi / 2 - angle) + (180 if left else 0),
        rotation_mode="anchor",
        ha="right" if left else "left",
        fontsize=7.5,
    )
