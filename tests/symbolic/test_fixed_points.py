"""Fixed points are fixed, and their orbits keep to the regions exactly when restitution is large
enough.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Integer, Rational

import juggleproof.symbolic as s

Value = Callable[..., Fraction]
restitutions = st.fractions(
    min_value=Fraction(1, 50), max_value=Fraction(49, 50), max_denominator=50
)
few = settings(max_examples=60, deadline=None)


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


@few
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
