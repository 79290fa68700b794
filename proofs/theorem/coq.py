"""The Coq statements of the theorem: the texts of its definition as Coq terms, and Statements.v,
which `python -m juggleproof.proofs.theorem.coq` writes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from string import Template

from juggleproof.certificates import checker
from juggleproof.coq_orbits.terms import ATOM, coq_formula, coq_term, names_in, term_of
from juggleproof.coq_store.text import without_primes
from juggleproof.encoding import from_sympy, written
from juggleproof.proofs.theorem import definition as chosen
from juggleproof.proofs.theorem.coq_templates import HEADER, PINS, THEOREMS
from juggleproof.proofs.theorem.definition import NORMAL, PHYSICAL, TheoremSetting
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import write_file
from juggleproof.symbolic.algebra import DerivationError, alpha, lowest_terms, r
from juggleproof.symbolic.bounds import E_max
from juggleproof.symbolic.energy import scaling, total_energy
from juggleproof.symbolic.maps import restitution_threshold
from juggleproof.symbolic.mechanics import period

# -------------------------------------------------------------------------------------------------
# The theorem as texts for Coq, in the syntax that the checker reads: the choices of
# proofs/theorem/definition.py, and what is derived.
#
# Rank, stages, weights and rates are the very ones that the checker is given; maps, regions, points
# and energies come from `symbolic`.


@dataclass(frozen=True)
class PieceText:
    """What the map does on one region: an image for each coordinate."""

    region: str
    images: tuple[str, ...]


@dataclass(frozen=True)
class ContractionText:
    """A weighted sup norm around the point that the map contracts by a rate, within a radius (times
    the weights).
    """

    weights: tuple[str, ...]
    rate: str
    radius: str


@dataclass(frozen=True)
class AttractionText:
    """Every orbit in the space reaches the last stage and from there on approaches the point.

    Outside the stages the rank falls by 1 a step; each stage leads to the next, the last to itself;
    on the last stage, where the point is at most `size` away, the map contracts; all states of the
    space within the radius of the point are in the last stage.
    """

    parameters: tuple[str, ...]
    given: str
    state: tuple[str, ...]
    space: str
    pieces: tuple[PieceText, ...]
    point: tuple[tuple[str, str], ...]
    root: tuple[str, str]
    rank: str
    stages: tuple[tuple[str, str], ...]
    contraction: ContractionText
    size: str

    @property
    def extra_steps(self) -> int:
        """The steps from the first stage to the last."""
        return len(self.stages) - 1


@cache
def ball() -> AttractionText:
    """For 0 < alpha < 1/3 every orbit of the ball's map on x >= 0 converges to e_1."""
    names = ("low_impact", "corner", "trap", "near_trap")
    stages = (*chosen.TO_THE_POINT.stages[:-1], chosen.NEAR_IN_TRAP)
    (root,) = chosen.TO_THE_POINT.roots
    return AttractionText(
        parameters=("alpha",),
        given=f"0 < alpha and alpha < {threshold()}",
        state=("x", "w"),
        space=str(chosen.SPACE),
        pieces=_pieces(NORMAL),
        point=tuple(zip(("e_x", "e_w"), map(str, chosen.FIXED), strict=True)),
        root=(root[0], str(root[1])),
        rank=str(chosen.TO_THE_POINT.rank),
        stages=tuple(zip(names, map(str, stages), strict=True)),
        contraction=_told(chosen.IN_THE_TRAP),
        size=str(chosen.IN_THE_TRAP.size),
    )


def _pieces(setting: TheoremSetting) -> tuple[PieceText, ...]:
    return tuple(PieceText(str(guard), tuple(map(str, images))) for guard, images in setting.pieces)


def _told(contraction: chosen.Contraction) -> ContractionText:
    return ContractionText(
        tuple(map(str, contraction.weights)), str(contraction.rate), str(contraction.radius)
    )


@cache
def threshold() -> str:
    """The restitution from which on e_2 exists: 1/3."""
    return written(restitution_threshold(2))


