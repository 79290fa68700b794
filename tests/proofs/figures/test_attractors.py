"""The figure of attracting orbits: its branches are those of the derived map, its ranges those of
the claims.
"""

from __future__ import annotations

from fractions import Fraction
from types import SimpleNamespace

import pytest

from juggleproof.proofs.figures.attractors import (
    MOST,
    SEEN,
    after,
    around,
    exists,
    impacts,
    joined_ranges,
)
from juggleproof.proofs.figures.certified import SETTLED, what_attracts
from juggleproof.proofs.restitution.unequal import FLIGHTS
from juggleproof.statements.language import ClaimError
from tests.proofs.figures.drawn import points
from tests.reports.results_table import results
from tests.rows import each_row

TINY = Fraction(1, 10**9)


def test_branches_of_the_fixed_points_are_theirs_holds() -> None:
    for K in range(1, MOST + 1):
        found = points("fig-attractors", f"e-{K}", 1)
        assert min(found)[0] == pytest.approx((K - 1) / (K + 1)) and max(found)[0] == 1
        for alpha, speed in found:
            assert speed == pytest.approx(2 * K / (1 + alpha))


def test_flights_bring_their_impacts_back_holds() -> None:
    alpha = Fraction(3, 4)
    orbit = impacts(FLIGHTS, alpha)
    assert exists(FLIGHTS, alpha) and after(FLIGHTS[-1], alpha, orbit[-1]) == orbit[0]
    assert str(orbit[0][1]) == "6400424/3249155"


def test_orbit_is_there_fails_without_its_range() -> None:
    assert not exists(FLIGHTS, Fraction(72, 100)) and not exists(FLIGHTS, Fraction(78, 100))
    assert around(FLIGHTS, Fraction(3, 4)) == (Fraction(73, 100), Fraction(31, 40))
    assert all(exists(flights, alpha) for flights, alpha in SEEN)


def test_shaded_ranges_are_those_of_the_claims_holds() -> None:
    settled, flights, proved = what_attracts(results())
    assert joined_ranges(settled) == [(0, settled[-1][1])] and flights == FLIGHTS
    assert exists(FLIGHTS, proved[0] + TINY) and exists(FLIGHTS, proved[1] - TINY)
    assert not exists(FLIGHTS, proved[0] - TINY) and not exists(FLIGHTS, proved[1] + TINY)
    assert {x for x, _ in points("fig-attractors", "unequal", 1)} >= {*map(float, proved)}
    (low, high), *_ = joined_ranges(settled)
    shaded = points("fig-attractors", "settled-0", 1)
    assert {x for x, _ in shaded} == {float(low), float(high)}


@each_row("claim", [SETTLED[3], "restitution-unequal-room"])
def test_rejects_a_claim_that_does_not_hold(claim: str) -> None:
    entries = [
        SimpleNamespace(
            claim=one.claim,
            sharp=one.sharp,
            verdict="unknown" if one.claim.id == claim else one.verdict,
        )
        for one in results()
    ]
    with pytest.raises(ClaimError, match=f"{claim} holds on no range"):
        what_attracts(entries)
