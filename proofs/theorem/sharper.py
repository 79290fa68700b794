"""Bounds that come near the worst case: for any W with (1 - alpha) W > 2, a rank with a smaller
factor leads to the energies u <= W - 1.

A ball thrown up from the ground with great u needs about u/(1 - alpha) periods to lose its energy,
as each impact leaves alpha of its speed.  The factor (1 + alpha) W / (2 ((1 - alpha) W - 2)) comes
down to (1 + alpha)/(2 (1 - alpha)) as W grows, and the rank of that ball to u/(1 - alpha). From u
<= W - 1 the rank of the theorem leads on, which is at most 5 (W - 1)/2 there.
"""

from __future__ import annotations

from dataclasses import replace

from certificates.search.closing import Hints
from certificates.statements import AnyStatement
from certificates.terms import reals
from proofs import forms
from proofs.claims import claim
from proofs.paper.vocabulary import STANDING, alpha, w, x
from proofs.theorem.definition import SPEED, TO_THE_POINT, WHOLE, Descent, u
from proofs.theorem.roots import AT_IMPACTS, LEMMA, compared
from proofs.theorem.rules import NORMAL, descends, the_map

W, after = reals("W after")
FACTOR = (1 + alpha) * W / (2 * ((1 - alpha) * W - 2))
LITTLE = 4 * x + (w - 1) ** 2 <= (W - 1) ** 2
RANK_THERE = (
    5 * (W - 1) / 2
)  # what the rank of the theorem is at most, where there is little energy
TO_LITTLE_ENERGY = Descent(FACTOR * u + (1 - w) / 2, (LITTLE,), (SPEED,))
WITH_W = replace(NORMAL, parameters=(alpha, W), positive=(W > 2, (1 - alpha) * W - 2 > 0))
OUTSIDE = (W - 1, u)
LOSES = "theorem-sharper/loses"
USES = Hints(
    (
        *compared((*AT_IMPACTS, OUTSIDE), WITH_W).uses,
        (LOSES, {"alpha": "alpha", "W": "W", "w": "w", "u": "u", "after": "u_next"}),
    )
)


@claim(
    "theorem-sharper",
    "theorem",
    "sharper bounds",
    hints={"uses": (LEMMA, LOSES), "premises": {"falls-1": USES}},
)
def orbits_lose_energy_about_as_fast_as_the_worst() -> list[AnyStatement]:
    """For every W > 2/(1 - alpha) an orbit has u <= W - 1 from some period on, no later than a rank
    tells that nears the worst case as W grows.
    """
    high = [W > 2, u >= W - 1, u >= w - 1, after <= 1 + alpha * w]
    return [
        forms.always(
            W * (u - after) >= w * ((1 - alpha) * W - 2),
            given=high,
            in_range=[],
            label="loses",
            vocabulary=STANDING,
        ),
        the_map("map", WITH_W),
        descends("to-little-energy", "theorem-sharper/map", WITH_W, WHOLE, TO_LITTLE_ENERGY),
        forms.always(
            TO_THE_POINT.rank <= RANK_THERE,
            given=[W >= 1, u**2 <= (W - 1) ** 2, -u <= w - 1],
            label="rank-there",
            vocabulary=STANDING,
        ),
    ]
