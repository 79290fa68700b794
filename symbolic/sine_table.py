"""A table that moves as a sine: its bounces of one period, their stability, and the curves between
which a bounce of one period can attract every motion.

Units: time in periods of the table, heights in g times the square of a period; Gamma is the peak
acceleration of the table in units of gravity.  Time is counted from an impact, at which the sine
has the angle theta; cosine and sine are those of theta, and G = Gamma sine is the acceleration at
which the table falls there.
"""

from __future__ import annotations

from functools import cache

from sympy import Expr, ImmutableMatrix, Symbol, cos, diff, expand_trig, pi, sin

from juggleproof.symbolic.algebra import (
    State,
    g,
    lowest_terms,
    rho,
    root_of,
    solution_of,
    state,
    t,
    u,
)
from juggleproof.symbolic.mechanics import collide, fly

Gamma = Symbol("Gamma")  # peak acceleration of the table
theta = Symbol("theta")  # angle of the sine at the impact
cosine = Symbol("cosine")  # of that angle
sine = Symbol("sine")
G = Symbol("G")  # acceleration at which the table falls at the impact
half_turn = Symbol("pi")  # as a number in statements, which need of pi only that it is positive
phase = Symbol("phase")  # of an impact
closing = Symbol("s")  # closing speed of an impact
landing = Symbol("landing")  # phase of the next impact
multiplier = Symbol("m")
cosine_t = Symbol("cosine_t")  # of the angle 2 pi t by which the sine has turned at time t
sine_t = Symbol("sine_t")
strike = Symbol("V")  # velocity of the ball as it strikes


def _named(expression: Expr) -> Expr:
    """The same in lowest terms, where symbols stand for cosines, sines and pi."""
    turned = Symbol("turned")
    parted = expand_trig(expression.xreplace({2 * pi * t: turned}))
    names = {cos(theta): cosine, sin(theta): sine, pi: half_turn}
    names |= {cos(turned): cosine_t, sin(turned): sine_t}
    return lowest_terms(parted.xreplace(names))


@cache
def table_height() -> Expr:
    """The table's height at time t: a sine whose greatest acceleration is Gamma.

    >>> table_height()
    Gamma*sin(2*pi*t + theta)/(4*pi**2)
    """
    wave = sin(2 * pi * t + theta)
    return Gamma * wave / (-diff(wave, t, 2) / wave)


def _table_at(time: Expr) -> dict[Symbol, Expr]:
    """Height and velocity of the table at a time, as values of rho and u."""
    height = table_height()
    return {rho: height.subs(t, time), u: diff(height, t).subs(t, time)}


def _flown(ball_speed: Expr, duration: Expr) -> State:
    """The ball after an impact on the table (rho, u) at this speed, and after a flight, at
    gravity 1.
    """
    struck = collide(state(rho, ball_speed), state(rho, u))
    return ImmutableMatrix(fly(struck, duration).xreplace({g: 1}))


# -------------------------------------------------------------------------------------------------
# The bounces of one period, and the drive at which they are born.


@cache
def change_over_a_period() -> State:
    """What a ball that strikes at the velocity V gains by impact and flight over one period: height
    above the table, and speed.

    >>> change_over_a_period().xreplace({cosine: 0}).applyfunc(lowest_terms).T
    Matrix([[-V*alpha - 1/2, -V*alpha - V - 1]])
    """
    flown, start, end = _flown(strike, 1), _table_at(0), _table_at(1)
    gained = (flown[0].xreplace(start) - end[rho], flown[1].xreplace(start) - strike)
    return ImmutableMatrix([_named(one) for one in gained])


@cache
def bounce() -> tuple[Expr, ...]:
    """The only bounces of one period: the velocity V at which the ball strikes, and the cosine of
    the angle; the two angles with this cosine give the two bounces.

    >>> bounce()
    (-1/2, (-alpha*pi + pi)/(Gamma*alpha + Gamma))
    """
    return solution_of([*change_over_a_period()], [strike, cosine])


@cache
def impact_closing_speed() -> Expr:
    """The closing speed of a ball that strikes: the velocity of the table less V.

    >>> impact_closing_speed()
    (Gamma*cosine - 2*V*pi)/(2*pi)
    """
    return lowest_terms(_named(_table_at(0)[u]) - strike)


@cache
def bounce_closing_speed() -> Expr:
    """The closing speed of a bounce of one period: 1/(1 + alpha).

    >>> bounce_closing_speed()
    1/(alpha + 1)
    """
    velocity, at_angle = bounce()
    return lowest_terms(impact_closing_speed().xreplace({strike: velocity, cosine: at_angle}))


