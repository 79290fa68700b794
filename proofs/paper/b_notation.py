"""Appendix B.7: what the table of notation says beyond naming a symbol."""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import equal, iff, reals
from proofs.claims import Assertion, Following, claim
from proofs.paper.events import (
    after_impact,
    ball_at,
    height,
    only_at,
    speed,
    strikes_at,
    table_at,
    value_of,
    vector,
)
from proofs.paper.outside import ATTRACTION
from proofs.paper.relative_motion import STABILITY, lies_around_e_1, narrow_band_stays
from proofs.paper.said_again import NEAR_B1, NEAR_B2, is_the_period, tells_b1, tells_b2
from proofs.paper.vocabulary import (
    PAPER,
    STRIKES,
    H,
    R,
    T,
    always,
    b,
    beta,
    collide,
    energy,
    eps,
    equals,
    f1,
    f2,
    flight,
    t,
)
from proofs.reading.notions import StateFunction
from proofs.reading.printed import Printed
from proofs.reading.values import Matrix, ShapeError, Vector

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
    names = PAPER.extended({r"\dot\beta": speed(ball_at(t))})
    return always(equals(vector(value_of(printed, names)), ball_at(0)))


@claim("sB.7-C", "B.7", "line 844", printed="C_{y}(x)")
def impact_in_the_table(printed: Printed) -> Statement:
    """In the notation of (3), this is the ball's state after an impact if y is the ball's state
    before it and x the table's.
    """
    table = Vector(reals("rho u"))
    names = PAPER.extended({"y": b, "x": table})
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
    names = PAPER.extended({r"\tau_c": only_at(b, t), r"\overline\tau_c": until})
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
    matrix = printed.right(PAPER)
    if not isinstance(matrix, Matrix):
        raise ShapeError("a matrix was expected")
    return [
        always(
            equals(vector(matrix * (b - other)), ball_at(t) - ball_at(t, other)), label="difference"
        ),
        always(printed.formula(PAPER), label="matrix"),
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
    return always(printed.formula(PAPER))


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
    names = PAPER.extended({"f": f1, r"\Delta E": only_at(b, change)})
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
    return always(printed.formula(PAPER.extended({"K": moving})))


@claim("sB.7-B1", "B.7", "line 854", nearby=NEAR_B1, printed=r"\tau_c < T", repeats="sB.2-B1")
def b1_in_the_table(printed: Printed) -> Statement:
    """Where the time to collision is defined, the states of H at which it is less than one period
    are the region B1 of (7).
    """
    return tells_b1(printed.formula(PAPER))


@claim("sB.7-B2", "B.7", "line 855", nearby=NEAR_B2, printed=r"\tau_c \ge T", repeats="s2.2.1-B2")
def b2_in_the_table(printed: Printed) -> Statement:
    """Where the time to collision is defined, the states of H at which it is one period or more are
    what B1 leaves of H.
    """
    return tells_b2(printed.formula(PAPER))


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
