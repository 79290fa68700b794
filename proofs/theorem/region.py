"""Proposition 1 for every 0 < alpha < 1: each orbit enters the region R within a number of periods
that its energy tells, and stays there.

Outside of R a rank falls by 1 at least every period.  It is (1 - w)/2, which a flight lowers by 1,
and a multiple of the root u of the energy, which a flight keeps: what an impact takes from u
outweighs the rise of (1 - w)/2, as the factor is chosen, at the worst where the ball is on the
ground and w = 1 + s/(1 - alpha), s^2 = 2 (1 + alpha).
"""

from __future__ import annotations

from certificates.statements import AnyStatement
from proofs.claims import claim
from proofs.paper.vocabulary import R, alpha, b, s, w
from proofs.theorem.definition import SPEED, WHOLE, Descent, u
from proofs.theorem.roots import AT_IMPACTS, LEMMA, compared
from proofs.theorem.rules import PHYSICAL, descends, the_map

FACTOR = (s + 1 - alpha) * (s + 1 + alpha) / (2 * (1 - alpha) ** 2)
TO_THE_REGION = Descent(FACTOR * u + (1 - w) / 2, (R(b),), (("s", 2 * (1 + alpha)), SPEED))
OUTSIDE = (s, (1 - alpha) * u)  # outside of R, u is at least s/(1 - alpha)


@claim(
    "theorem-region",
    "theorem",
    "Proposition 1",
    hints={"uses": (LEMMA,), "premises": {"falls-1": compared((*AT_IMPACTS, OUTSIDE), PHYSICAL)}},
)
def every_orbit_enters_the_region() -> list[AnyStatement]:
    """For every 0 < alpha < 1 each orbit is in R from some period on, no later than its rank
    tells.
    """
    return [
        the_map("map", PHYSICAL),
        descends("enters", "theorem-region/map", PHYSICAL, WHOLE, TO_THE_REGION),
    ]
