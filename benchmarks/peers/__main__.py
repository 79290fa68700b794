"""Every stored statement of the paper, side by side: our search with its check, our check alone,
Z3, cvc5 with and without its proof, QEPCAD B, Coq's nra and psatz, Coq on the exported store.

    python -m juggleproof.benchmarks.peers [--share 12] [--seconds 3] [--plot FILE.svg]

Exit 1 where an answer is not what the checker says of the stored certificate.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from juggleproof import coq_store as coq
from juggleproof.benchmarks.figures import ABSENT, can_plot
from juggleproof.benchmarks.peers.routes import (
    Problem,
    Route,
    is_expanded_away,
    problems,
    routes,
)
from juggleproof.benchmarks.peers.table import Measured, notes, plot, ratios, table, wrong
from juggleproof.benchmarks.processes import children_seconds
from juggleproof.statements.store import DEFAULT, Store, write_file

PLOT = Path("build/peers.svg")
NOTES = """\
All seconds are CPU seconds, user and system.  median, most, sum: of single statements, also of \
those given up; rest: what the processes of
the route used beside that, to start and to write what is asked.  A process that starts for one \
question is counted with it; Coq gives the seconds of single statements to the millisecond.
wrong: not what the checker says of the stored certificate.  Nobody but cvc5 reads its proof here: \
Carcara and Ethos, which could read it,
are neither in Debian nor on PyPI."""
RATIOS = """
CPU seconds as multiples of ours, over the statements that both decide (below 1: ours is slower):\
"""


def measured(route: Route, asked: Sequence[Problem], seconds: float) -> Measured:
    """The results of a route on all statements.  Raises ChildProcessError where it leaves one
    out.
    """
    before = children_seconds()
    results = {result.name: result for result in route.run(asked, seconds)}
    if results.keys() != {problem.name for problem in asked}:
        raise ChildProcessError(f"{route.title} has not answered on every statement")
    return Measured(route, results, children_seconds() - before)


def main(arguments: Sequence[str] | None = None) -> int:
    """Asks every route that is present, and prints the table, the ratios and what is wrong."""
    parser = argparse.ArgumentParser(prog="python -m juggleproof.benchmarks.peers")
    parser.add_argument("--share", type=int, default=1, metavar="N", help="one statement in N")
    parser.add_argument(
        "--seconds", type=float, default=3.0, help="CPU seconds for a statement, at least"
    )
    parser.add_argument("--plot", type=Path, default=PLOT, metavar="FILE.svg")
    options = parser.parse_args(arguments)
    every = problems(Store(DEFAULT))
    names = set(coq.share_of([problem.name for problem in every], options.share))
    asked = [problem for problem in every if problem.name in names]
    print(f"{len(asked)} of {len(every)} statements, {options.seconds:g} CPU s for each\n")
    done = []
    for route in routes():
        if route.present:
            print(f"{route.title} ...", file=sys.stderr, flush=True)
            done.append(measured(route, asked, options.seconds))
    print(table(asked, done) + "\n\n" + NOTES + "\n\n" + "\n".join(notes(done)))
    expanded = sum(map(is_expanded_away, asked))
    print(f"\nexpanding their polynomials leaves nothing to ask the peers: {expanded} statements")
    print(RATIOS)
    for one in done:
        if one.route.ours:
            print("\n" + ratios(done, one))
    absent = dict.fromkeys(route.package for route in routes() if not route.present)
    print("\nabsent: " + (", ".join(absent) or "none"))
    if can_plot():
        write_file(options.plot, plot(done))
        print(f"plot: {options.plot}")
    else:
        print(ABSENT)
    faults = wrong(asked, done)
    print("\n".join(faults) or "every answer is what the checker says of the stored certificate")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
