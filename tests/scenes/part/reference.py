"""The part followed slowly and to many digits, from the laws of mechanics alone: the reference that
the fast integrator `juggleproof.scenes.part` is measured against.

    from tests.scenes.part.reference import dropped, reference_orbit, setting

    block = setting("0.01", "0.02", e="0.7", mu="0.08", A_y="0.0002", f_y=60)
    reference_orbit(block, dropped(block, theta="0.5", height="0.001"), until="0.1")

It knows flights and impacts of one corner, and nothing of rest: it stops where impacts accumulate
(`Chatter`), where two corners strike together (`Simultaneous`), and where a corner grazes the table
too closely to tell (`Undecided`).  Nothing is proved: rounding is not enclosed.

The part and its table, where the reference stops, flight, impact, contact, the orbit: SI units.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from fractions import Fraction
from typing import NamedTuple, TypeAlias

from mpmath import MPContext, mpf

from juggleproof.scenes.errors import SceneError

# -------------------------------------------------------------------------------------------------
# The part, its table and its state: exact numbers, and the same in mpmath numbers.

GUARD_DIGITS = 10  # digits left to rounding: times and gaps are distinguished to the others
Number: TypeAlias = mpf | Fraction | float
Given: TypeAlias = Number | str


@dataclass(frozen=True)
class Setting:
    """A rectangle of half-sides a and b, its restitution and friction, gravity, and its table at
    A sin(2 pi f t + phase), along x and along y; made by `setting`.
    """

    a: Fraction
    b: Fraction
    e: Fraction
    mu: Fraction
    g: Fraction = Fraction("9.81")
    A_x: Fraction = Fraction(0)
    f_x: Fraction = Fraction(0)
    phase_x: Fraction = Fraction(0)
    A_y: Fraction = Fraction(0)
    f_y: Fraction = Fraction(0)
    phase_y: Fraction = Fraction(0)


class State(NamedTuple):
    """The centre of mass in the laboratory's frame at the time t: its place, the angle (0 upright,
    counterclockwise), and their velocities.
    """

    t: Number = 0
    X: Number = 0
    Y: Number = 0
    theta: Number = 0
    VX: Number = 0
    VY: Number = 0
    omega: Number = 0


def exact(value: Given) -> Fraction:
    """A number as the rational that it is; floats are the binary numbers that they are.

    >>> exact("0.7"), exact(0.5)
    (Fraction(7, 10), Fraction(1, 2))
    """
    return Fraction(value)


def setting(a: Given, b: Given, **others: Given) -> Setting:
    """A setting of half-sides a and b, and `others` by the names of its fields.

    >>> setting("0.01", "0.02", e="0.7", mu="0.08").mu
    Fraction(2, 25)
    """
    given = {"a": a, "b": b, **others}
    return Setting(**{name: exact(value) for name, value in given.items()})


class Model:
    """A setting in mpmath numbers, in a context of its own, so that mpmath's global precision is
    left alone.
    """

    def __init__(self, numbers: Setting, digits: int) -> None:
        self.context = MPContext()
        self.context.dps = digits
        lifted = {name: self.lift(value) for name, value in asdict(numbers).items()}
        self.a, self.b, self.e, self.mu, self.g = (
            lifted[name] for name in ("a", "b", "e", "mu", "g")
        )
        self.sideways, self.upwards = (
            tuple(lifted[f"{name}_{axis}"] for name in ("A", "f", "phase")) for axis in "xy"
        )
        self.k2 = (self.a**2 + self.b**2) / 3
        self.rho = self.context.sqrt(self.a**2 + self.b**2)
        self.ends = [(along * self.a, up * self.b) for along, up in CORNERS]
        self.noise = self.context.mpf(10) ** (GUARD_DIGITS - digits)

    def lift(self, value: Given) -> mpf:
        """A number in this context: exact ones divided once, those of mpmath as they are."""
        if hasattr(value, "_mpf_"):
            return self.context.mpf(value)
        number = exact(value)
        return self.context.mpf(number.numerator) / number.denominator

    def lifted(self, state: State) -> State:
        return State(*map(self.lift, state))

    def table(self, t: mpf) -> tuple[mpf, mpf, mpf]:
        """The table at the time t: its height, and its velocity sideways and upwards.

        >>> still = Model(setting(1, 2, e=1, mu=0, A_y=3), 30)
        >>> [int(part) for part in still.table(still.lift(5))]
        [0, 0, 0]
        """
        _, along = self._shaken(self.sideways, t)
        height, up = self._shaken(self.upwards, t)
        return height, along, up

    def steepest(self) -> mpf:
        """A bound of the table's acceleration upwards."""
        amplitude, frequency, _ = self.upwards
        return abs(amplitude) * (2 * self.context.pi * frequency) ** 2

    def _shaken(self, axis: tuple[mpf, ...], t: mpf) -> tuple[mpf, mpf]:
        """A sin(W t + phase) and its rate."""
        amplitude, frequency, phase = axis
        if not amplitude:
            return amplitude, amplitude
        W = 2 * self.context.pi * frequency
        cosine, sine = self.context.cos_sin(W * t + phase)
        return amplitude * sine, amplitude * W * cosine


