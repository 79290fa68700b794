"""The contents of a report, as data."""

from __future__ import annotations

import sys
import tomllib
from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING

from juggleproof.certificates import checker
from juggleproof.judging.checked import Checked, outcomes_of
from juggleproof.judging.claims import VERDICTS, Claim, awaited
from juggleproof.judging.judgement import Correction, Judgement, statements_of
from juggleproof.judging.register import (
    PATH,
    Change,
    Register,
    changes,
    load_register,
    registered,
)
from juggleproof.judging.run import (
    Options,
    Run,
    by_id,
    judge_some,
    judge_stored,
    lemmas,
    settle_by_rules,
    with_below,
)
from juggleproof.judging.strength import UNSEEN, Strength
from juggleproof.papers.derivations import behind, derivations_of
from juggleproof.papers.paper import opened
from juggleproof.reports import errata, tree
from juggleproof.reports import results as table
from juggleproof.reports.results import ClaimResult, RunResults, reading_of
from juggleproof.reports.tables import folded, line_width
from juggleproof.statements.language import ClaimError, Formula, lemmas_of, rests_on
from juggleproof.statements.nodes import Json
from juggleproof.statements.store import DEFAULT, Store, canonical
from juggleproof.statements.vote import Vote

if TYPE_CHECKING:
    from juggleproof.papers.derivations import Derivation

# -------------------------------------------------------------------------------------------------
# All that reports show, gathered once: claims with verdicts, derivations and statements; the
# theorem's tree; the differences from the register.
#
# Verdicts are judged again from the store, by the checker's outcomes for these files; none is taken
# from the register.

TOOLS = ("sympy", "mpmath", "z3-solver", "python-flint", "highspy")


@dataclass(frozen=True)
class ShownText:
    """A statement as reports show it: the text that the checker reads, its outcome, the certificate
    as stored, the counterexample with its numbers and in words, the answers of the routes.
    """

    name: str
    text: str
    outcome: str
    certificate: object
    at: str
    numbers: str
    words: str
    votes: Mapping[str, str]
    strength: Strength = UNSEEN


@dataclass(frozen=True)
class Entry:
    """One claim as reports show it; `wrong` and `group` are as in the errata, and empty where
    nothing is wrong.
    """

    claim: Claim
    verdict: str
    detail: str
    verdict_text: str
    settled_by: str
    sharp: str
    reading: str
    wrong: tuple[str, ...]
    group: str
    correction: Correction | None
    steps: tuple[Derivation, ...]
    statements: tuple[ShownText, ...]
    rests_on: tuple[str, ...]

    @property
    def fails(self) -> list[str]:
        """The counterexamples, the strongest first, each once."""
        shown = (errata.at_a_glance(one.at, one.numbers, one.words) for one in self.refuted)
        return list(dict.fromkeys(shown))

    @property
    def refuted(self) -> list[ShownText]:
        """The refuted statements, that with the strongest counterexample first."""
        refuted = [one for one in self.statements if one.at]
        return sorted(refuted, key=lambda one: one.strength, reverse=True)

    @property
    def remark(self) -> str:
        """The remark on the claim, with the claims that show it; empty where there is none."""
        return errata.told(self.claim.remark) if self.claim.remark else ""

    @property
    def why_restored(self) -> str:
        """The reason why the transcription is not judged, for a print that holds as restored."""
        return errata.why_restored(self.claim) if self.group == "restored" else ""


@dataclass(frozen=True)
class TheoremRule:
    """A node of the theorem's tree: a map rule, its premises as the checker writes them, the rules
    that it rests on, and the statements that it uses.
    """

    name: str
    kind: str
    text: str
    outcome: str
    premises: tuple[ShownText, ...]
    rests_on: tuple[str, ...]
    uses: tuple[str, ...]


