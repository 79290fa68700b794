"""Appendices B.1 and B.2: the time to collision, the table's period, and the regions, summed up."""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import Formula, different, equal, iff
from proofs.claims import Argument, Assertion, Readings, claim
from proofs.paper.events import ball_at, height, meet, only_at, speed, table_at
from proofs.paper.outside import pieces
from proofs.paper.said_again import (
    LANDS,
    NEAR_B1,
    NEAR_B2,
    b1_is_where_the_ball_strikes,
    b2_is_where_it_does_not,
    flown,
    is_the_period,
    line_of_equal_times,
    tells_b1,
    tells_b2,
)
from proofs.paper.vocabulary import PAPER, STRIKES, H, T, always, at, b, f1, f2, r, t, v
from proofs.reading.environment import Environment
from proofs.reading.printed import Printed

LAUNCH_SPEED = PAPER.extended({r"\dot\rho": r, r"\tau_c": only_at(b, t, factor=True)})
SPEED_THEN = LAUNCH_SPEED.extended({r"\dot\rho": speed(table_at(t))})
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
)
def collision_equation_with_gravity(printed: Printed) -> Readings:
    """The time to collision is the solution of this equation, the table's velocity being that of
    its launch.

    Read more strictly its sides are the heights of ball and table; or the table's velocity is that
    of the moment.
    """
    ball, table = height(ball_at(t)), height(table_at(t))
    heights = equal(ball, printed.left(LAUNCH_SPEED)) & equal(table, printed.right(LAUNCH_SPEED))
    return Readings(
        {
            "equation": Assertion(
                (always(iff(meet(t), printed.formula(LAUNCH_SPEED)), given=[t >= 0]),)
            ),
            "heights": Assertion(
                (always(heights & iff(meet(t), printed.formula(LAUNCH_SPEED)), given=[t >= 0]),)
            ),
            "speed-then": Assertion(
                (always(iff(meet(t), printed.formula(SPEED_THEN)), given=[t >= 0]),)
            ),
        }
    )


@claim(
    "sB.1-tau",
    "B.1",
    "line 736",
    printed=r"\tau_c = \frac{\overline{\beta}}{\dot{\rho} - \dot{\overline{\beta}}}",
)
def time_to_collision_again(printed: Printed) -> Readings:
    """Ball and table meet at this time and at no other, the table's velocity being that of its
    launch, or that of the moment.
    """

    def reading(names: Environment, *apart: Formula) -> Assertion:
        return Assertion(
            (always(iff(meet(t), printed.formula(names)), given=[t >= 0, different(v, r), *apart]),)
        )

    return Readings(
        {
            "launch-speed": reading(LAUNCH_SPEED),
            "speed-then": reading(SPEED_THEN, different(v, speed(table_at(t)))),
        }
    )


@claim("sB.1-period", "B.1", "line 740", printed=_PERIOD_EQUATION)
def period_solves_an_equation(printed: Printed) -> Statement:
    """The table is on the ground again when the nonzero solution of this equation has passed, its
    velocity being that of its launch.
    """
    return always(
        iff(LANDS, printed.formula(LAUNCH_SPEED.extended({"T": flown}))), given=[flown > 0]
    )


@claim("sB.1-so-that", "B.1", "line 742", printed=rf"{_PERIOD_EQUATION} \text{{so that}} {_PERIOD}")
def period_follows_from_the_equation(printed: Printed) -> Argument:
    """The printed period is the nonzero solution of the equation that is printed before it."""
    equation, period = pieces(printed, 2)
    names = LAUNCH_SPEED.extended({"T": flown})
    step = always(period.formula(names), given=[different(flown, 0), equation.formula(names)])
    return Argument(
        {"so-that": Assertion((step,))},
        conclusion=Assertion((is_the_period(period),)),
        rescue="s3.1-T",
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
    region = printed.set_predicate(PAPER, r"\mathcal{H}")
    return [
        always(iff(region(b), height(ball_at(0)) >= height(table_at(0))), label="at-or-above"),
        always(at(region(b), f1(b)), given=[region(b), STRIKES(b)], label="kept-with-impact"),
        always(at(region(b), f2(b)), given=[region(b), ~STRIKES(b)], label="kept-without-impact"),
    ]


@claim("sB.2-B1-less", "B.2", "line 752", repeats="s2.2.1-B1-strikes")
def b1_strikes_in_less_than_a_period() -> Readings:
    """From the states of B1, and from no others in H, the ball strikes the table in less than one
    period.

    To strike can mean to meet while approaching, or merely to be at one height.
    """
    return b1_is_where_the_ball_strikes()


@claim(
    "sB.2-B1",
    "B.2",
    "line 754",
    nearby=NEAR_B1,
    printed=r"\mathcal{B}_1 := \{ \overline{b} \in \mathcal{H} \mid \tau_c < T \}",
    as_it_stands=r"\beta_1 := \{ \overline{b} \in \mathcal{A} \mid \tau_c < T \}",
)
def b1_by_time_to_collision(printed: Printed) -> Statement:
    """Where the time to collision is defined, the states of H at which it is less than one period
    are the region B1 of (7).
    """
    return tells_b1(printed.set_predicate(PAPER, r"\mathcal{B}_1")(b))


@claim("sB.2-B2-atleast", "B.2", "line 756", repeats="s2.2.1-B2-no-strike")
def b2_strikes_in_a_period_at_least() -> Readings:
    """From no state of B2 does the ball strike the table in less than one period.

    To strike can mean to meet while approaching, or merely to be at one height.
    """
    return b2_is_where_it_does_not()


@claim(
    "sB.2-B2",
    "B.2",
    "line 758",
    nearby=NEAR_B2,
    printed=r"\mathcal{B}_2 := \{ \overline{b} \in \mathcal{H} \mid \tau_c \ge T \}",
    as_it_stands=r"\beta_2 := \{ \overline{b} \in \mathcal{A} \mid \tau_c \ge T \}",
    repeats="s2.2.1-B2",
)
def b2_by_time_to_collision(printed: Printed) -> Statement:
    """Where the time to collision is defined, the states of H at which it is one period or more are
    what B1 leaves of H.
    """
    return tells_b2(printed.set_predicate(PAPER, r"\mathcal{B}_2")(b))


@claim(
    "sB.2-dB2",
    "B.2",
    "line 762",
    printed=r"\partial\mathcal{B}_2 := \{ \overline{b} \in \mathcal{H} \mid \tau_c = T \}",
    as_it_stands=r"\partial\mathcal{B}_2 := \{ \overline{b} \in \mathcal{A} \mid \tau_c = T \}",
    repeats="s2.2.1-dB2",
)
def line_between_the_regions(printed: Printed) -> Readings:
    """The line between B1 and B2, where the ball meets the table as the period ends, holds the
    states whose time is one period.
    """
    return line_of_equal_times(printed.set_predicate(PAPER, r"\partial\mathcal{B}_2")(b))


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
    return always(iff(printed.formula(PAPER), H(b) & meet(T)))
