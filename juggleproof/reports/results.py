"""The table of results, and the results of a run as data."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from rich.console import Console
from rich.table import Column, Table

from juggleproof.judging.claims import (
    NOT_FORMALISED,
    VERDICTS,
    Argument,
    Assertion,
    Body,
    CheckedApart,
    Claim,
    Following,
    NotFormalised,
    Readings,
    Simulated,
)
from juggleproof.judging.judgement import Correction, Judgement
from juggleproof.judging.register import Change, Register, differences, registered
from juggleproof.judging.run import Run
from juggleproof.papers.paper import opened
from juggleproof.papers.places import place_of
from juggleproof.reports.errata import (
    counterexample,
    group_of,
    passages_of,
    told,
    what_is_wrong,
    words_of,
)
from juggleproof.reports.tables import plain
from juggleproof.reports.tree import STANDS, theorem_line
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import Store

# -------------------------------------------------------------------------------------------------
# The table of results, as rows of text and as it is drawn on a terminal.

OWN_COLUMNS = ("claim", "place", "verdict", "settled by", "sharp range")


def columns(of_paper: bool = True) -> tuple[str, ...]:
    """The heads of the table; where they are not the paper's, the cells name the parameters."""
    name = opened().parameter if of_paper else ""
    return (*OWN_COLUMNS[:-1], f"{OWN_COLUMNS[-1]} of {name}") if name else OWN_COLUMNS


COLOURS = {
    "holds": "green",
    "misprint": "yellow",
    "false": "red",
    "gap": "magenta",
    "ambiguous": "cyan",
    "simulated": "blue",
    "unknown": "bold red",
}


def counted(outcomes: Mapping[str, str]) -> list[str]:
    """The numbers of statements of a claim with a certificate, with a counterexample, and open, as
    texts; statements of its correction are not counted.

    >>> outcomes = {"a/x": "certified", "a/y": "refuted", "a/z": "certified"}
    >>> counted({**outcomes, "a/corrected.x": "certified"})
    ['2 certificates', '1 counterexample']
    """
    own = [outcome for name, outcome in outcomes.items() if "/corrected." not in name]
    labels = {"certified": "certificate", "refuted": "counterexample", "unknown": "open"}
    counts = [(own.count(word), labels.get(word, word)) for word in OUTCOMES]
    return [
        f"{count} {label}{'s' if count > 1 and label[0] == 'c' else ''}"
        for count, label in counts
        if count
    ]


def settled_by(judgement: Judgement) -> str:
    """The evidence for a verdict: the numbers of certificates and counterexamples, the votes of the
    other routes, map rules, and another checker.
    """
    parts = counted(judgement.outcomes)
    votes = [
        vote for name, cast in judgement.votes.items() if "/corrected." not in name for vote in cast
    ]
    for route in ("z3", "boxes"):
        cast = [vote for vote in votes if vote.route == route]
        decided = sum(vote.answer in ("holds", "fails") for vote in cast)
        parts += [f"{route} {decided}/{len(cast)}"] if cast and decided else []
    parts += [f"rule {name}" for name in judgement.rests_on]
    parts += [judgement.checked_by] if judgement.checked_by else []
    return ", ".join(parts) or "no statement"


NO_OWN_RANGE = "none"


def no_range() -> str:
    """The words in place of a sharp range, for a claim of the paper."""
    return f"no {opened().parameter}" if opened().parameter else NO_OWN_RANGE


def has_range(sharp: str) -> bool:
    """Whether this is a sharp range, and not words in its place.

    >>> has_range("0 < alpha < 1"), has_range("nowhere"), has_range("no alpha"), has_range("none")
    (True, True, False, False)
    """
    return sharp != NO_OWN_RANGE and not re.fullmatch(r"no \w+", sharp)


def is_of_paper(claim: Claim) -> bool:
    """Whether a claim is the paper's, and not a user's."""
    return claim.is_of_package


def locator(claim: Claim) -> str:
    """The place of a claim, as a reader of the paper finds it; for a user's claim, as it states."""
    return place_of(claim) if is_of_paper(claim) else f"{claim.section} {claim.place}".strip()


def source_of(claim: Claim) -> tuple[str, int]:
    """File and line of a claim; the file is relative to this project's tree if it is in it, else to
    the working directory if it is below that.
    """
    file, _, line = claim.where.rpartition(":")
    path = Path(file).absolute()
    tree = Path(__file__).parents[2]
    shown = path.relative_to(tree).as_posix() if path.is_relative_to(tree) else file
    return shown, int(line)


