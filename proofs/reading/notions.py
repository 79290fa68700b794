"""Values that are not numbers: functions of a state, regions, restrictions, cases, limits and
extrema.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from certificates.terms import Formula, implies
from proofs.reading.values import Scalar, ShapeError, Vector


def applied(function: Callable[..., Any], *arguments: Any) -> Any:
    """The function at these arguments; arguments that it is not made for raise ShapeError."""
    try:
        return function(*arguments)
    except (TypeError, AttributeError) as problem:
        kinds = ", ".join(type(argument).__name__.lower() for argument in arguments)
        raise ShapeError(f"a function that cannot take ({kinds})") from problem


@dataclass(frozen=True, slots=True)
class StateFunction:
    """A function of a state, applied to a bracketed state; a bracketed scalar after it is refused.

    With `factor` set, a bracketed scalar makes a product: tau_c(b) is an application, and in tau_c
    (v - r) the function stands for its value at the present state.
    """

    call: Callable[..., Any]
    factor: bool = False

    def __call__(self, *arguments: Any) -> Any:
        for argument in arguments:
            if not isinstance(argument, Vector):
                raise ShapeError("a function of a state, given something else")
        return self.call(*arguments)


@dataclass(frozen=True, slots=True)
class Region:
    """A set of states, by the formula that a state is in it."""

    holds: Callable[[Vector], Formula]

    def __call__(self, state: Vector) -> Formula:
        return self.holds(state)

    def __and__(self, other: Region) -> Region:
        return Region(lambda state: self(state) & other(state))

    def __or__(self, other: Region) -> Region:
        return Region(lambda state: self(state) | other(state))

    def __sub__(self, other: Region) -> Region:
        return Region(lambda state: self(state) & ~other(state))


@dataclass(frozen=True, slots=True)
class Image:
    """The image of a region under a function; it is met only on the left of an inclusion."""

    function: Callable[[Vector], Any]
    region: Region


@dataclass(frozen=True, slots=True)
class Restricted:
    """A function on a region only."""

    function: Callable[..., Any]
    region: Region

    def __call__(self, state: Vector) -> Guarded:
        return Guarded(self.region(state), applied(self.function, state))


@dataclass(frozen=True, slots=True)
class Guarded:
    """A value that is only spoken of under a condition."""

    condition: Formula
    value: Any

    def under(self, conclusion: Formula) -> Formula:
        """The conclusion, under the condition."""
        return implies(self.condition, conclusion)


@dataclass(frozen=True, slots=True)
class Piece:
    """One line of a list of cases: a value, its condition, and what the line says besides (a chain
    on its left).
    """

    value: Any
    condition: Formula
    besides: Formula | None = None


@dataclass(frozen=True, slots=True)
class Piecewise:
    """A list of cases."""

    pieces: tuple[Piece, ...]


@dataclass(frozen=True, slots=True)
class Rounded:
    r"""The greatest integer below (\lfloor) or the least above (\lceil)."""

    bracket: str
    value: Scalar | ExtremalValue


@dataclass(frozen=True, slots=True)
class ExtremalValue:
    r"""\max, \min, \sup or \inf of a value under a condition."""

    sign: str
    condition: Formula | None
    value: Any


@dataclass(frozen=True, slots=True)
class LimitValue:
    r"""The limit of a value as the named variable goes to the named destination (both as LaTeX)."""

    variable: str
    destination: str
    value: Any
