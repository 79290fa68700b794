"""Two figures that the paper lacks: the trap with the levels of the rank, and the restitutions for
which the claims hold.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from textwrap import wrap

from matplotlib.figure import Figure
from sympy import Expr, Symbol

from juggleproof.drawing.drawing import Plane, Style, blank, styled, ticks
from juggleproof.drawing.lines import Arc, Place, Real, straight
from juggleproof.drawing.look import B1, B2, TRAP
from juggleproof.proofs.figures.arcs import ALPHA, column, curve, value, zeros
from juggleproof.reports.figures import Row
from juggleproof.reports.words import Interval
from juggleproof.scenes.juggler.exact import flight, impact, strikes
from juggleproof.scenes.juggler.picture import CLOSING, HEIGHT
from juggleproof.symbolic import normal_e_1, root_of
from juggleproof.symbolic.algebra import n, w, x

# -------------------------------------------------------------------------------------------------
# The trap and the rank.
#
# The trap, the levels of the rank and orbits that fall into the trap, in the normal form (x, w).

ACROSS, UP = (-0.75, 8.2), (-4.3, 7.3)
# where the orbits start
STARTS = tuple(
    (Fraction(a), Fraction(b))
    for a, b in ((3, -3), (5, 0), (2, 6), (Fraction(1, 2), Fraction(-5, 2)))
)
LEVELS = range(1, 13)
State = tuple[Fraction, Fraction]  # (x, w)
Side = tuple[Place, Place, bool]  # its ends, and whether it is left out of the region
# an expression in x and w that is positive inside, and whether it is so on the boundary too
Margin = tuple[Expr, bool]


def normal_step(height: Fraction, closing: Fraction) -> State:
    """One period in normal form, exactly.

    >>> normal_step(Fraction(3), Fraction(-3))
    (Fraction(6, 1), Fraction(-1, 1))
    """
    return (
        impact(ALPHA, height, closing) if strikes(height, closing) else flight(height, closing, 1)
    )


def orbit_into(trap: Sequence[Margin], start: State, most: int = 30) -> list[State]:
    """The orbit from the start until it is in the trap; ValueError where that takes more steps than
    allowed.
    """
    states = [start]
    while not inside(trap, *states[-1]):
        if len(states) > most:
            raise ValueError(f"not in the trap after {most} steps: {start}")
        states.append(normal_step(*states[-1]))
    return states


def inside(trap: Sequence[Margin], height: Real, closing: Real) -> bool:
    """Whether a state is in the trap: every margin is positive, or zero where that is allowed."""
    return all(
        here > 0 or (here == 0 and not strict)
        for here, strict in (
            (value(margin, x=height, w=closing), strict) for margin, strict in trap
        )
    )


def sides(trap: Sequence[Margin]) -> list[Side]:
    """The sides of the trap, whose margins are linear, as far as the axes show it: ends, and
    whether the side is left out.
    """
    edge = [(Fraction(a), Fraction(b)) for a, b in ((-50, -50), (50, -50), (50, 50), (-50, 50))]
    polygon: list[Side] = [(start, stop, True) for start, stop in zip(edge, [*edge[1:], edge[0]])]
    for margin, strict in trap:
        polygon = _clipped(polygon, margin, strict)
    return polygon


def _clipped(polygon: list[Side], margin: Expr, strict: bool) -> list[Side]:
    kept: list[Side] = []
    for start, stop, left_out in polygon:
        here, there = (value(margin, x=point[0], w=point[1]) for point in (start, stop))
        if here * there < 0:
            share = here / (here - there)
            crossing = (
                start[0] + share * (stop[0] - start[0]),
                start[1] + share * (stop[1] - start[1]),
            )
            start, stop = (start, crossing) if here > 0 else (crossing, stop)
        if here > 0 or there > 0:
            kept.append((start, stop, left_out))
    # The new side runs from where the outline leaves the half plane to where it enters again.
    for index, (_, stop, _) in enumerate(kept):
        after = kept[(index + 1) % len(kept)][0]
        if stop != after:
            kept.insert(index + 1, (stop, after, strict))
            break
    return kept


@cache
def heights_of_rank(rank: Expr, root: Symbol, square: Expr) -> tuple[Expr, Expr]:
    """The height x at which w has the rank n, and the root there; the rank is linear in the root,
    whose square is linear in x.
    """
    root_there = root_of(rank - n, root)
    return root_of(square - root_there**2, x), root_there


def rank_level(rank: Expr, root: Symbol, square: Expr, level: int) -> Arc:
    """The states x >= 0 of this rank, an arc of a parabola; ValueError where the root would be
    negative.
    """
    height, root_there = heights_of_rank(rank, root, square)
    low, high = zeros(height, w, n=level)
    if min(value(root_there, w=low, n=level), value(root_there, w=high, n=level)) < 0:
        raise ValueError(f"the root would be negative where the rank is {level}")
    return curve(height, w, w, low, high, n=level)


@styled
def trap_and_rank(rank: Expr, root: tuple[Symbol, Expr], trap: Sequence[Margin]) -> Figure:
    """The trap (its margins, and whether each is strict), orbits that fall into it, and levels of
    the rank (its root, and the square of that).
    """
    plane = Plane(blank(5.2, 4.4), (0.1, 0.115, 0.88, 0.865), ACROSS, UP)
    plane.frame(
        ticks(range(int(ACROSS[1]) + 1)),
        ticks(range(-int(-UP[0]), int(UP[1]) + 1)),
        HEIGHT,
        CLOSING,
    )
    plane.line([straight((0, UP[0]), (0, UP[1]))], None, linewidth=1.2)
    draw_levels(plane, rank, root)
    draw_trap(plane, trap)
    for count, start in enumerate(STARTS):
        orbit = orbit_into(trap, start)
        for here, there in zip(orbit, orbit[1:]):
            plane.arrow(
                shown(here), shown(there), B1.colour if strikes(*here) else B2.colour, 1.2, short=3
            )
        plane.dots(map(shown, orbit), f"orbit-{count}", 3.2)
    point = shown(column(normal_e_1()))
    plane.dots([point], "e-1", 7, "+")
    plane.text(point, "$e_1$", (1, 3), va="bottom")
    plane.text((0.75, 3.55), "trap")
    plane.text((1.95, 1.82), "$x = w$", rotation=43, rotation_mode="anchor", va="top", fontsize=9)
    plane.text((0.7, 4.08), r"$\alpha w = 1$", va="bottom", fontsize=9)
    plane.text((1.65, 5.5), "$f_1$")
    plane.text((6.8, 2.2), "$f_2$")
    return plane.figure


def shown(state: Place) -> tuple[float, float]:
    """An exact state as it is drawn."""
    return float(state[0]), float(state[1])


def draw_levels(plane: Plane, rank: Expr, root: tuple[Symbol, Expr]) -> None:
    """Draws the levels of the rank, each numbered where it meets x = 0."""
    for level in LEVELS:
        arc = rank_level(rank, *root, level)
        plane.line([arc], f"rank-{level}", linewidth=0.6, alpha=0.75)
        plane.text(arc.at(arc.start), str(level), (-3, 0), ha="right", fontsize=7.5)
    plane.text(arc.at(arc.start), "rank", (-3, -9), ha="right", fontsize=8)


def draw_trap(plane: Plane, trap: Sequence[Margin]) -> None:
    """Fills the trap; sides that do not belong to it are dashed."""
    trap_sides = sides(trap)
    plane.area([straight(start, stop) for start, stop, _ in trap_sides], "trap", TRAP)
    for index, (start, stop, left_out) in enumerate(trap_sides):
        plane.line(
            [straight(start, stop)],
            f"trap-side-{index}",
            TRAP if left_out else None,
            linewidth=1.6,
            zorder=1.5,
        )


# -------------------------------------------------------------------------------------------------
# The ranges of the claims.
#
# For each claim the restitutions on which it holds; claims with the same range share a bar.

Group = tuple[tuple[Interval, ...], list[Row]]

# the figure's width in inches; a line of text, and what lies between rows, in points
WIDTH, LINE, GAP = 5.6, 8.6, 4.0
# where names start, and bars start and end, in parts of the width
NAMES, LEFT, RIGHT = 0.01, 0.445, 0.755
MOST_NAMED = 11  # claims are named up to so many, then counted
SMALL, HEAD = 7.0, 16.0  # the size of letters, and the room for the heads of the columns, in points
APART = 0.016  # how far a bar stays from an end that does not belong to it
TICKS = {Fraction(0): "0", Fraction(1, 3): "1/3", Fraction(1, 2): "1/2", Fraction(1): "1"}
WHOLE: tuple[Interval, ...] = ((Fraction(0), Fraction(1), False, False),)


def grouped(rows: Sequence[Row]) -> list[Group]:
    """The rows that can be drawn, those with one range together: the whole range first, then by the
    upper end, downwards, nowhere last.
    """
    groups: dict[tuple[Interval, ...], list[Row]] = {}
    for row in rows:
        if row[2] is not None:
            groups.setdefault(tuple(row[2]), []).append(row)
    return sorted(
        groups.items(),
        key=lambda group: (
            not group[0],
            [(low, -high, not from_low, not to_high) for low, high, from_low, to_high in group[0]],
        ),
    )


def names(group: Group) -> list[str]:
    """What a bar is called, in lines: its claims, or their number."""
    claims = list(dict.fromkeys(row[0] for row in group[1]))
    if len(claims) > MOST_NAMED:
        return [f"{len(claims)} claims and readings"]
    whole = ", ".join(claim.replace(" ", "~") for claim in claims)  # no name is broken
    return [line.replace("~", " ") for line in wrap(whole, 50, break_on_hyphens=False)]


def verdicts(group: Group) -> list[str]:
    """The verdicts of a bar's claims, with their numbers where there are several."""
    counts = Counter(row[1] for row in group[1])
    counted = [
        f"{count} {word}" if len(group[1]) > 1 else word
        for word, count in sorted(counts.items(), key=lambda one: (-one[1], one[0]))
    ]
    return [", ".join(counted[at : at + 2]) for at in range(0, len(counted), 2)]


