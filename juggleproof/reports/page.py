"""The report as one HTML page: what its templates show, and the page that they make."""

from __future__ import annotations

import inspect
import json
import re
import zlib
from base64 import a85encode
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from html import escape
from pathlib import Path
from types import FunctionType
from typing import TYPE_CHECKING

from juggleproof.certificates import checker
from juggleproof.judging.claims import VERDICTS
from juggleproof.judging.conclusions import RULES
from juggleproof.judging.correcting import note_of
from juggleproof.judging.extras import needed
from juggleproof.papers.paper import opened
from juggleproof.papers.places import place_of
from juggleproof.reports import markup, tex_words
from juggleproof.reports.contents import Contents, Entry, ShownText, TheoremRule
from juggleproof.reports.errata import FIRST, GROUPS, goal_of, is_latex
from juggleproof.reports.figures import Picture, scene_picture
from juggleproof.reports.latex import latex_of
from juggleproof.reports.markup import Chip, MarkedStatement, picture
from juggleproof.reports.mathml import mathml
from juggleproof.reports.part import HEADS, TableResults
from juggleproof.reports.results import has_range
from juggleproof.statements.store import CERTIFICATES

if TYPE_CHECKING:
    from jinja2 import Environment

# -------------------------------------------------------------------------------------------------
# The words, marks and links of the page for the templates, which hold no logic of their own.

# characters of a certificate: a longer one is shown only in the theorem's tree; elsewhere the page
# names its file
LONGEST = 300
MARKS_OF_VERDICTS = dict(zip(VERDICTS, "✓✎✗⋯⇄≈?"))


@dataclass(frozen=True)
class ShownStatement:
    """A statement with its lines as markup, its outcome, and its certificate as text."""

    name: str
    label: str
    outcome: str
    rows: Sequence[markup.MarkedLine]
    text: str
    at: str
    numbers: str
    words: str
    false_there: str
    votes: str
    certificate: str
    length: int
    stands_in: str


Line = tuple[str, str]  # a keyword and one of its formulas or names


def statement(shown: ShownText, whole: bool = False, shared: Sequence[Line] = ()) -> ShownStatement:
    """A statement for the page; a long certificate is left out unless `whole` is set.

    The `shared` lines of all statements of the claim are left out, since the page shows them once.
    """
    text = certificate_text(shown.certificate)
    refuted = shown.outcome == "refuted"
    lines = [
        (keyword, [one for one in parts if (keyword, one) not in shared])
        for keyword, parts in markup.lines_of(shown.text)
    ]
    votes = ", ".join(
        f"{route} {answer}" for route, answer in shown.votes.items() if answer != "not applicable"
    )
    return ShownStatement(
        shown.name,
        shown.name.partition("/")[2],
        shown.outcome,
        markup.rows_of([line for line in lines if line[1]]),
        shown.text,
        markup.values(shown.at) if refuted and shown.at else "",
        shown.numbers,
        shown.words,
        _false_there(shown.text) if refuted else "",
        votes,
        text if whole or len(text) <= LONGEST else "",
        len(text),
        f"certificates/store/{CERTIFICATES}",
    )


SHARED = ("given", "let", "root")


def shared_lines(statements: Sequence[ShownText]) -> list[Line]:
    """The lines that all statements of a claim assume, if there are several; rules and sharp ranges
    are not counted.
    """
    assumed = [
        [
            (keyword, one)
            for keyword, parts in markup.lines_of(shown.text)
            if keyword in SHARED
            for one in parts
        ]
        for shown in statements
        if "\nshow " in shown.text
    ]
    if len(assumed) < 2:
        return []
    return [line for line in dict.fromkeys(assumed[0]) if all(line in others for others in assumed)]


def _false_there(text: str) -> str:
    """The goal that is false at a counterexample, as markup; empty where it is long."""
    goal = goal_of(text)
    if not goal or "\nexists " in text:
        return markup.prose(goal)
    formula, *lets = goal.split(", where ")
    return ", where ".join(
        [markup.formula(formula), *(markup.named(*let.split(" = ", 1)) for let in lets)]
    )


