"""Derived expressions as numbers, exact or floating, at one setting: alpha = 1/4, r = g = 1; states
and orbits of the map.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from symbolic import collision_margin, f1, f2, period

ALPHA = Fraction(1, 4)  # below 1/3, where the theorem holds
SETTING: Mapping[str, Fraction] = {"alpha": ALPHA, "r": Fraction(1), "g": Fraction(1)}


def value(expression: Any, **values: Any) -> Any:
    """The value of an expression, symbols being named; alpha, r and g are those of the setting
    unless given.

    Exact where the given values are whole numbers or fractions and no root occurs, else a float, or
    an array.

    >>> from symbolic.symbols import beta, v
    >>> value(period()), value(beta / 2 + v, beta=Fraction(1, 3), v=1), value(v**2 + 1, v=0.5)
    (Fraction(2, 1), Fraction(7, 6), 1.25)
    """
    exact = all(isinstance(one, (int, Fraction)) for one in values.values())
    return _walk(
        expression,
        (
            {**SETTING, **values}
            if exact
            else {**{k: float(one) for k, one in SETTING.items()}, **values}
        ),
        exact,
    )


def _walk(expression: Any, values: Mapping[str, Any], exact: bool) -> Any:
    if expression.is_Symbol:
        return values[expression.name]
    if expression.is_Rational:
        return Fraction(expression.p, expression.q) if exact else expression.p / expression.q
    if not expression.args:
        raise ValueError(f"cannot be drawn: {expression}")
    parts = [_walk(part, values, exact) for part in expression.args]
    total = parts[0]
    if expression.is_Add:
        for part in parts[1:]:
            total = total + part
    elif expression.is_Mul:
        for part in parts[1:]:
            total = total * part
    elif expression.is_Pow:
        power = parts[1]
        whole = expression.exp.is_Integer
        total = (
            total ** int(expression.exp)
            if whole
            else float(total) ** float(power)
            if exact
            else total**power
        )
    else:
        raise ValueError(f"cannot be drawn: {expression}")
    return total


def column(entries: Any, **values: Any) -> tuple[Any, Any]:
    """The values of the two entries of a state."""
    return value(entries[0], **values), value(entries[1], **values)


def in_units(height: Any, speed: Any) -> tuple[Any, Any]:
    """A state as it is drawn: its height in units of r T, its speed in units of r."""
    return height / (SETTING["r"] * value(period())), speed / SETTING["r"]


def margin(height: Any, speed: Any) -> Any:
    """Positive exactly where the ball strikes the table within the period."""
    return value(collision_margin(), beta=height, v=speed)


def next_state(height: Any, speed: Any) -> tuple[Any, Any]:
    """The state one period later: by f1 in B1, by f2 elsewhere; exact for exact states.

    >>> next_state(Fraction(0), Fraction(-1))
    (Fraction(1, 1), Fraction(-1, 2))
    """
    return column(f1() if margin(height, speed) > 0 else f2(), beta=height, v=speed)


def orbit(start: tuple[Any, Any], steps: int) -> list[tuple[Any, Any]]:
    """The states from the start on, one a period."""
    states = [start]
    for _ in range(steps):
        states.append(next_state(*states[-1]))
    return states
