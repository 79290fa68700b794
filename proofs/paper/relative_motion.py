r"""Motion relative to e_1: the coordinates z = b - e_1, the kinetic energy K in them, and the
states where it is small.

K is a function here, the kinetic energy of section 4.3, and not the integer K of section 3.5.
"""

from __future__ import annotations

from certificates.statements import Statement
from certificates.terms import Formula, Term, conjunction, disjunction, equal, reals, term
from proofs.paper.events import height, only_at, speed, vector
from proofs.paper.vocabulary import (
    B1,
    NAMES,
    POINTS,
    R,
    alpha,
    always,
    at,
    b,
    derived,
    e_1,
    energy,
    eps,
    f1,
    g,
    r,
)
from proofs.reading.environment import Environment
from proofs.reading.notions import Region, StateFunction
from proofs.reading.values import Matrix, Vector

z1, z2, c, d, change = reals("z1 z2 c d change")
z = Vector((z1, z2))
image = Vector(
    reals("beta_next v_next")
)  # a state that follows b, for whichever branch of f applies
STABILITY = (
    "theorem-in-units/exactly",
)  # e_1 is stable and attracts every state of H <=> alpha < 1/3
RANGE_21 = (
    alpha > 0,
    alpha < derived("restitution_threshold", 2),
)  # (21): e_1 is the only fixed point


def _of_z(name: str) -> StateFunction:
    return StateFunction(lambda state: at(derived(name), {"z1": height(state), "z2": speed(state)}))


kinetic_energy = _of_z("relative_kinetic_energy")
kinetic_energy_change = _of_z("relative_kinetic_energy_change")
relative_step = _of_z("relative_map")


def from_e_1(state: Vector) -> Term:
    """K(b - e_1): the kinetic energy of the motion relative to e_1."""
    return term(kinetic_energy(state - e_1))


def on_the_line(velocity: Term) -> Vector:
    """The state of this velocity from which ball and table meet just when the table bounces
    next.
    """
    return Vector((at(derived("boundary_height"), {"v": velocity}), velocity))


def leaves_R_at(velocity: Term) -> Formula:
    """The line between B1 and B2 meets the boundary of R at this velocity, below the table's launch
    speed.
    """
    return conjunction(
        [velocity < r, equal(term(energy(on_the_line(velocity))), derived("region_energy"))]
    )


def band(size: Term) -> Region:
    """The states of B1 and R whose kinetic energy relative to e_1 is at most `size`."""
    return B1 & R & Region(lambda state: from_e_1(state) <= size)


def is_narrow(size: Term) -> tuple[Formula, ...]:
    """The band of this size does not reach to where R leaves B1."""
    return leaves_R_at(c), from_e_1(on_the_line(c)) > size


NEAR = is_narrow(eps)


def narrow_band_stays(size: Term) -> tuple[Statement, ...]:
    """f1 maps a narrow band into itself: its images are in B1, in R, and in the band."""
    after = vector(f1(b))
    return (
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


def boundary_of_band(size: Term) -> Region:
    """What bounds the band: its closure, at height 0, on the line between B1 and B2, at the energy
    of R, or at `size`.
    """

    def holds(state: Vector) -> Formula:
        margins = (
            height(state),
            at(derived("collision_margin"), state),
            at(derived("region_margin"), state),
            size - from_e_1(state),
        )
        return conjunction([margin >= 0 for margin in margins]) & disjunction(
            [equal(margin, 0) for margin in margins]
        )

    return Region(holds)


BOUNDARY_OF_R = R & Region(
    lambda state: equal(at(derived("region_margin"), state), 0) | equal(height(state), 0)
)

AT_Z = Environment(
    {**NAMES, r"K": kinetic_energy, r"z": z, r"b": b, r"u_2'": Matrix(((0, 1),))}, state=r"z"
)
STEP = Environment(
    {
        **NAMES,
        r"K": kinetic_energy,
        r"f": relative_step,
        r"z_k": z,
        r"z_{k+1}": relative_step(z),
        r"b_k": z + e_1,
        r"b_{k+1}": vector(f1(z + e_1)),
        r"u_2'": Matrix(((0, 1),)),
        r"\xi": derived("xi_1"),
    },
    state=r"z_k",
)
AROUND_E1 = Environment(
    {
        **NAMES,
        r"K": kinetic_energy,
        r"B_1": B1,
        r"R": R,
        r"\mathcal{K}": band(eps),
        r"\partial\mathcal{K}": boundary_of_band(eps),
        r"\overline f": only_at(b, image),
    },
    points=POINTS,
    state=r"\overline b",
)
