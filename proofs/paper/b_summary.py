"""Appendix B: the regions, maps, points and names of the paper, summed up."""

from __future__ import annotations

from juggleproof.judging.claims import Argument, Assertion, Following
from juggleproof.proofs.paper.names import (
    B1,
    B1_ZERO,
    B2,
    STRIKES,
    H,
    R,
    T,
    after_impact,
    always,
    at,
    b,
    ball_at,
    beta,
    claim,
    collide,
    derived,
    energy,
    eps,
    equals,
    f1,
    f2,
    flight,
    flight_matrix,
    flight_offset,
    height,
    meet,
    only_at,
    paper_names,
    r,
    same_set,
    speed,
    strikes_at,
    t,
    table_at,
    v,
    value_of,
    vector,
)
from juggleproof.proofs.paper.regions import ATTRACTION, is_boundary_of_R, pieces, v0
from juggleproof.proofs.paper.states import (
    CORNER_WITHOUT_A_TIME,
    LANDS,
    NEAR_B1,
    NEAR_B2,
    STABILITY,
    b1_is_where_the_ball_strikes,
    b2_is_where_it_does_not,
    b_0,
    is_fixed_point,
    is_the_map,
    is_the_period,
    lies_around_e_1,
    line_of_equal_times,
    narrow_band_stays,
    next_bounce,
    offset_with,
    since_launch,
    strikes_from,
    strikes_from_region,
    tells_b1,
    tells_b2,
)
from juggleproof.reading.meaning import Printed
from juggleproof.reading.values import (
    Matrix,
    ShapeError,
    StateFunction,
    Value,
    Vector,
    scalar,
)
from juggleproof.statements.language import Statement, different, equal, iff, reals

# -------------------------------------------------------------------------------------------------
# Appendices B.1 and B.2: the time to collision, the table's period, and the regions, summed up.

# The time to collision and the table's velocity: as \dot\rho is the velocity of the moment.
MOMENT = paper_names().extended(
    {r"\dot\rho": speed(table_at(t)), r"\tau_c": only_at(b, t, factor=True)}
)
LAUNCH_SPEED = paper_names().extended({r"\dot\rho": r})
_PERIOD_EQUATION = r"0 = \dot{\rho}T - \gamma T^2"
_PERIOD = r"T = \frac{2\dot{\rho}_0}{\gamma}"


@claim(
    "sB.1-collision",
    "B.1",
    "line 732",
    printed=(
        r"\overline{\beta} + \dot{\overline{\beta}}\tau_c - \gamma\tau_c^2 = \dot{\rho}\tau_c -"
        r" \gamma\tau_c^2"
    ),
    mended=(
        r"\overline{\beta} + \dot{\overline{\beta}}\tau_c - \frac{1}{2}\gamma\tau_c^2 ="
        r" \dot{\rho}_0\tau_c - \frac{1}{2}\gamma\tau_c^2"
    ),
)
def collision_equation_with_gravity(printed: Printed) -> list[Statement]:
    """The time to collision is the solution of this equation, whose sides are the heights of ball
    and table.
    """
    sides = zip((ball_at(t), table_at(t)), (printed.left(MOMENT), printed.right(MOMENT)))
    return [
        always(iff(meet(t), printed.formula(MOMENT)), given=[t >= 0], label="equation"),
        *(
            always(equal(height(body), scalar(side)), given=[t >= 0], label=label)
            for label, (body, side) in zip(("ball", "table"), sides)
        ),
    ]


@claim(
    "sB.1-tau",
    "B.1",
    "line 736",
    printed=r"\tau_c = \frac{\overline{\beta}}{\dot{\rho} - \dot{\overline{\beta}}}",
)
def time_to_collision_again(printed: Printed) -> Statement:
    """Ball and table meet at this time and at no other."""
    apart = [different(v, speed(table_at(t)))] if r"\dot{\rho}" in printed.names else []
    return always(iff(meet(t), printed.formula(MOMENT)), given=[t >= 0, different(v, r), *apart])