# -------------------------------------------------------------------------------------------------
# Where the reference stops: neither a flight nor the impact of one corner.


class Stopped(SceneError):
    """The orbit cannot be followed further; `events` holds what it met until then."""

    events: tuple[Event, ...] = ()


class Chatter(Stopped):
    """Impacts accumulate, or an impact leaves the corner on the table: the part comes to rest on a
    corner.
    """


class Simultaneous(Stopped):
    """Two corners strike together."""


class Undecided(Stopped):
    """A corner grazes the table: whether it strikes lies within the rounding."""


# -------------------------------------------------------------------------------------------------
# The part in flight: its centre on a parabola, turning evenly; the gaps between its four corners
# and the table.

# corner i is R(theta) (a, b) with these signs: counterclockwise, 2 and 3 below when upright
CORNERS = ((1, 1), (-1, 1), (-1, -1), (1, -1))


def places(model: Model, theta: mpf) -> list[tuple[mpf, mpf]]:
    """The four corners from the centre of mass: (+-a, +-b) turned by theta.

    >>> model = Model(setting(3, 4, e=0, mu=0), 30)
    >>> [(int(x), int(y)) for x, y in places(model, model.lift(0))]
    [(3, 4), (-3, 4), (-3, -4), (3, -4)]
    """
    cosine, sine = model.context.cos_sin(theta)
    return [(cosine * x - sine * y, sine * x + cosine * y) for x, y in model.ends]


class Flight:
    """The flight that leaves a state."""

    def __init__(self, model: Model, start: State) -> None:
        self.model, self.start = model, start

    def state(self, t: mpf) -> State:
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

    def gaps(self, t: mpf) -> list[tuple[mpf, mpf]]:
        """The gap between each corner and the table at the time t, and its rate.

        >>> model = Model(setting(3, 4, e=0, mu=0, g=10), 30)
        >>> flight = Flight(model, model.lifted(State(Y=9, omega=2)))
        >>> [(int(gap), int(rate)) for gap, rate in flight.gaps(model.lift(0))]
        [(13, 6), (13, -6), (5, -6), (5, 6)]
        """
        now, (height, _, up) = self.state(t), self.model.table(t)
        return [
            (now.Y + y - height, now.VY + now.omega * x - up)
            for x, y in places(self.model, now.theta)
        ]

    def bound(self) -> mpf:
        """A bound of the second derivative of every gap: gravity, the table's acceleration, and
        omega^2 times the corner's distance.
        """
        model = self.model
        return model.g + model.steepest() + self.start.omega**2 * model.rho


def dropped(
    setting: Setting | Model, theta: Given, height: Given, digits: int = 50, **others: Given
) -> State:
    """The state whose lowest corner stands so high above the table; `others` by their names.

    For a comparison with an integrator in float64, round it and start both at
    `State(*map(float, state))`.

    >>> int(dropped(setting(3, 4, e=0, mu=0), 0, 2).Y)
    6
    """
    model = setting if isinstance(setting, Model) else Model(setting, digits)
    start = model.lifted(State(theta=theta, **others))
    lowest = min(gap for gap, _ in Flight(model, start).gaps(start.t))
    return start._replace(Y=model.lift(height) - lowest)


# -------------------------------------------------------------------------------------------------
# The impact of one corner, walked literally through impulse space: the normal impulse grows,
# friction is what Coulomb says at each moment.
#
# The corner slides, and friction is mu times the normal impulse against it, until it stops; then it
# sticks where the friction that holds it is at most that, and slides off where it is more.
# Compression ends where the corner no longer approaches, at the normal impulse n; the impact ends
# at (1 + e) n (Poisson).  Numbers of any kind: exact rationals, or mpmath's.

# velocity of the centre of mass relative to the table, and angular velocity
Motion = tuple[Number, Number, Number]
Vector = tuple[Number, Number]


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


