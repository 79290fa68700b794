"""Squares around a point, where halving boxes leads nowhere: p - p(x*) + gap as squares plus
products of squares with the sides of a box; and facts over a box by large trees or such squares.

p is written in coordinates around the point x*, where every summand vanishes: so a square has no
constant, and where the Hessian is singular, no linear part along its kernel.  Without these two
steps no matrix is definite, and none could be rounded.  What is more degenerate is not found.
With a gap squares have constants, scaled by the root of the gap, and x* need only be near the
minimum.  Source: Putinar, Positive polynomials on compact semialgebraic sets (1993); Peyrl and
Parrilo, Theoretical Computer Science 409 (2008).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations_with_replacement
from math import lcm, prod

from flint import Ordering, fmpq, fmpq_mat, fmpq_mpoly, fmpq_mpoly_ctx, fmpz_mpoly

from juggleproof.algebra.box_trees import Box, Terms, value_at
from juggleproof.algebra.numbers import exact
from juggleproof.algebra.polynomials import Ring
from juggleproof.search import limits
from juggleproof.search.boxes.branching import Branching
from juggleproof.search.boxes.descent import Best, BoxProblem, shorter
from juggleproof.search.boxes.over_box import FactOverBox, facts_over_box
from juggleproof.search.psatz.facts import Factors
from juggleproof.search.psatz.sums_of_squares import (
    FactBlock,
    Square,
    SquaresProgram,
    search_squares,
)
from juggleproof.statements.nodes import Node, Product
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget


def program_around(
    terms: Terms,
    box: Box,
    point: Sequence[Fraction],
    names: Sequence[str],
    facts: Sequence[Sequence[int]],
    goal: int,
    gap: Fraction = Fraction(0),
) -> SquaresProgram | None:
    """The program that closes fact `goal`, p(x*) - gap - p > 0, on a box; None where it is too
    large, or where p falls from the point into the box by more than the gap makes up for.

    `facts` holds for each variable the numbers of low <= x and x <= high.
    """
    if len(box) > limits.SQUARES_VARIABLES:
        return None
    around = BlocksAroundPoint(terms, box, point, facts, goal, gap)
    if not around.is_stationary() or len(around.blocks[1].basis) > limits.SQUARES_BASIS:
        return None

    def lifted(squares: list[Square], _: object, roots: list[fmpz_mpoly]) -> Node:
        coordinates, products = around.coordinates(names), list[Product]()
        for (factors, root), weight in squares:
            content = 1 if root < 0 else int(roots[root].content())
            text = "1" if root < 0 else _text(roots[root] / content, coordinates)
            products.append((str(weight * content**2), factors, text))
        return "psatz", products, []

    return SquaresProgram(
        around.ring,
        around.blocks,
        [],
        lifted,
        around.total(),
        limits.SQUARES_GOALS[-1:],
        limits.AROUND_DENOMINATORS,
        kernels=(),
    )


class BlocksAroundPoint:
    """A polynomial around a point of a box: the goal and what may cancel it, block by block."""

    def __init__(
        self,
        terms: Terms,
        box: Box,
        point: Sequence[Fraction],
        facts: Sequence[Sequence[int]],
        goal: int,
        gap: Fraction,
    ) -> None:
        self.gap, self.box, self.point, self.facts = gap, box, point, facts
        self.size, self.half = len(box), (max(map(sum, terms)) + 1) // 2
        self.ring = Ring(tuple(f"u{i}" for i in range(self.size)))
        self.rational = fmpq_mpoly_ctx.get(self.ring.names, Ordering.degrevlex)
        u = self.rational.gens()
        p = self.rational.from_dict({e: exact(c) for e, c in terms.items()})
        p = p.compose(*(x + exact(at) for x, at in zip(u, point)))
        p = p - p[(0,) * self.size] + exact(gap)
        self.slopes = [p[self._exponents(i)] for i in range(self.size)]
        free = [i for i, slope in enumerate(self.slopes) if not slope and not gap]
        self.forms, kernel = self._adapted(p, free)
        self.steps = fmpq_mat(self.forms).inv().tolist()  # x - x* in the coordinates
        p = p.compose(*(self._linear(step) for step in self.steps))
        lines = [k for k in range(self.size) if k not in kernel]
        # the constant times the root of the gap, to a power of 2: so its entries are as the others
        root = _dyadic_root(gap) if gap else Fraction(1)
        self.one = [self.ring.one * root.numerator]
        self.lines = [self.ring.gens[k] * root.denominator for k in lines]
        self.monomials = [
            [prod(chosen, start=self.ring.one) * root.denominator for chosen in products]
            for products in (
                list(combinations_with_replacement(self.ring.gens, degree))
                for degree in range(2, self.half + 1)
            )
        ]
        self.blocks: list[FactBlock] = []
        self._add(-p, ((goal, 1),), [self.ring.one], strict=True)
        constant = self.one if gap else []
        self._add(self.rational.constant(1), (), [*constant, *self.lines, *self._above(self.half)])
        for i, (low, high) in enumerate(box):
            if low < high:
                self._add_sides(i, low, high)

    def is_stationary(self) -> bool:
        """Whether p rises, to first order, from the point into the box, or stays level; a gap makes
        up for what falls.
        """
        return self.gap > 0 or all(
            slope == 0 or at == ends[0 if slope > 0 else 1]
            for slope, at, ends in zip(self.slopes, self.point, self.box)
        )

    def total(self) -> Fraction:
        """The goal's coefficient: one with which its constant, or without one its largest
        coefficient, is 1.
        """
        poly = self.blocks[0].poly
        constant = abs(int(poly[(0,) * self.size]))
        return Fraction(1, constant or max(abs(int(c)) for c in poly.coeffs()))

    def _exponents(self, *variables: int) -> tuple[int, ...]:
        return tuple(variables.count(k) for k in range(self.size))

    def _adapted(self, p: fmpq_mpoly, free: Sequence[int]) -> tuple[list[list[fmpq]], list[int]]:
        """Linear forms that serve as coordinates, and the numbers of those that only complete the
        range of the Hessian of the free variables.
        """
        units = [[fmpq(int(i == k)) for k in range(self.size)] for i in range(self.size)]
        rows = [
            [p[self._exponents(i, j)] * (1 + (i == j)) * (j in free) for j in range(self.size)]
            for i in free
        ]
        forms, kernel = list[list[fmpq]](), list[int]()
        if not free or fmpq_mat(rows).rank() == len(free):
            return units, []
        for k, row in enumerate([*rows, *units]):
            if fmpq_mat([*forms, row]).rank() > len(forms):
                if k >= len(rows) and k - len(rows) in free:
                    kernel.append(len(forms))
                first = next(c for c in row if c)
                forms.append([c / first for c in row])
        return forms, kernel

    def _linear(self, coefficients: Sequence[fmpq], constant: Fraction | int = 0) -> fmpq_mpoly:
        u = self.rational.gens()
        start = self.rational.constant(exact(constant))
        return sum((c * x for c, x in zip(coefficients, u) if c), start)

    def _above(self, last: int) -> list[fmpz_mpoly]:
        """The monomials of degree 2 up to the last."""
        return [m for degree in self.monomials[: max(0, last - 1)] for m in degree]

    def _add(
        self, product: fmpq_mpoly, factors: Factors, basis: list[fmpz_mpoly], strict: bool = False
    ) -> None:
        scale = lcm(*(int(c.q) for c in product.coeffs()))
        whole = {m: int((c * scale).p) for m, c in zip(product.monoms(), product.coeffs())}
        poly = self.ring.ctx.from_dict(whole)
        self.blocks.append(FactBlock(poly, strict, basis, factors, Fraction(scale)))

    def _add_sides(self, i: int, low: Fraction, high: Fraction) -> None:
        """Squares times (x - low)(high - x), and times the one side where the point is held."""
        above = self._linear(self.steps[i], self.point[i] - low)
        below = self._linear([-c for c in self.steps[i]], high - self.point[i])
        first, last = self.facts[i]
        rest = [*self.lines, *self._above(self.half - 1)] if self.half > 1 else []
        held = bool(self.slopes[i]) and self.point[i] == (low if self.slopes[i] > 0 else high)
        constant = self.one if held or self.gap else []
        if constant or rest:
            self._add(above * below, ((first, 1), (last, 1)), [*constant, *rest])
        if held:
            side, fact = (above, first) if self.slopes[i] > 0 else (below, last)
            self._add(side, ((fact, 1),), [*self.one, *rest])

    def coordinates(self, names: Sequence[str]) -> list[str]:
        """The coordinates as text in the variables."""
        moved = [
            f"({name} {'-' if at > 0 else '+'} {abs(at)})" if at else name
            for name, at in zip(names, self.point)
        ]
        texts = [_text(self._linear(form), moved) for form in self.forms]
        return [text if text in moved else f"({text})" for text in texts]


def _dyadic_root(value: Fraction) -> Fraction:
    """A power of 2 near the square root."""
    return Fraction(2) ** ((value.numerator.bit_length() - value.denominator.bit_length()) // 2)


def _text(p: fmpq_mpoly | fmpz_mpoly, coordinates: Sequence[str]) -> str:
    parts = []
    for exponents, c in zip(p.monoms(), p.coeffs()):
        factors = [
            text if e == 1 else f"{text}^{e}" for text, e in zip(coordinates, exponents) if e
        ]
        parts.append("*".join([*([str(c)] if c != 1 or not factors else []), *factors]))
    return " + ".join(parts).replace("+ -", "- ")


# -------------------------------------------------------------------------------------------------
# Facts over a box, where small trees end.


def close_by_bounds(state: SearchState, most: int, budget: Budget) -> Node | None:
    """A node by a fact that fails in all of the box of the others, with a tree of at most `most`
    boxes, or with squares; None where none was found.

    Raises Exhausted where the budget ends.
    """
    for fact in facts_over_box(state):
        problem = BoxProblem(fact.opposite, fact.box, fact.names, fact.facts, fact.index)
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


def search_positive(problem: BoxProblem, weakly: bool, most: int, budget: Budget) -> Node | None:
    """A node of a tree of at most `most` boxes, or of squares, that closes p < 0, or p <= 0 where
    not `weakly`; None where p has such a value at a point, or none was found.

    Squares close p < 0 also where p <= 0 is asked: then a number is added to them.

    Raises Exhausted where the budget ends.
    """
    budget.spend(len(problem.terms) * len(problem.box))
    best = Best(problem.terms, problem.box, Fraction(0))

    def target() -> Fraction:
        """A number that all coefficients are to reach; any, where there is no such number."""
        return best.exact / 16 if best.exact > 0 and not weakly else min(best.exact, Fraction(0))

    def is_open() -> bool:
        return best.exact > 0 or weakly and not best.exact

    tried = False
    for exactly in (False, True):
        branching = Branching(problem.terms, problem.box, target, best.offer, exactly)
        boxes, size = 1, branching.numbers.root.size
        cost = 40 + size // 2 if exactly else 10 + size // 50
        for most_here in (
            min(limits.BOXES_BEFORE_SQUARES, most),
            min(most, branching.affordable()),
        ):
            tree = branching.run(most_here) if is_open() else None
            if tree is None or not is_open():
                return None
            budget.charge((tree.boxes - boxes) * cost)
            boxes = tree.boxes
            if tree.reached:
                return "boxes", problem.goal, problem.facts, tree.text
            node = None if tried else _squares_above(problem, best, target(), budget)
            tried = True
            if node is not None:
                return node
    return None


def _squares_above(problem: BoxProblem, best: Best, bound: Fraction, budget: Budget) -> Node | None:
    """Squares that show that p is at least the bound, by the fact -p > 0, or -p >= 0 where the
    bound is positive.
    """
    point = (
        best.point
        if best.exact == bound
        else shorter(best, (best.exact - bound) / limits.WIDTH_SHARE)
    )
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
