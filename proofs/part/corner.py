"""The impact of a corner: names, hypotheses, the five modes and their conditions, and what an
impulse does.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import partial
from typing import NamedTuple

from juggleproof.judging import claims
from juggleproof.judging.claims import ClaimHints
from juggleproof.judging.forms import Vocabulary, always
from juggleproof.proofs.paper.names import derived, derived_vector
from juggleproof.search.closing import Hints
from juggleproof.statements.language import (
    Formula,
    Number,
    Statement,
    Term,
    conjunction,
    equal,
    iff,
    reals,
    substitute,
    term,
)

# -------------------------------------------------------------------------------------------------
# What the claims about a corner's impact have in common: names, hypotheses, the five modes and
# their conditions.
#
# A corner strikes the table with C0 < 0; sigma, 1 or -1, is the direction in which it slides, of
# either sign where it does not (S0 = 0). Of the body only B1, B2 and B3 matter; for every corner of
# every body B1 > 0 and B1 B2 > B3^2 (claim part-corner).

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
claim = partial(claims.claim, vocabulary=Vocabulary(scales=frozenset()))  # no unit is set to 1
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
    return _CONDITIONS[mode]


class Impulse(NamedTuple):
    """An impulse, or a velocity: along the table, and away from it."""

    along: Term
    away: Term


def of(name: str, *arguments: str) -> Impulse:
    """A derived impulse or velocity."""
    value = derived_vector(name, *arguments)
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


# -------------------------------------------------------------------------------------------------
# The one lemma of the claims about impacts: products of what is not negative, which the search is
# told of rather than left to find.

p, q, d = reals("p q d")
LEMMA = "part-products/main"


@claim("part-products", "part", "lemma", parameters=())
def a_product_of_two_numbers_and_a_square_is_not_negative() -> Statement:
    """A product of two numbers that are not negative and a square is not negative."""
    return always(p * q * d**2 >= 0, given=[p >= 0, q >= 0])


def products_hint(products: Sequence[tuple[Number, Number, Number]]) -> ClaimHints:
    """The hints of a claim: these products, each of two numbers that are not negative and what is
    squared.
    """
    uses = tuple(
        (LEMMA, {"p": str(term(one)), "q": str(term(other)), "d": str(term(squared))})
        for one, other, squared in products
    )
    return {"uses": (LEMMA,), "search": Hints(uses)}


# -------------------------------------------------------------------------------------------------
# What an impulse at a corner does, how much friction jams it, and which corners a rectangle has:
# the numbers B1, B2 and B3.

x_c, y_c, J, h, k, mu, t = reals("x_c y_c J h k mu t")
c_x, c_y, omega, P_x, P_y = reals("c_x c_y omega P_x P_y")
d_x, d_y, omega_after = reals("d_x d_y omega_after")  # the motion after the impulse
COEFFICIENTS: dict[str, Term] = {
    f"B{index}": term(derived_vector("contact_coefficients").component(index))
    for index in (1, 2, 3)
}
B1, B2, B3 = reals("B1 B2 B3")
NAMES = Vocabulary(abbreviations=COEFFICIENTS)
MOVED = [
    equal(d_x, c_x + P_x),
    equal(d_y, c_y + P_y),
    equal(J * omega_after, J * omega + x_c * P_y - y_c * P_x),
]
RECTANGLE = [
    h > 0,
    equal(3 * J, h**2 + k**2),
    equal(x_c**2 + y_c**2, h**2 + k**2),
]  # half-sides h and k, however it is turned
ON_CIRCLE = [J > 0, equal(3 * J, x_c**2 + y_c**2)]
FOUR_THIRDS, THREE_QUARTERS = Fraction(4, 3), Fraction(3, 4)


@claim("part-corner", "part", "a corner", parameters=())
def an_impulse_changes_the_velocity_of_a_corner_by_three_numbers() -> list[Statement]:
    """An impulse changes a corner's velocity by three numbers, with B_1 >= 1, B_2 >= 1 and
    (B_1 - 1)*(B_2 - 1) = B_3^2, and the kinetic energy by its work.

    The momentum changes by the impulse, the angular momentum about the centre of mass by its
    moment; all is per unit of mass.
    """
    before = {"S0": c_x - omega * y_c, "C0": c_y + omega * x_c}
    impulse = Impulse(P_x, P_y)
    after: Impulse = Impulse(*(substitute(speed, before) for speed in velocity_after(impulse)))
    energy_before, energy_after = (
        (c_x**2 + c_y**2 + J * omega**2) / 2,
        (d_x**2 + d_y**2 + J * omega_after**2) / 2,
    )
    work = substitute(work_of(impulse), before)
    velocity = equal(d_x - omega_after * y_c, after.along) & equal(
        d_y + omega_after * x_c, after.away
    )
    return [
        always(velocity, given=[J > 0, *MOVED], label="velocity", vocabulary=NAMES),
        always(
            equal(energy_after - energy_before, work),
            given=[J > 0, *MOVED],
            label="energy",
            vocabulary=NAMES,
        ),
        always(
            (B1 >= 1) & (B2 >= 1) & equal((B1 - 1) * (B2 - 1), B3**2),
            given=[J > 0],
            label="numbers",
            vocabulary=NAMES,
        ),
        always((B1 > 0) & (B1 * B2 - B3**2 > 0), given=[J > 0], label="definite", vocabulary=NAMES),
    ]


@claim("part-jamming", "part", "a corner", parameters=())
def a_corner_jams_from_this_friction_on() -> list[Statement]:
    """A corner at (x, -z) from the centre, x and z > 0, jams exactly where mu*x*z > J + x^2; with
    q = J/(x^2 + z^2) it does not where mu < 2*sqrt(q*(1 + q)), which is sharp, nor where mu*t <
    q + (1 + q)*t^2 and t lies between x/z and sqrt(q/(1 + q)).

    The last bound is sharp too, as x/z = t jams beyond it.  To the left of the centre all is the
    mirror image, and with B_3 = 0 no friction jams.
    """
    square = x_c**2 + y_c**2  # of the distance; the statements are multiplied by it or its square
    free = (B2 + mu * B3 > 0) & (B2 - mu * B3 > 0)
    at_the_end = [J > 0, y_c < 0, mu >= 0, mu * t * square < J + (J + square) * t**2]
    at_most = 4 * J * (J + square)
    statements = {
        "jams": (iff(B2 + mu * B3 < 0, -mu * x_c * y_c > J + x_c**2), [J > 0]),
        "free": (free, [J > 0, mu**2 * square**2 < at_most]),
        "sharp": (
            iff(B2 + mu * B3 < 0, mu**2 * square**2 > at_most),
            [J > 0, x_c > 0, y_c < 0, mu >= 0, equal((J + square) * x_c**2, J * y_c**2)],
        ),
        "beside": (free, [*at_the_end, t > 0, x_c >= -t * y_c, (J + square) * t**2 >= J]),
        "below": (free, [*at_the_end, x_c > 0, x_c <= -t * y_c, (J + square) * t**2 <= J]),
    }
    return [
        always(shown, given=given, label=label, vocabulary=NAMES)
        for label, (shown, given) in statements.items()
    ]


@claim("part-rectangle", "part", "a rectangle", parameters=())
def no_corner_of_a_rectangle_jams_below_four_thirds() -> list[Statement]:
    """No corner of a rectangle, however it is turned, jams where mu <= 4/3, and |B_3| <= 3/4 B_1
    for each; both numbers are sharp for sides 1 to 2.

    A corner jams where B_2 < mu |B_3|: friction then turns it into the table.  The second
    bound says that with mu >= 3/4 friction always holds a corner that has stopped.
    """
    upright, lying = (
        [h > 0, equal(3 * J, h**2 + (2 * h) ** 2), equal(x_c, x), equal(y_c, y)]
        for x, y in ((h, 2 * h), (2 * h, h))
    )
    return [
        always(conjunction(ON_CIRCLE), given=RECTANGLE, label="circle", vocabulary=NAMES),
        always(
            (B2 + mu * B3 > 0) & (B2 - mu * B3 > 0),
            given=[*ON_CIRCLE, mu >= 0, mu < FOUR_THIRDS],
            label="free",
            vocabulary=NAMES,
        ),
        always(
            (B2 + mu * B3 >= 0) & (B2 - mu * B3 >= 0),
            given=[*ON_CIRCLE, equal(mu, FOUR_THIRDS)],
            label="just-free",
            vocabulary=NAMES,
        ),
        always(
            iff(B2 - mu * B3 < 0, mu > FOUR_THIRDS), given=upright, label="jams", vocabulary=NAMES
        ),
        always(
            (B3 <= THREE_QUARTERS * B1) & (-B3 <= THREE_QUARTERS * B1),
            given=ON_CIRCLE,
            label="holds",
            vocabulary=NAMES,
        ),
        always(
            equal(B3, THREE_QUARTERS * B1), given=lying, label="holds-no-less", vocabulary=NAMES
        ),
    ]
