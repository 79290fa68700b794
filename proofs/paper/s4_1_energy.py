"""Section 4.1: which impacts gain energy, the energy that the table can sustain, and the region
R.
"""

from __future__ import annotations

from juggleproof.judging.claims import Assertion, Following, Reading, Readings, Remark
from juggleproof.proofs.paper.names import (
    B1,
    B1_ZERO,
    B2,
    H,
    K,
    after_impact,
    always,
    at,
    b,
    ball_at,
    beta,
    claim,
    collision_time,
    derived,
    e_1,
    energy,
    exists_some,
    f1,
    f2,
    impact_energy_change,
    is_maximum,
    only_at,
    paper_names,
    r,
    same_set,
    speed,
    strikes_at,
    t,
    v,
)
from juggleproof.proofs.paper.regions import LEVEL, pieces
from juggleproof.proofs.paper.states import (
    BOTH_BOUNDS,
    NOT_LOSING,
    STABILITY,
    UNKNOWN,
    E_max,
    always_integer,
    cycle,
    dE_max,
    keeps_energy,
    place,
)
from juggleproof.reading.meaning import Printed
from juggleproof.statements.language import (
    Statement,
    Term,
    conjunction,
    different,
    equal,
    iff,
    real,
    term,
)


def speed_of_no_change() -> Term:
    """The derived speed at which an impact at the time to collision keeps the energy."""
    return term(at(derived("zero_change_speed"), {"tau": collision_time(b)}))


@claim(
    "s4.1-every-B1-changes",
    "4.1",
    "line 432",
    remark=Remark(
        "The print says every state of B1. On B1^0, which the next sentence takes out, the change"
        " is zero.",
        by=("s4.1-partition",),
    ),
)
def impacts_change_the_energy() -> list[Statement]:
    """From a state of B1, but for those of B1^0, the energy changes in a period, and by the impact
    alone; from the other states of H it does not change.
    """
    gained = energy(f1(b)) - energy(b)
    before, after = speed(ball_at(t)), speed(after_impact(t))
    return [
        always(
            equal(gained, (after**2 - before**2) / 2),
            given=[B1(b), strikes_at(t)],
            label="at-the-impact",
        ),
        always(different(gained, 0), given=[B1(b), ~B1_ZERO(b)], label="changes"),
        always(equal(energy(f2(b)), energy(b)), given=[B2(b)], label="nowhere-else"),
    ]


@claim("s4.1-from-16", "4.1", "line 436", printed=r"\Delta_1 E = 0")
def curve_of_no_change_from_the_energy_change(printed: Printed) -> Statement:
    """The energy change of an impact vanishes exactly at one speed that depends on the time to
    collision.
    """
    return always(
        iff(printed.formula(paper_names()), equal(v, speed_of_no_change())),
        given=[H(b), different(v, r)],
    )


@claim(
    "eq-22",
    "4.1",
    "(22)",
    printed=r"\mathcal{B}_1^0 := \{ \overline{b} \in \mathcal{H} \mid "
    r"\dot{\overline{\beta}} = \gamma\tau_c - \frac{1+\alpha}{1-\alpha}(\dot{\rho}_0 -"
    r" \gamma\tau_c) \}",
    as_it_stands=(
        r"\mathcal{B}_{1}^{0} := \left\{ \left. \overline{b} \in \mathcal{A} \right| \left."
        r" \dot{\overline{\beta}} = "
        r"\gamma \tau_{c} - \frac{1+\alpha}{1-\alpha} \left(\dot{\rho}_{0} - \gamma \tau_{c}"
        r" \right) \right. \right\}"
    ),
)
def states_that_keep_their_energy(printed: Printed) -> list[Statement]:
    """The states of B1 that an impact leaves with the same energy are those of H whose speed fits
    their time to collision so.
    """
    region = printed.set_predicate(paper_names(), r"\mathcal{B}_1^0")
    return [
        *same_set(region(b), B1(b) & keeps_energy(b), given=[different(v, r)]),
        always(different(v, r), given=[B1(b)], label="time-is-defined"),
    ]


