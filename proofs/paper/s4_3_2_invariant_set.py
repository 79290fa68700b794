"""Sections 4.3.2 and 4.4: the band around e_1 that the paper calls invariant, and what it
attracts.
"""

from __future__ import annotations

from juggleproof.judging.claims import Argument, Assertion, Following, Reading, Readings, Remark
from juggleproof.proofs.paper.names import (
    B1,
    B2,
    BOUNDARY_OF_R,
    R,
    T,
    alpha,
    always,
    b,
    c,
    claim,
    collision_time,
    derived,
    derived_vector,
    e_1,
    eps,
    equals,
    exists_some,
    f1,
    f2,
    from_e_1,
    height,
    kinetic_energy,
    leaves_R_at,
    meet,
    next_states,
    on_the_line,
    paper_names,
    r,
    s,
    speed,
    v,
)
from juggleproof.proofs.paper.states import (
    AROUND_E1,
    FALLS_FROM_IMPACT_TO_IMPACT,
    NEAR,
    RANGE_21,
    STABILITY,
    narrow_band_exists,
    narrow_band_stays,
    next_image,
    relative_step,
    within,
    z,
)
from juggleproof.reading.meaning import Printed
from juggleproof.reading.values import StateFunction, Vector
from juggleproof.statements.language import (
    Formula,
    Statement,
    Term,
    different,
    equal,
    iff,
    reals,
    term,
)

# -------------------------------------------------------------------------------------------------
# Section 4.3.2: the point p, the band of states whose kinetic energy is close to that of e_1, and
# whether f maps it into itself.

d, p0, p1, p2, y = reals("d p0 p1 p2 y")
JUST_AT_THE_BOUNCE = equal(term(collision_time(b)), T)  # what the line between B1 and B2 is


@claim(
    "eq-29",
    "4.3.2",
    "(29)",
    printed=r"\begin{bmatrix} \overline\beta \\ \dot{\overline\beta} \end{bmatrix} = "
    r"\begin{bmatrix} 1 \\ -\frac{1}{T} \end{bmatrix} \overline{\beta} + r_0",
    as_it_stands=r"\frac{\dot{\overline{\beta}}}{\overline{\beta}} = "
    r"\begin{bmatrix} 1 \\ -\frac{1}{T} \end{bmatrix} \overline{\beta} + \dot{\rho}_0",
)
def line_between_b1_and_b2(printed: Printed) -> Statement:
    """The states that would meet the table just at its next bounce are those of this line, with the
    height as its parameter.
    """
    return always(iff(meet(T), printed.formula(paper_names())))


def is_just_as_fast() -> Formula:
    """The ball has the kinetic energy of e_1."""
    return equal(term(kinetic_energy(b)), term(kinetic_energy(e_1)))


@claim(
    "eq-30",
    "4.3.2",
    "(30)",
    printed=(
        r"p := \begin{bmatrix} \frac{2T}{1+\alpha} \dot{\rho}_0 \\ -\frac{1-\alpha}{1+\alpha}"
        r" \dot{\rho}_0 \end{bmatrix}"
    ),
    remark=Remark(
        "The line is that of the velocity of e_1. A second line has the same kinetic energy, with"
        " the velocity turned round, and meets the line between B1 and B2 as well.",
        lambda: exists_some(
            ["beta", "v"],
            JUST_AT_THE_BOUNCE & is_just_as_fast() & different(v, speed(e_1)),
            within=[different(v, r)],
            label="another",
        ),
    ),
)
def point_p_is_the_intersection(printed: Printed) -> Statement:
    """p is where that line meets the states with the velocity of e_1."""
    is_p = printed.formula(paper_names().extended({"p": b}))
    return always(iff(JUST_AT_THE_BOUNCE & equal(v, speed(e_1)), is_p), given=[different(v, r)])


AT_P = paper_names().extended({"p": derived_vector("point_p")})


