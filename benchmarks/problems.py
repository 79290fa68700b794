"""The set of problems in benchmarks/problems, twelve scripts of SMT-LIB: answered by us, voted on
by Z3 and cvc5, and counted in docs/your-own.md.

    python -m juggleproof.benchmarks.problems               # answers all of them afresh
    python -m juggleproof.benchmarks.problems --accept      # writes the counts into the page
    python -m juggleproof.benchmarks.problems --votes 10    # also asks Z3 and cvc5, 10 CPU s each

The exit code is 1 if a problem is open or not as stated, the page differs, or a solver contradicts
an answer.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

from rich.console import Console

from juggleproof.benchmarks.classes.classes import Made
from juggleproof.benchmarks.classes.measuring import OUTCOMES, cvc5, z3
from juggleproof.benchmarks.generated import DOCS, Generated
from juggleproof.benchmarks.processes import each
from juggleproof.reports.problems import draw, summary
from juggleproof.smtlib.answering import Answered, answer_files
from juggleproof.smtlib.script import Problem

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "benchmarks/problems"
COUNTS = Generated(DOCS / "your-own.md", "problems")


def scripts() -> list[Path]:
    """The scripts of the set, by name."""
    return sorted(FOLDER.glob("*.smt2"))


def answered(paths: Sequence[Path]) -> list[Answered]:
    """The problems of the scripts, answered afresh at the default budget; no certificates are
    kept.
    """
    with tempfile.TemporaryDirectory() as folder:
        return answer_files(paths, store=Path(folder), fresh=True)


def counts(done: Sequence[Answered]) -> str:
    """The counts that stand in the page.

    >>> counts(answered([FOLDER / "cases.smt2"]))  # doctest: +NORMALIZE_WHITESPACE
    '6 problems, stated unsat 3 and sat 3: 6 answered as stated and accepted by the checker, 0 open,
    0 otherwise.'
    """
    stated = [one.problem.status for one in done]
    open_, otherwise = (
        sum(one.answer.word == "unknown" for one in done),
        sum(one.contradicts or bool(one.rejected) for one in done),
    )
    return (
        f"{len(done)} problem{'s' * (len(done) > 1)}, stated unsat {stated.count('unsat')} and sat"
        f" {stated.count('sat')}: {sum(one.settled for one in done)} answered as stated and"
        f" accepted by the checker, {open_} open, {otherwise} otherwise."
    )


SOLVERS = {"z3": z3, "cvc5": cvc5}


def votes(peer: str, problems: Sequence[Problem], seconds: float) -> list[str]:
    """The answers of Z3 or cvc5 to scripts of each problem alone: sat, unsat or unknown."""

    asked = [Made("", one.name, one.status or "", one.script) for one in problems]
    done = each(SOLVERS[peer], asked, seconds)
    words = [one.answer.word if one.answer else "unknown" for one in done]
    return [word if word in OUTCOMES else "unknown" for word in words]


def peers() -> list[str]:
    """The solvers that are installed."""
    return [peer for peer in SOLVERS if find_spec(peer)]


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the set as the options say."""
    parser = argparse.ArgumentParser(prog="python -m juggleproof.benchmarks.problems")
    parser.add_argument("--accept", action="store_true")
    parser.add_argument("--votes", type=float, default=0.0, metavar="SECONDS")
    options = parser.parse_args(arguments)
    paths = scripts()
    done = answered(paths)
    draw(done, Console(highlight=False))
    print(summary(done))
    counted, wrong = counts(done), sum(not one.settled for one in done)
    if options.accept:
        COUNTS.write(counted)
    elif COUNTS.text() != counted:
        print(f"{COUNTS.page.name} says {COUNTS.text()!r}, but: {counted}")
        wrong += 1
    for peer in peers() if options.votes else []:
        words = votes(peer, [one.problem for one in done], options.votes)
        against = [
            one.name
            for one, word in zip(done, words)
            if word != "unknown" and word != one.problem.status
        ]
        print(
            f"{peer}: {sum(word != 'unknown' for word in words)} of {len(done)} decided in"
            f" {options.votes:g} CPU s each"
            + (f"; CONTRADICTS {', '.join(against)}" if against else "")
        )
        wrong += len(against)
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
