"""The part, its table and its state: exact numbers, and the same in mpmath numbers of so many
digits.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from fractions import Fraction
from typing import Any, NamedTuple

from mpmath import MPContext

from juggleproof.scenes.errors import SceneError

FEWEST_DIGITS = 30
GUARD_DIGITS = 10  # digits left to rounding: times and gaps are told apart to the others
JAMMING = Fraction(4, 3)  # from this friction on a corner of some rectangle can jam


@dataclass(frozen=True)
class Setting:
    """The part and its table; made by `setting`."""

    a: Fraction
    b: Fraction
    e: Fraction
    mu: Fraction
    g: Fraction
    A_x: Fraction
    f_x: Fraction
    phase_x: Fraction
    A_y: Fraction
    f_y: Fraction
    phase_y: Fraction


class State(NamedTuple):
    """The centre of mass in the laboratory's frame at the time t: its place, the angle (0 upright,
    counterclockwise), and their velocities.
    """

    t: Any
    X: Any
    Y: Any
    theta: Any
    VX: Any
    VY: Any
    omega: Any


def exact(value: Any, name: str) -> Fraction:
    """A number as the rational that it is; floats are the binary numbers that they are.

    >>> exact("0.7", "e"), exact(0.5, "e")
    (Fraction(7, 10), Fraction(1, 2))
    """
    try:
        return Fraction(value)
    except (ValueError, TypeError, OverflowError, ZeroDivisionError) as error:
        raise SceneError(f"{name} = {value!r} is not a number") from error


def setting(
    a: Any,
    b: Any,
    *,
    e: Any,
    mu: Any,
    g: Any = "9.81",
    A_x: Any = 0,
    f_x: Any = 0,
    phase_x: Any = 0,
    A_y: Any = 0,
    f_y: Any = 0,
    phase_y: Any = 0,
) -> Setting:
    """A rectangle of half-sides a and b on a table at A sin(2 pi f t + phase), along x and along y;
    metres, seconds, radians.

    >>> setting("0.01", "0.02", e="0.7", mu="0.08").mu
    Fraction(2, 25)
    """
    given = locals()
    numbers = Setting(
        **{field.name: exact(given[field.name], field.name) for field in fields(Setting)}
    )
    allowed = {
        "a": ("> 0", numbers.a > 0),
        "b": ("> 0", numbers.b > 0),
        "e": ("from 0 to 1", 0 <= numbers.e <= 1),
        "g": ("> 0", numbers.g > 0),
        "mu": ("from 0 to less than 4/3, where a corner can jam", 0 <= numbers.mu < JAMMING),
        "f_x": (">= 0", numbers.f_x >= 0),
        "f_y": (">= 0", numbers.f_y >= 0),
    }
    for name, (what, holds) in allowed.items():
        if not holds:
            raise SceneError(f"{name} = {given[name]} is not allowed: {name} must be {what}")
    return numbers


class Model:
    """A setting in mpmath numbers, in a context of its own, so that mpmath's global precision is
    left alone.
    """

    def __init__(self, numbers: Setting, digits: int) -> None:
        if digits < FEWEST_DIGITS:
            raise SceneError(f"digits = {digits} is too few: at least {FEWEST_DIGITS}")
        self.context = MPContext()
        self.context.dps = digits
        lifted = {field.name: self.lift(getattr(numbers, field.name)) for field in fields(Setting)}
        self.a, self.b, self.e, self.mu, self.g = (
            lifted[name] for name in ("a", "b", "e", "mu", "g")
        )
        self.sideways, self.upwards = (
            tuple(lifted[f"{name}_{axis}"] for name in ("A", "f", "phase")) for axis in "xy"
        )
        self.k2 = (self.a**2 + self.b**2) / 3
        self.rho = self.context.sqrt(self.a**2 + self.b**2)
        self.noise = self.context.mpf(10) ** (GUARD_DIGITS - digits)

    def lift(self, value: Any) -> Any:
        """A number in this context: exact ones divided once, those of mpmath as they are."""
        if hasattr(value, "_mpf_"):
            if not self.context.isfinite(value):
                raise SceneError(f"{value} is not a finite number")
            return self.context.mpf(value)
        number = exact(value, "a number")
        return self.context.mpf(number.numerator) / number.denominator

    def lifted(self, state: State) -> State:
        return State(*map(self.lift, state))

    def table(self, t: Any) -> tuple[Any, Any, Any]:
        """The table at the time t: its height, and its velocity sideways and upwards.

        >>> still = Model(setting(1, 2, e=1, mu=0, A_y=3), 30)
        >>> [int(part) for part in still.table(still.lift(5))]
        [0, 0, 0]
        """
        _, along = self._shaken(self.sideways, t)
        height, up = self._shaken(self.upwards, t)
        return height, along, up

    def _shaken(self, axis: tuple[Any, ...], t: Any) -> tuple[Any, Any]:
        """A sin(W t + phase) and its rate."""
        amplitude, frequency, phase = axis
        if not amplitude:
            return amplitude, amplitude
        W = 2 * self.context.pi * frequency
        cosine, sine = self.context.cos_sin(W * t + phase)
        return amplitude * sine, amplitude * W * cosine

    def greatest_table_acceleration(self) -> Any:
        """A bound of the table's acceleration upwards and downwards: A_y W^2."""
        amplitude, frequency, _ = self.upwards
        return abs(amplitude) * (2 * self.context.pi * frequency) ** 2
