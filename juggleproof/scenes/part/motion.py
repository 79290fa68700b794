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
    STATE,
    STEPS,
    THETA,
    TIME,
    TOO_MANY_EVENTS,
    Floats,
    compiled,
    kernel,
)
from juggleproof.scenes.part.flight import land
from juggleproof.scenes.part.rest import lie, note_turn, pivot
from juggleproof.scenes.part.strike import strike_all

Rows = NDArray[np.float64]

# -------------------------------------------------------------------------------------------------
# Orbits.
#
# The orbit of one block: flights, impacts and contact in turn; and of many, one after another.

# the most in a second of a block's run: chatter that does not end is reported, not followed
MOST_EVENTS, MOST_STEPS = 1_000_000, 10_000_000
SECOND = 1.0


@compiled
def next_event(p: Floats, z: Floats, until: float, notes: Floats) -> int:
    """Moves one block on by one event, a flight with its impacts or a phase of contact, or to the
    time `until`; returns DONE, or why it gave up.
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
    """Moves one block on to the time `until`, its state z and notes in place; returns DONE, or why
    it gave up.
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


# -------------------------------------------------------------------------------------------------
# Places at given times.
#
# The states of blocks at given times of an orbit that is not stopped there: a stop adds a rounding,
# and chaos soon turns that into another orbit.


@compiled
def copied(z: Floats, other: Floats) -> None:
    """Makes the other state the same as z."""
    for k in range(STATE):
        other[k] = z[k]


@compiled
def sample(
    p: Floats,
    z: Floats,
    times: Floats,
    notes: Floats,
    samples: Rows,
    earlier: Floats,
    spare: Floats,
) -> int:
    """Moves one block on, event by event, to the last of the times, which do not fall, and fills a
    row of `samples` with its state at each of them.  Returns DONE, or why it gave up.  The state
    `earlier` and the notes `spare` are room to work in.

    For a time between two events a copy is moved on from the earlier event to that time; the block
    itself does not stop.
    """
    last, k = len(samples) - 1, 0
    begun, events, most = z[TIME], 0, notes[STEPS] + MOST_STEPS
    while k <= last:
        copied(z, earlier)
        if z[TIME] < times[last]:
            code = next_event(p, z, times[last], notes)
            if code != DONE:
                return code
        while k <= last and times[k] <= z[TIME]:
            copied(earlier, samples[k])
            code = follow(p, samples[k], times[k], spare)
            if code != DONE:
                return code
            k += 1
        events += 1
        if z[TIME] >= begun + SECOND:
            begun, events, most = z[TIME], 0, notes[STEPS] + MOST_STEPS
        elif events > MOST_EVENTS or notes[STEPS] > most:
            return TOO_MANY_EVENTS
    return DONE


# -------------------------------------------------------------------------------------------------
# Many blocks, one after another.  This is the one kernel: all else is a part of it, so that nothing
# is compiled twice.


@kernel
def move_all(
    p: Floats, states: Rows, times: Floats, notes: Rows, samples: Rows, room: Rows, codes: Rows
) -> None:
    """Moves n blocks on to the last of `times`; each has a row of `states` (n, 10) and of `notes`
    (n, 16).  `samples` (n, len(times), 10) is filled with their states at each of the times, unless
    it has the shape (n, 0, 10); `room` (2, 16) is room to work in.  `codes` (n,) is filled with how
    each run ended.
    """
    for k in range(len(states)):
        if samples.shape[1] == 0:
            codes[k] = follow(p, states[k], times[-1], notes[k])
        else:
            codes[k] = sample(p, states[k], times, notes[k], samples[k], room[0], room[1])


def follow_all(p: Floats, states: Rows, until: float, notes: Rows) -> Rows:
    """Moves n blocks on to a time; each has a row of `states` (n, 10) and of `notes` (n, 16).
    Returns how each run ended, shape (n,).
    """
    return sample_all(
        p, states, np.array([until], dtype=float), notes, np.empty((len(states), 0, STATE))
    )


def sample_all(p: Floats, states: Rows, times: Floats, notes: Rows, samples: Rows) -> Rows:
    """The same to the last of the times, which do not fall; `samples`, of shape (n, len(times),
    10), is filled with the states at each of these.
    """
    codes = np.zeros(len(states))
    move_all(p, states, times, notes, samples, np.zeros((2, NOTES)), codes)
    return codes