@dataclass(frozen=True)
class Contents:
    """The contents of a report: entries in the paper's order, derivations each after those that it
    uses, rules with the theorem first.
    """

    entries: tuple[Entry, ...]
    verdicts: Mapping[str, int]
    outcomes: Mapping[str, int]
    votes: tuple[str, ...]
    theorem: str
    rules: tuple[TheoremRule, ...]
    derivations: tuple[Derivation, ...]
    changes: tuple[str, ...]
    tools: Mapping[str, str]

    @property
    def theorem_stands(self) -> str:
        """The sentence on whether the theorem survives the errors."""
        return errata.theorem_stands([one.claim for one in self.entries], self.theorem)

    def first_page(self) -> list[tuple[Entry, list[errata.FirstPageLine]]]:
        """The errors that matter to those who cite the theorem: each claim with its three lines."""
        claims = [one.claim for one in self.entries]
        matters = errata.what_matters(claims, {one.claim.id: one.group for one in self.entries})
        entries = [self.entry(claim.id) for claim in matters]
        return [
            (one, errata.in_three_lines(one.claim, one.wrong, one.fails, one.correction))
            for one in entries
        ]

    def appendix(self, letter: str) -> list[tuple[str, str, list[Entry]]]:
        """The sections of an appendix that have claims: number, heading, entries.

        Raises ClaimError, one line, where a section of a claim has no heading.
        """
        headings = opened().headings
        for one in self.entries:
            if one.claim.section.startswith(f"{letter}.") and one.claim.section not in headings:
                raise ClaimError(
                    f"{one.claim.id}: section {one.claim.section} has no heading; add it to the"
                    " headings of the paper"
                )
        sections = [
            (section, heading, [one for one in self.entries if one.claim.section == section])
            for section, heading in headings.items()
            if section.startswith(letter)
        ]
        return [one for one in sections if one[2]]

    def entry(self, claim_id: str) -> Entry:
        """The entry of this claim."""
        return next(one for one in self.entries if one.claim.id == claim_id)


def gather(register: Path = PATH, checked: Checked | None = None) -> Contents:
    """The contents of a report on the stored claims, by the checker's outcomes for the store, which
    it is asked for unless `checked` has them.

    Raises ClaimError, one line, where the store has no certificates, or the register is invalid.
    """
    before = load_register(register)
    claims = opened().claims()
    for claim in claims:
        with suppress(ClaimError, checker.Rejected):  # judging raises these again, with the place
            claim.body()  # stated once, before other processes are started
    done = judge_stored(claims, Options(DEFAULT), checked=checked)
    settle_by_rules(done.judgements, done.outcomes, Store(DEFAULT).texts, by_id(done.claims))
    return contents_of(done, before)


def contents_of(done: Run, before: Register) -> Contents:
    """The contents of a report on a run over all claims of the paper, compared with a register."""
    store, judgements, checked = Store(done.store), done.judgements, done.outcomes
    votes = {name: cast for one in judgements for name, cast in one.votes.items()}
    register = _judged(done.claims, judgements)
    entries = _entries(done.claims, judgements, register, store)
    derived = {one.function: one for entry in entries for one in behind(entry.steps)}
    outcomes = Counter(outcome for one in judgements for outcome in one.outcomes.values())
    return Contents(
        entries,
        {word: sum(one.verdict.word == word for one in judgements) for word in VERDICTS},
        dict(outcomes),
        tuple(table.summary(judgements).splitlines()[2:]),
        tree.theorem_line(store, checked, votes),
        _rules(store, checked, votes),
        tuple(derived.values()),
        tuple(changes(before, register, partial=False)),
        tool_versions(),
    )


def entries_of(claims: Sequence[Claim]) -> tuple[Entry, ...]:
    """The entries of some of the paper's claims.  Only these are judged, by certificates alone; the
    weight of an error depends on the registered verdicts of the others.

    Raises ClaimError, one line, where the store has no certificates, or the register is invalid.
    """
    judgements = judge_some(claims, opened().claims_by_id, DEFAULT)
    register = {**load_register(), **_judged(claims, judgements)}
    return _entries(claims, judgements, register, Store(DEFAULT))


def _judged(claims: Sequence[Claim], judgements: Sequence[Judgement]) -> Register:
    return {claim.id: entry(claim, judgement) for claim, judgement in zip(claims, judgements)}


def _entries(
    claims: Sequence[Claim], judgements: Sequence[Judgement], register: Register, store: Store
) -> tuple[Entry, ...]:
    entries = list[Entry]()
    for claim, judgement in zip(claims, judgements):
        steps = derivations_of(statements_of(claim, judgement.correction))
        reading = reading_of(claim.body())
        entries.append(_entry(claim, judgement, register, store, tuple(steps), reading))
    return tuple(entries)


