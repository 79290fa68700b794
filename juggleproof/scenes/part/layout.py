"""How 91 blocks are laid out in a picture: rows of ten from front to back, as in figure 2;
which of them are nearer to lying; and their vibration in a line.

Blocks move in parallel planes and do not meet, so each is shown at its own place of a grid, at
its true angle and height above the table.  How far it has drifted along the table, some
centimetres a second, is left out of figure 2.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.part import body
from juggleproof.scenes.part.setting import Array, Scene, faces_below
from juggleproof.scenes.part.shape import geometry

COLUMNS, MOST_ROWS = 10, 60
PITCH = 2.6  # from one place to the next, in half diagonals of the block
ANGLES: Array = np.radians(np.arange(91.0))


def place(k: int) -> tuple[int, int]:
    """Column and row of block k: the foremost row has the first ten, from left to right.

    >>> place(9), place(10), place(90)
    ((9, 0), (0, 1), (0, 9))
    """
    return k % COLUMNS, k // COLUMNS


def rows(count: int) -> int:
    """How many rows this many blocks take; raises SceneError for none, or for too many to see.

    >>> rows(91)
    10
    """
    number = -(-count // COLUMNS)
    if not 1 <= number <= MOST_ROWS:
        raise SceneError(
            f"{count} blocks are outside 1 .. {MOST_ROWS * COLUMNS}, which is what a picture shows"
        )
    return number


def pitch(setting: Scene) -> float:
    """The distance from one place to the next, in metres: a block that turns does not reach its
    neighbours.
    """
    return PITCH * geometry(setting.polygon()).reach


def lying(setting: Scene, states: Array) -> NDArray[np.bool_]:
    """Which blocks are nearer to lying than to upright, as table I distinguishes them
    (`juggleproof.scenes.part.rest`): for states of shape (..., 10) an array of shape (...).
    """
    return np.isin(faces_below(setting, states[..., body.THETA]), setting.lying())


def noun(setting: Scene) -> str:
    """What blocks are called in a description."""
    return "rectangles" if setting.shape is None else "polygons"


def ways(setting: Scene) -> tuple[str, str]:
    """The names for a block that does not lie and for one that does."""
    if setting.shape is None:
        return "nearer to upright", "nearer to lying"
    return "over a higher face", "over a lowest face"


def vibration(setting: Scene) -> str:
    """The vibration and the contact of a scene, in a line.

    >>> from juggleproof.scenes.part.setting import scene
    >>> vibration(scene(e=0.7, mu=0.08, f_x=30.0, A_x=1e-3))
    'table: 60 Hz 0.2 mm up and down, 30 Hz 1 mm along; e = 0.7, mu = 0.08'
    """
    if setting.drive is not None:
        table = setting.drive.in_words()
    else:
        table = (
            f"{setting.f_y:g} Hz {1e3 * setting.A_y:g} mm up and down, {setting.f_x:g} Hz"
            f" {1e3 * setting.A_x:g} mm along"
        )
    return f"table: {table}; e = {setting.e:g}, mu = {setting.mu:g}"