@claim(
    "eq-31a",
    "4.3.2",
    "(31), first line",
    printed=(
        r"E(p) = \frac{2T}{1+\alpha} \dot{\rho}_0 \gamma + \frac{1}{2}"
        r" \left(-\frac{1-\alpha}{1+\alpha} \dot{\rho}_0 \right)^2"
    ),
)
def energy_of_the_point_p(printed: Printed) -> Statement:
    """A number is the energy of p exactly if it is what is printed."""
    return always(
        iff(equal(d, derived("energy_of_p")), printed.formula(AT_P.extended({r"E(p)": d})))
    )


@claim("eq-31b", "4.3.2", "(31), second line", printed=r"E(p) > E_{max} + \Delta E_{max}")
def point_p_has_more_energy_than_the_region(printed: Printed) -> Statement:
    """The energy of p is above the level of R."""
    return always(printed.formula(AT_P), in_range=RANGE_21)


@claim("s4.3.2-p-not-R", "4.3.2", "line 559", printed=r"p \notin \mathcal{R}")
def point_p_is_outside_the_region(printed: Printed) -> Statement:
    """p does not belong to R."""
    return always(printed.formula(AT_P), in_range=RANGE_21)


def slower_states_are_in_b1(
    in_range: tuple[Formula, ...] | None = RANGE_21,
) -> tuple[Statement, Statement]:
    """The states of R that are slower than where R leaves B1 are in B1, and e_1 is slower than
    that.
    """
    return (
        always(B1(b), given=[leaves_R_at(c), R(b), v < c], in_range=in_range, label="slower-in-B1"),
        always(speed(e_1) < c, given=[leaves_R_at(c)], in_range=in_range, label="e_1-is-slower"),
    )


@claim("s4.3.2-near-in-B1", "4.3.2", "line 559")
def states_near_e_1_in_kinetic_energy_are_in_b1() -> Readings:
    """The states of R whose kinetic energy is near that of e_1 lie in B1.

    Of the motion relative to e_1: the states of R that are slower than where R leaves B1 lie in B1,
    and e_1 is slower than that. Of the ball itself: the states of R with the kinetic energy of e_1
    lie in B1.
    """
    same_energy = always(B1(b), given=[R(b), is_just_as_fast()], in_range=RANGE_21)
    return Readings(
        {
            "relative": Reading(
                Assertion(slower_states_are_in_b1()), "(28) defines K for the difference to e_1"
            ),
            "of-the-ball": Reading(
                Assertion((same_energy,)),
                "section 4.3.2 says kinetic energy near that of e_1, and B.7 defines K(b) for the"
                " ball",
            ),
        }
    )


@claim(
    "s4.3.2-f1-applies",
    "4.3.2",
    "line 559",
    repeats="s4.3.2-near-in-B1",
    remark=Remark(
        "Near is said of K, the kinetic energy of the motion relative to e_1, as (28) defines it;"
        " of the kinetic energy of the ball itself this fails.",
        by=("s4.3.2-near-in-B1",),
    ),
)
def map_of_an_impact_applies_there() -> list[Statement]:
    """f is f1, for they lie in B1, at the states of R whose velocity is nearer to that of e_1 than
    where R leaves B1; there is such a velocity, and e_1 is slower than that.
    """
    edge = 2 * r - s * r / (1 - alpha)
    near = from_e_1(b) < from_e_1(on_the_line(c))
    return [
        always(B1(b), given=[leaves_R_at(c), R(b), near], in_range=RANGE_21),
        always(
            equals(next_image, f1(b)), given=[B1(b), next_states(b, next_image)], label="f-is-f1"
        ),
        always(leaves_R_at(edge), label="R-leaves-B1"),
        always(speed(e_1) < c, given=[leaves_R_at(c)], in_range=RANGE_21, label="e_1-is-slower"),
    ]


@claim(
    "eq-32",
    "4.3.2",
    "(32)",
    printed=(
        r"\mathcal{K} := \left\{ \overline{b} \in B_1 \middle| K(\overline{b} - e_1) \le \epsilon"
        r" \right\} \cap R,"
    ),
)
def band_around_the_fixed_point(printed: Printed) -> list[Statement]:
    """The set consists of the states of B1 and R whose velocity differs from that of e_1 by at most
    the root of 2 epsilon; e_1 is one.
    """
    region = printed.set_predicate(AROUND_E1, r"\mathcal{K}")
    close = (speed(e_1) - d <= v) & (v <= speed(e_1) + d)
    return [
        always(
            iff(region(b), B1(b) & R(b) & close), given=[d >= 0, equal(d**2, 2 * eps)], label="band"
        ),
        always(region(e_1), given=[eps >= 0], label="contains-e_1"),
        always(R(b), given=[region(b)], label="inside-R"),
    ]


