"""The markup of the page for sentences, statements, values and the picture of a proof tree."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from html import escape

from juggleproof.certificates import checker
from juggleproof.papers.paper import opened
from juggleproof.reports.latex import glyph, latex_of
from juggleproof.reports.mathml import mathml
from juggleproof.reports.words import SIGN, WORDS, parts_of, pieces

# -------------------------------------------------------------------------------------------------
# Sentences, statements and values with their formulas as MathML.

NAMES = ("exists", "integer", "over", "state", "input")
FORMULAS = (
    "given",
    "have",
    "show",
    "with",
    "domain",
    "holds",
    "space",
    "stage",
    "rank",
    "on",
    "rate",
    "radius",
    "size",
    "loss",
    "least",
    "upper",
)
TUPLES = ("point", "start", "weights", "direction")
LINKS = ("sharp", *checker.NAMED)
ONE_LINE = {
    "show": 144,
    "with": 144,
    "holds": 144,
}  # the longest formula, in characters, that is kept on one line
ELSE = 64
ARROW = r"\mapsto"


@dataclass(frozen=True)
class MarkedLine:
    """A line of a statement: the word for its keyword, and its content as markup, in parts between
    which a line may break; or names to link to.
    """

    word: str
    parts: tuple[str, ...] = ()
    links: tuple[str, ...] = ()


@cache
def prose(sentence: str) -> str:
    """A sentence as markup."""
    return "".join(
        escape(content, quote=False) if kind == "text" else mathml(content)
        for kind, content in pieces(sentence)
    )


def marked(text: str) -> str:
    """A text as markup; what stands between dollars is LaTeX.

    >>> marked("Finding $x$")
    'Finding <math alttext="x"><mi>x</mi></math>'
    """
    return "".join(
        mathml(part) if place % 2 else escape(part, quote=False)
        for place, part in enumerate(text.split("$"))
    )


def line(text: str) -> str:
    """A line of the program's own output as markup; text between backquotes is code."""
    return "".join(
        f"<code>{escape(part, quote=False)}</code>" if i % 2 else escape(part, quote=False)
        for i, part in enumerate(text.split("`"))
    )


@cache
def formula(text: str, block: bool = False) -> str:
    """A term or formula of the statement language as markup."""
    return mathml(latex_of(text), block)


def shown(text: str, longest: int) -> str:
    """A formula as markup; one that is too long for a line is shown as the checker reads it, since
    text can be broken.
    """
    return formula(text) if len(text) <= longest else f"<code>{escape(text, quote=False)}</code>"


def change(text: str) -> str:
    """The description of a correction's change, with its letters and signs as formulas."""
    return "".join(
        mathml(part) if i % 2 else escape(part, quote=False)
        for i, part in enumerate(SIGN.split(text))
    )


SIDE = r"-?[\w/()*^]+(?: [+-] [\w/()*^]+)*"  # a term with spaces around its signs


@cache
def _range() -> re.Pattern[str]:
    """The pattern of end points, polynomials, conditions on the paper's parameter, and the
    parameter alone.
    """
    name = re.escape(opened().parameter) or "(?!)"
    return re.compile(
        rf"(?P<point>\bc\d+ = \d\.\d+\.{{3}})|\ba root of (?P<polynomial>{SIDE})"
        rf"|(?P<condition>(?:{SIDE} <=? )?\b{name} (?:<=?|>=?|=) {SIDE})|(?P<name>\b{name}\b)"
    )


def ranged(sentence: str) -> str:
    """A sharp range, or a line with one, as markup: conditions on the parameter, end points and
    their polynomials are formulas.

    Labels of readings and steps are unchanged.
    """
    shown, at = "", 0
    for match in _range().finditer(sentence):
        shown += prose(sentence[at : match.start()])
        kind, text, at = str(match.lastgroup), str(match.group(match.lastgroup or 0)), match.end()
        if kind == "point":
            name, _, value = text.partition(" = ")
            shown += f"{mathml(glyph(name))} = {value}"
        else:
            shown += f"a root of {polynomial(text)}" if kind == "polynomial" else formula(text)
    return shown + prose(sentence[at:])


def polynomial(text: str) -> str:
    """A polynomial as markup, with its terms in their written order."""
    latex = re.sub(
        r"\^(\d+)", r"^{\1}", re.sub(r"[A-Za-z]\w*", lambda name: glyph(name.group()), text)
    ).replace("*", " ")
    return mathml(latex)


ADJOINED = re.compile(r"(\w+) is a root of (.+?) between (\S+) and (\S+?)(?= \w+ is a root|$)")


def values(at: str) -> str:
    """A counterexample as markup: the values of names, with the bounds of adjoined roots; or a
    family, by the sign of a polynomial.
    """
    family = "a family by the sign of "
    if at.startswith(family):
        return family + polynomial(at.removeprefix(family))
    point, where, rest = at.partition(" where ")
    shown = ", ".join(formula(one) for one in point.split(", "))
    for name, of, low, high in ADJOINED.findall(rest):
        shown += (
            f"{where}{mathml(glyph(name))} is a root of {polynomial(of)} between {formula(low)} and"
            f" {formula(high)}"
        )
        where = ", and "
    return shown


