"""Section 3.5.1: fixed points of f and of its composites, what they ask of ball and table, and for
which periods they exist.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from certificates.statements import AnyStatement, Iterates, Statement
from certificates.terms import (
    ClaimError,
    Formula,
    Term,
    different,
    disjunction,
    equal,
    iff,
    reals,
    substitute,
    term,
)
from proofs.claims import Assertion, Readings, claim
from proofs.paper.events import ball_at, height, speed, table_at, vector
from proofs.paper.orbits import (
    always_integer,
    b_0,
    comes_back,
    exists_integer,
    flights,
    from_threshold_on,
    function_of,
    relations_of,
    strikes_from,
    struck,
)
from proofs.paper.outside import ceiling_of, floor_of, with_rounding
from proofs.paper.vocabulary import (
    B1,
    B2,
    PAPER,
    K,
    T,
    alpha,
    always,
    b,
    beta,
    collide,
    derived,
    equals,
    exists_some,
    f1,
    is_maximum,
    next_states,
    r,
    t,
    v,
)
from proofs.reading.notions import ExtremalValue
from proofs.reading.printed import Printed
from proofs.reading.relations import relate
from proofs.reading.values import Vector

n, k, m, u, y, tau = reals("n k m u y tau")
beta_0, v_0 = b_0
UP_AGAIN = equal(
    height(ball_at(K * T, Vector((y, u)))), y
)  # a ball that leaves height y at speed u is back there after K periods
POWERS = PAPER.extended({r"\overline f_2^{\cdot}": flights})


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
        B1(b) & B2(vector(f1(b))) & comes_back(2),
        in_range=[alpha >= Fraction(1, 3), alpha < 1],
    )
    return Readings({"of-f": Assertion((two,)), "of-composites": Assertion((back,))})


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
            B2(vector(flights(n)(vector(f1(b))))),
            given=[comes_back(K), n >= 0, n <= K - 2],
            in_range=from_threshold_on(),
            label="flights",
        ),
    ]


@claim("s3.5.1-tf", "3.5.1", "line 386", printed=r"t_f = 2\beta/\gamma")
def time_of_flight(printed: Printed) -> Statement:
    """A ball is back at the height that it left after this time, and at no other time but that of
    leaving.
    """
    names = {"t_f": tau, r"\beta": y, r"\dot\beta": u}
    back = equal(height(ball_at(tau, Vector((y, u)))), y)
    return always(iff(back, printed.formula(PAPER.extended(names))), given=[different(tau, 0)])


@claim("s3.5.1-tf-KT", "3.5.1", "line 386", printed="t_f = KT")
def flight_lasts_k_periods(printed: Printed) -> Statement:
    """On an orbit with one impact in K periods, the ball is back at the height of an impact K
    periods later.
    """
    back = equal(height(ball_at(tau, struck(b, t))), height(struck(b, t)))
    return always_integer(
        iff(back, printed.formula(PAPER.extended({"t_f": tau}))),
        given=[comes_back(K), strikes_from(b, t), different(tau, 0)],
    )


@claim("s3.5.1-beta-dot", "3.5.1", "line 388", printed=r"\dot{\beta} = \frac{1}{2} K \gamma T")
def speed_after_the_impact(printed: Printed) -> list[Statement]:
    """The flight lasts K periods exactly for this launch speed, which the ball has on the orbit
    that comes back after K periods.
    """
    return [
        always_integer(
            iff(UP_AGAIN, printed.formula(PAPER.extended({r"\dot\beta": u}))), label="flight"
        ),
        always_integer(
            printed.formula(PAPER.extended({r"\dot\beta": speed(struck(b, t))})),
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
    (_, sign, value), again = relations_of(printed, PAPER.extended({r"\dot\rho(\tau_c)": m}), 2)

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


def longest_period(printed: Printed, rounded: Callable[[Term], Formula]) -> Assertion:
    """There is an orbit for K exactly up to what stands in the bracket, which, rounded in this way,
    is the last such K.
    """
    greatest: list[tuple[Formula, Term]] = []

    def value(found: ExtremalValue) -> Term:
        if found.sign != r"\max" or found.condition is None:
            raise ClaimError(
                f"{found.sign} stands where the greatest value under a condition is expected"
            )
        greatest.append((found.condition, term(found.value)))
        return m

    environment, inside = with_rounding(
        printed, PAPER.extended({"K_{max}": k, r"\dot\rho": y, r"\max_{\cdot} \cdot": value})
    )
    known: list[Formula] = []
    parts: list[Statement] = []
    for condition, of in greatest[:1]:
        known = [equal(m, substitute(of, {"y": r}))]
        parts = is_maximum(m, of, {"y": y}, {"y": r}, condition, given=known)
    longest = iff(printed.formula(environment), (k <= inside) & (inside < k + 1))
    return Assertion(
        (
            *parts,
            always_integer(iff(B1(b), K <= inside), given=[*known, comes_back(K)], label="orbits"),
            always_integer(longest, given=[*known, rounded(inside)], label="longest"),
        )
    )


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
def longest_period_by_the_fastest_table(printed: Printed) -> Readings:
    """The longest period of an orbit with one impact is what the fastest table allows by (17),
    rounded to an integer.
    """
    return Readings(
        {"floor": longest_period(printed, floor_of), "ceiling": longest_period(printed, ceiling_of)}
    )


@claim(
    "eq-18b",
    "3.5.1",
    "(18)",
    printed=r"K_{max} = [ \frac{1+\alpha}{1-\alpha} ]",
    as_it_stands=r"= \left[ \frac{1+\alpha}{1-\alpha} \right]",
)
def longest_period_by_the_restitution(printed: Printed) -> Readings:
    """The longest period of an orbit with one impact is this function of the restitution, rounded
    to an integer.
    """
    return Readings(
        {"floor": longest_period(printed, floor_of), "ceiling": longest_period(printed, ceiling_of)}
    )


@claim("s3.5.1-note7", "3.5.1", "note 7", printed=r"\dot{\beta} > \dot{\rho}")
def no_second_impact_within_the_period(printed: Printed) -> list[Statement]:
    """After an impact the ball is faster than the table, and stays above it until the period is
    over.
    """
    after = struck(b, tau)
    names = {r"\dot\beta": speed(after), r"\dot\rho": speed(table_at(tau))}
    return [
        always(
            printed.formula(PAPER.extended(names)), given=[strikes_from(b, tau)], label="faster"
        ),
        always(
            height(ball_at(t - tau, after)) > height(table_at(t)),
            given=[strikes_from(b, tau), t > tau, t <= T],
            label="above",
        ),
    ]