def certificate_text(certificate: object) -> str:
    """A certificate as it is stored; empty where there is none."""
    return json.dumps(certificate, separators=(",", ":"), ensure_ascii=True) if certificate else ""


@dataclass(frozen=True)
class ClaimView:
    """A claim for the page; fields with formulas are markup."""

    entry: Entry
    place: str
    says: str
    transcribed: str
    printed: str
    wrong: Sequence[str]
    corrected: str
    change: str
    remark: str
    why: str
    sharp: str
    steps: Sequence[tuple[str, str]]  # title, anchor
    letters: Sequence[tuple[str, str]]
    shared: Sequence[markup.MarkedLine]
    statements: Sequence[ShownStatement]
    note: str
    number: str
    regenerated: str
    mended: str

    @property
    def id(self) -> str:
        """The claim's id, which is its anchor."""
        return self.entry.claim.id

    @property
    def has_another_print(self) -> bool:
        """Whether the claim is regenerated in another form than that of its print."""
        appendices = opened().appendices
        corrected = bool(self.mended and self.printed and self.entry.correction)
        return corrected and self.entry.claim.section[:1] in appendices

    @property
    def refuted(self) -> list[ShownStatement]:
        """The refuted statements, the strongest counterexample first, without those that repeat
        one.
        """
        by_values: dict[tuple[str, str], ShownStatement] = {}
        shown = {one.name: one for one in self.statements}
        for one in (shown[refuted.name] for refuted in self.entry.refuted):
            by_values.setdefault((one.at, one.words), one)
        return list(by_values.values())

    @property
    def own_letters(self) -> list[tuple[str, str]]:
        """The letters of the first refuted statement that the notation lacks, with meanings."""
        return markup.letters_of([one.text for one in self.refuted[:1]], with_notation=False)

    @property
    def outcomes(self) -> str:
        """The number of statements by outcome, as text."""
        counts = {
            word: sum(one.outcome == word for one in self.statements)
            for word in ("certified", "refuted", "unknown")
        }
        return ", ".join(f"{count} {word}" for word, count in counts.items() if count)


def view_of(entry: Entry) -> ClaimView:
    """The view of one claim for the page."""
    claim, corrected, change = entry.claim, "", ""
    shared = shared_lines(entry.statements)
    if entry.correction:
        text, change = entry.correction["text"], note_of(entry.correction["change"])
        latex = is_latex(entry.correction)
        corrected = mathml(text, block=True) if latex else markup.prose(text)
    return ClaimView(
        entry=entry,
        place=place_of(claim),
        says=markup.prose(claim.says),
        transcribed=claim.as_it_stands,
        printed=mathml(claim.printed, block=True) if claim.printed else "",
        wrong=[markup.ranged(line) for line in entry.wrong],
        corrected=corrected,
        change=markup.change(change),
        remark=markup.prose(entry.remark),
        why=entry.why_restored,
        sharp=markup.ranged(entry.sharp) if has_range(entry.sharp) else "",
        steps=[(markup.prose(step.title), anchor(step.function)) for step in entry.steps],
        letters=markup.letters_of([one.text for one in entry.statements]),
        shared=_rows(shared),
        statements=[statement(one, shared=shared) for one in entry.statements],
        note=entry.verdict_text.partition(" (")[2].removesuffix(")"),
        number=tex_words.number(claim),
        regenerated=regenerated(entry) if claim.printed else "",
        mended=tex_words.footnote(entry) if tex_words.in_errata(entry) else "",
    )


def regenerated(entry: Entry) -> str:
    """The print of a claim in the form that is true, as markup (`tex_words.regenerated`)."""
    if not tex_words.in_errata(entry):
        return mathml(entry.claim.printed, block=True)
    if entry.correction and not is_latex(entry.correction):
        return markup.prose(entry.correction["text"])
    return mathml(tex_words.regenerated(entry), block=True)


Section = tuple[str, str, list[ClaimView]]


