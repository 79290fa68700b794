"""Rules of the second checker on what is made for them: cells that land where a table says, traps
whose norm Arb knows, rectangles and boxes.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import product
from types import SimpleNamespace
from typing import Any, NamedTuple

from flint import arb, ctx

from juggleproof.certificates.checker import Rejected, Work
from tests.certificates.sine.bounds import UNIT
from tests.certificates.sine.impacts import PRECISION, exact
from tests.certificates.sine.states import STEPS, Code

Q = Fraction
COLUMNS, ROWS = 16, 3
START, END = 13, 18  # of the arc: it goes on over 0
TRAP = {15, 0}  # the columns of the trap: its row is 1


def reason(code: Code, rule: Callable[..., object], *arguments: object) -> str:
    """Why a rule refuses, or ""."""
    try:
        rule(*arguments)
    except (code.flights.Refused, Rejected) as refused:
        return str(refused)
    return ""


# ------------------------------------------------------------ cells


def finer(i: int, row: int) -> list[tuple[int, int, int]]:
    """Where the parts of cells land: in the trap."""
    away = (i + COLUMNS) % (2 * COLUMNS) - COLUMNS
    return [(i - away + 2 * COLUMNS, 2, 3)]


def landings(i: int, row: int) -> list[tuple[int, int, int]]:
    """Where the cells of the world land: in the trap, but those of the arc, in row 0, in the next
    column of the arc, or above it.
    """
    lifted = i if i >= START else i + COLUMNS
    if row == 0 and lifted < END:
        return [(i + 1, 0 if lifted + 1 < END else 1, 1)]
    away = (i + 8) % COLUMNS - 8
    return [(i - away + COLUMNS, 1, 1)]


class World(NamedTuple):
    """A world with changes, and why `check_rest_arc` or `check_cells` refuses it, or ""."""

    name: str
    reason: str = ""
    lands: dict[tuple[int, int], list[tuple[int, int, int]]] = {}
    ranks: dict[tuple[int, int], int] = {}
    low: frozenset[int] = frozenset({14, 15, 16})  # columns where S may be 1 or below
    alpha: Fraction = Q(1, 20)
    arc: tuple[int, int] = (START, END)
    cut: dict[tuple[int, int], tuple[int, int, int, int]] = {}  # ranks of the parts
    parts: dict[tuple[int, int], list[tuple[int, int, int]]] = {}  # where parts land
    trap: tuple[Fraction | int, ...] = (1, 1, 2)


def made(code: Code, world: World) -> Any:
    """The certificate of a world."""
    ranks = bytearray()
    for i in range(COLUMNS):
        for row in range(ROWS):
            rests = row == 0 and (i if i >= START else i + COLUMNS) < END
            rank = 2 if rests else 0 if i in TRAP and row == 1 else 1
            rank = code.cells.CUT if (i, row) in world.cut else rank
            ranks.append(world.ranks.get((i, row), rank))
    for place in sorted(world.cut):
        ranks.extend(world.cut[place])
    grid = code.flights.Grid((world.alpha, Q(1, 2)), (Q(1, 5), Q(1, 5)), COLUMNS, 1, ROWS)
    trap = [int(side * 2 if world.cut else side) for side in world.trap]
    return code.cells.Certificate(grid, *trap, Q(1), world.arc, bytes(ranks))


def seen(code: Code, world: World) -> str:
    """Why the rules refuse a world."""

    def flown(lands: Any, changed: Any, scale: int) -> SimpleNamespace:
        def column(i: int, rows: list[int]) -> Iterator[tuple[int, list[tuple[int, int, int]]]]:
            return ((row, changed.get((i, row)) or lands(i, row)) for row in rows)

        wide = [i // scale for i in range(scale * COLUMNS)]
        steep = [UNIT + (not {i, i + COLUMNS} & world.low) for i in wide]
        return SimpleNamespace(column=column, S_low=steep, S_high=steep)

    flights = [flown(landings, world.lands, 1), flown(finer, world.parts, 2)]
    certificate = made(code, world)
    levels = code.cells.read_levels(certificate, Work(STEPS))
    why = reason(code, code.cells.check_rest_arc, certificate, levels, flights[0])
    return why or reason(code, code.cells.check_cells, certificate, levels, flights)


IN_TRAP, LEAVES = "a cell of the trap has a rank", "a flight leaves the trap"
FALLS, FITS = "a rank does not fall", "a rank does not fit its cell"
MAY_REST = "a cell where the ball may rest has no higher rank than R"
EMPTY = "the rest arc is empty or longer than a period"
LEFT_OUT = "the rest arc leaves out a phase where the ball may rest"
CUTS, WHOLE = "the trap cuts a cell", "a cell of the rest arc is cut"
CUT = {(5, 1): (1, 1, 1, 1)}
HALF, NONE = Q(1, 2), 254  # which is no rank
NO_REST = {(i % COLUMNS, 0): NONE for i in range(START, END)}
HIGH = {(i, row): 3 for i in range(COLUMNS) for row in range(ROWS) if (i, row) != (0, 1)}
ALONE = {  # an arc of one column, 3; what is elsewhere lands in the trap
    "arc": (3, 4),
    "low": frozenset({3}),
    "alpha": Q(0),
    "lands": {(i, 0): [(16, 1, 1)] for i in (13, 14, 15, 0, 1)},
}
ELSEWHERE = {(i, 0): 1 for i in (13, 14, 15, 0, 1)} | {(3, 0): 2}

WORLDS = [
    World("nothing changed"),
    World("two periods to the trap", "", {(5, 1): [(32, 1, 1)]}),
    World("any lower rank", "", {(5, 1): [(7, 0, 2), (31, 1, 1)]}, {(5, 1): 9, (7, 0): 8}),
    World("into the arc, from above it", "", {(5, 1): [(14, 0, 0)]}, {(5, 1): 3}),
    World("its own rank", FALLS, {(5, 1): [(7, 1, 1)]}),
    World("its own rank, in another period", FALLS, {(5, 1): [(39, 1, 1)]}),
    World("its own rank, seen second", FALLS, {(5, 1): [(16, 1, 1), (7, 1, 1)]}),
    World("its own rank, a row above", FALLS, {(5, 1): [(16, 1, 2)]}),
    World("its own rank, a row below", FALLS, {(5, 1): [(17, 0, 1)]}, {(5, 1): 2, (1, 0): 2}),
    World("into itself", FALLS, {(5, 1): [(5, 1, 1)]}),
    World("into the arc, from below it", FALLS, {(5, 1): [(14, 0, 0)]}),
    World("into the arc, from its rank", FALLS, {(5, 1): [(14, 0, 0)]}, {(5, 1): 2}),
    World("a trap cell of rank 1", IN_TRAP, {}, {(0, 1): 1}),
    World("a trap cell that lands at once", LEAVES, {(0, 1): [(0, 1, 1)]}),
    World("a trap cell that lands two periods later", LEAVES, {(0, 1): [(32, 1, 1)]}),
    World("before the trap", LEAVES, {(0, 1): [(14, 1, 1), (15, 1, 1)]}),
    World("just before the trap", LEAVES, {(0, 1): [(14 + 16, 1, 1)]}),
    World("just behind the trap", LEAVES, {(0, 1): [(16, 1, 1), (17, 1, 1)]}),
    World("behind the trap, from its left", LEAVES, {(15, 1): [(33, 1, 1)]}),
    World("below the trap", LEAVES, {(15, 1): [(31, 0, 1)]}),
    World("above the trap", LEAVES, {(15, 1): [(31, 1, 2)]}),
    World("on either side of the bounce", "", {(15, 1): [(31, 1, 1), (32, 1, 1)]}),
    World("above the trap, of rank 0", FITS, {}, {(0, 2): 0}),
    World("below the trap, of rank 0", FITS, {}, {(15, 0): 0}),
    World("beside the trap, of rank 0", FITS, {}, {(1, 1): 0}),
    World("before the trap, of rank 0", FITS, {}, {(14, 1): 0}),
    World("an arc of two ranks", FITS, {}, {(14, 0): 3}),
    World("an arc of two ranks, beyond 0", FITS, {}, {(1, 0): 3}),
    World("the cell after the arc, of another rank", "", {}, {(2, 0): 7}),
    World("the cell above the arc, of another rank", "", {(14, 0): [(16, 1, 1)]}, {(1, 2): 7}),
    World("an arc of rank 0", "R has rank 0", {}, {(13, 0): 0}),
    World("from rest into the next copy", FALLS, {(14, 0): [(29, 0, 0)]}),
    World("from rest beyond 0 into the next copy", FALLS, {(1, 0): [(14, 0, 0)]}),
    World("from rest to behind the arc, on its rank", FALLS, {(1, 0): [(2, 0, 0)]}, {(2, 0): 2}),
    World("from rest to behind the arc", "", {(1, 0): [(2, 0, 0)]}),
    World("from rest to above, on its rank", FALLS, {(14, 0): [(15, 0, 2)]}, {(15, 2): 2}),
    World("from rest to above, in row 1", FALLS, {(13, 0): [(14, 0, 1)]}, {(14, 1): 2}),
    World("from rest to the row above alone", "", {(14, 0): [(15, 1, 1)]}, {(15, 2): 2}),
    World("from rest to above, in the next copy", "", {(14, 0): [(29, 1, 1)]}),
    World("from rest into itself", "", {(14, 0): [(14, 0, 0)]}),
    World("from rest into the last of its copy", "", {(13, 0): [(17, 0, 0)]}),
    World("plastic, and of low rank", MAY_REST, {}, {(14, 1): 1}, alpha=Q(0)),
    World("plastic, off the arc", "", ranks={**ELSEWHERE, (3, 1): 3, (3, 2): 3}, **ALONE),
    World("plastic, of R's rank", MAY_REST, ranks={**ELSEWHERE, (3, 1): 3, (3, 2): 2}, **ALONE),
    World("all but plastic", "", ranks=ELSEWHERE, **{**ALONE, "alpha": Q(1, 1 << 60)}),
    World("an arc of no column", EMPTY, arc=(13, 13)),
    World("an arc from a period on", EMPTY, arc=(16, 18)),
    World("an arc from before 0", EMPTY, arc=(-3, 2)),
    World("an arc of a period", EMPTY, arc=(13, 29)),
    World("almost a period", "", {}, {(i, 0): 2 for i in range(12)}, arc=(13, 28)),
    World("an arc that begins late", LEFT_OUT, arc=(15, 18)),
    World("an arc that ends early", LEFT_OUT, arc=(13, 16)),
    World("an arc that just holds them", "", low=frozenset({13, 17})),
    World("S of 1 just before the arc", LEFT_OUT, low=frozenset({12})),
    World("S of 1 just behind the arc", LEFT_OUT, low=frozenset({18})),
    World("a cell that is cut", cut=CUT),
    World("from part to part", cut={(5, 1): (2, 1, 1, 1)}, parts={(10, 2): [(11, 2, 2)]}),
    World("from part to part, on its rank", FALLS, cut=CUT, parts={(10, 2): [(11, 2, 2)]}),
    World("a part that lands in itself", FALLS, cut=CUT, parts={(11, 3): [(43, 3, 3)]}),
    World("a part of rank 0", FITS, cut={(5, 1): (1, 1, 0, 1)}),
    World("to a lower part alone", cut={(5, 1): (2, 9, 1, 1)}, parts={(10, 2): [(11, 2, 3)]}),
    World("into a cell that is cut", "", {(7, 1): [(5, 1, 1)]}, {(7, 1): 4},
          cut={(5, 1): (1, 1, 1, 3)}),
    World("into parts, one of its rank", FALLS, {(7, 1): [(5, 1, 1)]}, {(7, 1): 3},
          cut={(5, 1): (1, 1, 1, 3)}),
    World("into parts, the first of its rank", FALLS, {(7, 1): [(5, 1, 1)]}, {(7, 1): 3},
          cut={(5, 1): (3, 1, 1, 1)}),
    World("from a part to a wide cell", cut={(5, 1): (2, 1, 1, 1)},
          parts={(10, 2): [(14, 2, 3)]}),
    World("from a part to a wide cell of its rank", FALLS, cut=CUT,
          parts={(10, 2): [(46, 3, 3)]}),
    World("from a part to the wide cell above", cut={(5, 1): (2, 1, 1, 1)},
          parts={(10, 2): [(10, 4, 5)]}),
    World("from a part to the wide cell above, of its rank", FALLS, cut=CUT,
          parts={(10, 2): [(10, 4, 4)]}),
    World("from a part to the wide cell below, of its rank", FALLS, cut=CUT,
          parts={(10, 2): [(10, 1, 1)]}),
    World("from a part to rest", cut={(5, 1): (3, 1, 1, 1)}, parts={(10, 2): [(28, 0, 0)]}),
    World("from a part to rest, on its rank", FALLS, cut={(5, 1): (2, 1, 1, 1)},
          parts={(10, 2): [(28, 0, 0)]}),
    World("a trap of parts", cut={(0, 1): (0, 0, 0, 0)}),
    World("a trap of parts, one with a rank", FALLS, cut={(0, 1): (0, 0, 0, 1)}),
    World("behind the trap, by a part", LEAVES, cut={(0, 1): (0, 0, 0, 0)},
          parts={(1, 2): [(33, 2, 3), (34, 2, 3)]}),
    World("above the trap, by a part", LEAVES, cut={(0, 1): (0, 0, 0, 0)},
          parts={(1, 2): [(32, 2, 4)]}),
    World("a trap beside a part", cut={(0, 1): (0, 0, 0, 0), (1, 1): (1, 1, 1, 1)}),
    *(World(f"the trap ends in a wide cell, {sides}", CUTS, ranks={(0, 1): 1, (15, 1): 1}, cut=CUT,
            trap=sides) for sides in ((HALF, 1, 2), (1, HALF, 2), (1, 1, 3 * HALF))),
    World("the trap ends in a wide cell, on its left alone", CUTS,
          ranks=HIGH | {(i, 0): 4 for i in (13, 14, 15, 0, 1)}, cut={(0, 1): (0, 0, 1, 1)},
          trap=(HALF, 1, 2)),
    World("from a part to two wide cells, the upper of its rank", FALLS, ranks={(7, 1): 2},
          cut={(5, 1): (2, 1, 1, 1)}, parts={(10, 2): [(14, 1, 2)]}),
    World("parts of row 0", cut={(6, 0): (1, 1, 1, 1)}),
    World("a cell of the arc that is cut", WHOLE, cut={(14, 0): (2, 2, 2, 2)}),
    World("the first cell of the arc is cut", WHOLE, cut={(13, 0): (2, 2, 2, 2)}),
    World("the last cell of the arc is cut", WHOLE, cut={(1, 0): (2, 2, 2, 2)}),
    World("the cell behind the arc is cut", cut={(2, 0): (1, 1, 1, 1)}),
    World("plastic parts", ranks={**ELSEWHERE, (3, 2): 3}, cut={(3, 1): (3, 3, 3, 3)}, **ALONE),
    World("a cell without a rank", "", {(5, 1): [(5, 1, 1)]}, {(5, 1): NONE}),
    World("into a cell without a rank", FALLS, {(7, 1): [(5, 1, 1)]}, {(5, 1): NONE, (7, 1): 253}),
    World("a part without a rank", cut={(5, 1): (1, 1, NONE, 1)}),
    World("into a part without a rank", FALLS, {(7, 1): [(5, 1, 1)]}, {(7, 1): 253},
          cut={(5, 1): (1, 1, 1, NONE)}),
    World("a trap cell without a rank", IN_TRAP, ranks={(0, 1): NONE}),
    World("a trap that ends in a cell without a rank", CUTS,
          ranks={(0, 1): NONE, (15, 1): NONE}, cut=CUT, trap=(HALF, 1, 2)),
    World("an arc without a rank", ranks=NO_REST),
    World("an arc without a rank, which lands in its next copy", "", {(14, 0): [(31, 0, 0)]},
          NO_REST),
    World("an arc, a part of it without a rank", FITS, ranks={(14, 0): NONE}),
    World("into an arc without a rank", FALLS, {(5, 1): [(14, 0, 0)]},
          NO_REST | {(5, 1): 253}),
    World("in the arc, above R, on its rank", FALLS, {(13, 1): [(14, 0, 0)]}, {(13, 1): 2}),
    World("from the arc above R, on its rank", FALLS, {(13, 0): [(14, 1, 1)]}, {(14, 1): 2}),
    World("plastic cells without a rank", ranks={**ELSEWHERE, (3, 1): NONE, (3, 2): 3}, **ALONE),
    World("nothing plastic has a rank",
          ranks={**ELSEWHERE, (3, 0): NONE, (3, 1): NONE, (3, 2): NONE}, **ALONE),
    World("plastic cells above an arc without a rank", MAY_REST,
          ranks={**ELSEWHERE, (3, 0): NONE, (3, 1): 3, (3, 2): 3}, **ALONE),
    World("plastic parts, one of R's rank", MAY_REST, ranks={**ELSEWHERE, (3, 2): 3},
          cut={(3, 1): (3, 3, 3, 2)}, **ALONE),
]  # fmt: skip


# (ranks, ranks of parts, the shares of the three rows): of 16 cells each
SHARES: list[tuple[dict[tuple[int, int], int], dict[tuple[int, int], Any], list[Fraction]]] = [
    ({}, {}, [Q(1), Q(1), Q(1)]),
    ({(5, 1): NONE}, {}, [Q(1), Q(15, 16), Q(1)]),
    ({(5, 1): NONE, (7, 1): NONE, (3, 2): NONE}, {}, [Q(1), Q(7, 8), Q(15, 16)]),
    ({}, {(5, 1): (1, NONE, 1, 1)}, [Q(1), Q(63, 64), Q(1)]),
    ({(4, 2): NONE}, {(5, 2): (1, 1, NONE, NONE)}, [Q(1), Q(1), Q(29, 32)]),
    (NO_REST, {}, [Q(11, 16), Q(1), Q(1)]),
]


def wrong_shares(code: Code) -> list[str]:
    """Shares of ranked cells, and of the states below a speed, that are not those they are."""
    wrong = []
    for ranks, cut, expected in SHARES:
        levels = code.cells.read_levels(made(code, World("", ranks=ranks, cut=cut)), Work(STEPS))
        found = code.cells.shares_of(levels)
        one = code.cells.Attraction((Q(0), Q(0)), (Q(1), Q(1)), 1, found)
        if list(found) != expected or one.everywhere() != (not ranks and not cut):
            wrong.append(f"{ranks}, {cut}: {found}")
    one = code.cells.Attraction((Q(0), Q(0)), (Q(1), Q(1)), 2, (Q(1), Q(1, 2), Q(1, 4)))
    all_of_it = code.checker.read_statement(f"{BEGINS} alpha in [0, 0] and g in [1, 1]")
    if code.checker.outcome(all_of_it, [one])[0] == "certified":
        wrong.append("every motion, by a basin")
    below = {"1/4": "1", "1/2": "1", "5/8": "4/5", "3/4": "2/3", "7/8": "5/7", "1": "3/4",
             "5/4": "3/5", "11/8": "6/11", "3/2": "7/12", "2": "7/16"}  # fmt: skip
    wrong += [speed for speed, share in below.items() if one.share_below(Q(speed)) != Q(share)]
    for text, holds in BASINS:
        rectangle = code.checker.read_statement(BASIN.format(*text.split()))
        if (code.checker.outcome(rectangle, [one])[0] == "certified") != holds:
            wrong.append(text)
    return wrong


# ------------------------------------------------------------ traps and strips


def ball(low: Fraction, high: Fraction) -> arb:
    return exact(low).union(exact(high))


NO_TRAP = "the map does not contract the trap"
TURN = 2 * math.pi


def needed(certificate: Any) -> tuple[float, float]:
    """The weights between which the map's matrix is below 1 at those of its ends that are tried."""
    grid, columns = certificate.grid, certificate.grid.columns
    far = certificate.width / columns
    speeds = certificate.low / grid.per_unit, certificate.high / grid.per_unit
    least, most = 0.0, math.inf
    pairs = product(map(float, grid.alpha), map(float, grid.g))
    for (alpha, g), x, x1, s, s1 in product(pairs, (-far, 0, far), (-far, 0, far), speeds, speeds):
        c = (1 - alpha) / (2 * (1 + alpha))
        lag, lag1 = (
            1 - TURN * (c * math.sin(TURN * one) + g * math.cos(TURN * one)) for one in (x, x1)
        )
        x_by_x, x_by_s = ((1 + x1 - x) * lag - alpha * s) / s1, alpha * (1 + x1 - x) / s1
        least = max(least, abs(lag1 * x_by_x - lag) / (1 - abs(lag1 * x_by_s - alpha)))
        most = min(most, (1 - abs(x_by_x)) / x_by_s)
    return least, most


