"""Section 3.3: the map of a period with an impact, its fixed point e_1, and its neighbourhood."""

from __future__ import annotations

from juggleproof.judging.claims import Argument, Assertion, Following, Remark
from juggleproof.proofs.paper.names import (
    B1,
    B2,
    STRIKES,
    H,
    T,
    alpha,
    always,
    as_region,
    b,
    ball_at,
    beta,
    claim,
    collide,
    collision_time,
    derived_vector,
    equals,
    exists_some,
    f1,
    f2,
    flight_matrix,
    height,
    matrix,
    meet,
    paper_names,
    r,
    r_0,
    speed,
    t,
    table_at,
    v,
    value_of,
    vector,
)
from juggleproof.proofs.paper.regions import pieces
from juggleproof.proofs.paper.states import (
    NEAR_B2,
    b_0,
    eigenvalue_of,
    is_fixed_point,
    is_the_map,
    next_bounce,
    offset_with,
    strikes_from,
    within,
)
from juggleproof.reading.meaning import Printed
from juggleproof.reading.values import Region, Vector
from juggleproof.statements.language import (
    Formula,
    Statement,
    Term,
    different,
    equal,
    iff,
    real,
    reals,
    term,
)

# -------------------------------------------------------------------------------------------------
# Section 3.3: the map of a period with an impact, its fixed point e_1, and the neighbourhood that
# stays in B1.

tau, size, p, q = reals("tau size p q")
FIXED, FIXED_0 = equals(f1(b), b), equals(f1(b_0), b_0)  # what e_1 is


@claim(
    "eq-10",
    "3.3",
    "(10)",
    printed=(
        r"\overline{b}_{k+1} = \overline{f}_1(\overline{b}_k) := -\alpha A_T \overline{b}_k +"
        r" (\alpha - 1) A_{-\xi_1} r_0"
    ),
)
def state_at_the_next_bounce(printed: Printed) -> Statement:
    """After an impact within the period, the state when the table bounces next is this affine image
    of the state before.
    """
    names = {r"\overline b_k": b_0, r"\overline b_{k+1}": next_bounce(b_0, t)}
    return always(printed.formula(paper_names().extended(names)), given=[strikes_from(b_0, t)])


@claim("s3.3-iterate", "3.3", "line 291")
def impact_in_each_of_two_periods() -> list[Statement]:
    """If the image of a state of B1 is in B1 too, the ball strikes again, and the state after the
    second period is the image's image.
    """
    once, twice = f1(b), f1(f1(b))
    slower = speed(once) < r
    return [
        always(slower, given=[B1(b), B1(once)], label="approaches-again"),
        exists_some(
            ["tau"], strikes_from(once, tau), given=[B1(b), slower, B1(once)], label="strikes-again"
        ),
        always(
            equals(next_bounce(next_bounce(b, t), tau), twice),
            given=[strikes_from(b, t), strikes_from(once, tau)],
            label="composed",
        ),
    ]


@claim("s3.3-xi1", "3.3", "line 297", printed=r"\xi_1 := \alpha T/(1 - \alpha)")
def time_in_the_offset(printed: Printed) -> Statement:
    """What an impact adds to the linear part of the map is r_0 flown back for one time only, and
    shrunk and turned round: for xi_1.
    """
    return always(
        iff(
            equals(offset_with(t), f1(Vector((0, 0)))),
            printed.formula(paper_names().extended({r"\xi_1": t})),
        )
    )


def in_box(state: Vector, center: Vector, size: Term) -> Formula:
    """The open box in which heights may differ by `size`, and speeds by what keeps the image of the
    box inside it.
    """
    height, speed = (term(entry) for entry in state - center)
    return within(size, height) & within((1 - alpha) * size, alpha * T * speed)


