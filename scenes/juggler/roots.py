"""For which alpha in (0, 1) polynomial conditions hold, exactly: isolated real roots, and signs
between and at them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from sympy import Poly, Rational, factor_list, refine_root
from sympy import intervals as isolating

from symbolic.symbols import alpha


@dataclass(frozen=True)
class Root:
    """The only root of an irreducible polynomial in [low, high]; rational where low = high."""

    polynomial: Any
    low: Fraction
    high: Fraction

    def nearer(self, width: Fraction) -> Root:
        """The same root between closer ends."""
        if self.high - self.low <= width:
            return self
        ends = refine_root(
            self.polynomial.as_expr(),
            _rational(self.low),
            _rational(self.high),
            eps=_rational(width),
        )
        return Root(self.polynomial, *(Fraction(int(end.p), int(end.q)) for end in ends))

    def __str__(self) -> str:
        if self.low == self.high:
            return str(self.low)
        near = self.nearer(Fraction(1, 10**9))
        return f"{float(near.low):.6f} (root of {self.polynomial.as_expr()})".replace("**", "^")


@dataclass(frozen=True)
class Range:
    """The alpha between two ends, each with whether it belongs to the range."""

    low: Root
    high: Root
    low_in: bool
    high_in: bool

    def __str__(self) -> str:
        if self.low == self.high:
            return f"alpha = {self.low}"
        return (
            f"{self.low} {'<=' if self.low_in else '<'} alpha {'<=' if self.high_in else '<'}"
            f" {self.high}"
        )


def _rational(value: Fraction) -> Any:
    return Rational(value.numerator, value.denominator)


def irreducible(polynomials: Sequence[Any]) -> list[Any]:
    """The irreducible factors of the polynomials, each once."""
    found = {
        Poly(factor, alpha).monic(): None
        for one in polynomials
        for factor, _ in factor_list(one, alpha)[1]
    }
    return [Poly(one.clear_denoms()[1], alpha) for one in found]


def roots_between(polynomials: Sequence[Any]) -> list[Root]:
    """The real roots of the polynomials strictly between 0 and 1, in order, between ends that hold
    no other root, and apart from each other.

    >>> [str(root) for root in roots_between([3 * alpha - 1, alpha**2 - 2, 2 * alpha**2 - 1])]
    ['1/3', '0.707107 (root of 2*alpha^2 - 1)']
    """
    factors = irreducible([*polynomials, alpha, alpha - 1])
    if not factors:
        return []
    found = []
    for (low, high), owners in isolating([one.as_expr() for one in factors], strict=True):
        factor, ends = factors[next(iter(owners))], [low, high]
        if factor.degree() == 1:  # a rational root, told as it is
            ends = [-factor.nth(0) / factor.nth(1)] * 2
        found.append(Root(factor, *(Fraction(int(end.p), int(end.q)) for end in ends)))
    return [
        root
        for root in found
        if root.low >= 0 and root.high <= 1 and root.polynomial.as_expr() not in (alpha, alpha - 1)
    ]


def _sign_at(polynomial: Any, at: Fraction) -> int:
    value = Poly(polynomial, alpha).eval(_rational(at))
    return int(bool(value > 0)) - int(bool(value < 0))


def sign_at_root(polynomial: Any, root: Root) -> int:
    """The sign of a polynomial, of those whose roots were isolated, at one of these roots.

    >>> roots = roots_between([2 * alpha**2 - 1, alpha - 1])
    >>> sign_at_root(alpha - 1, roots[0]), sign_at_root((2 * alpha**2 - 1) * alpha, roots[0])
    (-1, 0)
    """
    if Poly(polynomial, alpha).rem(root.polynomial).is_zero:
        return 0
    return _sign_at(polynomial, (root.low + root.high) / 2)  # between the ends it has no root


def where(nonnegative: Sequence[Any], positive: Sequence[Any] = ()) -> list[Range]:
    """All alpha in (0, 1) at which polynomials of the one list are >= 0 and those of the other > 0.

    >>> [str(one) for one in where([3 * alpha - 1, 1 - 2 * alpha])]
    ['1/3 <= alpha <= 1/2']
    >>> [str(one) for one in where([], [(alpha - 1) * alpha])]
    []
    >>> [str(one) for one in where([-((2 * alpha - 1) ** 2)])]
    ['alpha = 1/2']
    >>> [str(one) for one in where([], [(2 * alpha - 1) ** 2])]
    ['0 < alpha < 1/2', '1/2 < alpha < 1']
    """
    zero, one = (
        Root(Poly(alpha, alpha), Fraction(0), Fraction(0)),
        Root(Poly(alpha - 1, alpha), Fraction(1), Fraction(1)),
    )
    roots = [zero, *roots_between([*nonnegative, *positive]), one]
    conditions = [(Poly(part, alpha), False) for part in nonnegative] + [
        (Poly(part, alpha), True) for part in positive
    ]

    def holds(signs: Sequence[int]) -> bool:
        return all(
            sign > 0 or (sign == 0 and not strict) for sign, (_, strict) in zip(signs, conditions)
        )

    # Cells in order: root, between, root, ...; 0 and 1 do not belong to the domain.
    cells = []
    for left, right in zip(roots, roots[1:]):
        cells.append(
            left not in (zero, one) and holds([sign_at_root(part, left) for part, _ in conditions])
        )
        cells.append(holds([_sign_at(part, (left.high + right.low) / 2) for part, _ in conditions]))
    cells.append(False)
    found, begun = [], None
    for place, inside in enumerate([*cells, False]):
        if inside and begun is None:
            begun = place
        elif not inside and begun is not None:
            low, last = begun, place - 1
            found.append(
                Range(roots[low // 2], roots[(last + 1) // 2], low % 2 == 0, last % 2 == 0)
            )
            begun = None
    return found
