"""Writes proofs/coq/Statements.v from the table of the theorem:
`python -m proofs.theorem.coq_statements`.
"""

from __future__ import annotations

from pathlib import Path
from string import Template

from certificates.store import write_file
from proofs.theorem import coq_table
from proofs.theorem.coq_definitions import Scope, number, pair, piecewise, predicate
from proofs.theorem.coq_table import Attraction, Contraction, Periodic, Physical
from proofs.theorem.coq_templates import HEADER, PINS, THEOREMS
from proofs.theorem.coq_text import coq_formula, coq_term

COQ = Path(__file__).resolve().parents[1] / "coq"


def statements(
    theorem: Attraction, near: Contraction, other: Periodic, physical: Physical, boundary: str
) -> str:
    """The whole of Statements.v."""
    parts = [
        HEADER,
        _normal_form(theorem, near, other, boundary),
        _physical(physical),
        PINS,
        _theorems(theorem, other, physical),
    ]
    return "\n".join(part.strip("\n") + "\n" for part in parts)


def current() -> str:
    """The whole of Statements.v for the theorem as it is defined."""
    return statements(
        coq_table.ball(),
        coq_table.NEIGHBOURHOOD,
        coq_table.other_orbit(),
        coq_table.physical(),
        coq_table.boundary_speed(),
    )


def _normal_form(theorem: Attraction, near: Contraction, other: Periodic, boundary: str) -> str:
    name, under = theorem.root
    plain = Scope(theorem.parameters, theorem.state)
    scope = Scope(theorem.parameters, theorem.state, (*theorem.point, (name, f"sqrt({under})")))
    fixed = Scope(theorem.parameters)
    rows = [
        (
            "(* ---------------------------------------------------------------- the map in normal"
            " form, and the numbers of the theorem *)"
        ),
        "",
        (
            "(* x is the height in units of r T, w the closing speed in units of r, alpha the"
            " restitution. *)"
        ),
        predicate(plain, "space", theorem.space),
        piecewise(plain, "ball", theorem.pieces),
        pair(fixed, "e_1", [value for _, value in theorem.point]),
        pair(fixed, "e_2", other.state),
        "",
        number(plain, "speed", f"sqrt({under})"),
        number(scope, "rank", theorem.rank),
        *(predicate(scope, stage, text) for stage, text in theorem.stages),
        _stage_list(scope, theorem),
        "",
        pair(fixed, "weights", theorem.contraction.weights),
        number(Scope(theorem.parameters), "rate", theorem.contraction.rate),
        number(fixed, "radius", theorem.contraction.radius),
        number(fixed, "size", theorem.size),
        "",
        "(* Near e_1, for every 0 < alpha < 1. *)",
        pair(fixed, "near_weights", near.weights),
        number(fixed, "near_rate", near.rate),
        number(fixed, "near_radius", near.radius),
        "",
        "(* The states of energy at most E_max. *)",
        predicate(scope, "below_boundary", f"{theorem.space} and {name} <= {boundary}"),
        "",
    ]
    return "\n".join(rows)


def _stage_list(scope: Scope, theorem: Attraction) -> str:
    applied = [scope.applied(stage, text).strip("()") for stage, text in theorem.stages]
    return f"Definition stages (alpha : R) : list (R * R -> Prop) := [{'; '.join(applied)}]."


def _physical(physical: Physical) -> str:
    scope, fixed = Scope(physical.parameters, physical.state), Scope(physical.parameters)
    rows = [
        (
            "(* ---------------------------------------------------------------- the map in"
            " physical units *)"
        ),
        "",
        "(* beta is the height, v the velocity, r the launch speed of the table, g gravity. *)",
        predicate(scope, "physical_space", physical.space),
        piecewise(scope, "physical_ball", physical.pieces),
        pair(fixed, "physical_e_1", physical.point),
        pair(scope, "scaling", physical.scaling),
        number(scope, "energy", physical.energy),
        number(fixed, "greatest_energy", physical.greatest_energy),
        "",
    ]
    return "\n".join(rows)


def _theorems(theorem: Attraction, other: Periodic, physical: Physical) -> str:
    name, under = theorem.root
    scope = Scope(theorem.parameters, theorem.state, (*theorem.point, (name, f"sqrt({under})")))
    stages = [scope.applied(stage, text).strip("()") for stage, text in theorem.stages]
    last = len(stages) - 1
    leads = [
        f"({stage} s -> {stages[min(k + 1, last)]} (ball alpha s))"
        for k, stage in enumerate(stages)
    ]
    regions = [coq_formula(piece.region) for piece in (*theorem.pieces, *physical.pieces)]
    return Template(THEOREMS).substitute(
        first=regions[0],
        second=regions[1],
        physical_first=regions[2],
        physical_second=regions[3],
        given=coq_formula(theorem.given),
        lossy=coq_formula(coq_table.LOSSY),
        other_given=coq_formula(other.given),
        threshold=coq_term(coq_table.threshold()),
        in_a_stage=" \\/ ".join(f"{stage} s" for stage in stages),
        stages_lead_on=" /\\\n  ".join(leads),
        last_stage=stages[last],
        extra_steps=theorem.extra_steps,
        steps_to_trap=[stage for stage, _ in theorem.stages].index("trap"),
        period=other.period,
        unit_1=coq_term(physical.units[0]),
        unit_2=coq_term(physical.units[1]),
    )


if __name__ == "__main__":
    write_file(COQ / "Statements.v", current().encode())