@claim("s3.3-open-set", "3.3", "line 297")
def some_open_set_stays_in_b1() -> list[Statement]:
    """The box around e_1 that reaches down to the edge of H is open and not empty, lies in B1, and
    is mapped into itself.
    """
    reach = term(b_0.component(1))
    return [
        always(in_box(b, b, beta), given=[FIXED], label="not-empty"),
        always(
            B1(b) & in_box(f1(b), b_0, reach), given=[FIXED_0, in_box(b, b_0, reach)], label="stays"
        ),
    ]


@claim("s3.3-unique-fixed", "3.3", "line 299")
def impact_map_has_one_fixed_point() -> list[Statement]:
    """Exactly one state is its own image under the map of a period with an impact."""
    return [
        exists_some(["beta", "v"], FIXED, label="exists"),
        always(equals(b, b_0), given=[FIXED, FIXED_0], label="only-one"),
    ]


@claim(
    "s3.3-e1-solve",
    "3.3",
    "line 301",
    printed=r"e_1 := -(I + \alpha A_T)^{-1} \cdot (1 - \alpha) A_{-\xi_1} r_0",
)
def fixed_point_by_the_inverse(printed: Printed) -> Statement:
    """The fixed point is the inverse of 1 + alpha A_T, applied to the offset of the map."""
    return is_fixed_point(printed)


@claim(
    "s3.3-e1-closed",
    "3.3",
    "line 302",
    printed=r"e_1 = -\frac{1 - \alpha}{1 + \alpha} A_{-\xi_1} r_0",
    as_it_stands=r"= -\frac{1 - \alpha}{1 + \alpha} A_{-\xi_1} r_0",
    derived=lambda: derived_vector("e_1"),
)
def fixed_point_as_a_shifted_launch(printed: Printed) -> Statement:
    """The fixed point is the table's launch state flown back for the time in the index, shrunk and
    turned round.
    """
    return is_fixed_point(printed)


@claim("s3.3-epsilon1", "3.3", "line 304", printed=r"\epsilon_1 := 2\alpha T/(1 - \alpha^2)")
def time_in_the_fixed_point(printed: Printed) -> Statement:
    """The launch state flown back, shrunk by (1 - alpha)/(1 + alpha) and turned round, is a fixed
    point for this time only.
    """
    shifted = vector(flight_matrix(-t) * r_0).scaled(-(1 - alpha) / (1 + alpha))
    return always(
        iff(
            equals(f1(shifted), shifted),
            printed.formula(paper_names().extended({r"\epsilon_1": t})),
        )
    )


@claim(
    "s3.3-e1",
    "3.3",
    "line 306",
    printed=r"e_1 = \begin{bmatrix} \frac{4\alpha\dot{\rho}_0^2}{(1+\alpha)^2\gamma} \\ "
    r"\frac{-(1-\alpha)\dot{\rho}_0}{1+\alpha} \end{bmatrix}",
)
def fixed_point_in_coordinates(printed: Printed) -> Statement:
    """The fixed point has this height and this speed."""
    return is_fixed_point(printed)


@claim(
    "s3.3-e1-in-B1",
    "3.3",
    "line 306",
    printed=r"e_1 \in \mathcal{B}_1",
    as_it_stands=r"e_1 \in \beta_1",
)
def fixed_point_lies_in_b1(printed: Printed) -> Statement:
    """The fixed point lies in B1, so that it is one of the whole map."""
    return always(printed.formula(paper_names().extended({"e_1": b})), given=[FIXED])


@claim(
    "s3.3-e1-in-H",
    "3.3",
    "line 308",
    printed=r"e_1 \in \mathcal{H}",
    as_it_stands=r"e_1 \in \mathcal{A}",
)
def fixed_point_lies_above_the_table(printed: Printed) -> list[Statement]:
    """The height of the fixed point is positive, so that it lies in H."""
    return [
        always(beta > 0, given=[FIXED], label="positive"),
        always(printed.formula(paper_names().extended({"e_1": b})), given=[FIXED], label="in-H"),
    ]


