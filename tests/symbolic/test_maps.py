"""The return maps, and their fixed points."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from hypothesis import assume, given
from hypothesis import strategies as st
from sympy import Integer, Rational, eye

import juggleproof.symbolic as s

# -------------------------------------------------------------------------------------------------
# The return maps agree with a ball that is flown and struck step by step in exact arithmetic.

Value = Callable[..., Fraction]

positive = st.fractions(min_value=Fraction(1, 20), max_value=20, max_denominator=50)
speeds = st.fractions(min_value=-20, max_value=20, max_denominator=50)
restitutions = st.fractions(
    min_value=Fraction(1, 50), max_value=Fraction(49, 50), max_denominator=50
)


def flown(
    height: Fraction, speed: Fraction, time: Fraction, gravity: Fraction
) -> tuple[Fraction, Fraction]:
    return height + speed * time - gravity * time**2 / 2, speed - gravity * time


def stepped(
    height: Fraction, speed: Fraction, alpha: Fraction, launch: Fraction, gravity: Fraction
) -> tuple[Fraction, Fraction]:
    """One table period: fly, and if ball and table meet, reverse their relative speed there."""
    period = 2 * launch / gravity
    time = height / (launch - speed) if speed < launch else period
    if time >= period:
        return flown(height, speed, period, gravity)
    ball_height, ball_speed = flown(height, speed, time, gravity)
    table_height, table_speed = flown(Fraction(0), launch, time, gravity)
    assert ball_height == table_height
    return flown(
        ball_height, table_speed - alpha * (ball_speed - table_speed), period - time, gravity
    )


@given(positive, speeds, restitutions, positive, positive)
def test_maps_are_flight_and_impact_step_by_step_holds(
    value: Value, beta: Fraction, v: Fraction, alpha: Fraction, r: Fraction, g: Fraction
) -> None:
    at = {"alpha": alpha, "beta": beta, "v": v, "r": r, "g": g}
    impact_comes = value(s.collision_margin(), **at) > 0
    mapping = s.f1() if impact_comes else s.f2()
    assert tuple(value(entry, **at) for entry in mapping) == stepped(beta, v, alpha, r, g)


@given(positive, speeds, positive, positive)
def test_margin_is_positive_exactly_when_the_collision_comes_in_time_holds(
    value: Value, beta: Fraction, v: Fraction, r: Fraction, g: Fraction
) -> None:
    assume(v != r)
    at = {"beta": beta, "v": v, "r": r, "g": g}
    time = value(s.collision_time(), **at)
    comes = v < r and time < 2 * r / g
    assert comes == (value(s.collision_margin(), **at) > 0)
    assert value(s.gap(), t=time, **at) == 0


def test_ball_meets_the_table_at_the_collision_time_holds() -> None:
    ball = s.fly(s.state(s.beta, s.v), s.collision_time())
    table = s.table_at(s.collision_time())
    assert s.lowest_terms(ball[0] - table[0]) == 0
    assert s.lowest_terms(ball[1] - s.ball_speed_at_collision()) == 0
    assert s.lowest_terms(table[1] - s.table_speed_at_collision()) == 0
    assert s.relative_state_at_collision() == s.state(0, s.v - s.r)


def test_boundary_between_the_regions_is_where_the_collision_takes_a_period_holds() -> None:
    assert s.lowest_terms(s.collision_time().xreplace({s.v: s.boundary_speed()}) - s.period()) == 0
    assert (
        s.lowest_terms(s.collision_time().xreplace({s.beta: s.boundary_height()}) - s.period()) == 0
    )
    assert s.time_after_collision().xreplace({s.beta: s.boundary_height()}).cancel() == 0


def test_folded_impact_is_a_contraction_towards_the_launch_holds() -> None:
    difference = (
        s.folded_impact() - s.launch_state() + s.alpha * (s.state(s.beta, s.v) - s.launch_state())
    )
    assert difference.expand() == s.state(0, 0)
    assert (s.fly(s.folded_impact(), s.period()) - s.f1()).applyfunc(s.lowest_terms) == s.state(
        0, 0
    )


def test_first_map_has_its_matrix_offset_and_time_shift_holds() -> None:
    matrix, offset = s.f1_parts()
    assert (matrix + s.alpha * s.flight_matrix(s.period())).applyfunc(s.lowest_terms).is_zero_matrix
    shifted = (s.alpha - 1) * s.flight_matrix(-s.xi_1()) * s.launch_state()
    assert (offset - shifted).applyfunc(s.lowest_terms).is_zero_matrix
    ball = s.state(s.beta, s.v)
    assert (matrix * ball + offset - s.f1()).applyfunc(s.lowest_terms).is_zero_matrix


def test_power_of_the_second_map_is_its_iterate_holds() -> None:
    iterate = s.state(s.beta, s.v)
    for periods in range(5):
        assert s.flight_power(Integer(periods)) == iterate
        iterate = s.apply(s.f2(), iterate)


def test_power_of_the_first_matrix_is_its_iterate_holds() -> None:
    matrix, product = s.f1_parts()[0], eye(2)
    for iterations in range(5):
        assert (s.impact_power_matrix(Integer(iterations)) - product).expand().is_zero_matrix
        product = product * matrix


def test_return_map_is_flights_and_then_one_impact_holds() -> None:
    for periods in range(1, 5):
        iterate = s.state(s.beta, s.v)
        for _ in range(periods - 1):
            iterate = s.apply(s.f2(), iterate)
        difference = s.return_map().xreplace({s.K: Integer(periods)}) - s.apply(s.f1(), iterate)
        assert difference.applyfunc(s.lowest_terms).is_zero_matrix


def test_return_jacobian_is_the_shear_by_all_periods_holds() -> None:
    shear = -s.alpha * s.flight_matrix(s.K * s.period())
    assert (s.return_jacobian() - shear).applyfunc(s.lowest_terms).is_zero_matrix
    assert s.return_eigenvalues() == (-s.alpha, -s.alpha)


@given(positive, speeds, restitutions, positive, positive)
def test_normal_form_is_conjugate_to_the_maps_holds(
    value: Value, beta: Fraction, v: Fraction, alpha: Fraction, r: Fraction, g: Fraction
) -> None:
    at = {"alpha": alpha, "beta": beta, "v": v, "r": r, "g": g}
    x, w = (value(entry, **at) for entry in s.scaling())
    for physical, normal in ((s.f1(), s.normal_f1()), (s.f2(), s.normal_f2())):
        after_beta, after_v = (value(entry, **at) for entry in physical)
        after = tuple(value(entry, beta=after_beta, v=after_v, r=r, g=g) for entry in s.scaling())
        assert after == tuple(value(entry, alpha=alpha, x=x, w=w) for entry in normal)
    assert value(s.normal_energy(), x=x, w=w) * r**2 == value(s.total_energy(), **at)
    assert value(s.normal_energy_change(), alpha=alpha, x=x, w=w) * r**2 == value(
        s.energy_change_1(), **at
    )


# -------------------------------------------------------------------------------------------------
# Fixed points are fixed, and their orbits keep to the regions exactly when restitution is large
# enough.


def test_fixed_point_is_fixed_for_every_number_of_periods_holds() -> None:
    difference = s.apply(s.return_map(), s.fixed_point()) - s.fixed_point()
    assert difference.applyfunc(s.lowest_terms).is_zero_matrix


def test_first_fixed_point_is_that_of_one_period_holds() -> None:
    assert s.apply(s.f1(), s.e_1()) == s.e_1()
    assert (
        (s.fixed_point().xreplace({s.K: Integer(1)}) - s.e_1())
        .applyfunc(s.lowest_terms)
        .is_zero_matrix
    )
    assert s.scaled_state(s.e_1())[1] == s.lowest_terms(2 / (1 + s.alpha))


def test_impact_state_is_fixed_when_impact_comes_first_holds() -> None:
    around = s.apply(s.flight_power(s.K - 1), s.apply(s.f1(), s.impact_fixed_point()))
    assert (around - s.impact_fixed_point()).applyfunc(s.lowest_terms).is_zero_matrix
    assert (
        (s.apply(s.f1(), s.impact_fixed_point()) - s.fixed_point())
        .applyfunc(s.lowest_terms)
        .is_zero_matrix
    )


def test_first_fixed_point_is_a_shifted_launch_holds() -> None:
    shifted = -(1 - s.alpha) / (1 + s.alpha) * s.flight_matrix(-s.epsilon_1()) * s.launch_state()
    assert (shifted - s.e_1()).applyfunc(s.lowest_terms).is_zero_matrix


def test_relative_map_is_linear_holds() -> None:
    matrix = s.f1_parts()[0]
    difference = s.relative_map() - matrix * s.state(s.z1, s.z2)
    assert difference.applyfunc(s.lowest_terms).is_zero_matrix


@given(restitutions, st.integers(min_value=1, max_value=8))
def test_orbit_keeps_to_its_regions_exactly_from_the_threshold_on_holds(
    value: Value, alpha: Fraction, periods: int
) -> None:
    at = {"r": Fraction(1), "g": Fraction(1)}
    beta, v = (value(entry, alpha=alpha, K=Fraction(periods), **at) for entry in s.fixed_point())
    start, kept = (beta, v), True
    for period in range(periods):
        impact_comes = value(s.collision_margin(), beta=beta, v=v, **at) > 0
        kept = kept and beta >= 0 and impact_comes == (period == periods - 1)
        mapping = s.f1() if period == periods - 1 else s.f2()
        beta, v = (value(entry, alpha=alpha, beta=beta, v=v, **at) for entry in mapping)
    assert (beta, v) == start
    assert kept == (alpha >= value(s.restitution_threshold(), K=Fraction(periods)))


def test_table_speed_from_restitution_balance_is_that_of_the_fixed_point_holds() -> None:
    assert s.table_speed_at_fixed_point() == s.subharmonic_table_speed()
    ball = s.ball_speed_at_collision().xreplace(
        {s.beta: s.impact_fixed_point()[0], s.v: s.impact_fixed_point()[1]}
    )
    assert s.lowest_terms(ball + s.subharmonic_ball_speed()) == 0


def test_fixed_point_collides_within_the_period_holds(value: Value) -> None:
    for periods in range(1, 6):
        threshold = value(s.restitution_threshold(), K=Fraction(periods))
        for alpha in (threshold, (1 + threshold) / 2, Fraction(99, 100)):
            at = {"alpha": alpha, "K": Fraction(periods), "r": Fraction(1), "g": Fraction(1)}
            assert 0 <= value(s.collision_time_at_fixed_point(), **at) < 2


def test_equilibrium_speed_is_only_reversed_holds() -> None:
    speed = s.equilibrium_speed()
    struck = s.collide(s.state(0, -speed), s.state(0, s.r))
    assert s.lowest_terms(struck[1] - speed) == 0


def test_threshold_is_where_the_bound_is_the_number_of_periods_holds() -> None:
    assert (
        s.lowest_terms(s.subharmonic_bound().xreplace({s.alpha: s.restitution_threshold()}) - s.K)
        == 0
    )
    assert s.restitution_threshold(2) == Rational(1, 3)
    assert s.restitution_threshold(1) == 0
