"""The return maps f1 (a period with an impact) and f2 (without), their powers, and their fixed
points (sections 3.2 to 3.5).
"""

from __future__ import annotations

from functools import cache

from sympy import Expr, ImmutableMatrix, Symbol

from juggleproof.symbolic.algebra import (
    DerivationError,
    K,
    State,
    affine_parts,
    alpha,
    apply,
    beta,
    eigenvalues_of,
    lowest_terms,
    n,
    r,
    root_of,
    solution_of,
    state,
    u,
    unipotent_power,
    v,
    z1,
    z2,
)
from juggleproof.symbolic.mechanics import (
    collide,
    collision_time,
    flight_matrix,
    fly,
    hang_time,
    impact_map,
    launch_state,
    period,
    table_at,
    table_speed_at_collision,
    time_after_collision,
)

# -------------------------------------------------------------------------------------------------
# Return maps over one period of the table (sections 3.2 and 3.3).


def controlled_step(table_speed: Expr, flight_time: Expr) -> State:
    """The ball from one impact to the next: F^u1 o C_u2, u2 the table's speed and u1 the time of
    flight (equation 4).

    >>> from juggleproof.symbolic.algebra import t, u
    >>> controlled_step(u, t)[1]
    alpha*u - alpha*v - g*t + u
    """
    # The height of the table does not enter: position is continuous at an impact.
    return fly(collide(state(beta, v), state(beta, table_speed)), flight_time)


@cache
def ball_after_collision() -> State:
    """The ball just after it has met the table: flight to tau_c, then impact (section 3.2, before
    equation 8).

    >>> from juggleproof.symbolic.algebra import g, r
    >>> ball_after_collision().xreplace({beta: 3, v: 0, r: 2, g: 1}).T
    Matrix([[15/8, 2*alpha + 1/2]])
    """
    start = state(beta, v)
    return collide(fly(start, collision_time()), table_at(collision_time()))


@cache
def folded_impact() -> State:
    """Impact carried back to the start of the period: F^-tau o C o F^tau, which is -alpha (b - r_0)
    + r_0 (8, 9).

    >>> folded_impact().T
    Matrix([[-alpha*beta, alpha*r - alpha*v + r]])
    """
    return fly(ball_after_collision(), -collision_time())


@cache
def f1() -> State:
    """One period with an impact: flight to tau_c, impact, flight for T - tau_c (equation 10).

    >>> f1().T
    Matrix([[(-alpha*beta*g + 2*alpha*r**2 - 2*alpha*r*v)/g, alpha*r - alpha*v - r]])
    """
    return fly(ball_after_collision(), time_after_collision())


@cache
def f2() -> State:
    """One period without an impact: F^T (equation 12).

    >>> f2().T
    Matrix([[(beta*g - 2*r**2 + 2*r*v)/g, -2*r + v]])
    """
    return fly(state(beta, v), period())


@cache
def f1_parts() -> tuple[State, State]:
    """The matrix -alpha A_T and the offset of f1, which is affine (equation 10).

    >>> f1_parts()[0], f1_parts()[1].T
    (Matrix([
    [-alpha, -2*alpha*r/g],
    [     0,       -alpha]]), Matrix([[2*alpha*r**2/g, alpha*r - r]]))
    """
    return affine_parts(f1())


@cache
def f2_parts() -> tuple[State, State]:
    """The matrix A_T and the offset -a_T of f2, which is affine (equation 12).

    >>> f2_parts()[1].T
    Matrix([[-2*r**2/g, -2*r]])
    """
    return affine_parts(f2())


def time_shift(column: State, scale: Expr) -> Expr:
    """The time s with column = scale A_-s r_0; DerivationError if there is none.

    >>> from juggleproof.symbolic.algebra import r
    >>> time_shift(state(-3 * r, r), 1)
    3
    """
    unknown = Symbol("s")
    difference = scale * flight_matrix(-unknown) * launch_state() - column
    found = root_of(difference[0], unknown)
    if lowest_terms(difference[1].xreplace({unknown: found})) != 0:
        raise DerivationError(f"not a multiple of a shifted r_0: {column}")
    return found


