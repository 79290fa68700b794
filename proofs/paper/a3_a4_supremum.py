"""Appendices A.3 and A.4: the supremum of the energy change outside the region R, where it lies,
and how many impacts lead into R.
"""

from __future__ import annotations

from juggleproof.judging.claims import Assertion, Reading, Readings, Remark
from juggleproof.proofs.paper.names import (
    B1,
    B1_OUTSIDE,
    BEYOND_R,
    CLOSED_B1,
    CORNER,
    ON_R,
    H,
    R,
    alpha,
    always,
    at,
    b,
    beta,
    claim,
    derived,
    derived_vector,
    energy,
    exists_some,
    g,
    impact_energy_change,
    next_states,
    only_at,
    paper_names,
    r,
    strikes_at,
    t,
    v,
)
from juggleproof.proofs.paper.regions import (
    BOUNDED,
    LEFT,
    NEAR,
    PRINTED_SUPREMUM,
    SUPREMAL,
    WITHIN_DELTA,
    b_0,
    beta0,
    change,
    dE_sup,
    delta,
    edge,
    is_boundary_of_R,
    least,
    not_supremal,
    not_supremal_above_the_ground,
    pieces,
    room,
    state_on_the_level,
    v0,
)
from juggleproof.proofs.paper.s4_2_proposition import OF_THE_LOSS, is_enough
from juggleproof.proofs.paper.states import (
    STEEP,
    are_slopes,
    dE_dbeta,
    dE_dv,
    dR_dbeta,
    dR_dv,
    relations_of,
    with_slopes,
)
from juggleproof.reading.meaning import Printed
from juggleproof.reading.parser import parse_name
from juggleproof.reading.values import ExtremalValue, Region, Value, Vector, scalar
from juggleproof.statements.language import (
    ClaimError,
    Formula,
    Statement,
    Term,
    conjunction,
    equal,
    iff,
    reals,
    term,
)

# -------------------------------------------------------------------------------------------------
# Appendix A.3: how little an impact takes outside the region R, at least.

lam, height, h, supremum = reals("lam height h supremum")
AT_CORNER = (
    paper_names()
    .at(parse_name(r"\overline b"), b_0)
    .extended({r"\overline b_s": b_0, r"\Delta E_{sup}": dE_sup})
)
MULTIPLIED = with_slopes(paper_names(), b_0).extended({r"\lambda": lam, r"\overline b_s": b_0})


def is_least_bound(
    value: Term, region: Region, given: list[Formula]
) -> tuple[Statement, Statement]:
    """The value bounds the energy change of the impacts from the region, and above the corner that
    falls from it steadily, so that it comes as close as one likes.
    """
    above = Vector((height, v0))
    falls = equal(impact_energy_change(above), value - (1 + alpha) * g * height)
    return (
        always(change < value, given=[*given, region(b)], label="bound"),
        always(
            region(above) & falls,
            given=[*given, height > 0, g * height <= r**2],
            label="approached",
        ),
    )


@claim(
    "sA.3-sup",
    "A.3",
    "line 679",
    printed=r"\Delta E_{sup} = \sup_{\overline{b} \in \mathcal{H} - \mathcal{R}}"
    r" \Delta E(\overline{b})",
    as_it_stands=r"\Delta E \text{ on the } \mathcal{A} - \mathcal{R} \text{ region}",
    mended=r"\Delta E_{sup} = \sup_{\overline{b} \in \mathcal{B}_1 - \mathcal{R}}"
    r" \Delta E(\overline{b})",
)
def supremum_outside_the_region(printed: Printed) -> list[Statement]:
    """The energy change at the corner of R, Delta E_sup, is the supremum over the states of this
    set, with or without an impact.
    """
    next_one, suprema = Vector(reals("beta1 v1")), list[tuple[Formula, Term]]()

    def value(found: ExtremalValue) -> Term:
        if found.sign != r"\sup" or found.condition is None:
            raise ClaimError(f"{found.sign} stands where a supremum under a condition is expected")
        suprema.append((found.condition, term(scalar(found.value))))
        return supremum

    in_a_period = only_at(b, energy(next_one) - energy(b))
    names: dict[str, Value] = {
        r"\Delta E_{sup}": least,
        r"\Delta E": in_a_period,
        r"\sup_{\cdot} \cdot": value,
    }
    ((bound, sign, of),) = relations_of(printed, paper_names().extended(names), 1)
    if sign != "=" or of is not supremum:
        raise ClaimError("a value that equals a supremum is expected here")
    ((inside, changes),) = suprema
    region, given = Region(lambda state: at(inside, state)), [CORNER(b_0)]
    _, approached = is_least_bound(term(scalar(bound)), region & B1, given)
    below = changes < term(scalar(bound))
    return [
        always(below, given=[*given, inside, next_states(b, next_one)], label="bound"),
        approached,
    ]


