"""Appendix A.1: the velocity that impacts can sustain, and the energy that goes with it."""

from __future__ import annotations

import symbolic
from certificates.statements import Statement
from certificates.terms import Number, Term, conjunction, equal, iff, reals
from proofs.claims import claim
from proofs.paper.events import (
    ball_at,
    height,
    only_at,
    speed,
    strikes_at,
    table_at,
    value_of,
    vector,
)
from proofs.paper.gains import NOT_LOSING, UNKNOWN, E_max, place
from proofs.paper.outside import pieces
from proofs.paper.vocabulary import (
    PAPER,
    H,
    T,
    alpha,
    always,
    at,
    b,
    beta,
    collide,
    derived,
    encoded,
    energy,
    is_maximum,
    r,
    t,
    v,
)
from proofs.reading.printed import Printed
from proofs.reading.values import Vector

ball, ball_after, table, table_after = reals("ball ball_after table table_after")
equilibrium, chi_dot, tau, mass = reals("equilibrium chi_dot tau mass")
VELOCITIES = PAPER.extended(
    {
        r"\dot\beta": ball,
        r"\dot\beta'": ball_after,
        r"\dot\rho": table,
        r"\dot\rho'": table_after,
        r"\dot\beta_{eq}": equilibrium,
    }
)


def struck(before: Number, table_velocity: Number) -> Term:
    """The ball's velocity after it meets the heavy table at these velocities."""
    return speed(vector(collide(Vector((0, table_velocity)))(Vector((0, before)))))


@claim("sA.1-max-velocity", "A.1", "line 630")
def table_is_fastest_at_its_launch() -> Statement:
    """Within a period the table's velocity is never above its launch velocity, and equal to it only
    at the launch.
    """
    now = speed(table_at(t))
    return always((now <= r) & iff(equal(now, r), equal(t, 0)), given=[t >= 0, t < T])


@claim(
    "sA.1-chi",
    "A.1",
    "line 630",
    printed=r"\dot{\chi} = \dot{\beta} - \dot{\rho}",
    as_it_stands=r"\dot{\chi} = \dot{\beta} - \dot{p}",
)
def relative_velocity(printed: Printed) -> Statement:
    """The rate at which the distance of ball and table changes in flight is the difference of their
    velocities.
    """

    def distance(time: Term) -> Term:
        return height(ball_at(time)) - height(table_at(time))

    names = PAPER.extended(
        {r"\dot\chi": chi_dot, r"\dot\beta": speed(ball_at(t)), r"\dot\rho": speed(table_at(t))}
    )
    return always(
        equal(distance(t + tau) - distance(t), tau * chi_dot), given=[printed.formula(names)]
    )


@claim(
    "sA.1-restitution",
    "A.1",
    "line 632",
    printed=r"\dot{\beta}' - \dot{\rho}' = -\alpha (\dot{\beta} - \dot{\rho})",
    as_it_stands=r"\dot{\beta}' = -\dot{\rho}' = -\alpha (\dot{\beta} - \dot{\rho})",
)
def restitution_turns_the_relative_velocity(printed: Printed) -> Statement:
    """With a table that keeps its velocity, the relative velocity is turned and shrunk by alpha
    exactly as the impact (3) has it.
    """
    return always(
        iff(printed.formula(VELOCITIES), equal(ball_after, struck(ball, table))),
        given=[equal(table_after, table)],
    )


@claim("sA.1-high-mass", "A.1", "line 634", printed=r"\dot{\rho}' = \dot{\rho}")
def heavy_table_keeps_its_velocity(printed: Printed) -> Statement:
    """When the bodies meet at different velocities, the table keeps its own just if the ball's mass
    is nothing beside the table's.
    """
    after = at(encoded(symbolic.speeds_after_impact()[1]), {"m": mass, "v": ball, "u": table})
    return always(
        iff(printed.formula(VELOCITIES), equal(mass, 0)),
        given=[mass >= 0, ball < table, equal(table_after, after)],
    )


@claim(
    "sA.1-rearranged",
    "A.1",
    "line 636",
    printed=r"\dot{\beta}' = -\alpha \dot{\beta} + (1 + \alpha) \dot{\rho}",
)
def velocity_after_the_impact(printed: Printed) -> Statement:
    """The ball's velocity after an impact on the heavy table, as the impact (3) has it."""
    return always(iff(printed.formula(VELOCITIES), equal(ball_after, struck(ball, table))))


@claim("sA.1-loss", "A.1", "line 638", printed=r"\dot{\rho} = 0 \\ (1 - \alpha)")
def part_lost_on_a_table_at_rest(printed: Printed) -> Statement:
    """On a table at rest the ball, whose velocity is turned round, loses this part of it."""
    at_rest, part = pieces(printed, 2)
    lost = value_of(part, PAPER) * -ball
    return always(equal(-ball - struck(ball, table), lost), given=[at_rest.formula(VELOCITIES)])


