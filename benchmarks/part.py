"""The part on the table: CPU seconds for table I, how they grow, error against cost, and scatter
against the number of ensembles.

Run: python -m juggleproof.benchmarks.part [--plot FILE.svg] [--ensembles 48]
"""

from __future__ import annotations

import argparse
import math
import statistics
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TypeVar

import numpy as np

from juggleproof.benchmarks.processes import cpu_seconds
from juggleproof.scenes.part import body, run, scene, standing, table_one
from juggleproof.scenes.part.onsets import ANGLES, jittered

AIM_SECONDS, AIM_NANOSECONDS = 0.2, 1000.0
TOLERANCES = tuple(10.0**k for k in range(-12, -5))
UNTIL = 0.2  # seconds
KNOWN = (
    # Y, theta and omega of a start at rest otherwise, 1 mm above the table; X and theta at UNTIL,
    # as tests/scenes/part/reference.py gives them to 35 digits (tests/benchmarks/test_part.py)
    (0.023061931849125517, 0.3, 0.0, -0.003101475204388124, 0.017600327998065483),
    (0.023061931849125517, 0.3, 20.0, 0.00025592713805318345, 1.7743708745265574),
    (0.023345906623849486, 0.5, 0.0, 0.0026708993436094495, -0.19195112214818577),
    (0.023345906623849486, 0.5, 20.0, -0.0018088531708368276, 1.5722365266224454),
    (0.022107695095938535, 0.8, 0.0, -0.005627797910479694, 1.590688899520696),
    (0.022107695095938535, 0.8, 20.0, -0.0022336009557193943, 1.5495416012118293),
    (0.0189839960291259, 1.1, 0.0, -0.00011313208206649776, 1.561524492678009),
    (0.0189839960291259, 1.1, 20.0, 0.0028584303379096464, 1.5637618350945488),
    (0.015985558426663677, 1.3, 0.0, -0.002068432040313402, 1.653887053002308),
    (0.015985558426663677, 1.3, 20.0, -0.0024788585952853397, 1.5682129428516045),
)


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


def accuracy(
    tolerances: Sequence[float], parts: int, runs: int
) -> list[tuple[float, float, float]]:
    """For each tolerance: the median error of place and angle against the reference, in metres, and
    nanoseconds an impact.
    """
    rows = []
    for tolerance in tolerances:
        block = replace(THIRD_ROW, tolerance=tolerance, rest_speed=1e-6)
        states = np.zeros((len(KNOWN), body.STATE))
        states[:, [body.Y, body.THETA, body.OMEGA]] = [one[:3] for one in KNOWN]
        after = run(block, states, UNTIL).states
        ends = np.array([one[3:] for one in KNOWN])
        errors = np.abs(after[:, [body.X, body.THETA]] - ends) * [1, math.hypot(0.01, 0.02)]
        shaken = replace(block, rest_speed=1e-3)
        many = standing(shaken, np.radians(np.linspace(0, 90, parts)))
        seconds, done = least(partial(run, shaken, many, 1.0), runs)
        rows.append(
            (
                tolerance,
                float(np.median(errors.max(axis=1))),
                seconds * 1e9 / float(done.notes[:, body.IMPACTS].sum()),
            )
        )
    return rows


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


def plot(
    file: Path,
    errors: Sequence[tuple[float, float, float]],
    scattered: Sequence[tuple[int, float, float]],
) -> None:
    """Error against cost over tolerances, and scatter against the number of parts."""
    from matplotlib import pyplot

    pyplot.switch_backend("Agg")
    pyplot.rcParams["svg.hashsalt"] = "part"
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4), constrained_layout=True)
    left.loglog(
        [cost for _, _, cost in errors], [error for _, error, _ in errors], "o-", color="#0072b2"
    )
    for tolerance, error, cost in errors:
        left.annotate(
            f"{tolerance:g} m", (cost, error), textcoords="offset points", xytext=(5, 5), fontsize=8
        )
    left.set(
        xlabel="nanoseconds an impact",
        ylabel=f"median error after {UNTIL:g} s, metres",
        title="Error against cost, by tolerance",
    )
    parts = [size * ANGLES for size, _, _ in scattered]
    for column, name, colour, mark in (
        (1, "median onset", "#d55e00", "s-"),
        (2, "mean exit time", "#0072b2", "o-"),
    ):
        right.loglog(parts, [one[column] for one in scattered], mark, color=colour, label=name)
    right.set(
        xlabel="parts",
        ylabel="relative scatter of the estimate",
        title="Scatter against the number of parts",
    )
    right.legend()
    figure.savefig(file, metadata={"Date": None})
    pyplot.close(figure)


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints seconds, exponents of growth, errors and scatter; draws them where asked to."""
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
    errors = accuracy(TOLERANCES, ANGLES, chosen.runs)
    for tolerance, error, cost in errors:
        print(
            f"tolerance {tolerance:.0e} m: median error {error:.1e} m after {UNTIL} s, {cost:.0f}"
            " ns an impact"
        )
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
        plot(chosen.plot, errors, scattered)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
