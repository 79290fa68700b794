"""The symbols of the paper; exact algebra of states and of maps in (beta, v); exact signs of
functions of alpha for all 0 < alpha < 1.

A step that does not have the shape that it relies on raises DerivationError.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import TypeAlias

from sympy import (
    QQ,
    Expr,
    ImmutableMatrix,
    Poly,
    Pow,
    Rational,
    S,
    Symbol,
    eye,
    factor,
    factor_list,
    linsolve,
    sqrt,
)
from sympy.polys.fields import FracField

# -------------------------------------------------------------------------------------------------
# Symbols, without assumptions: what a step needs of them is stated where it is needed.

alpha = Symbol("alpha")  # coefficient of restitution
beta = Symbol("beta")  # height of the ball when the table is at its lowest
v = Symbol("v")  # speed of the ball then, upwards
rho = Symbol("rho")  # height of the table
u = Symbol("u")  # speed of the table, upwards
r = Symbol("r")  # launch speed of the table
g = Symbol("g")  # gravity
t = Symbol("t")  # time of flight
tau = Symbol("tau")  # time of collision, counted from the table's launch
K = Symbol("K")  # number of table periods that one flight of the ball lasts
n = Symbol("n")  # number of iterations
x = Symbol("x")  # height in units of r T
w = Symbol("w")  # closing speed in units of r
z1 = Symbol("z1")  # height above that of the fixed point
z2 = Symbol("z2")  # speed less that of the fixed point
E0 = Symbol("E0")  # energy of the state that an orbit starts from


# -------------------------------------------------------------------------------------------------
# Exact algebra: states, maps in (beta, v), linear systems, unipotent powers.

# a column (height, speed); a map is a State whose entries contain beta and v
State: TypeAlias = ImmutableMatrix


class DerivationError(ArithmeticError):
    """A step of a derivation did not have the shape that it relies on."""


@cache
def _fractions(symbols: tuple[Symbol, ...]) -> FracField:
    return FracField(symbols, QQ, "lex")


def lowest_terms(expression: Expr) -> Expr:
    """A rational expression as one fraction with coprime, expanded numerator and denominator (equal
    ones look equal).

    The same as SymPy's `cancel`, for rational expressions only: others raise DerivationError.

    >>> from juggleproof.symbolic.algebra import alpha
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

    >>> from juggleproof.symbolic.algebra import beta, v
    >>> apply(state(beta + v, 2 * v), state(1, beta)).T
    Matrix([[beta + 1, 2*beta]])
    """
    return state(*mapping.xreplace({beta: to[0], v: to[1]}))


def integral_from_zero(integrand: Expr, variable: Symbol) -> Expr:
    """The integral of a polynomial from 0 to the variable.

    >>> from juggleproof.symbolic.algebra import t
    >>> integral_from_zero(1 + t, t)
    t**2/2 + t
    """
    return Poly(integrand, variable).integrate().as_expr()


def solution_of(equations: Sequence[Expr], unknowns: Sequence[Symbol]) -> tuple[Expr, ...]:
    """The only solution of a linear system (each expression is to vanish); DerivationError if there
    is not exactly one.

    >>> from juggleproof.symbolic.algebra import beta, v
    >>> solution_of([beta + v - 3, beta - v - 1], [beta, v])
    (2, 1)
    """
    solutions = list(linsolve(list(equations), *unknowns))
    if len(solutions) != 1 or solutions[0].free_symbols & set(unknowns):
        raise DerivationError(f"not one solution in {list(unknowns)}: {list(equations)}")
    return tuple(lowest_terms(entry) for entry in solutions[0])


def root_of(expression: Expr, unknown: Symbol) -> Expr:
    """The only zero of a fraction whose numerator is linear in the unknown; DerivationError where
    it is not.

    >>> from juggleproof.symbolic.algebra import alpha, K
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

    >>> from juggleproof.symbolic.algebra import beta, v
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

    Checked by induction on the result: P(0) = 1 and P(k) M = P(k + 1); DerivationError where it
    fails.

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
    rational factors; DerivationError where it does not.

    >>> from sympy import ImmutableMatrix
    >>> eigenvalues_of(ImmutableMatrix([[2, 7], [0, 3]]))
    (2, 3)
    """
    unknown = Symbol("lambda")
    characteristic = matrix.charpoly(unknown).as_expr()
    eigenvalues: list[Expr] = []
    for part, multiplicity in factor_list(characteristic, unknown)[1]:
        eigenvalues += [root_of(part, unknown)] * multiplicity
    return tuple(sorted(eigenvalues, key=str))


# -------------------------------------------------------------------------------------------------
# Exact signs of algebraic functions of alpha for all 0 < alpha < 1, by Sturm's count.

_HALF = Rational(1, 2)
_ROOT = Symbol("root")


@cache
def sign_for_lossy_impacts(expression: Expr) -> int:
    """The sign (-1, 0 or 1) that an expression in alpha, with at most one square root, has for all
    0 < alpha < 1.

    DerivationError if it has no constant sign there.

    >>> sign_for_lossy_impacts(alpha**2 - alpha), sign_for_lossy_impacts(2 - sqrt(2 * alpha + 2))
    (-1, 1)
    """
    rational, radicand = _name_root(expression)
    numerator, denominator = (_sign(part, radicand) for part in rational.as_numer_denom())
    if denominator == 0:
        raise DerivationError(f"division by zero: {expression}")
    return numerator * denominator


def reduced(expression: Expr) -> Expr:
    """The normal form p + q sqrt(m) with reduced fractions p and q, for an expression in alpha with
    one root.

    >>> reduced((1 + sqrt(2 * alpha + 2)) ** 2)
    2*alpha + 2*sqrt(2*alpha + 2) + 3
    """
    rational, radicand = _name_root(expression)
    over, under = (
        Poly(part, _ROOT).rem(Poly(_ROOT**2 - radicand, _ROOT))
        for part in rational.as_numer_denom()
    )
    conjugate = under.compose(Poly(-_ROOT, _ROOT))
    value = (over * conjugate).rem(Poly(_ROOT**2 - radicand, _ROOT))
    norm = (under * conjugate).rem(Poly(_ROOT**2 - radicand, _ROOT)).nth(0)
    return factor(value.nth(0) / norm) + factor(value.nth(1) / norm) * sqrt(radicand)


def _name_root(expression: Expr) -> tuple[Expr, Expr]:
    """The expression as a fraction in alpha and the symbol of its only root, and the radicand of
    that root.
    """
    if S(expression).free_symbols - {alpha}:
        raise DerivationError(f"not a function of alpha alone: {expression}")
    powers = [
        power for power in S(expression).atoms(Pow) if power.exp.is_Rational and power.exp.q == 2
    ]
    bases = {power.base for power in powers}
    if len(bases) > 1:
        raise DerivationError(f"more than one root: {expression}")
    fraction = lowest_terms(S(expression).xreplace({power: _ROOT**power.exp.p for power in powers}))
    return fraction, bases.pop() if bases else S.One


def _sign(expression: Expr, radicand: Expr) -> int:
    """The constant sign of a polynomial in alpha and the root of the radicand."""
    remainder = Poly(expression, _ROOT).rem(Poly(_ROOT**2 - radicand, _ROOT))
    p, q, m = (Poly(part, alpha) for part in (remainder.nth(0), remainder.nth(1), radicand))
    if p.is_zero and q.is_zero:
        return 0
    # p + q sqrt(m) can change sign only where m or the norm p^2 - q^2 m vanishes.
    for changing in (m, p**2 - q**2 * m):
        if changing.is_zero or _vanishes(changing):
            raise DerivationError(f"the sign may change with alpha: {expression}")
    p, q, m = (part.eval(_HALF) for part in (p, q, m))
    if m < 0:
        raise DerivationError(f"root of a negative number: {radicand}")
    larger = p if p**2 > q**2 * m else q
    return 1 if larger > 0 else -1


def _vanishes(polynomial: Poly) -> bool:
    """Whether a polynomial in alpha has a zero in the open interval (the ends are divided out
    before counting).
    """
    ends = (Poly(alpha, alpha), Poly(alpha - 1, alpha))
    inner = (part for part, _ in polynomial.factor_list()[1] if part not in ends)
    return any(part.count_roots(0, 1) for part in inner)


def simplest_roots(polynomial: Poly) -> tuple[Expr, ...]:
    """The zeros of a polynomial of degree at most 2 over Q(alpha); none where they are complex for
    0 < alpha < 1.

    Squares are taken out of the root.  DerivationError for degrees above 2, and where a coefficient
    or the discriminant has no constant sign.

    >>> from juggleproof.symbolic.algebra import w
    >>> simplest_roots(Poly((1 - alpha) ** 2 * w**2 - 2 * (1 + alpha), w))
    (sqrt(2*alpha + 2)/(alpha - 1), -sqrt(2*alpha + 2)/(alpha - 1))
    >>> simplest_roots(Poly(w**2 + alpha, w))
    ()
    """
    # The leading coefficient must not vanish for any alpha; its sign does not matter.
    if sign_for_lossy_impacts(polynomial.LC()) == 0:
        raise DerivationError(f"every number is a zero: {polynomial}")
    if polynomial.degree() == 0:
        return ()
    if polynomial.degree() == 1:
        return (lowest_terms(-polynomial.nth(0) / polynomial.nth(1)),)
    if polynomial.degree() > 2:
        raise DerivationError(f"of too high a degree: {polynomial}")
    a, b, c = (polynomial.nth(power) for power in (2, 1, 0))
    numerator, denominator = lowest_terms(b**2 - 4 * a * c).as_numer_denom()
    if sign_for_lossy_impacts(numerator * denominator) < 0:
        return ()
    outside, inside = _square_taken_out(Poly(numerator * denominator, alpha))
    spread = lowest_terms(outside / denominator / (2 * a)) * sqrt(inside)
    middle = lowest_terms(-b / (2 * a))
    return middle + spread, middle - spread


def _square_taken_out(radicand: Poly) -> tuple[Expr, Expr]:
    """Factors s and m with radicand = s^2 m, m without square factors."""
    content, factors = radicand.factor_list()
    outside, inside = S.One, S.One
    for part, multiplicity in [*S(content).factors().items(), *factors]:
        base = part.as_expr() if isinstance(part, Poly) else S(part)
        outside *= base ** (multiplicity // 2)
        inside *= base ** (multiplicity % 2)
    return outside, inside.expand()
