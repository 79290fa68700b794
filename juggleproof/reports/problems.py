"""The answers to problems of SMT-LIB, as a table and as data."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING

from juggleproof.reports.tables import plain
from juggleproof.smtlib.answering import Answered, in_script
from juggleproof.statements.nodes import Json

if TYPE_CHECKING:
    from rich.console import Console

COLUMNS = ("problem", "answer", "settled by")
COLOURS = {"unsat": "green", "sat": "cyan", "unknown": "bold red"}


def settled_by(one: Answered) -> str:
    """The evidence for an answer: a certificate or an exact model; or the reason for unknown."""
    if one.answer.word == "unsat":
        return "certificate"
    if one.answer.word == "unknown":
        return one.answer.reason
    values = in_script(one.answer, one.problem)  # a symbol may have any character
    model = ", ".join(f"{ascii(symbol)[1:-1]} = {value}" for symbol, value in values)
    return "; ".join([f"model {model}" if model else "model", *one.answer.numbers])


def rows(answered: Sequence[Answered]) -> list[tuple[str, str, str]]:
    """The table's rows."""
    return [
        (
            one.name,
            one.answer.word + (f" (stated: {one.problem.status})" if one.contradicts else ""),
            settled_by(one),
        )
        for one in answered
    ]


def draw(answered: Sequence[Answered], console: Console | None = None) -> None:
    """Draws the table on a terminal; prints plain columns, one row a line, elsewhere."""
    if console is None and sys.stdout is not None and sys.stdout.isatty():
        console = import_module("rich.console").Console(highlight=False)
    if console is None or not console.is_terminal:
        print(plain([COLUMNS, *rows(answered)]))
        return
    table = import_module("rich.table").Table(*COLUMNS, header_style="bold")
    for row, one in zip(rows(answered), answered):
        colour = "bold red" if not one.settled else COLOURS[one.answer.word]
        table.add_row(row[0], f"[{colour}]{row[1]}[/{colour}]", row[2].replace("[", r"\["))
    console.print(table)


def summary(answered: Sequence[Answered]) -> str:
    """The number of problems by answer, as text."""
    words = [one.answer.word for one in answered]
    wrong = sum(one.contradicts for one in answered)
    counted = ", ".join(f"{words.count(word)} {word}" for word in ("unsat", "sat", "unknown"))
    return f"{len(answered)} problem{'' if len(answered) == 1 else 's'}: {counted}" + (
        f"; {wrong} not as stated" if wrong else ""
    )


def data(one: Answered) -> dict[str, Json]:
    """An answer as data for other programs."""
    return {
        "file": one.path.name,
        "line": one.problem.line,
        "answer": one.answer.word,
        "stated": one.problem.status,
        "statement": one.answer.text,
        "reason": one.answer.reason,
        "rejected": one.rejected,
        "model": dict(in_script(one.answer, one.problem)) if one.answer.word == "sat" else {},
        "numbers": list(one.answer.numbers),
    }
