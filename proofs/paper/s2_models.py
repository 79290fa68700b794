"""Section 2: the regions of the plane, free flight, the impact of two point masses, and the ball
from one impact to the next.
"""

from __future__ import annotations

from juggleproof.judging.claims import Assertion, Reading, Readings, Remark
from juggleproof.proofs.paper.names import (
    B1,
    B1_ZERO,
    B2,
    STRIKES,
    H,
    T,
    after_impact,
    alpha,
    always,
    as_region,
    at,
    b,
    ball_at,
    beta,
    claim,
    collide,
    collision_time,
    derived,
    derived_vector,
    energy,
    equals,
    exists_some,
    f1,
    f2,
    flight,
    height,
    impact_energy_change,
    meet,
    only_at,
    paper_names,
    r,
    speed,
    strikes_at,
    t,
    table_at,
    v,
    vector,
)
from juggleproof.proofs.paper.regions import pieces
from juggleproof.proofs.paper.states import (
    CORNER_WITHOUT_A_TIME,
    NEAR_B2,
    b1_is_where_the_ball_strikes,
    b2_is_where_it_does_not,
    line_of_equal_times,
    strikes_from_region,
)
from juggleproof.reading.meaning import Printed
from juggleproof.reading.values import ShapeError, StateFunction, Vector
from juggleproof.statements.language import (
    Formula,
    Statement,
    Term,
    conjunction,
    different,
    equal,
    iff,
    real,
    reals,
    term,
)

# -------------------------------------------------------------------------------------------------
# Section 2.2.1: the regions H, B1 and B2, the line between them, and the curve on which an impact
# keeps the energy.

u = real("u")  # the speed at which the line between B1 and B2 passes the height of the state


@claim("s2.2.1-H", "2.2.1", "line 123", printed=r"\overline{\beta} > 0")
def states_on_or_above_the_table(printed: Printed) -> list[Statement]:
    """H is the set of states with the ball on or above the table at its lowest, and no state leaves
    it within a period.
    """
    inside = printed.formula(paper_names())
    return [
        always(iff(inside, height(ball_at(0)) >= height(table_at(0))), label="on-or-above"),
        always(at(inside, f1(b)), given=[inside, STRIKES(b)], label="kept-with-impact"),
        always(at(inside, f2(b)), given=[inside, ~STRIKES(b)], label="kept-without-impact"),
    ]


@claim(
    "s2.2.1-B1",
    "2.2.1",
    "line 125",
    printed=r"0 \le \tau_c(\overline{b}) < T",
    as_it_stands=r"0 \le \tau_c(b) < T",
    repeats="s2.2.1-H",
)
def time_to_collision_tells_b1(printed: Printed) -> Readings:
    """In H, the time to collision lies in the first period exactly on the region B1 of (7).

    H is printed both without and with its edge, where the ball is level with the table.
    """

    def reading(in_h: Formula) -> Assertion:
        return Assertion(
            (
                always(
                    iff(printed.formula(paper_names()), STRIKES(b)),
                    given=[in_h, different(v, r)],
                    label="same-states",
                ),
                always(different(v, r), given=[in_h, STRIKES(b)], label="time-is-defined"),
            )
        )

    return Readings(
        {
            "without-edge": Reading(reading(beta > 0), "section 2.2.1 prints H as beta > 0"),
            "with-edge": Reading(reading(beta >= 0), "section B.2 prints H as beta >= 0"),
        }
    )


@claim("s2.2.1-B1-strikes", "2.2.1", "line 125")
def b1_strikes_within_a_period() -> list[Statement]:
    """From the states of B1, and from no others in H, the ball strikes the table, meeting it while
    they approach each other, before one period is over.
    """
    return b1_is_where_the_ball_strikes()


