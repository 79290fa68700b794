"""Many blocks at once: runs on any executor, frames for pictures, and blocks on a still table."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from math import atan, degrees, radians
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import NamedTuple, TypeVar
from zipfile import BadZipFile

import numpy as np

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body
from juggleproof.scenes.part.body import kernel_digest
from juggleproof.scenes.part.motion import follow_all, sample_all
from juggleproof.scenes.part.setting import LONGEST, Array, Scene, refuse_long, standing

# -------------------------------------------------------------------------------------------------
# Runs.
#
# Many blocks at once, chunks of them on any executor of `concurrent.futures`; the results do not
# depend on which.

CHUNK, MOST_CHUNKS = 91, 1000
WHY = {
    body.TOO_MANY_STEPS: "one flight or phase of contact took more than a million steps",
    body.JAMMED: "a corner jammed: friction is too large for the impact law",
    body.TOO_MANY_IMPACTS: "impacts at one time did not come to an end",
    body.TOO_MANY_EVENTS: "more than a million events in a second; a larger rest speed ends them",
}
CONTACT = {body.FLIGHT: "in flight", body.PIVOT: "on a corner", body.FACE: "on a face"}
J = TypeVar("J")  # a job
R = TypeVar("R")  # its result


@dataclass(frozen=True)
class EnsembleRun:
    """The states of blocks after a run, shape (n, 10), and their notes, shape (n, 16); columns are
    named in `juggleproof.scenes.part.body`.  `checked`: whether guarantees were checked.
    """

    states: Array
    notes: Array
    checked: bool

    def violations(self) -> dict[str, int]:
        """How often an impact broke a guarantee of the impact law, and a flight ended with a corner
        deeper in the table than the tolerance: all have to be 0.  Raises SceneError if guarantees
        were not checked.
        """
        if not self.checked:
            raise SceneError("a run that is not checked tells of no violations; give check=True")
        return {
            name: int(self.notes[:, column].sum())
            for name, column in (
                ("impulses that pull", body.PULLS),
                ("impulses outside the friction cone", body.CONES),
                ("energy gained", body.GAINS),
                ("corners left closing", body.CLOSINGS),
                ("corners too deep", body.SINKS),
            )
        }


def fresh_notes(count: int, since: float = 0.0) -> Array:
    """Notes, shape (count, 16), of blocks that have not moved yet; falls and rises are counted from
    the time `since` on.
    """
    notes = np.zeros((count, body.NOTES))
    notes[:, body.LEAST_GAP], notes[:, body.SINCE] = np.inf, since
    return notes


class Job(NamedTuple):
    """A chunk of blocks to be moved on to a time; `first` is the number of its first block."""

    parameters: Array
    states: Array
    until: float
    notes: Array
    first: int = 0


def advanced(job: Job) -> tuple[Array, Array]:
    """The states and notes of a chunk of blocks that is moved on; raises SceneError where a counted
    bound on the work is reached.
    """
    states, notes = job.states.copy(), job.notes.copy()
    _refuse_failed(states, follow_all(job.parameters, states, job.until, notes), job.first)
    return states, notes


def advanced_once(job: Job, keep: Path) -> tuple[Array, Array]:
    """The same; it is kept in a file of the folder `keep`, and read from there if it was computed
    before from the same numbers by the same kernels.
    """
    digest = hashlib.sha256(kernel_digest().encode())
    for part in (job.parameters, job.states, np.float64(job.until), job.notes):
        digest.update(part.tobytes())
    path = keep / f"{digest.hexdigest()[:32]}.npz"
    try:
        if not path.is_file():  # none, or a pipe, which might never end
            raise FileNotFoundError(path)
        with np.load(path, allow_pickle=False) as kept:
            states, notes = kept["states"], kept["notes"]
        if states.shape == job.states.shape and notes.shape == job.notes.shape:
            return states, notes
    except (OSError, ValueError, KeyError, BadZipFile):
        pass  # none, or one that was not written to its end
    states, notes = advanced(job)
    with NamedTemporaryFile(dir=keep, suffix=".part", delete=False) as file:
        np.savez(file, allow_pickle=False, states=states, notes=notes)
    os.replace(file.name, path)
    return states, notes


def worker(keep: Path | None) -> Callable[[Job], tuple[Array, Array]]:
    """The function that moves chunks on, and keeps them in a folder if there is one; raises
    SceneError for a folder that cannot be made.
    """
    if keep is None:
        return advanced
    try:
        keep.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        raise SceneError(f"{keep}: no folder to keep chunks in ({fault.strerror})") from None
    return partial(advanced_once, keep=keep)


def _refuse_failed(states: Array, codes: Array, first: int) -> None:
    """Raises SceneError for the first block whose run did not end as asked: where it is stuck."""
    for k in np.flatnonzero(codes):
        t, X, Y, theta, V_X, V_Y, omega = states[k, :7]
        raise SceneError(
            f"block {first + k} is stuck at t = {t:.6g} s, {CONTACT[states[k, body.MODE]]}, at"
            f" X = {X:.6g} m, Y = {Y:.6g} m, theta = {theta:.6g}, with V_X = {V_X:.3g} m/s,"
            f" V_Y = {V_Y:.3g} m/s, omega = {omega:.3g} rad/s: {WHY[int(codes[k])]}"
        )


def run(
    setting: Scene,
    states: Array,
    until: float,
    *,
    notes: Array | None = None,
    executor: Executor | None = None,
    check: bool = False,
    report: Callable[[int, int], None] | None = None,
    keep: Path | None = None,
) -> EnsembleRun:
    """Moves blocks on to the time `until`, in seconds; `states` of shape (n, 10) stay as they are.
    Raises SceneError for arrays of other shapes, and where a counted bound on the work is reached.
    `check`: whether broken guarantees are counted; `report` is called with the number of chunks
    that are done, and that of all; `keep`: a folder for chunks that are done, so that a run that
    was ended can go on.

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
    p = setting.parameters(check)
    size = max(CHUNK, -(-len(states) // MOST_CHUNKS))
    jobs = [
        Job(p, states[k : k + size], until, notes[k : k + size], k)
        for k in range(0, len(states), size)
    ]
    return joined(run_jobs(worker(keep), jobs, executor, report), check)


def joined(parts: Iterable[tuple[Array, Array]], checked: bool) -> EnsembleRun:
    """Chunks in their order as one run."""
    chunks = list(parts)
    return EnsembleRun(
        np.concatenate([part[0] for part in chunks]),
        np.concatenate([part[1] for part in chunks]),
        checked,
    )


def run_jobs(
    work: Callable[[J], R],
    jobs: Sequence[J],
    executor: Executor | None,
    report: Callable[[int, int], None] | None = None,
    done: list[R] | None = None,
) -> list[R]:
    """The results of the jobs, in the order given; `report` is called with the number of jobs that
    are done, and that of all.  A list `done` is filled as they end, and holds the results so far
    if the run is interrupted.
    """
    done = [] if done is None else done
    if len(jobs) == 1 and executor is None:
        done.append(work(jobs[0]))
        return done
    if executor is None:
        with ThreadPoolExecutor(os.cpu_count()) as threads:
            return run_jobs(work, jobs, threads, report, done)
    futures = [executor.submit(work, job) for job in jobs]
    try:
        for future in futures:
            done.append(future.result())
            if report:
                report(len(done), len(jobs))
    finally:
        for future in futures:
            future.cancel()  # if one failed, or the user interrupts
    return done


# -------------------------------------------------------------------------------------------------
# Frames.
#
# Many blocks at given times, for pictures; the orbit of a block is not stopped at these times.

MOST_STATES = 5_000_000


class FrameJob(NamedTuple):
    """A chunk of blocks, and the times at which their states are asked for."""

    parameters: Array
    states: Array
    times: Array
    first: int


def frames(
    setting: Scene,
    angles: Sequence[float] | Array,
    times: Sequence[float] | Array,
    executor: Executor | None = None,
) -> Array:
    """The states of blocks that start at these angles, in radians, at these times, in seconds,
    which do not fall: shape (len(times), n, 10).

    Each orbit is, to the last bit, the one that `run` follows to the last of the times; a run to an
    earlier one may round its last event differently.  Without an executor threads share the chunks.
    """
    at = np.asarray(times, dtype=float)
    if at.ndim != 1 or not len(at) or not np.isfinite(at).all() or (np.diff(at) < 0).any():
        raise SceneError("times: one row of finite numbers that do not fall is needed")
    if at[0] < 0 or at[-1] > LONGEST:
        raise SceneError(
            f"times from {at[0]:.6g} to {at[-1]:.6g} s are not within 0 .. {LONGEST:g}"
        )
    refuse_long(setting, float(at[-1]))
    states = standing(setting, angles)
    if len(states) * len(at) > MOST_STATES:
        raise SceneError(
            f"{len(states)} blocks at {len(at)} times are more than {MOST_STATES} states;"
            " choose fewer times"
        )
    jobs = [
        FrameJob(setting.parameters(), states[k : k + CHUNK], at, k)
        for k in range(0, len(states), CHUNK)
    ]
    return np.concatenate(run_jobs(sampled, jobs, executor), axis=1)


def sampled(job: FrameJob) -> Array:
    """A chunk of blocks at its times; raises SceneError where a counted bound on the work is
    reached.
    """
    states = job.states.copy()
    seen = np.zeros((len(states), len(job.times), body.STATE))
    notes = fresh_notes(len(states))
    codes = sample_all(job.parameters, states, job.times, notes, seen)
    _refuse_failed(states, codes, job.first)
    return np.ascontiguousarray(seen.transpose(1, 0, 2))


# -------------------------------------------------------------------------------------------------
# A still table.
#
# Blocks on a still table: on which face each comes to rest, and the starting angle that separates
# the two faces.
#
# Both are decided by geometry: a block that starts at rest on a corner falls to the side on which
# its centre is, and the sides meet at atan(a/b). The paper says that 0 to 26 degrees go to 0 and 27
# to 90 degrees to 90; so the sides that it shows are as 1 to 2.

DEGREES = tuple(range(91))
LAST_UPRIGHT, FIRST_LYING = 26, 27  # of the paper, in degrees
WIDTH = 1e-9  # degrees
MOST_HALVINGS = 60
LONGEST_SPLIT = 64.0  # seconds until all are at rest


@dataclass(frozen=True)
class EndSplit:
    """The angles, in degrees, at which blocks end that start at 0 to 90 degrees; a starting angle
    that ends at 0 and one that ends at 90; and atan(a/b), which separates them.
    """

    ends: tuple[int, ...]
    upright: float
    lying: float
    exact: float

    def as_printed(self) -> bool:
        """Whether 0 to 26 degrees end at 0, and 27 to 90 degrees at 90."""
        return self.ends == (0,) * (LAST_UPRIGHT + 1) + (90,) * (len(DEGREES) - FIRST_LYING)


def no_vibration(setting: Scene, executor: Executor | None = None) -> EndSplit:
    """The split of a scene's block on a still table, bisected to 1e-9 degrees between the two
    neighbours that end apart.

    >>> block = Scene(0.01, 0.02, 0.5, 0.3, 0, 0, 0, 0, 0, 0, 9.81, 1e-12, 1e-3, "rest")
    >>> split = no_vibration(block)
    >>> split.as_printed(), split.upright < split.exact < split.lying, round(split.lying, 6)
    (True, True, 26.565051)
    """
    if setting.shape is not None:
        raise SceneError("the angle that parts upright from lying is of a rectangle")
    still = replace(
        setting, A_x=0.0, f_x=0.0, phase_x=0.0, A_y=0.0, f_y=0.0, phase_y=0.0, drive=None
    )
    ends = ends_of(still, DEGREES, executor)
    first = ends.count(0)
    if ends != [0] * first + [90] * (len(ends) - first) or first in (0, len(ends)):
        raise SceneError(
            f"the blocks from 0 to 90 degrees are not parted once: {first} end upright,"
            f" {len(ends) - first} lying"
        )
    low, high = float(first - 1), float(first)
    for _ in range(MOST_HALVINGS):
        if high - low <= WIDTH:
            break
        middle = (low + high) / 2
        if ends_of(still, [middle])[0] == 90:
            high = middle
        else:
            low = middle
    return EndSplit(tuple(ends), low, high, degrees(atan(setting.a / setting.b)))


def ends_of(still: Scene, starts: Sequence[float], executor: Executor | None = None) -> list[int]:
    """The angle, 0 or 90 degrees, at which blocks come to rest that start at these angles, in
    degrees; raises SceneError if one does not come to rest.
    """
    states, notes, until = standing(still, [radians(start) for start in starts]), None, 1.0
    while until <= LONGEST_SPLIT:
        done = run(still, states, until, notes=notes, executor=executor)
        states, notes, until = done.states, done.notes, 2 * until
        if (states[:, body.MODE] == body.FACE).all():
            return [90 * int(edge % 2) for edge in states[:, body.CORNER]]
    moving = next(start for start, mode in zip(starts, states[:, body.MODE]) if mode != body.FACE)
    raise SceneError(
        f"the block that starts at {moving:g} degrees is not at rest after {LONGEST_SPLIT:g} s; e ="
        f" {still.e:g} is too near to 1"
    )


def in_words(split: EndSplit) -> str:
    """Where blocks end on a still table, and the angle that separates them.

    >>> split = EndSplit((0,) * 27 + (90,) * 64, 26.56, 26.57, 26.565)
    >>> print(in_words(split))  # doctest: +NORMALIZE_WHITESPACE
    Without vibration 27 blocks, 0 to 26 degrees, end upright, and 64, 27 to 90 degrees, lie, as the
    paper says. The two part
    between 26.5600000000 and 26.5700000000 degrees; atan(a/b) is 26.5650000000 degrees.
    """
    up, count = split.ends.index(90), len(split.ends)
    printed = (
        "as the paper says" if split.as_printed() else "where the paper says 0 to 26 and 27 to 90"
    )
    return (
        f"Without vibration {up} blocks, 0 to {up - 1} degrees, end upright, and {count - up}, {up}"
        f" to {count - 1} degrees, lie, {printed}. The two part between {split.upright:.10f} and"
        f" {split.lying:.10f} degrees; atan(a/b) is {split.exact:.10f} degrees."
    )
