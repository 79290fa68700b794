"""The table that moves as a sine, which the paper leaves open: its bounces of one period, when they
are stable, and where every motion tends to one.

In the units and names of `symbolic.sine_table`.  Of pi it is used only that it is positive; the
table falls at G, in units of gravity, in one bounce, and at -G in the other.
"""

from __future__ import annotations

from fractions import Fraction
from functools import partial

from juggleproof.judging import claims, forms
from juggleproof.judging.forms import Vocabulary
from juggleproof.papers.derivations import derived, derived_matrix, derived_vector
from juggleproof.statements.language import (
    Formula,
    Number,
    Statement,
    Term,
    equal,
    iff,
    reals,
    substitute,
    term,
)

alpha, pi, Gamma, G, cosine, sine, V = reals("alpha pi Gamma G cosine sine V")
m, k, p, q = reals("m k p q")

IN_RANGE = (alpha >= 0, alpha < 1)
TABLE = Vocabulary(
    order=("alpha", "pi", "Gamma", "G", "cosine", "sine", "V", "m", "k", "p", "q"),
    ranges={"alpha": IN_RANGE},
    givens={"pi": (pi > 0,), "Gamma": (Gamma > 0,)},
    domains={"alpha": IN_RANGE},
    scales=frozenset(),
)
claim = partial(claims.claim, vocabulary=TABLE, parameters=())
always = partial(forms.always, vocabulary=TABLE)

ON_CIRCLE = equal(cosine**2 + sine**2, 1)
BIRTH, DRIVE_SQUARED = derived("birth_drive"), derived("squared_drive")
TRACE, DETERMINANT = derived("bounce_trace"), derived("bounce_determinant")
DOUBLING = derived("doubling_fall")
IS_STABLE = (G > 0) & (G < DOUBLING)


def comes_back() -> Formula:
    """After impact and flight for one period the ball strikes the table again, at the same
    speed.
    """
    change = derived_vector("change_over_a_period")
    return equal(change.component(1), 0) & equal(change.component(2), 0)


# -------------------------------------------------------------------------------------------------
# The bounces of one period.


@claim("sine-bounces", "sine", "bounces of one period")
def bounces_of_one_period_strike_at_half_the_speed_of_a_period() -> list[Statement]:
    """A ball that strikes a table that moves as a sine does so again one period later, at the same
    speed, exactly where it comes down at half of gravity times the period and Gamma cos(theta) =
    pi (1 - alpha)/(1 + alpha); its closing speed is then 1/(1 + alpha).

    Whether the ball meets the table before is not said here.
    """
    closing, bounce = (
        derived("impact_closing_speed"),
        equal(2 * V, -1) & equal(Gamma * cosine, BIRTH),
    )
    return [
        always(iff(comes_back(), bounce), label="speed"),
        always(equal(closing, 1 / (1 + alpha)) & (closing > 0), given=[bounce], label="closing"),
    ]


@claim("sine-birth", "sine", "birth")
def bounces_are_born_at_this_drive() -> list[Statement]:
    """No bounce of one period exists for Gamma below pi (1 - alpha)/(1 + alpha), and above it two,
    at which the table falls at G and at -G, where Gamma^2 = (pi (1 - alpha)/(1 + alpha))^2 + G^2.

    The angle of a bounce is the one of claim sine-bounces.
    """
    drive, angle = equal(Gamma**2, DRIVE_SQUARED), equal(Gamma * cosine, BIRTH)

    def at(fall: Term) -> Formula:
        values = {"cosine": BIRTH / Gamma, "sine": fall / Gamma, "V": term(Fraction(-1, 2))}
        found: Formula = substitute(ON_CIRCLE & comes_back(), values)
        return found

    return [
        always(
            equal(DRIVE_SQUARED, (pi * (1 - alpha) / (1 + alpha)) ** 2 + G**2), label="in-words"
        ),
        always(drive, given=[ON_CIRCLE, angle, equal(G, Gamma * sine)], label="drive"),
        always(Gamma >= BIRTH, given=[drive], label="none-below"),
        always(at(G) & at(-G), given=[drive], label="two"),
    ]


