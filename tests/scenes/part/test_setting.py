"""Bad input is told in one line; executors do not change a byte; the juggler's scenes load nothing
of the part.
"""

from __future__ import annotations

import math
import multiprocessing
import re
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import (
    body,
    fresh_notes,
    moving,
    run,
    scene,
    standing,
    table_one,
)
from juggleproof.scenes.part.drive import harmonics
from juggleproof.scenes.part.ensemble import Job, advanced
from juggleproof.scenes.part.setting import Array
from tests.rows import each_row

ROOT = Path(__file__).resolve().parents[3]
BLOCK = scene(e=0.7, mu=0.08, f_x=30.0, A_x=2e-3)


@each_row(
    "wrong, message",
    [
        ({"mu": -0.1}, "mu = -0.1 is below 0"),
        ({"mu": 4 / 3}, "not below 4/3: from there on a corner can jam"),
        ({"mu": math.nan}, "mu = nan is not finite"),
        ({"e": -0.1}, "e = -0.1 is outside"),
        ({"e": 1.01}, "e = 1.01 is outside"),
        ({"e": "soft"}, "e = 'soft' is no number"),
        ({"e": math.inf}, "not finite"),
        ({"a": 0}, "a = 0 is not positive"),
        ({"b": -1}, "b = -1 is not positive"),
        ({"a": 0.03}, "longer than b"),
        ({"a": 1e-9}, "a = 1e-09 m is outside"),
        ({"b": 100}, "b = 100 m is outside"),
        ({"g": 0}, "g = 0 is not positive"),
        ({"g": 1e9}, "outside"),
        ({"A_y": -1e-4}, "A_y = -0.0001 is below 0"),
        ({"A_y": 5}, "A_y = 5 m is outside"),
        ({"f_x": -1}, "f_x = -1 is below 0"),
        ({"f_y": 1e9}, "f_y = 1e+09 Hz is outside"),
        ({"A_x": math.nan}, "A_x = nan"),
        ({"phase_y": 1e9}, "phase_y"),
        ({"rest_speed": 0}, "not positive"),
        ({"rest_speed": 50}, "rest_speed = 50 m/s is outside"),
        ({"tolerance": 1e-20}, "tolerance = 1e-20 m is outside"),
        ({"tolerance": 1}, "tolerance = 1 m is outside"),
        ({"a": 1e-4, "tolerance": 1e-5}, "above 0.01 of a"),
        ({"launch": "throw"}, "'throw'"),
    ],
)
def test_rejects_a_scene_that_is_not_one(wrong: dict[str, float | str], message: str) -> None:
    with pytest.raises(SceneError, match=re.escape(message)) as refused:
        scene(**{"e": 0.7, "mu": 0.08, **wrong})
    assert "\n" not in str(refused.value) and len(str(refused.value)) < 160


def refused(what: Callable[[], object]) -> str:
    with pytest.raises(SceneError) as found:
        what()
    assert "\n" not in str(found.value)
    return str(found.value)


def test_rejects_a_start_that_is_not_one() -> None:
    assert "1e-05 m into the table" in refused(lambda: moving(BLOCK, 0, 0.02 - 1e-5, 0, 0, 0, 0))
    assert "before the start" in refused(lambda: moving(BLOCK, 0, 1, 0, 0, 0, 0, t=-1))
    assert "V_X = nan" in refused(lambda: moving(BLOCK, 0, 1, 0, math.nan, 0, 0))
    assert "at most 1000 m/s" in refused(lambda: moving(BLOCK, 0, 1, 0, 1e4, 0, 0))
    assert "100000 rad/s" in refused(lambda: moving(BLOCK, 0, 1, 0, 0, 0, 1e200))
    assert "too many turns" in refused(lambda: moving(BLOCK, 0, 1, 1e6, 0, 0, 0))
    assert "too many turns" in refused(lambda: standing(BLOCK, [1e6]))
    for angles in ([], [[0.1]], [math.nan], [math.inf]):
        assert "one row of finite numbers" in refused(lambda angles=angles: standing(BLOCK, angles))


def test_rejects_a_run_that_is_not_one() -> None:
    states = standing(BLOCK, [0.1, 0.2])
    assert "time = -1 s is outside" in refused(lambda: run(BLOCK, states, -1))
    assert "time = nan" in refused(lambda: run(BLOCK, states, math.nan))
    assert "too late for a tolerance of 1e-12 m" in refused(lambda: run(BLOCK, states, 9e4))
    assert "is needed" in refused(lambda: run(BLOCK, states[0], 1)) and "is needed" in refused(
        lambda: run(BLOCK, states[:, :7], 1)
    )
    assert "finite" in refused(lambda: run(BLOCK, states * math.nan, 1)) and "finite" in refused(
        lambda: run(BLOCK, states[:0], 1)
    )
    assert "notes of shape" in refused(lambda: run(BLOCK, states, 1, notes=fresh_notes(3)))
    assert "horizon = 0" in refused(
        lambda: table_one(BLOCK, ensembles=1, horizon=0)
    ) and "outside" in refused(lambda: table_one(BLOCK, horizon=-2))
    assert "ensembles = 0" in refused(lambda: table_one(BLOCK, ensembles=0))


