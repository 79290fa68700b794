"""Sections 3, 3.1 and 3.2: the table that bounces without loss, and the ball coupled to it up to
the map of a period.
"""

from __future__ import annotations

from dataclasses import replace

from juggleproof.judging.claims import NotFormalised
from juggleproof.proofs.paper.names import (
    B1,
    B2,
    STANDING,
    STRIKES,
    H,
    T,
    after_impact,
    alpha,
    always,
    at,
    b,
    ball_at,
    beta,
    claim,
    collide,
    collision_time,
    derived,
    derived_matrix,
    energy,
    equals,
    f1,
    f2,
    flight,
    g,
    height,
    meet,
    only_at,
    paper_names,
    r,
    r_0,
    speed,
    strikes_at,
    t,
    table_at,
    v,
    value_of,
    vector,
)
from juggleproof.proofs.paper.regions import pieces
from juggleproof.proofs.paper.s0_s2_1_setting import CLOSED_FORM
from juggleproof.proofs.paper.states import is_the_period, strikes_from_region
from juggleproof.reading.evaluation import Environment
from juggleproof.reading.meaning import Printed
from juggleproof.reading.values import ShapeError, StateFunction, Vector, scalar
from juggleproof.statements.language import (
    Formula,
    Statement,
    Term,
    different,
    equal,
    iff,
    real,
    reals,
)

# -------------------------------------------------------------------------------------------------
# Section 3 and 3.1: the table, a point mass that bounces on the ground without loss.

n, since = reals("n since")  # a number of periods, and the time since the last of them began
WITH_INTEGER_N = replace(STANDING, integers=frozenset({"n"}))
IN_PERIOD = (since >= 0) & (since < T)
GROUND = Vector((0, 0))


@claim("s3.0-closed-form", "3", "line 220")
def time_to_collision_is_rational() -> Statement:
    """While their speeds differ, ball and table meet at one time only, and a quotient of
    polynomials gives it.
    """
    return always(iff(meet(t), equal(t, collision_time(b))), given=[different(v, r)])


@claim("s3.0-sine", "3", "line 220", parameters=())
def no_closed_form_for_a_table_that_moves_as_a_sine() -> NotFormalised:
    """Where the table moves as a sine, no closed form gives the time of collision."""
    return NotFormalised(CLOSED_FORM)


@claim("s3.0-velocity-jumps", "3", "line 220")
def table_velocity_jumps_and_so_does_the_map() -> list[Statement]:
    """The table's velocity jumps as it bounces, and so does the image of a state that meets it then
    while they approach.

    However little slower another state is, its image is faster by (1 + alpha) times the closing
    speed at least.
    """
    less = real("less")
    slower = Vector((beta, v - less))
    jump = speed(f1(slower)) - speed(f2(b))
    return [
        always(equal(height(table_at(T)), height(r_0)), label="returns"),
        always(speed(r_0) - speed(table_at(T)) > 0, label="velocity"),
        always(
            B1(slower) & (jump >= (1 + alpha) * (r - v)) & B2(b),
            given=[H(b), meet(T), v < r, less > 0],
            label="map",
        ),
    ]


@claim("s3.1-lossless", "3.1", "line 224")
def lossless_bounce_has_restitution_one() -> list[Statement]:
    """A bounce off the ground at rest keeps the energy exactly if the restitution, not being
    negative, is one; it then launches anew.
    """
    after = vector(collide(GROUND)(-r_0))
    return [
        always(
            iff(equal(energy(after), energy(-r_0)), equal(alpha, 1)),
            in_range=[],
            given=[alpha >= 0],
            label="lossless",
        ),
        always(equals(vector(at(after, {"alpha": 1})), r_0), label="launched"),
    ]


