"""Between samples the ball meets the table only where it is struck, and samples are the map's."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler import orbit, point, scene
from juggleproof.scenes.juggler.orbits import heights
from juggleproof.scenes.juggler.tables import in_units

alphas = st.fractions(Fraction(1, 20), Fraction(19, 20), max_denominator=20)


@settings(max_examples=40, deadline=None)
@given(
    alpha=alphas,
    x=st.fractions(0, 9, max_denominator=9),
    w=st.fractions(-4, 4, max_denominator=9),
    r=st.fractions(Fraction(1, 3), 4, max_denominator=3),
    g=st.fractions(Fraction(1, 3), 10, max_denominator=3),
)
def test_samples_are_the_map_and_the_ball_stays_above_the_table_holds(
    alpha: Fraction, x: Fraction, w: Fraction, r: Fraction, g: Fraction
) -> None:
    setting, length = scene(alpha, point(x, w), r, g), 2 * r / g
    found = heights(setting, [length * Fraction(k, 7) for k in range(5 * 7 + 1)])
    kept = orbit(setting, "exact", 5, keep=True)
    for row in kept.history(0):
        here = found[7 * row.periods]
        assert (here.ball, here.table) == (in_units(kept, row, "physical").x, 0)
    assert all(one.ball >= one.table >= 0 for one in found)


def test_ball_and_table_meet_at_an_impact_holds() -> None:
    # x = 1/2, w = 2 at r = 1, g = 2 (so that T = 1): the table strikes at x/w = 1/4.
    one = heights(scene("1/3", point("1/2", 2), 1, 2), ["1/4"])[0]
    assert one.ball == one.table == Fraction(3, 16)


def test_rejects_times_before_the_start() -> None:
    setting = scene("1/3", point(0, 3))
    for wrong, told in (
        (-1, "before the start"),
        (float("nan"), "no finite number"),
        ("x", "no finite number"),
    ):
        with pytest.raises(SceneError, match=told):
            heights(setting, [wrong])
    with pytest.raises(SceneError, match="impacts"):
        heights(setting, [10**9])
