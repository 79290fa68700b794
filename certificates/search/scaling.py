"""Physical units: positive variables that a change of units makes 1, and identities lifted back by powers of them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from flint import fmpz_mat, fmpz_mpoly

from .polynomials import Ring

Weight = tuple[int, ...]  # one entry for each unit


class Scaling:
    """Gradings under which every polynomial of a state is homogeneous, each with a positive variable of weight 1: its unit.

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
        self.values: dict[str, int] = {}
        differences: set[tuple[int, ...]] = set()
        for poly in polys:
            first, *others = poly.monoms()
            differences.update(tuple(a - b for a, b in zip(first, other)) for other in others)
        anchored = {k for d in differences if sum(map(bool, d)) == 1 for k, e in enumerate(d) if e}
        candidates = [k for k in positive if k not in anchored]
        if candidates:
            self._choose(sorted(differences), candidates)

    def _choose(self, differences: list[tuple[int, ...]], candidates: list[int]) -> None:
        """Takes as many units among the candidates as gradings allow, with integer weights for all variables."""
        size = self.ring.size
        if differences:
            basis, rank = fmpz_mat(differences).nullspace()
            rows = [list(line) for line in zip(*basis.tolist())][:rank]
        else:
            rows = [[int(i == k) for k in range(size)] for i in range(size)]
        for count in range(min(len(rows), len(candidates)), 0, -1):
            for units in combinations(candidates, count):
                order = [*units, *(k for k in range(size) if k not in units)]
                table, den, _ = fmpz_mat([[row[k] for k in order] for row in rows]).rref()
                lines = table.tolist()[:count]
                if all(int(lines[i][j]) == (int(den) if i == j else 0) for i in range(count) for j in range(count)) and all(
                        int(c) % int(den) == 0 for line in lines for c in line):
                    self.units = units
                    place = {variable: k for k, variable in enumerate(order)}
                    self.weights = [tuple(int(line[place[k]]) // int(den) for line in lines) for k in range(size)]
                    self.values = {self.ring.names[k]: 1 for k in units}
                    return

    def lower(self, poly: fmpz_mpoly) -> fmpz_mpoly:
        """The polynomial with every unit set to 1."""
        return poly.subs(self.values) if self.units else poly

    def of_monomial(self, monomial: Sequence[int]) -> Weight:
        """The weight of one monomial."""
        return tuple(sum(int(e) * self.weights[k][i] for k, e in enumerate(monomial) if e) for i in range(len(self.units)))

    def largest(self, poly: fmpz_mpoly) -> Weight:
        """The least weight to which a lowered polynomial can be lifted."""
        parts = [self.of_monomial(monomial) for monomial in poly.monoms()] or [(0,) * len(self.units)]
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
