"""`juggleproof check`: the bare checker over a folder, and what it means for the theorem."""

from __future__ import annotations

import argparse
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.certificates.language import ClaimError
from juggleproof.certificates.sine.stored import LOST as sine_lost
from juggleproof.certificates.sine.stored import sine_line
from juggleproof.certificates.store import DEFAULT, Store
from juggleproof.proofs.command.outputs import busy
from juggleproof.proofs.reports.tree import LOST, theorem_line


def command(parsed: argparse.Namespace) -> int:
    """Checks the folder that is named, or the store; returns the exit code."""
    return check(parsed.folder)


def check(folder: Path | None) -> int:
    """Prints what the checker rejects, the counts of outcomes, and one line for the theorem; 0
    where every statement is certified or refuted, and the theorem, if it is there, proved; else 1.

    Raises ClaimError, one line, where the folder cannot be read.
    """
    where = folder or DEFAULT
    try:
        with busy("checking"):
            results = checker.check_folder(str(where))
    except checker.Rejected as reason:
        raise ClaimError(
            f"{where}: {reason}; name a folder that `juggleproof certify` wrote"
        ) from None
    code = checker.report(results)
    line = theorem_line(Store(where), {name: outcome for name, outcome, _ in results})
    if line:
        print(line)
    sine = "" if folder else sine_line()
    if sine:
        print(sine)
    return max(code, int(line.startswith(LOST)), int(sine.startswith(sine_lost)))
