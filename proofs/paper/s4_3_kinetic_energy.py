"""Sections 4.3 and 4.3.1: coordinates around e_1, the kinetic energy in them, and whether it
decreases in R.
"""

from __future__ import annotations

from juggleproof.judging.claims import Argument, Assertion, Following, Reading, Readings, Remark
from juggleproof.proofs.paper.names import (
    B1,
    B2,
    R,
    alpha,
    always,
    at,
    b,
    claim,
    derived_matrix,
    derived_vector,
    e_1,
    eps,
    equals,
    f1,
    f2,
    from_e_1,
    kinetic_energy,
    next_states,
    only_at,
    r,
    vector,
)
from juggleproof.proofs.paper.regions import pieces
from juggleproof.proofs.paper.states import (
    AT_Z,
    FALLS_FROM_IMPACT_TO_IMPACT,
    RANGE_21,
    STABILITY,
    STEP,
    change,
    kinetic_energy_change,
    lies_around_e_1,
    narrow_band_stays,
    next_image,
    relative_step,
    z,
)
from juggleproof.reading.evaluation import relate
from juggleproof.reading.meaning import Printed
from juggleproof.reading.values import LimitValue, Matrix, Vector, scalar
from juggleproof.statements.language import (
    ClaimError,
    Statement,
    Term,
    conjunction,
    equal,
    iff,
    real,
    term,
)

d = real("d")
ORIGIN = Vector((0, 0))


@claim("s4.3-decay-to-K", "4.3", "line 498")
def orbits_decay_to_the_band() -> Following:
    """Every orbit that has entered R comes into the invariant band of states whose kinetic energy
    is close to that of e_1.

    It tends to e_1, and the band holds all states of H near e_1; a narrow band is mapped into
    itself.
    """
    return Following(STABILITY, Assertion((lies_around_e_1(eps), *narrow_band_stays(eps))))


def impact_shrinks() -> Statement:
    """An impact multiplies the kinetic energy relative to e_1 by alpha squared."""
    return always(
        equal(from_e_1(next_image), alpha**2 * from_e_1(b)),
        given=[B1(b), next_states(b, next_image)],
        label="impact-shrinks",
    )


@claim("s4.3.1-approach-constant", "4.3.1", "line 500")
def velocity_at_impacts_settles() -> Following:
    """From every state of H the kinetic energy at the impacts tends to a constant: the orbit tends
    to e_1, and each impact multiplies K, the kinetic energy of the motion relative to e_1, by alpha
    squared.
    """
    return Following(STABILITY, Assertion((impact_shrinks(),)))


@claim("eq-27", "4.3.1", "(27)", printed="z = b - e_1")
def coordinates_around_the_fixed_point(printed: Printed) -> Statement:
    """In the coordinates z, the one state that f maps to itself is the origin."""
    return always(iff(next_states(b, b), equals(z, ORIGIN)), given=[printed.formula(AT_Z)])


@claim("s4.3.1-same-linear", "4.3.1", "line 504")
def relative_motion_is_linear() -> Statement:
    """On all of B1 the difference to e_1 is mapped by the linear part of the map f1 of the
    states.
    """
    linear = Matrix(
        tuple(
            tuple(at(term(entry), {"K": 1}) for entry in row)
            for row in derived_matrix("return_jacobian").rows
        )
    )
    return always(
        equals(next_image - e_1, vector(linear * (b - e_1))),
        given=[B1(b), next_states(b, next_image)],
    )


def follows(printed: Printed) -> Statement:
    """The printed value is where the difference to e_1 is mapped."""
    return always(printed.formula(STEP))


def is_change(printed: Printed, derived_change: Term) -> Statement:
    """A number is what an impact changes K by exactly if it is the printed value."""
    return always(
        iff(
            equal(change, derived_change),
            printed.formula(STEP.extended({r"\Delta K": only_at(z, change)})),
        )
    )


@claim("s4.3.1-z1", "4.3.1", "line 506", printed="z_{k+1} = b_{k+1} - e_1")
def next_difference(printed: Printed) -> Statement:
    """The difference to e_1 after an impact is the next state less e_1."""
    return follows(printed)


@claim(
    "s4.3.1-z2",
    "4.3.1",
    "line 508",
    printed=r"z_{k+1} = -\alpha A_T b_k + (\alpha - 1) A_{-\xi} r_0 - e_1",
)
def next_difference_by_the_map(printed: Printed) -> Statement:
    """The difference after an impact, with the map (10) put in; xi without its index is xi_1."""
    return follows(printed)


@claim("s4.3.1-z3", "4.3.1", "line 510", printed=r"z_{k+1} = -\alpha A_T b_k + \alpha A_T e_1")
def next_difference_without_offset(printed: Printed) -> Statement:
    """Since e_1 is fixed, the offset of the map drops out of the difference."""
    return follows(printed)


