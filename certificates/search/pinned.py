"""Whole numbers that the hypotheses tie to a parameter, as floor and ceiling do: the pairs of both
are where a range is sought.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import fmpq, fmpq_mpoly

from certificates import checker
from certificates.terms import Formula, conjunction

from .budget import Budget
from .candidates import UNITS
from .condition import Condition, ring_of
from .elimination import without_equations
from .near import ring_names
from .writing import relation_of


def pinned(
    statements: Sequence[checker.Statement], parameter: str, domain: Any, budget: Budget
) -> tuple[str, Formula] | None:
    """(a whole number of all the statements, what their hypotheses say of it and the parameter
    alone), units being 1.

    >>> text = "statement a/b\\nforall alpha n x\\ninteger n\\n"
    >>> text += "given n <= 2*alpha and 2*alpha < n + 1\\nshow x*n <= 2*x*alpha"
    >>> (one,) = checker.read_statements(text).values()
    >>> str(pinned([one], "alpha", checker.parse("alpha > 0"), Budget(10**5))[1])
    '2*alpha - n >= 0 and -2*alpha + n + 1 > 0'
    """
    for name in sorted({n for each in statements for line in each.get("integer") for n in line}):
        said = [_said(each, parameter, name, domain, budget) for each in statements]
        if said and all(said):
            return name, conjunction(
                list({str(formula): formula for formulas in said for formula in formulas}.values())
            )
    return None


def _said(
    statement: checker.Statement, parameter: str, name: str, domain: Any, budget: Budget
) -> list[Formula]:
    story = checker.Unfolding(statement, checker.Context(), [domain])
    if name not in story.integers or name not in story.universal:
        return []
    ring = ring_of(story.context)
    premises = Condition.of(story.context, checker.join("and", list(story.premises)), ring)
    premises = premises.substituted({unit: fmpq(1) for unit in UNITS & story.variables})
    left, _ = without_equations(premises, {parameter, name}, budget, ())
    positive = [
        poly
        for poly, relation in left.facts()
        if relation == ">" and ring_names(poly) == {parameter}
    ]
    return [
        relation_of(_without(positive, poly), relation)
        for poly, relation in left.facts()
        if ring_names(poly) == {parameter, name}
    ]


def _without(positive: Sequence[fmpq_mpoly], poly: fmpq_mpoly) -> fmpq_mpoly:
    """The polynomial divided by what is positive, as often as that goes."""
    for factor in positive:
        while True:
            quotient, rest = divmod(poly, factor)
            if rest != 0:
                break
            poly = quotient
    return poly
