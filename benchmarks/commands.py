"""Whole commands, each in a process of its own: their CPU time, as a multiple of the time of
`import sympy` in the same run, and their peak memory, beside the aims.

    python -m juggleproof.benchmarks.commands [--runs 3] [--only TEXT]
    python -m juggleproof.benchmarks.commands --check      # fails above twice an aim
    python -m juggleproof.benchmarks.commands --accept     # writes the table into the page

Results that an earlier command has kept are used where the table says `again`, and nowhere else.
"""

from __future__ import annotations

import argparse
import math
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
from juggleproof.reports.tables import plain

ROOT = Path(__file__).resolve().parents[1]
TABLE = Generated(DOCS / "benchmarks.md", "commands")
THEOREM = "--only theorem-roots --only theorem"
UNIT = ("-c", "import sympy")  # takes 0.4 CPU seconds on a quiet machine
TOO_MUCH = 2  # times the aim, above which `--check` fails
OWN = """from juggleproof import always, claim, reals
x, y = reals("x y")
@claim("squares")
def product_below_squares():
    "The product is at most half of the sum of squares."
    return always(2 * x * y <= x**2 + y**2)
"""


class Timed(NamedTuple):
    """A command as a user writes it, DIR an empty folder with a file `own.py` of one claim, and the
    multiple of `import sympy` that it may take.
    """

    command: str
    aim: float | None = None
    needs: str = ""  # a program
    again: bool = False  # measured after a first run, with the results that this has kept


COMMANDS = (
    Timed("juggleproof --help", 0.3),
    Timed("juggleproof list", 0.5),
    Timed("juggleproof list --json", 0.5),
    Timed("juggleproof explain eq-37", 2),
    Timed("juggleproof export latex eq-37", 2),
    Timed("juggleproof explain theorem", 3),
    Timed("juggleproof errata", 6.25),
    Timed("python -I -S certificates/checker", 7.5),
    Timed("juggleproof check", 9),
    Timed("juggleproof certify DIR/own.py", 0.75),
    Timed("juggleproof certify --jobs 1", 12.5),
    Timed("juggleproof certify --jobs 1 --fresh --routes exact --store DIR", 125),
    Timed("juggleproof certify --jobs 1 --fresh --store DIR", 175),
    Timed(f"juggleproof certify --jobs 1 --fresh --routes exact {THEOREM} --store DIR"),
    Timed("juggleproof explain theorem --alpha 3/10 --state x=1000,w=-41"),
    Timed('juggleproof bound "x^2 - x*y + y^2/2" --box x=-1..1,y=0..1 --width 0'),
    Timed("juggleproof stability examples/lozi.map"),
    Timed("juggleproof export smt2 eq-37"),
    Timed("juggleproof export coq eq-37"),
    Timed("juggleproof export coq tests/proofs/coq/maps.py -o DIR"),
    Timed("juggleproof report --format json -o DIR"),
    Timed("juggleproof report --format markdown -o DIR"),
    Timed("juggleproof report --format badge -o DIR"),
    Timed("juggleproof report --format latex -o DIR"),
    Timed("juggleproof report --format figures -o DIR"),
    Timed("juggleproof report --format html -o DIR"),
    Timed("juggleproof report --format html -o DIR", 10, again=True),
    Timed("juggleproof report --format pdf -o DIR", None, "latexmk"),
    Timed("juggleproof simulate juggler --alpha 3/10 --state x=1000,w=-41"),
    Timed(
        "juggleproof simulate juggler --alpha 3/10 --state x=1,w=-1 --picture orbit -o DIR/o.svg"
    ),
    Timed("juggleproof simulate juggler --alpha 1/2 --picture basin -o DIR/basin.svg"),
    Timed("juggleproof simulate juggler --picture bifurcation -o DIR/bifurcation.svg"),
    Timed("juggleproof simulate part --ensembles 2 --jobs 1", 20),
    Timed("juggleproof bench --quick -o DIR"),
    Timed("make -s coq", None, "coqc"),
)


def measure(arguments: Sequence[str], kept: str = "off") -> tuple[float, float]:
    """CPU seconds of a command with all its processes, and peak megabytes of the largest; `kept` is
    the folder in which commands keep results.

    Raises RuntimeError if the command cannot be carried out.
    """
    environment = {**os.environ, "JUGGLEPROOF_CACHE": kept}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    process = subprocess.Popen(
        arguments,
        cwd=ROOT,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 1):
        raise RuntimeError(f"{shlex.join(arguments)}: exit code {process.returncode}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def arguments_of(command: str, folder: str) -> list[str]:
    """The program and arguments that are run for a command, in this environment."""
    ours = [sys.executable, "-m", "juggleproof.command.main"]
    head, *rest = shlex.split(command.replace("DIR", folder))
    return [*({"juggleproof": ours, "python": [sys.executable]}.get(head, [head])), *rest]


def measure_in_folder(one: Timed) -> tuple[float, float]:
    """CPU seconds and peak megabytes of a command in an empty folder; of the second run if it is to
    be run again.
    """
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as kept:
        Path(folder, "own.py").write_text(OWN, encoding="utf-8")
        arguments = arguments_of(one.command, folder)
        if one.again:
            measure(arguments, kept)
        return measure(arguments, kept if one.again else "off")


def table(runs: int, only: str = "", check: bool = False) -> tuple[str, list[str]]:
    """The commands, or those that contain a text, with the least multiple of `import sympy` that
    they take in some runs, as plain columns; and a line for each that takes over twice its aim.
    If `check`, commands without an aim are left out, and no run follows one that passes.  So are
    fresh searches: the record of `make exhaust` has their seconds, claim by claim.
    """
    rows, over = [("x sympy", "aim", "MB", "command")], list[str]()
    for one in COMMANDS:
        if only not in one.command or one.needs and not shutil.which(one.needs):
            continue
        if check and (one.aim is None or "--fresh" in one.command):
            continue
        limit = math.inf if one.aim is None else TOO_MUCH * one.aim
        measured = list[tuple[float, float]]()
        for _ in range(runs):
            unit = statistics.median(measure([sys.executable, *UNIT])[0] for _ in range(3))
            seconds, megabytes = measure_in_folder(one)
            measured.append((seconds / unit, megabytes))
            if check and seconds / unit <= limit:
                break
        multiple = min(each for each, _ in measured)
        aim = "" if one.aim is None else f"{one.aim:g}"
        named = one.command + (", again" if one.again else "")
        rows.append((f"{multiple:.2g}", aim, f"{max(most for _, most in measured):.0f}", named))
        print(*rows[-1], sep="\t", file=sys.stderr, flush=True)
        if multiple > limit:
            over.append(f"{named}: {multiple:.2g} times `import sympy`; the aim is {aim}")
    return plain(rows), over


def main() -> int:
    """Prints the table, or writes it into the page; returns 1 if commands are checked and one takes
    over twice its aim.
    """
    parser = argparse.ArgumentParser(prog="python -m juggleproof.benchmarks.commands")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--only", default="", metavar="TEXT")
    parser.add_argument("--accept", action="store_true")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    if options.only and options.accept:
        parser.error("--accept goes with the whole table")
    done, over = table(options.runs, options.only, options.check)
    if options.accept:
        TABLE.write(f"```text\n{done}\n```")
    else:
        print(done)
    for line in over if options.check else ():
        print(f"over twice its aim: {line}")
    return int(options.check and bool(over))


if __name__ == "__main__":
    sys.exit(main())
