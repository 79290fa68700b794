"""Claims of the theorem: the rules, the steps of its written proof, alpha = 1/3, and
Proposition 1.
"""

from __future__ import annotations

from dataclasses import replace

from juggleproof.proofs.paper.names import (
    Placed,
    R,
    alpha,
    always,
    at,
    b,
    claim,
    derived,
    equals,
    s,
    w,
    x,
)
from juggleproof.proofs.theorem.definition import (
    AT_IMPACTS,
    BELOW_A_THIRD,
    FIXED,
    FROM_A_THIRD,
    IMPACT,
    IN_THE_TRAP,
    NEARBY,
    NORMAL,
    OTHER,
    PHYSICAL,
    PIECES,
    SPACE,
    SPEED,
    TO_THE_POINT,
    TRAP,
    WHOLE,
    Descent,
    TheoremSetting,
    attracts,
    contracts,
    descends,
    escapes,
    exactly,
    opposite,
    the_map,
    u,
)
from juggleproof.proofs.theorem.definition import BELOW_A_THIRD as BELOW
from juggleproof.proofs.theorem.definition import FROM_A_THIRD as FROM
from juggleproof.reading.values import Vector
from juggleproof.statements.language import (
    AnyStatement,
    Formula,
    Statement,
    conjunction,
    different,
    equal,
    reals,
    substitute,
    term,
)

# -------------------------------------------------------------------------------------------------
# The theorem in normal form and in the paper's units: e_1 is globally asymptotically stable exactly
# for alpha < 1/3.
#
# A. Outside of its stages the rank 2 u + (1 - w)/2 falls by 1 at least every period, u^2 being
# twice the energy; the stages lead into the trap, where every period has an impact and brings the
# state closer to e_1. Hence for every integer N >= rank + 3 the state after N + k periods is within
# (2 alpha)^k of e_1, in units of r T and r. From alpha = 1/3 on the orbit of e_2, an impact and a
# flight by turns, never comes near e_1.


def stable_exactly_below_a_third(claim_id: str, setting: TheoremSetting) -> list[AnyStatement]:
    """The statements of the theorem, each resting on those before it."""

    def name(part: str) -> str:
        return f"{claim_id}/{part}"

    return [
        the_map("map", setting),
        descends("descends", name("map"), setting, BELOW_A_THIRD, TO_THE_POINT, AT_IMPACTS),
        contracts("contracts", name("map"), setting, BELOW_A_THIRD, IN_THE_TRAP),
        attracts("attracts", name("descends"), name("contracts")),
        escapes("escapes", name("map"), setting, FROM_A_THIRD),
        exactly("exactly", name("attracts"), name("escapes")),
    ]


