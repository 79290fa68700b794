"""Appendices A.1 and A.2: the greatest energy that impacts sustain, and the slopes and the maximum
of the energy change of an impact.
"""

from __future__ import annotations

from juggleproof.judging.claims import Argument, Assertion
from juggleproof.proofs.paper.names import (
    B1,
    B1_MINUS,
    B1_PLUS,
    B2,
    H,
    K,
    T,
    alpha,
    always,
    at,
    b,
    ball_at,
    beta,
    claim,
    collide,
    derived,
    derived_vector,
    energy,
    exists_some,
    f1,
    f2,
    g,
    height,
    impact_energy_change,
    is_maximum,
    only_at,
    paper_names,
    r,
    speed,
    strikes_at,
    t,
    table_at,
    v,
    value_of,
    vector,
)
from juggleproof.proofs.paper.regions import b_0, beta0, pieces, v0
from juggleproof.proofs.paper.states import (
    GREATEST_GAIN,
    NOT_LOSING,
    STEEP,
    UNKNOWN,
    E_max,
    always_integer,
    are_slopes,
    dE_dbeta,
    dE_dv,
    dE_max,
    place,
)
from juggleproof.reading.meaning import Printed
from juggleproof.reading.values import Vector, scalar
from juggleproof.statements.language import (
    Number,
    Statement,
    Term,
    conjunction,
    different,
    equal,
    iff,
    reals,
    term,
)

# -------------------------------------------------------------------------------------------------
# Appendix A.1: the velocity that impacts can sustain, and the energy that goes with it.