@claim(
    "sB.1-period",
    "B.1",
    "line 740",
    printed=_PERIOD_EQUATION,
    mended=r"0 = \dot{\rho}_0 T - \frac{1}{2}\gamma T^2",
)
def period_solves_an_equation(printed: Printed) -> Statement:
    """The table is on the ground again when the nonzero solution of this equation has passed."""
    names = paper_names().extended({r"\dot\rho": speed(table_at(since_launch)), "T": since_launch})
    return always(iff(LANDS, printed.formula(names)), given=[since_launch > 0])


@claim("sB.1-so-that", "B.1", "line 742", printed=rf"{_PERIOD_EQUATION} \text{{so that}} {_PERIOD}")
def period_follows_from_the_equation(printed: Printed) -> Argument:
    """The printed period is the nonzero solution of the equation that is printed before it."""
    equation, period = pieces(printed, 2)
    names = LAUNCH_SPEED.extended({"T": since_launch})
    step = always(
        period.formula(names), given=[different(since_launch, 0), equation.formula(names)]
    )
    return Argument(
        {"so-that": Assertion((step,))},
        conclusion=Assertion((is_the_period(period),)),
        proved_by="s3.1-T",
    )


@claim("sB.1-T", "B.1", "line 744", printed=_PERIOD, repeats="s3.1-T")
def period_again(printed: Printed) -> Statement:
    """After its launch the table is on the ground again exactly when T has passed."""
    return is_the_period(printed)


@claim(
    "sB.2-H",
    "B.2",
    "line 750",
    printed=r"\mathcal{H} := \{ \overline{b} \mid \overline{\beta} \ge 0 \}",
    as_it_stands=r"\mathcal{A} := \{ \overline{b} \mid \overline{\beta} \ge 0 \}",
)
def states_with_a_meaning(printed: Printed) -> list[Statement]:
    """H is the set of states with the ball at or above the table at its lowest, and no state leaves
    it within a period.
    """
    region = printed.set_predicate(paper_names(), r"\mathcal{H}")
    return [
        always(iff(region(b), height(ball_at(0)) >= height(table_at(0))), label="at-or-above"),
        always(at(region(b), f1(b)), given=[region(b), STRIKES(b)], label="kept-with-impact"),
        always(at(region(b), f2(b)), given=[region(b), ~STRIKES(b)], label="kept-without-impact"),
    ]


@claim("sB.2-B1-less", "B.2", "line 752", repeats="s2.2.1-B1-strikes")
def b1_strikes_in_less_than_a_period() -> list[Statement]:
    """From the states of B1, and from no others in H, the ball strikes the table, meeting it while
    they approach each other, in less than one period.
    """
    return b1_is_where_the_ball_strikes()


@claim(
    "sB.2-B1",
    "B.2",
    "line 754",
    true_nearby=NEAR_B1,
    printed=r"\mathcal{B}_1 := \{ \overline{b} \in \mathcal{H} \mid \tau_c < T \}",
    as_it_stands=r"\beta_1 := \{ \overline{b} \in \mathcal{A} \mid \tau_c < T \}",
)
def b1_by_time_to_collision(printed: Printed) -> Statement:
    """Where the time to collision is defined, the states of H at which it is less than one period
    are the region B1 of (7).
    """
    return tells_b1(printed.set_predicate(paper_names(), r"\mathcal{B}_1")(b))


@claim("sB.2-B2-atleast", "B.2", "line 756", repeats="s2.2.1-B2-no-strike")
def b2_strikes_in_a_period_at_least() -> list[Statement]:
    """From the states of B2, and no others in H, the ball does not strike the table, meeting it
    while they approach each other, in less than one period; later it does, having to come down.
    """
    below = height(ball_at(t)) < 0
    return [
        b2_is_where_it_does_not(),
        *strikes_from_region(H(b) & ~B2(b)),
        always(below, given=[H(b), t >= T, r * t > beta + v * T], label="comes-down"),
    ]


