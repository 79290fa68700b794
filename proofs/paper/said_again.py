"""What the paper says in several places, in one formal reading: what B1 and B2 are, the line
between them, and the table's period.
"""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import Formula, different, equal, iff, real, term
from proofs.claims import Assertion, Readings
from proofs.paper.events import height, meet, strikes_at, table_at
from proofs.paper.vocabulary import (
    B1,
    B2,
    PAPER,
    STRIKES,
    H,
    T,
    always,
    b,
    collision_time,
    exists_some,
    r,
    t,
    v,
)
from proofs.reading.printed import Printed

flown = real("flown")  # a time since the launch of the table
LANDS = equal(height(table_at(flown)), 0)
IN_PERIOD = (t >= 0) & (t < T)


def strikes_from(inside: Formula) -> tuple[Statement, Statement]:
    """From a state inside, ball and table approach each other; and as they do, they meet at some
    time within the period.
    """
    return (
        always(v < r, given=[inside], label="approach"),
        exists_some(["t"], strikes_at(t), given=[inside, v < r], label="strikes"),
    )


def b1_is_where_the_ball_strikes() -> Readings:
    """From the states of B1, and no others in H, the ball strikes within a period: meets the table
    approaching, or merely meets it.
    """
    return Readings(
        {
            "approaching": Assertion(
                (
                    *strikes_from(B1(b)),
                    always(B1(b), given=[H(b), strikes_at(t)], label="only-these"),
                )
            ),
            "one-height": Assertion(
                (
                    *strikes_from(B1(b)),
                    always(B1(b), given=[H(b), IN_PERIOD, meet(t)], label="only-these"),
                )
            ),
        }
    )


def b2_is_where_it_does_not() -> Readings:
    """From no state of B2 does the ball strike within a period: meet the table approaching, or
    merely meet it.
    """
    return Readings(
        {
            "approaching": Assertion((always(~(meet(t) & (v < r)), given=[B2(b), IN_PERIOD]),)),
            "one-height": Assertion((always(~meet(t), given=[B2(b), IN_PERIOD]),)),
        }
    )


def line_of_equal_times(times_are_equal: Formula) -> Readings:
    """The times are equal where ball and table meet as the period ends.

    The line that these states make has a corner with the ball on the table and as fast as it, where
    the time to collision is not defined: the line is taken without it, or with it.
    """
    same = always(iff(times_are_equal, meet(T)), given=[H(b), different(v, r)], label="same-states")
    defined = always(different(v, r), given=[H(b), meet(T)], label="time-is-defined")
    return Readings(
        {"without-corner": Assertion((same,)), "with-corner": Assertion((same, defined))}
    )


def tells_b1(early: Formula) -> Statement:
    """In H, where the time to collision is defined, this says that the state is in the region B1 of
    (7).
    """
    return always(iff(early, STRIKES(b)), given=[H(b), different(v, r)])


def tells_b2(late: Formula) -> Statement:
    """In H, where the time to collision is defined, this says that the state is not in the region
    B1 of (7).
    """
    return always(iff(late, ~STRIKES(b)), given=[H(b), different(v, r)])


def is_the_period(printed: Printed) -> Statement:
    """After its launch the table is on the ground again exactly at the time that is printed for
    T.
    """
    return always(iff(LANDS, printed.formula(PAPER.extended({"T": flown}))), given=[flown > 0])


def b1_by_time_while_closing() -> list[Statement]:
    """Of the states of H, those with v < r and a time to collision below one period are B1, and no
    others are.
    """
    early = term(collision_time(b)) < T
    return [
        always(iff(B1(b), early), given=[H(b), v < r], label="closing"),
        always(~B1(b), given=[H(b), v >= r], label="not-closing"),
    ]


def b2_by_time_while_closing() -> list[Statement]:
    """Of the states of H, those with v >= r, and those with v < r and a time to collision of one
    period at least, are B2.
    """
    late = term(collision_time(b)) >= T
    return [
        always(iff(B2(b), late), given=[H(b), v < r], label="closing"),
        always(B2(b), given=[H(b), v >= r], label="not-closing"),
    ]


NEAR_B1 = (r"\tau_c < T \text{ and } \dot{\overline\beta} < \dot\rho_0", b1_by_time_while_closing)
NEAR_B2 = (
    r"T \le \tau_c \text{ or } \dot{\overline\beta} \ge \dot\rho_0",
    b2_by_time_while_closing,
)