def sharp_range(judgement: Judgement, claim: Claim | None = None) -> str:
    """The sharp range, or that of each reading; where there is none, a text that names the
    parameter only for the paper's claims.
    """
    if not judgement.sharp:
        return no_range() if claim is None or is_of_paper(claim) else NO_OWN_RANGE
    shown = [
        (f"{prefix.rstrip('.')}: " if prefix else "") + one.text
        for prefix, one in judgement.sharp.items()
    ]
    return "; ".join(dict.fromkeys(shown))


def reading_of(body: Body) -> str:
    """The kind of a body, in a few words."""
    if isinstance(body, Assertion):
        return "asserts " + (f"{len(body.parts)} statements" if body.parts[1:] else "one statement")
    if isinstance(body, Readings):
        return "can be read as " + ", or as ".join(body.of)
    if isinstance(body, Following):
        return "the conclusion of " + ", ".join(body.rests_on)
    if isinstance(body, Argument):
        return (
            "argued from "
            + ", ".join(body.steps)
            + (f"; rescued by {body.proved_by}" if body.proved_by else "")
        )
    if isinstance(body, Simulated):
        return "what a simulation shows"
    if isinstance(body, CheckedApart):
        return f"what {body.checker} certifies: {body.believed}"
    if isinstance(body, NotFormalised):
        return "no statement of real arithmetic"
    raise ClaimError("a body of unknown kind")


def verdict_text(claim: Claim, judgement: Judgement) -> str:
    """The verdict with its qualifications."""
    word = judgement.verdict.word
    notes = []
    if claim.repeats and word in ("misprint", "false"):
        notes.append(f"repeats {claim.repeats}")
    if (
        judgement.correction
        and judgement.correction["possible transcription error"]
        or (claim.as_it_stands and word == "holds")
    ):
        notes.append("possible transcription error")
    return word + (f" ({'; '.join(notes)})" if notes else "")


def rows(claims: Sequence[Claim], judgements: Sequence[Judgement]) -> list[tuple[str, ...]]:
    """The table's rows."""
    return [
        (
            claim.id,
            locator(claim).removeprefix("section ") or claim.where,
            verdict_text(claim, judgement),
            settled_by(judgement),
            sharp_range(judgement, claim),
        )
        for claim, judgement in zip(claims, judgements)
    ]


def draw(claims: Sequence[Claim], judgements: Sequence[Judgement], console: Console) -> None:
    """Draws the table on a terminal; prints plain columns, one row a line, elsewhere."""
    heads = columns(any(map(is_of_paper, claims)))
    if not console.is_terminal:
        print(plain([heads, *rows(claims, judgements)]))
        return
    table = Table(Column(heads[0], no_wrap=True), *heads[1:], header_style="bold")
    for row, judgement in zip(rows(claims, judgements), judgements):
        colour = COLOURS[judgement.verdict.word]
        table.add_row(
            row[0],
            row[1].replace("[", r"\["),
            f"[{colour}]{row[2]}[/{colour}]",
            *(cell.replace("[", r"\[") for cell in row[3:]),
        )
    console.print(table)


def _many(count: int, thing: str) -> str:
    return f"{count} {thing}{'' if count == 1 else 's'}"


def counts(found: Sequence[str], words: Iterable[str]) -> str:
    """How often each of the words is found, without those that are not.

    >>> counts(["holds", "false", "holds"], ("holds", "gap", "false"))
    '2 holds, 1 false'
    """
    return ", ".join(f"{found.count(word)} {word}" for word in words if word in found) or "none"


def where_the_proof_breaks(results: RunResults) -> list[str]:
    """A line for each claim that breaks the paper's own proof; none where no claim does."""
    broken = [one for one in results.claims if one.group == "proof"]
    rows = [(f"  {one.id}", one.verdict, one.locator) for one in broken]
    head = "the paper's own proof breaks here; `juggleproof explain ID` shows why"
    return [head, *plain(rows).splitlines()] if broken else []


