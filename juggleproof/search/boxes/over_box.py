"""One fact over the box of the others: it fails everywhere between bounds of its variables."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import NamedTuple

from juggleproof.algebra.box_trees import Box, Exponents, search_tree, value_at
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.statements.nodes import Node
from juggleproof.statements.states import SearchState, variables_in
from juggleproof.statements.work import Budget


class FactBound(NamedTuple):
    """An end of a variable, the number of the fact that has it, and the fact's slope."""

    at: Fraction
    fact: int
    slope: Fraction


@dataclass(frozen=True)
class FactOverBox:
    """A fact p > 0 or p >= 0 of degree above 1, the bounds of its variables, and -p by the
    exponents of these.
    """

    index: int
    strict: bool
    names: list[str]
    bounds: list[tuple[FactBound, FactBound]]
    opposite: dict[Exponents, Fraction]

    @property
    def box(self) -> Box:
        """The ends of each variable."""
        return [(low.at, high.at) for low, high in self.bounds]

    @property
    def facts(self) -> list[tuple[int, int]]:
        """The numbers of the facts that bound each variable."""
        return [(low.fact, high.fact) for low, high in self.bounds]

    @property
    def size(self) -> int:
        """The number of Bernstein coefficients."""
        return prod(1 + max(e[k] for e in self.opposite) for k in range(len(self.names)))

    def middle(self) -> Fraction:
        """The value of -p at the middle of the box."""
        return value_at(self.opposite, [(low + high) / 2 for low, high in self.box])


def facts_over_box(state: SearchState) -> Iterator[FactOverBox]:
    """The facts all of whose variables are bounded on both sides, as far as their Bernstein forms
    are not too large.
    """
    bounds = box_of(state)
    for index, (poly, relation) in enumerate(state.facts):
        names = variables_in(state.context, poly)
        if relation in (">", ">=") and poly.deg > 1 and bounds.keys() >= set(names):
            own = [bounds[name] for name in names]
            opposite = {e: -c for e, c in terms_of(state, poly, names).items()}
            fact = FactOverBox(index, relation == ">", names, own, opposite)
            if fact.size <= limits.MOST_COEFFICIENTS:
                yield fact


def box_of(state: SearchState) -> dict[str, tuple[FactBound, FactBound]]:
    """The closest bounds of each variable that has both, by facts that are linear in it alone."""
    lows: dict[str, FactBound] = {}
    highs: dict[str, FactBound] = {}
    for index, (poly, relation) in enumerate(state.facts):
        if relation not in (">", ">=") or len(poly.terms) > 2:
            continue
        names = variables_in(state.context, poly)
        if len(names) != 1:
            continue
        (name,) = names
        one = 1 << checker.BITS * state.context.index[name]
        if not set(poly.terms) <= {0, one}:
            continue
        slope = poly.terms[one]
        at = Fraction(-poly.terms.get(0, 0), slope)
        end = FactBound(at, index, Fraction(abs(slope), poly.den))
        if slope > 0 and (name not in lows or end.at > lows[name].at):
            lows[name] = end
        if slope < 0 and (name not in highs or end.at < highs[name].at):
            highs[name] = end
    return {
        name: (lows[name], highs[name])
        for name in lows
        if name in highs and lows[name].at < highs[name].at
    }


def close_over_box(state: SearchState, most: int, budget: Budget) -> Node | None:
    """A node with a tree of at most `most` letters for a fact of degree above 1 or in several
    variables; None where none of the facts fails in all of the box, or that takes more.

    >>> context = checker.Context()
    >>> for name in "xy":
    ...     context.declare(name)
    >>> text = "0 <= x and x <= 1 and 0 <= y and y <= 1 and x*y*(1 - x) > 1/4"
    >>> state = SearchState(context).assume(context.formula(checker.parse(text)))
    >>> close_over_box(state, 9, Budget(10**6))
    ('boxes', 4, [(0, 1), (2, 3)], 'Ba..')

    Raises Exhausted where the budget ends.
    """
    for fact in facts_over_box(state):
        middle, size, constant = fact.middle(), fact.size, (0,) * len(fact.names)
        for margin in (Fraction(0),) if fact.strict else limits.BOX_MARGINS:
            # each face is a part of the box before: all faces cost no more than two boxes
            letters = min(most, max(budget.left // size, 2 * len(fact.names)))
            budget.spend(10)
            if middle < 0 or letters < 1:
                break
            budget.spend(size)
            above = fact.opposite.get(constant, Fraction(0)) - margin * middle
            tree = search_tree({**fact.opposite, constant: above}, fact.box, letters)
            if tree is not None:
                budget.spend((2 + sum(map(str.islower, tree))) * size // 10)
                return "boxes", fact.index, fact.facts, tree
            budget.spend(letters * size // 50)
    return None


def terms_of(state: SearchState, poly: checker.Poly, names: list[str]) -> dict[Exponents, Fraction]:
    """A polynomial by the exponents of its variables."""
    shifts = [checker.BITS * state.context.index[name] for name in names]
    mask = (1 << checker.BITS) - 1
    return {
        tuple((packed >> shift) & mask for shift in shifts): Fraction(c, poly.den)
        for packed, c in poly.terms.items()
    }
