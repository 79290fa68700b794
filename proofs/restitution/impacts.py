"""From impact to impact: f^K where the ball flies K periods, each e_K with a box that it attracts,
and what happens where its range begins.

An impact is a state (x, w) with 0 <= x < w, in the normal form; T_K, derived, leads to the next one
K periods later.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from juggleproof.papers.derivations import tidied
from juggleproof.proofs.paper.names import alpha, at, claim, equals, w, x
from juggleproof.proofs.theorem.definition import (
    NORMAL,
    PIECES,
    SPACE,
    WHOLE,
    Contraction,
    contracts,
    the_map,
)
from juggleproof.proofs.theorem.orbits import (
    AFTER,
    E_K,
    HERE,
    IN_FLIGHT,
    K,
    after_impact,
    always,
    d,
    n,
    next_impact,
    strikes,
)
from juggleproof.reading.values import Vector
from juggleproof.statements.language import (
    AnyStatement,
    Formula,
    Statement,
    Term,
    conjunction,
    equal,
    iff,
    reals,
    term,
)

THERE: Vector = tidied("normal_impact_fixed_point")  # e_K at its impact
ABOVE = K - 1 < alpha * (K + 1)
EXISTS, BELOW = [alpha < 1, ABOVE], [alpha > 0, alpha * (K + 1) < K - 1]
BEGINS = [equal(alpha * (K + 1), K - 1), K >= 2]
TWICE = next_impact(K, AFTER)
OTHER_ONE = Vector(reals("y z"))
NEAR = term(Fraction(1, 4))
STRUCK, FLOWN = (Vector(tuple(map(term, image.entries))) for _, image in PIECES)


def is_impact(state: Vector) -> Formula:
    """The state is one of H in which the bodies meet within the period."""
    return (term(state.entries[0]) >= 0) & strikes(state)


def from_here(image: Vector, state: Vector) -> Vector:
    """The image, a vector of x and w, at this state."""
    found: Vector = at(image, {"x": term(state.entries[0]), "w": term(state.entries[1])})
    return found


def apart(one: Vector, other: Vector, most: Term) -> Formula:
    """The components of two states differ by no more than this."""
    return conjunction(
        [
            part
            for here, there in zip(map(term, one.entries), map(term, other.entries))
            for part in (here - there <= most, there - here <= most)
        ]
    )


def before(periods: Term) -> Vector:
    """The state this number of periods before the impact of e_K, where its range begins."""
    return Vector((periods * (K - periods), K + 1 - 2 * periods))


def around(point: Vector, distances: tuple[Term, ...]) -> Formula:
    """Each component of the state differs from that of the point by no more than its distance."""
    return conjunction(
        [
            part
            for name, entry, most in zip((x, w), map(term, point.entries), distances)
            for part in (name - entry <= most, entry - name <= most)
        ]
    )


# -------------------------------------------------------------------------------------------------
# e_K for every whole K >= 1: with its impact at the centre, the norm max(|p|/weight, |q|) falls by
# the factor (1 + alpha)/2 with every flight of K periods.

WEIGHTS = (2 * alpha * K / (1 - alpha), term(1))
RADIUS = (1 - alpha) * (alpha * (K + 1) - (K - 1)) / (4 * (1 + alpha) ** 2)
BOX = around(THERE, tuple(weight * RADIUS for weight in WEIGHTS))
FLIGHT_OF_K = replace(
    NORMAL,
    parameters=(alpha, K),
    integers=(K,),
    positive=(K >= 1,),
    space=BOX,
    pieces=((equal(term(0), 0), AFTER),),
    fixed=THERE,
)
IN_THE_BOX = Contraction(equal(term(0), 0), WEIGHTS, (1 + alpha) / 2, RADIUS, RADIUS)
DOMAIN = WHOLE & ABOVE


@claim("restitution-flights", "restitution", "from impact to impact", parameters=())
def an_impact_that_leads_to_an_impact_flies_between() -> list[Statement]:
    """Where T_K, an impact and then K periods of flight up to the next impact, leads from an impact
    to a state that is not below the table, the K - 1 periods between are flight: T_K is f^K there.

    After an impact and n periods of flight, states that were d apart are (n + 2) alpha d apart at
    most, in x as in w.
    """
    return [
        always(
            ~strikes(after_impact(n, HERE)),
            given=[strikes(HERE), IN_FLIGHT[1], n >= 0, n <= K - 2],
            label="in-flight-between",
        ),
        always(
            apart(after_impact(n, HERE), after_impact(n, OTHER_ONE), (n + 2) * alpha * d),
            given=[apart(HERE, OTHER_ONE, d), n >= 0],
            label="near-between",
        ),
    ]


@claim("restitution-e-K", "restitution", "each e_K", parameters=())
def each_fixed_point_attracts_a_box() -> list[AnyStatement]:
    """For every whole K >= 1 and (K - 1)/(K + 1) < alpha < 1, T_K, which is f^K there, takes a box
    round the impact of e_K into itself and brings it closer; e_K is stable, and attracts the box.

    The box holds impacts only, from which T_K leads to impacts.
    """
    return [
        the_map("map", FLIGHT_OF_K, DOMAIN),
        contracts("contracts", "restitution-e-K/map", FLIGHT_OF_K, DOMAIN, IN_THE_BOX),
        always(is_impact(HERE), given=[BOX], in_range=EXISTS, label="impacts"),
        always(is_impact(AFTER), given=[BOX], in_range=EXISTS, label="lead-to-impacts"),
    ]


@claim("restitution-e-K-none", "restitution", "where e_K exists", parameters=())
def fixed_points_exist_just_on_their_range() -> list[Statement]:
    """For alpha < (K - 1)/(K + 1) no two flights of K periods follow one another. T_K has one fixed
    point, and that is an impact of H if and only if K <= (1 + alpha)/(1 - alpha).
    """
    return [
        always(
            term(TWICE.entries[0]) < 0,
            given=IN_FLIGHT,
            in_range=BELOW,
            label="no-two-flights",
        ),
        always(iff(equals(AFTER, HERE), equals(HERE, THERE)), label="one-comes-back"),
        always(iff(is_impact(THERE), K <= (1 + alpha) / (1 - alpha)), label="is-an-impact"),
    ]


@claim("restitution-e-K-begins", "restitution", "alpha = (K - 1)/(K + 1)", parameters=())
def fixed_points_attract_nothing_where_they_begin() -> list[Statement]:
    """At alpha = (K - 1)/(K + 1), K >= 2, flights of K periods follow one another only from e_K
    itself. Its orbit is that of the state K periods of flight before it, and no states lead to it
    but those 0, .., K periods of flight before it.

    A state within 1/4 of one of the orbit's, and led by f to within 1/4 of the next, is an impact
    just where that one is.
    """
    return [
        always(
            equals(HERE, E_K),
            given=[*IN_FLIGHT, term(TWICE.entries[0]) >= 0],
            in_range=BEGINS,
            label="only-e-K",
        ),
        always(equals(from_here(STRUCK, E_K), before(K - 1)), in_range=BEGINS, label="its-impact"),
        always(
            ~strikes(before(n)) & equals(from_here(FLOWN, before(n)), before(n - 1)),
            given=[n >= 1, n <= K],
            in_range=BEGINS,
            label="its-flight",
        ),
        always(
            equals(HERE, E_K),
            given=[SPACE, strikes(HERE), equals(STRUCK, before(n))],
            in_range=BEGINS,
            label="impacts-that-lead-to-it",
        ),
        always(
            equals(HERE, before(n + 1)) & (n >= 0) & (n + 1 <= K),
            given=[SPACE, ~strikes(HERE), equals(FLOWN, before(n))],
            in_range=BEGINS,
            label="flights-that-lead-to-it",
        ),
        always(
            strikes(HERE), given=[apart(HERE, E_K, NEAR)], in_range=BEGINS, label="near-it-strikes"
        ),
        always(
            ~strikes(HERE),
            given=[apart(HERE, before(n), NEAR), n >= 2, n <= K - 1],
            in_range=BEGINS,
            label="near-its-flight-flies",
        ),
        always(
            term(STRUCK.entries[1]) < K + 1 - NEAR,
            given=[apart(HERE, before(term(1)), NEAR)],
            in_range=BEGINS,
            label="near-its-end-flies",
        ),
    ]