def footnote(rows: Sequence[Row], without_alpha: int) -> str:
    """What the figure does not draw."""
    missing = [row[0] for row in rows if row[2] is None]
    without = (
        [f"{without_alpha} claims do not speak of \N{GREEK SMALL LETTER ALPHA}."]
        if without_alpha
        else []
    )
    return " ".join([*without, *([f"Not drawn: {', '.join(missing)}."] if missing else [])])


@styled
def ranges(rows: Sequence[Row], without_alpha: int = 0) -> Figure:
    """The ranges of the claims as bars over alpha, with the number of claims in which alpha does
    not occur.
    """
    groups = grouped(rows)
    lines = [max(len(names(group)), len(verdicts(group))) for group in groups]
    below = wrap(footnote(rows, without_alpha), 95, break_on_hyphens=False)
    foot = 34.0 + LINE * len(below)
    height = sum(count * LINE + GAP for count in lines) + HEAD + foot
    figure = blank(WIDTH, height / 72)
    bottom = height - foot - HEAD
    plane = Plane(figure, (LEFT, foot / height, RIGHT - LEFT, bottom / height), (0, 1), (0, bottom))
    plane.frame({float(tick): label for tick, label in TICKS.items()}, {}, r"$\alpha$")
    plane.line(
        [straight((1 / 3, 0), (1 / 3, bottom))],
        "one-third",
        linewidth=0.7,
        linestyle=(0, (4, 3)),
        zorder=0.5,
    )
    names_at, bars_at, verdicts_at = (
        72 * WIDTH * part for part in (NAMES, (LEFT + RIGHT) / 2, RIGHT + 0.025)
    )
    style: dict[str, Style] = {"fontsize": SMALL, "linespacing": 1.05, "ha": "left"}
    for at, label in (
        (names_at, "claim (reading)"),
        (bars_at, "holds for"),
        (verdicts_at, "verdict of the claim"),
    ):
        plane.words(
            (at, height - 10),
            label,
            **{**style, "style": "italic", "ha": "center" if at == bars_at else "left"},
        )
    top = bottom
    for index, (group, count) in enumerate(zip(groups, lines)):
        middle = top - (count * LINE + GAP) / 2
        plane.words((names_at, foot + middle), "\n".join(names(group)), **style)
        plane.words((verdicts_at, foot + middle), "\n".join(verdicts(group)), **style)
        draw_range(plane, group[0], middle, f"range-{index}")
        top -= count * LINE + GAP
    plane.words((names_at, 2), "\n".join(below), **{**style, "va": "bottom"})
    return figure