@claim("s3.3-e1-tau", "3.3", "line 310", printed=r"\tau_c(e_1) < T")
def impact_at_the_fixed_point_comes_in_time(printed: Printed) -> list[Statement]:
    """At the fixed point the ball is slower than the table's launch, and meets it before the period
    is over.
    """
    return [
        always(v < r, given=[FIXED], label="approaching"),
        always(
            printed.formula(paper_names().extended({"e_1": b})),
            given=[FIXED, v < r],
            label="in-time",
        ),
    ]


@claim(
    "s3.3-e1-in-B1-since",
    "3.3",
    "lines 306 to 310",
    remark=Remark(
        "That the ball falls is not among the reasons, but stands in the display before them. It is"
        " needed: of a ball faster than the table the time to collision by (6) is negative, and so"
        " less than a period, and no impact comes.",
        by=("s3.3.1-B2",),
    ),
)
def positive_height_and_early_impact_give_b1() -> Argument:
    """A state of positive height whose ball falls, and whose time to collision is less than a
    period, lies in B1; the fixed point is such a state.
    """
    early = collision_time(b) < T
    return Argument(
        steps={
            "positive": Assertion((always((beta > 0) & (v < 0), given=[FIXED]),)),
            "in-time": Assertion((always(early, given=[FIXED, v < r]),)),
            "inference": Assertion((always(B1(b), given=[v < 0, beta > 0, early]),)),
        },
        conclusion=Assertion((always(B1(b), given=[FIXED]),)),
    )


@claim("s3.3-eigenvalues", "3.3", "line 313", printed=r"-\alpha A_T")
def eigenvalues_lie_in_the_unit_circle(printed: Printed) -> Statement:
    """Every complex eigenvalue of the linear part of the map is less than 1 in absolute value,
    whatever the launch speed.
    """
    return always(
        p**2 + q**2 < 1, given=[eigenvalue_of(matrix(value_of(printed, paper_names())), p, q)]
    )


@claim("s3.3-neighbourhood", "3.3", "line 313")
def small_boxes_stay_in_b1() -> Statement:
    """Every box around e_1 that does not reach below the edge of H, however small, lies in B1 and
    is mapped into itself.
    """
    return always(
        B1(b) & in_box(f1(b), b_0, size),
        given=[FIXED_0, size <= term(b_0.component(1)), in_box(b, b_0, size)],
    )


@claim("s3.3-takes-e1-as-limit", "3.3", "line 313")
def neighbourhood_shrinks_to_the_fixed_point() -> Following:
    """What starts near e_1 tends to it: a period shrinks boxes around it to (1 + alpha)/2."""

    def box(state: Vector, scale: Term) -> Formula:
        height, speed = (term(entry) for entry in state - b_0)
        return within(scale, height) & within((1 - alpha) * scale, 2 * alpha * T * speed)

    shrunk = always(
        box(f1(b), (1 + alpha) / 2 * size),
        given=[FIXED_0, box(b, size)],
        label="a-period-shrinks-boxes",
    )
    return Following(("theorem-nearby/contracts",), Assertion((shrunk,)))


# -------------------------------------------------------------------------------------------------
# Section 3.3.1: periods without an impact, and the map f on all of H.

less = real("less")
ON_THE_LINE = (
    H(b) & meet(T) & (v < r)
)  # between B1 and B2, where the ball meets the table as it bounces


@claim(
    "s3.3.1-B2",
    "3.3.1",
    "lines 315 to 317",
    true_nearby=NEAR_B2,
    repeats="s2.2.1-B2",
    printed=r"\mathcal{B}_2 = \mathcal{H} - \mathcal{B}_1, \quad T \le \tau_c(\overline{b})",
    as_it_stands=r"\beta_2 = \mathcal{A} - \beta_1, \quad T \leq \tau_c(\overline{b})",
)
def states_outside_b1_meet_the_table_late(printed: Printed) -> list[Statement]:
    """The states of H outside B1 are those whose time to collision is one period at least."""
    difference, condition = pieces(printed, 2)
    late = Region(lambda state: H(state) & condition.formula(paper_names()))
    return [
        always(
            condition.formula(paper_names()),
            given=[as_region(difference.right(paper_names()))(b), different(v, r)],
            label="late",
        ),
        always(
            difference.formula(paper_names().extended({r"\mathcal{B}_2": late})),
            given=[different(v, r)],
            label="all-that-are-late",
        ),
    ]


