"""The columns of a linear program made from a problem's facts, and the certificate read off its solution."""

from __future__ import annotations

from fractions import Fraction
from itertools import product as choices
from math import lcm, prod
from typing import Any

import numpy as np
from flint import fmpz_mpoly

from .budget import Budget
from .lifting import Term, finish
from .linear_program import Program, solve
from .polynomials import Packing, Row, collect, multiply, total_degree
from .problem import Problem
from .reduction import Factors, merge, power
from .signs import Fact, Sum, times

Node = list[Any]
Cofactor = tuple[int, tuple[int, ...]]  # an equation left, and the exponents of a monomial


class Combination:
    """Products of at most `degree` facts, times Bernstein polynomials of the bounded variable, times squares of the roots."""

    def __init__(self, problem: Problem, degree: int, bernstein: int, roots: list[fmpz_mpoly],
                 only: list[int] | None = None) -> None:
        self.problem, self.roots, self.program = problem, roots, Program()
        self.columns: list[tuple[Factors, int]] = []  # facts and root (-1 for 1) of every column
        self.cofactors: list[Cofactor] = []
        facts, bounded = problem.facts, problem.bounded if bernstein else None
        others, degrees = only if only is not None else list(range(len(facts))), [0] * len(facts)
        if bounded is not None:
            others = [k for k in others if not problem.said_by_bounds(k, bounded)]
            degrees = [fact.degree(bounded.variable) for fact in facts]
        most = bernstein + max((degrees[k] for k in others), default=0) if bounded is not None else 0
        self.packing = Packing(problem.ring, [*problem.polys(), *roots])
        squares = [collect(multiply(row, row)) for row in map(self.packing.row, roots)]
        heights = [2 * self._height(root) for root in roots]
        own_heights = [self._height(fact.poly) for fact in facts]
        highest = max([2, *own_heights])
        products = Products([facts[k] for k in others], others, self.packing)
        levels: dict[int, Level] = {}
        for count in range(degree + 1):
            if count:
                products = products.times_facts()
            rooms = [most - sum(degrees[k] for k in chosen) for chosen in products.chosen]
            for room in sorted(set(rooms)):
                part = products.only([k for k, other in enumerate(rooms) if other == room])
                for level in {0, room} if room >= 0 else ():
                    if level not in levels:
                        levels[level] = Level(problem, level, self.packing)
                    self._add(levels[level], part, -1)
                    for which, square in enumerate(squares if count < 2 else ()):
                        low = [k for k, chosen in enumerate(part.chosen) if heights[which] + sum(own_heights[i] for i in chosen) <= highest]
                        if low:
                            self._add(levels[level], part.only(low).times_row(square), which)
        basis = problem.reduction.basis() if self.packing.exact else []
        for equation in basis:
            poly = equation.poly / int(equation.poly.content())
            keys, values = self.packing.row(poly)
            self.program.add_rewriting(self.packing.exponents(keys[:1])[0], keys, values)
        self.program.exponents = self.packing.exponents
        self._add_equations([k for k, equation in enumerate(problem.reduction.left) if equation not in basis], degree, bernstein)

    def _height(self, poly: fmpz_mpoly) -> int:
        """The total degree in all but the bounded variable."""
        bounded = self.problem.bounded
        if bounded is None:
            return total_degree(poly)
        return max(sum(int(e) for v, e in enumerate(monomial) if v != bounded.variable) for monomial in poly.monoms())

    def _add(self, level: Level, products: Products, root: int) -> None:
        """A block of columns: every product times every Bernstein polynomial of one degree."""
        count, size, length = len(products.chosen), len(level.strict), products.keys.shape[1]
        width = len(level.keys)
        keys = np.broadcast_to((products.keys[:, :, None] + level.keys)[:, None], (count, size, length, width))
        values = products.values[:, None, :, None] * level.table[None, :, None, :]
        strict = [root < 0 and s and t for s in products.strict for t in level.strict]
        costs = [1.0 + w / 4 + len(chosen) + level.degree / 8 for w, chosen in zip(products.widths, products.chosen) for _ in level.strict]
        self.program.add(keys.reshape(count * size, -1), values.reshape(count * size, -1), strict, costs)
        self.columns += [(merge(own, more), root) for own in map(powers_of, products.chosen) for more in level.factors]

    def _add_equations(self, places: list[int], degree: int, bernstein: int) -> None:
        """Adds equations that are left, times monomials, as free columns."""
        problem = self.problem
        degree = max(1, degree)
        polys = problem.polys() if places else []
        bounds = [max(int(p.degrees()[v]) for p in polys) for v in range(problem.ring.size)] if places else []
        top = max((total_degree(p) for p in polys), default=0) * degree + bernstein
        for place in places:
            equation = problem.reduction.left[place]
            room, own = top - total_degree(equation.poly), [int(d) for d in equation.poly.degrees()]
            ranges = [range(max(0, min(room, b * degree + (bernstein if b else 0) - o)) + 1 if b else 1) for b, o in zip(bounds, own)]
            monomials = [exponents for exponents in choices(*ranges) if sum(exponents) <= room]
            keys, values = self.packing.row(equation.poly)
            self.cofactors += [(place, exponents) for exponents in monomials]
            self.program.add_free(self.packing.keys(monomials)[:, None] + keys, np.broadcast_to(values, (len(monomials), len(values))))

    def node(self, budget: Budget) -> Node | None:
        """Solves the program, and gives the node of its solution."""
        budget.spend(3 * len(self.columns) + 3 * len(self.cofactors))
        found = solve(self.program, budget)
        if found is None:
            return None
        used = [(self.columns[k], c) for k, c in found[0].items()]
        cofactors = [(self.cofactors[k], c) for k, c in found[1].items()]
        return lift(self.problem, used, cofactors, self.roots)


