"""The table of results, as rows of text and as it is drawn on a terminal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from proofs.claims import Claim
from proofs.command.columns import plain
from proofs.judging import Judgement

COLUMNS = ("claim", "place", "verdict", "settled by", "sharp range of alpha")
COLOURS = {
    "holds": "green",
    "misprint": "yellow",
    "false": "red",
    "gap": "magenta",
    "ambiguous": "cyan",
    "unknown": "bold red",
}


def settled_by(judgement: Judgement) -> str:
    """How a claim was settled: certificates, counterexamples, and the votes of the other routes."""
    own = {
        name: outcome for name, outcome in judgement.outcomes.items() if "/corrected." not in name
    }
    counts = [
        (sum(o == word for o in own.values()), label)
        for word, label in (
            ("certified", "certificate"),
            ("refuted", "counterexample"),
            ("unknown", "open"),
        )
    ]
    parts = [
        f"{count} {label}{'s' if count > 1 and label != 'open' else ''}"
        for count, label in counts
        if count
    ]
    votes = [
        vote for name, cast in judgement.votes.items() if "/corrected." not in name for vote in cast
    ]
    for route in ("z3", "boxes"):
        cast = [vote for vote in votes if vote.route == route]
        decided = sum(vote.answer in ("holds", "fails") for vote in cast)
        parts += [f"{route} {decided}/{len(cast)}"] if cast and decided else []
    parts += [f"rule {name}" for name in judgement.rests_on]
    return ", ".join(parts) or "no statement"


def sharp_range(judgement: Judgement) -> str:
    """The sharp range, or each reading's."""
    if not judgement.sharp:
        return "no alpha"
    shown = [
        (f"{prefix.rstrip('.')}: " if prefix else "") + one["text"]
        for prefix, one in judgement.sharp.items()
    ]
    return "; ".join(dict.fromkeys(shown))


def verdict_text(claim: Claim, judgement: Judgement) -> str:
    """The verdict with what must be said beside it."""
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
            f"{claim.section} {claim.place}".strip(),
            verdict_text(claim, judgement),
            settled_by(judgement),
            sharp_range(judgement),
        )
        for claim, judgement in zip(claims, judgements)
    ]


def draw(claims: Sequence[Claim], judgements: Sequence[Judgement], console: Any) -> None:
    """Draws the table on a terminal; plain columns, one row a line, where there is none."""
    from rich.table import Table

    if not console.is_terminal:
        print(plain([COLUMNS, *rows(claims, judgements)]))
        return
    table = Table(*COLUMNS, header_style="bold")
    for row, judgement in zip(rows(claims, judgements), judgements):
        colour = COLOURS[judgement.verdict.word]
        table.add_row(
            row[0],
            row[1],
            f"[{colour}]{row[2]}[/{colour}]",
            *(cell.replace("[", r"\[") for cell in row[3:]),
        )
    console.print(table)


def _many(count: int, thing: str) -> str:
    return f"{count} {thing}{'' if count == 1 else 's'}"


def summary(judgements: Sequence[Judgement]) -> str:
    """Counts of claims by verdict, of statements by outcome, and of decided votes by route."""
    words = ("holds", "misprint", "false", "gap", "ambiguous", "unknown")
    verdicts = [f"{sum(j.verdict.word == word for j in judgements)} {word}" for word in words]
    outcomes = [o for j in judgements for o in j.outcomes.values()]
    counted = ", ".join(
        f"{outcomes.count(word)} {word}" for word in ("certified", "refuted", "unknown")
    )
    lines = [
        f"{_many(len(judgements), 'claim')}: {', '.join(verdicts)}",
        f"{_many(len(outcomes), 'statement')}: {counted}",
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
                f"{route} votes: {decided} decided of {len(asked)} asked"
                + (f", {enclosed} enclosed" if enclosed else "")
            )
    return "\n".join(lines)
