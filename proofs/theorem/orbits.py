"""Orbits in exact numbers with what the theorem's terms and formulas say of their states; the map
itself is that of `scenes.juggler.exact`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from certificates.terms import ClaimError, Formula, term
from proofs.reading.values import Vector
from proofs.theorem.definition import FIXED, SPACE, SPEED
from proofs.theorem.exact import holds_at, value_of
from scenes.juggler import exact

MAX_IMPACTS = 1000  # that an orbit is followed for
MAX_BITS = 20000  # of a numerator or denominator on an orbit


@dataclass(frozen=True)
class State:
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

    def moved(self, image: Vector, **more: Fraction | int) -> State:
        """The state that a derived vector gives here."""
        there = [value_of(term(entry), self.point(**more)) for entry in image.entries]
        return State(self.alpha, there[0], there[1])

    @property
    def strikes(self) -> bool:
        """Whether this period has an impact."""
        return exact.strikes(self.x, self.w)

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


def a_state(alpha: Fraction, x: Fraction, w: Fraction) -> State:
    """The state, which has to be one of H."""
    found = State(alpha, x, w)
    if not found.is_in(SPACE):
        raise ClaimError(f"x = {x} is below the table; a state has x >= 0")
    return found


def flight_length(state: State) -> int:
    """How many periods without an impact follow from this state on."""
    return exact.flight_length(state.x, state.w)


def flown(state: State, periods: int) -> State:
    """The state after so many periods without an impact."""
    return State(state.alpha, *exact.flight(state.x, state.w, periods))


def struck(state: State) -> State:
    """The state after a period with an impact."""
    return State(state.alpha, *exact.impact(state.alpha, state.x, state.w))


def step(state: State) -> State:
    """f: the state after one period."""
    return struck(state) if state.strikes else flown(state, 1)


@dataclass(frozen=True)
class Move:
    """From the period `start` on: a flight of so many periods, or an impact, which takes one."""

    start: int
    state: State
    periods: int
    impact: bool


def moves(state: State, impacts: int = MAX_IMPACTS) -> Iterator[Move]:
    """The orbit, flights at once, up to so many impacts or until its numbers are too long; at its
    end comes an impact.
    """
    count = 0
    for _ in range(impacts):
        periods = flight_length(state)
        if periods:
            yield Move(count, state, periods, False)
            count, state = count + periods, flown(state, periods)
        yield Move(count, state, 1, True)
        count, state = count + 1, struck(state)
        if state.size > MAX_BITS:
            return