def pushed(motion: Motion, place: Vector, k2: Number, impulse: Vector) -> Motion:
    """The motion after an impulse there; k2 is the square of the radius of gyration (momentum and
    angular momentum).

    >>> pushed((0, 0, 0), (3, 4), Fraction(2), (1, 0))
    (1, 0, Fraction(-2, 1))
    """
    (v_x, v_y, omega), (x, y), (along, up) = motion, place, impulse
    return v_x + along, v_y + up, omega + (x * up - y * along) / k2


def impact(motion: Motion, place: Vector, k2: Number, e: Number, mu: Number) -> Impact:
    """The impact of a corner that approaches the table; the motion is that relative to the table.

    A part that falls on the corner below its centre leaves with e times its speed:

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

    def growth(slope: Number) -> Vector:
        """What a unit of normal impulse, with so much friction, adds to the corner's velocity."""
        return corner_velocity(pushed((0, 0, 0), place, k2, (slope, 1)), place)

    def from_a_stop() -> tuple[int, Number]:
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
        # it stops once
        until_stop = -tangential / along_rate if stopped is None and way * along_rate < 0 else None
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


# -------------------------------------------------------------------------------------------------
# The first time at which one of several gaps falls to 0, found so that none can be skipped: pieces
# of time are halved until each is decided.
#
# With |gap''| <= M, at the middle m of a piece of half-width h:
# gap(m) - |gap'(m)| h - M h^2/2 > 0 leaves no root in it; |gap'(m)| > M h makes the gap rise or
# fall through all of it.

Gaps = Callable[[mpf], list[tuple[mpf, mpf]]]  # the gaps at a time, each with its rate
MOST_STEPS = 1000


def first_crossing(
    gaps: Gaps, bound: mpf, start: mpf, end: mpf, noise: mpf
) -> tuple[mpf, int] | None:
    """The first time from start to end at which a gap falls from above 0 to 0, and which one; none
    where there is no such time.

    Numbers closer than the noise are not distinguished: Undecided is raised for a gap that touches
    0 so closely.

    >>> first_crossing(lambda t: [(2 - t, -1), (3 - 2 * t, -2)], 0, mpf(0), mpf(8), mpf("1e-9"))
    (mpf('1.5'), 1)
    >>> touching = lambda t: [((t - 2)**2 + mpf("0.001"), 2 * (t - 2))]
    >>> first_crossing(touching, 2, mpf(0), mpf(8), mpf("1e-9"))
    """
    pieces = [(start, end, list(range(len(gaps(start)))))]
    while pieces:
        left, right, watched = pieces.pop()
        half = (right - left) / 2
        middle = left + half
        falling, unclear = _sorted_out(gaps(middle), watched, bound, half, noise)
        if unclear:
            if bound * half**2 < noise:
                raise Undecided(f"a corner grazes the table near t = {middle}")
            pieces += [(middle, right, falling + unclear), (left, middle, falling + unclear)]
            continue
        there = gaps(right) if falling else []
        crossings = [
            (crossing(gaps, one, left, right, noise), one) for one in falling if there[one][0] <= 0
        ]
        if crossings:
            return min(crossings)
    return None


def _sorted_out(
    here: list[tuple[mpf, mpf]], watched: list[int], bound: mpf, half: mpf, noise: mpf
) -> tuple[list[int], list[int]]:
    """Those of the watched gaps that fall through all of the piece, and those that are not decided;
    the others do not fall to 0 in it.
    """
    falling, unclear = [], []
    for one in watched:
        gap, rate = here[one]
        if gap - abs(rate) * half - bound * half**2 / 2 > noise:
            continue
        if abs(rate) - bound * half <= noise:
            unclear.append(one)
        elif rate < 0:
            falling.append(one)
    return falling, unclear


def crossing(gaps: Gaps, one: int, left: mpf, right: mpf, width: mpf) -> mpf:
    """The root of a gap that falls from above 0 to below, from the side where it is above, to this
    width (the Illinois method); Undecided where the gap does not change its sign.

    >>> crossing(lambda t: [(1 - t**2, -2 * t)], 0, mpf(0), mpf(3), mpf("1e-15")) - 1 < mpf("1e-15")
    True
    """
    above, below = gaps(left)[one][0], gaps(right)[one][0]
    if not above > 0 >= below:
        raise Undecided(
            f"no corner is known to be above the table at t = {left} and below it at t = {right}"
        )
    if below == 0:
        return right
    moved = 0
    for _ in range(MOST_STEPS):
        if right - left <= width:
            return left
        guess = right - below * (right - left) / (below - above)
        if not left < guess < right:
            guess = (left + right) / 2
        gap = gaps(guess)[one][0]
        if gap == 0:
            return guess
        if gap > 0:
            left, above, below = guess, gap, below / 2 if moved > 0 else below
        else:
            right, below, above = guess, gap, above / 2 if moved < 0 else above
        moved = 1 if gap > 0 else -1
    raise Undecided(f"the root near t = {left} is not found to the width {width}")


