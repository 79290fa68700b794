"""Section 3.5: fixed points of the composites of the map, for which periods they exist, and whether
they are stable.
"""

from __future__ import annotations

from fractions import Fraction

from juggleproof.judging.claims import Argument, Assertion, Reading, Readings, Remark
from juggleproof.proofs.paper.names import (
    B1,
    B2,
    H,
    K,
    T,
    alpha,
    always,
    at,
    b,
    ball_at,
    beta,
    claim,
    collide,
    derived,
    derived_matrix,
    derived_vector,
    equals,
    exists_some,
    f1,
    f2,
    flight_matrix,
    height,
    is_maximum,
    meanings,
    next_states,
    paper_names,
    r,
    speed,
    t,
    table_at,
    v,
    vector,
)
from juggleproof.proofs.paper.regions import floor_of, with_rounding
from juggleproof.proofs.paper.states import (
    always_integer,
    b_0,
    comes_back,
    composite,
    cycle,
    eigenvalue_of,
    exists_integer,
    flights,
    from_threshold_on,
    function_of,
    next_state_is,
    power_of_flight,
    relations_of,
    strikes_from,
    struck,
    within,
)
from juggleproof.reading.evaluation import Environment, relate
from juggleproof.reading.lexer import PrintError
from juggleproof.reading.meaning import Meaning, Printed
from juggleproof.reading.tree import Chain
from juggleproof.reading.values import ExtremalValue, Matrix, Region, Vector, scalar
from juggleproof.statements.language import (
    AnyStatement,
    ClaimError,
    Formula,
    Iterates,
    Number,
    Statement,
    Term,
    conjunction,
    different,
    disjunction,
    equal,
    iff,
    reals,
    substitute,
    term,
)

# -------------------------------------------------------------------------------------------------
# Section 3.5.1: fixed points of f and of its composites, what they ask of ball and table, and for
# which periods they exist.

n, k, m, u, y, tau = reals("n k m u y tau")
beta_0, v_0 = b_0
UP_AGAIN = equal(
    height(ball_at(K * T, Vector((y, u)))), y
)  # a ball that leaves height y at speed u is back there after K periods
POWERS = paper_names().extended({r"\overline f_2^{\cdot}": flights})


@claim("s3.5-fixed-points-of-f", "3.5", "line 382")
def many_fixed_points() -> Readings:
    """There are further fixed points besides e_1: of the map itself; or of composites, as states
    that come back after two periods are.
    """
    differ = disjunction(
        [different(term(one), term(other)) for one, other in zip(b, b_0, strict=True)]
    )
    two = exists_some(
        ["beta", "v", "beta0", "v0"], next_states(b, b) & next_states(b_0, b_0) & differ
    )
    back = exists_some(
        ["beta", "v"],
        B1(b) & B2(f1(b)) & comes_back(2),
        in_range=[alpha >= Fraction(1, 3), alpha < 1],
    )
    return Readings(
        {
            "of-f": Reading(Assertion((two,)), "section 3.5 says fixed points of f"),
            "of-composites": Reading(
                Assertion((back,)), "section 3.5.1 calls fixed points what the composites keep"
            ),
        }
    )


@claim(
    "s3.5.1-composite",
    "3.5.1",
    "line 384",
    printed=r"\overline{f}_1 \circ \overline{f}_2^{K-1}",
    as_it_stands=r"\overline{f}_1 o \overline{f}_2^{K-1}",
)
def composites_have_one_fixed_point(printed: Printed) -> list[AnyStatement]:
    """For every K, exactly one state comes back after K - 1 periods of flight and one with an
    impact; so does that where the impact is.
    """
    composite = function_of(printed, POWERS)
    fixed, fixed_0 = equals(vector(composite(b)), b), equals(vector(composite(b_0)), b_0)
    one, many = (tuple(term(entry) for entry in ball_at(count * T)) for count in (1, K))
    return [
        Iterates("flights", ("beta", "v"), one, "K", many, ("T", "g")),
        exists_integer(["beta", "v"], fixed, label="exists"),
        always_integer(equal(v, term(v_0)), given=[fixed, fixed_0], label="one-speed"),
        always_integer(
            equal(beta, term(beta_0)),
            given=[fixed, fixed_0, equal(v, term(v_0))],
            label="one-height",
        ),
        always_integer(
            comes_back(K, vector(flights(K - 1)(b))), given=[fixed], label="begun-at-the-impact"
        ),
    ]


