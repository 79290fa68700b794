"""The corners of a part and the faces on which it rests.

Face k is the side from corner k to corner k + 1, counterclockwise; at theta = 0 a rectangle stands
on face 0.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.part.setting import Array, Scene


def corners(setting: Scene) -> Array:
    """The corners of the part about its centre, in metres, counterclockwise, shape (n, 2)."""
    a, b = setting.a, setting.b
    return np.array([(-a, -b), (a, -b), (a, b), (-a, b)])


def resting_angles(around: Array) -> Array:
    """The angle, in degrees from 0 to 360, at which a part with these corners lies on each of its
    faces, shape (n,).

    >>> resting_angles(np.array([(-1, -2), (1, -2), (1, 2), (-1, 2)])).tolist()
    [0.0, 270.0, 180.0, 90.0]
    """
    sides = np.roll(around, -1, axis=0) - around
    return (-np.degrees(np.arctan2(sides[:, 1], sides[:, 0])) + 0.0) % 360.0


def face_of(theta: Array, rests: Array) -> NDArray[np.int64]:
    """The face on which parts lie at these angles, in radians: the one whose resting angle, in
    degrees, is nearest.

    >>> face_of(np.radians([0.0, -90.0, 450.0]), np.array([0.0, 270.0, 180.0, 90.0])).tolist()
    [0, 1, 3]
    """
    apart = (np.degrees(theta)[:, None] - rests + 180.0) % 360.0 - 180.0
    nearest: NDArray[np.int64] = np.abs(apart).argmin(axis=1)
    return nearest


def lowest_corner(setting: Scene, theta: Array) -> Array:
    """How high the lowest corner is above the centre, in metres: not above 0."""
    x, y = corners(setting).T[..., None]
    lowest: Array = (x * np.sin(theta) + y * np.cos(theta)).min(axis=0)
    return lowest
