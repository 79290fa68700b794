"""Maps whose pieces conserve an energy for a step: what two steps lose."""

from __future__ import annotations

import pytest

from juggleproof.map_stability.functions.candidates import Setting
from juggleproof.map_stability.functions.energies import energies, energy_candidates
from juggleproof.map_stability.terms import written
from tests.map_stability.maps import at_point, map_of, proved

TURNED = "state x y\npiece 3/5*x + 4/5*({0}), -4/5*x + 3/5*({0})"  # by a right triangle's angle


def oscillator(velocity: str) -> Setting:
    """A rotation, after a step that changes the velocity alone."""
    return at_point(map_of(TURNED.format(velocity)))


@pytest.mark.exhaust
def test_an_oscillator_whose_damping_saturates_comes_to_rest_holds() -> None:
    setting = oscillator("y - max(-1, min(1, y/2))")
    assert [written(one) for one in energies(setting)] == ["x_gap^2 + y_gap^2"]
    assert proved(setting, energy_candidates) == ["map", "lyapunov"]


@pytest.mark.parametrize("velocity", ["y + max(-1, min(1, y/2))", "y - max(0, min(1, y - 1))"])
def test_it_comes_to_rest_fails_without_damping(velocity: str) -> None:
    """Where the velocity grows, and where there is no damping close to the point."""
    assert proved(oscillator(velocity), energy_candidates) == ["map"]
