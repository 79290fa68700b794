"""Whole runs: hostile scenes, and mirrored ones."""

from __future__ import annotations

import math
import re

import hypothesis
import numpy as np
import pytest
from hypothesis import strategies as st

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body, fresh_notes, moving, run, scene, standing
from juggleproof.scenes.part.motion import follow_all, next_event
from juggleproof.scenes.part.onsets import PAPER
from juggleproof.scenes.part.rest import LANDS, LASTS, LETS_GO, SLIPS, STOPS, ending, pivot
from juggleproof.scenes.part.setting import Array, Scene
from juggleproof.scenes.part.strike import strike
from tests.rows import each_row

# -------------------------------------------------------------------------------------------------
# Scenes that broke an earlier integrator, and drawn ones: every run ends, with finite states,
# nothing gained and no corner in the table.

GUARANTEES = [body.PULLS, body.CONES, body.GAINS, body.CLOSINGS, body.SINKS]


def drawn(seed: int) -> tuple[Scene, Array]:
    """A scene and ten blocks: squares and slivers, no friction and much, no restitution and all,
    hard and soft shaking, standing or thrown.
    """
    dice = np.random.default_rng(seed)
    a = 10 ** dice.uniform(-3, -1.5)
    b = a * dice.choice([1, 1.0001, 2, 5, 100, 1 + dice.random()])
    f_y, A_y = (
        dice.choice([0, 60, 60, 1000, dice.random() * 100]),
        dice.choice([0, 2e-4, 5e-3 * dice.random(), 1e-4 * dice.random()]),
    )
    block = scene(
        a=a,
        b=b,
        e=dice.choice([0, 1, dice.random(), dice.random(), 0.999, 0.01]),
        mu=dice.choice([0, 1.3333, dice.random() * 1.33, 0.3]),
        A_x=dice.choice([0, 5e-3, dice.random() * 2e-3, -1e-3]),
        f_x=dice.choice([0, 60, 1000, dice.random() * 100]),
        phase_x=dice.random() * 6,
        A_y=A_y / 50 if f_y > 100 else A_y,
        f_y=f_y,
        phase_y=dice.choice([0, dice.random() * 6]),
        tolerance=10 ** dice.uniform(-13, -6),
        rest_speed=10 ** dice.uniform(-4, -1),
        g=dice.choice([9.81, 9.81, 1, 100]),
        launch="rest" if dice.random() < 0.5 else "table",
    )
    if dice.random() < 0.5:
        return block, standing(
            block, [*dice.uniform(-4, 4, 6), 0, math.pi / 2, math.pi / 4, math.atan(a / b)]
        )
    rows = []
    for _ in range(10):
        theta = dice.uniform(-7, 7)
        height = (
            dice.choice([0, 1e-6, 1e-3])
            + a * abs(math.sin(theta))
            + b * abs(math.cos(theta))
            + body.table_height(block.parameters(), 0.0)
        )
        spin = dice.choice([0, 30, 300, 60 / b]) * dice.normal()
        rows.append(moving(block, 0, height, theta, dice.normal() * 0.3, dice.normal() * 0.3, spin))
    return block, np.concatenate(rows)


def check(block: Scene, states: Array, until: float) -> Array:
    notes, p = fresh_notes(len(states)), block.parameters()
    codes = follow_all(p, states, until, notes)
    assert not codes.any() and np.isfinite(states).all() and (states[:, body.TIME] == until).all()
    assert not notes[:, GUARANTEES].any()
    assert notes[:, body.LEAST_GAP].min() >= -block.tolerance * (1 + 1e-9)
    cosine, sine = np.cos(states[:, body.THETA]), np.sin(states[:, body.THETA])
    lowest = np.min(
        [x * block.a * sine + y * block.b * cosine for x in (-1, 1) for y in (-1, 1)], axis=0
    )
    assert (
        states[:, body.Y] + lowest - body.table_height(p, until)
    ).min() >= -2 * block.tolerance - 1e-16
    return notes


