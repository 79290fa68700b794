"""Claims on orbits: exact orbits, flights, where stability ends, and how near the bounds come to
the worst case.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from importlib import import_module
from types import ModuleType

from juggleproof.judging import forms
from juggleproof.proofs.paper.names import (
    B1,
    B2,
    STANDING,
    Placed,
    alpha,
    at,
    b,
    claim,
    derived,
    derived_vector,
    energy,
    equals,
    f1,
    f2,
    paper_names,
    s,
    w,
    x,
)
from juggleproof.proofs.paper.names import always as always_real
from juggleproof.proofs.paper.names import exists_some as exists_real
from juggleproof.proofs.paper.regions import LEVEL, PRINTED_SUPREMUM
from juggleproof.proofs.theorem.definition import (
    AT_IMPACTS,
    BELOW_A_THIRD,
    FIXED,
    IMPACT,
    NORMAL,
    PIECES,
    SPACE,
    SPEED,
    TO_THE_POINT,
    WHOLE,
    Descent,
    descends,
    holds_at,
    the_map,
    u,
    value_of,
)
from juggleproof.reading.meaning import read
from juggleproof.reading.values import Vector, scalar
from juggleproof.statements.language import (
    AnyStatement,
    ClaimError,
    Formula,
    Iterates,
    Term,
    conjunction,
    equal,
    iff,
    implies,
    reals,
    term,
)

# -------------------------------------------------------------------------------------------------
# Orbits in exact numbers with what the theorem's terms and formulas say of their states; the map
# itself is that of `juggleproof.scenes.juggler.exact`.

EXACT = "juggleproof.scenes.juggler.exact"  # loads SymPy, which few claims need
MAX_IMPACTS = 1000  # that an orbit is followed for
MAX_BITS = 20000  # of a numerator or denominator on an orbit


def exact() -> ModuleType:
    """The scene's map in exact numbers."""
    return import_module(EXACT)


@dataclass(frozen=True)
class ExactState:
    """A state of the normal form, with the restitution: exact numbers."""

    alpha: Fraction
    x: Fraction
    w: Fraction

    def point(self, **more: Fraction | int) -> dict[str, Fraction]:
        """The values of the names in terms and formulas of the normal form."""
        return {
            "alpha": self.alpha,
            "x": self.x,
            "w": self.w,
            **{name: Fraction(value) for name, value in more.items()},
        }

    def is_in(self, region: Formula) -> bool:
        """Whether the state belongs to the region."""
        return holds_at(region, self.point())

    def moved(self, image: Vector, **more: Fraction | int) -> ExactState:
        """The state that a derived vector gives here."""
        there = [value_of(term(entry), self.point(**more)) for entry in image.entries]
        return ExactState(self.alpha, there[0], there[1])

    @property
    def strikes(self) -> bool:
        """Whether this period has an impact."""
        return bool(exact().strikes(self.x, self.w))

    @property
    def speed_squared(self) -> Fraction:
        """u^2, twice the energy in units of r^2."""
        return value_of(SPEED[1], self.point())

    @property
    def distance(self) -> Fraction:
        """The distance to e_1 in the sup norm."""
        fixed = self.moved(FIXED)
        return max(abs(self.x - fixed.x), abs(self.w - fixed.w))

    @property
    def size(self) -> int:
        """The length of the longest numerator or denominator in bits."""
        return max(
            part.bit_length()
            for number in (self.x, self.w)
            for part in (number.numerator, number.denominator)
        )


def a_state(alpha: Fraction, x: Fraction, w: Fraction) -> ExactState:
    """The state, which has to be one of H."""
    found = ExactState(alpha, x, w)
    if not found.is_in(SPACE):
        raise ClaimError(f"x = {x} is below the table; a state has x >= 0")
    return found


def flight_length(state: ExactState) -> int:
    """How many periods without an impact follow from this state on."""
    return int(exact().flight_length(state.x, state.w))


def flown(state: ExactState, periods: int) -> ExactState:
    """The state after this number of periods without an impact."""
    return ExactState(state.alpha, *exact().flight(state.x, state.w, periods))


