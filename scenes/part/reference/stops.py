"""Where the reference stops: what it meets there is not a flight, nor the impact of one corner."""

from __future__ import annotations

from typing import Any

from juggleproof.scenes.errors import SceneError


class Stopped(SceneError):
    """The orbit cannot be followed further; `events` holds what it met until then."""

    events: tuple[Any, ...] = ()


class Chatter(Stopped):
    """Impacts accumulate, or an impact leaves the corner on the table: the part comes to rest on a
    corner.
    """


class Simultaneous(Stopped):
    """Two corners strike together."""


class Undecided(Stopped):
    """A corner grazes the table: whether it strikes lies within the rounding."""