@cache
def xi_1() -> Expr:
    """The time xi_1 for which the offset of f1 is (alpha - 1) A_-xi r_0: alpha T / (1 - alpha)
    (equation 10).

    >>> xi_1()
    -2*alpha*r/(alpha*g - g)
    """
    return time_shift(f1_parts()[1], alpha - 1)


def flight_power(periods: Expr = K) -> State:
    """A symbolic number of periods without impact: the power f2^K, by its recurrence (section
    3.5.1).

    >>> flight_power().T
    Matrix([[(-2*K**2*r**2 + 2*K*r*v + beta*g)/g, -2*K*r + v]])
    """
    matrix, offset = f2_parts()
    homogeneous = ImmutableMatrix(matrix.row_join(offset).col_join(ImmutableMatrix([[0, 0, 1]])))
    return state(*(unipotent_power(homogeneous, periods) * ImmutableMatrix([beta, v, 1]))[:2])


def impact_power_matrix(iterations: Expr = n) -> State:
    """The matrix of f1^n: (-alpha)^n A_T^n, A_T^n being A_(n T) (sections 3.3 and 4.3).

    >>> impact_power_matrix() / (-alpha) ** n
    Matrix([
    [1, 2*n*r/g],
    [0,       1]])
    """
    shear = ImmutableMatrix((f1_parts()[0] / -alpha).applyfunc(lowest_terms))
    return (-alpha) ** iterations * unipotent_power(shear, iterations)


@cache
def return_map() -> State:
    """K periods of which only the last has an impact: f1 o f2^(K - 1) (section 3.5.1).

    >>> return_map()[1]
    2*K*alpha*r - alpha*r - alpha*v - r
    """
    return apply(f1(), flight_power(K - 1))


@cache
def return_jacobian() -> State:
    """The Jacobian of the map over K periods of which the last has an impact: -alpha A_T^K, with
    upper right entry -alpha K T (section 3.5.3).

    >>> return_jacobian()
    Matrix([
    [-alpha, -2*K*alpha*r/g],
    [     0,         -alpha]])
    """
    return affine_parts(return_map())[0]


@cache
def return_eigenvalues() -> tuple[Expr, ...]:
    """The eigenvalues of f1 o f2^(K - 1), for every K: -alpha twice (sections 3.3 and 3.5.3).

    >>> return_eigenvalues()
    (-alpha, -alpha)
    """
    return eigenvalues_of(return_jacobian())


# -------------------------------------------------------------------------------------------------
# Fixed points, and when they exist (sections 3.3 and 3.5).


@cache
def fixed_point() -> State:
    """The fixed point e_K of the map over K periods, sampled at the start of its flight: f1 o f2^(K
    - 1) keeps it (section 3.5.1).

    >>> from sympy import Rational
    >>> from juggleproof.symbolic.algebra import g
    >>> fixed_point().xreplace({K: 2, alpha: Rational(1, 2), r: 1, g: 1}).applyfunc(lowest_terms).T
    Matrix([[20/9, 1/3]])
    """
    return state(*solution_of(list(return_map() - state(beta, v)), [beta, v]))


@cache
def impact_fixed_point() -> State:
    """The orbit of e_K where its impact comes: f2^(K - 1)(e_K), the fixed point of f2^(K - 1) o f1
    (section 3.5.1).

    >>> from sympy import Rational
    >>> from juggleproof.symbolic.algebra import g
    >>> values = {K: 2, alpha: Rational(1, 2), r: 1, g: 1}
    >>> impact_fixed_point().xreplace(values).applyfunc(lowest_terms).T
    Matrix([[8/9, -5/3]])
    """
    return apply(flight_power(K - 1), fixed_point())


