"""Random polynomials with small rational coefficients, and scripts of SMT-LIB about them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import prod
from random import Random
from typing import TypeAlias

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx

Rational: TypeAlias = fmpq | int

# -------------------------------------------------------------------------------------------------
# Random polynomials.


def variables(count: int) -> list[fmpq_mpoly]:
    """The variables x1, x2, .. of a ring of their own."""
    names = [f"x{k}" for k in range(1, count + 1)]
    return list(fmpq_mpoly_ctx.get(names, "degrevlex").gens())


def rational(random: Random, low: int, high: int, denominators: Sequence[int] = (1, 2, 3)) -> fmpq:
    """A random rational between two whole numbers."""
    denominator = random.choice(denominators)
    return fmpq(random.randint(low * denominator, high * denominator), denominator)


def point(random: Random, count: int, size: int = 3) -> list[fmpq]:
    """A random rational point."""
    return [rational(random, -size, size) for _ in range(count)]


def polynomial(
    random: Random, names: Sequence[fmpq_mpoly], degree: int, terms: int = 4
) -> fmpq_mpoly:
    """A random polynomial that is no number, with at most this many terms and this degree."""
    total = random.choice(names) ** degree
    for _ in range(terms - 1):
        factors = random.choices([*names, 1 + 0 * names[0]], k=degree)
        total += random.choice((-3, -2, -1, 1, 2, 3)) * prod(factors, start=1 + 0 * names[0])
    return total if total.total_degree() > 0 else total + names[0]


def linear(random: Random, names: Sequence[fmpq_mpoly], size: int = 4) -> fmpq_mpoly:
    """A random linear form in all names, without a constant."""
    return sum((random.choice((-1, 1)) * random.randint(1, size) * x for x in names), 0 * names[0])


def squares(random: Random, names: Sequence[fmpq_mpoly], degree: int, count: int) -> fmpq_mpoly:
    """A random sum of squares of polynomials of half that degree."""
    return sum((polynomial(random, names, degree // 2) ** 2 for _ in range(count)), 0 * names[0])


# -------------------------------------------------------------------------------------------------
# Texts of SMT-LIB.  Every number is a decimal, which is of sort Real in every logic.


def number(value: Rational) -> str:
    """A rational number.

    >>> number(3), number(fmpq(-1, 2))
    ('3.0', '(- (/ 1.0 2.0))')
    """
    exact = fmpq(value)
    size = abs(exact)
    text = f"{size.p}.0" if size.q == 1 else f"(/ {size.p}.0 {size.q}.0)"
    return text if exact >= 0 else f"(- {text})"


def applied(operator: str, parts: Sequence[str]) -> str:
    """An operator on its parts, or the one part.

    >>> applied("+", ["x", "y"]), applied("+", ["x"])
    ('(+ x y)', 'x')
    """
    return parts[0] if len(parts) == 1 else f"({operator} {' '.join(parts)})"


def written(value: fmpq_mpoly | Rational) -> str:
    """A polynomial, expanded, or a number.

    >>> x, y = variables(2)
    >>> written(x**2 - y / 2)
    '(+ (* x1 x1) (* (- (/ 1.0 2.0)) x2))'
    """
    if not isinstance(value, fmpq_mpoly):
        return number(value)
    names, parts = value.context().names(), []
    for powers, coefficient in value.terms():
        factors = [name for name, power in zip(names, powers) for _ in range(int(power))]
        leading = [number(coefficient)] if coefficient != 1 or not factors else []
        parts.append(applied("*", [*leading, *factors]))
    return applied("+", parts) if parts else number(0)


def atom(
    left: fmpq_mpoly | Rational, relation: str, right: fmpq_mpoly | Rational | None = None
) -> str:
    """A relation between two polynomials, or to 0.

    >>> x, y = variables(2)
    >>> atom(x, "<", y), atom(x, ">=")
    ('(< x1 x2)', '(>= x1 0.0)')
    """
    return f"({relation} {written(left)} {written(0 if right is None else right)})"


def every(formulas: Sequence[str]) -> str:
    """The conjunction of formulas."""
    return applied("and", formulas)


def some(formulas: Sequence[str]) -> str:
    """The disjunction of formulas."""
    return applied("or", formulas)


def denied(formula: str) -> str:
    """The negation of a formula."""
    return f"(not {formula})"


def implied(formula: str, then: str) -> str:
    """An implication."""
    return f"(=> {formula} {then})"


def script(names: Iterable[object], formulas: Iterable[str], logic: str = "QF_NRA") -> str:
    """A script that asks once whether all formulas can hold."""
    return "\n".join(
        [
            f"(set-logic {logic})",
            *(f"(declare-const {name} Real)" for name in names),
            *(f"(assert {formula})" for formula in formulas),
            "(check-sat)\n",
        ]
    )
