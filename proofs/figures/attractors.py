"""What orbits come to for every restitution: each attracting orbit by the closing speeds at its
impacts.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import cache
from itertools import accumulate

from matplotlib.figure import Figure

from juggleproof.drawing.drawing import Plane, blank, styled, ticks
from juggleproof.drawing.lines import Arc, joined, straight
from juggleproof.drawing.look import B2, Look, R
from juggleproof.proofs.figures.arcs import column
from juggleproof.symbolic import normal_impact_after

UP = (0, 10)
STEPS, FINE = 30, 400  # of alpha from 0 to 1, along a branch and where its ends are sought
MOST = 9  # periods of the flights of the e_K that are drawn: those of more begin above
TICKS = {0.0: "0", 1 / 3: "1/3", 0.5: "1/2", 0.6: "3/5", 2 / 3: "2/3", 5 / 7: "5/7", 1.0: "1"}
# the flights of orbits that `juggleproof simulate juggler --words` saw at 0.78 and at 0.8, with an
# alpha at which they are there
SEEN = (
    ((1, 1, 2, 3, 3, 2, 2, 3, 3, 2, 2, 3, 4, 4, 3, 2), Fraction(78, 100)),
    ((2, 2, 3, 4, 4, 3, 3, 4, 4, 3, 3, 3), Fraction(80, 100)),
)
SETTLED = Look(R.colour, "", tint=0.14)
Range = tuple[Fraction, Fraction]
Impact = tuple[Fraction, Fraction]
Flights = tuple[int, ...]


def after(periods: int, alpha: Fraction, impact: Impact) -> Impact:
    """The impact after a flight of so many periods."""
    x, w = column(_image(periods), alpha=alpha, x=impact[0], w=impact[1])
    return Fraction(x), Fraction(w)


_image = cache(lambda periods: normal_impact_after((periods,)))


def impacts(flights: Flights, alpha: Fraction) -> list[Impact]:
    """The impacts that flights of so many periods bring back, of which each need not be one.

    >>> [tuple(map(str, state)) for state in impacts((1,), Fraction(1, 4))]
    [('8/25', '8/5')]
    """
    # after n flights of S periods in all (x, w) is (-alpha)^n (x - S w, w) from where (0, 0) is
    power, origin = (-alpha) ** len(flights), (Fraction(0), Fraction(0))
    *_, (x, w) = accumulate(flights, lambda here, n: after(n, alpha, here), initial=origin)
    speed = w / (1 - power)
    start = (x - power * sum(flights) * speed) / (1 - power), speed
    return list(accumulate(flights[:-1], lambda here, n: after(n, alpha, here), initial=start))


def exists(flights: Flights, alpha: Fraction) -> bool:
    """Whether all of them are impacts, so that an orbit has these flights."""
    return all(0 <= x < w for x, w in impacts(flights, alpha))


def around(flights: Flights, alpha: Fraction) -> Range:
    """From this alpha on both ways in steps, as far as the orbit exists."""
    ends = []
    for step in (Fraction(-1, FINE), Fraction(1, FINE)):
        end = alpha
        while exists(flights, end + step):
            end += step
        ends.append(end)
    return ends[0], ends[1]


def grid(low: Fraction, high: Fraction) -> list[Fraction]:
    """The ends and the steps between them.

    >>> [str(alpha) for alpha in grid(Fraction(1, 3), Fraction(3, 8))]
    ['1/3', '11/30', '3/8']
    """
    first, last = low * STEPS // 1 + 1, -(-high * STEPS // 1) - 1
    return [low, *(Fraction(int(k), STEPS) for k in range(int(first), int(last) + 1)), high]


def branches(flights: Flights, over: Range) -> list[Arc]:
    """The closing speeds at each impact of the orbit over this range of alpha."""
    alphas = grid(*over)
    speeds = zip(*([w for _, w in impacts(flights, alpha)] for alpha in alphas))
    return [arc for one in speeds for arc in joined([*zip(map(float, alphas), map(float, one))])]


@styled
def attractors(settled: Sequence[Range], flights: Flights, proved: Range) -> Figure:
    """The attracting orbits over alpha, and ranges in which all orbits tend to some e_K; one of
    other flights is proved to attract in its range.
    """
    plane = Plane(blank(6.4, 4.4), (0.085, 0.115, 0.9, 0.865), (0, 1), UP)
    plane.frame(TICKS, ticks(range(0, UP[1] + 1, 2)), r"$\alpha$", "$w$ at impacts", 24)
    for index, (low, high) in enumerate(joined_ranges(settled)):
        corners = [(low, UP[0]), (high, UP[0]), (high, UP[1]), (low, UP[1]), (low, UP[0])]
        plane.area(
            [straight(a, b) for a, b in zip(corners, corners[1:])], f"settled-{index}", SETTLED
        )
    for K in range(1, MOST + 1):
        begins = Fraction(K - 1, K + 1)
        plane.line(branches((K,), (begins, Fraction(1))), f"e-{K}", linewidth=1.2)
        plane.text((1, K), f"$e_{K}$", (-9, 8), fontsize=8)
        if K > 1:
            plane.dots([(float(begins), K + 1)], f"begins-{K}", 3.2, filled=False)
    plane.line(branches(flights, proved), "unequal", linewidth=0.9, edgecolor=B2.colour)
    for count, (of, alpha) in enumerate(SEEN):
        over = around(of, alpha)
        plane.line(branches(of, over), f"simulated-{count}", B2, linewidth=0.7)
    return plane.figure


def joined_ranges(ranges: Iterable[Range]) -> list[Range]:
    """The ranges with those that touch as one, in order.

    >>> [tuple(map(str, one)) for one in joined_ranges([(Fraction(1, 2), Fraction(1)),
    ...     (Fraction(0), Fraction(1, 3)), (Fraction(1, 3), Fraction(1, 2))])]
    [('0', '1')]
    """
    found: list[Range] = []
    for low, high in sorted(ranges):
        if found and found[-1][1] >= low:
            found[-1] = (found[-1][0], max(found[-1][1], high))
        else:
            found.append((low, high))
    return found