@claim("sA.1-sustain", "A.1", "line 638")
def table_gives_back_what_is_lost() -> Statement:
    """The ball's velocity is sustained exactly when the moving table adds to it what a table at
    rest would take.
    """
    added = struck(ball, table) - struck(ball, 0)
    return always(iff(equal(struck(ball, table), -ball), equal(added, (1 - alpha) * -ball)))


@claim("sA.1-maximise", "A.1", "line 638")
def fastest_table_gives_most() -> list[Statement]:
    """The ball leaves fastest, and so with the most energy, when the table has its greatest
    velocity.
    """
    slower, fastest = struck(ball, table), struck(ball, r)
    return [
        always(slower < fastest, given=[table < r], label="velocity"),
        always(slower**2 / 2 < fastest**2 / 2, given=[table < r, slower >= 0], label="energy"),
    ]


@claim(
    "sA.1-equilibrium", "A.1", "line 638", printed=r"\dot{\beta}_{eq} = -\dot{\beta} = \dot{\beta}'"
)
def equilibrium_velocity(printed: Printed) -> Statement:
    """The equilibrium velocity is that after an impact, and the flight that follows brings the ball
    back to the velocity before it.
    """
    leaves, wait = Vector((0, equilibrium)), at(derived("hang_time"), {"v": equilibrium})
    after = struck(ball, r)
    names = VELOCITIES.extended({r"\dot\beta'": after})
    return always(
        iff(
            printed.formula(names),
            equal(after, equilibrium) & equal(speed(ball_at(wait, leaves)), ball),
        )
    )


@claim(
    "sA.1-balance",
    "A.1",
    "line 640",
    printed=r"(1 - \alpha) \dot{\beta}_{eq} = (1 + \alpha) \dot{\rho}_0",
)
def equilibrium_balances(printed: Printed) -> Statement:
    """An impact with the fastest table just turns a velocity round if what is lost of it equals
    what the table adds.
    """
    return always(iff(printed.formula(VELOCITIES), equal(struck(-equilibrium, r), equilibrium)))


@claim(
    "eq-33",
    "A.1",
    "(33)",
    printed=r"\dot{\beta}_{eq} = \left(\frac{1+\alpha}{1-\alpha}\right) \dot{\rho}_0",
)
def equilibrium_velocity_solved(printed: Printed) -> Statement:
    """The only velocity that an impact with the fastest table just turns round."""
    return always(iff(printed.formula(VELOCITIES), equal(struck(-equilibrium, r), equilibrium)))


@claim(
    "sA.1-only-at-zero",
    "A.1",
    "line 646",
    printed=(
        r"\tau_c = 0, \quad \rho = 0, \quad \beta = 0, \quad \dot{\beta} = \dot{\overline{\beta}}"
    ),
    as_it_stands=r"\tau_c = 0, \quad \rho = 0, \quad \beta = 0, \quad \dot{\beta} = \dot{\beta}",
)
def fastest_table_is_met_at_its_launch(printed: Printed) -> Statement:
    """The ball meets the table at its greatest velocity just if that is at once, both on the
    ground, the ball at its sampled velocity.
    """
    there = ball_at(t)
    names = PAPER.extended(
        {
            r"\tau_c": only_at(b, t),
            r"\rho": height(table_at(t)),
            r"\beta": height(there),
            r"\dot\beta": speed(there),
        }
    )
    return always(
        iff(equal(speed(table_at(t)), r), printed.formula(names)), given=[H(b), strikes_at(t)]
    )


@claim(
    "eq-34",
    "A.1",
    "(34)",
    printed=r"E_{max} = \frac{1}{2} \left(\frac{1+\alpha}{1-\alpha} \dot{\rho}_0 \right)^2",
    repeats="s4.1-Emax",
)
def energy_of_the_equilibrium(printed: Printed) -> list[Statement]:
    """E_max is the energy at the equilibrium velocity on the ground, and the greatest at which an
    impact does not lose energy.
    """
    defined = printed.formula(UNKNOWN)
    turned = equal(struck(-equilibrium, r), equilibrium)
    both_ways = conjunction(
        [equal(E_max, energy(Vector((0, way)))) for way in (equilibrium, -equilibrium)]
    )
    return [
        always(both_ways, given=[defined, turned], label="at-equilibrium"),
        *is_maximum(
            E_max,
            energy(b),
            {"beta": beta, "v": v},
            at=place("largest_kept_energy"),
            on=NOT_LOSING(b),
            given=[defined],
        ),
    ]
