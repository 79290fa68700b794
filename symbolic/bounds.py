"""Bounds of the energy, E_max, Delta E_max and Delta E_sup, and the region R with its corner, the
point p and the times to enter it, for all 0 < alpha < 1 (sections 4.1 to 4.3, appendix A).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import combinations
from typing import NamedTuple

from sympy import Expr, ImmutableMatrix, Poly, Symbol, ceiling, sqrt

from juggleproof.symbolic.algebra import (
    E0,
    DerivationError,
    State,
    beta,
    lowest_terms,
    r,
    reduced,
    root_of,
    sign_for_lossy_impacts,
    simplest_roots,
    state,
    v,
    w,
    x,
)
from juggleproof.symbolic.energy import (
    energy_at,
    energy_gradient,
    normal_energy,
    normal_energy_change,
    scaled,
    total_energy,
    unscaling,
)
from juggleproof.symbolic.maps import e_1
from juggleproof.symbolic.mechanics import boundary_height, collision_margin, hang_time, period

# -------------------------------------------------------------------------------------------------
# The maximum of a function of (x, w) on a set, by comparing all candidates.
#
# Candidates are the points where the function is stationary inside, along each boundary curve
# (Lagrange), and the corners where two curves meet. Every function and constraint here is linear in
# x, so a curve gives x as a function of w.


class Candidate(NamedTuple):
    """A point (x, w) with the value there and the constraints that hold with equality by its
    construction.
    """

    x: Expr
    w: Expr
    value: Expr
    active: tuple[Expr, ...]


def candidates(objective: Expr, constraints: Sequence[Expr]) -> list[Candidate]:
    """The stationary points inside, along each curve constraint = 0, and the corners that satisfy
    all constraints >= 0.

    >>> largest, least = candidates(w - x, [x, 1 - w, w])
    >>> largest
    Candidate(x=0, w=1, value=1, active=(x, 1 - w))
    >>> least
    Candidate(x=0, w=0, value=0, active=(x, w))
    """
    _refuse_stationary_inside(objective)
    points: list[tuple[Expr, Expr, tuple[Expr, ...]]] = []
    for curve in constraints:
        points += [(*point, (curve,)) for point in _stationary_along(objective, curve)]
    for first, second in combinations(constraints, 2):
        points += [(*point, (first, second)) for point in _meeting_points(first, second)]
    return [
        Candidate(reduced(px), reduced(pw), reduced(objective.subs({x: px, w: pw})), active)
        for px, pw, active in points
        if all(sign_for_lossy_impacts(_at(g, px, pw)) >= 0 for g in constraints if g not in active)
    ]


def greatest(found: Sequence[Candidate]) -> Candidate:
    """The candidate of the greatest value for all 0 < alpha < 1; DerivationError where the order
    depends on alpha.

    >>> greatest(candidates(w - x, [x, 1 - w, w])).value
    1
    """
    if not found:
        raise DerivationError("no candidate satisfies the constraints")
    best = found[0]
    for candidate in found[1:]:
        if sign_for_lossy_impacts(candidate.value - best.value) > 0:
            best = candidate
    return best


def falls_without_bound(objective: Expr) -> bool:
    """Whether the objective tends to minus infinity at infinity in the wedge 0 <= x <= w.

    There it is enough that it decreases in x and is, along x = 0, a quadratic in w with negative
    leading coefficient.

    >>> falls_without_bound(w - x - w**2), falls_without_bound(w - x)
    (True, False)
    """
    along = Poly(objective.xreplace({x: 0}), w)
    slope = Poly(objective, x).nth(1)
    return (
        Poly(objective, x).degree() == 1
        and sign_for_lossy_impacts(slope) < 0
        and along.degree() == 2
        and sign_for_lossy_impacts(along.LC()) < 0
    )


def _refuse_stationary_inside(objective: Expr) -> None:
    slope = lowest_terms(objective.diff(x))
    if slope.has(x, w) or sign_for_lossy_impacts(slope) == 0:
        raise DerivationError(f"may be stationary inside: {objective}")


def _stationary_along(objective: Expr, curve: Expr) -> list[tuple[Expr, Expr]]:
    if not curve.has(x):
        # Along w = constant the objective is strictly monotone in x, so nothing is stationary.
        return []
    height = root_of(curve, x)
    slope = Poly(lowest_terms(objective.xreplace({x: height}).diff(w)), w)
    if slope.degree() < 1:
        if slope.is_zero or sign_for_lossy_impacts(slope.nth(0)) == 0:
            raise DerivationError(f"constant along a boundary curve: {curve}")
        return []
    return [(height.subs(w, speed), speed) for speed in simplest_roots(slope)]


def _meeting_points(first: Expr, second: Expr) -> list[tuple[Expr, Expr]]:
    if not first.has(x):
        first, second = second, first
    if not first.has(x):
        return []  # two lines w = constant
    height = root_of(first, x)
    speeds = simplest_roots(Poly(lowest_terms(second.subs(x, height)), w))
    return [(height.subs(w, speed), speed) for speed in speeds]


def _at(expression: Expr, height: Expr, speed: Expr) -> Expr:
    return expression.subs({x: height, w: speed})


# -------------------------------------------------------------------------------------------------
# Bounds of the energy (section 4.1, appendix A).


class Extremum(NamedTuple):
    """The least upper bound of a function on a set: its value, the state it belongs to, and whether
    it is reached.
    """

    value: Expr
    state: State
    attained: bool


def _supremum_on_b1(
    objective: Expr, closed: list[Expr], opened: list[Expr], bounding: Expr
) -> Extremum:
    """The supremum of the objective over the states of B1 with closed constraints >= 0 and opened
    ones > 0.

    `bounding` falls without bound on B1. It is the objective, or a closed constraint: either way
    candidates suffice.
    """
    if not falls_without_bound(bounding) or bounding not in (objective, *closed):
        raise DerivationError(f"the supremum may lie at infinity: {bounding}")
    opened = [scaled(collision_margin(), r**2), *opened]
    best = greatest(candidates(objective, [x, *closed, *opened]))
    touched = [
        g
        for g in opened
        if g in best.active or sign_for_lossy_impacts(g.subs({x: best.x, w: best.w})) == 0
    ]
    # Raising the height leaves the touched boundary into the set, so the point is a limit of the
    # set.
    if any(sign_for_lossy_impacts(g.diff(x)) <= 0 for g in touched):
        raise DerivationError(f"the candidate may be isolated: {best}")
    return Extremum(best.value * r**2, physical_state(best.x, best.w), not touched)


def physical_state(height: Expr, closing_speed: Expr) -> State:
    """The state (beta, v) of a point (x, w) whose coordinates depend on alpha alone.

    >>> physical_state(1, 2).T
    Matrix([[2*r**2/g, -r]])
    """
    units = (r * period(), r)
    entries = []
    for entry, unit in zip(unscaling(), units, strict=True):
        # Measured in its unit the entry has no symbol but alpha, so that a root in it can be
        # reduced.
        value = lowest_terms(entry / unit).subs({x: height, w: closing_speed})
        entries.append(reduced(value) * unit)
    return ImmutableMatrix(entries)


@cache
def largest_kept_energy() -> Extremum:
    """The greatest energy in B1 where an impact does not lose energy: E_max, at (0, -(1 + alpha) /
    (1 - alpha) r) (34).

    Candidates in the set 0 <= x <= w, energy change >= 0: stationary points along the three curves,
    and their corners.

    >>> from juggleproof.symbolic.algebra import alpha
    >>> found = largest_kept_energy()
    >>> found.value.subs(alpha, 0), found.state.T.subs(alpha, 0), found.attained
    (r**2/2, Matrix([[0, -r]]), True)
    """
    change = normal_energy_change()
    return _supremum_on_b1(normal_energy(), [change], [], bounding=change)


@cache
def E_max() -> Expr:
    """The greatest energy of a state of B1 whose impact does not lose energy: ((1 + alpha) / (1 -
    alpha) r)^2 / 2 (equation 34).

    >>> E_max()
    r**2*(alpha + 1)**2/(2*(alpha - 1)**2)
    """
    return largest_kept_energy().value


@cache
def largest_energy_change() -> Extremum:
    """The greatest energy change on B1: Delta E_max, at (0, alpha r / (alpha - 1)) (equation 37).

    >>> largest_energy_change().state.T, largest_energy_change().attained
    (Matrix([[0, alpha*r/(alpha - 1)]]), True)
    """
    change = normal_energy_change()
    return _supremum_on_b1(change, [], [], bounding=change)


@cache
def delta_E_max() -> Expr:
    """The greatest energy change of an impact: (1 + alpha) / (1 - alpha) r^2 / 2 (equation 37).

    >>> delta_E_max()
    -r**2*(alpha + 1)/(2*(alpha - 1))
    """
    return largest_energy_change().value


@cache
def region_energy() -> Expr:
    """The energy up to which the region R reaches: E_max + Delta E_max = (1 + alpha) / (1 -
    alpha)^2 r^2 (equation 23).

    >>> region_energy()
    r**2*(alpha + 1)/(alpha - 1)**2
    """
    return reduced(lowest_terms((E_max() + delta_E_max()) / r**2)) * r**2


@cache
def least_energy_loss() -> Extremum:
    """The supremum of the energy change on B1 - R: Delta E_sup, at the corner where R = 0 meets
    beta = 0 (A.3, 39).

    The corner belongs to R, so the supremum is not reached.

    >>> from sympy import Rational
    >>> from juggleproof.symbolic.algebra import alpha
    >>> found, eighth = least_energy_loss(), Rational(1, 8)
    >>> found.state.T.subs(alpha, eighth), found.value.subs(alpha, eighth), found.attained
    (Matrix([[0, -12*r/7]]), -513*r**2/896, False)
    """
    change = normal_energy_change()
    outside = normal_energy() - lowest_terms(region_energy() / r**2)
    return _supremum_on_b1(change, [], [outside], bounding=change)


@cache
def delta_E_sup() -> Expr:
    """The supremum of the energy change of an impact outside R (appendix A.3.2).

    >>> delta_E_sup()
    r**2*(-alpha*(alpha + 1)*sqrt(2*alpha + 2)/(alpha - 1) + (alpha + 1)**3/(2*(alpha - 1)))
    """
    return least_energy_loss().value


# -------------------------------------------------------------------------------------------------
# The region R, its corner, the point p, and the times to enter R (sections 4.1 to 4.3).


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