@each_row("seed", range(40))
def test_drawn_scene_runs_to_its_end_holds(seed: int) -> None:
    block, states = drawn(seed)
    check(block, states, 0.4)


ANGLES = np.radians(np.arange(0.0, 91.0, 5.0))
SCENES: dict[str, dict[str, float]] = {
    "a face on a table shaken so hard that times of a stop are not told apart": {
        "e": 0.6,
        "mu": 0.0,
        "A_x": 5e-3,
        "f_x": 1000.0,
        "A_y": 0.0,
    },
    "the same with friction": {
        "e": 0.01,
        "mu": 0.16,
        "A_x": 5e-3,
        "f_x": 1000.0,
        "A_y": 2e-6,
        "f_y": 1000.0,
        "rest_speed": 1e-2,
    },
    "a corner without speed deep within the tolerance": {
        "e": 0.0,
        "mu": 0.0,
        "A_y": 2.4e-5,
        "f_y": 300.0,
        "tolerance": 3.3e-13,
    },
    "a sliver that lands as soon as it pivots": {
        "a": 0.015,
        "b": 1.5,
        "e": 0.24,
        "mu": 0.02,
        "A_y": 3e-5,
        "f_y": 12.5,
        "tolerance": 1.3e-13,
    },
    "a square that rattles on a still table": {
        "a": 0.01,
        "b": 0.01,
        "e": 0.999,
        "mu": 0.14,
        "A_y": 0.0,
        "rest_speed": 1e-4,
    },
    "a block that rattles below the height of the tolerance": {
        "a": 0.01,
        "b": 0.016,
        "e": 0.999,
        "mu": 0.14,
        "A_y": 0.0,
        "g": 100.0,
        "tolerance": 2e-12,
        "rest_speed": 1.05e-5,
    },
}


@each_row("name", SCENES)
def test_scene_that_broke_an_integrator_runs_to_its_end_holds(name: str) -> None:
    block = scene(**SCENES[name])
    check(
        block,
        np.concatenate([standing(block, ANGLES), moving(block, 0, block.b * 1.01, 0.0, 0.1, 0, 3)]),
        1.0,
    )


@each_row("mu", [0.5, 1.2, 1.3, 1.33333])
def test_still_table_gives_no_energy_near_jamming_either_holds(mu: float) -> None:
    """At mu = 4/3 the force at a sliding corner of a 1:2 block has no bound: steps must become
    shorter near it.
    """
    for e, rest in ((0.0, 1e-3), (0.5, 0.1), (0.9, 1e-2)):
        block = scene(e=e, mu=mu, A_y=0.0, tolerance=1e-9, rest_speed=rest)
        states = np.concatenate(
            [
                moving(block, 0, 0.0225, theta, vx, -0.1, spin)
                for theta in (0.0, 0.3, 0.6, 1.2, 1.5)
                for vx in (-3, -0.5, 1)
                for spin in (-5, 0, 20)
            ]
        )
        k2 = (block.a**2 + block.b**2) / 3

        def energies(states: Array, k2: float = k2) -> Array:
            return (
                states[:, body.V_X] ** 2
                + states[:, body.V_Y] ** 2
                + k2 * states[:, body.OMEGA] ** 2
            ) / 2 + 9.81 * states[:, body.Y]

        last = energies(states)
        for until in (0.02, 0.05, 0.1, 0.2, 0.5, 1.0):
            check(block, states, until)
            assert (energies(states) <= last + 1e-7).all()
            last = energies(states)


# -------------------------------------------------------------------------------------------------
# The far corners of long flat blocks, which rattle for long, do not work their way into the table.

LYING = math.pi / 2
LONG: list[dict[str, float]] = [
    {"a": 0.02, "b": 0.65, "e": 0.999, "rest_speed": 1e-6},
    {"a": 0.0042, "b": 0.91, "e": 0.999, "mu": 0.1, "rest_speed": 1.8e-6, "tolerance": 2.5e-12},
    {"a": 0.028, "b": 0.79, "e": 0.9999, "mu": 0.1, "rest_speed": 3.6e-6, "tolerance": 4.4e-13},
    {"a": 0.005, "b": 1.5, "e": 0.99, "mu": 1.2, "rest_speed": 1e-5},
]


