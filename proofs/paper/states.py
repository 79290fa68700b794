"""Terms and regions that several sections speak of: impacts and their energy, orbits from bounce to
bounce, motion relative to e_1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from juggleproof.judging import forms
from juggleproof.judging.claims import Remark
from juggleproof.proofs.paper.names import (
    B1,
    B1_PLUS,
    B1_ZERO,
    B2,
    POINTS,
    STRIKES,
    WITH_INTEGER_K,
    H,
    K,
    R,
    T,
    alpha,
    always,
    b,
    ball_at,
    band,
    boundary_of_band,
    c,
    collide,
    collision_time,
    derived,
    derived_vector,
    e_1,
    energy,
    eps,
    equals,
    exists_some,
    f1,
    f2,
    flight,
    flight_matrix,
    from_e_1,
    function,
    g,
    height,
    impact_energy_change,
    is_narrow,
    kinetic_energy,
    leaves_R_at,
    meanings,
    meet,
    of_z,
    only_at,
    paper_names,
    r,
    r_0,
    speed,
    strikes_at,
    t,
    table_at,
    v,
    vector,
)
from juggleproof.reading.evaluation import Environment
from juggleproof.reading.meaning import Meaning, Printed
from juggleproof.reading.values import Matrix, StateFunction, Value, Vector
from juggleproof.statements.language import (
    ClaimError,
    Formula,
    Number,
    Statement,
    Term,
    conjunction,
    different,
    equal,
    iff,
    real,
    reals,
    term,
)

# -------------------------------------------------------------------------------------------------
# Impacts that gain, keep or lose energy, the greatest energies that go with them, and how the
# energy change varies (4.1, A.1 to A.3).

# The states of B1 whose impact gains or keeps energy.
NOT_LOSING = B1_PLUS | B1_ZERO
E_max, dE_max = reals("E_max dE_max")
# The meanings of prints in which both greatest energies are unknowns, said by what they are.
UNKNOWN = paper_names().extended({r"E_{max}": E_max, r"\Delta E_{max}": dE_max})
# What the unknowns are: Delta E_max of (23) and (37); and E_max of (34) as well.
GREATEST_GAIN = equal(dE_max, derived("delta_E_max"))
BOTH_BOUNDS = [equal(E_max, derived("E_max")), GREATEST_GAIN]


def keeps_energy(state: Vector) -> Formula:
    """The impact that comes within the period leaves the energy as it was."""
    return equal(energy(f1(state)), energy(state))


def place(extremum: str) -> dict[str, Term]:
    """The state at which a derived extremum is attained."""
    return dict(zip(("beta", "v"), map(term, derived_vector(extremum).entries)))


# The slopes of a quadratic function: for such a function the quotient of central differences is the
# derivative, whatever h is.
h = real("h")
SLOPES = reals("dE_dbeta dE_dv dR_dbeta dR_dv")
dE_dbeta, dE_dv, dR_dbeta, dR_dv = SLOPES


def with_slopes(environment: Environment, state: Vector = b) -> Environment:
    """The environment in which the derivatives at this state are the names of the slopes."""
    return environment.extended(
        {
            r"\frac{\partial \Delta_1 E}{\partial \overline\beta}": only_at(state, dE_dbeta),
            r"\frac{\partial \Delta_1 E}{\partial \dot{\overline\beta}}": only_at(state, dE_dv),
            r"D_{\overline\beta} \Delta_1 E": only_at(state, dE_dbeta),
            r"D_{\dot{\overline\beta}} \Delta_1 E": only_at(state, dE_dv),
            r"D_{\overline\beta} R": only_at(state, dR_dbeta),
            r"D_{\dot{\overline\beta}} R": only_at(state, dR_dv),
        }
    )


# The meanings of prints in which the derivatives of Delta_1 E and R are unknowns as well.
STEEP = with_slopes(UNKNOWN)


def are_slopes(*slopes: Term, state: Vector = b) -> Formula:
    """Each of these names is the slope of its function at the state: by central differences of any
    width h.
    """
    differences = [different(h, 0)]
    for slope in slopes:
        of = impact_energy_change if slope in (dE_dbeta, dE_dv) else function("region_margin")
        step = Vector((h, 0)) if slope in (dE_dbeta, dR_dbeta) else Vector((0, h))
        differences.append(equal(term(of(state + step)) - of(state - step), 2 * h * slope))
    return conjunction(differences)


# -------------------------------------------------------------------------------------------------
# From bounce to bounce: the state after a period with an impact, after periods without, and states
# that come back.
#
# A state that comes back is told by that property: no fixed point that was solved for enters here.

WITH_INTEGERS = replace(WITH_INTEGER_K, integers=frozenset({"K", "n", "k"}))
b_0 = Vector(reals("beta0 v0"))  # another state
image = Vector(reals("beta1 v1"))  # what becomes of the state b within a period
always_integer = partial(forms.always, vocabulary=WITH_INTEGERS)  # for all integers K >= 1, n and k
exists_integer = partial(forms.exists_some, vocabulary=WITH_INTEGERS)


def strikes_from(start: Vector, time: Term) -> Formula:
    """The ball, in this state when the table is launched, strikes the table at this time of the
    period.
    """
    ball, table = ball_at(time, start), table_at(time)
    return conjunction(
        [time >= 0, time < T, equal(height(ball), height(table)), speed(ball) < speed(table)]
    )


def struck(start: Vector, time: Number) -> Vector:
    """The ball's state just after an impact at this time."""
    return vector(collide(table_at(time))(ball_at(time, start)))