def struck(state: ExactState) -> ExactState:
    """The state after a period with an impact."""
    return ExactState(state.alpha, *exact().impact(state.alpha, state.x, state.w))


def step(state: ExactState) -> ExactState:
    """f: the state after one period."""
    return struck(state) if state.strikes else flown(state, 1)


@dataclass(frozen=True)
class OrbitMove:
    """From the period `start` on: a flight of `periods` periods, or an impact, which takes one."""

    start: int
    state: ExactState
    periods: int
    impact: bool


def moves(state: ExactState, impacts: int = MAX_IMPACTS) -> Iterator[OrbitMove]:
    """The orbit, flights at once, up to this number of impacts or until its numbers are too long.
    At its end comes an impact.
    """
    count = 0
    for _ in range(impacts):
        periods = flight_length(state)
        if periods:
            yield OrbitMove(count, state, periods, False)
            count, state = count + periods, flown(state, periods)
        yield OrbitMove(count, state, 1, True)
        count, state = count + 1, struck(state)
        if state.size > MAX_BITS:
            return


# -------------------------------------------------------------------------------------------------
# Argument B: from flight to flight. Why the bound is 1/3, and the repair closest to section 4.3 of
# the paper.
#
# A flight begins with an impact at the state (x, w) and lasts K periods, to the impact at (x', w').
# Since x' >= 0, a long flight needs a high closing speed, and leaves a low one: the next flight
# lasts J periods with J - 1 <= alpha (K + 1). For alpha < 1/3 flights grow shorter until all last
# one period. That is certified of f with a count: k is the number of periods that the flight has
# lasted when this one ends, and `most` a bound of its length; an impact after k periods makes it
# 1 + alpha (k + 1) for the next flight. The space has what is known of w and x then. The closing
# speeds at the impacts approach that of e_1 by the factor kappa = alpha (1 + 3 alpha)/(1 - alpha)
# at least, which is less than 1 exactly for alpha < 1/3: so the relative kinetic energy falls from
# impact to impact, which the paper claims of every period.

HERE = Vector((x, w))
K, J, n, d = reals("K J n d")
COUNTED = replace(
    STANDING,
    integers=frozenset({"K", "J", "n"}),
    givens={**STANDING.givens, "K": (K >= 1,), "J": (J >= 1,)},
)
always = partial(forms.always, vocabulary=COUNTED)
w_1 = term(FIXED.entries[1])  # the closing speed of e_1
KAPPA = alpha * (1 + 3 * alpha) / (1 - alpha)


def flown_for(periods: Term, start: Vector) -> Vector:
    """The state after this number of periods of flight."""
    values = {"x": term(start.entries[0]), "w": term(start.entries[1]), "K": periods}
    return at(derived_vector("normal_flight_power"), values)


def next_impact(periods: Term, start: Vector = HERE) -> Vector:
    """The state at the next impact, `periods` periods after an impact at `start`."""
    struck: Vector = at(
        derived_vector("normal_f1"), {"x": term(start.entries[0]), "w": term(start.entries[1])}
    )
    return flown_for(periods - 1, struck)


AFTER = next_impact(K)
x_after, w_after = (term(entry) for entry in AFTER)
IN_FLIGHT = [x >= 0, x_after >= 0]  # the next impact is above the table

k, most = reals("k most")
STRUCK, FLOWN = PIECES
COUNTING = replace(
    NORMAL,
    state=(x, w, k, most),
    space=conjunction([SPACE, k >= 1, k <= most, w >= 2 * k + 1 - most, x + k * w <= k * (k + 1)]),
    pieces=(
        (STRUCK[0], Vector((*STRUCK[1].entries, 1, 1 + alpha * (k + 1)))),
        (FLOWN[0], Vector((*FLOWN[1].entries, k + 1, most))),
    ),
)
TO_ONE_PERIOD = Descent(2 * most / (1 - 3 * alpha) - k, (IMPACT & (most < 2),))
BELOW = BELOW_A_THIRD & (1 - 3 * alpha > 0)  # for what is divided by


