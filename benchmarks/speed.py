"""Whole commands, each in a process of its own: CPU seconds and peak memory, beside the aims.

    python -m juggleproof.benchmarks.speed [--runs 3] [--only TEXT]
    python -m juggleproof.benchmarks.speed --accept     # writes the table into the page

Figures kept from an earlier run are not used.
"""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from juggleproof.benchmarks.generated import DOCS, Generated
from juggleproof.proofs.reports.tables import plain

ROOT = Path(__file__).resolve().parents[1]
TABLE = Generated(DOCS / "benchmarks.md", "speed")
THEOREM = "--only theorem-roots --only theorem"


class Timed(NamedTuple):
    """A command as a user writes it, DIR an empty folder, and the CPU seconds that it may take."""

    command: str
    aim: float | None = None
    needs: str = ""  # a program


COMMANDS = (
    Timed("juggleproof --help", 0.15),
    Timed("juggleproof certify --jobs 1", 1.5),
    Timed("juggleproof certify --jobs 1 --fresh --routes exact --store DIR", 12.0),
    Timed("juggleproof certify --jobs 1 --fresh --store DIR", 20.0),
    Timed(f"juggleproof certify --jobs 1 --fresh --routes exact {THEOREM} --store DIR", 2.0),
    Timed("python -I -S certificates/checker", 1.0),
    Timed("juggleproof check"),
    Timed("juggleproof list"),
    Timed("juggleproof explain eq-37"),
    Timed("juggleproof explain theorem --alpha 3/10 --state x=1000,w=-41"),
    Timed("juggleproof errata"),
    Timed('juggleproof bound "x^2 - x*y + y^2/2" --box x=-1..1,y=0..1 --width 0'),
    Timed("juggleproof stability examples/lozi.map", 10.0),
    Timed("juggleproof export smt2 eq-37"),
    Timed("juggleproof export coq eq-37"),
    Timed("juggleproof export coq tests/proofs/coq/maps.py -o DIR"),
    Timed("juggleproof export latex eq-37"),
    Timed("juggleproof report --format json -o DIR"),
    Timed("juggleproof report --format markdown -o DIR"),
    Timed("juggleproof report --format badge -o DIR"),
    Timed("juggleproof report --format latex -o DIR"),
    Timed("juggleproof report --format figures -o DIR"),
    Timed("juggleproof report --format html -o DIR"),
    Timed("juggleproof report --format pdf -o DIR", None, "latexmk"),
    Timed("juggleproof simulate juggler --alpha 3/10 --state x=1000,w=-41"),
    Timed(
        "juggleproof simulate juggler --alpha 3/10 --state x=1,w=-1 --picture orbit -o DIR/o.svg"
    ),
    Timed("juggleproof simulate juggler --alpha 1/2 --picture basin -o DIR/basin.svg"),
    Timed("juggleproof simulate juggler --picture bifurcation -o DIR/bifurcation.svg"),
    Timed("juggleproof simulate part --ensembles 2 --jobs 1"),
    Timed("juggleproof bench --quick -o DIR"),
    Timed("make -s coq", 20.0, "coqc"),
)


def measure(arguments: Sequence[str]) -> tuple[float, float]:
    """CPU seconds of a command with all its processes, and peak megabytes of the largest.

    Raises RuntimeError where it cannot be carried out.
    """
    process = subprocess.Popen(
        arguments,
        cwd=ROOT,
        env={**os.environ, "JUGGLEPROOF_CACHE": "off"},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 1):
        raise RuntimeError(f"{shlex.join(arguments)}: exit code {process.returncode}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def arguments_of(command: str, folder: str) -> list[str]:
    """What is run for a command, in this environment."""
    ours = [sys.executable, "-m", "juggleproof.proofs.command.main"]
    head, *rest = shlex.split(command.replace("DIR", folder))
    return [*({"juggleproof": ours, "python": [sys.executable]}.get(head, [head])), *rest]


def table(runs: int, only: str = "") -> str:
    """The commands, or those that contain a text, with the median of their CPU seconds over so many
    runs, as plain columns.
    """
    rows = [("CPU s", "aim", "MB", "command")]
    for one in COMMANDS:
        if only not in one.command or one.needs and not shutil.which(one.needs):
            continue
        measured = []
        for _ in range(runs):
            with tempfile.TemporaryDirectory() as folder:
                measured.append(measure(arguments_of(one.command, folder)))
        seconds = statistics.median(spent for spent, _ in measured)
        megabytes = max(most for _, most in measured)
        aim = "" if one.aim is None else f"{one.aim:g}"
        rows.append((f"{seconds:.2g}", aim, f"{megabytes:.0f}", one.command))
        print(*rows[-1], sep="\t", file=sys.stderr, flush=True)
    return plain(rows)


def main() -> None:
    """Prints the table, or writes it into the page."""
    parser = argparse.ArgumentParser(prog="python -m juggleproof.benchmarks.speed")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--only", default="", metavar="TEXT")
    parser.add_argument("--accept", action="store_true")
    options = parser.parse_args()
    if options.only and options.accept:
        parser.error("--accept goes with the whole table")
    done = table(options.runs, options.only)
    if options.accept:
        TABLE.write(f"```text\n{done}\n```")
    else:
        print(done)


if __name__ == "__main__":
    main()