def next_bounce(start: Vector, time: Term) -> Vector:
    """The ball's state when the table bounces next, after an impact at this time."""
    return ball_at(T - time, struck(start, time))


def flights(count: Number) -> StateFunction[Vector]:
    """So many periods of flight, without an impact."""
    return flight(term(count) * T)


def cycle(count: Number, start: Vector = b) -> Vector:
    """The state after this number of periods; the first has an impact."""
    return vector(flights(term(count) - 1)(f1(start)))


def composite(count: Number, state: Vector) -> Vector:
    """The state after `count` periods: all but one of flight, then one with an impact."""
    return vector(f1(vector(flights(term(count) - 1)(state))))


def power_of_flight(time: Term, count: Number) -> Matrix:
    """A_t to the power n, which is A of n t by the statement `powers`."""
    return flight_matrix(term(count) * time)


def comes_back(count: Number, start: Vector = b) -> Formula:
    """After this number of periods, the first with an impact, the state is what it was."""
    return equals(cycle(count, start), start)


def within(size: Term, *offsets: Term) -> Formula:
    """Every one of the offsets is smaller in absolute value than the size."""
    return conjunction([part for offset in offsets for part in (-size < offset, offset < size)])


def function_of(printed: Printed, environment: Environment) -> StateFunction[Value]:
    """The function of a state that a print names, and says nothing else about."""
    value = Meaning(environment).of(printed.tree)
    if not isinstance(value, StateFunction):
        raise ClaimError("a function of a state is expected here")
    return value


def relations_of(
    printed: Printed, environment: Environment, count: int
) -> list[tuple[Value, str, Value]]:
    """The relations of a print that has to have this many, each with the values on its two
    sides.
    """
    chain = printed.relation_chain(environment)
    if len(chain) != count:
        raise ClaimError(f"this print has {len(chain)} relations, where {count} are expected")
    return chain


def from_threshold_on(count: Number = K) -> tuple[Formula, ...]:
    """0 < alpha < 1, and (count - 1)/(count + 1) <= alpha."""
    return alpha > 0, alpha < 1, alpha * (term(count) + 1) >= term(count) - 1


def eigenvalue_of(matrix: Matrix, real_part: Term, imaginary_part: Term) -> Formula:
    """The complex number is an eigenvalue of the 2 by 2 matrix: real and imaginary part of det(z -
    M) vanish.
    """
    (a, _), (_, d) = ((term(entry) for entry in row) for row in matrix.rows)
    shifted = Matrix(
        tuple(
            tuple((real_part if i == j else 0) - term(entry) for j, entry in enumerate(row))
            for i, row in enumerate(matrix.rows)
        )
    )
    return conjunction(
        [
            equal(term(shifted.determinant()) - imaginary_part**2, 0),
            equal(imaginary_part * (2 * real_part - a - d), 0),
        ]
    )


def next_state_is(state: Vector, holds: Callable[[Vector], Formula]) -> Formula:
    """The state one period later is such: with an impact or without."""
    return (B1(state) & holds(f1(state))) | (B2(state) & holds(f2(state)))