def appendices(
    contents: Contents, views: Mapping[str, ClaimView]
) -> list[tuple[str, str, list[Section]]]:
    """The appendices of the paper: letter, title, and sections with their headings and claims."""
    return [
        (
            letter,
            title,
            [
                (section, markup.marked(heading), [views[one.claim.id] for one in entries])
                for section, heading, entries in contents.appendix(letter)
            ],
        )
        for letter, title in opened().appendices.items()
    ]


@dataclass(frozen=True)
class ShownDerivation:
    """A derived expression: its anchor, the paper's name for it, its title, its equation as markup
    (empty where it is too long to be read), its entries as text, its letters, and the derivations
    that it uses.
    """

    anchor: str
    symbol: str
    title: str
    shown: str
    text: str
    letters: Sequence[tuple[str, str]]
    uses: Sequence[tuple[str, str]]


def derivations(contents: Contents) -> list[ShownDerivation]:
    """The derived expressions, each once."""
    titles = {one.function: markup.prose(one.title) for one in contents.derivations}
    texts = {
        one.function: one.line.rpartition(f"{one.sentence} ")[2] for one in contents.derivations
    }
    symbols = opened().notation.derived
    return [
        ShownDerivation(
            anchor(one.function),
            mathml(symbols[one.function]) if one.function in symbols else "",
            titles[one.function],
            equation(one.function, one.rows) if len(texts[one.function]) <= LONGEST else "",
            texts[one.function],
            markup.letters(re.findall(r"[A-Za-z]\w*", str(one.rows))),
            [(titles[name], anchor(name)) for name in one.uses if name in titles],
        )
        for one in contents.derivations
    ]


def anchor(function: str) -> str:
    """The anchor of a derivation in the page.

    >>> anchor("controlled_step(u, t)")
    'derived-controlled_step-u-t'
    """
    return "derived-" + "-".join(re.findall(r"\w+", function))


def equation(function: str, entries: Sequence[Sequence[str]]) -> str:
    """A derived expression, column or matrix as markup, with the paper's name for it on the left,
    or else the name of its function.
    """
    name, _, arguments = function.partition("(")
    words = rf"\text{{{name.replace('_', ' ')}}}"
    given = rf"(\text{{{arguments[:-1]}}})" if arguments else ""
    left = opened().notation.derived.get(function, words + given)
    if len(entries) == 1 and len(entries[0]) == 1:
        return mathml(f"{left} = {latex_of(entries[0][0])}", block=True)

    lines = (
        r" \\ ".join(" & ".join(map(latex_of, row)) for row in entries)
        if len(entries) > 1
        else r" \\ ".join(map(latex_of, entries[0]))
    )
    return mathml(rf"{left} = \begin{{bmatrix}} {lines} \end{{bmatrix}}", block=True)


def _rows(lines: Sequence[Line]) -> list[markup.MarkedLine]:
    joined: dict[str, list[str]] = {}
    for keyword, content in lines:
        joined.setdefault(
            keyword if keyword in markup.FORMULAS else f"{keyword} {content}", []
        ).append(content)
    return markup.rows_of([(key.partition(" ")[0], content) for key, content in joined.items()])


def section_title(section: str) -> str:
    """The heading of a section: with its number for the paper's, in words for ours."""
    return f"Section {section}" if re.match(r"[A-Z0-9]", section) else section.capitalize()


def sections(contents: Contents) -> list[tuple[str, list[ClaimView]]]:
    """The claims by section, in the paper's order; sections that the paper lacks come last."""
    by_section: dict[str, list[ClaimView]] = {}
    for entry in contents.entries:
        by_section.setdefault(entry.claim.section, []).append(view_of(entry))

    def key(section: str) -> tuple[int, list[tuple[bool, int, str]]]:
        ours = not re.match(r"[A-Z0-9]", section)
        parts = (
            []
            if ours
            else [
                (not part.isdecimal(), int(part) if part.isdecimal() else 0, part)
                for part in section.split(".")
            ]
        )
        return int(ours), parts

    return sorted(by_section.items(), key=lambda item: key(item[0]))