# -------------------------------------------------------------------------------------------------
# Their multipliers.


def trace_and_determinant(jacobian: str) -> tuple[Term, Term]:
    """Trace and determinant of a derived matrix, from its entries."""
    (a, b), (c, d) = ((term(one) for one in row) for row in derived_matrix(jacobian).rows)
    return a + d, a * d - b * c


@claim("sine-multipliers", "sine", "multipliers")
def multipliers_of_the_bounce() -> list[Statement]:
    """The multipliers of the bounce where the table falls at G have the product alpha^2 and the sum
    1 + alpha^2 - (1 + alpha)^2 G. Their characteristic polynomial is (1 + alpha)^2 G at 1; at -1
    it is 0 exactly for G = 2 (1 + alpha^2)/(1 + alpha)^2, where the other multiplier is -alpha^2.
    """
    trace, determinant = trace_and_determinant("bounce_jacobian")
    characteristic = derived("bounce_characteristic")

    def characteristic_at(value: Number) -> Term:
        found: Term = substitute(characteristic, {"m": term(value)})
        return found

    return [
        always(equal(trace, 1 + alpha**2 - (1 + alpha) ** 2 * G), label="sum"),
        always(equal(determinant, alpha**2), label="product"),
        always(equal(characteristic, m**2 - trace * m + determinant), label="both"),
        always(equal(characteristic_at(1), (1 + alpha) ** 2 * G), label="birth"),
        always(iff(equal(characteristic_at(-1), 0), equal(G, DOUBLING)), label="doubling"),
        always(equal(DOUBLING, 2 * (1 + alpha**2) / (1 + alpha) ** 2), label="doubling-in-words"),
        always(
            equal(characteristic_at(-(alpha**2)), 0),
            given=[equal(G, DOUBLING)],
            label="other-at-doubling",
        ),
    ]


@claim("sine-stable", "sine", "stability")
def the_bounce_is_stable_between_birth_and_period_doubling() -> list[Statement]:
    """Both multipliers of the bounce lie inside the unit circle exactly for
    0 < G < 2 (1 + alpha^2)/(1 + alpha)^2, be they real or complex.
    """
    return [
        always(
            iff((m**2 < 1) & (k**2 < 1), IS_STABLE),
            given=[equal(m + k, TRACE), equal(m * k, DETERMINANT)],
            label="real",
        ),
        always(
            (p**2 + q**2 < 1) & IS_STABLE,
            given=[equal(2 * p, TRACE), equal(p**2 + q**2, DETERMINANT)],
            label="complex",
        ),
    ]


@claim("sine-other", "sine", "the other bounce")
def the_other_bounce_is_a_saddle() -> list[Statement]:
    """The other bounce, where the table falls at -G, is a saddle for every G > 0: its multipliers
    are real, one in [0, 1) and one above 1. Its flight begins and ends on the table.

    Whether it meets the table in between is not said here: the height above the table has a cosine
    and a sine of the time.
    """
    trace, determinant = trace_and_determinant("other_bounce_jacobian")
    gap, rate = (term(one) for one in derived_vector("other_bounce_gap").entries)
    start, end = ({"t": term(one), "cosine_t": term(1), "sine_t": term(0)} for one in (0, 1))
    begins = substitute(equal(gap, 0) & equal(rate, alpha / (1 + alpha)), start)
    ends = substitute(equal(gap, 0) & equal(rate, -1 / (1 + alpha)), end)
    return [
        always(trace**2 > 4 * determinant, given=[G > 0], label="real"),
        always(
            (m >= 0) & (m < 1) & (k > 1),
            given=[G > 0, equal(m + k, trace), equal(m * k, determinant), m <= k],
            label="saddle",
        ),
        always(begins & ends, label="flight"),
    ]
