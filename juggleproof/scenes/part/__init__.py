"""The part on the vibrating table (section 2.1, figure 2, table I): a rectangle, or another convex
polygon, that falls, strikes with its corners, turns, and comes to rest.

    from juggleproof.scenes.part import run, scene, standing, table_one

    table_one(scene(e=0.7, mu=0.08))

In reading order:

    body        the compiler, and block and table as numbers
    shape       convex polygons by their corners, from exact numbers
    drive       harmonics and records that the table follows
    setting     a scene: what the paper gives and what is inferred
    flight      free flight and the first contact
    strike      impacts, and the forces that hold a block on the table
    rest        lasting contact: on a face, or on a corner
    motion      the orbit of one block
    columns     results as named columns, in files and notebooks
    ensemble    many blocks
    onsets      table I
    readings    what it leaves open, and how likely its prints are
    layout      how blocks are laid out in a picture
    picture     figure 2
    animation   the same in motion, as one HTML file
    trajectory  the trajectories of several parts
    resting     how often parts rest on each face
    sweeps      onsets over two parameters; the least drive that clears faces
    graphs      graphs of all these

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
    ".resting": "Orientation Starts between listed orientation wilson",
    ".trajectory": "Trajectories start_of trajectories",
}
__all__, __getattr__, __dir__ = lazy_names(__name__, NAMES)
