"""Appendices B.3 to B.6: the maps, the fixed point, the zero energy change boundary and the
boundary of R, summed up.
"""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import different, equal, iff, reals, term
from proofs.claims import Assertion, Readings, claim
from proofs.paper.events import ball_at, height, only_at, table_at
from proofs.paper.orbits import (
    b_0,
    is_fixed_point,
    is_the_map,
    next_bounce,
    offset_with,
    strikes_from,
)
from proofs.paper.outside import pieces
from proofs.paper.vocabulary import (
    B1_ZERO,
    B2,
    PAPER,
    R,
    T,
    always,
    b,
    derived,
    equals,
    exists_some,
    f1,
    flight_matrix,
    flight_offset,
    r,
    same_set,
    t,
    v,
)
from proofs.reading.notions import StateFunction
from proofs.reading.printed import Printed
from proofs.reading.values import Vector

u, y, lift, tau, greatest, gain, margin = reals("u y lift tau greatest gain margin")


@claim(
    "sB.3-f1",
    "B.3",
    "lines 772 to 778",
    repeats="eq-10",
    printed=(
        r"""\overline{f}_1(\overline{b}_k) := \alpha A_T \overline{b}_k"""
        r""" + (\alpha - 1) A_{-\xi_1} r_0 = \overline{b}_{k+1} \\
       A_t := \begin{bmatrix} 1 & t \\ 0 & 1 \end{bmatrix} \\ \xi_1 := \frac{\alpha T}{1-\alpha}."""
    ),
)
def map_on_b1_again(printed: Printed) -> list[Statement]:
    """After an impact the state when the table bounces next is this affine image, with these
    meanings of A_t and xi_1.
    """
    map_, matrix, time = pieces(printed, 3)
    names = {r"\overline b_k": b_0, r"\overline b_{k+1}": next_bounce(b_0, tau)}
    return [
        always(map_.formula(PAPER.extended(names)), given=[strikes_from(b_0, tau)], label="map"),
        always(matrix.formula(PAPER), label="matrix"),
        always(
            iff(
                equals(offset_with(u), f1(Vector((0, 0)))),
                time.formula(PAPER.extended({r"\xi_1": u})),
            ),
            label="time",
        ),
    ]


@claim(
    "sB.3-f2",
    "B.3",
    "line 783",
    repeats="eq-12",
    printed=r"\overline{f}_1(\overline{b}_k) := -A_T x - \alpha_T",
)
def map_on_b2_again(printed: Printed) -> Statement:
    """The dynamics on B2, here under the name of those on B1, take a state x to this affine image
    at the next bounce.
    """
    flown = StateFunction(lambda state: ball_at(t, state))
    names = {
        r"\overline f_1": flown,
        r"\overline b_k": b_0,
        "x": b_0,
        r"\alpha_T": flight_offset(T),
    }
    return always(
        printed.formula(PAPER.extended(names)),
        given=[B2(b_0), t > 0, equal(height(table_at(t)), 0)],
    )


@claim(
    "sB.3-aT",
    "B.3",
    "line 785",
    repeats="eq-1",
    printed=r"\alpha_T := \gamma T \begin{bmatrix} T/2 \\ 1 \end{bmatrix}",
)
def what_gravity_takes_off_in_a_period(printed: Printed) -> Statement:
    """This column, and no other, is what a period of flight falls short of its linear part."""
    column = Vector((y, u))
    falls_short = equals(ball_at(T), flight_matrix(T) * b - column)
    return always(iff(falls_short, printed.formula(PAPER.extended({r"\alpha_T": column}))))


@claim(
    "sB.3-f",
    "B.3",
    "line 789",
    repeats="eq-13",
    printed=(
        r"\overline{f} := \left\{ \begin{array}{ll} \overline{f}_1 & : \overline{b} \in"
        r" \mathcal{B}_1 \\ "
        r"\overline{f}_2 & : \overline{b} \in \mathcal{B}_2 \end{array} \right."
    ),
)
def map_on_all_of_h_again(printed: Printed) -> Readings:
    """The two cases give every state of H one image, which is the state when the table bounces
    next.
    """
    return is_the_map(printed)


