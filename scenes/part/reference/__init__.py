"""The part followed slowly and to many digits, from the laws of mechanics alone: what a fast
integrator is measured against.

    from juggleproof.scenes.part.reference import dropped, reference_orbit, setting

    block = setting("0.01", "0.02", e="0.7", mu="0.08", A_y="0.0002", f_y=60)
    reference_orbit(block, dropped(block, theta="0.5", height="0.001"), until="0.1")

It knows flights and impacts of one corner, and nothing of rest: it stops where impacts accumulate
(`Chatter`), where two corners strike together (`Simultaneous`), and where a corner grazes the table
too closely to tell (`Undecided`).  Nothing is proved: rounding is not enclosed.
"""

from juggleproof.scenes.part.reference.flight import CORNERS, dropped
from juggleproof.scenes.part.reference.impact import Impact, impact
from juggleproof.scenes.part.reference.orbit import Event, reference_orbit
from juggleproof.scenes.part.reference.setting import Setting, State, setting
from juggleproof.scenes.part.reference.stops import Chatter, Simultaneous, Stopped, Undecided

__all__ = [
    "CORNERS",
    "Chatter",
    "Event",
    "Impact",
    "Setting",
    "Simultaneous",
    "State",
    "Stopped",
    "Undecided",
    "dropped",
    "impact",
    "reference_orbit",
    "setting",
]
