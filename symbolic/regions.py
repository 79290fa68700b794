"""The region R, its corner, the point p, and how long an orbit takes to enter R (sections 4.1 to
4.3, appendix A).
"""

from __future__ import annotations

from functools import cache

from sympy import Expr, Poly, Symbol, ceiling, sqrt

from symbolic.algebra import DerivationError, State, lowest_terms, root_of, state
from symbolic.bounds import delta_E_sup, physical_state, region_energy
from symbolic.collision import boundary_height
from symbolic.energy import energy_at, energy_gradient, total_energy
from symbolic.fixed_points import e_1
from symbolic.flight import hang_time
from symbolic.normal_form import scaled
from symbolic.signs import sign_for_lossy_impacts, simplest_roots
from symbolic.symbols import E0, beta, r, v, w, x


@cache
def region_margin() -> Expr:
    """The function whose sign tells R: R(b) = E_max + Delta E_max - E(b) (equations 23 and 24,
    appendix B.6).

    >>> region_margin().xreplace({beta: 0, v: 0})
    r**2*(alpha + 1)/(alpha - 1)**2
    """
    return region_energy() - total_energy()


@cache
def region_gradient() -> State:
    """The gradient of R(b) with respect to beta and v: (-g, -v) (after equation 38).

    >>> region_gradient().T
    Matrix([[-g, -v]])
    """
    return state(region_margin().diff(beta), region_margin().diff(v))


@cache
def lagrange_multiplier() -> Expr:
    """The multiplier lambda in grad Delta_1 E = lambda grad R, from its first component: alpha + 1
    (after equation 38).

    >>> lagrange_multiplier()
    alpha + 1
    """
    return lowest_terms(energy_gradient()[0] / region_gradient()[0])


@cache
def stationary_speed_on_region_boundary() -> Expr:
    """The speed at which Delta_1 E is stationary on R(b) = 0: r, where ball and table do not
    approach (A.3.1).

    >>> stationary_speed_on_region_boundary()
    r
    """
    return root_of(energy_gradient()[1] - lagrange_multiplier() * region_gradient()[1], v)


@cache
def region_corner() -> State:
    """The state where R(b) = 0 meets beta = 0 in B1: (0, -sqrt(2 (1 + alpha)) r / (1 - alpha))
    (equation 39).

    >>> region_corner().T
    Matrix([[0, r*sqrt(2*alpha + 2)/(alpha - 1)]])
    """
    margin = scaled(region_margin(), r**2)
    speeds = [
        root
        for root in simplest_roots(Poly(margin.xreplace({x: 0}), w))
        if sign_for_lossy_impacts(root) > 0
    ]
    if len(speeds) != 1:
        raise DerivationError(f"not one corner: {speeds}")
    return physical_state(0, speeds[0])


@cache
def point_p() -> State:
    """Where the line tau_c = T has the speed of e_1: p = (2 T r / (1 + alpha), -(1 - alpha) r / (1
    + alpha)) (30).

    >>> point_p().T
    Matrix([[4*r**2/(alpha*g + g), (alpha*r - r)/(alpha + 1)]])
    """
    speed = e_1()[1]
    return state(boundary_height().xreplace({v: speed}), speed)


@cache
def energy_of_p() -> Expr:
    """The energy of p: E(p) (equation 31).

    >>> energy_of_p().subs("alpha", 1)
    2*r**2
    """
    return energy_at(point_p())


@cache
def worst_flight_time() -> Expr:
    """The longest flight with energy E0: up from height 0 and back, tau_w = 2 sqrt(2 E0) / g
    (equation 25).

    >>> worst_flight_time()
    2*sqrt(2)*sqrt(E0)/g
    """
    square = Symbol("square")
    from_ground = Poly(total_energy().xreplace({beta: 0}) - E0, v)
    launch_square = root_of(from_ground.nth(2) * square + from_ground.nth(0), square)
    return hang_time().xreplace({v: sqrt(launch_square)})


@cache
def impacts_to_enter_region() -> Expr:
    """How many impacts, as a real number, bring the energy E0 down to that of R: (E0 - E_R) /
    -Delta E_sup (A.4).

    >>> from sympy import Rational
    >>> impacts_to_enter_region().subs("alpha", Rational(1, 8)).xreplace({E0: 10, r: 1})
    2816/189
    """
    count, change = Symbol("count"), Symbol("change")
    return root_of(E0 + count * change - region_energy(), count).xreplace({change: delta_E_sup()})


@cache
def time_to_enter_region() -> Expr:
    """The time in which every orbit of energy E0 enters R: t_R, with whole impacts (equation 26).

    >>> time_to_enter_region().has(ceiling)
    True
    """
    return worst_flight_time() * ceiling(impacts_to_enter_region())
