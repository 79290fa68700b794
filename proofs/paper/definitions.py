"""The names that stand in the statement file for what the paper defines; each body is derived."""

from __future__ import annotations

import inspect
from functools import cache

from juggleproof import symbolic
from juggleproof.certificates.definitions import Definition
from juggleproof.certificates.language import Formula, Term, names_in, term
from juggleproof.proofs.paper.names import B1, B2, R, b, derived

STATE = ("beta", "v")

# Name, function of `symbolic`, parameters of a term; a vector has a name for each entry as well.
DERIVED: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("E", "total_energy", STATE),
    ("dE1", "energy_change_1", STATE),
    ("F", "flight_map", (*STATE, "t")),
    ("f1", "f1", STATE),
    ("f2", "f2", STATE),
    ("e_1", "e_1", ()),
    ("e_K", "fixed_point", ("K",)),
    ("struck_e_K", "impact_fixed_point", ("K",)),
    ("value_of_E_max", "E_max", ()),
    ("value_of_dE_max", "delta_E_max", ()),
    ("value_of_dE_sup", "delta_E_sup", ()),
    ("collision_margin", "collision_margin", STATE),
    ("region_margin", "region_margin", STATE),
)
REGIONS: tuple[tuple[str, Formula, str], ...] = (
    ("in_R", R(b), "The region R, on or above the table."),
    ("in_B1", B1(b), "On or above the table, and an impact comes within the period."),
    ("in_B2", B2(b), "On or above the table, and no impact comes within the period."),
)


@cache
def definitions() -> tuple[Definition, ...]:
    """The definitions in the order of the file: a later one may name an earlier one.

    >>> print(definitions()[0].text())
    define E(beta, v) over g := beta*g + v^2/2
    """
    made: list[Definition] = []
    for name, function, parameters in DERIVED:
        value = derived(function)
        says = sentence(function)
        if isinstance(value, Term):
            made.append(Definition(name, parameters, value, says))
            continue
        entries = tuple(map(term, value.entries))
        for part, entry in zip(STATE, entries):
            own = tuple(one for one in parameters if one in names_in(entry))
            made.append(Definition(f"{name}_{part}", own, entry, says))
            says = ""
        if parameters:
            made.append(Definition(name, parameters, entries))
    made += [Definition(name, STATE, formula, says) for name, formula, says in REGIONS]
    return tuple(made)


def sentence(function: str) -> str:
    """What a function of `symbolic` says that it derives."""
    said = inspect.getdoc(getattr(symbolic, function)) or ""
    return " ".join(said.partition("\n\n")[0].split())
