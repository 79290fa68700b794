"""The table that moves as a sine: seconds against width of a box and distance to the curves where
the theorem ends, certified area against processes, and whole commands beside their aims.

    python -m juggleproof.benchmarks.sine
    python -m juggleproof.benchmarks.sine --accept     # writes tables and plot into the page
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from tempfile import TemporaryDirectory

from juggleproof.benchmarks.commands import arguments_of, measure
from juggleproof.benchmarks.figures import ABSENT, as_svg, can_plot, new_figure
from juggleproof.benchmarks.generated import DOCS, Generated
from juggleproof.certificates.sine.checker import check_line, read_statement
from juggleproof.certificates.sine.flights import Interval
from juggleproof.reports.tables import plain
from juggleproof.scenes.table.curves import doubling, g_of, grazing
from juggleproof.sine.cover import GRIDS, cover
from juggleproof.sine.search import find_certificate, line_of
from juggleproof.statements.processes import own_pool
from juggleproof.statements.store import write_file

TABLES = Generated(DOCS / "benchmarks.md", "sine")
PLOT = DOCS / "img" / "sine-growth.svg"
MIDDLE = Fraction(1, 20), Fraction(197, 1000)  # alpha and g
WIDTHS = (0, 1, 2, 4, 5, 6, 7, 8)  # half widths in alpha and g, in thousandths
DISTANCES = (100, 50, 20, 10, 5, 2, 1)  # of Gamma, in thousandths
AREA = (
    "the period-one bounce is stable and every motion tends to it for all"
    " alpha in [1/25, 3/50] and Gamma in [149/50, 79/25]"
)
COMMANDS = (  # with the most CPU seconds and megabytes that they may take
    ("juggleproof certify sine --alpha 0.05 --gamma 3.10 --jobs 1 --store DIR", "1", ""),
    ("python -I -S certificates/sine", "2", "50"),
)
RUNS = 5  # of each command: other work on the machine only adds seconds, so the least counts
Row = tuple[str, str, str, str, str]
HEAD: Row = ("", "search s", "check s", "cells", "bytes")
Curve = Callable[[float], float]


def measured(label: str, alpha: Interval, g: Interval) -> tuple[Row, float | None]:
    """A row of a table, and CPU seconds of search and check; None if nothing was found."""
    begin = time.process_time()
    found = find_certificate(alpha, g, *GRIDS[0])
    searched = time.process_time() - begin
    if found.certificate is None:
        return (label, f"{searched:.2f}", "none found", f"{found.cells:,}", ""), None
    line = line_of(found.certificate)
    begin = time.process_time()
    if check_line(line)[0] is None:
        raise RuntimeError(f"{label}: the checker rejects what the search found")
    checked = time.process_time() - begin
    row = (label, f"{searched:.2f}", f"{checked:.2f}", f"{found.cells:,}", f"{len(line):,}")
    return row, searched + checked


def by_width() -> Iterator[tuple[float, Row, float | None]]:
    """Yields (half width, row, seconds) of boxes round the middle."""
    for width in WIDTHS:
        half = Fraction(width, 1000)
        alpha, g = ((one - half, one + half) for one in MIDDLE)
        yield float(half), *measured(f"half width {float(half):g}", alpha, g)


def by_distance(name: str, curve: Curve, side: int) -> Iterator[tuple[float, Row, float | None]]:
    """Yields (distance, row, seconds) of pairs beside a curve, at the alpha of the middle."""
    alpha = MIDDLE[0]
    for thousandths in DISTANCES:
        gamma = curve(float(alpha)) + side * thousandths / 1000
        g = Fraction(round(g_of(float(alpha), gamma) * 10**6), 10**6)
        label = f"{thousandths / 1000:g} {name}"
        yield thousandths / 1000, *measured(label, (alpha, alpha), (g, g))


def by_processes(most: int) -> Iterator[tuple[str, ...]]:
    """Yields rows: seconds on the clock, boxes and certified area of a rectangle from nothing."""
    statement = read_statement(AREA)
    for jobs in range(1, most + 1):
        begin = time.monotonic()
        with TemporaryDirectory() as folder, own_pool(jobs) as pool:
            (done,) = cover([statement], Path(folder), pool)
        spent = time.monotonic() - begin
        area = sum((a[1] - a[0]) * (g[1] - g[0]) for a, g in done.boxes)
        rate = float(area) / spent * 10**6
        yield str(jobs), f"{spent:.1f}", done.outcome, str(len(done.boxes)), f"{rate:.0f}"


def by_command() -> Iterator[Row]:
    """Yields rows: the least CPU seconds of some runs of commands, each from nothing and in a
    process of its own, and megabytes, with the aims.

    A command is never counted with fewer megabytes than this process had before it: so commands
    are measured first.
    """
    for command, seconds, megabytes in COMMANDS:
        runs = []
        for _ in range(RUNS):
            with TemporaryDirectory() as folder:
                runs.append(measure(arguments_of(command, folder)))
        spent, most = min(runs)
        yield f"{spent:.2g}", seconds, f"{most:.0f}", megabytes, command


Series = list[tuple[float, Row, float | None]]


def plotted(series: Sequence[tuple[str, Series]]) -> bytes:
    """Seconds of search and check against width and distance, both axes logarithmic, as SVG."""
    figure = new_figure()
    axes = figure.subplots()
    for name, points in series:
        found = [(x, seconds) for x, _, seconds in points if seconds is not None and x]
        axes.loglog(*zip(*found), marker="o", label=name)
    axes.set_xlabel("half width in alpha and g, or distance in Gamma")
    axes.set_ylabel("CPU seconds, search and check")
    axes.legend()
    return as_svg(figure)


def main() -> None:
    """Prints the tables, or writes them and the plot into the page."""
    parser = argparse.ArgumentParser(prog="python -m juggleproof.benchmarks.sine")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--accept", action="store_true")
    options = parser.parse_args()
    whole = [("CPU s", "aim", "MB", "aim", "command"), *by_command()]
    series = [
        ("width of the box", list(by_width())),
        ("above the second orbit", list(by_distance("above the second orbit", grazing, 1))),
        ("below period doubling", list(by_distance("below period doubling", doubling, -1))),
    ]
    rows = [HEAD, *(row for _, points in series for _, row, _ in points)]
    cores = [("processes", "seconds", "verdict", "boxes", "1e-6 of area/s")]
    done = f"{plain(rows)}\n\n{plain([*cores, *by_processes(options.jobs)])}\n\n{plain(whole)}"
    if not options.accept:
        print(done)
        return
    TABLES.write(f"```text\n{done}\n```")
    if can_plot():
        write_file(PLOT, plotted(series))
    else:
        print(ABSENT)


if __name__ == "__main__":
    main()
