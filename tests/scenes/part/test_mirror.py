"""A mirrored start on the mirrored table gives the mirrored orbit, bit for bit: impacts, contact
and rest prefer no side.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from juggleproof.scenes.part import body, run, scene, standing
from juggleproof.scenes.part.onsets import PAPER

ANGLES = np.radians(np.arange(91.0))
EVEN = [body.TIME, body.Y, body.V_Y, body.MODE]
ODD = [body.X, body.THETA, body.V_X, body.OMEGA, body.SLIDE]
COUNTED = [body.IMPACTS, body.STEPS, body.CONTACTS, body.LEAST_GAP, body.LARGEST_REMOVED]
MIRRORED_CORNER = np.array([1, 0, 3, 2])
SCENES: list[dict[str, Any]] = [
    *({"e": 0.7, "mu": 0.08, "row": row} for row in range(6)),
    {"e": 0.7, "mu": 0.08, "row": 2, "tolerance": 1e-9},
    {"e": 0.7, "mu": 0.08, "row": 3, "tolerance": 1e-6},
    {"e": 0.4, "mu": 1.2, "row": 3},
    {"e": 0.7, "mu": 1.2, "row": 4},
    {"e": 0.0, "mu": 0.08, "row": 1},
    {"e": 1.0, "mu": 0.08, "row": 5},
    {"e": 0.0, "mu": 0.0, "row": 0},
    {"e": 0.5, "mu": 0.3, "row": 2, "a": 0.02, "b": 0.02},
    {"e": 0.7, "mu": 0.3, "row": 1, "launch": "table", "phase_x": 1.0},
]


@pytest.mark.parametrize("given", SCENES, ids=str)
def test_mirrored_start_gives_the_mirrored_orbit_holds(given: dict[str, Any]) -> None:
    numbers = {name: value for name, value in given.items() if name != "row"}
    frequency, amplitude, _ = PAPER[given["row"]]
    here, there = (scene(f_x=frequency, A_x=sign * amplitude, **numbers) for sign in (1, -1))
    right, left = run(here, standing(here, ANGLES), 3.0), run(there, standing(there, -ANGLES), 3.0)
    assert (right.states[:, EVEN] == left.states[:, EVEN]).all()
    assert (right.states[:, ODD] == -left.states[:, ODD]).all()
    assert (right.notes[:, COUNTED] == left.notes[:, COUNTED]).all()
    pivots = right.states[:, body.MODE] == body.PIVOT
    faces = right.states[:, body.MODE] == body.FACE
    corners = [one.states[:, body.CORNER] for one in (right, left)]
    assert (MIRRORED_CORNER[corners[0][pivots].astype(int)] == corners[1][pivots]).all()
    assert (corners[0][faces] == -corners[1][faces]).all()
    assert right.notes[:, body.IMPACTS].sum() > 91


def test_mirror_fails_without_the_mirrored_table() -> None:
    frequency, amplitude, _ = PAPER[2]
    here = scene(e=0.7, mu=0.08, f_x=frequency, A_x=amplitude)
    right, left = run(here, standing(here, ANGLES), 0.5), run(here, standing(here, -ANGLES), 0.5)
    assert not (right.states[:, ODD] == -left.states[:, ODD]).all()


def test_upright_block_on_a_table_that_goes_up_and_down_stays_upright_holds() -> None:
    block = scene(e=0.7, mu=0.08, A_y=1e-3)
    after = run(block, standing(block, [0.0, np.pi / 2, -np.pi / 2]), 2.0)
    assert (after.states[0, [body.X, body.THETA, body.V_X, body.OMEGA]] == 0).all()
    assert (after.states[1:, body.X] == 0).all() and after.notes[:, body.IMPACTS].min() >= 10
