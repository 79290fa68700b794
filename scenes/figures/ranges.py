"""For each claim the restitutions on which it holds; claims with the same range share a bar."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from scenes.figures.arcs import straight
from scenes.figures.drawing import blank, styled
from scenes.figures.plane import Plane

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Interval = tuple[
    Fraction, Fraction, bool, bool
]  # low, high, and whether each belongs to it; a single number is low = high
Row = tuple[
    str, str, "Sequence[Interval] | None"
]  # claim (and reading), verdict, range; None where it cannot be drawn
Group = tuple[tuple[Interval, ...], list[Row]]

WIDTH, LINE, GAP = (
    5.6,
    8.6,
    4.0,
)  # the figure's width in inches; a line of text, and what lies between rows, in points
NAMES, LEFT, RIGHT = (
    0.01,
    0.445,
    0.755,
)  # where names start, and bars start and end, in parts of the width
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
    told = [
        f"{count} {word}" if len(group[1]) > 1 else word
        for word, count in sorted(counts.items(), key=lambda one: (-one[1], one[0]))
    ]
    return [", ".join(told[at : at + 2]) for at in range(0, len(told), 2)]


def footnote(rows: Sequence[Row], without_alpha: int) -> str:
    """What the figure does not draw."""
    missing = [row[0] for row in rows if row[2] is None]
    said = (
        [f"{without_alpha} claims do not speak of \N{GREEK SMALL LETTER ALPHA}."]
        if without_alpha
        else []
    )
    return " ".join([*said, *([f"Not drawn: {', '.join(missing)}."] if missing else [])])


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
    plane.frame({float(tick): said for tick, said in TICKS.items()}, {}, r"$\alpha$")
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
    style: dict[str, Any] = {"fontsize": SMALL, "linespacing": 1.05, "ha": "left"}
    for at, said in (
        (names_at, "claim (reading)"),
        (bars_at, "holds for"),
        (verdicts_at, "verdict of the claim"),
    ):
        plane.words(
            (at, height - 10),
            said,
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
            plane.text((float(high), middle), told(high), (5, 0), ha="left", fontsize=SMALL)


def told(end: Fraction) -> str:
    """An end as a number: a short fraction, or three decimals.

    >>> told(Fraction(3, 5)), told(Fraction(342087213408, 10**12))
    ('3/5', '0.342')
    """
    return str(end) if end.denominator < 100 else f"{float(end):.3f}"
