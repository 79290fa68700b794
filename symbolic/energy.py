"""Energy and its change at an impact (section 3.4, appendices A.2 and B.5)."""

from __future__ import annotations

from functools import cache

from sympy import Expr, expand

from symbolic.algebra import (
    DerivationError,
    State,
    integral_from_zero,
    lowest_terms,
    root_of,
    state,
)
from symbolic.fixed_points import relative_map
from symbolic.flight import acceleration, flight_map, fly
from symbolic.impact import collide
from symbolic.maps import f1, f2
from symbolic.symbols import beta, t, tau, v, z2
from symbolic.table import table_at


@cache
def total_energy() -> Expr:
    """The first integral of flight: kinetic energy less the work of gravity, E = g beta + v^2 / 2
    (equation 14).

    Zero at rest on the ground; its conservation, v dE/dbeta + (acceleration) dE/dv = 0, is checked.

    >>> total_energy()
    beta*g + v**2/2
    """
    found = integral_from_zero(v, v) - integral_from_zero(acceleration(), beta)
    if expand(v * found.diff(beta) + acceleration() * found.diff(v)) != 0:
        raise DerivationError(f"not conserved in flight: {found}")
    return found


def energy_at(where: State) -> Expr:
    """The energy of a state: E(b) (equation 14).

    >>> energy_at(state(v, beta))
    beta**2/2 + g*v
    """
    return lowest_terms(total_energy().xreplace({beta: where[0], v: where[1]}))


@cache
def energy_in_flight() -> Expr:
    """The energy after flight for time t: E o F^t = E, free of t (section 3.4.1).

    >>> energy_in_flight() == total_energy(), t in energy_in_flight().free_symbols
    (True, False)
    """
    return energy_at(flight_map())


@cache
def energy_change_1() -> Expr:
    """The energy gained in a period with an impact: E o f1 - E (section 3.4.2).

    >>> from symbolic.symbols import alpha, g, r
    >>> energy_change_1().xreplace({beta: 0, v: -3, r: 1, g: 1, alpha: 0})
    -4
    """
    return expand(lowest_terms(energy_at(f1()) - total_energy()))


@cache
def energy_change_2() -> Expr:
    """The energy gained in a period without an impact: E o f2 - E = 0 (equation 15).

    >>> energy_change_2()
    0
    """
    return expand(lowest_terms(energy_at(f2()) - total_energy()))


@cache
def energy_change_at_impact() -> Expr:
    """The kinetic energy gained at an impact at time tau: half the difference of squared speeds
    (equation 16).

    >>> from symbolic.symbols import r
    >>> energy_change_at_impact().xreplace({tau: 0})
    -v**2/2 + (alpha*r - alpha*v + r)**2/2
    """
    before = fly(state(beta, v), tau)
    after = collide(before, table_at(tau))
    return after[1] ** 2 / 2 - before[1] ** 2 / 2


@cache
def energy_gradient() -> State:
    """The gradient of the energy change with respect to beta and v (equations 35 and 36).

    >>> energy_gradient().T
    Matrix([[-alpha*g - g, -alpha**2*r + alpha**2*v - alpha*r - v]])
    """
    return state(energy_change_1().diff(beta), energy_change_1().diff(v))


@cache
def zero_change_speed() -> Expr:
    """The speed v for which an impact at time tau keeps the energy (equation 22, appendix B.5).

    The energy change is quadratic in v. One root is that of grazing, where the bodies move alike;
    this is the other.

    >>> from symbolic.symbols import r
    >>> zero_change_speed().xreplace({tau: 0})
    (alpha*r + r)/(alpha - 1)
    """
    grazing = flight_map()[1].xreplace({t: tau}) - table_at(tau)[1]
    return root_of(energy_change_at_impact() / grazing, v)


@cache
def zero_change_height() -> Expr:
    """The height beta for which a period with an impact keeps the energy: a parabola in v (section
    4.1, figure 8).

    >>> zero_change_height().xreplace({v: 0})
    (alpha*r**2 + r**2)/(2*g)
    """
    return root_of(energy_change_1(), beta)


@cache
def relative_kinetic_energy() -> Expr:
    """The kinetic energy of the motion relative to e_1, in z = b - e_1: z2^2 / 2 (equation 28).

    >>> relative_kinetic_energy()
    z2**2/2
    """
    return integral_from_zero(v, v).xreplace({v: z2})


@cache
def relative_kinetic_energy_change() -> Expr:
    """The change of the relative kinetic energy under f1: (alpha^2 - 1) z2^2 / 2, zero on the whole
    line z2 = 0 (section 4.3.1).

    >>> relative_kinetic_energy_change()
    alpha**2*z2**2/2 - z2**2/2
    """
    after = relative_kinetic_energy().xreplace({z2: relative_map()[1]})
    return expand(lowest_terms(after - relative_kinetic_energy()))
