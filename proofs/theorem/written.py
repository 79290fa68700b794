"""Derived SymPy expressions as texts that the checker reads: one fraction, what is added before
what is taken away.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, factor, fraction

import symbolic
from certificates.terms import ClaimError, Formula, Term, term
from proofs.encoding import from_sympy
from proofs.paper import vocabulary
from proofs.reading.values import Vector
from symbolic.algebra import lowest_terms


def tidied(name: str, **values: int) -> Vector:
    """A derived column of `symbolic` in lowest terms, with numbers put for some of its symbols.

    >>> print(*tidied("e_1"))
    4*alpha*r^2/(g*(alpha + 1)^2) (alpha*r - r)/(alpha + 1)
    """
    vocabulary.derivations_used.append((name, ()))
    return Vector(tuple(tidy(entry) for entry in getattr(symbolic, name)().subs(values)))


def written(expression: Expr) -> str:
    """The text of an expression in lowest terms.

    >>> from symbolic.symbols import alpha, w
    >>> written(2 - alpha * w), written((1 - alpha) / (alpha**2 + 2 * alpha + 1))
    ('2 - alpha*w', '(1 - alpha)/(alpha + 1)^2')
    >>> written((alpha + 1) / (1 - alpha))
    '(alpha + 1)/(1 - alpha)'
    """
    return str(tidy(expression))


def tidy(expression: Expr) -> Term:
    """The expression in lowest terms: an expanded numerator, positive terms first, over a factored
    denominator.
    """
    above, below = fraction(lowest_terms(expression))
    if not _by_sign(above)[0]:
        above, below = -above, -below
    numerator, factored = _difference(above), factor(below)
    if below == 1:
        return numerator
    return numerator / (
        _difference(below)
        if below.is_Add and not (factored.is_Mul or factored.is_Pow)
        else from_sympy(factored)
    )


def positive(margin: Expr) -> Formula:
    """The formula margin > 0, what is taken away on the left of <.

    >>> from symbolic.symbols import w, x
    >>> str(positive(w**2 - x + 1))
    'x < w^2 + 1'
    """
    above, below = fraction(lowest_terms(margin))
    if not below.is_Rational or below <= 0:
        raise ClaimError(f"the sign of {margin} is not that of a polynomial")
    kept, taken = _by_sign(above)
    return _sum(taken) < _sum(kept)


def opposite(strict: Formula) -> Formula:
    """The other side of a strict inequality.

    >>> from certificates.terms import reals
    >>> x, w = reals("x w")
    >>> str(opposite(x < w))
    'w <= x'
    """
    if strict.op != "<":
        raise ClaimError(f"{strict} is not one strict inequality")
    left, right = strict.args
    other: Formula = right <= left
    return other


def _difference(polynomial: Expr) -> Term:
    kept, taken = _by_sign(polynomial)
    total = _sum(kept) if kept else -_sum(taken)
    for part in taken if kept else []:
        total = total - part
    return total


def _by_sign(polynomial: Expr) -> tuple[list[Term], list[Term]]:
    parts = polynomial.expand().as_ordered_terms()
    kept = [from_sympy(part) for part in parts if not part.could_extract_minus_sign()]
    return kept, [from_sympy(-part) for part in parts if part.could_extract_minus_sign()]


def _sum(parts: Sequence[Term]) -> Term:
    total = parts[0] if parts else term(0)
    for part in parts[1:]:
        total = total + part
    return total
