"""A lower bound of a polynomial on a box with its proof, close to the value at a point that floats
propose.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from juggleproof.algebra.box_trees import rounded_down, value_at
from juggleproof.search import limits
from juggleproof.search.boxes.branching import BoxTree, Branching
from juggleproof.search.boxes.descent import Best, BoxProblem, Point, shorter
from juggleproof.search.boxes.squares import program_around
from juggleproof.search.psatz.sums_of_squares import search_squares
from juggleproof.statements.language import ClaimError
from juggleproof.statements.nodes import Node
from juggleproof.statements.work import Budget

# -------------------------------------------------------------------------------------------------
# A lower bound of a polynomial on a box, with its proof, within a width of the value at a rational
# point: the searches, in order.

BySquares = Callable[
    [Fraction], Node | None
]  # a node, by squares times facts, that the polynomial is at least so much
Prove = Callable[
    [Fraction, Node], bool
]  # whether the checker accepts that the polynomial is at least so much, by this node


@dataclass(frozen=True)
class Bounds:
    """min >= low by the node, and min <= high at the point; `reached` says whether high - low is
    within the width that was asked for.
    """

    low: Fraction
    high: Fraction
    point: Point
    node: Node
    boxes: int
    reached: bool


def search_enclosure(
    problem: BoxProblem, width: Fraction, budget: int, prove: Prove, by_squares: BySquares
) -> Bounds:
    """A bound from below within `width` of the value at a point where the budget of boxes allows,
    else the best that it came to, also when other widths are asked for.

    So no width fails where a wider one is reached with a quarter of the boxes, nor where a narrower
    one is with few: from wide to narrow as far as they are reached, then narrower ones.

    Raises ClaimError where the polynomial is too large for the checker.
    """
    found = _search_width(problem, width, budget, prove, by_squares)
    for other in () if found.reached else limits.WIDTHS:
        if found.high - found.low <= width or found.boxes > 2 * budget:
            break
        if width <= other < found.high - found.low:
            more = _search_width(problem, other, max(1, budget // 4), prove, by_squares)
            found = _both(found, more, width)
            if not more.reached:
                break
    for other in (*limits.WIDTHS, Fraction(0)):
        if found.high - found.low <= width or found.boxes > 2 * budget:
            break
        if other < width:
            more = _search_width(
                problem, other, min(budget, 4 * limits.BOXES_BEFORE_SQUARES), prove, by_squares
            )
            found = _both(found, more, width)
    return found


def _both(first: Bounds, second: Bounds, width: Fraction) -> Bounds:
    """The better bound of each side."""
    below = max(first, second, key=lambda one: one.low)
    above = min(first, second, key=lambda one: one.high)
    reached, boxes = above.high - below.low <= width, first.boxes + second.boxes
    return Bounds(below.low, above.high, above.point, below.node, boxes, reached)


def _search_width(
    problem: BoxProblem, width: Fraction, budget: int, prove: Prove, by_squares: BySquares
) -> Bounds:
    """The bounds that one search comes to.

    Trees first, in floating point unless the width is too small for it, then in integers; squares
    around the best point where boxes are slow.
    """
    best, done, squares_left = (
        Best(problem.terms, problem.box, width),
        0,
        budget >= limits.BOXES_BEFORE_SQUARES,
    )
    kept: Bounds | None = None
    floats = width >= 64 * limits.TREE_ROUNDING * max(map(abs, problem.terms.values()))
    while budget:
        for exact in (False, True) if floats else (True,):
            branching = Branching(
                problem.terms, problem.box, lambda: best.bounds[0], best.offer, exact
            )
            most = min(budget, branching.affordable())
            tree = branching.run(min(limits.BOXES_BEFORE_SQUARES, most))
            if not tree.reached and squares_left:
                squares_left = False
                kept = _squares(problem, best, done + tree.boxes, prove, by_squares)
                if kept and kept.reached:
                    return kept
            tree = branching.run(most)
            done += tree.boxes
            found = (_reached if tree.reached else _unfinished)(
                best, tree, done, ("boxes", problem.goal, problem.facts, tree.text), prove
            )
            if found:
                return _both(kept, found, width) if kept else found
        budget //= 4  # the checker's own count of work may have ended first
    raise ClaimError(
        "the polynomial is too large: the checker's counted work ends before its Bernstein"
        " coefficients are known"
    )


def _squares(
    problem: BoxProblem, best: Best, done: int, prove: Prove, by_squares: BySquares
) -> Bounds | None:
    """Squares that show that the value at the best point is the minimum, or a simple number just
    below it; or, for a positive width, that the minimum is within the width of it.
    """
    low, high = best.bounds
    simple = _simple_below(best)
    centres = [
        (best.exact, best.exact, best.point),
        *([(low, high, shorter(best, best.width / limits.WIDTH_SHARE))] if best.width else []),
    ]
    for bound, top, point in centres:
        program = program_around(
            problem.terms,
            problem.box,
            point,
            problem.names,
            problem.facts,
            problem.goal,
            value_at(problem.terms, point) - bound,
        )
        node = search_squares([program], Budget(limits.BOUND_SQUARES_WORK)) if program else None
        if node and prove(bound, node):
            return Bounds(bound, top, best.point, node, done, True)
        node = by_squares(simple) if bound == best.exact and simple is not None else None
        if node and simple is not None and prove(simple, node):
            reached = best.exact - simple <= best.width
            return Bounds(simple, best.exact, best.point, node, done, reached)
    return None


def _simple_below(best: Best) -> Fraction | None:
    """A number of small denominator at the value at the best point, or just below it."""
    near = (1 + abs(best.exact)) * min(max(limits.NEAR, best.width), limits.FAR)
    for most in limits.SIMPLEST:
        simple = best.exact.limit_denominator(most)
        if simple <= best.exact <= simple + near:
            return simple
    return None


def _reached(best: Best, tree: BoxTree, done: int, node: Node, prove: Prove) -> Bounds | None:
    """What a tree that reached its aim shows: the minimum itself where that is the simple value at
    the point, else a bound within the width.
    """
    low, high = best.bounds
    if low < high and best.exact.denominator <= limits.SIMPLE and prove(best.exact, node):
        return Bounds(best.exact, best.exact, best.point, node, done, True)
    return Bounds(low, high, best.point, node, done, True) if prove(low, node) else None


def _unfinished(best: Best, tree: BoxTree, done: int, node: Node, prove: Prove) -> Bounds | None:
    """What the leaves of a tree show that did not reach its aim, rounded down until the checker
    accepts it.
    """
    for digits in (40, 12, 6, 0):
        low = rounded_down(tree.bound, Fraction(1, 10**digits)) - Fraction(1, 10**digits)
        if prove(low, node):
            return Bounds(low, best.exact, best.point, node, done, best.exact - low <= best.width)
    return None