@claim(
    "s4.3.2-f1-boundary",
    "4.3.2",
    "line 565",
    printed=r"\overline{f}_1(\partial \mathcal{K}) \subset \mathcal{K}",
)
def boundary_of_the_band_is_mapped_into_it(printed: Printed) -> Readings:
    """f1 maps the boundary of the band into the band: of a band of every size, or of a narrow one,
    which does not reach up to where R leaves B1; there are such bands.
    """
    stays = printed.formula(AROUND_E1)
    return Readings(
        {
            "every-size": Reading(
                Assertion((always(stays, given=[eps > 0], in_range=RANGE_21),)),
                "(32) defines the band for an epsilon of which nothing is said",
            ),
            "near-e_1": Reading(
                Assertion(
                    (
                        narrow_band_exists(),
                        always(stays, given=[eps > 0, *NEAR], in_range=RANGE_21),
                    )
                ),
                "before (32) the kinetic energy is said to be close to that of e_1",
            ),
        }
    )


@claim(
    "s4.3.2-f1-boundary-R",
    "4.3.2",
    "line 565",
    printed=r"\overline{f}_1(\partial \mathcal{R} \cap \mathcal{B}_1) \subset \mathcal{R}",
    as_it_stands=r"\overline{f}_1(\partial \mathcal{K} \cap \mathcal{B}_1) \subset \mathcal{K}",
)
def boundary_of_the_region_is_mapped_into_it(printed: Printed) -> Statement:
    """f1 maps those boundary states of R that are in B1 into R."""
    return always(printed.formula(paper_names().extended({r"\partial\mathcal{R}": BOUNDARY_OF_R})))


@claim(
    "s4.3.2-f-K-continuous",
    "4.3.2",
    "line 565",
    printed=r"\overline{f}|_{\mathcal{K}} = \overline{f}_1",
)
def map_on_the_band_is_that_of_an_impact(printed: Printed) -> list[Statement]:
    """On the band f is f1, which is continuous: images differ in each component by no more than a
    multiple of what the states differ by.
    """
    other = Vector(reals("beta0 v0"))
    change = f1(b) - f1(other)
    near = (height(b - other), T * speed(b - other))
    within = [-d <= near[0], near[0] <= d, -d <= near[1], near[1] <= d]
    far = (height(change), T * speed(change))
    return [
        always(printed.formula(AROUND_E1), given=[next_states(b, next_image)], label="agrees"),
        always(
            (-2 * d <= far[0]) & (far[0] <= 2 * d) & (-2 * d <= far[1]) & (far[1] <= 2 * d),
            given=within,
            label="continuous",
        ),
    ]


@claim(
    "s4.3.2-K-invariant",
    "4.3.2",
    "line 565",
    printed=r"\overline{f}(\mathcal{K}) \subseteq \mathcal{K}",
    remark=Remark(
        "Where R has states that close at r/alpha, the band of (32) is kept if and only if"
        " sqrt(2 eps)/r < (1 - alpha)/(alpha (1 + alpha)), and else for every eps. With E_max in"
        " place of the level of R it would be kept for every eps and alpha < 1/3.",
        by=("region-K-size", "region-Emax-B1"),
    ),
)
def band_is_mapped_into_itself(printed: Printed) -> Argument:
    """Since f is continuous on the band and its boundary is mapped into it, a narrow band is mapped
    into itself; there are such bands.

    For continuous maps in general this does not follow: a quadratic map can keep the ends of an
    interval in it and lead a point between them out of it.
    """

    def quadratic(at: Term | int) -> Term:
        return p0 + p1 * at + p2 * at**2

    def inside(value: Term) -> Formula:
        return (-1 <= value) & (value <= 1)

    is_enough = always(
        inside(quadratic(y)), given=[inside(quadratic(-1)), inside(quadratic(1)), inside(y)]
    )

    def stays(f: StateFunction[Vector], given: list[Formula], label: str) -> Statement:
        stated = printed.formula(AROUND_E1.extended({r"\overline f": f}))
        return always(stated, given=[eps > 0, *NEAR, *given], in_range=RANGE_21, label=label)

    return Argument(
        steps={"boundary-is-enough": Assertion((is_enough,))},
        conclusion=Assertion(
            (
                narrow_band_exists(),
                stays(f1, [], "with-impact"),
                stays(f2, [B2(b)], "without-impact"),
            )
        ),
    )