# -------------------------------------------------------------------------------------------------
# The orbit of the part: flight, impact of a corner, flight, as long as there is nothing else.

TOGETHER = "1e-12"  # metres: corners so close to the table strike together
MOST_IMPACTS, WITHIN = 20, "1e-6"  # more impacts in so many seconds are chatter


class Event(NamedTuple):
    """An impact: when, of which corner (an index of CORNERS), in which mode, and the states before
    and after it.
    """

    time: mpf
    corner: int
    mode: str
    before: State
    after: State


def reference_orbit(
    setting: Setting | Model,
    start: State,
    until: Given,
    digits: int = 50,
    *,
    together: Given = TOGETHER,
) -> list[Event]:
    """The impacts from a state in flight until a time; Stopped where it cannot be followed, with
    the impacts until then in `events`; SceneError for a start that does not fly.

    Dropped by 0.2 m under g = 10, with its centre above the corner, a part strikes after 0.2 s and,
    with e = 1/2, again after 0.2 s:

    >>> from math import atan
    >>> block = setting(3, 4, e="1/2", mu="1/2", g=10)
    >>> tilted = dropped(block, theta=atan(3 / 4), height="0.2")
    >>> events = reference_orbit(block, tilted, until="0.41")
    >>> [(f"{float(event.time):.12f}", event.corner) for event in events]
    [('0.200000000000', 2), ('0.400000000000', 2)]
    """
    model = setting if isinstance(setting, Model) else Model(setting, digits)
    begun, last = model.lifted(start), model.lift(until)
    _refuse_what_does_not_fly(model, begun, last)
    events: list[Event] = []
    try:
        for event in _impacts(model, begun, last, model.lift(together)):
            events.append(event)
            many = len(events) > MOST_IMPACTS
            if many and event.time - events[-1 - MOST_IMPACTS].time < model.lift(WITHIN):
                raise Chatter(
                    f"more than {MOST_IMPACTS} impacts within {WITHIN} s before t ="
                    f" {float(event.time):.9f}"
                )
    except Stopped as stopped:
        stopped.events = tuple(events)
        raise
    return events


def _refuse_what_does_not_fly(model: Model, start: State, last: mpf) -> None:
    for corner, (gap, rate) in enumerate(Flight(model, start).gaps(start.t)):
        if not (gap > 0 or (gap == 0 and rate > 0)):
            raise SceneError(
                f"corner {corner} is not above the table at the start: its gap is"
                f" {float(gap):.3g} m"
            )


def _impacts(model: Model, start: State, last: mpf, together: mpf) -> Iterator[Event]:
    while True:
        flight = Flight(model, start)
        met = first_crossing(flight.gaps, flight.bound(), start.t, last, model.noise)
        if met is None:
            return
        event = struck(model, flight, *met)
        refuse_others_that_strike_too(flight, event, together)
        yield event
        if Flight(model, event.after).gaps(event.time)[event.corner][1] ** 2 <= model.noise:
            raise Chatter(
                f"corner {event.corner} stays on the table at t = {float(event.time):.9f}"
            )
        start = event.after


def struck(model: Model, flight: Flight, time: mpf, corner: int) -> Event:
    """The impact of a corner at this time of a flight: only the velocities change."""
    before = flight.state(time)
    _, along, up = model.table(time)
    met = impact(
        (before.VX - along, before.VY - up, before.omega),
        places(model, before.theta)[corner],
        model.k2,
        model.e,
        model.mu,
    )
    push_along, push_up = met.impulse
    return Event(
        time,
        corner,
        met.mode,
        before,
        before._replace(VX=before.VX + push_along, VY=before.VY + push_up, omega=met.motion[2]),
    )


def refuse_others_that_strike_too(flight: Flight, event: Event, together: mpf) -> None:
    """Raise where another corner is as good as on the table and approaches it, before this impact
    or after it.

    Both impulses would have to be taken symmetrically, so that a mirrored start gives the mirrored
    orbit; the law of one corner says nothing of it.
    """
    after = Flight(flight.model, event.after).gaps(event.time)
    for corner, (gap, rate) in enumerate(flight.gaps(event.time)):
        if corner != event.corner and gap <= together and min(rate, after[corner][1]) < 0:
            raise Simultaneous(
                f"corners {event.corner} and {corner} strike together at t ="
                f" {float(event.time):.9f}"
            )
