"""Maps whose pieces move far states by no more than a constant: a quadratic form falls by
c V/(1 + V) along them, and where a hypothesis is dropped nothing is said to be proved.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from juggleproof.map_stability.functions.saturated import saturated_candidates
from juggleproof.map_stability.maps import read_file
from tests.map_stability.maps import at_point, map_of, proved

TANKS = Path(__file__).parents[2] / "examples/two-tanks.map"
CLIPPED = (
    "over h\ndomain {}\nstate x y\n"
    "piece x - h*max(-1, min(1, 2*x + y)), y - h*max(-1, min(1, x + 2*y))"
)
SATURATED = {
    "an integrator behind a saturation": read_file(TANKS),
    "clipped steps below two thirds": map_of(CLIPPED.format("0 < h and 2 - 3*h > 0")),
    # at k = 0, an end of the domain, x stays where it is
    "a loop whose gain goes to zero": map_of(
        "over k\ndomain 0 < k and k < 1/2\nstate x v\n"
        "piece x + v - k*max(-1, min(1, x)), v/2 - k/4*max(-1, min(1, x))"
    ),
}


LONG = {"clipped steps below two thirds", "a loop whose gain goes to zero"}


@pytest.mark.parametrize(
    "name",
    [pytest.param(one, marks=pytest.mark.exhaust) if one in LONG else one for one in SATURATED],
)
def test_a_saturated_map_comes_to_rest_holds(name: str) -> None:
    assert proved(at_point(SATURATED[name]), saturated_candidates) == ["map", "lyapunov"]


def test_rejects_clipped_steps_up_to_one() -> None:
    """At h = 1 the linear part has the multiplier -2."""
    setting = at_point(map_of(CLIPPED.format("0 < h and h < 1")))
    assert proved(setting, saturated_candidates) == ["map"]
