"""Appendix A.2: the slopes of the energy change of an impact, and its maximum."""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import Term, different, equal, reals, term
from proofs.claims import claim
from proofs.paper.events import only_at
from proofs.paper.gains import (
    GREATEST_GAIN,
    STEEP,
    UNKNOWN,
    are_slopes,
    dE_dbeta,
    dE_dv,
    dE_max,
    place,
)
from proofs.paper.outside import b_0, beta0, v0
from proofs.paper.vocabulary import (
    B1,
    B1_MINUS,
    B1_PLUS,
    B2,
    PAPER,
    H,
    always,
    at,
    b,
    beta,
    derived,
    energy,
    f1,
    f2,
    g,
    impact_energy_change,
    is_maximum,
    v,
)
from proofs.reading.printed import Printed
from proofs.reading.values import Vector

change = term(impact_energy_change(b))
step, dE_2 = reals("step dE_2")
ON_EDGE = Vector((0, v))


@claim("sA.2-upper-bound", "A.2", "line 652")
def energy_change_is_bounded_above() -> list[Statement]:
    """The energy change of an impact has an upper bound on H; impacts gain at bounded energies
    only, and lose at all others.
    """
    return [
        always(change <= derived("delta_E_max"), given=[H(b)], label="bounded"),
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
    between = term(impact_energy_change(there)) - impact_energy_change(back)
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
            term(impact_energy_change(place)) for place in (state + Vector((step, 0)), state)
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
    return always(change < impact_energy_change(ON_EDGE), given=[H(b), ~printed.formula(PAPER)])


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
        change,
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
    here = printed.formula(PAPER)
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
