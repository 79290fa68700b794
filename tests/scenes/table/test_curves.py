"""The curves between which the bounce of one period may attract every motion, and the picture of
boxes between them.
"""

from __future__ import annotations

from math import isclose, pi

import numpy as np
import pytest

from juggleproof.scenes.table.curves import (
    birth,
    doubling,
    g_of,
    gamma_of,
    grazing,
    own_grazing,
    second_orbit,
)
from juggleproof.scenes.table.motion import Table, bounce_phase, events
from tests.rows import each_row


def first_impact(alpha: float, gamma: float, phase: float) -> float:
    """How long a ball flies that hits the table at this phase of the sine as in a bounce of one
    period.
    """
    table = Table(alpha, gamma)
    own = float(table.derivative(np.array(phase), 1))
    return next(events(table, phase, own + alpha / (1 + alpha))).time - phase


def test_curves_meet_and_cross_as_they_should() -> None:
    for alpha in (0.01, 0.05, 0.1, 0.15):
        assert birth(alpha) <= grazing(alpha) < doubling(alpha)
        assert birth(alpha) in (grazing(alpha), own_grazing(alpha))  # one of them at most
    # beyond alpha = 0.175 the second orbit is a motion wherever the bounce is stable
    assert grazing(0.17) < doubling(0.17) and grazing(0.18) == doubling(0.18)
    # a ball without restitution flies where the table falls faster than it, 2 pi g > 1
    assert own_grazing(0.0) == pytest.approx((pi**2 + 1) ** 0.5, abs=1e-4)


@each_row("alpha", [0.0, 0.05, 0.3])
def test_g_is_that_of_gamma(alpha: float) -> None:
    assert g_of(alpha, birth(alpha)) == 0
    assert isclose(
        gamma_of(alpha, 0.2), ((pi * (1 - alpha) / (1 + alpha)) ** 2 + (0.4 * pi) ** 2) ** 0.5
    )
    assert isclose(g_of(alpha, gamma_of(alpha, 0.2)), 0.2)


@each_row("alpha", [0.03, 0.05, 0.098])
def test_the_ball_of_the_second_orbit_touches_the_table_on_the_curve_holds(alpha: float) -> None:
    edge = grazing(alpha)
    flights = [
        first_impact(alpha, gamma, bounce_phase(alpha, gamma) + second_orbit(alpha, gamma))
        for gamma in (edge - 1e-4, edge + 1e-4)
    ]
    assert flights[0] == pytest.approx(1) and flights[1] < 0.9


@each_row("alpha", [0.001, 0.002, 0.01])
def test_the_ball_of_the_bounce_touches_the_table_on_the_curve_holds(alpha: float) -> None:
    edge = own_grazing(alpha)
    flights = [
        first_impact(alpha, gamma, bounce_phase(alpha, gamma))
        for gamma in (edge - 1e-4, edge + 1e-4)
    ]
    assert flights[0] < 0.9 and flights[1] == pytest.approx(1)


def test_a_cover_is_drawn_with_and_without_boxes_holds() -> None:
    cover = pytest.importorskip("juggleproof.scenes.table.cover").cover
    asked, box = [((0.0, 0.06), "g", (0.18, 0.2))], ((0.0, 0.005), (0.18, 0.19))
    for certified, left in ([box], []), ([], [box]), ([], []):
        drawn = cover(asked, certified, left)
        for name, there in ("certified", certified), ("left", left), ("own-grazing", True):
            assert (f'id="cover-{name}"'.encode() in drawn) == bool(there)
    # of curves that run together one is drawn: that of the bounce's own flight is the birth here
    assert b'id="cover-own-grazing"' not in cover([((0.1, 0.2), "Gamma", (2.6, 2.7))], [], [])
