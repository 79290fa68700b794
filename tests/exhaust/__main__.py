"""Runs the stages that the record does not have as they are now, and writes their lines.

python -m tests.exhaust                # all that are due; what was stopped goes on
python -m tests.exhaust NAME ..        # these, due or not; NAME/ for all that begin so
python -m tests.exhaust --ci NAME ..   # what CI does, of these or of all: short ones are run where
                                       # they are due, others fail
python -m tests.exhaust --due          # names those that are due
"""

from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Mapping, Sequence
from contextlib import closing
from pathlib import Path

from tests.exhaust import record
from tests.exhaust.lanes import LOGS, Done, Lanes
from tests.exhaust.record import FAILED, Line
from tests.exhaust.sources import ROOT, Sources
from tests.exhaust.stages import Stage, Stages

SHORT = 120  # CPU seconds of a stage that CI runs itself
IN_ALL = 600  # of all that it runs


def due(
    stages: Mapping[str, Stage], digests: Mapping[str, str], lines: Mapping[str, Line]
) -> list[Stage]:
    """The stages that the record does not have with their digest, and those that failed."""
    return [
        stage
        for name, stage in stages.items()
        if name not in lines or lines[name].digest != digests[name] or lines[name].result == FAILED
    ]


def refused(
    waiting: Sequence[Stage], digests: Mapping[str, str], lines: Mapping[str, Line]
) -> list[str]:
    """Why CI does not run what is due itself, a line for each stage; none where it does."""
    bounds = {
        stage.name: lines[stage.name].seconds if stage.name in lines else stage.bound
        for stage in waiting
    }
    reasons = {}
    for name, bound in bounds.items():
        if name in lines and lines[name].result == FAILED and lines[name].digest == digests[name]:
            reasons[name] = "failed when it was last run"
        elif bound is None:
            reasons[name] = "has never been run"
        elif bound >= SHORT:
            reasons[name] = f"takes {bound} CPU s, and what it depends on has changed"
    whole = sum(bound or 0 for bound in bounds.values())
    if not reasons and whole > IN_ALL:
        longest = max(bounds, key=lambda name: bounds[name] or 0)
        return [
            f"{len(bounds)} stages take {whole} CPU s, {longest} most, and what they depend on has"
            " changed: run `make exhaust`, and commit tests/exhaust/record.tsv"
        ]
    return [
        f"{name} {why}: run `make exhaust STAGE={name}`, and commit tests/exhaust/record.tsv"
        for name, why in reasons.items()
    ]


def chosen(stages: Mapping[str, Stage], names: Sequence[str]) -> dict[str, Stage]:
    """The stages of these names, and all that begin with one where that ends in a stroke; all
    stages where there is no name.

    Raises ValueError, one line, where no stage has a name.
    """
    found = {} if names else dict(stages)
    for asked in names:
        of_name = {
            name: stage
            for name, stage in stages.items()
            if name == asked or asked.endswith("/") and name.startswith(asked)
        }
        if not of_name:
            raise ValueError(f"{asked}: no stage is called so; `python -m tests.exhaust --due`")
        found |= of_name
    return found


def told(done: Done, root: Path) -> str:
    """A line about a stage; where it failed, with the end of what it printed."""
    line = f"{done.seconds:6} CPU s  {done.result}  {done.stage.name}"
    if done.result != FAILED:
        return line
    return f"{line}; what it printed stands in {root / LOGS}"


def run(
    waiting: Sequence[Stage],
    root: Path,
    lines: dict[str, Line] | None,
    digests: Mapping[str, str],
    path: Path,
) -> int:
    """Runs stages, and writes the line of each where lines are given; returns how many failed."""
    failed = 0
    with closing(Lanes(root).run(waiting)) as lanes:
        for done in lanes:
            print(told(done, root), flush=True)
            failed += done.result == FAILED
            if lines is not None:
                name = done.stage.name
                lines[name] = Line(digests[name], done.seconds, done.result)
                record.write(lines, path)
    return failed


def main(
    arguments: Sequence[str] | None = None, root: Path = ROOT, path: Path = record.PATH
) -> int:
    """Does what the options say; returns 1 where a stage fails, or CI refuses one."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # ends what runs
    parser = argparse.ArgumentParser(prog="python -m tests.exhaust")
    parser.add_argument("stages", nargs="*", metavar="NAME")
    parser.add_argument("--ci", action="store_true")
    parser.add_argument("--due", action="store_true")
    options = parser.parse_args(arguments)
    try:
        lines = record.read(path)
        found = Stages(Sources(root))
        stages, digests = found.all, found.digests()
        asked = chosen(stages, options.stages)
        as_asked = options.stages and not (options.ci or options.due)
        waiting = [*asked.values()] if as_asked else due(asked, digests, lines)
    except ValueError as problem:
        print(problem)
        return 2
    if options.due:
        print("".join(f"{stage.name}\n" for stage in waiting), end="")
        return 0
    print(f"{len(waiting)} of {len(stages)} stages are run", flush=True)
    if options.ci:
        for line in (reasons := refused(waiting, digests, lines)):
            print(line)
        return 1 if reasons else int(run(waiting, root, None, digests, path) > 0)
    lines = {name: line for name, line in lines.items() if name in stages}
    return int(run(waiting, root, lines, digests, path) > 0)


if __name__ == "__main__":
    sys.exit(main())
