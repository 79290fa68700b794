"""The ways in which a corner that strikes a table with friction can slide or stick."""

from __future__ import annotations

# mode -> the lines of greatest compression and of the end
MODES = {
    "sliding": ("sliding", "sliding"),
    "sticking-in-compression": ("sticking", "sticking"),
    "sticking-in-restitution": ("sliding", "sticking"),
    "reversed-in-compression": ("reversed", "reversed"),
    "reversed-in-restitution": ("sliding", "reversed"),
}
