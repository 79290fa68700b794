"""`juggleproof errata`: what the paper prints wrongly, with what is wrong, the correction, and
exact values at which the print fails.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from juggleproof.certificates.language import ClaimError
from juggleproof.certificates.nodes import Certificate
from juggleproof.certificates.store import DEFAULT, Store
from juggleproof.proofs.claims import Claim
from juggleproof.proofs.judgement import Correction, Finding
from juggleproof.proofs.paper import paper_claims
from juggleproof.proofs.register import Register, load_register, registered
from juggleproof.proofs.run import judge_some

ERRORS = ("misprint", "false", "gap")
HEAD = """\
What the paper prints wrongly: the print, what is wrong with it, the correction, and exact \
values at which it fails.
  misprint  false as printed, certified as corrected
  false     refuted, and no correction is known
  gap       a step of the argument is refuted; the conclusion may stand by another route
alpha is the restitution, 0 < alpha < 1; r the table's launch speed, g gravity; beta and v the \
ball's height and velocity when the table is
at its lowest; iff(a, b) means that a is true exactly if b is. What is said is told in our \
words; a line is one of the transcription.
`juggleproof explain ID` shows the other names, the derivation, the statements and their \
certificates.
"""
GROUPS = {
    "errors": "Errors of the paper",
    "readings": (
        "False in one reading: what is said can be read in several ways, and not all of them are"
        " true"
    ),
    "repeats": "Wrong again: prints that repeat one of these",
    "transcription": (
        "Possible transcription errors: one lost mark mends the print, so the fault may not be the"
        " authors'"
    ),
}
WIDTH, LONGEST_GOAL = 124, 110  # characters of a formula that are still read at a glance


def as_text() -> str:
    """Every claim that is not simply true, in groups; a heading with its number opens each.

    Raises ClaimError, one line, where no verdict is registered yet.
    """
    register, claims = {**load_register()}, paper_claims()
    if not register:
        raise ClaimError(
            "no verdict is registered yet; `juggleproof certify --accept` registers them"
        )
    doubted = [claim for claim in claims if register.get(claim.id, {}).get("verdict") != "holds"]
    judged = {one.id: one for one in judge_some(doubted, claims, DEFAULT)}
    for name, one in judged.items():
        register[name] = registered(one.verdict.word, one.verdict.detail, "", "")
    findings = {name: one.finding() for name, one in judged.items()}
    lines = [HEAD]
    for group, title in GROUPS.items():
        members = [claim for claim in claims if group_of(claim, register, findings) == group]
        lines.append(f"{title} ({len(members)})\n")
        for claim in members:
            one = judged[claim.id]
            settled = [(*part, one.certificates[part[0]]) for part in one.statements]
            lines += [*entry_of(claim, register, findings[claim.id], settled), ""]
    names = restored(claims, register)
    mangled = (
        f"Mangled in the transcription, and true as restored ({len(names)}):"
        f" {', '.join(names) or 'none'}"
    )
    return "\n".join([*lines, textwrap.fill(mangled, WIDTH, break_on_hyphens=False)])


def group_of(
    claim: Claim,
    register: Register,
    findings: Mapping[str, Finding],
) -> str:
    """The group that lists the claim, or none: a repeat is one only of a print that is itself
    listed.
    """

    def wrong(name: str) -> bool:
        return register.get(name, {}).get("verdict") in (*ERRORS, "ambiguous")

    if not wrong(claim.id):
        return ""
    if claim.repeats and wrong(claim.repeats):
        return "repeats"
    if register[claim.id]["verdict"] == "ambiguous":
        return "readings"
    correction = findings.get(claim.id, Finding()).get("correction")
    return (
        "transcription" if correction and correction["possible transcription error"] else "errors"
    )


Settled = tuple[str, str, Certificate | None]  # a statement: its name, its text, its certificate


def stored(claim: Claim, store: Store) -> list[Settled]:
    """The statements of a claim as a store holds them."""
    names = (name for name in store.texts if name.split("/")[0] == claim.id)
    return [(name, store.texts[name], store.certificate(name, store.texts[name])) for name in names]


class Row(NamedTuple):
    """One row of an entry: its title, empty where it goes on with the row before, and its text.

    `latex` says how the text is a formula: "print" for LaTeX, "term" for the language of
    statements, empty for prose; `code` that the text is an exact one of the program.
    """

    title: str
    text: str
    latex: str = ""
    code: bool = False


def rows_of(
    claim: Claim,
    register: Register,
    finding: Finding,
    settled: Sequence[Settled],
) -> list[Row]:
    """One entry: a heading with place and verdict, then what is said, the print, what is wrong, the
    correction, exact counterexamples.
    """
    entry = register[claim.id]
    heading = f"{claim.id}, {_place(claim)}: {entry['verdict']}"
    if claim.repeats:
        holds = register.get(claim.repeats, {}).get("verdict") == "holds"
        which = (
            ""
            if not holds
            else ", which holds"
            if entry["verdict"] == "ambiguous"
            else ", which prints it right"
        )
        heading += f"; repeats {claim.repeats}{which}"
    rows = [Row("", heading), Row("said", claim.says)]
    if claim.as_it_stands:
        rows.append(Row("transcribed", claim.as_it_stands, code=True))
    if claim.printed:
        rows.append(Row("restored" if claim.as_it_stands else "printed", claim.printed, "print"))
    title = "readings" if entry["verdict"] == "ambiguous" else "wrong"
    rows.append(Row(title, "\n".join(what_is_wrong(entry, finding.get("sharp", {})))))
    correction = finding.get("correction")
    if correction:
        form = "term" if correction["kind"] in ("coefficients", "derived") else "print"
        rows.append(Row("correction", correction["text"], form))
        change = "; ".join([correction["change"], *_roots_named(correction, settled)])
        rows.append(Row("", change, code="\\" in change or "=" in change))
    elif entry["verdict"] not in ("ambiguous", "gap"):
        rows.append(Row("correction", "none found"))
    return [
        *rows,
        *(Row("fails at", text, code=True) for text in _counterexamples(settled)),
    ]


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
                textwrap.fill(row.text, WIDTH, break_on_hyphens=False)
                if row.title == "said"
                else row.text,
            )
            for row in rows
        ),
    ]


def restored(claims: Sequence[Claim], register: Register) -> list[str]:
    """The claims whose print the transcription mangles, and which hold as restored."""
    return [
        claim.id
        for claim in claims
        if claim.as_it_stands and register.get(claim.id, {}).get("verdict") == "holds"
    ]


def _row(title: str, text: str) -> str:
    return (
        f"    {title:12}"
        + "\n".join(f"{'':16}{line.strip()}" for line in text.splitlines()).lstrip()
    )


def _place(claim: Claim) -> str:
    section = f"section {claim.section}" if re.match(r"[A-Z0-9]", claim.section) else claim.section
    return f"{section}, " + (
        f"equation {claim.place}" if claim.place.startswith("(") else claim.place
    )


def what_is_wrong(entry: Mapping[str, str], sharp: Mapping[str, str]) -> list[str]:
    """One line for each reading where there are several, else one in all, with the alpha for which
    it holds where that is known.
    """
    detail, verdict = entry.get("detail", ""), entry["verdict"]
    readings = dict(part.split(": ") for part in detail.split("; ")) if ": " in detail else {}
    if readings:
        words = {"holds": "true", "false": "false", "unknown": "open"}
        return [
            f"read as {name}: {words[word]}{_for_alpha(sharp.get(name + '.', ''), word)}"
            for name, word in readings.items()
        ]
    for pattern, wording in (
        (r"^its conclusion is refuted(, and)?", r"the conclusion is false\1"),
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
        + _for_alpha(sharp.get("", ""), "false")
    ]


def _for_alpha(sharp: str, word: str) -> str:
    if sharp in ("", "not found"):
        return ""
    if word == "holds":
        return "" if sharp == "0 < alpha < 1" else f", exactly for {sharp}"
    return ", for every alpha" if sharp == "nowhere" else f"; it would be true exactly for {sharp}"


def _roots_named(correction: Correction, settled: Sequence[Settled]) -> Iterator[str]:
    """What a name of a root in a corrected term means: the statements say it."""
    lines = {
        line for _, text, _ in settled for line in text.splitlines() if line.startswith("root ")
    }
    for line in sorted(lines):
        name = line.split()[1]
        if correction["kind"] in ("coefficients", "derived") and re.search(
            rf"\b{name}\b", correction["text"]
        ):
            yield line.removeprefix("root ")


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


def _counterexamples(settled: Sequence[Settled]) -> list[str]:
    """The exact values of every refuted statement, with the part of the claim that fails there, and
    what it says where that is short.
    """
    goals = dict[str, str]()
    for name, text, certificate in settled:
        if certificate is not None and "refuted" in certificate:
            label = name.split("/")[1].removesuffix(".main")
            values = counterexample(certificate["refuted"]) + (
                "" if label == "main" else f"   [{label}]"
            )
            goals.setdefault(values, goal_of(text))
    return [values + (f"\nfalse there: {goal}" if goal else "") for values, goal in goals.items()]


def goal_of(text: str) -> str:
    """What the statement shows at a point of its givens, in its own words; nothing where that is
    long.

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
