"""The plane of the sampled states: height across in units of r T, velocity up in units of r; its
curves, and the outlines of its regions.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from matplotlib.figure import Figure
from sympy import Expr

from juggleproof.drawing.drawing import Box, Plane, Sides, Style, ticks
from juggleproof.drawing.lines import Arc, Point, straight
from juggleproof.drawing.look import Look
from juggleproof.proofs.figures.arcs import SETTING, column, curve, value, zeros
from juggleproof.symbolic import (
    State,
    boundary_height,
    e_1,
    period,
    region_energy,
    root_of,
    total_energy,
    zero_change_height,
)
from juggleproof.symbolic.algebra import E0, beta, v

HEIGHT = r"$\bar\beta\,/\,(\dot\rho_0 T)$"
VELOCITY = r"$\dot{\bar\beta}\,/\,\dot\rho_0$"


def units() -> tuple[float, float]:
    """What is 1 on the axes: the height r T and the speed r."""
    r = SETTING["r"]
    return float(r * value(period())), float(r)


def drawn(arcs: Sequence[Arc]) -> list[Arc]:
    """Arcs of states (beta, v) in the units of the axes."""
    h, s = units()
    return [
        Arc((a / h, b / h, c / h), (d / s, e / s, k / s), arc.start, arc.stop)
        for arc in arcs
        for (a, b, c), (d, e, k) in [(arc.across, arc.up)]
    ]


def at(state: State) -> Point:
    """A derived state, in the units of the axes."""
    height, speed = column(state)
    return float(height) / units()[0], float(speed) / units()[1]


class StatePlane(Plane):
    """The plane of the states; what is drawn are states (beta, v), what is written stands at places
    in the units of the axes.
    """

    def __init__(
        self,
        figure: Figure,
        box: Box,
        across: Sides,
        up: Sides,
        labels: tuple[str, str] = (HEIGHT, VELOCITY),
        numbered: bool = True,
    ) -> None:
        super().__init__(figure, box, across, up)
        part = 1 if up[1] - up[0] > 2 else 2
        velocities = ticks(k / part for k in range(-int(-part * up[0]), int(part * up[1]) + 1))
        heights = ticks(k / 2 for k in range(int(2 * across[1]) + 1))
        self.frame(
            heights,
            velocities if numbered else dict.fromkeys(velocities, ""),
            *labels,
            20 if part == 1 else 27,
        )
        self.line(
            [straight((across[0], 0), (across[1], 0))], None, linewidth=0.4, alpha=0.6, zorder=0.8
        )
        if across[0] < 0:
            self.line([straight((0, up[0]), (0, up[1]))], None, linewidth=1.2, zorder=2)

    def draw(
        self, arcs: Sequence[Arc], name: str, look: Look | None = None, **style: Style
    ) -> None:
        """Draws a curve of states."""
        self.line(drawn(arcs), name, look, **style)

    def fill(self, arcs: Sequence[Arc], name: str, look: Look) -> None:
        """Fills a region of states."""
        self.area(drawn(arcs), name, look)

    def name(self, arc: Arc, speed: float, label: str, above: bool = True, gap: float = 3) -> None:
        """Writes along a curve of states, at this velocity."""
        self.along(drawn([arc])[0], speed, label, above, gap)

    def dot(self, state: State, name: str, label: str, shift: Point, **style: Style) -> None:
        """A dot at a derived state, with its name beside it."""
        self.dots([at(state)], name)
        self.text(at(state), label, shift, **{"ha": "left", "va": "bottom", **style})


@cache
def bounce_line(lowest: float) -> Arc:
    """The line tau_c = T between B1 and B2 (29), from beta = 0 down to this speed."""
    return curve(boundary_height(), v, v, zeros(boundary_height(), v)[0], lowest)


@cache
def level_height() -> Expr:
    """The height at which a velocity has the energy E0."""
    return root_of(total_energy() - E0, beta)


@cache
def level(energy: float) -> Arc:
    """The states of H with this energy, from the greatest speed to the least."""
    low, high = zeros(level_height(), v, E0=energy)
    return curve(level_height(), v, v, high, low, E0=energy)


@cache
def region_boundary() -> Arc:
    """Those states of H on the boundary of R."""
    return level(float(value(region_energy())))


@cache
def zero_change_curve() -> Arc:
    """B1^0, the states whose impact keeps the energy, from the greatest speed to the least."""
    low, high = zeros(zero_change_height(), v)
    return curve(zero_change_height(), v, v, high, low)


def chain(*parts: Arc) -> list[Arc]:
    """The arcs as one closed outline, straight lines joining what does not meet."""
    closed: list[Arc] = []
    for arc, after in zip(parts, [*parts[1:], parts[0]]):
        closed.append(arc)
        if arc.at(arc.stop) != after.at(after.start):
            closed.append(straight(arc.at(arc.stop), after.at(after.start)))
    return closed


def outline_h(reach: float, up: Sides) -> list[Arc]:
    """H as far as the axes show it: up to this height, between these speeds."""
    return chain(straight((0, up[0]), (reach, up[0])), straight((reach, up[1]), (0, up[1])))


def outline_b1(lowest: float) -> list[Arc]:
    """B1 down to this speed: the triangle between beta = 0 and the line."""
    return chain(bounce_line(lowest), straight((0, lowest), (0, bounce_line(lowest).start)))


def outline_b2(reach: float, up: Sides) -> list[Arc]:
    """B2 as far as the axes show it; the speeds reach down to where the line has left the axes."""
    arc = bounce_line(up[0])
    corner = max(reach, arc.at(arc.stop)[0])
    return chain(
        arc, straight((corner, up[0]), (corner, up[1])), straight((0, up[1]), arc.at(arc.start))
    )


def outline_r() -> list[Arc]:
    """R: the states of H inside its boundary."""
    return chain(region_boundary())


def outline_gain() -> list[Arc]:
    """B1^+, the states whose impact gains energy: between beta = 0 and B1^0."""
    return chain(zero_change_curve())


def outline_loss(lowest: float) -> list[Arc]:
    """B1^- down to this speed: the rest of B1."""
    return chain(
        bounce_line(lowest),
        straight((0, lowest), (0, zero_change_curve().stop)),
        zero_change_curve().reverse(),
    )


def speed_of_e_1() -> float:
    """The velocity of e_1."""
    return float(column(e_1())[1])
