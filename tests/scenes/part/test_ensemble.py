"""Frames show the orbit that is followed without stops."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from math import nan

import numpy as np
import pytest

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body, run, scene, standing
from juggleproof.scenes.part.ensemble import CHUNK, frames

pytest.importorskip("numba", reason="numba, the extra `part`, is not installed")

SHAKEN = scene(e=0.7, mu=0.08, A_x=1e-3, f_x=30.0)
STICKY = scene(e=0.3, mu=0.9, A_x=2e-3, f_x=15.0)
ANGLES = np.radians(np.arange(91))


@pytest.mark.parametrize("setting", [SHAKEN, STICKY], ids=["free", "held"])
def test_frames_are_of_the_orbit_without_stops_holds(setting: object) -> None:
    assert isinstance(setting, type(SHAKEN))
    times = [0.0, 0.05, 0.8, 0.8, 1.5]
    seen = frames(setting, ANGLES, times)
    start = standing(setting, ANGLES)
    assert seen.shape == (5, 91, body.STATE) and (seen[0] == start).all()
    assert (seen[-1] == run(setting, start, times[-1]).states).all()
    for frame, time in zip(
        seen,
        times,
        # the last event before a stop may round otherwise: the stop cuts the step in which it is
        # looked
        # for
    ):
        assert np.abs(frame - run(setting, start, time).states).max() < 1e-9


def test_orbits_are_the_same_fails_without_one_orbit() -> None:
    """Why frames are not runs from one time to the next: the stop rounds, and chaos makes that
    another orbit.
    """
    half = run(SHAKEN, standing(SHAKEN, ANGLES), 0.8)
    stopped = run(SHAKEN, half.states, 1.5, notes=half.notes).states
    assert np.abs(stopped - frames(SHAKEN, ANGLES, [1.5])[0]).max() > 1e-3


def test_frames_do_not_depend_on_other_times_or_on_the_executor_holds() -> None:
    angles = np.linspace(0, 1.5, CHUNK + 5)
    seen = frames(SHAKEN, angles, np.linspace(0, 0.5, 31))
    assert (seen[[12, 30]] == frames(SHAKEN, angles, [seen[12, 0, body.TIME], 0.5])).all()
    with ThreadPoolExecutor(2) as threads:
        assert (seen == frames(SHAKEN, angles, np.linspace(0, 0.5, 31), threads)).all()
    assert (seen[:, :, body.TIME] == np.linspace(0, 0.5, 31)[:, None]).all()


@pytest.mark.parametrize("times", [[], [0.5, 0.2], [-1.0], [nan], [[0.1]], [1e9]])
def test_rejects_times_that_are_none(times: list[float]) -> None:
    with pytest.raises(SceneError, match="^times"):
        frames(SHAKEN, ANGLES, times)


def test_rejects_more_states_than_fit() -> None:
    with pytest.raises(SceneError, match="choose fewer times"):
        frames(SHAKEN, ANGLES, np.linspace(0, 1, 100_000))
