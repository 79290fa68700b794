"""Random problems by classes, answered by Z3, cvc5 and us; their table in docs/benchmarks.md.

    python -m juggleproof.benchmarks.classes                # some minutes
    python -m juggleproof.benchmarks.classes --share 8      # one problem in 8, some seconds
    python -m juggleproof.benchmarks.classes --accept       # writes the table into the page
    python -m juggleproof.benchmarks.classes -o DIR         # only writes the scripts

The exit code is 1 if any answer is wrong, or the checker does not take a certificate.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from juggleproof.benchmarks.classes.classes import CLASSES, Made, every_problem
from juggleproof.benchmarks.classes.measuring import Measured, measured, ratios, table
from juggleproof.benchmarks.generated import DOCS, Generated
from juggleproof.coq_store import share_of
from juggleproof.statements.store import write_file

TABLE = Generated(DOCS / "benchmarks.md", "classes")


def write_scripts(problems: Sequence[Made], folder: Path) -> None:
    """Writes each problem as a script that states its status."""
    for one in problems:
        text = f"(set-info :status {one.status})\n{one.script}"
        write_file(folder / one.group.replace(" ", "-") / f"{one.name}.smt2", text.encode())


def undecided(one: Measured) -> str:
    """A line with the class, and those of its problems that we leave open."""
    ours = one.decided("ours")
    left = [problem.name for problem in one.problems if problem.name not in ours]
    return f"{one.group}: {len(ours)} of {len(one.problems)}" + (
        f"; open: {', '.join(left)}" if left else ""
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Asks every solver, and prints the table, or writes it into the page."""
    parser = argparse.ArgumentParser(prog="python -m juggleproof.benchmarks.classes")
    parser.add_argument("--share", type=int, default=1, metavar="N", help="one problem in N")
    parser.add_argument("--only", default="", metavar="CLASS")
    parser.add_argument("--accept", action="store_true")
    parser.add_argument("-o", dest="output", type=Path, metavar="DIR")
    options = parser.parse_args(arguments)
    if options.accept and (options.only or options.share > 1):
        parser.error("--accept goes with all problems")
    problems = every_problem()
    if options.output is not None:
        write_scripts(problems, options.output)
        return 0
    chosen = set(share_of([one.name for one in problems], options.share))
    done = []
    for group in CLASSES:
        asked = [one for one in problems if one.group == group and one.name in chosen]
        if asked and options.only in group:
            done.append(measured(group, asked))
            print(undecided(done[-1]), flush=True)
    text = "\n".join([table(done), "", *ratios(done)])
    print(text)
    faults = [line for one in done for line in one.faults()]
    print("\n".join(faults) or "no answer is wrong")
    if options.accept and not faults:
        TABLE.write(text)
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main())