@claim("s4.3.1-z4", "4.3.1", "line 512", printed=r"z_{k+1} = -\alpha A_T z_k")
def next_difference_is_linear(printed: Printed) -> Statement:
    """An impact maps the difference to e_1 by the matrix -alpha A_T."""
    return follows(printed)


@claim("eq-28", "4.3.1", "(28)", printed=r"K(z) = \frac{1}{2} (u_2' z)^2")
def kinetic_energy_of_the_difference(printed: Printed) -> Statement:
    """K is half the square of the velocity component, u_2' being the row that takes it out."""
    return always(
        iff(
            equal(change, kinetic_energy(z)),
            printed.formula(AT_Z.extended({r"K": only_at(z, change)})),
        )
    )


@claim("s4.3.1-DK-def", "4.3.1", "line 523", printed=r"\Delta K = K \circ f - K")
def change_of_kinetic_energy(printed: Printed) -> Statement:
    """What an impact changes K by is, in the coordinates around e_1, K after it less K before
    it.
    """
    before = z + e_1
    return is_change(printed, from_e_1(f1(before)) - from_e_1(before))


@claim(
    "s4.3.1-DK1",
    "4.3.1",
    "line 527",
    printed=r"\Delta K(z_k) = K \circ f(z_k) - K(z_k)",
    as_it_stands=r"\Delta K &(z_z) = K \circ f(z_k - K(z_k))",
)
def change_as_a_difference(printed: Printed) -> Statement:
    """The change of K at z_k is K of its image less K of itself."""
    return is_change(printed, term(kinetic_energy_change(z)))


@claim("s4.3.1-DK2", "4.3.1", "line 527", printed=r"\Delta K(z_k) = K(-\alpha A_T z_k) - K(z_k)")
def change_with_the_linear_map(printed: Printed) -> Statement:
    """The change of K, with the linear map of the differences put in."""
    return is_change(printed, term(kinetic_energy_change(z)))


@claim(
    "s4.3.1-DK3",
    "4.3.1",
    "line 527",
    printed=(
        r"\Delta K(z_k) = \frac{1}{2} \left(-\alpha u_2' A_T z_k \right)^2 - \frac{1}{2} \left(u_2'"
        r" z_k \right)^2"
    ),
)
def change_with_the_quadratic_form(printed: Printed) -> Statement:
    """The change of K, with the formula for K put in."""
    return is_change(printed, term(kinetic_energy_change(z)))


@claim(
    "s4.3.1-DK4",
    "4.3.1",
    "line 527",
    printed=r"\Delta K(z_k) = \frac{1}{2} \left((-\alpha u_2' z_k)^2 - (u_2' z_k)^2 \right)",
)
def change_without_the_shear(printed: Printed) -> Statement:
    """The matrix A_T leaves the velocity component alone, so that it drops out of the change of
    K.
    """
    return is_change(printed, term(kinetic_energy_change(z)))


@claim(
    "s4.3.1-DK5",
    "4.3.1",
    "line 527",
    printed=r"\Delta K(z_k) = \frac{1}{2} \left(\alpha^2 - 1 \right) (u_2' z_k)^2",
)
def change_as_one_square(printed: Printed) -> Statement:
    """The change of K is a negative multiple of a square."""
    return is_change(printed, term(kinetic_energy_change(z)))


@claim(
    "s4.3.1-DK-negative", "4.3.1", "lines 529 to 531", printed=r"0 \le \alpha < 1 \\ \Delta K < 0"
)
def kinetic_energy_falls_at_every_impact(printed: Printed) -> Statement:
    """For every such alpha, an impact lowers the kinetic energy relative to e_1."""
    where, falls = pieces(printed, 2)
    return always(
        falls.formula(AT_Z.extended({r"\Delta K": kinetic_energy_change})),
        in_range=[where.formula(AT_Z)],
    )


@claim("s4.3.1-K-nonneg", "4.3.1", "line 533", printed=r"K \ge 0")
def kinetic_energy_is_not_negative(printed: Printed) -> Statement:
    """The kinetic energy relative to e_1 is never negative."""
    return always(printed.formula(AT_Z))


def _limit(printed: Printed) -> tuple[Term, str, Term]:
    """The value of which the print gives the limit along an orbit, the relation, and the limit."""
    chain = printed.relation_chain(STEP)
    value, sign, limit = chain[0]
    if (
        len(chain) != 1
        or not isinstance(value, LimitValue)
        or (value.variable, value.destination) != ("k", r"\infty")
    ):
        raise ClaimError("the limit of a value for k to infinity is expected here")
    return term(scalar(value.value)), sign, term(scalar(limit))