@cache
def lines_of(text: str) -> list[tuple[str, tuple[str, ...]]]:
    """The lines of a statement below its name, each keyword with its formulas; successive lines
    with the same keyword are joined.

    The line `forall` is left out, since the other lines have its names.  So is an empty line.

    >>> lines_of("statement a/b\\nforall x y\\ngiven x > 0 and y > 1\\ngiven x < y\\nshow x > y")
    [('given', ('x > 0', 'y > 1', 'x < y')), ('show', ('x > y',))]
    """
    joined: list[tuple[str, list[str]]] = []
    for line in text.splitlines()[1:]:
        keyword, _, content = line.partition(" ")
        keyword = "given" if keyword == "range" else keyword
        parts = conjuncts(content) if keyword in FORMULAS else [content]
        if joined and joined[-1][0] == keyword and keyword in FORMULAS and keyword != "stage":
            joined[-1][1].extend(parts)
        elif keyword != "forall" and content:
            joined.append((keyword, parts))
    return [
        (keyword, tuple(chained(parts) if keyword in FORMULAS else parts))
        for keyword, parts in joined
    ]


def rows_of(lines: Sequence[tuple[str, Sequence[str]]]) -> list[MarkedLine]:
    """The lines as markup."""
    return [_row(keyword, parts) for keyword, parts in lines]


def _row(keyword: str, parts: Sequence[str]) -> MarkedLine:
    word = WORDS.get(keyword, keyword)
    if keyword in LINKS:
        return MarkedLine(word, links=tuple(parts[0].split()))
    if keyword in NAMES:
        return MarkedLine(word, (mathml(", ".join(map(glyph, parts[0].split()))),))
    if keyword == "holds" and parts == ("0 = 1",):
        return MarkedLine(word, ("never",))
    if keyword in FORMULAS:
        return MarkedLine(word, tuple(shown(one, ONE_LINE.get(keyword, ELSE)) for one in parts))
    if keyword in TUPLES:
        return MarkedLine(word, (_tuple(parts_of(parts[0])),))
    if keyword in ("let", "root", "number"):
        name, _, value = parts[0].partition(" = ")
        return MarkedLine(word, (named(name, value),))
    if keyword == "value":
        return MarkedLine(word, (f" {mathml(ARROW)} ".join(map(formula, parts[0].split(" -> "))),))
    if keyword in ("piece", "iterates", "after"):
        before, _, images = parts[0].partition(" -> ")
        source = _tuple(_listed(before)) if keyword == "iterates" else formula(before)
        return MarkedLine(
            word,
            (
                (
                    f"{source} {mathml(ARROW)}"
                    f" {_tuple(parts_of(images) if keyword == 'piece' else _listed(images))}"
                ),
            ),
        )
    return MarkedLine(word, (escape(parts[0], quote=False),))


def _listed(text: str) -> list[str]:
    """The entries of a list in brackets; a list with one entry ends with a comma."""
    return [part for part in parts_of(text[1:-1]) if part]


def _tuple(parts: Sequence[str]) -> str:
    return mathml(r"\left(" + ", ".join(map(latex_of, parts)) + r"\right)")


def named(name: str, value: str) -> str:
    """A name with its value as markup: a term, a square root, or a root of a polynomial between two
    bounds.
    """
    if value.startswith("sqrt(") and value.endswith(")"):
        return mathml(rf"{glyph(name)} = \sqrt{{{latex_of(value[5:-1])}}}")
    if value.startswith("root(") and value.endswith(")"):
        polynomial, low, high = parts_of(value[5:-1])
        between = rf"{latex_of(low)} \le {glyph(name)} \le {latex_of(high)}"
        return f"{mathml(between)}, a root of {formula(polynomial)}"
    return mathml(f"{glyph(name)} = {latex_of(value)}")


def _apart(text: str, by: str) -> list[str]:
    """The parts of a text between separators, except those inside brackets.

    >>> _apart("(a, b)*c, d", ", ")
    ['(a, b)*c', 'd']
    """
    parts, depth = [""], 0
    for piece in re.split(f"({re.escape(by)}|[()])", text):
        depth += (piece == "(") - (piece == ")")
        if piece == by and not depth:
            parts.append("")
        else:
            parts[-1] += piece
    return parts


def conjuncts(text: str) -> list[str]:
    """The parts that a formula joins by `and`.

    >>> conjuncts("x > 0 and (y > 0 and z > 0 or x < 1)"), conjuncts("x > 0 and y > 0 or z > 0")
    (['x > 0', '(y > 0 and z > 0 or x < 1)'], ['x > 0 and y > 0 or z > 0'])
    """
    return [text] if len(_apart(text, " or ")) > 1 else _apart(text, " and ")


