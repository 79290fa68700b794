"""Pictures over restitution and drive: which boxes are certified, between the curves; what balls
come to, simulated.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from juggleproof.drawing.drawing import (
    LETTERS,
    TOP,
    Plane,
    Sides,
    axes,
    on_white,
    raster,
    spaced,
    style,
    ticks,
)
from juggleproof.drawing.lines import Arc, Place, joined
from juggleproof.drawing.look import B1, B2, KEPT, LOSS, PLAIN, Look, R
from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.table.attractors import MOST, attractors
from juggleproof.scenes.table.curves import birth, doubling, gamma_of, grazing, own_grazing

Asked = tuple[Sides, str, Sides]  # alpha, and Gamma or g
Box = tuple[tuple[float, float], tuple[float, float]]  # of alpha, of g
Entry = tuple[str, Look, str]  # of a key: what it is drawn as (area, box or line), and in words
Curve = tuple[str, str, Callable[[float], float], tuple[float, ...]]
SIZE, RIGHT = (640.0, 340.0), 176.0  # points; the key stands at the right
POINTS = 400  # of a curve
COLUMNS, ROWS = 160, 120  # of a raster
CERTIFIED = Look(R.colour, "", tint=0.35)
OPEN = Look(KEPT.colour, "", tint=0.6)
WHITE = Look("#FFFFFF", "", tint=1.0)
CURVES: tuple[Curve, ...] = (
    ("birth", "birth of the bounce", birth, ()),
    ("own-grazing", "below: the table is in its way", own_grazing, (4, 1.5, 1, 1.5)),
    ("grazing", "below: a second orbit", grazing, (6, 2)),
    ("doubling", "above: it is unstable", doubling, (1, 1.5)),
)
KINDS = (  # by number of a kind of attractors
    (B1.colour, "all starts come to the bounce"),
    (LOSS.colour, "some starts do"),
    (B2.colour, "all rest again and again"),
    ("#D8D8D8", "anything else, or slow"),
)


def cover(asked: Sequence[Asked], certified: Sequence[Box], left: Sequence[Box]) -> bytes:
    """The rectangles that are asked for, the boxes that are certified and those that are left, and
    the curves between which the theorem may hold, as SVG.
    """
    outlines = [
        _outline((alpha, ends)) if drive == "g" else _rectangle(alpha, ends)
        for alpha, drive, ends in asked
    ]
    with style():
        plane = _plane([point for one in outlines for point in one], len(certified), len(left))
        for name, boxes, look in ("certified", certified, CERTIFIED), ("left", left, OPEN):
            if boxes:
                plane.area(_outlines(boxes), name, look)
                plane.line(_outlines(boxes), f"{name}-edge", look, linewidth=0.5)
        key = [entry for curve in CURVES for entry in _draw_curve(plane, *curve)]
        for number, one in enumerate(outlines):
            plane.line(joined(one), f"asked-{number}", linewidth=1.2)
        _draw_key(plane, key)
    return on_white(plane.figure, "cover")


def attractor_map(alpha: Sides, gamma: Sides, certified: Sequence[Box]) -> bytes:
    """What balls come to for the pairs of a rectangle, simulated; over it the curves, and the
    outlines of boxes that are certified, as SVG.  Raises SceneError where the rectangle has no
    width, or is not within 0 <= alpha < 1 and 0 < Gamma.
    """
    if not (0 <= alpha[0] < alpha[1] < 1 and 0 < gamma[0] < gamma[1]):
        raise SceneError("attractors: give --alpha A0:A1 within 0 and 1, and --gamma G0:G1 above 0")
    across, up = (
        [low + (high - low) * (k + 0.5) / count for k in range(count)]
        for (low, high), count in ((alpha, COLUMNS), (gamma, ROWS))
    )
    found = attractors([(one, drive) for drive in up for one in across])
    inside = [box for box in certified if _meets(box, alpha, gamma)]
    palette = np.array([list(bytes.fromhex(colour[1:])) for colour, _ in KINDS], dtype=np.uint8)
    key: list[Entry] = [
        ("area", _filled(kind), f"{words}: {int((found.kinds == kind).sum()):,}")
        for kind, (_, words) in enumerate(KINDS)
    ]
    with style():
        counts = (
            f"simulated at {found.kinds.size:,} points, {found.starts} starts each,"
            f" {found.flights:,} flights, {MOST} of a ball at most"
        )
        title = "What balls come to on a table that moves as a sine"
        plane = _framed(alpha, gamma, (title, counts))
        raster(plane, palette[found.kinds.reshape(ROWS, COLUMNS)])
        plane.line(_outlines(inside), "certified", WHITE, linewidth=0.3)
        if inside:
            key.append(("box", _filled(0), f"certified, every motion: {len(inside)} boxes"))
        for curve in CURVES:
            key += _draw_curve(plane, *curve)
        _draw_key(plane, key)
    return on_white(plane.figure, "attractors")


def _filled(kind: int) -> Look:
    """The colour of a kind of attractors, in a key."""
    return Look(KINDS[kind][0], "", tint=1.0)


def _meets(box: Box, alpha: Sides, gamma: Sides) -> bool:
    """Whether the box in (alpha, g) has a point in the rectangle."""
    (low, high), (g_low, g_high) = box
    low, high = max(low, alpha[0]), min(high, alpha[1])
    return low <= high and gamma_of(high, g_low) <= gamma[1] and gamma[0] <= gamma_of(low, g_high)


def _plane(points: Sequence[Place], certified: int, left: int) -> Plane:
    """These points with a margin, which reaches the curves where they are not far."""
    alpha, gamma = ((min(ends), max(ends)) for ends in zip(*points))
    margin = max(0.01, 0.3 * (alpha[1] - alpha[0]))
    across = max(0.0, alpha[0] - margin), min(0.999, alpha[1] + margin)
    ends = [curve(end) for _, _, curve, _ in CURVES for end in alpha]
    up = min(gamma[0], *ends) - 0.05, max(gamma[1], *ends) + 0.05
    counts = f"{certified} boxes where every motion tends to the bounce of one period, certified"
    counts += f"; {left} left" if left else ""
    return _framed(across, up, ("A table that moves as a sine", counts))


def _framed(across: Sides, up: Sides, title: tuple[str, str]) -> Plane:
    """A plane of alpha and Gamma with its axes, and room for a key."""
    plane = axes(SIZE, RIGHT, across, up, title)
    plane.frame(
        ticks(spaced(*across)), ticks(spaced(*up)), r"restitution $\alpha$", r"drive $\Gamma$", 30
    )
    return plane


def _rectangle(alpha: Sides, gamma: Sides) -> list[Place]:
    """The corners of a rectangle."""
    (a, b), (c, d) = alpha, gamma
    return [(a, c), (b, c), (b, d), (a, d), (a, c)]


def _outline(box: Box) -> list[Place]:
    """The box in (alpha, g), drawn in (alpha, Gamma)."""
    (low, high), g = box
    along = [low + (high - low) * k / 4 for k in range(5)]
    points = [(x, gamma_of(x, g[0])) for x in along]
    points += [(x, gamma_of(x, g[1])) for x in reversed(along)]
    return [*points, points[0]]


def _outlines(boxes: Sequence[Box]) -> list[Arc]:
    """The outlines of all boxes."""
    return [arc for box in boxes for arc in joined(_outline(box))]


def _draw_curve(
    plane: Plane,
    name: str,
    label: str,
    curve: Callable[[float], float],
    dashes: tuple[float, ...],
) -> list[Entry]:
    """Draws one of the curves, where it is within the plane and parts from those before it; returns
    its entry in a key, if any of it is seen.
    """
    low, high = plane.across
    drawn: list[Place] = []
    for x in (low + (high - low) * k / POINTS for k in range(POINTS + 1)):
        y, others = curve(x), (birth(x), doubling(x))
        if plane.up[0] <= y <= plane.up[1] and (curve in (birth, doubling) or y not in others):
            drawn.append((x, y))
    if not drawn:
        return []
    look = Look(PLAIN.colour, "", dashes)
    plane.line(joined(drawn), name, look, linewidth=1.0)
    return [("line", look, label)]


def _square(middle: Place, half: float) -> Sequence[Arc]:
    """A square round a point."""
    x, y = middle
    return joined(_rectangle((x - half, x + half), (y - half, y + half)))


def _draw_key(beside: Plane, entries: Sequence[Entry]) -> None:
    """The entries below each other, at the right of a plane."""
    (width, height), left = SIZE, SIZE[0] - RIGHT + 12
    tall = 14.0 * len(entries)
    box = left / width, 1 - (TOP + tall) / height, (RIGHT - 16) / width, tall / height
    key = Plane(beside.figure, box, (0.0, RIGHT - 16), (-14.0 * len(entries), 0.0))
    for number, (kind, look, words) in enumerate(entries):
        y = -14.0 * number - 7
        if kind == "line":
            key.line(joined([(0, y), (22, y)]), f"key-{number}", look, linewidth=1.0)
        else:
            key.area(_square((11, y), 5), f"key-{number}", look)
        if kind == "box":
            key.line(_square((11, y), 3), f"key-{number}-edge", WHITE, linewidth=0.8)
        key.text((28, y), words, ha="left", va="center", fontsize=LETTERS)
