"""The bounds are bounds, and are reached or approached, at restitutions for which sqrt(2 (1 +
alpha)) is rational.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from sympy import Poly, Rational, sqrt

import juggleproof.symbolic as s

Value = Callable[..., Fraction]
# alpha = q^2 / 2 - 1 makes sqrt(2 (1 + alpha)) = q rational.
roots = st.fractions(min_value=Fraction(71, 50), max_value=Fraction(99, 50), max_denominator=60)
closing = st.fractions(min_value=Fraction(1, 100), max_value=60, max_denominator=100)
shares = st.fractions(min_value=0, max_value=Fraction(99, 100), max_denominator=100)
UNIT = {"r": Fraction(1), "g": Fraction(2)}  # x = beta and w = 1 - v in these units


def restitution(root: Fraction) -> Fraction:
    return root**2 / 2 - 1


@given(roots, closing, shares)
def test_no_state_that_keeps_its_energy_has_more_than_the_maximum_holds(
    value: Value, root: Fraction, w: Fraction, share: Fraction
) -> None:
    alpha = restitution(root)
    w = min(w, 2 / (1 - alpha))  # beyond, no state of H keeps its energy
    kept = w / 2 - (1 - alpha) * w**2 / 4
    at = {"alpha": alpha, "beta": min(kept, w * Fraction(99, 100)) * share, "v": 1 - w, **UNIT}
    assert value(s.collision_margin(), **at) > 0
    assert value(s.energy_change_1(), **at) >= 0
    assert value(s.total_energy(), **at) <= value(s.E_max(), alpha=alpha, **UNIT)


@given(roots, closing, shares)
def test_no_impact_gains_more_than_the_maximum_holds(
    value: Value, root: Fraction, w: Fraction, share: Fraction
) -> None:
    alpha = restitution(root)
    at = {"alpha": alpha, "beta": w * share, "v": 1 - w, **UNIT}
    assert value(s.collision_margin(), **at) > 0
    assert value(s.energy_change_1(), **at) <= value(s.delta_E_max(), alpha=alpha, **UNIT)


@given(roots, closing, shares)
def test_every_impact_outside_the_region_loses_more_than_the_supremum_holds(
    value: Value, root: Fraction, w: Fraction, share: Fraction
) -> None:
    alpha = restitution(root)
    at = {"alpha": alpha, "beta": w * share, "v": 1 - w, **UNIT}
    while value(s.region_margin(), **at) >= 0:  # outwards, till it is outside of the region
        w *= 2
        at |= {"beta": w * share, "v": 1 - w}
    assert value(s.collision_margin(), **at) > 0
    assert value(s.energy_change_1(), **at) < value(s.delta_E_sup(), alpha=alpha, **UNIT) < 0


@pytest.mark.parametrize(
    "root", [Fraction(3, 2), Fraction(5, 3), Fraction(71, 50), Fraction(199, 100)]
)
def test_maxima_are_reached_in_the_set_and_the_supremum_is_only_approached_holds(
    value: Value, root: Fraction
) -> None:
    alpha = restitution(root)

    def at(found: s.Extremum, lower: Fraction = Fraction(0)) -> dict[str, Fraction]:
        beta, v = (value(entry, alpha=alpha, **UNIT) for entry in found.state)
        return {"alpha": alpha, "beta": beta, "v": v - lower, **UNIT}

    energy, gain, loss = s.largest_kept_energy(), s.largest_energy_change(), s.least_energy_loss()
    assert (energy.attained, gain.attained, loss.attained) == (True, True, False)
    for found in (energy, gain, loss):
        assert value(s.collision_margin(), **at(found)) > 0
    assert value(s.total_energy(), **at(energy)) == value(energy.value, **at(energy))
    assert value(s.energy_change_1(), **at(energy)) == 0
    assert value(s.energy_change_1(), **at(gain)) == value(gain.value, **at(gain))
    assert value(s.region_margin(), **at(loss)) == 0
    near = at(loss, lower=Fraction(1, 10**6))
    assert value(s.region_margin(), **near) < 0
    assert 0 < value(loss.value, **near) - value(s.energy_change_1(), **near) < Fraction(1, 10**3)


def test_maximum_energy_is_that_of_the_equilibrium_speed_holds() -> None:
    assert s.lowest_terms(s.E_max() - s.equilibrium_speed() ** 2 / 2) == 0
    assert s.lowest_terms(s.largest_kept_energy().state[1] + s.equilibrium_speed()) == 0


def test_region_energy_is_the_sum_of_the_maxima_holds() -> None:
    assert s.lowest_terms(s.E_max() + s.delta_E_max() - s.region_energy()) == 0
    assert s.lowest_terms(s.region_margin() + s.total_energy() - s.region_energy()) == 0


def test_corner_lies_on_the_ground_and_on_the_boundary_of_the_region_holds() -> None:
    corner = s.region_corner()
    assert corner[0] == 0
    assert (
        s.lowest_terms(
            (corner[1] / sqrt(2 * s.alpha + 2)) ** 2 * (2 * s.alpha + 2) - 2 * s.region_energy()
        )
        == 0
    )
    assert corner == s.least_energy_loss().state


def test_stationary_point_on_the_boundary_of_the_region_is_no_impact_holds() -> None:
    assert s.stationary_speed_on_region_boundary() == s.r
    gradients = s.energy_gradient() - s.lagrange_multiplier() * s.region_gradient()
    assert gradients.xreplace({s.v: s.r}).expand() == s.state(0, 0)


def test_point_p_has_the_speed_of_the_fixed_point_on_the_line_between_the_regions_holds() -> None:
    height, speed = s.point_p()
    assert speed == s.e_1()[1]
    assert s.lowest_terms(s.collision_margin().xreplace({s.beta: height, s.v: speed})) == 0
    assert s.energy_of_p() == s.energy_at(s.point_p())


@given(closing, st.fractions(min_value=-20, max_value=20, max_denominator=50))
def test_no_fall_takes_longer_than_the_worst_flight_holds(
    value: Value, beta: Fraction, v: Fraction
) -> None:
    # The worst time squared is compared, so that no root is taken.
    at = {"beta": beta, "v": v, **UNIT}
    energy = value(s.total_energy(), **at)
    squared = value(s.worst_flight_time() ** 2, E0=energy, **UNIT)
    # After the worst time the ball is below the ground: at time t it is at beta + v t - g t^2 / 2
    # <= 0.
    fallen = UNIT["g"] * squared / 2 - beta
    assert fallen >= 0
    assert fallen**2 >= v**2 * squared


def test_time_to_enter_the_region_counts_whole_impacts_holds() -> None:
    start = {s.alpha: Rational(1, 8), s.r: 1, s.g: 2, s.E0: 8}
    assert s.impacts_to_enter_region().subs(start) == Rational(40960, 3591)
    assert s.time_to_enter_region().subs(start) == 48  # 12 impacts, at most 4 apart


def test_sign_is_refused_where_it_changes_holds() -> None:
    with pytest.raises(s.DerivationError, match="sign may change"):
        s.sign_for_lossy_impacts(s.alpha - Rational(1, 2))
    with pytest.raises(s.DerivationError, match="sign may change"):
        s.sign_for_lossy_impacts(s.alpha - sqrt(2 * s.alpha + 2) + Rational(6, 5))
    with pytest.raises(s.DerivationError, match="alpha alone"):
        s.sign_for_lossy_impacts(s.alpha + s.K)


@given(roots, st.lists(st.integers(min_value=-9, max_value=9), min_size=4, max_size=4))
def test_sign_is_that_of_every_value_holds(value: Value, root: Fraction, c: list[int]) -> None:
    expression = c[0] + c[1] * s.alpha + (c[2] + c[3] * s.alpha) * sqrt(2 * s.alpha + 2)
    try:
        sign = s.sign_for_lossy_impacts(expression)
    except s.DerivationError:
        assume(False)
    found = value(expression, alpha=restitution(root))
    assert sign == (found > 0) - (found < 0)


def test_candidates_of_which_none_is_always_greatest_are_refused_holds() -> None:
    found = s.candidates(s.w - s.x, [s.x, s.w - s.alpha, 1 - s.w])
    assert s.greatest(found).value == 1
    split = [
        candidate._replace(value=level)
        for candidate, level in zip(found, (s.alpha, Rational(1, 2)), strict=True)
    ]
    with pytest.raises(s.DerivationError, match="sign may change"):
        s.greatest(split)


def test_zeros_of_a_quadratic_are_zeros_holds() -> None:
    quadratic = Poly(s.alpha * s.w**2 - 2 * s.w - s.alpha - 2, s.w)
    for zero in s.simplest_roots(quadratic):
        assert s.reduced(quadratic.as_expr().xreplace({s.w: zero})) == 0
