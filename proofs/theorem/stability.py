"""The theorem in normal form and in the paper's units: e_1 is globally asymptotically stable
exactly for alpha < 1/3.

A. Outside of its stages the rank 2 u + (1 - w)/2 falls by 1 at least every period, u^2 being twice
the energy; the stages lead into the trap, where every period has an impact and brings the state
closer to e_1.  Hence for every integer N >= rank + 3 the state after N + k periods is within (2
alpha)^k of e_1, in units of r T and r.  From alpha = 1/3 on the orbit of e_2, an impact and a
flight by turns, never comes near e_1.
"""

from __future__ import annotations

from certificates.statements import AnyStatement
from proofs.claims import claim
from proofs.theorem.definition import (
    BELOW_A_THIRD,
    FROM_A_THIRD,
    IN_THE_TRAP,
    NEARBY,
    TO_THE_POINT,
    WHOLE,
)
from proofs.theorem.roots import AT_IMPACTS, LEMMA, compared
from proofs.theorem.rules import (
    NORMAL,
    PHYSICAL,
    Setting,
    attracts,
    contracts,
    descends,
    escapes,
    exactly,
    the_map,
)


def stable_exactly_below_a_third(claim_id: str, setting: Setting) -> list[AnyStatement]:
    """The statements of the theorem, each resting on those before it."""

    def name(part: str) -> str:
        return f"{claim_id}/{part}"

    return [
        the_map("map", setting),
        descends("descends", name("map"), setting, BELOW_A_THIRD, TO_THE_POINT),
        contracts("contracts", name("map"), setting, BELOW_A_THIRD, IN_THE_TRAP),
        attracts("attracts", name("descends"), name("contracts")),
        escapes("escapes", name("map"), setting, FROM_A_THIRD),
        exactly("exactly", name("attracts"), name("escapes")),
    ]


@claim(
    "theorem",
    "theorem",
    "normal form",
    hints={"uses": (LEMMA,), "premises": {"falls-1": compared(AT_IMPACTS, NORMAL)}},
)
def fixed_point_is_stable_and_attracts_exactly_below_a_third() -> list[AnyStatement]:
    """For 0 < alpha < 1: e_1 is stable and attracts every state with x >= 0 if and only if alpha <
    1/3.
    """
    return stable_exactly_below_a_third("theorem", NORMAL)


@claim(
    "theorem-in-units",
    "theorem",
    "the paper's units",
    hints={"uses": (LEMMA,), "premises": {"falls-1": compared(AT_IMPACTS, PHYSICAL)}},
)
def the_same_in_the_units_of_the_paper() -> list[AnyStatement]:
    """For 0 < alpha < 1 and all r, g > 0: e_1 is stable and attracts every state of H if and only
    if alpha < 1/3.
    """
    return stable_exactly_below_a_third("theorem-in-units", PHYSICAL)


@claim("theorem-nearby", "theorem", "near e_1")
def fixed_point_attracts_a_neighbourhood_for_every_alpha() -> list[AnyStatement]:
    """For every 0 < alpha < 1, e_1 is stable, and attracts the states of H up to twice its height

    whose speed differs from its speed by at most (1 - alpha) r/(1 + alpha)^2.
    """
    return [
        the_map("map", PHYSICAL),
        contracts("contracts", "theorem-nearby/map", PHYSICAL, WHOLE, NEARBY),
    ]
