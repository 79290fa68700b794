"""A scene of the part: block, table, contact and accuracy, with what the paper gives and what is
inferred.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body

Launch = Literal["rest", "table"]
Array = NDArray[np.float64]
JAMS = 4 / 3  # the friction from which a rectangle can jam: claim part-jamming
LEAST_TOLERANCE, LARGEST_TOLERANCE = 1e-13, 1e-4
LONGEST = 1e5  # seconds of a run
COARSEST = 0.01  # of half the short side: the largest tolerance
ROUNDING = 0.05  # of the tolerance: the most by which a gap may be rounded
HOP = 4.0  # by which a hop is to surpass what is lost in rounding
LEAST_LOSS = 1e-6  # of energy in an impact: below, it counts as lossless
FASTEST, FASTEST_TURN = 1e3, 1e5  # m/s and rad/s of a start
RANGES = {
    "a": (1e-5, 10.0),
    "b": (1e-5, 10.0),
    "g": (1e-3, 1e3),
    "A_x": (-1.0, 1.0),
    "A_y": (0.0, 1.0),
    "f_x": (0.0, 1e4),
    "f_y": (0.0, 1e4),
    "phase_x": (-100.0, 100.0),
    "phase_y": (-100.0, 100.0),
    "rest_speed": (1e-8, 1.0),
    "tolerance": (LEAST_TOLERANCE, LARGEST_TOLERANCE),
}
UNITS = {
    "a": " m",
    "b": " m",
    "g": " m/s^2",
    "A_x": " m",
    "A_y": " m",
    "f_x": " Hz",
    "f_y": " Hz",
    "rest_speed": " m/s",
    "tolerance": " m",
}
STANDARD_GRAVITY = 9.81
EPSILON = float(np.finfo(float).eps)


@dataclass(frozen=True)
class Scene:
    """A block on a vibrating table, in SI units: half sides a <= b in metres, frequencies in hertz,
    phases in radians; made by `scene`.

    The table is at (A_x sin(2 pi f_x t + phase_x), A_y sin(2 pi f_y t + phase_y)).
    """

    a: float
    b: float
    e: float
    mu: float
    A_x: float
    f_x: float
    phase_x: float
    A_y: float
    f_y: float
    phase_y: float
    g: float
    tolerance: float
    rest_speed: float
    launch: Launch

    def parameters(self, check: bool = True) -> Array:
        """The numbers that the kernels take (`juggleproof.scenes.part.body`); `check`: whether they
        count how often an impact breaks a guarantee.
        """
        p = np.zeros(body.PARAMETERS)
        p[body.G], p[body.RESTITUTION], p[body.FRICTION] = self.g, self.e, self.mu
        p[body.A_X], p[body.W_X], p[body.PHASE_X] = self.A_x, 2 * math.pi * self.f_x, self.phase_x
        p[body.A_Y], p[body.W_Y], p[body.PHASE_Y] = self.A_y, 2 * math.pi * self.f_y, self.phase_y
        p[body.HALF_SHORT], p[body.HALF_LONG], p[body.GYRATION] = (
            self.a,
            self.b,
            (self.a**2 + self.b**2) / 3,
        )
        p[body.TOLERANCE], p[body.REST_SPEED], p[body.STEP] = (
            self.tolerance,
            max(self.rest_speed, self.least_rest_speed()),
            self.step(),
        )
        p[body.SPLIT], p[body.REACH] = math.atan(self.a / self.b), math.hypot(self.a, self.b)
        p[body.CHECKED] = check
        return p

    def least_rest_speed(self) -> float:
        """The least rest speed, in m/s, at which chatter ends: a hop gains less by the rounding of
        heights than its impact takes away, and lasts longer than a flight that ends at once.

        >>> from juggleproof.scenes.part import scene
        >>> scene(e=0.9, mu=0.3, A_y=0.0).least_rest_speed() < 1e-7
        True
        """
        fall = self.g + self.A_y * (2 * math.pi * self.f_y) ** 2
        rounded = HOP * EPSILON * (math.hypot(self.a, self.b) + self.A_y)
        lost = max(1 - self.e**2, LEAST_LOSS)
        return max(HOP * fall * body.MOMENT, math.sqrt(HOP * fall * rounded / lost))

    def step(self) -> float:
        """The length of a step of Runge and Kutta, in seconds, by its error term: fifth derivatives
        of table and fall, times h^5/120, make the tolerance.
        """
        bound = (
            abs(self.A_y) * (2 * math.pi * self.f_y) ** 5.0
            + abs(self.A_x) * (2 * math.pi * self.f_x) ** 5
            + 10 * self.g**2.5 / self.b**1.5
        )
        return min(float((120 * self.tolerance / bound) ** 0.2), 1e-3)


def scene(
    *,
    a: float = 0.01,
    b: float = 0.02,
    e: float,
    mu: float,
    A_x: float = 0.0,
    f_x: float = 0.0,
    phase_x: float = 0.0,
    A_y: float = 2e-4,
    f_y: float = 60.0,
    phase_y: float = 0.0,
    g: float = STANDARD_GRAVITY,
    tolerance: float = 1e-12,
    rest_speed: float = 1e-3,
    launch: Launch = "rest",
) -> Scene:
    """A scene; SceneError, one line, for numbers that make none.

    >>> scene(e=0.7, mu=0.08).b
    0.02
    """
    given = {
        "a": a,
        "b": b,
        "e": e,
        "mu": mu,
        "A_x": A_x,
        "f_x": f_x,
        "phase_x": phase_x,
        "A_y": A_y,
        "f_y": f_y,
        "phase_y": phase_y,
        "g": g,
        "tolerance": tolerance,
        "rest_speed": rest_speed,
    }
    numbers = {name: _finite(value, name) for name, value in given.items()}
    for name in ("a", "b", "g", "rest_speed"):
        if numbers[name] <= 0:
            raise SceneError(f"{name} = {numbers[name]:.6g} is not positive")
    for name in ("A_y", "f_x", "f_y"):
        if numbers[name] < 0:
            raise SceneError(
                f"{name} = {numbers[name]:.6g} is below 0; give the amount, and a phase"
            )
    if numbers["a"] > numbers["b"]:
        raise SceneError(f"a = {a:.6g} is longer than b = {b:.6g}; a is half the short side")
    if not 0 <= numbers["e"] <= 1:
        raise SceneError(f"e = {e:.6g} is outside [0, 1]; it is the coefficient of restitution")
    if numbers["mu"] < 0:
        raise SceneError(f"mu = {mu:.6g} is below 0; it is the coefficient of friction")
    if numbers["mu"] >= JAMS:
        raise SceneError(
            f"mu = {mu:.6g} is not below 4/3: from there on a corner can jam, and the impact law"
            " has no answer"
        )
    for name, (least, most) in RANGES.items():
        if not least <= numbers[name] <= most:
            raise SceneError(
                f"{name} = {numbers[name]:.6g}{UNITS.get(name, '')} is outside {least:g} .."
                f" {most:g}"
            )
    if numbers["tolerance"] > COARSEST * numbers["a"]:
        raise SceneError(
            f"tolerance = {numbers['tolerance']:.6g} m is above {COARSEST:g} of a ="
            f" {numbers['a']:.6g} m"
        )
    if launch not in ("rest", "table"):
        raise SceneError(f"launch = {str(launch)[:40]!r}: choose 'rest' or 'table'")
    return Scene(launch=launch, **numbers)


def changed(setting: Scene, **numbers: float) -> Scene:
    """The same scene but for some of its numbers; SceneError for numbers that make none.

    >>> changed(scene(e=0.7, mu=0.08), e=0.5).e
    0.5
    """
    return scene(**{**asdict(setting), **numbers})


def _finite(value: float, name: str) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise SceneError(f"{name} = {str(value)[:40]!r} is no number") from None
    if not math.isfinite(number):
        raise SceneError(f"{name} = {number} is not finite")
    return number


def standing(setting: Scene, angles: Sequence[float] | Array) -> Array:
    """States at time 0 with the lowest corner on the table, one row each; `angles` in radians,
    shape (n,); the result has shape (n, 10).

    Blocks start at rest, or as fast as the table where the scene's launch is "table".  SceneError
    for angles of another shape, not finite, or of too many turns.

    >>> standing(scene(e=0.7, mu=0.08), [0.0])[0, body.Y]
    np.float64(0.02)
    """
    theta = np.asarray(angles, dtype=float)
    if theta.ndim != 1 or not len(theta) or not np.isfinite(theta).all():
        raise SceneError(f"angles of shape {theta.shape}: one row of finite numbers is needed")
    refuse_turned(setting, theta)
    p = setting.parameters()
    states = np.zeros((len(theta), body.STATE))
    states[:, body.THETA] = theta
    states[:, body.Y] = (
        body.table_height(p, 0.0)
        + np.abs(setting.a * np.sin(theta))
        + np.abs(setting.b * np.cos(theta))
    )
    states[:, body.X] = body.table_place(p, 0.0)
    if setting.launch == "table":
        states[:, body.V_X], states[:, body.V_Y] = body.table_glide(p, 0.0), body.table_rise(p, 0.0)
    return states


def moving(
    setting: Scene,
    X: float,
    Y: float,
    theta: float,
    V_X: float,
    V_Y: float,
    omega: float,
    t: float = 0.0,
) -> Array:
    """One state, shape (1, 10), of the centre of mass in the resting frame, in m, rad, m/s, rad/s
    and s; SceneError for numbers out of range, and where the block and the table overlap.
    """
    given = {"t": t, "X": X, "Y": Y, "theta": theta, "V_X": V_X, "V_Y": V_Y, "omega": omega}
    numbers = [_finite(value, name) for name, value in given.items()]
    if numbers[0] < 0:
        raise SceneError(f"t = {t:.6g} is before the start, t = 0")
    if max(map(abs, numbers[4:6])) > FASTEST or abs(numbers[6]) > FASTEST_TURN:
        raise SceneError(
            f"({V_X:.6g}, {V_Y:.6g}) m/s, {omega:.6g} rad/s: a start has at most {FASTEST:g} m/s"
            f" and {FASTEST_TURN:g} rad/s"
        )
    refuse_turned(setting, np.array([numbers[3]]))
    refuse_long(setting, t)
    state = np.zeros((1, body.STATE))
    state[0, :7] = numbers
    lowest = abs(setting.a * math.sin(theta)) + abs(setting.b * math.cos(theta))
    gap = Y - lowest - body.table_height(setting.parameters(), t)
    if gap < -setting.tolerance:
        raise SceneError(
            f"Y = {Y:.6g} m puts the lowest corner {-gap:.3g} m into the table; the centre is at"
            f" least {Y - gap:.6g} m high there"
        )
    return state


def refuse_turned(setting: Scene, theta: Array) -> None:
    """SceneError where an angle is so large that its rounding moves corners by more than a part of
    the tolerance.
    """
    rounded = float(np.abs(theta).max()) * math.hypot(setting.a, setting.b) * EPSILON
    if rounded > ROUNDING * setting.tolerance:
        raise SceneError(
            f"theta = {float(np.abs(theta).max()):.6g} rad is too many turns for a tolerance of"
            f" {setting.tolerance:g} m"
        )


def refuse_long(setting: Scene, until: float, name: str = "time") -> None:
    """SceneError for a time that is out of range, or so late that its rounding moves the table by
    more than a part of the tolerance.
    """
    if not 0 <= until <= LONGEST:
        raise SceneError(f"{name} = {until:.6g} s is outside 0 .. {LONGEST:g}")
    rounded = setting.A_y * (2 * math.pi * setting.f_y * until + abs(setting.phase_y)) * EPSILON
    if rounded > ROUNDING * setting.tolerance:
        raise SceneError(
            f"{name} = {until:.6g} s is too late for a tolerance of {setting.tolerance:g} m: the"
            f" table is rounded by {rounded:.2g} m"
        )