def test_run_that_cannot_go_on_is_reported_in_one_line_holds() -> None:
    p, states = BLOCK.parameters(), standing(BLOCK, [0.0, 0.6])
    p[body.FRICTION] = 5.0
    assert (
        "block 182 is stuck at t = 1.19366e-11 s, in flight, at X = 0 m, Y = 0.02 m, theta = 0, "
        in (message := refused(lambda: advanced(Job(p, states, 1.0, fresh_notes(2), 182))))
        and "friction is too large" in message
    )


def test_start_is_left_as_it_is_holds() -> None:
    states = standing(BLOCK, [0.1, 0.2])
    kept, after = states.copy(), run(BLOCK, states, 0.05)
    assert (
        (states == kept).all()
        and (after.states[:, body.TIME] == 0.05).all()
        and not (after.states == kept).all()
    )


def same_as_alone(executor: Executor) -> bool:
    states = standing(BLOCK, np.radians(np.linspace(0, 90, 300)))
    alone, shared = run(BLOCK, states, 0.5), run(BLOCK, states, 0.5, executor=executor)
    return (
        alone.states.tobytes() == shared.states.tobytes()
        and alone.notes.tobytes() == shared.notes.tobytes()
    )


@each_row("workers", [1, 2, 5])
def test_threads_give_the_same_bytes_holds(workers: int) -> None:
    with ThreadPoolExecutor(workers) as executor:
        assert same_as_alone(executor)


@pytest.mark.exhaust
def test_spawned_processes_give_the_same_bytes_holds() -> None:
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as executor:
        assert same_as_alone(executor)


def test_dask_cluster_gives_the_same_bytes_holds() -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=2, processes=True, dashboard_address=None
    ) as cluster:
        with cluster.get_client() as client:
            assert same_as_alone(client.get_executor())


def loaded_by(code: str) -> set[str]:
    shown = subprocess.run(
        [sys.executable, "-c", f"{code}\nimport sys; print(*sys.modules)"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    return set(shown.stdout.split())


def test_machine_code_is_kept_anew_where_a_compiled_file_changes_holds() -> None:
    folder = Path(body.__file__).parent
    assert set(body.KERNELS) == {
        path.stem
        for path in folder.glob("*.py")
        if re.search(r"(?m)^@(compiled|inlined|kernel)$", path.read_text(encoding="utf-8"))
    }
    assert (body.FOLDER is not None) is body.COMPILED


def test_door_loads_numba_only_when_a_name_is_used_holds() -> None:
    assert "numba" not in loaded_by("import juggleproof.scenes.part; dir(juggleproof.scenes.part)")
    assert "numba" in loaded_by("from juggleproof.scenes.part import scene")


@pytest.mark.exhaust
@each_row(
    "first",
    [
        "import juggleproof.scenes.part.onsets",
        "from juggleproof.scenes.part import sweep, table_one",
    ],
)
def test_names_of_the_door_mean_the_same_whatever_is_imported_first_holds(first: str) -> None:
    code = (
        f"{first}\nfrom juggleproof.scenes import part\n"
        "assert all(callable(getattr(part, name)) for name in part.__all__ if name.islower())"
    )
    assert loaded_by(code) and set(
        dir(__import__("juggleproof.scenes.part", fromlist=["part"]))
    ) >= {
        "run",
        "scene",
        "table_one",
        "sweep",
    }
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        getattr(__import__("juggleproof.scenes.part", fromlist=["part"]), "nothing")  # noqa: B009


def test_parts_of_a_kernel_are_what_they_are_in_plain_python_and_translated_once_holds() -> None:
    numba = pytest.importorskip("numba")
    p = scene(e=0.5, mu=0.3, drive=harmonics([(1e-3, 20, 0.5)], [(2e-4, 60, 0.1)])).parameters()

    def several(p: Array, t: float) -> tuple[float, float, float]:
        return body.table_lift(p, t), body.shaken(p, t, 0, 1), body.shaken(p, t, 1, 0)

    made = numba.njit(several, error_model="numpy", _nrt=False)
    assert all(made(p, t) == several(p, t) for t in (0.0, 0.3, 1.7))
    parts = dict(body.builtin_registry.globals)
    assert [len(parts[one].part.overloads) for one in (body.table_lift, body.shaken)] == [1, 1]
