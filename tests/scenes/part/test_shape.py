"""Convex polygons and other drives: what follows from corners, bad corners, and
orbits against the reference.
"""

from __future__ import annotations

import math
import random
import re
from fractions import Fraction

import numpy as np
import pytest

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body, fresh_notes, run, scene, standing
from juggleproof.scenes.part.drive import harmonics
from juggleproof.scenes.part.flight import fly
from juggleproof.scenes.part.setting import Array, Scene, changed, faces_below
from juggleproof.scenes.part.shape import (
    geometry,
    gyration,
    jamming,
    polygon,
    stable_faces,
)
from juggleproof.scenes.part.strike import strike
from tests.rows import each_row
from tests.scenes.part.reference import Chatter, Event, State, dropped, reference_orbit
from tests.scenes.part.reference_shapes import modelled, triangles

BLOCK = [(0.0, 0.0), (0.02, 0.0), (0.02, 0.04), (0.0, 0.04)]
TRIANGLE = [(0.0, 0.0), (0.03, 0.0), (0.01, 0.04)]
HEXAGON = [
    (0.0, 0.0),
    (0.02, -0.003),
    (0.035, 0.005),
    (0.03, 0.02),
    (0.012, 0.028),
    (-0.004, 0.015),
]
SHAKEN = {"A_y": 2e-4, "f_y": 60.0, "A_x": 1e-3, "f_x": 30.0}
SUMMED = harmonics([(1e-3, 30.0, 0.5)], [(2e-4, 60.0, 0.0), (-1e-4, 120.0, 1.0)])


def drawn(seed: int) -> list[tuple[Fraction, Fraction]]:
    """The corners of a convex polygon, on an ellipse, at rational places."""
    dice = random.Random(seed)
    angles = sorted(dice.sample(range(0, 360, 5), dice.randint(3, 9)))
    tilt = dice.uniform(0, 3)
    return [
        (
            Fraction(round(1e6 * math.cos(math.radians(one) + tilt)), 10**8),
            Fraction(round(4e5 * math.sin(math.radians(one) + tilt)), 10**8),
        )
        for one in angles
    ]


def test_rectangle_by_its_corners_is_the_rectangle_to_the_byte_holds() -> None:
    given = {"e": 0.7, "mu": 0.08, "f_x": 30.0, "A_x": 1e-3}
    rectangle, block = scene(**given), scene(shape=BLOCK, **given)
    assert rectangle.parameters().tobytes() == block.parameters().tobytes()
    angles = np.radians(np.arange(0.0, 91.0, 6.0))
    ours, theirs = (run(one, standing(one, angles), 1.0) for one in (rectangle, block))
    assert ours.states.tobytes() == theirs.states.tobytes()
    assert ours.notes.tobytes() == theirs.notes.tobytes()


@each_row("seed", range(20))
def test_centre_and_gyration_are_those_of_the_triangles_of_a_fan_holds(seed: int) -> None:
    corners = drawn(seed)
    X, Y, k2 = triangles(corners)
    found = polygon(corners)
    for (x, y), (given_x, given_y) in zip(found.corners, corners):
        assert (x, y) == (float(given_x - X), float(given_y - Y))
    moved = [(x - X, y - Y) for x, y in corners]
    assert gyration(moved) == k2
    assert geometry(found).gyration == pytest.approx(float(k2), rel=1e-14)


@each_row("seed", range(20))
def test_corners_that_go_around_clockwise_make_the_same_shape_holds(seed: int) -> None:
    corners = drawn(seed)
    assert polygon([corners[0], *reversed(corners[1:])]) == polygon(corners)


@each_row(
    "corners, message",
    [
        ([(0, 0), (1, 0)], "a shape of 2 corners; 3 to 64 are needed"),
        ([(0, 0), (1, 0), (1, 1), (0, 0)], "corners 0 and 3 of the shape are the same, (0, 0) m"),
        ([(0, 0), (1, 0), (2, 0)], "no area"),
        ([(0, 0), (2, 0), (0.5, 0.5), (0, 2)], "not convex at its corner (0.5, 0.5) m"),
        ([(0, 0), (1, 0), (2, 0), (0, 2)], "all but straight at its corner (1, 0) m"),
        ([(0, 0), (1, 1), (1, 0), (0, 1)], "no area"),
        (
            [(math.cos(t), math.sin(t)) for t in (0.0, 2.5, 5.0, 1.2, 3.8)],
            "around more than once",
        ),
        ([(0, 0), (1, 0), (math.nan, 1)], "corner 2 of the shape has no finite numbers"),
        ([(0, 0), (1, 0, 2), (0, 1)], "corner 1 of the shape has 3 numbers"),
    ],
)
def test_rejects_corners_that_make_no_shape(corners: list[tuple[float, ...]], message: str) -> None:
    with pytest.raises(SceneError, match=re.escape(message)) as refused:
        polygon(corners)
    assert "\n" not in str(refused.value)


