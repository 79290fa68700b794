"""The table that moves as a sine.  In reading order:

curves      where the bounce of one period is born, begins to clear the table, loses its stability,
            and where a second orbit takes motions away
motion      flights, impacts, rest and launch, simulated
attractors  what balls come to over restitution and drive, simulated
cover       which boxes of parameters are certified, between the curves, over what balls come to
pictures    ball and table over time; how long states take to the bounce

Importing this package loads what it needs only when a name is first used.
"""

from __future__ import annotations

from juggleproof.lazy import lazy_names

NAMES = {".motion": "MOST Table flights_by_state"}
__all__, __getattr__, __dir__ = lazy_names(__name__, NAMES)