@claim(
    "sB.2-B2",
    "B.2",
    "line 758",
    true_nearby=NEAR_B2,
    printed=r"\mathcal{B}_2 := \{ \overline{b} \in \mathcal{H} \mid \tau_c \ge T \}",
    as_it_stands=r"\beta_2 := \{ \overline{b} \in \mathcal{A} \mid \tau_c \ge T \}",
    repeats="s2.2.1-B2",
)
def b2_by_time_to_collision(printed: Printed) -> Statement:
    """Where the time to collision is defined, the states of H at which it is one period or more are
    what B1 leaves of H.
    """
    return tells_b2(printed.set_predicate(paper_names(), r"\mathcal{B}_2")(b))


@claim(
    "sB.2-dB2",
    "B.2",
    "line 762",
    printed=r"\partial\mathcal{B}_2 := \{ \overline{b} \in \mathcal{H} \mid \tau_c = T \}",
    as_it_stands=r"\partial\mathcal{B}_2 := \{ \overline{b} \in \mathcal{A} \mid \tau_c = T \}",
    repeats="s2.2.1-dB2",
    remark=CORNER_WITHOUT_A_TIME,
)
def line_between_the_regions(printed: Printed) -> list[Statement]:
    """The line between B1 and B2, where the ball meets the table as the period ends, holds the
    states whose time is one period, wherever it is defined; at each height B1 is what is slower.
    """
    beside, line = Vector((beta, v0)), [H(b), meet(T)]
    return [
        line_of_equal_times(printed.set_predicate(paper_names(), r"\partial\mathcal{B}_2")(b)),
        always(iff(B1(beside), v0 < v) & iff(B2(beside), v0 >= v), given=line, label="between"),
    ]


@claim(
    "sB.2-line",
    "B.2",
    "line 766",
    printed=(
        r"\overline{b} = \begin{bmatrix} 1 \\ -\frac{1}{T} \end{bmatrix} \overline{\beta} + r_0,"
        r" \qquad \overline{\beta} \ge 0"
    ),
    as_it_stands=(
        r"\dot{\overline{\beta}} = \begin{bmatrix} 1 \\ -\frac{1}{T} \end{bmatrix} \overline{\beta}"
        r" + r_0, \qquad \beta \ge 0"
    ),
    repeats="eq-29",
)
def line_by_its_height(printed: Printed) -> Statement:
    """The states of H that meet the table as the period ends are these, one for each height."""
    return always(iff(printed.formula(paper_names()), H(b) & meet(T)))


# -------------------------------------------------------------------------------------------------
# Appendices B.3 to B.6: the maps, the fixed point, the zero energy change boundary and the boundary
# of R, summed up.

u, y, tau, greatest, gain, margin = reals("u y tau greatest gain margin")


@claim(
    "sB.3-f1",
    "B.3",
    "lines 772 to 778",
    repeats="eq-10",
    printed=(
        r"""\overline{f}_1(\overline{b}_k) := \alpha A_T \overline{b}_k"""
        r""" + (\alpha - 1) A_{-\xi_1} r_0 = \overline{b}_{k+1} \\
       A_t := \begin{bmatrix} 1 & t \\ 0 & 1 \end{bmatrix} \\ \xi_1 := \frac{\alpha T}{1-\alpha}."""
    ),
)
def map_on_b1_again(printed: Printed) -> list[Statement]:
    """After an impact the state when the table bounces next is this affine image, with these
    meanings of A_t and xi_1.
    """
    map_, matrix, time = pieces(printed, 3)
    names = {r"\overline b_k": b_0, r"\overline b_{k+1}": next_bounce(b_0, tau)}
    return [
        always(
            map_.formula(paper_names().extended(names)), given=[strikes_from(b_0, tau)], label="map"
        ),
        always(matrix.formula(paper_names()), label="matrix"),
        always(
            iff(
                equals(offset_with(u), f1(Vector((0, 0)))),
                time.formula(paper_names().extended({r"\xi_1": u})),
            ),
            label="time",
        ),
    ]