ON_THE_LEVEL = state_on_the_level(v0)
GRADIENTS = [
    [term(entry) for entry in at(derived_vector(name), ON_THE_LEVEL).entries]
    for name in ("energy_gradient", "region_gradient")
]


def must_satisfy(condition: Formula) -> Statement:
    """A supremal state on R(b) = 0 satisfies the condition with the one multiplier that fits the
    slopes with the height.
    """
    (down, _), (dR_down, _) = GRADIENTS
    supremal = equal(impact_energy_change(ON_THE_LEVEL), derived("delta_E_sup"))
    fits = equal(down, lam * dR_down)
    return always(condition, given=[CLOSED_B1(ON_THE_LEVEL), supremal, fits])


def parallel_or_on_the_ground() -> Statement:
    """A supremal state on R(b) = 0 has parallel gradients, or is on the ground."""
    (down, along), (dR_down, dR_along) = GRADIENTS
    parallel = equal(down, lam * dR_down) & equal(along, lam * dR_along)
    return must_satisfy(parallel | equal(ON_THE_LEVEL.component(1), 0))


@claim(
    "eq-38",
    "A.3.1",
    "(38)",
    printed=(
        r"D_{\overline{\beta}} \Delta_1 E(\overline{b}_s) = \lambda D_{\overline{\beta}}"
        r" R(\overline{b}_s) \\ "
        r"D_{\dot{\overline{\beta}}} \Delta_1 E(\overline{b}_s) = \lambda"
        r" D_{\dot{\overline{\beta}}} R(\overline{b}_s)"
    ),
    as_it_stands=(
        r"D_{\overline{\beta}} \Delta_1 E(\overline{b}_s) = \lambda D_{\overline{\beta}}"
        r" R(\overline{b}_s) \\ "
        r"D_{\overline{\beta}} \Delta_1 E(\overline{b}_s) = \lambda D_{\overline{\beta}}"
        r" R(\overline{b}_s)"
    ),
    true_nearby=(r"\text{(38) or } \overline{\beta} = 0", parallel_or_on_the_ground),
    remark=Remark(
        "This is the step of A.3.1 that does not follow: on R(b) = 0 within H a supremal state is"
        " stationary unless it is an end point of that arc, and the corner (39) is one.",
        by=("sA.3.2-corner",),
    ),
)
def condition_on_the_boundary(printed: Printed) -> Statement:
    """A state with R(b) = 0, in B1 or on the line between B1 and B2, that has the energy change
    Delta E_sup satisfies this for some multiplier: the one that fits the slopes with the height.
    """
    (down, along), (dR_down, dR_along) = GRADIENTS
    names: dict[str, Value] = {
        r"\overline b_s": ON_THE_LEVEL,
        r"D_{\overline\beta} \Delta_1 E": only_at(ON_THE_LEVEL, down),
        r"D_{\dot{\overline\beta}} \Delta_1 E": only_at(ON_THE_LEVEL, along),
        r"D_{\overline\beta} R": only_at(ON_THE_LEVEL, dR_down),
        r"D_{\dot{\overline\beta}} R": only_at(ON_THE_LEVEL, dR_along),
    }
    return must_satisfy(printed.formula(MULTIPLIED.extended(names)))