@claim("s3.1-minus-r0", "3.1", "line 224", printed=r"-r_0 = (0, -\dot{\rho}_0)")
def table_comes_down_as_it_went_up(printed: Printed) -> Statement:
    """Whenever the table is back on the ground after its launch, its state is that of the launch
    with the sign changed.
    """
    lands = equal(height(table_at(t)), 0)
    return always(
        equals(table_at(t), vector(printed.right(paper_names()))) & printed.formula(paper_names()),
        given=[t > 0, lands],
    )


@claim(
    "eq-5",
    "3.1",
    "(5)",
    printed=r"r(t) = F^{\tau_p(t)}(r_0)",
    as_it_stands=r"r(t) = F^{\tau_p(t)}(r_o)",
)
def table_state_by_time_in_period(printed: Printed) -> list[Statement]:
    """At every time the table is where free flight from its launch brings it in the time since it
    last touched the ground.

    In the n-th period it flies from a launch at n T; it is off the ground between, and ends the
    period where it can be launched anew.
    """
    flown = table_at(t - n * T)
    here = paper_names().extended({"r(t)": flown, r"\tau_p(t)": since})
    again = at(collide(GROUND)(table_at(T)), {"alpha": 1})
    return [
        always(
            printed.formula(here),
            given=[IN_PERIOD, equal(t, n * T + since)],
            vocabulary=WITH_INTEGER_N,
            label="state",
        ),
        always(
            height(vector(printed.right(here))) > 0,
            given=[IN_PERIOD, since > 0],
            label="off-the-ground",
        ),
        always(equals(again, r_0), label="launched-anew"),
    ]


@claim("s3.1-T", "3.1", "line 228", printed=r"T := 2\dot{\rho}_0/\gamma")
def period_of_the_table(printed: Printed) -> Statement:
    """After its launch the table is on the ground again exactly when T has passed."""
    return is_the_period(printed)


@claim("s3.1-rho0-positive", "3.1", "line 228", printed=r"\rho_0 > 0")
def launch_speed_is_positive(printed: Printed) -> Statement:
    """The parameter that is assumed positive is the one whose sign makes the table fly: the period
    is positive exactly if it is.

    As printed it is the height at launch, which is zero.
    """
    free = replace(STANDING, givens={"g": (g > 0,)})
    rho = real("rho")  # what the print names: the height at launch
    positive = printed.formula(paper_names().extended({r"\rho_0": rho}))
    return always(iff(positive, T > 0), given=[equal(rho, height(r_0))], vocabulary=free)


@claim("s3.1-note3", "3.1", "footnote 3", printed=r"0 \le t < T")
def time_in_period_is_one_function(printed: Printed) -> list[Statement]:
    """Exactly one function of time has the period T and is the identity on this interval: every
    time has one equal in it.
    """

    def inside(time: Term) -> Formula:
        return printed.formula(paper_names().extended({"t": time}))

    other = real("other")
    return [
        always(
            inside(t - n * T),
            given=[n * T <= t, t < (n + 1) * T],
            vocabulary=WITH_INTEGER_N,
            label="one",
        ),
        always(
            equal(since, other),
            given=[inside(since), inside(other), equal(since - other, n * T)],
            vocabulary=WITH_INTEGER_N,
            label="only-one",
        ),
    ]


# -------------------------------------------------------------------------------------------------
# Section 3.2: the ball coupled to the table, the time to collision, and the state after it.
#
# The time to collision stands for an unknown time t, told by what happens then: ball and table are
# at one height. The map of (8) is told by what it is for: its value is the state that, flying
# freely, is the ball's state just after the impact.

d, rho, u = reals("d rho u")
AT_TIME = paper_names().extended({r"\tau_c": only_at(b, t, factor=True)})
TABLE = Vector((rho, u))  # a table in any state as the period begins
FOLDED = Vector(reals("folded folded_dot"))  # the value of the map in (8)