@claim("s4.1-partition", "4.1", "line 441", printed=r"\Delta_1 E > 0 \\ \Delta_1 E < 0")
def three_regions_of_b1(printed: Printed) -> list[Statement]:
    """The curve of no change parts B1 into states that gain, states that lose and itself, and none
    of the three is empty.
    """
    gains, loses = (part.formula(paper_names()) for part in pieces(printed, 2))
    on_curve = equal(v, speed_of_no_change())
    one_of_them = conjunction(
        [gains | loses | on_curve, ~(gains & loses), ~(gains & on_curve), ~(loses & on_curve)]
    )
    return [
        always(iff(gains, energy(f1(b)) > energy(b)), given=[B1(b)], label="gains"),
        always(iff(loses, energy(f1(b)) < energy(b)), given=[B1(b)], label="loses"),
        always(one_of_them, given=[v < r, B1(b)], label="exactly-one"),
        exists_some(["beta", "v"], gains, within=[B1(b)], label="some-gain"),
        exists_some(["beta", "v"], loses, within=[B1(b)], label="some-lose"),
        exists_some(["beta", "v"], keeps_energy(b), within=[B1(b)], label="some-keep"),
    ]


@claim(
    "s4.1-Emax",
    "4.1",
    "lines 443 to 445",
    printed=r"E_{max} = \frac{1}{2} \left(\frac{1+\alpha}{1-\alpha} \dot{\rho}_0 \right)^2",
    remark=Remark(
        "(34) is cited for this maximum, and does not show it: A.1 finds an equilibrium.",
        by=("sA.1-in-step",),
    ),
)
def greatest_energy_that_is_kept(printed: Printed) -> list[Statement]:
    """E_max is the greatest energy of a state of B1 whose impact does not lose energy."""
    return is_maximum(
        E_max,
        energy(b),
        {"beta": beta, "v": v},
        at=place("largest_kept_energy"),
        on=NOT_LOSING(b),
        given=[printed.formula(UNKNOWN)],
    )


@claim(
    "s4.1-Emax-maintain",
    "4.1",
    "line 447",
    parameters=("alpha", "K"),
    remark=Remark(
        "The next impact comes as the table is launched again just for alpha = (K - 1)/(K + 1), K a"
        " whole number. No orbit of less energy than E_max exceeds it.",
        by=("sA.1-in-step", "theorem-E-max"),
    ),
)
def table_maintains_that_energy_at_most() -> Readings:
    """An impact from a state of more energy than E_max loses energy; some state of the energy E_max
    keeps it over one impact; or for ever, and so over the next impact too, which comes after K
    periods and before K + 1.
    """
    greatest = derived("E_max")
    at_most = always(
        energy(f1(b)) < energy(b), given=[B1(b), energy(b) > greatest], label="not-more"
    )
    keeps = [B1(b), equal(energy(b), greatest), keeps_energy(b)]
    as_much = exists_some(["beta", "v"], keeps[2], within=keeps[:2], label="as-much")
    periods = derived("subharmonic_bound")  # of the flight after that impact
    again = always_integer(
        keeps_energy(cycle(K)),
        given=[*keeps, K <= periods, periods < K + 1],
        label="at-the-next-impact",
    )
    return Readings(
        {
            "over-one-impact": Reading(
                Assertion((at_most, as_much)),
                "section 4.1 takes E_max as the greatest energy at which an impact does not lose",
            ),
            "for-ever": Reading(
                Assertion((again,)),
                "A.1 seeks the energy that can be sustained, of a velocity in equilibrium",
            ),
        }
    )


@claim(
    "s4.1-DEmax",
    "4.1",
    "lines 447 to 449",
    printed=r"\Delta E_{max} = \frac{1}{2} \frac{1+\alpha}{1-\alpha} \dot{\rho}_0^2",
)
def greatest_gain_of_an_impact(printed: Printed) -> list[Statement]:
    """Delta E_max is the greatest energy change of a state of B1 whose impact does not lose
    energy.
    """
    return is_maximum(
        dE_max,
        impact_energy_change(b),
        {"beta": beta, "v": v},
        at=place("largest_energy_change"),
        on=NOT_LOSING(b),
        given=[printed.formula(UNKNOWN)],
    )