@claim(
    "sA.3.1-DR",
    "A.3.1",
    "line 690",
    printed=r"D_{\overline{\beta}} R(\overline{b}) = -\gamma \text{ and } "
    r"D_{\dot{\overline{\beta}}} R(\overline{b}) = -\dot{\overline{\beta}}.",
)
def slopes_of_the_region(printed: Printed) -> Statement:
    """How R(b) varies with height and velocity."""
    return always(printed.formula(STEEP), given=[are_slopes(dR_dbeta, dR_dv)])


@claim(
    "sA.3.1-35",
    "A.3.1",
    "line 694",
    printed=r"D_{\overline{\beta}} \Delta_1 E = -\alpha\gamma - \gamma",
    as_it_stands=r"D_{\overline{B}} \Delta_1 E = -\alpha \gamma - \gamma",
    repeats="eq-35",
)
def slope_with_the_height_recalled(printed: Printed) -> Statement:
    """How the energy change of an impact falls with the height, once more."""
    return always(printed.formula(STEEP), given=[are_slopes(dE_dbeta)])


@claim("sA.3.1-lambda", "A.3.1", "line 696", printed=r"\lambda = \alpha + 1")
def multiplier(printed: Printed) -> Statement:
    """The slopes with the height leave one multiplier only."""
    parallel = equal(dE_dbeta, lam * dR_dbeta)
    return always(
        iff(parallel, printed.formula(MULTIPLIED)),
        given=[are_slopes(dE_dbeta, dR_dbeta, state=b_0)],
    )


@claim(
    "sA.3.1-36",
    "A.3.1",
    "line 698",
    repeats="eq-36",
    printed=r"D_{\dot{\overline{\beta}}} \Delta_1 E = "
    r"-\alpha\gamma T - (1-\alpha^2) \dot{\overline{\beta}} - \alpha(\alpha-1) \dot{\rho}_0",
    as_it_stands=r"D_{\dot{\overline{B}}} \Delta_1 E = "
    r"-\alpha \gamma T - (1-\alpha^2) \dot{\overline{B}} - \alpha (\alpha - 1) \dot{\rho}_0",
)
def slope_with_the_velocity_recalled(printed: Printed) -> Statement:
    """How the energy change of an impact varies with the velocity, once more."""
    return always(printed.formula(STEEP), given=[are_slopes(dE_dv)])


@claim("sA.3.1-not-satisfied", "A.3.1", "line 700", printed=r"\lambda = \alpha + 1")
def multiplier_does_not_fit(printed: Printed) -> Readings:
    """With this multiplier the gradients are nowhere parallel on R(b) = 0: nowhere in B1 or on the
    line between B1 and B2, or nowhere at all.
    """
    parallel = equal(dE_dbeta, lam * dR_dbeta) & equal(dE_dv, lam * dR_dv)
    slopes = are_slopes(dE_dbeta, dE_dv, dR_dbeta, dR_dv, state=b_0)
    on_curve = [H(b_0), ON_R(b_0), slopes]
    everywhere = [*on_curve, printed.formula(MULTIPLIED)]
    return Readings(
        {
            "in-closed-B1": Reading(
                Assertion((always(~parallel, given=[*on_curve, CLOSED_B1(b_0)]),)),
                "A.4 says the closure of B1 - R",
            ),
            "everywhere": Reading(
                Assertion((always(~parallel, given=everywhere),)), "A.3.1 says on R(b) = 0"
            ),
        }
    )


ABOVE_THE_GROUND = (
    r"R(\overline{b}) = 0 \text{ and } \overline{\beta} > 0",
    not_supremal_above_the_ground,
)


