"""What (26) and A.4 count with: the least loss of an impact outside R, derived or as the third line
of A.3.2 prints it, in units of r^2.

The bracket, (E - E_max - Delta E_max)/(-Delta E_sup), is at most n where u^2 <= 2 (level + n loss),
u^2 being twice the energy.  With the derived loss, rounded up, it counts enough impacts.  With the
printed loss it does exactly where `ENOUGH` holds, alpha <= 0.3645..: an impact from the ground with
bracket 1 then leads into R, and one with more loses as much as is counted.  Beyond, such an impact
leaves the ball outside of R, in all readings of time: its flight before took m > u - 1 periods, the
next impact comes a period later at the earliest, and u < m + 1 is all of (26).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from certificates.statements import AnyStatement
from certificates.terms import Term, equal, iff, reals, term
from proofs import forms
from proofs.claims import claim
from proofs.paper.outside import LEVEL, PRINTED_SUPREMUM
from proofs.paper.vocabulary import PAPER, STANDING, alpha, at, derived, equals, s, x
from proofs.reading.printed import read
from proofs.reading.values import Vector
from proofs.theorem.definition import IMPACT, SPACE, SPEED, u
from proofs.theorem.flights import flown

m, n = reals("m n")
COUNTED = replace(STANDING, integers=frozenset({"m", "n"}))
always = partial(forms.always, vocabulary=COUNTED)


def in_units(energy: object) -> Term:
    """An energy in units of r^2."""
    scaled: Term = at(energy, {"r": 1})
    return scaled


LEVEL_OF_R = in_units(LEVEL)  # the energy up to which R reaches
TRUE_LOSS = in_units(-term(derived("delta_E_sup")))
PRINTED_LOSS = in_units(-term(read(PRINTED_SUPREMUM).right(PAPER)))
ENOUGH = 2 * s * (1 - alpha + alpha**2) <= 3 - alpha - 2 * alpha**3
MARGIN = (
    1,
    2,
    -7,
    -20,
    12,
    -8,
    4,
    # coefficients of the polynomial in alpha alone that is >= 0 where ENOUGH holds; 0.3645.. is its
    # root
)
TOO_MUCH = 4 * alpha * s > (1 - alpha) * (
    1 + alpha
)  # where the printed loss is above the derived one
CORNER = s / (1 - alpha)  # the u of the border of R
GROUND = Vector((0, 1 + u))  # the ball comes down to the ground with u
AFTER_GROUND = alpha * u + 1 + alpha  # the u after the impact there
AFTER_IMPACT: Vector = derived("normal_f1")


def written(coefficients: Sequence[int]) -> Term:
    """The polynomial in alpha with these coefficients, from the constant up."""
    total = term(coefficients[0])
    for k, c in enumerate(coefficients[1:], 1):
        total = total + c * alpha**k
    return total


def at_state(thing: Any, state: Vector) -> Any:
    """A term or formula of (x, w) at this state."""
    return at(thing, {"x": term(state.entries[0]), "w": term(state.entries[1])})


def before_the_ground(periods: Term) -> Vector:
    """The state so many periods before the ball strikes on the ground, coming down with u."""
    return Vector((periods * (u - periods), 1 + u - 2 * periods))


@claim("theorem-count", "theorem", "(26) and A.4")
def printed_loss_counts_too_few_impacts() -> list[AnyStatement]:
    """The bracket of (26), rounded up, counts enough impacts with the loss that A.3.2 prints just
    for alpha up to 0.3645.., an algebraic number.

    Of the states sampled once a period (26) is too early for every alpha and either loss: u < m + 1
    periods are counted, and m + 1 are needed.
    """
    speed, struck = (
        SPEED[1],
        Vector(tuple(at_state(entry, GROUND) for entry in derived("normal_f1").entries)),
    )
    outside, one = u > CORNER, u**2 <= 2 * (LEVEL_OF_R + PRINTED_LOSS)
    most = u**2 >= 2 * (LEVEL_OF_R + PRINTED_LOSS)
    margin = written(MARGIN)
    slope = written([k * c for k, c in enumerate(MARGIN)][1:])
    in_flight = [u > 0, m <= u, u < m + 1, m >= 1]
    return [
        always(iff(PRINTED_LOSS > TRUE_LOSS, TOO_MUCH), label="differs"),
        always(
            at_state(speed, AFTER_IMPACT) <= (alpha * u + 1 + alpha) ** 2,
            given=[x >= 0, IMPACT, u >= 0, equal(u**2, speed)],
            label="impact",
        ),
        always(AFTER_GROUND <= CORNER, given=[u >= 0, one, ENOUGH], label="one-is-enough"),
        always(
            u**2 - AFTER_GROUND**2 >= 2 * PRINTED_LOSS,
            given=[outside, most, ENOUGH],
            label="more-lose-as-counted",
        ),
        always(
            at_state(IMPACT, GROUND)
            & equal(at_state(speed, GROUND), u**2)
            & equal(at_state(speed, struck), AFTER_GROUND**2),
            given=[u > 0],
            label="on-the-ground",
        ),
        always(AFTER_GROUND > CORNER, given=[u > 0, most, ~ENOUGH], label="one-is-not-enough"),
        always(
            at_state(SPACE & ~IMPACT, before_the_ground(m))
            & equals(flown(m, before_the_ground(m)), GROUND),
            given=in_flight,
            label="flight",
        ),
        always(
            ~at_state(IMPACT, before_the_ground(n)),
            given=[*in_flight, n >= 1, n <= m],
            label="in-flight-between",
        ),
        always(equal(CORNER**2, 2 * LEVEL_OF_R), label="corner"),
        always(iff(ENOUGH, margin >= 0), label="enough-by-alpha"),
        always(slope < 0, given=[5 * alpha >= 1], label="falls-there"),
        always(ENOUGH, given=[1000 * alpha <= 364], label="enough-up-to"),
        always(~ENOUGH, given=[1000 * alpha >= 365], label="not-enough-from"),
        always(
            iff(TOO_MUCH, 32 * alpha**2 > (1 - alpha) ** 2 * (1 + alpha)), label="differs-by-alpha"
        ),
        always((TRUE_LOSS > 0) & (PRINTED_LOSS > 0), label="losses"),
    ]