@claim("s3.5.1-once-in-K", "3.5.1", "line 384", parameters=("alpha", "K"))
def one_impact_in_k_periods() -> list[Statement]:
    """From alpha = (K - 1)/(K + 1) on, the state that comes back after K periods lies in B1, and
    the K - 1 states after it in B2.
    """
    return [
        always_integer(B1(b), given=[comes_back(K)], in_range=from_threshold_on(), label="impact"),
        always_integer(
            B2(vector(flights(n)(f1(b)))),
            given=[comes_back(K), n >= 0, n <= K - 2],
            in_range=from_threshold_on(),
            label="flights",
        ),
    ]


@claim("s3.5.1-two-conditions", "3.5.1", "line 386")
def two_conditions_make_the_orbit_of_k_periods() -> Statement:
    """A state whose impact comes within the period comes back after K periods exactly if the impact
    leaves the ball so fast that its flight lasts K periods, and turns its speed round.
    """
    before, after = speed(ball_at(t)), speed(struck(b, t))
    back = equal(height(ball_at(K * T, struck(b, t))), height(struck(b, t)))
    return always_integer(
        iff(comes_back(K), back & equal(after, -before)), given=[strikes_from(b, t)]
    )


@claim("s3.5.1-tf", "3.5.1", "line 386", printed=r"t_f = 2\beta/\gamma")
def time_of_flight(printed: Printed) -> Statement:
    """A ball is back at the height that it left after this time, and at no other time but that of
    leaving.
    """
    names = {"t_f": tau, r"\beta": y, r"\dot\beta": u}
    back = equal(height(ball_at(tau, Vector((y, u)))), y)
    return always(
        iff(back, printed.formula(paper_names().extended(names))), given=[different(tau, 0)]
    )


@claim("s3.5.1-tf-KT", "3.5.1", "line 386", printed="t_f = KT")
def flight_lasts_k_periods(printed: Printed) -> Statement:
    """On an orbit with one impact in K periods, the ball is back at the height of an impact K
    periods later.
    """
    back = equal(height(ball_at(tau, struck(b, t))), height(struck(b, t)))
    return always_integer(
        iff(back, printed.formula(paper_names().extended({"t_f": tau}))),
        given=[comes_back(K), strikes_from(b, t), different(tau, 0)],
    )


@claim("s3.5.1-beta-dot", "3.5.1", "line 388", printed=r"\dot{\beta} = \frac{1}{2} K \gamma T")
def speed_after_the_impact(printed: Printed) -> list[Statement]:
    """The flight lasts K periods exactly for this launch speed, which the ball has on the orbit
    that comes back after K periods.
    """
    return [
        always_integer(
            iff(UP_AGAIN, printed.formula(paper_names().extended({r"\dot\beta": u}))),
            label="flight",
        ),
        always_integer(
            printed.formula(paper_names().extended({r"\dot\beta": speed(struck(b, t))})),
            given=[comes_back(K), strikes_from(b, t)],
            label="on-the-orbit",
        ),
    ]


@claim(
    "eq-17",
    "3.5.1",
    "(17)",
    printed=(
        r"\dot{\rho}(\tau_c) = \frac{1}{2} \frac{1-\alpha}{1+\alpha} K \gamma T ="
        r" \frac{1-\alpha}{1+\alpha} K \dot{\rho}_0"
    ),
)
def table_speed_at_the_impact(printed: Printed) -> list[Statement]:
    """An impact turns the speed of a flight of K periods round exactly if the table moves at this
    speed; on the orbit, it does.
    """
    (_, sign, value), again = relations_of(
        printed, paper_names().extended({r"\dot\rho(\tau_c)": m}), 2
    )

    turned = equal(speed(vector(collide(Vector((y, m)))(Vector((y, -u))))), u)
    return [
        always_integer(iff(turned, relate(m, sign, value)), given=[UP_AGAIN], label="balance"),
        always_integer(
            relate(speed(table_at(t)), sign, value),
            given=[comes_back(K), strikes_from(b, t)],
            label="on-the-orbit",
        ),
        always_integer(relate(*again), label="in-launch-speeds"),
    ]


@claim("s3.5.1-exists", "3.5.1", "line 397")
def fast_table_has_the_orbit() -> list[Statement]:
    """Exactly if the table has the speed that (17) asks for at some time of its period, a state of
    B1 comes back after K periods.
    """
    needed = term(derived("subharmonic_table_speed"))
    return [
        exists_integer(
            ["beta", "v"],
            comes_back(K) & B1(b),
            given=[t >= 0, t < T, equal(speed(table_at(t)), needed)],
            label="if",
        ),
        exists_integer(
            ["t"],
            (t >= 0) & (t < T) & equal(speed(table_at(t)), needed),
            given=[comes_back(K), B1(b)],
            label="only-if",
        ),
    ]


