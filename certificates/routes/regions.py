"""The region of a question, branch by branch: facts made simple, a box that holds it, and exact
points of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice, product

from certificates.routes.arithmetic import Box
from certificates.routes.bounding import Bounds, bounding_box, dyadic
from certificates.routes.polynomials import Atom, Formula, branches, truth
from certificates.routes.reduction import Solved, reduce_factors, solve_equations

MOST_BRANCHES, MOST_SAMPLES, ENOUGH_SAMPLES = 64, 128, 8
TRIAL_SIDE = Fraction(8)
SAMPLES = [
    Fraction(n, d)
    for n, d in (
        (1, 4),
        (1, 1),
        (1, 8),
        (0, 1),
        (2, 1),
        (1, 2),
        (3, 2),
        (-1, 1),
        (3, 1),
        (7, 1),
        (5, 4),
        (-3, 1),
    )
]


@dataclass(frozen=True)
class Region:
    """One branch, ready for boxes; variables that an equation gives are `solved` and no longer
    occur in the facts.
    """

    names: tuple[str, ...]
    facts: tuple[Atom, ...]
    solved: tuple[Solved, ...]
    bounds: tuple[Bounds, ...]

    def used(self) -> list[int]:
        """The numbers of the variables that still occur."""
        return sorted({i for fact in self.facts for i in fact.poly.used})

    def unbounded(self) -> list[str]:
        """The variables that still occur and that nothing bounds."""
        return [self.names[i] for i in self.used() if self.bounds[i][0][0] or self.bounds[i][1][0]]

    def box(self) -> Box:
        """Dyadic sides around the intervals; infinite ones are cut, and variables that no longer
        occur stay at one value.
        """
        used, sides = self.used(), []
        for i, (low, high) in enumerate(self.bounds):
            a = (
                low[1]
                if not low[0]
                else min(-TRIAL_SIDE, high[1] - 2 * TRIAL_SIDE)
                if not high[0]
                else -TRIAL_SIDE
            )
            b = high[1] if not high[0] else max(TRIAL_SIDE, a + 2 * TRIAL_SIDE)
            sides.append(dyadic(a, b) if i in used else dyadic((a + b) / 2, (a + b) / 2))
        return tuple(sides)

    def complete(self, point: Sequence[Fraction]) -> list[Fraction]:
        """The point with the solved variables computed from the others."""
        values = list(point)
        for step in reversed(self.solved):
            values[step.i] = step.value.at(values)
        return values

    def test(self, formula: Formula) -> Callable[[list[Fraction]], bool]:
        """The exact test whether the completed point meets the formula."""
        return lambda point: holds_at(formula, self.complete(point))

    def samples(self, formula: Formula) -> Iterator[list[Fraction]]:
        """A few exact points of the region that meet the formula, from small numbers."""
        used, found = self.used(), 0
        sides = [self.bounds[i] for i in used]
        choices = [
            [v for v in SAMPLES if side[0] <= (0, v) <= side[1]] or [_inside(side)]
            for side in sides
        ]
        for values in islice(product(*choices), MOST_SAMPLES):
            point = [Fraction(0)] * len(self.names)
            for i, value in zip(used, values):
                point[i] = value
            point = self.complete(point)
            if holds_at(formula, point):
                yield point
                found += 1
                if found == ENOUGH_SAMPLES:
                    return


def holds_at(formula: Formula, point: Sequence[Fraction]) -> bool:
    """The exact truth value of the formula at a rational point."""
    return truth(formula, lambda fact: fact.holds(fact.poly.at(point))) is True


def regions(names: tuple[str, ...], formula: Formula) -> list[Region] | None:
    """The branches of the formula that are not seen to be empty at once; None where there are too
    many.
    """
    parts = branches(formula, MOST_BRANCHES)
    if parts is None:
        return None
    found = (_region(names, facts) for facts in parts)
    return [region for region in found if region is not None]


def _region(names: tuple[str, ...], facts: Sequence[Atom]) -> Region | None:
    """The branch as a region; None where its facts contradict each other on the way.

    Factors may turn into equations and bounds may give factors a sign, so both are gone through
    twice.
    """
    current, solved = list(facts), list[Solved]()
    bounds: list[Bounds] | None = None
    for _ in range(2):
        solution = solve_equations(current)
        reduced = reduce_factors(solution[0], bounds) if solution is not None else None
        if solution is None or reduced is None:
            return None
        solved += solution[1]
        if bounds is None or reduced != current:
            bounds = bounding_box(reduced, len(names))
        if bounds is None:
            return None
        current = reduced
    return Region(names, tuple(current), tuple(solved), tuple(bounds or ()))


def _inside(bounds: Bounds) -> Fraction:
    (low_kind, low), (high_kind, high) = bounds
    return (
        (low + high) / 2
        if not low_kind and not high_kind
        else low + 1
        if not low_kind
        else high - 1
    )
