"""The region inclusions that the argument of section 4 rests on, for alpha < 1/3, and the change to
the normal form.

Each is stated for the range (21) of the paper; how far it really goes is found by the program.
"""

from __future__ import annotations

from juggleproof.proofs.paper.names import (
    B1,
    B1_MINUS,
    B1_OUTSIDE,
    B1_PLUS,
    B1_ZERO,
    B2,
    OUTSIDE,
    H,
    Placed,
    R,
    T,
    alpha,
    always,
    at,
    b,
    band,
    c,
    claim,
    collision_time,
    derived,
    derived_vector,
    e_1,
    energy,
    eps,
    equals,
    f1,
    f2,
    height,
    impact_energy_change,
    is_supremum,
    leaves_R_at,
    on_the_line,
    r,
    s,
    speed,
    v,
)
from juggleproof.proofs.paper.regions import (
    state_on_the_level,
)
from juggleproof.proofs.paper.states import (
    RANGE_21,
    narrow_band_stays,
)
from juggleproof.reading.values import Region, Vector
from juggleproof.statements.language import Statement, equal, iff, real, term

d = real("d")
TRAP = B1 & Region(lambda state: alpha * (r - speed(state)) < r)


def scaled(state: Vector) -> Vector:
    """The state in the coordinates of the normal form."""
    return at(derived_vector("scaling"), state)


def in_normal_form(value: Placed, state: Vector) -> Placed:
    """A derived term or state of the normal form at a state (x, w)."""
    return at(value, {"x": height(state), "w": speed(state)})


@claim("region-scaling", "inclusions", "normal form")
def normal_form_is_conjugate() -> list[Statement]:
    """With heights in units of r T and closing speeds in units of r, maps and regions no longer
    depend on r and g, only on alpha.
    """
    there = scaled(b)
    x, w = height(there), speed(there)
    return [
        always(
            equals(scaled(f1(b)), in_normal_form(derived_vector("normal_f1"), there)),
            label="f1",
        ),
        always(
            equals(scaled(f2(b)), in_normal_form(derived_vector("normal_f2"), there)),
            label="f2",
        ),
        always(
            iff(H(b), x >= 0) & iff(B1(b), (0 <= x) & (x < w)) & iff(B2(b), (0 <= x) & (x >= w)),
            label="regions",
        ),
        always(
            equal(energy(b), r**2 * in_normal_form(derived("normal_energy"), there)),
            label="energy",
        ),
        always(equals(in_normal_form(derived_vector("unscaling"), there), b), label="one-to-one"),
    ]


@claim("region-f-H", "inclusions", "line 327")
def states_stay_in_h() -> list[Statement]:
    """f maps H into itself."""
    return [
        always(H(f1(b)), given=[B1(b)], in_range=RANGE_21, label="with-impact"),
        always(H(f2(b)), given=[B2(b)], label="without-impact"),
    ]


@claim("region-B-partition", "inclusions", "line 315")
def b1_and_b2_part_h() -> list[Statement]:
    """Each state of H is in exactly one of B1 and B2; the time to collision tells which, where the
    ball is slower than the launch.
    """
    in_time = term(collision_time(b)) < T
    return [
        always((B1(b) | B2(b)) & ~(B1(b) & B2(b)), given=[H(b)], label="exactly-one"),
        always(iff(B1(b), in_time) & iff(B2(b), ~in_time), given=[v < r, H(b)], label="slower"),
        always(B2(b), given=[v >= r, H(b)], label="not-slower"),
    ]


@claim("region-B1-plus-E", "inclusions", "line 494")
def states_that_do_not_lose_have_little_energy() -> Statement:
    """The states of B1 whose impact gains or keeps energy have at most the energy E_max."""
    return always(energy(b) <= derived("E_max"), given=[(B1_PLUS | B1_ZERO)(b)], in_range=RANGE_21)


@claim("region-outside", "inclusions", "line 478")
def outside_impacts_lose() -> Statement:
    """The states of H outside R have no impact in the period, or one that loses energy."""
    return always((B2 | B1_MINUS)(b), given=[OUTSIDE(b)], in_range=RANGE_21)


@claim("region-f-R", "inclusions", "line 494")
def states_stay_in_the_region() -> list[Statement]:
    """f maps R into itself."""
    return [
        always(R(f1(b)), given=[B1(b), R(b)], in_range=RANGE_21, label="with-impact"),
        always(R(f2(b)), given=[B2(b), R(b)], in_range=RANGE_21, label="without-impact"),
    ]


