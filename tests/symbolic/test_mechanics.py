"""Flight, impact and table: what the rest is built on."""

from __future__ import annotations

from typing import Any

from sympy import diff, expand, symbols

import juggleproof.symbolic as s


def vanishes(difference: Any) -> bool:
    return all(s.lowest_terms(entry) == 0 for entry in difference)


def test_flight_solves_newtons_equation_holds() -> None:
    height, speed = s.flight_map()
    assert diff(height, s.t) == speed
    assert diff(speed, s.t) == s.acceleration() == -s.g
    assert s.flight_map().xreplace({s.t: 0}) == s.state(s.beta, s.v)


def test_flights_add_up_holds() -> None:
    first, second = symbols("first second")
    start = s.state(s.beta, s.v)
    assert vanishes(s.fly(s.fly(start, first), second) - s.fly(start, first + second))


def test_a_flight_whose_duration_depends_on_the_ball_does_not_capture_its_symbols_holds() -> None:
    assert s.fly(s.state(s.r, 0), s.v) == s.state(s.r - s.g * s.v**2 / 2, -s.g * s.v)


def test_flight_is_matrix_less_offset_holds() -> None:
    assert vanishes(s.flight_matrix() * s.state(s.beta, s.v) - s.flight_offset() - s.flight_map())


def test_impact_reverses_the_relative_speed_and_keeps_momentum_holds() -> None:
    ball, table = s.speeds_after_impact()
    assert s.lowest_terms((ball - table) + s.alpha * (s.v - s.u)) == 0
    assert s.lowest_terms(s.mass_ratio * (ball - s.v) + (table - s.u)) == 0


def test_impact_on_a_heavy_table_leaves_the_table_as_it_is_holds() -> None:
    assert s.table_after_impact() == s.state(s.rho, s.u)


def test_impact_never_gains_energy_in_the_frame_of_the_centre_of_mass_holds() -> None:
    ball, table = s.speeds_after_impact()
    lost = s.mass_ratio * (s.v**2 - ball**2) + (s.u**2 - table**2)
    expected = (1 - s.alpha**2) * s.mass_ratio / (1 + s.mass_ratio) * (s.v - s.u) ** 2
    assert s.lowest_terms(lost - expected) == 0


def test_impact_map_is_the_restitution_matrix_on_the_relative_state_holds() -> None:
    matrix = s.restitution_matrix()
    ball, table = s.state(s.beta, s.v), s.state(s.beta, s.u)
    assert vanishes(matrix * (ball - table) + table - s.collide(ball, table))


def test_table_is_periodic_holds() -> None:
    assert s.table_at(s.period())[0] == 0
    assert s.period() != 0
    assert s.landing_state() == -s.launch_state()
    assert s.state_after_ground() == s.launch_state()


def test_hang_time_returns_to_the_launch_height_holds() -> None:
    landed = s.fly(s.state(s.beta, s.v), s.hang_time())
    assert landed == s.state(s.beta, -s.v)


def test_controlled_step_between_impacts_holds() -> None:
    height, speed = s.controlled_step(s.u, s.t)
    assert expand(speed - ((1 + s.alpha) * s.u - s.alpha * s.v - s.g * s.t)) == 0
    assert diff(height, s.t) == speed
    assert height.xreplace({s.t: 0}) == s.beta