@cache
def e_1() -> State:
    """The fixed point of f1: (4 alpha r^2 / ((1 + alpha)^2 g), -(1 - alpha) r / (1 + alpha))
    (section 3.3, B.4).

    >>> from sympy import Rational
    >>> from juggleproof.symbolic.algebra import g
    >>> e_1().xreplace({alpha: Rational(1, 3), r: 1, g: 1}).T
    Matrix([[3/4, -1/2]])
    """
    return state(*solution_of(list(f1() - state(beta, v)), [beta, v]))


@cache
def epsilon_1() -> Expr:
    """The time for which e_1 = -(1 - alpha) / (1 + alpha) A_-epsilon r_0: 2 alpha T / (1 - alpha^2)
    (section 3.3).

    >>> epsilon_1()
    -4*alpha*r/(alpha**2*g - g)
    """
    return time_shift(e_1(), -(1 - alpha) / (1 + alpha))


@cache
def collision_time_at_fixed_point() -> Expr:
    """The time of the impact of e_K within its period; below T, as section 3.3 asks for K = 1.

    >>> from sympy import Rational
    >>> from juggleproof.symbolic.algebra import g
    >>> collision_time_at_fixed_point().xreplace({K: 1, alpha: Rational(1, 3), r: 1, g: 1})
    1/2
    """
    return _at(collision_time(), impact_fixed_point())


@cache
def relative_map() -> State:
    """The map f1 in coordinates z = b - e_1: -alpha A_T z (equation 27 and after).

    >>> relative_map().T
    Matrix([[(-alpha*g*z1 - 2*alpha*r*z2)/g, -alpha*z2]])
    """
    return state(*(apply(f1(), e_1() + state(z1, z2)) - e_1()))


@cache
def equilibrium_speed() -> Expr:
    """The speed that an impact only reverses, the table moving at r: (1 + alpha) / (1 - alpha) r
    (equation 33).

    >>> equilibrium_speed()
    (-alpha*r - r)/(alpha - 1)
    """
    kept = Symbol("kept")
    return root_of(impact_map()[1].xreplace({v: -kept, u: r}) - kept, kept)


@cache
def subharmonic_ball_speed() -> Expr:
    """The launch speed of a flight that lasts K periods: K g T / 2 = K r (section 3.5.1, before
    equation 17).

    >>> subharmonic_ball_speed()
    K*r
    """
    return root_of(hang_time() - K * period(), v)


@cache
def subharmonic_table_speed() -> Expr:
    """The table's speed that keeps flights of K periods going: (1 - alpha) / (1 + alpha) K r
    (equation 17).

    >>> subharmonic_table_speed()
    (-K*alpha*r + K*r)/(alpha + 1)
    """
    speed = subharmonic_ball_speed()
    return root_of(impact_map()[1].xreplace({v: -speed}) - speed, u)


@cache
def table_speed_at_fixed_point() -> Expr:
    """The table's speed at the impact of e_K, from the fixed point itself: the same as
    `subharmonic_table_speed`.

    >>> lowest_terms(table_speed_at_fixed_point() - subharmonic_table_speed())
    0
    """
    return _at(table_speed_at_collision(), impact_fixed_point())


@cache
def subharmonic_bound() -> Expr:
    """The real K at which the table's speed must be the greatest it has, r: (1 + alpha) / (1 -
    alpha) (equation 18).

    >>> subharmonic_bound()
    (-alpha - 1)/(alpha - 1)
    """
    return root_of(subharmonic_table_speed() - r, K)


def restitution_threshold(periods: Expr = K) -> Expr:
    """The restitution from which on e_K exists: (K - 1) / (K + 1) (equations 20 and 21).

    >>> restitution_threshold(), restitution_threshold(K + 1), restitution_threshold(2)
    ((K - 1)/(K + 1), K/(K + 2), 1/3)
    """
    return lowest_terms(root_of(subharmonic_bound() - K, alpha).xreplace({K: periods}))


def _at(expression: Expr, where: State) -> Expr:
    return lowest_terms(expression.xreplace({beta: where[0], v: where[1]}))
