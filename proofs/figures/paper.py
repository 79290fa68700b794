"""Figures 3 and 5 to 14 of the paper."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from math import dist

from matplotlib.figure import Figure
from sympy import Expr

from juggleproof.drawing.drawing import Box, Plane, blank, styled, ticks
from juggleproof.drawing.lines import Arc, Real, straight
from juggleproof.drawing.look import B1, B2, BAND, GAIN, KEPT, LOSS, PLAIN, R
from juggleproof.proofs.figures import states
from juggleproof.proofs.figures.arcs import (
    SETTING,
    column,
    curve,
    cut_at_the_bounce,
    images,
    margin,
    orbit,
    value,
    zeros,
)
from juggleproof.symbolic import (
    E_max,
    ball_after_collision,
    collision_time,
    e_1,
    energy_of_p,
    flight_map,
    largest_energy_change,
    largest_kept_energy,
    period,
    point_p,
    relative_kinetic_energy,
    table_at,
)
from juggleproof.symbolic.algebra import t, z2

BOX = (0.135, 0.15, 0.84, 0.82)  # of the axes in a figure
BEYOND = (-4.0, 4.0)  # beyond the lower and upper edges of the axes

# -------------------------------------------------------------------------------------------------
# Figure 3.
#
# The boundary of R and its images under f, cut where f jumps.

STEPS = 6  # images shown, the boundary itself being the first
# the axes of the upper and of the lower row
WHOLE, CLOSE = ((0.0, 1.75), (-2.4, 2.4)), ((0.0, 0.9), (-1.0, 0.2))


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


# -------------------------------------------------------------------------------------------------
# Figures 5 and 6.
#
# The half plane H of the states, and what the table does to them: B1 (it strikes within the period)
# and B2 (it does not).

REGION_ACROSS, REGION_UP = (-0.35, 2.3), (-2.2, 2.2)
REACH = 6.0  # beyond the right edge of the axes, in units of height
REGION_BEYOND = (-3.0, 3.0)  # beyond their lower and upper edges


@styled
def half_plane() -> Figure:
    """Figure 5: H, the states with the ball on or above the table."""
    figure = blank(4.6, 3.2)
    plane = states.StatePlane(figure, BOX, REGION_ACROSS, REGION_UP)
    plane.fill(states.outline_h(REACH, REGION_BEYOND), "H", PLAIN)
    plane.text((1.15, 0.9), r"$\mathcal{H}$", fontsize=20)
    plane.text((1.15, 0.42), r"$\bar\beta \geq 0$: ball on or above the table")
    plane.text((-0.17, -1.1), "below the table", rotation=90, alpha=0.8)
    plane.text((0, -1.75), r"$\bar\beta = 0$", (8, 0), ha="left")
    return figure


@styled
def strikes_and_flights() -> Figure:
    """Figure 6: B1, B2 and the line between them, which belongs to B2."""
    figure = blank(4.6, 3.2)
    plane = states.StatePlane(figure, BOX, REGION_ACROSS, REGION_UP)
    plane.fill(states.outline_b1(REGION_BEYOND[0]), "B1", B1)
    plane.fill(states.outline_b2(REACH, REGION_BEYOND), "B2", B2)
    plane.draw([states.bounce_line(REGION_BEYOND[0])], "bounce-line", linewidth=1.6)
    plane.text((0.45, -1.0), r"$\mathcal{B}_1$", fontsize=18)
    plane.text((0.45, -1.4), "struck within\nthe period", va="top", linespacing=1.0)
    plane.text((1.55, 1.2), r"$\mathcal{B}_2$", fontsize=18)
    plane.text((1.55, 0.8), "not struck\nwithin the period", va="top", linespacing=1.0)
    plane.name(states.bounce_line(REGION_BEYOND[0]), -0.4, r"$\tau_c = T$")
    plane.name(
        states.bounce_line(REGION_BEYOND[0]),
        -0.75,
        r"$\partial\mathcal{B}_2 \subset \mathcal{B}_2$",
        above=False,
    )
    return figure


# -------------------------------------------------------------------------------------------------
# Figures 7, 8 and 11.
#
# Energy levels, which flights keep to; the impacts that keep, gain and lose energy.

LEVELS = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)  # in units of the square of the launch speed
ENERGY_UP = (-2.6, 2.6)


@styled
def levels() -> Figure:
    """Figure 7: the lines of equal energy, along which the state moves in free flight,
    downwards.
    """
    figure = blank(4.8, 3.5)
    plane = states.StatePlane(figure, BOX, (0, 1.8), ENERGY_UP)
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
    plane = states.StatePlane(figure, BOX, (-0.46, 1.6), ENERGY_UP)
    kept_level = states.level(float(value(E_max())))
    plane.draw([states.bounce_line(BEYOND[0])], "bounce-line", linewidth=0.9)
    plane.draw([states.zero_change_curve()], "B10", KEPT, linewidth=1.8)
    plane.draw([kept_level], "E-max", linewidth=1.1, linestyle=(0, (5, 2)))
    plane.draw([states.region_boundary()], "boundary-of-R", R, linewidth=2.2)
    plane.name(states.bounce_line(BEYOND[0]), -0.42, r"$\partial\mathcal{B}_2$", gap=2)
    plane.name(states.zero_change_curve(), 0.55, r"$\mathcal{B}_1^0$", above=False, gap=2)
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
    for state, name, label in (
        (largest_kept_energy().state, "greatest-kept", "$E_{max}$ is\nkept here"),
        (largest_energy_change().state, "greatest-gain", "$\\Delta E_{max}$ is\ngained here"),
    ):
        plane.dot(state, name, label, (-5, 0), ha="right", va="center", linespacing=1.1)
    return figure


@styled
def gains_and_losses() -> Figure:
    """Figure 11: the parts of B1 whose impacts gain, keep and lose energy."""
    figure = blank(4.8, 3.5)
    plane = states.StatePlane(figure, BOX, (0, 1.6), ENERGY_UP)
    plane.fill(states.outline_gain(), "B1+", GAIN)
    plane.fill(states.outline_loss(BEYOND[0]), "B1-", LOSS)
    plane.fill(states.outline_b2(6.0, BEYOND), "B2", B2)
    plane.draw([states.bounce_line(BEYOND[0])], "bounce-line", linewidth=1.4)
    plane.draw([states.zero_change_curve()], "B10", KEPT, linewidth=2)
    plane.text((0.15, -0.42), r"$\mathcal{B}_1^+$", fontsize=16)
    plane.text((0.15, -0.8), r"$\Delta_1 E > 0$", fontsize=9)
    plane.text((0.85, -1.1), r"$\mathcal{B}_1^-$", fontsize=16)
    plane.text((0.85, -1.5), r"$\Delta_1 E < 0$")
    plane.text((1.0, 1.4), r"$\mathcal{B}_2$", fontsize=16)
    plane.text((1.0, 1.0), r"$\Delta_2 E = 0$")
    plane.text(
        states.drawn([states.zero_change_curve()])[0].at(-0.75),
        r"$\mathcal{B}_1^0$: $\Delta_1 E = 0$",
        (9, -2),
        ha="left",
        va="top",
    )
    return figure


# -------------------------------------------------------------------------------------------------
# Figures 9 and 10.
#
# The table alone, and the ball with the table, against time.

TIME = r"$t\,/\,T$"
HEIGHT, VELOCITY = r"$\rho\,/\,(\dot\rho_0 T)$", r"$\dot\rho\,/\,\dot\rho_0$"  # of the table
# height and velocity as the ball starts, the table being at its lowest
START = (Fraction(9, 5), Fraction(3, 5))


def against_time(height: Expr, shift: Real, stop: Real, **values: Real) -> Arc:
    """A height that is a quadratic in t, from time 0 to stop, as drawn: time in periods, from the
    shift on, height in units of r T.
    """
    a, b, c = curve(t, height, t, 0.0, stop, **values).up
    unit, length = states.units()[0], float(value(period()))
    across = (float(shift) / length, 1 / length, 0.0)
    return Arc(across, (a / unit, b / unit, c / unit), 0.0, float(stop))


def table_path(periods: int) -> list[Arc]:
    """The table's height over so many periods."""
    length = value(period())
    return [against_time(table_at()[0], k * length, length) for k in range(periods)]


