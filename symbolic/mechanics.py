"""Ball and table: free flight, the impact of a light body on a heavy one, the bouncing table, and
when ball and table meet (sections 2.2, 3.1 and 3.2, appendix B).
"""

from __future__ import annotations

from functools import cache

from sympy import Expr, ImmutableMatrix, S, Symbol

from juggleproof.symbolic.algebra import (
    State,
    affine_parts,
    alpha,
    beta,
    g,
    integral_from_zero,
    lowest_terms,
    r,
    rho,
    root_of,
    solution_of,
    state,
    t,
    u,
    v,
)

# -------------------------------------------------------------------------------------------------
# Free flight: Newton's equation with constant gravity, integrated twice (section 2.2.2).


@cache
def acceleration() -> Expr:
    """Newton's equation of free flight: the acceleration is -g (section 2.2.2, before equation 1).

    >>> acceleration()
    -g
    """
    return -g


@cache
def flight_map() -> State:
    """The flight map F^t: two integrations of the acceleration from the state (beta, v) (equation
    1).

    >>> flight_map().T
    Matrix([[beta - g*t**2/2 + t*v, -g*t + v]])
    """
    speed = v + integral_from_zero(acceleration(), t)
    return state(beta + integral_from_zero(speed, t), speed)


def fly(start: State, duration: Expr) -> State:
    """The state after free flight from start for the duration: F^duration(start) (equation 1).

    >>> from juggleproof.symbolic.algebra import r
    >>> fly(state(0, r), 2 * r / g).T
    Matrix([[0, -r]])
    """
    # At once, since a duration such as the time of collision may itself contain beta and v.
    return state(*flight_map().xreplace({t: duration, beta: start[0], v: start[1]}))


def flight_matrix(duration: Expr = t) -> State:
    """The matrix A_t of F^t(b) = A_t b - a_t (equation 1).

    >>> flight_matrix()
    Matrix([
    [1, t],
    [0, 1]])
    """
    return affine_parts(flight_map())[0].xreplace({t: duration})


def flight_offset(duration: Expr = t) -> State:
    """The column a_t of F^t(b) = A_t b - a_t (equation 1).

    >>> flight_offset().T
    Matrix([[g*t**2/2, g*t]])
    """
    return -affine_parts(flight_map())[1].xreplace({t: duration})


@cache
def hang_time() -> Expr:
    """How long a body launched upwards at speed v takes to return to its height: t_f = 2 v / g
    (section 3.5.1).

    >>> hang_time()
    2*v/g
    """
    # The return is the nonzero root, so the root 0 (the launch itself) is divided out.
    return root_of((flight_map()[0] - beta) / t, t)


# -------------------------------------------------------------------------------------------------
# Impact of a light body on a heavy one: momentum balance and restitution (section 2.2.2).

mass_ratio = Symbol("m")  # mass of the ball over mass of the table


@cache
def speeds_after_impact() -> tuple[Expr, Expr]:
    """Speeds of ball and table after an impact of a ball of mass m on a table of mass 1.

    The momentum m v + u is kept, and the bodies part at alpha times the speed at which they met
    (equation 2).

    >>> # Equal masses swap speeds.
    >>> [speed.xreplace({mass_ratio: 1, alpha: 1}) for speed in speeds_after_impact()]
    [u, v]
    """
    ball, table = Symbol("ball"), Symbol("table")
    momentum = (mass_ratio * ball + table) - (mass_ratio * v + u)
    restitution = (ball - table) + alpha * (v - u)
    after_ball, after_table = solution_of([momentum, restitution], [ball, table])
    return after_ball, after_table


@cache
def impact_map() -> State:
    """The ball's state (beta, v) after it meets a much heavier table of state (rho, u): C_y(x)
    (equation 3).

    Position is continuous; the speed is that of `speeds_after_impact` at mass ratio 0.

    >>> impact_map().T
    Matrix([[beta, alpha*u - alpha*v + u]])
    """
    return state(beta, speeds_after_impact()[0].xreplace({mass_ratio: 0}))


