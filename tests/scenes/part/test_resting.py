"""Faces on which parts rest: as geometry says on a still table, whatever the part did when the
table stopped; Wilson's interval; and the least drive that clears a face, which is clear from there.
"""

from __future__ import annotations

import math
from dataclasses import replace
from statistics import NormalDist

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body, run, scene, standing
from juggleproof.scenes.part.resting import (
    ANY_ANGLE,
    MOVING,
    Clearing,
    Orientation,
    between,
    clearing,
    listed,
    orientation,
    parameters,
    resting_faces,
    wilson,
)
from juggleproof.scenes.part.setting import changed

pytest.importorskip("numba", reason="numba, the extra `part`, is not installed")
BLOCK = scene(e=0.6, mu=0.2, f_x=30.0, A_x=1e-3)


def falls_to(theta: float, around: np.ndarray) -> int:
    """The side of a polygon over which its centre is, where it stands on its lowest corner."""
    c, s = math.cos(theta), math.sin(theta)
    turned = around @ np.array([[c, s], [-s, c]])
    lowest = int(turned[:, 1].argmin())  # the centre is at x = 0
    return lowest if turned[lowest, 0] < 0 else (lowest - 1) % len(around)


def test_on_a_still_table_parts_rest_where_their_centre_is_holds() -> None:
    angles = between(0, 360).drawn(300, 7)
    faces = resting_faces(BLOCK, standing(scene(e=0.6, mu=0.2, A_y=0.0), angles))
    assert faces.tolist() == [
        falls_to(theta, np.array(BLOCK.polygon().corners)) for theta in angles
    ]
    assert {*faces.tolist()} == {0, 1, 2, 3}


def test_a_part_that_lies_stays_on_its_face_when_the_table_stops_holds() -> None:
    gentle = scene(e=0.5, mu=0.4, f_x=20.0, A_x=1e-4, A_y=5e-5)
    states = run(gentle, standing(gentle, np.radians([0.0, 90.0, 180.0, 270.0])), 0.517).states
    assert (states[:, body.MODE] == body.FACE).all()
    assert resting_faces(gentle, states).tolist() == [0, 3, 2, 1]


def test_no_part_is_left_in_flight_holds() -> None:
    states = run(BLOCK, standing(BLOCK, between(0, 360).drawn(60, 1)), 0.731).states
    assert (states[:, body.MODE] == body.FLIGHT).any()
    assert (resting_faces(BLOCK, states) != MOVING).all()


def test_a_part_that_loses_nothing_rests_nowhere_holds() -> None:
    lossless = scene(e=1.0, mu=0.0, A_y=0.0)
    found = orientation(lossless, listed([40]), parts=2, shaken=0.0)
    assert (found.moving, found.counts, found.parts()) == (2, (0, 0, 0, 0), 2)
    assert found.share(3)[0] == 0.0


def test_a_triangle_rests_on_each_of_its_sides_holds() -> None:
    triangle = scene(e=0.3, mu=0.4, A_y=0.0, shape=[(0, 0), (0.03, 0), (0, 0.03)])
    for face, rest in enumerate((0.0, 225.0, 90.0)):
        found = orientation(triangle, listed([rest - 3, rest + 3]), parts=8, shaken=0.0)
        assert found.counts[face] == 8, face
        assert math.isclose(found.columns()[2].values[face], rest)


@given(st.integers(1, 5000).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_ends_of_the_interval_solve_wilsons_equation_holds(trial: tuple[int, int]) -> None:
    """An end p is where the share found is z standard errors of p away."""
    hits, count = trial
    z, share = NormalDist().inv_cdf(0.975), hits / count
    for end in wilson(hits, count):
        assert 0 <= end <= 1
        if 0 < end < 1:
            assert math.isclose(
                (share - end) ** 2, z * z * end * (1 - end) / count, rel_tol=1e-6, abs_tol=1e-12
            )
    assert wilson(hits, count)[0] <= share <= wilson(hits, count)[1]


def test_starts_are_drawn_as_they_are_told_holds() -> None:
    even = np.degrees(between(10, 50).drawn(1000, 3))
    assert even.min() > 10 and even.max() < 50 and abs(even.mean() - 30) < 3 * 40 / 12**0.5 / 31
    some = np.degrees(listed([0, 26, 90]).drawn(300, 3))
    nearest = np.abs(some[:, None] - [0, 26, 90]).min(axis=1)
    assert (nearest <= 1e-6 + 1e-12).all() and len(set(some)) == 300
    assert (between(10, 50).drawn(9, 3) == between(10, 50).drawn(9, 3)).all()


def test_the_same_seed_gives_the_same_counts_holds() -> None:
    def counts() -> Orientation:
        return orientation(BLOCK, between(0, 90), parts=120, shaken=0.5, seed=4)

    assert counts() == counts() and sum(counts().counts) == 120
    assert "120 parts that start evenly from 0 to 90 degrees, shaken for 0.5 s" in counts().title()


def test_rejects_starts_that_are_none() -> None:
    for wrong in (lambda: between(90, 0), lambda: listed([]), lambda: listed([math.nan])):
        with pytest.raises(SceneError, match="within -360"):
            wrong()
    with pytest.raises(SceneError, match=r"parts = 0 is outside 1 \.\. 1000000"):
        orientation(BLOCK, parts=0)


# -------------------------------------------------------------------------------------------------
# The least drive that clears faces.

SHAKEN = scene(e=0.7, mu=0.08)


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
        changed_to = parameters(0.5)[name].set_in(SHAKEN, 0.75)
        assert np.isclose(getattr(changed_to, field), value)
        assert replace(changed_to, **{field: getattr(SHAKEN, field)}) == SHAKEN


def found_clearing(*left: int) -> Clearing:
    values = tuple(0.5 * k for k in range(len(left)))
    return Clearing(SHAKEN, (0, 2), "amplitude-up", "mm", values, left, 50, ANY_ANGLE, 3.0)


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
    block = changed(SHAKEN, f_x=30.0, A_x=1e-3)
    grid = {"amplitude-up": [0.05, 0.3]}
    found = clearing(block, [0, 2, 2], grid, starts=listed([0]), parts=40, shaken=2.0)
    for value, left in zip(found.values, found.left):
        shaken = changed(block, A_y=1e-3 * value)
        alone = orientation(shaken, listed([0]), parts=40, shaken=2.0)
        assert left == alone.counts[0] + alone.counts[2] + alone.moving
    assert found.left[0] == 40 > found.left[1] and found.faces == (0, 2)
    shares = np.array([one.values for one in found.columns()])
    assert shares.shape == (6, 2) and (shares[4] <= shares[3]).all()


def test_rejects_drives_and_faces_that_are_none() -> None:
    for grid, reason in (
        ({"e": [0.5], "mu": [0.1]}, "a sweep of e, mu: choose 1 of e, mu, frequency"),
        ({"width": [1.0]}, "a sweep of width: choose 1 of e, mu, frequency"),
        ({"e": []}, r"a sweep of 0 points is outside 1 \.\. 10000"),
        ({"e": [2.0]}, r"e = 2 is outside \[0, 1\]"),
        ({"amplitude": [1.0, 0.5]}, "give values that grow"),
    ):
        with pytest.raises(SceneError, match=reason):
            clearing(SHAKEN, [0], grid, parts=1, shaken=0.0)
    for faces in ([], [4], [-1]):
        with pytest.raises(SceneError, match="choose from 0 to 3"):
            clearing(SHAKEN, faces, {"amplitude": [1.0]}, parts=1, shaken=0.0)
