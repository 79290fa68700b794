"""`juggleproof check`: the bare checker over a folder, and a line on the theorem."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.command.outputs import busy
from juggleproof.judging.checked import StoreReading
from juggleproof.judging.claims import CheckedApart, claims_in
from juggleproof.papers.paper import opened
from juggleproof.reports.tree import LOST, theorem_line
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import DEFAULT, Store


def command(parsed: argparse.Namespace) -> int:
    """Checks the folder that is named, or the store; returns the exit code."""
    return check(parsed.folder)


def check(folder: Path | None) -> int:
    """Prints the statements that the checker rejects, the counts of outcomes, one line for the
    theorem and, for the paper's store, one line for each claim that another checker certifies.
    Returns 0 where every statement is certified or refuted, the theorem, if the folder has it, is
    proved, and these claims hold; else 1.

    Raises ClaimError, one line, where the folder cannot be read.
    """
    where = folder or DEFAULT
    try:
        with busy("checking"), StoreReading(where, os.cpu_count() or 1) as reading:
            reading.outcomes()
        results = reading.results or checker.check_folder(str(where))
    except checker.Rejected as reason:
        raise ClaimError(
            f"{where}: {reason}; name a folder that `juggleproof certify` wrote"
        ) from None
    code = checker.report(results)
    line = theorem_line(Store(where), {name: outcome for name, outcome, _ in results})
    if line:
        print(line)
    code = max(code, int(line.startswith(LOST)))
    for claim in () if folder else claims_in(opened().checked_apart):
        body = claim.body()
        if isinstance(body, CheckedApart):
            verdict = body.verdict()
            print(body.line(claim.id, verdict))
            code = max(code, int(verdict.word != "holds"))
    return code