@cache
def table_after_impact() -> State:
    """The table's state after the impact, at mass ratio 0: unchanged (section 2.2.2, before
    equation 3).

    >>> table_after_impact().T
    Matrix([[rho, u]])
    """
    return state(rho, speeds_after_impact()[1].xreplace({mass_ratio: 0}))


def collide(ball: State, table: State) -> State:
    """The ball's state after it meets the table: C_table(ball) (equation 3).

    >>> collide(state(0, -1), state(0, 2)).T
    Matrix([[0, 3*alpha + 2]])
    """
    return state(*impact_map().xreplace({beta: ball[0], v: ball[1], rho: table[0], u: table[1]}))


@cache
def restitution_matrix() -> State:
    """The matrix R_alpha of C_y(x) = R_alpha x + (1 - R_alpha) y, the part that acts on the ball
    (equation 3).

    >>> restitution_matrix()
    Matrix([
    [1,      0],
    [0, -alpha]])
    """
    return ImmutableMatrix(impact_map().jacobian([beta, v]))


# -------------------------------------------------------------------------------------------------
# The table: a point mass bouncing on the ground without loss (section 3.1).


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


# -------------------------------------------------------------------------------------------------
# When and how ball and table meet (section 3.2, appendices B.1 and B.2).


@cache
def gap() -> Expr:
    """The height of the ball above the table at time t, if they do not meet before: beta + t (v -
    r) (section 3.2).

    >>> gap()
    beta - r*t + t*v
    """
    return lowest_terms(flight_map()[0] - table_at()[0])


@cache
def collision_time() -> Expr:
    """The time tau_c at which ball and table are at the same height: beta / (r - v) (equation 6).

    >>> collision_time()
    beta/(r - v)
    """
    return root_of(gap(), t)


@cache
def time_after_collision() -> Expr:
    """The time T - tau_c from the collision to the next launch of the table (table II).

    >>> time_after_collision()
    (-beta*g + 2*r**2 - 2*r*v)/(g*r - g*v)
    """
    return lowest_terms(period() - collision_time())


@cache
def relative_state_at_collision() -> State:
    """Ball less table at the collision: A_tau (b - r_0) = (0, v - r) (section 3.2, before equation
    9).

    >>> relative_state_at_collision().T
    Matrix([[0, -r + v]])
    """
    return state(*(flight_matrix(collision_time()) * (state(beta, v) - launch_state())))


@cache
def ball_speed_at_collision() -> Expr:
    """The ball's speed just before the collision: v - g tau_c (section 3.4.2).

    >>> ball_speed_at_collision().xreplace({beta: 3, v: 0, r: 2, g: 4})
    -6
    """
    return lowest_terms(flight_map()[1].xreplace({t: collision_time()}))


@cache
def table_speed_at_collision() -> Expr:
    """The table's speed at the collision: r - g tau_c (section 3.4.2).

    >>> table_speed_at_collision().xreplace({beta: 3, v: 0, r: 2, g: 4})
    -4
    """
    return lowest_terms(table_at(collision_time())[1])


@cache
def collision_margin() -> Expr:
    """Positive where the collision comes before the period ends: r^2 - (g beta / 2 + r v)
    (inequality 7).

    It is (T - tau_c) (r - v) g / 2: of the sign of T - tau_c where the bodies approach (v < r) and
    g > 0.

    >>> collision_margin()
    -beta*g/2 + r**2 - r*v
    """
    return lowest_terms(time_after_collision() * (r - v) * g / 2)


@cache
def boundary_speed() -> Expr:
    """The speed on the line tau_c = T between B1 and B2, as a function of height: r - beta / T
    (equation 29).

    >>> boundary_speed()
    (-beta*g + 2*r**2)/(2*r)
    """
    return root_of(collision_margin(), v)


@cache
def boundary_height() -> Expr:
    """The height on the line tau_c = T between B1 and B2, as a function of speed: T (r - v)
    (equation 29).

    >>> boundary_height()
    (2*r**2 - 2*r*v)/g
    """
    return root_of(collision_margin(), beta)