@claim("theorem-flights", "theorem", "argument B")
def flights_grow_shorter_below_a_third() -> list[AnyStatement]:
    """Flights end; long ones need a high closing speed and leave a low one; for alpha < 1/3 they
    grow shorter until they last one period.
    """
    one, many = (tuple(term(entry) for entry in flown_for(count, HERE)) for count in (term(1), n))
    last = next_impact(J, AFTER)
    return [
        Iterates("powers", ("x", "w"), one, "n", many),
        always(
            term(flown_for(n, HERE).entries[0]) < 0,
            given=[x >= 0, n >= 1, n > x + 1 - w],
            label="end",
        ),
        always((alpha * w >= K - 1) & (w_after <= K + 1), given=IN_FLIGHT, label="long-after-fast"),
        always(
            J - 1 <= alpha * (K + 1),
            given=[*IN_FLIGHT, term(last.entries[0]) >= 0],
            label="the-next",
        ),
        always(
            implies(equal(K, 1), equal(J, 1)) & implies(K >= 2, J < K),
            given=[J - 1 <= alpha * (K + 1)],
            in_range=[alpha > 0, 3 * alpha < 1],
            label="shorter",
        ),
        exists_real(["k", "most"], COUNTING.space, given=[x >= 0], label="counted"),
        the_map("counting", COUNTING),
        descends("until-one", "theorem-flights/counting", COUNTING, BELOW, TO_ONE_PERIOD),
    ]


@claim("theorem-kinetic", "theorem", "after 4.3")
def speeds_at_impacts_approach_that_of_the_fixed_point() -> list[AnyStatement]:
    """From impact to impact the closing speed comes nearer to that of e_1, by the factor kappa at
    least, which is below 1 exactly for alpha < 1/3.

    The relative kinetic energy, sampled at impacts, is half the square of that difference: it falls
    by kappa squared at least.
    """
    nearer = (-KAPPA * d <= w_after - w_1) & (w_after - w_1 <= KAPPA * d)
    close = [-d <= w - w_1, w - w_1 <= d]
    return [
        always(nearer, given=[*IN_FLIGHT, *close, equal(K, 1)], label="after-one-period"),
        always(nearer, given=[*IN_FLIGHT, *close, K >= 2], label="after-more"),
        always(iff(KAPPA < 1, 3 * alpha < 1), label="kappa-below-1"),
    ]


# -------------------------------------------------------------------------------------------------
# Where stability ends: e_K at the least alpha for which it exists, and the energy that no orbit
# exceeds.
#
# At alpha = (K - 1)/(K + 1), K >= 2, the orbit of e_K meets the table just at a bounce, one period
# before its impact. However little the ball starts higher, it strikes a period early, and after K
# periods is far from where it started: e_K comes back after K periods, and is not stable.

AT_THE_END = [alpha > 0, alpha < 1, equal(alpha * (K + 1), K - 1), K >= 2]
E_K = Vector((0, K + 1))  # at the impact
HIGHER = Vector((d, K + 1))


def strikes(state: Vector) -> Formula:
    """The state is in B1."""
    found: Formula = at(IMPACT, {"x": term(state.entries[0]), "w": term(state.entries[1])})
    return found


def after_impact(periods: Term, start: Vector) -> Vector:
    """The state after an impact and this number of periods of flight."""
    return next_impact(periods + 1, start)


@claim("theorem-ends", "theorem", "alpha = (K - 1)/(K + 1)", parameters=())
def fixed_points_are_not_stable_where_they_begin() -> list[AnyStatement]:
    """At alpha = (K - 1)/(K + 1), K >= 2, e_K comes back after K periods, and states however near
    it are far from it after K periods.
    """
    struck = after_impact(K - 2, HIGHER)
    back = Vector(
        tuple(
            at(term(entry), {"x": term(struck.entries[0]), "w": term(struck.entries[1])})
            for entry in derived_vector("normal_f1").entries
        )
    )
    raised = [d > 0, d < 1]
    return [
        always(
            equals(derived_vector("normal_impact_fixed_point"), E_K),
            in_range=AT_THE_END,
            label="e_K",
        ),
        always(
            strikes(E_K) & equals(next_impact(K, E_K), E_K), in_range=AT_THE_END, label="comes-back"
        ),
        always(
            ~strikes(after_impact(n, E_K)),
            given=[n >= 0, n <= K - 2],
            in_range=AT_THE_END,
            label="in-flight-between",
        ),
        always(strikes(HIGHER), given=raised, in_range=AT_THE_END, label="higher-strikes"),
        always(
            ~strikes(after_impact(n, HIGHER)),
            given=[*raised, n >= 0, n <= K - 3],
            in_range=AT_THE_END,
            label="higher-flies",
        ),
        always(strikes(struck), given=raised, in_range=AT_THE_END, label="strikes-a-period-early"),
        always(
            term(back.entries[1]) <= K, given=raised, in_range=AT_THE_END, label="is-far-after-K"
        ),
    ]


