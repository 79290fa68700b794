"""Energy and its change at an impact (section 3.4, appendices A.2 and B.5), and the normal form, in
which heights and speeds are in units of the table and only alpha is left.
"""

from __future__ import annotations

from functools import cache

from sympy import Expr, Integer, Matrix, expand, eye

from juggleproof.symbolic.algebra import (
    DerivationError,
    K,
    State,
    apply,
    beta,
    integral_from_zero,
    lowest_terms,
    r,
    root_of,
    solution_of,
    state,
    t,
    tau,
    v,
    w,
    x,
    z1,
    z2,
)
from juggleproof.symbolic.maps import (
    e_1,
    f1,
    f2,
    fixed_point,
    flight_power,
    impact_fixed_point,
    relative_map,
)
from juggleproof.symbolic.mechanics import (
    acceleration,
    collide,
    collision_margin,
    collision_time,
    flight_map,
    fly,
    period,
    table_at,
)

# -------------------------------------------------------------------------------------------------
# Energy and its change at an impact.


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

    >>> from juggleproof.symbolic.algebra import alpha, g, r
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

    >>> from juggleproof.symbolic.algebra import r
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

    >>> from juggleproof.symbolic.algebra import r
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


# -------------------------------------------------------------------------------------------------
# The normal form: heights in units of r T, closing speeds in units of r; only alpha is left.


@cache
def scaling() -> State:
    """The change of coordinates from (beta, v) to (x, w): x = beta / (r T), w = 1 - v / r.

    >>> scaling().T
    Matrix([[beta*g/(2*r**2), (r - v)/r]])
    """
    return state(beta / (r * period()), 1 - v / r)


@cache
def unscaling() -> State:
    """The change of coordinates from (x, w) back to (beta, v).

    >>> unscaling().T
    Matrix([[2*r**2*x/g, -r*w + r]])
    """
    return state(*solution_of(list(scaling() - state(x, w)), [beta, v]))


def scaled(expression: Expr, unit: Expr) -> Expr:
    """An expression in beta and v, rewritten in x and w and measured in the unit.

    >>> from juggleproof.symbolic.mechanics import collision_margin
    >>> scaled(collision_margin(), r**2)
    w - x
    """
    return lowest_terms(expression.xreplace({beta: unscaling()[0], v: unscaling()[1]}) / unit)


def scaled_state(where: State) -> State:
    """The normal form (x, w) of a state (beta, v).

    >>> scaled_state(state(0, -r)).T
    Matrix([[0, 2]])
    """
    return apply(scaling(), where)


def _conjugate(mapping: State) -> State:
    return scaled_state(apply(mapping, unscaling()))


@cache
def normal_f1() -> State:
    """The map f1 in normal form: (x, w) -> (alpha (w - x), 2 - alpha w).

    >>> normal_f1().T
    Matrix([[alpha*w - alpha*x, -alpha*w + 2]])
    """
    return _conjugate(f1())


@cache
def normal_f2() -> State:
    """The map f2 in normal form: (x, w) -> (x - w, w + 2).

    >>> normal_f2().T
    Matrix([[-w + x, w + 2]])
    """
    return _conjugate(f2())


@cache
def normal_flight_power(periods: Expr = K) -> State:
    """A number K of periods without impact, in normal form: (x, w) -> (x - K w - K (K - 1), w + 2
    K).

    >>> normal_flight_power().T
    Matrix([[-K**2 - K*w + K + x, 2*K + w]])
    """
    return _conjugate(flight_power(periods))


@cache
def normal_margin() -> Expr:
    """What is positive exactly in B1, by inequality (7), in units of r^2: w - x.

    >>> normal_margin()
    w - x
    """
    return scaled(collision_margin(), r**2)


@cache
def normal_e_1() -> State:
    """The fixed point e_1 in normal form: (2 alpha / (1 + alpha)^2, 2 / (1 + alpha)).

    >>> normal_e_1()[1]
    2/(alpha + 1)
    """
    return scaled_state(e_1())


@cache
def normal_e_2() -> State:
    """The orbit of e_2 where its impact comes, in normal form: (2 (3 alpha - 1) / (1 + alpha)^2, 4
    / (1 + alpha)).

    >>> normal_e_2()[1]
    4/(alpha + 1)
    """
    return scaled_state(impact_fixed_point().xreplace({K: Integer(2)}))


