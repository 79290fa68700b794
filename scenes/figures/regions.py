"""Figures 5 and 6: the half plane H of the states, and what the table does to them: B1 (it strikes
within the period) and B2 (it does not).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from scenes.figures import states
from scenes.figures.drawing import B1, B2, PLAIN, blank, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BOX = (0.135, 0.15, 0.84, 0.82)
ACROSS, UP = (-0.35, 2.3), (-2.2, 2.2)
REACH = 6.0  # beyond the right edge of the axes, in units of height
BEYOND = (-3.0, 3.0)  # beyond their lower and upper edges


@styled
def half_plane() -> Figure:
    """Figure 5: H, the states with the ball on or above the table."""
    figure = blank(4.6, 3.2)
    plane = states.StatePlane(figure, BOX, ACROSS, UP)
    plane.fill(states.outline_h(REACH, BEYOND), "H", PLAIN)
    plane.text((1.15, 0.9), r"$\mathcal{H}$", fontsize=20)
    plane.text((1.15, 0.42), r"$\bar\beta \geq 0$: ball on or above the table")
    plane.text((-0.17, -1.1), "below the table", rotation=90, alpha=0.8)
    plane.text((0, -1.75), r"$\bar\beta = 0$", (8, 0), ha="left")
    return figure


@styled
def strikes_and_flights() -> Figure:
    """Figure 6: B1, B2 and the line between them, which belongs to B2."""
    figure = blank(4.6, 3.2)
    plane = states.StatePlane(figure, BOX, ACROSS, UP)
    plane.fill(states.outline_b1(BEYOND[0]), "B1", B1)
    plane.fill(states.outline_b2(REACH, BEYOND), "B2", B2)
    plane.draw([states.bounce_line(BEYOND[0])], "bounce-line", linewidth=1.6)
    plane.text((0.45, -1.0), r"$\mathcal{B}_1$", fontsize=18)
    plane.text((0.45, -1.4), "struck within\nthe period", va="top", linespacing=1.0)
    plane.text((1.55, 1.2), r"$\mathcal{B}_2$", fontsize=18)
    plane.text((1.55, 0.8), "not struck\nwithin the period", va="top", linespacing=1.0)
    plane.name(states.bounce_line(BEYOND[0]), -0.4, r"$\tau_c = T$")
    plane.name(
        states.bounce_line(BEYOND[0]),
        -0.75,
        r"$\partial\mathcal{B}_2 \subset \mathcal{B}_2$",
        above=False,
    )
    return figure
