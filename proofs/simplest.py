"""Counterexamples in simple rationals: the parameter at a simple value first, at which the roots of
the statement are rational too.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from fractions import Fraction
from math import isqrt

from juggleproof.certificates.language import Statement, Term, equal, names_in, real, term
from juggleproof.certificates.nodes import Counterexample
from juggleproof.proofs.evaluating import value_at

LARGEST = 32  # denominator of the parameter that is tried
TRIED = 4  # values of the parameter
PLAIN = 16  # numerators and denominators up to here are simple


def is_simple(found: Counterexample) -> bool:
    """Whether all values are rationals of small height."""
    numbers = [int(digits) for text in found.terms.values() for digits in re.findall(r"\d+", text)]
    return not found.adjoined and max(numbers, default=0) <= PLAIN


def at_simple_values(
    statement: Statement, parameter: str, roots: Iterable[Term]
) -> Iterator[Statement]:
    """The statement with the parameter given a simple value, the simplest first, at which the
    square roots of these terms in it are rational.
    """
    under = [str(one) for one in roots if names_in(one) == {parameter}]
    values = sorted({Fraction(p, q) for q in range(2, LARGEST + 1) for p in range(1, q)}, key=_size)
    tried = 0
    for value in values:
        squares = [value_at(text, {parameter: value}) for text in under]
        if tried < TRIED and all(square is None or _is_square(square) for square in squares):
            tried += 1
            given = ("given", equal(real(parameter), term(value)))
            yield replace(statement, lines=(*statement.lines, given))


def _size(value: Fraction) -> tuple[int, int]:
    return value.denominator, value.numerator


def _is_square(value: Fraction) -> bool:
    return value >= 0 and all(isqrt(n) ** 2 == n for n in value.as_integer_ratio())
