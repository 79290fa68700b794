"""Impact of a light body on a heavy one: momentum balance and restitution, solved (section
2.2.2).
"""

from __future__ import annotations

from functools import cache

from sympy import Expr, ImmutableMatrix, Symbol

from symbolic.algebra import State, solution_of, state
from symbolic.symbols import alpha, beta, rho, u, v

mass_ratio = Symbol("m")  # mass of the ball over mass of the table


@cache
def speeds_after_impact() -> tuple[Expr, Expr]:
    """Speeds of ball and table after an impact of a ball of mass m on a table of mass 1.

    The momentum m v + u is kept, and the bodies part at alpha times the speed at which they met
    (equation 2).

    >>> # Equal masses swap speeds.
    >>> [speed.xreplace({mass_ratio: 1, alpha: 1}) for speed in speeds_after_impact()]
    [u, v]
    """
    ball, table = Symbol("ball"), Symbol("table")
    momentum = (mass_ratio * ball + table) - (mass_ratio * v + u)
    restitution = (ball - table) + alpha * (v - u)
    after_ball, after_table = solution_of([momentum, restitution], [ball, table])
    return after_ball, after_table


@cache
def impact_map() -> State:
    """The ball's state (beta, v) after it meets a much heavier table of state (rho, u): C_y(x)
    (equation 3).

    Position is continuous; the speed is that of `speeds_after_impact` at mass ratio 0.

    >>> impact_map().T
    Matrix([[beta, alpha*u - alpha*v + u]])
    """
    return state(beta, speeds_after_impact()[0].xreplace({mass_ratio: 0}))


@cache
def table_after_impact() -> State:
    """The table's state after the impact, at mass ratio 0: unchanged (section 2.2.2, before
    equation 3).

    >>> table_after_impact().T
    Matrix([[rho, u]])
    """
    return state(rho, speeds_after_impact()[1].xreplace({mass_ratio: 0}))


def collide(ball: State, table: State) -> State:
    """The ball's state after it meets the table: C_table(ball) (equation 3).

    >>> collide(state(0, -1), state(0, 2)).T
    Matrix([[0, 3*alpha + 2]])
    """
    return state(*impact_map().xreplace({beta: ball[0], v: ball[1], rho: table[0], u: table[1]}))


@cache
def restitution_matrix() -> State:
    """The matrix R_alpha of C_y(x) = R_alpha x + (1 - R_alpha) y, the part that acts on the ball
    (equation 3).

    >>> restitution_matrix()
    Matrix([
    [1,      0],
    [0, -alpha]])
    """
    return ImmutableMatrix(impact_map().jacobian([beta, v]))