@each_row(
    "given, message",
    [
        ({"shape": TRIANGLE, "a": 0.01}, "give them or a shape"),
        ({"shape": TRIANGLE, "mu": 2.0}, "mu = 2 is not below"),
        ({"shape": TRIANGLE, "tolerance": 2e-4}, "tolerance"),
        ({"shape": [(0, 0), (1e-7, 0), (0, 1e-7)]}, "a = 5e-08 m is outside"),
        ({"drive": SUMMED, "A_x": 1e-3}, "give them or a drive"),
    ],
)
def test_rejects_a_scene_of_a_shape_that_is_not_one(given: dict[str, object], message: str) -> None:
    with pytest.raises(SceneError, match=re.escape(message)) as refused:
        scene(**{"e": 0.5, "mu": 0.2, **given})
    assert "\n" not in str(refused.value)


def closing(shape: list[tuple[float, float]], mu: float) -> float:
    """The least B_2 - mu |B_3| of a corner at any angle at which it is the lowest, by trying."""
    block = polygon(shape)
    k2 = geometry(block).gyration
    least = math.inf
    for theta in np.linspace(0, 2 * math.pi, 40_001):
        c, s = math.cos(theta), math.sin(theta)
        x, y = min(
            ((x * c - y * s, x * s + y * c) for x, y in block.corners), key=lambda one: one[1]
        )
        least = min(least, 1 + (x * x - mu * abs(x * y)) / k2)
    return least


@each_row("shape", [BLOCK, TRIANGLE, HEXAGON, [(0, 0), (1, 0), (4, 1), (3, 1)]])
def test_friction_jams_a_shape_from_its_bound_on_and_not_below_holds(
    shape: list[tuple[float, float]],
) -> None:
    bound = geometry(polygon(shape)).jams
    assert abs(closing(shape, bound)) < 1e-6
    assert closing(shape, bound * (1 - 1e-3)) > 0 > closing(shape, bound * (1 + 1e-3))


def test_friction_that_jams_a_rectangle_is_four_thirds_holds() -> None:
    for b in (Fraction(1), Fraction(3, 2), Fraction(2), Fraction(30)):
        assert jamming(polygon([(0, 0), (1, 0), (1, b), (0, b)])) == Fraction(16, 9)


def test_shape_jams_at_the_bound_and_not_below_it_holds() -> None:
    bound = geometry(polygon(HEXAGON)).jams
    with pytest.raises(SceneError, match="not below"):
        scene(e=0.5, mu=bound, shape=HEXAGON)
    block = scene(e=0.5, mu=bound * (1 - 1e-9), shape=HEXAGON, **SHAKEN)
    after = run(block, standing(block, np.radians(np.arange(0.0, 360.0, 12.0))), 0.5, check=True)
    assert not any(after.violations().values())


# -------------------------------------------------------------------------------------------------
# Rest.

SCENES: dict[str, dict[str, object]] = {
    "triangle": {"shape": TRIANGLE},
    "hexagon": {"shape": HEXAGON},
}


@each_row("name", SCENES)
def test_block_at_rest_falls_to_the_face_below_it_holds(name: str) -> None:
    """On a still table, with friction that holds; from a fifth of a degree beside a face it comes
    to lie there.
    """
    block = scene(e=0.0, mu=0.7, A_y=0.0, **SCENES[name])
    holding = stable_faces(block.polygon())
    rests = 2 * math.pi * np.array(geometry(block.polygon()).turns)
    angles = np.radians(np.arange(1.0, 360.0, 10.0))
    faces = faces_below(block, angles)
    after = run(block, standing(block, angles), 0.003, check=True)
    before, now = (
        np.mod(theta - rests[faces] + math.pi, 2 * math.pi) - math.pi
        for theta in (angles, after.states[:, body.THETA])
    )
    assert (np.abs(now) < np.abs(before)).all() and set(faces) == set(holding)
    assert not any(after.violations().values())
    beside = np.concatenate([rests[[*holding]] + turned for turned in np.radians([-0.2, 0.2])])
    lies = run(block, standing(block, beside), 2.0, check=True)
    assert (lies.states[:, body.MODE] == body.FACE).all()
    assert (lies.states[:, body.CORNER] == [*holding, *holding]).all()
    assert not any(lies.violations().values())


