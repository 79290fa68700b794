"""Section 2.2.1: the regions H, B1 and B2, the line between them, and the curve on which an impact
keeps the energy.
"""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import Formula, Term, different, equal, iff, real, term
from proofs.claims import Assertion, Readings, claim
from proofs.paper.events import (
    after_impact,
    as_region,
    ball_at,
    height,
    meet,
    speed,
    strikes_at,
    table_at,
)
from proofs.paper.outside import pieces
from proofs.paper.said_again import (
    NEAR_B2,
    b1_is_where_the_ball_strikes,
    b2_is_where_it_does_not,
    line_of_equal_times,
    strikes_from,
)
from proofs.paper.vocabulary import (
    B1,
    B1_ZERO,
    B2,
    PAPER,
    STRIKES,
    H,
    T,
    always,
    at,
    b,
    beta,
    collision_time,
    derived,
    energy,
    f1,
    f2,
    impact_energy_change,
    r,
    t,
    v,
)
from proofs.reading.printed import Printed
from proofs.reading.values import Vector

u = real("u")  # the speed at which the line between B1 and B2 passes the height of the state


@claim("s2.2.1-H", "2.2.1", "line 123", printed=r"\overline{\beta} > 0")
def states_on_or_above_the_table(printed: Printed) -> list[Statement]:
    """H is the set of states with the ball on or above the table at its lowest, and no state leaves
    it within a period.
    """
    inside = printed.formula(PAPER)
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
)
def time_to_collision_tells_b1(printed: Printed) -> Readings:
    """In H, the time to collision lies in the first period exactly on the region B1 of (7).

    H is printed both without and with its edge, where the ball is level with the table.
    """

    def reading(in_h: Formula) -> Assertion:
        return Assertion(
            (
                always(
                    iff(printed.formula(PAPER), STRIKES(b)),
                    given=[in_h, different(v, r)],
                    label="same-states",
                ),
                always(different(v, r), given=[in_h, STRIKES(b)], label="time-is-defined"),
            )
        )

    return Readings({"without-edge": reading(beta > 0), "with-edge": reading(beta >= 0)})


@claim("s2.2.1-B1-strikes", "2.2.1", "line 125")
def b1_strikes_within_a_period() -> Readings:
    """From the states of B1, and from no others in H, the ball strikes the table before one period
    is over.

    To strike can mean to meet while approaching, or merely to be at one height.
    """
    return b1_is_where_the_ball_strikes()


@claim(
    "s2.2.1-B2",
    "2.2.1",
    "line 125",
    nearby=NEAR_B2,
    printed=r"\mathcal{B}_2 = \mathcal{H} - \mathcal{B}_1, \quad T \le \tau_c",
    as_it_stands=r"\mathcal{H} - \mathcal{B}_1 \ (T \le \tau_c)",
)
def time_to_collision_tells_b2(printed: Printed) -> list[Statement]:
    """B2 is what B1 leaves of H, and there the time to collision is one period at least."""
    difference, condition = pieces(printed, 2)
    rest, late = as_region(difference.right(PAPER)), condition.formula(PAPER)
    return [
        always(difference.formula(PAPER), label="what-is-left"),
        always(late, given=[rest(b), different(v, r)], label="late"),
        always(rest(b), given=[H(b), different(v, r), late], label="all-that-are-late"),
    ]


@claim("s2.2.1-B2-no-strike", "2.2.1", "line 125")
def b2_does_not_strike_within_a_period() -> Readings:
    """From no state of B2 does the ball strike the table before one period is over.

    To strike can mean to meet while approaching, or merely to be at one height.
    """
    return b2_is_where_it_does_not()


@claim("s2.2.1-dB2", "2.2.1", "line 125", printed=r"\tau_c = T")
def line_between_b1_and_b2(printed: Printed) -> Readings:
    """The line between B1 and B2, where the ball meets the table as the period ends, is where the
    time to collision is one period.

    Its lower end, with the ball on the table and as fast as it, has no time to collision: with it,
    or without.
    """
    return line_of_equal_times(printed.formula(PAPER))


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


@claim("s2.2.1-axis-below", "2.2.1", "line 137", printed=r"\dot{\overline{\beta}} = 0")
def axis_below_the_line(printed: Printed) -> Readings:
    """What lies on the axis below the line between B1 and B2 belongs to B1: the axis of no speed as
    printed, or the edge of H.
    """
    return Readings(
        {
            "printed": _beside_the_line(printed.formula(PAPER), v < u, B1(b)),
            "edge": _beside_the_line(equal(beta, 0), v < u, B1(b)),
        }
    )


@claim("s2.2.1-axis-above", "2.2.1", "line 137", printed=r"\dot{\overline{\beta}} = 0")
def axis_above_the_line(printed: Printed) -> Readings:
    """What lies on the axis above the line between B1 and B2 belongs to B2: the axis of no speed as
    printed, or the edge of H.
    """
    return Readings(
        {
            "printed": _beside_the_line(printed.formula(PAPER), v > u, B2(b)),
            "edge": _beside_the_line(equal(beta, 0), v > u, B2(b)),
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
        PAPER.extended({r"\Delta E": impact_energy_change}), r"\mathcal{B}_1^0"
    )
    keeps = equal(energy(after_impact(t)), energy(ball_at(t)))
    return [
        always(iff(region(b), keeps), given=[H(b), strikes_at(t)], label="keeps-energy"),
        *strikes_from(region(b)),
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
