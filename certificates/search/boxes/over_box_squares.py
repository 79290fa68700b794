"""One fact over the box of the others, where small trees end: larger ones, and squares around the
point where the fact is closest to hold.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import prod

from juggleproof.certificates.nodes import Node, Product
from juggleproof.certificates.search.boxes.branching import Branching
from juggleproof.certificates.search.boxes.descent import SHARE, Best, Problem, shorter
from juggleproof.certificates.search.boxes.over_box import FactOverBox, facts_over_box
from juggleproof.certificates.search.boxes.small import value_at
from juggleproof.certificates.search.boxes.squares import program_around
from juggleproof.certificates.search.psatz.sums_of_squares import search_squares
from juggleproof.certificates.states import State
from juggleproof.certificates.work import Budget

QUICK = 300  # boxes before squares are tried


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


def _of_the_state(fact: FactOverBox, products: Sequence[Product]) -> Node:
    """The same squares for the facts as the state has them: bounds with their slopes, and -p, which
    is a number less than what the squares close where p >= 0 is the fact.
    """
    slopes = {end.fact: end.slope for pair in fact.bounds for end in pair}
    scaled: list[Product] = []
    for coefficient, factors, root in products:
        size = prod((slopes.get(k, Fraction(1)) ** e for k, e in factors), start=Fraction(1))
        scaled.append((str(Fraction(coefficient) / size), factors, root))
    return "psatz", scaled, []


def search_positive(problem: Problem, weakly: bool, most: int, budget: Budget) -> Node | None:
    """A node of a tree of at most `most` boxes, or of squares, that closes p < 0, or p <= 0 where
    not `weakly`; None where p has such a value at a point, or none was found.

    Squares close p < 0 also where p <= 0 is asked: then a number is added to them.

    Raises Exhausted where the budget ends.
    """
    best = Best(problem.terms, problem.box, Fraction(0))

    def target() -> Fraction:
        """A number that all coefficients are to reach; any, where there is no such number."""
        return best.exact / 16 if best.exact > 0 and not weakly else min(best.exact, Fraction(0))

    def is_open() -> bool:
        return best.exact > 0 or weakly and not best.exact

    tried = False
    for exact in (False, True):
        branching = Branching(problem.terms, problem.box, target, best.offer, exact)
        boxes, size = 1, branching.numbers.root.size
        cost = 40 + size // 2 if exact else 10 + size // 50
        for most_here in (min(QUICK, most), min(most, branching.affordable())):
            tree = branching.run(most_here) if is_open() else None
            if tree is None or not is_open():
                return None
            budget.spend((tree.boxes - boxes) * cost)
            boxes = tree.boxes
            if tree.reached:
                return "boxes", problem.goal, problem.facts, tree.text
            node = None if tried else _squares_above(problem, best, target(), budget)
            tried = True
            if node is not None:
                return node
    return None


def _squares_above(problem: Problem, best: Best, bound: Fraction, budget: Budget) -> Node | None:
    """Squares that show that p is at least the bound, by the fact -p > 0, or -p >= 0 where the
    bound is positive.
    """
    point = best.point if best.exact == bound else shorter(best, (best.exact - bound) / SHARE)
    gap = value_at(problem.terms, point) - bound
    program = program_around(
        problem.terms, problem.box, point, problem.names, problem.facts, problem.goal, gap
    )
    node = search_squares([program], budget) if program else None
    if node is None or node[0] != "psatz":
        return None
    own = ((problem.goal, 1),)
    more = [
        (str(Fraction(c) * bound), (), "1") for c, factors, _ in node[1] if factors == own and bound
    ]
    return "psatz", [*node[1], *more], []