def summary(judgements: Sequence[Judgement]) -> str:
    """The numbers of claims by verdict, of statements by outcome, and of decided votes by route."""
    verdicts = [judgement.verdict.word for judgement in judgements]
    outcomes = [o for j in judgements for o in j.outcomes.values()]
    lines = [
        f"{_many(len(verdicts), 'claim')}: {counts(verdicts, VERDICTS)}",
        f"{_many(len(outcomes), 'statement')}: {counts(outcomes, OUTCOMES)}",
    ]
    for route in ("z3", "boxes"):
        cast = [
            vote
            for j in judgements
            for votes in j.votes.values()
            for vote in votes
            if vote.route == route
        ]
        asked = [vote for vote in cast if vote.answer != "not applicable"]
        decided, enclosed = (
            sum(vote.answer in words for vote in asked)
            for words in (("holds", "fails"), ("enclosed",))
        )
        if cast:
            lines.append(
                f"{route} votes on record: {decided} decided of {len(asked)} asked"
                + (f", {enclosed} enclosed" if enclosed else "")
            )
    return "\n".join(lines)


# -------------------------------------------------------------------------------------------------
# The results of a run as plain text and data, from which JSON, JUnit, Markdown and the badge are
# made.
#
# They are gathered from a run (`certify`, pytest) or from the contents of a report, and are the
# same for both.

OUTCOMES = ("certified", "refuted", "unknown", "rejected")
NO_VALUES = "every value: the negation is certified"


@dataclass(frozen=True)
class Stated:
    """A statement of a claim: the text that the checker reads, its outcome, the votes by route, the
    counterexample (`at`), and a sentence on it, or the reason why it is open (`words`).
    """

    name: str
    text: str
    outcome: str
    votes: Mapping[str, str]
    at: str = ""
    words: str = ""


@dataclass(frozen=True)
class ClaimResult:
    """The result for a claim; `wrong` and `group` are its faults and its group in the errata;
    `source` is its file and line.
    """

    id: str
    section: str
    place: str
    locator: str
    source: tuple[str, int]
    says: str
    printed: str
    as_it_stands: str
    repeats: str
    verdict: str
    detail: str
    verdict_text: str
    settled_by: str
    sharp: str
    correction: Correction | None
    remark: str
    wrong: tuple[str, ...]
    group: str
    statements: tuple[Stated, ...]

    @property
    def is_open(self) -> bool:
        """Whether the claim is stated but not settled."""
        return self.verdict == "unknown" and not self.detail.startswith(NOT_FORMALISED)

    def registered(self) -> dict[str, str]:
        """The entry of the register for the claim."""
        return registered(
            self.verdict,
            self.detail,
            self.correction["text"] if self.correction else "",
            self.sharp if has_range(self.sharp) else "",
        )

    def sharp_by_reading(self) -> dict[str, str]:
        """The sharp range by reading or step; the name is empty where the claim has one reading."""
        parts = re.split(r"(?:^|; )([\w.\-]+): ", self.sharp)
        if not has_range(self.sharp):
            return {}
        return dict(zip(parts[1::2], parts[2::2])) if len(parts) > 1 else {"": self.sharp}


@dataclass(frozen=True)
class RunResults:
    """The results of a run; `own` says that they are about a user's files, for which there is no
    register.

    `rejected` are statements that the checker rejects, each with the reason; `accepted` says that
    the changes have been written to the register.
    """

    claims: tuple[ClaimResult, ...]
    theorem: str = ""
    votes: tuple[str, ...] = ()
    changes: tuple[Change, ...] = ()
    rejected: tuple[tuple[str, str], ...] = ()
    own: bool = False
    partial: bool = False
    accepted: bool = False

    @property
    def is_proved(self) -> bool:
        """Whether the theorem is proved."""
        return self.theorem.startswith(STANDS)

    @property
    def exit(self) -> int:
        """The exit code of `certify`: 0 where nothing is rejected, and all verdicts are as
        registered, or all claims of a user hold; else 1.
        """
        if self.rejected:
            return 1
        return int(
            any(one.verdict != "holds" for one in self.claims)
            if self.own
            else bool(self.changes) and not self.accepted
        )

    def verdicts(self) -> dict[str, int]:
        """The number of claims by verdict."""
        counts = Counter(one.verdict for one in self.claims)
        return {word: counts[word] for word in VERDICTS}

    def outcomes(self) -> dict[str, int]:
        """The number of statements by outcome."""
        counts = Counter(stated.outcome for one in self.claims for stated in one.statements)
        return {word: counts[word] for word in OUTCOMES}

    def change_of(self) -> dict[str, Change]:
        """The changes by claim."""
        return {change.claim: change for change in self.changes}


def theorem_of_run(done: Run) -> str:
    """The line about the theorem after a run, with the run's votes."""
    votes = {name: cast for one in done.judgements for name, cast in one.votes.items()}
    return theorem_line(Store(done.store), done.outcomes, votes)


