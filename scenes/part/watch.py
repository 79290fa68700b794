"""Where blocks are at given times of an orbit that is not stopped there: a stop rounds, and chaos
soon makes another orbit of that.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scenes.part.body import DONE, NO_PROGRESS, NOTES, TIME, Floats
from scenes.part.compiling import compiled
from scenes.part.motion import MOST_AT_ONCE, MOST_EVENTS, follow, go_on


@compiled
def watch(
    p: Floats, z: NDArray[np.float64], times: Floats, notes: Floats, seen: NDArray[np.float64]
) -> int:
    """One block at times that do not fall, a row of `seen` each, while it is moved on, event by
    event, to the last; DONE, or why it gave up.

    Between two events the block is where a copy comes to that sets out from the earlier one; the
    block itself does not stop.
    """
    aside, scratch = z.copy(), np.zeros(NOTES)
    last, k, still = len(seen) - 1, 0, 0
    for _ in range(MOST_EVENTS):
        aside[:] = z
        if z[TIME] < times[last]:
            code = go_on(p, z, times[last], notes)
            if code != DONE:
                return code
        while k <= last and times[k] <= z[TIME]:
            seen[k] = aside
            code = follow(p, seen[k], times[k], scratch)
            if code != DONE:
                return code
            k += 1
        if k > last:
            return DONE
        still = still + 1 if z[TIME] == aside[TIME] else 0
        if still > MOST_AT_ONCE:
            return NO_PROGRESS
    return NO_PROGRESS


@compiled
def watch_all(
    p: Floats,
    states: NDArray[np.float64],
    times: Floats,
    notes: NDArray[np.float64],
    seen: NDArray[np.float64],
) -> NDArray[np.float64]:
    """The same for many blocks, one after another; `seen` has the shape (blocks, times, 10).  How
    each ended.
    """
    codes = np.zeros(len(states))
    for k in range(len(states)):
        codes[k] = watch(p, states[k], times, notes[k], seen[k])
    return codes
