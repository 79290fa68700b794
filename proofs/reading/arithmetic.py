"""Sums, products and powers of values of any kind; what does not fit is refused with what was
tried.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from certificates.terms import Formula, Term
from proofs.reading.notions import Region
from proofs.reading.values import Matrix, ShapeError, Vector, is_scalar, over


def kind_of(value: Any) -> str:
    """What a value is, in a word, for messages."""
    if is_scalar(value):
        return "a scalar"
    if isinstance(value, (Formula, Vector, Matrix, Region)):
        return f"a {type(value).__name__.lower()}"
    return "a function" if callable(value) else f"{type(value).__name__}"


def _both(left: Any, right: Any, deed: str) -> None:
    fits = is_scalar(left) and is_scalar(right)
    if not (fits or (type(left) is type(right) and isinstance(left, (Vector, Matrix)))):
        raise ShapeError(f"a {deed} of {kind_of(left)} and {kind_of(right)}")


def add(left: Any, right: Any) -> Any:
    """left + right."""
    _both(left, right, "sum")
    return left + right


def subtract(left: Any, right: Any) -> Any:
    """left - right, of numbers or of regions."""
    if isinstance(left, Region) and isinstance(right, Region):
        return left - right
    _both(left, right, "difference")
    return left - right


def union(left: Any, right: Any) -> Region:
    """The union of two regions."""
    if isinstance(left, Region) and isinstance(right, Region):
        return left | right
    raise ShapeError(f"a union of {kind_of(left)} and {kind_of(right)}")


def negate(value: Any) -> Any:
    """-value."""
    if is_scalar(value) or isinstance(value, (Vector, Matrix)):
        return -value
    raise ShapeError(f"minus {kind_of(value)}")


def multiply(left: Any, right: Any) -> Any:
    """left right: scalars, a scalar and a vector or matrix, a matrix and a vector or matrix."""
    number = is_scalar(left), is_scalar(right)
    if (
        all(number)
        or number[0]
        and isinstance(right, (Vector, Matrix))
        or number[1]
        and isinstance(left, (Vector, Matrix))
    ):
        return left * right if number[1] else right.scaled(left)
    if isinstance(left, Matrix) and isinstance(right, (Vector, Matrix)):
        return left * right
    raise ShapeError(f"a product of {kind_of(left)} and {kind_of(right)}")


def raised(base: Any, exponent: int) -> Any:
    """base to an integer power."""
    if isinstance(base, Matrix):
        return base.power(exponent)
    if isinstance(base, Term):
        return base**exponent if exponent >= 0 else over(1, base**-exponent)
    if not is_scalar(base):
        raise ShapeError(f"a power of {kind_of(base)}")
    return Fraction(base) ** exponent if exponent >= 0 else over(1, Fraction(base) ** -exponent)
