"""Section 4.2: Proposition 1, that every orbit enters the region R and stays there, and each
sentence of its proof.
"""

from __future__ import annotations

from juggleproof.judging.claims import Assertion, Following, Reading, Readings, Remark, Simulated
from juggleproof.proofs.paper.names import (
    B1,
    B1_MINUS,
    B1_OUTSIDE,
    B1_PLUS,
    B1_ZERO,
    B2,
    OUTSIDE,
    H,
    R,
    T,
    always,
    as_region,
    b,
    ball_at,
    beta,
    claim,
    derived,
    energy,
    f1,
    f2,
    height,
    impact_energy_change,
    is_maximum,
    only_at,
    paper_names,
    r,
    t,
    v,
    value_of,
)
from juggleproof.proofs.paper.regions import (
    ATTRACTION,
    LEVEL,
    NAMED,
    always_counting,
    b_0,
    beta0,
    ceiling_of,
    exists_counting,
    floor_of,
    flown,
    grounded_after,
    impacts_suffice,
    j,
    lands,
    m,
    n,
    pieces,
    strikes_in_period,
    struck_by,
    tau,
    tau_w,
    v0,
    with_rounding,
    worst_wait,
)
from juggleproof.proofs.paper.states import place
from juggleproof.proofs.simulations.figures import HEIGHTS, SPEEDS, figures
from juggleproof.reading.meaning import Printed
from juggleproof.reading.values import scalar
from juggleproof.statements.language import Formula, Statement, different, equal, real, term

t_R = real("t_R")


def stays() -> Assertion:
    """f maps R into itself, on both of its branches."""
    return Assertion(
        (
            always(R(f1(b)), given=[R(b), B1(b)], label="with-impact"),
            always(R(f2(b)), given=[R(b), B2(b)], label="without-impact"),
        )
    )


def loses_outside() -> tuple[Statement, Statement]:
    """Outside R an impact takes energy, and a period without one keeps it."""
    return (
        always(energy(f1(b)) < energy(b), given=[B1_OUTSIDE(b)], label="impact-loses"),
        always(equal(energy(f2(b)), energy(b)), given=[B2(b)], label="flight-keeps"),
    )


@claim("prop-1", "4.2", "Proposition 1, line 476")
def region_attracts_and_is_invariant() -> Following:
    """For alpha below 1/3, and beyond, every orbit is attracted to R, and R is mapped into
    itself.
    """
    return Following(ATTRACTION, beside=stays())


@claim("prop-1-outside-in-B1minus", "4.2", "line 478")
def impacts_outside_the_region_lose() -> Statement:
    """The part of B1 outside R belongs to the states whose impact loses energy."""
    return always(B1_MINUS(b), given=[B1_OUTSIDE(b)])


def flights_end() -> tuple[Statement, Statement]:
    """Flight keeps the energy and stays in H, and does not last for ever: once its worst time is
    over the ball would be below the ground.
    """
    return (
        always(
            H(f2(b)) & equal(energy(f2(b)), energy(b)), given=[B2(b)], label="in-H-at-one-energy"
        ),
        always_counting(~B2(flown(n)), given=[H(b_0), n * T > worst_wait], label="not-for-ever"),
    )


@claim("prop-1-B2-to-B1", "4.2", "line 478")
def flights_end_in_b1_outside_the_region() -> Readings:
    """Free flight at constant energy leads to the part of B1 outside R: from the states of B2
    outside R, or from all of B2.
    """

    def arrive(given: list[Formula]) -> Assertion:
        arrives = (B1 & OUTSIDE)(f2(b))
        arrival = always(arrives, given=[*given, B1(f2(b))], label="arrives-outside")
        return Assertion((*flights_end(), arrival))

    return Readings(
        {
            "from-outside-R": Reading(
                arrive([B2(b), OUTSIDE(b)]), "section 4.2 says, and hence in B2 - R"
            ),
            "from-all-of-B2": Reading(arrive([B2(b)]), "section 4.2 says all points in B2"),
        }
    )


@claim("prop-1-lose-energy", "4.2", "line 478")
def outside_states_are_attracted_as_they_lose() -> Following:
    """Outside R every impact takes energy and flights keep it, so that states outside are attracted
    to R.
    """
    return Following(ATTRACTION, beside=Assertion(loses_outside()))


@claim("prop-1-finite", "4.2", "line 478")
def finite_states_arrive_in_finite_time() -> Following:
    """Every state enters R in finite time: its flights end, and its impacts outside R take an
    energy bounded away from zero.
    """
    loss = derived("delta_E_sup")
    return Following(
        ATTRACTION,
        beside=Assertion(
            (
                always(
                    energy(f1(b)) - energy(b) < loss, given=[B1_OUTSIDE(b)], label="takes-at-least"
                ),
                always(loss < 0, label="bounded-from-zero"),
                always_counting(
                    ~B2(flown(n)), given=[H(b_0), n * T > worst_wait], label="flights-end"
                ),
            )
        ),
    )