ball, ball_after, table, table_after = reals("ball ball_after table table_after")
equilibrium, chi_dot, chi_dot_after = reals("equilibrium chi_dot chi_dot_after")
tau, mass = reals("tau mass")
VELOCITIES = paper_names().extended(
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
def table_is_fastest_at_its_launch() -> list[Statement]:
    """Within a period the table's velocity is never above its launch velocity, and equal to it only
    at the launch; so the energy that an impact adds is limited.
    """
    now = speed(table_at(t))
    added = struck(ball, table) ** 2 / 2 - ball**2 / 2
    return [
        always((now <= r) & iff(equal(now, r), equal(t, 0)), given=[t >= 0, t < T]),
        always(added <= derived("delta_E_max"), given=[ball < table, table <= r], label="limited"),
    ]


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

    names = paper_names().extended(
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
def restitution_turns_the_relative_velocity(printed: Printed) -> list[Statement]:
    """The law (2), with the minus that it lacks, of the relative velocities before and after the
    impact; with a table that keeps its velocity it is the impact (3).
    """
    law = equal(chi_dot_after, -alpha * chi_dot)
    differences = [equal(chi_dot, ball - table), equal(chi_dot_after, ball_after - table_after)]
    return [
        always(iff(printed.formula(VELOCITIES), law), given=differences, label="by-2"),
        always(
            iff(printed.formula(VELOCITIES), equal(ball_after, struck(ball, table))),
            given=[equal(table_after, table)],
        ),
    ]


@claim("sA.1-high-mass", "A.1", "line 634", printed=r"\dot{\rho}' = \dot{\rho}")
def heavy_table_keeps_its_velocity(printed: Printed) -> Statement:
    """When the bodies meet at different velocities, the table keeps its own just if the ball's mass
    is nothing beside the table's.
    """
    after = at(
        term(derived_vector("speeds_after_impact").component(2)), {"m": mass, "v": ball, "u": table}
    )
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
    lost = scalar(value_of(part, paper_names())) * -ball
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
    later, falling = speed(table_at(t)), [t > 0, t < T, ball < speed(table_at(t))]
    return [
        always(slower < fastest, given=[table < r], label="velocity"),
        always(struck(ball, later) ** 2 / 2 < fastest**2 / 2, given=falling, label="energy"),
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


@claim("sA.1-in-step", "A.1", "line 638", parameters=("alpha", "K"))
def equilibrium_is_kept_up() -> Argument:
    """The greatest energy that is sustained is found where the fastest table just turns the
    velocity round; for the flight that follows brings the ball back to that velocity.

    For that the flight has to end as the table is launched again: when it lasts K periods and less
    than K + 1, it has to last K.
    """
    turned = equal(struck(-equilibrium, r), equilibrium)
    wait = at(derived("hang_time"), {"v": equilibrium})
    lasts = [turned, K * T <= wait, wait < (K + 1) * T]
    return Argument(
        steps={
            "turned-round": Assertion(
                (always(equal(speed(ball_at(wait, Vector((0, equilibrium)))), -equilibrium)),)
            ),
            "in-step": Assertion((always_integer(equal(wait, K * T), given=lasts),)),
        },
        proved_by="s4.1-Emax",
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
    names = paper_names().extended(
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


# -------------------------------------------------------------------------------------------------
# Appendix A.2: the slopes of the energy change of an impact, and its maximum.

change = impact_energy_change(b)
step, dE_2 = reals("step dE_2")
ON_EDGE = Vector((0, v))


@claim("sA.2-upper-bound", "A.2", "line 652")
def energy_change_is_bounded_above() -> list[Statement]:
    """The energy change of an impact has an upper bound on H; some impacts gain, at bounded
    energies only, and at all greater energies impacts lose.
    """
    return [
        always(change <= derived("delta_E_max"), given=[H(b)], label="bounded"),
        exists_some(["beta", "v"], B1_PLUS(b), label="some-gain"),
        always(energy(b) <= derived("E_max"), given=[B1_PLUS(b)], label="few-gain"),
        always(B1_MINUS(b), given=[B1(b), energy(b) > derived("E_max")], label="most-lose"),
    ]


@claim(
    "sA.2-gradient",
    "A.2",
    "line 656",
    printed=(
        r"D(\Delta_1 E) := \begin{bmatrix} \frac{\partial \Delta_1 E}{\partial"
        r" \overline{\beta}} \\ "
        r"\frac{\partial \Delta_1 E}{\partial \dot{\overline{\beta}}} \end{bmatrix}"
    ),
    as_it_stands=r"D(\Delta_1 E) := \begin{bmatrix} \frac{\partial \Delta_1 E}{\partial \beta} \\ "
    r"\frac{\partial \Delta_1 E}{\partial \dot{\beta}} \end{bmatrix}",
)
def gradient_of_the_energy_change(printed: Printed) -> Statement:
    """Both slopes together give the first-order change of Delta_1 E in every direction."""
    d1, d2, p, q = reals("d1 d2 p q")
    there, back = b + Vector((p, q)), b - Vector((p, q))
    defined = printed.formula(STEEP.extended({r"D(\Delta_1 E)": Vector((d1, d2))}))
    between = impact_energy_change(there) - impact_energy_change(back)
    return always(
        equal(between, 2 * (d1 * p + d2 * q)), given=[are_slopes(dE_dbeta, dE_dv), defined]
    )


@claim(
    "eq-35",
    "A.2",
    "(35)",
    printed=r"\frac{\partial \Delta_1 E}{\partial \overline{\beta}} = -\alpha\gamma - \gamma",
    as_it_stands=r"\frac{\partial \Delta_1 E}{\partial \overline{B}} = -\alpha \gamma - \gamma",
)
def slope_with_the_height(printed: Printed) -> Statement:
    """How the energy change of an impact falls with the height."""
    return always(printed.formula(STEEP), given=[are_slopes(dE_dbeta)])


@claim(
    "eq-36",
    "A.2",
    "(36)",
    printed=r"\frac{\partial \Delta_1 E}{\partial \dot{\overline{\beta}}} = "
    r"-\alpha\gamma T - (1-\alpha^2) \dot{\overline{\beta}} - \alpha(\alpha-1) \dot{\rho}_0",
)
def slope_with_the_velocity(printed: Printed) -> Statement:
    """How the energy change of an impact varies with the velocity."""
    return always(printed.formula(STEEP), given=[are_slopes(dE_dv)])


@claim("sA.2-unbounded", "A.2", "line 663")
def energy_change_falls_steadily_with_the_height() -> list[Statement]:
    """The slope with the height is the same everywhere; the energy change falls faster than
    potential energy rises, without bound.
    """

    def gained(state: Vector) -> Term:
        raised, before = (
            impact_energy_change(place) for place in (state + Vector((step, 0)), state)
        )
        return raised - before

    return [
        always(equal(gained(b), gained(b_0)), label="same-slope"),
        always(gained(b) < -g * step, given=[step > 0], label="no-lower-bound"),
    ]


@claim("sA.2-max-on-edge", "A.2", "line 663", printed=r"\overline{\beta} = 0")
def maximum_lies_on_the_edge(printed: Printed) -> Statement:
    """Away from this edge of H a state of the same velocity on the edge has a greater energy
    change.
    """
    return always(
        change < impact_energy_change(ON_EDGE), given=[H(b), ~printed.formula(paper_names())]
    )


@claim(
    "sA.2-kuhn-tucker",
    "A.2",
    "line 665",
    printed=r"\frac{\partial \Delta_1 E}{\partial \dot{\overline{\beta}}} = 0",
    as_it_stands=r"\frac{\partial \Delta_1 E}{\partial \dot{\overline{B}}} = 0",
)
def condition_for_the_maximum(printed: Printed) -> list[Statement]:
    """A state of the edge has the greatest energy change of H exactly if the slope with the
    velocity vanishes there.
    """
    slope, stationary = at(are_slopes(dE_dv), {"beta": 0}), printed.formula(STEEP)
    return [
        always(
            impact_energy_change(b_0) <= impact_energy_change(ON_EDGE),
            given=[slope, stationary, H(b_0)],
            label="enough",
        ),
        always(
            impact_energy_change(ON_EDGE) < at(change, place("largest_energy_change")),
            given=[slope, ~stationary],
            label="needed",
        ),
    ]


@claim(
    "eq-37",
    "A.2",
    "(37)",
    printed=r"\Delta E_{max} = \frac{1}{2} \frac{1+\alpha}{1-\alpha} \dot{\rho}_0^2",
    repeats="s4.1-DEmax",
)
def greatest_energy_change(printed: Printed) -> list[Statement]:
    """The maximum of Delta_1 E on H."""
    return is_maximum(
        dE_max,
        energy(f1(b)) - energy(b),
        {"beta": beta, "v": v},
        at=place("largest_energy_change"),
        on=H(b),
        given=[printed.formula(UNKNOWN)],
    )


@claim(
    "sA.2-at",
    "A.2",
    "line 673",
    printed=r"\overline{b} = \left(0, \frac{\alpha \dot{\rho}_0}{\alpha - 1}\right).",
)
def state_of_the_greatest_energy_change(printed: Printed) -> list[Statement]:
    """The only state of H with the greatest energy change; it lies in B1."""
    here = printed.formula(paper_names())
    return [
        always(impact_energy_change(b_0) <= change, given=[here, H(b_0)], label="greatest"),
        always(
            impact_energy_change(b_0) < change,
            given=[here, H(b_0), different(beta0, beta) | different(v0, v)],
            label="only",
        ),
        always(B1(b), given=[here], label="in-B1"),
    ]


@claim("sA.2-entire-H", "A.2", "line 675", printed=r"\Delta E_{max} > \Delta_2 E")
def maximum_holds_without_impacts_too(printed: Printed) -> list[Statement]:
    """Without an impact the energy changes less than that, so that Delta E_max is the greatest
    change on all of H.
    """
    greater = printed.formula(UNKNOWN.extended({r"\Delta_2 E": only_at(b, dE_2)}))
    return [
        always(
            greater,
            given=[GREATEST_GAIN, B2(b), equal(dE_2, energy(f2(b)) - energy(b))],
            label="without-impact",
        ),
        always(
            energy(f1(b)) - energy(b) <= dE_max, given=[GREATEST_GAIN, B1(b)], label="with-impact"
        ),
    ]