@claim(
    "sA.3.1-not-on-R0",
    "A.3.1",
    "lines 681 and 700",
    printed=r"R(\overline{b}) = 0",
    true_nearby=ABOVE_THE_GROUND,
)
def supremum_is_not_on_the_boundary(printed: Printed) -> Statement:
    """No state with R(b) = 0, in B1 or on the line between B1 and B2, has the energy change Delta
    E_sup, which A.3.2 finds at such a state.
    """
    return not_supremal(printed.formula(paper_names()))


@claim(
    "sA.3.2-leftmost",
    "A.3.2",
    "line 702",
    printed=r"\overline{\beta} = 0",
    remark=Remark(
        "The line alone is not all of the leftmost boundary: to the left of some states lies R.",
        lambda: exists_some(
            ["beta", "v"],
            ~BEYOND_R(Vector((0, v))),
            within=[B1_OUTSIDE(b)],
            label="left-of-it-is-R",
        ),
    ),
)
def leftmost_states(printed: Printed) -> list[Statement]:
    """The leftmost boundary of the impacts outside R is the edge of H, besides the arc of R(b) = 0,
    which A.3.1 considers.

    From any such state a move to the left at the same velocity ends there, and raises the energy
    change; to the left of the arc lies R.
    """
    edge_of_h = printed.formula(paper_names().extended({r"\overline\beta": edge}))
    still_outside = at(derived("region_margin"), LEFT) <= 0
    raised = change <= impact_energy_change(LEFT)
    return [
        exists_some(
            ["edge"],
            conjunction([edge_of_h | ON_R(LEFT), still_outside, B1(LEFT), raised]),
            within=[edge >= 0, edge <= beta],
            given=[B1_OUTSIDE(b)],
        ),
        always(R(LEFT), given=[ON_R(b), edge >= 0, edge < beta], label="left-of-the-arc"),
    ]


@claim("sA.3.2-concave", "A.3.2", "line 702", printed=r"\alpha^2 - 1 < 0 \\ 0 \le \alpha < 1")
def energy_change_is_concave_on_the_edge(printed: Printed) -> list[Statement]:
    """For these alpha this number is negative: the second derivative of the energy change on the
    edge, which is concave there.
    """
    negative, physical = pieces(printed, 2)
    second = scalar(negative.left(paper_names()))
    before, here, after = (
        term(impact_energy_change(Vector((0, speed)))) for speed in (v - h, v, v + h)
    )
    return [
        always(
            negative.formula(paper_names()),
            in_range=[physical.formula(paper_names())],
            label="negative",
        ),
        always(equal(before - 2 * here + after, second * h**2), label="second-derivative"),
    ]


@claim(
    "sA.3.2-corner", "A.3.2", "line 702", printed=r"R(\overline{b}) = 0, \quad \overline{\beta} = 0"
)
def supremum_belongs_to_the_corner(printed: Printed) -> list[Statement]:
    """The supremum is the energy change where the level line of R meets the edge of H, at the
    boundary of the impacts outside R.
    """
    return list(is_least_bound(least, B1_OUTSIDE, [CLOSED_B1(b_0), printed.formula(AT_CORNER)]))


@claim(
    "eq-39",
    "A.3.2",
    "(39)",
    printed=(
        r"\overline{\beta} = 0 \\ \dot{\overline{\beta}} = -\sqrt{2(1+\alpha)}"
        r" \frac{\dot{\rho}_0}{1-\alpha}"
    ),
)
def corner_of_the_region(printed: Printed) -> Statement:
    """The only state of B1 on the ground and on the level line of R."""
    return always(iff(CORNER(b), printed.formula(paper_names())))


@claim("sA.3.2-tau-zero", "A.3.2", "line 708", printed=r"\tau_c = 0")
def corner_strikes_at_once(printed: Printed) -> Statement:
    """From the corner the ball strikes the table at once."""
    return always(
        iff(strikes_at(t), printed.formula(paper_names().extended({r"\tau_c": only_at(b, t)}))),
        given=[CORNER(b)],
    )


