"""The one encoder from SymPy expressions to exact terms."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction

from sympy import Expr, cancel, factor, fraction

from juggleproof.statements.language import ClaimError, Formula, Term, real, term


def from_sympy(expression: Expr, roots: Mapping[Expr, Term] | None = None) -> Term:
    """The term of a SymPy expression that is rational in its symbols.

    `roots` gives the term that stands for the square root of a SymPy radicand.  Raises ClaimError
    for floats and functions.

    >>> from sympy import Rational, Symbol
    >>> x, y = Symbol("x"), Symbol("y")
    >>> str(from_sympy(Rational(1, 3) * x**2 / (y - 1)))
    'x^2/(3*(y - 1))'
    """
    if expression.is_Symbol:
        return real(expression.name)
    if expression.is_Rational:
        return term(Fraction(int(expression.p), int(expression.q)))
    if expression.is_Add:
        return _sum(expression, roots)
    if expression.is_Mul:
        return _product(expression, roots)
    if expression.is_Pow:
        base, exponent = expression.base, expression.exp
        if exponent.is_Integer:
            return from_sympy(base, roots) ** int(exponent)
        twice = 2 * exponent
        if twice.is_Integer:
            return _root(base, roots) ** int(twice) if twice != 1 else _root(base, roots)
    raise ClaimError(
        f"{expression} is not rational in its symbols; adjoin its roots and write the rest exactly"
    )


def _sum(expression: Expr, roots: Mapping[Expr, Term] | None) -> Term:
    return signed_sum(
        (negative, from_sympy(-part if negative else part, roots))
        for part in expression.as_ordered_terms()
        for negative in [part.could_extract_minus_sign()]
    )


def signed_sum(parts: Iterable[tuple[bool, Term]]) -> Term:
    """The sum of terms in order, each with whether it is taken away; 0 where there are none.

    >>> str(signed_sum([(True, real("x")), (False, real("y")), (True, term(2))]))
    '-x + y - 2'
    """
    total: Term | None = None
    for negative, piece in parts:
        if total is None:
            total = -piece if negative else piece
        else:
            total = total - piece if negative else total + piece
    return term(0) if total is None else total


def _product(expression: Expr, roots: Mapping[Expr, Term] | None) -> Term:
    """Factors with positive exponents above, those with negative ones below, as SymPy holds them:
    nothing is multiplied out.
    """
    above: list[Term] = []
    below: list[Term] = []
    negative = False
    for one in expression.as_ordered_factors():
        if one.is_Rational:
            negative ^= bool(one.p < 0)
            above += [term(abs(int(one.p)))] if abs(one.p) != 1 else []
            below += [term(int(one.q))] if one.q != 1 else []
        elif one.is_Pow and one.exp.could_extract_minus_sign():
            below.append(from_sympy(1 / one, roots))
        else:
            above.append(from_sympy(one, roots))
    product = _multiplied(above)
    product = product / _multiplied(below) if below else product
    return -product if negative else product


def _multiplied(factors: list[Term]) -> Term:
    if not factors:
        return term(1)
    product = factors[0]
    for one in factors[1:]:
        product = product * one
    return product


def _root(base: Expr, roots: Mapping[Expr, Term] | None) -> Term:
    for radicand, name in (roots or {}).items():
        if (radicand - base).expand() == 0:
            return name
    raise ClaimError(f"the square root of {base} has no name here; adjoin it with a root line")


# -------------------------------------------------------------------------------------------------
# In lowest terms: one fraction, what is added before what is taken away.


def written(expression: Expr) -> str:
    """The text of an expression in lowest terms.

    >>> from sympy import symbols
    >>> alpha, w = symbols("alpha w")
    >>> written(2 - alpha * w), written((1 - alpha) / (alpha**2 + 2 * alpha + 1))
    ('2 - alpha*w', '(1 - alpha)/(alpha + 1)^2')
    >>> written((alpha + 1) / (1 - alpha)), written(-alpha * w)
    ('(alpha + 1)/(1 - alpha)', '-alpha*w')
    """
    return str(tidy(expression))


def tidy(expression: Expr) -> Term:
    """The expression in lowest terms: an expanded numerator, positive terms first, over a factored
    denominator.
    """
    above, below = fraction(cancel(expression))
    if below != 1 and not _by_sign(above)[0]:
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

    >>> from sympy import symbols
    >>> w, x = symbols("w x")
    >>> str(positive(w**2 - x + 1))
    'x < w^2 + 1'
    """
    above, below = fraction(cancel(margin))
    if not below.is_Rational or below <= 0:
        raise ClaimError(f"the sign of {margin} is not that of a polynomial")
    kept, taken = _by_sign(above)
    return _added(taken) < _added(kept)


def _difference(polynomial: Expr) -> Term:
    kept, taken = _by_sign(polynomial)
    total = _added(kept) if kept else -_added(taken)
    for part in taken if kept else []:
        total = total - part
    return total


def _by_sign(polynomial: Expr) -> tuple[list[Term], list[Term]]:
    parts = polynomial.expand().as_ordered_terms()
    kept = [from_sympy(part) for part in parts if not part.could_extract_minus_sign()]
    return kept, [from_sympy(-part) for part in parts if part.could_extract_minus_sign()]


def _added(parts: Sequence[Term]) -> Term:
    total = parts[0] if parts else term(0)
    for part in parts[1:]:
        total = total + part
    return total