@claim("s4.1-DEmax-on-H", "4.1", "line 451")
def greatest_gain_on_the_whole_state_space() -> list[Statement]:
    """Delta E_max is also the greatest energy change of all states of H, with or without an
    impact.
    """
    greatest = derived("delta_E_max")
    return [
        always(energy(f1(b)) - energy(b) <= greatest, given=[B1(b)], label="with-impact"),
        always(energy(f2(b)) - energy(b) <= greatest, given=[B2(b)], label="without-impact"),
        exists_some(
            ["beta", "v"],
            equal(energy(f1(b)) - energy(b), greatest),
            within=[B1(b)],
            label="attained",
        ),
    ]


@claim(
    "s4.1-sum",
    "4.1",
    "line 453",
    printed=r"E_{max} + \Delta E_{max} = \frac{1+\alpha}{(1-\alpha)^2} \dot{\rho}_0^2.",
)
def sum_of_both_bounds(printed: Printed) -> Statement:
    """The greatest energy that is kept and the greatest gain add up to this level."""
    return always(printed.formula(UNKNOWN), given=BOTH_BOUNDS)


@claim("s4.1-conservative", "4.1", "line 455")
def smaller_region_attracts_too() -> Following:
    """The level of R is higher than need be: the states of H of energy at most E_max, which is
    below it, are mapped to such states, and attract every orbit.

    Every orbit tends to e_1, which has less energy than that.
    """
    little = derived("E_max")
    given = [energy(b) <= little]
    return Following(
        STABILITY,
        Assertion(
            (
                always(energy(f1(b)) <= little, given=[B1(b), *given], label="with-impact"),
                always(energy(f2(b)) <= little, given=[B2(b), *given], label="without-impact"),
                always(little < LEVEL, label="smaller"),
                always(energy(e_1) < little, label="e_1-inside"),
            )
        ),
    )


@claim(
    "eq-23a",
    "4.1",
    "(23), first line",
    printed=r"R(\overline{b}) := E_{max} + \Delta E_{max} - E(\overline{b})",
)
def energy_that_is_left_to_the_level(printed: Printed) -> list[Statement]:
    """R(b) is what the energy of the state lacks to the sum of both bounds: nonnegative up to that
    level.
    """
    margin, level = real("margin"), derived("E_max") + derived("delta_E_max")
    defined = [printed.formula(UNKNOWN.extended({r"R": only_at(b, margin)})), *BOTH_BOUNDS]
    return [
        always(equal(margin + energy(b), level), given=defined, label="lack"),
        always(iff(margin >= 0, energy(b) <= level), given=defined, label="sign"),
    ]


@claim(
    "eq-23b",
    "4.1",
    "(23), second line",
    printed=r"E_{max} + \Delta E_{max} - E(\overline{b}) = "
    r"\frac{1+\alpha}{(1-\alpha)^2} \dot{\rho}_0^2 - \gamma \overline{\beta} - \frac{1}{2}"
    r" \dot{\overline{\beta}}^2.",
)
def energy_that_is_left_written_out(printed: Printed) -> Statement:
    """What the energy lacks to the sum of both bounds, written out in height and speed."""
    return always(printed.formula(UNKNOWN), given=BOTH_BOUNDS)


@claim(
    "eq-24",
    "4.1",
    "(24)",
    printed=r"\mathcal{R} := \{ \overline{b} \in \mathcal{H} \mid R(\overline{b}) \ge 0 \}",
    as_it_stands=r"R := \left\{ \overline{b} \in \mathcal{A} \mid R(\overline{b}) \ge 0 \right\}",
)
def region_below_the_level(printed: Printed) -> list[Statement]:
    """R holds the states of H whose energy is at most the sum of E_max and Delta E_max."""
    region = printed.set_predicate(paper_names(), r"\mathcal{R}")
    return same_set(region(b), H(b) & (energy(b) <= derived("E_max") + derived("delta_E_max")))
