"""Section 3.4: total energy, kept in flight, and its change by an impact."""

from __future__ import annotations

from juggleproof.proofs.paper.names import (
    B1,
    B2,
    POINTS,
    always,
    b,
    ball_at,
    claim,
    derived,
    energy,
    f1,
    f2,
    meanings,
    next_states,
    only_at,
    paper_names,
    speed,
    t,
)
from juggleproof.proofs.paper.states import next_bounce, strikes_from, struck
from juggleproof.reading.evaluation import Environment
from juggleproof.reading.meaning import Printed
from juggleproof.reading.values import StateFunction, Value, Vector
from juggleproof.statements.language import Statement, equal, reals

tau, change, change_1, change_2 = reals("tau change change_1 change_2")
b_0, image = Vector(reals("beta0 v0")), Vector(reals("beta1 v1"))
FROM_B_0 = Environment(meanings(), points=POINTS, state=r"\overline b_0")


@claim(
    "eq-14",
    "3.4.1",
    "(14)",
    printed=r"E(\overline{b}) := \gamma \overline{\beta} + \frac{1}{2} \dot{\overline{\beta}}^2",
)
def total_energy(printed: Printed) -> Statement:
    """The energy is what Newton's equation keeps in flight: half the squared speed, less the work
    of gravity from the ground up.
    """
    return always(printed.formula(paper_names()))


@claim(
    "s3.4.1-E0",
    "3.4.1",
    "line 344",
    printed=(
        r"E_0 := E(\overline{b}_0) = \gamma \overline{\beta}_0 + \frac{1}{2}"
        r" \dot{\overline{\beta}}_0^2"
    ),
)
def energy_at_the_start(printed: Printed) -> Statement:
    """The energy of the state from which a flight starts is the one that it has after any time."""
    return always(printed.formula(paper_names().extended({"E_0": energy(ball_at(t, b_0))})))


@claim("s3.4.1-flight", "3.4.1", "line 348", printed=r"\overline{b}(t) = F^t \circ \overline{b}_0")
def state_in_flight(printed: Printed) -> Statement:
    """The state at a time is what flight makes of the first state, also if the flight is looked at
    in between.
    """
    on_the_way = ball_at(t - tau, ball_at(tau, b_0))
    return always(printed.formula(paper_names().extended({r"\overline b(t)": on_the_way})))


@claim(
    "s3.4.1-Et",
    "3.4.1",
    "lines 352 to 356",
    printed=r"""E(t) := E \circ F^t
       = \gamma (\overline{\beta}_0 + \dot{\overline{\beta}}_0 t - \frac{1}{2} \gamma t^2)
       + \frac{1}{2} (\dot{\overline{\beta}}_0 - \gamma t)^2""",
)
def energy_in_flight(printed: Printed) -> Statement:
    """The energy after a time of flight, written out in height and speed."""
    return always(printed.formula(FROM_B_0.extended({"E(t)": energy(ball_at(t, b_0))})))


@claim(
    "s3.4.1-conserved",
    "3.4.1",
    "lines 360 to 361",
    printed=r"E(t) = \gamma \overline{\beta}_0 + \frac{1}{2} \dot{\overline{\beta}}_0^2 = E_0",
)
def flight_keeps_the_energy(printed: Printed) -> Statement:
    """After any time of flight the energy is that of the first state."""
    return always(
        printed.formula(
            paper_names().extended({"E(t)": energy(ball_at(t, b_0)), "E_0": energy(b_0)})
        )
    )


def image_of_b(state: Vector = b) -> StateFunction[Vector]:
    """f, of which only the image of this state is known, by a name."""
    return only_at(state, image)


@claim(
    "eq-15",
    "3.4.1",
    "(15)",
    printed=r"E \circ \overline{f}|_{\mathcal{B}_2} = E",
    as_it_stands=r"E \circ \overline{f} \mid_{\mathcal{B}_2} = E",
)
def map_keeps_the_energy_on_b2(printed: Printed) -> Statement:
    """The map leaves the energy of a state of B2 as it is."""
    return always(
        printed.formula(paper_names().extended({r"\overline f": image_of_b()})),
        given=[next_states(b, image)],
    )


