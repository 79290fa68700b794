"""The map and its flights as arithmetic, compiled from the derived expressions; and given numbers,
which are taken exactly or refused.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any, TypeAlias, TypeVar

import numpy as np
from sympy import Expr, ImmutableMatrix, Poly, Symbol, expand, horner, symbols

from juggleproof.scenes.errors import SceneError
from juggleproof.symbolic import (
    DerivationError,
    lowest_terms,
    normal_e_1,
    normal_energy,
    normal_f1,
    normal_f2,
    normal_flight_power,
    normal_margin,
    region_energy,
    scaling,
    unipotent_power,
    unscaling,
)
from juggleproof.symbolic.algebra import K, alpha, beta, n, r, w, x

# -------------------------------------------------------------------------------------------------
# The derived formulas.
#
# The map, its flights and its closed form as plain arithmetic, written out from the expressions
# that the proofs are about.
#
# Each function is the source text of a derived expression in normal form, compiled: it takes any
# numbers that add, multiply and divide (rationals, balls, floats, arrays). Only sums, products and
# one division by a whole number or a polynomial occur; powers are written as products.

N = TypeVar("N")  # numbers of one kind: rationals, balls, mpmath's, floats, arrays with bounds
Compiled = Callable[..., Any]  # of `eval`; what it returns is of the kind of what it is given
p_e, q_e, power = symbols("e_x e_w power")  # the fixed point, and (-alpha)^n


def plain(expression: Expr, first: Symbol) -> str:
    """The text of a rational expression: a Horner form in the symbol `first`, whole coefficients,
    no powers, at most one division; raises DerivationError for any other expression.

    >>> plain(normal_f1()[0], alpha), plain(normal_flight_power()[0], K), plain(normal_energy(), w)
    ('(alpha*(w - x))', '((K*(1 - K - w)) + x)', '((4*x) + (w*(w - 2)) + 1)/2')
    """
    top, bottom = lowest_terms(expression).as_numer_denom()
    texts = [
        _infix(horner(part, wrt=first) if part.has(first) else part)
        for part in (expand(top), expand(bottom))
    ]
    return texts[0] if bottom == 1 else f"{texts[0]}/{texts[1]}"


def _infix(expression: Expr) -> str:
    if expression.is_Symbol:
        return str(expression.name)
    if expression.is_Integer:
        return str(int(expression))
    if expression.is_Add:
        terms = sorted(
            expression.args, key=lambda part: (_is_negative(part), bool(part.is_number), str(part))
        )
        added = "".join(
            (" - " if _is_negative(part) else " + ") + _infix(-part if _is_negative(part) else part)
            for part in terms
        )
        return (
            "("
            + added.removeprefix(" + ").replace(" - ", "-", 1 if added.startswith(" - ") else 0)
            + ")"
        )
    if expression.is_Mul:
        return (
            "("
            + "*".join(
                _infix(part)
                for part in sorted(
                    expression.args, key=lambda part: (not part.is_number, part.is_Add, str(part))
                )
            )
            + ")"
        )
    if expression.is_Pow and expression.exp.is_Integer and int(expression.exp) > 0:
        return "(" + "*".join([_infix(expression.base)] * int(expression.exp)) + ")"
    raise DerivationError(f"cannot be written as plain arithmetic: {expression}")


def _is_negative(expression: Expr) -> bool:
    return bool(expression.as_coeff_Mul()[0] < 0)


def compiled(name: str, names: str, *expressions: Expr, first: Symbol = alpha) -> Compiled:
    """A function of these names with the values of the expressions; its docstring is its source.
    Raises DerivationError if an expression is not rational or has other symbols.

    >>> compiled("impact", "alpha x w", *normal_f1()).__doc__
    'lambda alpha, x, w: ((alpha*(w - x)), (2 - (alpha*w)))'
    """
    texts = [plain(expression, first) for expression in expressions]
    allowed = set(names.split())
    for expression in expressions:
        if {str(symbol) for symbol in expression.free_symbols} - allowed:
            raise DerivationError(f"{name}: {expression} has other symbols than {names}")
    source = f"lambda {', '.join(names.split())}: " + (
        f"({', '.join(texts)})" if len(texts) > 1 else texts[0]
    )
    function: Compiled = eval(compile(source, f"<{name}>", "eval"), {"__builtins__": {}})
    function.__doc__, function.__name__ = source, name
    return function


@dataclass(frozen=True)
class Formulas:
    """The compiled formulas; all in normal form but the change of units.

    The numbers given to one call are of one kind N; whole numbers K and n may be ints beside them.
    """

    # (x, w) -> positive exactly where the period has an impact, by (7)
    margin: Callable[[N, N], N]
    # (alpha, x, w) -> f1, by (10)
    impact: Callable[[N, N, N], tuple[N, N]]
    # (x, w, K) -> f2^K, K periods without an impact, by (12)
    flight: Callable[[N, N, N | int], tuple[N, N]]
    # (x, w) -> b, d: the margin after K periods is K^2 + b K + c, of discriminant d
    end_of_flight: Callable[[N, N], tuple[N, N]]
    # (alpha) -> e_1
    fixed: Callable[[N], tuple[N, N]]
    # (x, w, e_x, e_w, n, power) -> f1^n, power being (-alpha)^n
    impact_power: Callable[[N, N, N, N, N | int, N], tuple[N, N]]
    # (alpha, w) -> two numbers, positive exactly where alpha w < 1 at the state and after its
    # impact; with an impact at the state, it is in the trap (`juggleproof.scenes.juggler.track`)
    trap_margins: Callable[[N, N], tuple[N, N]]
    # (x, w) -> energy in units of r^2
    energy: Callable[[N, N], N]
    # (beta, v, r, g) -> (x, w)
    scaled: Callable[[N, N, N, N], tuple[N, N]]
    # (x, w, r, g) -> (beta, v)
    unscaled: Callable[[N, N, N, N], tuple[N, N]]


@cache
def formulas() -> Formulas:
    """The formulas, derived and compiled once; raises DerivationError where they are not of the
    shape that the arithmetics rely on.

    >>> from fractions import Fraction
    >>> f = formulas()
    >>> third = Fraction(1, 3)
    >>> f.impact(third, Fraction(0), Fraction(3)), f.flight(1, 1, 1), f.fixed(third)
    ((Fraction(1, 1), Fraction(1, 1)), (0, 3), (Fraction(3, 8), Fraction(3, 2)))
    """
    if any(
        lowest_terms(one - two) != 0
        for one, two in zip(normal_flight_power().xreplace({K: 1}), normal_f2())
    ):
        raise DerivationError("one period of flight is not f2")
    flown = normal_flight_power()
    after = Poly(normal_margin().xreplace({x: flown[0], w: flown[1]}), K)
    if after.degree() != 2 or after.nth(2) != 1:
        raise DerivationError("the margin after K periods of flight is not K^2 + b K + c")
    struck = normal_f1()
    return Formulas(
        margin=compiled("margin", "x w", normal_margin()),
        impact=compiled("impact", "alpha x w", *struck),
        flight=compiled("flight", "x w K", *flown, first=K),
        end_of_flight=compiled(
            "end_of_flight", "x w", after.nth(1), after.nth(1) ** 2 - 4 * after.nth(0), first=w
        ),
        fixed=compiled("fixed", "alpha", *normal_e_1()),
        impact_power=compiled("impact_power", "x w e_x e_w n power", *_closed_form(), first=power),
        trap_margins=compiled("trap_margins", "alpha w", 1 - alpha * w, 1 - alpha * struck[1]),
        energy=compiled("energy", "x w", normal_energy(), first=w),
        scaled=compiled("scaled", "beta v r g", *scaling(), first=beta),
        unscaled=compiled("unscaled", "x w r g", *unscaling(), first=r),
    )


@cache
def region() -> Callable[[N], N]:
    """(alpha) -> the greatest energy of R, in units of r^2 (23); by itself, since its derivation
    takes longest.

    >>> region().__doc__
    'lambda alpha: (alpha + 1)/((alpha*(alpha - 2)) + 1)'
    """
    return compiled("region", "alpha", lowest_terms(region_energy() / r**2))


def _closed_form() -> tuple[Expr, Expr]:
    """f1^n(x, w) = e + (-alpha)^n M^n ((x, w) - e), M the unipotent matrix with f1 = e - alpha M (.
    - e); `power` stands for (-alpha)^n.
    """
    struck = normal_f1()
    matrix = ImmutableMatrix(struck.jacobian([x, w]) / -alpha).applyfunc(lowest_terms)
    shear = unipotent_power(matrix, n)
    offset = shear * ImmutableMatrix([x - p_e, w - q_e])
    return p_e + power * offset[0], q_e + power * offset[1]


# -------------------------------------------------------------------------------------------------
# Given numbers.
#
# Given numbers are taken exactly and within their ranges, or refused in one line with the value and
# what is allowed.

Number: TypeAlias = int | float | str | Fraction  # a float means the binary number that it is
BITS = (
    14000  # of a numerator or denominator that is given; Python writes numbers of up to 4300 digits
)
# Fraction would write all its digits out
_LONG_POWER = re.compile(r"e[+-]?[\d_]{6,}", re.IGNORECASE)
_FINITE = "is no finite number; give an integer, a fraction or a finite float"


def rational(value: Number, name: str) -> Fraction:
    """The exact value of a number; raises SceneError for what is no number.

    >>> rational("1/3", "x"), rational(0.5, "x")
    (Fraction(1, 3), Fraction(1, 2))
    """
    too_long = SceneError(f"{name} is longer than {BITS} bits; choose a shorter number")
    if isinstance(value, (np.integer, np.floating)):
        value = value.item()
    if isinstance(value, bool) or not isinstance(value, (int, float, str, Fraction)):
        raise SceneError(f"{name} = {brief(value)} {_FINITE}")
    if isinstance(value, str) and (len(value) > BITS or _LONG_POWER.search(value)):
        raise too_long
    try:
        number = Fraction(value)
    except (ValueError, OverflowError, ZeroDivisionError):
        raise SceneError(f"{name} = {brief(value)} {_FINITE}") from None
    if max(number.numerator.bit_length(), number.denominator.bit_length()) > BITS:
        raise too_long
    return number


def height(value: Number, name: str = "x") -> Fraction:
    """A height, which is at least 0; raises SceneError for others."""
    number = rational(value, name)
    if number < 0:
        raise SceneError(f"{name} = {brief(number)} is below the table; a state has {name} >= 0")
    return number


def positive(value: Number, name: str) -> Fraction:
    """The launch speed r or gravity g, which are greater than 0; raises SceneError for others."""
    number = rational(value, name)
    if number <= 0:
        raise SceneError(
            f"{name} = {brief(number)} is not positive; the launch speed r and gravity g are"
        )
    return number


def restitution(alpha: Number) -> Fraction:
    """The restitution, strictly between 0 and 1; raises SceneError for others."""
    number = rational(alpha, "alpha")
    if not 0 < number < 1:
        raise SceneError(
            f"alpha = {brief(number)} is not between 0 and 1; the restitution has 0 < alpha < 1"
        )
    return number


def counted(value: int, name: str, least: int, most: int) -> int:
    """A whole number within its bounds; raises SceneError for others."""
    if (
        isinstance(value, bool)
        or not isinstance(value, (int, np.integer))
        or not least <= value <= most
    ):
        raise SceneError(f"{name} = {brief(value)} is not a whole number from {least} to {most}")
    return int(value)


def brief(value: object) -> str:
    """What was given, in one line of 40 signs at most.

    >>> brief(Fraction(1, 3)), brief(10**5000), brief("a\\nb")
    ('1/3', 'a number of 16610 bits', 'a b')
    """
    if isinstance(value, (int, Fraction)):
        bits = max(value.numerator.bit_length(), value.denominator.bit_length())
        return str(value) if bits <= 132 else f"a number of {bits} bits"
    return "".join(sign if sign.isprintable() else " " for sign in str(value)[:40])


def nearest(value: Fraction) -> tuple[float, float]:
    """A float next to the number, and a bound on their difference, itself rounded up; infinities
    for a number beyond the floats.

    >>> nearest(Fraction(1, 2)), 0 < nearest(Fraction(1, 3))[1] < 2**-54
    ((0.5, 0.0), True)
    """
    try:
        rounded = float(value)
    except OverflowError:
        return math.inf, math.inf
    missed = abs(value - Fraction(rounded))
    return rounded, math.nextafter(float(missed), math.inf) if missed else 0.0
