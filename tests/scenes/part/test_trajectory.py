"""Trajectories of named parts are the orbits that `run` follows; their columns are the same in CSV,
NPZ, Parquet and pandas; a notebook shows them.
"""

from __future__ import annotations

import csv
import io
import sys
from base64 import b64encode

import numpy as np
import pytest

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body, moving, run, scene, standing, table_one
from juggleproof.scenes.part.onsets import Row, Table
from juggleproof.scenes.part.trajectory import Trajectories, start_of, trajectories

pytest.importorskip("numba", reason="numba, the extra `part`, is not installed")
BLOCK = scene(e=0.7, mu=0.08, f_x=30.0, A_x=1e-3)
NAMES = ("part", "t", "X", "Y", "theta", "V_X", "V_Y", "omega", "contact")


def followed() -> Trajectories:
    starts = {
        "theta=20": start_of(BLOCK, theta=20),
        "thrown": start_of(BLOCK, theta=50, x=3, y=40, vx=0.2, vy=-0.1, omega=90),
    }
    return trajectories(BLOCK, starts, np.linspace(0.0, 0.8, 41))


def test_each_part_follows_its_own_orbit_holds() -> None:
    found = followed()
    states = np.concatenate([standing(BLOCK, [np.radians(20.0)]), thrown()])
    assert (found.states[0] == states).all()
    assert (found.states[-1] == run(BLOCK, states, 0.8).states).all()
    alone = trajectories(BLOCK, {"one": thrown()}, found.times)
    assert (alone.states[:, 0] == found.states[:, 1]).all()


def thrown() -> np.ndarray:
    return moving(BLOCK, 0.003, 0.04, np.radians(50.0), 0.2, -0.1, np.radians(90.0))


def written(form: str) -> io.BytesIO:
    file = io.BytesIO()
    followed().write(file, form)
    file.seek(0)
    return file


def test_columns_are_named_and_the_same_in_all_files_holds() -> None:
    columns = followed().columns()
    assert tuple(one.name for one in columns) == NAMES
    assert {len(one.values) for one in columns} == {82}
    rows = list(csv.reader(io.StringIO(written(".csv").read().decode())))
    assert rows[0] == [one.head() for one in columns] and rows[0][1] == "t [s]" and len(rows) == 83
    arrays = np.load(written(".npz"))
    assert tuple(arrays) == NAMES
    for place, one in enumerate(columns):
        assert (arrays[one.name] == one.values).all()
        texts = [row[place] for row in rows[1:]]
        if one.values.dtype.kind == "f":
            assert [float(text) for text in texts] == one.values.tolist()
        else:
            assert texts == one.values.tolist()
    assert {*arrays["part"].tolist()} == {"theta=20", "thrown"}
    assert {*arrays["contact"].tolist()} <= {"in flight", "on a corner", "on a face"}


def test_files_are_the_same_from_run_to_run_holds() -> None:
    assert all(written(form).read() == written(form).read() for form in (".csv", ".npz"))


def test_parquet_has_the_same_columns_holds() -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    table = parquet.read_table(written(".parquet"))
    assert tuple(table.column_names) == NAMES
    assert table.schema.field("theta").metadata == {b"unit": b"rad"}
    for one in followed().columns():
        assert table[one.name].to_pylist() == one.values.tolist()


def test_pandas_has_the_same_columns_holds() -> None:
    pytest.importorskip("pandas")
    frame = followed().to_pandas()
    assert tuple(frame.columns) == NAMES
    assert all((frame[one.name] == one.values).all() for one in followed().columns())


def test_rejects_what_a_missing_library_would_do(monkeypatch: pytest.MonkeyPatch) -> None:
    for library in ("pandas", "pyarrow"):
        monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(SceneError, match="^pandas is needed for a data frame; install it with pip"):
        followed().to_pandas()
    with pytest.raises(SceneError, match="^pyarrow is needed for Parquet; install it with pip"):
        written(".parquet")
    with pytest.raises(SceneError, match="'.xls' is no form of columns: choose from .csv, .npz"):
        written(".xls")


def test_a_notebook_shows_table_and_picture_holds() -> None:
    pytest.importorskip("matplotlib")
    shown = followed()._repr_html_()
    assert shown.count("<tr>") == 13 and "and 70 more rows" in shown
    assert "<th>theta [rad]</th>" in shown and "<td>theta=20</td>" in shown
    drawn = b64encode(followed().picture()).decode()
    assert (
        f'<img src="data:image/svg+xml;base64,{drawn}"' in shown
        and "2 parts at 41 times from 0 to 0.8 s" in shown
    )


def test_a_notebook_shows_the_table_alone_without_matplotlib_holds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    shown = followed()._repr_html_()
    assert "matplotlib is needed for a picture" in shown and "<img" not in shown


def test_runs_and_table_one_are_shown_too_holds() -> None:
    done = run(BLOCK, standing(BLOCK, [0.1, 0.2]), 0.2)
    columns = {one.name: one.values for one in done.columns()}
    assert (columns["theta"] == done.states[:, body.THETA]).all()
    assert (columns["impacts"] == done.notes[:, body.IMPACTS]).all()
    assert done._repr_html_().count("<tr>") == 3
    table = table_one(BLOCK, ensembles=2, horizon=0.05)
    columns = {one.name: one.values for one in table.columns()}
    assert columns["f_x"].tolist() == [15.0, 15.0, 30.0, 30.0, 60.0, 60.0]
    assert np.isnan(columns["paper"]).tolist() == [False, True, False, False, False, False]
    assert (columns["chaotic"] + columns["censored"]).tolist() == [2] * 6
    assert table._repr_html_().count("<tr>") == 7 and "Table I" in table.title()


def test_rejects_starts_and_times_that_are_none() -> None:
    with pytest.raises(SceneError, match="no part is given"):
        trajectories(BLOCK, {}, [0.0])
    with pytest.raises(SceneError, match="starts of shape"):
        trajectories(BLOCK, {"two": standing(BLOCK, [0.0, 1.0])}, [0.0])
    with pytest.raises(SceneError, match="puts the lowest corner"):
        start_of(BLOCK, theta=0, y=5)
    with pytest.raises(SceneError, match="times: one row of finite numbers that do not fall"):
        trajectories(BLOCK, {"one": start_of(BLOCK, theta=0)}, [1.0, 0.0])


def test_a_picture_of_table_one_counts_what_has_no_onset_holds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pytest.importorskip("matplotlib")
    from juggleproof.drawing.drawing import Plane

    dots: dict[str, int] = {}
    words: list[str] = []
    monkeypatch.setattr(
        Plane, "dots", lambda self, at, name, *_, **__: dots.update({name: len(at)})
    )
    monkeypatch.setattr(Plane, "words", lambda self, at, label, *_, **__: words.append(label))
    onsets = np.array([3.0, 5.0, np.inf, np.inf, np.inf])
    some = Row(15.0, 2e-3, 4.0, onsets, (False, False, True, False, False), 12.0)
    none = Row(15.0, 4e-3, None, np.full(5, np.inf), (True,) * 5, 12.0)
    table = Table((some, none), run(BLOCK, standing(BLOCK, [0.1]), 0.2))
    assert table.picture().startswith(b"<?xml") and table.picture() == table.picture()
    assert dots["row-0"] == 2 and "row-1" not in dots
    below = ["15 Hz, 2 mm", "chaotic: 1", "later: 2", "15 Hz, 4 mm", "chaotic: 5", "later: 0"]
    assert [word for word in words if word in below][:6] == below
    assert "printed: chaotic" in words and any("5 ensembles" in word for word in words)