@claim(
    "s3.4.2-DeltaE",
    "3.4.2",
    "lines 369 to 371",
    printed=r"""\Delta E(\overline{b}) := E \circ \overline{f}(\overline{b}) - E(\overline{b})
       = \begin{cases} \Delta_1 E := \Delta E|_{\mathcal{B}_1} : \overline{b} \in \mathcal{B}_1 \\
       \Delta_2 E := \Delta E|_{\mathcal{B}_2} : \overline{b} \in \mathcal{B}_2 \end{cases}""",
    as_it_stands=(
        r"""\Delta E(\overline{b}) := """
        r"""E \circ \overline{f}(\overline{b}) - E(\overline{b}) \\
       = \begin{cases} \Delta_1 E := \Delta E \big|_{\beta_1} : \overline{b} \in \beta_1 \\ \\
       \Delta_2 E := \Delta E \big|_{\beta_2} : \overline{b} \in \beta_2 \end{cases}"""
    ),
)
def energy_change(printed: Printed) -> list[Statement]:
    """The map changes the energy by what the impact adds to it on B1, and by nothing on B2."""
    gain = energy(struck(b, t)) - energy(ball_at(t))
    names: dict[str, Value] = {
        r"\Delta_1 E": change_1,
        r"\Delta_2 E": change_2,
        r"\Delta E": only_at(b, change),
    }
    known = equal(change_1, derived("energy_change_1")) & equal(
        change_2, derived("energy_change_2")
    )
    return [
        always(
            printed.formula(paper_names().extended({**names, r"\overline f": f1})),
            given=[known, B1(b), strikes_from(b, t), equal(change, gain)],
            label="with-impact",
        ),
        always(
            printed.formula(paper_names().extended({**names, r"\overline f": f2})),
            given=[known, B2(b), equal(change, 0)],
            label="without-impact",
        ),
    ]


@claim("s3.4.2-Delta2E-zero", "3.4.2", "line 373", repeats="eq-15", printed=r"\Delta_2 E \equiv 0")
def no_energy_change_on_b2(printed: Printed) -> Statement:
    """On B2 the energy of a state and that of its image are the same."""
    return always(
        printed.formula(paper_names().extended({r"\Delta_2 E": energy(image) - energy(b)})),
        given=[B2(b), next_states(b, image)],
    )


@claim("s3.4.2-only-kinetic", "3.4.2", "line 375")
def energy_changes_by_the_speed_at_impact() -> Statement:
    """An impact, which leaves the height as it was by the definition of C in (3), changes the
    energy by the kinetic energy that it adds.
    """
    before, after = ball_at(t), struck(b, t)
    return always(
        equal(energy(next_bounce(b, t)) - energy(b), (speed(after) ** 2 - speed(before) ** 2) / 2)
    )


@claim(
    "eq-16",
    "3.4.2",
    "(16)",
    printed=(
        r"""\Delta_1 E = \frac{1}{2} \left[ -\alpha \dot{\overline{\beta}} + \alpha\gamma\tau_c
       + (1 + \alpha)\dot{\rho}_0 - (1 + \alpha)\gamma\tau_c \right]^2"""
        r""" - \frac{1}{2} (\dot{\overline{\beta}} - \gamma\tau_c)^2"""
    ),
)
def energy_change_on_b1(printed: Printed) -> Statement:
    """The energy changes by this expression in the speed and the time to collision, if the ball
    strikes at that time.
    """
    change = energy(next_bounce(b, t)) - energy(b)
    return always(
        printed.formula(paper_names().extended({r"\Delta_1 E": change, r"\tau_c": t})),
        given=[strikes_from(b, t)],
    )