@claim(
    "s2.2.1-B2",
    "2.2.1",
    "line 125",
    true_nearby=NEAR_B2,
    printed=r"\mathcal{B}_2 = \mathcal{H} - \mathcal{B}_1, \quad T \le \tau_c",
    as_it_stands=r"\mathcal{H} - \mathcal{B}_1 \ (T \le \tau_c)",
)
def time_to_collision_tells_b2(printed: Printed) -> list[Statement]:
    """B2 is what B1 leaves of H, and there the time to collision is one period at least."""
    difference, condition = pieces(printed, 2)
    rest, late = as_region(difference.right(paper_names())), condition.formula(paper_names())
    return [
        always(difference.formula(paper_names()), label="what-is-left"),
        always(late, given=[rest(b), different(v, r)], label="late"),
        always(rest(b), given=[H(b), different(v, r), late], label="all-that-are-late"),
    ]


@claim("s2.2.1-B2-no-strike", "2.2.1", "line 125")
def b2_does_not_strike_within_a_period() -> Statement:
    """From no state of B2 does the ball strike the table, meeting it while they approach each
    other, before one period is over.
    """
    return b2_is_where_it_does_not()


@claim("s2.2.1-dB2", "2.2.1", "line 125", printed=r"\tau_c = T", remark=CORNER_WITHOUT_A_TIME)
def line_between_b1_and_b2(printed: Printed) -> list[Statement]:
    """The line between B1 and B2, where the ball meets the table as the period ends, is where the
    time to collision is one period, wherever it is defined. Of the states of any height, those
    slower than that of the line are B1, and the others B2.
    """
    parted = iff(B1(b), v < u) & iff(B2(b), v >= u)
    return [
        line_of_equal_times(printed.formula(paper_names())),
        always(parted, given=[H(b), meet(T, Vector((beta, u)))], label="between"),
    ]


@claim("s2.2.1-dB2-in-B2", "2.2.1", "lines 125 and 137")
def line_belongs_to_b2() -> list[Statement]:
    """The states at which the time to collision is one period belong to B2, as do all that meet the
    table when the period ends.
    """
    return [
        always(
            B2(b),
            given=[H(b), different(v, r), equal(collision_time(b), T)],
            label="time-is-a-period",
        ),
        always(B2(b), given=[H(b), meet(T)], label="meets-at-the-end"),
    ]


def _beside_the_line(axis: Formula, side: Formula, inside: Formula) -> Assertion:
    """States of H on this axis and on this side of the state of the line at their height lie
    inside.
    """
    on_line = meet(T, Vector((beta, u)))
    return Assertion((always(inside, given=[axis, H(b), on_line, side]),))


PROBABLY_MISNAMED = Remark(
    "The axis is probably misnamed, and the edge of H is meant, the axis beta = 0: it is upright in"
    " Figure 6, so that the line, which meets it at the speed of the table, parts it into what is"
    " below and what is above. Both axes have the property.",
    lambda: always(iff(meet(T), equal(v, r)), given=[H(b), equal(beta, 0)], label="parts-the-edge"),
)


@claim(
    "s2.2.1-axis-below",
    "2.2.1",
    "line 137",
    printed=r"\dot{\overline{\beta}} = 0",
    remark=PROBABLY_MISNAMED,
)
def axis_below_the_line(printed: Printed) -> Readings:
    """What lies on the axis below the line between B1 and B2 belongs to B1: the axis of no speed as
    printed, or the edge of H.
    """
    return Readings(
        {
            "printed": Reading(
                _beside_the_line(printed.formula(paper_names()), v < u, B1(b)),
                "section 2.2.1 prints the axis so",
            ),
            "edge": Reading(
                _beside_the_line(equal(beta, 0), v < u, B1(b)),
                "section 2.2.1 says below and above, which part the edge of H in Figure 6",
            ),
        }
    )


@claim(
    "s2.2.1-axis-above",
    "2.2.1",
    "line 137",
    printed=r"\dot{\overline{\beta}} = 0",
    remark=PROBABLY_MISNAMED,
)
def axis_above_the_line(printed: Printed) -> Readings:
    """What lies on the axis above the line between B1 and B2 belongs to B2: the axis of no speed as
    printed, or the edge of H.
    """
    return Readings(
        {
            "printed": Reading(
                _beside_the_line(printed.formula(paper_names()), v > u, B2(b)),
                "section 2.2.1 prints the axis so",
            ),
            "edge": Reading(
                _beside_the_line(equal(beta, 0), v > u, B2(b)),
                "section 2.2.1 says below and above, which part the edge of H in Figure 6",
            ),
        }
    )


