"""The branches of a question as regions: equations used up, factors of known sign divided out, and
a box that holds what is left.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import islice, product
from math import prod

from flint import Ordering, fmpz_mpoly

from juggleproof.algebra import trees
from juggleproof.algebra.intervals import Box
from juggleproof.algebra.polynomials import (
    Ring,
    constant_of,
    factorization,
    pseudo_divide,
    value_at,
)
from juggleproof.search.psatz.facts import EliminationStep, Reduction, Signed
from juggleproof.votes import limits
from juggleproof.votes.questions import Atom, Formula, atom, branches
from juggleproof.votes.spans import (
    ZERO,
    Bounds,
    Interval,
    bounding_box,
    dyadic,
    intervals,
    upper_end,
)

# -------------------------------------------------------------------------------------------------
# Facts made simpler before boxes are cut.


def solve_equations(
    names: tuple[str, ...], facts: Sequence[Atom], bounds: Sequence[Bounds] | None = None
) -> tuple[list[Atom], list[EliminationStep]] | None:
    """The facts without the variables that an equation among them gives, and the eliminations in
    order; None where the facts contradict each other.

    Formula: lead * variable = rest with lead > 0 by other facts, or on the box of the bounds, which
    holds all points at which the facts hold.
    """
    equations = [(k, fact.poly) for k, fact in enumerate(facts) if fact.relation == "="]
    if not equations:
        return list(facts), []
    signed = [
        Signed(k, fact.poly, fact.relation == ">")
        for k, fact in enumerate(facts)
        if fact.relation in (">", "!=")
    ]
    for _, poly in equations if bounds is not None else ():
        for factor in _positive_factors(poly, intervals(bounds or ())):
            signed.append(Signed(len(facts) + len(signed), factor, True))
    reduction = Reduction(Ring(names, Ordering.lex), equations, signed)
    if reduction.contradiction is not None:
        return None
    left = [atom(equation.poly, "=") for equation in reduction.left]
    left += [
        atom(reduction.reduce(fact.poly)[1], fact.relation)
        for fact in facts
        if fact.relation != "="
    ]
    if False in left:
        return None
    return list(dict.fromkeys(f for f in left if isinstance(f, Atom))), reduction.steps


def _positive_factors(poly: fmpz_mpoly, box: Sequence[Interval]) -> Iterator[fmpz_mpoly]:
    """The factors of leads of the equation, or their negatives, that are positive on the box."""
    for i, degree in enumerate(poly.degrees()):
        for factor, _ in factorization(poly.derivative(i))[1] if degree == 1 else ():
            for signed in (factor, -factor):
                if upper_end(-signed, box) < ZERO:
                    yield signed


def reduce_factors(
    facts: Sequence[Atom], bounds: Sequence[Bounds] | None = None
) -> list[Atom] | None:
    """Facts that follow from the given ones and are simpler; None where they contradict each other.

    Formula: p = f q > 0 with f > 0 or f >= 0 among the facts (or on the box) gives q > 0; p = f q
    >= 0 with f > 0 gives q >= 0; p = f^2 q > 0 gives q > 0; p = f q = 0 with f > 0 gives q = 0.
    Source: flint's factorization over the integers.
    """
    current, box = list(dict.fromkeys(facts)), intervals(bounds) if bounds is not None else None
    for _ in range(4):
        signs = [fact for fact in current if fact.relation in (">", ">=")]
        new: list[Atom] = []
        for fact in current:
            simpler = _simplified(fact, signs, box)
            if simpler is False:
                return None
            if isinstance(simpler, Atom) and simpler not in new:
                new.append(simpler)
        if _contradict(new):
            return None
        if new == current:
            break
        current = new
    return current


def _simplified(fact: Atom, signs: Sequence[Atom], box: Sequence[Interval] | None) -> Formula:
    if fact.relation == "!=":
        return fact
    constant, factors = factorization(fact.poly)
    if fact.relation == "=":
        one = fact.poly.context().constant(1)
        left = (f for f, _ in factors if not _known_sign(f, signs, box, "="))
        return atom(prod(left, start=one), "=")
    if len(factors) == 1 and factors[0][1] == 1:
        return fact
    positive, kept = constant > 0, list[tuple[fmpz_mpoly, int]]()
    for factor, exponent in factors:
        sign = _known_sign(factor, signs, box, fact.relation)
        if sign:
            positive = positive == (sign > 0 or exponent % 2 == 0)
        elif fact.relation == ">":
            kept += [(factor, 1)] if exponent % 2 else []
        else:
            kept.append((factor, 2 - exponent % 2))
    relation = fact.relation
    if relation == ">=" and not positive and all(exponent == 2 for _, exponent in kept):
        kept, relation = [(factor, 1) for factor, _ in kept], "="  # -q^2 >= 0
    one = fact.poly.context().constant(1 if positive else -1)
    return atom(prod((factor**exponent for factor, exponent in kept), start=one), relation)


def _known_sign(
    factor: fmpz_mpoly, signs: Sequence[Atom], box: Sequence[Interval] | None, relation: str
) -> int:
    """1 or -1 where the factor is known to be > 0 or < 0; for a strict product >= 0 or <= 0
    suffice.
    """
    minus = -factor
    for poly, sign in ((factor, 1), (minus, -1)):
        if any(s.poly == poly and (s.relation == ">" or relation == ">") for s in signs):
            return sign
    if box is not None:
        for poly, sign in ((factor, -1), (minus, 1)):
            end = upper_end(poly, box)
            if end < ZERO or relation == ">" and end == ZERO:
                return sign
    return 0


def _contradict(facts: Sequence[Atom]) -> bool:
    """Whether p > 0 stands beside -p > 0 or -p >= 0, or p = 0 beside p > 0 or -p > 0."""
    strict = [fact.poly for fact in facts if fact.relation == ">"]
    for fact in facts:
        minus = -fact.poly
        if fact.relation == ">" and any(Atom(minus, r) in facts for r in (">", ">=")):
            return True
        if fact.relation == "=" and (fact.poly in strict or minus in strict):
            return True
    return False


# -------------------------------------------------------------------------------------------------
# The region of a branch: a box that holds it, and exact points of it.


@dataclass(frozen=True)
class BranchRegion:
    """One branch, ready for boxes; variables that an equation gives are `solved` and no longer
    occur in the facts.
    """

    names: tuple[str, ...]
    facts: tuple[Atom, ...]
    solved: tuple[EliminationStep, ...]
    bounds: tuple[Bounds, ...]

    def used(self) -> list[int]:
        """The numbers of the variables that still occur."""
        return sorted({i for fact in self.facts for i in fact.used})

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
                else min(-limits.TRIAL_SIDE, high[1] - 2 * limits.TRIAL_SIDE)
                if not high[0]
                else -limits.TRIAL_SIDE
            )
            b = high[1] if not high[0] else max(limits.TRIAL_SIDE, a + 2 * limits.TRIAL_SIDE)
            sides.append(dyadic(a, b) if i in used else dyadic((a + b) / 2, (a + b) / 2))
        return tuple(sides)

    def complete(self, point: Sequence[Fraction]) -> list[Fraction]:
        """The point with the solved variables computed from the others."""
        values = list(point)
        for step in reversed(self.solved):
            lead = value_at(step.lead, values)
            values[step.variable] = value_at(step.rest, values) / lead if lead else Fraction(0)
        return values

    def test(self, formula: Formula) -> Callable[[list[Fraction]], bool]:
        """The exact test whether the completed point meets the formula."""
        return lambda point: holds_at(formula, self.complete(point))

    def reduced(self, poly: fmpz_mpoly) -> tuple[fmpz_mpoly, int] | None:
        """(p, c) with p / c the same polynomial without the solved variables, c > 0; None where
        that is none.
        """
        scale = 1
        for step in self.solved:
            generator = step.lead.context().gens()[step.variable]
            count, _, poly = pseudo_divide(poly, step.variable, generator, step.lead, step.rest)
            lead = constant_of(step.lead)
            if count and lead is None:
                return None
            scale *= (lead or 1) ** count
        return poly, scale

    def samples(self, formula: Formula) -> Iterator[list[Fraction]]:
        """A few exact points of the region that meet the formula, from small numbers."""
        used, count = self.used(), 0
        sides = [self.bounds[i] for i in used]
        choices = [
            [v for v in limits.SAMPLES if side[0] <= (0, v) <= side[1]] or [_inside(side)]
            for side in sides
        ]
        for values in islice(product(*choices), limits.MOST_SAMPLES):
            point = [Fraction(0)] * len(self.names)
            for i, value in zip(used, values):
                point[i] = value
            point = self.complete(point)
            if holds_at(formula, point):
                yield point
                count += 1
                if count == limits.ENOUGH_SAMPLES:
                    return


def holds_at(formula: Formula, point: Sequence[Fraction]) -> bool:
    """The exact truth value of the formula at a rational point."""
    return trees.truth(formula, lambda fact: fact.holds_at(point)) is True


@lru_cache(maxsize=16)  # one vote asks about the same part of the space again
def regions(names: tuple[str, ...], formula: Formula) -> Sequence[BranchRegion] | None:
    """The branches of the formula that are not seen to be empty at once; None where there are too
    many.
    """
    parts = branches(formula, limits.MOST_BRANCHES)
    if parts is None:
        return None
    candidates = (_region(names, facts) for facts in parts)
    return tuple(region for region in candidates if region is not None)


def _region(names: tuple[str, ...], facts: Sequence[Atom]) -> BranchRegion | None:
    """The branch as a region; None where its facts contradict each other on the way.

    Factors may turn into equations and bounds may give factors a sign, so both are gone through
    twice.
    """
    current, solved = list(facts), list[EliminationStep]()
    bounds: list[Bounds] | None = None
    for _ in range(2):
        solution = solve_equations(names, current, bounds)
        reduced = reduce_factors(solution[0], bounds) if solution is not None else None
        if solution is None or reduced is None:
            return None
        solved += solution[1]
        if bounds is None or reduced != current:
            bounds = bounding_box(reduced, len(names))
        if bounds is None:
            return None
        current = reduced
    return BranchRegion(names, tuple(current), tuple(solved), tuple(bounds or ()))


def _inside(bounds: Bounds) -> Fraction:
    (low_kind, low), (high_kind, high) = bounds
    return (
        (low + high) / 2
        if not low_kind and not high_kind
        else low + 1
        if not low_kind
        else high - 1
    )
