"""Exact algebra that every derivation uses: states, maps in (beta, v), linear systems, unipotent
powers.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import TypeAlias

from sympy import QQ, Expr, ImmutableMatrix, Poly, S, Symbol, eye, factor_list, linsolve
from sympy.polys.fields import FracField

from symbolic.symbols import beta, v

State: TypeAlias = (
    ImmutableMatrix  # a column (height, speed); a map is a State whose entries contain beta and v
)


class DerivationError(ArithmeticError):
    """A step of a derivation did not have the shape that it relies on."""


@cache
def _fractions(symbols: tuple[Symbol, ...]) -> FracField:
    return FracField(symbols, QQ, "lex")


def lowest_terms(expression: Expr) -> Expr:
    """A rational expression as one fraction with coprime, expanded numerator and denominator (equal
    ones look equal).

    The same as SymPy's `cancel`, without its care for what is not rational: such expressions are
    refused.

    >>> from symbolic.symbols import alpha
    >>> lowest_terms((alpha**2 - 1) / (alpha + 1) ** 2)
    (alpha - 1)/(alpha + 1)
    """
    expression = S(expression)
    if expression.is_Rational or expression.is_Symbol:
        return expression
    field = _fractions(tuple(sorted(expression.free_symbols, key=str)))
    try:
        return field.from_expr(expression).as_expr()
    except ValueError as error:
        raise DerivationError(f"not a rational expression: {expression}") from error


def state(height: Expr, speed: Expr) -> State:
    """The column (height, speed), each entry with numerator and denominator coprime.

    >>> state(v**2 / v, 0).T
    Matrix([[v, 0]])
    """
    return ImmutableMatrix([lowest_terms(height), lowest_terms(speed)])


def apply(mapping: State, to: State) -> State:
    """The value of a map, given as a column in beta and v, at a state.

    >>> from symbolic.symbols import beta, v
    >>> apply(state(beta + v, 2 * v), state(1, beta)).T
    Matrix([[beta + 1, 2*beta]])
    """
    return state(*mapping.xreplace({beta: to[0], v: to[1]}))


def integral_from_zero(integrand: Expr, variable: Symbol) -> Expr:
    """The integral of a polynomial from 0 to the variable.

    >>> from symbolic.symbols import t
    >>> integral_from_zero(1 + t, t)
    t**2/2 + t
    """
    return Poly(integrand, variable).integrate().as_expr()


def solution_of(equations: Sequence[Expr], unknowns: Sequence[Symbol]) -> tuple[Expr, ...]:
    """The only solution of a linear system (each expression is to vanish); DerivationError if there
    is not exactly one.

    >>> from symbolic.symbols import beta, v
    >>> solution_of([beta + v - 3, beta - v - 1], [beta, v])
    (2, 1)
    """
    solutions = list(linsolve(list(equations), *unknowns))
    if len(solutions) != 1 or solutions[0].free_symbols & set(unknowns):
        raise DerivationError(f"not one solution in {list(unknowns)}: {list(equations)}")
    return tuple(lowest_terms(entry) for entry in solutions[0])


def root_of(expression: Expr, unknown: Symbol) -> Expr:
    """The only zero of a fraction whose numerator is linear in the unknown.

    >>> from symbolic.symbols import alpha, K
    >>> root_of((1 + alpha) / (1 - alpha) - K, alpha)
    (K - 1)/(K + 1)
    """
    numerator = Poly(lowest_terms(expression).as_numer_denom()[0], unknown)
    if numerator.degree() != 1:
        raise DerivationError(f"not linear in {unknown}: {expression}")
    return lowest_terms(-numerator.nth(0) / numerator.nth(1))


def affine_parts(mapping: State) -> tuple[State, State]:
    """The matrix M and the offset c of an affine map b -> M b + c; DerivationError if the map is
    not affine.

    >>> from symbolic.symbols import beta, v
    >>> affine_parts(state(beta + 2 * v, 3 - v))
    (Matrix([
    [1,  2],
    [0, -1]]), Matrix([
    [0],
    [3]]))
    """
    matrix = mapping.jacobian([beta, v]).applyfunc(lowest_terms)
    if matrix.free_symbols & {beta, v}:
        raise DerivationError(f"not affine in beta and v: {mapping}")
    return ImmutableMatrix(matrix), apply(mapping, state(0, 0))


def unipotent_power(matrix: State, exponent: Expr) -> State:
    """M^k for a symbolic k where (M - 1)^3 = 0: the binomial series of (1 + (M - 1))^k, which ends.

    Checked by induction on the result: P(0) = 1 and P(k) M = P(k + 1).

    >>> from sympy import ImmutableMatrix, Symbol
    >>> unipotent_power(ImmutableMatrix([[1, 5], [0, 1]]), Symbol("k"))
    Matrix([
    [1, 5*k],
    [0,   1]])
    """
    identity = eye(matrix.rows)
    rest = matrix - identity

    def power(k: Expr) -> State:
        return ImmutableMatrix(
            (identity + k * rest + k * (k - 1) / 2 * rest**2).applyfunc(lowest_terms)
        )

    for left, right in ((power(S.Zero), identity), (power(exponent) * matrix, power(exponent + 1))):
        if any(lowest_terms(entry) != 0 for entry in left - right):
            raise DerivationError(f"not unipotent of order 3: {matrix}")
    return power(exponent)


def eigenvalues_of(matrix: State) -> tuple[Expr, ...]:
    """The eigenvalues with their multiplicity, where the characteristic polynomial splits into
    rational factors.

    >>> from sympy import ImmutableMatrix
    >>> eigenvalues_of(ImmutableMatrix([[2, 7], [0, 3]]))
    (2, 3)
    """
    unknown = Symbol("lambda")
    characteristic = matrix.charpoly(unknown).as_expr()
    found: list[Expr] = []
    for factor, multiplicity in factor_list(characteristic, unknown)[1]:
        found += [root_of(factor, unknown)] * multiplicity
    return tuple(sorted(found, key=str))
