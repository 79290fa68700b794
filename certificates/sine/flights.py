"""Flight enclosure: where a ball lands on a table that moves as a sine, for a box of parameters.

Of the second checker, whose theorem stands in `checker.py`.  The standard library alone, and the
first checker's meter of work; integers and fractions only.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Iterator
from fractions import Fraction
from functools import lru_cache
from math import isqrt
from typing import NamedTuple

from ..checker import Work

BITS = 40
ONE = 1 << BITS
SLACK = 256  # units of 2^-40, in each bound: the roundings behind it are together below 100 units
FINE = 96  # bits of the sums that give pi, sines and cosines
LONGEST = 4  # periods that a flight may take in an enclosure
MAX_COLUMNS, MAX_ROWS, MAX_CELLS = 1 << 15, 1 << 13, 1 << 21
# What one line of certificates may cost, in steps: a step is what it takes to look at one line of a
# grid, 5 to 10 microseconds, and all other work is counted by as many as it takes, or by more.
MAX_STEPS = 1 << 24

Interval = tuple[Fraction, Fraction]
Landing = tuple[int, int, int]  # a column, counted on over periods; its lowest and highest row


class Refused(Exception):
    """A certificate does not prove its statement; the message is one line."""


def require(holds: object, reason: str) -> None:
    """A check on which soundness rests: unlike `assert`, it cannot be switched off."""
    if not holds:
        raise Refused(reason)


# ------------------------------------------------------------ numbers


def pi_times(unit: int) -> int:
    """pi in units of 1/unit, within 2^9 units: Machin's 16 arctan(1/5) - 4 arctan(1/239)."""

    def arctan(inverse: int) -> int:
        power = unit // inverse
        total, odd = 0, 1
        while power:  # fewer than 200 terms for 2^FINE, each rounded by less than 2 units
            total += power // odd if odd % 4 == 1 else -(power // odd)
            power //= inverse * inverse
            odd += 2
        return total

    return 16 * arctan(5) - 4 * arctan(239)