@claim(
    "sB.3-f2",
    "B.3",
    "line 783",
    repeats="eq-12",
    printed=r"\overline{f}_1(\overline{b}_k) := -A_T x - \alpha_T",
    mended=r"\overline{f}_2(\overline{b}_k) := A_T \overline{b}_k - \alpha_T",
)
def map_on_b2_again(printed: Printed) -> Statement:
    """The dynamics on B2, which have to be what free flight makes of a state until the next bounce.

    f1 is the map of an impact, as the section has it; x, which it does not introduce, is taken for
    the state.
    """
    names: dict[str, Value] = {
        r"\overline f_2": StateFunction(lambda state: ball_at(t, state)),
        r"\overline b_k": b_0,
        "x": b_0,
        r"\alpha_T": flight_offset(T),
    }
    return always(
        printed.formula(paper_names().extended(names)),
        given=[B2(b_0), t > 0, equal(height(table_at(t)), 0)],
    )


@claim(
    "sB.3-aT",
    "B.3",
    "line 785",
    repeats="eq-1",
    printed=r"\alpha_T := \gamma T \begin{bmatrix} T/2 \\ 1 \end{bmatrix}",
)
def what_gravity_takes_off_in_a_period(printed: Printed) -> Statement:
    """This column, and no other, is what a period of flight falls short of its linear part."""
    column = Vector((y, u))
    falls_short = equals(ball_at(T), vector(flight_matrix(T) * b) - column)
    return always(iff(falls_short, printed.formula(paper_names().extended({r"\alpha_T": column}))))


@claim(
    "sB.3-f",
    "B.3",
    "line 789",
    repeats="eq-13",
    printed=(
        r"\overline{f} := \left\{ \begin{array}{ll} \overline{f}_1 & : \overline{b} \in"
        r" \mathcal{B}_1 \\ "
        r"\overline{f}_2 & : \overline{b} \in \mathcal{B}_2 \end{array} \right."
    ),
)
def map_on_all_of_h_again(printed: Printed) -> list[Statement]:
    """The two cases give every state of H one image, which is the state when the table bounces
    next, B2 being what B1 leaves of H.
    """
    return is_the_map(printed)


@claim(
    "sB.4-e1",
    "B.4",
    "line 795",
    repeats="s3.3-e1",
    printed=r"e_1 = \begin{bmatrix} \frac{4\alpha\dot{\rho}_0^2}{(1+\alpha)^2\gamma} \\ "
    r"\frac{-1(1-\alpha)\dot{\rho}_0}{1+\alpha} \end{bmatrix}",
)
def fixed_point_again(printed: Printed) -> Statement:
    """The fixed point of f1 has this height and this speed."""
    return is_fixed_point(printed)


@claim(
    "sB.5-B10",
    "B.5",
    "line 801",
    repeats="eq-22",
    printed=r"\mathcal{B}_1^0 := \{ \overline{b} \in \mathcal{H} \mid "
    r"\dot{\overline{\beta}} = \gamma\tau_c - \frac{1+\alpha}{1-\alpha}(\dot{\rho}_0 -"
    r" \gamma\tau_c) \}",
    as_it_stands=r"\mathcal{B}_{1}^{0}:=\left\{ \overline{b}\in\mathcal{A}\,\big|\,\, "
    r"\dot{\overline{\beta}}=\gamma\tau_{c}-\frac{1+\alpha}{1-\alpha}\,(\dot{\rho}_{0}-\gamma\tau_{c})\right\}",
)
def states_without_energy_change_again(printed: Printed) -> list[Statement]:
    """The states of B1 whose image has the same energy are those of H whose speed and time to
    collision meet this equation.
    """
    region = printed.set_predicate(paper_names(), r"\mathcal{B}_1^0")
    return same_set(region(b), B1_ZERO(b), given=[different(v, r)])