@claim(
    "eq-11",
    "3.3.1",
    "(11)",
    true_nearby=NEAR_B2,
    repeats="s2.2.1-B2",
    printed=r"\mathcal{B}_2 := \{ \overline{b} \in \mathcal{H} \mid T \le \tau_c(\overline{b}) \}",
    as_it_stands=r"\beta_2 := \{ \overline{b} \in \mathcal{A} \mid T \le \tau_c(\overline{b}) \}",
)
def second_region_by_the_time_to_collision(printed: Printed) -> list[Statement]:
    """The states of H whose time to collision is one period at least are those from which the ball
    does not strike within a period.
    """
    late = printed.set_predicate(paper_names(), r"\mathcal{B}_2")
    no_strike = H(b) & ~strikes_from(b, t)
    return [
        always(no_strike, given=[different(v, r), late(b)], label="no-strike"),
        always(late(b), given=[different(v, r), B2(b)], label="all-of-B2"),
    ]


@claim("s3.3.1-no-impact", "3.3.1", "line 323", repeats="s2.2.1-B2-no-strike")
def no_impact_within_a_period_of_b2() -> Statement:
    """From a state of B2 the ball never touches the table, while coming nearer, before the period
    is over.
    """
    return always(~strikes_from(b, t), given=[B2(b)])


@claim("eq-12", "3.3.1", "(12)", printed=r"\overline{f}_2 := F^T")
def period_of_flight(printed: Printed) -> list[Statement]:
    """From a state of B2 the ball flies freely until the table is on the ground next, and is in H
    then.
    """
    lands = (t > 0) & equal(height(table_at(t)), 0)
    after = vector(printed.right(paper_names()))
    return [
        always(
            printed.formula(paper_names().extended({r"\overline f_2": ball_at(t)})),
            given=[lands],
            label="next-bounce",
        ),
        always(H(after), given=[B2(b)], label="stays-in-H"),
    ]


@claim(
    "eq-13",
    "3.3.1",
    "(13)",
    printed=r"\overline{f} := \begin{cases} \overline{f}_1 : \overline{b} \in \mathcal{B}_1 \\ "
    r"\overline{f}_2 : \overline{b} \in \mathcal{B}_2 \end{cases}",
)
def map_on_all_of_h(printed: Printed) -> list[Statement]:
    """The two cases give every state of H one image, which is the state when the table bounces
    next, B2 being what B1 leaves of H.
    """
    return is_the_map(printed)


@claim("s3.3.1-global", "3.3.1", "line 327")
def map_takes_h_into_itself() -> list[Statement]:
    """From every state of H, with or without an impact, the ball is in H again when the table
    bounces next.
    """
    return [
        always(H(f1(b)), given=[B1(b)], label="with-impact"),
        always(H(f2(b)), given=[B2(b)], label="without-impact"),
        always(STRIKES(b), given=[H(b), ~B2(b)], label="no-other-states"),
    ]


@claim("s3.3.1-discontinuous", "3.3.1", "line 332")
def map_jumps_between_b1_and_b2() -> list[Statement]:
    """The map jumps at the line between B1 and B2: from a state on it that is slower than the
    table's launch to one that is ever so little slower still, the image's speed jumps.

    The jump is no less than a fixed amount. It comes of the table's velocity: on the line, the two
    maps differ by the impact with the table as it comes down.
    """
    slower = Vector((beta, v - less))
    return [
        always(
            B1(slower) & (speed(f1(slower)) - speed(f2(b)) >= r - v),
            given=[ON_THE_LINE, less > 0],
            label="jump",
        ),
        always(B2(b), given=[ON_THE_LINE], label="value-on-the-line"),
        always(
            equals(f1(b), vector(collide(table_at(T))(f2(b)))),
            given=[meet(T)],
            label="cause",
        ),
    ]
