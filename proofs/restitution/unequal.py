"""An orbit of 12 unequal flights, 26 periods: the restitutions for which it exists, and a box that
it attracts.

Where it exists, not every orbit tends to some e_K: an e_K has flights of one length. The linear
part of 12 flights is alpha^12 times a shear, so that the orbit attracts wherever its impacts have
room to spare; at either end of its range one impact has none.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from juggleproof.papers.derivations import Origin, made_by
from juggleproof.papers.derived import derived_by
from juggleproof.proofs.paper.names import alpha, always, claim, equals, w, x
from juggleproof.proofs.restitution.impacts import is_impact
from juggleproof.proofs.theorem.definition import (
    NORMAL,
    WHOLE,
    Contraction,
    TheoremSetting,
    contracts,
    escapes,
    opposite,
    the_map,
)
from juggleproof.proofs.theorem.orbits import strikes
from juggleproof.reading.values import Vector
from juggleproof.statements.language import (
    AnyStatement,
    Formula,
    Statement,
    Term,
    conjunction,
    equal,
    reals,
    term,
)

ALONG = "juggleproof.proofs.restitution.along_flights"  # the module that loads SymPy
FLIGHTS = (1, 1, 2, 3, 3, 2, 2, 3, 3, 2, 2, 2)  # their periods
PERIODS, COUNT = sum(FLIGHTS), len(FLIGHTS)
BORN, DIES = 8, 9  # the numbers of flights after which the impacts come that end its range
z1, z2, rho = reals("z1 z2 rho")
SPACED = [alpha > Fraction(73, 100), alpha < Fraction(31, 40)]
WIDER = [alpha > Fraction(7286, 10000), alpha < Fraction(7765, 10000)]  # both ends lie here
NOT_LARGE = rho <= Fraction(1, 2000)
WEIGHTS = (term(PERIODS), term(1))
SMALL = conjunction(
    [
        part
        for name, weight in zip((z1, z2), WEIGHTS)
        for part in (name <= weight * rho, -weight * rho <= name)
    ]
)


RANGE = conjunction(WIDER) & WHOLE


def derived_along(name: str, flights: tuple[int, ...], *arguments: int) -> Vector:
    """A derived state along the flights: in lowest terms, and what z1 and z2 add to it."""
    value = derived_by(Vector, f"{ALONG}.in_lowest_terms", name, flights, *arguments)
    found: Vector = made_by(Origin(name, (flights, *arguments)), value)
    return found


def turned(count: int) -> tuple[int, ...]:
    """The flights in turn, from the flight of this index on."""
    return FLIGHTS[count:] + FLIGHTS[:count]


def on_the_orbit(count: int) -> Vector:
    """The impact after this number of flights from the start, before those that then follow."""
    return derived_along("normal_periodic_impact", turned(count))


def beside(count: int) -> Vector:
    """The impact after this number of flights, from (z1, z2) beside the start."""
    return derived_along("normal_impact_beside", FLIGHTS, count)


def above(state: Vector) -> Formula:
    """The state is one of H."""
    return term(state.entries[0]) >= 0


def divides() -> Formula:
    """The denominators of the start are not 0: each of their factors has a sign."""
    signs = derived_by(tuple, f"{ALONG}.denominators", FLIGHTS)
    return conjunction([RANGE, *(one for one in signs if isinstance(one, Formula))])


def is_below_the_table(flights: tuple[int, ...]) -> Formula:
    """The point that the flights bring back is below the table."""
    return _of_the_impact("is_below_the_table", flights)


def is_a_collision(flights: tuple[int, ...]) -> Formula:
    """The impact that the flights bring back is a collision within the period."""
    return _of_the_impact("is_a_collision", flights)


def _of_the_impact(name: str, flights: tuple[int, ...]) -> Formula:
    value = derived_by(Formula, f"{ALONG}.{name}", flights)
    found: Formula = made_by(Origin("normal_periodic_impact", (flights,)), value)
    return found


def change(count: int) -> Vector:
    """The change by (z1, z2) beside the start of the impact after this number of flights."""
    return derived_along("normal_change_beside", FLIGHTS[:count])


def changed(count: int) -> Vector:
    """The impact after this number of flights from beside the start; on the orbit it is (x, w)."""
    return Vector(tuple(here + term(more) for here, more in zip((x, w), change(count).entries)))


def moved(count: int, times: int = 0) -> Term:
    """The greatest change beside the start of x plus `times` times w, after `count` flights."""
    return (PERIODS + sum(FLIGHTS[:count]) + times) * alpha**count * rho


def exists() -> Formula:
    """The orbit is one: the impact after BORN flights is above the table, and that after DIES
    flights a collision.
    """
    return opposite(is_below_the_table(turned(BORN))) & is_a_collision(turned(DIES))


def map_beside() -> TheoremSetting:
    """What is left of (z1, z2) beside the start after all flights, as a map."""
    return replace(
        NORMAL,
        parameters=(alpha, rho),
        positive=(rho > 0,),
        state=(z1, z2),
        space=SMALL,
        pieces=((equal(term(0), 0), change(COUNT)),),
        fixed=Vector((0, 0)),
        place=Vector((z1, z2)),
    )


CLOSER = Contraction(equal(term(0), 0), WEIGHTS, 2 * alpha**COUNT, rho, rho)
WORD = " ".join("1" + " 2" * (periods - 1) for periods in FLIGHTS)


@claim("restitution-unequal", "restitution", "12 unequal flights")
def an_orbit_of_unequal_flights_attracts_a_box() -> list[AnyStatement]:
    """Where it exists, an orbit of f has flights of 1 1 2 3 3 2 2 3 3 2 2 2 periods and repeats
    itself, and is not that of an e_K.

    Every impact within 26 rho in x and rho in w of its first has these flights too, and with every
    12 of them its weighted distance from the first falls to 2 alpha^12 of what it was or less, for
    each rho from 0 to 1/2000 that the impacts after 8 and after 9 flights have room for: (x, w) of
    the one has 43 alpha^8 rho <= x, of the other 47 alpha^9 rho < w - x.
    """
    start, domain, around = on_the_orbit(0), divides(), map_beside()
    return [
        the_map("f", NORMAL, domain),
        always(
            equals(
                start, Vector((Fraction(7537860971672, 4060387774625), Fraction(6400424, 3249155)))
            ),
            in_range=[equal(alpha, Fraction(3, 4))],
            label="at-three-quarters",
        ),
        always(term(start.entries[1]) < term(on_the_orbit(4).entries[1]), label="is-no-e-K"),
        *(
            always(
                is_impact(beside(count)),
                given=[NOT_LARGE, SMALL],
                in_range=WIDER,
                label=f"impact-{count}",
            )
            for count in range(COUNT)
            if count not in (BORN, DIES)
        ),
        always(
            strikes(beside(BORN)) & above(beside(DIES)),
            given=[NOT_LARGE, SMALL],
            in_range=WIDER,
            label="half-of-two",
        ),
        always(above(changed(BORN)), given=[moved(BORN) <= x, SMALL], label="stays-above"),
        always(
            strikes(changed(DIES)),
            given=[moved(DIES, times=1) < w - x, SMALL],
            label="still-strikes",
        ),
        the_map("map", around, (alpha > 0) & WIDER[1]),
        contracts("contracts", "restitution-unequal/map", around, RANGE, CLOSER),
        # last, as the range that is told is that of the last map rule
        escapes(
            "comes-back",
            "restitution-unequal/f",
            replace(NORMAL, other=start),
            domain & exists(),
            WORD,
        ),
    ]


@claim("restitution-unequal-ends", "restitution", "where that orbit exists", parameters=("alpha",))
def two_of_its_impacts_end_the_range_of_the_orbit() -> list[Statement]:
    """The impact after 8 of the flights is not below the table, and that after 9 a collision, for
    73/100 < alpha < 31/40; the ends of the sharp range are algebraic numbers, 0.7286.. and 0.7764..

    Between 0.7286 and 0.7765 the orbit's other conditions hold, by restitution-unequal: it exists
    just on that range.
    """
    return [
        always(
            above(on_the_orbit(BORN)) & strikes(on_the_orbit(DIES)), in_range=SPACED, label="both"
        )
    ]


@claim("restitution-unequal-room", "restitution", "where it attracts", parameters=("alpha",))
def two_of_its_impacts_have_room_between_the_ends() -> list[Statement]:
    """The impact after 8 of the flights is higher than the table, and that after 9 a collision, for
    73/100 < alpha < 31/40; the sharp range is that of restitution-unequal-ends without its ends.

    So there is a rho as in restitution-unequal for every alpha between the ends.
    """
    return [
        always(
            (term(on_the_orbit(BORN).entries[0]) > 0) & strikes(on_the_orbit(DIES)),
            in_range=SPACED,
            label="both",
        )
    ]
