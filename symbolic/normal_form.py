"""The normal form: heights in units of r T, closing speeds in units of r; only alpha is left."""

from __future__ import annotations

from functools import cache

from sympy import Expr, Integer

from symbolic.algebra import State, apply, lowest_terms, solution_of, state
from symbolic.collision import collision_margin, collision_time
from symbolic.energy import energy_change_1, total_energy
from symbolic.fixed_points import e_1, fixed_point, impact_fixed_point
from symbolic.maps import f1, f2, flight_power
from symbolic.symbols import K, beta, r, v, w, x
from symbolic.table import period


@cache
def scaling() -> State:
    """The change of coordinates from (beta, v) to (x, w): x = beta / (r T), w = 1 - v / r.

    >>> scaling().T
    Matrix([[beta*g/(2*r**2), (r - v)/r]])
    """
    return state(beta / (r * period()), 1 - v / r)


@cache
def unscaling() -> State:
    """The change of coordinates from (x, w) back to (beta, v).

    >>> unscaling().T
    Matrix([[2*r**2*x/g, -r*w + r]])
    """
    return state(*solution_of(list(scaling() - state(x, w)), [beta, v]))


def scaled(expression: Expr, unit: Expr) -> Expr:
    """An expression in beta and v, rewritten in x and w and measured in the unit.

    >>> from symbolic.collision import collision_margin
    >>> scaled(collision_margin(), r**2)
    w - x
    """
    return lowest_terms(expression.xreplace({beta: unscaling()[0], v: unscaling()[1]}) / unit)


def scaled_state(where: State) -> State:
    """The normal form (x, w) of a state (beta, v).

    >>> scaled_state(state(0, -r)).T
    Matrix([[0, 2]])
    """
    return apply(scaling(), where)


def _conjugate(mapping: State) -> State:
    return scaled_state(apply(mapping, unscaling()))


@cache
def normal_f1() -> State:
    """The map f1 in normal form: (x, w) -> (alpha (w - x), 2 - alpha w).

    >>> normal_f1().T
    Matrix([[alpha*w - alpha*x, -alpha*w + 2]])
    """
    return _conjugate(f1())


@cache
def normal_f2() -> State:
    """The map f2 in normal form: (x, w) -> (x - w, w + 2).

    >>> normal_f2().T
    Matrix([[-w + x, w + 2]])
    """
    return _conjugate(f2())


def normal_flight_power(periods: Expr = K) -> State:
    """A number K of periods without impact, in normal form: (x, w) -> (x - K w - K (K - 1), w + 2
    K).

    >>> normal_flight_power().T
    Matrix([[-K**2 - K*w + K + x, 2*K + w]])
    """
    return _conjugate(flight_power(periods))


@cache
def normal_margin() -> Expr:
    """What is positive exactly in B1, by inequality (7), in units of r^2: w - x.

    >>> normal_margin()
    w - x
    """
    return scaled(collision_margin(), r**2)


@cache
def normal_e_1() -> State:
    """The fixed point e_1 in normal form: (2 alpha / (1 + alpha)^2, 2 / (1 + alpha)).

    >>> normal_e_1()[1]
    2/(alpha + 1)
    """
    return scaled_state(e_1())


@cache
def normal_e_2() -> State:
    """The orbit of e_2 where its impact comes, in normal form: (2 (3 alpha - 1) / (1 + alpha)^2, 4
    / (1 + alpha)).

    >>> normal_e_2()[1]
    4/(alpha + 1)
    """
    return scaled_state(impact_fixed_point().xreplace({K: Integer(2)}))


@cache
def normal_energy() -> Expr:
    """The energy in units of r^2: 2 x + (1 - w)^2 / 2.

    >>> normal_energy()
    w**2/2 - w + 2*x + 1/2
    """
    return scaled(total_energy(), r**2)


@cache
def normal_energy_change() -> Expr:
    """The energy change of a period with an impact in units of r^2: (1 + alpha) (w - 2 x - (1 -
    alpha) w^2 / 2).

    >>> normal_energy_change().xreplace({x: 0})
    alpha**2*w**2/2 + alpha*w - w**2/2 + w
    """
    return scaled(energy_change_1(), r**2)


@cache
def normal_collision_time() -> Expr:
    """The collision time in units of T: x / w.

    >>> normal_collision_time()
    x/w
    """
    return scaled(collision_time(), period())


@cache
def normal_fixed_point() -> State:
    """The fixed point e_K of f1 o f2^(K - 1) in normal form, at the start of its flight.

    >>> normal_fixed_point()[1]
    (-2*K*alpha + 2*alpha + 2)/(alpha + 1)
    """
    return scaled_state(fixed_point())


@cache
def normal_impact_fixed_point() -> State:
    """The orbit of e_K where its impact comes, in normal form: w = 2 K / (1 + alpha).

    >>> normal_impact_fixed_point()[1]
    2*K/(alpha + 1)
    """
    return scaled_state(impact_fixed_point())