def enough(certificate: Any, steep: arb) -> tuple[arb, arb]:
    """Weights between which the map's matrix is below 1 all over a trap, for S in an interval."""
    grid, columns = certificate.grid, certificate.grid.columns
    alpha = ball(*grid.alpha)
    speed = ball(Q(certificate.low, grid.per_unit), Q(certificate.high, grid.per_unit))
    time = ball(1 - Q(2 * certificate.width, columns), 1 + Q(2 * certificate.width, columns))
    x_by_x = (time * (1 - steep) - alpha * speed) / speed
    x_by_s = alpha * time / speed
    s_by_x = (1 - steep) * x_by_x - (1 - steep)
    s_by_s = (1 - steep) * x_by_s - alpha
    sizes = [arb(abs(one).upper()) for one in (x_by_x, x_by_s, s_by_x, s_by_s)]
    return sizes[2] / (1 - sizes[3]), (1 - sizes[0]) / sizes[1]


def steepness(certificate: Any, room: int) -> arb:
    """S over a trap, so many half columns wider."""
    grid = certificate.grid
    x = Q(certificate.width, grid.columns) + Q(room, 2 * grid.columns)
    found = None
    parts = 8
    for k in range(parts):
        sine, cosine = (2 * ball(-x + 2 * x * k / parts, -x + 2 * x * (k + 1) / parts)).sin_cos_pi()
        for alpha in grid.alpha:
            for g in grid.g:
                c = exact((1 - alpha) / (2 * (1 + alpha)))
                one = 2 * arb.pi() * (c * sine + exact(g) * cosine)
                found = one if found is None else found.union(one)
    return arb(0) if found is None else found