def _folded(table: Vector) -> Environment:
    """The names of (8), the value of its map being unknown, for a table in this state as the period
    begins.
    """

    def family(start: Vector) -> StateFunction[Vector]:
        if start != table:
            raise ShapeError("this map is known for the table of the claim only")
        return only_at(b, FOLDED)

    return AT_TIME.extended({r"\overline C_{\cdot}": family})


def _flies_to_the_impact(table: Vector | None = None) -> Formula:
    """The unknown state, flying freely, is at time t that of the ball just after the impact."""
    after = collide(table_at(t, table))(ball_at(t))
    return equals(ball_at(t, FOLDED), vector(after))


@claim(
    "s3.2-b-bar", "3.2", "line 234", printed=r"\overline{b} = (\overline{\beta}, \overline{\beta})"
)
def sampled_state(printed: Printed) -> Statement:
    """The sampled state is the ball's position and velocity as the table touches the ground."""
    velocity = (height(ball_at(d)) - height(ball_at(-d))) / (
        2 * d
    )  # exact, as the flight is quadratic in time
    sampled = Vector((height(ball_at(0)), velocity))
    return always(
        printed.formula(paper_names().extended({r"\overline b": sampled})), given=[different(d, 0)]
    )


@claim(
    "s3.2-B1-collides",
    "3.2",
    "line 236",
    printed=r"\mathcal{B}_1 \subset \mathcal{H}, \quad \overline{b} \in \mathcal{B}_1",
    as_it_stands=r"\mathcal{B}_1 \subset \mathcal{A}, \quad \overline{b} \in \mathcal{B}_1",
)
def b1_collides_before_the_table_lands(printed: Printed) -> list[Statement]:
    """B1 is a part of H, and from its states the ball hits the table before the table next touches
    the ground.
    """
    subset, member = pieces(printed, 2)
    return [
        always(subset.formula(paper_names()), label="part-of-h"),
        *strikes_from_region(member.formula(paper_names())),
    ]


def _height_above_the_table(printed: Printed) -> list[Statement]:
    """The printed line is the ball's height above the table at time t, and says that they meet."""
    gap = height(ball_at(t)) - height(table_at(t))
    return [
        always(equal(scalar(printed.right(AT_TIME)), gap), label="height"),
        always(iff(printed.formula(AT_TIME), meet(t)), label="meet"),
    ]


@claim(
    "s3.2-collision-a",
    "3.2",
    "line 238",
    printed=r"0 = [F^{\tau_c}(\overline{b})]_1 - [F^{\tau_c}(r_0)]_1",
)
def collision_equation(printed: Printed) -> Statement:
    """Ball and table meet when the difference of their heights in flight is zero, which is a
    definition: they are then at one height.
    """
    return always(iff(printed.formula(AT_TIME), meet(t)))


@claim(
    "s3.2-collision-b",
    "3.2",
    "line 239",
    printed=r"0 = [A_{\tau_c}(\overline{b} - r_0)]_1",
    as_it_stands=r"= [A_{\tau_c}(\overline{b} - r_0)]_1",
)
def collision_equation_without_gravity(printed: Printed) -> list[Statement]:
    """That difference is the first component of the sheared difference of the states, in which
    gravity cancels.
    """
    return _height_above_the_table(printed)


@claim(
    "s3.2-collision-c",
    "3.2",
    "line 240",
    printed=r"0 = \overline{\beta} + \tau_c(\dot{\overline{\beta}} - \dot{\rho}_0)",
    as_it_stands=r"= \overline{\beta} + \tau_c(\dot{\overline{\beta}} - \dot{\rho}_0)",
)
def collision_equation_in_components(printed: Printed) -> list[Statement]:
    """That component is the height of the ball, and the time multiplied by its speed relative to
    the table.
    """
    return _height_above_the_table(printed)