@claim("s3.5.1-rho-dot-limited", "3.5.1", "line 397")
def table_is_fastest_at_its_launch() -> list[Statement]:
    """Within its period the table is never faster than at its launch."""
    return is_maximum(r, speed(table_at(t)), {"t": t}, {"t": 0}, (t >= 0) & (t < T))


def longest_period(printed: Printed) -> list[Statement]:
    """There is an orbit for K exactly up to what stands in the bracket, which, rounded down, is the
    last such K.
    """
    greatest: list[tuple[Formula, Term]] = []

    def value(found: ExtremalValue) -> Term:
        if found.sign != r"\max" or found.condition is None:
            raise ClaimError(
                f"{found.sign} stands where the greatest value under a condition is expected"
            )
        greatest.append((found.condition, term(scalar(found.value))))
        return m

    environment, inside = with_rounding(
        printed,
        paper_names().extended({"K_{max}": k, r"\dot\rho": y, r"\max_{\cdot} \cdot": value}),
    )
    known: list[Formula] = []
    parts: list[Statement] = []
    for condition, of in greatest[:1]:
        known = [equal(m, substitute(of, {"y": r}))]
        parts = is_maximum(m, of, {"y": y}, {"y": r}, condition, given=known)
    longest = iff(printed.formula(environment), (k <= inside) & (inside < k + 1))
    return [
        *parts,
        always_integer(iff(B1(b), K <= inside), given=[*known, comes_back(K)], label="orbits"),
        always_integer(longest, given=[*known, floor_of(inside)], label="longest"),
    ]


@claim(
    "eq-18a",
    "3.5.1",
    "(18)",
    printed=(
        r"K_{max} := [ \max_{\dot{\rho} \le \dot{\rho}_0} \frac{1+\alpha}{1-\alpha}"
        r" \frac{\dot{\rho}}{\dot{\rho}_0} ]"
    ),
    as_it_stands=(
        r"K_{max} := \left[ \max \left| \frac{1+\alpha}{\rho \leq \rho_0}"
        r" \frac{1+\alpha}{1-\alpha} "
        r"\frac{\dot{\rho}}{\rho_0} \right| \right]"
    ),
)
def longest_period_by_the_fastest_table(printed: Printed) -> list[Statement]:
    """The longest period of an orbit with one impact is what the fastest table allows by (17),
    rounded down to an integer.
    """
    return longest_period(printed)


@claim(
    "eq-18b",
    "3.5.1",
    "(18)",
    printed=r"K_{max} = [ \frac{1+\alpha}{1-\alpha} ]",
    as_it_stands=r"= \left[ \frac{1+\alpha}{1-\alpha} \right]",
)
def longest_period_by_the_restitution(printed: Printed) -> list[Statement]:
    """The longest period of an orbit with one impact is this function of the restitution, rounded
    down to an integer.
    """
    return longest_period(printed)


@claim("s3.5.1-note7", "3.5.1", "note 7", printed=r"\dot{\beta} > \dot{\rho}")
def no_second_impact_within_the_period(printed: Printed) -> list[Statement]:
    """After an impact the ball is faster than the table, and stays above it until the period is
    over.
    """
    after = struck(b, tau)
    names = {r"\dot\beta": speed(after), r"\dot\rho": speed(table_at(tau))}
    return [
        always(
            printed.formula(paper_names().extended(names)),
            given=[strikes_from(b, tau)],
            label="faster",
        ),
        always(
            height(ball_at(t - tau, after)) > height(table_at(t)),
            given=[strikes_from(b, tau), t > tau, t <= T],
            label="above",
        ),
    ]


# -------------------------------------------------------------------------------------------------
# Section 3.5.2: which restitutions allow which periods of orbits with one impact.

n, k = reals("n k")
BOUND = term(derived("subharmonic_bound"))  # the real number that K_max rounds


def threshold(count: int) -> Term:
    """The restitution from which on the fastest table can keep up flights of so many periods."""
    return term(derived("restitution_threshold", count))


@claim("eq-19", "3.5.2", "(19)", printed=r"K \le K_{max} < K + 1", parameters=("alpha", "K"))
def periods_up_to_k(printed: Printed) -> list[Statement]:
    """There are orbits for the periods up to K, and for no longer one, exactly if the bound,
    rounded down, lies between K and K + 1.
    """
    says = printed.formula(paper_names().extended({"K_{max}": n}))
    return [
        always_integer(iff(B1(b), K <= BOUND), given=[comes_back(K)], label="orbits"),
        always_integer(
            iff(says, (K <= BOUND) & (BOUND < K + 1)), given=[floor_of(BOUND)], label="longest"
        ),
    ]


