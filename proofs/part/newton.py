"""Why restitution is Poisson's: Newton's, C = -e C0 after the impact, can raise the energy."""

from __future__ import annotations

from fractions import Fraction

from certificates.statements import Statement
from certificates.terms import Formula, conjunction, substitute, term
from proofs.claims import claim
from proofs.forms import exists_some
from proofs.part.corner import COEFFICIENTS
from proofs.part.setting import (
    APPROACH,
    BACK,
    FRICTION,
    NO_JAM,
    PAST_COMPRESSION,
    RESTITUTION,
    S0,
    of,
    words,
    work_of,
)
from proofs.theorem.exact import value_of

CORNER = {
    "x_c": Fraction(-2),
    "y_c": Fraction(-1),
    "J": Fraction(5, 3),
}  # half-sides 1 and 2; it lies on a longer side


@claim("part-newton", "part", "restitution", parameters=())
def newtons_restitution_can_raise_the_energy() -> Statement:
    """A corner of the 1 by 2 rectangle, at e <= 1, can stick in compression in such a way that it
    would gain energy by Newton's restitution.
    """
    numbers = {name: term(value_of(value, CORNER)) for name, value in COEFFICIENTS.items()}

    def to_the_right(formula: Formula) -> Formula:
        there: Formula = substitute(formula, {"sigma": 1})
        return there

    sticks = [APPROACH, S0 >= 0, FRICTION, *RESTITUTION, NO_JAM, PAST_COMPRESSION <= 0, BACK <= 0]
    return exists_some(
        ["e", "mu", "S0", "C0"],
        to_the_right(work_of(of("newton_impulse")) > 0),
        within=[to_the_right(conjunction(sticks))],
        vocabulary=words("", **numbers),
    )
