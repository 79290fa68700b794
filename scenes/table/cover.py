"""Which boxes of parameters are certified, in the plane of restitution and drive."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from juggleproof.scenes.figures.arcs import Place, joined
from juggleproof.scenes.figures.drawing import Plane, Sides, spaced, style, ticks
from juggleproof.scenes.figures.look import KEPT, PLAIN, Look, R
from juggleproof.scenes.table.curves import birth, doubling, gamma_of, grazing
from juggleproof.scenes.table.plane import LETTERS, axes, on_white

Asked = tuple[Sides, str, Sides]  # alpha, and Gamma or g
Box = tuple[tuple[float, float], tuple[float, float]]  # of alpha, of g
SIZE, RIGHT = (600.0, 340.0), 120.0  # points
POINTS = 60  # of a curve
CERTIFIED = Look(R.colour, "", tint=0.35)
OPEN = Look(KEPT.colour, "", tint=0.6)
CURVES: tuple[tuple[str, str, Callable[[float], float], tuple[float, ...]], ...] = (
    ("birth", "birth of the bounce", birth, ()),
    ("grazing", "a second orbit below", grazing, (6, 2)),
    ("doubling", "the bounce unstable above", doubling, (1, 1.5)),
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
            for number, box in enumerate(boxes):
                outline = joined(_outline(box))
                plane.area(outline, f"{name}-{number}", look)
                plane.line(outline, f"{name}-{number}-edge", look, linewidth=0.5)
        for name, label, curve, dashes in CURVES:
            _draw_curve(plane, name, label, curve, Look(PLAIN.colour, "", dashes))
        for number, one in enumerate(outlines):
            plane.line(joined(one), f"asked-{number}", linewidth=1.2)
    return on_white(plane.figure, "cover")


def _plane(points: Sequence[Place], certified: int, left: int) -> Plane:
    """These points with a margin, which reaches the curves where they are not far."""
    alpha, gamma = ((min(ends), max(ends)) for ends in zip(*points))
    margin = max(0.01, 0.3 * (alpha[1] - alpha[0]))
    across = max(0.0, alpha[0] - margin), min(0.999, alpha[1] + margin)
    ends = [curve(end) for _, _, curve, _ in CURVES for end in alpha]
    up = min(gamma[0], *ends) - 0.05, max(gamma[1], *ends) + 0.05
    counts = f"{certified} boxes where every motion tends to the bounce of one period, certified"
    counts += f"; {left} left" if left else ""
    plane = axes(SIZE, RIGHT, across, up, ("A table that moves as a sine", counts))
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


def _draw_curve(
    plane: Plane, name: str, label: str, curve: Callable[[float], float], look: Look
) -> None:
    """One of the curves, where it is within the plane, with its name at its end."""
    low, high = plane.across
    along = [low + (high - low) * k / POINTS for k in range(POINTS + 1)]
    points = [(x, y) for x in along if plane.up[0] <= (y := curve(x)) <= plane.up[1]]
    plane.line(joined(points), name, look, linewidth=1.0)
    if points:
        leaves = points[-1][0] < high  # by the lower side, where the axis is
        side = "bottom" if leaves else "center"
        plane.text(points[-1], label, (5, 0), ha="left", va=side, fontsize=LETTERS)