@claim("region-DE-max", "inclusions", "line 451")
def no_period_gains_more() -> list[Statement]:
    """On H the energy rises in a period by Delta E_max at most."""
    gain = derived("delta_E_max")
    return [
        always(
            energy(f1(b)) - energy(b) <= gain, given=[B1(b)], in_range=RANGE_21, label="with-impact"
        ),
        always(
            energy(f2(b)) - energy(b) <= gain,
            given=[B2(b)],
            in_range=RANGE_21,
            label="without-impact",
        ),
    ]


@claim("region-DE-sup", "inclusions", "line 712")
def impacts_outside_lose_at_least() -> list[Statement]:
    """Delta E_sup is the supremum of the energy change on B1 outside R, and is not attained
    there.
    """
    return is_supremum(
        derived("delta_E_sup"),
        impact_energy_change(b),
        ["beta", "v"],
        B1_OUTSIDE(b),
        strict=True,
        in_range=RANGE_21,
    )


@claim("region-p", "inclusions", "line 559")
def point_p_lies_outside() -> Statement:
    """The state of the line between B1 and B2 that has the velocity of e_1 does not belong to R."""
    return always(~R(on_the_line(speed(e_1))), in_range=RANGE_21)


@claim("region-near", "inclusions", "line 559")
def states_of_the_region_near_e_1_lie_in_b1() -> list[Statement]:
    """The states of R whose velocity is near that of e_1 lie in B1: exactly those slower than where
    R leaves B1 are sure to.
    """
    leaves, highest = [leaves_R_at(c)], state_on_the_level(v)
    return [
        always(leaves_R_at((2 - s / (1 - alpha)) * r), in_range=RANGE_21, label="leaves"),
        always(B1(b), given=[*leaves, R(b), v < c], in_range=RANGE_21, label="slower"),
        always(speed(e_1) < c, given=leaves, in_range=RANGE_21, label="e_1-is-slower"),
        always(
            (B2 & R)(highest),
            given=[*leaves, R(b), v >= c],
            in_range=RANGE_21,
            label="no-further",
        ),
    ]


@claim("region-e1-R", "inclusions", "line 561")
def fixed_point_lies_in_both() -> Statement:
    """The fixed point of f1 lies in B1 and in R."""
    return always(B1(b) & R(b), given=[equals(f1(b), b)], in_range=RANGE_21)


@claim("region-K", "inclusions", "line 565")
def bands_are_mapped_into_themselves() -> list[Statement]:
    """f, which is f1 there, maps the band of size eps r^2 around e_1 into itself, if the band does
    not reach up to where R leaves B1; there are such bands.
    """
    return [*narrow_band_stays(eps * r**2)]


@claim("region-K-size", "inclusions", "not printed")
def band_is_kept_up_to_this_size() -> list[Statement]:
    """f1 maps the band of size eps r^2 around e_1 into itself if sqrt(2 eps) < (1 - alpha)/(alpha
    (1 + alpha)); and where R has the state on the ground that closes at r/alpha, only then, for f1
    takes this state of the band out of B1; else it maps every band into itself.
    """
    size, stays = eps * r**2, band(eps * r**2)(f1(b))
    fast = Vector((0, r - r / alpha))  # on the ground, closing at r/alpha
    half_width = [d >= 0, equal(d**2, 2 * eps)]  # sqrt(2 eps)
    kept = alpha * (1 + alpha) * d < 1 - alpha
    reached = term(at(derived("region_margin"), fast)) >= 0  # R has this state
    return [
        always(stays, given=[band(size)(b), *half_width, kept], in_range=RANGE_21, label="kept"),
        always(
            band(size)(fast) & ~B1(f1(fast)),
            given=[reached, *half_width, ~kept],
            in_range=RANGE_21,
            label="not-kept",
        ),
        always(stays, given=[band(size)(b), ~reached], in_range=RANGE_21, label="every-band"),
    ]


@claim("region-Emax-B1", "inclusions", "not printed")
def impacts_of_sustainable_energy_stay_impacts() -> Statement:
    """The states of B1 with energy E_max at most are mapped to such states by f, which is f1
    there.
    """
    sustainable = B1 & Region(lambda state: energy(state) <= derived("E_max"))
    return always(sustainable(f1(b)), given=[sustainable(b)], in_range=RANGE_21)


@claim("region-trap", "inclusions", "not printed")
def trap_is_mapped_into_itself() -> Statement:
    """The states of B1 whose closing speed is below r/alpha are mapped to such states by f, which
    is f1 there.
    """
    return always(TRAP(f1(b)), given=[TRAP(b)], in_range=RANGE_21)
