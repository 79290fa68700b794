"""Many blocks at once: chunks of them on any executor of `concurrent.futures`; the results do not
depend on which.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from scenes.errors import SceneError
from scenes.part import body
from scenes.part.setting import Array, Scene, refuse_long

CHUNK = 91
WHY = {
    body.TOO_MANY_STEPS: "the search for an impact took too many steps",
    body.JAMMED: "a corner jammed: friction is too large for the impact law",
    body.TOO_MANY_IMPACTS: "impacts at one time did not come to an end",
    body.NO_PROGRESS: "events did not come to an end",
}
Job = tuple[Array, Array, float, Array]  # parameters, states, until, notes


@dataclass(frozen=True)
class Run:
    """Where blocks are after a run, shape (n, 10), and what was noted of them, shape (n, 16);
    columns are named in `scenes.part.body`.
    """

    states: Array
    notes: Array

    def violations(self) -> dict[str, int]:
        """How often an impact broke a guarantee of the impact law, and corners how deep in the
        table: all are to be 0.
        """
        return {
            name: int(self.notes[:, column].sum())
            for name, column in (
                ("impulses that pull", body.PULLS),
                ("impulses outside the friction cone", body.CONES),
                ("energy gained", body.GAINS),
                ("corners left closing", body.CLOSINGS),
            )
        }


def fresh_notes(count: int, since: float = 0.0) -> Array:
    """Notes of blocks that have not moved yet; falls and rises are counted from the time `since`
    on.
    """
    notes = np.zeros((count, body.NOTES))
    notes[:, body.LEAST_GAP], notes[:, body.SINCE] = np.inf, since
    return notes


def moved(job: Job) -> tuple[Array, Array]:
    """A chunk of blocks, moved on: states and notes; SceneError where a counted bound on the work
    is reached.
    """
    from scenes.part.motion import follow_all

    p, states, until, notes = job[0], job[1].copy(), job[2], job[3].copy()
    codes = follow_all(p, states, until, notes)
    for k in np.flatnonzero(codes):
        raise SceneError(
            f"block {k}, at t = {states[k, body.TIME]:.6g} s and theta ="
            f" {states[k, body.THETA]:.6g}: {WHY[int(codes[k])]}"
        )
    return states, notes


def run(
    setting: Scene,
    states: Array,
    until: float,
    *,
    notes: Array | None = None,
    executor: Executor | None = None,
) -> Run:
    """Moves blocks on to the time `until`, in seconds; `states` of shape (n, 10) stay as they are.

    Without an executor the chunks are shared over the cores by threads; kernels do not hold the
    interpreter's lock.
    """
    refuse_long(setting, until)
    if states.ndim != 2 or states.shape[1] != body.STATE:
        raise SceneError(f"states of shape {states.shape}: (n, {body.STATE}) is needed")
    if not len(states) or not np.isfinite(states).all():
        raise SceneError(f"states of shape {states.shape}: rows of finite numbers are needed")
    notes = fresh_notes(len(states)) if notes is None else notes
    if notes.shape != (len(states), body.NOTES):
        raise SceneError(f"notes of shape {notes.shape}: {(len(states), body.NOTES)} is needed")
    p = setting.parameters()
    jobs = [
        (p, states[k : k + CHUNK], until, notes[k : k + CHUNK])
        for k in range(0, len(states), CHUNK)
    ]
    return joined(each(jobs, executor))


def joined(parts: Iterable[tuple[Array, Array]]) -> Run:
    """Chunks in their order as one run."""
    found = list(parts)
    return Run(
        np.concatenate([part[0] for part in found]), np.concatenate([part[1] for part in found])
    )


def each(
    jobs: list[Job], executor: Executor | None, tell: Callable[[int, int], None] | None = None
) -> list[tuple[Array, Array]]:
    """The chunks moved on, in the order given; `tell` hears how many are done, and of how many."""
    if len(jobs) == 1 and executor is None:
        return [moved(jobs[0])]
    if executor is None:
        with ThreadPoolExecutor(os.cpu_count()) as threads:
            return each(jobs, threads, tell)
    futures, done = [executor.submit(moved, job) for job in jobs], []
    try:
        for future in futures:
            done.append(future.result())
            if tell:
                tell(len(done), len(jobs))
    finally:
        for future in futures:
            future.cancel()  # where one failed, or the user has had enough
    return done
