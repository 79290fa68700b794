"""The part in flight: its centre on a parabola, turning evenly; the gaps between its four corners
and the table.
"""

from __future__ import annotations

from typing import Any

from juggleproof.scenes.part.reference.setting import Model, Setting, State

CORNERS = (
    (1, 1),
    (-1, 1),
    (-1, -1),
    (1, -1),
)  # corner i is R(theta) (a, b) with these signs: counterclockwise, 2 and 3 below when upright


def places(model: Model, theta: Any) -> list[tuple[Any, Any]]:
    """The four corners from the centre of mass: (+-a, +-b) turned by theta.

    >>> from fractions import Fraction
    >>> model = Model(Setting(*map(Fraction, (3, 4, 0, 0, 1, 0, 0, 0, 0, 0, 0))), 30)
    >>> [(int(x), int(y)) for x, y in places(model, model.lift(0))]
    [(3, 4), (-3, 4), (-3, -4), (3, -4)]
    """
    cosine, sine = model.context.cos_sin(theta)
    ends = [(along * model.a, up * model.b) for along, up in CORNERS]
    return [(cosine * x - sine * y, sine * x + cosine * y) for x, y in ends]


class Flight:
    """The flight that leaves a state."""

    def __init__(self, model: Model, start: State) -> None:
        self.model, self.start = model, start

    def state(self, t: Any) -> State:
        """The state at the time t: the parabola, and the even turn."""
        start, lasted = self.start, t - self.start.t
        return State(
            t,
            start.X + start.VX * lasted,
            start.Y + start.VY * lasted - self.model.g * lasted**2 / 2,
            start.theta + start.omega * lasted,
            start.VX,
            start.VY - self.model.g * lasted,
            start.omega,
        )

    def gaps(self, t: Any) -> list[tuple[Any, Any]]:
        """The gap between each corner and the table at the time t, and its rate.

        >>> from fractions import Fraction
        >>> model = Model(Setting(*map(Fraction, (3, 4, 0, 0, 10, 0, 0, 0, 0, 0, 0))), 30)
        >>> flight = Flight(model, model.lifted(State(0, 0, 9, 0, 0, 0, 2)))
        >>> [(int(gap), int(rate)) for gap, rate in flight.gaps(model.lift(0))]
        [(13, 6), (13, -6), (5, -6), (5, 6)]
        """
        now, (height, _, up) = self.state(t), self.model.table(t)
        return [
            (now.Y + y - height, now.VY + now.omega * x - up)
            for x, y in places(self.model, now.theta)
        ]

    def bound(self) -> Any:
        """A bound of the second derivative of every gap: gravity, the table's acceleration, and
        omega^2 times the corner's distance.
        """
        return (
            self.model.g
            + self.model.greatest_table_acceleration()
            + self.start.omega**2 * self.model.rho
        )


def dropped(
    setting: Setting,
    theta: Any,
    height: Any,
    *,
    X: Any = 0,
    VX: Any = 0,
    VY: Any = 0,
    omega: Any = 0,
    t: Any = 0,
    digits: int = 50,
) -> State:
    """The state at the time t whose lowest corner stands so high above the table.

    For a comparison with an integrator in float64, round it and start both at
    `State(*map(float, state))`.

    >>> from fractions import Fraction
    >>> block = Setting(*map(Fraction, (3, 4, 0, 0, 10, 0, 0, 0, 0, 0, 0)))
    >>> int(dropped(block, 0, 2).Y)
    6
    """
    model = Model(setting, digits)
    start = model.lifted(State(t, X, 0, theta, VX, VY, omega))
    lowest = min(gap for gap, _ in Flight(model, start).gaps(start.t))
    return start._replace(Y=model.lift(height) - lowest)
