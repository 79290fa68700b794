"""Statements under the checker's map rules, written from the definition, in normal form or in the
paper's units.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from certificates.statements import MapRule
from certificates.terms import Formula, Number, Term, substitute, term
from proofs.paper.vocabulary import H, alpha, b, derived, g, r, w, x
from proofs.reading.values import Vector
from proofs.theorem.definition import FIXED, OTHER, PIECES, SPACE, WHOLE, Contraction, Descent
from proofs.theorem.written import opposite, positive, tidied
from symbolic.collision import collision_margin


@dataclass(frozen=True)
class Setting:
    """The map in some coordinates: parameters, state, pieces and fixed points, and what the x, w
    and units of the normal form are in them.
    """

    parameters: tuple[Term, ...]
    positive: tuple[Formula, ...]
    state: tuple[Term, Term]
    space: Formula
    pieces: tuple[tuple[Formula, Vector], ...]
    fixed: Vector
    other: Vector
    place: Vector
    units: tuple[Number, Number]

    def here(self, thing: Any) -> Any:
        """A term or formula of the normal form in these coordinates."""
        return substitute(thing, dict(zip(("x", "w"), (term(entry) for entry in self.place))))

    def domain(self, of_alpha: Formula) -> str:
        """The range of alpha with what is assumed of the other parameters."""
        for formula in self.positive:
            of_alpha = of_alpha & formula
        return str(of_alpha)


NORMAL = Setting((alpha,), (), (x, w), SPACE, PIECES, FIXED, OTHER, Vector((x, w)), (1, 1))
STRIKES_HERE = positive(collision_margin())
PHYSICAL = Setting(
    parameters=(alpha, r, g),
    positive=(r > 0, g > 0),
    state=(term(b.component(1)), term(b.component(2))),
    space=H(b),
    pieces=((STRIKES_HERE, tidied("f1")), (opposite(STRIKES_HERE), tidied("f2"))),
    fixed=tidied("e_1"),
    other=tidied("impact_fixed_point", K=2),
    place=derived("scaling"),
    units=(2 * r**2 / g, r),
)


def spaced(items: Iterable[object]) -> str:
    return " ".join(map(str, items))


def listed(items: Iterable[object]) -> str:
    return ", ".join(map(str, items))


def the_map(name: str, setting: Setting, of_alpha: Formula = WHOLE) -> MapRule:
    """f maps the space into itself, by one of its pieces at each state."""
    pieces = [("piece", f"{guard} -> {listed(images)}") for guard, images in setting.pieces]
    return MapRule(
        name,
        (
            ("over", spaced(setting.parameters)),
            ("domain", setting.domain(of_alpha)),
            ("state", spaced(setting.state)),
            ("space", str(setting.space)),
            *pieces,
        ),
    )


def _roots(roots: Sequence[tuple[str, Term]], setting: Setting) -> list[tuple[str, str]]:
    return [("root", f"{name} = sqrt({setting.here(under)})") for name, under in roots]


def descends(name: str, of: str, setting: Setting, of_alpha: Formula, descent: Descent) -> MapRule:
    """Every orbit is led to the last stage by the fall of the rank."""
    stages = [("stage", str(setting.here(stage))) for stage in descent.stages]
    return MapRule(
        name,
        (
            ("map", of),
            ("domain", setting.domain(of_alpha)),
            *_roots(descent.roots, setting),
            ("rank", str(setting.here(descent.rank))),
            *stages,
        ),
    )


def contracts(
    name: str, of: str, setting: Setting, of_alpha: Formula, contraction: Contraction
) -> MapRule:
    """The set is mapped into itself and brought closer to the fixed point."""
    weights = [
        unit if weight == term(1) else weight if unit == 1 else weight * unit
        for weight, unit in zip(contraction.weights, setting.units)
    ]
    return MapRule(
        name,
        (
            ("map", of),
            ("domain", setting.domain(of_alpha)),
            ("on", str(setting.here(contraction.on))),
            ("point", listed(setting.fixed)),
            ("weights", listed(weights)),
            ("rate", str(contraction.rate)),
            ("radius", str(contraction.radius)),
            ("size", str(contraction.size)),
        ),
    )


def attracts(name: str, descent: str, contraction: str) -> MapRule:
    """The fixed point is stable, and attracts every orbit."""
    return MapRule(name, (("descent", descent), ("contraction", contraction)))


def escapes(name: str, of: str, setting: Setting, of_alpha: Formula) -> MapRule:
    """The orbit of e_2, an impact and a flight by turns, does not tend to the fixed point."""
    return MapRule(
        name,
        (
            ("map", of),
            ("domain", setting.domain(of_alpha)),
            ("point", listed(setting.fixed)),
            ("start", listed(setting.other)),
            ("word", "1 2"),
        ),
    )


def exactly(name: str, attraction: str, escape: str) -> MapRule:
    """Stable and globally attracting for these parameters and no others."""
    return MapRule(name, (("attraction", attraction), ("escape", escape)))
