"""Section 3.2: the ball coupled to the table, the time to collision, and the state after it."""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import equal, iff, term
from proofs.claims import claim
from proofs.paper.vocabulary import PAPER, always, b, flight, r, r_0, t, v
from proofs.reading.printed import Printed


@claim("eq-6", "3.2", "(6)",
       printed=r"\tau_c(\overline{\beta}, \dot{\overline{\beta}}) := \frac{\overline{\beta}}{\dot{\rho}_0 - \dot{\overline{\beta}}}")
def time_to_collision(printed: Printed) -> Statement:
    """While the ball's speed differs from the table's launch speed, both are at one height at tau_c and at no other time."""
    ball, table = flight(t)(b), flight(t)(r_0)
    meet = equal(term(ball.component(1)), term(table.component(1)))
    is_tau_c = printed.formula(PAPER.extended({r"\tau_c(\overline\beta, \dot{\overline\beta})": t}))
    return always(iff(meet, is_tau_c), given=[v < r])
