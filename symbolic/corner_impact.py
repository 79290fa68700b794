"""The impact of a rigid body's corner on a table, with Coulomb friction and Poisson's restitution
(the scene of section 2.1, figure 2).

All of it is per unit of mass, which drops out.  The corner stands (x_c, y_c) from the centre of
mass; J, the moment of inertia about that centre, is the square of the radius of gyration.  S and C
are the tangential and the normal velocity of the corner relative to the table.
"""

from __future__ import annotations

from functools import cache

from sympy import Expr, ImmutableMatrix, S, Symbol, diff, factor, fraction

from juggleproof.symbolic.algebra import (
    DerivationError,
    State,
    integral_from_zero,
    lowest_terms,
    root_of,
    state,
)
from juggleproof.symbolic.modes import MODES

# -------------------------------------------------------------------------------------------------
# What an impulse at the corner does.

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


# -------------------------------------------------------------------------------------------------
# The impact, by a walk through impulse space (Routh; Wang and Mason 1992).
#
# The walk begins on the line of sliding, where friction is mu times the normal impulse and opposes
# the sliding.  Where the corner stops (S = 0) it goes on along the line of sticking or, where
# friction cannot hold it, along the line of sliding back.  Compression is greatest where C = 0, at
# the normal impulse n; the walk ends at (1 + e) n.  Five modes: no stop at all, or one in
# compression or in restitution, then sticking or sliding back.
#
# All is derived for a corner that slides to the right, S0 >= 0.  The mirror image of an impact is
# one: sigma = 1 or -1 is the direction of sliding.

mu = Symbol("mu")  # coefficient of friction
e = Symbol("e")  # coefficient of restitution
sigma = Symbol("sigma")  # direction in which the corner slides at first: 1 or -1


def _at(expression: Expr, tangential: Expr, normal: Expr = P_y) -> Expr:
    """An expression of the impulse, where the impulse is this."""
    return expression.xreplace({P_x: tangential, P_y: normal})


def _mirrored(expression: Expr) -> Expr:
    """The same for a corner that slides in the direction sigma."""
    above, below = fraction(factor(lowest_terms(expression)))
    turned = [
        _without_squares(part.xreplace({B3: sigma * B3, S0: sigma * S0}))
        for part in (above.expand(), below)
    ]
    return factor(turned[0]) / turned[1]


def _without_squares(expression: Expr) -> Expr:
    """The same by sigma^2 = 1."""
    return expression.replace(
        lambda one: one.is_Pow and one.base == sigma, lambda one: sigma ** (one.exp % 2)
    )


def _mirrored_pair(tangential: Expr, normal: Expr) -> State:
    """An impulse or a velocity likewise: along the table it changes its sign."""
    return ImmutableMatrix([_mirrored(sigma * tangential), _mirrored(normal)])


@cache
def _stop() -> Expr:
    """The normal impulse at which a corner that slides to the right stops: S = 0 on the line of
    sliding.
    """
    return root_of(_at(velocity_after_impulse()[0], -mu * P_y), P_y)


@cache
def _line(name: str) -> Expr:
    """The tangential impulse at the normal impulse P_y on one of the three lines, for a corner that
    slides to the right.
    """
    if name == "sliding":
        return -mu * P_y
    if name == "reversed":
        return -mu * _stop() + mu * (P_y - _stop())
    return root_of(velocity_after_impulse()[0], P_x)


@cache
def _compressed(line: str) -> Expr:
    """The normal impulse of greatest compression, C = 0, on a line."""
    return root_of(_at(velocity_after_impulse()[1], _line(line)), P_y)


@cache
def stopping_impulse() -> State:
    """The impulse at which the sliding corner stops: S = 0 on the line of sliding (Routh).

    >>> stopping_impulse().T
    Matrix([[-S0*mu/(B1*mu + B3*sigma), S0*sigma/(B1*mu + B3*sigma)]])
    """
    return _mirrored_pair(-mu * _stop(), _stop())


@cache
def compressing_impulse(mode: str) -> State:
    """The impulse at greatest compression, C = 0 (Routh).

    >>> compressing_impulse("sticking-in-compression")[1]
    (-B1*C0 - B3*S0)/(B1*B2 - B3**2)
    """
    line = MODES[mode][0]
    normal = _compressed(line)
    return _mirrored_pair(_at(_line(line), P_x, normal), normal)


@cache
def normal_impulse(mode: str) -> Expr:
    """The normal impulse of the impact: 1 + e times that of greatest compression (Poisson).

    >>> normal_impulse("sliding")
    -C0*(e + 1)/(B2 + B3*mu*sigma)
    """
    return _mirrored((1 + e) * _compressed(MODES[mode][0]))


