"""Onsets over two parameters are those of table I where the vibrations are the same; the least
drive that clears a face is clear from there on; pictures show what is counted.
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import scene, table_one
from juggleproof.scenes.part.onsets import PAPER, Row
from juggleproof.scenes.part.resting import ANY_ANGLE, listed, orientation, wilson
from juggleproof.scenes.part.setting import changed
from juggleproof.scenes.part.sweeps import Clearing, OnsetMap, clearing, onset_map, parameters

pytest.importorskip("numba", reason="numba, the extra `part`, is not installed")
BLOCK = scene(e=0.7, mu=0.08)


def test_points_are_the_rows_of_table_one_holds() -> None:
    grid = {"frequency": [15.0, 30.0], "amplitude": [2.0, 4.0]}
    found = onset_map(BLOCK, grid, ensembles=2, horizon=1.5, seed=5)
    table = table_one(BLOCK, ensembles=2, horizon=1.5, seed=5)
    for pair, row in zip(found.values().tolist(), found.rows):
        printed = [k for k, one in enumerate(PAPER) if [one[0], 1000 * one[1]] == pair]
        for k in printed:
            assert row.onsets.tolist() == table.rows[k].onsets.tolist()
            assert row.chaotic == table.rows[k].chaotic
    assert sum(found.counts()) == 4 == len(found.rows)


def test_any_parameter_is_set_in_its_unit_holds() -> None:
    for name, field, value in (
        ("e", "e", 3.0 / 4),
        ("mu", "mu", 0.75),
        ("frequency", "f_x", 0.75),
        ("amplitude", "A_x", 0.375e-3),
        ("phase", "phase_x", np.radians(0.75)),
        ("frequency-up", "f_y", 0.75),
        ("amplitude-up", "A_y", 0.375e-3),
    ):
        changed_to = parameters(0.5)[name].set_in(BLOCK, 0.75)
        assert np.isclose(getattr(changed_to, field), value)
        assert replace(changed_to, **{field: getattr(BLOCK, field)}) == BLOCK


def test_the_order_of_a_sweep_is_told_with_its_values_holds() -> None:
    grid = {"mu": [0.1, 0.2], "amplitude": [1.0, 2.0]}
    found = onset_map(changed(BLOCK, f_x=30.0), grid, ensembles=1, horizon=0.3)
    assert found.values().tolist() == [[0.1, 1.0], [0.1, 2.0], [0.2, 1.0], [0.2, 2.0]]
    alone = onset_map(
        changed(BLOCK, f_x=30.0), {"mu": [0.2], "amplitude": [1.0]}, ensembles=1, horizon=0.3
    )
    assert alone.rows[0].onsets.tolist() == found.rows[2].onsets.tolist()


def drawn_map() -> OnsetMap:
    def row(onsets: list[float], chaotic: bool) -> Row:
        return Row(1.0, 1e-3, None, np.array(onsets), (chaotic,) * 2, 12.0)

    rows = [
        row([1, 2], False),
        row([np.inf] * 2, True),
        row([np.inf] * 2, False),
        row([3, 4], False),
    ]
    return OnsetMap(BLOCK, {"e": [0.5, 0.6], "mu": [0.1, 0.2]}, ("", ""), (*rows, rows[1], rows[1]))


def test_picture_counts_what_it_shows_holds() -> None:
    pytest.importorskip("matplotlib")
    whole = replace(drawn_map(), grid={"e": [0.5, 0.6], "mu": [0.1, 0.2, 0.3]})
    assert whole.counts() == (2, 3, 1)
    assert "6 points of 2 ensembles, 12 s each: 2 settle, 3 are chaotic, 1 have" in whole.title()
    picture = whole.picture()
    assert picture == whole.picture() and picture.startswith(b"<?xml")
    ids = re.findall(r'id="([^"]*)"', picture.decode())
    assert len(ids) == len(set(ids)) and all(one.startswith("onsets-") for one in ids)
    with pytest.raises(SceneError, match="6 of 4 points are not drawn"):
        drawn_map().picture()


def found_clearing(*left: int) -> Clearing:
    values = tuple(0.5 * k for k in range(len(left)))
    return Clearing(BLOCK, (0, 2), "amplitude-up", "mm", values, left, 50, ANY_ANGLE, 3.0)


def test_least_drive_is_clear_there_and_above_holds() -> None:
    found = found_clearing(9, 0, 4, 0, 0)
    assert found.least() == 1.5 and found.islands() == [0.5]
    lines = found.in_words()
    assert "1.5 mm is the least of the grid that clears faces 0, 2, there and at all 1" in lines[0]
    assert f"0 of 50 parts are left, a probability of at most {wilson(0, 50)[1]:.2%}" in lines[0]
    assert (
        lines[1]
        == "below it, at amplitude-up 1 mm, 4 of 50 are left; nothing was run between the two"
    )
    assert lines[2] == "not monotone: none is left at 0.5, but at larger ones"


def test_least_drive_fails_without_a_clear_end() -> None:
    found = found_clearing(9, 0, 0, 1)
    assert found.least() is None and found.islands() == [0.5, 1.0]
    assert "no amplitude-up of the grid clears faces 0, 2 for good" in found.in_words()[0]
    assert found_clearing(0, 0).least() == 0.0 and len(found_clearing(0, 0).in_words()) == 1


def test_clearing_counts_the_parts_of_each_orientation_holds() -> None:
    block = changed(BLOCK, f_x=30.0, A_x=1e-3)
    grid = {"amplitude-up": [0.05, 0.3]}
    found = clearing(block, [0, 2, 2], grid, starts=listed([0]), parts=40, shaken=2.0)
    for value, left in zip(found.values, found.left):
        shaken = changed(block, A_y=1e-3 * value)
        alone = orientation(shaken, listed([0]), parts=40, shaken=2.0)
        assert left == alone.counts[0] + alone.counts[2] + alone.moving
    assert found.left[0] == 40 > found.left[1] and found.faces == (0, 2)
    shares = np.array([one.values for one in found.columns()])
    assert shares.shape == (6, 2) and (shares[4] <= shares[3]).all()


def test_rejects_sweeps_and_faces_that_are_none() -> None:
    for grid, reason in (
        ({"e": [0.5]}, "choose 2 of e, mu, frequency"),
        ({"e": [0.5], "width": [1.0]}, "choose 2 of e, mu, frequency"),
        ({"e": [0.5], "mu": []}, r"a sweep of 0 points is outside 1 \.\. 10000"),
        ({"e": [2.0], "mu": [0.1]}, r"e = 2 is outside \[0, 1\]"),
    ):
        with pytest.raises(SceneError, match=reason):
            onset_map(BLOCK, grid, ensembles=1, horizon=0.1)
    with pytest.raises(SceneError, match="no time to settle in"):
        onset_map(BLOCK, {"e": [0.5], "mu": [0.1]}, horizon=0.0)
    for faces in ([], [4], [-1]):
        with pytest.raises(SceneError, match="choose from 0 to 3"):
            clearing(BLOCK, faces, {"amplitude": [1.0]}, parts=1, shaken=0.0)
    with pytest.raises(SceneError, match="give values that grow"):
        clearing(BLOCK, [0], {"amplitude": [1.0, 0.5]})
