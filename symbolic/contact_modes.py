"""The impact of a corner with Coulomb friction and Poisson's restitution, by a walk through impulse
space (Routh; Wang and Mason 1992).

The walk begins on the line of sliding, where friction is mu times the normal impulse and opposes
the sliding.  Where the corner stops (S = 0) it goes on along the line of sticking or, where
friction cannot hold it, along the line of sliding back.  Compression is greatest where C = 0, at
the normal impulse n; the walk ends at (1 + e) n.  Five modes: no stop at all, or one in compression
or in restitution, then sticking or sliding back.

All is derived for a corner that slides to the right, S0 >= 0.  The mirror image of an impact is
one: sigma = 1 or -1 is the direction of sliding.
"""

from __future__ import annotations

from functools import cache

from sympy import Expr, ImmutableMatrix, S, Symbol, diff, factor, fraction

from symbolic.algebra import State, lowest_terms, root_of, state
from symbolic.contact import B3, C0, S0, P_x, P_y, velocity_after_impulse, work_of_impulse

mu = Symbol("mu")  # coefficient of friction
e = Symbol("e")  # coefficient of restitution
sigma = Symbol("sigma")  # direction in which the corner slides at first: 1 or -1

# mode -> the lines of greatest compression and of the end
MODES = {
    "sliding": ("sliding", "sliding"),
    "sticking-in-compression": ("sticking", "sticking"),
    "sticking-in-restitution": ("sliding", "sticking"),
    "reversed-in-compression": ("reversed", "reversed"),
    "reversed-in-restitution": ("sliding", "reversed"),
}


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

    >>> from symbolic.contact import B1, B2
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

    >>> from symbolic.contact import B1, B2
    >>> values = {B1: 2, B2: 2, B3: 1, S0: 0, C0: -3, e: 0}  # e = 0: as by Poisson's
    >>> newton_impulse().xreplace(values).T
    Matrix([[1, 2]])
    """
    law = velocity_after_impulse()[1] + e * C0
    normal = root_of(_at(law, _line("sticking")), P_y)
    return _mirrored_pair(_at(_line("sticking"), P_x, normal), normal)