@claim("s2.2.1-flight-along-level", "2.2.1", "line 139")
def flight_follows_level_curves() -> list[Statement]:
    """In free flight the state stays on its curve of constant energy, and its speed falls
    steadily.
    """
    return [
        always(equal(energy(ball_at(t)), energy(b)), label="on-its-curve"),
        always(speed(ball_at(t)) < v, given=[t > 0], label="direction"),
    ]


@claim(
    "s2.2.1-B10",
    "2.2.1",
    "line 143",
    printed=(
        r"\mathcal{B}_1^0 := \{ \overline{b} \in \mathcal{B}_1 \mid \Delta E(\overline{b}) = 0 \}"
    ),
    as_it_stands=(
        r"\beta_1^0 := \{ \overline{b} \in \beta_1 \, \big| \, \Delta E(\overline{b}) = 0 \}"
    ),
)
def states_whose_impact_keeps_the_energy(printed: Printed) -> list[Statement]:
    """B1^0 holds those states of B1 whose impact leaves the energy as it was."""
    region = printed.set_predicate(
        paper_names().extended({r"\Delta E": impact_energy_change}), r"\mathcal{B}_1^0"
    )
    keeps = equal(energy(after_impact(t)), energy(ball_at(t)))
    return [
        always(iff(region(b), keeps), given=[H(b), strikes_at(t)], label="keeps-energy"),
        *strikes_from_region(region(b)),
    ]


@claim("s2.2.1-B10-parabolic", "2.2.1", "line 141")
def energy_is_kept_on_a_parabola() -> list[Statement]:
    """The states of B1 whose energy does not change lie on a curve that gives the height as a
    quadratic function of the speed.
    """
    d = real("d")

    def curve(at_speed: Term) -> Term:
        return term(at(derived("zero_change_height"), {"v": at_speed}))

    third = curve(v + 3 * d) - 3 * curve(v + 2 * d) + 3 * curve(v + d) - curve(v)
    return [
        always(
            iff(equal(energy(f1(b)), energy(b)), equal(beta, curve(v))),
            given=[B1(b)],
            label="curve",
        ),
        always(equal(third, 0), label="quadratic"),
        always(
            curve(v + d) - 2 * curve(v) + curve(v - d) < 0, given=[different(d, 0)], label="bent"
        ),
    ]


@claim("s2.2.1-energy-changes", "2.2.1", "line 141")
def impact_changes_the_energy_elsewhere() -> Statement:
    """From a state of B1 that is not in B1^0, the impact changes the energy."""
    return always(
        different(energy(after_impact(t)), energy(ball_at(t))),
        given=[B1(b), ~B1_ZERO(b), strikes_at(t)],
    )


# -------------------------------------------------------------------------------------------------
# Section 2.2.2: free flight under gravity, and the impact of two point masses.

d, rho, u, m = reals("d rho u m")
table = Vector((rho, u))  # the body that the ball hits, in any state


@claim("s2.2.2-newton", "2.2.2", "line 159", printed=r"\ddot{x} = -\gamma")
def newtons_equation(printed: Printed) -> list[Statement]:
    """In free flight the second derivative by time of what the print names is minus gravity, in
    each of its components.

    x is the state, as the sentence before says, and chi the position; the derivative is an exact
    difference quotient, since the flight is quadratic in time.
    """

    def second_derivative(index: int) -> Term:
        before, now, after = (term(ball_at(time).component(index)) for time in (t - d, t, t + d))
        return (after - 2 * now + before) / d**2

    def component(index: int) -> Statement:
        names = {r"\ddot{x}": second_derivative(index), r"\ddot\chi": second_derivative(1)}
        says = printed.formula(paper_names().extended(names))
        return always(says, given=[different(d, 0)], label=("position", "speed")[index - 1])

    return [component(1), component(2)]


