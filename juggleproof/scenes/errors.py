"""The one error of the scenes: a scene, a state or a run that cannot be carried out, in one
line.
"""

from __future__ import annotations


class SceneError(ValueError):
    """What was asked for, with the value that was given and what is allowed."""