@cache
def normal_energy() -> Expr:
    """The energy in units of r^2: 2 x + (1 - w)^2 / 2.

    >>> normal_energy()
    w**2/2 - w + 2*x + 1/2
    """
    return scaled(total_energy(), r**2)


@cache
def normal_energy_change() -> Expr:
    """The energy change of a period with an impact in units of r^2: (1 + alpha) (w - 2 x - (1 -
    alpha) w^2 / 2).

    >>> normal_energy_change().xreplace({x: 0})
    alpha**2*w**2/2 + alpha*w - w**2/2 + w
    """
    return scaled(energy_change_1(), r**2)


@cache
def normal_collision_time() -> Expr:
    """The collision time in units of T: x / w.

    >>> normal_collision_time()
    x/w
    """
    return scaled(collision_time(), period())


@cache
def normal_fixed_point() -> State:
    """The fixed point e_K of f1 o f2^(K - 1) in normal form, at the start of its flight.

    >>> normal_fixed_point()[1]
    (-2*K*alpha + 2*alpha + 2)/(alpha + 1)
    """
    return scaled_state(fixed_point())


@cache
def normal_impact_fixed_point() -> State:
    """The orbit of e_K where its impact comes, in normal form: w = 2 K / (1 + alpha).

    >>> normal_impact_fixed_point()[1]
    2*K/(alpha + 1)
    """
    return scaled_state(impact_fixed_point())


# -------------------------------------------------------------------------------------------------
# Flights of given lengths, one after another, in normal form.


@cache
def normal_impact_after(flights: tuple[int, ...]) -> State:
    """The impact after flights of so many periods each, from the impact (x, w), in normal form.

    >>> normal_impact_after((1, 2)).T
    Matrix([[-3*alpha**2*w + alpha**2*x + 4*alpha - 2, alpha**2*w - 2*alpha + 4]])
    """
    if not flights:
        return state(x, w)
    here = normal_impact_after(flights[:-1])
    for step in (normal_f1(), normal_flight_power(Integer(flights[-1] - 1))):
        here = state(*(entry.expand() for entry in step.xreplace({x: here[0], w: here[1]})))
    return here


@cache
def normal_periodic_impact(flights: tuple[int, ...]) -> State:
    """The impact that flights of so many periods each bring back, in normal form.

    >>> normal_periodic_impact((2,)) == normal_e_2()
    True
    """
    return state(*solution_of(list(normal_impact_after(flights) - state(x, w)), [x, w]))


@cache
def normal_sum_of_heights(flights: tuple[int, ...]) -> Expr:
    """A linear form in the impact (x, w), in normal form, that falls with each time that flights of
    so many periods are repeated by the height of x over that of the impact which they bring back.

    >>> form, after = normal_sum_of_heights((2,)), normal_impact_after((2,))
    >>> fall = form - form.xreplace({x: after[0], w: after[1]})
    >>> lowest_terms(fall - (x - normal_periodic_impact((2,))[0]))
    0
    """
    stays = eye(2) - normal_impact_after(flights).jacobian([x, w])
    return lowest_terms((Matrix([[1, 0]]) * stays.inv() * state(x, w))[0])


@cache
def normal_change_beside(flights: tuple[int, ...]) -> State:
    """What (z1, z2) beside an impact adds to the impact after these flights, in normal form.

    >>> normal_change_beside((1, 2)).T
    Matrix([[alpha**2*z1 - 3*alpha**2*z2, alpha**2*z2]])
    """
    change = normal_impact_after(flights).jacobian([x, w]) * state(z1, z2)
    return state(*(entry.expand() for entry in change))


@cache
def normal_impact_beside(flights: tuple[int, ...], count: int) -> State:
    """The impact after the first of the flights, so many, from (z1, z2) beside the impact that all
    of them bring back, in normal form.

    >>> lowest_terms(normal_impact_beside((1, 2), 2)[1] - normal_periodic_impact((1, 2))[1])
    alpha**2*z2
    """
    start = normal_periodic_impact(flights)
    there = normal_impact_after(flights[:count]).xreplace({x: start[0], w: start[1]})
    change = normal_change_beside(flights[:count])
    return state(*(lowest_terms(there[i]) + change[i] for i in (0, 1)))
