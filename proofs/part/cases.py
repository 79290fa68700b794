"""The five modes cover every impact, agree where two of them meet, and say what happens to a corner
that does not slide at first.
"""

from __future__ import annotations

from itertools import combinations

from certificates.statements import Statement
from certificates.terms import Formula, conjunction, disjunction, equal, iff, substitute
from proofs.claims import claim
from proofs.forms import always
from proofs.part.setting import (
    APPROACH,
    B1,
    B3,
    BACK,
    BODY,
    DEFINITE,
    DIRECTION,
    FRICTION,
    NO_JAM,
    PAST_COMPRESSION,
    PAST_RESTITUTION,
    S0,
    SLIDES,
    STOPPING,
    Impulse,
    P_x,
    P_y,
    conditions_of,
    e,
    mu,
    of,
    sigma,
    velocity_after,
    words,
)
from symbolic import MODES

FRICTION_HOLDS = (B3 <= mu * B1) & (-B3 <= mu * B1)  # mu >= |B3|/B1


@claim("part-modes-cover", "part", "the modes", parameters=())
def every_impact_is_of_one_of_the_modes() -> list[Statement]:
    """Every impact meets the conditions of one of the five modes, and a corner that stops sticks
    exactly where mu >= |B3|/B1.
    """
    return [
        always(
            disjunction([conjunction(conditions_of(mode)) for mode in MODES]),
            given=[B1 > 0, FRICTION],
            label="cover",
            vocabulary=words(),
        ),
        always(
            iff(BACK <= 0, FRICTION_HOLDS),
            given=[DIRECTION, STOPPING >= 0],
            label="sticks",
            vocabulary=words(),
        ),
    ]


@claim("part-modes-agree", "part", "the modes", parameters=())
def modes_agree_where_two_of_them_meet() -> list[Statement]:
    """Two modes meet only where quantities that tell them apart vanish, and there their impulses
    are the same.

    Sliding all along meets a stop in compression where e = 0, since compression then ends the
    impact, or where the corner does not slide at all.
    """
    no_restitution = equal(e, 0) | equal(S0, 0) & equal(STOPPING, 0)

    def agree(one: str, other: str) -> Statement:
        first, second = of("contact_impulse", one), of("contact_impulse", other)
        conditions = {*conditions_of(one), *conditions_of(other)}
        meet = [
            equal(q, 0)
            for q in (BACK, PAST_COMPRESSION, PAST_RESTITUTION)
            if {q >= 0, q <= 0} <= conditions
        ]
        if one == "sliding" and other.endswith("in-compression"):
            meet = [equal(PAST_COMPRESSION, 0), no_restitution]
        sticks, compressed = "sticking" in one + other, "in-compression" in one + other
        reverses, all_compressed = (
            "reversed" in one + other,
            one.endswith("in-compression") and other.endswith("in-compression"),
        )
        needs = {
            B1 > 0: sticks,
            DEFINITE: compressed,
            DIRECTION: True,
            NO_JAM: not all_compressed,
            STOPPING > 0: reverses,
            BACK >= 0: "reversed-in-compression" in (one, other) and not sticks,
        }
        return always(
            equal(first.along, second.along) & equal(first.away, second.away),
            label=f"{one}.{other}",
            vocabulary=words(),
            given=[*(formula for formula, needed in needs.items() if needed), *meet],
        )

    return [
        always(
            equal(PAST_COMPRESSION, 0) & no_restitution,
            label="no-restitution",
            vocabulary=words(),
            given=[
                DIRECTION,
                SLIDES,
                NO_JAM,
                APPROACH,
                e >= 0,
                PAST_RESTITUTION >= 0,
                PAST_COMPRESSION <= 0,
            ],
        ),
        *(agree(*two) for two in combinations(MODES, 2)),
    ]


@claim("part-at-rest", "part", "S0 = 0", parameters=())
def a_corner_at_rest_sticks_or_slides_as_friction_lets_it() -> list[Statement]:
    """A corner with S0 = 0 sticks where mu >= |B3|/B1; else it slides at once, against the sign of
    B3, and does not jam; either sigma gives this law.

    By sigma = sgn B3 the law is that of sliding back in compression, by sigma = -sgn B3 that of
    sliding.
    """

    def other_way(formula: Formula) -> Formula:
        turned: Formula = substitute(formula, {"sigma": -sigma})
        return turned

    stays, back = (
        of("contact_impulse", "sticking-in-compression"),
        of("contact_impulse", "reversed-in-compression"),
    )
    slides = Impulse(
        *(substitute(part, {"sigma": -sigma}) for part in of("contact_impulse", "sliding"))
    )
    at_rest = [equal(S0, 0), *BODY, APPROACH, e >= 0]
    starts = [equal(S0, 0), *BODY, DIRECTION, FRICTION, BACK > 0]
    return [
        always(
            (P_y >= 0) & (P_x <= mu * P_y) & (-P_x <= mu * P_y),
            given=[*at_rest, FRICTION_HOLDS, equal(P_x, stays.along), equal(P_y, stays.away)],
            label="stays",
            vocabulary=words(),
        ),
        always(
            NO_JAM
            & other_way(NO_JAM)
            & conjunction(conditions_of("reversed-in-compression"))
            & other_way(conjunction(conditions_of("sliding"))),
            given=[*starts, APPROACH, e >= 0],
            label="conditions",
            vocabulary=words(),
        ),
        always(
            equal(slides.along, back.along) & equal(slides.away, back.away),
            given=starts,
            label="either-way",
            vocabulary=words(),
        ),
        always(
            -sigma * velocity_after(slides).along >= 0,
            given=[*starts, APPROACH, e >= 0],
            label="starts",
            vocabulary=words(),
        ),
    ]
