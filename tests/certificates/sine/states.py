"""States whose next impacts are known, drawn where enclosures of flights are tight: corners of
cells and of boxes of parameters, grazes, S = 1, plastic impacts; and what lies outside them.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from fractions import Fraction
from typing import Any, NamedTuple

from juggleproof.certificates.checker import Work
from juggleproof.certificates.sine import cells, checker, flights
from tests.certificates.sine.impacts import State, exact, first_impact

Q = Fraction
STEPS = 1 << 26
UNIT = 1 << 40


class Code(NamedTuple):
    """The second checker's files, or mutants of them."""

    flights: Any = flights
    cells: Any = cells
    checker: Any = checker


CODE = Code()


def box(alpha: str, g: str, *cells: int) -> flights.Grid:
    """A grid over a box written as A0:A1 and G0:G1, or A and G."""
    ends = [[Fraction(end) for end in text.split(":")] for text in (alpha, g)]
    return flights.Grid(*((one[0], one[-1]) for one in ends), *cells)


# boxes of the theorem; and coarse columns under fine rows, where second orders are large
GRIDS = (
    box("1/20", "197/1000", 256, 16, 24),
    box("9/200:11/200", "24/125:101/500", 512, 32, 44),
    box("0", "11/50", 256, 16, 22),
    box("0:1/100", "1/5:21/100", 128, 16, 24),
    box("1/7", "1/3", 16, 1024, 2048),
    box("1/5:3/10", "2/5:3/5", 16, 512, 2048),
    box("1/2:11/20", "9/10:1", 32, 512, 2048),
    box("1/3", "1/100", 32, 1024, 2048),
    box("1/10:1/5", "13/100", 32, 1024, 2048),
    box("1/10", "1/10:3/10", 32, 1024, 2048),
)


def drawn(grid: flights.Grid, source: random.Random) -> Iterator[State]:
    """States of a cell: its corners and others, each for pairs at ends of the box and others."""

    def within(ends: tuple[Fraction, Fraction]) -> Fraction:
        part = source.choice((Q(0), Q(1), Q(source.randrange(1 << 12), 1 << 12)))
        return ends[0] + part * (ends[1] - ends[0])

    columns, per_unit = grid.columns, grid.per_unit
    i = source.choice((0, columns // 2, columns - 1, source.randrange(columns)))
    row = source.choice((0, 1, source.randrange(per_unit), source.randrange(per_unit)))
    for _ in range(4):
        x = within((Q(i, columns), Q(i + 1, columns)))
        s = within((Q(row, per_unit), Q(row + 1, per_unit)))
        yield State(x, s, within(grid.alpha), within(grid.g))


def resting(grid: flights.Grid, source: random.Random) -> Iterator[State]:
    """States where S is 1, or just above, and the ball leaves at a speed of 0, or almost."""
    alpha, g = source.choice(grid.alpha), source.choice(grid.g)
    c = float((1 - alpha) / (1 + alpha) / 2)
    drive = 2 * math.pi * math.hypot(c, float(g))
    if drive > 1:
        # S = drive cos 2 pi (x - peak)
        peak = math.atan2(c, float(g)) / (2 * math.pi)
        for side in (-1, 1):
            x = Q((peak + side * math.acos(1 / drive) / (2 * math.pi)) % 1) % 1
            near = source.choice((Q(1, 1 << source.randrange(10, 45)), Q(source.random()) / 8))
            s = source.choice((Q(0), near, Q(1, grid.per_unit)))
            yield State((x - side * near) % 1, s, alpha, g)
            yield State(x, Q(1, grid.per_unit), alpha, g)


def grazing(grid: flights.Grid, source: random.Random) -> Iterator[State]:
    """States whose flights touch the table at a phase that is drawn, or miss that by little."""
    alpha, g = source.choice(grid.alpha), source.choice(grid.g)
    c, real = float((1 - alpha) / (1 + alpha) / 2), float(g)
    turn = 2 * math.pi

    def height(x: float) -> float:
        return (c * math.sin(turn * x) + real * math.cos(turn * x)) / turn

    def velocity(x: float) -> float:
        return c * math.cos(turn * x) - real * math.sin(turn * x)

    x1 = source.random()

    def start(time: float) -> float:  # 0 where a flight that began so long ago touches at x1
        return height(x1 - time) - height(x1) + velocity(x1) * time + time * time / 2

    times = [k / 64 for k in range(3, 128)]
    for one, other in zip(times, times[1:]):
        if alpha and start(one) * start(other) < 0:
            for _ in range(50):
                middle = (one + other) / 2
                one, other = (one, middle) if start(one) * start(middle) <= 0 else (middle, other)
            s = (one + velocity(x1) - velocity(x1 - one)) / float(alpha)
            miss = 2.0 ** -source.randrange(8, 36)
            for speed in (s - miss, s + miss):
                if 0 < speed < 1:
                    yield State(Q((x1 - one) % 1) % 1, Q(speed), alpha, g)


def cells_of(state: State, grid: flights.Grid) -> list[tuple[int, int]]:
    """The cells that hold a state: several where it is on a line."""
    i, row = state.x * grid.columns, state.s * grid.per_unit
    columns = {int(i)} | ({int(i) - 1} if i == int(i) else set())
    rows = {int(row)} | ({int(row) - 1} if row == int(row) else set())
    return [
        (one, other)
        for one in columns
        for other in rows
        if 0 <= one < grid.columns and 0 <= other < grid.rows
    ]


def escapes(code: Code, grid: flights.Grid, count: int, seed: int) -> tuple[int, list[str]]:
    """(impacts looked at, those of them outside the enclosure of a cell that holds the state)."""
    source = random.Random(seed)
    there = code.flights.Flights(grid, Work(STEPS))
    walks: dict[int, Any] = {}
    whole: dict[int, list[Any]] = {}  # columns
    looked, outside = 0, []
    while looked < count:
        for state in source.choice((drawn, drawn, drawn, resting, grazing))(grid, source):
            found = first_impact(state)
            for i, row in cells_of(state, grid) if found else ():
                if grid.rows < 40:
                    if i not in whole:
                        whole[i] = [one for _, one in there.column(i, range(grid.rows))]
                    lands = whole[i][row]
                else:
                    walk = walks[i] = walks.get(i) or code.flights.Walk(there, i)
                    below = walk.landings(row - 1, i) if row else []
                    lands = walk.landings(row, below[0][0] if below else i)
                looked += 1
                if not any(holds(found, one, grid) for one in lands):
                    outside.append(f"{state} in cell {i}, {row}")
    return looked, outside


def holds(found: Any, landing: tuple[int, int, int], grid: flights.Grid) -> bool:
    """Whether an impact is not surely outside a landing."""
    x1, s1 = found
    m, lowest, highest = landing
    columns, per_unit = grid.columns, grid.per_unit
    beside = x1 < exact(Q(m, columns)) or x1 > exact(Q(m + 1, columns))
    return not (beside or s1 < exact(Q(lowest, per_unit)) or s1 > exact(Q(highest + 1, per_unit)))
