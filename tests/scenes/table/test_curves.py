"""The curves between which the bounce of one period may attract every motion, and their picture."""

from __future__ import annotations

from math import isclose, pi

import pytest

from juggleproof.scenes.table.curves import (
    birth,
    clearance,
    doubling,
    g_of,
    gamma_of,
    grazing,
)


def test_curves_meet_and_cross_as_they_should() -> None:
    for alpha in (0.01, 0.05, 0.1, 0.15):
        assert birth(alpha) <= grazing(alpha) < doubling(alpha)
    # beyond alpha = 0.175 the second orbit is a motion wherever the bounce is stable
    assert grazing(0.17) < doubling(0.17) and grazing(0.18) == doubling(0.18)


@pytest.mark.parametrize("alpha", [0.0, 0.05, 0.3])
def test_g_is_that_of_gamma(alpha: float) -> None:
    assert g_of(alpha, birth(alpha)) == 0
    assert isclose(
        gamma_of(alpha, 0.2), ((pi * (1 - alpha) / (1 + alpha)) ** 2 + (0.4 * pi) ** 2) ** 0.5
    )
    assert isclose(g_of(alpha, gamma_of(alpha, 0.2)), 0.2)


def test_the_ball_of_the_second_orbit_touches_the_table_on_the_curve() -> None:
    edge = grazing(0.05)
    assert clearance(0.05, edge - 1e-3) > 0 > clearance(0.05, edge + 1e-3)
