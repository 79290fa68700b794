"""Pictures of a ball on a table that moves as a sine: over time; how long states take to the
bounce of one period.  Simulated, but for the ranks of a certificate.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import floor

import numpy as np
from numpy.typing import NDArray

from juggleproof.drawing.drawing import (
    LETTERS,
    Plane,
    axes,
    on_white,
    raster,
    spaced,
    style,
    ticks,
)
from juggleproof.drawing.lines import joined
from juggleproof.drawing.look import B1, BAND, KEPT, R
from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.table.curves import second_orbit
from juggleproof.scenes.table.motion import (
    MOST,
    Floats,
    Table,
    bounce_phase,
    events,
    flights_by_state,
)

BALLS = tuple(look.colour for look in (B1, KEPT, R, BAND))
A_PERIOD = 64  # points of a curve in one period
COLUMNS, ROWS = 160, 120  # of a raster
DARK, LIGHT = np.array([8, 48, 107]), np.array([222, 235, 247])  # few flights, many
NEVER = np.array([230, 159, 0])
Certified = tuple[NDArray[np.int64], Fraction]  # ranks, -1 for none; the share that has one
Start = tuple[float, float]  # phase, closing speed at the impact it begins with


def orbit(table: Table, starts: Sequence[Start], periods: int) -> bytes:
    """Table and balls over some periods, as SVG; dots are impacts, and squares launches after a
    rest.
    """
    if not 1 <= periods <= 60 or not 1 <= len(starts) <= len(BALLS):
        raise SceneError(f"give from 1 to 60 periods, and from 1 to {len(BALLS)} starts")
    times = np.arange(periods * A_PERIOD + 1) / A_PERIOD
    heights = table.derivative(times, 0)
    paths = [_path(table, start, periods) for start in starts]
    top = 1.05 * max(float(heights.max()), *(float(path[:, 1].max()) for path, _ in paths))
    low = 1.3 * float(heights.min())
    with style():
        title = f"Ball and table over {periods} periods: {_named(table)}"
        impacts, launches = (
            sum(one == kind for _, marks in paths for one, _ in marks)
            for kind in ("impact", "launch")
        )
        note = (
            f"simulated, {len(starts)} ball{'s' * (len(starts) > 1)}; dots: {impacts} impacts,"
            f" squares: {launches} launches from rest; height in $gT^2$"
        )
        plane = axes((600, 280), 14, (0, float(periods)), (low, top), (title, note))
        plane.frame(ticks(spaced(0, periods)), ticks(spaced(low, top)), r"$t\,/\,T$", "height", 30)
        plane.line(joined([(float(t), float(h)) for t, h in zip(times, heights)]), "table")
        for number, (path, marks) in enumerate(paths):
            colour = BALLS[number]
            points = [(float(t), float(h)) for t, h in path]
            plane.line(joined(points), f"ball-{number}", edgecolor=colour, linewidth=1.0)
            for kind, marker in ("impact", "o"), ("launch", "s"):
                dots = [
                    (at, float(table.derivative(np.array(at), 0)))
                    for which, at in marks
                    if which == kind
                ]
                if dots:
                    plane.dots(dots, f"{kind}-{number}", 3.0, marker, colour=colour)
    return on_white(plane.figure, "orbit")


def _path(
    table: Table, start: Start, periods: int
) -> tuple[NDArray[np.float64], list[tuple[str, float]]]:
    """The heights of one ball, shape (n, 2), and what happens to it at which times."""
    phase, speed = start
    time, up = phase, float(table.derivative(np.array(phase), 1)) + table.alpha * speed
    pieces: list[Floats] = []
    marks: list[tuple[str, float]] = [("impact", phase)]
    resting = False
    for event in events(table, time, up):
        stop = min(event.time, float(periods))
        grid = np.linspace(time, stop, max(2, int((stop - time) * A_PERIOD) + 2))
        ball = table.derivative(np.full_like(grid, time), 0) + up * (grid - time)
        ball -= (grid - time) ** 2 / 2
        if resting:
            ball = table.derivative(grid, 0)
        pieces.append(np.column_stack((grid, ball)))
        if event.time >= periods or len(marks) > 5000:
            break
        marks.append((event.kind, event.time))
        time, resting = event.time, event.kind == "rest"
        up = float(table.derivative(np.array(time), 1)) + table.alpha * event.speed
    return np.concatenate(pieces), marks


def basin(table: Table, top: float, certified: Certified | None) -> bytes:
    """After how many flights states come to the bounce, by phase and closing speed up to `top`;
    beside it the ranks of a certificate, shape (rows, columns), if there is one.
    """
    counts = flights_by_state(table, top, ROWS, COLUMNS)
    there = (counts >= 0) & (counts <= MOST)
    longest = int(counts[there].max()) if there.any() else 1
    bounce = bounce_phase(table.alpha, table.gamma)
    marked = (bounce, "o"), ((bounce + second_orbit(table.alpha, table.gamma)) % 1.0, "x")
    size = (640.0, 320.0) if certified else (400.0, 320.0)
    with style():
        shares = (
            f"{there.mean():.1%} of {counts.size:,} states come to it, in {longest} flights at most"
        )
        title = f"Flights to the bounce of one period: {_named(table)}"
        right = 350.0 if certified else 14.0
        plane = axes(size, right, (0, 1), (0, top), (title, f"simulated; dark: few; {shares}"))
        plane.frame(ticks(spaced(0, 1)), ticks(spaced(0, top)), "phase", "closing speed", 30)
        raster(plane, _shaded(counts, there))
        planes = [plane]
        if certified:
            planes.append(_ranks(plane, certified, top, bounce))
        for number, one in enumerate(planes):
            for place, marker in marked:
                at = place, 1 / (1 + table.alpha)
                one.dots([at], f"orbit-{marker}-{number}", 5, marker, colour=KEPT.colour)
    return on_white(plane.figure, "basin")


def _ranks(beside: Plane, certified: Certified, top: float, bounce: float) -> Plane:
    """The ranks of a certificate in a plane of their own, moved to the phase of the wave."""
    ranks, share = certified
    figure = beside.figure
    width, height = (72 * float(side) for side in figure.get_size_inches())
    left = beside.left + beside.width + 60
    box = (left / width, beside.bottom / height, beside.width / width, beside.height / height)
    plane = Plane(figure, box, (0, 1), (0, top))
    plane.frame(ticks(spaced(0, 1)), ticks(spaced(0, top)), "phase", "", 30)
    columns = ranks.shape[1]
    moved = np.roll(ranks, round(bounce * columns), axis=1)
    raster(plane, _shaded(moved, moved >= 0))
    # rounded down: no more is certified
    words = f"certified, by ranks: {floor(1000 * share) / 10}% of states come to it"
    plane.words((left, height - 26), words, ha="left", fontsize=LETTERS)
    return plane


def _shaded(counts: NDArray[np.int64], there: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Colours: dark for few flights, light for many, another one for states that do not arrive."""
    most = max(1, int(counts[there].max())) if there.any() else 1
    part = np.clip(counts / most, 0, 1)[..., None]
    colours = np.where(there[..., None], DARK + (LIGHT - DARK) * part, NEVER)
    return colours.astype(np.uint8)


def _named(table: Table) -> str:
    harmonics = "" if table.wave == (1.0,) else ", wave " + ",".join(f"{w:g}" for w in table.wave)
    return rf"$\alpha = ${table.alpha:g}, $\Gamma = ${table.gamma:g}{harmonics}"
