"""The impact of one corner, walked literally through impulse space: the normal impulse grows,
friction is what Coulomb says at each moment.

The corner slides, and friction is mu times the normal impulse against it, until it stops; then it
sticks where the friction that holds it is at most that, and slides off where it is more.
Compression ends where the corner no longer approaches, at the normal impulse n; the impact ends at
(1 + e) n (Poisson).  Numbers of any kind: exact rationals, or mpmath's.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from juggleproof.scenes.errors import SceneError

Motion = tuple[
    Any, Any, Any
]  # velocity of the centre of mass relative to the table, and angular velocity
Vector = tuple[Any, Any]
AT_REST = (0, 0, 0)


class Impact(NamedTuple):
    """The impulse on the part (per unit of its mass), its motion after it, and how the corner moved
    meanwhile.
    """

    impulse: Vector
    motion: Motion
    mode: str


def corner_velocity(motion: Motion, place: Vector) -> Vector:
    """The velocity of the point of the part that stands there from its centre (rigid body).

    >>> corner_velocity((1, 2, 10), (3, 4))
    (-39, 32)
    """
    (v_x, v_y, omega), (x, y) = motion, place
    return v_x - omega * y, v_y + omega * x


def pushed(motion: Motion, place: Vector, k2: Any, impulse: Vector) -> Motion:
    """The motion after an impulse there; k2 is the square of the radius of gyration (momentum and
    angular momentum).

    >>> from fractions import Fraction
    >>> pushed((0, 0, 0), (3, 4), Fraction(2), (1, 0))
    (1, 0, Fraction(-2, 1))
    """
    (v_x, v_y, omega), (x, y), (along, up) = motion, place, impulse
    return v_x + along, v_y + up, omega + (x * up - y * along) / k2


def impact(motion: Motion, place: Vector, k2: Any, e: Any, mu: Any) -> Impact:
    """The impact of a corner that approaches the table; the motion is that relative to the table.

    A part that falls on the corner below its centre leaves with e times its speed:

    >>> from fractions import Fraction
    >>> half = Fraction(1, 2)
    >>> fallen = impact((0, -2, 0), (0, -5), Fraction(25, 3), half, half)
    >>> fallen.motion == (0, 1, 0), fallen.mode
    (True, 'sticking-in-compression')

    One that slides along stops there if friction is strong enough, and turns:

    >>> impact((Fraction(1), -2, 0), (0, -5), Fraction(25, 3), half, half)[::2]
    ((Fraction(-1, 4), Fraction(3, 1)), 'sticking-in-compression')
    >>> impact((Fraction(1), -2, 0), (0, -5), Fraction(25, 3), half, half / 50)[::2]
    ((Fraction(-3, 100), Fraction(3, 1)), 'sliding')
    """

    def growth(slope: Any) -> Vector:
        """What a unit of normal impulse, with so much friction, adds to the corner's velocity."""
        return corner_velocity(pushed(AT_REST, place, k2, (slope, 1)), place)

    def from_a_stop() -> tuple[int, Any]:
        """The way in which a corner without tangential velocity goes on, and its friction: it
        sticks where friction can hold it.
        """
        frictionless, with_friction = growth(0)[0], growth(1)[0]
        holding = frictionless / (frictionless - with_friction)
        if abs(holding) <= mu:
            return 0, holding
        return (-1, mu) if holding > 0 else (1, -mu)

    tangential, normal = corner_velocity(motion, place)
    if not normal < 0:
        raise SceneError(f"the corner does not approach the table: its normal velocity is {normal}")
    way, slope = (1, -mu) if tangential > 0 else (-1, mu) if tangential < 0 else from_a_stop()
    stopped = None if way else "compression"
    along, up, end = 0, 0, None
    while end is None or up < end:
        along_rate, up_rate = growth(slope)
        if not up_rate > 0:
            raise SceneError(f"friction jams the corner at {place}: mu = {mu} is too large")
        step = -normal / up_rate if end is None else end - up
        until_stop = (
            -tangential / along_rate if stopped is None and way * along_rate < 0 else None
        )  # it stops once
        stops = until_stop is not None and (
            until_stop <= step if end is None else until_stop < step
        )
        if stops:
            step = until_stop
        along, up = along + slope * step, up + step
        tangential, normal = tangential + along_rate * step, normal + up_rate * step
        if stops:
            tangential, stopped = 0, "compression" if end is None else "restitution"
            way, slope = from_a_stop()
        elif end is None:
            end = (1 + e) * up
        else:
            up = end
    return Impact((along, up), pushed(motion, place, k2, (along, up)), _mode(way, stopped))


def _mode(way: int, stopped: str | None) -> str:
    """Wang and Mason's name for how the corner moved: where it stopped, if it did, and whether it
    stuck.
    """
    if stopped is None:
        return "sliding"
    return f"{'reversed' if way else 'sticking'}-in-{stopped}"