@claim("sA.3.2-sup1", "A.3.2", "line 710", printed=r"\Delta E_{sup} := \Delta_1 E(\overline{b}_s)")
def supremum_is_the_energy_change_at_the_corner(printed: Printed) -> list[Statement]:
    """The energy change at the corner is the supremum over the impacts outside R, and is not
    attained there.
    """
    names = paper_names().extended({r"\overline b_s": b_0})
    return [
        always(printed.formula(names), given=[CORNER(b_0)], label="value"),
        *is_least_bound(term(scalar(printed.right(names))), B1_OUTSIDE, [CORNER(b_0)]),
    ]


@claim(
    "sA.3.2-sup2",
    "A.3.2",
    "line 710",
    printed=r"\Delta E_{sup} = "
    r"\frac{1}{2} [-\alpha \dot{\overline{\beta}} + (1+\alpha) \dot{\rho}_0]^2 - \frac{1}{2}"
    r" \dot{\overline{\beta}}^2",
)
def supremum_by_the_velocity(printed: Printed) -> Statement:
    """The energy change at the corner, by its velocity."""
    return always(printed.formula(AT_CORNER), given=SUPREMAL)


@claim(
    "sA.3.2-sup3",
    "A.3.2",
    "line 710",
    derived=lambda: term(derived("delta_E_sup")),
    printed=PRINTED_SUPREMUM,
    remark=Remark(
        "This value enters (26). With the printed one the number of impacts is too small for great"
        " alpha, also when rounded up; with the corrected one, rounded up, it is enough.",
        by=("eq-26", "theorem-count"),
    ),
)
def supremum_by_alpha(printed: Printed) -> Statement:
    """The supremum, which is that of sA.3.2-sup1, by alpha and the table's launch velocity."""
    return always(printed.formula(paper_names()))


@claim("sA.3.2-sup4", "A.3.2", "line 710", printed=r"\Delta E_{sup} < 0")
def supremum_is_negative(printed: Printed) -> Statement:
    """The energy change at the corner is negative."""
    return always(printed.formula(AT_CORNER), given=SUPREMAL)


@claim(
    "sA.3.2-strict",
    "A.3.2",
    "line 712",
    printed=(
        r"\forall \overline{b} \in \mathcal{B}_1 - \mathcal{R}, \Delta E(\overline{b}) < \Delta"
        r" E_{sup}"
    ),
    as_it_stands=r"\forall \overline{b} \in \beta_1 - R, \Delta E(\overline{b}) < \Delta E_{sup}",
)
def impacts_outside_take_more(printed: Printed) -> Statement:
    """Every impact outside R takes more than at the corner."""
    return always(
        printed.formula(
            paper_names().extended({r"\Delta E": impact_energy_change, r"\Delta E_{sup}": least})
        ),
        given=[CORNER(b_0)],
    )


# -------------------------------------------------------------------------------------------------
# Appendix A.4: where the supremum lies, and how many impacts lead into the region R.


@claim("sA.4-distinct", "A.4", "line 716")
def supremum_and_maximum_differ() -> Statement:
    """Delta E_sup, the energy change at the corner of R, and Delta E_max are different: one is
    negative and the other positive.
    """
    return always((dE_sup < 0) & (term(derived("delta_E_max")) > 0), given=SUPREMAL)


@claim("sA.4-leftmost", "A.4", "line 716", repeats="sA.3.2-leftmost")
def supremum_is_at_the_left() -> list[Statement]:
    """An impact outside R takes less from the leftmost state of the same velocity, on the edge of H
    or on the arc of R(b) = 0, so that the supremum is at the left.
    """
    ground = Vector((0, v))
    return [
        always(
            B1_OUTSIDE(ground) & (impact_energy_change(ground) > change),
            given=[B1_OUTSIDE(b), beta > 0, BEYOND_R(ground)],
            label="down-to-the-edge",
        ),
        exists_some(
            ["edge"],
            conjunction([B1(LEFT), ON_R(LEFT), impact_energy_change(LEFT) > change]),
            within=[edge >= 0, edge < beta],
            given=[B1_OUTSIDE(b), ~BEYOND_R(ground)],
            label="down-to-the-arc",
        ),
    ]