@cache
def birth_drive() -> Expr:
    """The drive at which the bounces of one period are born, Gamma times their cosine:
    pi (1 - alpha)/(1 + alpha).

    >>> birth_drive()
    (-alpha*pi + pi)/(alpha + 1)
    """
    return lowest_terms(Gamma * bounce()[1])


@cache
def squared_drive() -> Expr:
    """The square of the drive for which the table falls at G in one bounce, and at -G in the other:
    Gamma^2 = (Gamma cosine)^2 + G^2.

    >>> from juggleproof.symbolic.algebra import alpha
    >>> squared_drive().xreplace({alpha: 0})
    G**2 + pi**2
    """
    return lowest_terms(birth_drive() ** 2 + G**2)


# -------------------------------------------------------------------------------------------------
# How the map from impact to impact takes what is near the bounce.


@cache
def bounce_jacobian() -> ImmutableMatrix:
    """The derivative of the map from impact to impact, of phase and closing speed, at the bounce
    where the table falls at G: by the implicit function theorem on the height above the table.

    >>> bounce_jacobian()
    Matrix([
    [               -G*alpha - G + 1,                 alpha**2 + alpha],
    [G**2*alpha + G**2 - G*alpha - G, -G*alpha**2 - G*alpha + alpha**2]])
    """
    flown = _flown(u - closing, landing - phase)
    start, end = _table_at(phase), _table_at(landing)
    height = flown[0].xreplace(start) - end[rho]
    arrival = end[u] - flown[1].xreplace(start)
    by_landing = diff(height, landing)
    rows = []
    for one in (phase, closing):
        lands = -diff(height, one) / by_landing
        rows.append([lands, diff(arrival, one) + diff(arrival, landing) * lands])
    at = {phase: 0, landing: 1, closing: bounce_closing_speed()}
    known = {cosine: bounce()[1], sine: G / Gamma}
    matrix = ImmutableMatrix(rows).T
    return matrix.applyfunc(lambda one: lowest_terms(_named(one.subs(at)).xreplace(known)))


@cache
def other_bounce_jacobian() -> ImmutableMatrix:
    """The same at the other bounce, where the table falls at -G.

    >>> other_bounce_jacobian()[0, 0]
    G*alpha + G + 1
    """
    return ImmutableMatrix(bounce_jacobian().xreplace({G: -G}))


@cache
def bounce_trace() -> Expr:
    """The sum of the two multipliers of the bounce: 1 + alpha^2 - (1 + alpha)^2 G.

    >>> bounce_trace()
    -G*alpha**2 - 2*G*alpha - G + alpha**2 + 1
    """
    return lowest_terms(bounce_jacobian().trace())


@cache
def bounce_determinant() -> Expr:
    """The product of the two multipliers of the bounce: alpha^2.

    >>> bounce_determinant()
    alpha**2
    """
    return lowest_terms(bounce_jacobian().det())


@cache
def bounce_characteristic() -> Expr:
    """The polynomial whose zeros m are the multipliers of the bounce.

    >>> bounce_characteristic().xreplace({multiplier: 1}).factor()
    G*(alpha + 1)**2
    """
    return bounce_jacobian().charpoly(multiplier).as_expr()


@cache
def doubling_fall() -> Expr:
    """The G at which a multiplier of the bounce is -1 and its period doubles: 2 (1 + alpha^2)/(1 +
    alpha)^2.

    >>> doubling_fall().factor()
    2*(alpha**2 + 1)/(alpha + 1)**2
    """
    return root_of(bounce_characteristic().xreplace({multiplier: -1}), G)


# -------------------------------------------------------------------------------------------------
# Where the flight of the other bounce begins to be possible.


@cache
def other_bounce_gap() -> State:
    """The ball's height above the table and its rate at time t, on the flight of the other bounce:
    that flight grazes the table where both vanish at one t.

    >>> other_bounce_gap().xreplace({t: 1, cosine_t: 1, sine_t: 0}).applyfunc(lowest_terms).T
    Matrix([[0, -1/(alpha + 1)]])
    """
    velocity, at_angle = bounce()
    start, end = _table_at(0), _table_at(t)
    flown = _flown(velocity, t).xreplace(start)
    gap = (flown[0] - end[rho], flown[1] - end[u])
    return ImmutableMatrix(
        [lowest_terms(_named(one).xreplace({cosine: at_angle, sine: -G / Gamma})) for one in gap]
    )
