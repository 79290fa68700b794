"""When and how ball and table meet (section 3.2, appendices B.1 and B.2)."""

from __future__ import annotations

from functools import cache

from sympy import Expr

from symbolic.algebra import State, lowest_terms, root_of, state
from symbolic.flight import flight_map, flight_matrix
from symbolic.symbols import beta, g, r, t, v
from symbolic.table import launch_state, period, table_at


@cache
def gap() -> Expr:
    """The height of the ball above the table at time t, if they do not meet before: beta + t (v -
    r) (section 3.2).

    >>> gap()
    beta - r*t + t*v
    """
    return lowest_terms(flight_map()[0] - table_at()[0])


@cache
def collision_time() -> Expr:
    """The time tau_c at which ball and table are at the same height: beta / (r - v) (equation 6).

    >>> collision_time()
    beta/(r - v)
    """
    return root_of(gap(), t)


@cache
def time_after_collision() -> Expr:
    """The time T - tau_c from the collision to the next launch of the table (table II).

    >>> time_after_collision()
    (-beta*g + 2*r**2 - 2*r*v)/(g*r - g*v)
    """
    return lowest_terms(period() - collision_time())


@cache
def relative_state_at_collision() -> State:
    """Ball less table at the collision: A_tau (b - r_0) = (0, v - r) (section 3.2, before equation
    9).

    >>> relative_state_at_collision().T
    Matrix([[0, -r + v]])
    """
    return state(*(flight_matrix(collision_time()) * (state(beta, v) - launch_state())))


@cache
def ball_speed_at_collision() -> Expr:
    """The ball's speed just before the collision: v - g tau_c (section 3.4.2).

    >>> ball_speed_at_collision().xreplace({beta: 3, v: 0, r: 2, g: 4})
    -6
    """
    return lowest_terms(flight_map()[1].xreplace({t: collision_time()}))


@cache
def table_speed_at_collision() -> Expr:
    """The table's speed at the collision: r - g tau_c (section 3.4.2).

    >>> table_speed_at_collision().xreplace({beta: 3, v: 0, r: 2, g: 4})
    -4
    """
    return lowest_terms(table_at(collision_time())[1])


@cache
def collision_margin() -> Expr:
    """Positive where the collision comes before the period ends: r^2 - (g beta / 2 + r v)
    (inequality 7).

    It is (T - tau_c) (r - v) g / 2: of the sign of T - tau_c where the bodies approach (v < r) and
    g > 0.

    >>> collision_margin()
    -beta*g/2 + r**2 - r*v
    """
    return lowest_terms(time_after_collision() * (r - v) * g / 2)


@cache
def boundary_speed() -> Expr:
    """The speed on the line tau_c = T between B1 and B2, as a function of height: r - beta / T
    (equation 29).

    >>> boundary_speed()
    (-beta*g + 2*r**2)/(2*r)
    """
    return root_of(collision_margin(), v)


@cache
def boundary_height() -> Expr:
    """The height on the line tau_c = T between B1 and B2, as a function of speed: T (r - v)
    (equation 29).

    >>> boundary_height()
    (2*r**2 - 2*r*v)/g
    """
    return root_of(collision_margin(), beta)
