"""What simulations show of the paper's sentences about motion: the figures that are kept in
`figures.json`, which `compute` computes; nothing here is proved.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import TypedDict

from juggleproof.statements.language import ClaimError

RECORD = Path(__file__).with_suffix(".json")
HEIGHTS, SPEEDS = (0, 20), (-10, 10)  # x and w of the starts outside R


class Still(TypedDict):
    """How many of the blocks from 0 to 90 degrees end upright and lying on a still table, and the
    starting angles, in degrees, between which they part.
    """

    upright: int
    lying: int
    between: list[float]


class FrameCounts(TypedDict):
    """Numbers of each ensemble: upright blocks at 0.8 s; pairs of neighbours, a degree apart, with
    one upright then; upright blocks at 3 s.
    """

    upright: list[int]
    apart: list[int]
    late: list[int]


class Onset(TypedDict):
    """A row of table I: vibration in Hz and mm, the paper's onset in seconds or None, the median
    and the 16 and 84 percent of ours, None where they are chaotic or later than the run, how many
    ensembles are chaotic, how many have not settled at the end, and how often a block rises from
    lying in the second half of the runs.
    """

    frequency: float
    amplitude: float
    paper: float | None
    median: float | None
    low: float | None
    high: float | None
    chaotic: int
    censored: int
    rises: int


class EntryTimes(TypedDict):
    """Of starts outside R: how many, and the time until R in parts of t_R, median and greatest."""

    alpha: str
    starts: int
    median: float
    greatest: float


class Given(TypedDict):
    """The reading of table I: the face in the plane, what an amplitude is, the phases in degrees,
    restitution and friction.
    """

    face: str
    amplitudes: str
    phase_x: float
    phase_y: float
    e: float
    mu: float


class Figures(TypedDict):
    """All that is kept."""

    seed: int
    ensembles: int
    reading: Given
    still: Still
    frame: FrameCounts
    table: list[Onset]
    region: list[EntryTimes]


@cache
def figures() -> Figures:
    """The figures that are kept.  Raises ClaimError, one line, where they cannot be read."""
    try:
        kept: Figures = json.loads(RECORD.read_text(encoding="utf-8"))
    except (OSError, ValueError) as fault:
        raise ClaimError(
            f"{RECORD.name}: {type(fault).__name__}; restore it from the repository, or run"
            " python -m juggleproof.proofs.simulations.compute"
        ) from None
    return kept
