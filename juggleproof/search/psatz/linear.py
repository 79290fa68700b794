"""One leaf: a linear program over products of facts, with Bernstein polynomials and squares.

Source, for products of linear facts: Handelman, Representing polynomials by positive linear
functions on compact convex polyhedra, Pacific Journal of Mathematics 132 (1988).
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from math import prod

import numpy as np
from flint import fmpz_mpoly

from juggleproof.algebra.polynomials import (
    Keys,
    Monomial,
    Packing,
    Row,
    collect,
    constant_of,
    multiply,
    total_degree,
)
from juggleproof.search import limits
from juggleproof.search.psatz.facts import Factors, merge, power
from juggleproof.search.psatz.lifting import (
    LiftedTerm,
    MonomialCofactor,
    finish,
    lift,
    powers_of,
)
from juggleproof.search.psatz.linear_program import Floats, Mask, Program, counted, solve
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.statements.nodes import Node
from juggleproof.statements.work import Budget

# -------------------------------------------------------------------------------------------------
# The columns of a linear program made from a problem's facts, and the certificate read off its
# solution.


# the products of facts used, each with the number of the root that it is times the square of (-1:
# none), and the monomials times equations, with their coefficients
Solution = tuple[
    list[tuple[tuple[Factors, int], Fraction]], list[tuple[MonomialCofactor, Fraction]]
]


class ProgramTooLarge(Exception):
    """A program would have more columns, or terms in them, than can be solved."""


class ProductCombination:
    """Products of at most `degree` facts, times Bernstein polynomials of the bounded variable,
    times squares of the roots.

    Columns are counted before they are made: raises TooLarge where there are too many.
    """

    def __init__(
        self,
        problem: LeafProblem,
        degree: int,
        bernstein: int,
        roots: list[fmpz_mpoly],
        only: list[int] | None = None,
    ) -> None:
        self.problem, self.roots, self.program = problem, roots, Program()
        self.blocks: list[Block] = []
        self.cofactors: list[MonomialCofactor] = []
        self.columns = self.terms = 0
        facts, bounded = problem.facts, problem.bounded if bernstein else None
        others, degrees = only if only is not None else list(range(len(facts))), [0] * len(facts)
        if bounded is not None:
            others = [k for k in others if not problem.implied_by_bounds(k, bounded)]
            degrees = [fact.degrees[bounded.variable] for fact in facts]
        most = (
            bernstein + max((degrees[k] for k in others), default=0) if bounded is not None else 0
        )
        self.packing = Packing(problem.ring, [*problem.polys(), *roots])
        squares = [collect(multiply(row, row)) for row in map(self.packing.row, roots)]
        heights = [2 * self._height(root) for root in roots]
        own_heights = [self._height(fact.poly) for fact in facts] if roots else []
        highest = max([2, *own_heights])
        products = Products(problem, others, self.packing)
        in_bounded, in_others = (
            np.array(degrees, dtype=np.int64),
            np.array(own_heights, dtype=np.int64),
        )
        levels: dict[int, BernsteinLevel] = {}
        for count in range(degree + 1):
            if count:
                self._count(*products.sizes_with_facts())
                products = products.times_facts()
            rooms = most - in_bounded[products.chosen].sum(axis=1)
            for room in np.unique(rooms).tolist():
                part = products.only(rooms == room)
                for level in {0, room} if room >= 0 else ():
                    if level not in levels:
                        levels[level] = BernsteinLevel(problem, level, self.packing)
                    self._add(levels[level], part, -1)
                    for which, square in enumerate(squares if count < 2 else ()):
                        low = heights[which] + in_others[part.chosen].sum(axis=1) <= highest
                        if low.any():
                            self._add(levels[level], part.only(low).times_row(square), which)
        basis = problem.reduction.basis() if self.packing.exact else []
        for equation in basis:
            poly = equation.poly / int(equation.poly.content())
            keys, values = self.packing.row(poly)
            self.program.add_rewriting(self.packing.exponents(keys[:1])[0], keys, values)
        self.program.exponents = self.packing.exponents
        self._add_equations(
            [k for k, equation in enumerate(problem.reduction.left) if equation not in basis],
            degree,
            bernstein,
        )

    def _count(self, columns: int, terms: int) -> None:
        if columns > limits.MOST_COLUMNS or terms > limits.MOST_PRODUCT_TERMS:
            raise ProgramTooLarge

    def _height(self, poly: fmpz_mpoly) -> int:
        """The total degree in all but the bounded variable."""
        bounded = self.problem.bounded
        if bounded is None:
            return total_degree(poly)
        return max(
            sum(int(e) for v, e in enumerate(monomial) if v != bounded.variable)
            for monomial in poly.monoms()
        )

    def _add(self, level: BernsteinLevel, products: Products, root: int) -> None:
        """A block of columns: every product times every Bernstein polynomial of one degree."""
        count, size = len(products.places), len(level.strict)
        self.columns += count * size
        self.terms += len(products.at) * len(level.at)
        self._count(self.columns, self.terms)
        columns = (products.at[:, None] * size + level.at).ravel()
        keys = (products.keys[:, None] + level.keys).ravel()
        values = (products.values[:, None] * level.values).ravel()
        strict = (
            np.outer(products.strict, level.strict).ravel()
            if root < 0
            else np.zeros(count * size, dtype=bool)
        )
        costs = 1.0 + products.widths / 4 + products.places.shape[1] + level.degree / 8
        self.blocks.append(Block(self.program.count, level, products.chosen, root))
        self.program.add(columns, keys, values, strict, np.repeat(costs, size))

    def _column(self, place: int) -> tuple[Factors, int]:
        """The facts and the root (-1 for 1) of a column."""
        block = self.blocks[bisect_right(self.blocks, place, key=lambda one: one.start) - 1]
        product, power_of_bounds = divmod(place - block.start, len(block.level.strict))
        return (
            merge(
                powers_of(tuple(block.chosen[product].tolist())),
                block.level.factors[power_of_bounds],
            ),
            block.root,
        )

    def _add_equations(self, places: list[int], degree: int, bernstein: int) -> None:
        """Adds equations that are left, times monomials, as free columns."""
        problem = self.problem
        degree = max(1, degree)
        polys = problem.polys() if places else []
        bounds = (
            [max(int(p.degrees()[v]) for p in polys) for v in range(problem.ring.size)]
            if places
            else []
        )
        top = max((total_degree(p) for p in polys), default=0) * degree + bernstein
        for place in places:
            equation = problem.reduction.left[place]
            room, own = top - total_degree(equation.poly), [int(d) for d in equation.poly.degrees()]
            tops = [
                max(0, min(room, b * degree + bernstein - o)) if b else 0
                for b, o in zip(bounds, own)
            ]
            most = limits.MOST_COLUMNS - self.columns
            monomials = list(islice(exponents_up_to(tops, room), most + 1))
            keys, values = self.packing.row(equation.poly)
            self.columns += len(monomials)
            self._count(self.columns, self.terms + len(monomials) * len(keys))
            self.cofactors += [(place, exponents) for exponents in monomials]
            self.program.add_free(
                len(monomials),
                (self.packing.keys(monomials)[:, None] + keys).ravel(),
                np.tile(values, len(monomials)),
            )

    def solution(self, budget: Budget) -> Solution | None:
        """Solves the program."""
        budget.spend(3 * self.program.count + 3 * len(self.cofactors))
        found = solve(self.program, budget)
        if found is None:
            return None
        used = [(self._column(k), c) for k, c in found[0].items()]
        cofactors = [(self.cofactors[k], c) for k, c in found[1].items()]
        return used, cofactors


def exponents_up_to(tops: Sequence[int], room: int) -> Iterator[Monomial]:
    """The exponents, each at most its top, whose sum is at most `room`, in order.

    >>> list(exponents_up_to((1, 0, 2), 2))
    [(0, 0, 0), (0, 0, 1), (0, 0, 2), (1, 0, 0), (1, 0, 1)]
    """
    if not tops:
        yield ()
        return
    for first in range(min(tops[0], room) + 1):
        for rest in exponents_up_to(tops[1:], room - first):
            yield (first, *rest)


@dataclass
class Block:
    """Columns that were added together: the number of the first, the facts of every product, and
    what each was multiplied by.
    """

    start: int
    level: BernsteinLevel
    chosen: Keys
    root: int


class Products:
    """All products of n of the given facts, repetitions allowed, their terms one after another.

    Shapes, for P products with T terms in all and F facts with S terms in all:

    - `places` (P, n): the facts of every product, by their numbers among the given ones, ascending;
    - `strict` (P,): whether a product is positive, not only not negative;
    - `widths` (P,): how many terms each has; their sum is T;
    - `at`, `keys`, `values` (T,): of every term its product, its monomial's key, its coefficient;
    - `lengths`, `others`, `own_strict` (F,), `own_keys`, `own_values` (S,): the same of the facts.

    Equal monomials of one product are left apart.
    """

    def __init__(self, problem: LeafProblem, others: list[int], packing: Packing) -> None:
        rows = [problem.row(problem.facts[k].poly, packing) for k in others]
        self.lengths = np.array([len(keys) for keys, _ in rows], dtype=np.int64)
        self.own_keys = np.concatenate([np.zeros(0, np.int64), *(keys for keys, _ in rows)])
        self.own_values = np.concatenate([np.zeros(0), *(values for _, values in rows)])
        self.own_strict = np.array([problem.facts[k].strict for k in others], dtype=bool)
        self.others = np.array(others, dtype=np.int64)
        self.places = np.zeros((1, 0), np.int64)  # one product, of no facts: it is 1
        self.strict: Mask = np.ones(1, dtype=bool)
        self.at, self.keys, self.values = np.zeros(1, np.int64), np.zeros(1, np.int64), np.ones(1)
        self.widths = np.ones(1, np.int64)

    @property
    def chosen(self) -> Keys:
        """The facts of every product by their numbers in the problem, of the shape (P, n)."""
        return self.others[self.places]

    def _changed(
        self, places: Keys, strict: Mask, at: Keys, keys: Keys, values: Floats
    ) -> Products:
        """Other products of the same facts."""
        new = object.__new__(Products)
        new.__dict__.update(self.__dict__)
        new.places, new.strict, new.at, new.keys, new.values = places, strict, at, keys, values
        new.widths = np.bincount(at, minlength=len(places))
        return new

    def sizes_with_facts(self) -> tuple[int, int]:
        """How many products, and terms in them, there would be with one fact more."""
        last = self.places[:, -1] if self.places.shape[1] else np.zeros(len(self.places), np.int64)
        after = np.cumsum(self.lengths[::-1])[::-1]  # the terms of a fact and of those after it
        terms = int(self.widths @ after[last]) if len(after) else 0
        return int((len(self.others) - last).sum()), terms

    def times_facts(self) -> Products:
        """The products with one fact more, each once: the new fact is none before the last one.

        For every new product `old` and `fact` name its two parts; for every new term `at` names its
        product, `here` the term of the old product and `there` that of the fact.
        """
        last = self.places[:, -1] if self.places.shape[1] else np.zeros(len(self.places), np.int64)
        counts = len(self.others) - last
        old = np.repeat(np.arange(len(last)), counts)
        fact = counted(counts) + last[old]
        lengths = self.lengths[fact]
        whole = self.widths[old] * lengths
        at, inner = np.repeat(np.arange(len(old)), whole), counted(whole)
        here, there = np.divmod(inner, lengths[at])  # within the old product, and the fact
        here += (np.cumsum(self.widths) - self.widths)[old[at]]
        there += (np.cumsum(self.lengths) - self.lengths)[fact[at]]
        return self._changed(
            np.hstack([self.places[old], fact[:, None]]),
            self.strict[old] & self.own_strict[fact],
            at,
            self.keys[here] + self.own_keys[there],
            self.values[here] * self.own_values[there],
        )

    def only(self, kept: Mask) -> Products:
        """The products where `kept`, of the shape (P,), is true."""
        if kept.all():
            return self
        inside = kept[self.at]
        new_place = np.cumsum(kept) - 1
        return self._changed(
            self.places[kept],
            self.strict[kept],
            new_place[self.at[inside]],
            self.keys[inside],
            self.values[inside],
        )

    def times_row(self, row: Row) -> Products:
        """All of the products times one polynomial, given as keys and coefficients."""
        at = np.repeat(self.at, len(row[0]))
        return self._changed(
            self.places,
            self.strict,
            at,
            (self.keys[:, None] + row[0]).ravel(),
            (self.values[:, None] * row[1]).ravel(),
        )


class BernsteinLevel:
    """The Bernstein polynomials low^i * high^(degree - i): which has which power of the bounded
    variable, and how often.
    """

    def __init__(self, problem: LeafProblem, degree: int, packing: Packing) -> None:
        self.degree = degree
        bounded, facts = problem.bounded, problem.facts
        if bounded is None or degree == 0:
            self.factors: list[Factors] = [()]
            self.strict, self.at, self.keys, self.values = (
                np.ones(1, dtype=bool),
                np.zeros(1, np.int64),
                np.zeros(1, np.int64),
                np.ones(1),
            )
            return
        lines = []
        for k in (bounded.low, bounded.high):
            slope = float(int(facts[k].poly.derivative(bounded.variable).leading_coefficient()))
            line, base = (
                [np.ones(1)],
                np.array([float(-facts[k].end(bounded.variable) * int(slope)), slope]),
            )
            for _ in range(degree):
                line.append(np.convolve(line[-1], base))
            lines.append(line)
        table = np.array(
            [np.convolve(lines[0][i], lines[1][degree - i]) for i in range(degree + 1)]
        )
        self.at, powers = np.nonzero(table)
        self.keys, self.values = powers * packing.weights[bounded.variable], table[self.at, powers]
        pairs = [((bounded.low, i), (bounded.high, degree - i)) for i in range(degree + 1)]
        self.factors = [tuple(sorted((k, e) for k, e in pair if e)) for pair in pairs]
        self.strict = np.array(
            [all(facts[k].strict for k, _ in own) for own in self.factors], dtype=bool
        )


# -------------------------------------------------------------------------------------------------
# One leaf of a proof: facts that contradict one another, shown by a positive combination that
# vanishes identically.

# (facts, stage) -> the solution, and the work that it takes: the same facts come back, in other
# cases and at greater effort
_solved: dict[tuple[Hashable, int, int, str], tuple[Solution | None, int]] = {}
# (products of facts, extra Bernstein degree, kind of squares; or "goal": no squares, and only facts
# in the goal's variables)
Stage = tuple[int, int, str]
QUICK: tuple[Stage, ...] = ((1, 0, ""),)
FIRST: tuple[Stage, ...] = ((2, 0, ""),)
USUAL: tuple[Stage, ...] = ((2, 2, "goal"), (2, 2, ""), (1, 0, "squares"))
SQUARES: tuple[Stage, ...] = ((1, 2, "squares"), (1, 2, "resultants"))
TRIPLES: tuple[Stage, ...] = ((3, 2, ""),)


def close_by_equations(problem: LeafProblem) -> Node | None:
    """Closes a state whose equations are contradictory, or make a fact false or a nonzero
    polynomial zero.
    """
    ring, reduction = problem.ring, problem.reduction
    fact, equation = problem.contradiction, reduction.contradiction
    if fact is not None:
        value = constant_of(fact.poly) or 0
        pairs = list(zip(reduction.steps, fact.counts))
        factors = merge(fact.factors, *(power(step.lead_factors, n) for step, n in pairs))
        scale = prod((step.lead_scale**n for step, n in pairs), start=Fraction(1))
        terms = [LiftedTerm(scale, factors, ring.one)] + (
            [LiftedTerm(Fraction(-value), (), ring.one)] if value else []
        )
        return finish(problem.source, reduction, terms, {})
    if equation is not None:
        value = constant_of(equation.poly) or 0
        # multiple * value = sum of combination, so multiple^2 * value^2 is a sum of equations, and
        # positive
        owed = {k: -c * equation.multiple * value for k, c in equation.combination.items()}
        return finish(
            problem.source,
            reduction,
            [LiftedTerm(Fraction(value * value), power(equation.factors, 2), ring.one)],
            owed,
        )
    return None


def contrary_bounds(problem: LeafProblem) -> Solution | None:
    """Two facts with a positive combination that is a number less than it has to be."""
    before: dict[tuple[Monomial, bool], list[int]] = {}  # by the leading monomial and its sign
    for k, fact in enumerate(problem.facts):
        leading, lead = fact.poly.monomial(0), int(fact.poly.leading_coefficient())
        for other in before.get((leading, lead < 0), ()):
            first = problem.facts[other]
            a, b = abs(lead), abs(int(first.poly.leading_coefficient()))
            value = constant_of(first.poly * a + fact.poly * b)
            if value is not None and (value < 0 or value == 0 and (first.strict or fact.strict)):
                terms: list[tuple[Factors, int]] = [
                    ((), -value),
                    (((other, 1),), a),
                    (((k, 1),), b),
                ]
                return [((factors, -1), Fraction(c)) for factors, c in terms if c], []
        before.setdefault((leading, lead > 0), []).append(k)
    return None


def search(problem: LeafProblem, stages: Sequence[Stage], budget: Budget) -> Node | None:
    """The first node that one of the stages finds; None where none does.

    Raises Exhausted where the budget ends.
    """
    if not problem.facts and not problem.reduction.left:
        return None
    solution = contrary_bounds(problem)
    if solution is not None:
        return lift(problem, *solution, [])
    key = problem.content()
    roots: dict[str, list[fmpz_mpoly]] = {"": [], "goal": []}
    for degree, bernstein, kind in stages:
        stage = (key, degree, bernstein, kind)
        solution, work = _solved.get(stage, (None, 0))
        budget.spend(work)
        if solution is None and work:
            continue
        if kind not in roots:
            roots[kind] = problem.candidates(kind)
        if solution is None:
            goal_facts = problem.goal_facts() if kind == "goal" else None
            same = (
                bernstein == 2
                and degree == 2
                and problem.bounded is None
                and not problem.reduction.left
            )
            if goal_facts is None if kind == "goal" else not roots[kind] if kind else same:
                continue  # nothing that a smaller stage did not have
            if degree > 2 and len(problem.facts) > limits.MOST_FACTS_FOR_TRIPLES:
                continue
            left = budget.left
            try:
                with np.errstate(over="raise"):
                    program = ProductCombination(
                        problem, degree, bernstein, roots[kind], goal_facts
                    )
                    solution = program.solution(budget)
            except (
                ProgramTooLarge,
                OverflowError,
                FloatingPointError,
            ):  # of terms, or of coefficients
                budget.spend(limits.GIVEN_UP_WORK)
            if len(_solved) >= limits.MOST_PROGRAMS:
                _solved.clear()
            _solved[stage] = solution, left - budget.left
        node = None if solution is None else lift(problem, *solution, roots[kind])
        if node is not None:
            return node
    return None