def errata(
    by_section: Sequence[tuple[str, Sequence[ClaimView]]],
) -> list[tuple[str, str, list[ClaimView]]]:
    """The groups of the errata with their claims."""
    everything = [one for _, claims in by_section for one in claims]
    groups = [
        (group, title, [one for one in everything if one.entry.group == group])
        for group, title in GROUPS.items()
    ]
    return [group for group in groups if group[2]]


@dataclass(frozen=True)
class Panel:
    """A rule of the theorem's tree, with its conclusion in the checker's words and its premises."""

    name: str
    title: str
    kind: str
    gives: str
    shown: ShownStatement
    premises: Sequence[ShownStatement]
    rests_on: Sequence[str]
    uses: Sequence[str]


def panels(rules: Sequence[TheoremRule]) -> list[Panel]:
    """The panels of the rules; `gives` is the checker's own docstring of the rule."""
    return [
        Panel(
            rule.name,
            rule.name.partition("/")[2],
            rule.kind,
            inspect.cleandoc(checker.orbit_rules()[rule.kind]),
            statement(
                ShownText(rule.name, rule.text, rule.outcome, None, "", "", "", {}), whole=True
            ),
            [statement(premise, whole=True) for premise in rule.premises],
            rule.rests_on,
            rule.uses,
        )
        for rule in rules
    ]


def tree(rules: Sequence[TheoremRule], outcomes: Mapping[str, str]) -> str:
    """The picture of the theorem's tree; it also has the statements that rules use."""
    if not rules:
        return ""
    nodes = [
        MarkedStatement(
            rule.name,
            rule.name,
            RULES[rule.kind].label,
            f"#rule-{rule.name}",
            rule.outcome,
            tuple(
                Chip(one.name.rpartition(".")[2], f"#premise-{one.name}", one.outcome)
                for one in rule.premises
            ),
            (*rule.rests_on, *rule.uses),
        )
        for rule in rules
    ]
    for used in sorted({name for rule in rules for name in rule.uses}):
        nodes.append(
            MarkedStatement(
                used, used, "a statement on numbers", f"#{used}", outcomes.get(used, "unknown")
            )
        )
    return picture(
        nodes,
        "What the theorem rests on: each rule stands above the rules that it rests on, and holds"
        " its premises",
    )


# -------------------------------------------------------------------------------------------------
# The report as one HTML page: nothing is fetched, formulas are MathML, pictures are SVG.
#
# The page has the theorem with its proof, the errata, and everything else as a list.  The parts
# behind the list are compressed data, which a script puts in place when a part is opened: as
# elements they would be ten times as large as all the rest.

TEMPLATES = Path(__file__).parent / "templates"
FILE = "juggleproof.html"


@cache
def _environment() -> Environment:
    jinja2, markupsafe = needed("jinja2"), needed("markupsafe")
    made: Environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader([one for one in (opened().templates, TEMPLATES) if one]),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
        auto_reload=False,
    )
    made.filters["markup"] = markupsafe.Markup
    made.filters["text"] = lambda text: markupsafe.Markup(escape(text, quote=False))
    made.filters["prose"] = lambda text: markupsafe.Markup(markup.prose(text))
    return made


def build(
    contents: Contents, drawn: Sequence[Picture] = (), scene: TableResults | None = None
) -> bytes:
    """The page, the same to the byte for the same contents; `scene` has the kept results of the
    part on the vibrating table.

    Raises ClaimError, one line, where a formula cannot be shown.
    """
    environment, markupsafe = _environment(), needed("markupsafe")
    macros = environment.get_template("parts.html.j2").module

    def drawn_by(macro: str, *arguments: object) -> str:
        return str(getattr(macros, macro)(*arguments))

    text: str = environment.get_template("page.html.j2").render(
        **_shown(contents, drawn, scene, markupsafe.Markup, drawn_by)
    )
    return (text.rstrip() + "\n").encode()


