"""Maps whose pieces conserve an energy for a step: what two steps lose."""

from __future__ import annotations

import pytest

from juggleproof.proofs.stability.functions.energies import energies, energy_rules
from juggleproof.proofs.stability.functions.values import Setting
from juggleproof.proofs.stability.given import Map, read_rows, written
from juggleproof.proofs.stability.points import PARAMETERS, fixed_points
from juggleproof.proofs.stability.samples import region, with_licences
from juggleproof.proofs.stability.search import Proof, setting_of

TURNED = "3/5*x + 4/5*({0}), -4/5*x + 3/5*({0})"  # by a right triangle's angle


def oscillator(velocity: str) -> Map:
    """A rotation, after a step that changes the velocity alone."""
    rows = [("state", "x y"), ("piece", TURNED.format(velocity))]
    return with_licences(read_rows("oscillator", rows))


def at_its_point(system: Map) -> Setting:
    parameters = region(system.domain, system.parameters, PARAMETERS)
    points = [one for one in fixed_points(system) if one.exists(system, parameters).all()]
    return setting_of(system, points[0], system.domain)


def proved(system: Map) -> Proof:
    """What is certified of the map by such energies alone."""
    found = Proof()
    assert not found.add(system.rule("oscillator/map"))
    for rule, searches in energy_rules(at_its_point(system), system.space, "oscillator/lyapunov"):
        if not found.add(rule, (1, 2), 100_000, searches=searches):
            break
    return found


def test_an_oscillator_whose_damping_saturates_comes_to_rest_holds() -> None:
    system = oscillator("y - max(-1, min(1, y/2))")
    assert [written(one) for one in energies(at_its_point(system))] == ["x_gap^2 + y_gap^2"]
    found = proved(system)
    assert set(found.known) == {"oscillator/map", "oscillator/lyapunov"}
    assert len(str(found.certificates)) < 60_000


@pytest.mark.parametrize("velocity", ["y + max(-1, min(1, y/2))", "y - max(0, min(1, y - 1))"])
def test_it_comes_to_rest_fails_without_damping(velocity: str) -> None:
    """Where the velocity grows, and where there is no damping close to the point."""
    assert set(proved(oscillator(velocity)).known) == {"oscillator/map"}
