"""Section 3.3: the map of a period with an impact, its fixed point e_1, and the neighbourhood that
stays in B1.
"""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import Formula, Term, different, iff, reals, term
from proofs.claims import Argument, Assertion, Following, claim
from proofs.paper.events import speed, value_of, vector
from proofs.paper.orbits import (
    b_0,
    eigenvalue_of,
    is_fixed_point,
    next_bounce,
    offset_with,
    strikes_from,
    within,
)
from proofs.paper.vocabulary import (
    B1,
    PAPER,
    T,
    alpha,
    always,
    b,
    beta,
    collision_time,
    derived,
    equals,
    exists_some,
    f1,
    flight_matrix,
    r,
    r_0,
    t,
    v,
)
from proofs.reading.printed import Printed
from proofs.reading.values import Vector

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
    return always(printed.formula(PAPER.extended(names)), given=[strikes_from(b_0, t)])


@claim("s3.3-iterate", "3.3", "line 291")
def impact_in_each_of_two_periods() -> list[Statement]:
    """If the image of a state of B1 is in B1 too, the ball strikes again, and the state after the
    second period is the image's image.
    """
    once, twice = vector(f1(b)), f1(f1(b))
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
            printed.formula(PAPER.extended({r"\xi_1": t})),
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
    derived=lambda: derived("e_1"),
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
    shifted = (flight_matrix(-t) * r_0).scaled(-(1 - alpha) / (1 + alpha))
    return always(
        iff(equals(f1(shifted), shifted), printed.formula(PAPER.extended({r"\epsilon_1": t})))
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
    return always(printed.formula(PAPER.extended({"e_1": b})), given=[FIXED])


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
        always(printed.formula(PAPER.extended({"e_1": b})), given=[FIXED], label="in-H"),
    ]


@claim("s3.3-e1-tau", "3.3", "line 310", printed=r"\tau_c(e_1) < T")
def impact_at_the_fixed_point_comes_in_time(printed: Printed) -> list[Statement]:
    """At the fixed point the ball is slower than the table's launch, and meets it before the period
    is over.
    """
    return [
        always(v < r, given=[FIXED], label="approaching"),
        always(printed.formula(PAPER.extended({"e_1": b})), given=[FIXED, v < r], label="in-time"),
    ]


@claim("s3.3-e1-in-B1-since", "3.3", "lines 306 to 310")
def positive_height_and_early_impact_give_b1() -> Argument:
    """A state of positive height whose time to collision is less than a period lies in B1; the
    fixed point is such a state.
    """
    early = collision_time(b) < T
    return Argument(
        steps={
            "positive": Assertion((always(beta > 0, given=[FIXED]),)),
            "in-time": Assertion((always(early, given=[FIXED, v < r]),)),
            "inference": Assertion((always(B1(b), given=[different(v, r), beta > 0, early]),)),
        },
        conclusion=Assertion((always(B1(b), given=[FIXED]),)),
        rescue="s3.3-e1-in-B1",
    )


@claim("s3.3-eigenvalues", "3.3", "line 313", printed=r"-\alpha A_T")
def eigenvalues_lie_in_the_unit_circle(printed: Printed) -> Statement:
    """Every complex eigenvalue of the linear part of the map is less than 1 in absolute value,
    whatever the launch speed.
    """
    return always(p**2 + q**2 < 1, given=[eigenvalue_of(value_of(printed, PAPER), p, q)])


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
    """What starts in the neighbourhood tends to e_1."""

    def box(state: Vector, scale: Term) -> Formula:
        height, speed = (term(entry) for entry in state - b_0)
        return within(scale, height) & within((1 - alpha) * scale, 2 * alpha * T * speed)

    shrunk = always(
        box(f1(b), (1 + alpha) / 2 * size),
        given=[FIXED_0, box(b, size)],
        label="a-period-shrinks-boxes",
    )
    return Following(("theorem-nearby/contracts",), Assertion((shrunk,)))
