"""What the pictures of simulations have in common: a plane with a title of two lines, a key of
colours, and white behind it.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from matplotlib.figure import Figure

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.figures.drawing import Plane, Sides, blank, svg

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
    """A plane in a new figure of this size in points, so much of it left free at the right and at
    the bottom.  SceneError for sides that floats do not tell apart.
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