@claim("eq-20", "3.5.2", "(20)", printed=r"\frac{K-1}{K+1} \le \alpha < \frac{K}{K+2}")
def restitution_for_periods_up_to_k(printed: Printed) -> list[Statement]:
    """For these restitutions K is the longest period: the left end is where the orbit for K begins
    to exist, the right that for K + 1.
    """
    from_k_on, to_next = (
        relate(left, sign, right) for left, sign, right in relations_of(printed, paper_names(), 2)
    )
    return [
        always_integer(
            iff(from_k_on & to_next, (K <= n) & (n < K + 1)),
            given=[floor_of(BOUND)],
            label="inserted",
        ),
        always_integer(iff(B1(b), from_k_on), given=[comes_back(K)], label="orbit-for-K"),
        always_integer(iff(~B1(b), to_next), given=[comes_back(K + 1)], label="none-for-the-next"),
    ]


@claim(
    "s3.5.2-set", "3.5.2", "line 410", printed=r"\{ e_k \mid k \le K \}", parameters=("alpha", "K")
)
def periods_that_exist(printed: Printed) -> Statement:
    """For the restitutions of (20), the orbits with one impact are those whose period is not above
    K.
    """
    meant = Environment({**meanings(), "k": k}, points={"e_k": ("k",)})
    held = Meaning(meant).of(printed.tree)
    if not isinstance(held, Region):
        raise ClaimError("a set of fixed points is expected here")
    return always_integer(
        iff(B1(b), held(Vector((n,)))),
        given=[n >= 1, comes_back(n)],
        in_range=[*from_threshold_on(K), ~conjunction(from_threshold_on(K + 1)[2:])],
    )


@claim("eq-21", "3.5.2", "(21)", printed=r"0 < \alpha < \frac{1}{3}")
def restitution_for_one_fixed_point(printed: Printed) -> list[Statement]:
    """These are the restitutions for which no period but one has an orbit with one impact."""
    single = printed.formula(paper_names())
    return [
        always_integer(
            ~B1(b), given=[K >= 2, comes_back(K)], in_range=[single], label="no-longer-period"
        ),
        always(single, given=[comes_back(2), ~B1(b)], label="only-these"),
    ]


@claim("s3.5.2-note8", "4.1", "note 8", printed=r"\alpha = 0")
def no_restitution_is_left_out(printed: Printed) -> Statement:
    """For K = 1, (20) also admits that value of the restitution, and (21) is (20) without it."""
    zero = printed.formula(paper_names())
    admitted = (threshold(1) <= alpha) & (alpha < threshold(2))
    return always(iff(admitted & ~zero, (alpha > 0) & (alpha < threshold(2))), in_range=[])


# -------------------------------------------------------------------------------------------------
# Section 3.5.3: the Jacobian of the composites, and the stability of their fixed points.

n, p, q, size, lift = reals("n p q size lift")


def is_jacobian(value: object, count: Number, label: str) -> Statement:
    """The matrix takes the difference of any two states to the difference of their images under the
    composite.
    """
    if not isinstance(value, Matrix):
        raise ClaimError("a matrix is expected here")
    difference = composite(count, b_0) - composite(count, b)
    return always_integer(equals(vector(value * (b_0 - b)), difference), label=label)


def for_every_k(printed: Printed) -> list[Statement]:
    """What is printed, for every integer K; a power with the exponent K of anything but A_t has a
    meaning for single K only.
    """
    chain = printed.tree
    if not isinstance(chain, Chain):
        raise ClaimError("an equation is expected here")
    meaning = Meaning(paper_names().extended({r"A_{\cdot}^{\cdot}": power_of_flight}))
    left = is_jacobian(meaning.here(chain.first), K, "left-side")
    try:
        return [left, is_jacobian(meaning.here(chain.rest[-1][1]), K, "right-side")]
    except PrintError:
        return [left]


@claim(
    "s3.5.3-jacobian",
    "3.5.3",
    "line 422",
    printed=r"-\alpha A_T^K = \begin{bmatrix} -\alpha & -\alpha T^K \\ 0 & -\alpha \end{bmatrix}",
)
def jacobian_of_the_composites(printed: Printed) -> list[AnyStatement]:
    """Both sides are the matrix of the composite for K, which is affine; and the power of A_T on
    the left is the repeated product.
    """
    one, many = (
        tuple(term(entry) for entry in vector(flight_matrix(count * T) * b)) for count in (1, K)
    )
    equations: list[AnyStatement] = []
    for count in (1, 2, 3):
        environment = paper_names().extended({"K": count})
        equations.append(always_integer(printed.formula(environment), label=f"equation-{count}"))
        equations.append(is_jacobian(printed.right(environment), count, f"right-side-{count}"))
    return [
        Iterates("powers", ("beta", "v"), one, "K", many, ("T",)),
        *for_every_k(printed),
        *equations,
    ]


