"""The energy bounds E_max, Delta E_max and Delta E_sup, for all 0 < alpha < 1 (section 4.1,
appendix A).
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

from sympy import Expr, ImmutableMatrix

from symbolic.algebra import DerivationError, State, lowest_terms
from symbolic.collision import collision_margin
from symbolic.extrema import candidates, falls_without_bound, greatest
from symbolic.normal_form import normal_energy, normal_energy_change, scaled, unscaling
from symbolic.signs import reduced, sign_for_lossy_impacts
from symbolic.symbols import r, w, x
from symbolic.table import period


class Extremum(NamedTuple):
    """The least upper bound of a function on a set: its value, the state it belongs to, and whether
    it is reached.
    """

    value: Expr
    state: State
    attained: bool


def _supremum_on_b1(
    objective: Expr, closed: list[Expr], opened: list[Expr], bounding: Expr
) -> Extremum:
    """The supremum of the objective over the states of B1 with closed constraints >= 0 and opened
    ones > 0.

    `bounding` falls without bound on B1. It is the objective, or a closed constraint: either way
    candidates suffice.
    """
    if not falls_without_bound(bounding) or bounding not in (objective, *closed):
        raise DerivationError(f"the supremum may lie at infinity: {bounding}")
    opened = [scaled(collision_margin(), r**2), *opened]
    best = greatest(candidates(objective, [x, *closed, *opened]))
    touched = [
        g
        for g in opened
        if g in best.active or sign_for_lossy_impacts(g.subs({x: best.x, w: best.w})) == 0
    ]
    # Raising the height leaves the touched boundary into the set, so the point is a limit of the
    # set.
    if any(sign_for_lossy_impacts(g.diff(x)) <= 0 for g in touched):
        raise DerivationError(f"the candidate may be isolated: {best}")
    return Extremum(best.value * r**2, physical_state(best.x, best.w), not touched)


def physical_state(height: Expr, closing_speed: Expr) -> State:
    """The state (beta, v) of a point (x, w) whose coordinates depend on alpha alone.

    >>> physical_state(1, 2).T
    Matrix([[2*r**2/g, -r]])
    """
    units = (r * period(), r)
    entries = []
    for entry, unit in zip(unscaling(), units, strict=True):
        # Measured in its unit the entry has no symbol but alpha, so that a root in it can be
        # reduced.
        value = lowest_terms(entry / unit).subs({x: height, w: closing_speed})
        entries.append(reduced(value) * unit)
    return ImmutableMatrix(entries)


@cache
def largest_kept_energy() -> Extremum:
    """The greatest energy in B1 where an impact does not lose energy: E_max, at (0, -(1 + alpha) /
    (1 - alpha) r) (34).

    Candidates in the set 0 <= x <= w, energy change >= 0: stationary points along the three curves,
    and their corners.

    >>> from symbolic.symbols import alpha
    >>> found = largest_kept_energy()
    >>> found.value.subs(alpha, 0), found.state.T.subs(alpha, 0), found.attained
    (r**2/2, Matrix([[0, -r]]), True)
    """
    change = normal_energy_change()
    return _supremum_on_b1(normal_energy(), [change], [], bounding=change)


@cache
def E_max() -> Expr:
    """The greatest energy of a state of B1 whose impact does not lose energy: ((1 + alpha) / (1 -
    alpha) r)^2 / 2 (equation 34).

    >>> E_max()
    r**2*(alpha + 1)**2/(2*(alpha - 1)**2)
    """
    return largest_kept_energy().value


@cache
def largest_energy_change() -> Extremum:
    """The greatest energy change on B1: Delta E_max, at (0, alpha r / (alpha - 1)) (equation 37).

    >>> largest_energy_change().state.T, largest_energy_change().attained
    (Matrix([[0, alpha*r/(alpha - 1)]]), True)
    """
    change = normal_energy_change()
    return _supremum_on_b1(change, [], [], bounding=change)


@cache
def delta_E_max() -> Expr:
    """The greatest energy change of an impact: (1 + alpha) / (1 - alpha) r^2 / 2 (equation 37).

    >>> delta_E_max()
    -r**2*(alpha + 1)/(2*(alpha - 1))
    """
    return largest_energy_change().value


@cache
def region_energy() -> Expr:
    """The energy up to which the region R reaches: E_max + Delta E_max = (1 + alpha) / (1 -
    alpha)^2 r^2 (equation 23).

    >>> region_energy()
    r**2*(alpha + 1)/(alpha - 1)**2
    """
    return reduced(lowest_terms((E_max() + delta_E_max()) / r**2)) * r**2


@cache
def least_energy_loss() -> Extremum:
    """The supremum of the energy change on B1 - R: Delta E_sup, at the corner where R = 0 meets
    beta = 0 (A.3, 39).

    The corner belongs to R, so the supremum is not reached.

    >>> from sympy import Rational
    >>> from symbolic.symbols import alpha
    >>> found, eighth = least_energy_loss(), Rational(1, 8)
    >>> found.state.T.subs(alpha, eighth), found.value.subs(alpha, eighth), found.attained
    (Matrix([[0, -12*r/7]]), -513*r**2/896, False)
    """
    change = normal_energy_change()
    outside = normal_energy() - lowest_terms(region_energy() / r**2)
    return _supremum_on_b1(change, [], [outside], bounding=change)


@cache
def delta_E_sup() -> Expr:
    """The supremum of the energy change of an impact outside R (appendix A.3.2).

    >>> delta_E_sup()
    r**2*(-alpha*(alpha + 1)*sqrt(2*alpha + 2)/(alpha - 1) + (alpha + 1)**3/(2*(alpha - 1)))
    """
    return least_energy_loss().value
