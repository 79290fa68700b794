"""Physical units: positive variables that a change of units makes 1, and identities lifted back by
powers of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from flint import fmpz_mat, fmpz_mpoly

from .polynomials import Ring

Weight = tuple[int, ...]  # one entry for each unit


class Scaling:
    """Gradings under which every polynomial of a state is homogeneous, each with a positive
    variable of weight 1: its unit.

    >>> ring = Ring(("r", "v", "w"))
    >>> r, v, w = ring.gens
    >>> scaling = Scaling(ring, [r**2 - v**2, r * w - v * w], [0])
    >>> scaling.units, str(scaling.lower(r**2 - v**2)), str(scaling.lift(1 - v, (2,)))
    ((0,), '-v^2 + 1', 'r^2 - r*v')
    """

    def __init__(self, ring: Ring, polys: Sequence[fmpz_mpoly], positive: Sequence[int]) -> None:
        self.ring = ring
        self.units: tuple[int, ...] = ()
        self.weights: list[Weight] = []  # of every variable
        self.values: dict[int, int] = {}
        self.gradings: list[list[int]] = []  # of all of which the polynomials are homogeneous
        differences = frozenset[tuple[int, ...]]().union(*map(self._differences, polys))
        key = differences, tuple(positive)
        if key not in ring.scalings:  # most states of a search have the same units
            self._find(differences, positive)
            ring.scalings[key] = self.units, self.weights, self.values, self.gradings
        self.units, self.weights, self.values, self.gradings = ring.scalings[key]

    def _differences(self, poly: fmpz_mpoly) -> frozenset[tuple[int, ...]]:
        """The first monomial less each of the others."""
        known = self.ring.differences.get(id(poly))
        if known is None:
            first, *others = poly.monoms()
            found = frozenset(tuple(a - b for a, b in zip(first, other)) for other in others)
            known = self.ring.differences[id(poly)] = (
                poly,
                found,
            )  # holding the polynomial keeps its id from being used again
        return known[1]

    def _find(self, differences: frozenset[tuple[int, ...]], positive: Sequence[int]) -> None:
        ring = self.ring
        if differences:
            basis, rank = fmpz_mat(sorted(differences)).nullspace()
            self.gradings = [[int(c) for c in line] for line in zip(*basis.tolist())][:rank]
        else:
            self.gradings = [[int(i == k) for k in range(ring.size)] for i in range(ring.size)]
        candidates = [k for k in positive if any(row[k] for row in self.gradings)]
        for count in range(min(len(self.gradings), len(candidates)), 0, -1):
            if any(self._choose(units) for units in combinations(candidates, count)):
                return

    def _choose(self, units: tuple[int, ...]) -> bool:
        """Takes these units, if each has a grading of its own with integer weights for all
        variables.
        """
        size = self.ring.size
        others = [k for k in range(size) if k not in units]
        for first in others if len(units) < len(self.gradings) else others[:1] or [-1]:
            order = [*units, *(k for k in (first, *(k for k in others if k != first)) if k >= 0)]
            table, den, rank = fmpz_mat([[row[k] for k in order] for row in self.gradings]).rref()
            lines, den = [[int(c) for c in line] for line in table.tolist()[: len(units)]], int(den)
            if (
                rank >= len(units)
                and all(c % den == 0 for line in lines for c in line)
                and all(
                    lines[i][j] == (den if i == j else 0)
                    for i in range(len(units))
                    for j in range(len(units))
                )
            ):
                place = {variable: k for k, variable in enumerate(order)}
                self.units, self.values = units, dict.fromkeys(units, 1)
                self.weights = [tuple(line[place[k]] // den for line in lines) for k in range(size)]
                return True
        return False

    def alike(self, v: int, w: int) -> bool:
        """Whether two variables may be compared: every grading gives them the same weight."""
        return all(row[v] == row[w] for row in self.gradings)

    def lower(self, poly: fmpz_mpoly) -> fmpz_mpoly:
        """The polynomial with every unit set to 1."""
        if not self.units:
            return poly
        key = id(poly), self.units
        if key not in self.ring.lowered:
            self.ring.lowered[key] = poly, poly.subs(self.values)
        return self.ring.lowered[key][1]

    def of_monomial(self, monomial: Sequence[int]) -> Weight:
        """The weight of one monomial."""
        return tuple(
            sum(int(e) * self.weights[k][i] for k, e in enumerate(monomial) if e)
            for i in range(len(self.units))
        )

    def largest(self, poly: fmpz_mpoly) -> Weight:
        """The least weight to which a lowered polynomial can be lifted."""
        parts = [self.of_monomial(monomial) for monomial in poly.monoms()] or [
            (0,) * len(self.units)
        ]
        return tuple(map(max, zip(*parts)))

    def lift(self, poly: fmpz_mpoly, weight: Weight) -> fmpz_mpoly:
        """The homogeneous polynomial of this weight which lowers to the given one."""
        if not self.units:
            return poly
        terms = {}
        for monomial, coefficient in zip(poly.monoms(), poly.coeffs()):
            exponents = [int(e) for e in monomial]
            for unit, have, want in zip(self.units, self.of_monomial(monomial), weight):
                exponents[unit] += want - have
            terms[tuple(exponents)] = coefficient
        return self.ring.ctx.from_dict(terms)
