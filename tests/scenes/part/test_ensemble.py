"""Ensembles: frames of their orbits, and the split of a still table."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from math import atan, degrees, nan
from pathlib import Path

import numpy as np
import pytest

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body, run, scene, standing
from juggleproof.scenes.part.ensemble import CHUNK, WIDTH, ends_of, frames, no_vibration
from tests.rows import each_row

# -------------------------------------------------------------------------------------------------
# Frames show the orbit that is followed without stops.

pytest.importorskip("numba", reason="numba, the extra `part`, is not installed")

SHAKEN = scene(e=0.7, mu=0.08, A_x=1e-3, f_x=30.0)
STICKY = scene(e=0.3, mu=0.9, A_x=2e-3, f_x=15.0)
ANGLES = np.radians(np.arange(91))


@pytest.mark.exhaust
@each_row("setting", [SHAKEN, STICKY])
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


@each_row("times", [[], [0.5, 0.2], [-1.0], [nan], [[0.1]], [1e9]])
def test_rejects_times_that_are_none(times: list[float]) -> None:
    with pytest.raises(SceneError, match="^times"):
        frames(SHAKEN, ANGLES, times)


def test_rejects_more_states_than_fit() -> None:
    with pytest.raises(SceneError, match="choose fewer times"):
        frames(SHAKEN, ANGLES, np.linspace(0, 1, 100_000))


# -------------------------------------------------------------------------------------------------
# What is done is kept: a run that was ended goes on from there.


class Ended(Exception):
    """Raised by a report, as an interrupt would be."""


def test_run_that_was_ended_goes_on_from_what_is_kept_holds(tmp_path: Path) -> None:
    states = standing(SHAKEN, np.linspace(0, 1.5, 3 * CHUNK))
    told: list[tuple[int, int]] = []

    def report(done: int, of: int) -> None:
        told.append((done, of))
        if done == 2:
            raise Ended

    with ThreadPoolExecutor(1) as one, pytest.raises(Ended):
        run(SHAKEN, states, 0.2, executor=one, report=report, keep=tmp_path)
    kept = {file: file.stat().st_mtime_ns for file in tmp_path.iterdir()}
    assert told == [(1, 3), (2, 3)] and len(kept) >= 2
    next(iter(kept)).write_bytes(b"half of a file")
    again = run(SHAKEN, states, 0.2, keep=tmp_path)
    plain = run(SHAKEN, states, 0.2)
    assert (again.states == plain.states).all() and (again.notes == plain.notes).all()
    assert len(list(tmp_path.iterdir())) == 3
    assert sum(file.stat().st_mtime_ns == at for file, at in kept.items()) == len(kept) - 1


def test_kept_chunks_are_not_those_of_another_run_holds(tmp_path: Path) -> None:
    states = standing(SHAKEN, ANGLES)
    run(SHAKEN, states, 0.1, keep=tmp_path)
    for other, until, check in ((STICKY, 0.1, False), (SHAKEN, 0.2, False), (SHAKEN, 0.1, True)):
        found = run(other, states, until, keep=tmp_path, check=check)
        assert (found.states == run(other, states, until).states).all()
    assert len(list(tmp_path.iterdir())) == 4


def test_rejects_a_folder_that_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(SceneError, match="no folder to keep chunks in"):
        run(SHAKEN, standing(SHAKEN, [0.1]), 0.1, keep=tmp_path / "file")


# -------------------------------------------------------------------------------------------------
# Without vibration, blocks part at atan(a/b), whatever restitution and friction are.

pytest.importorskip("numba", reason="numba, the extra `part`, is not installed")


@each_row(("e", "mu"), [(0.7, 0.08), (0.0, 0.0), (0.4, 1.0), (0.9, 0.3)])
def test_split_is_as_printed_and_at_the_exact_angle_holds(e: float, mu: float) -> None:
    found = no_vibration(scene(e=e, mu=mu, A_x=1e-3, f_x=30.0))
    assert found.as_printed() and 0 < found.lying - found.upright <= WIDTH
    assert found.upright < found.exact == degrees(atan(0.5)) < found.lying


def test_split_as_printed_fails_without_sides_of_one_to_two() -> None:
    """1 x 4 cm in the plane: 14 degrees is the last to stand up."""
    found = no_vibration(scene(e=0.7, mu=0.08, a=0.005, b=0.02))
    assert not found.as_printed() and found.ends.index(90) == 15
    assert found.upright - WIDTH < degrees(atan(0.25)) < found.lying + WIDTH


def test_square_is_parted_at_45_degrees_holds() -> None:
    found = no_vibration(scene(e=0.5, mu=0.3, a=0.01, b=0.01))
    assert found.upright - WIDTH <= 45 <= found.lying + WIDTH


def test_rejects_a_block_that_does_not_come_to_rest() -> None:
    with pytest.raises(SceneError, match="not at rest after 64 s; e = 1 is too near to 1"):
        ends_of(scene(e=1.0, mu=0.0, A_y=0.0, f_y=0.0), [10.0])


def test_rejects_ends_that_are_not_parted_once(monkeypatch: pytest.MonkeyPatch) -> None:
    from juggleproof.scenes.part import ensemble

    for ends in ([0] * 91, [90] * 91, [0, 90, *[0] * 89]):
        monkeypatch.setattr(ensemble, "ends_of", lambda *_, ends=ends: ends)
        with pytest.raises(SceneError, match="not parted once"):
            no_vibration(scene(e=0.7, mu=0.08))
