"""Contact that lasts: pivots, which stick or slide, and faces at rest, against mechanics in many
digits; coming to rest adds no energy.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from types import ModuleType
from typing import TypeAlias

import mpmath
import numpy as np
import pytest
from mpmath import matrix, mpf

from juggleproof.scenes.part import body, moving, run, scene, standing
from juggleproof.scenes.part.ensemble import fresh_notes
from juggleproof.scenes.part.motion import follow, follow_all
from juggleproof.scenes.part.rest import lie, lift_off, pivot, slip_time, stop_time
from juggleproof.scenes.part.setting import Array, Scene
from juggleproof.scenes.part.strike import lie_down
from tests.rows import each_row

Real: TypeAlias = float | mpf
CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))
NOTES = fresh_notes(1)[0]


def place(block: Scene, i: int, theta: Real, lib: ModuleType = math) -> tuple[Real, Real]:
    """Corner i from the centre, by the definition of a turn."""
    (x, y), c, s = CORNERS[i], lib.cos(theta), lib.sin(theta)
    return x * block.a * c - y * block.b * s, x * block.a * s + y * block.b * c


def pivoting(
    block: Scene, i: int, theta: float, omega: float, slide: float = 0.0, speed: float = 0.0
) -> Array:
    """A block at time 0 with corner i on the table; the corner slides at `speed`."""
    p = block.parameters()
    x, y = place(block, i, theta)
    z = moving(
        block,
        0.0,
        1.0,
        theta,
        body.table_glide(p, 0.0) + speed + omega * y,
        body.table_rise(p, 0.0) - omega * x,
        omega,
    )[0]
    z[body.X], z[body.Y] = body.table_place(p, 0.0) - x, body.table_height(p, 0.0) - y
    z[body.MODE], z[body.CORNER], z[body.SLIDE] = body.PIVOT, i, slide
    return z


def lying(block: Scene, speed: float = 0.0, slide: float = 0.0, turns: int = 0) -> Array:
    """A block on a face at time 0, sliding at `speed`."""
    p = block.parameters()
    z = moving(
        block,
        0.0,
        1.0,
        turns * math.pi / 2,
        body.table_glide(p, 0.0) + speed,
        body.table_rise(p, 0.0),
        0.0,
    )[0]
    z[body.Y] = body.table_height(p, 0.0) + (block.a if turns % 2 else block.b)
    z[body.MODE], z[body.CORNER], z[body.SLIDE] = body.FACE, -turns % 4, slide
    return z


def kinetic(block: Scene, z: Array) -> float:
    k2 = (block.a**2 + block.b**2) / 3
    return float(z[body.V_X] ** 2 + z[body.V_Y] ** 2 + k2 * z[body.OMEGA] ** 2) / 2


@each_row("tolerance", [1e-12, 1e-9])
def test_sticking_pivot_on_a_still_table_keeps_the_energy_holds(tolerance: float) -> None:
    block = scene(e=0.5, mu=1.2, A_y=0.0, tolerance=tolerance)
    for i, theta, omega in ((0, 0.5, 0.0), (0, 0.4, -2.0), (1, -0.6, 1.0), (2, math.pi + 0.5, 0.0)):
        z = pivoting(block, i, theta, omega)
        before = kinetic(block, z) + 9.81 * z[body.Y]
        assert pivot(block.parameters(), z, 0.03, fresh_notes(1)[0]) == body.DONE
        assert (z[body.TIME], z[body.MODE], z[body.SLIDE]) == (0.03, body.PIVOT, 0.0)
        assert abs(kinetic(block, z) + 9.81 * z[body.Y] - before) <= 10 * tolerance
        assert abs(place(block, i, z[body.THETA])[0] + z[body.X]) <= 1e-15  # the foot stays


def by_newton(
    block: Scene, z: Array, i: int, slide: int
) -> tuple[Callable[[Real], list[mpf]], Callable[[Real, Real, Real], matrix]]:
    """(X, V_X, theta, omega) by Newton and Euler with the constraint, its forces eliminated by
    linear algebra; as a function of time, and the forces.
    """
    lib = mpmath
    g, k2, mu = (
        lib.mpf(block.g),
        (lib.mpf(block.a) ** 2 + lib.mpf(block.b) ** 2) / 3,
        lib.mpf(block.mu),
    )
    wx, wy = 2 * lib.pi * block.f_x, 2 * lib.pi * block.f_y

    def forces(t: Real, theta: Real, omega: Real) -> matrix:
        x, y = place(block, i, theta, lib)
        lift = -block.A_y * wy**2 * lib.sin(wy * t + block.phase_y)
        push = -block.A_x * wx**2 * lib.sin(wx * t + block.phase_x)
        # unknown F, N, alpha; x'' and y'' of the corner are X'' - y alpha - x omega^2 and Y'' + x
        # alpha - y omega^2
        last = [1, 0, -y] if slide == 0 else [1, slide * mu, 0]
        right = push + x * omega**2 if slide == 0 else lib.mpf(0)
        return lib.lu_solve(
            lib.matrix([[0, 1, x], [-y / k2, x / k2, -1], last]),
            lib.matrix([lift + g + y * omega**2, 0, right]),
        )

    def rates(t: mpf, state: list[mpf]) -> list[mpf]:
        _, v, theta, omega = state
        along, _, alpha = forces(t, theta, omega)
        return [v, along, omega, alpha]

    start = [z[body.X], z[body.V_X], z[body.THETA], z[body.OMEGA]]
    return (
        mpmath.odefun(
            rates,
            z[body.TIME],
            [mpmath.mpf(float(one)) for one in start],
            tol=mpmath.mpf(10) ** -17,
        ),
        forces,
    )


def state_of(z: Array) -> Array:
    return np.array([z[body.X], z[body.V_X], z[body.THETA], z[body.OMEGA]])


@pytest.mark.exhaust
@each_row("slide", [1, -1])
def test_sliding_pivot_is_that_of_newton_and_euler_holds(slide: int) -> None:
    block = scene(e=0.5, mu=0.2, A_x=1e-4, f_x=30.0, A_y=1e-5, f_y=60.0, phase_x=0.3)
    z = pivoting(block, 0, 0.6, -1.0, slide, slide * 0.3)
    with mpmath.workdps(20):
        exact, _ = by_newton(block, z, 0, slide)
        assert (
            pivot(block.parameters(), z, 0.02, fresh_notes(1)[0]) == body.DONE
            and z[body.SLIDE] == slide
            and z[body.TIME] == 0.02
        )
        x, v, theta, omega = np.abs(state_of(z) - np.array([float(one) for one in exact(0.02)]))
        assert (
            max(x, theta * math.hypot(block.a, block.b)) < 5e-12
            and max(v, omega * math.hypot(block.a, block.b)) < 2e-10
        )


def test_sticking_pivot_slips_when_friction_is_used_up_holds() -> None:
    block = scene(e=0.5, mu=0.4, A_x=1e-4, f_x=60.0, A_y=1e-5, f_y=60.0)
    z = pivoting(block, 0, 0.5, 0.0)
    with mpmath.workdps(20):
        exact, forces = by_newton(block, z, 0, 0)

        def left(t: Real) -> mpf:
            _, _, theta, omega = exact(t)
            along, normal, _ = forces(t, theta, omega)
            return mpmath.mpf(block.mu) * normal - abs(along)

        times = np.linspace(0, 0.01, 21)
        late = next(k for k, t in enumerate(times) if left(t) < 0)
        slips = mpmath.findroot(left, (times[late - 1], times[late]), solver="anderson", tol=1e-30)
        assert late > 1 and exact(slips)[3] != 0
        before, after = z.copy(), z.copy()
        for one, until in ((before, float(slips) - 1e-11), (after, float(slips) + 1e-11)):
            assert pivot(block.parameters(), one, until, fresh_notes(1)[0]) == body.DONE
        assert before[body.SLIDE] == 0 and after[body.SLIDE] != 0
        x, v, theta, omega = np.abs(
            state_of(before) - np.array([float(one) for one in exact(before[body.TIME])])
        )
        assert (
            max(x, theta * math.hypot(block.a, block.b)) < 5e-12
            and max(v, omega * math.hypot(block.a, block.b)) < 2e-10
        )


def test_pivot_lands_flat_with_both_corners_on_the_table_holds() -> None:
    block = scene(e=0.5, mu=1.0, A_y=0.0)
    z, notes = pivoting(block, 0, 0.2, -1.0), fresh_notes(1)[0]
    assert pivot(block.parameters(), z, 1.0, notes) == body.DONE
    assert z[body.THETA] == 0 and notes[body.IMPACTS] > 0
    assert abs(z[body.Y] - block.b) < 1e-15 and 0 < z[body.TIME] < 1


def test_face_leaves_when_the_table_falls_as_fast_as_the_block_holds() -> None:
    block = scene(e=0.5, mu=0.3, phase_y=5.0)
    z = lying(block)
    assert lie(block.parameters(), z, 1.0, fresh_notes(1)[0]) == body.DONE
    wy = 2 * math.pi * 60
    assert z[body.MODE] == body.FLIGHT
    assert z[body.TIME] == pytest.approx(
        (math.asin(9.81 / (2e-4 * wy**2)) - 5.0 + 2 * math.pi) / wy, abs=1e-15
    )
    assert (
        lift_off(scene(e=0.5, mu=0.3, A_y=6e-5).parameters(), 0.0, 9.0, NOTES) == 1e300
    )  # 8.5 m/s^2


def test_face_leaves_at_once_where_rounding_has_passed_the_time_to_holds() -> None:
    """Where it could tip too, and nothing pushes it to a side."""
    block = scene(
        e=0.0,
        mu=1.2,
        b=0.01,
        A_y=6.514857454574451e-05,
        f_y=1000.0,
        phase_y=1.1821471600847224,
        g=100.0,
    )
    p, z = block.parameters(), lying(block)
    z[body.TIME] = 0.4168180450698706
    z[body.Y], z[body.V_Y] = (
        0.01 + body.table_height(p, z[body.TIME]),
        body.table_rise(p, z[body.TIME]),
    )
    assert -1e-8 < 100 + body.table_lift(p, z[body.TIME]) < 0
    assert lie(p, z, 1.0, fresh_notes(1)[0]) == body.DONE and z[body.MODE] == body.FLIGHT
    assert follow(p, z, 0.5, fresh_notes(1)[0]) == body.DONE


def test_face_slips_and_stops_at_the_roots_of_its_forces_holds() -> None:
    block = scene(e=0.5, mu=0.3, A_x=1e-4, f_x=60.0, A_y=2e-5, f_y=60.0, phase_y=1.0)
    p, (wx, wy) = block.parameters(), (2 * mpmath.pi * 60,) * 2

    def left(t: Real) -> mpf:
        return 0.3 * (9.81 - 2e-5 * wy**2 * mpmath.sin(wy * t + 1)) - abs(
            1e-4 * wx**2 * mpmath.sin(wx * t)
        )

    with mpmath.workdps(30):
        slips = slip_time(p, 0.0, 1.0, 0.3, 0.3, fresh_notes(1)[0])[0]
        assert all(left(mpmath.mpf(slips) * k / 200) > 0 for k in range(199))
        root = mpmath.findroot(left, (slips - 1e-5, slips + 1e-5), solver="anderson", tol=1e-40)
        assert abs(root - slips) < 1e-12
        push = body.table_push(p, slips)
        slide = -1 if push > 0 else 1
        stops = stop_time(p, slips, 1.0, slide, 0.0, fresh_notes(1)[0])
        start = mpmath.mpf(slips)

        def speed(t: mpf) -> mpf:
            glide, rise = (
                A * w * (mpmath.cos(w * t + phase) - mpmath.cos(w * start + phase))
                for A, w, phase in ((1e-4, wx, 0), (2e-5, wy, 1))
            )
            return -slide * glide - 0.3 * (9.81 * (t - start) + rise)

        assert stops - slips > 1e-3 and all(
            speed(start + (stops - start) * k / 200) > 0 for k in range(1, 199)
        )
        assert (
            abs(
                mpmath.findroot(speed, (stops - 1e-5, stops + 1e-5), solver="anderson", tol=1e-40)
                - stops
            )
            < 1e-11
        )


def test_face_slides_as_the_integral_of_its_forces_holds() -> None:
    block = scene(e=0.5, mu=0.3, A_x=1e-4, f_x=60.0, phase_x=0.2, A_y=2e-5, f_y=60.0, phase_y=1.0)
    p, z = block.parameters(), lying(block, 0.5, 1.0)
    start = z.copy()
    assert lie(p, z, 0.01, fresh_notes(1)[0]) == body.DONE and z[body.SLIDE] == 1

    def normal(t: mpf) -> mpf:
        return 9.81 - 2e-5 * (120 * mpmath.pi) ** 2 * mpmath.sin(120 * mpmath.pi * t + 1)

    lost = 0.3 * mpmath.quad(normal, [0, 0.01])
    moved = 0.3 * mpmath.quad(lambda t: (mpmath.mpf("0.01") - t) * normal(t), [0, 0.01])
    assert (
        abs(start[body.V_X] - lost - z[body.V_X]) < 1e-14
        and abs(start[body.V_X] * 0.01 - moved - z[body.X]) < 1e-15
    )


def test_face_that_friction_cannot_hold_does_not_stick_holds() -> None:
    """It comes to lie while the table pushes harder than friction can, and ever less."""
    block = scene(e=0.5, mu=0.1, A_x=1e-3, f_x=60.0, phase_x=2.0, A_y=0.0)
    p, z = block.parameters(), lying(block)
    assert abs(body.table_push(p, 0.0)) > 0.1 * 9.81 and body.table_push(p, 1e-5) > body.table_push(
        p, 0.0
    )
    assert slip_time(p, 0.0, 1.0, 0.1, 0.1, fresh_notes(1)[0])[0] == 0
    speed = z[body.V_X]
    assert lie(p, z, 1e-4, fresh_notes(1)[0]) == body.DONE
    assert z[body.SLIDE] == 1 and abs(z[body.V_X] - (speed - 0.1 * 9.81 * 1e-4)) < 1e-12


def test_face_that_rests_for_long_does_not_run_out_of_steps_holds() -> None:
    block = scene(e=0.5, mu=0.3, A_x=2e-6, f_x=60.0, A_y=6e-5, tolerance=1e-9)
    z, notes = lying(block, turns=1), fresh_notes(1)[0]
    assert follow_all(block.parameters(), z[None], 3000.0, notes[None])[0] == body.DONE
    assert (
        z[body.MODE] == body.FACE
        and abs(z[body.X] - 2e-6 * math.sin(120 * math.pi * 3000)) < 1e-9
        and notes[body.IMPACTS] == 0
    )


def test_coming_to_lie_adds_no_energy_and_takes_at_most_what_is_stated_holds() -> None:
    dice = np.random.default_rng(1)
    block = scene(e=0.5, mu=0.3, A_y=0.0, rest_speed=1e-2)
    p = block.parameters()
    for turns in (0, 1, 2, -1):
        half = block.b if turns % 2 else block.a
        most = 1e-4 * (2 + (block.a**2 + block.b**2) / 3 / half**2) / 2
        for _ in range(200):
            left, right, across = dice.uniform(-1e-2, 1e-2, 3)
            z, notes = lying(block, across, turns=turns), fresh_notes(1)[0]
            z[body.V_Y], z[body.OMEGA] = (left + right) / 2, (right - left) / (2 * half)
            before = kinetic(block, z)
            lie_down(p, z, 0, 0.0, 0.0, notes)
            assert 0 <= before - kinetic(block, z) <= most * (1 + 1e-12)
            assert notes[body.LARGEST_REMOVED] == pytest.approx(
                before - kinetic(block, z), abs=1e-18
            )


@each_row("tolerance, mu", [(1e-12, 0.08), (1e-12, 1.2), (1e-8, 0.3)])
def test_blocks_in_contact_are_on_the_table_holds(tolerance: float, mu: float) -> None:
    block = scene(e=0.3, mu=mu, A_x=1e-3, f_x=30.0, A_y=5e-5, tolerance=tolerance)
    seen = set()
    for until in (0.02, 0.1, 0.3, 1.0):
        after = run(block, standing(block, np.radians(np.arange(91.0))), until)
        p = block.parameters()
        for z in after.states:
            lowest = min(place(block, i, z[body.THETA])[1] for i in range(4))
            gap = z[body.Y] + lowest - body.table_height(p, z[body.TIME])
            seen.add(z[body.MODE])
            assert gap >= -2 * tolerance and (z[body.MODE] == body.FLIGHT or gap <= 2 * tolerance)
        removed, narrow = after.notes[:, body.LARGEST_REMOVED].max(), block.a
        assert removed <= 1e-6 * (2 + (block.a**2 + block.b**2) / 3 / narrow**2) / 2
    assert seen == {body.FLIGHT, body.PIVOT, body.FACE}
