"""What SymPy derives along given flights of one impact each: impacts, the signs that keep a
denominator from 0, and a rank.

This file loads SymPy, and is called where nothing is kept of what it derives.
"""

from __future__ import annotations

from fractions import Fraction

from sympy import Expr, factor_list, fraction, together

from juggleproof import symbolic
from juggleproof.encoding import positive, tidy
from juggleproof.reading.values import Vector
from juggleproof.statements.language import Formula
from juggleproof.symbolic.algebra import lowest_terms

HALF = Fraction(1, 2)  # a restitution at which signs are read off


def in_lowest_terms(name: str, flights: tuple[int, ...], *arguments: int) -> Vector:
    """A derived state along the flights: in lowest terms, and what z1 and z2 add to it."""
    entries = []
    for entry in getattr(symbolic, name)(flights, *arguments):
        there = entry.subs({symbolic.z1: 0, symbolic.z2: 0})
        kept, *added = (tidy(part) for part in (there, entry - there) if part != 0)
        entries.append(sum(added, kept))
    return Vector(tuple(entries))


def denominators(flights: tuple[int, ...]) -> tuple[Formula, ...]:
    """Each factor of the denominators of the periodic impact has the sign that it has at 1/2."""
    return tuple(
        positive(_sign_at_half(factor) * factor)
        for entry in symbolic.normal_periodic_impact(flights)
        for factor, _ in factor_list(fraction(together(entry))[1])[1]
    )


def is_below_the_table(flights: tuple[int, ...]) -> Formula:
    """The height of the impact that the flights bring back is negative, times its denominator,
    which has one sign.
    """
    return _positive_numerator(-symbolic.normal_periodic_impact(flights)[0])


def is_a_collision(flights: tuple[int, ...]) -> Formula:
    """The closing speed of the impact that the flights bring back exceeds its height, times the
    denominator, which has one sign.
    """
    height, speed = symbolic.normal_periodic_impact(flights)
    return _positive_numerator(speed - height)


def rank_of_repeats(flights: tuple[int, ...], fast: Fraction) -> str:
    """The rank that falls by 1 each time that the flights are repeated: the sum of the heights to
    come, less what it is at (0, fast), over the depth of the point that the flights bring back.
    """
    form = symbolic.normal_sum_of_heights(flights)
    least = form.xreplace({symbolic.x: 0, symbolic.w: fast})
    return str(tidy((form - least) / -symbolic.normal_periodic_impact(flights)[0]))


def _positive_numerator(margin: Expr) -> Formula:
    above, below = fraction(lowest_terms(margin))
    return positive(_sign_at_half(below) * above)


def _sign_at_half(expression: Expr) -> int:
    return 1 if expression.subs(symbolic.alpha, HALF) > 0 else -1