@claim(
    "eq-6",
    "3.2",
    "(6)",
    printed=(
        r"\tau_c(\overline{\beta}, \dot{\overline{\beta}}) := \frac{\overline{\beta}}{\dot{\rho}_0"
        r" - \dot{\overline{\beta}}}"
    ),
    derived=lambda: derived("collision_time"),
)
def time_to_collision(printed: Printed) -> Statement:
    """While the ball's speed differs from the table's launch speed, both are at one height at tau_c
    and at no other time.
    """
    return always(iff(meet(t), printed.formula(AT_TIME)), given=[different(v, r)])


@claim("s3.2-bounds", "3.2", "line 248", printed=r"0 \le \tau_c(\overline{b}) \le T")
def bounds_on_the_time_tell_b1(printed: Printed) -> Statement:
    """Of the states of H in which the bodies approach each other, those with this time to collision
    make up the region B1 of (7).
    """
    return always(iff(printed.formula(paper_names()), STRIKES(b)), given=[H(b), v < r])


@claim(
    "eq-7",
    "3.2",
    "(7)",
    printed=(
        r"\mathcal{B}_1 := \{ \overline{b} \in \mathcal{H} \mid [\frac{1}{2}\gamma, \dot{\rho}_0] "
        r"\begin{bmatrix} \overline{\beta} \\ \dot{\overline{\beta}} \end{bmatrix} <"
        r" \dot{\rho}_0^2 \}"
    ),
    as_it_stands=(
        r"\beta_1 := \{ \overline{\mathbf{b}} \in \mathcal{A} \mid [\frac{1}{2}\gamma,"
        r" \dot{\rho}_0] "
        r"\begin{bmatrix} \overline{\beta} \\ \dot{\overline{\beta}} \end{bmatrix} <"
        r" \dot{\rho}_0^2 \}"
    ),
)
def region_b1(printed: Printed) -> list[Statement]:
    """B1 holds those states of H from which the ball strikes the table before the period ends, and
    no others.
    """
    region = printed.set_predicate(paper_names(), r"\mathcal{B}_1")
    return [
        *strikes_from_region(region(b)),
        always(region(b), given=[H(b), strikes_at(t)], label="only-these"),
    ]


@claim(
    "s3.2-flown-to-collision",
    "3.2",
    "line 255",
    printed=r"C_{F^{\tau_c}(r_0)} \circ F^{\tau_c}(\overline{b})",
    as_it_stands=r"C_F \tau c_{(r_0)} \circ F^{\tau_c}(\overline{b})",
)
def state_just_after_the_collision(printed: Printed) -> Statement:
    """At the collision the ball is where the table is, and leaves it at alpha times the speed at
    which they met.
    """
    after, ball, table = vector(value_of(printed, AT_TIME)), ball_at(t), table_at(t)
    parts = equal(speed(after) - speed(table), -alpha * (speed(ball) - speed(table)))
    return always(equal(height(after), height(table)) & parts, given=[meet(t)])


@claim(
    "s3.2-onward",
    "3.2",
    "line 255",
    printed=r"F^{T} \circ \overline{C}_{r_0}(\overline{b})",
    as_it_stands=r"F^T \circ \overline{C_{r_0}}(\overline{b})",
)
def state_at_the_end_of_the_period(printed: Printed) -> Statement:
    """The state at the period's end is that after the collision, flown onward for the rest of the
    period.
    """
    onward = flight(T - t)(after_impact(t))
    return always(
        equals(vector(value_of(printed, _folded(r_0))), vector(onward)),
        given=[meet(t), _flies_to_the_impact()],
    )


@claim("s3.2-minus-r0-at-T", "3.2", "line 255", printed="-r_0", repeats="s3.1-minus-r0")
def table_lands_as_it_was_launched(printed: Printed) -> Statement:
    """The table's state at time T, as it meets the ground, is that of its launch with the sign
    changed.
    """
    return always(
        equals(table_at(T), vector(value_of(printed, paper_names())))
        & equal(height(table_at(T)), 0)
    )


