"""The table: a point mass bouncing on the ground without loss (section 3.1)."""

from __future__ import annotations

from functools import cache

from sympy import Expr, S

from symbolic.algebra import State, state
from symbolic.flight import fly, hang_time
from symbolic.impact import collide
from symbolic.symbols import alpha, r, t, v


@cache
def launch_state() -> State:
    """The table as it leaves the ground: r_0 = (0, r) (section 3.1).

    >>> launch_state().T
    Matrix([[0, r]])
    """
    return state(S.Zero, r)


def table_at(time: Expr = t) -> State:
    """The table's state at a time after its launch, within the period: F^t(r_0) (equation 5).

    >>> table_at().T
    Matrix([[-g*t**2/2 + r*t, -g*t + r]])
    """
    return fly(launch_state(), time)


@cache
def period() -> Expr:
    """The table's period: the nonzero root T = 2 r / g of its height (section 3.1, appendix B.1).

    >>> period()
    2*r/g
    """
    return hang_time().xreplace({v: r})


@cache
def landing_state() -> State:
    """The table as it meets the ground again: F^T(r_0) = (0, -r) (section 3.1).

    >>> landing_state().T
    Matrix([[0, -r]])
    """
    return table_at(period())


@cache
def state_after_ground() -> State:
    """The landed table after a lossless bounce (restitution 1) off the ground at rest: r_0 again
    (section 3.1).

    >>> state_after_ground() == launch_state()
    True
    """
    ground = state(S.Zero, S.Zero)
    return collide(landing_state(), ground).xreplace({alpha: 1})
