"""Polynomials of a search as terms and formulas of the language of statements."""

from __future__ import annotations

from math import lcm

from flint import fmpq_mpoly

from certificates.terms import Formula, Term, real, term

from .algebraic import fraction


def relation_of(poly: fmpq_mpoly, relation: str) -> Formula:
    """The formula: polynomial relation 0, coefficients made whole."""
    return Formula(relation, term_of(poly), term(0))


def term_of(poly: fmpq_mpoly) -> Term:
    """A polynomial, times the least number that makes its coefficients whole, as a term."""
    names = poly.context().names()
    scale = lcm(*(int(c.q) for c in poly.coeffs()))
    total: Term | None = None
    for powers, c in (poly * scale).to_dict().items():
        value = fraction(c)
        part: Term | None = None
        for name, e in zip(names, powers):
            if e:
                factor: Term = real(name) if e == 1 else real(name) ** int(e)
                part = factor if part is None else part * factor
        size: Term = (
            term(abs(value)) if part is None else part if abs(value) == 1 else abs(value) * part
        )
        total = (
            (size if value > 0 else -size)
            if total is None
            else total + size
            if value > 0
            else total - size
        )
    return term(0) if total is None else total