def offset_with(time: Term) -> Vector:
    """r_0 flown back for this time, shrunk by 1 - alpha and turned round: the offset of f1 for the
    time xi_1.
    """
    return vector(flight_matrix(-time) * r_0).scaled(alpha - 1)


def is_fixed_point(printed: Printed) -> Statement:
    """A state is its own image exactly if it is what is printed for e_1."""
    return always(iff(equals(f1(b), b), printed.formula(paper_names().extended({"e_1": b}))))


def is_the_map(printed: Printed) -> list[Statement]:
    """What is printed for f holds of a state and of what becomes of the ball within a period, and
    of nothing else.
    """
    stated = printed.formula(paper_names().extended({r"\overline f": image}))
    return [
        always(
            iff(equals(image, next_bounce(b, t)), stated),
            given=[H(b), strikes_from(b, t)],
            label="with-impact",
        ),
        always(iff(equals(image, ball_at(T)), stated), given=[B2(b)], label="without-impact"),
    ]


# -------------------------------------------------------------------------------------------------
# Motion relative to e_1: the coordinates z = b - e_1, the kinetic energy K in them, and the states
# where it is small.
#
# K is a function here, the kinetic energy of section 4.3, and not the integer K of section 3.5.

z1, z2, d, change = reals("z1 z2 d change")
z = Vector((z1, z2))
next_image = Vector(
    reals("beta_next v_next")
)  # a state that follows b, for whichever branch of f applies
STABILITY = (
    "theorem-in-units/exactly",
)  # e_1 is stable and attracts every state of H <=> alpha < 1/3
RANGE_21 = (
    alpha > 0,
    alpha < derived("restitution_threshold", 2),
)  # (21): e_1 is the only fixed point


kinetic_energy_change = of_z(derived("relative_kinetic_energy_change"))
relative_step = of_z(derived_vector("relative_map"))


# The band of size eps is narrow.
NEAR = is_narrow(eps)


def narrow_band_exists() -> Statement:
    """R leaves B1 at a velocity above that of e_1, so that some band around e_1 is narrow."""
    return always(
        speed(e_1) < c, given=[leaves_R_at(c)], in_range=RANGE_21, label="there-is-a-narrow-one"
    )


def narrow_band_stays(size: Term) -> tuple[Statement, ...]:
    """There are narrow bands, and f1 maps each into itself: its images are in B1, in R, and in the
    band.
    """
    after = f1(b)
    return (
        narrow_band_exists(),
        always(
            B1(after),
            given=[*is_narrow(size), B1(b), from_e_1(b) <= size],
            in_range=RANGE_21,
            label="stays-in-B1",
        ),
        always(R(after), given=[B1(b), R(b)], in_range=RANGE_21, label="stays-in-R"),
        always(
            from_e_1(after) <= size,
            given=[eps > 0, from_e_1(b) <= size],
            in_range=RANGE_21,
            label="stays-in-the-band",
        ),
    )


FALLS_FROM_IMPACT_TO_IMPACT = Remark(
    "What falls is this kinetic energy as sampled at impacts: from one to the next by the square"
    " of kappa = alpha (1 + 3 alpha)/(1 - alpha) at least, which is below 1 just for alpha < 1/3.",
    by=("theorem-kinetic",),
)


def lies_around_e_1(size: Term) -> Statement:
    """The band, however narrow, holds all states of H near e_1: an orbit that tends to e_1 comes
    into it.
    """
    height_off, speed_off = (term(entry) for entry in b - e_1)
    close = [-d <= speed_off, speed_off <= d, d <= r / 16, d**2 <= 2 * size]
    low = height_off * g <= r**2 / 8
    return always(
        band(size)(b),
        given=[height(b) >= 0, low, *close],
        in_range=RANGE_21,
        label="lies-around-e_1",
    )


