"""The part on the table: CPU seconds for table I, how they grow, and scatter against the number of
ensembles; error against cost is a question of `juggleproof bench`.

Run: python -m juggleproof.benchmarks.part [--plot FILE.svg] [--ensembles 48]
"""

from __future__ import annotations

import argparse
import statistics
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from juggleproof.benchmarks.processes import cpu_seconds
from juggleproof.scenes.part import body, run, scene, standing, table_one
from juggleproof.scenes.part.onsets import ANGLES, jittered

AIM_SECONDS, AIM_NANOSECONDS = 0.2, 400.0
THIRD_ROW = scene(e=0.7, mu=0.08, f_x=30.0, A_x=1e-3)  # of table I: 30 Hz, 1 mm
T = TypeVar("T")


def least(work: Callable[[], T], runs: int) -> tuple[float, T]:
    """The least CPU seconds of some runs, one at least, and what the work gives."""

    def timed() -> tuple[float, T]:
        began = cpu_seconds()
        result = work()
        return cpu_seconds() - began, result

    return min((timed() for _ in range(runs)), key=lambda one: one[0])


def once(cores: int, horizon: float, runs: int) -> tuple[float, float]:
    """Table I once, 6 x 91 parts: CPU seconds of each core, and nanoseconds an impact."""
    with ThreadPoolExecutor(cores) as executor:
        seconds, table = least(
            lambda: table_one(THIRD_ROW, ensembles=1, horizon=horizon, executor=executor), runs
        )
    return seconds / cores, seconds * 1e9 / float(table.run.notes[:, body.IMPACTS].sum())


def slope(sizes: Sequence[float], seconds: Sequence[float]) -> float:
    """The exponent of growth: 1 is linear."""
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])


def growth(parts: Sequence[int], horizons: Sequence[float], runs: int) -> tuple[float, float]:
    """The exponents of the seconds in the number of parts, and in the time that they are followed
    for, on one core.
    """
    # with e = 1 blocks do not come to rest, so that every second has about as many impacts as the
    # last
    block = replace(THIRD_ROW, e=1.0)

    def seconds(count: int, horizon: float) -> float:
        states = standing(block, np.radians(np.linspace(0, 90, count)))
        with ThreadPoolExecutor(1) as executor:
            return least(lambda: run(block, states, horizon, executor=executor), runs)[0]

    return slope(parts, [seconds(count, horizons[0]) for count in parts]), slope(
        horizons, [seconds(parts[0], h) for h in horizons]
    )


def scatter(sizes: Sequence[int], ensembles: int, horizon: float) -> list[tuple[int, float, float]]:
    """For estimates from some ensembles of 91 parts each: the relative scatter of the median onset,
    and of the mean exit time.

    Both are standard deviations over disjoint groups of ensembles; onsets that are censored count
    as the horizon.
    """
    block = THIRD_ROW
    notes = (
        run(block, standing(block, jittered(ensembles, 1).ravel()), horizon)
        .notes[:, body.LAST_UPRIGHT]
        .reshape(ensembles, ANGLES)
    )
    rows = []
    for size in sizes:
        groups = [notes[k : k + size] for k in range(0, ensembles - size + 1, size)]
        onsets = [float(np.median(group.max(axis=1))) for group in groups]
        means = [float(group.mean()) for group in groups]
        rows.append(
            (
                size,
                statistics.stdev(onsets) / statistics.mean(onsets),
                statistics.stdev(means) / statistics.mean(means),
            )
        )
    return rows


def plot(file: Path, scattered: Sequence[tuple[int, float, float]]) -> None:
    """Scatter against the number of parts."""
    from matplotlib import pyplot

    pyplot.switch_backend("Agg")
    pyplot.rcParams["svg.hashsalt"] = "part"
    figure, axes = pyplot.subplots(figsize=(5, 4), constrained_layout=True)
    parts = [size * ANGLES for size, _, _ in scattered]
    for column, name, colour, mark in (
        (1, "median onset", "#d55e00", "s-"),
        (2, "mean exit time", "#0072b2", "o-"),
    ):
        axes.loglog(parts, [one[column] for one in scattered], mark, color=colour, label=name)
    axes.set(
        xlabel="parts",
        ylabel="relative scatter of the estimate",
        title="Scatter against the number of parts",
    )
    axes.legend()
    figure.savefig(file, metadata={"Date": None})
    pyplot.close(figure)


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints seconds, exponents of growth and scatter; draws them where asked to."""
    parser = argparse.ArgumentParser(
        prog="python -m juggleproof.benchmarks.part", description=__doc__
    )
    parser.add_argument("--plot", type=Path, help="an SVG file to write")
    parser.add_argument(
        "--ensembles", type=int, default=48, help="of 91 parts each, for the scatter"
    )
    parser.add_argument("--horizon", type=float, default=6.0, help="seconds of table I")
    parser.add_argument("--runs", type=int, default=5, help="of which the quickest counts")
    chosen = parser.parse_args(arguments)
    once(1, 0.01, 1)  # compiles
    for cores in (1, 2):
        seconds, each = once(cores, chosen.horizon, chosen.runs)
        print(
            f"table I once, {cores} core{'s' * (cores > 1)}: {seconds:.3f} CPU s each (aim on two"
            f" {AIM_SECONDS} s), {each:.0f} ns an impact of one core (aim {AIM_NANOSECONDS:.0f})"
        )
    in_parts, in_time = growth(
        [182, 364, 728], [chosen.horizon / 6, chosen.horizon / 3, chosen.horizon], chosen.runs
    )
    print(f"seconds grow as parts^{in_parts:.2f} and time^{in_time:.2f}")
    scattered = scatter(
        [size for size in (1, 2, 4, 8, 16) if 3 * size <= chosen.ensembles],
        chosen.ensembles,
        chosen.horizon,
    )
    for size, onset, exits in scattered:
        print(
            f"{size * ANGLES:5} parts: scatter of the median onset {onset:.1%}, of the mean exit"
            f" time {exits:.1%}"
        )
    if chosen.plot:
        plot(chosen.plot, scattered)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