@claim(
    "eq-8",
    "3.2",
    "(8)",
    printed=(
        r"\overline{C}_r(\overline{b}) := F^{-\tau_c(\overline{b})} \circ"
        r" C_{F^{\tau_c(\overline{b})}(r)} \circ "
        r"F^{\tau_c(\overline{b})}(\overline{b})"
    ),
    as_it_stands=(
        r"\overline{C}_{r}(\overline{b}) := F^{-\tau_c(\overline{b})} \circ"
        r" C_{F^{\tau}(\overline{b})(r)} \circ "
        r"F^{\tau_c(\overline{b})}(\overline{b})"
    ),
)
def folded_collision(printed: Printed) -> Statement:
    """The map's value is the state that, flying freely from the period's beginning, is the ball's
    just after the impact.
    """
    names = _folded(TABLE).extended({"r": TABLE})
    return always(iff(_flies_to_the_impact(TABLE), printed.formula(names)))


@claim(
    "s3.2-cbar-expanded",
    "3.2",
    "line 269",
    printed=r"\overline{C}_r(\overline{b}) = A_{-\tau_c} R A_{\tau_c} (\overline{b} - r_0) + r_0",
    as_it_stands=(
        r"\overline{C}_r(\overline{b}) = A_{[-\tau_c]} R A_{\tau_c} (\overline{b} - r_0) + r_0"
    ),
)
def folded_collision_is_affine(printed: Printed) -> Statement:
    """For the table launched in the state r_0, which is meant by r, that map is affine; R is the
    matrix of (3).
    """
    names = AT_TIME.extended(
        {r"\overline C_r": only_at(b, FOLDED), "R": derived_matrix("restitution_matrix")}
    )
    return always(iff(_flies_to_the_impact(), printed.formula(names)))


@claim(
    "s3.2-difference-at-impact",
    "3.2",
    "line 273",
    printed=(
        r"A_{\tau_c}(\overline{b} - r_0) = \begin{bmatrix} 0 \\ \dot{\overline{\beta}} -"
        r" \dot{\rho}_0 \end{bmatrix}"
    ),
    as_it_stands=(
        r"A_{\tau_c}(\overline{b}-r_0)=\left[egin{array}{c}0\ rac{\dot{ar{eta}}"
        r"-\dot{ho}_0\end{array}ight]"
    ),
)
def difference_at_the_impact(printed: Printed) -> Statement:
    """At the time when they meet, and only then, the sheared difference of the states is one of
    speeds alone.
    """
    return always(iff(printed.formula(AT_TIME), meet(t)))


@claim(
    "s3.2-alpha-beta",
    "3.2",
    "line 279",
    printed=r"\alpha\overline{\beta} = -\alpha\tau_c(\dot{\overline{\beta}} - \dot{\rho}_0)",
)
def height_by_time_to_collision(printed: Printed) -> Statement:
    """At the time when they meet, and only then, the height is the time multiplied by the speed of
    approach, both times alpha.
    """
    return always(iff(printed.formula(AT_TIME), meet(t)))


@claim(
    "eq-9",
    "3.2",
    "(9)",
    printed=r"\overline{C}_{r_0}(\overline{b}) = -\alpha(\overline{b} - r_0) + r_0",
)
def folded_collision_scales_the_difference(printed: Printed) -> Statement:
    """For a ball that meets the table, that map multiplies the difference of their states by
    -alpha.
    """
    return always(iff(_flies_to_the_impact(), printed.formula(_folded(r_0))), given=[meet(t)])


@claim(
    "s3.2-after-9",
    "3.2",
    "line 287",
    printed=r"F^T \circ \overline{C}_{r_0}(\overline{b}) = -\alpha A_T(\overline{b} - r_0) - r_0",
)
def state_at_the_end_is_affine(printed: Printed) -> Statement:
    """So the state at the end of a period with a collision is an affine function of that at its
    beginning.
    """
    return always(printed.formula(_folded(r_0)), given=[meet(t), _flies_to_the_impact()])
