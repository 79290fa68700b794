"""Figures saved to the same bytes from run to run; and a plane to draw on."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import wraps
from math import atan2, ceil, cos, degrees, floor, hypot, inf, log10, pi, sin
from typing import Any, ParamSpec, TypeAlias, TypeVar

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.text import Text
from matplotlib.transforms import Affine2D, Bbox, Transform, TransformedBbox
from numpy.typing import NDArray

from juggleproof.drawing.lines import Arc, Point
from juggleproof.drawing.look import INK, STYLE, Look
from juggleproof.scenes.errors import SceneError

# -------------------------------------------------------------------------------------------------
# How figures are saved: bytes that are the same from run to run.

P = ParamSpec("P")
Drawn = TypeVar("Drawn")
Style: TypeAlias = Any  # what a keyword of matplotlib takes


@contextmanager
def style(**settings: Style) -> Iterator[None]:
    """The style, and more settings of matplotlib, for as long as the block lasts."""
    with rc_context({**STYLE, **settings}):
        yield


def styled(draw: Callable[P, Drawn]) -> Callable[P, Drawn]:
    """The same function, drawing in this style."""

    @wraps(draw)
    def drawn(*args: P.args, **kwargs: P.kwargs) -> Drawn:
        with style():
            return draw(*args, **kwargs)

    return drawn


def blank(width: float, height: float) -> Figure:
    """An empty figure of this size in inches."""
    return Figure(figsize=(width, height))


def svg(figure: Figure, slug: str) -> bytes:
    """The figure as an SVG file in which every id begins with the slug, so that several can stand
    in one page.
    """
    text = io.StringIO()
    with style(**{"svg.hashsalt": slug}):
        FigureCanvasSVG(figure).print_svg(
            text, metadata={"Date": None, "Creator": None, "Type": None, "Format": None}
        )
    return _with_own_ids(text.getvalue(), slug).encode("utf-8")


def _with_own_ids(text: str, slug: str) -> str:
    """The same file in fewer bytes, with ids distinct from those of other figures; glyphs, which
    it uses most, have the shortest ids.
    """
    text = text.replace("xlink:href=", "href=").replace(
        ' xmlns:xlink="http://www.w3.org/1999/xlink"', ""
    )
    text = text.replace(' target="_blank"', "")  # links lead to places of the same page
    glyphs = list(dict.fromkeys(re.findall(r'<use href="#([^"]*)"', text)))
    short = {glyph: f"{slug}-{count:x}" for count, glyph in enumerate(glyphs)}
    text = re.sub(r"<!--.*?-->|<!DOCTYPE[^>]*>", "", text, flags=re.DOTALL)
    text = re.sub(
        r'(\sid="|<use [^>]*?href="#|url\(#)([^")]*)',
        lambda match: match[1] + short.get(match[2], f"{slug}-{match[2]}"),
        text,
    )
    text = re.sub(r'(<use [^>]*?)transform="translate\(([-\d.]+) ([-\d.]+)\)"', _placed, text)
    return (
        re.sub(r">\s+<", "><", re.sub(r"\s*\n\s*", " ", text)).replace(' "/>', '"/>').strip() + "\n"
    )


def _placed(use: re.Match[str]) -> str:
    return use[1] + " ".join(
        f'{name}="{round(float(at), 1):g}"'
        for name, at in (("x", use[2]), ("y", use[3]))
        if float(at)
    )


def pdf(figure: Figure) -> bytes:
    """The figure as a PDF file, without a date."""
    from matplotlib.backends.backend_pdf import FigureCanvasPdf

    data = io.BytesIO()
    with style():
        FigureCanvasPdf(figure).print_pdf(
            data, metadata={"CreationDate": None, "Creator": None, "Producer": None}
        )
    return data.getvalue()


# -------------------------------------------------------------------------------------------------
# The plane.
#
# A plane with two axes in a figure: curves, areas, dots, arrows and words put on it.
#
# Lighter than matplotlib's Axes, whose ticks and layout cost more than all that is drawn here.
# Curves keep their own coordinates.

Sides = tuple[float, float]
Box = tuple[float, float, float, float]  # left, bottom, width and height, in parts of the figure's
TICK, HEAD = 3.5, 6.0  # the lengths of a tick and of an arrow's head, in points
NUMBERS, LABELS = 9.0, 11.0  # sizes of letters


class Plane:
    """A part of a figure with its own coordinates: `across` and `up` are the ranges that it shows,
    `box` is its place.
    """

    def __init__(self, figure: Figure, box: Box, across: Sides, up: Sides) -> None:
        self.figure, self.across, self.up = figure, across, up
        width, height = (72 * float(size) for size in figure.get_size_inches())
        self.left, self.bottom, self.width, self.height = (
            box[0] * width,
            box[1] * height,
            box[2] * width,
            box[3] * height,
        )
        self.scale = (self.width / (across[1] - across[0]), self.height / (up[1] - up[0]))
        self.points: Transform = Affine2D().scale(1 / 72) + figure.dpi_scale_trans
        own = (
            Affine2D()
            .scale(*self.scale)
            .translate(self.left - across[0] * self.scale[0], self.bottom - up[0] * self.scale[1])
        )
        self.own: Transform = own + self.points
        corners = [[self.left, self.bottom], [self.left + self.width, self.bottom + self.height]]
        self.window = TransformedBbox(Bbox(corners), self.points)

    def place(self, x: float, y: float) -> Point:
        """Where a point of the plane lies in the figure, in points of print."""
        return (
            self.left + (x - self.across[0]) * self.scale[0],
            self.bottom + (y - self.up[0]) * self.scale[1],
        )

    def line(
        self, arcs: Sequence[Arc], name: str | None, look: Look | None = None, **style: Style
    ) -> None:
        """Draws arcs as one curve, joined only where one ends at the very point where the next
        starts; draws nothing if there are no arcs.
        """
        if arcs:
            dashes = {"linestyle": (0, tuple(look.dashes))} if look and look.dashes else {}
            self._patch(
                path(arcs),
                name,
                **{
                    "fill": False,
                    "edgecolor": look.colour if look else INK,
                    "linewidth": 1.4,
                    **dashes,
                    **style,
                },
            )

    def area(self, arcs: Sequence[Arc], name: str, look: Look) -> None:
        """Fills what the closed chain of arcs surrounds: a tint of the colour, and its hatch."""
        outline = path(arcs)
        self._patch(
            outline, name, facecolor=look.colour, edgecolor="none", alpha=look.tint, zorder=0.5
        )
        self._patch(
            outline,
            f"{name}-hatch",
            fill=False,
            edgecolor=look.colour,
            hatch=look.hatch,
            linewidth=0,
            alpha=look.hatched,
            zorder=0.6,
        )

    def dots(
        self,
        places: Iterable[Point],
        name: str,
        size: float = 3.6,
        marker: str = "o",
        filled: bool = True,
        colour: str = INK,
    ) -> None:
        """Dots, or other markers of matplotlib, at points of the plane."""
        xs, ys = zip(*(self.place(*one) for one in places))
        self.figure.add_artist(
            Line2D(
                xs,
                ys,
                linestyle="none",
                marker=marker,
                markersize=size,
                color=colour,
                markeredgewidth=0.9,
                gid=name,
                markerfacecolor=colour if filled else "none",
                transform=self.points,
                zorder=5,
            )
        )

    def text(self, at: Point, label: str, shift: Point = (0, 0), **style: Style) -> None:
        """Writes at a point of the plane, shifted by points of print, about its middle unless
        aligned otherwise.
        """
        self.words(self.place(*at), label, shift, **style)

    def words(self, at: Point, label: str, shift: Point = (0, 0), **style: Style) -> None:
        """Writes at a place of the figure in points of print."""
        if not label:
            return
        style = {"ha": "center", "va": "center", "transform": self.points, "zorder": 6, **style}
        self.figure.add_artist(Text(at[0] + shift[0], at[1] + shift[1], label, **style))

    def along(
        self,
        arc: Arc,
        parameter: float,
        label: str,
        above: bool = True,
        gap: float = 3,
    ) -> None:
        """Writes along a curve, `gap` points above or below its point with the parameter."""
        x, y = self.place(*arc.at(parameter))
        dx, dy = (slope * scale for slope, scale in zip(arc.slope(parameter), self.scale))
        angle = atan2(dy, dx)
        angle -= pi * round(angle / pi)  # upright: between -90 and 90 degrees
        side = gap if above else -gap
        self.words(
            (x, y),
            label,
            (-side * sin(angle), side * cos(angle)),
            rotation=degrees(angle),
            rotation_mode="anchor",
            va="bottom" if above else "top",
        )

    def arrow(
        self,
        tail: Point,
        tip: Point,
        colour: str = INK,
        width: float = 0.8,
        both: bool = False,
        short: float = 0,
    ) -> None:
        """Draws an arrow between two points of the plane, with a head at the tip or at both ends;
        it ends `short` points before them.
        """
        (x, y), (far_x, far_y) = self.place(*tail), self.place(*tip)
        length = hypot(far_x - x, far_y - y)
        dx, dy = (far_x - x) / length, (far_y - y) / length
        ends = [
            (x + dx * short, y + dy * short, dx, dy),
            (far_x - dx * short, far_y - dy * short, -dx, -dy),
        ]
        vertices, codes = [end[:2] for end in ends], [Path.MOVETO, Path.LINETO]
        for at_x, at_y, back_x, back_y in ends if both else ends[1:]:
            head = [
                (
                    at_x + HEAD * back_x + side * HEAD / 3 * back_y,
                    at_y + HEAD * back_y - side * HEAD / 3 * back_x,
                )
                for side in (1, -1)
            ]
            vertices += [(at_x, at_y), *head, (at_x, at_y)]
            codes += [Path.MOVETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY]
        self._patch(
            Path(vertices, codes),
            None,
            facecolor=colour,
            edgecolor=colour,
            linewidth=width,
            joinstyle="miter",
            transform=self.points,
            zorder=2.5,
        )

    def frame(
        self,
        across: Mapping[float, str],
        up: Mapping[float, str],
        label: str = "",
        label_up: str = "",
        room: float = 20,
    ) -> None:
        """Draws the two axes with their ticks, numbers and labels; the label of the upward one
        stands `room` points to the left.
        """
        left, bottom, right, top = (
            self.left,
            self.bottom,
            self.left + self.width,
            self.bottom + self.height,
        )
        lines = (
            [[(left, top), (left, bottom), (right, bottom)]]
            if up
            else [[(left, bottom), (right, bottom)]]
        )
        for value, number in across.items():
            x = self.place(value, 0)[0]
            lines.append([(x, bottom), (x, bottom - TICK)])
            self.words((x, bottom), number, (0, -TICK - 3), va="top", fontsize=NUMBERS)
        for value, number in up.items():
            y = self.place(0, value)[1]
            lines.append([(left, y), (left - TICK, y)])
            self.words(
                (left, y),
                number,
                (-TICK - 3, 0),
                ha="right",
                va="center_baseline",
                fontsize=NUMBERS,
            )
        self._patch(
            polylines(lines),
            None,
            fill=False,
            edgecolor=INK,
            linewidth=0.7,
            transform=self.points,
            clip_on=False,
            capstyle="projecting",
        )
        if label:
            self.words(((left + right) / 2, bottom), label, (0, -20), va="top", fontsize=LABELS)
        if label_up:
            self.words(
                (left, (bottom + top) / 2),
                label_up,
                (-room, 0),
                ha="right",
                rotation=90,
                fontsize=LABELS,
            )

    def _patch(self, outline: Path, name: str | None, clip_on: bool = True, **style: Style) -> None:
        style = {"transform": self.own, "capstyle": "butt", **style}
        patch = PathPatch(outline, gid=name, **style)
        if clip_on:
            patch.set_clip_box(self.window)
        self.figure.add_artist(patch, clip=False)


def path(arcs: Sequence[Arc]) -> Path:
    """The arcs as a path; each is a quadratic Bezier curve, which a parabola is, or a straight
    line.
    """
    vertices: list[Point] = []
    codes: list[np.uint8] = []
    for arc in arcs:
        start, control, stop = arc.bezier()
        if not vertices or vertices[-1] != start:
            vertices.append(start)
            codes.append(Path.MOVETO)
        bent = arc.across[2] or arc.up[2]
        vertices += [control, stop] if bent else [stop]
        codes += [Path.CURVE3, Path.CURVE3] if bent else [Path.LINETO]
    return Path(vertices, codes)


def polylines(lines: Sequence[Sequence[Point]]) -> Path:
    """Several lines as one path, each apart from the others."""
    codes = [code for line in lines for code in [Path.MOVETO, *[Path.LINETO] * (len(line) - 1)]]
    return Path([point for line in lines for point in line], codes)


def raster(plane: Plane, colours: NDArray[np.uint8]) -> None:
    """Fills the plane with an image, shape (rows from below, columns, 3 or 4)."""
    width, height = (72 * float(side) for side in plane.figure.get_size_inches())
    axes = plane.figure.add_axes(
        (
            plane.left / width,
            plane.bottom / height,
            plane.width / width,
            plane.height / height,
        )
    )
    axes.set_axis_off()
    axes.imshow(colours, origin="lower", aspect="auto", interpolation="none", gid="raster")


def spaced(low: float, high: float) -> list[float]:
    """Round numbers within these ends, three to eight of them.

    >>> spaced(0, 40), spaced(-0.2, 0.9)
    ([0.0, 10.0, 20.0, 30.0, 40.0], [-0.2, 0.0, 0.2, 0.4, 0.6, 0.8])
    """
    power = floor(log10(high - low)) - 1
    step = (
        next(part for part in (1, 2, 5, 10, 20) if (high - low) / (part * 10.0**power) <= 7)
        * 10.0**power
    )
    return [
        round(k * step, max(0, -power))
        for k in range(ceil(low / step - 1e-9), floor(high / step + 1e-9) + 1)
    ]


def ticks(values: Iterable[float]) -> dict[float, str]:
    """Numbers as ticks, with a true minus sign."""
    return {value: f"{value:g}".replace("-", "\N{MINUS SIGN}") for value in values}


# -------------------------------------------------------------------------------------------------
# What the pictures of simulations have in common: a plane with a title of two lines, a key of
# colours, and white behind it.

LEFT, BOTTOM, TOP, LINE = 48.0, 44.0, 48.0, 15.0  # points
LETTERS = 8.0
Title = tuple[str, str]  # what is shown, and in smaller letters how it was found


def axes(
    size: tuple[float, float],
    right: float,
    across: Sides,
    up: Sides,
    title: Title,
    bottom: float = BOTTOM,
) -> Plane:
    """A plane in a new figure of this size in points, with `right` and `bottom` points left free on
    these sides.  Raises SceneError for ends of a side that floats do not tell apart.
    """
    for low, high in (across, up):
        if not 1e-9 * max(abs(low), abs(high)) < high - low < inf:
            raise SceneError(
                f"from {low:g} to {high:g} cannot be drawn; give ends that are further apart, or"
                " nearer to 0"
            )
    width, height = size
    box = (
        LEFT / width,
        bottom / height,
        1 - (LEFT + right) / width,
        1 - (bottom + TOP) / height,
    )
    plane = Plane(blank(width / 72, height / 72), box, across, up)
    plane.words((LEFT, height - 10), title[0], ha="left", fontsize=11)
    plane.words((LEFT, height - 26), title[1], ha="left", fontsize=LETTERS)
    return plane


def key(plane: Plane, entries: Sequence[tuple[str, str]]) -> None:
    """Colours and what they mean, at the right."""
    right, top = plane.left + plane.width, plane.bottom + plane.height
    own = Plane(plane.figure, (0, 0, 1, 1), (0, 1), (0, 1))
    for line, (colour, text) in enumerate(entries):
        y = top - LINE * (line + 0.5)
        own.dots([((right + 12) / own.width, y / own.height)], f"key-{line}", 8, "s", colour=colour)
        own.words((right + 20, y), text, ha="left", va="center_baseline", fontsize=8.5)


def on_white(figure: Figure, slug: str) -> bytes:
    """The figure as SVG, on white, so that it can be read on a dark page."""
    figure.set_facecolor("white")
    return svg(figure, slug)