@each_row("given", LONG)
def test_corners_of_a_long_block_do_not_sink_holds(given: dict[str, float]) -> None:
    block = scene(**{"mu": 0.5, "A_y": 0.0, **given})
    angles = LYING - 10.0 ** np.arange(-7.0, -1.0)
    impacts = check(block, standing(block, [*angles, 1e-5]), 1.0)[:, body.IMPACTS]
    assert impacts.max() > 1000


@hypothesis.given(
    aspect=st.floats(1, 300),
    length=st.floats(0.01, 2),
    lost=st.sampled_from([1e-6, 1e-4, 1e-3, 0.05]),
    mu=st.sampled_from([0.0, 0.1, 1.2]),
    tilted=st.floats(-8, -1),
    quiet=st.floats(-6, -3),
    tolerance=st.floats(-13, -9),
    A_y=st.sampled_from([0.0, 1e-5, 2e-4]),
)
@hypothesis.settings(max_examples=30)
def test_no_corner_of_a_bouncy_block_of_aspect_1_to_300_sinks_holds(
    aspect: float,
    length: float,
    lost: float,
    mu: float,
    tilted: float,
    quiet: float,
    tolerance: float,
    A_y: float,
) -> None:
    try:
        block = scene(
            a=length / aspect,
            b=length,
            e=1 - lost,
            mu=mu,
            A_y=A_y,
            rest_speed=10**quiet,
            tolerance=10**tolerance,
        )
        states = standing(block, [LYING - 10**tilted, 10**tilted])
    except SceneError:  # a tolerance that floats of this size cannot keep
        hypothesis.reject()
    check(block, states, 0.05)


def test_corner_that_is_too_deep_is_counted_holds() -> None:
    block = scene(e=0.5, mu=0.0, A_y=0.0)
    z, notes = moving(block, 0, block.b, 0.0, 0.0, 0.01, 0.0), fresh_notes(1)
    z[0, body.Y] -= 3 * block.tolerance
    follow_all(block.parameters(), z, 1e-3, notes)
    assert notes[0, body.SINKS] == 1 and notes[0, body.LEAST_GAP] < -2.9 * block.tolerance


# -------------------------------------------------------------------------------------------------
# Chatter on a still table comes to an end, in events that what is left to move bounds; where it
# cannot, the run says where it is stuck.

CHATTER: list[tuple[float, dict[str, float]]] = [
    (1e-9, {"e": 0.5, "mu": 1.3, "g": 1000.0, "rest_speed": 1e-6}),
    (1e-9, {"e": 0.7, "mu": 1.3, "g": 1000.0, "rest_speed": 1e-6, "a": 0.005}),
    (LYING - 1e-9, {"e": 0.99, "mu": 1.3, "g": 1000.0, "rest_speed": 1e-6}),
    (1e-9, {"e": 0.9, "mu": 1.3, "g": 100.0, "rest_speed": 1e-6}),
    (1e-9, {"e": 0.9, "mu": 1.3, "g": 100.0, "rest_speed": 1e-8}),
    (1e-3, {"e": 0.9, "mu": 1.3, "g": 100.0, "rest_speed": 1e-8}),
    (LYING - 1e-9, {"e": 0.5, "mu": 0.0, "rest_speed": 1e-8, "a": 0.005}),
    (1e-9, {"e": 0.9, "mu": 0.3, "b": 0.01, "rest_speed": 1e-8}),
]


