"""Finds a certificate for a box of parameters; not believed.

The flights are those that the checker encloses; what is looked for is the rest: a trap round the
bounce that the map contracts, the arc in which a ball may rest, and ranks of all other cells.
Where enclosures are too wide for a rank, some cells lie on cycles: these alone are cut, until they
are all round the bounce (the subdivision algorithm; M. Dellnitz, A. Hohmann, Numer. Math. 75,
1997).  Where motions tend elsewhere too, cells have ranks as far as they can, and those at the
border of the ranked cells are cut.
"""

from __future__ import annotations

import json
import zlib
from base64 import b64encode
from collections.abc import Callable, Collection, Iterable, Iterator
from fractions import Fraction
from math import pi
from typing import NamedTuple

from juggleproof.certificates.checker import Rejected, Work
from juggleproof.certificates.sine.cells import (
    CUT,
    UNRANKED,
    Certificate,
    check_trap,
    halved,
    in_trap,
)
from juggleproof.certificates.sine.checker import Counterexample
from juggleproof.certificates.sine.flights import (
    MAX_CELLS,
    MAX_STEPS,
    ONE,
    Flights,
    Grid,
    Interval,
    Landing,
    Refused,
    Walk,
    absorbing_strip,
)
from juggleproof.sine.cycles import cyclic_parts

Cell = tuple[int, int, int]  # how often cells of the grid were cut to make it; column; row
Box = tuple[int, int, int]  # width, low and high of a trap
Targets = Callable[[Cell], Collection[Cell]]

MOST_LEVELS = 8
MOST_EDGES = 1 << 18  # between cells that are looked at again because wider ones lie on cycles
MOST_TRAPPED = 1 << 12  # cells
HIGHEST = UNRANKED - 1
ONCE, MOST_SPEED = Fraction(1), 5  # closing speeds: that of a strip is above 1, in most cases


class Found(NamedTuple):
    """certificate: None if none was found, with the reason; cells: how many were looked at."""

    certificate: Certificate | None
    reason: str
    cells: int


def find_certificate(
    alpha: Interval, g: Interval, columns: int, per_unit: int, basin: int = 0, top: Fraction = ONCE
) -> Found:
    """A certificate for a box, on a grid of this many columns, and rows in a unit of speed.  All
    cells have ranks; for a basin, as many cells as looking at `basin` cells allows.  The rows reach
    up to the closing speed `top`, and to an absorbing strip.
    """
    graph = None
    try:
        graph = Graph(*find_strip(alpha, g, columns, per_unit, top))
        trapped = find_trap_and_cuts(graph, bool(basin))
        return Found(find_ranks(graph, trapped, basin), "", len(graph.landings))
    except (Refused, Rejected) as reason:
        return Found(None, str(reason), len(graph.landings) if graph else 0)


