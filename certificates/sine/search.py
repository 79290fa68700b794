"""Finds a certificate for a box of parameters; not believed.

The flights are those that the checker encloses; what is looked for is the rest: a trap round the
bounce that the map contracts, the arc in which a ball may rest, and ranks of all other cells.
"""

from __future__ import annotations

import json
import zlib
from base64 import b64encode
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from typing import NamedTuple

from ..checker import Rejected, Work
from .checker import Certificate, Counterexample, check_trap
from .flights import (
    MAX_STEPS,
    ONE,
    Flights,
    Grid,
    Interval,
    Landing,
    Refused,
    absorbing_strip,
)

WEIGHTS = [Fraction(n, 16) for n in range(8, 65)]


class Found(NamedTuple):
    """certificate: None where none was found, for the reason; cells: how many were looked at."""

    certificate: Certificate | None
    reason: str
    cells: int


class Graph(NamedTuple):
    """The cells of a grid and where they land: `landings[i * rows + row]`."""

    grid: Grid
    flights: Flights
    landings: list[list[Landing]]


def find_certificate(alpha: Interval, g: Interval, columns: int, per_unit: int) -> Found:
    """A certificate for a box, on a grid of so many columns and rows of a unit of speed."""
    cells = 0
    try:
        grid, flights = find_strip(alpha, g, columns, per_unit)
        cells = columns * grid.rows
        graph = Graph(grid, flights, [one for i in range(columns) for one in flights.column(i)])
        trapped = find_trap(graph)
        return Found(find_ranks(graph, trapped), "", cells)
    except (Refused, Rejected) as reason:
        return Found(None, str(reason), cells)


def find_strip(alpha: Interval, g: Interval, columns: int, per_unit: int) -> tuple[Grid, Flights]:
    """The fewest rows whose top is that of an absorbing strip, and the flights below it."""
    grid = Grid(alpha, g, columns, per_unit, per_unit)
    trial = Flights(grid, Work(MAX_STEPS))
    for rows in range(per_unit, 3 * per_unit):
        trial.rows = rows  # of which its tables know nothing
        try:
            absorbing_strip(trial)
        except Refused:
            continue
        grid = grid._replace(rows=rows)
        return grid, Flights(grid, Work(MAX_STEPS))
    raise Refused("no absorbing strip")