def packed(parts: Mapping[str, str]) -> str:
    """The named parts of the page as JSON that is compressed (RFC 1950) and in base 85, with the
    characters from ! to v without <, which could begin markup.  Formulas and outlines of pictures
    are stored once, apart from the parts; a part has # and their number in their place.
    """
    shared = dict[str, int]()
    numbered = {
        name: re.sub(
            r'<math.*?</math>|(?<= d=")[^"]+|#',
            lambda one: f"#{shared.setdefault(one.group(), len(shared))};",
            part.strip(),
        )
        for name, part in parts.items()
    }
    data = json.dumps({"parts": numbered, "shared": [*shared]}, ensure_ascii=False)
    signs = a85encode(zlib.compress(data.encode(), 9)).decode("ascii")
    return signs.replace("z", "!!!!!").replace("<", "v")


OWN_STYLE = "/* here stands the paper's own style */\n"


def _style(own: Path | None) -> str:
    """The style of the page, with that of the paper's own templates in its place."""
    places = [TEMPLATES / "style.css", *([own / "style.css"] if own else [])]
    whole, *more = [path.read_text(encoding="utf-8") for path in places if path.is_file()]
    return whole.replace(OWN_STYLE, "".join(more))


def _shown(
    contents: Contents,
    drawn: Sequence[Picture],
    scene: TableResults | None,
    raw: Callable[[str], str],
    part: Callable[..., str],
) -> dict[str, object]:
    by_section, rules = sections(contents), panels(contents.rules)
    views = {one.id: one for _, found in by_section for one in found}
    groups, behind = errata(by_section), derivations(contents)
    outcomes = {one.name: one.outcome for entry in contents.entries for one in entry.statements}
    linked = {*outcomes, *(entry.claim.id for entry in contents.entries)}
    paper = opened()
    motion, opening = (paper.hook(name, FunctionType) for name in ("motion", "opening"))
    in_proof = paper.hook("proof-figure", str)
    trap = [one for one in drawn if one.slug == in_proof]
    folded = [one for one in drawn if one.slug != in_proof]
    parts = {
        **{name: part("claim", one, linked) for name, one in views.items()},
        **{
            f"erratum-{one.id}": part("erratum", one)
            for *_, found in groups
            for one in found
            if one.refuted
        },
        **{
            f"print-{one.id}": part("print", one) for one in views.values() if one.has_another_print
        },
        **{f"rule-{one.name}": part("rule", one, linked) for one in rules},
        **{one.anchor: part("derived", one) for one in behind},
        **{f"figure-{one.slug}": part("figure", one) for one in [*folded, *scene_picture(scene)]},
    }
    headline, *further = [
        line.strip().rstrip(";") for line in contents.theorem.removeprefix("theorem: ").splitlines()
    ] or [""]
    return {
        "contents": contents,
        "sections": by_section,
        "appendices": appendices(contents, views),
        "errata": groups,
        "first_title": FIRST,
        "theorem_stands": markup.prose(contents.theorem_stands),
        "first_page": [(view_of(entry), three) for entry, three in contents.first_page()],
        "mathml": mathml,
        "panels": rules,
        "derivations": behind,
        "named": [
            one
            for name in paper.notation.shown_first
            for one in behind
            if one.anchor == anchor(name)
        ],
        "tree": tree(contents.rules, outcomes),
        "drawn": folded,
        "trap": next(iter(trap), None),
        "motion": motion() if motion else None,
        "opening": opening(contents) if opening else None,
        "proof_claim": paper.hook("proof-claim", str),
        "paper": paper,
        "own": [] if paper.templates is None else [one.name for one in paper.templates.iterdir()],
        "scene": scene,
        "scene_heads": HEADS,
        "verdicts": {word: (MARKS_OF_VERDICTS[word], means) for word, means in VERDICTS.items()},
        "kinds": {kind: rule.label for kind, rule in RULES.items()},
        "section_title": section_title,
        "headline": headline[:1].upper() + headline[1:],
        "further": list(map(markup.line, further)),
        "notation": [
            (mathml(paper.notation.glyphs[name]), name, meaning)
            for name, meaning in paper.notation.listed.items()
        ],
        "linked": linked,
        "parts": packed(parts),
        "style": raw(_style(paper.templates)),
        "script": raw((TEMPLATES / "page.js").read_text(encoding="utf-8")),
    }
