"""What the paper gives of its three-degree-of-freedom simulation, what is inferred, and what is
chosen here; and where the results differ from it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from scenes.part.onsets import JITTER, Row
from scenes.part.setting import Scene
from scenes.part.sweeping import as_good, recorded

Standing = Literal["given", "inferred", "chosen"]
FACES = {
    "2x4": (0.01, 0.02),
    "1x2": (0.005, 0.01),
    "1x4": (0.005, 0.02),
}  # half sides in metres of the block's face in the plane
AMPLITUDES = {"peak": 1.0, "peak-to-peak": 0.5}


@dataclass(frozen=True)
class Assumption:
    """One entry: what it is about, its value in this run, where it comes from, and why."""

    name: str
    value: str
    standing: Standing
    why: str


def assumptions(setting: Scene, amplitudes: str, swept: bool) -> list[Assumption]:
    """All that a run of table I assumes; `swept` where e and mu are those of the stored sweep."""
    origin = "an option of this run"
    if swept:
        origin = (
            "the least misfit of the stored sweep, made before, with another seed;"
            f" {len(as_good(recorded()))} of its {len(recorded())} pairs are as good within scatter"
        )
    pair: Standing = "inferred" if swept else "chosen"
    phase = math.degrees(setting.phase_x - setting.phase_y)
    in_phase: Standing = "given" if phase == 0 else "chosen"
    return [
        Assumption("block", "1 x 2 x 4 cm, in a vertical plane", "given", "section 2.1"),
        Assumption(
            "face in the plane",
            f"{200 * setting.a:g} x {200 * setting.b:g} cm",
            "inferred",
            "sides of 1 : 2, for the still table parts 26 from 27 degrees; 2 x 4 or 1 x 2 cm",
        ),
        Assumption("restitution e", f"{setting.e:g}", pair, origin),
        Assumption("friction mu", f"{setting.mu:g}", pair, origin),
        Assumption(
            "vertical vibration",
            f"{1000 * setting.A_y:g} mm at {setting.f_y:g} Hz, a sine",
            "given",
            "table I",
        ),
        Assumption("amplitudes", amplitudes, "inferred", "the paper says magnitude"),
        Assumption(
            "phase along the table",
            f"{phase:g} degrees",
            in_phase,
            "in phase, figure 2; taken for table I too" if phase == 0 else "an option of this run",
        ),
        Assumption(
            "starts", "0 to 90 degrees by 1, lowest corner on the table", "given", "section 2.1"
        ),
        Assumption(
            "first speed",
            {"rest": "at rest", "table": "as fast as the table"}[setting.launch],
            "inferred",
            "not told; the sine starts at full speed",
        ),
        Assumption(
            "jitter",
            f"at most {JITTER:g} degrees",
            "chosen",
            "onsets scatter: only ensembles mean anything",
        ),
        Assumption(
            "impact",
            "five modes, restitution by Poisson",
            "inferred",
            "the paper names Routh, and Wang and Mason; derived anew",
        ),
        Assumption("gravity", f"{setting.g:g} m/s^2", "chosen", ""),
    ]


def discrepancies(rows: tuple[Row, ...]) -> list[str]:
    """Where the rows differ from the paper's: a row is chaotic on one side only, or the paper's
    onset is outside of the 16 to 84 percent.
    """
    told = []
    for row in rows:
        name, chaotic = f"{row.frequency:g} Hz {1000 * row.amplitude:g} mm", sum(row.chaotic)
        low, high = row.quantile(0.16), row.quantile(0.84)
        if (row.paper is None) != row.is_chaotic():
            printed = "chaotic" if row.paper is None else f"{row.paper:g} s"
            told.append(
                f"{name}: {printed} in the paper, {chaotic} of {len(row.chaotic)} ensembles are"
                " chaotic here"
            )
        elif row.paper is not None and not low <= row.paper <= high:
            told.append(
                f"{name}: {row.paper:g} s in the paper, outside of {low:.3g} to {high:.3g} s"
            )
    return told
