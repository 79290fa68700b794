"""The five modes of a corner's impact: the impulse of each by Coulomb's and Poisson's laws, the
energy, and that they cover every impact and agree.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations

from juggleproof.judging.claims import Remark
from juggleproof.judging.forms import always, exists_some
from juggleproof.proofs.part.corner import (
    APPROACH,
    B1,
    B2,
    B3,
    BACK,
    BODY,
    C0,
    CLOSING,
    COEFFICIENTS,
    DEFINITE,
    DIRECTION,
    FRICTION,
    NO_JAM,
    PAST_COMPRESSION,
    PAST_RESTITUTION,
    RESTITUTION,
    REVERSES,
    S0,
    SLIDES,
    STOPPING,
    C,
    Impulse,
    P_x,
    P_y,
    S,
    claim,
    conditions_of,
    e,
    mu,
    of,
    products_hint,
    sigma,
    velocity_after,
    words,
    work_of,
)
from juggleproof.proofs.theorem.definition import value_of
from juggleproof.statements.language import (
    Formula,
    Number,
    Statement,
    Term,
    conjunction,
    disjunction,
    equal,
    iff,
    real,
    reals,
    substitute,
    term,
)
from juggleproof.symbolic import MODES

# -------------------------------------------------------------------------------------------------
# The five modes of a corner's impact: each impulse is that of a walk by Coulomb's and Poisson's
# laws, and what it guarantees.
#
# A walk through impulse space grows the impulse from 0. While the corner slides, friction is mu
# times the normal impulse and opposes the sliding; where it has stopped, friction holds it if it
# can. Compression is greatest where C = 0; the impact ends at 1 + e times the normal impulse of
# that moment. Velocities are linear on each piece of a walk, so what holds at the ends of a piece
# holds all along it.

STOP, MOST, END = (
    Impulse(*reals("x_stop y_stop")),
    Impulse(*reals("x_most y_most")),
    Impulse(P_x, P_y),
)


WALKS: dict[str, tuple[Formula, ...]] = {  # what determines a walk, beside its laws
    "sliding": (NO_JAM,),
    "sticking-in-compression": (*BODY, DIRECTION, STOPPING > 0),
    "sticking-in-restitution": (B1 > 0, DIRECTION, NO_JAM, STOPPING > 0),
    "reversed-in-compression": (*BODY, DIRECTION, *REVERSES),
    "reversed-in-restitution": (DIRECTION, NO_JAM, STOPPING > 0),
}
IMPACTS: dict[
    str, tuple[Formula, ...]
] = {  # what its guarantees need of an impact, beside the conditions of the mode
    "sliding": (DIRECTION, NO_JAM, APPROACH, e >= 0),
    "sticking-in-compression": (*BODY, DIRECTION, SLIDES, APPROACH, e >= 0),
    "sticking-in-restitution": (B1 > 0, DIRECTION, NO_JAM, APPROACH, e >= 0),
    "reversed-in-compression": (*BODY, DIRECTION, SLIDES, e >= 0),
    "reversed-in-restitution": (DIRECTION, NO_JAM, APPROACH),
}
# What is gained backwards: the speed times what impulse is left, part by part.
BACKWARDS = products_hint(
    [(BACK, -(1 + e) * PAST_COMPRESSION, 1), (BACK, e * sigma * S0 * (B2 - mu * sigma * B3), 1)]
)


def on_line(name: str, impulse: Impulse) -> Formula:
    """The impulse is on the line of sliding, of sticking, or of sliding back."""
    if name == "sliding":
        return equal(impulse.along, -sigma * mu * impulse.away)
    if name == "reversed":
        return equal(impulse.along - STOP.along, sigma * mu * (impulse.away - STOP.away))
    return equal(velocity_after(impulse).along, 0)


def laws(mode: str) -> list[Formula]:
    """What determines a walk: where the corner stops, if it does, where compression is greatest,
    and where the impact ends.
    """
    compression, end = MODES[mode]
    stops = (
        []
        if mode == "sliding"
        else [on_line("sliding", STOP), equal(velocity_after(STOP).along, 0)]
    )
    return [
        *stops,
        on_line(compression, MOST),
        equal(velocity_after(MOST).away, 0),
        on_line(end, END),
        equal(P_y, (1 + e) * MOST.away),
    ]


def order(mode: str) -> list[Formula]:
    """The moments of a walk come in their order, and friction does on each piece what it should."""
    compression, end = MODES[mode]
    if mode == "sliding":
        return [0 <= MOST.away, MOST.away <= P_y, sigma * S >= 0]
    first, second = (MOST, STOP) if compression == "sliding" else (STOP, MOST)
    in_order = [0 <= first.away, first.away <= second.away, second.away <= P_y]
    along, away = P_x - STOP.along, P_y - STOP.away
    return in_order + (
        [along <= mu * away, -along <= mu * away] if end == "sticking" else [sigma * S <= 0]
    )


def impact(mode: str) -> list[Statement]:
    """All that is claimed of a mode: the walk, that there is no other, and what is guaranteed."""
    given = [*IMPACTS[mode], *conditions_of(mode)]
    points = {"P_x": of("contact_impulse", mode).along, "P_y": of("contact_impulse", mode).away}
    points |= dict(zip(("x_most", "y_most"), of("compressing_impulse", mode)))
    points |= dict(zip(("x_stop", "y_stop"), of("stopping_impulse"))) if mode != "sliding" else {}
    walk = {name: point for name, point in points.items() if not name.startswith("P")}

    def so(show: Formula, label: str, needs: Sequence[Formula]) -> Statement:
        return always(show, given=needs, label=label, vocabulary=words(mode, **walk))

    no_other = conjunction(equal(real(name), point) for name, point in points.items())
    return [
        so(conjunction(laws(mode)), "walk", WALKS[mode]),
        always(no_other, given=[*WALKS[mode], *laws(mode)], label="no-other", vocabulary=words()),
        so(
            conjunction(order(mode)),
            "order",
            [*given, STOPPING > 0] if mode.startswith("sticking") else given,
        ),
        so(P_y >= 0, "pushes", given),
        so(
            (P_x <= mu * P_y) & (-P_x <= mu * P_y),
            "cone",
            given if mode == "sticking-in-compression" else [*given, FRICTION],
        ),
        so(C >= 0, "parts", [*given, DEFINITE] if mode.endswith("in-restitution") else given),
    ]


@claim("part-sliding", "part", "sliding", parameters=())
def a_corner_that_slides_all_along_ends_its_approach() -> list[Statement]:
    """A corner that slides all along has this impulse; it pushes, is in the cone of friction, and
    ends the approach.
    """
    return impact("sliding")


@claim("part-sticking-in-compression", "part", "sticking in compression", parameters=())
def a_corner_that_sticks_in_compression_ends_its_approach() -> list[Statement]:
    """A corner that stops in compression and sticks has this impulse; it pushes, is in the cone of
    friction, and ends the approach.
    """
    return impact("sticking-in-compression")


@claim("part-sticking-in-restitution", "part", "sticking in restitution", parameters=())
def a_corner_that_sticks_in_restitution_ends_its_approach() -> list[Statement]:
    """A corner that stops in restitution and sticks has this impulse; it pushes, is in the cone of
    friction, and ends the approach.
    """
    return impact("sticking-in-restitution")


@claim(
    "part-reversed-in-compression",
    "part",
    "reversed in compression",
    parameters=(),
    hints=BACKWARDS,
)
def a_corner_that_slides_back_in_compression_ends_its_approach() -> list[Statement]:
    """A corner that stops in compression and slides back has this impulse; it pushes, is in the
    cone of friction, and ends the approach.
    """
    return impact("reversed-in-compression")


@claim("part-reversed-in-restitution", "part", "reversed in restitution", parameters=())
def a_corner_that_slides_back_in_restitution_ends_its_approach() -> list[Statement]:
    """A corner that stops in restitution and slides back has this impulse; it pushes, is in the
    cone of friction, and ends the approach.
    """
    return impact("reversed-in-restitution")


# -------------------------------------------------------------------------------------------------
# No impact of a corner gains kinetic energy in the table's frame: in each mode what is gained is
# minus a sum of products that are not negative.

LOST = (1 - e) * (1 + e)
DETERMINANT = B1 * B2 - B3**2
CLOSING_BACK = B2 - mu * sigma * B3  # the closing rate of a corner that slides back
LEFT = (
    -(1 + e) * PAST_COMPRESSION + e * CLOSING_BACK * sigma * S0
)  # the normal impulse after the stop, without its denominators


def gains_nothing(mode: str, given: Sequence[Formula]) -> Statement:
    """The work of the mode's impulse is not positive."""
    return always(
        work_of(Impulse(P_x, P_y)) <= 0, given=given, label="gains-nothing", vocabulary=words(mode)
    )


