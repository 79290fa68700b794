"""One fact over the box of the others: it fails everywhere between bounds of its variables."""

from __future__ import annotations

from fractions import Fraction
from math import prod
from typing import NamedTuple

from juggleproof.certificates import checker
from juggleproof.certificates.nodes import Node
from juggleproof.certificates.search.boxes.small import Exponents, search_tree, value_at
from juggleproof.certificates.states import State
from juggleproof.certificates.work import Budget

MOST_COEFFICIENTS = 4000  # of the Bernstein form of a fact
MARGINS = (Fraction(1, 100), Fraction(1, 10**5))  # parts of the value at the middle of the box


class Bound(NamedTuple):
    """An end of a variable, and the number of the fact that has it."""

    at: Fraction
    fact: int


def box_of(state: State) -> dict[str, tuple[Bound, Bound]]:
    """The closest bounds of each variable that has both, by facts that are linear in it alone."""
    lows: dict[str, Bound] = {}
    highs: dict[str, Bound] = {}
    for index, (poly, relation) in enumerate(state.facts):
        names = checker.variables_of(state.context, poly)
        if relation not in (">", ">=") or len(names) != 1:
            continue
        (name,) = names
        one = 1 << checker.BITS * state.context.index[name]
        if not set(poly.terms) <= {0, one}:
            continue
        slope, end = poly.terms[one], Bound(Fraction(-poly.terms.get(0, 0), poly.terms[one]), index)
        if slope > 0 and (name not in lows or end.at > lows[name].at):
            lows[name] = end
        if slope < 0 and (name not in highs or end.at < highs[name].at):
            highs[name] = end
    return {
        name: (lows[name], highs[name])
        for name in lows
        if name in highs and lows[name].at < highs[name].at
    }


def close_over_box(state: State, most: int, budget: Budget) -> Node | None:
    """A node with a tree of at most `most` letters for a fact of degree above 1 or in several
    variables; None where none of the facts fails in all of the box, or that takes more.

    >>> context = checker.Context()
    >>> for name in "xy":
    ...     context.declare(name)
    >>> text = "0 <= x and x <= 1 and 0 <= y and y <= 1 and x*y*(1 - x) > 1/4"
    >>> state = State(context).assume(context.formula(checker.parse(text)))
    >>> close_over_box(state, 9, Budget(10**6))
    ('boxes', 4, [(0, 1), (2, 3)], 'Ba..')

    Raises Exhausted where the budget ends.
    """
    bounds = box_of(state)
    for index, (poly, relation) in enumerate(state.facts):
        used = checker.variables_of(state.context, poly)
        names = [name for name in state.context.index if name in used]
        if relation not in (">", ">=") or poly.deg < 2 or not used <= bounds.keys():
            continue
        terms = _opposite(state, poly, names)
        sizes = [1 + max(exponents[k] for exponents in terms) for k in range(len(names))]
        if prod(sizes) > MOST_COEFFICIENTS:
            continue
        box = [(bounds[name][0].at, bounds[name][1].at) for name in names]
        middle = value_at(terms, [(low + high) / 2 for low, high in box])
        constant = (0,) * len(names)
        for margin in (Fraction(0),) if relation == ">" else MARGINS:
            letters = min(most, budget.left // prod(sizes))
            budget.spend(10 + prod(sizes))
            if middle < 0 or letters < 1:
                break
            above = terms.get(constant, Fraction(0)) - margin * middle
            tree = search_tree({**terms, constant: above}, box, letters)
            if tree is not None:
                budget.spend(len(tree) * prod(sizes) // 10)
                facts = [(bounds[name][0].fact, bounds[name][1].fact) for name in names]
                return "boxes", index, facts, tree
            budget.spend(letters * prod(sizes) // 50)
    return None


def _opposite(state: State, poly: checker.Poly, names: list[str]) -> dict[Exponents, Fraction]:
    """The opposite of a polynomial, by the exponents of its variables."""
    shifts = [checker.BITS * state.context.index[name] for name in names]
    mask = (1 << checker.BITS) - 1
    return {
        tuple((packed >> shift) & mask for shift in shifts): Fraction(-c, poly.den)
        for packed, c in poly.terms.items()
    }