@claim(
    "eq-1",
    "2.2.2",
    "(1)",
    printed=(
        r"F^{t}(x) = A_{t}x - a_{t} \\ A_{t} := \begin{bmatrix} 1 & t \\ 0 & 1 \end{bmatrix} \\ "
        r"a_{t} := \gamma t \begin{bmatrix} t/2 \\ 1 \end{bmatrix}"
    ),
)
def flight_is_affine(printed: Printed) -> list[Statement]:
    """The flight for any time t is affine in the state: a shear by t, less what gravity takes
    off.
    """
    here = paper_names().extended({"x": b})
    whole, matrix, offset = pieces(printed, 3)
    by_print = here.extended({"A_t": matrix.right(here), "a_t": offset.right(here)})
    return [
        always(whole.formula(by_print), label="flight"),
        always(matrix.formula(here) & offset.formula(here), label="parts"),
    ]


@claim("s2.2.2-group-law", "2.2.2", "lines 162 and 170")
def flights_join() -> list[Statement]:
    """To every time belongs one map of the plane: no flight for no time, and two flights in a row
    are one of the joint time.
    """
    joint = flight(d)(ball_at(t))
    return [
        always(equals(ball_at(0), b), label="no-time"),
        always(equals(joint, ball_at(t + d)), label="in-a-row"),
    ]


@claim(
    "eq-2",
    "2.2.2",
    "(2)",
    printed=r"\dot{\chi}' = \alpha\dot{\chi} \\ 0 < \alpha < 1 \\ \chi = x - y",
)
def relative_velocity_after_impact(printed: Printed) -> Statement:
    """The relative velocity after an impact is alpha times that before, for two bodies of any
    masses that meet, 0 < alpha < 1.

    The velocities after the impact keep the momentum and part the bodies at alpha times the speed
    at which they met.
    """
    law, values, relative = pieces(printed, 3)
    ball_speed, table_speed = map(term, derived_vector("speeds_after_impact"))
    names = reals("chi chi_dot chi_after chi_dot_after")
    before = relative.formula(
        paper_names().extended({"x": b, "y": table, r"\chi": Vector(names[:2])})
    )
    after = relative.formula(
        paper_names().extended(
            {
                "x": Vector((beta, ball_speed)),
                "y": Vector((rho, table_speed)),
                r"\chi": Vector(names[2:]),
            }
        )
    )
    says = law.formula(paper_names().extended({r"\dot\chi": names[1], r"\dot\chi'": names[3]}))
    return always(
        says,
        in_range=[values.formula(paper_names())],
        given=[m > 0, equal(beta, rho), v < u, before, after],
    )


@claim("s2.2.2-alpha-range", "2.2.2", "line 176", printed=r"0 < \alpha < 1")
def impact_rebounds_with_loss(printed: Printed) -> Statement:
    """Exactly for these values of alpha, bodies that approach each other part after the impact, and
    more slowly.
    """
    parting = speed(collide(table)(b)) - u
    return always(
        iff(printed.formula(paper_names()), conjunction([parting > 0, parting < u - v])),
        given=[v < u],
        in_range=[],
    )


