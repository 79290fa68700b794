"""Argument B: from flight to flight.  Why the bound is 1/3, and the repair closest to section 4.3
of the paper.

A flight begins with an impact at the state (x, w) and lasts K periods, to the impact at (x', w').
Since x' >= 0, a long flight needs a high closing speed, and leaves a low one: the next flight lasts
J periods with J - 1 <= alpha (K + 1).  For alpha < 1/3 flights grow shorter until all last one
period.  The closing speeds at the impacts approach that of e_1 by the factor kappa = alpha (1 + 3
alpha)/(1 - alpha) at least, which is less than 1 exactly for alpha < 1/3: so the relative kinetic
energy falls from impact to impact, which the paper claims of every period.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from certificates.statements import AnyStatement, Iterates
from certificates.terms import Term, equal, iff, implies, reals, term
from proofs import forms
from proofs.claims import claim
from proofs.paper.vocabulary import STANDING, alpha, at, derived, w, x
from proofs.reading.values import Vector
from proofs.theorem.definition import FIXED

HERE = Vector((x, w))
K, J, n, d = reals("K J n d")
COUNTED = replace(
    STANDING,
    integers=frozenset({"K", "J", "n"}),
    givens={**STANDING.givens, "K": (K >= 1,), "J": (J >= 1,)},
)
always = partial(forms.always, vocabulary=COUNTED)
w_1 = term(FIXED.entries[1])  # the closing speed of e_1
KAPPA = alpha * (1 + 3 * alpha) / (1 - alpha)


def flown(periods: Term, start: Vector) -> Vector:
    """The state after so many periods of flight."""
    values = {"x": term(start.entries[0]), "w": term(start.entries[1]), "K": periods}
    flight: Vector = at(derived("normal_flight_power"), values)
    return flight


def next_impact(periods: Term, start: Vector = HERE) -> Vector:
    """The state at the next impact, so many periods after an impact at `start`."""
    struck: Vector = at(
        derived("normal_f1"), {"x": term(start.entries[0]), "w": term(start.entries[1])}
    )
    return flown(periods - 1, struck)


AFTER = next_impact(K)
x_after, w_after = (term(entry) for entry in AFTER)
IN_FLIGHT = [x >= 0, x_after >= 0]  # the next impact is above the table


@claim("theorem-flights", "theorem", "argument B")
def flights_grow_shorter_below_a_third() -> list[AnyStatement]:
    """Flights end; long ones need a high closing speed and leave a low one; for alpha < 1/3 they
    grow shorter until they last one period.
    """
    one, many = (tuple(term(entry) for entry in flown(count, HERE)) for count in (term(1), n))
    last = next_impact(J, AFTER)
    return [
        Iterates("powers", ("x", "w"), one, "n", many),
        always(
            term(flown(n, HERE).entries[0]) < 0, given=[x >= 0, n >= 1, n > x + 1 - w], label="end"
        ),
        always((alpha * w >= K - 1) & (w_after <= K + 1), given=IN_FLIGHT, label="long-after-fast"),
        always(
            J - 1 <= alpha * (K + 1),
            given=[*IN_FLIGHT, term(last.entries[0]) >= 0],
            label="the-next",
        ),
        always(
            implies(equal(K, 1), equal(J, 1)) & implies(K >= 2, J < K),
            given=[J - 1 <= alpha * (K + 1)],
            in_range=[alpha > 0, 3 * alpha < 1],
            label="shorter",
        ),
    ]


@claim("theorem-kinetic", "theorem", "after 4.3")
def speeds_at_impacts_approach_that_of_the_fixed_point() -> list[AnyStatement]:
    """From impact to impact the closing speed comes nearer to that of e_1, by the factor kappa at
    least, which is below 1 exactly for alpha < 1/3.

    The relative kinetic energy, sampled at impacts, is half the square of that difference: it falls
    by kappa squared at least.
    """
    nearer = (-KAPPA * d <= w_after - w_1) & (w_after - w_1 <= KAPPA * d)
    close = [-d <= w - w_1, w - w_1 <= d]
    return [
        always(nearer, given=[*IN_FLIGHT, *close, equal(K, 1)], label="after-one-period"),
        always(nearer, given=[*IN_FLIGHT, *close, K >= 2], label="after-more"),
        always(iff(KAPPA < 1, 3 * alpha < 1), label="kappa-below-1"),
    ]
