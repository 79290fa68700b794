"""Impacts that gain, keep or lose energy, the greatest energies that go with them, and how the
energy change varies (4.1, A.1 to A.3).
"""

from __future__ import annotations

import symbolic
from certificates.terms import Formula, Term, conjunction, different, equal, real, reals, term
from proofs.paper.events import only_at
from proofs.paper.vocabulary import (
    B1_PLUS,
    B1_ZERO,
    PAPER,
    b,
    derived,
    encoded,
    energy,
    f1,
    function,
    impact_energy_change,
)
from proofs.reading.environment import Environment
from proofs.reading.notions import StateFunction
from proofs.reading.values import Vector

NOT_LOSING = B1_PLUS | B1_ZERO
E_max, dE_max = reals("E_max dE_max")
UNKNOWN = PAPER.extended({r"E_{max}": E_max, r"\Delta E_{max}": dE_max})
GREATEST_GAIN = equal(dE_max, derived("delta_E_max"))
BOTH_BOUNDS = [equal(E_max, derived("E_max")), GREATEST_GAIN]


def keeps_energy(state: Vector) -> Formula:
    """The impact that comes within the period leaves the energy as it was."""
    return equal(energy(f1(state)), energy(state))


def place(extremum: str) -> dict[str, Term]:
    """The state at which a derived extremum is attained."""
    return dict(zip(("beta", "v"), encoded(getattr(symbolic, extremum)().state).entries))


# The slopes of a quadratic function: for such a function the quotient of central differences is the
# derivative, whatever h is.
h = real("h")
SLOPES = reals("dE_dbeta dE_dv dR_dbeta dR_dv")
dE_dbeta, dE_dv, dR_dbeta, dR_dv = SLOPES


def with_slopes(environment: Environment, state: Vector = b) -> Environment:
    """The environment in which the derivatives at this state are the names of the slopes."""
    return environment.extended(
        {
            r"\frac{\partial \Delta_1 E}{\partial \overline\beta}": only_at(state, dE_dbeta),
            r"\frac{\partial \Delta_1 E}{\partial \dot{\overline\beta}}": only_at(state, dE_dv),
            r"D_{\overline\beta} \Delta_1 E": only_at(state, dE_dbeta),
            r"D_{\dot{\overline\beta}} \Delta_1 E": only_at(state, dE_dv),
            r"D_{\overline\beta} R": only_at(state, dR_dbeta),
            r"D_{\dot{\overline\beta}} R": only_at(state, dR_dv),
        }
    )


STEEP = with_slopes(UNKNOWN)


def are_slopes(*slopes: Term, state: Vector = b) -> Formula:
    """Each of these names is the slope of its function at the state: by central differences of any
    width h.
    """
    said = [different(h, 0)]
    for slope in slopes:
        of: StateFunction = (
            impact_energy_change if slope in (dE_dbeta, dE_dv) else function("region_margin")
        )
        step = Vector((h, 0)) if slope in (dE_dbeta, dR_dbeta) else Vector((0, h))
        said.append(equal(term(of(state + step)) - of(state - step), 2 * h * slope))
    return conjunction(said)
