"""Terms and formulas at exact rational points, and exact comparison of integers with numbers that
have square roots in them.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from fractions import Fraction
from math import isqrt
from typing import Any

from certificates.terms import ClaimError, Formula, Term

Point = Mapping[str, Fraction]
_ARITHMETIC: dict[str, Callable[..., Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "neg": operator.neg,
    "^": operator.pow,
}
_RELATIONS: dict[str, Callable[..., bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    "=": operator.eq,
    "!=": operator.ne,
    ">=": operator.ge,
    ">": operator.gt,
}


def value_of(expression: Term, point: Point) -> Fraction:
    """The value of a term where its variables have these values.

    >>> from certificates.terms import reals
    >>> x, w = reals("x w")
    >>> value_of((x - w**2) / 3, {"x": Fraction(1), "w": Fraction(1, 2)})
    Fraction(1, 4)
    """
    if expression.op == "num":
        return Fraction(expression.args[0])
    if expression.op == "var":
        if expression.args[0] not in point:
            raise ClaimError(f"{expression.args[0]} has no value here")
        return point[expression.args[0]]
    parts = [value_of(part, point) if isinstance(part, Term) else part for part in expression.args]
    return Fraction(_ARITHMETIC[expression.op](*parts))


def holds_at(formula: Formula, point: Point) -> bool:
    """Whether a formula of `and`, `or` and `not` over relations holds where its variables have
    these values.
    """
    if formula.op in _RELATIONS:
        return _RELATIONS[formula.op](*(value_of(side, point) for side in formula.args))
    parts = (holds_at(part, point) for part in formula.args)
    if formula.op in ("and", "or"):
        return all(parts) if formula.op == "and" else any(parts)
    if formula.op == "not":
        return not next(parts)
    raise ClaimError(f"{formula} cannot be decided at a point")


def linear_in(expression: Term, name: str, point: Point) -> tuple[Fraction, Fraction]:
    """(constant, slope) of a term that is linear in the named variable, at a point of its other
    variables.
    """
    values = [value_of(expression, {**point, name: Fraction(k)}) for k in range(3)]
    if values[2] - values[1] != values[1] - values[0]:
        raise ClaimError(f"{expression} is not linear in {name}")
    return values[0], values[1] - values[0]


def sign_with_root(p: Fraction, q: Fraction, square: Fraction) -> int:
    """The sign of p + q sqrt(square).

    >>> triples = (1, -1, 2), (2, -1, 2), (2, -1, 4)
    >>> [sign_with_root(*map(Fraction, triple)) for triple in triples]
    [-1, 1, 0]
    """
    of_p, of_q = (p > 0) - (p < 0), ((q > 0) - (q < 0)) * (square > 0)
    if of_p * of_q >= 0:
        return of_p or of_q
    return of_p * ((p * p > q * q * square) - (p * p < q * q * square))


def least_integer(enough: Callable[[int], bool], start: int = 0) -> int:
    """The least integer from `start` on for which `enough` holds, which stays true from there
    on.
    """
    if enough(start):
        return start
    width = 1
    while not enough(start + width):
        width *= 2
    low, high = start + width // 2, start + width  # not enough at low, enough at high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if enough(middle) else (middle, high)
    return high


def ceiling(constant: Fraction, factor: Fraction, square: Fraction) -> int:
    """The least integer that is not below constant + factor sqrt(square), for factor >= 0.

    >>> ceiling(Fraction(0), Fraction(2), Fraction(2))
    3
    >>> ceiling(Fraction(1, 2), Fraction(1), Fraction(9, 4))
    2
    """
    low = (constant.numerator // constant.denominator) + isqrt(factor**2 * square // 1)
    return least_integer(lambda n: sign_with_root(n - constant, -factor, square) >= 0, low)
