"""A scene of the part: block, table, contact and accuracy, with what the paper gives and what is
inferred; and on which face a block rests.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body
from juggleproof.scenes.part.drive import Harmonics
from juggleproof.scenes.part.shape import (
    Polygon,
    balances,
    geometry,
    polygon,
    stable_faces,
)

Launch = Literal["rest", "table"]
Array = NDArray[np.float64]
LEAST_TOLERANCE, LARGEST_TOLERANCE = 1e-13, 1e-4
LONGEST = 1e5  # seconds of a run
COARSEST = 0.01  # of half the short side: the largest tolerance
ROUNDING = 0.05  # of the tolerance: the most by which a gap may be rounded
HOP = 4.0  # the factor by which a hop has to exceed what is lost in rounding
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

    The table is at (A_x sin(2 pi f_x t + phase_x), A_y sin(2 pi f_y t + phase_y)), or where `drive`
    says, along it and away from it.  Of another `shape` than a rectangle a and b are half the width
    and height at theta = 0.
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
    shape: Polygon | None = None
    drive: Harmonics | None = None

    def polygon(self) -> Polygon:
        """The block as a polygon; the corners of a rectangle begin at the lower left."""
        a, b = self.a, self.b
        return self.shape or Polygon(((-a, -b), (a, -b), (a, b), (-a, b)))

    def lying(self) -> tuple[int, ...]:
        """The edges on which a block counts as lying: of those on which it can rest, those above
        which its centre is lowest; for a rectangle the long ones.

        >>> scene(e=0.7, mu=0.08).lying()
        (1, 3)
        """
        if self.shape is None:
            return tuple(one for one in (1, 3) if one in stable_faces(self.polygon()))
        heights = geometry(self.shape).heights
        holding = stable_faces(self.shape)
        least = min(heights[i] for i in holding)
        return tuple(i for i in holding if heights[i] == least)

    def parameters(self, check: bool = True) -> Array:
        """The numbers that the kernels take (`juggleproof.scenes.part.body`); `check`: whether they
        count how often an impact breaks a guarantee.
        """
        block = geometry(self.polygon())
        numbers, drive = np.zeros(body.EDGES), [] if self.drive is None else self.drive.numbers()
        edges = [
            [*corner, *direction]
            for corner, direction in zip(self.polygon().corners, block.directions)
        ]
        faces = sorted(block.turns)
        sides = balances(self.polygon())
        lies = [float(below in self.lying()) for _, below in sides]
        tail = [*np.ravel(edges), *faces, *(angle for angle, _ in sides), *lies, *drive]
        p = np.concatenate([numbers, tail])
        p[body.G], p[body.RESTITUTION], p[body.FRICTION] = self.g, self.e, self.mu
        p[body.PHASE_X], p[body.PHASE_Y] = self.phase_x, self.phase_y
        (p[body.A_X], p[body.W_X]), (p[body.A_Y], p[body.W_Y]) = self.shaken()
        p[body.GYRATION], p[body.REACH] = block.gyration, block.reach
        p[body.SIZE] = block.reach + self.highest()
        p[body.TOLERANCE], p[body.REST_SPEED], p[body.STEP] = (
            self.tolerance,
            max(self.rest_speed, self.least_rest_speed()),
            self.step(),
        )
        p[body.CHECKED], p[body.CORNERS], p[body.SIDES] = check, len(edges), len(sides)
        p[body.FIRST] = block.turns.index(faces[0])
        p[body.LEAST_TURN] = body.TURN * min(
            after - before for before, after in zip(faces, [*faces[1:], faces[0] + 1])
        )
        p[body.AT_FACES] = body.EDGES + 4 * len(edges)
        p[body.AT_SIDES] = p[body.AT_FACES] + len(edges)
        p[body.AT_DRIVE] = p[body.AT_SIDES] + 2 * len(sides)
        p[body.DRIVE] = body.SINE if self.drive is None else body.SINES
        return p

    def shaken(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """(A, W) along the table and away from it, such that A W^k bounds the derivatives of its
        place from the second to the fourth; for a single sine, its amplitude and frequency.
        """
        if self.drive is not None:
            return self.drive.bounds()
        return (self.A_x, 2 * math.pi * self.f_x), (self.A_y, 2 * math.pi * self.f_y)

    def highest(self) -> float:
        """The greatest distance of the table's height from 0, in metres."""
        return self.A_y if self.drive is None else self.drive.highest()

    def least_rest_speed(self) -> float:
        """The least rest speed, in m/s, at which chatter ends: a hop gains less by the rounding of
        heights than its impact takes away, and lasts longer than a flight that ends at once.

        >>> from juggleproof.scenes.part import scene
        >>> scene(e=0.9, mu=0.3, A_y=0.0).least_rest_speed() < 1e-7
        True
        """
        A, W = self.shaken()[1]
        fall = self.g + A * W**2
        reach = geometry(self.polygon()).reach
        rounded = HOP * EPSILON * (reach + self.highest())
        lost = max(1 - self.e**2, LEAST_LOSS)
        return max(HOP * fall * body.MOMENT, math.sqrt(HOP * fall * rounded / lost))

    def step(self) -> float:
        """The length h of a step of Runge and Kutta, in seconds, by its error term: the fifth
        derivatives of table and fall, times h^5/120, equal the tolerance.
        """
        (along, fast), (high, quick) = self.shaken()
        size = max(max(map(abs, corner)) for corner in self.polygon().corners)
        bound = abs(high) * quick**5.0 + abs(along) * fast**5 + 10 * self.g**2.5 / size**1.5
        return min(float((120 * self.tolerance / bound) ** 0.2), 1e-3)