@claim("theorem-E-max", "theorem", "after (22)")
def orbits_of_little_energy_keep_to_it() -> list[AnyStatement]:
    """The states of energy at most E_max are mapped into themselves, for every 0 < alpha < 1."""
    little = derived("E_max")
    return [
        always_real(
            energy(f1(b)) <= little, given=[B1(b), energy(b) <= little], label="with-impact"
        ),
        always_real(
            energy(f2(b)) <= little, given=[B2(b), energy(b) <= little], label="without-impact"
        ),
    ]


# -------------------------------------------------------------------------------------------------
# Bounds that come near the worst case: for any W with (1 - alpha) W > 2, a rank with a smaller
# factor leads to the energies u <= W - 1.
#
# A ball thrown up from the ground with great u needs about u/(1 - alpha) periods to lose its
# energy, as each impact leaves alpha of its speed. The factor (1 + alpha) W / (2 ((1 - alpha) W -
# 2)) comes down to (1 + alpha)/(2 (1 - alpha)) as W grows, and the rank of that ball to u/(1 -
# alpha). From u <= W - 1 the rank of the theorem leads on, which is at most 5 (W - 1)/2 there.

W, after, u_next = reals("W after u_next")
FACTOR = (1 + alpha) * W / (2 * ((1 - alpha) * W - 2))
LEAST_FACTOR = (1 + alpha) / (2 * (1 - alpha))
LITTLE = 4 * x + (w - 1) ** 2 <= (W - 1) ** 2
RANK_THERE = (
    5 * (W - 1) / 2
)  # what the rank of the theorem is at most, where there is little energy
TO_LITTLE_ENERGY = Descent(FACTOR * u + (1 - w) / 2, (LITTLE,), (SPEED,))
WITH_W = replace(NORMAL, parameters=(alpha, W), positive=(W > 2, (1 - alpha) * W - 2 > 0))
OUTSIDE = W - 1 <= u
LOSES = W * (u - u_next) >= w * ((1 - alpha) * W - 2)


@claim("theorem-sharper", "theorem", "sharper bounds")
def a_smaller_rank_leads_to_little_energy() -> list[AnyStatement]:
    """For every W > 2/(1 - alpha) an orbit has u <= W - 1 from some period on, no later than a rank
    tells whose factor of u falls to (1 + alpha)/(2 (1 - alpha)) as W grows.
    """
    high = [W > 2, u >= W - 1, u >= w - 1, after <= 1 + alpha * w]
    return [
        forms.always(
            W * (u - after) >= w * ((1 - alpha) * W - 2),
            given=high,
            in_range=[],
            label="loses",
            vocabulary=STANDING,
        ),
        the_map("map", WITH_W),
        descends(
            "to-little-energy",
            "theorem-sharper/map",
            WITH_W,
            WHOLE,
            TO_LITTLE_ENERGY,
            (*AT_IMPACTS, OUTSIDE, LOSES),
        ),
        forms.always(
            TO_THE_POINT.rank <= RANK_THERE,
            given=[W >= 1, u**2 <= (W - 1) ** 2, -u <= w - 1],
            label="rank-there",
            vocabulary=STANDING,
        ),
        always_real(
            equal(FACTOR, LEAST_FACTOR + (1 + alpha) / ((1 - alpha) * ((1 - alpha) * W - 2))),
            given=WITH_W.positive,
            label="factor",
        ),
    ]


