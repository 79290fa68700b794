"""The part on the vibrating table (section 2.1, figure 2, table I): a rectangle, or another convex
polygon, that falls, strikes with its corners, turns, and comes to rest.

    from juggleproof.scenes.part import run, scene, standing, table_one

    table_one(scene(e=0.7, mu=0.08))

In reading order:

    body        the compiler, and block and table as numbers
    shape       convex polygons by their corners, from exact numbers
    drive       harmonics that the table follows
    setting     a scene: what the paper gives and what is inferred
    flight      free flight and the first contact
    strike      impacts, and the forces that hold a block on the table
    rest        lasting contact: on a face, or on a corner
    motion      the orbit of one block
    ensemble    many blocks
    onsets      table I
    readings    what it leaves open, and how likely its prints are
    layout      how blocks are laid out in a picture
    resting     how often parts rest on each face; the least drive that clears faces
    picture     figure 2, and a graph of that

Kernels are compiled by numba, the optional extra `part`; importing this package loads what it needs
only when a name is first used.
"""

from __future__ import annotations

from juggleproof.lazy import lazy_names

NAMES = {
    "..errors": "SceneError",
    ".setting": "Scene scene standing moving",
    ".ensemble": "Run run fresh_notes",
    ".onsets": "Row Table table_one",
    ".readings": "Point Reading chosen likelihood recorded sweep",
    ".resting": "Clearing Orientation Starts between clearing listed orientation wilson",
}
__all__, __getattr__, __dir__ = lazy_names(__name__, NAMES)
