"""The picture of a proof tree: rules in layers, each above what it rests on, as SVG whose boxes are
links.

The layout is a small layered drawing: a node's layer is the longest way down to it; a line that
passes a layer takes a place in it; the order in a layer follows the neighbours' middles; places are
moved towards the neighbours as far as the order allows.  Same nodes, same bytes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape

LETTER, LINE, CHIP, PAD, GAP, RISE = 7.0, 18, 24, 10, 28, 44
THROUGH = 12.0  # the width of a line that passes a layer
SWEEPS = 6
MARKS = {"certified": "✓", "refuted": "✗", "unknown": "?"}


@dataclass(frozen=True)
class Chip:
    """A premise: its label, where it leads, and its outcome."""

    label: str
    link: str
    outcome: str


@dataclass(frozen=True)
class Node:
    """A rule or statement: lines of text, where it leads, its outcome, its premises, and the names
    of what it rests on.
    """

    name: str
    title: str
    subtitle: str
    link: str
    outcome: str
    chips: tuple[Chip, ...] = ()
    below: tuple[str, ...] = ()

    @property
    def columns(self) -> int:
        """Premises stand in one, two or three columns."""
        return 1 + (len(self.chips) > 2) + (len(self.chips) > 8)

    @property
    def chip_width(self) -> float:
        """As wide as the longest label asks for."""
        return max((len(chip.label) for chip in self.chips), default=0) * LETTER + 34

    @property
    def width(self) -> float:
        """The box's width."""
        return (
            max(
                self.columns * self.chip_width + (self.columns - 1) * 6,
                (len(self.title) + 3) * LETTER * 1.22,
                len(self.subtitle) * 6.4,
            )
            + 2 * PAD
        )

    @property
    def height(self) -> float:
        """The box's height."""
        return 2 * PAD + 2 * LINE + -(-len(self.chips) // self.columns) * (CHIP + 4)


@dataclass
class _Place:
    """A node, or the stretch of a line that passes its layer, with the places that it is joined to
    above and below.
    """

    layer: int
    width: float
    node: Node | None = None
    x: float = 0.0
    above: list[_Place] = field(default_factory=list)
    below: list[_Place] = field(default_factory=list)


def picture(nodes: Sequence[Node], title: str) -> str:
    """The SVG; what is named below a node and is no node itself is left out."""
    rows = _laid_out(nodes)
    heights = [max((place.node.height for place in row if place.node), default=0.0) for row in rows]
    tops = [PAD + sum(heights[:i]) + i * RISE for i in range(len(rows))]
    width = max(place.x + place.width / 2 for row in rows for place in row) + PAD
    height = tops[-1] + heights[-1] + PAD
    lines = [
        _line(place, child, tops, heights) for row in rows for place in row for child in place.below
    ]
    boxes = [_box(place, tops[place.layer]) for row in rows for place in row if place.node]
    return (
        f'<svg class="tree" xmlns="http://www.w3.org/2000/svg" width="{width:.0f}"'
        f' height="{height:.0f}" viewBox="0 0 {width:.0f} {height:.0f}" role="group"'
        f' aria-label="{escape(title)}">{"".join(lines)}{"".join(boxes)}</svg>'
    )


def depths(nodes: Sequence[Node]) -> Mapping[str, int]:
    """The longest way from a node that nothing rests on; a circle is an error.

    >>> a, b = Node("a", "", "", "", "", below=("b", "c")), Node("b", "", "", "", "", below=("c",))
    >>> depths([a, b, Node("c", "", "", "", "")])
    {'a': 0, 'b': 1, 'c': 2}
    """
    known = {node.name: node for node in nodes}
    found = dict.fromkeys(known, 0)
    for _ in nodes:
        before = dict(found)
        for node in nodes:
            for name in node.below:
                if name in known:
                    found[name] = max(found[name], found[node.name] + 1)
        if found == before:
            return found
    raise ValueError("a rule rests on itself")


def _laid_out(nodes: Sequence[Node]) -> list[list[_Place]]:
    depth = depths(nodes)
    places = {node.name: _Place(depth[node.name], node.width, node) for node in nodes}
    rows: list[list[_Place]] = [[] for _ in range(max(depth.values()) + 1)]
    for node in nodes:
        rows[depth[node.name]].append(places[node.name])
    for node in nodes:
        for name in node.below:
            if name in places:
                _join(places[node.name], places[name], rows)
    for turn in range(SWEEPS):
        for row in rows[1:] if turn % 2 == 0 else rows[-2::-1]:
            order = {id(place): i for others in rows for i, place in enumerate(others)}
            row.sort(
                key=lambda place: _middle(
                    [
                        float(order[id(one)])
                        for one in (place.above if turn % 2 == 0 else place.below)
                    ],
                    float(order[id(place)]),
                )
            )
    for row in rows:
        _set_apart(row, [0.0] * len(row))
    for turn in range(2 * SWEEPS):
        for row in rows if turn % 2 else rows[::-1]:
            _set_apart(
                row,
                [_middle([one.x for one in place.above + place.below], place.x) for place in row],
            )
    left = min(place.x - place.width / 2 for row in rows for place in row) - PAD
    for row in rows:
        for place in row:
            place.x -= left
    return rows


def _join(upper: _Place, lower: _Place, rows: list[list[_Place]]) -> None:
    here = upper
    for layer in range(upper.layer + 1, lower.layer):
        through = _Place(layer, THROUGH)
        rows[layer].append(through)
        here.below.append(through)
        through.above.append(here)
        here = through
    here.below.append(lower)
    lower.above.append(here)


def _middle(values: Sequence[float], otherwise: float) -> float:
    return sum(values) / len(values) if values else otherwise


def _set_apart(row: Sequence[_Place], wanted: Sequence[float]) -> None:
    """Puts each place near where it is wanted, in order and without overlap: the mean of pushing
    rightwards and pushing leftwards.
    """
    if not row:
        return
    steps = [(a.width + b.width) / 2 + GAP for a, b in zip(row, row[1:])]
    right, left = list(wanted), list(wanted)
    for i, step in enumerate(steps):
        right[i + 1] = max(right[i + 1], right[i] + step)
    for i in reversed(range(len(steps))):
        left[i] = min(left[i], left[i + 1] - steps[i])
    for place, a, b in zip(row, right, left):
        place.x = (a + b) / 2


def _line(upper: _Place, lower: _Place, tops: Sequence[float], heights: Sequence[float]) -> str:
    start = tops[upper.layer] + (upper.node.height if upper.node else heights[upper.layer])
    end, bottom = tops[lower.layer], tops[upper.layer] + heights[upper.layer]
    bend = (bottom + end) / 2
    through = f"V{end + heights[lower.layer]:.1f}" if lower.node is None else ""
    return (
        f'<path class="edge" d="M{upper.x:.1f} {start:.1f}V{bottom:.1f}C{upper.x:.1f} {bend:.1f}'
        f' {lower.x:.1f} {bend:.1f} {lower.x:.1f} {end:.1f}{through}"/>'
    )


def _box(place: _Place, top: float) -> str:
    node = place.node
    if node is None:
        return ""
    left = place.x - node.width / 2
    shown = [
        f'<a href="{escape(node.link)}"'
        f' aria-label="{escape(f"{node.title}: {node.subtitle}; {node.outcome}")}"><rect'
        f' class="node {node.outcome}" x="{left:.1f}" y="{top:.1f}" width="{node.width:.1f}"'
        f' height="{node.height:.1f}" rx="8"/><text class="title" x="{left + PAD:.1f}"'
        f' y="{top + PAD + 13:.1f}">{MARKS.get(node.outcome, "?")} {escape(node.title)}</text><text'
        f' class="subtitle" x="{left + PAD:.1f}"'
        f' y="{top + PAD + 13 + LINE:.1f}">{escape(node.subtitle)}</text></a>'
    ]
    width = (node.width - 2 * PAD - 6 * (node.columns - 1)) / node.columns
    for i, chip in enumerate(node.chips):
        x = left + PAD + i % node.columns * (width + 6)
        y = top + PAD + 2 * LINE + 2 + i // node.columns * (CHIP + 4)
        shown.append(
            f'<a href="{escape(chip.link)}"'
            f' aria-label="{escape(f"premise {chip.label} of {node.title}; {chip.outcome}")}"><rect'
            f' class="chip {chip.outcome}" x="{x:.1f}" y="{y:.1f}" width="{width:.1f}"'
            f' height="{CHIP}" rx="5"/><text class="label" x="{x + 8:.1f}"'
            f' y="{y + 16:.1f}">{MARKS.get(chip.outcome, "?")} {escape(chip.label)}</text></a>'
        )
    return "".join(shown)
