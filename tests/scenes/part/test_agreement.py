"""The fast integrator against the slow reference: the same impacts before chaos parts them, and an
error that falls with the tolerance.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from juggleproof.scenes.part import body, fresh_notes, scene
from juggleproof.scenes.part.flight import fly
from juggleproof.scenes.part.setting import Array
from juggleproof.scenes.part.strike import first_slide, mode_of, strike
from tests.rows import each_row
from tests.scenes.part.reference import Chatter, Event, State, dropped, reference_orbit, setting

UNTIL = 0.2
MODES = (
    "sliding",
    "sticking-in-compression",
    "sticking-in-restitution",
    "reversed-in-compression",
    "reversed-in-restitution",
)
TO_REFERENCE = (2, 3, 0, 1)
TOLERANCES = (1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6)
TABLES: tuple[dict[str, float], ...] = (
    {"A_y": 0.0002, "f_y": 60.0, "A_x": 0.002, "f_x": 15.0},
    {"A_y": 0.0002, "f_y": 60.0, "A_x": 0.001, "f_x": 60.0},
    {"A_y": 0.0, "A_x": 0.001, "f_x": 30.0},
    {"A_y": 0.0005, "f_y": 30.0, "phase_y": 1.0},
)
STARTS = tuple(
    (table, e, mu, theta, omega)
    for table in TABLES
    for e, mu, theta, omega in (
        (0.7, 0.08, 0.3, 0.0),
        (0.7, 0.5, 1.1, 0.0),
        (0.9, 0.08, 0.7, 40.0),
        (0.8, 1.2, -0.4, 5.0),
    )
)


@cache
def by_reference(which: int) -> tuple[State, tuple[Event, ...]]:
    table, e, mu, theta, omega = STARTS[which]
    slow = setting(0.01, 0.02, e=e, mu=mu, g=9.81, **table)
    start = State(*map(float, dropped(slow, theta, 0.001, VX=0.05, omega=omega)))
    try:
        return start, tuple(reference_orbit(slow, start, UNTIL, 35))
    except Chatter as stopped:
        return start, stopped.events[:4]  # before impacts accumulate


def fast(which: int, tolerance: float) -> list[tuple[int, str, Array]]:
    """Corner, mode and state after each impact: flights and impacts, one after another."""
    table, e, mu, _, _ = STARTS[which]
    block = scene(e=e, mu=mu, rest_speed=1e-6, tolerance=tolerance, **table)
    p, notes, z = block.parameters(), fresh_notes(1)[0], np.zeros(body.STATE)
    z[:7] = by_reference(which)[0]
    found: list[tuple[int, str, Array]] = []
    while True:
        if z[body.MODE] != body.FLIGHT or len(found) > 200:
            return found
        assert fly(p, z, UNTIL, notes) == body.DONE
        if z[body.TIME] >= UNTIL:
            return found
        c, s = math.cos(z[body.THETA]), math.sin(z[body.THETA])
        corner = min(range(4), key=lambda i: body.corner_y(p, i, c, s))
        x, y, k2 = body.corner_x(p, corner, c, s), body.corner_y(p, corner, c, s), p[body.GYRATION]
        S0 = z[body.V_X] - z[body.OMEGA] * y - body.table_glide(p, z[body.TIME])
        C0 = z[body.V_Y] + z[body.OMEGA] * x - body.table_rise(p, z[body.TIME])
        B1, B2, B3 = 1 + y * y / k2, 1 + x * x / k2, x * y / k2
        mode = MODES[mode_of(S0, C0, B1, B2, B3, e, mu, first_slide(S0, B1, B3, mu))]
        assert strike(p, z, notes) == body.DONE
        found.append((TO_REFERENCE[corner], mode, z[:7].copy()))


def errors(which: int, tolerance: float) -> list[float]:
    """How far the states after the impacts are from the reference's: times, places and speeds in
    seconds and metres, angles times half a diagonal.
    """
    scale = np.array([1, 1, 1, math.hypot(0.01, 0.02), 1, 1, math.hypot(0.01, 0.02)])
    return [
        float(np.abs((ours[2] - np.array([float(one) for one in event.after])) * scale).max())
        for ours, event in zip(fast(which, tolerance), by_reference(which)[1])
    ]


@each_row("which", range(len(STARTS)))
def test_fast_has_the_impacts_of_the_reference_holds(which: int) -> None:
    events = by_reference(which)[1]
    ours = fast(which, 1e-12)
    whole = len(events) > 4
    assert len(events) >= 2 and (len(ours) == len(events) or not whole and len(ours) >= len(events))
    assert [(corner, mode) for corner, mode, _ in ours[: len(events)]] == [
        (event.corner, event.mode) for event in events
    ]
    assert max(errors(which, 1e-12)) < 1e-10


def test_error_falls_with_the_tolerance_holds() -> None:
    """After the fourth impact, in the median over the starts: faster than the tolerance, and never
    above it, until rounding is all that is left.
    """
    chosen = [which for which in range(len(STARTS)) if len(by_reference(which)[1]) >= 4]
    assert len(chosen) >= 10
    found = [
        float(np.median([errors(which, tolerance)[3] for which in chosen]))
        for tolerance in TOLERANCES
    ]
    slope = np.polyfit(np.log(TOLERANCES[3:]), np.log(found[3:]), 1)[0]
    assert slope > 1.1 and found[0] < 1e-13, (slope, found)
    assert all(error < tolerance for error, tolerance in zip(found, TOLERANCES)), found
