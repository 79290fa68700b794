"""The map in normal form, and what is chosen to prove the theorem about it: rank, stages and contraction.

x is the height in units of r T, w = 1 - v/r the closing speed in units of r.  Map, fixed points and energies are derived; rank, stages,
weights, rates and radii are choices that the premises of the checker's rules have to confirm.
"""

from __future__ import annotations

from dataclasses import dataclass

from certificates.terms import Formula, Term, conjunction, reals, term
from proofs.paper.vocabulary import derived, factored, w, x
from proofs.reading.values import Vector

alpha, u = reals("alpha u")
WHOLE = (alpha > 0) & (alpha < 1) & (1 - alpha > 0) & (1 + alpha > 0)  # the last two are there for what is divided by
BELOW_A_THIRD = (alpha > 0) & (3 * alpha < 1) & (1 + alpha > 0)
FROM_A_THIRD = (3 * alpha >= 1) & (alpha < 1) & (1 + alpha > 0)

SPACE = x >= 0
IMPACT: Formula = derived("normal_margin") > 0
PIECES = ((IMPACT, factored("normal_f1")), (derived("normal_margin") <= 0, factored("normal_f2")))
FIXED: Vector = factored("normal_e_1")
OTHER: Vector = factored("normal_e_2")  # the orbit of e_2 at its impact: an impact, a flight, and it is back


@dataclass(frozen=True)
class Descent:
    """A rank that falls by 1 at least outside of all stages, roots that it is written with, and stages of which the last is the trap."""

    rank: Term
    stages: tuple[Formula, ...]
    roots: tuple[tuple[str, Term], ...] = ()


@dataclass(frozen=True)
class Contraction:
    """A set that is mapped into itself and brought closer to the fixed point, in the weighted sup norm, by the rate."""

    on: Formula
    weights: tuple[Term, Term]
    rate: Term
    radius: Term
    size: Term


def within(*distances: Term) -> Formula:
    """Each component differs from that of the fixed point by no more than its distance."""
    offsets = [name - term(entry) for name, entry in zip((x, w), FIXED.entries)]
    return conjunction([part for offset, most in zip(offsets, distances) for part in (-most <= offset, offset <= most)])


SPEED = ("u", 4 * x + (w - 1) ** 2)  # u^2 is twice the energy in units of r^2
TRAP = IMPACT & (alpha * w < 1)
CORE = TRAP & within(term(1), term(1))
# An impact with w < 6 leads to x + w <= 2, that to the trap, and one step more to within 1 of the fixed point.
TO_THE_POINT = Descent(2 * u + (1 - w) / 2, (IMPACT & (w < 6), (w > 0) & (x + w <= 2), TRAP, CORE), (SPEED,))
IN_THE_TRAP = Contraction(CORE, (term(1), term(1)), 2 * alpha, term(1) / 16, term(1))

WEIGHTS = (2 * alpha, 1 - alpha)
NEARBY = Contraction(within(alpha / 2, (1 - alpha) / 4), WEIGHTS, (1 + alpha) / 2, term(1) / 4, term(1) / 4)