LOSSY = "0 < alpha and alpha < 1"

# Near e_1 the map contracts this norm for every 0 < alpha < 1.
NEIGHBOURHOOD = _told(chosen.NEARBY)


@dataclass(frozen=True)
class Periodic:
    """A periodic orbit that stays away from the point: a state of it, as far as it is in the space,
    and its period.
    """

    given: str
    state: tuple[str, ...]
    period: int


@cache
def other_orbit() -> Periodic:
    """For 1/3 <= alpha < 1: the orbit of e_2, a flight that lasts two periods, from where its
    impact comes.
    """
    return Periodic(
        given=f"{threshold()} <= alpha and alpha < 1", state=tuple(map(str, chosen.OTHER)), period=2
    )


@cache
def boundary_speed() -> str:
    """The bound on u that belongs to the energy E_max, u^2 being twice the energy in units of r^2:
    (alpha + 1)/(1 - alpha).
    """
    bound = (1 + alpha) / (1 - alpha)
    if lowest_terms(bound**2 - 2 * E_max() / r**2) != 0:
        raise DerivationError(f"not the square root of twice {E_max()}")
    return written(bound)


@dataclass(frozen=True)
class Physical:
    """The same map in the paper's own units, and the change of coordinates (with the unit of each)
    that makes it the normal form.
    """

    parameters: tuple[str, ...]
    given: str
    state: tuple[str, ...]
    space: str
    pieces: tuple[PieceText, ...]
    point: tuple[str, ...]
    scaling: tuple[str, ...]
    units: tuple[str, ...]
    energy: str
    greatest_energy: str


@cache
def physical() -> Physical:
    """The ball's map on heights beta >= 0 and velocities v, for a table launched at r under gravity
    g.
    """
    return Physical(
        parameters=("alpha", "r", "g"),
        given="0 < r and 0 < g",
        state=("beta", "v"),
        space="0 <= beta",
        pieces=_pieces(PHYSICAL),
        point=tuple(map(str, PHYSICAL.fixed)),
        scaling=tuple(map(written, scaling())),
        units=(written(r * period()), written(r)),
        energy=written(total_energy()),
        greatest_energy=str(from_sympy(E_max())),
    )


# -------------------------------------------------------------------------------------------------
# The definitions of the theorem, printed for Coq from its data.

Lets = Sequence[tuple[str, str]]


@dataclass(frozen=True)
class TextScope:
    """What a definition may speak of: parameters, the two coordinates of a state, and names for
    terms.
    """

    parameters: tuple[str, ...]
    state: tuple[str, ...] = ()
    names: tuple[tuple[str, str], ...] = ()

    def heading(self, *texts: str) -> tuple[str, str]:
        """The arguments and the `let` lines that texts need, of those that the scope has."""
        used = set().union(*map(names_in, texts))
        lets: list[str] = []
        for name, value in reversed(self.names):
            if name in used:
                used |= names_in(value)
                lets.insert(0, f"let {name} := {coq_value(value)} in ")
        entries = [
            f"let {name} := {part} s in "
            for name, part in zip(self.state, ("fst", "snd"))
            if name in used
        ]
        unknown = used - {*self.parameters, *self.state, *dict(self.names)}
        if unknown:
            raise ClaimError(f"{', '.join(sorted(unknown))}: not known in {texts}")
        arguments = [f"({name} : R)" for name in self.parameters if name in used]
        return " ".join([*arguments, *(["(s : R * R)"] if self.state else [])]), "".join(
            entries + lets
        ) + ("\n  " if entries + lets else "")

    def applied(self, name: str, *texts: str) -> str:
        """The definition applied to the parameters that its texts need: what is left is a function
        of the state.
        """
        heading, _ = self.heading(*texts)
        used = [p for p in self.parameters if f"({p} : R)" in heading]
        return f"({name} {' '.join(used)})" if used else name

    def defined(self, name: str, returns: str, body: str, *texts: str) -> str:
        """One definition whose body is made of the texts."""
        heading, lets = self.heading(*texts)
        return f"Definition {name} {heading}{' ' if heading else ''}: {returns} :=\n  {lets}{body}."