def scene(
    *,
    a: float | None = None,
    b: float | None = None,
    e: float,
    mu: float,
    A_x: float = 0.0,
    f_x: float = 0.0,
    phase_x: float = 0.0,
    A_y: float | None = None,
    f_y: float | None = None,
    phase_y: float = 0.0,
    g: float = STANDARD_GRAVITY,
    tolerance: float = 1e-12,
    rest_speed: float = 1e-3,
    launch: Launch = "rest",
    shape: Polygon | Sequence[Sequence[float]] | None = None,
    drive: Harmonics | None = None,
) -> Scene:
    """A scene; raises SceneError, one line, for numbers that make none.  `shape`: the corners of a
    convex polygon, (x, y) in metres, instead of a and b; `drive` instead of A, f and phase.

    >>> scene(e=0.7, mu=0.08).b
    0.02
    >>> scene(e=0.7, mu=0.08, shape=[(0, 0), (0.03, 0), (0, 0.03)]).lying()
    (1,)
    """
    if shape is not None:
        if a is not None or b is not None:
            raise SceneError("a and b are half the sides of a rectangle; give them or a shape")
        shape = shape if isinstance(shape, Polygon) else polygon(shape)
        a, b = ((max(axis) - min(axis)) / 2 for axis in zip(*shape.corners))
    if drive is not None and (A_y or f_y or A_x or f_x or phase_x or phase_y):
        raise SceneError(
            "A, f and phase are of a single sine along each axis; give them or a drive"
        )
    given = {
        "a": 0.01 if a is None else a,
        "b": 0.02 if b is None else b,
        "e": e,
        "mu": mu,
        "A_x": A_x,
        "f_x": f_x,
        "phase_x": phase_x,
        "A_y": (2e-4 if drive is None else 0.0) if A_y is None else A_y,
        "f_y": (60.0 if drive is None else 0.0) if f_y is None else f_y,
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
    if shape is None and numbers["a"] > numbers["b"]:
        raise SceneError(
            f"a = {numbers['a']:.6g} is longer than b = {numbers['b']:.6g}; a is half the short"
            " side"
        )
    if not 0 <= numbers["e"] <= 1:
        raise SceneError(f"e = {e:.6g} is outside [0, 1]; it is the coefficient of restitution")
    if numbers["mu"] < 0:
        raise SceneError(f"mu = {mu:.6g} is below 0; it is the coefficient of friction")
    for name, (least, most) in RANGES.items():
        if not least <= numbers[name] <= most:
            raise SceneError(
                f"{name} = {numbers[name]:.6g}{UNITS.get(name, '')} is outside {least:g} .."
                f" {most:g}"
            )
    if launch not in ("rest", "table"):
        raise SceneError(f"launch = {str(launch)[:40]!r}: choose 'rest' or 'table'")
    made = Scene(launch=launch, shape=shape, drive=drive, **numbers)
    _refuse_block(made)
    return made


def _refuse_block(made: Scene) -> None:
    """Raises SceneError for friction with which the block can jam, and for a tolerance that is
    coarse beside it.
    """
    block = geometry(made.polygon())
    if made.mu >= block.jams:
        raise SceneError(
            f"mu = {made.mu:.6g} is not below"
            f" {'4/3' if made.shape is None else f'{block.jams:.6g}'}: from there on a corner can"
            " jam, and the impact law has no answer"
        )
    if made.tolerance > COARSEST * block.shortest / 2:
        raise SceneError(
            f"tolerance = {made.tolerance:.6g} m is above {COARSEST:g} of"
            f" {'a' if made.shape is None else 'half the shortest side'} ="
            f" {block.shortest / 2:.6g} m"
        )


def changed(setting: Scene, **numbers: float) -> Scene:
    """The same scene but for some of its numbers; raises SceneError for numbers that make none.

    >>> changed(scene(e=0.7, mu=0.08), e=0.5).e
    0.5
    """
    given = {one.name: getattr(setting, one.name) for one in fields(setting)}
    if setting.shape is not None:
        del given["a"], given["b"]
    return scene(**{**given, **numbers})


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
    states[:, body.Y] = body.table_height(p, 0.0) + centre_heights(setting, theta)
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
    and s; raises SceneError for numbers out of range, and where the block and the table overlap.
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
    gap = (
        Y
        - float(centre_heights(setting, np.array([numbers[3]]))[0])
        - body.table_height(setting.parameters(), t)
    )
    if gap < -setting.tolerance:
        raise SceneError(
            f"Y = {Y:.6g} m puts the lowest corner {-gap:.3g} m into the table; the centre is at"
            f" least {Y - gap:.6g} m high there"
        )
    return state


def centre_heights(setting: Scene, theta: Array) -> Array:
    """How high the centre is above the table where a corner touches it, in metres, at angles in
    radians; the shape stays.

    >>> centre_heights(scene(e=0.7, mu=0.08), np.array([0.0])).tolist()
    [0.02]
    """
    c, s = np.cos(theta), np.sin(theta)
    heights: Array = np.max([-x * s - y * c for x, y in setting.polygon().corners], axis=0)
    return heights


def faces_below(setting: Scene, theta: Array) -> NDArray[np.int64]:
    """The edge on to which a block at rest at these angles, in radians, falls, or on which it lies:
    one of `juggleproof.scenes.part.shape.stable_faces`; the shape stays.  Of a state on a face,
    CORNER is the edge.

    >>> faces_below(scene(e=0.7, mu=0.08), np.radians([0.0, 26.5, 26.6, 90.0, 180.0])).tolist()
    [0, 0, 3, 3, 2]
    """
    sides = balances(setting.polygon())
    rest = np.mod(np.asarray(theta) + math.pi, 2 * math.pi) - math.pi
    after = np.searchsorted([angle for angle, _ in sides], rest, side="right") % len(sides)
    return np.array([edge for _, edge in sides])[after]


def refuse_turned(setting: Scene, theta: Array) -> None:
    """Raises SceneError where an angle is so large that its rounding moves corners by more than a
    part of the tolerance.
    """
    rounded = float(np.abs(theta).max()) * geometry(setting.polygon()).reach * EPSILON
    if rounded > ROUNDING * setting.tolerance:
        raise SceneError(
            f"theta = {float(np.abs(theta).max()):.6g} rad is too many turns for a tolerance of"
            f" {setting.tolerance:g} m"
        )


def refuse_long(setting: Scene, until: float, name: str = "time") -> None:
    """Raises SceneError for a time that is out of range, or so late that its rounding moves the
    table by more than a part of the tolerance.
    """
    if not 0 <= until <= LONGEST:
        raise SceneError(f"{name} = {until:.6g} s is outside 0 .. {LONGEST:g}")
    if setting.drive is not None:
        rounded = setting.drive.rounded(until)
    else:
        turns = 2 * math.pi * setting.f_y * until + abs(setting.phase_y)
        rounded = setting.A_y * turns * EPSILON
    if rounded > ROUNDING * setting.tolerance:
        raise SceneError(
            f"{name} = {until:.6g} s is too late for a tolerance of {setting.tolerance:g} m: the"
            f" table is rounded by {rounded:.2g} m"
        )
