"""Maps whose pieces move far states by no more than a constant: a quadratic form falls by
c V/(1 + V) along them, and where a hypothesis is dropped nothing is said to be proved.
"""

from __future__ import annotations

from pathlib import Path

from juggleproof.proofs.stability.functions.saturated import saturated_rules
from juggleproof.proofs.stability.given import Map, read_file, read_rows
from juggleproof.proofs.stability.points import fixed_points
from juggleproof.proofs.stability.samples import region, with_licences
from juggleproof.proofs.stability.search import PARAMETERS, Proof, setting_of

EXAMPLES = Path(__file__).parents[3] / "examples"
CLIPPED = "x - h*max(-1, min(1, 2*x + y)), y - h*max(-1, min(1, x + 2*y))"


def proved(system: Map) -> Proof:
    """What is certified of the map by these functions alone."""
    system = with_licences(system)
    parameters = region(system.domain, system.parameters, PARAMETERS)
    (fixed,) = [one for one in fixed_points(system) if one.exists(system, parameters).all()]
    found = Proof()
    assert not found.add(system.rule(f"{system.name}/map"))
    setting = setting_of(system, fixed, system.domain)
    for rule, signs in saturated_rules(setting, system.space, f"{system.name}/lyapunov"):
        if not found.add(rule, (1, 2), 100_000, signs):
            break
    return found


def clipped(domain: str) -> Map:
    rows = [("over", "h"), ("domain", domain), ("state", "x y"), ("piece", CLIPPED)]
    return read_rows("clipped", rows)


def test_an_integrator_behind_a_saturation_comes_to_rest_holds() -> None:
    system = read_file(EXAMPLES / "two-tanks.map")
    found = proved(system)
    assert set(found.known) == {"two-tanks/map", "two-tanks/lyapunov"}
    assert len(str(found.certificates)) < 40_000


def test_clipped_steps_below_two_thirds_come_to_rest_holds() -> None:
    assert "clipped/lyapunov" in proved(clipped("0 < h and 2 - 3*h > 0")).known


def test_a_loop_whose_gain_goes_to_zero_comes_to_rest_holds() -> None:
    """At k = 0, an end of the domain, x stays where it is."""
    rows = [("over", "k"), ("domain", "0 < k and k < 1/2"), ("state", "x v")]
    image = "x + v - k*max(-1, min(1, x)), v/2 - k/4*max(-1, min(1, x))"
    assert "loop/lyapunov" in proved(read_rows("loop", [*rows, ("piece", image)])).known


def test_rejects_clipped_steps_up_to_one() -> None:
    """At h = 1 the linear part has the multiplier -2."""
    assert set(proved(clipped("0 < h and h < 1")).known) == {"clipped/map"}
