"""One fact over the box of the others, where small trees end: larger ones, and squares around the
point where the fact is closest to hold.
"""

from __future__ import annotations

from fractions import Fraction
from math import prod

from juggleproof.certificates.nodes import Node, Product
from juggleproof.certificates.search.boxes.enclosures import Problem, search_positive
from juggleproof.certificates.search.over_box import FactOverBox, facts_over_box
from juggleproof.certificates.states import State
from juggleproof.certificates.work import Budget


def close_by_bounds(state: State, most: int, budget: Budget) -> Node | None:
    """A node by a fact that fails in all of the box of the others, with a tree of at most `most`
    boxes, or with squares; None where none was found.

    Raises Exhausted where the budget ends.
    """
    for fact in facts_over_box(state):
        problem = Problem(fact.opposite, fact.box, fact.names, fact.facts, fact.index)
        found = search_positive(problem, fact.strict, most, budget)
        if found is not None and found[0] == "psatz":
            found = _of_the_state(fact, found[1])
        if found is not None and state.is_closed_by(found, {}):
            return found
    return None


def _of_the_state(fact: FactOverBox, products: list[Product]) -> Node:
    """The same squares for the facts as the state has them: bounds with their slopes, and -p, which
    is a number less than what the squares close where p >= 0 is the fact.
    """
    slopes = {end.fact: end.slope for pair in fact.bounds for end in pair}
    scaled: list[Product] = []
    for coefficient, factors, root in products:
        size = prod((slopes.get(k, Fraction(1)) ** e for k, e in factors), start=Fraction(1))
        scaled.append((str(Fraction(coefficient) / size), factors, root))
    return "psatz", scaled, []
