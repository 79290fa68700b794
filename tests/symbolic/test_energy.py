"""Energy is kept in flight, and changes at an impact as the speeds say."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from hypothesis import assume, given
from hypothesis import strategies as st

import juggleproof.symbolic as s

Value = Callable[..., Fraction]
numbers = st.fractions(min_value=-20, max_value=20, max_denominator=50)
positive = st.fractions(min_value=Fraction(1, 20), max_value=20, max_denominator=50)
restitutions = st.fractions(
    min_value=Fraction(1, 50), max_value=Fraction(49, 50), max_denominator=50
)


def test_energy_is_kept_in_flight_holds() -> None:
    assert s.energy_in_flight() == s.total_energy()
    assert s.energy_change_2() == 0


def test_energy_change_is_that_of_the_kinetic_energy_at_impact_holds() -> None:
    at_impact = s.energy_change_at_impact().xreplace({s.tau: s.collision_time()})
    assert s.lowest_terms(at_impact - s.energy_change_1()) == 0


@given(numbers, numbers, restitutions, positive, positive, positive)
def test_gradient_is_the_exact_slope_of_a_quadratic_holds(
    value: Value,
    beta: Fraction,
    v: Fraction,
    alpha: Fraction,
    r: Fraction,
    g: Fraction,
    step: Fraction,
) -> None:
    # Central differences of a quadratic are its derivative, whatever the step.
    at = {"alpha": alpha, "r": r, "g": g}
    change = s.energy_change_1()
    by_height = value(change, beta=beta + step, v=v, **at) - value(
        change, beta=beta - step, v=v, **at
    )
    by_speed = value(change, beta=beta, v=v + step, **at) - value(
        change, beta=beta, v=v - step, **at
    )
    slopes = tuple(value(entry, beta=beta, v=v, **at) for entry in s.energy_gradient())
    assert slopes == (by_height / (2 * step), by_speed / (2 * step))


@given(positive, restitutions, positive, positive)
def test_zero_change_speed_keeps_the_energy_and_does_not_graze_holds(
    value: Value, tau: Fraction, alpha: Fraction, r: Fraction, g: Fraction
) -> None:
    at = {"alpha": alpha, "r": r, "g": g, "tau": tau}
    v = value(s.zero_change_speed(), **at)
    assert value(s.energy_change_at_impact(), v=v, **at) == 0
    assume(r != g * tau)
    assert v != r


@given(numbers, restitutions, positive, positive)
def test_zero_change_height_keeps_the_energy_holds(
    value: Value, v: Fraction, alpha: Fraction, r: Fraction, g: Fraction
) -> None:
    at = {"alpha": alpha, "v": v, "r": r, "g": g}
    assert value(s.energy_change_1(), beta=value(s.zero_change_height(), **at), **at) == 0


def test_relative_kinetic_energy_contracts_by_the_square_of_restitution_holds() -> None:
    change = s.relative_kinetic_energy_change()
    assert s.lowest_terms(change / s.relative_kinetic_energy() - (s.alpha**2 - 1)) == 0