@each_row(("angle", "given"), CHATTER)
def test_chatter_on_a_still_table_ends_holds(angle: float, given: dict[str, float]) -> None:
    """No event adds energy, not even that of a rounding of the height, and few are needed."""
    block = scene(A_y=0.0, **given)
    p, z, notes = block.parameters(), standing(block, [angle])[0], fresh_notes(1)[0]
    last = math.inf
    for _ in range(1000):
        if z[body.TIME] == 0.2:
            break
        assert next_event(p, z, 0.2, notes) == body.DONE
        energy = (z[body.V_X] ** 2 + z[body.V_Y] ** 2 + p[body.GYRATION] * z[body.OMEGA] ** 2) / 2
        assert energy + block.g * z[body.Y] <= last
        last = energy + block.g * z[body.Y]
    assert z[body.TIME] == 0.2 and z[body.MODE] == body.FACE
    assert notes[body.IMPACTS] + notes[body.CONTACTS] < 1000


def test_lossless_chatter_is_told_with_part_and_state_holds() -> None:
    """Hops of 3e-4 m/s at 1000 m/s^2 last for 6e-7 s, and lose nothing."""
    block = scene(e=1.0, mu=0.0, g=1000.0, A_y=0.0, rest_speed=1e-8)
    starts = np.concatenate(
        [standing(block, [0.3]), moving(block, 0, block.b + 4.5e-11, 0, 0, 0, 0)], axis=0
    )
    with pytest.raises(SceneError) as told:
        run(block, starts, 1.0)
    assert re.fullmatch(
        r"block 1 is stuck at t = 0\.\d+ s, in flight, at X = 0 m, Y = 0\.02 m, theta = 0, with"
        r" V_X = 0 m/s, V_Y = \S+ m/s, omega = 0 rad/s: more than a million events in a second; .*",
        str(told.value),
    )


def test_face_that_trips_near_jamming_is_not_sped_up_holds() -> None:
    block = scene(
        a=2.1860752568100615e-3,
        b=4.372150513620123e-3,
        e=0.999,
        mu=1.3333,
        A_x=5e-3,
        f_x=25.4,
        A_y=0.0,
        g=1.0,
        tolerance=2.2e-9,
        rest_speed=0.097,
    )
    states = standing(block, ANGLES)
    assert check(block, states, 1.0)[:, body.CONTACTS].max() < 10_000
    assert np.abs(states[:, body.V_X]).max() < 2


def test_pivot_that_ends_at_once_does_not_go_into_the_table_holds() -> None:
    """The next corner is 3 tolerances high and comes down so fast that it lands within 4e-13 s."""
    block = scene(a=0.015, b=1.5, e=0.2, mu=0.5, A_y=0.0)
    p, width = block.parameters(), 2 * block.b
    theta = -math.pi / 2 + 3e-12 / width
    z = moving(block, 0.0, 1.0, theta, 0.0, 0.0, -4.0)[0]
    i = 2
    c, s = math.cos(theta), math.sin(theta)
    z[body.Y], z[body.V_Y] = -body.corner_y(p, i, c, s), 4.0 * body.corner_x(p, i, c, s)
    z[body.V_X], z[body.MODE], z[body.CORNER] = -4.0 * body.corner_y(p, i, c, s), body.PIVOT, i
    notes = fresh_notes(1)
    assert pivot(p, z, 1.0, notes[0]) == body.DONE
    gaps = [
        z[body.Y] + body.corner_y(p, k, math.cos(z[body.THETA]), math.sin(z[body.THETA]))
        for k in range(4)
    ]
    assert 0 < z[body.TIME] < 1e-11 and min(gaps) > -1e-14 and sum(gap < 1e-14 for gap in gaps) == 2


def test_corner_that_leaves_without_speed_flies_on_holds() -> None:
    """It is struck where it spins so fast that nothing holds it, nearly a tolerance deep."""
    block = scene(e=0.0, mu=0.0, A_y=0.0)
    z = moving(block, 0.0, 1.0, 0.3, 0.0, 0.0, 60.0)
    p, c, s = block.parameters(), math.cos(0.3), math.sin(0.3)
    z[0, body.Y], z[0, body.V_Y] = (
        -body.corner_y(p, 0, c, s) - 0.95e-12,
        -60 * body.corner_x(p, 0, c, s) - 1e-17,
    )
    assert strike(p, z[0], fresh_notes(1)[0]) == body.DONE and z[0, body.MODE] == body.FLIGHT
    check(block, z, 0.2)