@claim("s3.5.3-eigenvalues", "3.5.3", "line 424")
def eigenvalues_of_the_composites_lie_in_the_unit_circle() -> Statement:
    """For every K, each complex eigenvalue of the matrix of the composite is less than 1 in
    absolute value.
    """
    return always_integer(
        p**2 + q**2 < 1, given=[eigenvalue_of(derived_matrix("return_jacobian"), p, q)]
    )


@claim(
    "s3.5.3-stable-inside",
    "3.5.3",
    "line 424",
    parameters=("alpha", "K"),
    remark=Remark(
        "(20) includes the left end. There the fixed point is on the edge of H, and not stable.",
        by=("s3.5.3-locally-stable", "theorem-ends"),
    ),
)
def fixed_points_are_stable_inside_their_range() -> list[Statement]:
    """Where the fixed point lies above the edge of H, for alpha above the left end of its range
    (20), every small box around it has the same impact and flights, and comes back (1 + alpha)/2 as
    large.

    So the fixed point is stable there, and attracts the states near it.
    """
    center, middle = derived_vector("impact_fixed_point"), b_0
    edge, largest = term(center.component(1)), term(middle.component(1))

    def in_box(state: Vector, around: Vector, box: Term) -> Formula:
        up, ahead = (term(entry) for entry in state - around)
        return within(box, up) & within((1 - alpha) * box, 2 * alpha * K * T * ahead)

    def corner_at_most_on_the_line(around: Vector, box: Term) -> Formula:
        corner = around + Vector((box, (1 - alpha) * box / (2 * alpha * K * T)))
        return term(at(derived("collision_margin"), corner)) >= 0

    return [
        always_integer(comes_back(K, center), label="center"),
        always_integer(
            edge > 0,
            in_range=[alpha > 0, alpha < 1, alpha * (K + 1) > K - 1],
            label="there-are-boxes",
        ),
        always_integer(corner_at_most_on_the_line(center, edge), label="corner"),
        always_integer(
            B1(b),
            given=[
                size <= largest,
                in_box(b, middle, size),
                corner_at_most_on_the_line(middle, largest),
            ],
            label="impact",
        ),
        always_integer(
            in_box(cycle(K), center, (1 + alpha) / 2 * size) & H(cycle(K)),
            given=[size <= edge, in_box(b, center, size)],
            label="comes-back",
        ),
        always_integer(
            H(vector(flights(n)(b))),
            given=[H(b), H(vector(flights(K - 1)(b))), n >= 0, n <= K - 1],
            label="above-the-table",
        ),
        always(B2(b), given=[H(b), H(f2(b))], label="flights"),
    ]


@claim(
    "s3.5.3-locally-stable",
    "3.5.3",
    "line 424",
    parameters=("alpha", "K"),
    true_nearby=(
        "every fixed point is stable for which alpha is above the left end of its range (20)",
        fixed_points_are_stable_inside_their_range,
    ),
)
def fixed_points_are_stable_where_they_exist() -> Argument:
    """The eigenvalues make every fixed point stable that exists, also at the left end of its range
    (20).

    For that, the composite has to be what the map does around the fixed point: a state that lies a
    little higher must fly on as long. And from a state that lies a little higher the orbit has to
    come back near the fixed point after K periods.
    """
    lifted = b + Vector((lift, term(0)))
    flying = vector(flights(K - 2)(f1(lifted)))
    returns = B1(lifted) & next_state_is(flying, lambda state: within(r, speed(state) - speed(b)))

    def of_some_lift(formula: Formula) -> Assertion:
        return Assertion(
            (
                exists_integer(
                    ["lift"],
                    formula,
                    within=[lift > 0],
                    given=[K >= 2, comes_back(K)],
                    in_range=from_threshold_on(),
                ),
            )
        )

    eigenvalue = eigenvalue_of(derived_matrix("return_jacobian"), p, q)
    return Argument(
        steps={
            "eigenvalues": Assertion((always_integer(p**2 + q**2 < 1, given=[eigenvalue]),)),
            "same-pieces": of_some_lift(B1(lifted) & B2(flying)),
        },
        conclusion=of_some_lift(returns),
    )
