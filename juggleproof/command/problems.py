"""`juggleproof certify FILE.smt2 ...`: answers every problem of the scripts, and shows the
certificate or model for each answer.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from juggleproof.command.outputs import asked_of, refuse_unwritable
from juggleproof.judging import limits
from juggleproof.reports import problems
from juggleproof.smtlib.answering import Answered, answer_files
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import canonical, write_file


class ProblemOptions(argparse.Namespace):
    """The options of `juggleproof certify` for scripts; 0 stands for the default."""

    files: list[Path]
    fresh: bool
    jobs: int
    budget: int
    store: Path | None
    json: Path | None


def command(parsed: argparse.Namespace) -> int:
    """Answers the scripts; returns the exit code."""
    return certify(ProblemOptions(**vars(parsed)))


NOT_FOR_SCRIPTS = (
    "only",
    "rederive",
    "accept",
    "revote",
    "junit",
    "markdown",
    "timings",
    "report",
    "output",
)


def certify(options: ProblemOptions) -> int:
    """Answers the problems; returns 0 where all are answered as the scripts state, else 1.  Raises
    ClaimError for an option that goes with claims only.
    """
    for option in NOT_FOR_SCRIPTS:
        if getattr(options, option):
            raise ClaimError(f"--{option}: not for scripts of SMT-LIB; leave it out")
    refuse_unwritable(options.files, asked_of(options))
    answered = _answered(options)
    problems.draw(answered)
    for one in answered:
        if one.contradicts:
            print(
                f"CONTRADICTS {one.problem.place}: the script states"
                f" {one.problem.status}, but it is {one.answer.word}, by what the checker accepted"
            )
        if one.rejected:
            print(f"rejected by the checker: {one.answer.name}: {one.rejected}")
    print(problems.summary(answered))
    if options.json is not None:
        write_file(
            options.json, canonical({one.answer.name: problems.data(one) for one in answered})
        )
    return int(not all(one.settled for one in answered))


def _answered(options: ProblemOptions) -> list[Answered]:
    return answer_files(
        options.files,
        budget=options.budget or limits.DEFAULT_BUDGET,
        store=options.store,
        fresh=options.fresh,
        jobs=options.jobs if options.jobs > 0 else os.cpu_count() or 1,
    )
