"""Sharp ranges: asks the search for one, and tells it as intervals with exact end points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from certificates import checker
from certificates.search.algebraic import AlgebraicNumber
from certificates.search.budget import Budget, Exhausted
from certificates.search.ranges import Line
from certificates.search.sharp import find_sharp_range
from certificates.statements import SharpRange, Statement
from certificates.terms import real

DECIMALS = 12


def search_sharp_range(
    name: str, statements: Sequence[Statement], parameter: str, known: Mapping[str, checker.Statement], budget: int,
) -> tuple[SharpRange, Any, str] | None:
    """The sharp range of the statements in (0, 1), its certificate and how it is told; None where the search does not find one."""
    value = real(parameter)
    parsed = [checker.read_statements(statement.text())[statement.name] for statement in statements]
    try:
        found = find_sharp_range(parsed, parameter, (value > 0) & (value < 1), name, known, Budget(budget))
    except Exhausted:
        return None
    if found.statement is None or found.certificate is None or found.line is None:
        return None
    return found.statement, found.certificate, told(found.line.simplified(), parameter)


def told(line: Line, parameter: str) -> str:
    """The set as a person reads it: intervals, and for each irrational end its 12 decimals and its equation.

    >>> from fractions import Fraction
    >>> told(Line((AlgebraicNumber.rational(Fraction(1, 3)),), (True, False, False)), "alpha")
    '0 < alpha < 1/3'
    """
    names = {id(number): f"c{k + 1}" for k, number in enumerate(n for n in line.numbers if not n.is_rational)}

    def shown(end: AlgebraicNumber | None, outer: str) -> str:
        if end is None:
            return outer
        return str(end.as_fraction()) if end.is_rational else names[id(end)]

    parts = []
    for interval in line.intervals(True):
        if interval.low is not None and interval.low is interval.high:
            parts.append(f"{parameter} = {shown(interval.low, '')}")
        else:
            low, high = ("<=" if closed else "<" for closed in (interval.low_closed, interval.high_closed))
            parts.append(f"{shown(interval.low, '0')} {low} {parameter} {high} {shown(interval.high, '1')}")
    text = " or ".join(parts) or "nowhere"
    ends = [f"{names[id(n)]} = {n.decimal(DECIMALS)}..., a root of {polynomial(n.coefficients, parameter)}"
            for n in line.numbers if not n.is_rational]
    return "; ".join([text, *ends])


def polynomial(coefficients: Sequence[Any], name: str) -> str:
    """A polynomial in one variable, coefficients from the constant up, as text.

    >>> polynomial([-1, 7, 1, 1], "a")
    'a^3 + a^2 + 7*a - 1'
    """
    text = ""
    for power in range(len(coefficients) - 1, -1, -1):
        c = int(coefficients[power])
        if c:
            variable = "" if not power else name if power == 1 else f"{name}^{power}"
            body = "*".join([*([str(abs(c))] if abs(c) != 1 or not power else []), *([variable] if variable else [])])
            text += (" - " if c < 0 else " + ") + body if text else ("-" if c < 0 else "") + body
    return text or "0"
