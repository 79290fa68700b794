"""Fixed points of the return maps and when they exist (sections 3.3 and 3.5)."""

from __future__ import annotations

from functools import cache

from sympy import Expr, Symbol

from symbolic.algebra import State, apply, lowest_terms, root_of, solution_of, state
from symbolic.collision import collision_time, table_speed_at_collision
from symbolic.flight import hang_time
from symbolic.impact import impact_map
from symbolic.maps import f1, flight_power, return_map, time_shift
from symbolic.symbols import K, alpha, beta, r, u, v, z1, z2
from symbolic.table import period


@cache
def fixed_point() -> State:
    """The fixed point e_K of the map over K periods, sampled at the start of its flight: f1 o f2^(K
    - 1) keeps it (section 3.5.1).

    >>> from sympy import Rational
    >>> from symbolic.symbols import g
    >>> fixed_point().xreplace({K: 2, alpha: Rational(1, 2), r: 1, g: 1}).applyfunc(lowest_terms).T
    Matrix([[20/9, 1/3]])
    """
    return state(*solution_of(list(return_map() - state(beta, v)), [beta, v]))


@cache
def impact_fixed_point() -> State:
    """The orbit of e_K where its impact comes: f2^(K - 1)(e_K), the fixed point of f2^(K - 1) o f1
    (section 3.5.1).

    >>> from sympy import Rational
    >>> from symbolic.symbols import g
    >>> values = {K: 2, alpha: Rational(1, 2), r: 1, g: 1}
    >>> impact_fixed_point().xreplace(values).applyfunc(lowest_terms).T
    Matrix([[8/9, -5/3]])
    """
    return apply(flight_power(K - 1), fixed_point())


@cache
def e_1() -> State:
    """The fixed point of f1: (4 alpha r^2 / ((1 + alpha)^2 g), -(1 - alpha) r / (1 + alpha))
    (section 3.3, B.4).

    >>> from sympy import Rational
    >>> from symbolic.symbols import g
    >>> e_1().xreplace({alpha: Rational(1, 3), r: 1, g: 1}).T
    Matrix([[3/4, -1/2]])
    """
    return state(*solution_of(list(f1() - state(beta, v)), [beta, v]))


@cache
def epsilon_1() -> Expr:
    """The time for which e_1 = -(1 - alpha) / (1 + alpha) A_-epsilon r_0: 2 alpha T / (1 - alpha^2)
    (section 3.3).

    >>> epsilon_1()
    -4*alpha*r/(alpha**2*g - g)
    """
    return time_shift(e_1(), -(1 - alpha) / (1 + alpha))


@cache
def collision_time_at_fixed_point() -> Expr:
    """The time of the impact of e_K within its period; below T, as section 3.3 asks for K = 1.

    >>> from sympy import Rational
    >>> from symbolic.symbols import g
    >>> collision_time_at_fixed_point().xreplace({K: 1, alpha: Rational(1, 3), r: 1, g: 1})
    1/2
    """
    return _at(collision_time(), impact_fixed_point())


@cache
def relative_map() -> State:
    """The map f1 in coordinates z = b - e_1: -alpha A_T z (equation 27 and after).

    >>> relative_map().T
    Matrix([[(-alpha*g*z1 - 2*alpha*r*z2)/g, -alpha*z2]])
    """
    return state(*(apply(f1(), e_1() + state(z1, z2)) - e_1()))


@cache
def equilibrium_speed() -> Expr:
    """The speed that an impact only reverses, the table moving at r: (1 + alpha) / (1 - alpha) r
    (equation 33).

    >>> equilibrium_speed()
    (-alpha*r - r)/(alpha - 1)
    """
    kept = Symbol("kept")
    return root_of(impact_map()[1].xreplace({v: -kept, u: r}) - kept, kept)


@cache
def subharmonic_ball_speed() -> Expr:
    """The launch speed of a flight that lasts K periods: K g T / 2 = K r (section 3.5.1, before
    equation 17).

    >>> subharmonic_ball_speed()
    K*r
    """
    return root_of(hang_time() - K * period(), v)


@cache
def subharmonic_table_speed() -> Expr:
    """The table's speed that keeps flights of K periods going: (1 - alpha) / (1 + alpha) K r
    (equation 17).

    >>> subharmonic_table_speed()
    (-K*alpha*r + K*r)/(alpha + 1)
    """
    speed = subharmonic_ball_speed()
    return root_of(impact_map()[1].xreplace({v: -speed}) - speed, u)


@cache
def table_speed_at_fixed_point() -> Expr:
    """The table's speed at the impact of e_K, from the fixed point itself: the same as
    `subharmonic_table_speed`.

    >>> lowest_terms(table_speed_at_fixed_point() - subharmonic_table_speed())
    0
    """
    return _at(table_speed_at_collision(), impact_fixed_point())


@cache
def subharmonic_bound() -> Expr:
    """The real K at which the table's speed must be the greatest it has, r: (1 + alpha) / (1 -
    alpha) (equation 18).

    >>> subharmonic_bound()
    (-alpha - 1)/(alpha - 1)
    """
    return root_of(subharmonic_table_speed() - r, K)


def restitution_threshold(periods: Expr = K) -> Expr:
    """The restitution from which on e_K exists: (K - 1) / (K + 1) (equations 20 and 21).

    >>> restitution_threshold(), restitution_threshold(K + 1), restitution_threshold(2)
    ((K - 1)/(K + 1), K/(K + 2), 1/3)
    """
    return lowest_terms(root_of(subharmonic_bound() - K, alpha).xreplace({K: periods}))


def _at(expression: Expr, where: State) -> Expr:
    return lowest_terms(expression.xreplace({beta: where[0], v: where[1]}))
