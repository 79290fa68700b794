"""From bounce to bounce: the state after a period with an impact, after periods without, and states
that come back.

A state that comes back is told by that property: no fixed point that was solved for enters here.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

from certificates.statements import Statement
from certificates.terms import (
    ClaimError,
    Formula,
    Number,
    Term,
    conjunction,
    different,
    equal,
    iff,
    reals,
    term,
)
from proofs import forms
from proofs.claims import Assertion, Readings
from proofs.paper.events import ball_at, height, speed, table_at, vector
from proofs.paper.vocabulary import (
    B1,
    B2,
    PAPER,
    WITH_INTEGER_K,
    H,
    K,
    T,
    alpha,
    always,
    b,
    collide,
    collision_time,
    equals,
    f1,
    f2,
    flight,
    flight_matrix,
    r,
    r_0,
    t,
    v,
)
from proofs.reading.environment import Environment
from proofs.reading.meaning import Meaning
from proofs.reading.notions import Region, StateFunction
from proofs.reading.printed import Printed
from proofs.reading.values import Matrix, Vector

WITH_INTEGERS = replace(WITH_INTEGER_K, integers=frozenset({"K", "n", "k"}))
b_0 = Vector(reals("beta0 v0"))  # another state
image = Vector(reals("beta1 v1"))  # what becomes of the state b within a period
MEETS_LATE = Region(lambda state: H(state) & (term(collision_time(state)) >= T))
always_integer = partial(forms.always, vocabulary=WITH_INTEGERS)  # for all integers K >= 1, n and k
exists_integer = partial(forms.exists_some, vocabulary=WITH_INTEGERS)


def strikes_from(start: Vector, time: Term) -> Formula:
    """The ball, in this state when the table is launched, strikes the table at this time of the
    period.
    """
    ball, table = ball_at(time, start), table_at(time)
    return conjunction(
        [time >= 0, time < T, equal(height(ball), height(table)), speed(ball) < speed(table)]
    )


def struck(start: Vector, time: Number) -> Vector:
    """The ball's state just after an impact at this time."""
    return vector(collide(table_at(time))(ball_at(time, start)))


def next_bounce(start: Vector, time: Term) -> Vector:
    """The ball's state when the table bounces next, after an impact at this time."""
    return ball_at(T - time, struck(start, time))


def flights(count: Number) -> StateFunction:
    """So many periods of flight, without an impact."""
    return flight(term(count) * T)


def cycle(count: Number, start: Vector = b) -> Vector:
    """The state after this number of periods, of which the first has an impact."""
    return vector(flights(term(count) - 1)(vector(f1(start))))


def comes_back(count: Number, start: Vector = b) -> Formula:
    """After this number of periods, of which the first has an impact, the state is what it was."""
    return equals(cycle(count, start), start)


def within(size: Term, *offsets: Term) -> Formula:
    """Every one of the offsets is smaller in absolute value than the size."""
    return conjunction([part for offset in offsets for part in (-size < offset, offset < size)])


def function_of(printed: Printed, environment: Environment) -> StateFunction:
    """The function of a state that a print names, and says nothing else about."""
    value = Meaning(environment).of(printed.tree)
    if not isinstance(value, StateFunction):
        raise ClaimError("a function of a state is expected here")
    return value


def relations_of(
    printed: Printed, environment: Environment, count: int
) -> list[tuple[Any, str, Any]]:
    """The relations of a print that has to have this many, each with the values on its two
    sides.
    """
    chain = printed.relation_chain(environment)
    if len(chain) != count:
        raise ClaimError(f"this print has {len(chain)} relations, where {count} are expected")
    return chain


def from_threshold_on(count: Number = K) -> tuple[Formula, ...]:
    """0 < alpha < 1, and (count - 1)/(count + 1) <= alpha."""
    return alpha > 0, alpha < 1, alpha * (term(count) + 1) >= term(count) - 1


def eigenvalue_of(matrix: Matrix, real_part: Term, imaginary_part: Term) -> Formula:
    """The complex number is an eigenvalue of the 2 by 2 matrix: real and imaginary part of det(z -
    M) vanish.
    """
    (a, _), (_, d) = ((term(entry) for entry in row) for row in matrix.rows)
    shifted = Matrix(
        tuple(
            tuple((real_part if i == j else 0) - term(entry) for j, entry in enumerate(row))
            for i, row in enumerate(matrix.rows)
        )
    )
    return conjunction(
        [
            equal(term(shifted.determinant()) - imaginary_part**2, 0),
            equal(imaginary_part * (2 * real_part - a - d), 0),
        ]
    )


def next_state_is(state: Vector, says: Callable[[Vector], Formula]) -> Formula:
    """The state one period later is such: with an impact or without."""
    return (B1(state) & says(vector(f1(state)))) | (B2(state) & says(vector(f2(state))))


def offset_with(time: Term) -> Vector:
    """r_0 flown back for this time, shrunk by 1 - alpha and turned round: the offset of f1 for the
    time xi_1.
    """
    return vector(flight_matrix(-time) * r_0).scaled(alpha - 1)


def is_fixed_point(printed: Printed) -> Statement:
    """A state is its own image exactly if it is what is printed for e_1."""
    return always(iff(equals(f1(b), b), printed.formula(PAPER.extended({"e_1": b}))))


def one_image_for_every_state(
    printed: Printed, environment: Environment, given: tuple[Formula, ...] = ()
) -> Assertion:
    """What is printed for f holds of a state and of what becomes of the ball within a period, and
    of nothing else.
    """
    says = printed.formula(environment.extended({r"\overline f": image}))
    return Assertion(
        (
            always(
                iff(equals(image, next_bounce(b, t)), says),
                given=[*given, H(b), strikes_from(b, t)],
                label="with-impact",
            ),
            always(
                iff(equals(image, ball_at(T)), says), given=[*given, B2(b)], label="without-impact"
            ),
        )
    )


def is_the_map(printed: Printed) -> Readings:
    """The cases of f, with B2 as the rest of H, and with B2 as (11) has it."""
    return Readings(
        {
            "rest-of-H": one_image_for_every_state(printed, PAPER),
            "as-in-11": one_image_for_every_state(
                printed, PAPER.extended({r"\mathcal{B}_2": MEETS_LATE}), (different(v, r),)
            ),
        }
    )