def coq_value(text: str) -> str:
    """The Coq term of a text, in which sqrt(..) may stand alone."""
    if text.startswith("sqrt(") and text.endswith(")"):
        return f"sqrt ({coq_term(text[5:-1])})"
    return coq_term(text)


def predicate(scope: TextScope, name: str, text: str) -> str:
    """A set of states."""
    return scope.defined(name, "Prop", coq_formula(text), text)


def number(scope: TextScope, name: str, text: str) -> str:
    """A number that depends on parameters and state."""
    return scope.defined(name, "R", coq_value(text), text)


def pair(scope: TextScope, name: str, texts: Sequence[str]) -> str:
    """A state, or the image of a state."""
    first, second = texts
    return scope.defined(name, "R * R", f"({coq_term(first)}, {coq_term(second)})", *texts)


def piecewise(scope: TextScope, name: str, pieces: Sequence[PieceText]) -> str:
    """A map of two pieces: that of the first where its strict inequality holds, that of the second
    elsewhere.
    """
    first, second = pieces
    left, sign, right = first.region.partition(" < ")
    if not sign or any(mark in left + right for mark in "<>="):
        raise ClaimError(f"{first.region} is not one strict inequality")
    images = ["(" + ", ".join(map(coq_term, piece.images)) + ")" for piece in pieces]
    sides = " ".join(term_of(checker.parse(side), ATOM) for side in (left, right))
    body = f"if Rlt_dec {sides}\n  then {images[0]}\n  else {images[1]}"
    return scope.defined(name, "R * R", body, left, right, *first.images, *second.images)


# -------------------------------------------------------------------------------------------------
# Writes proofs/coq/theorem/Statements.v from the table of the theorem: `python -m
# juggleproof.proofs.theorem.coq`.

STATEMENTS = Path(__file__).resolve().parents[1] / "coq" / "theorem" / "Statements.v"


def statements(
    theorem: AttractionText,
    near: ContractionText,
    other: Periodic,
    physical: Physical,
    boundary: str,
) -> str:
    """The whole of Statements.v."""
    parts = [
        HEADER,
        _normal_form(theorem, near, other, boundary),
        _physical(physical),
        PINS,
        _theorems(theorem, other, physical),
    ]
    return without_primes("\n".join(part.strip("\n") + "\n" for part in parts))


def current() -> str:
    """The whole of Statements.v for the theorem as it is defined."""
    return statements(
        ball(),
        NEIGHBOURHOOD,
        other_orbit(),
        physical(),
        boundary_speed(),
    )


def _normal_form(
    theorem: AttractionText, near: ContractionText, other: Periodic, boundary: str
) -> str:
    name, under = theorem.root
    plain = TextScope(theorem.parameters, theorem.state)
    scope = TextScope(theorem.parameters, theorem.state, (*theorem.point, (name, f"sqrt({under})")))
    fixed = TextScope(theorem.parameters)
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
        number(TextScope(theorem.parameters), "rate", theorem.contraction.rate),
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


def _stage_list(scope: TextScope, theorem: AttractionText) -> str:
    applied = [scope.applied(stage, text).strip("()") for stage, text in theorem.stages]
    return f"Definition stages (alpha : R) : list (R * R -> Prop) := [{'; '.join(applied)}]."


def _physical(physical: Physical) -> str:
    scope, fixed = TextScope(physical.parameters, physical.state), TextScope(physical.parameters)
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


def _theorems(theorem: AttractionText, other: Periodic, physical: Physical) -> str:
    name, under = theorem.root
    scope = TextScope(theorem.parameters, theorem.state, (*theorem.point, (name, f"sqrt({under})")))
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
        lossy=coq_formula(LOSSY),
        other_given=coq_formula(other.given),
        threshold=coq_term(threshold()),
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
    write_file(STATEMENTS, current().encode())
