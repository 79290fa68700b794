"""The juggler: orbits of the paper's map in four arithmetics, from a scene; periodic orbits; the
motion between samples.

    from juggleproof.scenes.juggler import orbit, point, scene

    orbit(scene("3/10", point(1000, -41)), "exact", until_trap=True).row(0)

Importing this package loads what it needs only when a name is first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

_NAMES = {
    "juggleproof.scenes.errors": ("SceneError"),
    "juggleproof.scenes.juggler.starts": (
        "Goal Scene scene arrays boundary grid listed physical physical_box physical_grid "
        "point random"
    ),
    "juggleproof.scenes.juggler.orbits": ("ARITHMETICS Orbits Row orbit prepare"),
}
_PLACE = {name: module for module, names in _NAMES.items() for name in names.split()}


__all__ = sorted(_PLACE)


def __getattr__(name: str) -> Any:
    if name not in _PLACE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_PLACE[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *_PLACE})