@claim("eq-25", "4.2", "(25)", printed=r"\tau_w := \frac{2}{\gamma} \sqrt{2E(\overline{b}_0)}.")
def worst_time_to_impact(printed: Printed) -> list[Statement]:
    """A ball of this energy strikes the table within tau_w, after which it would be on or below the
    ground, and one thrown up from the ground is above it as long as that.
    """
    defined = printed.formula(NAMED)
    above = height(ball_at(t, b_0))
    return [
        *struck_by(tau_w, b_0, [defined]),
        grounded_after(tau_w, b_0, [defined], "no-longer"),
        always_counting(
            above > 0, given=[equal(beta0, 0), v0 > 0, defined, t > 0, t < tau_w], label="as-long"
        ),
    ]


# The two roundings of the bracket, with what the paper prints for either.
ROUNDED_DOWN = "(18) prints the same bracket, which rounds down there"
ROUNDED_UP = "section 4.2 says a number of impacts that is enough in the worst case"
OF_THE_LOSS = Remark(
    "Delta E_sup is the least loss as derived. With the loss that A.3.2 prints, this number of"
    " impacts is too small for great alpha also when rounded up.",
    by=("theorem-count", "sA.3.2-sup3"),
)


def is_enough(printed: Printed) -> Readings:
    """The number of impacts, rounded down or up."""
    count = with_rounding(printed, NAMED)[1]
    return Readings(
        {
            "floor": Reading(impacts_suffice(floor_of(count)), ROUNDED_DOWN),
            "ceiling": Reading(impacts_suffice(ceiling_of(count)), ROUNDED_UP),
        }
    )


@claim(
    "s4.2-count",
    "4.2",
    "line 484",
    printed=r"[\frac{E(\overline{b}_0) - E_{max} - \Delta E_{max}}{-\Delta E_{sup}}]",
    remark=OF_THE_LOSS,
)
def impacts_before_the_region_is_entered(printed: Printed) -> Readings:
    """The energy above the level of R, over the derived least loss outside R, tells how many
    impacts lead into R: rounded down, or rounded up.
    """
    return is_enough(printed)


def longest_waits() -> Statement:
    """A ball of less energy than b_0 lands sooner than the worst flight of b_0's energy."""
    return always_counting(t < worst_wait, given=[H(b), energy(b) < energy(b_0), lands(b, t)])


@claim(
    "s4.2-less-energy-shorter",
    "4.2",
    "line 484",
    true_nearby=("the longest of them is shorter for states of less energy", longest_waits),
)
def less_energy_makes_flights_shorter() -> Statement:
    """Of two states, that of less energy does not wait longer for the next impact.

    The wait is read as the time until the ball is down on the ground, if nothing is in its way.
    """
    less = [H(b), H(b_0), energy(b) < energy(b_0), lands(b, t)]
    return always(t <= tau, given=[*less, lands(b_0, tau)])


@claim("s4.2-max-time", "4.2", "line 484")
def longest_time_between_impacts() -> list[Statement]:
    """While an orbit is outside R its energy does not rise, and a ball of that energy or less
    strikes the table within tau_w of any moment, as of its last impact.
    """
    return [
        *loses_outside(),
        *struck_by(worst_wait, b, [energy(b) <= energy(b_0)]),
    ]


def never_enough_of_samples() -> list[Statement]:
    """A ball thrown up from the ground outside R, with so little energy that one impact is counted,
    is outside R for the m periods that it flies.
    """
    loss = -term(derived("delta_E_sup"))
    thrown = [equal(beta0, 0), v0 > 0, LEVEL < energy(b_0), energy(b_0) <= LEVEL + loss]
    return [
        always_counting(
            equal(n, 1), given=[*thrown, ceiling_of((energy(b_0) - LEVEL) / loss)], label="counted"
        ),
        always_counting(
            OUTSIDE(flown(n)),
            given=[*thrown, m * T <= worst_wait, n >= 0, n <= m],
            label="outside-in-flight",
        ),
    ]


def enough_of_samples() -> list[Statement]:
    """The sample that follows the n-th impact comes within a period of it, and is in R, since the
    other impacts have left no more energy than one least loss above the level of R.
    """
    loss = -term(derived("delta_E_sup"))
    return [
        always_counting(
            j * T < n * worst_wait + T,
            given=[H(b_0), t <= n * worst_wait, (j - 1) * T < t],
            label="next-sample-by",
        ),
        always(
            R(f1(b)),
            given=[B1_OUTSIDE(b), energy(b) <= LEVEL + loss],
            label="next-sample-in-R",
        ),
    ]


