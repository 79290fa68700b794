"""The part on the vibrating table (section 2.1, figure 2, table I): a rectangle that falls, strikes
with its corners, turns, and comes to rest.

    from juggleproof.scenes.part import run, scene, standing, table_one

    table_one(scene(e=0.7, mu=0.08))

Kernels are compiled by numba, the optional extra `part`; importing this package loads what it needs
only when a name is first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

_NAMES = {
    "juggleproof.scenes.errors": ("SceneError"),
    "juggleproof.scenes.part.setting": ("Scene scene standing moving"),
    "juggleproof.scenes.part.ensemble": ("Run run fresh_notes"),
    "juggleproof.scenes.part.onsets": ("Row Table table_one Point chosen misfit recorded sweep"),
}
_PLACE = {name: module for module, names in _NAMES.items() for name in names.split()}

__all__ = sorted(_PLACE)


def __getattr__(name: str) -> Any:
    if name not in _PLACE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_PLACE[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *_PLACE})
