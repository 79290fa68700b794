"""Figures 7, 8 and 11: energy levels, which flights keep to; the impacts that keep, gain and lose
energy.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from scenes.figures import states
from scenes.figures.drawing import B2, GAIN, KEPT, LOSS, R, blank, styled
from scenes.figures.numbers import SETTING, value
from symbolic import E_max, largest_energy_change, largest_kept_energy

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BOX = (0.135, 0.15, 0.84, 0.82)
LEVELS = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)  # in units of the square of the launch speed
UP = (-2.6, 2.6)
BEYOND = (-4.0, 4.0)  # beyond the lower and upper edges of the axes


@styled
def levels() -> Figure:
    """Figure 7: the lines of equal energy, along which the state moves in free flight,
    downwards.
    """
    figure = blank(4.8, 3.5)
    plane = states.StatePlane(figure, BOX, (0, 1.8), UP)
    unit = float(SETTING["r"] ** 2)
    for energy in LEVELS:
        arc = states.level(energy * unit)
        plane.draw([arc], f"level-{energy}", linewidth=1.1)
        for part in (0.25, 0.75):
            tail, tip = (
                states.drawn([arc])[0].at(arc.start + (arc.stop - arc.start) * (part + d))
                for d in (-0.012, 0.012)
            )
            plane.arrow(tail, tip)
        plane.text(
            states.drawn([arc])[0].at(0.0),
            f"{energy:g}",
            (3, 3),
            ha="left",
            va="bottom",
            fontsize=9,
        )
    plane.text((1.79, 2.3), r"$E(\bar b)\,/\,\dot\rho_0^2$ at each tip", ha="right", fontsize=10)
    return figure


@styled
def important_lines() -> Figure:
    """Figure 8: B1^0, the level E_max that touches it, and the boundary of R, which is Delta E_max
    above.
    """
    figure = blank(4.8, 3.5)
    plane = states.StatePlane(figure, BOX, (-0.46, 1.6), UP)
    kept_level = states.level(float(value(E_max())))
    plane.draw([states.bounce_line(BEYOND[0])], "bounce-line", linewidth=0.9)
    plane.draw([states.kept()], "B10", KEPT, linewidth=1.8)
    plane.draw([kept_level], "E-max", linewidth=1.1, linestyle=(0, (5, 2)))
    plane.draw([states.region_boundary()], "boundary-of-R", R, linewidth=2.2)
    plane.name(states.bounce_line(BEYOND[0]), -0.42, r"$\partial\mathcal{B}_2$", gap=2)
    plane.name(states.kept(), 0.55, r"$\mathcal{B}_1^0$", above=False, gap=2)
    plane.name(kept_level, -1.1, r"$E = E_{max}$", above=False)
    plane.name(
        states.region_boundary(),
        1.35,
        r"$\partial\mathcal{R}$: $E = E_{max} + \Delta E_{max}$",
        gap=4,
    )
    left, right = (
        states.drawn([arc])[0].at(-0.6) for arc in (kept_level, states.region_boundary())
    )
    plane.arrow(left, right, both=True)
    plane.text(
        ((left[0] + right[0]) / 2, -0.55), r"$\Delta E_{max}\,/\,\gamma$", va="bottom", fontsize=9
    )
    for state, name, said in (
        (largest_kept_energy().state, "greatest-kept", "$E_{max}$ is\nkept here"),
        (largest_energy_change().state, "greatest-gain", "$\\Delta E_{max}$ is\ngained here"),
    ):
        plane.mark(state, name, said, (-5, 0), ha="right", va="center", linespacing=1.1)
    return figure


@styled
def gains_and_losses() -> Figure:
    """Figure 11: the parts of B1 whose impacts gain, keep and lose energy."""
    figure = blank(4.8, 3.5)
    plane = states.StatePlane(figure, BOX, (0, 1.6), UP)
    plane.fill(states.outline_gain(), "B1+", GAIN)
    plane.fill(states.outline_loss(BEYOND[0]), "B1-", LOSS)
    plane.fill(states.outline_b2(6.0, BEYOND), "B2", B2)
    plane.draw([states.bounce_line(BEYOND[0])], "bounce-line", linewidth=1.4)
    plane.draw([states.kept()], "B10", KEPT, linewidth=2)
    plane.text((0.15, -0.42), r"$\mathcal{B}_1^+$", fontsize=16)
    plane.text((0.15, -0.8), r"$\Delta_1 E > 0$", fontsize=9)
    plane.text((0.85, -1.1), r"$\mathcal{B}_1^-$", fontsize=16)
    plane.text((0.85, -1.5), r"$\Delta_1 E < 0$")
    plane.text((1.0, 1.4), r"$\mathcal{B}_2$", fontsize=16)
    plane.text((1.0, 1.0), r"$\Delta_2 E = 0$")
    plane.text(
        states.drawn([states.kept()])[0].at(-0.75),
        r"$\mathcal{B}_1^0$: $\Delta_1 E = 0$",
        (9, -2),
        ha="left",
        va="top",
    )
    return figure