@claim("sB.6-boundary", "B.6", "line 807", printed=r"R(\overline{b}) = 0", repeats="sA.4-boundary")
def boundary_of_the_region(printed: Printed) -> list[Statement]:
    """The states of R next to which in H, however near, lie states outside R, are those at which
    the function R vanishes.
    """
    return is_boundary_of_R(printed.formula(paper_names()))


@claim(
    "sB.6-R",
    "B.6",
    "line 811",
    repeats="eq-23b",
    printed=(
        r"""R(\overline{b}) := E_{max} + \Delta E_{max} - E(\overline{b})
       = \frac{1+\alpha}{(1-\alpha)^2} \dot{\rho}_0^2 - \gamma \overline{\beta}"""
        r""" - \frac{1}{2} \dot{\overline{\beta}}^2"""
    ),
)
def function_of_the_region_again(printed: Printed) -> Statement:
    """R(b) is what the energy of a state lacks to the sum of both bounds, in height and speed."""
    names: dict[str, Value] = {
        "R": only_at(b, margin),
        "E_{max}": greatest,
        r"\Delta E_{max}": gain,
    }
    known = (
        equal(greatest, derived("E_max"))
        & equal(gain, derived("delta_E_max"))
        & equal(margin, derived("region_margin"))
    )
    return always(printed.formula(paper_names().extended(names)), given=[known])


# -------------------------------------------------------------------------------------------------
# Appendix B.7: what the table of notation says beyond naming a symbol.

since, until = reals("since until")


@claim("sB.7-T", "B.7", "line 824", printed=r"T := 2\dot{\rho}_0/\gamma", repeats="s3.1-T")
def period_in_the_table(printed: Printed) -> Statement:
    """After its launch the table is on the ground again exactly when T has passed."""
    return is_the_period(printed)


@claim("sB.7-tau-p", "B.7", "line 828", repeats="s3.1-note3")
def time_since_the_lowest_point() -> Statement:
    """The time since a period began is the time since the table was last at its lowest: it was
    higher ever since.
    """
    return always(height(table_at(t)) > height(table_at(0)), given=[t > 0, t <= since, since < T])


@claim("sB.7-b-bar", "B.7", "line 835", printed=r"(\overline{\beta}, \dot{\beta})")
def sampled_state_in_the_table(printed: Printed) -> Statement:
    """The pair is the ball's position and velocity as the table is at its lowest; without a bar the
    velocity is that of any time.
    """
    names = paper_names().extended({r"\dot\beta": speed(ball_at(t))})
    return always(equals(vector(value_of(printed, names)), ball_at(0)))


@claim("sB.7-C", "B.7", "line 844", printed="C_{y}(x)")
def impact_in_the_table(printed: Printed) -> Statement:
    """In the notation of (3), this is the ball's state after an impact if y is the ball's state
    before it and x the table's.
    """
    table = Vector(reals("rho u"))
    names = paper_names().extended({"y": b, "x": table})
    return always(
        equals(vector(value_of(printed, names)), vector(collide(table)(b))),
        given=[equal(height(table), beta)],
    )


@claim(
    "sB.7-bar-tau",
    "B.7",
    "line 847",
    printed=r"\overline{\tau}_c = T - \tau_c",
    as_it_stands=r"-\tau_c = T - \tau_c",
)
def time_until_the_next_period(printed: Printed) -> Statement:
    """After a collision, the time that is left until the table next touches the ground is one
    period less the time to collision.
    """
    names = paper_names().extended({r"\tau_c": only_at(b, t), r"\overline\tau_c": until})
    lands = equal(height(flight(until)(table_at(t))), 0)
    return always(iff(lands, printed.formula(names)), given=[H(b), strikes_at(t), until > 0])