def errata_text() -> str:
    """Every claim that is not simply true, in groups, each under a heading with its number.

    Each claim that is shown is judged now: the checker reads its statements and all on which they
    rest, and no others.  A claim is left out where it is registered as `holds` and the store has a
    proof of each of its statements; the checker is not asked about these proofs here.  Raises
    ClaimError, one line, where no verdict is registered yet, or the store cannot be read.
    """
    registers, claims, store = load_register(), opened().claims(), Store(DEFAULT)
    if not registers:
        raise ClaimError(
            "no verdict is registered yet; `juggleproof certify --accept` registers them"
        )
    names, proved = dict[str, list[str]](), set[str]()
    for name in store.texts:
        names.setdefault(name.split("/")[0], []).append(name)
        if "certified" in (store.certificate_named(name) or ()):
            proved.add(name)
    doubted = [
        claim
        for claim in claims
        if not {*names.get(claim.id, [""])} <= proved
        or registers.get(claim.id, {}).get("verdict") != "holds"
        or errata.is_noted(claim)
    ]
    ids = by_id(claims)
    rests_on = (*lemmas(ids, doubted), *(name for one in doubted for name in awaited(one.body())))
    shown = [name for claim in doubted for name in names.get(claim.id, ())]
    below = with_below((*rests_on, *tree.name_of_theorem()), ids)
    checked = outcomes_of(DEFAULT, [*shown, *below])
    judged = {one.id: one for one in judge_some(doubted, ids, DEFAULT, checked)}
    register = {claim.id: registered("holds", "", "", "") for claim in claims}
    for name, one in judged.items():
        register[name] = registered(one.verdict.word, one.verdict.detail, "", "")
    findings = {name: one.finding() for name, one in judged.items()}
    settled = {
        name: [(*part, one.certificates[part[0]]) for part in one.statements]
        for name, one in judged.items()
    }
    groups = {claim.id: errata.group_of(claim, register, findings) for claim in claims}
    theorem = tree.theorem_line(store, checked)
    width = line_width(errata.WIDTH + errata.INDENT)
    letters = " ".join(opened().letters.split()) + " "
    head = folded(f"{errata.HEAD}{letters}{errata.NOTES}", width)
    lines = [head, *errata.first_page(claims, register, groups, findings, settled, theorem)]
    for group, title in errata.GROUPS.items():
        members = [claim for claim in claims if groups[claim.id] == group]
        lines.append(f"{title} ({len(members)})\n")
        for claim in members:
            own = settled[claim.id]
            lines += [*errata.entry_of(claim, register, findings[claim.id], own), ""]
    return "\n".join(lines).rstrip("\n")


def tool_versions() -> dict[str, str]:
    """The versions of the libraries that search and vote, and of this project."""
    versions = {}
    for tool in ("juggleproof", *TOOLS):
        try:
            versions[tool] = version(tool)
        except PackageNotFoundError:
            versions[tool] = "not installed"
    return versions


def entry(claim: Claim, judgement: Judgement) -> dict[str, str]:
    """The entry of the register for a judgement."""
    return registered(
        judgement.verdict.word,
        judgement.verdict.detail,
        judgement.correction["text"] if judgement.correction else "",
        table.sharp_range(judgement) if judgement.sharp else "",
    )


def _entry(
    claim: Claim,
    judgement: Judgement,
    by_id: Register,
    store: Store,
    steps: tuple[Derivation, ...],
    reading: str,
) -> Entry:
    finding = judgement.finding()
    group = errata.group_of(claim, by_id, {claim.id: finding})
    return Entry(
        claim,
        judgement.verdict.word,
        judgement.verdict.detail,
        table.verdict_text(claim, judgement),
        table.settled_by(judgement),
        table.sharp_range(judgement),
        reading,
        tuple(
            errata.what_is_wrong(
                by_id[claim.id], finding.get("sharp", {}), errata.passages_of(claim)
            )
        )
        if group and judgement.verdict.word != "holds"
        else (),
        group,
        judgement.correction,
        steps,
        tuple(
            _shown(
                name,
                text,
                judgement.outcomes[name],
                store.certificate(name, text),
                judgement.votes.get(name, ()),
                claim.assumed,
            )
            for name, text in [*judgement.statements]
        ),
        judgement.rests_on,
    )


def _shown(
    name: str,
    text: str,
    outcome: str,
    certificate: object,
    votes: Sequence[Vote],
    assumed: Sequence[Formula] = (),
) -> ShownText:
    refuted = certificate.get("refuted") if isinstance(certificate, dict) else None
    strength = errata.strength_at(text, refuted, assumed) if refuted else UNSEEN
    return ShownText(
        name,
        text,
        outcome,
        certificate,
        errata.counterexample(refuted) if refuted else "",
        errata.numbers_of(text, refuted),
        errata.words_of(text, refuted) + errata.told_outside(assumed, strength),
        {vote.route: vote.answer for vote in votes},
        strength,
    )


def _rules(
    store: Store, checked: Mapping[str, str], votes: Mapping[str, Sequence[Vote]]
) -> tuple[TheoremRule, ...]:
    theorem = opened().theorem
    if theorem is None or theorem.name not in store.texts:
        return ()
    rules, nodes = tree.rules_of(store, [theorem.name]), list[TheoremRule]()
    for name in tree.with_all_below(theorem.name, rules):
        certificate, outcome = (
            store.certificate(name, store.texts[name]),
            checked.get(name, "rejected"),
        )
        certified = certificate.get("certified") if certificate else None
        parts = certified if isinstance(certified, Mapping) else {}
        premises = tuple(
            _shown(
                premise.name, premise.text(), outcome, parts.get(label), votes.get(premise.name, ())
            )
            for label, premise in checker.premises_of(rules[name], rules).items()
        )
        nodes.append(
            TheoremRule(
                name,
                rules[name].kind,
                store.texts[name],
                outcome,
                premises,
                tuple(rests_on(rules[name])),
                tuple(sorted(lemmas_of(certificate))),
            )
        )
    return tuple(nodes)


