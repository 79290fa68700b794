"""Table I of the paper over jittered ensembles, and its files."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body
from juggleproof.scenes.part.body import COMPILED
from juggleproof.scenes.part.ensemble import EnsembleRun, Job, fresh_notes, joined, run_jobs, worker
from juggleproof.scenes.part.setting import Array, Scene, changed, refuse_long, standing

# -------------------------------------------------------------------------------------------------
# Table I.
#
# Table I of the paper: from when on all 91 blocks lie, for six vibrations along the table; with one
# (e, mu) for all, over jittered ensembles.
#
# Onset of an ensemble: the last time at which any of its blocks is nearer to upright than to lying.
# An ensemble is chaotic if in the second half of the run blocks pass both ways, from upright to
# lying and from lying to upright; a row is chaotic if more than half of its ensembles are.  An
# ensemble that is not chaotic and has a block nearer to upright at the end is censored: its onset
# is later than the end of the run.

# frequency in hertz, amplitude in metres, and the onset in seconds that the paper prints; None:
# "chaotic"
PAPER: tuple[tuple[float, float, float | None], ...] = (
    (15.0, 2e-3, 4.0),
    (15.0, 4e-3, None),
    (30.0, 1e-3, 2.9),
    (30.0, 2e-3, 2.1),
    (60.0, 1e-4, 5.0),
    (60.0, 1e-3, 3.1),
)
ANGLES = 91  # 0, 1, ... 90 degrees
JITTER = 1e-6  # degrees, either way: of each start, and of each ensemble's phase
ENSEMBLES, HORIZON = 24, 12.0
MOST_ENSEMBLES = 100_000
MOST_POINTS = 10_000  # of a sweep


def ensembles_in_words(count: int) -> str:
    """How many ensembles.

    >>> ensembles_in_words(1)
    '1 ensemble'
    """
    return f"{count} ensemble{'' if count == 1 else 's'}"


@dataclass(frozen=True)
class OnsetRow:
    """One row: vibration along the table, the paper's onset, and for each ensemble its onset (inf:
    censored or chaotic) and whether it is chaotic.
    """

    frequency: float
    amplitude: float
    paper: float | None
    onsets: Array
    chaotic: tuple[bool, ...]
    horizon: float

    def quantile(self, part: float) -> float:
        """The onset of this quantile of the ensembles; inf if that is after the end of the run."""
        return float(np.sort(self.onsets)[max(0, int(np.ceil(part * len(self.onsets))) - 1)])

    def is_chaotic(self) -> bool:
        """Whether more than half of the ensembles are chaotic."""
        return 2 * sum(self.chaotic) > len(self.chaotic)

    def censored(self) -> int:
        """How many ensembles are not chaotic and have not settled at the end."""
        return int(np.isinf(self.onsets).sum()) - sum(self.chaotic)


@dataclass(frozen=True)
class OnsetTable:
    """The six rows, or those that are done, and the runs that they come from."""

    rows: tuple[OnsetRow, ...]
    run: EnsembleRun


def jittered(ensembles: int, seed: int) -> Array:
    """Starting angles in radians, shape (ensembles, 91): 0 to 90 degrees, each moved by at most a
    millionth of a degree.
    """
    if not 1 <= ensembles <= MOST_ENSEMBLES:
        raise SceneError(f"ensembles = {ensembles} is outside 1 .. {MOST_ENSEMBLES}")
    moves = np.random.default_rng(seed).uniform(-JITTER, JITTER, (ensembles, ANGLES))
    return np.radians(np.arange(ANGLES) + moves)


def jittered_phases(ensembles: int, seed: int) -> Array:
    """The shift of each ensemble's phase along the table, in radians, shape (ensembles,): at most a
    millionth of a degree.

    A block that comes to lie forgets the angle at which it started, but not the phase.
    """
    moves = np.random.default_rng((seed, 1)).uniform(-JITTER, JITTER, ensembles)
    return np.radians(moves)


def table_one(
    setting: Scene,
    *,
    ensembles: int = ENSEMBLES,
    horizon: float = HORIZON,
    seed: int = 1,
    peak: float = 1.0,
    executor: Executor | None = None,
    report: Callable[[int, int], None] | None = None,
    check: bool = False,
    keep: Path | None = None,
) -> OnsetTable:
    """Table I with the block, contact and vertical vibration of a scene; its vibration along the
    table is replaced by that of each row.

    The amplitude is `peak` times the printed one: 1, or 1/2 if prints are from peak to peak.
    `report` is called with the number of ensembles that are done, and that of all.  `check`:
    whether broken guarantees are counted; `keep`: a folder for what is done, as in `run`.
    Raises SceneError for numbers out of range, and without numba; `Interrupted`, with the rows that
    are done, if it is interrupted.
    """
    refuse_long(setting, horizon, "horizon")
    if horizon == 0:
        raise SceneError("horizon = 0 s leaves no time to settle in")
    if not COMPILED:
        raise SceneError("table I is computed by numba; install it with pip install numba")
    jobs: list[Job] = []
    starts = list(zip(jittered(ensembles, seed), jittered_phases(ensembles, seed)))
    for frequency, amplitude, _ in PAPER:
        for angles, moved in starts:
            shaken = changed(
                setting,
                f_x=frequency,
                A_x=peak * amplitude,
                phase_x=setting.phase_x + float(moved),
            )
            states, notes = standing(shaken, angles), fresh_notes(ANGLES, horizon / 2)
            p = shaken.parameters(check)
            jobs.append(Job(p, states, horizon, notes, len(jobs) * ANGLES))
    done: list[tuple[Array, Array]] = []
    try:
        run_jobs(worker(keep), jobs, executor, report, done)
    except KeyboardInterrupt:
        if len(done) < ensembles:
            raise
        raise Interrupted(_table(done, ensembles, horizon, check)) from None
    return _table(done, ensembles, horizon, check)


class Interrupted(KeyboardInterrupt):
    """An interrupted run; `table` has the rows all of whose ensembles were done by then."""

    def __init__(self, table: OnsetTable) -> None:
        self.table = table


def _table(
    done: Sequence[tuple[Array, Array]], ensembles: int, horizon: float, checked: bool
) -> OnsetTable:
    """The rows of `PAPER` that are done."""
    count = len(done) // ensembles
    rows = tuple(
        row_of(row, [notes for _, notes in done[k * ensembles : (k + 1) * ensembles]], horizon)
        for k, row in enumerate(PAPER[:count])
    )
    return OnsetTable(rows, joined(done[: count * ensembles], checked))


def row_of(row: tuple[float, float, float | None], notes: list[Array], horizon: float) -> OnsetRow:
    """A row of `PAPER` with the notes of its ensembles, each of shape (91, 16)."""
    chaotic = tuple(bool(one[:, body.RISES].any() and one[:, body.FALLS].any()) for one in notes)
    last = np.array([one[:, body.LAST_UPRIGHT].max() for one in notes])
    return OnsetRow(
        *row, np.where((last >= horizon) | np.array(chaotic), np.inf, last), chaotic, horizon
    )


# -------------------------------------------------------------------------------------------------
# Where the rows differ from the paper's.


def discrepancies(rows: tuple[OnsetRow, ...]) -> list[str]:
    """Where the rows differ from the paper's: a row is chaotic on one side only, or the paper's
    onset is outside of the range from 16 to 84 percent of the ensembles.
    """
    lines = []
    for row in rows:
        name, chaotic = f"{row.frequency:g} Hz {1000 * row.amplitude:g} mm", sum(row.chaotic)
        low, high = row.quantile(0.16), row.quantile(0.84)
        if (row.paper is None) != row.is_chaotic():
            printed = "chaotic" if row.paper is None else f"{row.paper:g} s"
            lines.append(
                f"{name}: {printed} in the paper, {chaotic} of {len(row.chaotic)} ensembles are"
                " chaotic here"
            )
        elif row.paper is not None and not low <= row.paper <= high:
            lines.append(
                f"{name}: {row.paper:g} s in the paper, outside of {low:.3g} to {high:.3g} s"
            )
    return lines


# -------------------------------------------------------------------------------------------------
# Files.
#
# Table I as files: CSV with a line for each ensemble, and NumPy arrays; the same to the byte
# from run to run.

HEADS = ("f_x [Hz]", "A_x [m]", "paper [s]", "ensemble", "onset [s]", "chaotic", "censored")


def as_csv(table: OnsetTable, file: BinaryIO) -> None:
    """Writes a line for each row and ensemble; the onset is left out where the ensemble is chaotic
    or censored.
    """
    text = io.TextIOWrapper(file, encoding="utf-8", newline="", write_through=True)
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow(HEADS)
    for row in table.rows:
        for k, (onset, chaotic) in enumerate(zip(row.onsets.tolist(), row.chaotic)):
            settled = np.isfinite(onset)
            lines.writerow(
                [
                    row.frequency,
                    row.amplitude,
                    "chaotic" if row.paper is None else row.paper,
                    k,
                    repr(onset) if settled else "",
                    int(chaotic),
                    int(not settled and not chaotic),
                ]
            )
    text.detach()


def as_npz(table: OnsetTable, file: BinaryIO) -> None:
    """Writes arrays: f_x [Hz], A_x [m] and paper [s, nan for chaotic] of shape (6,); onset [s] and
    chaotic (6, ensembles); and of each block, (6, ensembles, 91), the last time nearer to upright
    [s], the number of impacts, and its angle at the end [rad].
    """
    rows, ensembles = table.rows, len(table.rows[0].chaotic)
    shape = (len(rows), ensembles, -1)
    arrays = {
        "f_x": np.array([row.frequency for row in rows]),
        "A_x": np.array([row.amplitude for row in rows]),
        "paper": np.array([np.nan if row.paper is None else row.paper for row in rows]),
        "onset": np.array([row.onsets for row in rows]),
        "chaotic": np.array([row.chaotic for row in rows]),
        "last_upright": table.run.notes[:, body.LAST_UPRIGHT].reshape(shape),
        "impacts": table.run.notes[:, body.IMPACTS].reshape(shape),
        "theta": table.run.states[:, body.THETA].reshape(shape),
    }
    np.savez_compressed(file, allow_pickle=False, **arrays)