@claim("part-sliding-energy", "part", "sliding", parameters=())
def sliding_gains_no_energy() -> Statement:
    """A corner that slides all along gains no energy."""
    return gains_nothing(
        "sliding",
        [DIRECTION, SLIDES, NO_JAM, APPROACH, FRICTION, PAST_RESTITUTION >= 0, *RESTITUTION],
    )


@claim("part-sticking-in-compression-energy", "part", "sticking in compression", parameters=())
def sticking_in_compression_gains_no_energy() -> Statement:
    """An impact by the law of sticking in compression gains no energy, wherever it is used."""
    return gains_nothing("sticking-in-compression", [*BODY, *RESTITUTION])


@claim(
    "part-sticking-in-restitution-energy",
    "part",
    "sticking in restitution",
    parameters=(),
    hints=products_hint(
        [
            (1, 1, PAST_COMPRESSION),
            (1, 1, C0 * STOPPING),
            (LOST, DETERMINANT, C0),
            (-C0 * PAST_COMPRESSION, (1 - e) * mu * B1 - e * BACK, 1),
            (1, 1, S0 * CLOSING + (1 + e) * B3 * C0),
            (LOST, B1 * B2, C0),
            ((1 + e) * mu * B1, sigma * B3, C0),
        ]
    ),
)  # the first line for sigma B3 <= 0
def sticking_in_restitution_gains_no_energy() -> Statement:
    """A corner that stops in restitution and sticks gains no energy."""
    return gains_nothing(
        "sticking-in-restitution",
        [*BODY, DIRECTION, NO_JAM, APPROACH, FRICTION, PAST_COMPRESSION >= 0, *RESTITUTION],
    )


