"""Section 3.3.1: periods without an impact, and the map f on all of H."""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import different, equal, real
from proofs.claims import Readings, claim
from proofs.paper.events import ball_at, height, meet, speed, table_at, vector
from proofs.paper.orbits import is_the_map, strikes_from
from proofs.paper.outside import pieces
from proofs.paper.said_again import NEAR_B2
from proofs.paper.vocabulary import (
    B1,
    B2,
    PAPER,
    STRIKES,
    H,
    T,
    always,
    b,
    beta,
    collide,
    equals,
    f1,
    f2,
    r,
    t,
    v,
)
from proofs.reading.notions import Region
from proofs.reading.printed import Printed
from proofs.reading.values import Vector

less = real("less")
ON_THE_LINE = (
    H(b) & meet(T) & (v < r)
)  # between B1 and B2, where the ball meets the table as it bounces


@claim(
    "s3.3.1-B2",
    "3.3.1",
    "lines 315 to 317",
    nearby=NEAR_B2,
    repeats="s2.2.1-B2",
    printed=r"\mathcal{B}_2 = \mathcal{H} - \mathcal{B}_1, \quad T \le \tau_c(\overline{b})",
    as_it_stands=r"\beta_2 = \mathcal{A} - \beta_1, \quad T \leq \tau_c(\overline{b})",
)
def states_outside_b1_meet_the_table_late(printed: Printed) -> list[Statement]:
    """The states of H outside B1 are those whose time to collision is one period at least."""
    difference, condition = pieces(printed, 2)
    late = Region(lambda state: H(state) & condition.formula(PAPER))
    return [
        always(
            condition.formula(PAPER),
            given=[difference.right(PAPER)(b), different(v, r)],
            label="late",
        ),
        always(
            difference.formula(PAPER.extended({r"\mathcal{B}_2": late})),
            given=[different(v, r)],
            label="all-that-are-late",
        ),
    ]


@claim(
    "eq-11",
    "3.3.1",
    "(11)",
    nearby=NEAR_B2,
    repeats="s2.2.1-B2",
    printed=r"\mathcal{B}_2 := \{ \overline{b} \in \mathcal{H} \mid T \le \tau_c(\overline{b}) \}",
    as_it_stands=r"\beta_2 := \{ \overline{b} \in \mathcal{A} \mid T \le \tau_c(\overline{b}) \}",
)
def second_region_by_the_time_to_collision(printed: Printed) -> list[Statement]:
    """The states of H whose time to collision is one period at least are those from which the ball
    does not strike within a period.
    """
    late = printed.set_predicate(PAPER, r"\mathcal{B}_2")
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
    after = printed.right(PAPER)
    return [
        always(
            printed.formula(PAPER.extended({r"\overline f_2": ball_at(t)})),
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
def map_on_all_of_h(printed: Printed) -> Readings:
    """The two cases give every state of H one image, which is the state when the table bounces
    next.
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
    """The map jumps between B1 and B2: from a state on the line to one that is ever so little
    slower, the image's speed jumps.

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
            equals(f1(b), vector(collide(table_at(T))(vector(f2(b))))),
            given=[meet(T)],
            label="cause",
        ),
    ]
