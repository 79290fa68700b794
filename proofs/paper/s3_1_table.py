"""Section 3 and 3.1: the table, a point mass that bounces on the ground without loss."""

from __future__ import annotations

from dataclasses import replace

from certificates.statements import Statement
from certificates.terms import Formula, Term, different, equal, iff, real, reals
from proofs.claims import claim
from proofs.paper.events import height, meet, speed, table_at, vector
from proofs.paper.said_again import is_the_period
from proofs.paper.vocabulary import (
    B1,
    B2,
    PAPER,
    STANDING,
    H,
    T,
    alpha,
    always,
    at,
    b,
    beta,
    collide,
    collision_time,
    energy,
    equals,
    f1,
    f2,
    g,
    r,
    r_0,
    t,
    v,
)
from proofs.reading.printed import Printed
from proofs.reading.values import Vector

n, since = reals("n since")  # a number of periods, and the time since the last of them began
WITH_INTEGER_N = replace(STANDING, integers=frozenset({"n"}))
IN_PERIOD = (since >= 0) & (since < T)
GROUND = Vector((0, 0))


@claim("s3.0-closed-form", "3", "line 220")
def time_to_collision_is_rational() -> Statement:
    """While their speeds differ, ball and table meet at one time only, and a quotient of
    polynomials gives it.
    """
    return always(iff(meet(t), equal(t, collision_time(b))), given=[different(v, r)])


@claim("s3.0-velocity-jumps", "3", "line 220")
def table_velocity_jumps_and_so_does_the_map() -> list[Statement]:
    """The table's velocity jumps as it bounces, and so does the image of a state that meets it then
    while they approach.

    However little slower another state is, its image is faster by (1 + alpha) times the closing
    speed at least.
    """
    less = real("less")
    slower = Vector((beta, v - less))
    jump = speed(vector(f1(slower))) - speed(vector(f2(b)))
    return [
        always(equal(height(table_at(T)), height(r_0)), label="returns"),
        always(speed(r_0) - speed(table_at(T)) > 0, label="velocity"),
        always(
            B1(slower) & (jump >= (1 + alpha) * (r - v)) & B2(b),
            given=[H(b), meet(T), v < r, less > 0],
            label="map",
        ),
    ]


@claim("s3.1-lossless", "3.1", "line 224")
def lossless_bounce_has_restitution_one() -> list[Statement]:
    """A bounce off the ground at rest keeps the energy exactly if the restitution, not being
    negative, is one; it then launches anew.
    """
    after = vector(collide(GROUND)(-r_0))
    return [
        always(
            iff(equal(energy(after), energy(-r_0)), equal(alpha, 1)),
            in_range=[],
            given=[alpha >= 0],
            label="lossless",
        ),
        always(equals(vector(at(after, {"alpha": 1})), r_0), label="launched"),
    ]


@claim("s3.1-minus-r0", "3.1", "line 224", printed=r"-r_0 = (0, -\dot{\rho}_0)")
def table_comes_down_as_it_went_up(printed: Printed) -> Statement:
    """Whenever the table is back on the ground after its launch, its state is that of the launch
    with the sign changed.
    """
    lands = equal(height(table_at(t)), 0)
    return always(
        equals(table_at(t), printed.right(PAPER)) & printed.formula(PAPER), given=[t > 0, lands]
    )


@claim(
    "eq-5",
    "3.1",
    "(5)",
    printed=r"r(t) = F^{\tau_p(t)}(r_0)",
    as_it_stands=r"r(t) = F^{\tau_p(t)}(r_o)",
)
def table_state_by_time_in_period(printed: Printed) -> list[Statement]:
    """At every time the table is where free flight from its launch brings it in the time since it
    last touched the ground.

    In the n-th period it flies from a launch at n T; it is off the ground between, and ends the
    period where it can be launched anew.
    """
    flown = table_at(t - n * T)
    here = PAPER.extended({"r(t)": flown, r"\tau_p(t)": since})
    again = at(collide(GROUND)(table_at(T)), {"alpha": 1})
    return [
        always(
            printed.formula(here),
            given=[IN_PERIOD, equal(t, n * T + since)],
            vocabulary=WITH_INTEGER_N,
            label="state",
        ),
        always(
            height(printed.right(here)) > 0, given=[IN_PERIOD, since > 0], label="off-the-ground"
        ),
        always(equals(again, r_0), label="launched-anew"),
    ]


@claim("s3.1-T", "3.1", "line 228", printed=r"T := 2\dot{\rho}_0/\gamma")
def period_of_the_table(printed: Printed) -> Statement:
    """After its launch the table is on the ground again exactly when T has passed."""
    return is_the_period(printed)


@claim("s3.1-rho0-positive", "3.1", "line 228", printed=r"\rho_0 > 0")
def launch_speed_is_positive(printed: Printed) -> Statement:
    """The parameter that is assumed positive is the one whose sign makes the table fly: the period
    is positive exactly if it is.

    As printed it is the height at launch, which is zero.
    """
    free = replace(STANDING, givens={"g": (g > 0,)})
    rho = real("rho")  # what the print names: the height at launch
    positive = printed.formula(PAPER.extended({r"\rho_0": rho}))
    return always(iff(positive, T > 0), given=[equal(rho, height(r_0))], vocabulary=free)


@claim("s3.1-note3", "3.1", "footnote 3", printed=r"0 \le t < T")
def time_in_period_is_one_function(printed: Printed) -> list[Statement]:
    """Exactly one function of time has the period T and is the identity on this interval: every
    time has one equal in it.
    """

    def inside(time: Term) -> Formula:
        return printed.formula(PAPER.extended({"t": time}))

    other = real("other")
    return [
        always(
            inside(t - n * T),
            given=[n * T <= t, t < (n + 1) * T],
            vocabulary=WITH_INTEGER_N,
            label="one",
        ),
        always(
            equal(since, other),
            given=[inside(since), inside(other), equal(since - other, n * T)],
            vocabulary=WITH_INTEGER_N,
            label="only-one",
        ),
    ]
