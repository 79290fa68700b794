"""Table I of the paper: from when on all 91 blocks lie, for six vibrations along the table; with
one (e, mu) for all, over jittered ensembles.

Onset of an ensemble: the last time at which any of its blocks is nearer to upright than to lying.
An ensemble is chaotic if in the second half of the run blocks pass both ways, from upright to lying
and from lying to upright; a row is, if more than half of its ensembles are.  An ensemble with a
block nearer to upright at the end, and not chaotic, is censored: its onset is later than the run is
long.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np

from scenes.errors import SceneError
from scenes.part import body
from scenes.part.compiling import COMPILED
from scenes.part.ensemble import Job, Run, each, fresh_notes, joined
from scenes.part.setting import Array, Scene, changed, refuse_long, standing

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
JITTER = 1e-6  # degrees, either way
ENSEMBLES, HORIZON = 24, 12.0
MOST_ENSEMBLES = 100_000


@dataclass(frozen=True)
class Row:
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
        """The onset that this part of the ensembles has reached; inf where that is after the end of
        the run.
        """
        return float(np.sort(self.onsets)[max(0, int(np.ceil(part * len(self.onsets))) - 1)])

    def is_chaotic(self) -> bool:
        """Whether more than half of the ensembles are."""
        return 2 * sum(self.chaotic) > len(self.chaotic)

    def censored(self) -> int:
        """How many ensembles, not chaotic, have not settled at the end."""
        return int(np.isinf(self.onsets).sum()) - sum(self.chaotic)


@dataclass(frozen=True)
class Table:
    """The six rows, and the runs that they come from."""

    rows: tuple[Row, ...]
    run: Run


def jittered(ensembles: int, seed: int) -> Array:
    """Starting angles in radians, shape (ensembles, 91): 0 to 90 degrees, each moved by at most a
    millionth of a degree.
    """
    if not 1 <= ensembles <= MOST_ENSEMBLES:
        raise SceneError(f"ensembles = {ensembles} is outside 1 .. {MOST_ENSEMBLES}")
    moves = np.random.default_rng(seed).uniform(-JITTER, JITTER, (ensembles, ANGLES))
    return np.radians(np.arange(ANGLES) + moves)


def table_one(
    setting: Scene,
    *,
    ensembles: int = ENSEMBLES,
    horizon: float = HORIZON,
    seed: int = 1,
    peak: float = 1.0,
    executor: Executor | None = None,
    tell: Callable[[int, int], None] | None = None,
) -> Table:
    """Table I with the block, contact and vertical vibration of a scene; its vibration along the
    table is replaced by that of each row.

    `peak` is how much of a printed amplitude is the amplitude: 1, or 1/2 where prints are from peak
    to peak.  `tell` hears how many ensembles are done, and of how many.
    """
    refuse_long(setting, horizon, "horizon")
    if horizon == 0:
        raise SceneError("horizon = 0 s leaves no time to settle in")
    if not COMPILED:
        raise SceneError("table I is computed by numba; install it with pip install -e '.[part]'")
    jobs: list[Job] = []
    angles = jittered(ensembles, seed)
    for frequency, amplitude, _ in PAPER:
        shaken = changed(setting, f_x=frequency, A_x=peak * amplitude)
        p = shaken.parameters()
        jobs += [
            (p, standing(shaken, row), horizon, fresh_notes(ANGLES, horizon / 2)) for row in angles
        ]
    done = each(jobs, executor, tell)
    rows = tuple(
        judged(row, [notes for _, notes in done[k * ensembles : (k + 1) * ensembles]], horizon)
        for k, row in enumerate(PAPER)
    )
    return Table(rows, joined(done))


def judged(row: tuple[float, float, float | None], notes: list[Array], horizon: float) -> Row:
    """A row of `PAPER` with the notes of its ensembles."""
    chaotic = tuple(bool(one[:, body.RISES].any() and one[:, body.FALLS].any()) for one in notes)
    last = np.array([one[:, body.LAST_UPRIGHT].max() for one in notes])
    return Row(
        *row, np.where((last >= horizon) | np.array(chaotic), np.inf, last), chaotic, horizon
    )
