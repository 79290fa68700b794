"""The share of the wedge that docs/sine.md tells is that of the certificates' boxes."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from juggleproof.benchmarks import wedge
from juggleproof.certificates.sine.checker import Rectangle, outcome
from juggleproof.scenes.table.curves import doubling, grazing
from juggleproof.sine.stored import boxes_in

POINTS = 400
PROVED = boxes_in(wedge.WIDE)


def test_the_page_has_the_shares_of_the_certificates_holds() -> None:
    assert wedge.TABLE.text() == wedge.table()


@pytest.mark.exhaust
def test_shares_are_those_of_random_pairs_of_the_wedge_holds() -> None:
    source = random.Random(7)
    low, high = wedge.ENDS[0], wedge.ENDS[-1]
    inside = certified = 0
    while inside < POINTS:
        alpha = low + (high - low) * Fraction(source.random())
        gamma = Fraction(2.4 + 1.2 * source.random())
        if grazing(float(alpha)) < gamma < doubling(float(alpha)):
            inside += 1
            pair = Rectangle("", (alpha, alpha), "Gamma", (gamma, gamma))
            certified += outcome(pair, PROVED)[0] == "certified"
    whole = wedge.area(low, high, [(one.alpha, one.g) for one in PROVED])
    assert certified / POINTS == pytest.approx(whole.certified / whole.wedge, abs=0.05)


def test_no_share_is_certified_without_boxes_holds() -> None:
    low, high = wedge.ENDS[:2]
    whole, none = (
        wedge.area(low, high, [(one.alpha, one.g) for one in PROVED]),
        wedge.area(low, high, []),
    )
    assert none.certified == 0 < whole.certified < whole.wedge == none.wedge