@claim(
    "part-reversed-in-compression-energy",
    "part",
    "reversed in compression",
    parameters=(),
    hints=products_hint(
        [
            (mu, 2 * STOPPING + BACK, sigma * S0 * CLOSING_BACK),
            (mu, BACK, LEFT),
            (LOST, CLOSING_BACK, CLOSING_BACK * sigma * S0 - PAST_COMPRESSION),
        ]
    ),
)
def sliding_back_in_compression_gains_no_energy() -> Statement:
    """An impact by the law of sliding back in compression gains no energy where friction does not
    hold the corner.
    """
    return gains_nothing(
        "reversed-in-compression", [*BODY, DIRECTION, FRICTION, *REVERSES, *RESTITUTION]
    )


@claim(
    "part-reversed-in-restitution-energy",
    "part",
    "reversed in restitution",
    parameters=(),
    hints=products_hint(
        [
            (LOST, CLOSING, C0 * STOPPING),
            (mu, STOPPING + 2 * BACK, PAST_RESTITUTION),
            (mu, STOPPING, S0 * CLOSING),
        ]
    ),
)
def sliding_back_in_restitution_gains_no_energy() -> Statement:
    """An impact by the law of sliding back in restitution gains no energy where friction does not
    hold the corner.
    """
    return gains_nothing(
        "reversed-in-restitution", [DIRECTION, NO_JAM, FRICTION, *REVERSES, *RESTITUTION]
    )


# -------------------------------------------------------------------------------------------------
# The five modes cover every impact, agree where two of them meet, and say what happens to a corner
# that does not slide at first.

FRICTION_HOLDS = (B3 <= mu * B1) & (-B3 <= mu * B1)  # mu >= |B3|/B1


