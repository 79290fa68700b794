"""Many blocks at given times, for pictures: all of one orbit each, which is not stopped at them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from typing import NamedTuple

import numpy as np

from scenes.errors import SceneError
from scenes.part import body
from scenes.part.ensemble import CHUNK, WHY, fresh_notes
from scenes.part.setting import LONGEST, Array, Scene, standing

MOST_STATES = 5_000_000


class Job(NamedTuple):
    """A chunk of blocks with the times at which they are looked at."""

    parameters: Array
    states: Array
    times: Array


def frames(
    setting: Scene,
    angles: Sequence[float] | Array,
    times: Sequence[float] | Array,
    executor: Executor | None = None,
) -> Array:
    """The states of blocks that start at these angles, in radians, at these times, in seconds,
    which do not fall: shape (len(times), n, 10).

    Each orbit is, to the last bit, the one that `run` follows to the last of the times; a run to an
    earlier one may round its last event otherwise. Without an executor threads share the chunks.
    """
    looked = np.asarray(times, dtype=float)
    if (
        looked.ndim != 1
        or not len(looked)
        or not np.isfinite(looked).all()
        or (np.diff(looked) < 0).any()
    ):
        raise SceneError("times: one row of finite numbers that do not fall is needed")
    if looked[0] < 0 or looked[-1] > LONGEST:
        raise SceneError(
            f"times from {looked[0]:.6g} to {looked[-1]:.6g} s are not within 0 .. {LONGEST:g}"
        )
    states = standing(setting, angles)
    if len(states) * len(looked) > MOST_STATES:
        raise SceneError(
            f"{len(states)} blocks at {len(looked)} times are more than {MOST_STATES} states;"
            " choose fewer times"
        )
    jobs = [
        Job(setting.parameters(), states[k : k + CHUNK], looked)
        for k in range(0, len(states), CHUNK)
    ]
    if len(jobs) == 1 and executor is None:
        return watched(jobs[0])
    if executor is not None:
        return np.concatenate(
            [future.result() for future in [executor.submit(watched, job) for job in jobs]], axis=1
        )
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        return np.concatenate(list(threads.map(watched, jobs)), axis=1)


def watched(job: Job) -> Array:
    """A chunk of blocks at its times; SceneError where a counted bound on the work is reached."""
    from scenes.part.watch import watch_all

    states = job.states.copy()
    seen = np.zeros((len(states), len(job.times), body.STATE))
    codes = watch_all(job.parameters, states, job.times, fresh_notes(len(states)), seen)
    for k in np.flatnonzero(codes):
        raise SceneError(
            f"block {k}, at t = {states[k, body.TIME]:.6g} s and theta ="
            f" {states[k, body.THETA]:.6g}: {WHY[int(codes[k])]}"
        )
    return np.ascontiguousarray(seen.transpose(1, 0, 2))
