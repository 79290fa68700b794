"""What a method answers, and what was measured of it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any


class GaveUp(Exception):
    """The method ends without the width that was asked for; the message says why."""


@dataclass(frozen=True)
class Answer:
    """low <= supremum <= high as the method says; without `high` it is a value and no bound.
    `note` tells what else there is to say.
    """

    low: Fraction
    high: Fraction | None = None
    note: str = ""

    def as_json(self) -> dict[str, Any]:
        """For another process."""
        return {
            "low": str(self.low),
            "high": None if self.high is None else str(self.high),
            "note": self.note,
        }

    def error(self, truth: Fraction) -> Fraction:
        """The width of the enclosure; the distance to the truth where there is none."""
        return abs(truth - self.low) if self.high is None else self.high - self.low

    def wrong(self, truth: Fraction) -> bool:
        """Whether an enclosure does not hold the truth."""
        return self.high is not None and not self.low <= truth <= self.high


@dataclass(frozen=True)
class Strayed:
    """How far a state is from the exact one, and what the method says of that: a bound, or None
    where it says nothing.
    """

    distance: Fraction
    bound: Fraction | None
    note: str = ""
    beyond: bool = False  # whether the state is farther off than the bound says

    def as_json(self) -> dict[str, Any]:
        """For another process."""
        bound = None if self.bound is None else str(self.bound)
        return {
            "distance": str(self.distance),
            "bound": bound,
            "note": self.note,
            "beyond": self.beyond,
        }

    def error(self, truth: Fraction) -> Fraction:
        """The bound where there is one."""
        return self.distance if self.bound is None else self.bound

    def wrong(self, truth: Fraction) -> bool:
        """Whether the state is farther off than the bound says."""
        return self.beyond


def read_answer(data: dict[str, Any]) -> Answer | Strayed:
    """What `as_json` wrote."""

    def number(key: str) -> Fraction | None:
        return None if data[key] is None else Fraction(data[key])

    if "distance" in data:
        return Strayed(Fraction(data["distance"]), number("bound"), data["note"], data["beyond"])
    return Answer(Fraction(data["low"]), number("high"), data["note"])


@dataclass(frozen=True)
class Measured:
    """One method on one piece of work: its answer with its seconds, or why there is none."""

    method: str
    size: Fraction
    cold: float | None = None
    warm: float | None = None
    answer: Answer | Strayed | None = None
    reason: str = ""

    @property
    def seconds(self) -> float | None:
        """Warm, or cold where there was no time for more."""
        return self.cold if self.warm is None else self.warm
