"""What `juggleproof simulate part` prints."""

from __future__ import annotations

import math
from typing import Any

from proofs.command.columns import draw
from scenes.part import body
from scenes.part.assumptions import assumptions, discrepancies
from scenes.part.ensemble import Run
from scenes.part.onsets import Row, Table
from scenes.part.setting import Scene
from scenes.part.sweeping import Point, misfit

POINT_HEADS = "    e     mu   misfit   median onset of the six rows in s (chaotic ensembles)"

RULES = (
    (
        "median: of the onsets; the onset of an ensemble is the last time at which one of its"
        " blocks is nearer to upright than to lying."
    ),
    (
        "chaotic: ensembles in which blocks pass both ways between upright and lying in the second"
        " half of the run; a row is, if more than half are."
    ),
    "censored: ensembles that have not settled at the end of the run.",
)


def _console() -> Any:
    from rich.console import Console

    return Console(highlight=False)


def seconds(value: float, horizon: float) -> str:
    """An onset, or that it is later than the run is long."""
    return f"> {horizon:g}" if math.isinf(value) else f"{value:.2f}"


def line(row: Row) -> tuple[str, ...]:
    """A row of table I: vibration, the paper's onset, median, 16 to 84 percent, chaotic, censored,
    and the verdict by the rule.
    """
    parts = [seconds(row.quantile(part), row.horizon) for part in (0.5, 0.16, 0.84)]
    found = "chaotic" if row.is_chaotic() else f"{parts[0]} s"
    return (
        f"{row.frequency:g} Hz {1000 * row.amplitude:g} mm",
        "chaotic" if row.paper is None else f"{row.paper:g} s",
        found,
        f"{parts[1]} to {parts[2]}",
        str(sum(row.chaotic)),
        str(row.censored()),
    )


def table(found: Table, setting: Scene, amplitudes: str, swept: bool) -> None:
    """Table I beside the paper's, what it assumes, and where it differs."""
    count = len(found.rows[0].chaotic)
    print(
        f"Table I: from when on all blocks lie; {count} ensembles of 91 blocks,"
        f" {found.rows[0].horizon:g} s each.  Simulated, not proved."
    )
    draw(
        ("along the table", "paper", "median", "16 to 84 %", "chaotic", "censored"),
        [line(row) for row in found.rows],
        _console(),
    )
    for rule in RULES:
        print(rule)
    print()
    known = assumptions(setting, amplitudes, swept)
    draw(
        ("assumed", "value", "", "why"),
        [(one.name, one.value, one.standing, one.why) for one in known],
        _console(),
    )
    print()
    told = discrepancies(found.rows)
    print("differs from the paper:" if told else "no row differs from the paper")
    for one in told:
        print(f"  {one}")
    print(
        f"misfit {misfit(found):.3f}: the mean over rows of |ln(median/paper)|, at most 1; for a"
        " chaotic print, the part of ensembles that are not"
    )


def violations(run: Run, setting: Scene) -> bool:
    """Tells how often the impact law's guarantees were broken; whether any was."""
    found = run.violations()
    deepest = -float(run.notes[:, body.LEAST_GAP].min())
    print(
        f"{int(run.notes[:, body.IMPACTS].sum())} impacts: "
        + ", ".join(f"{count} {name}" for name, count in found.items())
    )
    print(
        f"deepest corner {deepest:.3g} m below the table, tolerance {setting.tolerance:g} m;"
        " largest energy taken away by coming to lie"
        f" {float(run.notes[:, body.LARGEST_REMOVED].max()):.3g} J/kg"
    )
    return any(found.values()) or deepest > setting.tolerance


def point(one: Point) -> str:
    """A point of a sweep in one line."""
    rows = "  ".join(
        f"{'-' if m is None else f'{m:.2f}':>6} ({c})" for m, c in zip(one.medians, one.chaotic)
    )
    return f"{one.e:6.3f} {one.mu:6.3f} {one.misfit:7.3f} {rows}"