def find_strip(
    alpha: Interval, g: Interval, columns: int, per_unit: int, top: Fraction
) -> tuple[Grid, Flights]:
    """The grid with the fewest rows, not below this top, that end at the top of an absorbing strip;
    and the flights below it.
    """
    grid = Grid(alpha, g, columns, per_unit, per_unit)
    trial = Flights(grid, Work(MAX_STEPS))
    for rows in range(-int(-top * per_unit // 1), MOST_SPEED * per_unit):
        trial.rows = rows  # its tables do not depend on them
        try:
            absorbing_strip(trial)
        except Refused:
            continue
        grid = grid._replace(rows=rows)
        return grid, Flights(grid, Work(MAX_STEPS))
    raise Refused("no absorbing strip")


# ------------------------------------------------------------ cells and where they land


class Graph:
    """Cells, those of the grid and the parts of those that are cut, and where they land.

    landings: those of each cell that was looked at; cut: the cells that are cut; arc: that of R,
    whose cells are one node, `rest`; edges: how many were looked at, and how many may be.
    """

    def __init__(self, grid: Grid, flights: Flights) -> None:
        self.grids, self.flights = [grid], [flights]
        self.cut: set[Cell] = set()
        self.walks: dict[tuple[int, int], Walk] = {}
        self.landings: dict[Cell, list[Landing]] = {
            (0, i, row): landings
            for i in range(grid.columns)
            for row, landings in flights.column(i, range(grid.rows))
        }
        self.arc = find_arc(flights, self.landings)
        self.rest: Cell = (0, self.arc[0], 0)
        self.edges, self.most_edges = 0, MAX_STEPS

    def level(self, number: int) -> Grid:
        """The grid of cells that are cut this number of times."""
        if number == len(self.grids):
            grid = halved(self.grids[-1])
            self.flights.append(Flights(grid, Work(MAX_STEPS)))
            self.grids.append(grid)
        return self.grids[number]

    def lands(self, cell: Cell) -> list[Landing]:
        """The landings of a cell."""
        found = self.landings.get(cell)
        if found is None:
            number, i, row = cell
            if (number, i) not in self.walks:
                self.walks[number, i] = Walk(self.flights[number], i)
            found = self.walks[number, i].landings(row, i)
            if not found:
                raise Refused("a cell without a landing")
            self.landings[cell] = found
        return found

    def there(self, cell: Cell) -> bool:
        """Whether the cell is one of the grid, or a part of one that is cut."""
        return not cell[0] or above(cell) in self.cut

    def node(self, cell: Cell) -> Cell:
        """The cell, or R for its cells."""
        number, i, row = cell
        start, end = self.arc
        rests = not number and not row and (i - start) % self.grids[0].columns < end - start
        return self.rest if rests else cell

    def nodes(self, number: int, landing: Landing) -> Iterator[Cell]:
        """The cells that are not cut and meet this landing of a cell that is cut this number of
        times.
        """
        m, lowest, highest = landing
        m %= self.grids[number].columns
        found = [(0, m >> number, row) for row in range(lowest >> number, (highest >> number) + 1)]
        while found:
            self.edges += 1
            cell = found.pop()
            if cell not in self.cut:
                yield self.node(cell)
                continue
            shift = number - cell[0] - 1
            for part in parts(cell):
                _, i, row = part
                if shift < 0 or i == m >> shift and lowest >> shift <= row <= highest >> shift:
                    found.append(part)

    def targets(self, cell: Cell) -> set[Cell]:
        """The cells in which a motion may first have its next impact, or leave from rest."""
        if self.edges > self.most_edges:
            raise Refused("flights may lead from too many cells back to them")
        if cell == self.rest:
            return self.targets_of_rest()
        number, i, _ = cell
        found = {node for landing in self.lands(cell) for node in self.nodes(number, landing)}
        if not self.grids[0].alpha[0] and self.flights[number].S_low[i] <= ONE:
            found.add(self.rest)
        return found

    def targets_of_rest(self) -> set[Cell]:
        columns = self.grids[0].columns
        start, end = self.arc
        found: set[Cell] = set()
        for i in range(start, end):
            for m, lowest, highest in self.lands((0, i % columns, 0)):
                stays = lowest == 0 and start <= m - i % columns + i < end
                found.update(self.nodes(0, (m, lowest + stays, highest)))
        return found


def above(cell: Cell) -> Cell:
    """The cell that this one is a part of."""
    number, i, row = cell
    return number - 1, i >> 1, row >> 1


def parts(cell: Cell) -> Iterator[Cell]:
    """The four parts of a cell, in the order of their ranks."""
    number, i, row = cell
    for side in 2 * i, 2 * i + 1:
        for half in 2 * row, 2 * row + 1:
            yield number + 1, side, half


def find_arc(flights: Flights, landings: dict[Cell, list[Landing]]) -> tuple[int, int]:
    """The columns where a ball may rest, and those after them where its next flights may land,
    unless these are a period long.
    """
    columns = flights.columns
    rest = [low <= ONE for low in flights.S_low]
    starts = [i for i in range(columns) if rest[i] and not rest[i - 1]]
    if len(starts) != 1:
        raise Refused("no arc where the ball may rest")
    start = end = starts[0]
    while rest[end % columns]:
        end += 1
    least, i = end, start
    while i < end:
        for m, lowest, _ in landings[0, i % columns, 0]:
            landed = m - i % columns + i
            if not lowest and end <= landed < end + columns // 8:
                end = landed + 1
        i += 1
        if end >= start + columns:
            return start, least
    return start, end


# ------------------------------------------------------------ the trap, and what is cut


def find_trap_and_cuts(graph: Graph, basin: bool) -> Certificate:
    """Cuts cells until those on cycles of the graph, or for a basin some round the bounce, are all
    in a trap; returns the trap.

    A cycle of narrow cells lies in a cycle of the wide cells that they are parts of: so only the
    parts of cells on cycles are looked at again.
    """
    trapped: Certificate | None = None
    nodes = {graph.node(cell) for cell in graph.landings}
    if not basin and graph.rest in graph.targets(graph.rest):
        raise Refused("a ball that rests may land there one period later")
    for number in range(MOST_LEVELS + 1):
        grid = graph.level(number)
        cycles = cyclic_parts(nodes, graph.targets)
        homes = [cycle for cycle in cycles if meets_bounce(grid, cycle)]
        home = {cell for cycle in homes for cell in cycle}
        home.discard(graph.rest)
        trapped = finer(trapped) if trapped else find_trap(graph, number, home)
        cycles = homes if basin else cycles
        cut = {cell for cycle in cycles for cell in cycle if not is_trapped(trapped, cell)}
        if trapped and (basin or not cut):
            graph.most_edges = graph.edges + MAX_STEPS
            return trapped
        rests = {graph.rest} & cut
        cut -= rests
        if not trapped:
            cut.update(around(graph, number, home))
        if not cut:
            break
        graph.most_edges = graph.most_edges if number else graph.edges + MOST_EDGES
        graph.cut |= cut
        nodes = {part for cell in cut for part in parts(cell)} | rests
    raise Refused("flights may lead from narrow cells back to them" if trapped else "no trap")


def meets_bounce(grid: Grid, cells: Iterable[Cell]) -> bool:
    """Whether one of the cells may hold the bounce."""
    low, high = rows_of_bounce(grid)
    return any(low <= row < high and i in (0, grid.columns - 1) for _, i, row in cells)


def is_trapped(trapped: Certificate | None, cell: Cell) -> bool:
    """Whether a cell of the grid of a trap is in it."""
    number, i, row = cell
    return trapped is not None and in_trap(trapped, 0, centred(i, trapped.grid), row, row)


def centred(i: int, grid: Grid) -> int:
    """The column, counted from the bounce."""
    return i if i < grid.columns // 2 else i - grid.columns


def finer(trapped: Certificate) -> Certificate:
    """The same trap, in cells of half the width."""
    width, low, high = 2 * trapped.width, 2 * trapped.low, 2 * trapped.high
    return trapped._replace(grid=halved(trapped.grid), width=width, low=low, high=high)


def rows_of_bounce(grid: Grid) -> tuple[int, int]:
    """The rows that hold the bounce; if it is on a line between rows, those on both sides."""
    first, last = (1 / (1 + end) * grid.per_unit for end in reversed(grid.alpha))
    return -int(-first // 1) - 1, int(last // 1) + 1


def extent(grid: Grid, cells: Iterable[Cell]) -> Box:
    """(width, low, high) of the least box round the bounce with these cells in it."""
    width, (low, high) = 1, rows_of_bounce(grid)
    for _, i, row in cells:
        x = centred(i, grid)
        width, low, high = max(width, -x, x + 1), min(low, row), max(high, row + 1)
    return width, low, high


def find_trap(graph: Graph, number: int, home: Collection[Cell]) -> Certificate | None:
    """The least box round the bounce that holds these cells and all that its flights reach, with a
    weight in whose norm the map contracts it.
    """
    grid = graph.grids[number]
    box: Box | None = None
    grown: Box | None = extent(grid, home)
    while grown != box:
        box, grown = grown, grown and reached(graph, number, grown)
    if grown is None:
        return None
    width, low, high = grown
    for weight in weights_at_bounce(grid):
        trapped = Certificate(grid, width, low, high, weight, graph.arc, b"")
        try:
            check_trap(trapped, grid, graph.flights[number])
        except Refused:
            continue
        return trapped
    return None


def weights_at_bounce(grid: Grid) -> list[Fraction]:
    """Weights in whose norms the map contracts what is close to the bounce, if there are any."""
    alpha, g = (float(low + high) / 2 for low, high in (grid.alpha, grid.g))
    lag = 1 - 2 * pi * g
    x_by_x, x_by_s = lag * (1 + alpha) - alpha, alpha * (1 + alpha)
    least = abs(lag * (x_by_x - 1)) / (1 - abs(lag * x_by_s - alpha))
    most = (1 - abs(x_by_x)) / x_by_s if alpha else 4 * least
    if not 0 < least < most:
        return []
    return [Fraction(round(least * (most / least) ** (n / 16) * 1024), 1024) for n in range(1, 16)]


def reached(graph: Graph, number: int, box: Box) -> Box | None:
    """The least box round the bounce that holds this one and all that its flights reach one period
    later; None if some land elsewhere or may touch the table, or if a cell of it is not there.
    """
    width, low, high = box
    columns = graph.grids[number].columns
    if width > columns // 8 or 2 * width * (high - low) > MOST_TRAPPED:
        return None
    for x in range(-box[0], box[0]):
        for row in range(*box[1:]):
            cell = number, x % columns, row
            if not graph.there(cell):
                return None
            for m, lowest, highest in graph.lands(cell):
                y = m - x % columns + x - columns
                if not lowest or abs(y) > columns // 8:
                    return None
                width, low, high = max(width, -y, y + 1), min(low, lowest), max(high, highest + 1)
    return width, low, high


def around(graph: Graph, number: int, home: Collection[Cell]) -> Iterator[Cell]:
    """These cells and their neighbours, among which there may be room for a trap."""
    grid = graph.grids[number]
    width, low, high = extent(grid, home)
    side, half = max(1, width // 2), max(1, (high - low) // 2)
    for x in range(-width - side, width + side):
        for row in range(max(0, low - half), min(high + half, grid.rows)):
            cell = number, x % grid.columns, row
            if graph.there(cell) and graph.node(cell) != graph.rest:
                yield cell


# ------------------------------------------------------------ ranks


def find_ranks(graph: Graph, trapped: Certificate, basin: int) -> Certificate:
    """Ranks: 0 in the trap, else one more than the greatest of the cells where flights may land.

    For a basin, cells without a rank from which a flight may lead to one with a rank are cut, as
    long as no more than `basin` cells are looked at.
    """
    grid, last = graph.grids[0], len(graph.grids) - 1

    def in_it(cell: Cell) -> bool:
        number, i, row = cell
        x = centred(i, graph.grids[number])
        return in_trap(trapped, last - number, x, row, row)

    wide = [(0, i, row) for i in range(grid.columns) for row in range(grid.rows)]
    cells = wide + [part for cell in sorted(graph.cut) for part in parts(cell)]
    left = sorted({graph.node(cell) for cell in cells if cell not in graph.cut})
    ranks = {cell: 0 for cell in left if in_it(cell)}
    nodes, deepest = len(left), MOST_LEVELS - 1
    while left := [cell for cell in left if cell not in ranks]:
        descend(left, ranks, graph.targets)
        left = [cell for cell in left if cell not in ranks]
        if not basin:
            break
        cut = {cell for cell in left if at_border(graph, cell, ranks, deepest)}
        while cut and stored(grid, graph.cut | cut) > MAX_CELLS:
            deepest -= 1
            cut = {cell for cell in cut if cell[0] < deepest}
        if not cut or len(graph.landings) + 4 * len(cut) > basin:
            break
        graph.level(1 + max(number for number, _, _ in cut))
        graph.cut |= cut
        left = [cell for cell in left if cell not in cut]
        left += [part for cell in sorted(cut) for part in parts(cell)]
    if left and not basin:
        raise Refused(f"{len(left)} of {nodes} cells without a rank")
    if max(ranks.values()) > HIGHEST:
        raise Refused(f"more than {HIGHEST} ranks")
    while trapped.grid != graph.grids[-1]:
        trapped = finer(trapped)
    ranks |= dict.fromkeys(left, UNRANKED) | dict.fromkeys(graph.cut, CUT)
    cells = wide + [part for cell in sorted(graph.cut) for part in parts(cell)]
    data = bytes(ranks[graph.node(cell)] for cell in cells)
    return trapped._replace(grid=grid, arc=graph.arc, ranks=data)


def at_border(graph: Graph, cell: Cell, ranks: Collection[Cell], deepest: int) -> bool:
    """Whether a cell that is cut fewer times than `deepest` has a flight to one with a rank."""
    narrow = cell == graph.rest or cell[0] >= deepest
    return not narrow and any(target in ranks for target in graph.targets(cell))


def stored(grid: Grid, cut: Iterable[Cell]) -> int:
    """How many cells of a grid the checker stores if these are cut: `read_levels`."""
    columns = {(number, i) for number, i, _ in cut}
    return grid.rows * (grid.columns + sum(4 << number for number, _ in columns))


def descend(cells: Iterable[Cell], ranks: dict[Cell, int], targets: Targets) -> None:
    """Gives ranks to all cells from which every way leads down.

    Each cell waits for one cell without a rank at a time, and is looked at again when that has one.
    """
    left = {cell: iter(targets(cell)) for cell in cells}
    greatest = dict.fromkeys(left, 0)
    waiting: dict[Cell, list[Cell]] = {}
    for cell in left:
        ready = [cell]
        while ready:
            one = ready.pop()
            for target in left[one]:
                if target not in ranks:
                    waiting.setdefault(target, []).append(one)
                    break
                greatest[one] = max(greatest[one], ranks[target])
            else:
                ranks[one] = greatest[one] + 1
                for other in waiting.pop(one, []):
                    greatest[other] = max(greatest[other], ranks[one])
                    ready.append(other)


def line_of(one: Certificate | Counterexample) -> str:
    """The line of certificates for it."""
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