def chained(parts: Sequence[str]) -> list[str]:
    """The conditions, where a lower bound of a name and the upper bound after it become a chain.

    >>> chained(["r > 0", "alpha > 0", "alpha < 1", "0 <= t", "t < T"])
    ['r > 0', '0 < alpha < 1', '0 <= t < T']
    """
    chain: list[str] = []
    for part in parts:
        upper = re.fullmatch(r"(\w+) (<=?) (\w+)", part)
        lower = chain and re.fullmatch(r"(\w+) (>=?) ([\w/]+)|([\w/]+) (<=?) (\w+)", chain[-1])
        if upper and lower and upper.group(1) in (lower.group(1), lower.group(6)):
            bound = (
                f"{lower.group(4)} {lower.group(5)}"
                if lower.group(4)
                else f"{lower.group(3)} {lower.group(2).replace('>', '<')}"
            )
            chain[-1] = f"{bound} {part}"
        else:
            chain.append(part)
    return chain


# -------------------------------------------------------------------------------------------------
# The meanings of the letters in a statement.

WHOLE = ("whole number", "whole numbers")  # for one letter, and for several
ANY = ("any number that meets what is given", "any numbers that meet what is given")


def letters_of(texts: Sequence[str], with_notation: bool = True) -> list[tuple[str, str]]:
    """Each letter of the statements with its meaning; letters without one are grouped as whole
    numbers, and as any numbers that meet what is given.
    """
    lines = [line.partition(" ")[::2] for text in texts for line in text.splitlines()]
    listed = {
        keyword: {name: 0 for word, names in lines if word == keyword for name in names.split()}
        for keyword in ("forall", "exists", "over", "state", "input", "integer")
    }
    names = {name: 0 for some in listed.values() for name in some}
    paper = opened().notation
    notation = {name for name in paper.listed if paper.is_meant(name, names)}
    whole = [name for name in listed["integer"] if name not in notation]
    known = letters([name for name in names if name not in whole], with_notation)
    free = [name for name in names if name not in {*paper.meanings, *notation, *whole}]
    for some, meanings in ((whole, WHOLE), (free, ANY)):
        if some:
            known.append((mathml(", ".join(map(glyph, some))), meanings[len(some) > 1]))
    return known


def letters(names: Collection[str], with_notation: bool = True) -> list[tuple[str, str]]:
    """The names that have a fixed meaning, as markup, each with its meaning."""
    notation = opened().notation
    listed = notation.listed if with_notation else {}
    return [
        (mathml(glyph(name)), meaning)
        for name, meaning in {**listed, **notation.meanings}.items()
        if name in names and notation.is_meant(name, names)
    ]


# -------------------------------------------------------------------------------------------------
# The picture of a proof tree: rules in layers, each above the rules that it rests on, as SVG whose
# boxes are links.
#
# The layout is a layered drawing: a node's layer is the length of the longest path down to it; a
# line that passes a layer takes a place in it; the order in a layer follows the neighbours'
# middles; places are moved towards the neighbours as far as the order allows. Equal nodes give
# equal bytes.

LETTER, LINE, CHIP, PAD, GAP, RISE = 7.0, 18, 24, 10, 28, 44
THROUGH = 12.0  # the width of a line that passes a layer
SWEEPS = 6
MARKS = {"certified": "✓", "refuted": "✗", "unknown": "?"}


@dataclass(frozen=True)
class Chip:
    """A premise: its label, its link, and its outcome."""

    label: str
    link: str
    outcome: str


@dataclass(frozen=True)
class MarkedStatement:
    """A rule or statement: its lines of text, its link, its outcome, its premises, and the names of
    the nodes that it rests on.
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
        """The number of columns of premises: one, two or three."""
        return 1 + (len(self.chips) > 2) + (len(self.chips) > 8)

    @property
    def chip_width(self) -> float:
        """The width of a premise, which fits the longest label."""
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
    """A place in a layer, for a node or for a line that passes the layer, with the places above and
    below that it is joined to.
    """

    layer: int
    width: float
    node: MarkedStatement | None = None
    x: float = 0.0
    above: list[_Place] = field(default_factory=list)
    below: list[_Place] = field(default_factory=list)


def picture(nodes: Sequence[MarkedStatement], title: str) -> str:
    """The SVG of the nodes; names below a node that are not nodes themselves are left out."""
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


def depths(nodes: Sequence[MarkedStatement]) -> Mapping[str, int]:
    """The length of the longest path to each node from above; raises ValueError for a cycle.

    >>> below = {"a": ("b", "c"), "b": ("c",), "c": ()}
    >>> depths([MarkedStatement(name, "", "", "", "", below=one) for name, one in below.items()])
    {'a': 0, 'b': 1, 'c': 2}
    """
    known = {node.name: node for node in nodes}
    layers = dict.fromkeys(known, 0)
    for _ in nodes:
        before = dict(layers)
        for node in nodes:
            for name in node.below:
                if name in known:
                    layers[name] = max(layers[name], layers[node.name] + 1)
        if layers == before:
            return layers
    raise ValueError("a rule rests on itself")


def _laid_out(nodes: Sequence[MarkedStatement]) -> list[list[_Place]]:
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
    """Puts each place close to its wanted position, in order and without overlap: at the mean of
    the positions by pushing all to the right and by pushing all to the left.
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