# What the time to collision of b_0 may be, with what the paper prints for either.
BY_THE_FORMULA = "section 4.2 prints tau_c(b_0), which (6) defines by a formula"
IN_REAL_TIME = "section 4.2 speaks of the time to impact, which may be more than a period"


@claim("s4.2-note9-equal", "4.2", "footnote 9", printed=r"\tau_w = \tau_c(\overline{b}_0)")
def worst_time_is_met(printed: Printed) -> Readings:
    """From the ground in B2, with tau_w a multiple of the period, the time to collision is tau_w:
    that of (6), or the real one.
    """
    case = [equal(beta0, 0), B2(b_0), equal(tau_w, worst_wait), equal(tau_w, m * T)]
    real_time = printed.formula(NAMED.extended({r"\tau_c": only_at(b_0, tau)}))
    earlier = [j >= 0, t >= 0, t < T, j * T + t < tau]
    return Readings(
        {
            "by-6": Reading(
                Assertion(
                    (always_counting(printed.formula(NAMED), given=[*case, different(v0, r)]),)
                ),
                BY_THE_FORMULA,
            ),
            "in-real-time": Reading(
                Assertion(
                    (
                        always_counting(
                            strikes_in_period(m, tau - m * T),
                            given=[*case, real_time],
                            label="strikes-then",
                        ),
                        always_counting(
                            ~strikes_in_period(j, t),
                            given=[*case, real_time, *earlier],
                            label="not-before",
                        ),
                    )
                ),
                IN_REAL_TIME,
            ),
        }
    )


@claim("s4.2-note9-otherwise", "4.2", "footnote 9", printed=r"\tau_w > \tau_c(\overline{b}_0)")
def worst_time_is_not_met_otherwise(printed: Printed) -> Readings:
    """In all other cases outside R the time to collision is less than tau_w: that of (6), or the
    real one.

    In real time the ball is on or below the ground before tau_w, or, thrown from the ground,
    strikes the rising table.
    """
    outside = [OUTSIDE(b_0), equal(tau_w, worst_wait)]
    sooner = printed.formula(NAMED.extended({r"\tau_c": only_at(b_0, tau)}))
    between = [m * T < tau_w, tau_w < (m + 1) * T]
    by_formula = Assertion(
        (
            always_counting(
                printed.formula(NAMED),
                given=[*outside, beta0 > 0, different(v0, r)],
                label="above-the-ground",
            ),
            always_counting(
                printed.formula(NAMED),
                given=[*outside, equal(beta0, 0), different(v0, r)],
                label="on-the-ground",
            ),
        )
    )
    real = Assertion(
        (
            exists_counting(
                ["tau"],
                height(ball_at(tau, b_0)) <= 0,
                within=[tau >= 0, sooner],
                given=[*outside, (beta0 > 0) | (v0 <= 0)],
                label="falls-before",
            ),
            exists_counting(
                ["tau"],
                strikes_in_period(m, tau - m * T),
                within=[tau >= m * T, sooner],
                given=[equal(beta0, 0), v0 > 0, equal(tau_w, worst_wait), *between],
                label="strikes-before",
            ),
        )
    )
    return Readings(
        {
            "by-6": Reading(by_formula, BY_THE_FORMULA),
            "in-real-time": Reading(real, IN_REAL_TIME),
        }
    )


@claim(
    "eq-26",
    "4.2",
    "(26)",
    printed=r"t_{\mathcal{R}} := \frac{2}{\gamma} \sqrt{2E(\overline{b}_0)} "
    r"[\frac{E(\overline{b}_0) - E_{max} - \Delta E_{max}}{-\Delta E_{sup}}].",
    as_it_stands=r"t_R := \frac{2}{\gamma} \sqrt{2E(\overline{b}_0)} "
    r"\left[\frac{E(\overline{b}_0) - E_{max} - \Delta E_{max}}{-\Delta E_{sun}} \right].",
    remark=Remark(
        f"{OF_THE_LOSS.text} Of the states sampled once a period, as section 2.3 takes them, (26)"
        " is too early for every alpha: a ball that is thrown up from the ground with little more"
        " than the energy of R, for which one impact is counted, flies for all of the whole periods"
        " in that time, and is outside R at their end. A period more is enough: with N the number"
        " of impacts, rounded up, the sample that follows the N-th impact is in R, and comes before"
        " N tau_w + T.",
        lambda: [*never_enough_of_samples(), *enough_of_samples()],
        by=OF_THE_LOSS.by,
    ),
)
def longest_time_to_enter_the_region(printed: Printed) -> Readings:
    """Within this time b_0 enters R: one worst flight for each impact, their number, with the
    derived least loss outside R, rounded down or up.
    """
    environment, count = with_rounding(printed, NAMED.extended({r"t_{\mathcal{R}}": t_R}))
    defined = printed.formula(environment)

    def continuous(rounding: Formula) -> Assertion:
        enough = always_counting(
            n * worst_wait <= t_R, given=[H(b_0), rounding, defined], label="time-for-each"
        )
        waits = grounded_after(worst_wait, b, [energy(b) <= energy(b_0)], "each-wait")
        return Assertion((enough, waits, *impacts_suffice(rounding).parts))

    return Readings(
        {
            "floor": Reading(continuous(floor_of(count)), ROUNDED_DOWN),
            "ceiling": Reading(continuous(ceiling_of(count)), ROUNDED_UP),
        }
    )


