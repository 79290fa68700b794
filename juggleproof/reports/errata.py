"""`juggleproof errata`: the errors of the paper, each with its fault, its correction, and exact
values at which the print fails.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import NamedTuple

from juggleproof.certificates import checker
from juggleproof.judging.claims import VERDICTS, Argument, Claim, Readings, Remark, stated_texts
from juggleproof.judging.conclusions import REFUTED
from juggleproof.judging.correcting import note_of
from juggleproof.judging.evaluating import numbers_at, value_at
from juggleproof.judging.judgement import Correction, Finding
from juggleproof.judging.register import Register
from juggleproof.judging.strength import UNSEEN, Strength, strength_of
from juggleproof.papers.paper import opened
from juggleproof.papers.places import place_of
from juggleproof.reading.meaning import read
from juggleproof.reports.counterexample_words import in_words
from juggleproof.reports.tables import line_width
from juggleproof.reports.tree import STANDS
from juggleproof.statements.language import ClaimError, Formula, conjunction
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.store import Store

ERRORS = ("misprint", "false", "gap")
LEGEND = "\n".join(f"  {word:8}  {VERDICTS[word]}" for word in ERRORS)
HEAD = f"""\
What the paper prints wrongly: the print, what is wrong with it, the correction, and exact \
values at which it fails, in words too.
{LEGEND}
"""
NOTES = """\
iff(a, b) means that a is true exactly if b is. The sentences are ours.
`juggleproof explain ID` shows the other names, the derivation, the statements and their \
certificates, and with --lines the line of the transcription.
"""
GROUPS = {  # in order of weight, the heaviest first
    "proof": "Breaks the proof: what a section concludes rests on it, and stands by a repair",
    "statement": "Wrong statements",
    "mark": "Wrong formulas, mended by one mark",
    "marks": "Wrong formulas, mended by several marks",
    "readings": (
        "False in one reading: what is said can be read in several ways, and not all of them are"
        " true"
    ),
    "repeats": "Wrong again: prints that repeat one of these",
    "transcription": (
        "Possible transcription errors: one lost mark mends the print, so the fault may not be the"
        " authors'"
    ),
    "remarks": "Remarks on what is true",
    "restored": "Mangled in the transcription, and true as restored",
}
WRONG = [name for name in GROUPS if name not in ("remarks", "restored")]
FIRST = "What matters to whoever cites the theorem"
WEIGHTS = {
    "proof": "breaks the proof",
    "statement": "wrong statement",
    "mark": "wrong formula, mended by one mark",
    "marks": "wrong formula, mended by several marks",
    "readings": "wording",
}
WIDTH, LONGEST_GOAL = 108, 110  # characters of a line of text, and of a formula that is shown
INDENT = 16  # of the text of a row, after its title


def is_noted(claim: Claim) -> bool:
    """Whether the errata have a note on the claim, even if it holds."""
    return bool(claim.as_it_stands or claim.remark)


def group_of(
    claim: Claim,
    register: Register,
    findings: Mapping[str, Finding],
) -> str:
    """The group that lists the claim, or empty; a claim counts as a repeat only if the print that
    it repeats is wrong too.
    """

    def wrong(name: str) -> bool:
        return register.get(name, {}).get("verdict") in (*ERRORS, "ambiguous")

    if not wrong(claim.id):
        noted = "restored" if claim.as_it_stands else "remarks" if claim.remark else ""
        return noted if register.get(claim.id, {}).get("verdict") == "holds" else ""
    if claim.repeats and wrong(claim.repeats):
        return "repeats"
    correction = findings.get(claim.id, Finding()).get("correction")
    if correction and correction["possible transcription error"]:
        return "transcription"
    return weight_of(claim, register, correction)


def weight_of(claim: Claim, register: Register, correction: Correction | None) -> str:
    """The weight of an error, as a key of `WEIGHTS`.

    An argument whose conclusion stands only by the theorem's rules breaks the proof, and so does a
    claim that asserts one of its refuted steps.  An error that one mark or several marks mend is a
    wrong formula, any other a wrong statement.
    """
    if register[claim.id]["verdict"] == "ambiguous":
        return "readings"
    texts = {text.partition("\n")[2] for text in stated_texts(claim).values()}
    details = frozenset((name, one.get("detail", "")) for name, one in register.items())
    if texts & _broken_steps(details):
        return "proof"
    if correction and correction["kind"] != "nearby":
        return "marks" if correction["kind"] in ("marks", "coefficients", "derived") else "mark"
    return "statement"


@cache
def _broken_steps(details: frozenset[tuple[str, str]]) -> frozenset[str]:
    """The texts, without names, of the refuted steps of arguments whose conclusion stands by rules
    of the theorem.
    """
    by_id = {name: detail for name, detail in details if detail.startswith("step ")}
    found = set[str]()
    for claim in (
        opened().claims() if by_id else ()
    ):  # without such steps, a false claim of a user does not load the paper
        body = claim.body() if claim.id in by_id else None
        if isinstance(body, Argument) and body.rests_on:
            steps = by_id[claim.id].removeprefix("step ").partition(" is false")[0].split(", ")
            for name, text in stated_texts(claim).items():
                if name.split("/")[1].partition(".")[0] in steps:
                    found.add(text.partition("\n")[2])
    return frozenset(found)


Settled = tuple[str, str, Certificate | None]  # a statement: its name, its text, its certificate


def stored(claim: Claim, store: Store) -> list[Settled]:
    """The statements of a claim in a store."""
    names = (name for name in store.texts if name.split("/")[0] == claim.id)
    return [(name, store.texts[name], store.certificate(name, store.texts[name])) for name in names]


class ErrataRow(NamedTuple):
    """A row of an entry: its title, which is empty where the row continues the one before, and its
    text.

    `latex` says that the text is LaTeX; `code` that it is an exact text of the program.
    """

    title: str
    text: str
    latex: bool = False
    code: bool = False


def rows_of(
    claim: Claim,
    register: Register,
    finding: Finding,
    settled: Sequence[Settled],
) -> list[ErrataRow]:
    """The rows of an entry: a heading with place and verdict, then the claim's sentence, its print,
    the fault, the correction, and exact counterexamples, also in words.
    """
    entry = register[claim.id]
    heading = f"{claim.id}, {place_of(claim)}: {entry['verdict']}"
    if entry["verdict"] != "holds":
        heading += f"; {WEIGHTS[weight_of(claim, register, finding.get('correction'))]}"
    if claim.repeats:
        holds = register.get(claim.repeats, {}).get("verdict") == "holds"
        which = (
            ""
            if not holds or entry["verdict"] == "holds"
            else ", which holds"
            if entry["verdict"] == "ambiguous"
            else ", which prints it right"
        )
        heading += f"; repeats {claim.repeats}{which}"
    rows = [ErrataRow("", heading), ErrataRow("said", claim.says)]
    if claim.as_it_stands:
        rows.append(ErrataRow("transcribed", claim.as_it_stands, code=True))
    if claim.printed:
        rows.append(
            ErrataRow("restored" if claim.as_it_stands else "printed", claim.printed, latex=True)
        )
    if claim.as_it_stands and entry["verdict"] == "holds":
        rows.append(ErrataRow("why", why_restored(claim)))
    title = "readings" if entry["verdict"] == "ambiguous" else "wrong"
    if entry["verdict"] != "holds":
        wrong = what_is_wrong(entry, finding.get("sharp", {}), passages_of(claim))
        rows.append(ErrataRow(title, "\n".join(wrong)))
    correction = finding.get("correction")
    if correction:
        rows.append(ErrataRow("correction", correction["text"], latex=is_latex(correction)))
        change = note_of(correction["change"])
        rows.append(ErrataRow("", change, code="\\" in change or "=" in change))
    elif entry["verdict"] in ("misprint", "false"):
        rows.append(ErrataRow("correction", "none found"))
    if claim.remark:
        rows.append(ErrataRow("remark", told(claim.remark)))
    for one in _counterexamples(claim, settled):
        rows.append(ErrataRow("fails at", one.text, code=True))
        if one.words:
            rows.append(ErrataRow("in words", one.words))
    return rows


def entry_of(
    claim: Claim,
    register: Register,
    finding: Finding,
    settled: Sequence[Settled],
) -> list[str]:
    """The lines of one entry, as `juggleproof errata` prints them."""
    heading, *rows = rows_of(claim, register, finding, settled)
    return [
        heading.text,
        *(
            _row(
                row.title,
                _filled(row.text) if row.title in ("said", "remark", "in words") else row.text,
            )
            for row in rows
        ),
    ]


def _filled(text: str) -> str:
    return textwrap.fill(text, line_width(WIDTH + INDENT) - INDENT, break_on_hyphens=False)


def told(remark: Remark) -> str:
    """A remark with the claims that show it."""
    return remark.text + (f" ({', '.join(remark.by)})" if remark.by else "")


def passages_of(claim: Claim) -> dict[str, str]:
    """The passage of the paper for each reading of a claim."""
    body = claim.body()
    return (
        {name: one.passage for name, one in body.of.items()} if isinstance(body, Readings) else {}
    )


def why_restored(claim: Claim) -> str:
    """The reason why the transcription is not judged as it stands."""
    try:
        claim.body(read(claim.as_it_stands))
    except (ClaimError, checker.Rejected) as problem:
        return f"as transcribed: {problem}"
    return "as transcribed it can be read, and says something else"


def first_page(
    claims: Sequence[Claim],
    register: Register,
    groups: Mapping[str, str],
    findings: Mapping[str, Finding],
    settled: Mapping[str, Sequence[Settled]],
    theorem: str,
) -> list[str]:
    """The first page, for those who cite the theorem: whether it stands, by its line `theorem`, and
    the errors that concern it, each with its three lines; nothing where the paper has no theorem.
    """
    if opened().theorem is None:
        return []
    lines = [f"{FIRST}\n", theorem_stands(claims, theorem), ""]
    for claim in what_matters(claims, groups):
        lines.append(f"{claim.id}, {place_of(claim)}")
        three = three_lines_of(claim, register, findings[claim.id], settled[claim.id])
        for one in three:
            lines.append(_row(one.title, _filled(one.text)))
        lines.append("")
    return lines


def three_lines_of(
    claim: Claim, register: Register, finding: Finding, settled: Sequence[Settled]
) -> list[FirstPageLine]:
    """The three lines of a claim on the first page."""
    wrong = what_is_wrong(register[claim.id], finding.get("sharp", {}), passages_of(claim))
    counterexamples = _counterexamples(claim, settled)
    fails = [at_a_glance(one.values, one.numbers, one.words) for one in counterexamples]
    return in_three_lines(claim, wrong, fails, finding.get("correction"))


def theorem_stands(claims: Sequence[Claim], theorem: str) -> str:
    """The sentence on whether the theorem survives, by its line `theorem`; empty where the paper
    has no theorem.
    """
    of_paper = opened().theorem
    if of_paper is None:
        return ""
    says = [claim.says for claim in claims if claim.id == of_paper.claim]
    if not theorem.startswith(STANDS) or not says:
        return f"The theorem is not certified ({of_paper.claim})."
    return f"The theorem survives all of these, by another proof ({of_paper.claim}). {says[0]}"


def what_matters(claims: Sequence[Claim], group: Mapping[str, str]) -> list[Claim]:
    """The errors that concern the theorem, by the group of each claim: those that break its proof,
    then the wrong values that enter other results of the paper.
    """
    breaks = [claim for claim in claims if group[claim.id] == "proof"]
    return breaks + [one for one in claims if one.id in opened().enters and group[one.id]]


def at_a_glance(values: str, numbers: str, words: str) -> str:
    """The values of a counterexample, the numbers that disagree there, and the words on it."""
    return " ".join([f"{values}: {numbers}." if numbers else f"{values}.", words]).rstrip()


class FirstPageLine(NamedTuple):
    """A line of the first page: its title, a formula as LaTeX or empty, and words."""

    title: str
    words: str
    latex: str = ""

    @property
    def text(self) -> str:
        """The line as it is printed on a terminal."""
        return ". ".join(part for part in (self.latex, self.words) if part)


def in_three_lines(
    claim: Claim, wrong: Sequence[str], fails: Sequence[str], correction: Correction | None
) -> list[FirstPageLine]:
    """The three lines of a claim: what is said, why it is wrong, and what is true instead."""
    mended = correction["text"] if correction else ""
    latex, words = (mended, "") if correction and is_latex(correction) else ("", mended)
    parts = [words, told(claim.remark) if claim.remark else ""]
    true = ". ".join(part for part in parts if part)
    return [
        FirstPageLine("said", claim.says.partition(". ")[0].rstrip(".")),
        FirstPageLine("wrong", "; fails at ".join(["; ".join(wrong), *fails[:1]])),
        FirstPageLine("true", true or ("" if latex else "the conclusion itself"), latex),
    ]


def is_latex(correction: Correction) -> bool:
    """Whether the text of a correction is a print, and not a sentence."""
    return correction["kind"] != "nearby" or "\\" in correction["text"]


def _row(title: str, text: str) -> str:
    return (
        f"    {title:12}"
        + "\n".join(f"{'':{INDENT}}{line.strip()}" for line in text.splitlines()).lstrip()
    )


def what_is_wrong(
    entry: Mapping[str, str], sharp: Mapping[str, str], passages: Mapping[str, str] | None = None
) -> list[str]:
    """The fault of a claim: a line for each reading, if there are several, with the passage that
    prints it so, else one line; with the parameters for which it holds, where that is known.
    """
    detail, verdict = entry.get("detail", ""), entry["verdict"]
    readings = dict(part.split(": ") for part in detail.split("; ")) if ": " in detail else {}
    if readings:
        words = {"holds": "true", "false": "false", "unknown": "open"}
        return [
            f"read as {name}: {words[word]}{_for_which(sharp.get(name + '.', ''), word)}"
            + (f"; {passages[name]}" if passages else "")
            for name, word in readings.items()
        ]
    for pattern, wording in (
        (rf"^its conclusion is {REFUTED}(, and)?", r"the conclusion is false\1"),
        (r", and (step .*)", r", and so is \1"),
        (r"^step (.*,.*) is false", r"steps \1 are false"),
        ("conclusion open", "the conclusion stays open"),
        ("conclusion certified", "the conclusion is certified all the same"),
        ("conclusion by", "the conclusion stands by"),
    ):
        detail = re.sub(pattern, wording, detail)
    if detail:
        return [detail]
    return [
        ("false as printed" if verdict == "misprint" else "false")
        + _for_which(sharp.get("", ""), "false")
    ]


def for_which(sharp: str) -> str:
    """A sharp range after the words that say whether it is the whole of it.

    >>> for_which("alpha < 1/3"), for_which("at least alpha < 1/3")
    ('exactly for alpha < 1/3', 'for at least alpha < 1/3')
    """
    return ("for " if sharp.startswith("at least ") else "exactly for ") + sharp


def _for_which(sharp: str, word: str) -> str:
    """The words on the values of the parameter for which an assertion holds."""
    if sharp in ("", "not found"):
        return ""
    paper = opened()
    if word == "holds":
        return "" if sharp == paper.domain else f", {for_which(sharp)}"
    if sharp == "nowhere":
        return f", for every {paper.parameter}"
    return f"; it would be true {for_which(sharp)}"


def counterexample(refutation: object) -> str:
    """The values of a counterexample as text; raises ClaimError where a certificate has none."""
    match refutation:
        case ["sign", polynomial, *_]:
            return f"a family by the sign of {polynomial}"
        case [_, list() | tuple() as adjoined, {**terms}, *_]:
            return ", ".join(f"{name} = {value}" for name, value in terms.items()) + "".join(
                f" where {root} is a root of {polynomial} between {low} and {high}"
                for root, polynomial, low, high, *_ in adjoined
            )
    raise ClaimError("a refutation without values; `juggleproof certify --fresh` searches anew")


class Fails(NamedTuple):
    """A counterexample: the exact values, with the label of the statement that fails; its goal, if
    that is short; the numbers that disagree; and the sentence in words.
    """

    values: str
    goal: str
    numbers: str
    words: str

    @property
    def text(self) -> str:
        """The values, the goal and the numbers, each in a line."""
        return (
            self.values
            + (f"\nfalse there: {self.goal}" if self.goal else "")
            + (f"\nin numbers: {self.numbers}" if self.numbers else "")
        )


def _counterexamples(claim: Claim, settled: Sequence[Settled]) -> list[Fails]:
    """The counterexamples of the refuted statements, the strongest first; those with equal values
    are shown once.
    """
    fails, strengths = dict[str, Fails](), dict[str, Strength]()
    for name, text, certificate in settled:
        if certificate is not None and "refuted" in certificate:
            label = name.split("/")[1].removesuffix(".main")
            refuted = certificate["refuted"]
            values = counterexample(refuted) + ("" if label == "main" else f"   [{label}]")
            strengths[values] = strength_at(text, refuted, claim.assumed)
            words = words_of(text, refuted) + told_outside(claim.assumed, strengths[values])
            one = Fails(values, goal_of(text), numbers_of(text, refuted), words)
            fails.setdefault(values, one)
    return sorted(fails.values(), key=lambda one: strengths[one.values], reverse=True)


def strength_at(text: str, refutation: object, assumed: Sequence[Formula]) -> Strength:
    """The strength of a counterexample in a section that assumes this; `UNSEEN` for a family, and
    for a counterexample with a root.
    """
    point = point_of(text, refutation)
    return UNSEEN if point is None else strength_of(text, point, assumed)


def told_outside(assumed: Sequence[Formula], strength: Strength) -> str:
    """A sentence where a counterexample lies outside of what its section assumes; else empty."""
    if strength.within or not assumed:
        return ""
    return f" The section assumes {conjunction(assumed)}; there no counterexample is known."


def words_of(text: str, refutation: object, of_paper: bool = True) -> str:
    """The sentence in words on a rational counterexample; empty where it has a root."""
    point = point_of(text, refutation)
    return "" if point is None else in_words(text, point, of_paper)


def numbers_of(text: str, refutation: object) -> str:
    """The first false goal of the statement, with the numbers of a rational counterexample in
    place; empty where it has a root, the statement has `exists`, or the text is long.
    """
    point = point_of(text, refutation)
    lines = [line.partition(" ") for line in text.splitlines()]
    if point is None or any(keyword == "exists" for keyword, _, _ in lines):
        return ""
    shown = [formula for keyword, _, formula in lines if keyword == "show"]
    failing = [numbers for numbers in (numbers_at(one, point) for one in shown) if numbers]
    return failing[0] if failing and len(failing[0]) <= LONGEST_GOAL else ""


def point_of(text: str, refutation: object) -> dict[str, Fraction] | None:
    """The values at a rational counterexample, also of abbreviations; None for a family, and for a
    counterexample with a root.
    """
    match refutation:
        case [_, [] | (), {**terms}, *_]:
            values = {str(name): value_at(str(value), {}) for name, value in terms.items()}
            point = {name: value for name, value in values.items() if value is not None}
        case _:
            return None
    for line in text.splitlines():
        keyword, _, rest = line.partition(" ")
        name, _, value = rest.partition(" = ")
        known = value_at(value, point) if keyword == "let" else None
        if known is not None:
            point[name] = known
    return point


def goal_of(text: str) -> str:
    """The goal of the statement in its own notation; empty where it is long.

    >>> text = "statement a/b\\nforall x\\ngiven x > 0\\nexists y\\nwith y > 0\\nshow y < x - 1"
    >>> goal_of(text)
    'some y has y > 0 and y < x - 1'
    """
    lines = [line.partition(" ") for line in text.splitlines()]
    chosen = " ".join(names for keyword, _, names in lines if keyword == "exists")
    shown = (f"some {chosen} has " if chosen else "") + " and ".join(
        formula for keyword, _, formula in lines if keyword in ("with", "show")
    )
    lets = [
        let
        for keyword, _, let in lines
        if keyword == "let" and re.search(rf"\b{let.split()[0]}\b", shown)
    ]
    goal = shown + "".join(f", where {let}" for let in lets)
    return goal if len(goal) <= LONGEST_GOAL else ""