class Products:
    """Products of the same number of facts as rows of keys and values, padded with zeros."""

    def __init__(self, facts: list[Fact], others: list[int], packing: Packing) -> None:
        length = max((len(fact.poly) for fact in facts), default=1)
        self.own_keys, self.own_values = np.zeros((len(facts), length), np.int64), np.zeros((len(facts), length))
        for k, fact in enumerate(facts):
            width = len(fact.poly)
            self.own_keys[k, :width], self.own_values[k, :width] = packing.row(fact.poly)
        self.own_strict = [fact.strict for fact in facts]
        self.others = others
        self.places: list[tuple[int, ...]] = [()]  # the facts of every product, by their places among the others
        self.chosen: list[tuple[int, ...]] = [()]
        self.strict = [True]
        self.keys, self.values = np.zeros((1, 1), np.int64), np.ones((1, 1))
        self.widths = [1]

    def _copy(self) -> Products:
        new = object.__new__(Products)
        new.__dict__.update(self.__dict__)
        return new

    def times_facts(self) -> Products:
        """The products with one fact more, each once."""
        pairs = [(i, k) for i, place in enumerate(self.places) for k in range(place[-1] if place else 0, len(self.others))]
        old, fact = [i for i, _ in pairs], [k for _, k in pairs]
        new = self._copy()
        new.places = [(*self.places[i], k) for i, k in pairs]
        new.chosen = [(*self.chosen[i], self.others[k]) for i, k in pairs]
        new.strict = [self.strict[i] and self.own_strict[k] for i, k in pairs]
        length = self.keys.shape[1] * self.own_keys.shape[1]
        new.keys = (self.keys[old][:, :, None] + self.own_keys[fact][:, None, :]).reshape(len(pairs), length)
        new.values = (self.values[old][:, :, None] * self.own_values[fact][:, None, :]).reshape(new.keys.shape)
        new.widths = np.count_nonzero(new.values, axis=1).tolist()
        return new

    def only(self, kept: list[int]) -> Products:
        """Some of the products."""
        if len(kept) == len(self.chosen):
            return self
        new = self._copy()
        new.keys, new.values = self.keys[kept], self.values[kept]
        new.places, new.chosen = [self.places[k] for k in kept], [self.chosen[k] for k in kept]
        new.strict, new.widths = [self.strict[k] for k in kept], [self.widths[k] for k in kept]
        return new

    def times_row(self, row: Row) -> Products:
        """All of the products times one polynomial."""
        new = self._copy()
        new.keys = (self.keys[:, :, None] + row[0]).reshape(len(self.keys), -1)
        new.values = (self.values[:, :, None] * row[1]).reshape(len(self.keys), -1)
        new.widths = [width * len(row[0]) for width in self.widths]
        return new


def powers_of(chosen: tuple[int, ...]) -> Factors:
    """A product of facts, each with its exponent."""
    return tuple((k, chosen.count(k)) for k in sorted(set(chosen)))


class Level:
    """The Bernstein polynomials low^i * high^(degree - i) as a table of coefficients of the powers of the bounded variable."""

    def __init__(self, problem: Problem, degree: int, packing: Packing) -> None:
        self.degree = degree
        bounded, facts = problem.bounded, problem.facts
        if bounded is None or degree == 0:
            self.factors: list[Factors] = [()]
            self.strict, self.keys, self.table = [True], np.zeros(1, np.int64), np.ones((1, 1))
            return
        lines = []
        for k in (bounded.low, bounded.high):
            slope = float(int(facts[k].poly.derivative(bounded.variable).leading_coefficient()))
            line, base = [np.ones(1)], np.array([float(-facts[k].end(bounded.variable) * int(slope)), slope])
            for _ in range(degree):
                line.append(np.convolve(line[-1], base))
            lines.append(line)
        self.table = np.array([np.convolve(lines[0][i], lines[1][degree - i]) for i in range(degree + 1)])
        self.keys = np.arange(degree + 1, dtype=np.int64) * packing.weights[bounded.variable]
        pairs = [((bounded.low, i), (bounded.high, degree - i)) for i in range(degree + 1)]
        self.factors = [tuple(sorted((k, e) for k, e in pair if e)) for pair in pairs]
        self.strict = [all(facts[k].strict for k, _ in own) for own in self.factors]


