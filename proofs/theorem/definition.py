"""The map in normal form, and what is chosen to prove the theorem about it: rank, stages and
contraction.

x is the height in units of r T, w = 1 - v/r the closing speed in units of r.  Map, fixed points and
energies are derived; rank, stages, weights, rates and radii are choices that the premises of the
checker's rules have to confirm.
"""

from __future__ import annotations

from dataclasses import dataclass

from certificates.terms import Formula, Term, conjunction, reals, substitute, term
from proofs.paper.vocabulary import w, x
from proofs.reading.values import Vector
from proofs.theorem.written import opposite, positive, tidied
from symbolic.normal_form import normal_margin

alpha, u, e_x, e_w = reals("alpha u e_x e_w")
WHOLE = (
    (alpha > 0) & (alpha < 1) & (1 - alpha > 0) & (1 + alpha > 0)
)  # the last two are there for what is divided by
BELOW_A_THIRD = (alpha > 0) & (3 * alpha < 1) & (1 + alpha > 0)
FROM_A_THIRD = (3 * alpha >= 1) & (alpha < 1) & (1 + alpha > 0)

SPACE = term(0) <= x
IMPACT: Formula = positive(normal_margin())  # inequality (7)
PIECES = ((IMPACT, tidied("normal_f1")), (opposite(IMPACT), tidied("normal_f2")))
FIXED: Vector = tidied("normal_e_1")
OTHER: Vector = tidied(
    "normal_e_2"
)  # the orbit of e_2 at its impact: an impact, a flight, and it is back


@dataclass(frozen=True)
class Descent:
    """A rank that falls by 1 at least outside of all stages, roots that it is written with, and
    stages of which the last is the trap.
    """

    rank: Term
    stages: tuple[Formula, ...]
    roots: tuple[tuple[str, Term], ...] = ()


@dataclass(frozen=True)
class Contraction:
    """A set that is mapped into itself and brought closer to the fixed point, in the weighted sup
    norm, by the rate.
    """

    on: Formula
    weights: tuple[Term, Term]
    rate: Term
    radius: Term
    size: Term


def near(*distances: Term) -> Formula:
    """Each component differs from that of the fixed point, (e_x, e_w), by no more than its
    distance.
    """
    pairs = zip((x, w), (e_x, e_w), distances)
    return conjunction(
        [
            part
            for name, entry, most in pairs
            for part in (name - entry <= most, entry - name <= most)
        ]
    )


def at_the_point(formula: Formula) -> Formula:
    """The formula with the fixed point put in for its names."""
    put_in: Formula = substitute(formula, dict(zip(("e_x", "e_w"), map(term, FIXED.entries))))
    return put_in


SPEED = ("u", 4 * x + (w - 1) ** 2)  # u^2 is twice the energy in units of r^2
TRAP = conjunction([SPACE, IMPACT, alpha * w < 1])
NEAR_IN_TRAP = TRAP & near(term(1), term(1))
CORE = at_the_point(NEAR_IN_TRAP)
# An impact with w < 6 leads to x + w <= 2, that to the trap, and one step more to within 1 of the
# fixed point.
TO_THE_POINT = Descent(
    2 * u + (1 - w) / 2, (IMPACT & (w < 6), (term(0) < w) & (x + w <= 2), TRAP, CORE), (SPEED,)
)
IN_THE_TRAP = Contraction(CORE, (term(1), term(1)), 2 * alpha, term(1) / 2, term(1))

# Near e_1 the map contracts this norm for every 0 < alpha < 1.
WEIGHTS, RADIUS = (2 * alpha / (1 - alpha), term(1)), (1 - alpha) / (1 + alpha) ** 2
NEARBY = Contraction(
    at_the_point(near(*(RADIUS * weight for weight in WEIGHTS))),
    WEIGHTS,
    (1 + alpha) / 2,
    RADIUS,
    RADIUS,
)