@lru_cache(maxsize=4)
def sines(count: int) -> array[int]:
    """2^40 sin(2 pi j/count) for j below count, a multiple of 4, each within one unit.

    Taylor's sum in units of 2^-96 in the first quarter, the others by symmetry; the rest of the sum
    is below its last term.
    """
    pi = pi_times(1 << FINE)
    quarter = []
    for j in range(count // 4 + 1):
        angle = 2 * pi * j // count
        square = angle * angle >> FINE
        total, power, odd = 0, angle, 1
        while power:
            total += power if odd % 4 == 1 else -power
            power = (power * square >> FINE) // ((odd + 1) * (odd + 2))
            odd += 2
        quarter.append(total + (1 << FINE - BITS - 1) >> FINE - BITS)
    half = quarter + quarter[-2:0:-1]
    return array("q", half + [-value for value in half])


PI2 = 2 * pi_times(1 << FINE) >> FINE - BITS  # 2 pi, rounded down


# ------------------------------------------------------------ grids


class Grid(NamedTuple):
    """A box of parameters, and the cells that states are cut into.

    columns: N, phases are cut at multiples of 1/N; per_unit: K, closing speeds are cut at multiples
    of 1/K; rows: speeds below rows/K are looked at.
    """

    alpha: Interval
    g: Interval
    columns: int
    per_unit: int
    rows: int


def power_of_two(number: int) -> bool:
    return number > 0 and not number & number - 1


def check_grid(grid: Grid) -> None:
    """The parameters are in range, and no table of the grid is too large."""
    (alpha_low, alpha_high), (g_low, g_high) = grid.alpha, grid.g
    require(0 <= alpha_low <= alpha_high < 1, "alpha is not within 0 <= alpha < 1")
    require(0 < g_low <= g_high <= 1, "g is not within 0 < g <= 1")
    fits = power_of_two(grid.columns) and 16 <= grid.columns <= MAX_COLUMNS
    require(fits, f"the columns are not a power of two from 16 to {MAX_COLUMNS}")
    fits = power_of_two(grid.per_unit) and grid.per_unit <= MAX_ROWS
    require(fits, f"the rows of a unit are not a power of two up to {MAX_ROWS}")
    require(0 < grid.rows <= MAX_ROWS, f"the rows are not up to {MAX_ROWS}")


def absorbing_strip(flights: Flights) -> None:
    """Every motion comes to closing speeds below top = rows/K, and stays there.

    rho is the table's greatest speed, rho/(2 pi) its greatest height.  The ball leaves with
    |u| <= rho + alpha s; by its energy it arrives with the square of its velocity at most
    u^2 + 2 (P(x) - P(x1)) <= (rho + alpha s)^2 + 2 rho/pi.  Hence

        s1 <= b(s) = rho + sqrt((rho + alpha s)^2 + 2 rho/pi).

    b has a slope of at most alpha < 1: where b(top) < top, each s <= top has s1 <= b(top) < top,
    and each s > top has s1 - top <= alpha (s - top) - (top - b(top)), so that finitely many impacts
    lead below top.
    """
    top = flights.rows * ONE // flights.per_unit
    speed = flights.rho + (flights.alpha_high * top >> BITS) + 1
    square = speed * speed + 4 * flights.rho * ONE * ONE // PI2 + ONE
    require(flights.rho + isqrt(square) + 1 < top, "the rows do not reach up to an absorbing strip")


class Flights:
    """Flight enclosure: where every flight that starts in a cell lands, for a box of parameters.

    A cell is a column i, i/N <= x <= (i + 1)/N, and a row r, r/K <= s <= (r + 1)/K.  `column` gives
    for each row a list of landings, column and rows: each motion that starts in the cell has its
    first impact after x in one of them.

    Bounds are those of the mean value theorem, from the centre of the box of (x, s, alpha, g) in
    two steps: s, alpha and g move to their values at the centre of the column, and then x does.
    With half widths h, |F - F(centre)| <= |F_s| h_s + |F_alpha| h_alpha + |F_g| h_g + |F_x| h_x,
    where the first three are suprema over all s, alpha and g at that one x, and the last is one
    over the whole box; no term of second order is left.  With d = x1 - x, and dc/dalpha = -k,
    k = 1/(1+alpha)^2:

        F_x = d (1 - S(x)) - alpha s,  F_alpha = s d - k ((sin 2 pi x - sin 2 pi x1)/(2 pi)
        F_s = alpha d,                                    + d cos 2 pi x),
        F_g = (cos 2 pi x - cos 2 pi x1)/(2 pi) - d sin 2 pi x.

    S is bounded likewise: S_alpha = -2 pi k sin 2 pi x, S_g = 2 pi cos 2 pi x, |S_x| <= 2 pi Gamma;
    and so is s1, x1 moving last, as x does: its derivatives are S(x) - 1, -alpha, sin 2 pi x - sin
    2 pi x1, k (cos 2 pi x - cos 2 pi x1) - s, and 1 - S(x1) in x1.  F'' = S(x1) - 1 >= -M,
    M = 1 + Gamma, F' = -s1.

    A walk goes over the lines x1 = m/N.  On each, `low` >= 0 bounds F from below and `slope` bounds
    F' from below, for the motions that have not landed before it: F > 0 holds for them up to there.
    A column after a line is free of landings where low + slope t + rise t^2/2 > 0 for its t, with
    rise <= S - 1 on it, or where F at both ends exceeds bend/(8 N^2), bend >= S - 1 on it; a walk
    jumps over columns where low + slope t - M t^2/2 > 0.  It ends at a line where F < 0 for all of
    the cell.  A column that is not free is a landing, but where s1 < 0 on it: F falls to a first
    zero.  F grows with s: no row lands before the columns where the row below it first can.
    """

    def __init__(self, grid: Grid, work: Work) -> None:
        (alpha_low, alpha_high), (g_low, g_high) = grid.alpha, grid.g
        columns, rows = grid.columns, grid.rows
        check_grid(grid)
        work.spend(2 * columns)  # before the tables
        self.work = work
        self.columns, self.per_unit, self.rows = columns, grid.per_unit, rows
        self.shift = columns.bit_length()  # 2^shift half columns are a period
        self.half = ONE >> self.shift
        self.alpha_low, self.alpha_high = round_down(alpha_low), round_up(alpha_high)
        self.alpha = self.alpha_low + self.alpha_high >> 1
        self.alpha_half = self.alpha_high - self.alpha
        g_down, g_up = round_down(g_low), round_up(g_high)
        self.g = g_down + g_up >> 1
        self.g_half = g_up - self.g
        self.k_low = ONE**3 // (ONE + self.alpha_high) ** 2
        self.k_high = ONE**3 // (ONE + self.alpha_low) ** 2 + 1
        c_high = (ONE - self.alpha_low) * ONE // (2 * (ONE + self.alpha_low)) + 1
        self.rho = isqrt(c_high**2 + g_up**2) + 1
        gamma = (self.rho * (PI2 + 1) >> BITS) + 1
        self.fall = ONE + gamma  # M
        c = (ONE - self.alpha) * ONE // (2 * (ONE + self.alpha))
        self.sin = sines(2 * columns)
        self.cos = self.sin[columns // 2 :] + self.sin[: columns // 2]
        heights = [c * sin + self.g * cos for sin, cos in zip(self.sin, self.cos)]
        # below 2^45 all of them, or OverflowError: eight bytes for each
        self.height = array("q", (height // PI2 for height in heights))
        waves = zip(self.sin, self.cos)
        self.velocity = array("q", (c * cos - self.g * sin >> BITS for sin, cos in waves))
        turn = ((PI2 + 1) * self.half >> BITS) + 1
        self.S_low, self.S_high = array("q"), array("q")
        for j in range(1, 2 * columns, 2):
            middle = (heights[j] >> BITS) * PI2 >> BITS
            radius = gamma * turn >> BITS
            by_alpha = (self.k_high * self.alpha_half >> BITS) * abs(self.sin[j])
            by_g = self.g_half * abs(self.cos[j])
            radius += ((by_alpha + by_g >> BITS) + 1) * PI2 >> BITS
            self.S_low.append(middle - radius - SLACK)
            self.S_high.append(middle + radius + SLACK)

    def times_k(self, middle: int) -> tuple[int, int]:
        """The ends of k times what is rounded to this."""
        low, high = middle - SLACK, middle + SLACK
        low = low * (self.k_low if low >= 0 else self.k_high) >> BITS
        return low, (high * (self.k_high if high >= 0 else self.k_low) >> BITS) + 1

    def column(self, i: int, rows: Iterable[int]) -> Iterator[tuple[int, list[Landing]]]:
        """(row, its landings) for rows of column i, which ascend."""
        first = i
        walk = Walk(self, i)
        for row in rows:
            landings = walk.landings(row, first)
            require(landings, "a cell without a landing")
            first = landings[0][0]
            yield row, landings


def round_down(value: Fraction) -> int:
    return value.numerator * ONE // value.denominator


def round_up(value: Fraction) -> int:
    return -(-value.numerator * ONE // value.denominator)


class Row(NamedTuple):
    """Bounds of a row's s; alpha s at the centre; bounds of alpha s."""

    low: int
    high: int
    rebound: int
    least: int
    most: int


class Walk:
    """The flights that start in one column; see `Flights`.  What all rows share is kept."""

    def __init__(self, flights: Flights, i: int) -> None:
        self.flights, self.i = flights, i
        self.j = 2 * i + 1
        # 1 - S on this column
        self.lag_low, self.lag_high = ONE - flights.S_high[i], ONE - flights.S_low[i]
        self.lag = max(abs(self.lag_low), abs(self.lag_high))
        self.heights: dict[int, tuple[int, ...]] = {}
        self.speeds: dict[int, tuple[int, ...]] = {}

    def height_at(self, m: int) -> tuple[int, ...]:
        """For the line x1 = m/N: F without alpha s, d in half columns and in periods, the ends of
        d (1 - S(x)), of k's product in F_alpha, and what s and g add to the radius.
        """
        flights, j = self.flights, self.j
        n = 2 * m - j
        q = 2 * m & 2 * flights.columns - 1
        sin, cos, shift = flights.sin, flights.cos, flights.shift
        d = n * flights.half
        low, high = d - flights.half, d + flights.half
        value = flights.height[j] - flights.height[q] + (flights.velocity[j] * n >> shift)
        value -= d * d >> BITS + 1
        lag_low = self.lag_low * (low if self.lag_low >= 0 else high) >> BITS
        lag_high = (self.lag_high * (high if self.lag_high >= 0 else low) >> BITS) + 1
        by_c = (sin[j] - sin[q]) * ONE // PI2 + (cos[j] * n >> shift)
        c_low, c_high = flights.times_k(by_c)
        by_g = abs((cos[j] - cos[q]) * ONE // PI2 - (sin[j] * n >> shift)) + SLACK
        speed = ONE // (2 * flights.per_unit)
        radius = (flights.alpha_high * d >> BITS) * speed + by_g * flights.g_half
        radius = (radius >> BITS) + SLACK
        found = value, n, d, lag_low, lag_high, c_low, c_high, radius
        self.heights[m] = found
        return found

    def speed_at(self, p: int) -> tuple[int, int, int, int]:
        """For x1 = p/(2N), or, p being odd, the column around it: s1 without alpha s, the ends of
        its derivative in alpha but for s, and what x, s, g and x1 add to the radius.
        """
        flights, j = self.flights, self.j
        q = p & 2 * flights.columns - 1
        value = (p - j) * flights.half + flights.velocity[q] - flights.velocity[j]
        c_low, c_high = flights.times_k(flights.cos[j] - flights.cos[q])
        by_g = abs(flights.sin[j] - flights.sin[q]) + SLACK
        radius = self.lag * flights.half + by_g * flights.g_half
        radius += flights.alpha_high * (ONE // (2 * flights.per_unit))
        if p & 1:
            t = q >> 1
            lag = max(abs(ONE - flights.S_low[t]), abs(ONE - flights.S_high[t]))
            radius += lag * flights.half
        found = value, c_low, c_high, (radius >> BITS) + SLACK
        self.speeds[p] = found
        return found

    def row(self, row: int) -> Row:
        flights = self.flights
        low, high = row * ONE // flights.per_unit, (row + 1) * ONE // flights.per_unit
        rebound = flights.alpha * (low + high) >> BITS + 1
        least, most = flights.alpha_low * low >> BITS, (flights.alpha_high * high >> BITS) + 1
        return Row(low, high, rebound, least, most)

    def height(self, m: int, row: Row) -> tuple[int, int]:
        """Bounds of F at x1 = m/N for all that starts in a row of this column."""
        flights = self.flights
        s_low, s_high, rebound, least, most = row
        found = self.heights.get(m) or self.height_at(m)
        value, n, d, lag_low, lag_high, c_low, c_high, radius = found
        by_x = max(lag_high - least, most - lag_low)
        by_alpha = max((s_high * d >> BITS) + 1 - c_low, c_high - (s_low * d >> BITS))
        radius += by_x * flights.half + by_alpha * flights.alpha_half >> BITS
        value += rebound * n >> flights.shift
        return value - radius, value + radius

    def speed(self, p: int, row: Row) -> tuple[int, int]:
        """Bounds of s1 at x1 = p/(2N), or, p being odd, in the column around it."""
        s_low, s_high, rebound = row[:3]
        value, c_low, c_high, radius = self.speeds.get(p) or self.speed_at(p)
        radius += max(c_high - s_low, s_high - c_low) * self.flights.alpha_half >> BITS
        return value - rebound - radius, value - rebound + radius

    def landing(self, m: int, row: Row) -> list[Landing]:
        """A landing in column m, unless F rises all over it or s1 is beyond the rows."""
        rows, unit = self.flights.rows, BITS + 1 - self.flights.per_unit.bit_length()
        slowest, fastest = self.speed(2 * m + 1, row)
        lowest = max(slowest, 0) >> unit
        if fastest < 0 or lowest >= rows:
            return []
        return [(m, lowest, min(fastest >> unit, rows - 1))]

    def landings(self, number: int, first: int) -> list[Landing]:
        """Where the flights of one row land, none of which lands before the column `first`."""
        flights, i, row = self.flights, self.i, self.row(number)
        columns, fall, least = flights.columns, flights.fall, row.least
        step = 2 * flights.half
        landings: list[Landing] = []
        m = first
        if m == i:
            # x anywhere in the column: F >= alpha s t + rise t^2/2 up to its end
            rise = flights.S_low[i] - ONE
            if rise <= 0 and least * 2 * columns <= -rise:
                landings += self.landing(m, row)
            m += 1
            low, slope = 0, least + (min(0, rise) * step >> BITS)
        else:
            low, slope = 0, -self.speed(2 * m, row)[1]
        while True:
            flights.work.spend(1)
            require(m - i <= LONGEST * columns, "a flight without an end")
            least_height, most_height = self.height(m, row)
            if most_height < 0:
                break
            low = max(low, least_height)
            if low > step >> 2:
                slope = max(slope, -self.speed(2 * m, row)[1])
                time = (slope + isqrt(slope * slope + 2 * fall * (low - 2 * SLACK))) * ONE // fall
                jump = time // step
                if jump > 1:
                    time = jump * step
                    low += (slope * time >> BITS) - (fall * (time * time >> BITS + 1) >> BITS)
                    low -= SLACK
                    slope -= (fall * time >> BITS) + 1
                    if low > 0:
                        m += jump
                        continue
                    raise Refused("a jump over a landing")
            # least S - 1 on the column, and greatest F over a chord
            rise = flights.S_low[m % columns] - ONE
            bend = max(0, flights.S_high[m % columns] - ONE) // (8 * columns * columns) + 1
            after = low + (slope * step >> BITS) + (rise * step >> BITS + 1) * step // ONE
            free = after > 0 if rise <= 0 else slope >= 0
            if not free and not (low > bend and self.height(m + 1, row)[0] > bend):
                landings += self.landing(m, row)
            low = max(after, 0)
            slope += rise * step >> BITS
            m += 1
        # the ranks of the rows that are reached will be looked at
        flights.work.spend(sum(top - low for _, low, top in landings) // 64)
        return landings
