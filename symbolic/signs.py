"""Exact signs of algebraic functions of alpha on the open interval 0 < alpha < 1, by Sturm's
count.
"""

from __future__ import annotations

from functools import cache

from sympy import Expr, Poly, Pow, Rational, S, Symbol, factor, sqrt

from symbolic.algebra import DerivationError, lowest_terms
from symbolic.symbols import alpha

_HALF = Rational(1, 2)
_ROOT = Symbol("root")


@cache
def sign_for_lossy_impacts(expression: Expr) -> int:
    """The sign (-1, 0 or 1) that an expression in alpha, with at most one square root, has for all
    0 < alpha < 1.

    DerivationError if it has no constant sign there.

    >>> sign_for_lossy_impacts(alpha**2 - alpha), sign_for_lossy_impacts(2 - sqrt(2 * alpha + 2))
    (-1, 1)
    """
    rational, radicand = _name_root(expression)
    numerator, denominator = (_sign(part, radicand) for part in rational.as_numer_denom())
    if denominator == 0:
        raise DerivationError(f"division by zero: {expression}")
    return numerator * denominator


def reduced(expression: Expr) -> Expr:
    """The normal form p + q sqrt(m) with reduced fractions p and q, for an expression in alpha with
    one root.

    >>> reduced((1 + sqrt(2 * alpha + 2)) ** 2)
    2*alpha + 2*sqrt(2*alpha + 2) + 3
    """
    rational, radicand = _name_root(expression)
    over, under = (
        Poly(part, _ROOT).rem(Poly(_ROOT**2 - radicand, _ROOT))
        for part in rational.as_numer_denom()
    )
    conjugate = under.compose(Poly(-_ROOT, _ROOT))
    value = (over * conjugate).rem(Poly(_ROOT**2 - radicand, _ROOT))
    norm = (under * conjugate).rem(Poly(_ROOT**2 - radicand, _ROOT)).nth(0)
    return factor(value.nth(0) / norm) + factor(value.nth(1) / norm) * sqrt(radicand)


def _name_root(expression: Expr) -> tuple[Expr, Expr]:
    """The expression as a fraction in alpha and the symbol of its only root, and what stands below
    that root.
    """
    if S(expression).free_symbols - {alpha}:
        raise DerivationError(f"not a function of alpha alone: {expression}")
    powers = [
        power for power in S(expression).atoms(Pow) if power.exp.is_Rational and power.exp.q == 2
    ]
    bases = {power.base for power in powers}
    if len(bases) > 1:
        raise DerivationError(f"more than one root: {expression}")
    fraction = lowest_terms(S(expression).xreplace({power: _ROOT**power.exp.p for power in powers}))
    return fraction, bases.pop() if bases else S.One


def _sign(expression: Expr, radicand: Expr) -> int:
    """The constant sign of a polynomial in alpha and the root of the radicand."""
    remainder = Poly(expression, _ROOT).rem(Poly(_ROOT**2 - radicand, _ROOT))
    p, q, m = (Poly(part, alpha) for part in (remainder.nth(0), remainder.nth(1), radicand))
    if p.is_zero and q.is_zero:
        return 0
    # p + q sqrt(m) can change sign only where m or the norm p^2 - q^2 m vanishes.
    for changing in (m, p**2 - q**2 * m):
        if changing.is_zero or _vanishes(changing):
            raise DerivationError(f"the sign may change with alpha: {expression}")
    p, q, m = (part.eval(_HALF) for part in (p, q, m))
    if m < 0:
        raise DerivationError(f"root of a negative number: {radicand}")
    larger = p if p**2 > q**2 * m else q
    return 1 if larger > 0 else -1


def _vanishes(polynomial: Poly) -> bool:
    """Whether a polynomial in alpha has a zero in the open interval (the ends are divided out
    before counting).
    """
    ends = (Poly(alpha, alpha), Poly(alpha - 1, alpha))
    inner = (part for part, _ in polynomial.factor_list()[1] if part not in ends)
    return any(part.count_roots(0, 1) for part in inner)


def simplest_roots(polynomial: Poly) -> tuple[Expr, ...]:
    """The zeros of a polynomial of degree at most 2 over Q(alpha); none where they are complex for
    0 < alpha < 1.

    Squares are taken out of the root.

    >>> from symbolic.symbols import w
    >>> simplest_roots(Poly((1 - alpha) ** 2 * w**2 - 2 * (1 + alpha), w))
    (sqrt(2*alpha + 2)/(alpha - 1), -sqrt(2*alpha + 2)/(alpha - 1))
    >>> simplest_roots(Poly(w**2 + alpha, w))
    ()
    """
    # The leading coefficient must not vanish for any alpha; its sign does not matter.
    if sign_for_lossy_impacts(polynomial.LC()) == 0:
        raise DerivationError(f"every number is a zero: {polynomial}")
    if polynomial.degree() == 0:
        return ()
    if polynomial.degree() == 1:
        return (lowest_terms(-polynomial.nth(0) / polynomial.nth(1)),)
    if polynomial.degree() > 2:
        raise DerivationError(f"of too high a degree: {polynomial}")
    a, b, c = (polynomial.nth(power) for power in (2, 1, 0))
    numerator, denominator = lowest_terms(b**2 - 4 * a * c).as_numer_denom()
    if sign_for_lossy_impacts(numerator * denominator) < 0:
        return ()
    outside, inside = _square_taken_out(Poly(numerator * denominator, alpha))
    spread = lowest_terms(outside / denominator / (2 * a)) * sqrt(inside)
    middle = lowest_terms(-b / (2 * a))
    return middle + spread, middle - spread


def _square_taken_out(radicand: Poly) -> tuple[Expr, Expr]:
    """Factors s and m with radicand = s^2 m, m without square factors."""
    content, factors = radicand.factor_list()
    outside, inside = S.One, S.One
    for part, multiplicity in [*S(content).factors().items(), *factors]:
        base = part.as_expr() if isinstance(part, Poly) else S(part)
        outside *= base ** (multiplicity // 2)
        inside *= base ** (multiplicity % 2)
    return outside, inside.expand()
