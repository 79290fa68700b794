"""What the page opens with: the moving system, its map, and the theorem with its written proof."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from html import escape
from typing import NamedTuple

from juggleproof.proofs.theorem.definition import FIXED, value_of
from juggleproof.reports import markup
from juggleproof.reports.contents import Contents, Entry
from juggleproof.reports.latex import glyph, latex_of
from juggleproof.reports.mathml import mathml
from juggleproof.reports.words import parts_of
from juggleproof.scenes.juggler import point, scene
from juggleproof.scenes.juggler.orbits import Heights, heights
from juggleproof.statements.language import term

# -------------------------------------------------------------------------------------------------
# What moves: ball and table over some periods, exactly iterated, as SVG that moves without a
# script; where no motion is wanted, and on paper, it stands still.

ALPHA, START = Fraction(3, 10), (1, -1)  # below 1/3, and a ball that rises: x and w
PERIODS, A_PERIOD, SECONDS = 10, 24, 15
LEFT, RIGHT, TOP, BOTTOM, HIGHEST = 120, 590, 16, 262, Fraction(21, 10)
STRIP, BALL = 60, 9  # the middle of the strip where things move, and the ball's radius


class Motion(NamedTuple):
    """The picture with its caption."""

    svg: str
    caption: str


def motion() -> Motion:
    """Heights of ball and table over the periods, in units of r T, against time in units of T."""
    start = scene(ALPHA, point(*START), r=1, g=2)  # r = T = 1
    path = heights(start, [Fraction(k, A_PERIOD) for k in range(PERIODS * A_PERIOD + 1)])
    level = value_of(term(FIXED.component(1)), {"alpha": ALPHA})
    caption = (
        f"Ball and table for alpha = {ALPHA} from x = {START[0]}, w = {START[1]}, over"
        f" {PERIODS} periods. A dot stands where the ball is when the table is at its lowest. The"
        f" dots approach the height of e_1, which is x = {level}; there each period has one impact,"
        " at the same place."
    )
    return Motion(_drawn(path, level), caption)


def _drawn(path: Sequence[Heights], level: Fraction) -> str:
    balls, tables = [_y(one.ball) for one in path], [_y(one.table) for one in path]
    samples = "".join(
        f'<circle cx="{_x(one.time)}" cy="{_y(one.ball)}" r="3.5"/>' for one in path[::A_PERIOD]
    )
    rules = "".join(f"M{_x(Fraction(k))} {TOP}V{BOTTOM}" for k in range(PERIODS + 1))
    numbers = "".join(
        f'<text x="{_x(Fraction(k))}" y="{BOTTOM + 26}" text-anchor="middle">{k}</text>'
        for k in range(0, PERIODS + 1, 2)
    )
    title, alt = (
        "What moves: a ball on a moving table",
        "Left, a ball above a table that rises and falls. Right, their heights against time: the"
        " table flies in equal low arcs, the ball in a high arc and then in lower ones, until both"
        " repeat themselves every period.",
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" id="motion" viewBox="0 0 620 324" role="img"'
        f' aria-labelledby="motion-title motion-desc"><title id="motion-title">{title}</title>'
        f'<desc id="motion-desc">{alt}</desc><path class="rules" d="{rules}M{LEFT} {BOTTOM}'
        f'H{RIGHT}"/><path class="level" d="M{LEFT} {_y(level)}H{RIGHT}"/>'
        f'<text x="{RIGHT + 6}" y="{_y(level - Fraction(1, 25))}">e<tspan dy="4"'
        f' font-size="12">1</tspan></text><polyline class="table"'
        f' points="{_points(path, tables)}"/><polyline class="ball"'
        f' points="{_points(path, balls)}"/><g class="samples">{samples}</g>{numbers}'
        f'<text x="{(LEFT + RIGHT) // 2}" y="{BOTTOM + 52}" text-anchor="middle">time, in'
        f' periods</text><text x="{STRIP}" y="{BOTTOM + 26}" text-anchor="middle">table</text>'
        f'<g class="still">{_bodies(balls[0], tables[0])}</g>'
        f'<g class="moving">{_bodies(balls[0], tables[0], balls, tables)}'
        f'<path class="now" d="M{LEFT} {TOP}V{BOTTOM}"><animateTransform'
        f' attributeName="transform" type="translate" from="0 0" to="{RIGHT - LEFT} 0"'
        f' dur="{SECONDS}s" repeatCount="indefinite"/></path></g></svg>'
    )


def _bodies(ball: str, table: str, balls: Sequence[str] = (), tables: Sequence[str] = ()) -> str:
    """Ball and table at these heights; moved, where there are values to move them by."""

    def moved(values: Sequence[str]) -> str:
        return (
            f'<animateTransform attributeName="transform" type="translate"'
            f' values="{";".join(f"0 {one}" for one in values)}" dur="{SECONDS}s"'
            f' repeatCount="indefinite"/>'
            if values
            else ""
        )

    return (
        f'<circle class="body" cx="{STRIP}" cy="-{BALL}" r="{BALL}"'
        f' transform="translate(0 {ball})">{moved(balls)}</circle><rect class="plate"'
        f' x="{STRIP - 38}" y="0" width="76" height="7"'
        f' transform="translate(0 {table})">{moved(tables)}</rect>'
    )


def _points(path: Sequence[Heights], ys: Sequence[str]) -> str:
    return " ".join(f"{_x(one.time)},{y}" for one, y in zip(path, ys))


def _x(time: Fraction) -> str:
    return f"{float(LEFT + (RIGHT - LEFT) * time / PERIODS):.1f}"


def _y(height: Fraction) -> str:
    return f"{float(BOTTOM - (BOTTOM - TOP) * height / HIGHEST):.1f}"


# -------------------------------------------------------------------------------------------------
# The map and the theorem, as the stored statements have them, and the lines of the written proof.

RULES, PROOF = "theorem", "theorem-by-hand"  # the claims whose statements are shown
TRAP = "fig-trap"  # the figure that the written proof shows
IN_UNITS, SCALING = "theorem-in-units", "region-scaling"


class ProofLines:
    """The lines of the written proof: the statements of a claim by label, each with a link to its
    certificate.
    """

    def __init__(self, entry: Entry) -> None:
        self.by_label = {one.name.partition("/")[2]: one for one in entry.statements}

    def show(self, label: str, *parts: int) -> str:
        """What a line shows, whole or some of its conjuncts, with a link to its statement; a line
        that is not certified says so.
        """
        one = self.by_label[label]
        conjuncts = markup.conjuncts(one.text.rpartition("\nshow ")[2])
        shown = [conjuncts[part] for part in parts] if parts else conjuncts
        certified = one.outcome == "certified"
        link = (
            f'<a class="cite {escape(one.outcome)}" href="#{escape(one.name)}">{escape(label)}'
            f"{'' if certified else f': not certified, {escape(one.outcome)}'}</a>"
        )
        return f"{', '.join(map(markup.formula, shown))} {link}"

    def given(self, label: str, place: int) -> str:
        """What a line is given, by place."""
        lines = [line.partition(" ") for line in self.by_label[label].text.splitlines()]
        return markup.formula([rest for word, _, rest in lines if word == "given"][place])


@dataclass(frozen=True)
class Opening:
    """The map, its sets and points, and what the proof chooses, as markup; verdicts by claim."""

    map: str
    space: str
    guards: Sequence[str]
    fixed: str
    other: str
    below: str
    others: str
    energy: str
    rank: str
    stages: Sequence[str]
    later: int
    rate: str
    radius: str
    rate_to_the_k: str
    lines: ProofLines
    verdicts: Mapping[str, str]

    @property
    def is_certified(self) -> bool:
        """Whether every line of the written proof is certified."""
        return all(one.outcome == "certified" for one in self.lines.by_label.values())


def opening(contents: Contents) -> Opening | None:
    """What the page opens with; None where the contents lack the theorem or its written proof."""
    entries = {one.claim.id: one for one in contents.entries}
    if not {RULES, PROOF} <= set(entries):
        return None
    texts = {one.name: one.text for one in entries[RULES].statements}

    def rows(part: str, keyword: str) -> list[str]:
        lines = [line.partition(" ") for line in texts[f"{RULES}/{part}"].splitlines()]
        return [rest for word, _, rest in lines if word == keyword]

    def conjuncts(text: str, most: int | None = None) -> str:
        """The parts of a conjunction; the first ones of a domain, whose last is there for a
        division.
        """
        return ", ".join(map(markup.formula, markup.chained(markup.conjuncts(text)[:most])))

    def place(part: str, keyword: str) -> str:
        return mathml(rf"\left({', '.join(map(latex_of, parts_of(rows(part, keyword)[0])))}\right)")

    pieces = [row.partition(" -> ")[::2] for row in rows("map", "piece")]
    cases = r" \\ ".join(
        rf"({', '.join(map(latex_of, parts_of(image)))}) & \text{{if }} {latex_of(guard)}"
        for guard, image in pieces
    )
    state = ", ".join(map(glyph, rows("map", "state")[0].split()))
    root, rate = rows("descends", "root")[0], latex_of(rows("contracts", "rate")[0])
    stages = rows("descends", "stage")
    return Opening(
        map=mathml(rf"f({state}) = \begin{{cases}} {cases} \end{{cases}}", block=True),
        space=markup.formula(rows("map", "space")[0]),
        guards=[markup.formula(guard) for guard, _ in pieces],
        fixed=place("contracts", "point"),
        other=place("escapes", "start"),
        below=conjuncts(rows("descends", "domain")[0], 2),
        others=conjuncts(rows("escapes", "domain")[0], 2),
        energy=markup.named(*root.split(" = ", 1)),
        rank=mathml(rf"\mathit{{rank}} = {latex_of(rows('descends', 'rank')[0])}"),
        stages=[conjuncts(stage) for stage in stages],
        later=len(stages) - 1,
        rate=mathml(rate),
        radius=markup.formula(rows("contracts", "radius")[0]),
        rate_to_the_k=mathml(f"({rate})^k"),
        lines=ProofLines(entries[PROOF]),
        verdicts={name: one.verdict for name, one in entries.items()},
    )
