"""Section 3.2: the ball coupled to the table, the time to collision, and the state after it.

The time to collision stands for an unknown time t, told by what happens then: ball and table are at
one height.  The map of (8) is told by what it is for: its value is the state that, flying freely,
is the ball's state just after the impact.
"""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import Formula, different, equal, iff, reals
from proofs.claims import claim
from proofs.paper.events import (
    after_impact,
    ball_at,
    height,
    meet,
    only_at,
    speed,
    strikes_at,
    table_at,
    value_of,
    vector,
)
from proofs.paper.outside import pieces
from proofs.paper.said_again import strikes_from
from proofs.paper.vocabulary import (
    PAPER,
    STRIKES,
    H,
    T,
    alpha,
    always,
    b,
    collide,
    derived,
    equals,
    flight,
    r,
    r_0,
    t,
    v,
)
from proofs.reading.environment import Environment
from proofs.reading.notions import StateFunction
from proofs.reading.printed import Printed
from proofs.reading.values import ShapeError, Vector

d, rho, u = reals("d rho u")
AT_TIME = PAPER.extended({r"\tau_c": only_at(b, t, factor=True)})
TABLE = Vector((rho, u))  # a table in any state as the period begins
FOLDED = Vector(reals("folded folded_dot"))  # the value of the map in (8)


def _folded(table: Vector) -> Environment:
    """The names of (8), the value of its map being unknown, for a table in this state as the period
    begins.
    """

    def family(start: Vector) -> StateFunction:
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
        printed.formula(PAPER.extended({r"\overline b": sampled})), given=[different(d, 0)]
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
        always(subset.formula(PAPER), label="part-of-h"),
        *strikes_from(member.formula(PAPER)),
    ]


def _height_above_the_table(printed: Printed) -> list[Statement]:
    """The printed line is the ball's height above the table at time t, and says that they meet."""
    gap = height(ball_at(t)) - height(table_at(t))
    return [
        always(equal(printed.right(AT_TIME), gap), label="height"),
        always(iff(printed.formula(AT_TIME), meet(t)), label="meet"),
    ]


@claim(
    "s3.2-collision-a",
    "3.2",
    "line 238",
    printed=r"0 = [F^{\tau_c}(\overline{b})]_1 - [F^{\tau_c}(r_0)]_1",
)
def collision_equation(printed: Printed) -> list[Statement]:
    """Ball and table meet when the difference of their heights in flight is zero."""
    return _height_above_the_table(printed)


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
    return always(iff(printed.formula(PAPER), STRIKES(b)), given=[H(b), v < r])


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
    region = printed.set_predicate(PAPER, r"\mathcal{B}_1")
    return [
        *strikes_from(region(b)),
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
        equals(table_at(T), vector(value_of(printed, PAPER))) & equal(height(table_at(T)), 0)
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
        {r"\overline C_r": only_at(b, FOLDED), "R": derived("restitution_matrix")}
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
