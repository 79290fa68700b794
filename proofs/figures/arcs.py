"""Derived expressions as numbers at the setting of the figures, and the arcs of parabolas that they
draw.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cache

from sympy import Expr, Symbol

from juggleproof.drawing.lines import Arc, Place, Quadratic, Real, at
from juggleproof.symbolic import State, collision_margin, f1, f2

# -------------------------------------------------------------------------------------------------
# Expressions as numbers.
#
# Derived expressions as numbers, exact or floating, at one setting: alpha = 1/4, r = g = 1; states
# and orbits of the map.

ALPHA = Fraction(1, 4)  # below 1/3, where the theorem holds
SETTING: Mapping[str, Fraction] = {"alpha": ALPHA, "r": Fraction(1), "g": Fraction(1)}


def value(expression: Expr, **values: Real) -> Real:
    """The value of an expression, symbols being named; alpha, r and g are those of the setting
    unless given.

    Exact where the given values are whole numbers or fractions and no root occurs, else a float.
    ValueError for an expression that is not of sums, products and powers.

    >>> from juggleproof.symbolic import period
    >>> from juggleproof.symbolic.algebra import beta, v
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


def _walk(expression: Expr, values: Mapping[str, Real], exact: bool) -> Real:
    if expression.is_Symbol:
        return values[expression.name]
    if expression.is_Rational:
        return Fraction(expression.p, expression.q) if exact else expression.p / expression.q
    if not expression.args:
        raise ValueError(f"cannot be drawn: {expression}")
    parts = [_walk(part, values, exact) for part in expression.args]
    total: Real = parts[0]
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


def column(entries: State, **values: Real) -> Place:
    """The values of the two entries of a state."""
    return value(entries[0], **values), value(entries[1], **values)


def margin(height: Real, speed: Real) -> Real:
    """Positive exactly where the ball strikes the table within the period, by (7)."""
    return value(collision_margin(), beta=height, v=speed)


def next_state(height: Real, speed: Real) -> Place:
    """The state one period later: by f1 (10) in B1, by f2 (12) elsewhere; exact for exact
    states.

    >>> next_state(Fraction(0), Fraction(-1))
    (Fraction(1, 1), Fraction(-1, 2))
    """
    return column(f1() if margin(height, speed) > 0 else f2(), beta=height, v=speed)


def orbit(start: Place, steps: int) -> list[Place]:
    """The states from the start on, one a period."""
    states = [start]
    for _ in range(steps):
        states.append(next_state(*states[-1]))
    return states


# -------------------------------------------------------------------------------------------------
# Arcs.
#
# Curves of the figures as what they are, arcs of parabolas: from derived expressions, and taken by
# the map f, cut where it jumps.


def polynomial(expression: Expr, parameter: Symbol, **values: Real) -> Quadratic:
    """The coefficients, from the constant up, of an expression that is at most quadratic in the
    parameter; ValueError for others.

    >>> from juggleproof.symbolic.algebra import v
    >>> polynomial(3 * v**2 + v / 2, v)
    (0.0, 0.5, 3.0)
    """
    coefficients = [float(value(one, **values)) for one in _coefficients(expression, parameter)]
    constant, slope, square = [*coefficients, 0.0, 0.0][:3]
    return constant, slope, square


@cache
def _coefficients(expression: Expr, parameter: Symbol) -> list[Expr]:
    quadratic = (expression + 0 * parameter).as_poly(parameter)
    if quadratic is None or quadratic.degree() > 2:
        raise ValueError(f"not a parabola: {expression}")
    return list(reversed(quadratic.all_coeffs()))


def zeros(expression: Expr, parameter: Symbol, **values: Real) -> list[float]:
    """The real zeros, in order, of an expression that is at most quadratic in the parameter.

    >>> from juggleproof.symbolic.algebra import v
    >>> zeros(v**2 - 4, v), zeros(v**2 + 1, v)
    ([-2.0, 2.0], [])
    """
    return _zeros(*polynomial(expression, parameter, **values))


def _zeros(constant: float, slope: float, square: float) -> list[float]:
    if square == 0:
        return [] if slope == 0 else [-constant / slope]
    inside = slope**2 - 4 * square * constant
    if inside < 0:
        return []
    # The root with the larger size first: no digits are lost where slope and spread nearly cancel.
    larger = -(slope + (inside**0.5 if slope > 0 else -(inside**0.5))) / 2
    return sorted([larger / square, constant / larger if larger else 0.0])


def curve(
    height: Expr, speed: Expr, parameter: Symbol, start: Real, stop: Real, **values: Real
) -> Arc:
    """The states (height, speed) of a parameter, of which both are at most quadratic."""
    return Arc(
        polynomial(height, parameter, **values),
        polynomial(speed, parameter, **values),
        float(start),
        float(stop),
    )


@cache
def _affine(strikes: bool) -> tuple[Quadratic, Quadratic]:
    """f1 or f2 at the setting: for each entry its coefficient of the height, that of the speed, and
    its constant.
    """
    mapping = f1() if strikes else f2()
    (c, d), (c1, d1), (c2, d2) = (column(mapping, beta=h, v=s) for h, s in ((0, 0), (1, 0), (0, 1)))
    return (float(c1 - c), float(c2 - c), float(c)), (float(d1 - d), float(d2 - d), float(d))


def cut_at_the_bounce(arc: Arc) -> Iterator[tuple[Arc, bool]]:
    """The arc's parts on either side of the line between B1 and B2, each with whether it lies in
    B1.
    """
    c, h, s = (float(margin(*at)) for at in ((0, 0), (1, 0), (0, 1)))
    h, s = h - c, s - c
    constant, slope, square = (h * across + s * up for across, up in zip(arc.across, arc.up))
    inside = [
        one
        for one in _zeros(constant + c, slope, square)
        if min(arc.start, arc.stop) < one < max(arc.start, arc.stop)
    ]
    ends = [arc.start, *sorted(inside, reverse=arc.stop < arc.start), arc.stop]
    for start, stop in zip(ends, ends[1:]):
        yield arc.part(start, stop), at((constant + c, slope, square), (start + stop) / 2) > 0


def images(arcs: Sequence[Arc]) -> list[Arc]:
    """The image under f: each arc is cut where f jumps, and each part taken by the branch that
    holds there.
    """
    mapped = []
    for arc in arcs:
        for part, strikes in cut_at_the_bounce(arc):
            (a, b, c), (d, e, k) = _affine(strikes)
            across = tuple(a * one + b * two for one, two in zip(part.across, part.up))
            up = tuple(d * one + e * two for one, two in zip(part.across, part.up))
            mapped.append(
                Arc(
                    (across[0] + c, across[1], across[2]),
                    (up[0] + k, up[1], up[2]),
                    part.start,
                    part.stop,
                )
            )
    return mapped