def ball_path(
    height: Real, speed: Real, shift: Real
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


# -------------------------------------------------------------------------------------------------
# Figures 12, 13 and 14.
#
# The region R, the point p that must lie outside it, and the band around e_1 in it.

ACROSS, UP = (0.0, 1.9), (-2.6, 2.6)
# of the band, in units of the square of the launch speed: a band of half width 1/4
EPSILON = Fraction(1, 32)


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
    plane.draw([states.zero_change_curve()], "B10", KEPT, linewidth=1.6)
    plane.draw([states.region_boundary()], "boundary-of-R", R, linewidth=2.2)
    plane.draw([through_p], "level-of-p", linewidth=1.1, linestyle=(0, (1, 1.5)))
    plane.dot(e_1(), "e-1", r"$e_1$", (5, 4))
    plane.dot(point_p(), "p", r"$p$", (-3, -5), ha="right", va="top")
    plane.name(states.zero_change_curve(), 0.5, r"$\mathcal{B}_1^0$", above=False, gap=2)
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
    plane.dot(e_1(), "e-1", r"$e_1$", (6, 0), va="center")
    plane.text((0.62, states.speed_of_e_1()), r"$\mathcal{K}$", fontsize=14)
    plane.text((0.25, -1.3), r"$\mathcal{R}$", fontsize=16)
    plane.name(states.bounce_line(BEYOND[0]), -0.4, r"$\partial\mathcal{B}_2$", gap=2)
    across = 1.22
    low, high = states.speed_of_e_1() - half, states.speed_of_e_1() + half
    plane.arrow((across, low), (across, high), both=True)
    plane.text((across + 0.03, (low + high) / 2), r"$2\sqrt{2\epsilon}$", ha="left")
    return figure
