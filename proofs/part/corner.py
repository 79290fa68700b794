"""What an impulse at a corner does, and which corners a rectangle has: the numbers B1, B2 and
B3.
"""

from __future__ import annotations

from fractions import Fraction

from certificates.statements import Statement
from certificates.terms import Term, conjunction, equal, iff, reals, substitute, term
from proofs.claims import claim
from proofs.forms import Vocabulary, always
from proofs.paper.vocabulary import derived
from proofs.part.setting import Impulse, velocity_after, work_of

x_c, y_c, J, h, k, mu = reals("x_c y_c J h k mu")
c_x, c_y, omega, P_x, P_y = reals("c_x c_y omega P_x P_y")
d_x, d_y, omega_after = reals("d_x d_y omega_after")  # the motion after the impulse
COEFFICIENTS: dict[str, Term] = {
    f"B{index}": term(derived("contact_coefficients").component(index)) for index in (1, 2, 3)
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
    """An impulse changes a corner's velocity by three numbers, with B1, B2 >= 1 and (B1 - 1)(B2 -
    1) = B3^2, and the kinetic energy by its work.

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


@claim("part-rectangle", "part", "a rectangle", parameters=())
def no_corner_of_a_rectangle_jams_below_four_thirds() -> list[Statement]:
    """No corner of a rectangle, however it is turned, jams where mu <= 4/3, and |B3| <= (3/4) B1
    for each; both numbers are sharp for sides 1 to 2.

    A corner jams where B2 - mu |B3| is negative: friction then turns it into the table.  The second
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