def draw_range(plane: Plane, intervals: Sequence[Interval], middle: float, name: str) -> None:
    """Draws one range: bars with full circles at ends that belong to it and open ones at others,
    and the ends that are no ticks as numbers.
    """
    if not intervals:
        plane.text((0.5, middle), "nowhere", fontsize=SMALL)
    bars = [
        (float(low) + APART * (not from_low), float(high) - APART * (not to_high))
        for low, high, from_low, to_high in intervals
    ]
    plane.line([straight((low, middle), (high, middle)) for low, high in bars], name, linewidth=2.2)
    for belongs in (True, False):
        ends = [
            end
            for low, high, from_low, to_high in intervals
            for end, there in ((low, from_low), (high, to_high))
            if there is belongs
        ]
        if ends:
            plane.dots(
                [(float(end), middle) for end in dict.fromkeys(ends)],
                f"{name}-{'closed' if belongs else 'open'}",
                3.8,
                filled=belongs,
            )
    for _, high, _, _ in intervals:
        if high not in TICKS:
            plane.text((float(high), middle), short(high), (5, 0), ha="left", fontsize=SMALL)


def short(end: Fraction) -> str:
    """An end as a number: a short fraction, or three decimals.

    >>> short(Fraction(3, 5)), short(Fraction(342087213408, 10**12))
    ('3/5', '0.342')
    """
    return str(end) if end.denominator < 100 else f"{float(end):.3f}"
