"""One leaf in coordinates that are not negative: facts times monomials, of whose sum no coefficient
is positive.

Facts that are linear in a variable, with a constant factor, are taken for coordinates, as in
successive difference substitution (Yang, Solving harder problems with lesser mathematics, ATCM
2005).  Monomials in them are products of facts; the multipliers, of whatever degree, are those that
cancel a monomial.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import combinations_with_replacement
from math import prod
from operator import add, ge, sub

import numpy as np
from flint import fmpz_mpoly

from juggleproof.algebra.polynomials import (
    Monomial,
    coefficients_in,
    constant_of,
    total_degree,
)
from juggleproof.search import limits
from juggleproof.search.psatz.facts import Factors, merge, power
from juggleproof.search.psatz.lifting import MonomialCofactor, lift
from juggleproof.search.psatz.linear_program import EXACT, Program, solve
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.statements.nodes import Node
from juggleproof.statements.work import Budget, Exhausted

Multiple = tuple[Fraction, Factors]  # a positive number times strict facts


@dataclass
class OrthantStep:
    """gen - rest, divided by a factor, in place of a variable, whose generator stands for a fact
    from then on; the factor is positive, or negative where `sign` is -1, and of this size.
    """

    fact: int
    variable: int
    factor: fmpz_mpoly
    rest: fmpz_mpoly
    sign: int
    size: Multiple

    def work(self, poly: fmpz_mpoly) -> int:
        """Units of work that `apply` takes at most, by the terms of the powers to be multiplied."""
        degree = int(poly.degrees()[self.variable]) if poly else 0
        terms: int = max(len(self.rest) + 1, len(self.factor))
        return len(poly) * int(terms**degree) // 10

    def apply(self, poly: fmpz_mpoly) -> tuple[fmpz_mpoly, Multiple]:
        """The polynomial after the step, times the size of the factor to its degree, and that."""
        degree = int(poly.degrees()[self.variable]) if poly else 0
        if not degree:
            return poly, (Fraction(1), ())
        gen = poly.context().gens()[self.variable]
        value, size = (gen - self.rest) * self.sign, self.factor * self.sign
        whole = poly * 0
        for i, part in enumerate(coefficients_in(poly, self.variable)):
            whole = whole + part * value**i * size ** (degree - i)
        return whole, (self.size[0] ** degree, power(self.size[1], degree))


class Orthant:
    """Some facts of a problem in coordinates: a generator v of its ring stands for a multiple of
    the fact `own[v]`, or else for itself.

    >>> from juggleproof.certificates import checker
    >>> from juggleproof.algebra.polynomials import Ring
    >>> from juggleproof.statements.states import SearchState
    >>> context = checker.Context()
    >>> for name in ("x", "y"):
    ...     context.declare(name)
    >>> formula = context.formula(checker.parse("x > 1 and y >= x and y^2 < x^2"))
    >>> problem = LeafProblem(SearchState(context).assume(formula), Ring(("x", "y")))
    >>> orthant = Orthant(problem, [0, 1, 2], Budget(10**5))
    >>> orthant.own, str(orthant.facts[2])
    ({0: 1, 1: 0}, '-x^2 - 2*x*y - 2*x')
    """

    def __init__(self, problem: LeafProblem, only: Sequence[int], budget: Budget) -> None:
        self.problem, self.ring, self.only, self.budget = problem, problem.ring, only, budget
        self.own: dict[int, int] = {}
        self.steps: list[OrthantStep] = []
        self.facts = [fact.poly for fact in problem.facts]
        self.multiples: list[Multiple] = [(Fraction(1), ()) for _ in self.facts]
        while step := self._best():
            self.own[step.variable] = step.fact
            self.steps.append(step)
            for k in set(self.only) - {step.fact}:
                budget.spend(step.work(self.facts[k]))
                self.facts[k], more = step.apply(self.facts[k])
                self.multiples[k] = both(self.multiples[k], more)
            self.facts[step.fact] = self.ring.gens[step.variable]

    def _best(self) -> OrthantStep | None:
        """The step after which most facts have no negative coefficient; constant factors and linear
        facts first.
        """
        self.budget.spend(len(self.only) * self.ring.size)
        best: tuple[tuple[int, ...], OrthantStep] | None = None
        facts = [(k, self.facts[k]) for k in self.only]
        small = [(p, not_negative(p)) for _, p in facts if len(p) <= limits.ORTHANT_TERMS]
        for k, poly in facts:
            for v in () if k in self.own.values() else range(self.ring.size):
                step = self._step(k, v) if v not in self.own and poly.degrees()[v] == 1 else None
                if step is None:
                    continue
                order = -total_degree(step.factor), -total_degree(poly)
                if best is None or order >= best[0][:2]:
                    self.budget.spend(sum(step.work(p) for p, _ in small))
                    count = sum(
                        not_negative(step.apply(p)[0]) if p.degrees()[v] else now
                        for p, now in small
                    )
                    score = (*order, count, -len(poly), k)
                    if best is None or score > best[0]:
                        best = score, step
        return best[1] if best else None

    def _step(self, k: int, v: int) -> OrthantStep | None:
        """The step that a fact is for a variable that it is linear in, if the variable's factor is
        a product of strict facts.
        """
        factor = self.facts[k].derivative(v)
        rest, size, found = factor, (Fraction(1), Factors()), self.problem.facts
        for j in self.only if not factor.is_constant() else ():
            content, fact = self.facts[j].primitive()
            while found[j].strict and not fact.is_constant() and not rest.is_constant():
                quotient, remainder = divmod(rest, fact)
                if remainder:
                    break
                rest = quotient
                scale, factors = self.multiples[j]
                size = both(size, (scale / int(content), merge(factors, ((j, 1),))))
        number = constant_of(rest)
        if not number:
            return None
        size = size[0] * abs(number), size[1]
        sign = 1 if number > 0 else -1
        return OrthantStep(k, v, factor, self.facts[k] - self.ring.gens[v] * factor, sign, size)

    def changed(self, poly: fmpz_mpoly) -> tuple[fmpz_mpoly, Multiple]:
        """The polynomial in the coordinates, times a multiple, and that."""
        multiple: Multiple = (Fraction(1), ())
        for step in self.steps:
            poly, more = step.apply(poly)
            multiple = both(multiple, more)
        return poly, multiple


def both(a: Multiple, b: Multiple) -> Multiple:
    """The product of two."""
    return a[0] * b[0], merge(a[1], b[1])


def not_negative(poly: fmpz_mpoly) -> bool:
    """Whether no coefficient is negative."""
    return all(c > 0 for c in poly.coeffs())


@dataclass
class Base:
    """What is multiplied by monomials, in the coordinates: a number times facts times root^2, or
    times an equation.
    """

    poly: fmpz_mpoly
    multiple: Multiple
    strict: bool = False
    root: fmpz_mpoly | None = None
    terms: list[tuple[Monomial, int]] = field(init=False)

    def __post_init__(self) -> None:
        exponents = [tuple(map(int, m)) for m in self.poly.monoms()]
        self.terms = list(zip(exponents, map(int, self.poly.coeffs())))
        self.degree = total_degree(self.poly)


def search_orthant(problem: LeafProblem, most: int, budget: Budget) -> Node | None:
    """The node of an identity of at most `most` products; None where none was found, or where the
    facts in coordinates are too large for the budget.

    Raises Exhausted where the budget ends.
    """
    if not problem.facts:
        return None
    budget.spend(200 + 20 * sum(len(fact.poly) for fact in problem.facts))
    last, every = len(problem.facts) - 1, list(range(len(problem.facts)))
    others = [v for v, d in enumerate(problem.facts[last].poly.degrees()) if not d]
    own = [k for k in every if not any(problem.facts[k].poly.degrees()[v] for v in others)]
    for only in (own, every) if len(own) < len(every) else (every,):
        try:
            leaf = OrthantLeaf(Orthant(problem, only, budget))
        except Exhausted:
            return None
        starts = [[k for k, fact in enumerate(leaf.alone) if fact == last]]
        starts += [list(range(len(leaf.alone)))] if only is every else []
        for start in starts:
            node = leaf.node(start, most, budget) if start else None
            if node is not None:
                return node
    return None


class OrthantLeaf:
    """The linear program in coordinates."""

    def __init__(self, orthant: Orthant) -> None:
        self.orthant, self.problem, self.ring = orthant, orthant.problem, orthant.ring
        facts = self.problem.facts
        rest = [
            k
            for k in orthant.only
            if k not in orthant.own.values() and not not_negative(orthant.facts[k])
        ]
        self.alone = rest  # the first bases are made of these
        groups: list[tuple[int, ...]] = [(k,) for k in rest]
        if len(rest) <= limits.MOST_FACTS_IN_ORTHANT:
            groups += combinations_with_replacement(rest, 2)
        self.bases = []
        for group in groups:
            poly = prod((orthant.facts[k] for k in group), start=self.ring.one)
            multiple: Multiple = (Fraction(1), merge(*(((k, 1),) for k in group)))
            for k in group:
                multiple = both(multiple, orthant.multiples[k])
            self.bases.append(Base(poly, multiple, all(facts[k].strict for k in group)))
        top = max((b.degree for b in self.bases[: len(rest)]), default=0) + limits.ORTHANT_MORE
        self.bases = [base for base in self.bases if base.degree <= top]
        for root in self.problem.candidates("squares", 4 * limits.ORTHANT_ROOTS):
            poly, multiple = orthant.changed(root)
            if len(poly) > 1 and len(self.bases) < len(rest) + len(groups) + limits.ORTHANT_ROOTS:
                self.bases.append(Base(poly * poly, both(multiple, multiple), root=root))
        self.equations = [Base(*orthant.changed(e.poly)) for e in self.problem.reduction.left]
        self.top = top

    def _columns(
        self, start: Sequence[int], most: int, budget: Budget
    ) -> list[tuple[int, Monomial]]:
        """The bases, and the equations after them, each times monomials that cancel one."""
        every = [*self.bases, *self.equations]
        one = (0,) * self.ring.size
        columns = {(k, one): None for k in start}
        reached: dict[Monomial, None] = {}
        for k in start:
            reached.update((m, None) for m, c in every[k].terms if c > 0)
        for _ in range(limits.ORTHANT_ROUNDS):
            new: dict[Monomial, None] = {}
            for k, base in enumerate(every):
                free = k >= len(self.bases)
                for term, c in base.terms:
                    budget.spend(1 + len(reached) // 8)
                    for monomial in reached if free or c < 0 else ():
                        if not all(map(ge, monomial, term)):
                            continue
                        factor = tuple(map(sub, monomial, term))
                        if (
                            (k, factor) in columns
                            or sum(factor) + base.degree > self.top
                            or not free
                            and any(
                                e % 2 for v, e in enumerate(factor) if v not in self.orthant.own
                            )
                        ):
                            continue
                        if len(columns) >= most:
                            return list(columns)
                        columns[k, factor] = None
                        new.update(
                            (tuple(map(add, m, factor)), None)
                            for m, a in base.terms
                            if free or a > 0
                        )
            reached = {m: None for m in new if m not in reached}
        return list(columns)

    def node(self, start: Sequence[int], most: int, budget: Budget) -> Node | None:
        """The node of an identity."""
        columns = sorted(
            self._columns(start, most, budget), key=lambda one: one[0] >= len(self.bases)
        )
        every = [*self.bases, *self.equations]
        numbers: dict[Monomial, int] = {}
        program = Program()
        rows = []
        for k, factor in columns:
            row = [(tuple(map(add, m, factor)), c) for m, c in every[k].terms]
            for m, _ in row:
                numbers.setdefault(m, len(numbers))
            rows.append(row)
        if any(abs(c) >= EXACT for row in rows for _, c in row):
            return None
        fixed = [place for place, (k, _) in enumerate(columns) if k < len(self.bases)]
        alone = [m for m in numbers if self._square(m)]
        every_row = [rows[place] for place in fixed] + [[(m, 1)] for m in alone]
        used = [columns[place] for place in fixed] + [(-1, m) for m in alone]
        facts, own = self.problem.facts, self.orthant.own
        strict = [
            (k < 0 or every[k].strict)
            and all(v in own and facts[own[v]].strict for v, e in enumerate(m) if e)
            for k, m in used
        ]
        self._add(program, every_row, numbers, strict, [1 + sum(m) / 4 for _, m in used])
        for place, (k, _) in enumerate(columns):
            if k >= len(self.bases):
                keys = np.array([numbers[m] for m, _ in rows[place]], dtype=np.int64)
                program.add_free(1, keys, np.array([c for _, c in rows[place]], dtype=np.float64))
        free = [one for one in columns if one[0] >= len(self.bases)]
        if not any(strict):
            return None
        budget.spend(3 * len(columns) + 3 * len(alone))
        found = solve(program, budget)
        if found is None:
            return None
        return self._lifted(
            [(used[place], c) for place, c in found[0].items()],
            [(free[place], c) for place, c in found[1].items()],
        )

    def _square(self, monomial: Monomial) -> bool:
        """Whether a monomial is not negative: even in what is no fact."""
        return not any(e % 2 for v, e in enumerate(monomial) if v not in self.orthant.own)

    @staticmethod
    def _add(
        program: Program,
        rows: list[list[tuple[Monomial, int]]],
        numbers: dict[Monomial, int],
        strict: list[bool],
        costs: list[float],
    ) -> None:
        places = [place for place, row in enumerate(rows) for _ in row]
        program.add(
            np.array(places, dtype=np.int64),
            np.array([numbers[m] for row in rows for m, _ in row], dtype=np.int64),
            np.array([c for row in rows for _, c in row], dtype=np.float64),
            np.array(strict, dtype=bool),
            np.array(costs),
        )

    def _lifted(
        self,
        used: list[tuple[tuple[int, Monomial], Fraction]],
        free: list[tuple[tuple[int, Monomial], Fraction]],
    ) -> Node | None:
        ring, facts = self.ring, self.problem.facts
        roots: list[fmpz_mpoly] = []
        terms: list[tuple[tuple[Factors, int], Fraction]] = []
        for (k, monomial), c in used:
            (scale, factors), root = self._product(monomial)
            if k >= 0:
                scale, factors = both((scale, factors), self.bases[k].multiple)
                root = root * (self.bases[k].root or ring.one)
            if root != ring.one:
                roots.append(root)
            terms.append(((factors, -1 if root == ring.one else len(roots) - 1), c * scale))
        total: dict[MonomialCofactor, Fraction] = {}
        for (k, monomial), c in free:
            place = k - len(self.bases)
            (scale, factors), root = self._product(monomial, 1)
            scale, factors = both((scale, factors), self.equations[place].multiple)
            product = prod((facts[j].poly ** e for j, e in factors), start=root)
            for m, a in zip(product.monoms(), product.coeffs()):
                key = place, tuple(map(int, m))
                total[key] = total.get(key, Fraction(0)) + c * scale * int(a)
        cofactors = [(key, c) for key, c in total.items() if c]
        return lift(self.problem, terms, cofactors, roots)

    def _product(self, monomial: Monomial, square: int = 2) -> tuple[Multiple, fmpz_mpoly]:
        """A monomial as a multiple times the square of a root, or times this itself."""
        multiple: Multiple = (Fraction(1), ())
        root = self.ring.one
        for v, e in enumerate(monomial):
            if e and v in self.orthant.own:
                k = self.orthant.own[v]
                scale, factors = self.orthant.multiples[k]
                own = scale**e, merge(power(factors, e), ((k, e),))
                multiple = both(multiple, own)
            elif e:
                root = root * self.ring.gens[v] ** (e // square)
        return multiple, root