# -------------------------------------------------------------------------------------------------
# The results as JSON, as `schema.json` beside this file describes it: with versions of tools,
# without dates or machines.

SCHEMA = 2
SCHEMA_FILE = Path(__file__).with_name("schema.json")
PROJECT = Path(__file__).resolve().parents[2] / "pyproject.toml"


def results_of(contents: Contents | RunResults, register: Register | None = None) -> RunResults:
    """The results that reports are made of: the argument itself, or the contents of a report
    converted to results.
    """
    if isinstance(contents, RunResults):
        return contents
    if register is None:
        register = load_register()
    results = [
        ClaimResult(
            one.claim.id,
            one.claim.section,
            one.claim.place,
            table.locator(one.claim),
            table.source_of(one.claim),
            one.claim.says,
            one.claim.printed,
            one.claim.as_it_stands,
            one.claim.repeats,
            one.verdict,
            one.detail,
            one.verdict_text,
            one.settled_by,
            one.sharp or table.no_range(),
            one.correction,
            one.remark,
            tuple(one.wrong),
            one.group,
            tuple(
                table.Stated(
                    shown.name,
                    shown.text,
                    shown.outcome,
                    dict(shown.votes),
                    table.where(shown.outcome, shown.at),
                    shown.words,
                )
                for shown in one.statements
            ),
        )
        for one in contents.entries
    ]
    return table.compared(
        results, register, (), RunResults((), contents.theorem, tuple(contents.votes))
    )


def as_json(contents: Contents | RunResults) -> bytes:
    """The document of a run or of a report's contents, in canonical bytes."""
    return canonical(document(results_of(contents)))


def document(results: RunResults) -> dict[str, Json]:
    """The document as data; every field is described in `schema.json`."""
    verdicts, outcomes, changes = results.verdicts(), results.outcomes(), results.change_of()
    return {
        "$schema": SCHEMA_FILE.name,
        "schema": SCHEMA,
        "tools": tools(),
        "subject": "file" if results.own else "paper",
        "partial": results.partial,
        "exit": results.exit,
        "theorem": (
            {"proved": results.is_proved, "text": results.theorem} if results.theorem else None
        ),
        "counts": {
            "claims": sum(verdicts.values()),
            "verdicts": verdicts,
            "statements": sum(outcomes.values()),
            "outcomes": outcomes,
            "changes": len(changes),
        },
        "votes": list(results.votes),
        "accepted": results.accepted,
        "changes": [_change(change) for change in results.changes],
        "rejected": [{"statement": name, "reason": reason} for name, reason in results.rejected],
        "claims": [_claim(one, changes.get(one.id)) for one in results.claims],
    }


def _claim(one: ClaimResult, change: Change | None) -> dict[str, Json]:
    texts = {
        name: getattr(one, name)
        for name in (
            "id",
            "section",
            "place",
            "locator",
            "says",
            "printed",
            "as_it_stands",
            "repeats",
            "verdict",
            "detail",
            "verdict_text",
            "settled_by",
            "remark",
            "group",
        )
    }
    return {
        **texts,
        "sharp": one.sharp_by_reading(),
        "correction": _correction(one),
        "wrong": list(one.wrong),
        "change": _change(change) if change else None,
        "statements": [
            {
                "name": stated.name,
                "outcome": stated.outcome,
                "votes": dict(stated.votes),
                "counterexample": stated.at or None,
                "text": stated.text,
            }
            for stated in one.statements
        ],
    }


def _correction(one: ClaimResult) -> dict[str, Json] | None:
    if not one.correction:
        return None
    return {
        "text": one.correction["text"],
        "change": one.correction["change"],
        "kind": one.correction["kind"],
        "possible_transcription_error": one.correction["possible transcription error"],
    }


def _change(change: Change) -> dict[str, Json]:
    return {
        "claim": change.claim,
        "before": change.before,
        "after": change.after,
        "text": str(change),
    }


def tools() -> dict[str, str]:
    """The versions of juggleproof, of Python without its patch level, and of the libraries, which
    the checker does not use.
    """
    own = {
        "juggleproof": _own_version(),
        "python": f"{sys.version_info.major}.{sys.version_info.minor}",
    }
    return {**own, **{tool: version(tool) for tool in TOOLS}}


def _own_version() -> str:
    if PROJECT.is_file():  # a checkout, installed or not
        return str(tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]["version"])
    try:
        return version("juggleproof")
    except PackageNotFoundError:
        return "unknown"
