"""Appendix A.4: where the supremum lies, and how many impacts lead into the region R."""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import Formula, Term, conjunction, reals, term
from proofs.claims import Assertion, Readings, claim
from proofs.paper.outside import (
    B1_OUTSIDE,
    BEYOND_R,
    CLOSED_B1,
    CORNER,
    NAMED,
    ON_R,
    OUTSIDE,
    SUPREMAL,
    b_0,
    beta0,
    ceiling_of,
    change,
    dE_sup,
    floor_of,
    impacts_suffice,
    least,
    not_supremal,
    with_rounding,
)
from proofs.paper.vocabulary import (
    B1,
    PAPER,
    H,
    R,
    always,
    at,
    b,
    beta,
    derived,
    exists_some,
    g,
    impact_energy_change,
    r,
    v,
)
from proofs.reading.printed import Printed
from proofs.reading.values import Vector

edge, delta, k, p, q = reals("edge delta k p q")
LEFT = Vector((edge, v))  # a state beside b, at another height
# The states near b: the height moves by at most delta r^2 / g and the velocity by at most delta r;
# (k - 2) r bounds the velocity of b.
NEAR = b + Vector((p, q))
WITHIN_DELTA = [-(r**2) * delta <= g * p, g * p <= r**2 * delta, -r * delta <= q, q <= r * delta]
BOUNDED = [-(k - 2) * r <= v, v <= (k - 2) * r]


def room(*margins: Term) -> Formula:
    """Moving by delta changes none of these margins of energy so much that it vanishes."""
    return conjunction([k * r**2 * delta < margin for margin in margins])


@claim("sA.4-distinct", "A.4", "line 716")
def supremum_and_maximum_differ() -> Statement:
    """The least loss outside R and the greatest gain are different: one is negative and the other
    positive.
    """
    return always((dE_sup < 0) & (term(derived("delta_E_max")) > 0), given=SUPREMAL)


@claim("sA.4-leftmost", "A.4", "line 716", repeats="sA.3.2-leftmost")
def supremum_is_at_the_left() -> list[Statement]:
    """An impact outside R takes less from a lower state of the same velocity, still outside R, so
    that the supremum is at the left.
    """
    ground = Vector((0, v))
    return [
        always(
            B1_OUTSIDE(ground) & (term(impact_energy_change(ground)) > change),
            given=[B1_OUTSIDE(b), beta > 0, BEYOND_R(ground)],
            label="down-to-the-edge",
        ),
        exists_some(
            ["edge"],
            B1_OUTSIDE(LEFT) & (term(impact_energy_change(LEFT)) > change),
            within=[edge >= 0, edge < beta],
            given=[B1_OUTSIDE(b), ~BEYOND_R(ground)],
            label="towards-the-arc",
        ),
    ]


@claim("sA.4-open", "A.4", "line 716")
def impacts_outside_are_open() -> Readings:
    """The states outside R whose impact comes are an open set: of the plane, or of H only."""
    margins = {
        "collision": at(derived("collision_margin"), b),
        "energy": -term(at(derived("region_margin"), b)),
    }
    # What is room for a delta is room for every smaller one, so that one delta serves both margins.
    rooms = [
        exists_some(
            ["delta"],
            room(margin),
            within=[delta > 0],
            given=[B1_OUTSIDE(b), *BOUNDED],
            label=f"room-for-{name}",
        )
        for name, margin in margins.items()
    ]
    near = always(
        B1_OUTSIDE(NEAR),
        given=[B1_OUTSIDE(b), *BOUNDED, *WITHIN_DELTA, room(*margins.values()), H(NEAR)],
        label="all-near",
    )
    return Readings(
        {
            "of-the-plane": Assertion(
                (
                    exists_some(
                        ["edge"], B1_OUTSIDE(LEFT), within=[edge < beta], given=[B1_OUTSIDE(b)]
                    ),
                )
            ),
            "of-H": Assertion((*rooms, near)),
        }
    )