@claim(
    "eq-3",
    "2.2.2",
    "(3)",
    printed=(
        r"C_{y}(x) = R_{\alpha} x + (I - R_{\alpha}) y \\ R_{\alpha} := \begin{bmatrix} 1 & 0 \\ 0"
        r" & -\alpha \end{bmatrix}"
    ),
    as_it_stands=r"C_{\nu}(x) = R_{\alpha} x + (I - R_{\alpha}) y \\ "
    r"R_{\alpha} := \begin{bmatrix} 1 & 0 \\ 0 & -\alpha \end{bmatrix}",
)
def impact_on_a_massive_body(printed: Printed) -> list[Statement]:
    """After an impact on a massive body the small one has its place still, and the velocity that
    restitution gives it.

    The massive body is slowed by at most (1 + alpha) m times the speed at which they met, m being
    the mass ratio.
    """
    here = paper_names().extended({"x": b, "y": table})
    whole, matrix = pieces(printed, 2)
    after = Vector(reals("after after_dot"))

    def struck(body: Vector) -> StateFunction[Vector]:
        if body != table:
            raise ShapeError("this map is known for the massive body of the claim only")
        return only_at(b, after)

    by_print = here.extended({r"R_\alpha": matrix.right(here), r"C_{\cdot}": struck})
    restitution = equal(speed(after) - u, -alpha * (v - u)) & equal(height(after), beta)
    slowed = u - term(derived_vector("speeds_after_impact").component(2))
    return [
        always(whole.formula(by_print), given=[restitution], label="new-state"),
        always(matrix.formula(here), label="matrix"),
        always(
            (slowed >= 0) & (slowed <= m * (1 + alpha) * (u - v)),
            given=[m >= 0, v < u],
            label="massive-body",
        ),
    ]


# -------------------------------------------------------------------------------------------------
# Section 2.3: the ball from one impact to the next, steered by the table's speed and the time of
# flight.

u1, u2, rho, rebound = reals("u1 u2 rho rebound")
control = Vector((u1, u2))
ball = Vector(reals("beta_before v_before"))  # just before an impact
parts_by_restitution = equal(
    rebound - u2, -alpha * (speed(ball) - u2)
)  # rebound: the ball's velocity just after the impact
just_before_the_next = ball_at(u1, Vector((height(ball), rebound)))


def _steered(state: Vector, steering: Vector) -> Vector:
    if (state, steering) != (ball, control):
        raise ShapeError("this function is known at the state and the control of the claim only")
    return just_before_the_next


@claim(
    "eq-4",
    "2.3",
    "(4)",
    printed=r"f(b, u) := F^{u_1} \circ C_{u_2}(b)",
    remark=Remark(
        "(3) defines C_y for a state y of the table; here its index is a velocity. It is restored"
        " as the velocity of a table at any height.",
        by=("eq-3",),
    ),
)
def next_state_by_control(printed: Printed) -> Statement:
    """The state just before the next impact: rebound off a table of velocity u_2 by the law of
    restitution, then free flight for u_1.

    C is given a velocity where (3) has a state: the table's height plays no part, whatever it is.
    """
    here = paper_names().extended(
        {
            "f": _steered,
            "b": ball,
            "u": control,
            "u_1": u1,
            "u_2": u2,
            r"C_{\cdot}": lambda velocity: StateFunction(collide(Vector((rho, velocity)))),
        }
    )
    return always(printed.formula(here), given=[parts_by_restitution])


@claim("s2.3-next-state", "2.3", "line 201")
def next_state_by_impact_and_flight() -> list[Statement]:
    """The state just before the next impact comes of a rebound and a flight, and so does the one
    after it, steered anew.
    """
    u3, u4, again = reals("u3 u4 again")
    once = derived_vector("controlled_step", "u", "t")

    def step(state: Vector, steering: Vector) -> Vector:
        return vector(
            at(
                once,
                {
                    "beta": height(state),
                    "v": speed(state),
                    "u": speed(steering),
                    "t": height(steering),
                },
            )
        )

    parts_again = equal(again - u4, -alpha * (speed(just_before_the_next) - u4))
    twice = ball_at(u3, Vector((height(just_before_the_next), again)))
    return [
        always(
            equals(step(ball, control), just_before_the_next),
            given=[parts_by_restitution],
            label="once",
        ),
        always(
            equals(step(step(ball, control), Vector((u3, u4))), twice),
            given=[parts_by_restitution, parts_again],
            label="twice",
        ),
    ]


@claim("s2.3-any-effect", "2.3", "line 206")
def every_effect_of_the_table_is_a_control() -> Statement:
    """Whatever velocity an impact leaves the ball with, and however long it then flies, some table
    velocity u_2 has that effect, so that the pair of both describes it.
    """
    step = flight(u1)(collide(Vector((rho, u2)))(ball))
    return exists_some(["u2"], equals(step, just_before_the_next))
