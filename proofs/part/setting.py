"""What the claims about a corner's impact have in common: names, hypotheses, the five modes and
their conditions.

A corner strikes the table with C0 < 0; sigma, 1 or -1, is the direction in which it slides, of
either sign where it does not (S0 = 0).  Of the body only B1, B2 and B3 matter; for every corner of
every body B1 > 0 and B1 B2 > B3^2 (claim part-corner).
"""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from certificates.terms import Formula, Number, Term, equal, reals, substitute, term
from proofs.forms import Vocabulary
from proofs.paper.vocabulary import derived

B1, B2, B3, S0, C0, e, mu, sigma = reals("B1 B2 B3 S0 C0 e mu sigma")
P_x, P_y, S, C = reals(
    "P_x P_y S C"
)  # the impulse of the impact, and the corner's velocity after it
ORDER = ("sigma", "e", "mu", "B1", "B2", "B3", "S0", "C0")
SAMPLE = {
    "B3": Fraction(1),
    "mu": Fraction(1, 4),
    "sigma": Fraction(1),
}  # here the corner stops and slides back

CRITERIA = (
    "closing_rate",
    "stopping_rate",
    "slides_back",
    "slides_through_compression",
    "slides_through_restitution",
)
CLOSING, STOPPING, BACK, PAST_COMPRESSION, PAST_RESTITUTION = map(derived, CRITERIA)

DEFINITE = B1 * B2 - B3**2 > 0
BODY = (B1 > 0, DEFINITE)
DIRECTION = equal(sigma, 1) | equal(sigma, -1)
SLIDES = sigma * S0 >= 0
NO_JAM = CLOSING > 0
APPROACH = C0 < 0
FRICTION = mu >= 0
RESTITUTION = (e >= 0, e <= 1)
STICKS, REVERSES = (BACK <= 0,), (BACK >= 0, STOPPING > 0)
IN_COMPRESSION, IN_RESTITUTION = (
    (PAST_COMPRESSION <= 0,),
    (PAST_COMPRESSION >= 0, PAST_RESTITUTION <= 0),
)
_CONDITIONS: dict[str, tuple[Formula, ...]] = {
    "sliding": (PAST_RESTITUTION >= 0,),
    "sticking-in-compression": IN_COMPRESSION + STICKS,
    "sticking-in-restitution": IN_RESTITUTION + STICKS,
    "reversed-in-compression": IN_COMPRESSION + REVERSES,
    "reversed-in-restitution": IN_RESTITUTION + REVERSES,
}


def conditions_of(mode: str) -> tuple[Formula, ...]:
    """When an impact is of a mode; where two modes meet, the conditions of both hold, and they
    agree (claim part-modes-agree).
    """
    for name in CRITERIA:  # noted as what the claim rests on
        derived(name)
    return _CONDITIONS[mode]


class Impulse(NamedTuple):
    """An impulse, or a velocity: along the table, and away from it."""

    along: Term
    away: Term


def of(name: str, *arguments: str) -> Impulse:
    """A derived impulse or velocity."""
    value = derived(name, *arguments)
    return Impulse(term(value.component(1)), term(value.component(2)))


def velocity_after(impulse: Impulse) -> Impulse:
    """The corner's velocity after an impulse."""
    values: dict[str, Number] = {"P_x": impulse.along, "P_y": impulse.away}
    return Impulse(*(substitute(speed, values) for speed in of("velocity_after_impulse")))


def work_of(impulse: Impulse) -> Term:
    """What an impulse adds to the kinetic energy in the table's frame."""
    added: Term = substitute(
        derived("work_of_impulse"), {"P_x": impulse.along, "P_y": impulse.away}
    )
    return added


def words(mode: str = "", **further: Term) -> Vocabulary:
    """The names for the impulse of a mode, for the velocity after it, and for what else there
    is.
    """
    names: dict[str, Term] = dict(further)
    if mode:
        after = velocity_after(Impulse(P_x, P_y))
        names |= {
            "P_y": derived("normal_impulse", mode),
            "P_x": derived("tangential_impulse", mode),
            "S": after.along,
            "C": after.away,
        }
    return Vocabulary(ORDER, abbreviations=names, sample=SAMPLE)