# -------------------------------------------------------------------------------------------------
# Orbits in the trap in closed form: f^n(e_1 + (p, q)) = e_1 + (-alpha)^n (p - n q, q), so that
# distances fall to (1 + n) alpha^n times the first.
#
# There every period has an impact (`theorem/contracts`), and the impact map is affine: it turns the
# shear (p, q) -> (p - q, q) about e_1 by -alpha.

p, q, n, c = reals("p q n c")
ONE_COUNT = replace(STANDING, integers=frozenset({"n"}), givens={**STANDING.givens, "n": (n >= 0,)})
always_in_closed_form = partial(forms.always, vocabulary=ONE_COUNT)
SHEARED = (p - n * q, q)
# the distance after n periods, from where it is at most 1, is at most GROWTH times RATE to the n
RATE = alpha
GROWTH = 1 + n


def from_the_fixed_point(factor: Term, offset: tuple[Term, Term]) -> Vector:
    """e_1 with a multiple of the offset added."""
    return Vector(tuple(term(entry) + factor * part for entry, part in zip(FIXED.entries, offset)))


def within(most: Term) -> Formula:
    """The sheared offset is at most this in the sup norm."""
    return conjunction([bound for part in SHEARED for bound in (-most <= part, part <= most)])


@claim("theorem-closed-form", "theorem", "orbits in the trap")
def orbits_in_the_trap_in_closed_form() -> list[AnyStatement]:
    """While impact follows impact, f^n(e_1 + (p, q)) = e_1 + (-alpha)^n (p - n q, q), at most (1 +
    n) alpha^n from e_1 if (p, q) is at most 1.

    The step is an induction: c stands for (-alpha)^n, which is 1 for n = 0, and -alpha c for the
    next power.
    """
    here = from_the_fixed_point(c, SHEARED)
    after = at(
        derived_vector("normal_f1"), {"x": term(here.entries[0]), "w": term(here.entries[1])}
    )
    small = [-1 <= p, p <= 1, -1 <= q, q <= 1]
    return [
        Iterates("shear", ("p", "q"), (p - q, q), "n", SHEARED),
        always_in_closed_form(
            equals(after, from_the_fixed_point(-alpha * c, (p - (n + 1) * q, q))), label="step"
        ),
        always_in_closed_form(within(GROWTH), given=small, label="at-most"),
    ]


# -------------------------------------------------------------------------------------------------
# What (26) and A.4 count with: the least loss of an impact outside R, derived or as the third line
# of A.3.2 prints it, in units of r^2.
#
# The bracket, (E - E_max - Delta E_max)/(-Delta E_sup), is at most n where u^2 <= 2 (level + n
# loss), u^2 being twice the energy. With the derived loss, rounded up, it counts enough impacts.
# With the printed loss it does exactly where `ENOUGH` holds, alpha <= 0.3645..: an impact that
# leaves the ball outside of R then takes as much as is counted. Beyond, an impact on the ground
# with bracket 1 leaves the ball outside of R, in all readings of time: its flight before took m > u
# - 1 periods, the next impact comes a period later at the earliest, and u < m + 1 is all of (26).

m, n = reals("m n")
TWO_COUNTS = replace(STANDING, integers=frozenset({"m", "n"}))
always_counted = partial(forms.always, vocabulary=TWO_COUNTS)


def in_units(energy: Term) -> Term:
    """An energy in units of r^2."""
    return at(energy, {"r": 1})


LEVEL_OF_R = in_units(LEVEL)  # the energy up to which R reaches
TRUE_LOSS = in_units(-term(derived("delta_E_sup")))
PRINTED_LOSS = in_units(-term(scalar(read(PRINTED_SUPREMUM).right(paper_names()))))
ENOUGH = 2 * s * (1 - alpha + alpha**2) <= 3 - alpha - 2 * alpha**3
MARGIN = (
    1,
    2,
    -7,
    -20,
    12,
    -8,
    4,
    # coefficients of the polynomial in alpha alone that is >= 0 where ENOUGH holds; 0.3645.. is its
    # root
)
TOO_MUCH = 4 * alpha * s > (1 - alpha) * (
    1 + alpha
)  # where the printed loss is above the derived one
GROUND = Vector((0, 1 + u))  # the ball comes down to the ground with u
AFTER_IMPACT = derived_vector("normal_f1")


