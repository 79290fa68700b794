"""The trajectories of several independent parts, each with a name, at given times."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from math import radians

import numpy as np

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body
from juggleproof.scenes.part.columns import Column, Shown, graphs
from juggleproof.scenes.part.ensemble import frames_of, state_columns
from juggleproof.scenes.part.layout import vibration
from juggleproof.scenes.part.setting import Array, Scene, moving, standing
from juggleproof.scenes.part.shape import geometry, stable_faces

MILLIMETRE = 1e-3


@dataclass(frozen=True)
class Trajectories(Shown):
    """The states of parts, which have names, at times in seconds: shape (times, parts, 10)."""

    setting: Scene
    names: tuple[str, ...]
    times: Array
    states: Array

    def title(self) -> str:
        count = len(self.names)
        return (
            f"{count} part{'s' * (count != 1)} at {len(self.times)} times from {self.times[0]:g} to"
            f" {self.times[-1]:g} s; {vibration(self.setting)}"
        )

    def columns(self) -> Sequence[Column]:
        """A row a part and time, one part after another; SI units."""
        rows = self.states.transpose(1, 0, 2).reshape(-1, body.STATE)
        names = np.repeat(np.array(self.names), len(self.times))
        return Column("part", "", names), *state_columns(rows)

    def picture(self) -> bytes:
        """The angles against time."""
        drawing, count = graphs(), len(self.names)
        shape = self.setting.polygon()
        block = geometry(shape)
        drawn: bytes = drawing.angles(
            self.times,
            [np.degrees(self.states[:, k, body.THETA]) for k in range(count)],
            self.names,
            [360 * block.turns[face] for face in stable_faces(shape, self.setting.tilt)],
            (
                f"The angle of {count} part{'s' * (count != 1)} against time",
                f"{vibration(self.setting)}; {len(self.times)} times",
            ),
        )
        return drawn


def trajectories(
    setting: Scene,
    starts: Mapping[str, Array],
    times: Sequence[float] | Array,
    executor: Executor | None = None,
) -> Trajectories:
    """The trajectories of parts that start in these states, one each, by their names, at times in
    seconds that do not fall; the parts do not touch.  SceneError for no starts or other shapes.

    >>> from juggleproof.scenes.part.setting import scene
    >>> block = scene(e=0.5, mu=0.3, A_y=0.0)
    >>> starts = {"left": start_of(block, theta=20), "right": start_of(block, theta=30)}
    >>> ends = trajectories(block, starts, [0.0, 2.0]).states[-1]
    >>> np.degrees(ends[:, body.THETA]).tolist()
    [0.0, 90.0]
    """
    if not starts:
        raise SceneError("no part is given; give a start at least")
    states = np.concatenate([np.atleast_2d(one) for one in starts.values()])
    if states.shape != (len(starts), body.STATE):
        raise SceneError(f"starts of shape {states.shape}: ({len(starts)}, {body.STATE}) is needed")
    at = np.asarray(times, dtype=float)
    return Trajectories(setting, tuple(starts), at, frames_of(setting, states, at, executor))


def start_of(
    setting: Scene,
    *,
    theta: float,
    x: float | None = None,
    y: float | None = None,
    vx: float | None = None,
    vy: float | None = None,
    omega: float = 0.0,
) -> Array:
    """A start at t = 0, shape (1, 10): theta in degrees, the centre at x, y in millimetres, speeds
    in m/s and degrees a second.  What is not given is as in `standing`: the lowest corner on the
    table.  SceneError as for `moving`.
    """
    stands = standing(setting, [radians(theta)])[0]
    given = (
        (body.X, x if x is None else x * MILLIMETRE),
        (body.Y, y if y is None else y * MILLIMETRE),
        (body.V_X, vx),
        (body.V_Y, vy),
    )
    for place, value in given:
        stands[place] = stands[place] if value is None else value
    X, Y, angle, V_X, V_Y = stands[body.X : body.OMEGA].tolist()
    return moving(setting, X, Y, angle, V_X, V_Y, radians(omega))
