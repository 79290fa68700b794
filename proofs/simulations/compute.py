"""Computes `figures.json` by the scenes, with stored seeds, in about a minute.

    python -m juggleproof.proofs.simulations.compute    computes the figures anew, and writes them

The part of section 2.1 has the most likely reading of the stored sweep; its orbits are chaotic, so
that another processor gives other figures within their scatter.  Orbits of the juggler are exact.
"""

from __future__ import annotations

import json
from fractions import Fraction
from math import ceil, floor, isinf, pi, sqrt
from operator import ne
from statistics import median

from juggleproof.proofs.simulations.figures import (
    HEIGHTS,
    RECORD,
    SPEEDS,
    EntryTimes,
    Figures,
    FrameCounts,
    Given,
    Onset,
    Still,
)
from juggleproof.scenes.juggler import random
from juggleproof.scenes.juggler.compiled_map import formulas, region
from juggleproof.scenes.juggler.exact import flight, flight_length, impact
from juggleproof.scenes.part import body
from juggleproof.scenes.part.ensemble import frames, no_vibration
from juggleproof.scenes.part.onsets import (
    ANGLES,
    ENSEMBLES,
    PAPER,
    OnsetTable,
    jittered,
    table_one,
)
from juggleproof.scenes.part.readings import TableReading, chosen, recorded
from juggleproof.scenes.part.setting import Scene
from juggleproof.statements.store import write_file
from juggleproof.symbolic import delta_E_sup
from juggleproof.symbolic.algebra import alpha as restitution
from juggleproof.symbolic.algebra import r

SEED = 1
ALPHAS = (Fraction(1, 10), Fraction(1, 5), Fraction(3, 10))  # within the paper's range (21)
STARTS = 1000  # of each alpha, before those in R are left out
EARLY, LATE = 0.8, 3.0  # seconds, of figure 2


def still_table(setting: Scene) -> Still:
    """Blocks that are let go on a still table."""
    split = no_vibration(setting)
    ends = split.ends
    return Still(
        upright=ends.count(0),
        lying=ends.count(90),
        between=[round(split.upright, 9), round(split.lying, 9)],
    )


def figure_two(reading: TableReading, ensembles: int = ENSEMBLES) -> FrameCounts:
    """Figure 2: the table moves along itself by 1 mm at 30 Hz."""
    shaken = reading.scene(f_x=30.0, A_x=reading.peak * 1e-3)
    states = frames(shaken, jittered(ensembles, SEED).ravel(), [EARLY, LATE])
    early, late = (
        [[floor(turns + 0.5) % 2 == 0 for turns in one] for one in at]
        for at in (states[:, :, body.THETA] / (pi / 2)).reshape(2, ensembles, ANGLES).tolist()
    )
    return FrameCounts(
        upright=[sum(one) for one in early],
        apart=[sum(map(ne, one, one[1:])) for one in early],
        late=[sum(one) for one in late],
    )


def settled(onset: float) -> float | None:
    """An onset, None where it is not within the run."""
    return None if isinf(onset) else round(onset, 2)


def onsets(computed: OnsetTable) -> list[Onset]:
    """The rows of table I."""
    notes = computed.run.notes.reshape(len(PAPER), -1, body.NOTES)
    return [
        Onset(
            frequency=row.frequency,
            amplitude=1000 * row.amplitude,
            paper=row.paper,
            median=settled(row.quantile(0.5)),
            low=settled(row.quantile(0.16)),
            high=settled(row.quantile(0.84)),
            chaotic=sum(row.chaotic),
            censored=row.censored(),
            rises=int(notes[k, :, body.RISES].sum()),
        )
        for k, row in enumerate(computed.rows)
    ]


def time_to_region(alpha: Fraction, starts: int = STARTS) -> EntryTimes:
    """Orbits of random states outside R, followed to the impact that brings them into R, against
    t_R of (26): the count of impacts rounded up, with the derived Delta E_sup.
    """
    drawn = random(starts, SEED, x=HEIGHTS, w=SPEEDS)
    energy, goal = formulas().energy, region()(alpha)
    loss = -float(delta_E_sup().subs({restitution: alpha.numerator / alpha.denominator, r: 1}))
    parts = []
    for index in range(starts):
        x, w = drawn.exact(index)
        first, periods, struck = energy(x, w), 0, Fraction(0)
        if first <= goal:
            continue
        while energy(x, w) > goal:
            free = flight_length(x, w)
            x, w = flight(x, w, free)
            struck = periods + free + x / w
            x, w = impact(alpha, x, w)
            periods += free + 1
        parts.append(float(struck) / (sqrt(2 * first) * ceil((first - goal) / loss)))
    return EntryTimes(
        alpha=str(alpha),
        starts=len(parts),
        median=round(median(parts), 4),
        greatest=round(max(parts), 4),
    )


def compute() -> Figures:
    """All figures, in about a minute.  SceneError without numba, the extra `part`."""
    reading = chosen(recorded()).reading
    setting = reading.scene()
    return Figures(
        seed=SEED,
        ensembles=ENSEMBLES,
        reading=Given(
            face=reading.face,
            amplitudes=reading.amplitudes,
            phase_x=reading.phase_x,
            phase_y=reading.phase_y,
            e=reading.e,
            mu=reading.mu,
        ),
        still=still_table(setting),
        frame=figure_two(reading),
        table=onsets(table_one(setting, seed=SEED, peak=reading.peak)),
        region=[time_to_region(alpha) for alpha in ALPHAS],
    )


if __name__ == "__main__":
    write_file(RECORD, (json.dumps(compute(), indent=1) + "\n").encode())
