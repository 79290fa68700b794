"""States on borders: unknowns put where relations that include equality are equations, the others
in between, tried on samples of the base.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from flint import fmpq_mpoly

from .candidates import UNITS
from .condition import Condition, Tree, coefficients_in, valued
from .near import Trial, ring_names
from .partial import Partial
from .quotients import Choice, Quotient, Root, square_roots
from .templates import TemplateSearch

STEPS = 120  # substitutions in one search
MOST_FACTORS = 200  # a polynomial with more terms is not factored
Move = tuple[str, Quotient, "Root | None"]


class CornerSearch(TemplateSearch):
    """One search for corners: equations are solved first, then some of the relations >= are taken
    as equations, and solved too.

    The sharp end of a range lies as a rule where some inequalities meet, and beyond it the states
    that break a statement begin there.
    """

    def search(self, condition: Condition, unknowns: Sequence[str]) -> Iterator[Choice]:
        """Choices of terms for the unknowns, those on the most borders first."""
        self.steps, self.seen = STEPS, set[frozenset[int]]()
        if (
            self.borders is None
        ):  # factors now: what an adjoined root is put into may no longer be a product
            products = [
                condition.polys[k].factor()[1]
                for k in condition.used()
                if len(condition.polys[k]) <= MOST_FACTORS
            ]
            self.borders = [
                factor for factors in products if len(factors) > 1 for factor, _ in factors
            ]
        yield from super().search(condition, unknowns)

    def _descend(self, partial: Partial, unknowns: list[str]) -> Iterator[Choice]:
        yield from self._corner(partial, unknowns, frozenset())

    def _corner(
        self, partial: Partial, unknowns: list[str], chosen: frozenset[int]
    ) -> Iterator[Choice]:
        if sum(c.tree is not False for c in partial.sampled) < self.least:
            return
        if not unknowns:
            yield from super()._descend(partial, unknowns)
            return
        unit = next((name for name in unknowns if name in UNITS), None)
        if unit is not None:
            one = partial.condition.ring.constant(1)
            yield from self._follow(partial, unknowns, chosen, [(unit, Quotient(one, one), None)])
            return
        forced = next(
            (
                moves
                for poly, relation in partial.condition.facts()
                if relation == "="
                for moves in [self._moves(partial, poly, unknowns)]
                if moves
            ),
            None,
        )
        if forced:
            yield from self._follow(partial, unknowns, chosen, forced)
            return
        for k, relation in sorted(set(atoms(partial.condition.tree))):
            onward = chosen | {k}
            if relation in (">=", "=") and onward not in self.seen and self.steps > 0:
                self.seen.add(onward)
                yield from self._follow(
                    partial,
                    unknowns,
                    onward,
                    self._moves(partial, partial.condition.polys[k], unknowns),
                )
        if len(unknowns) == 1:
            yield from super()._descend(partial, unknowns)

    def _follow(
        self, partial: Partial, unknowns: list[str], chosen: frozenset[int], moves: Sequence[Move]
    ) -> Iterator[Choice]:
        seen = self.seen
        for name, value, root in moves:
            self.steps -= 1
            self.budget.spend(100 + 60 * len(self.samples) * (1 + len(partial.condition.polys)))
            widened = (
                partial
                if root is None
                else Partial(partial.make, partial.sampled, partial.steps, [*partial.roots, root])
            )
            rows = [
                Trial(sampled, name) if sampled.tree is not False else None
                for sampled in partial.sampled
            ]
            if (ring_names(value.top) | ring_names(value.bottom)) & set(
                unknowns
            ) or self._plausible(widened, rows, value, None, {}):
                self.seen = set(seen) if len(moves) > 1 else seen
                yield from self._corner(
                    self._with(widened, name, value.top, value.bottom),
                    [n for n in unknowns if n != name],
                    chosen,
                )
        self.seen = seen

    def _moves(self, partial: Partial, poly: fmpq_mpoly, unknowns: Sequence[str]) -> list[Move]:
        """The ways to make a polynomial 0 by the value of one unknown: of a factor linear in it, or
        of degree 2 in it alone.
        """
        found: list[Move] = []
        for factor, _ in poly.factor()[1] if len(poly) <= MOST_FACTORS else ():
            names = ring_names(factor)
            present = [n for n in unknowns if n in names and n not in self.integers]
            present.sort(key=lambda n: (self._degree(partial, n), -unknowns.index(n)))
            linear = next(
                (
                    move
                    for name in present
                    for move in self._linear(partial, factor, name, unknowns)
                ),
                None,
            )
            if linear is not None:
                found.append(linear)
            elif len(present) == 1 and len(coefficients_in(factor, present[0])) == 3:
                zeros, fresh = square_roots(factor, present[0], partial.roots)
                found += [(present[0], zero, fresh) for zero in zeros]
        return found

    @staticmethod
    def _degree(partial: Partial, name: str) -> int:
        """How high an unknown occurs: the lowest is solved for, which keeps degrees low."""
        condition = partial.condition
        place = condition.ring.variable_to_index(name)
        return max((int(condition.polys[k].degrees()[place]) for k in condition.used()), default=0)

    def _linear(
        self, partial: Partial, factor: fmpq_mpoly, name: str, unknowns: Sequence[str]
    ) -> list[Move]:
        parts = coefficients_in(factor, name)
        if len(parts) != 2 or ring_names(parts[1]) & set(unknowns):
            return []
        if any(valued(parts[1], self._given(partial, sample)) == 0 for sample in self.samples):
            return []
        return [(name, Quotient.reduced(-parts[0], parts[1]), None)]


def atoms(tree: Tree) -> Iterator[tuple[int, str]]:
    """The relations of a tree, each as (number of its polynomial, relation)."""
    if isinstance(tree, bool):
        return
    if isinstance(tree[0], int):
        yield tree
    else:
        for part in tree[1]:
            yield from atoms(part)
