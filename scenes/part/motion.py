"""The orbit of one block: flights, impacts and contact in turn; and of many, one after another."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scenes.part.body import DONE, FACE, MODE, NO_PROGRESS, PIVOT, THETA, TIME, Floats
from scenes.part.compiling import compiled
from scenes.part.face import lie
from scenes.part.flight import fly
from scenes.part.pivot import pivot
from scenes.part.strike import strike
from scenes.part.turns import note_turn

MOST_EVENTS = 100_000_000
MOST_AT_ONCE = 10_000  # events that do not move time on


@compiled
def go_on(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves one block on by one event, a flight with its impacts or a phase of contact, or to the
    time `until`; DONE, or why it gave up.
    """
    if z[MODE] == FACE:
        return lie(p, z, until, notes)
    if z[MODE] == PIVOT:
        return pivot(p, z, until, notes)
    before, theta = z[TIME], z[THETA]
    code = fly(p, z, until, notes)
    note_turn(p, notes, before, theta, z[TIME], z[THETA])
    if code == DONE and z[TIME] < until:
        return strike(p, z, notes)
    return code


@compiled
def follow(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves one block on to the time `until`, its state z and notes in place; DONE, or why it gave
    up.
    """
    still = 0
    for _ in range(MOST_EVENTS):
        before = z[TIME]
        if before >= until:
            return DONE
        code = go_on(p, z, until, notes)
        if code != DONE:
            return code
        still = still + 1 if z[TIME] == before else 0
        if still > MOST_AT_ONCE:
            return NO_PROGRESS
    return NO_PROGRESS


@compiled
def follow_all(
    p: Floats, states: NDArray[np.float64], until: float, notes: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Moves blocks on, a row of `states` and of `notes` each; how each run ended."""
    codes = np.zeros(len(states))
    for k in range(len(states)):
        codes[k] = follow(p, states[k], until, notes[k])
    return codes
