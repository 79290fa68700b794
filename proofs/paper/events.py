"""What happens within a period, in formulas of derived flight and impact: ball and table meet,
approach, collide, and fly on.

A time at which something happens is left unknown and told by what happens then: nothing that was
solved for enters here.
"""

from __future__ import annotations

from typing import Any

from certificates.terms import Formula, Number, Term, conjunction, equal, term
from proofs.paper.vocabulary import T, b, collide, flight, r, r_0, v
from proofs.reading.environment import Environment
from proofs.reading.meaning import Meaning
from proofs.reading.notions import Region, StateFunction
from proofs.reading.printed import Printed
from proofs.reading.values import ShapeError, Vector


def ball_at(time: Number, start: Vector = b) -> Vector:
    """The ball's state after free flight for this time."""
    return vector(flight(time)(start))


def table_at(time: Number, start: Vector | None = None) -> Vector:
    """The table's state after free flight for this time, from its launch unless told otherwise."""
    return vector(flight(time)(r_0 if start is None else start))


def vector(value: Any) -> Vector:
    """The value itself, which has to be a state."""
    if not isinstance(value, Vector):
        raise ShapeError("a state was expected")
    return value


def as_region(value: Any) -> Region:
    """The value itself, which has to be a region."""
    if not isinstance(value, Region):
        raise ShapeError("a region was expected")
    return value


def height(state: Vector) -> Term:
    """The first component of a state."""
    return term(state.component(1))


def speed(state: Vector) -> Term:
    """The second component of a state."""
    return term(state.component(2))


def meet(time: Number, ball: Vector = b) -> Formula:
    """Ball and table are at one height at this time, if neither is deflected before."""
    return equal(height(ball_at(time, ball)), height(table_at(time)))


def strikes_at(time: Term) -> Formula:
    """The ball strikes the table at this time, which lies within the period: they meet, and
    approach each other.
    """
    return conjunction([time >= 0, time < T, meet(time), v < r])


def after_impact(time: Number) -> Vector:
    """The ball's state just after an impact at this time."""
    return vector(collide(table_at(time))(ball_at(time)))


def only_at(place: Vector, value: Any, factor: bool = False) -> StateFunction:
    """The function that has this value at this state, and is refused at any other."""

    def call(state: Vector) -> Any:
        if state != place:
            raise ShapeError("this function is known at the state of the claim only")
        return value

    return StateFunction(call, factor)


def value_of(printed: Printed, environment: Environment) -> Any:
    """The value of a print that is an expression and states no relation."""
    return Meaning(environment).here(printed.tree)