@claim(
    "sB.4-e1",
    "B.4",
    "line 795",
    repeats="s3.3-e1",
    printed=r"e_1 = \begin{bmatrix} \frac{4\alpha\dot{\rho}_0^2}{(1+\alpha)^2\gamma} \\ "
    r"\frac{-1(1-\alpha)\dot{\rho}_0}{1+\alpha} \end{bmatrix}",
)
def fixed_point_again(printed: Printed) -> Statement:
    """The fixed point of the map on B1 has this height and this speed."""
    return is_fixed_point(printed)


@claim(
    "sB.5-B10",
    "B.5",
    "line 801",
    repeats="eq-22",
    printed=r"\mathcal{B}_1^0 := \{ \overline{b} \in \mathcal{H} \mid "
    r"\dot{\overline{\beta}} = \gamma\tau_c - \frac{1+\alpha}{1-\alpha}(\dot{\rho}_0 -"
    r" \gamma\tau_c) \}",
    as_it_stands=r"\mathcal{B}_{1}^{0}:=\left\{ \overline{b}\in\mathcal{A}\,\big|\,\, "
    r"\dot{\overline{\beta}}=\gamma\tau_{c}-\frac{1+\alpha}{1-\alpha}\,(\dot{\rho}_{0}-\gamma\tau_{c})\right\}",
)
def states_without_energy_change_again(printed: Printed) -> list[Statement]:
    """The states of B1 whose image has the same energy are those of H whose speed and time to
    collision meet this equation.
    """
    region = printed.set_predicate(PAPER, r"\mathcal{B}_1^0")
    return same_set(region(b), B1_ZERO(b), given=[different(v, r)])


@claim("sB.6-boundary", "B.6", "line 807", printed=r"R(\overline{b}) = 0")
def boundary_of_the_region(printed: Printed) -> Readings:
    """The states of R next to which, however near, lie states outside R, are those at which the
    function R vanishes.

    Next to a state may mean in H only, that is above it at least, or anywhere in the plane, also
    below it.
    """
    vanishes = printed.formula(PAPER)
    higher, lower = (b + Vector((step, term(0))) for step in (lift, -lift))
    leaves = always(~R(higher), given=[R(b), vanishes, lift > 0], label="on-the-boundary")

    def inside(neighbour: Vector, label: str) -> Statement:
        return exists_some(
            ["lift"], R(neighbour), within=[lift > 0], given=[R(b), ~vanishes], label=label
        )

    above, below = inside(higher, "inside-above"), inside(lower, "inside-below")
    return Readings(
        {"in-H": Assertion((leaves, above)), "in-the-plane": Assertion((leaves, above, below))}
    )


@claim(
    "sB.6-R",
    "B.6",
    "line 811",
    repeats="eq-23b",
    printed=(
        r"""R(\overline{b}) := E_{max} + \Delta E_{max} - E(\overline{b})
       = \frac{1+\alpha}{(1-\alpha)^2} \dot{\rho}_0^2 - \gamma \overline{\beta}"""
        r""" - \frac{1}{2} \dot{\overline{\beta}}^2"""
    ),
)
def function_of_the_region_again(printed: Printed) -> Statement:
    """The function R is what the energy of a state lacks to the sum of both bounds, in height and
    speed.
    """
    names = {"R": only_at(b, margin), "E_{max}": greatest, r"\Delta E_{max}": gain}
    known = (
        equal(greatest, derived("E_max"))
        & equal(gain, derived("delta_E_max"))
        & equal(margin, derived("region_margin"))
    )
    return always(printed.formula(PAPER.extended(names)), given=[known])