def test_face_that_does_not_hold_is_left_at_once_holds() -> None:
    """A parallelogram set down on the side beyond whose end its centre is."""
    block = scene(e=0.0, mu=0.9, A_y=0.0, shape=[(0, 0), (0.01, 0), (0.04, 0.01), (0.03, 0.01)])
    after = run(block, standing(block, [0.0]), 2.0, check=True)
    assert faces_below(block, np.array([0.0])) == [1] and 0 not in stable_faces(block.polygon())
    assert after.states[0, body.MODE] == body.FACE and after.states[0, body.CORNER] == 1


def test_table_of_one_harmonic_moves_as_the_sine_holds() -> None:
    given = {"e": 0.5, "mu": 0.2, "shape": TRIANGLE}
    sine = scene(**given, **SHAKEN)
    same = scene(**given, drive=harmonics([(1e-3, 30.0, 0.0)], [(2e-4, 60.0, 0.0)]))
    p, q = sine.parameters(), same.parameters()
    for t in (0.0, 0.0123, 1.7):
        for which in ("height", "rise", "lift", "place", "glide", "push"):
            table = getattr(body, f"table_{which}")
            assert table(p, t) == pytest.approx(table(q, t), rel=1e-12)
    angles = np.radians([10.0, 100.0, 200.0])
    one, other = (run(block, standing(block, angles), 0.1).states for block in (sine, same))
    assert np.abs(one[:, :7] - other[:, :7]).max() < 1e-9


# -------------------------------------------------------------------------------------------------
# Orbits against the reference, before chaos parts them.

UNTIL = 0.2
ORBITS: dict[str, dict[str, object]] = {
    "triangle": {"shape": TRIANGLE, **SHAKEN},
    "hexagon": {"shape": HEXAGON, **SHAKEN},
    "harmonics": {"shape": HEXAGON, "drive": SUMMED},
}
STARTS = ((0.7, 0.08, 0.4, 0.0), (0.8, 0.5, 2.0, 30.0), (0.6, 0.3, -1.3, -8.0))


def fast(block: Scene, start: State) -> list[tuple[int, Array]]:
    """Corner and state after each impact: flights and impacts, one after another."""
    p, notes, z = block.parameters(), fresh_notes(1)[0], np.zeros(body.STATE)
    z[:7] = start
    found: list[tuple[int, Array]] = []
    while len(found) <= 200:
        assert fly(p, z, UNTIL, notes) == body.DONE
        if z[body.TIME] >= UNTIL:
            break
        corner = int(z[body.CORNER])
        assert strike(p, z, notes) == body.DONE
        found.append((corner, z[:7].copy()))
        if z[body.MODE] != body.FLIGHT:
            break
    assert notes[body.SINKS] == 0
    return found


@each_row("name", ORBITS)
def test_orbit_is_that_of_the_reference_holds(name: str) -> None:
    compared = 0
    for e, mu, theta, omega in STARTS:
        block = scene(e=e, mu=mu, rest_speed=1e-6, **ORBITS[name])
        slow = modelled(block)
        start = State(
            *map(float, dropped(slow, theta, 0.001, slow.context.dps, VX=0.05, omega=omega))
        )
        events: tuple[Event, ...]
        try:
            events = tuple(reference_orbit(slow, start, UNTIL, together=0))
        except Chatter as stopped:
            events = stopped.events[:4]
        ours = fast(block, start)
        assert len(events) >= 2 and len(ours) >= len(events)
        for (corner, state), event in zip(ours, events):
            assert corner == event.corner
            there = np.array([float(one) for one in event.after])
            assert np.abs((state - there) * [1, 1, 1, 0.02, 1, 1, 0.02]).max() < 1e-9
            compared += 1
    assert compared >= 8


def test_changed_scene_keeps_shape_and_drive_holds() -> None:
    block = scene(e=0.5, mu=0.2, shape=HEXAGON, drive=SUMMED)
    assert changed(block, e=0.6).polygon() == block.polygon()
    assert changed(block, e=0.5) == block