def lift(problem: Problem, used: list[tuple[tuple[Factors, int], Fraction]], cofactors: list[tuple[Cofactor, Fraction]],
         roots: list[fmpz_mpoly]) -> Node | None:
    """The node of an identity between the problem's facts and the equations left."""
    ring, facts = problem.ring, problem.facts
    divided: dict[int, int] = {}  # facts with a multiplier -> the largest exponent in use
    for (factors, _), _ in used:
        for k, e in factors:
            if facts[k].multiplier is not None:
                divided[k] = max(divided.get(k, 0), e)
    terms: list[Term] = []
    for (factors, root), c in used:
        have = dict(factors)
        whole: Sum = [(c, factors)]
        for k, most in divided.items():
            for _ in range(most - have.get(k, 0)):
                whole = times(whole, facts[k].multiplier or [])
        for value, product in whole:
            terms.append(term(problem, value, product, roots[root] if root >= 0 else ring.one))
    common = lcm(1, *(c.denominator for _, c in cofactors), *(t.coefficient.denominator for t in terms))
    extra = ring.one  # what the terms have been multiplied by
    scale = Fraction(common)
    for k, most in divided.items():
        poly, unit = sum_of(problem, facts[k].multiplier or [])
        extra, scale = extra * poly**most, scale * unit**most
    terms = [Term(t.coefficient * common * scale.denominator, t.factors, t.root) for t in terms]
    scale *= scale.denominator
    owed: dict[int, fmpz_mpoly] = {}
    used_equations = sorted({place for (place, _), _ in cofactors})
    multiples = [squared(problem, place) for place in used_equations]
    for at, place in enumerate(used_equations):
        equation = problem.reduction.left[place]
        own = [(monomial, c) for (where, monomial), c in cofactors if where == place]
        # every term is multiplied by all multiples: an equation's own multiple is part of its combination
        cofactor = extra * prod((multiple for other, (multiple, _) in enumerate(multiples) if other != at), start=ring.one)
        if multiples[at][0] != equation.multiple:
            cofactor = cofactor * equation.multiple
        whole_cofactor = ring.zero
        clear = lcm(1, *(Fraction(c * scale).denominator for _, c in own))
        if clear != 1:
            return None
        for monomial, c in own:
            whole_cofactor = whole_cofactor + ring.ctx.from_dict({monomial: int(c * scale)})
        for k, part in equation.combination.items():
            owed[k] = owed.get(k, ring.zero) + part * whole_cofactor * cofactor
    shared = merge(*(factors for _, factors in multiples))
    terms = [Term(t.coefficient, merge(t.factors, shared), t.root) for t in terms]
    return finish(problem.source, problem.reduction, terms, owed)


def term(problem: Problem, coefficient: Fraction, product: Factors, root: fmpz_mpoly) -> Term:
    """A product of the problem's facts in terms of the state's facts."""
    factors: Factors = ()
    for k, e in product:
        fact: Fact = problem.facts[k]
        factors, coefficient = merge(factors, power(fact.factors, e)), coefficient / fact.scale**e
        for step, n in zip(problem.reduction.steps, fact.counts):
            factors, coefficient = merge(factors, power(step.lead_factors, n * e)), coefficient * step.lead_scale ** (n * e)
    return Term(coefficient, factors, root)


def sum_of(problem: Problem, total: Sum) -> tuple[fmpz_mpoly, Fraction]:
    """(p, c) with c * p the value of a sum over the problem's facts."""
    common = lcm(*(c.denominator for c, _ in total))
    poly = problem.ring.zero
    for c, factors in total:
        poly = poly + prod((problem.facts[k].poly ** e for k, e in factors), start=problem.ring.one) * int(c * common)
    return poly, Fraction(1, common)


def squared(problem: Problem, place: int) -> tuple[fmpz_mpoly, Factors]:
    """The multiple of an equation left and its facts, squared where a fact in it has no known sign."""
    equation = problem.reduction.left[place]
    even = any(problem.source.relations[k] == "!=" for k, _ in equation.factors)
    return (equation.multiple * equation.multiple, power(equation.factors, 2)) if even else (equation.multiple, equation.factors)
