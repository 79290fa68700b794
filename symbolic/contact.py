"""A corner of a rigid body and the table that it strikes: what an impulse at the corner does (scene
of section 2.1, figure 2).

All of it per unit of mass, which drops out.  The corner stands (x_c, y_c) from the centre of mass;
J, the moment of inertia about that centre, is the square of the radius of gyration.  S and C are
the tangential and the normal velocity of the corner relative to the table.
"""

from __future__ import annotations

from functools import cache

from sympy import Expr, ImmutableMatrix, Symbol

from symbolic.algebra import DerivationError, State, integral_from_zero, lowest_terms, state

x_c = Symbol("x_c")  # the corner's place along the table, from the centre of mass
y_c = Symbol("y_c")  # the corner's place upwards, from the centre of mass
J = Symbol("J")  # moment of inertia about the centre of mass, per unit of mass
c_x = Symbol("c_x")  # velocity of the centre of mass relative to the table
c_y = Symbol("c_y")
omega = Symbol("omega")  # angular velocity
P_x = Symbol("P_x")  # tangential and normal impulse
P_y = Symbol("P_y")
B1 = Symbol("B1")  # what an impulse does to the corner's velocity: see contact_coefficients
B2 = Symbol("B2")
B3 = Symbol("B3")
S0 = Symbol("S0")  # velocities of the corner before the impact
C0 = Symbol("C0")  # less than 0 where corner and table approach


@cache
def corner_velocity() -> State:
    """The velocity (S, C) of the corner of a body that moves at (c_x, c_y) and turns at omega
    (rigid body).

    >>> corner_velocity().T
    Matrix([[c_x - omega*y_c, c_y + omega*x_c]])
    """
    return state(c_x - omega * y_c, c_y + omega * x_c)


@cache
def motion_after_impulse() -> ImmutableMatrix:
    """The motion (c_x, c_y, omega) after the impulse (P_x, P_y) at the corner (momentum and angular
    momentum).

    >>> motion_after_impulse().T
    Matrix([[P_x + c_x, P_y + c_y, omega + (-P_x*y_c + P_y*x_c)/J]])
    """
    return ImmutableMatrix([c_x + P_x, c_y + P_y, omega + (x_c * P_y - y_c * P_x) / J])


def _moved(expression: Expr) -> Expr:
    """The same of the motion after the impulse."""
    return expression.xreplace(dict(zip((c_x, c_y, omega), motion_after_impulse())))


@cache
def contact_coefficients() -> ImmutableMatrix:
    """What an impulse does to the corner's velocity: (B1, B2, B3), where S grows by B1 P_x - B3 P_y
    and C by B2 P_y - B3 P_x (Routh).

    >>> contact_coefficients().T
    Matrix([[(J + y_c**2)/J, (J + x_c**2)/J, x_c*y_c/J]])
    """
    response = _moved(corner_velocity()).jacobian([P_x, P_y]).applyfunc(lowest_terms)
    if response[0, 1] != response[1, 0]:
        raise DerivationError(f"not symmetric: {response}")
    return ImmutableMatrix([response[0, 0], response[1, 1], -response[0, 1]])


@cache
def velocity_after_impulse() -> State:
    """The velocity (S, C) of the corner after an impulse, in terms of its coefficients (Routh).

    >>> velocity_after_impulse().T
    Matrix([[B1*P_x - B3*P_y + S0, B2*P_y - B3*P_x + C0]])
    """
    return state(S0 + B1 * P_x - B3 * P_y, C0 - B3 * P_x + B2 * P_y)


@cache
def work_of_impulse() -> Expr:
    """The work of an impulse on a body, the power of the growing impulse at the corner summed up:
    P_x (S0 + S)/2 + P_y (C0 + C)/2 (Routh).

    It does not depend on how the impulse grows, since the response is symmetric.

    >>> work_of_impulse()
    B1*P_x**2/2 + B2*P_y**2/2 - B3*P_x*P_y + C0*P_y + P_x*S0
    """
    part = Symbol("part")
    moving = velocity_after_impulse().xreplace({P_x: part * P_x, P_y: part * P_y})
    return lowest_terms(
        integral_from_zero(P_x * moving[0] + P_y * moving[1], part).xreplace({part: 1})
    )


@cache
def kinetic_energy_gained() -> Expr:
    """What an impulse at the corner adds to the kinetic energy of the body in the table's frame,
    per unit of mass (rigid body).

    >>> values = {x_c: 2, y_c: 1, J: 1, c_x: 0, c_y: -1, omega: 0, P_x: 0, P_y: 1}
    >>> kinetic_energy_gained().xreplace(values)
    3/2
    """
    energy = (c_x**2 + c_y**2 + J * omega**2) / 2
    return lowest_terms(_moved(energy) - energy)
