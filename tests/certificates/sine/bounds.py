"""What the bounds of the flight enclosure must hold: S, F and s1 at corners, by Arb's balls; and
walks over heights that are known exactly.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from fractions import Fraction
from itertools import product
from typing import Any, NamedTuple

from flint import arb, ctx

from juggleproof.certificates.checker import Work
from juggleproof.certificates.sine import flights
from tests.certificates.sine.impacts import PRECISION, State, exact, flight
from tests.certificates.sine.states import STEPS, Code, box

Q = Fraction
UNIT = 1 << 40

# narrow in all but one or two directions, so that no other term hides what is missing in one;
# the last two: the table is slow, or its S steep
GRIDS = (
    box("1/7", "1/3", 16, 1024, 1024),
    box("0:9/10", "1/3", 4096, 4096, 512),
    box("0:9/10", "1/3", 1024, 1024, 1024),
    box("1/3", "1/100:1", 4096, 4096, 512),
    box("0:1/2", "1/2:1", 16, 512, 1024),
    box("1/2:7/8", "1/100:1/50", 4096, 1, 4),
    box("9/10:19/20", "1/100", 16, 1, 4),
    box("9/10", "1/100", 16, 4096, 64),
    box("19/20", "1", 16, 4096, 64),
)


def outside(value: arb, bounds: tuple[int, int]) -> bool:
    """Whether the value is surely not within bounds in units of 2^-40."""
    return bool(value * UNIT < bounds[0]) or bool(value * UNIT > bounds[1])


def broken_bounds(code: Code, grid: flights.Grid, count: int, seed: int) -> list[str]:
    """The bounds of S, F and s1 that a state of their cell exceeds, among so many cells."""
    ctx.prec = PRECISION
    source = random.Random(seed)
    there = code.flights.Flights(grid, Work(STEPS))
    columns, per_unit = grid.columns, grid.per_unit
    broken = []
    for _ in range(count):
        i = source.choice((0, columns // 4, columns // 2, source.randrange(columns)))
        number = source.choice((0, source.randrange(grid.rows)))
        m = i + 1 + source.choice((0, source.randrange(1, columns), source.randrange(3 * columns)))
        walk = code.flights.Walk(there, i)
        row = walk.row(number)
        height, speed, along = (
            walk.height(m, row),
            walk.speed(2 * m, row),
            walk.speed(2 * m + 1, row),
        )
        steep = there.S_low[i], there.S_high[i]
        for parts in product((0, 1), (0, 1), grid.alpha, grid.g):
            x, s = Q(i + parts[0], columns), Q(number + parts[1], per_unit)
            one = flight(State(x, s, *parts[2:]))
            time = exact(Q(m, columns) - x)
            if outside(1 - one.lag(arb(0)), steep):
                broken.append(f"S in {i}")
            if outside(one.gap(time), height):
                broken.append(f"F at {m} from {i}, {number}")
            if outside(-one.rate(time), speed):
                broken.append(f"s1 at {m} from {i}, {number}")
            for end in (0, 1):
                if outside(-one.rate(time + exact(Q(end, columns))), along):
                    broken.append(f"s1 along {m} from {i}, {number}")
            if outside(one.speed, (row.least, row.most)):
                broken.append(f"alpha s in {number}")
            if not one.c**2 + one.g**2 <= (exact(Q(there.rho, UNIT))) ** 2:
                broken.append("rho")
            if not 1 + 2 * arb.pi() * (one.c**2 + one.g**2).sqrt() <= exact(Q(there.fall, UNIT)):
                broken.append("M")
    return broken


class Bent(NamedTuple):
    """An F in units of 2^-40 that bends evenly over each of 16 columns: of a ball that leaves at
    part/8 of the way through column 0, at the rate `start`.
    """

    bends: list[int]  # F'' in each column
    part: int
    start: int

    def pieces(self) -> Iterator[tuple[int, int, int, int]]:
        """For each column the time in it, in 1/128; F and F' where that begins, in units of
        1/2^15 and 1/2^7; F''.
        """
        height, rate = 0, self.start * 128
        for k, bend in enumerate(self.bends):
            time = 8 - self.part if k == 0 else 8
            yield time, height, rate, bend
            height, rate = height + 2 * rate * time + bend * time * time, rate + bend * time

    def first_zero(self) -> set[int]:
        """The columns that hold the first zero: two, where it is on the line between them."""
        for k, (time, height, rate, bend) in enumerate(self.pieces()):
            end = height + 2 * rate * time + bend * time * time
            turns = bend > 0 and 0 < -rate < bend * time and height * bend <= rate * rate
            falls = height == 0 and (rate < 0 or rate == 0 and bend < 0)
            if time and (turns or falls or end < 0):
                return {k}
            if time and end == 0 and (height, rate, bend) != (0, 0, 0):
                return {k, k + 1}
        return set()

    def grazed(self) -> Bent:
        """The same with the greatest start that has a zero in the columns but the last four."""
        low, high = 0, 1 << 44
        while high - low > 1:
            middle = (low + high) // 2
            if min(self._replace(start=middle).first_zero(), default=16) < 12:
                low = middle
            else:
                high = middle
        return self._replace(start=low)


def random_bends(source: random.Random, most: int) -> Bent:
    """Bends of all sizes up to M, some the same as those before; the last columns end all."""
    bends: list[int] = []
    while len(bends) < 12:
        size = source.choice((most, UNIT, UNIT // 64))
        bends += [source.randrange(-size, size)] * source.choice((1, 1, 4))
    bends = bends[:12] + [-most] * 4
    start = source.choice((0, 1, source.randrange(UNIT // 8)))
    one = Bent(bends, source.choice((0, 8, source.randrange(8))), start)
    return source.choice((one, one.grazed()))


def missed_zeros(code: Code, count: int, seed: int) -> tuple[int, list[str]]:
    """Walks over such an F, under bounds that hold it: (those with a zero, those that miss it)."""
    source = random.Random(seed)
    there = code.flights.Flights(box("1/2", "1/3", 16, 16, 64), Work(STEPS))
    looked, missed = 0, []
    for number in range(count):
        one = random_bends(source, there.fall * 9 // 10)
        zero = one.first_zero()
        if zero:
            looked += 1
            lands = {m for m, _, _ in known_walk(code, there, one, source).landings(0, 0)}
            if not zero & lands:
                missed.append(f"walk {number}: {zero} {lands}")
    return looked, missed


def known_walk(code: Code, there: Any, one: Bent, source: random.Random) -> Any:
    """A walk whose bounds are F itself, or hold it with some room."""
    pieces = [*one.pieces()]
    room = [source.choice((0, 0, source.randrange(UNIT // 4))) for _ in pieces]
    there.S_low = [UNIT + bend - less for (_, _, _, bend), less in zip(pieces, room)]
    there.S_high = [UNIT + bend + more for (_, _, _, bend), more in zip(pieces, room)]

    class Walk(code.flights.Walk):  # type: ignore[misc]
        def row(self, number: int) -> Any:
            return code.flights.Row(0, 0, 0, one.start, one.start)

        def height(self, m: int, row: object) -> tuple[int, int]:
            height = pieces[m][1] if m < len(pieces) else -UNIT
            return height >> 15, -(-height >> 15)

        def speed(self, p: int, row: object) -> tuple[int, int]:
            rates = [rate for _, _, rate, _ in pieces[p >> 1 : (p >> 1) + 1 + (p & 1)]]
            return -max(rates) >> 7, -(min(rates) >> 7)

    return Walk(there, 0)


def roundings(code: Code, grid: flights.Grid, count: int, seed: int) -> int:
    """The greatest error of F, s1 or S at centres of cells, and of the box, in units of 2^-40."""
    ctx.prec = PRECISION
    source = random.Random(seed)
    there = code.flights.Flights(grid, Work(STEPS))
    columns, worst = grid.columns, 0
    for _ in range(count):
        i, number = source.randrange(columns), source.randrange(grid.rows)
        m = i + source.randrange(1, 4 * columns)
        walk = code.flights.Walk(there, i)
        row = walk.row(number)
        x, s = Q(2 * i + 1, 2 * columns), Q(2 * number + 1, 2 * grid.per_unit)
        one = flight(State(x, s, Q(there.alpha, UNIT), Q(there.g, UNIT)))
        time = exact(Q(m, columns) - x)
        steep = (there.S_low[i] + there.S_high[i]) // 2
        for bounds, value in (
            (walk.height(m, row), one.gap(time)),
            (walk.speed(2 * m, row), -one.rate(time)),
            ((steep, steep), 1 - one.lag(arb(0))),
        ):
            error = abs(value * UNIT - sum(bounds) // 2).upper()
            worst = max(worst, int(error.ceil().unique_fmpz()))
    return worst
