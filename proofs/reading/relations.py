r"""The formula that `left sign right` states, for values of every kind.

A definition := and an identity \equiv state equality; vectors are equal entry by entry, regions at
the present state, a list of cases case by case; a restricted function is spoken of inside its
region only; \subset allows equality.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from certificates.terms import (
    Formula,
    conjunction,
    different,
    disjunction,
    equal,
    iff,
    implies,
    term,
)
from proofs.reading.arithmetic import kind_of
from proofs.reading.notions import Guarded, Image, Piecewise, Region, Rounded, applied
from proofs.reading.values import Matrix, Scalar, ShapeError, Vector, is_scalar

EQUALITIES = frozenset(("=", ":=", r"\equiv"))
_INCLUSIONS = frozenset((r"\subset", r"\subseteq"))
_OF_TERMS: dict[str, Callable[[Any, Any], Formula]] = {
    "=": equal,
    ":=": equal,
    r"\equiv": equal,
    r"\ne": different,
    "<": lambda a, b: term(a) < b,
    ">": lambda a, b: term(a) > b,
    r"\le": lambda a, b: term(a) <= b,
    r"\ge": lambda a, b: term(a) >= b,
}


def relate(left: Any, sign: str, right: Any, state: Any = None) -> Formula:
    """The formula of one relation; `state` is where regions are compared."""
    if is_scalar(left) and is_scalar(right) and sign in _OF_TERMS:
        return _OF_TERMS[sign](left, right)
    for value, other, turned in ((left, right, False), (right, left, True)):
        if isinstance(value, Guarded):
            inner = (other, sign, value.value) if turned else (value.value, sign, other)
            return value.under(relate(*inner, state))
        if isinstance(value, Piecewise) and sign in EQUALITIES:
            return _by_cases(other, value, state)
        if isinstance(value, Rounded) and sign in EQUALITIES and is_scalar(value.value):
            return _rounds(other, value)
    if sign in (r"\in", r"\notin"):
        return _member(left, sign, right)
    if isinstance(left, (Region, Image)) and isinstance(right, Region):
        return _of_regions(left, sign, right, state)
    if (
        isinstance(left, (Vector, Matrix))
        and type(left) is type(right)
        and (sign in EQUALITIES or sign == r"\ne")
    ):
        pairs = _pairs(left, right)
        if sign == r"\ne":
            return disjunction([different(a, b) for a, b in pairs])
        return conjunction([equal(a, b) for a, b in pairs])
    raise ShapeError(f"{sign} between {kind_of(left)} and {kind_of(right)} states no formula")


def _pairs(left: Any, right: Any) -> list[tuple[Scalar, Scalar]]:
    if isinstance(left, Matrix):
        if left.shape != right.shape:
            raise ShapeError("an equation of matrices of different shapes")
        return [
            pair
            for rows in zip(left.rows, right.rows, strict=True)
            for pair in zip(*rows, strict=True)
        ]
    if len(left.entries) != len(right.entries):
        raise ShapeError("an equation of vectors of different lengths")
    return list(zip(left.entries, right.entries, strict=True))


def _by_cases(value: Any, cases: Piecewise, state: Any) -> Formula:
    stated = []
    for piece in cases.pieces:
        says = relate(value, "=", piece.value, state)
        stated.append(
            implies(piece.condition, says if piece.besides is None else says & piece.besides)
        )
    return conjunction(stated)


def _rounds(value: Any, rounded: Rounded) -> Formula:
    if not is_scalar(value):
        raise ShapeError(f"a rounded number equal to {kind_of(value)}")
    whole, exact = term(value), term(rounded.value)  # type: ignore[arg-type]
    if rounded.bracket == r"\lfloor":
        return (whole <= exact) & (exact < whole + 1)
    return (exact <= whole) & (whole < exact + 1)


def _member(left: Any, sign: str, right: Any) -> Formula:
    if not isinstance(left, Vector) or not isinstance(right, Region):
        raise ShapeError(f"{sign} between {kind_of(left)} and {kind_of(right)} states no formula")
    inside = right(left)
    return inside if sign == r"\in" else ~inside


def _of_regions(left: Region | Image, sign: str, right: Region, state: Any) -> Formula:
    if state is None:
        raise ShapeError("regions are compared at the state of the environment, which has none")
    if sign in _INCLUSIONS:
        if isinstance(left, Region):
            return implies(left(state), right(state))
        return implies(left.region(state), right(applied(left.function, state)))
    if isinstance(left, Region) and sign in EQUALITIES:
        return iff(left(state), right(state))
    raise ShapeError(f"{sign} between {kind_of(left)} and {kind_of(right)} states no formula")