def results_of_run(
    claims: Sequence[Claim],
    judgements: Sequence[Judgement],
    register: Register | None,
    *,
    theorem: str = "",
    rejected: Sequence[tuple[str, str]] = (),
    partial: bool = False,
    accepted: bool = False,
) -> RunResults:
    """The results of judgements; without a register they are about a user's claims."""
    findings = {one.id: one.finding() for one in judgements}
    judged_claims = [_result(claim, judged) for claim, judged in zip(claims, judgements)]
    entries = {**(register or {}), **{one.id: one.registered() for one in judged_claims}}
    grouped = [
        replace(
            one,
            group=group_of(claim, entries, findings),
            wrong=(
                ()
                if one.verdict in ("holds", "simulated", "unknown")
                else tuple(
                    what_is_wrong(entries[one.id], findings[one.id]["sharp"], passages_of(claim))
                )
            ),
        )
        for claim, one in zip(claims, judged_claims)
    ]
    return compared(
        grouped,
        register,
        rejected,
        RunResults(
            (),
            theorem,
            tuple(summary(judgements).splitlines()[2:]),
            own=register is None,
            partial=partial,
            accepted=accepted,
        ),
    )


def _result(claim: Claim, judged: Judgement) -> ClaimResult:
    def at(name: str) -> str:
        certificate = judged.certificates[name]
        return counterexample(certificate["refuted"]) if judged.outcomes[name] == "refuted" else ""

    def words(name: str, text: str) -> str:
        certificate = judged.certificates[name]
        if judged.outcomes[name] == "refuted":
            return words_of(text, certificate["refuted"], is_of_paper(claim))
        return certificate.get("unknown") or ""

    statements = tuple(
        Stated(
            name,
            text,
            judged.outcomes[name],
            {vote.route: vote.answer for vote in judged.votes.get(name, ())},
            where(judged.outcomes[name], at(name)),
            words(name, text),
        )
        for name, text in judged.statements
    )
    return ClaimResult(
        claim.id,
        claim.section,
        claim.place,
        locator(claim),
        source_of(claim),
        claim.says,
        claim.printed,
        claim.as_it_stands,
        claim.repeats,
        judged.verdict.word,
        judged.verdict.detail,
        verdict_text(claim, judged),
        settled_by(judged),
        sharp_range(judged, claim),
        judged.correction,
        told(claim.remark) if claim.remark else "",
        (),
        "",
        statements,
    )


def where(outcome: str, at: str) -> str:
    """The text on where a statement fails: its counterexample `at`; empty unless it is refuted."""
    return (at or NO_VALUES) if outcome == "refuted" else ""


def compared(
    results: Sequence[ClaimResult],
    register: Register | None,
    rejected: Sequence[tuple[str, str]],
    about: RunResults,
) -> RunResults:
    """The results `about` a run with these claims: those with rejected statements become unknown,
    the changes from the register are added, and characters that no file can hold are replaced.
    """
    reasons = dict(rejected)
    claims = tuple(_written(_without(one, reasons)) for one in results)
    changes = (
        ()
        if register is None
        else tuple(
            differences(register, {one.id: one.registered() for one in claims}, about.partial)
        )
    )
    return replace(about, claims=claims, changes=changes, rejected=tuple(reasons.items()))


def _without(one: ClaimResult, reasons: Mapping[str, str]) -> ClaimResult:
    """The result, which becomes unknown where the checker rejects statements of the claim."""
    lost = [stated.name for stated in one.statements if stated.name in reasons]
    if not lost:
        return one
    statements = tuple(
        replace(stated, outcome="rejected", at="") if stated.name in reasons else stated
        for stated in one.statements
    )
    return replace(
        one,
        verdict="unknown",
        verdict_text="unknown",
        detail=f"the checker rejects {lost[0]}: {reasons[lost[0]]}",
        correction=None,
        sharp=no_range(),
        wrong=(),
        group="",
        statements=statements,
    )


def _written(one: ClaimResult) -> ClaimResult:
    """The result with `writable` texts, since the docstring of a claim may have any characters."""
    texts = {name: writable(value) for name, value in vars(one).items() if isinstance(value, str)}
    return ClaimResult(**(vars(one) | texts))


def writable(text: str) -> str:
    """The text with the characters replaced that XML or UTF-8 cannot hold.

    >>> writable("a" + chr(1) + "b" + chr(0xd800))
    'a\ufffdb\ufffd'
    """
    return re.sub(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "\ufffd", text)
