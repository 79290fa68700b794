"""`juggleproof certify FILE.smt2 ...`: answers every problem of the scripts, and shows what settles
each.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from certificates.store import canonical, write_file
from certificates.terms import ClaimError
from proofs.command import outputs
from proofs.running import start, stop
from proofs.smtlib.answering import BUDGET, in_script
from proofs.smtlib.running import Answered, answer_files

COLUMNS = ("problem", "answer", "settled by")
COLOURS = {"unsat": "green", "sat": "cyan", "unknown": "bold red"}
SUFFIX = ".smt2"
NOT_FOR_SCRIPTS = ("only", "accept", "junit", "markdown", "timings")


def are_scripts(files: Sequence[Path]) -> bool:
    """Whether the files are scripts of SMT-LIB; raises ClaimError where some are and others are
    not.
    """
    scripts = [path for path in files if path.suffix == SUFFIX]
    if scripts and len(scripts) < len(files):
        other = next(path for path in files if path.suffix != SUFFIX)
        raise ClaimError(f"{other}: beside scripts of SMT-LIB; certify files of one kind at a time")
    return bool(scripts)


def certify_problems(options: argparse.Namespace) -> int:
    """Answers the problems; 0 where all are answered, and as the scripts state, else 1."""
    from rich.console import Console

    for option in NOT_FOR_SCRIPTS:
        if getattr(options, option):
            raise ClaimError(f"--{option}: not for scripts of SMT-LIB; leave it out")
    outputs.refuse_unwritable(options)
    answered = _answered(options)
    draw(answered, Console(highlight=False))
    for one in answered:
        if one.contradicts:
            print(
                f"CONTRADICTS {one.problem.file}:{one.problem.line}: the script states"
                f" {one.problem.status}, but it is {one.answer.word}, by what the checker accepted"
            )
        if one.rejected:
            print(f"rejected by the checker: {one.answer.name}: {one.rejected}")
    print(summary(answered))
    if options.json is not None:
        write_file(options.json, canonical({one.answer.name: data(one) for one in answered}))
    return int(not all(one.settled for one in answered))


def _answered(options: argparse.Namespace) -> list[Answered]:
    jobs = options.jobs if options.jobs > 0 else os.cpu_count() or 1
    budget = options.budget or BUDGET
    if jobs == 1:
        return answer_files(options.files, budget=budget, store=options.store, fresh=options.fresh)
    with ProcessPoolExecutor(jobs, mp_context=get_context("fork"), initializer=start) as pool:
        try:
            return answer_files(
                options.files,
                budget=budget,
                store=options.store,
                fresh=options.fresh,
                executor=pool,
            )
        except ClaimError:
            raise
        except BaseException:
            stop(pool)
            raise


def settled_by(one: Answered) -> str:
    """What settles a problem: a certificate, an exact model, or why nothing does."""
    if one.answer.word == "unsat":
        return "certificate"
    if one.answer.word == "unknown":
        return one.answer.reason
    model = ", ".join(f"{symbol} = {value}" for symbol, value in in_script(one.answer, one.problem))
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


def draw(answered: Sequence[Answered], console: Any) -> None:
    """Draws the table on a terminal; plain columns, one row a line, where there is none."""
    from rich.table import Table

    if not console.is_terminal:
        everything = [COLUMNS, *rows(answered)]
        widths = [max(len(row[i]) for row in everything) for i in range(len(COLUMNS))]
        for row in everything:
            print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
        return
    table = Table(*COLUMNS, header_style="bold")
    for row, one in zip(rows(answered), answered):
        colour = "bold red" if not one.settled else COLOURS[one.answer.word]
        table.add_row(row[0], f"[{colour}]{row[1]}[/{colour}]", row[2].replace("[", r"\["))
    console.print(table)


def summary(answered: Sequence[Answered]) -> str:
    """How many problems have which answer."""
    words = [one.answer.word for one in answered]
    wrong = sum(one.contradicts for one in answered)
    counted = ", ".join(f"{words.count(word)} {word}" for word in ("unsat", "sat", "unknown"))
    return f"{len(answered)} problem{'' if len(answered) == 1 else 's'}: {counted}" + (
        f"; {wrong} not as stated" if wrong else ""
    )


def data(one: Answered) -> dict[str, Any]:
    """An answer for other programs."""
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
