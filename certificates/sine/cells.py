"""Cells of states, cut where that is needed, and the rules on them: what comes to the trap.

Of the second checker, whose theorem stands in `checker.py`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import NamedTuple

from ..checker import Work
from .flights import (
    MAX_CELLS,
    ONE,
    Flights,
    Grid,
    Interval,
    Landing,
    absorbing_strip,
    check_grid,
    require,
)

CUT = 255  # in place of the rank of a cell that is cut
UNRANKED = 254  # of a cell of which nothing is said
WHOLE, PARTED = 1, 2  # what a row of a column is, or 0


class Certificate(NamedTuple):
    """What a line that certifies says.

    grid: of the widest cells; trap: the states |x| <= width/N, low/K <= s <= high/K, with N and K
    of the narrowest cells; weight: of s in the norm max(|x|, |s|/weight); arc: first column of the
    grid and the column after the last; ranks: those of the cells, as `read_levels` reads them.
    """

    grid: Grid
    width: int
    low: int
    high: int
    weight: Fraction
    arc: tuple[int, int]
    ranks: bytes


class Attraction(NamedTuple):
    """What a certificate proves: for all alpha and g of a box the bounce is stable, and of all
    states (x, s) with row/K <= s < (row + 1)/K at least a share tends to it, for each row.  Where
    each share is 1 every motion tends to it.
    """

    alpha: Interval
    g: Interval
    per_unit: int
    shares: tuple[Fraction, ...]

    def everywhere(self) -> bool:
        return all(share == 1 for share in self.shares)

    def share_below(self, speed: Fraction) -> Fraction:
        """A lower bound of the share of the states with s < speed that tend to the bounce: of a row
        across that speed, what tends elsewhere may all be below it.
        """
        rows = speed * self.per_unit
        whole = int(rows)
        total = sum(self.shares[:whole], Fraction())
        if whole < len(self.shares):
            total += max(Fraction(), self.shares[whole] - (1 - rows + whole))
        return total / rows


class Level(NamedTuple):
    """The cells of one width.

    ranks: for each column with such cells, the rank of each of its rows, in which a wider cell has
    its own, and a cell that is cut the greatest of its parts; cells: for these columns, what each
    row is: a cell of this width that is WHOLE, one that is PARTED, or a part of a wider one.
    """

    grid: Grid
    ranks: dict[int, bytearray]
    cells: dict[int, bytearray]

    def rows(self, i: int, kind: int) -> Iterator[int]:
        """The rows of a column that are of this kind."""
        return (row for row, found in enumerate(self.cells[i]) if found == kind)


def read_levels(certificate: Certificate, work: Work) -> list[Level]:
    """The cells of a certificate, from the widest to the narrowest.

    Ranks are one byte for each cell of the grid, column by column.  A cell of the rank CUT is cut
    into four, across phase and speed; for these, in the same order, the ranks of their parts
    follow, column by column, and so on.
    """
    grid, data = certificate.grid, certificate.ranks
    columns, rows = grid.columns, grid.rows
    check_grid(grid)
    read = stored = columns * rows
    require(read <= len(data), "not one rank for each cell")
    work.spend(stored)
    first = {i: bytearray(data[i * rows : (i + 1) * rows]) for i in range(columns)}
    levels = [Level(grid, first, {i: bytearray([WHOLE]) * rows for i in range(columns)})]
    while True:
        wide = levels[-1]
        for i, cells in wide.cells.items():
            for row in wide.rows(i, WHOLE):
                if wide.ranks[i][row] == CUT:
                    cells[row] = PARTED
        cut = [i for i, cells in wide.cells.items() if PARTED in cells]
        if not cut:
            break
        parts = 4 * sum(wide.cells[i].count(PARTED) for i in cut)
        require(read + parts <= len(data), "not one rank for each cell")
        grid = halved(grid)
        more = 2 * grid.rows * len(cut)
        stored += more
        require(stored <= MAX_CELLS, "too many cells")
        work.spend(more)
        narrow = Level(grid, {}, {})
        for i in cut:
            for side in 2 * i, 2 * i + 1:
                narrow.ranks[side] = doubled(wide.ranks[i])
                narrow.cells[side] = bytearray(grid.rows)
            for row in wide.rows(i, PARTED):
                for side in 2 * i, 2 * i + 1:
                    narrow.ranks[side][2 * row : 2 * row + 2] = data[read : read + 2]
                    narrow.cells[side][2 * row : 2 * row + 2] = [WHOLE, WHOLE]
                    read += 2
        levels.append(narrow)
    require(read == len(data), "not one rank for each cell")
    for wide, narrow in reversed(list(zip(levels, levels[1:]))):
        for i in wide.cells:
            for row in wide.rows(i, PARTED):
                sides = narrow.ranks[2 * i], narrow.ranks[2 * i + 1]
                wide.ranks[i][row] = max(max(side[2 * row : 2 * row + 2]) for side in sides)
    return levels


def halved(grid: Grid) -> Grid:
    """The grid of cells of half the width in phase and speed."""
    return Grid(grid.alpha, grid.g, 2 * grid.columns, 2 * grid.per_unit, 2 * grid.rows)


def doubled(ranks: bytearray) -> bytearray:
    """Each rank twice."""
    twice = bytearray(2 * len(ranks))
    twice[::2] = twice[1::2] = ranks
    return twice


def greatest_rank(levels: Sequence[Level], landing: Landing) -> int:
    """The greatest rank of all cells that a landing in columns and rows of the last of these levels
    may be in; -1 for no rows.
    """
    m, lowest, highest = landing
    m %= levels[-1].grid.columns
    for level in reversed(levels):
        if m in level.ranks:
            return max(level.ranks[m][lowest : highest + 1], default=-1)
        m, lowest, highest = m >> 1, lowest >> 1, highest >> 1
    raise LookupError(m)  # the first level has all columns


# ------------------------------------------------------------ rules on cells


def times(first: Interval, second: Interval) -> Interval:
    """All products of a number of one interval with a number of the other."""
    ends = [one * other for one in first for other in second]
    return min(ends), max(ends)


def plus(first: Interval, second: Interval) -> Interval:
    return first[0] + second[0], first[1] + second[1]


def largest(interval: Interval) -> Fraction:
    return max(abs(interval[0]), abs(interval[1]))


def check_trap(certificate: Certificate, grid: Grid, flights: Flights) -> None:
    """The bounce is a stable fixed point in the trap, and all that starts in the trap tends to it.

    The trap is a box |x| <= width/N, low/K <= s <= high/K, of the grid of the narrowest cells, with
    the bounce inside, for each alpha.
    `check_cells` has seen that all its flights land in it, one period later, and so with s1 > 0:
    without a touch before, so that the map from impact to impact is differentiable there.  By the
    implicit function theorem on F = 0, with y = x1 - x,

        dx1 = (F_x dx + alpha y ds)/s1,       F_x = y (1 - S(x)) - alpha s,
        ds1 = -(1 - S(x)) dx - alpha ds + (1 - S(x1)) dx1.

    Where the norm of this matrix in max(|dx|, |ds|/weight) is below 1 all over the trap, which is
    convex, the map contracts it.  Its fixed point has a flight of exactly one period, so
    s = 1/(1 + alpha) and c cos 2 pi x - g sin 2 pi x = c: x is 0, or else S(x) = -2 pi g < 0, which
    S > 0 on the trap excludes.  With alpha = 0 the ball would rest where S <= 1: then S > 1 there.
    """
    width, low, high = certificate.width, certificate.low, certificate.high
    columns, per_unit = grid.columns, grid.per_unit
    require(0 < width <= columns // 8 and 0 < low < high, "the trap is empty or too large")
    require(high <= grid.rows, "the trap is beyond the rows")
    a_low, a_high = grid.alpha
    speed = (Fraction(low, per_unit), Fraction(high, per_unit))
    holds = speed[0] < 1 / (1 + a_high) and 1 / (1 + a_low) < speed[1]
    require(holds, "the bounce is not inside the trap for each alpha")
    S_low = min(flights.S_low[i] for i in range(-width, width))
    S_high = max(flights.S_high[i] for i in range(-width, width))
    require(S_low > (0 if a_low > 0 else ONE), "the table is too slow in the trap")
    lag = (1 - Fraction(S_high, ONE), 1 - Fraction(S_low, ONE))
    time = (1 - Fraction(2 * width, columns), 1 + Fraction(2 * width, columns))
    inverse = (1 / speed[1], 1 / speed[0])
    minus_alpha = (-a_high, -a_low)
    x_by_x = times(plus(times(time, lag), times(minus_alpha, speed)), inverse)
    x_by_s = times(times((a_low, a_high), time), inverse)
    s_by_x = plus((-lag[1], -lag[0]), times(lag, x_by_x))
    s_by_s = plus(minus_alpha, times(lag, x_by_s))
    weight = certificate.weight
    require(weight > 0, "the weight is not positive")
    contracts = largest(x_by_x) + largest(x_by_s) * weight < 1
    contracts = contracts and largest(s_by_x) + largest(s_by_s) * weight < weight
    require(contracts, "the map does not contract the trap")


def check_rest_arc(certificate: Certificate, levels: Sequence[Level], flights: Flights) -> None:
    """A motion that comes to R, the arc in row 0 of the grid, leaves R after finitely many flights
    and at most one rest.

    The arc is shorter than a period and holds every column where S <= 1 is possible, so that in
    each of its copies the phases with S <= 1 are one interval, which ends where S rises through 1,
    at x_L say.  `check_cells` has seen that a flight from R that lands in R lands in the same copy.
    Let impacts in R go on for ever: their phases increase in one copy, to a limit x'.  The flights'
    durations t tend to 0, and with F = 0 at both ends and |F''| <= M, s <= M t tends to 0.  Were
    S(x') > 1, then S >= 1 + e near x', where a flight of any u >= v stays above the table for as
    long as it is near: so S(x') <= 1, and the ball rests, from x' to x_L, and leaves in the state
    (x_L, 0), in R.  The rest of the copy has S > 1: no second limit is there.
    """
    start, end = certificate.arc
    columns = certificate.grid.columns
    fits = 0 <= start < columns and start < end < start + columns
    require(fits, "the rest arc is empty or longer than a period")
    outside = all(flights.S_low[i % columns] > ONE for i in range(end, start + columns))
    require(outside, "the rest arc leaves out a phase where the ball may rest")
    whole = all(levels[0].cells[i % columns][0] == WHOLE for i in range(start, end))
    require(whole, "a cell of the rest arc is cut")


def check_cells(
    certificate: Certificate, levels: Sequence[Level], flights: Sequence[Flights]
) -> None:
    """Descent of a rank: every motion from a ranked cell below the strip's top comes to the trap.

    Each cell has a rank, those of R the same, or is unranked.  What starts in a ranked cell outside
    R and the trap has its next impact in a cell of smaller rank, or in the trap; what starts in R,
    where that is ranked, leaves it (`check_rest_arc`) to a cell of smaller rank, or to the trap, in
    which all stays.  Ranks are whole numbers >= 0: so the trap is reached.  With alpha = 0 the ball
    rests after an impact where S <= 1 and leaves in R: such cells have ranks above that of R.
    UNRANKED is above all ranks: no flight from a ranked cell leads there.  A cell may be cut, and
    its parts have ranks instead; none is cut by the border of the trap.
    """
    start, end = certificate.arc
    at_rest = levels[0].ranks[start][0]
    require(at_rest > 0, "R has rank 0")
    for number, (level, flown) in enumerate(zip(levels, flights)):
        columns, shift = level.grid.columns, len(levels) - 1 - number
        for i in level.cells:
            lifted = i if i >= start else i + columns
            in_arc = not number and lifted < end
            x = i if i < columns // 2 else i - columns
            may_stay = level.grid.alpha[0] == 0 and flown.S_low[i] <= ONE
            for row in level.rows(i, WHOLE):
                rank, rests = level.ranks[i][row], in_arc and row == 0
                if in_trap(certificate, shift, x, row, row):
                    require(rank == 0, "a cell of the trap has a rank")
                    continue
                require(rank == at_rest if rests else rank > 0, "a rank does not fit its cell")
                require(not meets_trap(certificate, shift, x, row), "the trap cuts a cell")
                if may_stay and not rests and rank != UNRANKED:
                    higher = rank > at_rest
                    require(higher, "a cell where the ball may rest has no higher rank than R")
            ranked = (row for row in level.rows(i, WHOLE) if level.ranks[i][row] != UNRANKED)
            for row, landings in flown.column(i, ranked):
                rank = level.ranks[i][row]
                for m, lowest, highest in landings:
                    if rank == 0:
                        lands = in_trap(certificate, shift, m - i + x - columns, lowest, highest)
                        require(lands, "a flight leaves the trap")
                        continue
                    if in_arc and row == lowest == 0:
                        lowest += m - i + lifted < end  # in R, in the same copy
                    reached = greatest_rank(levels[: number + 1], (m, lowest, highest))
                    require(reached < rank, "a rank does not fall")


def shares_of(levels: Sequence[Level]) -> tuple[Fraction, ...]:
    """For each row of the grid, the share of its states that lie in ranked cells."""
    grid, last = levels[0].grid, len(levels) - 1
    ranked = [0] * grid.rows  # in cells of the narrowest
    for number, level in enumerate(levels):
        for i in level.cells:
            for row in level.rows(i, WHOLE):
                if level.ranks[i][row] != UNRANKED:
                    ranked[row >> number] += 4 ** (last - number)
    return tuple(Fraction(count, grid.columns * 4**last) for count in ranked)


def in_trap(one: Certificate, shift: int, x: int, lowest: int, highest: int) -> bool:
    """Whether column x, of cells that are 2^shift of the narrowest wide, is in the trap there."""
    inside = -one.width <= x << shift and x + 1 << shift <= one.width
    return inside and one.low <= lowest << shift and highest + 1 << shift <= one.high


def meets_trap(one: Certificate, shift: int, x: int, row: int) -> bool:
    """Whether such a cell has a part in the trap."""
    inside = -one.width < x + 1 << shift and x << shift < one.width
    return inside and one.low < row + 1 << shift and row << shift < one.high


def check_box(certificate: Certificate, work: Work) -> Attraction:
    """What a certificate proves for its box; raises Refused where it proves nothing."""
    levels = read_levels(certificate, work)
    flights = [Flights(level.grid, work) for level in levels]
    absorbing_strip(flights[0])
    check_trap(certificate, levels[-1].grid, flights[-1])
    check_rest_arc(certificate, levels, flights[0])
    check_cells(certificate, levels, flights)
    grid = certificate.grid
    return Attraction(grid.alpha, grid.g, grid.per_unit, shares_of(levels))
