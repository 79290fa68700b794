"""Free flight: Newton's equation with constant gravity, integrated twice (section 2.2.2)."""

from __future__ import annotations

from functools import cache

from sympy import Expr

from symbolic.algebra import State, affine_parts, integral_from_zero, root_of, state
from symbolic.symbols import beta, g, t, v


@cache
def acceleration() -> Expr:
    """Newton's equation of free flight: the acceleration is -g (section 2.2.2, before equation 1).

    >>> acceleration()
    -g
    """
    return -g


@cache
def flight_map() -> State:
    """The flight map F^t: two integrations of the acceleration from the state (beta, v) (equation
    1).

    >>> flight_map().T
    Matrix([[beta - g*t**2/2 + t*v, -g*t + v]])
    """
    speed = v + integral_from_zero(acceleration(), t)
    return state(beta + integral_from_zero(speed, t), speed)


def fly(start: State, duration: Expr) -> State:
    """The state after free flight from start for the duration: F^duration(start) (equation 1).

    >>> from symbolic.symbols import r
    >>> fly(state(0, r), 2 * r / g).T
    Matrix([[0, -r]])
    """
    # At once, since a duration such as the time of collision may itself contain beta and v.
    return state(*flight_map().xreplace({t: duration, beta: start[0], v: start[1]}))


def flight_matrix(duration: Expr = t) -> State:
    """The matrix A_t of F^t(b) = A_t b - a_t (equation 1).

    >>> flight_matrix()
    Matrix([
    [1, t],
    [0, 1]])
    """
    return affine_parts(flight_map())[0].xreplace({t: duration})


def flight_offset(duration: Expr = t) -> State:
    """The column a_t of F^t(b) = A_t b - a_t (equation 1).

    >>> flight_offset().T
    Matrix([[g*t**2/2, g*t]])
    """
    return -affine_parts(flight_map())[1].xreplace({t: duration})


@cache
def hang_time() -> Expr:
    """How long a body launched upwards at speed v takes to return to its height: t_f = 2 v / g
    (section 3.5.1).

    >>> hang_time()
    2*v/g
    """
    # The return is the nonzero root, so the root 0 (the launch itself) is divided out.
    return root_of((flight_map()[0] - beta) / t, t)