@claim(
    "theorem",
    "theorem",
    "normal form",
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


# -------------------------------------------------------------------------------------------------
# The steps of argument A as a mathematician writes them, each a statement of its own: the written
# proof of a report prints these and no others.
#
# The rules of `theorem` need less, since the checker writes their premises; these are the lines in
# between.

u_next, p, q, c = reals("u_next p q c")
AFTER_IMPACT, AFTER_FLIGHT = (Vector(tuple(map(term, images.entries))) for _, images in PIECES)
FLIGHT = opposite(IMPACT)
RANK = TO_THE_POINT.rank
HEIGHT, CLOSING = term(FIXED.entries[0]), term(FIXED.entries[1])
STAGE_1, STAGE_2 = TO_THE_POINT.stages[:2]


def state_after(image: Vector, thing: Placed) -> Placed:
    """A term or formula of the state, at the image of the state."""
    return at(thing, dict(zip(("x", "w"), map(term, image.entries))))


def line(
    label: str, show: Formula, *given: Formula, names: str = "alpha x w", below: Formula = BELOW
) -> Statement:
    """One step: for all of the names, below 1/3 unless told otherwise, what is given implies what
    is shown.
    """
    return Statement(
        label, tuple(names.split()), tuple(("given", one) for one in (below, *given)), show
    )


@claim("theorem-by-hand", "theorem", "argument A, written out")
def argument_a_line_by_line() -> list[Statement]:
    """The lines of argument A: energy, rank, stages, trap and contraction, each of them an
    inequality or an identity.
    """
    squared, is_speed = SPEED[1], (u >= 0, equal(u**2, SPEED[1]))
    speed = "alpha x w u"
    bound_before, bound_after = 3 * (w - 1) / 2, term(3) / 2 + 5 * w / 6
    rank_after = state_after(AFTER_IMPACT, RANK)
    x_next, w_next = map(term, AFTER_IMPACT.entries)
    distance = conjunction([part for one in (p, q) for part in (-c <= one, one <= c)])
    offset = Vector((HEIGHT + p, CLOSING + q))
    image = at(AFTER_IMPACT, {"x": offset.entries[0], "w": offset.entries[1]})
    start = dict(zip(("x", "w"), map(term, OTHER.entries)))
    between = at(AFTER_IMPACT, start)
    return [
        line("units", equal(squared, 2 * term(derived("normal_energy")))),
        line("closing-speed", (1 - u <= w) & (w <= 1 + u), SPACE, *is_speed, names=speed),
        line("rank-is-not-negative", term(0) <= RANK, SPACE, *is_speed, names=speed),
        line("flight-keeps-the-speed", equal(state_after(AFTER_FLIGHT, squared), squared)),
        line(
            "flight-lowers-the-rank", equal(state_after(AFTER_FLIGHT, RANK), RANK - 1), names=speed
        ),
        line("flight-stays", term(AFTER_FLIGHT.entries[0]) >= 0, FLIGHT),
        line(
            "impact-speed",
            equal(state_after(AFTER_IMPACT, squared), (1 + alpha * w) ** 2 - 4 * alpha * x),
        ),
        line(
            "impact-speed-is-bounded",
            u_next <= 1 + alpha * w,
            SPACE,
            IMPACT,
            equal(u_next**2, state_after(AFTER_IMPACT, squared)),
            names="alpha x w u_next",
        ),
        line("rank-before", bound_before <= RANK, SPACE, *is_speed, names=speed),
        line(
            "rank-after",
            substitute(rank_after, {"u": 1 + alpha * w}) <= bound_after,
            w > 0,
            names="alpha w",
        ),
        line("rank-falls", bound_after <= bound_before - 1, w >= 6, names="alpha w"),
        line("impact-stays", x_next >= 0, IMPACT),
        line("stage-1", (term(0) < w_next) & equal(x_next + w_next, 2 - alpha * x), SPACE, STAGE_1),
        line(
            "stage-2-impact",
            (x_next < w_next) & (alpha * w_next < 2 * alpha),
            SPACE,
            IMPACT,
            STAGE_2,
        ),
        line(
            "stage-2-flight",
            (state_after(AFTER_FLIGHT, x) < state_after(AFTER_FLIGHT, w))
            & (alpha * (w + 2) <= 3 * alpha),
            SPACE,
            FLIGHT,
            STAGE_2,
        ),
        line("trap-image", (x_next < 1) & (term(1) < w_next) & (w_next <= 2), TRAP),
        line(
            "trap-fixed-point",
            (term(0) < HEIGHT) & (HEIGHT < 1) & (term(1) < CLOSING) & (CLOSING < 2),
            names="alpha",
        ),
        line(
            "core-holds-a-ball",
            TRAP,
            x - HEIGHT <= IN_THE_TRAP.radius,
            -IN_THE_TRAP.radius <= w - CLOSING,
            w - CLOSING <= IN_THE_TRAP.radius,
            SPACE,
        ),
        line(
            "fixed",
            equal(substitute(x_next, {"x": HEIGHT, "w": CLOSING}), HEIGHT)
            & equal(substitute(w_next, {"x": HEIGHT, "w": CLOSING}), CLOSING),
            names="alpha",
            below=(alpha > 0) & (alpha < 1) & (1 + alpha > 0),
        ),
        line(
            "difference",
            equal(image.entries[0], HEIGHT + alpha * (q - p))
            & equal(image.entries[1], CLOSING - alpha * q),
            names="alpha p q",
        ),
        line(
            "closer",
            conjunction(
                [
                    part
                    for one in (alpha * (q - p), -alpha * q)
                    for part in (-2 * alpha * c <= one, one <= 2 * alpha * c)
                ]
            ),
            distance,
            names="alpha p q c",
        ),
        line(
            "other-orbit-strikes",
            (term(0) <= start["x"]) & (start["x"] < start["w"]),
            names="alpha",
            below=FROM,
        ),
        line(
            "other-orbit-flies",
            (term(between.entries[1]) <= between.entries[0]),
            names="alpha",
            below=FROM,
        ),
        line(
            "other-orbit-returns",
            conjunction(
                [
                    equal(entry, back)
                    for entry, back in zip(
                        at(
                            AFTER_FLIGHT, {"x": between.entries[0], "w": between.entries[1]}
                        ).entries,
                        OTHER.entries,
                    )
                ]
            ),
            names="alpha",
            below=FROM,
        ),
        line("other-orbit-differs", different(start["w"], CLOSING), names="alpha", below=FROM),
    ]


# -------------------------------------------------------------------------------------------------
# At alpha = 1/3 the orbits that do not tend to e_1: three states and no others.
#
# (0, 3) and (1, 1) are the orbit of e_2, an impact and a flight by turns, and (0, -1) flies to it,
# in units of r T and r. No other state leads to them, and from every other state the proof for
# alpha < 1/3 goes through: the stage after an impact holds (1, 1) on its border only.

THIRD = equal(3 * alpha, 1) & (1 + alpha > 0)
EXCEPTIONS = (Vector((0, 3)), Vector((1, 1)), Vector((0, -1)))


def is_none_of(*states: Vector) -> Formula:
    """The state (x, w) is none of these: its distance to each is positive."""
    return conjunction(
        [
            (x - term(state.entries[0])) ** 2 + (w - term(state.entries[1])) ** 2 > 0
            for state in states
        ]
    )


def goes_to(start: Vector, end: Vector, label: str) -> Statement:
    """One period leads from the one state to the other."""
    there = {"x": start.entries[0], "w": start.entries[1]}
    steps = [(at(guard, there), equals(at(image, there), end)) for guard, image in NORMAL.pieces]
    return always(
        conjunction([~guard | arrives for guard, arrives in steps]), in_range=[THIRD], label=label
    )


OTHERS = replace(NORMAL, space=NORMAL.space & is_none_of(*EXCEPTIONS))


@claim(
    "theorem-one-third",
    "theorem",
    "alpha = 1/3",
)
def three_states_do_not_tend_to_the_fixed_point() -> list[AnyStatement]:
    """At alpha = 1/3 every orbit tends to e_1 but those of (0, 3), (1, 1) and (0, -1), and e_1 is
    stable.
    """
    falling, period_two, rising = EXCEPTIONS
    return [
        the_map("map", NORMAL, THIRD),
        escapes("escapes", "theorem-one-third/map", NORMAL, THIRD),
        always(equals(OTHER, falling), in_range=[THIRD], label="e_2"),
        goes_to(falling, period_two, "impact"),
        goes_to(period_two, falling, "flight"),
        goes_to(rising, period_two, "flies-to-it"),
        the_map("map-of-others", OTHERS, THIRD),
        descends(
            "descends", "theorem-one-third/map-of-others", OTHERS, THIRD, TO_THE_POINT, AT_IMPACTS
        ),
        contracts("contracts", "theorem-one-third/map-of-others", OTHERS, THIRD, IN_THE_TRAP),
        attracts("attracts", "theorem-one-third/descends", "theorem-one-third/contracts"),
    ]


# -------------------------------------------------------------------------------------------------
# Proposition 1 for every 0 < alpha < 1: each orbit enters the region R within a number of periods
# that its energy tells, and stays there.
#
# Outside of R a rank falls by 1 at least every period. It is (1 - w)/2, which a flight lowers by 1,
# and a multiple of the root u of the energy, which a flight keeps: what an impact takes from u
# outweighs the rise of (1 - w)/2, as the factor is chosen, at the worst where the ball is on the
# ground and w = 1 + s/(1 - alpha), s^2 = 2 (1 + alpha).

FACTOR = (s + 1 - alpha) * (s + 1 + alpha) / (2 * (1 - alpha) ** 2)
TO_THE_REGION = Descent(FACTOR * u + (1 - w) / 2, (R(b),), (("s", 2 * (1 + alpha)), SPEED))
OUTSIDE = s <= (1 - alpha) * u  # outside of R, u is at least s/(1 - alpha)


@claim(
    "theorem-region",
    "theorem",
    "Proposition 1",
)
def every_orbit_enters_the_region() -> list[AnyStatement]:
    """For every 0 < alpha < 1 each orbit is in R from some period on, no later than its rank
    tells.
    """
    return [
        the_map("map", PHYSICAL),
        descends(
            "enters", "theorem-region/map", PHYSICAL, WHOLE, TO_THE_REGION, (*AT_IMPACTS, OUTSIDE)
        ),
    ]
