"""Outside the region R: the states there, how long they may fly, and what an impact takes from them
(sections 4.2 and A.3); and the boundary of R.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from juggleproof.judging import forms
from juggleproof.judging.claims import Assertion
from juggleproof.proofs.paper.names import (
    B1_OUTSIDE,
    CLOSED_B1,
    CORNER,
    ON_R,
    OUTSIDE,
    STANDING,
    H,
    R,
    T,
    always,
    at,
    b,
    ball_at,
    beta,
    derived,
    derived_vector,
    energy,
    exists_some,
    f1,
    g,
    height,
    impact_energy_change,
    meet,
    paper_names,
    r,
    speed,
    t,
    table_at,
    v,
    value_of,
)
from juggleproof.reading import tree
from juggleproof.reading.evaluation import Environment
from juggleproof.reading.meaning import Printed
from juggleproof.reading.values import Vector, scalar
from juggleproof.statements.language import (
    ClaimError,
    Formula,
    Statement,
    Term,
    conjunction,
    different,
    equal,
    reals,
    term,
)

beta0, v0, u, tau_w, dE_sup, n, m, j, tau, launch = reals(
    "beta0 v0 u tau_w dE_sup n m j tau launch"
)
edge, delta, k, p, q = reals("edge delta k p q")
b_0 = Vector((beta0, v0))
WITH_INTEGERS = replace(
    STANDING,
    roots={**STANDING.roots, "u": 2 * energy(b_0)},
    integers=frozenset({"n", "m", "j"}),
)
always_counting = partial(forms.always, vocabulary=WITH_INTEGERS)
exists_counting = partial(forms.exists_some, vocabulary=WITH_INTEGERS)

change, least = (
    impact_energy_change(b),
    impact_energy_change(b_0),
)  # the least loss is that at the corner b_0
# What Delta E_sup is: the energy change at the state b_0 that is the corner.
SUPREMAL = [CORNER(b_0), equal(dE_sup, least)]
ATTRACTION = ("theorem-region/enters",)  # from some period on, every orbit is in R
LEVEL: Term = derived("region_energy")  # E_max + Delta E_max, the energy on the edge of R
# The meanings of prints in which tau_w and the root of the energy are unknowns.
NAMED = paper_names().extended({r"\sqrt{2E(\overline b_0)}": u, r"\tau_w": tau_w})
PRINTED_SUPREMUM = (
    r"\Delta E_{sup} = [-\frac{1+\alpha}{1-\alpha} + 1 + \alpha - \sqrt{2(1+\alpha)}"
    r" \frac{\alpha}{1-\alpha}] "
    r"\times (1+\alpha) \dot{\rho}_0^2"
)  # the third line of A.3.2, which sA.3.2-sup3 judges
worst_wait: Term = at(
    derived("hang_time"), {"v": u}
)  # the flight from the ground up and back that has all the energy of b_0


def state_on_the_level(velocity: Term) -> Vector:
    """The state of this velocity on R(b) = 0."""
    return Vector(((LEVEL - velocity**2 / 2) / g, velocity))


def pieces(printed: Printed, count: int) -> tuple[Printed, ...]:
    """The parts of a print that has to have this many."""
    if len(printed.parts) != count:
        raise ClaimError(f"this print has {len(printed.parts)} parts, where {count} are expected")
    return printed.parts


def flown(periods: Term) -> Vector:
    """The state b_0 after this many periods without an impact."""
    return at(at(derived_vector("flight_power"), b_0), {"K": periods})


def strikes_in_period(periods: Term, time: Term) -> Formula:
    """After this many periods without an impact, and this time more, ball and table are at one
    height and approach each other.
    """
    ball = flown(periods)
    return equal(height(ball_at(time, ball)), height(table_at(time))) & (speed(ball) < r)


def lands(state: Vector, time: Term) -> Formula:
    """The ball comes down to the ground at this time, if nothing is in its way."""
    there = ball_at(time, state)
    return conjunction([time >= 0, equal(height(there), 0), speed(there) <= 0])


def grounded_after(wait: Term, state: Vector, given: list[Formula], label: str) -> Statement:
    """From this time on the ball of this state would be on or below the ground, so an impact has
    come before.
    """
    return always_counting(
        height(ball_at(t, state)) <= 0, given=[H(state), *given, t >= wait], label=label
    )


def struck_by(wait: Term, state: Vector, given: list[Formula]) -> list[Statement]:
    """A ball of this state that nothing has struck until the last launch of the table within the
    wait strikes it by the end of the wait: it approaches, so that they meet, and by then.
    """
    ball = ball_at(launch, state)
    there = [H(state), *given, launch >= 0, wait < launch + T]
    met = equal(height(ball_at(tau, state)), height(table_at(tau - launch)))
    return [
        always_counting(speed(ball) < r, given=there, label="approaches"),
        exists_counting(["tau"], meet(tau), given=[v < r], label="meets"),
        always_counting(
            (launch <= tau) & (tau <= wait),
            given=[H(state), *given, wait < launch + T, H(ball), met],
            label="by-then",
        ),
    ]


def floor_of(value: Term) -> Formula:
    """n is the greatest integer that is not above the value."""
    return (n <= value) & (value < n + 1)


def ceiling_of(value: Term) -> Formula:
    """n is the least integer that is not below the value."""
    return (value <= n) & (n < value + 1)


def not_supremal(on_boundary: Formula) -> Statement:
    """No state of this boundary of the impacts outside R has the supremal energy change."""
    there = [CLOSED_B1(b), on_boundary]
    return always(different(change, derived("delta_E_sup")), given=there)


def not_supremal_above_the_ground() -> Statement:
    """No state of R(b) = 0 above the ground has the supremal energy change."""
    there = [CLOSED_B1(b), ON_R(b), beta > 0]
    return always(change < derived("delta_E_sup"), given=there)


def impacts_suffice(rounding: Formula) -> Assertion:
    """After n impacts the energy of b_0 is down to the level of R: n times the least loss covers
    what is above it.
    """
    loss = -term(derived("delta_E_sup"))
    return Assertion(
        (
            always_counting(R(b_0), given=[H(b_0), rounding, n <= 0], label="none-needed"),
            always_counting(
                energy(b_0) <= LEVEL + n * loss, given=[H(b_0), rounding], label="losses-cover"
            ),
            always(energy(f1(b)) <= energy(b) - loss, given=[B1_OUTSIDE(b)], label="each-impact"),
        )
    )


def with_rounding(printed: Printed, environment: Environment) -> tuple[Environment, Term]:
    """The environment in which the square bracket of the print is the integer n, and what stands
    inside the bracket.
    """
    for group in _square_brackets(printed.tree):
        start = end = group.at
        depth = 0
        while depth or start == end:
            depth += {"[": 1, "]": -1}.get(printed.latex[end], 0)
            end += 1
        inside = value_of(Printed(printed.latex[start:end]), environment)
        return environment.extended({printed.latex[start:end]: n}), term(scalar(inside))
    raise ClaimError("this print has no square bracket that could round a number")


def _square_brackets(node: object) -> list[tree.Group]:
    if isinstance(node, tuple):
        return [group for item in node for group in _square_brackets(item)]
    if not isinstance(node, tree.Tree):
        return []
    found = (
        [node]
        if isinstance(node, tree.Group) and node.bracket == "[" and len(node.items) == 1
        else []
    )
    return found + [
        group
        for name in node.__dataclass_fields__
        for group in _square_brackets(getattr(node, name))
    ]


# -------------------------------------------------------------------------------------------------
# The boundary of R, as a set of states of H: where it is that states inside and outside of R lie as
# near as one likes.

LEFT = Vector((edge, v))  # a state beside b, at another height
# The states near b: the height moves by at most delta r^2 / g and the velocity by at most delta r;
# (k - 2) r bounds the velocity of b.
NEAR = b + Vector((p, q))
WITHIN_DELTA = [-(r**2) * delta <= g * p, g * p <= r**2 * delta, -r * delta <= q, q <= r * delta]
BOUNDED = [-(k - 2) * r <= v, v <= (k - 2) * r]


def room(*margins: Term) -> Formula:
    """Moving by delta changes none of these margins of energy so much that it vanishes."""
    return conjunction([k * r**2 * delta < margin for margin in margins])


def is_boundary_of_R(on_it: Formula) -> list[Statement]:
    """The states of this formula, and no others of H, have states of R and others as near as one
    likes.
    """
    margin = term(at(derived("region_margin"), b))
    inner, outer = [R(b), ~on_it, *BOUNDED], [OUTSIDE(b), *BOUNDED]
    return [
        always(R(b), given=[H(b), on_it], label="one-side"),
        exists_some(
            ["edge"],
            OUTSIDE(LEFT),
            within=[edge > beta, edge < beta + delta],
            given=[H(b), on_it, delta > 0],
            label="both-sides",
        ),
        exists_some(["delta"], room(margin), within=[delta > 0], given=inner, label="room-inside"),
        exists_some(
            ["delta"], room(-margin), within=[delta > 0], given=outer, label="room-outside"
        ),
        always(
            R(NEAR),
            given=[R(b), *BOUNDED, *WITHIN_DELTA, delta < 1, room(margin), H(NEAR)],
            label="inside",
        ),
        always(~R(NEAR), given=[*outer, *WITHIN_DELTA, room(-margin)], label="outside"),
    ]