def test_each_end_of_a_pivot_is_distinguished_holds() -> None:
    block = scene(e=0.5, mu=0.3, A_y=0.0)
    p = block.parameters()

    def end(theta: float, omega: float, slide: float, speed: float = 0.0) -> int:
        across = speed + omega * body.corner_y(p, 0, math.cos(theta), math.sin(theta))
        return ending(p, 0.0, across, theta, omega, 0, slide, 0)

    assert (
        end(0.46, 0.0, 0.0) == LASTS
        and end(-1e-9, 0.0, 0.0) == LANDS
        and end(math.pi / 2 + 1e-9, 0.0, 0.0) == LANDS
    )
    assert end(0.46, 60.0, 0.0) == LETS_GO and end(1.2, 0.0, 0.0) == SLIPS
    assert end(0.46, 0.0, 1.0, 0.1) == LASTS and end(0.46, 0.0, 1.0, -0.1) == STOPS


# -------------------------------------------------------------------------------------------------
# A mirrored start on the mirrored table gives the mirrored orbit, bit for bit: impacts, contact and
# rest prefer no side.

EVERY_DEGREE = np.radians(np.arange(91.0))
EVEN = [body.TIME, body.Y, body.V_Y, body.MODE]
ODD = [body.X, body.THETA, body.V_X, body.OMEGA, body.SLIDE]
COUNTED = [body.IMPACTS, body.STEPS, body.CONTACTS, body.LEAST_GAP, body.LARGEST_REMOVED]
MIRRORED_CORNER = np.array([1, 0, 3, 2])
MIRRORED: list[dict[str, object]] = [
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


@pytest.mark.exhaust
@each_row("given", MIRRORED)
def test_mirrored_start_gives_the_mirrored_orbit_holds(given: dict[str, object]) -> None:
    numbers = {name: value for name, value in given.items() if name != "row"}
    frequency, amplitude, _ = PAPER[given["row"]]
    here, there = (scene(f_x=frequency, A_x=sign * amplitude, **numbers) for sign in (1, -1))
    right, left = (
        run(here, standing(here, EVERY_DEGREE), 3.0),
        run(there, standing(there, -EVERY_DEGREE), 3.0),
    )
    assert (right.states[:, EVEN] == left.states[:, EVEN]).all()
    assert (right.states[:, ODD] == -left.states[:, ODD]).all()
    assert (right.notes[:, COUNTED] == left.notes[:, COUNTED]).all()
    pivots = right.states[:, body.MODE] == body.PIVOT
    faces = right.states[:, body.MODE] == body.FACE
    corners = [one.states[:, body.CORNER] for one in (right, left)]
    assert (MIRRORED_CORNER[corners[0][pivots].astype(int)] == corners[1][pivots]).all()
    assert (-corners[0][faces] % 4 == corners[1][faces]).all()
    assert right.notes[:, body.IMPACTS].sum() > 91


def test_mirror_fails_without_the_mirrored_table() -> None:
    frequency, amplitude, _ = PAPER[2]
    here = scene(e=0.7, mu=0.08, f_x=frequency, A_x=amplitude)
    right, left = (
        run(here, standing(here, EVERY_DEGREE), 0.5),
        run(here, standing(here, -EVERY_DEGREE), 0.5),
    )
    assert not (right.states[:, ODD] == -left.states[:, ODD]).all()


def test_upright_block_on_a_table_that_goes_up_and_down_stays_upright_holds() -> None:
    block = scene(e=0.7, mu=0.08, A_y=1e-3)
    after = run(block, standing(block, [0.0, np.pi / 2, -np.pi / 2]), 2.0)
    assert (after.states[0, [body.X, body.THETA, body.V_X, body.OMEGA]] == 0).all()
    assert (after.states[1:, body.X] == 0).all() and after.notes[:, body.IMPACTS].min() >= 10