@claim("s4.2-trapped", "4.2", "line 494")
def orbits_do_not_leave_the_region() -> Assertion:
    """From a state of R, f leads to a state of R."""
    return stays()


@claim(
    "s4.2-highest-B1plus",
    "4.2",
    "line 494",
    printed=r"\mathcal{B}_1^+ \cup \mathcal{B}_1^0, \quad E_{max}",
    as_it_stands=r"\ell_1 \ell_1, \quad \ell_1 \text{ region is } \ell_2 \text{ region is } \ell_2",
    repeats="s4.1-Emax",
    remark=Remark(
        "The transcription has lost the names of the region and of the energy. They are restored"
        " as section 4.1 has them; on B1^+ alone E_max is not attained.",
        lambda: always(energy(b) < derived("E_max"), given=[B1_PLUS(b)], label="not-attained"),
        by=("s4.1-Emax",),
    ),
)
def greatest_energy_that_can_gain(printed: Printed) -> list[Statement]:
    """E_max is the greatest energy of the states whose impact gains or keeps energy."""
    where, greatest = pieces(printed, 2)
    parts = {r"\mathcal{B}_1^+": B1_PLUS, r"\mathcal{B}_1^0": B1_ZERO}
    return is_maximum(
        term(scalar(value_of(greatest, paper_names()))),
        energy(b),
        {"beta": beta, "v": v},
        at=place("largest_kept_energy"),
        on=as_region(value_of(where, paper_names().extended(parts)))(b),
    )


@claim(
    "s4.2-adding",
    "4.2",
    "line 494",
    printed=r"\Delta E_{max}, \quad \mathcal{R}",
    as_it_stands=r"\ell_2 + \ell_2, \quad \ell_3",
    remark=Remark(
        "The transcription has lost both names. They are restored as the greatest gain of section"
        " 4.1, and the region that the sentences before and after speak of.",
        by=("s4.1-DEmax-on-H",),
    ),
)
def greatest_gain_does_not_lead_out(printed: Printed) -> list[Statement]:
    """The greatest gain, on top of the greatest energy at which an impact gains, does not lead out
    of R.
    """
    what, where = pieces(printed, 2)
    kept, gain = derived("E_max"), term(scalar(value_of(what, paper_names())))
    inside = as_region(value_of(where, paper_names()))
    return [
        always(impact_energy_change(b) <= gain, given=[B1_PLUS(b)], label="gain"),
        always(inside(f1(b)), given=[B1(b), energy(b) <= kept], label="stays"),
        always(kept + gain <= LEVEL, label="level"),
    ]


@claim("s4.2-invariant", "4.2", "line 494")
def region_is_attracting_and_invariant() -> Following:
    """R is attracting and f maps it into itself."""
    return Following(ATTRACTION, beside=stays())


@claim("s4.2-typically-shorter", "4.2", "line 492", parameters=())
def orbits_reach_the_region_sooner_than_the_bound() -> Simulated:
    """Orbits from outside R are typically in R much sooner than t_R; typical are states drawn from
    a box.
    """
    kept = figures()
    rows = "; ".join(
        f"alpha = {one['alpha']}: median {one['median']:g}, greatest {one['greatest']:g} of"
        f" {one['starts']} starts"
        for one in kept["region"]
    )
    (low, high), (slow, fast) = HEIGHTS, SPEEDS
    return Simulated(
        f"time in parts of t_R: {rows}; uniform in {low} < x < {high}, {slow} < w < {fast}, seed"
        f" {kept['seed']}",
        agrees=all(one["median"] < 1 / 10 for one in kept["region"]),
    )