@cache
def tangential_impulse(mode: str) -> Expr:
    """The tangential impulse of the impact, in terms of the normal one (Routh).

    >>> tangential_impulse("sliding"), tangential_impulse("sticking-in-restitution")
    (-P_y*mu*sigma, (B3*P_y - S0)/B1)
    """
    return _mirrored(sigma * _line(MODES[mode][1]))


@cache
def contact_impulse(mode: str) -> State:
    """The impulse (P_x, P_y) of the impact (Wang and Mason, their table of five modes).

    >>> contact_impulse("sliding").T
    Matrix([[C0*mu*sigma*(e + 1)/(B2 + B3*mu*sigma), -C0*(e + 1)/(B2 + B3*mu*sigma)]])
    """
    compression, end = MODES[mode]
    normal = (1 + e) * _compressed(compression)
    return _mirrored_pair(_at(_line(end), P_x, normal), normal)


@cache
def velocity_after_contact(mode: str) -> State:
    """The velocity (S, C) of the corner after the impact (Routh).

    >>> velocity_after_contact("sliding")[1], velocity_after_contact("sticking-in-compression")[0]
    (-C0*e, 0)
    """
    compression, end = MODES[mode]
    normal = (1 + e) * _compressed(compression)
    after = state(
        *(_at(speed, _at(_line(end), P_x, normal), normal) for speed in velocity_after_impulse())
    )
    return _mirrored_pair(after[0], after[1])


@cache
def energy_gained_in_contact(mode: str) -> Expr:
    """What the impact adds to the kinetic energy in the table's frame, per unit of mass: never more
    than 0 (Routh).

    >>> from juggleproof.symbolic.corner_impact import B1, B2
    >>> example = {B1: 1, B2: 4, B3: 0, S0: 0, C0: -2, e: S.Half, mu: 1, sigma: 1}
    >>> energy_gained_in_contact("sticking-in-compression").xreplace(example)
    -3/8
    """
    compression, end = MODES[mode]
    normal = (1 + e) * _compressed(compression)
    return _mirrored(_at(work_of_impulse(), _at(_line(end), P_x, normal), normal))


@cache
def closing_rate() -> Expr:
    """The rate at which a normal impulse ends the approach of a sliding corner: of C along the line
    of sliding (Routh).

    Where it is not positive, friction jams the corner.

    >>> closing_rate()
    B2 + B3*mu*sigma
    """
    return _mirrored(_rate(1))


@cache
def stopping_rate() -> Expr:
    """The rate at which a normal impulse stops the sliding corner: of -S along the line of sliding
    (Routh).

    Where it is not positive, the corner never stops.

    >>> stopping_rate()
    B1*mu + B3*sigma
    """
    return _mirrored(-_rate(0))


def _rate(which: int) -> Expr:
    """The growth of S or C with the normal impulse on the line of sliding."""
    return diff(_at(velocity_after_impulse()[which], -mu * P_y), P_y)


@cache
def slides_through_compression() -> Expr:
    """The margin by which the corner slides through compression: P_d - P_q, S at its greatest times
    the closing rate (Wang and Mason).

    >>> slides_through_compression()
    B1*C0*mu + B2*S0*sigma + B3*C0*sigma + B3*S0*mu
    """
    return _slides_through(S.One)


@cache
def slides_through_restitution() -> Expr:
    """The margin by which the corner slides through restitution: P_d - (1 + e) P_q, S at the end
    times the closing rate (Wang and Mason).

    >>> slides_through_restitution().xreplace({e: 0}) == slides_through_compression()
    True
    """
    return _slides_through(1 + e)


def _slides_through(part: Expr) -> Expr:
    normal = part * _compressed("sliding")
    return _mirrored(_at(velocity_after_impulse()[0], -mu * normal, normal) * _rate(1)).expand()


@cache
def slides_back() -> Expr:
    """The margin by which friction fails to hold a corner that has stopped: the speed gained on the
    line of sliding back (Routh).

    >>> slides_back()
    -B1*mu + B3*sigma
    """
    return _mirrored(-diff(_at(velocity_after_impulse()[0], _line("reversed")), P_y))


@cache
def newton_impulse() -> State:
    """The impulse of a corner that sticks, were the impact to end with C = -e C0 (Newton's
    restitution).

    >>> from juggleproof.symbolic.corner_impact import B1, B2
    >>> values = {B1: 2, B2: 2, B3: 1, S0: 0, C0: -3, e: 0}  # e = 0: as by Poisson's
    >>> newton_impulse().xreplace(values).T
    Matrix([[1, 2]])
    """
    law = velocity_after_impulse()[1] + e * C0
    normal = root_of(_at(law, _line("sticking")), P_y)
    return _mirrored_pair(_at(_line("sticking"), P_x, normal), normal)
