"""Orbits of the juggler: seconds by states and steps for each arithmetic, error against the exact
orbit, memory.

    python -m juggleproof.benchmarks.orbits

Slopes are of log seconds against log size, by least squares: 1 is linear, 0 is no growth.
"""

from __future__ import annotations

import math
import multiprocessing
import resource
from collections.abc import Sequence
from fractions import Fraction
from multiprocessing.queues import Queue
from pathlib import Path

from flint import arb
from mpmath import mpf

from juggleproof.benchmarks.processes import cpu_seconds
from juggleproof.scenes.juggler.bounded import bytes_needed
from juggleproof.scenes.juggler.exact import as_fraction
from juggleproof.scenes.juggler.orbits import Orbits, Row, orbit
from juggleproof.scenes.juggler.starts import Scene, point, random, scene

ALPHAS = ("3/10", "9/10")  # in the trap after a few impacts; out of it for long
STEPS, STATES, RANDOM_STEPS = (100, 1000, 10000), (1000, 10000, 100000), 100
MEMORY = (10**6, 20)


def seconds(
    setting: Scene, arithmetic: str, steps: int, to_the_trap: bool = False
) -> tuple[float, Orbits]:
    """The least CPU seconds of three runs of `orbit`, and its result."""
    best = math.inf
    for _ in range(3):
        began = cpu_seconds()
        found = orbit(setting, arithmetic, steps, impacts=to_the_trap, until_trap=to_the_trap)
        best = min(best, cpu_seconds() - began)
    return best, found


def slope(sizes: Sequence[float], times: Sequence[float]) -> float:
    """The slope of the line through log times against log sizes."""
    xs, ys = [math.log(size) for size in sizes], [math.log(one) for one in times]
    x, y = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((a - x) * (b - y) for a, b in zip(xs, ys)) / sum((a - x) ** 2 for a in xs)


def _rational(value: Fraction | float | arb | mpf) -> Fraction:
    if isinstance(value, arb):
        return as_fraction(value.mid().fmpq())
    return Fraction(value if isinstance(value, (Fraction, float)) else str(value))


def error(row: Row, exact: Row) -> str:
    """The distance of a state from the exact one, and the bound that the run gives of it."""
    if row.end != "reached" or exact.end != "reached":
        return row.end or exact.end
    pairs = ((row.x, exact.x), (row.w, exact.w))
    off = max(abs(_rational(value) - true) for value, true in pairs)
    bound = "" if row.error is None else f" <= {float(max(row.error)):.1e}"
    return f"{float(off):.1e}{bound}"


def head(first: str, sizes: Sequence[str], last: str) -> None:
    """The heads of a table of seconds by size."""
    print(first, *(f"{size:>16}" for size in sizes), f"{'slope':>6}  {last}")


def by_steps() -> None:
    """One orbit: seconds and error by the number of periods, of impacts, and by the energy."""
    head(
        f"{'alpha':>6} {'arithmetic':>10}",
        [f"{steps} periods" for steps in STEPS],
        f"error after {STEPS[1]} periods",
    )
    for alpha in ALPHAS:
        setting = scene(alpha, point(1, -4))
        exact = orbit(setting, "exact", STEPS[1]).row(0)
        for kind in ("exact", "enclosed", "mp", "fast"):
            times = [seconds(setting, kind, steps)[0] for steps in STEPS]
            off = error(orbit(setting, kind, STEPS[1]).row(0), exact)
            print(
                f"{alpha:>6} {kind:>10} "
                + " ".join(f"{one:16.5f}" for one in times)
                + f" {slope(STEPS, times):6.2f}  {off}"
            )
    print()
    energies = (10, 10**3, 10**6, 10**12)
    head(
        f"{'until the trap':>17}", [f"height {energy:.0e}" for energy in energies], "(alpha = 3/10)"
    )
    for kind in ("exact", "enclosed", "fast"):
        times = [
            seconds(scene("3/10", point(energy, "1/7")), kind, 1000, to_the_trap=True)[0]
            for energy in energies
        ]
        print(
            f"{kind:>17} "
            + " ".join(f"{one:16.5f}" for one in times)
            + f" {slope(energies, times):6.2f}"
        )
    print()


def by_states() -> None:
    """Many orbits in fast arithmetic."""
    head(
        f"{'alpha':>6} {'fast':>10}",
        [f"{count} states" for count in STATES],
        f"undecided, greatest bound ({RANDOM_STEPS} periods)",
    )
    for alpha in ALPHAS:
        runs = [seconds(scene(alpha, random(count, 1)), "fast", RANDOM_STEPS) for count in STATES]
        last = runs[-1][1]
        rows = map(last.row, range(last.followed))
        worst = max(max(row.error) for row in rows if row.end == "reached" and row.error)
        print(
            f"{alpha:>6} {'':>10} "
            + " ".join(f"{one:16.4f}" for one, _ in runs)
            + f" {slope(STATES, [one for one, _ in runs]):6.2f}  "
            f"{len(last.undecided)}, {worst:.1e}"
        )
    print()


def peak() -> float:
    """The most memory that this process has held, in MB.

    Linux says it of the program itself; `getrusage` counts what its parent held when it was forked,
    too, and serves where there is no /proc.
    """
    try:
        lines = Path("/proc/self/status").read_text().splitlines()
        return next(int(line.split()[1]) / 1024 for line in lines if line.startswith("VmHWM:"))
    except (OSError, StopIteration):
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def _memory(queue: Queue[tuple[float, float]]) -> None:
    count, steps = MEMORY
    orbit(scene("9/10", random(10, 1)), "fast", 1)
    before = peak()
    orbit(scene("9/10", random(count, 1)), "fast", steps)
    queue.put((before, peak()))


def memory() -> float:
    """Peak memory in MB of a process that follows a million states."""
    context = multiprocessing.get_context("spawn")
    queue = context.Queue()
    process = context.Process(target=_memory, args=(queue,))
    process.start()
    before, after = queue.get()
    process.join()
    print(
        f"{MEMORY[0]} states, {MEMORY[1]} periods: {after:.0f} MB at most, {before:.0f} MB of it"
        " before the run (aim: below 200); computed beforehand"
        f" {bytes_needed(MEMORY[0], MEMORY[1]) / 1e6:.0f} MB"
    )
    return float(after)


def main() -> None:
    """Prints all of it."""
    by_steps()
    by_states()
    memory()


if __name__ == "__main__":
    main()
