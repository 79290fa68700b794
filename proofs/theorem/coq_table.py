"""The theorem as texts for Coq, in the syntax that the checker reads: the choices of
proofs/theorem/definition.py, and what is derived.

Rank, stages, weights and rates are the very ones that the checker is given; maps, regions, points
and energies come from `symbolic`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from proofs.encoding import from_sympy
from proofs.theorem import definition as chosen
from proofs.theorem.rules import NORMAL, PHYSICAL, Setting
from proofs.theorem.written import written
from symbolic.algebra import DerivationError, lowest_terms
from symbolic.bounds import E_max
from symbolic.energy import total_energy
from symbolic.fixed_points import restitution_threshold
from symbolic.normal_form import scaling
from symbolic.symbols import alpha, r
from symbolic.table import period


@dataclass(frozen=True)
class Piece:
    """What the map does on one region: an image for each coordinate."""

    region: str
    images: tuple[str, ...]


@dataclass(frozen=True)
class Contraction:
    """A weighted sup norm around the point that the map contracts by a rate, within a radius (times
    the weights).
    """

    weights: tuple[str, ...]
    rate: str
    radius: str


@dataclass(frozen=True)
class Attraction:
    """Every orbit in the space reaches the last stage and from there on approaches the point.

    Outside the stages the rank falls by 1 a step; each stage leads to the next, the last to itself;
    on the last stage, where the point is at most `size` away, the map contracts; all states of the
    space within the radius of the point are in the last stage.
    """

    parameters: tuple[str, ...]
    given: str
    state: tuple[str, ...]
    space: str
    pieces: tuple[Piece, ...]
    point: tuple[tuple[str, str], ...]
    root: tuple[str, str]
    rank: str
    stages: tuple[tuple[str, str], ...]
    contraction: Contraction
    size: str

    @property
    def extra_steps(self) -> int:
        """The steps from the first stage to the last."""
        return len(self.stages) - 1


@cache
def ball() -> Attraction:
    """For 0 < alpha < 1/3 every orbit of the ball's map on x >= 0 converges to e_1."""
    names = ("low_impact", "corner", "trap", "near_trap")
    stages = (*chosen.TO_THE_POINT.stages[:-1], chosen.NEAR_IN_TRAP)
    (root,) = chosen.TO_THE_POINT.roots
    return Attraction(
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


def _pieces(setting: Setting) -> tuple[Piece, ...]:
    return tuple(Piece(str(guard), tuple(map(str, images))) for guard, images in setting.pieces)


def _told(contraction: chosen.Contraction) -> Contraction:
    return Contraction(
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
    pieces: tuple[Piece, ...]
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