@claim("s4.3.2-K-attracts", "4.3.2", "line 565", remark=FALLS_FROM_IMPACT_TO_IMPACT)
def band_attracts_the_region() -> Argument:
    """The band attracts all of R, since on R the kinetic energy relative to e_1 decreases, at
    impacts and in flight, unless it is zero.
    """
    outside = [R(b), from_e_1(b) > 0]
    return Argument(
        steps={
            "falls-at-impacts": Assertion(
                (
                    always(
                        from_e_1(f1(b)) < from_e_1(b),
                        given=[B1(b), *outside],
                        in_range=RANGE_21,
                    ),
                )
            ),
            "falls-in-flight": Assertion(
                (
                    always(
                        from_e_1(f2(b)) < from_e_1(b),
                        given=[B2(b), *outside],
                        in_range=RANGE_21,
                    ),
                )
            ),
        },
        rests_on=STABILITY,
    )


# -------------------------------------------------------------------------------------------------
# Section 4.4: the fixed point e_1 attracts the band around it, and so the whole state space.

size, y1, y2, p, q = reals("size y1 y2 p q")
y_pair = Vector((y1, y2))


@claim(
    "s4.4-linear",
    "4.4",
    "line 569",
    printed=r"\overline{f}|_{\mathcal{K}} = \overline{f}_1",
    repeats="s4.3.2-f-K-continuous",
    remark=Remark(
        "In the states themselves f1 is affine, and not linear: it does not keep the origin.",
        lambda: always(different(speed(f1(Vector((0, 0)))), 0), label="moves-the-origin"),
    ),
)
def map_on_the_band_is_linear(printed: Printed) -> list[Statement]:
    """On the band f is f1, which is linear in the differences to e_1."""

    def step(difference: Vector) -> Vector:
        return f1(e_1 + difference) - e_1

    agrees = always(printed.formula(AROUND_E1), given=[next_states(b, next_image)], label="agrees")
    mixed = z.scaled(p) + y_pair.scaled(q)
    combined = step(z).scaled(p) + step(y_pair).scaled(q)
    return [agrees, always(equals(step(mixed), combined), label="linear")]


@claim("s4.4-e1-attracts-K", "4.4", "line 569")
def fixed_point_attracts_the_band() -> Following:
    """e_1 is stable and attracts the band; a narrow band is mapped into itself, and each impact
    brings its states closer to e_1.

    An impact multiplies the greater of the differences to e_1, in height and in speed times T, by 2
    alpha at most.
    """
    after = relative_step(z)
    before = within(size, height(z)) & within(size, T * speed(z))
    shrunk = within(2 * alpha * size, height(after)) & within(2 * alpha * size, T * speed(after))
    return Following(
        STABILITY,
        Assertion(
            (
                *narrow_band_stays(eps),
                always(shrunk, given=[before], in_range=RANGE_21, label="contracts"),
            )
        ),
    )


@claim("s4.4-global", "4.4", "line 569")
def fixed_point_is_a_global_attractor() -> Following:
    """e_1 is stable, and every orbit on H tends to it."""
    return Following(STABILITY, is_conclusion=True)


# -------------------------------------------------------------------------------------------------
# Section 5: what the conclusion says was found.


@claim("s5-range", "5", "line 583")
def a_range_of_restitution_makes_the_orbit_globally_stable() -> Following:
    """For a range of the restitution the periodic orbit of one impact a period is globally
    asymptotically stable.
    """
    return Following(STABILITY, is_conclusion=True)
