"""Orbits in the trap in closed form: f^n(e_1 + (p, q)) = e_1 + (-alpha)^n (p - n q, q), so that
distances fall to (1 + n) alpha^n times the first.

There every period has an impact (`theorem/contracts`), and the impact map is affine: it turns the
shear (p, q) -> (p - q, q) about e_1 by -alpha.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from certificates.statements import AnyStatement, Iterates
from certificates.terms import Formula, Term, conjunction, reals, term
from proofs import forms
from proofs.claims import claim
from proofs.paper.vocabulary import STANDING, alpha, at, derived, equals
from proofs.reading.values import Vector
from proofs.theorem.definition import FIXED

p, q, n, c = reals("p q n c")
COUNTED = replace(STANDING, integers=frozenset({"n"}), givens={**STANDING.givens, "n": (n >= 0,)})
always = partial(forms.always, vocabulary=COUNTED)
SHEARED = (p - n * q, q)
# the distance after n periods, from where it is at most 1, is at most GROWTH times RATE to the n
RATE = alpha
GROWTH = 1 + n


def from_the_fixed_point(factor: Term, offset: tuple[Term, Term]) -> Vector:
    """e_1 with a multiple of the offset added."""
    return Vector(tuple(term(entry) + factor * part for entry, part in zip(FIXED.entries, offset)))


def within(most: Term) -> Formula:
    """The sheared offset is at most this in the sup norm."""
    return conjunction([bound for part in SHEARED for bound in (-most <= part, part <= most)])


@claim("theorem-closed-form", "theorem", "orbits in the trap")
def orbits_in_the_trap_in_closed_form() -> list[AnyStatement]:
    """In the trap f^n(e_1 + (p, q)) = e_1 + (-alpha)^n (p - n q, q), at most (1 + n) alpha^n from
    e_1 if (p, q) is at most 1.

    The step is an induction: c stands for (-alpha)^n, which is 1 for n = 0, and -alpha c for the
    next power.
    """
    here = from_the_fixed_point(c, SHEARED)
    after = at(derived("normal_f1"), {"x": term(here.entries[0]), "w": term(here.entries[1])})
    small = [-1 <= p, p <= 1, -1 <= q, q <= 1]
    return [
        Iterates("shear", ("p", "q"), (p - q, q), "n", SHEARED),
        always(equals(after, from_the_fixed_point(-alpha * c, (p - (n + 1) * q, q))), label="step"),
        always(within(GROWTH), given=small, label="at-most"),
    ]
