"""Section 2.2.2: free flight under gravity, and the impact of two point masses."""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import conjunction, different, equal, iff, reals, term
from proofs.claims import Assertion, Readings, claim
from proofs.paper.events import ball_at, height, only_at, speed
from proofs.paper.outside import pieces
from proofs.paper.vocabulary import (
    PAPER,
    alpha,
    always,
    b,
    beta,
    collide,
    encoded,
    equals,
    flight,
    t,
    v,
)
from proofs.reading.printed import Printed
from proofs.reading.values import Vector

d, rho, u, m = reals("d rho u m")
table = Vector((rho, u))  # the body that the ball hits, in any state


@claim("s2.2.2-newton", "2.2.2", "line 159", printed=r"\ddot{x} = -\gamma")
def newtons_equation(printed: Printed) -> Readings:
    """In free flight the second derivative by time is minus gravity.

    x is the position as in (2), or the state as the sentence before says; the derivative is an
    exact difference quotient, since the flight is quadratic in time.
    """

    def component(index: int) -> Statement:
        before, now, after = (term(ball_at(time).component(index)) for time in (t - d, t, t + d))
        quotient = (after - 2 * now + before) / d**2
        says = printed.formula(PAPER.extended({r"\ddot{x}": quotient}))
        return always(says, given=[different(d, 0)], label=("position", "speed")[index - 1])

    return Readings(
        {"position": Assertion((component(1),)), "state": Assertion((component(1), component(2)))}
    )


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
    here = PAPER.extended({"x": b})
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
    import symbolic

    law, values, relative = pieces(printed, 3)
    ball_speed, table_speed = (term(encoded(one)) for one in symbolic.speeds_after_impact())
    names = reals("chi chi_dot chi_after chi_dot_after")
    before = relative.formula(PAPER.extended({"x": b, "y": table, r"\chi": Vector(names[:2])}))
    after = relative.formula(
        PAPER.extended(
            {
                "x": Vector((beta, ball_speed)),
                "y": Vector((rho, table_speed)),
                r"\chi": Vector(names[2:]),
            }
        )
    )
    says = law.formula(PAPER.extended({r"\dot\chi": names[1], r"\dot\chi'": names[3]}))
    return always(
        says,
        in_range=[values.formula(PAPER)],
        given=[m > 0, equal(beta, rho), v < u, before, after],
    )


@claim("s2.2.2-alpha-range", "2.2.2", "line 176", printed=r"0 < \alpha < 1")
def impact_rebounds_with_loss(printed: Printed) -> Statement:
    """Exactly for these values of alpha, bodies that approach each other part after the impact, and
    more slowly.
    """
    parting = speed(collide(table)(b)) - u
    return always(
        iff(printed.formula(PAPER), conjunction([parting > 0, parting < u - v])),
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
    import symbolic

    here = PAPER.extended({"x": b, "y": table})
    whole, matrix = pieces(printed, 2)
    after = Vector(reals("after after_dot"))
    by_print = here.extended(
        {
            r"R_\alpha": matrix.right(here),
            r"C_{\cdot}": lambda body: only_at(b, after) if body == table else None,
        }
    )
    restitution = equal(speed(after) - u, -alpha * (v - u)) & equal(height(after), beta)
    slowed = u - term(encoded(symbolic.speeds_after_impact()[1]))
    return [
        always(whole.formula(by_print), given=[restitution], label="new-state"),
        always(matrix.formula(here), label="matrix"),
        always(
            (slowed >= 0) & (slowed <= m * (1 + alpha) * (u - v)),
            given=[m >= 0, v < u],
            label="massive-body",
        ),
    ]
