"""For 1/3 < alpha <= 1/2 every orbit tends to that of e_1 or to that of e_2, but for four states at
1/2.

A second map leads by f from flights and from fast impacts, and from slow impacts by f, f^2 or f^3
at once to the next one, which is T_1, T_2 or T_3 of it. Where one flight of 2 periods follows
another all flights last 2 periods from then on; else all last 1 at last.
"""

from __future__ import annotations

from dataclasses import replace

from juggleproof.papers.derivations import tidied
from juggleproof.proofs.paper.names import alpha, claim, derived_vector, w
from juggleproof.proofs.restitution.impacts import from_here
from juggleproof.proofs.theorem.definition import (
    AT_IMPACTS,
    IMPACT,
    NORMAL,
    PIECES,
    SPACE,
    SPEED,
    Contraction,
    Descent,
    contracts,
    descends,
    the_map,
    u,
)
from juggleproof.proofs.theorem.orbits import HERE, strikes
from juggleproof.proofs.theorem.stability import is_none_of
from juggleproof.reading.values import Vector
from juggleproof.statements.language import (
    AnyStatement,
    Formula,
    MapRule,
    conjunction,
    equal,
    term,
)

FAST = 5  # the closing speed from which on impacts are led on by f
LONGEST = 3  # periods that a flight after a slower impact lasts
BETWEEN = (3 * alpha > 1) & (2 * alpha < 1) & (1 - alpha > 0) & (1 + alpha > 0)
HALF = equal(2 * alpha, 1) & (1 - alpha > 0) & (1 + alpha > 0)


def flown(periods: int, start: Vector = HERE) -> Vector:
    """T_K of the state, K being the number of periods."""
    return from_here(derived_vector("normal_impact_after", (periods,)), start)


def lasts(periods: int, start: Vector = HERE) -> Formula:
    """The flight after an impact lasts this number of periods, or more if it is the longest."""
    next_one = flown(periods, start)
    above = [term(next_one.entries[0]) >= 0] if periods > 1 else []
    return conjunction([*above, *([strikes(next_one)] if periods < LONGEST else [])])


SLOW = IMPACT & (w < FAST)
ONE = SLOW & lasts(1)
TWO = SLOW & lasts(2)
TWO_AND_TWO = TWO & lasts(2, flown(2))
STRUCK, FLOWN = PIECES
FROM_SLOW_IMPACTS = tuple((SLOW & lasts(K), flown(K)) for K in range(1, LONGEST + 1))
SPED_UP = replace(NORMAL, pieces=((IMPACT & (w >= FAST), STRUCK[1]), *FROM_SLOW_IMPACTS, FLOWN))
TO_ONE_OR_TWO = Descent(24 * u + (1 - w) / 2, (SLOW, ONE | TWO, ONE | TWO_AND_TWO), (SPEED,))


def settles(claim_id: str, space: Formula, of_alpha: Formula) -> list[AnyStatement]:
    """The map f, and the map of impacts that makes several steps of it; the descent of that to
    flights of 1 or of 2 periods for good, and the contractions there; to which all orbits of both
    tend.
    """
    here, setting = f"{claim_id}/impacts", replace(SPED_UP, space=space)
    return [
        the_map("map", replace(NORMAL, space=space), of_alpha),
        the_map("impacts", setting, of_alpha),
        descends("descends", here, setting, of_alpha, TO_ONE_OR_TWO, AT_IMPACTS),
        *(
            contracts(
                f"e-{K}",
                here,
                replace(setting, fixed=tidied("normal_impact_fixed_point", K=K)),
                of_alpha,
                Contraction(
                    on,
                    (2 * K * alpha / (1 - alpha), term(1)),
                    (1 + alpha) / 2,
                    (1 - alpha) * (alpha * (K + 1) - (K - 1)) / 20,
                    term(20),
                ),
            )
            for K, on in ((1, ONE), (2, TWO_AND_TWO))
        ),
        MapRule(
            "settles",
            (
                ("descent", f"{claim_id}/descends"),
                # the last stage has no fast impacts, no flights of 3 periods, and no other states
                *(("never", piece) for piece in ("1", "4", "5")),
                *(("contraction", f"{claim_id}/e-1"), ("word", "2")),
                *(("contraction", f"{claim_id}/e-2"), ("word", "3")),
            ),
        ),
        MapRule(
            "returns",
            (
                ("map", f"{claim_id}/map"),
                ("settling", f"{claim_id}/settles"),
                *(("word", word) for word in ("1", "1", "1 2", "1 2 2", "2")),
            ),
        ),
    ]


@claim("restitution-to-a-half", "restitution", "1/3 < alpha < 1/2", parameters=())
def every_orbit_tends_to_one_of_two_between_a_third_and_a_half() -> list[AnyStatement]:
    """For 1/3 < alpha < 1/2 every orbit of H tends to e_1 or to the orbit of e_2; both are
    stable.
    """
    return settles("restitution-to-a-half", SPACE, BETWEEN)


EXCEPTIONS = tuple(Vector((j * (LONGEST - j), LONGEST + 1 - 2 * j)) for j in range(LONGEST + 1))


@claim("restitution-half", "restitution", "alpha = 1/2", parameters=())
def every_orbit_but_four_tends_to_one_of_two_at_a_half() -> list[AnyStatement]:
    """At alpha = 1/2 every orbit of H tends to e_1 or to the orbit of e_2, and both are stable, but
    those of four states: the orbit of e_3, and what flies to it.
    """
    return settles("restitution-half", SPACE & is_none_of(*EXCEPTIONS), HALF)
