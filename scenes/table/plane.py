"""What the pictures of the table have in common: a plane with a title, and white behind it."""

from __future__ import annotations

from matplotlib.figure import Figure

from juggleproof.scenes.figures.drawing import Plane, Sides, blank, svg

LEFT, BOTTOM, TOP = 48.0, 44.0, 48.0  # points
LETTERS = 8.0


def axes(
    size: tuple[float, float], right: float, across: Sides, up: Sides, title: tuple[str, str]
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
    plane.words((LEFT, height - 26), title[1], ha="left", fontsize=LETTERS)
    return plane


def on_white(figure: Figure, slug: str) -> bytes:
    """The figure as SVG, on white, so that it can be read on a dark page."""
    figure.set_facecolor("white")
    return svg(figure, slug)
