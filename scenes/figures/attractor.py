"""Figures 12, 13 and 14: the region R, the point p that must lie outside it, and the band around
e_1 in it.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from scenes.figures import states
from scenes.figures.arcs import Arc, straight, zeros
from scenes.figures.drawing import B1, B2, BAND, KEPT, R, blank, styled
from scenes.figures.numbers import SETTING, value
from symbolic import e_1, energy_of_p, point_p, relative_kinetic_energy
from symbolic.symbols import z2

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BOX = (0.135, 0.15, 0.84, 0.82)
ACROSS, UP = (0.0, 1.9), (-2.6, 2.6)
BEYOND = (-4.0, 4.0)  # beyond the lower and upper edges of the axes
EPSILON = Fraction(
    1, 32
)  # of the band, in units of the square of the launch speed: a band of half width 1/4


@styled
def region() -> Figure:
    """Figure 12: R, with B1 and B2."""
    figure = blank(4.8, 3.5)
    plane = states.StatePlane(figure, BOX, ACROSS, UP)
    plane.fill(states.outline_b1(BEYOND[0]), "B1", B1)
    plane.fill(states.outline_b2(8.0, BEYOND), "B2", B2)
    plane.fill(states.outline_r(), "R", R)
    plane.draw([states.bounce_line(BEYOND[0])], "bounce-line", linewidth=1.4)
    plane.draw([states.region_boundary()], "boundary-of-R", R, linewidth=2.2)
    plane.text((0.42, -0.3), r"$\mathcal{R}$", fontsize=18)
    plane.text((1.0, -1.75), r"$\mathcal{B}_1$", fontsize=18)
    plane.text((1.4, 1.2), r"$\mathcal{B}_2$", fontsize=18)
    plane.name(states.region_boundary(), 1.2, r"$\partial\mathcal{R}$: $R(\bar b) = 0$", gap=4)
    plane.name(states.bounce_line(BEYOND[0]), -0.55, r"$\partial\mathcal{B}_2$")
    return figure


@styled
def intersections() -> Figure:
    """Figure 13: p, where the line tau_c = T has the velocity of e_1, and the level through it."""
    figure = blank(4.8, 3.5)
    plane = states.StatePlane(figure, BOX, ACROSS, UP)
    through_p = states.level(float(value(energy_of_p())))
    speed = states.speed_of_e_1()
    plane.draw(
        [straight((0, speed), (8.0, speed))], "speed-of-e-1", linewidth=0.9, linestyle=(0, (4, 2))
    )
    plane.draw([states.bounce_line(BEYOND[0])], "bounce-line", linewidth=1.1)
    plane.draw([states.kept()], "B10", KEPT, linewidth=1.6)
    plane.draw([states.region_boundary()], "boundary-of-R", R, linewidth=2.2)
    plane.draw([through_p], "level-of-p", linewidth=1.1, linestyle=(0, (1, 1.5)))
    plane.mark(e_1(), "e-1", r"$e_1$", (5, 4))
    plane.mark(point_p(), "p", r"$p$", (-3, -5), ha="right", va="top")
    plane.name(states.kept(), 0.5, r"$\mathcal{B}_1^0$", above=False, gap=2)
    plane.name(states.region_boundary(), 1.3, r"$\partial\mathcal{R}$", above=False)
    plane.name(through_p, 1.5, r"$E = E(p)$")
    plane.name(states.bounce_line(BEYOND[0]), 0.4, r"$\partial\mathcal{B}_2$", gap=2)
    plane.text((0.58, speed - 0.06), r"$\dot{\bar\beta}$ of $e_1$", va="top", fontsize=9)
    return figure


def outline_band(half_width: float) -> tuple[Arc, ...]:
    """The states of R whose velocity differs from that of e_1 by no more than this; ValueError
    where they are not all in B1.
    """
    low, high = states.speed_of_e_1() - half_width, states.speed_of_e_1() + half_width
    outside = states.region_boundary().part(high, low)
    line = states.bounce_line(low)
    if any(outside.at(speed)[0] >= line.at(speed)[0] for speed in (low, high)):
        raise ValueError("the band leaves B1 before it leaves R")
    return tuple(states.chain(outside, straight((0, low), (0, high))))


@styled
def band() -> Figure:
    """Figure 14: the region K, the states of R and B1 whose velocity is near that of e_1."""
    figure = blank(4.8, 3.5)
    plane = states.StatePlane(figure, BOX, (0, 1.6), UP)
    half = max(zeros(relative_kinetic_energy() - EPSILON * SETTING["r"] ** 2, z2))
    plane.fill(states.outline_r(), "R", R)
    plane.fill(outline_band(half), "K", BAND)
    plane.draw(outline_band(half), "boundary-of-K", BAND, linewidth=1.8)
    plane.draw([states.bounce_line(BEYOND[0])], "bounce-line", linewidth=1.1)
    plane.draw([states.region_boundary()], "boundary-of-R", R, linewidth=2.2)
    plane.mark(e_1(), "e-1", r"$e_1$", (6, 0), va="center")
    plane.text((0.62, states.speed_of_e_1()), r"$\mathcal{K}$", fontsize=14)
    plane.text((0.25, -1.3), r"$\mathcal{R}$", fontsize=16)
    plane.name(states.bounce_line(BEYOND[0]), -0.4, r"$\partial\mathcal{B}_2$", gap=2)
    across = 1.22
    low, high = states.speed_of_e_1() - half, states.speed_of_e_1() + half
    plane.arrow((across, low), (across, high), both=True)
    plane.text((across + 0.03, (low + high) / 2), r"$2\sqrt{2\epsilon}$", ha="left")
    return figure