def modes_cover() -> Statement:
    """Every impact meets the conditions of one of the five modes."""
    return always(
        disjunction([conjunction(conditions_of(mode)) for mode in MODES]),
        given=[B1 > 0, FRICTION],
        label="cover",
        vocabulary=words(),
    )


@claim("part-modes-cover", "part", "the modes", parameters=())
def every_impact_is_of_one_of_the_modes() -> list[Statement]:
    """Every impact meets the conditions of one of the five modes, and a corner that stops sticks
    exactly where mu >= |B_3|/B_1.
    """
    return [
        modes_cover(),
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
    """A corner with S_0 = 0 sticks where mu >= |B_3|/B_1; else it slides at once, against the sign
    of B_3, and does not jam; either sigma gives this law.

    With sigma the sign of B_3 the law is that of sliding back in compression, with the other sign
    that of sliding.
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


def is_only(mode: str) -> Formula:
    """An impact of this mode and of no other."""
    others = [conjunction(conditions_of(one)) for one in MODES if one != mode]
    return conjunction([*conditions_of(mode), *(~other for other in others)])


# -------------------------------------------------------------------------------------------------
# One corner has impacts in all five modes; and Newton's restitution, C = -e C0 after an impact, can
# raise its energy, which is why restitution is Poisson's.

CORNER = {
    "x_c": Fraction(-2),
    "y_c": Fraction(-1),
    "J": Fraction(5, 3),
}  # half-sides 1 and 2; it lies on a longer side


def numbers_of_the_corner() -> dict[str, Term]:
    """B1, B2 and B3 of this corner."""
    return {name: term(value_of(value, CORNER)) for name, value in COEFFICIENTS.items()}


@claim(
    "s2.1-five-modes",
    "2.1",
    "line 81",
    parameters=(),
    remark=Remark(
        "That [32] has these five modes, by Coulomb's friction and Poisson's restitution, is taken"
        " over from there and not shown.",
    ),
)
def five_modes_that_differ_and_depend_on_the_motion() -> list[Statement]:
    """Every impact is of one of five modes, and each of them is that of some impact, at a corner of
    the 1 by 2 rectangle, that no other mode describes; with the same motion there are two, by e and
    mu alone, and with the same e and mu there are two, by the motion alone.
    """
    impact = [DIRECTION, SLIDES, NO_JAM, APPROACH, FRICTION, *RESTITUTION]
    names = ["sigma", "e", "mu", "S0", "C0"]
    words_here = words("", **numbers_of_the_corner())

    def two_modes(changed: dict[str, Number], label: str) -> Statement:
        """One impact slides all along; the other, with these values changed, sticks."""
        sticks = [*impact, is_only("sticking-in-compression")]
        return exists_some(
            [*names, *(str(value) for value in changed.values())],
            conjunction([is_only("sliding"), *(substitute(one, changed) for one in sticks)]),
            within=impact,
            label=label,
            vocabulary=words_here,
        )

    return [
        modes_cover(),
        *(
            exists_some(names, is_only(mode), within=impact, label=mode, vocabulary=words_here)
            for mode in MODES
        ),
        two_modes({"e": real("restitution_2"), "mu": real("friction_2")}, "by-the-parameters"),
        two_modes(
            {"sigma": real("direction_2"), "S0": real("S1"), "C0": real("C1")}, "by-the-motion"
        ),
    ]


@claim("part-newton", "part", "restitution", parameters=())
def newtons_restitution_can_raise_the_energy() -> Statement:
    """A corner of the 1 by 2 rectangle, at e <= 1, can stick in compression in such a way that it
    would gain energy by Newton's restitution.
    """

    def to_the_right(formula: Formula) -> Formula:
        there: Formula = substitute(formula, {"sigma": 1})
        return there

    sticks = [APPROACH, S0 >= 0, FRICTION, *RESTITUTION, NO_JAM, PAST_COMPRESSION <= 0, BACK <= 0]
    return exists_some(
        ["e", "mu", "S0", "C0"],
        to_the_right(work_of(of("newton_impulse")) > 0),
        within=[to_the_right(conjunction(sticks))],
        vocabulary=words("", **numbers_of_the_corner()),
    )
