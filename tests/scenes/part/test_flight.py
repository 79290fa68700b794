"""Flights end at the first corner that meets the table: no meeting is stepped over, and no corner
gets below the tolerance's negative.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from juggleproof.scenes.part import body, moving, scene
from juggleproof.scenes.part.ensemble import fresh_notes
from juggleproof.scenes.part.flight import fly, lands_after, safe_step
from juggleproof.scenes.part.setting import Array, Scene
from tests.rows import each_row
from tests.scenes.part.reference import Flight, Model, State, first_crossing, setting

UNTIL = 0.2
TO_REFERENCE = (2, 3, 0, 1)  # the corner's number there


def flights(count: int, tolerance: float) -> list[tuple[Scene, Array]]:
    """Scenes and states in flight: some spin fast, some are near the table, some graze it, some are
    flat.
    """
    dice = np.random.default_rng(7)
    found = []
    for _ in range(count):
        b = dice.choice([0.01, 0.02, 0.2])
        block = scene(
            a=0.01,
            b=b,
            e=0.7,
            mu=0.1,
            A_y=dice.choice([0.0, 2e-4, 2e-3]),
            f_y=dice.choice([15.0, 60.0]),
            phase_y=dice.uniform(0, 6),
            tolerance=tolerance,
        )
        theta = dice.choice([dice.uniform(-7, 7), 0.0, math.pi / 2])
        lowest = (
            0.01 * abs(math.sin(theta))
            + b * abs(math.cos(theta))
            + body.table_height(block.parameters(), 0.0)
        )
        height = dice.choice([1e-9, 1e-5, 1e-3, 1e-2])
        found.append(
            (
                block,
                moving(
                    block,
                    0.0,
                    lowest + height,
                    theta,
                    0.1,
                    dice.normal() * 0.3,
                    dice.choice([0, 10, 100, 600]) * dice.normal(),
                )[0],
            )
        )
    return found


def gaps(p: Array, z: Array, s: Array | float) -> Array:
    """The four gaps at times s of the flight that leaves z, from the definition."""
    theta = z[body.THETA] + z[body.OMEGA] * s
    table = p[body.A_Y] * np.sin(p[body.W_Y] * (z[body.TIME] + s) + p[body.PHASE_Y])
    centre = z[body.Y] + z[body.V_Y] * s - p[body.G] * s * s / 2 - table
    corners = p[body.EDGES :][: 4 * int(p[body.CORNERS])].reshape(-1, 4)[:, :2]
    return np.stack([centre + x * np.sin(theta) + y * np.cos(theta) for x, y in corners])


def flown(block: Scene, start: Array) -> tuple[Array, float]:
    z, notes = start.copy(), fresh_notes(1)[0]
    assert fly(block.parameters(), z, UNTIL, notes) == body.DONE
    return z, float(notes[body.LEAST_GAP])


@each_row("tolerance", [1e-12, 1e-9, 1e-6])
def test_no_corner_gets_below_the_table_holds(tolerance: float) -> None:
    landed = 0
    for block, start in flights(200, tolerance):
        z, least = flown(block, start)
        s = np.linspace(0.0, z[body.TIME], 4001)
        found = gaps(block.parameters(), start, s)
        assert found.min() >= -tolerance and least >= -tolerance
        if z[body.TIME] < UNTIL:
            landed += 1
            assert -tolerance <= found[:, -1].min() <= tolerance
    assert landed > 100


def test_end_is_the_first_crossing_by_the_reference_holds() -> None:
    landed = 0
    for block, start in flights(60, 1e-12):
        z, _ = flown(block, start)
        model = Model(
            setting(
                block.a,
                block.b,
                e=block.e,
                mu=block.mu,
                g=block.g,
                A_y=block.A_y,
                f_y=block.f_y,
                phase_y=block.phase_y,
            ),
            30,
        )
        flight = Flight(model, model.lifted(State(*map(float, start[:7]))))
        met = first_crossing(
            flight.gaps, flight.bound(), flight.start.t, model.lift(UNTIL), model.noise
        )
        if met is None:
            assert z[body.TIME] == UNTIL
            continue
        landed += 1
        time, corner = met
        rate = abs(float(flight.gaps(time)[corner][1]))
        assert abs(float(time) - z[body.TIME]) * rate <= 1.1e-12 + 1e-15 * rate
        ours = gaps(block.parameters(), start, z[body.TIME] - start[0])
        assert abs(ours[TO_REFERENCE.index(corner)]) <= 1.1e-12
    assert landed > 30


def test_flight_keeps_its_parabola_and_its_spin_holds() -> None:
    for block, start in flights(50, 1e-12):
        z, _ = flown(block, start)
        s = z[body.TIME] - start[body.TIME]
        assert z[body.X] == pytest.approx(start[body.X] + start[body.V_X] * s, abs=1e-15)
        assert z[body.Y] == pytest.approx(
            start[body.Y] + start[body.V_Y] * s - 9.81 * s * s / 2, abs=1e-15
        )
        assert (z[body.V_X], z[body.OMEGA]) == (start[body.V_X], start[body.OMEGA])


def test_safe_step_is_the_first_root_of_its_parabola_holds() -> None:
    dice = np.random.default_rng(3)
    for _ in range(2000):
        value, fall = 10.0 ** dice.uniform(-13, 0), 10.0 ** dice.uniform(0, 5)
        rate = dice.choice([-1, 1]) * 10.0 ** dice.uniform(-8, 2)
        step = safe_step(value, rate, fall)
        terms = value + abs(rate) * step + fall * step * step / 2
        assert step > 0 and abs(value + rate * step - fall * step * step / 2) <= 1e-14 * terms
        assert all(
            value + rate * part * step - fall * (part * step) ** 2 / 2 > 0
            for part in (0.1, 0.5, 0.9, 0.999)
        )
    assert safe_step(0.0, -1.0, 2.0) == 0.0 == safe_step(0.0, 0.0, 2.0)


def test_sines_that_are_turned_on_are_those_of_the_angle_holds() -> None:
    steps = np.concatenate([np.linspace(-body.SMALL_TURN, body.SMALL_TURN, 400), [1e-9, 0.0]])
    for angle in (-2.0, 0.3, 1.5, 7.0):
        for step in steps:
            c, s = body.turned(math.cos(angle), math.sin(angle), step)
            assert abs(c - math.cos(angle + step)) < 2e-15 > abs(s - math.sin(angle + step))


def test_landing_that_is_told_is_that_of_the_gap_holds() -> None:
    """Of gaps c - sin(w s + phase), with all derivatives bounded as they are."""
    dice, told = np.random.default_rng(5), 0
    for _ in range(500):
        w, phase = 10.0 ** dice.uniform(0, 3), dice.uniform(1.8, 4.4)
        gap, rate = 10.0 ** dice.uniform(-12, -2), w * math.cos(phase)
        push, jerk = -w * w * math.sin(phase), -(w**3) * math.cos(phase)
        late = lands_after(gap, rate, push, jerk, w**4, 1e-12)
        if late < 1e300:
            told += 1
            assert abs(gap + math.sin(w * late + phase) - math.sin(phase)) < 1.01e-12 + 4e-16
    assert 100 < told < 500


def test_least_gap_is_seen_where_a_corner_starts_too_low() -> None:
    block, start = flights(1, 1e-12)[0]
    start[body.Y] -= gaps(block.parameters(), start, 0.0).min() + 1e-9
    assert flown(block, start)[1] < -1e-12


@each_row("depth", [0.0, 0.5, 0.89])
@each_row("hop", [1e-1, 1e-3, 1e-6])
def test_hop_below_the_tolerance_does_not_sink_the_corner_holds(depth: float, hop: float) -> None:
    """It comes down to the height from which it set out, as fast as it went up: hops that sank a
    little each went through the table in time.
    """
    block = scene(a=0.01, b=0.02, e=0.5, mu=0.0, A_y=0.0, tolerance=1e-7)
    p, theta = block.parameters(), 0.3
    up = math.sqrt(
        2 * block.g * hop * block.tolerance
    )  # the hop is this part of the tolerance high
    lowest = 0.01 * math.sin(theta) + 0.02 * math.cos(theta)
    z, notes = moving(block, 0.0, 1.0, theta, 0.0, up, 0.0)[0], fresh_notes(1)[0]
    z[body.Y] = lowest - depth * block.tolerance
    assert fly(p, z, UNTIL, notes) == body.DONE
    assert abs(z[body.Y] - lowest + depth * block.tolerance) < 1e-8 * block.tolerance + 1e-9 * up
    near = 1e-6 * up + 1e-16 / up  # rounding of heights by 1e-17 m
    assert abs(z[body.V_Y] + up) < near and abs(z[body.TIME] - 2 * up / block.g) < near


def test_flight_that_would_end_at_once_takes_a_time_holds() -> None:
    block = scene(a=0.01, b=0.02, e=0.5, mu=0.0, A_y=0.0, tolerance=1e-7)
    z = moving(block, 0.0, 1.0, 0.3, 0.0, 0.0, 0.0)[0]
    z[body.Y] = 0.01 * math.sin(0.3) + 0.02 * math.cos(0.3)
    assert fly(block.parameters(), z, UNTIL, fresh_notes(1)[0]) == body.DONE
    assert 0 < z[body.TIME] < 1e-9
