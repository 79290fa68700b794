"""Figure 3: the boundary of R and its images under f, cut where f jumps."""

from __future__ import annotations

from functools import cache
from math import dist
from typing import TYPE_CHECKING

from scenes.figures import states
from scenes.figures.arcs import Arc, cut_at_the_bounce, images, straight
from scenes.figures.drawing import B1, B2, R, blank, styled
from symbolic import e_1

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STEPS = 6  # images shown, the boundary itself being the first
WHOLE, CLOSE = (
    ((0.0, 1.75), (-2.4, 2.4)),
    ((0.0, 0.9), (-1.0, 0.2)),
)  # the axes of the upper and of the lower row


@cache
def boundary_image(step: int) -> tuple[Arc, ...]:
    """f^step of the boundary of R: its arc and the edge beta = 0, in pieces that f has not torn."""
    if step:
        return tuple(images(boundary_image(step - 1)))
    arc = states.region_boundary()
    return arc, straight(arc.at(arc.stop), arc.at(arc.start))


def torn_ends(step: int) -> list[tuple[float, float]]:
    """Where f has torn the image so far: the ends of its pieces, but for those of the boundary
    itself and those that still meet.
    """
    whole = {end for arc in boundary_image(0) for end in (arc.start, arc.stop)}
    ends = [
        (end, arc.at(end))
        for arc in boundary_image(step)
        for end in (arc.start, arc.stop)
        if end not in whole
    ]
    return [
        at
        for end, at in ends
        if sum(same == end and dist(at, other) < 1e-9 for same, other in ends) == 1
    ]


@styled
def boundary_under_f() -> Figure:
    """Figure 3: f^n of the boundary of R for n = 0 to 5; where the next period brings a strike in
    one colour, elsewhere in the other.
    """
    figure = blank(5.4, 4.3)
    for step in range(STEPS):
        row, column = divmod(step, 3)
        labels = (states.HEIGHT if row else "", "" if column else states.VELOCITY)
        box = (0.125 + 0.297 * column, 0.575 - 0.46 * row, 0.272, 0.4)
        plane = states.StatePlane(
            figure, box, *(CLOSE if row else WHOLE), labels, numbered=not column
        )
        draw_image(plane, step)
        plane.text((0.14, -0.9) if row else (1.3, 2.05), f"$n$ = {step}")
        if step == STEPS // 2 - 1:
            (left, right), (low, high) = CLOSE
            corners = [(left, low), (right, low), (right, high), (left, high)]
            sides = [straight(one, other) for one, other in zip(corners, corners[1:])]
            plane.line(sides, "frame-of-lower-row", linewidth=0.7, linestyle=(0, (2, 2)))
    return figure


def draw_image(plane: states.StatePlane, step: int) -> None:
    """Draws f^step of the boundary, its torn ends, the boundary itself, the line at which f jumps,
    and e_1.
    """
    plane.draw([states.bounce_line(-4.0)], f"bounce-line-{step}", linewidth=0.7)
    if step:
        plane.draw([states.region_boundary()], f"boundary-of-R-{step}", R, linewidth=0.8, alpha=0.8)
    parts = [part for arc in boundary_image(step) for part in cut_at_the_bounce(arc)]
    plane.draw(
        [arc for arc, strikes in parts if strikes],
        f"image-{step}-in-B1",
        B1,
        linewidth=1.8,
        zorder=3,
    )
    plane.draw(
        [arc for arc, strikes in parts if not strikes],
        f"image-{step}-in-B2",
        B2,
        linewidth=1.8,
        zorder=3,
    )
    h, s = states.units()
    ends = [(x / h, y / s) for x, y in torn_ends(step)]
    if ends:
        plane.dots(ends, f"torn-ends-{step}", 2.6, filled=False)
    plane.dots([states.at(e_1())], f"e-1-{step}", 7, "+")
