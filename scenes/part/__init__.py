"""The part on the vibrating table (section 2.1, figure 2, table I): a rectangle that falls, strikes
with its corners, turns, and comes to rest.

    from juggleproof.scenes.part import run, scene, standing, table_one

    table_one(scene(e=0.7, mu=0.08))

Kernels are compiled by numba, the optional extra `part`; importing this package loads what it needs
only when a name is first used.
"""

from __future__ import annotations

from juggleproof.symbolic.lazy import lazy_names

NAMES = {
    "..errors": "SceneError",
    ".setting": "Scene scene standing moving",
    ".ensemble": "Run run fresh_notes",
    ".onsets": "Row Table table_one Point chosen misfit recorded sweep",
}
__all__, __getattr__, __dir__ = lazy_names(__name__, NAMES)