def orbit_that_stays_away() -> Statement:
    """At alpha = 1/2 the state e_2 of R comes back after two periods, and its K is positive."""
    second = at(derived_vector("impact_fixed_point"), {"K": 2})
    back = equals(vector(f2(vector(f1(second)))), second) & B1(second) & B2(vector(f1(second)))
    return always(
        back & R(second) & (from_e_1(second) > 0),
        in_range=[equal(2 * alpha, 1)],
        label="comes-back",
    )


@claim(
    "s4.3.1-LaSalle",
    "4.3.1",
    "lines 533 to 535",
    printed=r"\lim_{k\to\infty}K(z_k)=0",
    remark=Remark(
        "LaSalle's invariance principle is one of continuous maps, and f jumps. Nor can the"
        " argument be right: of alpha it uses alpha < 1 only, and at alpha = 1/2 it would prove"
        " what is false, for there the orbit of e_2 lies in R, comes back after two periods, and"
        " its K does not tend to zero.",
        orbit_that_stays_away,
        by=("s3.3.1-discontinuous", "s4.3.1-DK-negative"),
    ),
)
def kinetic_energy_tends_to_zero(printed: Printed) -> Argument:
    """K is not negative and decreases along the orbits in R, so that it tends to zero; its decrease
    is needed on both branches of f.

    While impact follows impact, alpha squared multiplies what K differs from one number by, its
    limit.
    """
    value, sign, limit = _limit(printed)
    following = at(
        value, dict(zip(("z1", "z2"), (term(entry) for entry in vector(relative_step(z)).entries)))
    )
    return Argument(
        steps={
            "not-negative": Assertion((always(from_e_1(b) >= 0),)),
            "falls-at-impacts": Assertion(
                (
                    always(
                        from_e_1(f1(b)) < from_e_1(b),
                        given=[B1(b), R(b)],
                        in_range=RANGE_21,
                    ),
                )
            ),
            "falls-in-flight": Assertion(
                (
                    always(
                        from_e_1(f2(b)) < from_e_1(b),
                        given=[B2(b), R(b)],
                        in_range=RANGE_21,
                    ),
                )
            ),
            "impacts-only": Assertion(
                (always(iff(equal(following - d, alpha**2 * (value - d)), relate(d, sign, limit))),)
            ),
        },
        rests_on=STABILITY,
    )


@claim("s4.3.1-lim-b", "4.3.1", "lines 537 to 539", printed=r"\lim_{k\to\infty} K(b_k) = K(e_1).")
def kinetic_energy_tends_to_that_of_the_fixed_point(printed: Printed) -> Following:
    """The kinetic energy tends to that of e_1, since the state tends to e_1: where that of the
    difference to e_1 is small, it differs little.
    """
    value, sign, limit = _limit(printed)
    little = d * (r + d / 2)
    close = (
        relate(value, sign, limit)
        if sign != "="
        else conjunction([value <= limit + little, limit - little <= value])
    )
    return Following(
        STABILITY, Assertion((always(close, given=[d >= 0, term(kinetic_energy(z)) <= d**2 / 2]),))
    )


@claim("s4.3.1-B2-approach", "4.3.1", "line 541", remark=FALLS_FROM_IMPACT_TO_IMPACT)
def flight_in_the_region_approaches_too() -> Readings:
    """A period of free flight within R brings the kinetic energy closer to that of e_1.

    That of the motion relative to e_1 comes closer to zero, or that of the ball closer to that of
    e_1.
    """
    in_flight = [B2(b), R(b)]

    def excess(state: Vector) -> Term:
        return term(kinetic_energy(state)) - term(kinetic_energy(e_1))

    after = f2(b)
    return Readings(
        {
            "relative": Reading(
                Assertion(
                    (always(from_e_1(after) < from_e_1(b), given=in_flight, in_range=RANGE_21),)
                ),
                "(28) defines K for the difference to e_1",
            ),
            "of-the-ball": Reading(
                Assertion(
                    (
                        always(
                            excess(after) ** 2 < excess(b) ** 2,
                            given=in_flight,
                            in_range=RANGE_21,
                        ),
                    )
                ),
                "section 4.3.1 says K(e_1), and B.7 defines K(b) for the ball",
            ),
        }
    )


@claim("s4.3.1-plain-english", "4.3.1", "line 543", repeats="s4.3.1-lim-b")
def kinetic_energy_settles_in_the_region() -> Following:
    """From every state of H the kinetic energy of an orbit tends to that of the fixed point of f1,
    and each impact multiplies K, the kinetic energy of the motion relative to e_1, by alpha
    squared.
    """
    return Following(STABILITY, Assertion((impact_shrinks(),)))