@claim(
    "sB.7-A",
    "B.7",
    "line 848",
    printed=r"A_{t} := \begin{bmatrix} 1 & t \\ 0 & 1 \end{bmatrix}",
    repeats="eq-1",
)
def flight_matrix_in_the_table(printed: Printed) -> list[Statement]:
    """The matrix carries the difference of two states through a flight of time t, in which gravity
    cancels.
    """
    other = Vector(reals("beta0 v0"))
    matrix = printed.right(paper_names())
    if not isinstance(matrix, Matrix):
        raise ShapeError("a matrix was expected")
    return [
        always(
            equals(vector(matrix * (b - other)), ball_at(t) - ball_at(t, other)), label="difference"
        ),
        always(printed.formula(paper_names()), label="matrix"),
    ]


@claim(
    "sB.7-E",
    "B.7",
    "line 849",
    printed=r"E(\overline{b}) := \gamma\overline{\beta} + \frac{1}{2}\dot{\overline{\beta}}^2",
    repeats="eq-14",
)
def energy_in_the_table(printed: Printed) -> Statement:
    """The energy is what flight keeps: weight by height, and half the squared velocity."""
    return always(printed.formula(paper_names()))


@claim(
    "sB.7-DE",
    "B.7",
    "line 850",
    printed=r"\Delta E(\overline{b}) := E(f(\overline{b}))^2 - E(\overline{b})",
    as_it_stands=r"\Delta E(b) := E(f(b))^2 - E(b)",
)
def energy_change_in_the_table(printed: Printed) -> Statement:
    """The change of energy at an impact is the energy of the next state less that of this one."""
    change = energy(after_impact(t)) - energy(ball_at(t))
    names = paper_names().extended({"f": f1, r"\Delta E": only_at(b, change)})
    return always(printed.formula(names), given=[H(b), strikes_at(t)])


@claim(
    "sB.7-K",
    "B.7",
    "line 851",
    printed=r"K(\overline{b}) := \frac{1}{2}\dot{\overline{\beta}}^2",
    repeats="eq-28",
)
def kinetic_energy_in_the_table(printed: Printed) -> Statement:
    """The kinetic energy is the part of the energy that the ball would not have at rest at its
    height.
    """
    moving = StateFunction(lambda state: energy(state) - energy(Vector((state.component(1), 0))))
    return always(printed.formula(paper_names().extended({"K": moving})))


@claim("sB.7-B1", "B.7", "line 854", true_nearby=NEAR_B1, printed=r"\tau_c < T", repeats="sB.2-B1")
def b1_in_the_table(printed: Printed) -> Statement:
    """Where the time to collision is defined, the states of H at which it is less than one period
    are the region B1 of (7).
    """
    return tells_b1(printed.formula(paper_names()))


@claim(
    "sB.7-B2", "B.7", "line 855", true_nearby=NEAR_B2, printed=r"\tau_c \ge T", repeats="s2.2.1-B2"
)
def b2_in_the_table(printed: Printed) -> Statement:
    """Where the time to collision is defined, the states of H at which it is one period or more are
    what B1 leaves of H.
    """
    return tells_b2(printed.formula(paper_names()))


@claim("sB.7-R", "B.7", "line 856", repeats="prop-1")
def region_r_in_the_table() -> Following:
    """Every orbit is attracted to R; once in it, it stays."""
    return Following(
        ATTRACTION,
        beside=Assertion(
            (
                always(R(f1(b)), given=[R(b), STRIKES(b)], label="with-impact"),
                always(R(f2(b)), given=[R(b), ~STRIKES(b)], label="without-impact"),
            )
        ),
    )


@claim("sB.7-K-region", "B.7", "line 857", repeats="s4.3.2-K-attracts")
def region_k_in_the_table() -> Following:
    """Every orbit is attracted to the region K, and stays in it, if K is narrow."""
    return Following(STABILITY, Assertion((lies_around_e_1(eps), *narrow_band_stays(eps))))