# The meanings of prints about z = b - e_1; about the step from z_k to z_{k+1}; and about the band
# around e_1, the next state being an unknown.
AT_Z = Environment(
    {**meanings(), r"K": kinetic_energy, r"z": z, r"b": b, r"u_2'": Matrix(((0, 1),))}, state=r"z"
)
STEP = Environment(
    {
        **meanings(),
        r"K": kinetic_energy,
        r"f": relative_step,
        r"z_k": z,
        r"z_{k+1}": relative_step(z),
        r"b_k": z + e_1,
        r"b_{k+1}": f1(z + e_1),
        r"u_2'": Matrix(((0, 1),)),
        r"\xi": derived("xi_1"),
    },
    state=r"z_k",
)
AROUND_E1 = Environment(
    {
        **meanings(),
        r"K": kinetic_energy,
        r"B_1": B1,
        r"R": R,
        r"\mathcal{K}": band(eps),
        r"\partial\mathcal{K}": boundary_of_band(eps),
        r"\overline f": only_at(b, next_image),
    },
    points=POINTS,
    state=r"\overline b",
)


# -------------------------------------------------------------------------------------------------
# What the paper says in several places, in one formal reading: what B1 and B2 are, the line between
# them, and the table's period.

since_launch = real("time")  # a name that no print has
LANDS = equal(height(table_at(since_launch)), 0)
IN_PERIOD = (t >= 0) & (t < T)


def strikes_from_region(inside: Formula) -> tuple[Statement, Statement]:
    """From a state inside, ball and table approach each other; and as they do, they meet at some
    time within the period.
    """
    return (
        always(v < r, given=[inside], label="approach"),
        exists_some(["t"], strikes_at(t), given=[inside, v < r], label="strikes"),
    )


def b1_is_where_the_ball_strikes() -> list[Statement]:
    """From the states of B1, and no others in H, the ball meets the table, approaching it, within a
    period.
    """
    return [
        *strikes_from_region(B1(b)),
        always(B1(b), given=[H(b), strikes_at(t)], label="only-these"),
    ]


def b2_is_where_it_does_not() -> Statement:
    """From no state of B2 does the ball meet the table, approaching it, within a period."""
    return always(~(meet(t) & (v < r)), given=[B2(b), IN_PERIOD])


def line_of_equal_times(times_are_equal: Formula) -> Statement:
    """The times are equal where ball and table meet as the period ends."""
    return always(iff(times_are_equal, meet(T)), given=[H(b), different(v, r)])


CORNER_WITHOUT_A_TIME = Remark(
    "The line has one state without a time to collision: on the ground, and as fast as the table.",
    lambda: always(
        iff(equal(v, r), equal(term(b.component(1)), 0)), given=[H(b), meet(T)], label="no-time"
    ),
)


def tells_b1(early: Formula) -> Statement:
    """In H, where the time to collision is defined, this says that the state is in the region B1 of
    (7).
    """
    return always(iff(early, STRIKES(b)), given=[H(b), different(v, r)])


def tells_b2(late: Formula) -> Statement:
    """In H, where the time to collision is defined, this says that the state is not in the region
    B1 of (7).
    """
    return always(iff(late, ~STRIKES(b)), given=[H(b), different(v, r)])


def is_the_period(printed: Printed) -> Statement:
    """After its launch the table is on the ground again exactly at the time that is printed for
    T.
    """
    names = paper_names().extended({"T": since_launch})
    return always(iff(LANDS, printed.formula(names)), given=[since_launch > 0])


def b1_by_time_while_closing() -> list[Statement]:
    """Of the states of H, those with v < r and a time to collision below one period are B1, and no
    others are.
    """
    early = term(collision_time(b)) < T
    return [
        always(iff(B1(b), early), given=[H(b), v < r], label="closing"),
        always(~B1(b), given=[H(b), v >= r], label="not-closing"),
    ]


def b2_by_time_while_closing() -> list[Statement]:
    """Of the states of H, those with v >= r, and those with v < r and a time to collision of one
    period at least, are B2.
    """
    late = term(collision_time(b)) >= T
    return [
        always(iff(B2(b), late), given=[H(b), v < r], label="closing"),
        always(B2(b), given=[H(b), v >= r], label="not-closing"),
    ]


# True assertions near the printed ones about B1 and B2, with their text.
NEAR_B1 = (r"\tau_c < T \text{ and } \dot{\overline\beta} < \dot\rho_0", b1_by_time_while_closing)
NEAR_B2 = (
    r"T \le \tau_c \text{ or } \dot{\overline\beta} \ge \dot\rho_0",
    b2_by_time_while_closing,
)