@claim("sA.4-boundary", "A.4", "line 716", printed=r"R(\overline{b}) = 0", as_it_stands=r"R(b) = 0")
def boundary_of_the_region(printed: Printed) -> Readings:
    """The boundary of R is where R(b) = 0: as a set of states of H, or as a set of the plane."""
    on_it, margin = printed.formula(PAPER), term(at(derived("region_margin"), b))
    both_sides = exists_some(
        ["edge"],
        OUTSIDE(LEFT),
        within=[edge > beta, edge < beta + delta],
        given=[H(b), on_it, delta > 0],
        label="both-sides",
    )
    return Readings(
        {
            "in-H": Assertion(
                (
                    always(R(b), given=[H(b), on_it], label="one-side"),
                    both_sides,
                    exists_some(
                        ["delta"],
                        room(margin),
                        within=[delta > 0],
                        given=[R(b), ~on_it, *BOUNDED],
                        label="room-inside",
                    ),
                    exists_some(
                        ["delta"],
                        room(-margin),
                        within=[delta > 0],
                        given=[OUTSIDE(b), *BOUNDED],
                        label="room-outside",
                    ),
                    always(
                        R(NEAR),
                        given=[R(b), *BOUNDED, *WITHIN_DELTA, delta < 1, room(margin), H(NEAR)],
                        label="inside",
                    ),
                    always(
                        ~R(NEAR),
                        given=[OUTSIDE(b), *BOUNDED, *WITHIN_DELTA, room(-margin)],
                        label="outside",
                    ),
                )
            ),
            "in-the-plane": Assertion(
                (
                    both_sides,
                    exists_some(
                        ["edge"],
                        R(LEFT),
                        within=[edge < beta],
                        given=[R(b), ~on_it],
                        label="inside",
                    ),
                )
            ),
        }
    )


@claim("sA.4-not-on-boundary", "A.4", "line 716", repeats="sA.3.1-not-on-R0")
def supremum_is_not_on_the_boundary_of_the_region() -> Readings:
    """The supremum does not belong to a state of the boundary R(b) = 0: to none at all, or to none
    above the ground.
    """
    return not_supremal(ON_R(b))


@claim(
    "sA.4-on-edge",
    "A.4",
    "line 716",
    printed=r"\overline{\beta} = 0",
    as_it_stands=r"\overline{b} = 0",
    repeats="sA.3.2-corner",
)
def supremum_is_on_the_edge_and_negative(printed: Printed) -> Statement:
    """The supremum belongs to a state on the edge of H, and is negative."""
    there = [CLOSED_B1(b_0), ON_R(b_0), printed.formula(PAPER.extended({r"\overline\beta": beta0}))]
    return always(conjunction([least < 0, change < least]), given=[*there, B1_OUTSIDE(b)])


@claim("sA.4-each-impact", "A.4", "line 718")
def each_impact_takes_the_least_loss() -> Readings:
    """Each impact changes the energy by Delta E_sup at most: those outside R, or all."""

    def reading(region: Formula) -> Assertion:
        return Assertion((always(change <= least, given=[CORNER(b_0), region]),))

    return Readings({"outside-R": reading(B1_OUTSIDE(b)), "every-impact": reading(B1(b))})


@claim(
    "sA.4-count",
    "A.4",
    "lines 718 to 722",
    repeats="s4.2-count",
    printed=r"[\frac{E(\overline{b}_0) - E_{max} - \Delta E_{max}}{-\Delta E_{sup}}]",
)
def impacts_to_enter_the_region(printed: Printed) -> Readings:
    """So many impacts lead from b_0 into R, the number rounded down or rounded up."""
    count = with_rounding(printed, NAMED)[1]
    return Readings(
        {"floor": impacts_suffice(floor_of(count)), "ceiling": impacts_suffice(ceiling_of(count))}
    )
