"""The orbit of one block: flights, impacts and contact in turn; and its places at given times."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.part.body import (
    DONE,
    FACE,
    MODE,
    NOTES,
    PIVOT,
    STEPS,
    THETA,
    TIME,
    TOO_MANY_EVENTS,
    Floats,
    compiled,
    making_arrays,
)
from juggleproof.scenes.part.flight import land
from juggleproof.scenes.part.rest import lie, note_turn, pivot
from juggleproof.scenes.part.strike import strike_all

# -------------------------------------------------------------------------------------------------
# Orbits.
#
# The orbit of one block: flights, impacts and contact in turn; and of many, one after another.

# of one block, in any second of its run: chatter that does not end is told, and not followed
MOST_EVENTS, MOST_STEPS = 1_000_000, 10_000_000
SECOND = 1.0


@compiled
def next_event(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves one block on by one event, a flight with its impacts or a phase of contact, or to the
    time `until`; DONE, or why it gave up.
    """
    if z[MODE] == FACE:
        return lie(p, z, until, notes)
    if z[MODE] == PIVOT:
        return pivot(p, z, until, notes)
    before, theta = z[TIME], z[THETA]
    code, c, s, level, rise, lift = land(p, z, until, notes)
    note_turn(p, notes, before, theta, z[TIME], z[THETA])
    if code == DONE and z[TIME] < until:
        return strike_all(p, z, c, s, level, rise, lift, notes)
    return code


@compiled
def follow(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves one block on to the time `until`, its state z and notes in place; DONE, or why it gave
    up.
    """
    begun, events, most = z[TIME], 0, notes[STEPS] + MOST_STEPS
    while z[TIME] < until:
        code = next_event(p, z, until, notes)
        if code != DONE:
            return code
        events += 1
        if z[TIME] >= begun + SECOND:
            begun, events, most = z[TIME], 0, notes[STEPS] + MOST_STEPS
        elif events > MOST_EVENTS or notes[STEPS] > most:
            return TOO_MANY_EVENTS
    return DONE


@making_arrays
def follow_all(
    p: Floats, states: NDArray[np.float64], until: float, notes: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Moves n blocks on, a row of `states` (n, 10) and of `notes` (n, 16) each; how each run
    ended, shape (n,).
    """
    codes = np.zeros(len(states))
    for k in range(len(states)):
        codes[k] = follow(p, states[k], until, notes[k])
    return codes


# -------------------------------------------------------------------------------------------------
# Places at given times.
#
# Where blocks are at given times of an orbit that is not stopped there: a stop rounds, and chaos
# soon makes another orbit of that.


@making_arrays
def sample(
    p: Floats, z: NDArray[np.float64], times: Floats, notes: Floats, samples: NDArray[np.float64]
) -> int:
    """One block at times that do not fall, a row of `samples` each, while it is moved on, event by
    event, to the last; DONE, or why it gave up.

    Between two events the block is where a copy comes to that sets out from the earlier one; the
    block itself does not stop.
    """
    earlier, scratch = z.copy(), np.zeros(NOTES)
    last, k = len(samples) - 1, 0
    begun, events, most = z[TIME], 0, notes[STEPS] + MOST_STEPS
    while k <= last:
        earlier[:] = z
        if z[TIME] < times[last]:
            code = next_event(p, z, times[last], notes)
            if code != DONE:
                return code
        while k <= last and times[k] <= z[TIME]:
            samples[k] = earlier
            code = follow(p, samples[k], times[k], scratch)
            if code != DONE:
                return code
            k += 1
        events += 1
        if z[TIME] >= begun + SECOND:
            begun, events, most = z[TIME], 0, notes[STEPS] + MOST_STEPS
        elif events > MOST_EVENTS or notes[STEPS] > most:
            return TOO_MANY_EVENTS
    return DONE


@making_arrays
def sample_all(
    p: Floats,
    states: NDArray[np.float64],
    times: Floats,
    notes: NDArray[np.float64],
    samples: NDArray[np.float64],
) -> NDArray[np.float64]:
    """The same for many blocks, one after another; `samples` has the shape (blocks, times, 10); how
    each run ended.
    """
    codes = np.zeros(len(states))
    for k in range(len(states)):
        codes[k] = sample(p, states[k], times, notes[k], samples[k])
    return codes
