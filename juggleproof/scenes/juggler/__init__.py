"""The juggler: orbits of the paper's map in four arithmetics, from a scene; periodic orbits; the
motion between samples.

    from juggleproof.scenes.juggler import orbit, point, scene

    orbit(scene("3/10", point(1000, -41)), "exact", until_trap=True).row(0)

In reading order:

    given     the derived formulas as arithmetic, and numbers as they are given
    starts    scenes, and the states from which orbits start
    track     one orbit in any arithmetic: flights, impacts, the trap
    exact     orbits in exact rationals and in mpmath numbers
    bounded   orbits in Arb balls, and in float64 with proved bounds
    orbits    the orbits of a scene, and the motion between samples
    periodic  periodic orbits
    limits    the periodic orbits that orbits tend to
    tables    tables and hard cases
    picture   pictures of orbits

Importing this package loads what it needs only when a name is first used.
"""

from __future__ import annotations

from juggleproof.lazy import lazy_names

NAMES = {
    "..errors": "SceneError",
    ".starts": (
        "Goal Scene scene arrays boundary grid listed physical physical_box physical_grid "
        "point random"
    ),
    ".orbits": "ARITHMETICS Orbits Row orbit prepare",
}
__all__, __getattr__, __dir__ = lazy_names(__name__, NAMES)