def find_trap(graph: Graph) -> Certificate:
    """The widest trap: a box round the bounce that its flights do not leave, and a weight in whose
    norm the map contracts it.
    """
    grid, columns = graph.grid, graph.grid.columns
    bounce = [1 / (1 + end) * grid.per_unit for end in reversed(grid.alpha)]
    # the rows with the bounce inside: where it is on a line, those on both of its sides
    first = -int(-bounce[0] // 1) - 1, int(bounce[1] // 1) + 1
    for width in range(columns // 8, 0, -1):
        rows = trapped_rows(graph, width, first)
        if rows is None:
            continue
        for weight in WEIGHTS:
            trapped = Certificate(grid, width, *rows, weight, (0, 1), b"")
            try:
                check_trap(trapped, graph.flights)
            except Refused:
                continue
            return trapped
    raise Refused("no trap")


def trapped_rows(graph: Graph, width: int, first: tuple[int, int]) -> tuple[int, int] | None:
    """The fewest rows, those of `first` among them, which flights from |x| <= width/N do not leave;
    None where one leaves these phases.
    """
    columns, rows = graph.grid.columns, graph.grid.rows
    low, high = first
    while True:
        least, most = low, high
        for x in range(-width, width):
            i = x % columns
            for row in range(low, high):
                for m, lowest, highest in graph.landings[i * rows + row]:
                    if not -width <= m - i + x - columns < width or not lowest:
                        return None
                    least, most = min(least, lowest), max(most, highest + 1)
        if (least, most) == (low, high):
            return low, high
        low, high = least, most


def find_arc(graph: Graph) -> tuple[int, int]:
    """The columns where a ball may rest, and those after them where its next flights may land."""
    columns, rows, flights = graph.grid.columns, graph.grid.rows, graph.flights
    rest = [low <= ONE for low in flights.S_low]
    starts = [i for i in range(columns) if rest[i] and not rest[i - 1]]
    if len(starts) != 1:
        raise Refused("no arc where the ball may rest")
    start = end = starts[0]
    while rest[end % columns]:
        end += 1
    i = start
    while i < end:
        for m, lowest, _ in graph.landings[i % columns * rows]:
            landed = m - i % columns + i
            if not lowest and end <= landed < end + columns // 8:
                end = landed + 1
        i += 1
    return start, end


def find_ranks(graph: Graph, trapped: Certificate) -> Certificate:
    """Ranks: 0 in the trap, else one more than the greatest of the cells where flights may land.

    Each cell waits for one cell without a rank at a time, and is looked at again when that has one.
    """
    grid = trapped.grid
    columns, rows = grid.columns, grid.rows
    start, end = find_arc(graph)
    rest = start * rows  # one node for all of row 0 on the arc

    def node(m: int, row: int) -> int:
        return (
            rest if row == 0 and (m - start) % columns < end - start else m % columns * rows + row
        )

    def targets(cell: int) -> Iterator[int]:
        if cell != rest:
            i = cell // rows
            if not grid.alpha[0] and graph.flights.S_low[i] <= ONE:
                yield rest
            yield from reached(cell)
            return
        for i in range(start, end):
            for m, lowest, highest in graph.landings[i % columns * rows]:
                stays = lowest == 0 and start <= m - i % columns + i < end
                for row in range(lowest + stays, highest + 1):
                    if node(m, row) == rest:
                        raise Refused("a ball that rests may land there one period later")
                    yield node(m, row)

    def reached(cell: int) -> Iterator[int]:
        for m, lowest, highest in graph.landings[cell]:
            for row in range(lowest, highest + 1):
                yield node(m, row)

    ranks = [-1] * (columns * rows)
    for x in range(-trapped.width, trapped.width):
        for row in range(trapped.low, trapped.high):
            ranks[x % columns * rows + row] = 0
    cells = [n for n in range(columns * rows) if ranks[n] and node(n // rows, n % rows) == n]
    descend(cells, ranks, targets)
    left = sum(ranks[n] < 0 for n in cells)
    if left:
        raise Refused(f"{left} of {len(cells)} cells without a rank")
    for i in range(start, end):
        ranks[i % columns * rows] = ranks[rest]
    if max(ranks) > 255:
        raise Refused("more than 255 ranks")
    return trapped._replace(arc=(start, end), ranks=bytes(ranks))


def descend(
    cells: Iterable[int], ranks: list[int], targets: Callable[[int], Iterator[int]]
) -> None:
    """Gives ranks to all cells from which every way leads down."""
    greatest = dict.fromkeys(cells, 0)
    left = {cell: targets(cell) for cell in cells}
    waiting: dict[int, list[int]] = {}
    for cell in left:
        ready = [cell]
        while ready:
            one = ready.pop()
            for target in left[one]:
                if ranks[target] < 0:
                    waiting.setdefault(target, []).append(one)
                    break
                greatest[one] = max(greatest[one], ranks[target])
            else:
                ranks[one] = greatest[one] + 1
                for other in waiting.pop(one, []):
                    greatest[other] = max(greatest[other], ranks[one])
                    ready.append(other)


def line_of(one: Certificate | Counterexample) -> str:
    """What is written of it as a line of certificates."""
    if isinstance(one, Counterexample):
        cells = [one.columns, one.per_unit]
        pair = {"alpha": str(one.alpha), "g": [str(end) for end in one.g]}
        return json.dumps({**pair, "grid": cells, "refutes": one.refutes})
    grid = one.grid
    return json.dumps(
        {
            "alpha": [str(end) for end in grid.alpha],
            "g": [str(end) for end in grid.g],
            "grid": [grid.columns, grid.per_unit, grid.rows],
            "trap": [one.width, one.low, one.high, str(one.weight)],
            "arc": list(one.arc),
            "ranks": b64encode(zlib.compress(one.ranks, 9)).decode("ascii"),
        }
    )
