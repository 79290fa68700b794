"""Every motion on a table that moves as a sine tends to one bounce, as the second checker certifies
it.
"""

from __future__ import annotations

from juggleproof.judging.claims import CheckedApart, claim
from juggleproof.sine.stored import STATEMENT, stored_outcomes

CHECKER = "the second checker"
BELIEVED = (
    "certificates/sine alone is believed, which encloses all flights in integers."
    " Coq proves the theorem from flight and impact and from what the checker is to find; it does"
    " not prove that its integers find so"
)


@claim("sine", "sine", "every motion", parameters=())
def every_motion_tends_to_the_bounce_of_one_period() -> CheckedApart:
    """On a table that moves as a sine, for all restitutions alpha in [49/1000, 51/1000] and peak
    accelerations of Gamma times gravity with Gamma in [619/200, 621/200], the bounce of one period
    is stable, and every motion that starts on or above the table tends to it.

    A motion is flights and impacts; where impacts accumulate the ball rests, until the table falls
    away faster than it. A touch without closing speed in flight may count as an impact or not.
    """
    return CheckedApart((STATEMENT,), CHECKER, stored_outcomes, BELIEVED)