@claim(
    "sA.4-open",
    "A.4",
    "line 716",
    remark=Remark(
        "Open in H: in the plane the set is not open, since it holds states of the edge of H.",
        lambda: exists_some(
            ["v"], B1_OUTSIDE(Vector((0, v))), within=[v < 0], label="some-on-the-edge"
        ),
    ),
)
def impacts_outside_are_open() -> list[Statement]:
    """The states of B1 outside R are an open set in H."""
    margins = {
        "collision": at(derived("collision_margin"), b),
        "energy": -term(at(derived("region_margin"), b)),
    }
    # What is room for a delta is room for every smaller one, so that one delta serves both margins.
    rooms = [
        exists_some(
            ["delta"],
            room(margin),
            within=[delta > 0],
            given=[B1_OUTSIDE(b), *BOUNDED],
            label=f"room-for-{name}",
        )
        for name, margin in margins.items()
    ]
    near = always(
        B1_OUTSIDE(NEAR),
        given=[B1_OUTSIDE(b), *BOUNDED, *WITHIN_DELTA, room(*margins.values()), H(NEAR)],
        label="all-near",
    )
    return [*rooms, near]


@claim("sA.4-boundary", "A.4", "line 716", printed=r"R(\overline{b}) = 0", as_it_stands=r"R(b) = 0")
def boundary_of_the_region(printed: Printed) -> list[Statement]:
    """The boundary of R, as a set of states of H, is where R(b) = 0: there states of R and states
    outside R lie as near as one likes.
    """
    return is_boundary_of_R(printed.formula(paper_names()))


@claim(
    "sA.4-not-on-boundary",
    "A.4",
    "line 716",
    repeats="sA.3.1-not-on-R0",
    true_nearby=ABOVE_THE_GROUND,
)
def supremum_is_not_on_the_boundary_of_the_region() -> Statement:
    """The supremum, Delta E_sup, is the energy change of no state with R(b) = 0 that is in B1 or on
    the line between B1 and B2.
    """
    return not_supremal(ON_R(b))


@claim(
    "sA.4-on-edge",
    "A.4",
    "line 716",
    printed=r"\overline{\beta} = 0",
    as_it_stands=r"\overline{b} = 0",
    repeats="sA.3.2-corner",
)
def supremum_is_on_the_edge_and_negative(printed: Printed) -> list[Statement]:
    """The supremum over the impacts outside R is the energy change of a state on the edge of H with
    R(b) = 0, and is negative.
    """
    there = [
        CLOSED_B1(b_0),
        ON_R(b_0),
        printed.formula(paper_names().extended({r"\overline\beta": beta0})),
    ]
    return [
        always(least < 0, given=there, label="negative"),
        *is_least_bound(least, B1_OUTSIDE, there),
    ]


@claim("sA.4-each-impact", "A.4", "line 718")
def each_impact_takes_the_least_loss() -> Statement:
    """Each impact outside R changes the energy by Delta E_sup at most, which is the energy change
    at the corner of R.
    """
    return always(change <= least, given=[CORNER(b_0), B1_OUTSIDE(b)])


@claim(
    "sA.4-count",
    "A.4",
    "lines 718 to 722",
    repeats="s4.2-count",
    printed=r"[\frac{E(\overline{b}_0) - E_{max} - \Delta E_{max}}{-\Delta E_{sup}}]",
    remark=OF_THE_LOSS,
)
def impacts_to_enter_the_region(printed: Printed) -> Readings:
    """So many impacts, with the derived least loss outside R, lead from b_0 into R, the number
    rounded down or rounded up.
    """
    return is_enough(printed)
