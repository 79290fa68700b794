"""Figures 9 and 10: the table alone, and the ball with the table, against time."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from scenes.figures import states
from scenes.figures.arcs import Arc, curve, straight
from scenes.figures.drawing import B1, B2, PLAIN, blank, styled
from scenes.figures.numbers import column, margin, orbit, value
from scenes.figures.plane import Box, Plane, ticks
from symbolic import ball_after_collision, collision_time, flight_map, period, table_at
from symbolic.symbols import t

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TIME = r"$t\,/\,T$"
HEIGHT, VELOCITY = r"$\rho\,/\,(\dot\rho_0 T)$", r"$\dot\rho\,/\,\dot\rho_0$"  # of the table
START = (
    Fraction(9, 5),
    Fraction(3, 5),
)  # height and velocity as the ball starts, the table being at its lowest


def against_time(height: Any, shift: Any, stop: Any, **values: Any) -> Arc:
    """A height that is a quadratic in t, from time 0 to stop, as drawn: time in periods, from the
    shift on, height in units of r T.
    """
    one = curve(t, height, t, 0.0, stop, **values)
    unit, length = states.units()[0], float(value(period()))
    across = (float(shift) / length, 1 / length, 0.0)
    return Arc(across, tuple(part / unit for part in one.up), 0.0, float(stop))  # type: ignore[arg-type]


def table_path(periods: int) -> list[Arc]:
    """The table's height over so many periods."""
    length = value(period())
    return [against_time(table_at()[0], k * length, length) for k in range(periods)]


def ball_path(
    height: Fraction, speed: Fraction, shift: Fraction
) -> tuple[list[Arc], tuple[float, float] | None]:
    """The ball's height over the period that starts at this time in this state, and where the table
    strikes it, if it does.
    """
    length = value(period())
    if margin(height, speed) <= 0:
        return [against_time(flight_map()[0], shift, length, beta=height, v=speed)], None
    struck = value(collision_time(), beta=height, v=speed)
    up, away = column(ball_after_collision(), beta=height, v=speed)
    first = against_time(flight_map()[0], shift, struck, beta=height, v=speed)
    then = against_time(flight_map()[0], shift + struck, length - struck, beta=up, v=away)
    return [first, then], first.at(first.stop)


def time_plane(figure: Figure, box: Box, periods: int, top: float, label: str) -> Plane:
    """Axes of time in periods and height in units of r T."""
    plane = Plane(figure, box, (0, periods), (-0.02 * top, top))
    plane.frame(
        ticks(range(periods + 1)),
        ticks(k / 10 for k in range(0, int(10 * top) + 1, 2 if top > 1 else 1)),
        TIME,
        label,
        26,
    )
    return plane


def draw_table(plane: Plane, periods: int) -> None:
    """Draws the table's height and, below it, the table."""
    arcs = table_path(periods)
    plane.area(states.chain(*arcs, straight((periods, -1), (0, -1))), "table-body", PLAIN)
    plane.line(arcs, "table", linewidth=1.3)


@styled
def coupled_motion() -> Figure:
    """Figure 9: ball and table against time; the ball is sampled whenever the table is lowest."""
    periods, top = 6, 1.12
    figure = blank(5.4, 3.2)
    plane = time_plane(
        figure, (0.105, 0.155, 0.875, 0.8), periods, top, r"height$\,/\,(\dot\rho_0 T)$"
    )
    draw_table(plane, periods)
    length = value(period())
    samples = orbit(START, periods)
    strikes = []
    for k, sample in enumerate(samples[:-1]):
        arcs, strike = ball_path(*sample, k * length)
        plane.line(arcs, f"ball-{k}", B1 if strike else B2, linewidth=1.7, zorder=3)
        strikes += [strike] if strike else []
        plane.text((k + 0.5, 1.06), rf"$\bar b_{k} \in \mathcal{{B}}_{1 if strike else 2}$")
    plane.dots(strikes, "strikes", 6, filled=False, colour=B1.colour)
    heights = [(k, float(height) / states.units()[0]) for k, (height, _) in enumerate(samples)]
    plane.line(
        [straight((k, 0), (k, top)) for k, _ in heights[1:]],
        "sampling",
        linewidth=0.5,
        linestyle=(0, (2, 2)),
        zorder=0.4,
    )
    plane.dots(heights, "samples", 4)
    for k, place in enumerate(heights[:-1]):
        plane.text(
            place,
            rf"$\bar\beta_{k}$",
            (5, 3) if k else (6, -3),
            ha="left",
            va="bottom" if k else "top",
        )
    plane.text((0.5, 0.1), "table")
    plane.text((0.42, 0.78), "ball")
    plane.line([straight((1.49, 0.7), strikes[0])], "pointer", linewidth=0.6)
    plane.text((1.5, 0.74), "strike")
    return figure


@styled
def oscillator() -> Figure:
    """Figure 10: the table's height against time, and its orbit in the phase plane."""
    figure = blank(5.4, 2.6)
    plane = time_plane(figure, (0.105, 0.2, 0.47, 0.76), 3, 0.31, HEIGHT)
    draw_table(plane, 3)
    plane.arrow((1, 0.27), (2, 0.27), both=True)
    plane.text((1.5, 0.275), "$T$", va="bottom")
    phase = Plane(figure, (0.69, 0.2, 0.29, 0.76), (-0.03, 0.31), (-1.35, 1.35))
    phase.frame(ticks([0, 0.1, 0.2, 0.3]), ticks([-1, 0, 1]), HEIGHT, VELOCITY)
    loop = states.drawn([curve(table_at()[0], table_at()[1], t, 0.0, value(period()))])[0]
    launch, landing = loop.at(loop.start), loop.at(loop.stop)
    phase.line([loop], "phase-portrait", linewidth=1.4)
    phase.line([straight(landing, launch)], "bounce", linewidth=1.1, linestyle=(0, (3, 2)))
    for part in (0.3, 0.75):
        phase.arrow(loop.at(loop.stop * (part - 0.02)), loop.at(loop.stop * (part + 0.02)))
    phase.arrow((0, -0.1), (0, 0.1))
    phase.dots([launch, landing], "launch-and-landing")
    phase.text(launch, "launch", (4, 4), ha="left", va="bottom")
    phase.text(landing, "landing", (4, -4), ha="left", va="top")
    phase.text((0, 0), "bounce", (6, 0), ha="left")
    return figure