def written(coefficients: Sequence[int]) -> Term:
    """The polynomial in alpha with these coefficients, from the constant up."""
    total = term(coefficients[0])
    for k, c in enumerate(coefficients[1:], 1):
        total = total + c * alpha**k
    return total


def at_state(thing: Placed, state: Vector) -> Placed:
    """A term or formula of (x, w) at this state."""
    return at(thing, {"x": term(state.entries[0]), "w": term(state.entries[1])})


def before_the_ground(periods: Term) -> Vector:
    """The state this number of periods before the ball strikes the ground, coming down with u."""
    return Vector((periods * (u - periods), 1 + u - 2 * periods))


@claim("theorem-count", "theorem", "(26) and A.4")
def printed_loss_counts_too_few_impacts() -> list[AnyStatement]:
    """The bracket of (26), rounded up, counts enough impacts with the loss that A.3.2 prints just
    for alpha up to 0.3645.., an algebraic number.

    Up to there an impact that leaves the ball outside R takes that loss at least; beyond, a ball on
    the ground, for which one impact is counted, is outside R after it.

    Of the states sampled once a period (26) is too early for every alpha and either loss: u < m + 1
    periods are counted, and m + 1 are needed.
    """
    speed = SPEED[1]
    after = at_state(speed, AFTER_IMPACT)
    one = equal(u**2, 2 * (LEVEL_OF_R + PRINTED_LOSS))
    little = s / (1 - alpha) + alpha * (1 - alpha) / 4  # a u just outside of R
    margin = written(MARGIN)
    slope = written([k * c for k, c in enumerate(MARGIN)][1:])
    in_flight = [u > 0, m <= u, u < m + 1, m >= 1]
    return [
        always_counted(iff(PRINTED_LOSS > TRUE_LOSS, TOO_MUCH), label="differs"),
        always_counted(
            speed - after >= 2 * PRINTED_LOSS,
            given=[x >= 0, IMPACT, after > 2 * LEVEL_OF_R, ENOUGH],
            label="each-loses-as-counted",
        ),
        always_counted(
            at_state(IMPACT & equal(speed, u**2) & (after > 2 * LEVEL_OF_R), GROUND),
            given=[u > 0, one, ~ENOUGH],
            label="one-is-not-enough",
        ),
        always_counted(
            at_state(SPACE & ~IMPACT, before_the_ground(m))
            & equals(flown_for(m, before_the_ground(m)), GROUND)
            & at_state(IMPACT, GROUND),
            given=in_flight,
            label="flight",
        ),
        always_counted(
            ~at_state(IMPACT, before_the_ground(n)),
            given=[*in_flight, n >= 1, n <= m],
            label="in-flight-between",
        ),
        always_counted(
            equal(at_state(speed, before_the_ground(n)), u**2), label="energy-in-flight"
        ),
        *(
            always_counted(
                (little**2 > 2 * LEVEL_OF_R) & (little**2 < 2 * (LEVEL_OF_R + loss)),
                label=f"one-is-counted-{which}",
            )
            for which, loss in (("derived", TRUE_LOSS), ("printed", PRINTED_LOSS))
        ),
        always_counted(iff(ENOUGH, margin >= 0), label="enough-by-alpha"),
        always_counted(slope < 0, given=[5 * alpha >= 1], label="falls-there"),
        always_counted(ENOUGH, given=[10000 * alpha <= 3645], label="enough-up-to"),
        always_counted(~ENOUGH, given=[10000 * alpha >= 3646], label="not-enough-from"),
        always_counted(
            iff(TOO_MUCH, 32 * alpha**2 > (1 - alpha) ** 2 * (1 + alpha)), label="differs-by-alpha"
        ),
        always_counted((TRUE_LOSS > 0) & (PRINTED_LOSS > 0), label="losses"),
    ]
