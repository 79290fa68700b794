"""The names that the paper's prose introduces, section by section; its displays define others."""

from __future__ import annotations

# By section, names that its prose introduces, with what they name; "" holds throughout, as the
# table of B.7 repeats.
PROSE: dict[str, dict[str, str]] = {
    "": {
        r"\overline{b}": "the ball's state when the table is at its lowest",
        r"\overline{\beta}": "the ball's height when the table is at its lowest",
        r"\dot{\overline{\beta}}": "the ball's velocity when the table is at its lowest",
        r"\overline{b}_{\cdot}": "such a state, by the number of the bounce, or another index",
        r"\overline{f}": "the map of such states",
        "b": "the ball's state",
        r"\beta": "the ball's height",
        r"\dot{\beta}": "the ball's velocity",
        r"\rho": "the table's height",
        r"\dot{\rho}": "the table's velocity",
        "K": "a number of periods; from 4.3 on, the kinetic energy",
    },
    "2.2.2": {
        "x": "a point mass with its state",
        "y": "another point mass with its state",
        r"\chi": "the position of a mass; relative to another from (2) on",
        r"\dot{\chi}": "the velocity that goes with it",
        r"\dot{\chi}'": "that velocity after an impact",
        r"\dot{\dot{\chi}}": "the acceleration that goes with it",
    },
    "3.5.1": {"t_{f}": "the time of flight"},
    "4.3.1": {r"\Delta K": "the change of K by an impact", "k": "the number of impacts"},
    "B.7": {
        "x": "the state that a function is applied to, or the table's",
        "y": "the ball's state before an impact",
        "C_{x}": "the impact with a table in the state x",
        "f": "the map of sampled states",
    },
}


def introduced(section: str) -> frozenset[str]:
    """The names that hold throughout, and those that the prose of the section, or of one that holds
    it, introduces.

    >>> ["x" in introduced(section) for section in ("2.2.2", "B.3")]
    [True, False]
    """
    parts = section.split(".")
    holders = ["", *(".".join(parts[: k + 1]) for k in range(len(parts)))]
    return frozenset(name for one in holders for name in PROSE.get(one, ()))