def wrong_traps(code: Code, count: int, seed: int) -> tuple[int, list[str]]:
    """Traps with weights just beyond those that Arb knows to contract, and just within: (those that
    contract, those on which `check_trap` differs).
    """
    ctx.prec = PRECISION
    source = random.Random(seed)
    contract, wrong = 0, []
    for number in range(count):
        alpha, g = Q(source.randrange(1, 300), 1000), Q(source.randrange(20, 300), 1000)
        wide = [Q(source.choice((0, source.randrange(30))), 1000) for _ in range(2)]
        per_unit = source.choice((16, 64))
        grid = code.flights.Grid((alpha, alpha + wide[0]), (g, g + wide[1]), 1024, per_unit, 100)
        ends = 1 / (1 + alpha + wide[0]), 1 / (1 + alpha)
        low = int(ends[0] * per_unit) - source.randrange(4)
        high = -int(-ends[1] * per_unit // 1) + source.randrange(4)
        there = code.flights.Flights(grid, Work(1 << 20))
        for width in (1, 12, 32):
            one = code.cells.Certificate(grid, width, low, high, Q(1), (0, 1), b"")
            least, most = needed(one)
            begin, end = enough(one, steepness(one, 2))
            within = [Q(float(begin)) * Q(501, 500), Q(float(end)) * Q(499, 500)]
            within = [weight for weight in within if begin < exact(weight) < end]
            for weight in (*within, Q(least) * Q(499, 500), Q(most) * Q(501, 500)):
                if weight > 0:
                    tried = one._replace(weight=weight)
                    why = reason(code, code.cells.check_trap, tried, grid, there)
                    contract += not why
                    if (weight in within) and why == NO_TRAP or weight not in within and not why:
                        wrong.append(f"{number}, {width}, {float(weight)}: {why}")
    return contract, wrong


def wrong_strips(code: Code) -> list[str]:
    """The fewest rows that reach an absorbing strip, where they are not those of its formula."""
    ctx.prec = PRECISION
    wrong = []
    for alpha, g in ((("0", "1/1000"), ("1/5", "1/5")), (("1/20", "1/10"), ("1/10", "1/4"))):
        ends = [(Q(one), Q(other)) for one, other in (alpha, g)]
        c = exact((1 - ends[0][0]) / (2 * (1 + ends[0][0])))
        rho, most = (c * c + exact(ends[1][1]) ** 2).sqrt(), exact(ends[0][1])
        for rows in range(1024, 2048):
            top = exact(Q(rows, 1024))
            if rho + ((rho + most * top) ** 2 + 2 * rho / arb.pi()).sqrt() < top:
                break
        for number, expected in ((rows, ""), (rows - 1, "the rows do not reach")):
            grid = code.flights.Grid(*ends, 16, 1024, number)
            there = code.flights.Flights(grid, Work(1 << 20))
            why = reason(code, code.flights.absorbing_strip, there)
            if not why.startswith(expected) or bool(why) != bool(expected):
                wrong.append(f"{number} rows: {why}")
    return wrong


# ------------------------------------------------------------ rectangles


def boxes(*rows: str) -> list[Any]:
    """Boxes written as "A0 A1 G0 G1", in hundredths."""
    found = []
    for row in rows:
        a_low, a_high, g_low, g_high = (Q(text) / 100 for text in row.split())
        found.append(((a_low, a_high), (g_low, g_high)))
    return found


GAP = "the boxes do not cover the rectangle"
# (name, rectangle, boxes, reason): in hundredths, of alpha and g, or "Gamma"
COVERS = [
    ("one box", "10 20 30 40", ("10 20 30 40",), ""),
    ("a box around", "10 20 30 40", ("9 21 29 41",), ""),
    ("no box", "10 20 30 40", (), GAP),
    ("no box for a point", "10 10 30 30", (), GAP),
    ("a point", "10 10 30 30", ("10 10 30 30",), ""),
    ("a point beside", "10 10 30 30", ("10 10 31 31",), GAP),
    ("a point above a box", "10 10 30 30", ("10 10 28 29",), GAP),
    ("two boxes above each other", "10 20 30 40", ("10 20 30 35", "10 20 35 40"), ""),
    ("two boxes with a gap", "10 20 30 40", ("10 20 30 34", "10 20 35 40"), GAP),
    ("boxes in another order", "10 20 30 40", ("10 20 35 40", "10 20 33 36", "10 20 30 33"), ""),
    ("a box below all", "10 20 30 40", ("10 20 10 20", "10 20 25 40"), ""),
    ("a box within another", "10 20 30 40", ("10 20 30 38", "10 20 31 32", "10 20 38 40"), ""),
    ("too low", "10 20 30 40", ("10 20 30 39",), GAP),
    ("too high", "10 20 30 40", ("10 20 31 40",), GAP),
    ("too far left", "10 20 30 40", ("10 19 30 40",), GAP),
    ("too far right", "10 20 30 40", ("11 20 30 40",), GAP),
    ("two boxes beside each other", "10 20 30 40", ("10 15 30 40", "15 20 30 40"), ""),
    ("two boxes with a strip between", "10 20 30 40", ("10 15 30 40", "15.1 20 30 40"), GAP),
    ("a brick wall", "10 20 30 40",
     ("10 13 30 35", "13 20 30 36", "10 17 35 40", "13 17 36 40", "17 20 36 40"), ""),
    ("a wall without a brick", "10 20 30 40",
     ("10 13 30 35", "13 20 30 36", "10 16 35 40", "17 20 36 40"), GAP),
    ("a box without width", "10 20 30 40", ("10 10 30 40", "10 20 30 30", "20 20 30 40"), GAP),
    ("a box upside down", "10 20 30 40", ("20 10 40 30",), GAP),
]  # fmt: skip


def covered(code: Code, rectangle: str, rows: tuple[str, ...]) -> str:
    """Why boxes do not cover a rectangle of g."""
    ((alpha, g),) = boxes(rectangle)
    one = code.checker.Rectangle("", alpha, "g", g)
    return reason(code, code.checker.check_cover, one, boxes(*rows), Work(1 << 20))


def wrong_drives(code: Code, count: int, seed: int) -> list[str]:
    """Bounds of g for a drive Gamma that do not hold it, or are wide; and what rests on them."""
    ctx.prec = PRECISION
    source = random.Random(seed)
    wrong: list[str] = []
    for _ in range(count):
        alpha = Q(source.randrange(980), 1001)
        gamma = Q(source.randrange(10**6, 8 * 10**6), 10**6)
        c = exact((1 - alpha) / (2 * (1 + alpha)))
        square = (exact(gamma) / (2 * arb.pi())) ** 2 - c * c
        low, high = (code.checker.g_at(alpha, gamma, up=up) for up in (False, True))
        if square > 1e-3:
            root = square.sqrt()
            if not (exact(low) < root < exact(high) and high - low <= Q(32, UNIT)):
                wrong.append(f"g at {alpha}, {gamma}")
            far = alpha + Q(1, 100), gamma + Q(1, 100)
            corner = code.checker.g_at(*far, up=True)
            one = code.checker.Rectangle("", (alpha, far[0]), "Gamma", (gamma, far[1]))
            whole = [((alpha, far[0]), (low, corner))]
            if reason(code, code.checker.check_cover, one, whole, Work(1 << 20)):
                wrong.append(f"a rectangle from {alpha}, {gamma} is not covered")
            for g in ((high, Q(9)), (Q(0), corner - Q(64, UNIT))):
                less = [((alpha, far[0]), g)]
                if not reason(code, code.checker.check_cover, one, less, Work(1 << 20)):
                    wrong.append(f"a rectangle from {alpha}, {gamma} is covered by less")
        elif square < -1e-3 and (low != 0 or high != Q(1, UNIT)):
            wrong.append(f"no g at {alpha}, {gamma}")
    return wrong


MULTIPLIERS = Q(1, 20), (Q(29, 100), Q(3, 10))  # alpha and g: Gamma is 3.3764.. to 3.4107..
BELOW_BIRTH = (Q(0), Q(1, 2)), "Gamma", (Q(3), Q(4))
BEGINS = "the period-one bounce is stable and every motion tends to it for all"
# (name, the rest of a statement, whether MULTIPLIERS refute it)
MEETS = [
    ("that g", "alpha in [1/20, 1/20] and g in [29/100, 30/100]", True),
    ("a wider g", "alpha in [1/100, 1/10] and g in [1/10, 1]", True),
    ("g that begins there", "alpha in [1/100, 1/10] and g in [30/100, 1]", True),
    ("g beyond", "alpha in [1/100, 1/10] and g in [31/100, 1]", False),
    ("g below", "alpha in [1/100, 1/10] and g in [1/100, 28/100]", False),
    ("alpha below", "alpha in [1/100, 1/25] and g in [1/10, 1]", False),
    ("alpha beyond", "alpha in [1/19, 1/10] and g in [1/10, 1]", False),
    ("a Gamma within", "alpha in [1/20, 1/20] and Gamma in [339/100, 339/100]", True),
    ("a Gamma below", "alpha in [1/20, 1/20] and Gamma in [3, 337/100]", False),
    ("a Gamma above", "alpha in [1/20, 1/20] and Gamma in [342/100, 4]", False),
    ("a Gamma below birth", "alpha in [1/20, 1/20] and Gamma in [1, 2]", False),
]


BASIN = (
    "the period-one bounce is stable and at least {} of the impacts with closing speed below {}"
    " tend to it for all alpha in [{}, 0] and g in [1, 1]"
)
# (share, speed, alpha; whether the shares 1, 1/2 and 1/4 of half units prove it at alpha = 0)
BASINS = [
    ("1 1/2 0", True),
    ("3/4 1 0", True),
    ("751/1000 1 0", False),
    ("7/12 3/2 0", True),
    ("59/100 3/2 0", False),
    ("2/3 3/4 0", True),
    ("67/100 3/4 0", False),
]
NO_BASINS = ["0 1 0", "2 1 0", "1/2 0 0", "0.5 1 0", "1/2 -1 0", "1/2 1 1/2"]


def refuted(code: Code, text: str, why: str = "multiplier", begins: str = BEGINS) -> bool:
    """Whether a statement is refuted by an interval of multipliers, or of saddles."""
    one = code.checker.Counterexample(why, *MULTIPLIERS, 16, 16)
    rectangle = code.checker.read_statement(f"{begins} {text}")
    return bool(code.checker.outcome(rectangle, [one])[0] == "refuted")


def basins_in_order(code: Code) -> bool:
    """Basins are refuted by a multiplier, not by a saddle; and not every text is a basin's."""
    begins = BASIN.partition(" alpha")[0].format("1/2", "1")
    text = MEETS[0][1]
    return (
        refuted(code, text, begins=begins)
        and not refuted(code, text, "saddle", begins)
        and refuted(code, text, "saddle")
        and all(
            reason(code, code.checker.read_statement, BASIN.format(*one.split()))
            for one in NO_BASINS
        )
    )
