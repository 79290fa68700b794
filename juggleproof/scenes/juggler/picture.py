"""Pictures of orbits: ball and table against time; the basins of the periodic orbits at one alpha;
what orbits tend to as alpha grows.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from fractions import Fraction

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from juggleproof.drawing.drawing import (
    BOTTOM,
    Plane,
    axes,
    key,
    on_white,
    raster,
    spaced,
    style,
    ticks,
)
from juggleproof.drawing.lines import joined, straight
from juggleproof.drawing.look import B1, B2, BAND, GAIN, INK, KEPT, LOSS, R
from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler.compiled_map import brief, formulas
from juggleproof.scenes.juggler.limits import UNDECIDED, Limits
from juggleproof.scenes.juggler.orbits import heights
from juggleproof.scenes.juggler.periodic import Word, exists_for, returning_state
from juggleproof.scenes.juggler.starts import Scene, StartGrid

# -------------------------------------------------------------------------------------------------
# What the pictures have in common: axes in either system of units, a title, a legend.

MOST_PERIODS, A_PERIOD, MOST_BALLS = 40, 32, 6
HEIGHT, CLOSING = r"$x = \bar\beta\,/\,(\dot\rho_0 T)$", r"$w = 1 - \dot{\bar\beta}\,/\,\dot\rho_0$"
LABELS = {"normal": (HEIGHT, CLOSING), "physical": (r"$\bar\beta$", r"$\dot{\bar\beta}$")}
# e_1 to e_6 and beyond; orbits of unequal flights, in the order of how many states tend to them
OF_FLIGHT = tuple(look.colour for look in (B1, B2, R, BAND, LOSS, KEPT))
BEYOND, UNEQUAL = GAIN.colour, ("#7A4FA3", "#8C6239", "#B8B8FF")
OTHERS, NOT_KNOWN = "#9A9A9A", "#000000"


def name(word: Word) -> str:
    """How a periodic orbit is called: e_K for one flight of K periods, else the flights.

    >>> name((2,)), name((4, 4, 5, 5)), name((1,) * 40)
    ('e_2', '4,4,5,5', '40 flights')
    """
    if len(word) == 1:
        return f"e_{word[0]}"
    return ",".join(map(str, word)) if len(word) <= 6 else f"{len(word)} flights"


def _shown(word: Word) -> str:
    return f"$e_{{{word[0]}}}$" if len(word) == 1 else name(word)


def _setting(scene: Scene, units: str) -> str:
    """The restitution, and in physical units launch speed and gravity."""
    text = rf"$\alpha = ${brief(scene.alpha)}"
    if units == "physical":
        text += rf", $\dot\rho_0 = ${brief(scene.r)}, $\gamma = ${brief(scene.g)}"
    return text


def _on_white(draw: Callable[[], Figure], slug: str) -> bytes:
    """The picture as SVG, on white, so that it can be read on a dark page; raises SceneError for
    numbers beyond the floats.
    """
    with style():
        try:
            figure = draw()
        except OverflowError:
            raise SceneError("numbers beyond 10^308 cannot be drawn; give smaller ones") from None
    return on_white(figure, slug)


# -------------------------------------------------------------------------------------------------
# Ball and table against time.


def orbit(scene: Scene, periods: int, units: str) -> bytes:
    """Table and balls, six at most, over 40 periods at most, as SVG, by exact heights at 32 times
    in a period.  Raises SceneError for more.
    """
    if not 1 <= periods <= MOST_PERIODS:
        raise SceneError(f"{periods} periods cannot be drawn; give from 1 to {MOST_PERIODS}")
    if scene.starts.count > MOST_BALLS:
        raise SceneError(f"{scene.starts.count} starts cannot be drawn; give {MOST_BALLS} at most")
    return _on_white(lambda: _orbit(scene, periods, units), "orbit")


def _orbit(scene: Scene, periods: int, units: str) -> Figure:
    count = scene.starts.count
    normal = Scene(scene.alpha, Fraction(1), Fraction(2), scene.starts)  # in which r T = T = 1
    times = [Fraction(k, A_PERIOD) for k in range(periods * A_PERIOD + 1)]
    paths = [heights(normal, times, index) for index in range(count)]
    unit, labels = (1.0, 1.0), (r"$t\,/\,T$", r"height$\,/\,(\dot\rho_0 T)$")
    if units == "physical":
        height = formulas().unscaled(Fraction(1), Fraction(1), scene.r, scene.g)[0]  # r T
        unit, labels = (float(height / scene.r), float(height)), (r"$t$", r"$\beta,\ \rho$")
    last = float(periods) * unit[0]
    top = 1.05 * unit[1] * max(0.25, *(float(one.ball) for path in paths for one in path))
    plane = axes(
        (520, 270),
        110,
        (0, last),
        (-0.02 * top, top),
        (
            f"{'Balls' if count > 1 else 'Ball'} and table over {periods} periods at"
            f" {_setting(scene, units)}",
            f"{count} ball{'s' * (count > 1)}, {len(times)} heights each, from exact rational"
            f" states; dots: {periods + 1} samples each, when the table is lowest",
        ),
    )
    plane.frame(ticks(spaced(0, last)), ticks(spaced(0, top)), *labels, 30)
    curves = [("table", INK, [one.table for one in paths[0]])] + [
        (f"ball-{index + 1}", OF_FLIGHT[index], [one.ball for one in path])
        for index, path in enumerate(paths)
    ]
    for slug, colour, values in curves:
        points = [
            (float(time) * unit[0], float(value) * unit[1]) for time, value in zip(times, values)
        ]
        plane.line(
            joined(points),
            slug,
            edgecolor=colour,
            linewidth=1.2,
        )
        if slug != "table":
            plane.dots(points[::A_PERIOD], f"{slug}-samples", 3, colour=colour)
    keys = ["table", *(f"ball {index + 1}" if count > 1 else "ball" for index in range(count))]
    key(plane, [(colour, key) for (_, colour, _), key in zip(curves, keys)])
    return plane.figure


# -------------------------------------------------------------------------------------------------
# Basins at one alpha.


def grid_of(scene: Scene) -> StartGrid:
    """The starts; raises SceneError if they are no grid of at least two by two states."""
    grid = scene.starts
    if not isinstance(grid, StartGrid) or min(len(grid.heights), len(grid.speeds)) < 2:
        raise SceneError("basins are of a grid of at least 2 by 2 states; give --grid")
    return grid


def basin(scene: Scene, found: Limits, units: str) -> bytes:
    """The states of a grid, coloured by what their orbits tend to, as SVG; raises SceneError for
    states that are no grid of at least two by two.
    """
    return _on_white(lambda: _basin(scene, grid_of(scene), found, units), "basin")


def _basin(scene: Scene, grid: StartGrid, found: Limits, units: str) -> Figure:
    def shown(x: Fraction, w: Fraction) -> tuple[float, float]:
        if units == "physical":
            x, w = formulas().unscaled(x, w, scene.r, scene.g)
        return float(x), float(w)

    shape = (len(grid.heights), len(grid.speeds))
    low = shown(grid.heights.first, grid.speeds.first)
    high = shown(grid.heights.last, grid.speeds.last)
    image = found.which.reshape(shape).T
    if low[1] > high[1]:
        image, low, high = image[::-1], (low[0], high[1]), (high[0], low[1])
    half = [(b - a) / (count - 1) / 2 for a, b, count in zip(low, high, shape)]
    across, up = ((a - step, b + step) for a, b, step in zip(low, high, half))
    counts = found.counts()
    colours, keys = palette(found.words, counts)
    plane = axes(
        (520, 400),
        130,
        across,
        up,
        (f"What the orbit of each state tends to, at {_setting(scene, units)}", how(found)),
    )
    tinted = np.array(
        [[255 - 0.75 * (255 - 255 * part) for part in to_rgb(one)] for one in colours]
    )
    tinted[UNDECIDED] = 0
    raster(plane, tinted.round().astype(np.uint8)[image])
    plane.frame(ticks(spaced(*across)), ticks(spaced(*up)), *LABELS[units], 28)
    at = Fraction(scene.alpha)
    for word in found.words:
        if len(word) == 1:
            place = shown(*returning_state(at, word, Fraction(0)))
            if across[0] <= place[0] <= across[1] and up[0] <= place[1] <= up[1]:
                plane.dots([place], f"e-{word[0]}", 6, "+")
                plane.text(place, _shown(word), (4, 3), ha="left", va="bottom", fontsize=11)
    key(plane, keys)
    return plane.figure


def how(found: Limits) -> str:
    """How the limits were found, in one line."""
    undecided = int((found.which == UNDECIDED).sum())
    return (
        f"{found.which.size} orbits in float64 with error bounds, {found.exact} of them also in"
        f" exact rationals; undecided: {undecided}"
    )


def palette(
    words: Sequence[Word], counts: Counter[int], apart: Sequence[str] = UNEQUAL
) -> tuple[list[str], list[tuple[str, str]]]:
    """The colour of each word, and after these the colour of undecided orbits; and the entries of a
    legend, with the share of the orbits that tend there.  Words of unequal flights have the colours
    `apart`; when these are used up, all others have one colour.
    """
    colours = [OTHERS] * len(words) + [NOT_KNOWN]
    titles = {BEYOND: f"$e_K$, $K > {len(OF_FLIGHT)}$", NOT_KNOWN: "undecided"}
    titles[OTHERS] = "other periodic orbits" if apart else "unequal flights"
    unequal = sorted(
        (place for place, word in enumerate(words) if len(word) > 1),
        key=lambda place: (-counts[place], words[place]),
    )
    for place, word in enumerate(words):
        if len(word) == 1:
            colours[place] = OF_FLIGHT[word[0] - 1] if word[0] <= len(OF_FLIGHT) else BEYOND
    for place, colour in zip(unequal, apart):
        colours[place] = colour
    for colour, word in zip(colours, words):
        titles.setdefault(colour, _shown(word))
    shares = Counter[str]()
    for place, count in counts.items():
        shares[colours[place]] += count
    return colours, [
        (colour, f"{titles[colour]}  {percent(shares[colour], counts.total())}")
        for colour in (*OF_FLIGHT, BEYOND, *UNEQUAL, OTHERS, NOT_KNOWN)
        if shares[colour] or colour == NOT_KNOWN
    ]


def percent(part: int, whole: int) -> str:
    """The share in percent, never rounded to nothing or to all.

    >>> percent(1, 10**6), percent(999, 1000), percent(0, 5), percent(5, 5), percent(9999, 10**4)
    ('< 0.1 %', '99.9 %', '0 %', '100 %', '> 99.9 %')
    """
    share = 100 * part / whole
    if share in (0, 100):
        return f"{share:.0f} %"
    return "< 0.1 %" if share < 0.1 else "> 99.9 %" if share > 99.9 else f"{share:.1f} %"


# -------------------------------------------------------------------------------------------------
# What orbits tend to as alpha grows.

ROWS, THICK = 480, 4  # of the image, and of a point
SHARES = 60.0  # the height of the panel below, in points


def bifurcation(scene: Scene, found: Limits, units: str) -> bytes:
    """Closing speeds at the impacts of the orbits that any start tends to, against alpha, and below
    the share of the starts, as SVG; raises SceneError for fewer than two alpha.
    """
    if len(found.alphas) < 2:
        raise SceneError("one alpha makes no picture; give two at least")
    return _on_white(lambda: _bifurcation(scene, found, units), "bifurcation")


def speeds(alpha: Fraction, word: Word) -> list[float]:
    """The closing speeds w at the impacts of the word, in floats for drawing.

    >>> [round(w, 4) for w in speeds(Fraction(1, 2), (2,))]
    [2.6667]
    """
    map_, at, found = formulas(), float(alpha), []
    here = returning_state(at, word, 0.0)
    for periods in word:
        found.append(here[1])
        here = map_.flight(*map_.impact(at, *here), periods - 1)
    return found


def _bifurcation(scene: Scene, found: Limits, units: str) -> Figure:
    colours, keys = palette(found.words, found.counts(), ())
    points = [
        (column, place, speed)
        for column, row in enumerate(found.which)
        for place in np.unique(row[row != UNDECIDED]).tolist()
        for speed in speeds(found.alphas[column], found.words[place])
    ]
    # up to the fastest of the orbits that have a name; the others beyond are cut off
    top = max((one[2] for one in points if len(found.words[one[1]]) == 1), default=2.0) + 0.5
    image = np.zeros((ROWS, len(found.alphas), 4), np.uint8)
    for column, place, speed in sorted(points, key=lambda one: -len(found.words[one[1]])):
        row = int(speed / top * ROWS)
        image[max(row - THICK // 2, 0) : row + THICK // 2, column] = _opaque(colours[place])
    up = (0.0, top)
    if units == "physical":  # v = r (1 - w) runs the other way
        r, g = float(scene.r), float(scene.g)
        low, high = (formulas().unscaled(0.0, w, r, g)[1] for w in (top, 0.0))
        image, up = image[::-1], (low, high)
    step = (found.alphas[-1] - found.alphas[0]) / (len(found.alphas) - 1) / 2
    across = float(found.alphas[0] - step), float(found.alphas[-1] + step)
    starts = scene.starts.count
    title = (
        f"What orbits of {starts} start{'s' * (starts != 1)} tend to as $\\alpha$ grows:"
        f" {len(found.alphas)} $\\alpha$"
    )
    plane = axes((520, 400), 130, across, up, (title, how(found)), BOTTOM + SHARES + 12)
    numbers = ticks(spaced(*across))
    plane.frame(dict.fromkeys(numbers, ""), ticks(spaced(*up)), "", LABELS[units][1], 28)
    third = float(exists_for((2,))[0].low.low)
    if across[0] < third < across[1]:
        line = straight((third, up[0]), (third, up[1]))
        plane.line([line], "third", linewidth=0.7, linestyle=(0, (4, 3)))
        plane.text((third, up[1]), r"$\alpha = 1/3$", (-3, -7), ha="right", fontsize=9)
    raster(plane, image)
    width, height = (72 * float(side) for side in plane.figure.get_size_inches())
    box = (plane.left / width, BOTTOM / height, plane.width / width, SHARES / height)
    below = Plane(plane.figure, box, across, (0, 1))
    order = {colour: place for place, (colour, _) in enumerate(keys)}
    ranks = np.array([order.get(colour, 0) for colour in colours])
    looks = np.array([_opaque(colour) for colour, _ in keys], np.uint8)
    raster(below, looks[np.sort(ranks[found.which], axis=1).T])
    below.frame(numbers, {0: "0", 1: "1"}, r"$\alpha$", "share", 28)
    key(plane, [(colour, key.rpartition("  ")[0]) for colour, key in keys])
    return plane.figure


def _opaque(colour: str) -> list[int]:
    return [*(round(255 * part) for part in to_rgb(colour)), 255]
