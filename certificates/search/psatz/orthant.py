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

from juggleproof.certificates.algebra.polynomials import (
    Monomial,
    coefficients_in,
    constant_of,
    total_degree,
)
from juggleproof.certificates.nodes import Node
from juggleproof.certificates.search.psatz.facts import Factors, merge
from juggleproof.certificates.search.psatz.lifting import MonomialCofactor, lift
from juggleproof.certificates.search.psatz.linear_program import EXACT, Program, solve
from juggleproof.certificates.search.psatz.problem import Problem
from juggleproof.certificates.work import Budget

MOST_COLUMNS = 1200
MOST_FOR_PAIRS = 8  # facts beside the coordinates
ROUNDS = 2  # of multipliers, each for the monomials of those before
MORE = 2  # degrees beyond that of the facts
SMALL = 8  # terms of a fact that coordinates are chosen by
MOST_ROOTS = 12


class Orthant:
    """The facts of a problem in coordinates: a generator v of its ring stands for the fact
    `own[v]`, or else for itself.

    >>> from juggleproof.certificates import checker
    >>> from juggleproof.certificates.algebra.polynomials import Ring
    >>> from juggleproof.certificates.states import State
    >>> context = checker.Context()
    >>> for name in ("x", "y"):
    ...     context.declare(name)
    >>> formula = context.formula(checker.parse("x > 1 and y >= x and y^2 < x^2"))
    >>> orthant = Orthant(Problem(State(context).assume(formula), Ring(("x", "y"))), [0, 1, 2])
    >>> orthant.own, str(orthant.facts[2])
    ({0: 0, 1: 1}, '-2*x*y - y^2 - 2*y')
    """

    def __init__(self, problem: Problem, only: Sequence[int]) -> None:
        self.problem, self.ring, self.only = problem, problem.ring, only
        self.own: dict[int, int] = {}
        self.steps: list[tuple[int, int, fmpz_mpoly]] = []  # c*v + rest is the new coordinate
        self.facts = [fact.poly for fact in problem.facts]
        while step := self._best():
            k, *rest = step
            self.own[rest[0]] = k
            self.steps.append((rest[0], rest[1], rest[2]))
            self.facts = [substituted(poly, *self.steps[-1])[0] for poly in self.facts]

    def _best(self) -> tuple[int, int, int, fmpz_mpoly] | None:
        """The fact, and the variable that it is linear in, after whose step most facts have no
        negative coefficient; linear facts first.
        """
        best: tuple[tuple[int, ...], tuple[int, int, int, fmpz_mpoly]] | None = None
        facts = [(k, self.facts[k]) for k in self.only]
        small = [(p, not_negative(p)) for _, p in facts if len(p) <= SMALL]
        for k, poly in facts:
            for v in () if k in self.own.values() else range(self.ring.size):
                c = constant_of(poly.derivative(v)) if v not in self.own else None
                if c:
                    rest = poly - self.ring.gens[v] * c
                    count = sum(
                        not_negative(substituted(p, v, c, rest)[0]) if p.degrees()[v] else now
                        for p, now in small
                    )
                    score = (-total_degree(poly), count, -len(poly), k)
                    if best is None or score > best[0]:
                        best = score, (k, v, c, rest)
        return best[1] if best else None

    def changed(self, poly: fmpz_mpoly) -> tuple[fmpz_mpoly, int]:
        """A positive multiple of the polynomial in the coordinates, and by how much."""
        scale = 1
        for step in self.steps:
            poly, more = substituted(poly, *step)
            scale *= more
        return poly, scale


def not_negative(poly: fmpz_mpoly) -> bool:
    """Whether no coefficient is negative."""
    return all(c > 0 for c in poly.coeffs())


def substituted(poly: fmpz_mpoly, v: int, c: int, rest: fmpz_mpoly) -> tuple[fmpz_mpoly, int]:
    """The polynomial with (v - rest)/c in place of v, times c^degree, and this positive number."""
    degree = int(poly.degrees()[v]) if poly else 0
    if not degree:
        return poly, 1
    gen = poly.context().gens()[v]
    value, size = (gen - rest) * (1 if c > 0 else -1), abs(c)
    parts = coefficients_in(poly, v, gen)
    whole = sum((p * value**i * size ** (degree - i) for i, p in enumerate(parts)), poly * 0)
    return whole, size**degree


@dataclass
class Base:
    """What is multiplied by monomials, in the coordinates: scale * product of facts * root^2, or
    scale * an equation.
    """

    poly: fmpz_mpoly
    scale: int
    factors: Factors = ()
    strict: bool = False
    root: fmpz_mpoly | None = None
    terms: list[tuple[Monomial, int]] = field(init=False)

    def __post_init__(self) -> None:
        exponents = [tuple(map(int, m)) for m in self.poly.monoms()]
        self.terms = list(zip(exponents, map(int, self.poly.coeffs())))
        self.degree = total_degree(self.poly)


def search_orthant(problem: Problem, budget: Budget) -> Node | None:
    """The node of an identity; None where none was found.

    Raises Exhausted where the budget ends.
    """
    if not problem.facts:
        return None
    budget.spend(200 + 20 * sum(len(fact.poly) for fact in problem.facts))
    last, every = len(problem.facts) - 1, list(range(len(problem.facts)))
    others = [v for v, d in enumerate(problem.facts[last].poly.degrees()) if not d]
    own = [k for k in every if not any(problem.facts[k].poly.degrees()[v] for v in others)]
    for only in (own, every) if len(own) < len(every) else (every,):
        leaf = Leaf(Orthant(problem, only))
        starts = [[k for k, base in enumerate(leaf.bases) if base.factors == ((last, 1),)]]
        starts += [list(range(leaf.count))] if only is every else []
        for start in starts:
            node = leaf.node(start, budget) if start else None
            if node is not None:
                return node
    return None


class Leaf:
    """The linear program in coordinates."""

    def __init__(self, orthant: Orthant) -> None:
        self.orthant, self.problem, self.ring = orthant, orthant.problem, orthant.ring
        facts = self.problem.facts
        rest = [
            k
            for k in orthant.only
            if k not in orthant.own.values() and not not_negative(orthant.facts[k])
        ]
        self.count = len(rest)
        groups: list[tuple[int, ...]] = [(k,) for k in rest]
        if len(rest) <= MOST_FOR_PAIRS:
            groups += combinations_with_replacement(rest, 2)
        self.bases = []
        for group in groups:
            poly, scale = orthant.changed(prod((facts[k].poly for k in group), start=self.ring.one))
            factors = merge(*(((k, 1),) for k in group))
            self.bases.append(Base(poly, scale, factors, all(facts[k].strict for k in group)))
        top = max((b.degree for b in self.bases[: len(rest)]), default=0) + MORE
        self.bases = [base for base in self.bases if base.degree <= top]
        for root in self.problem.candidates("squares", 4 * MOST_ROOTS):
            poly, scale = orthant.changed(root)
            if len(poly) > 1 and len(self.bases) < self.count + len(groups) + MOST_ROOTS:
                self.bases.append(Base(poly * poly, scale * scale, root=root))
        self.equations = [Base(*orthant.changed(e.poly)) for e in self.problem.reduction.left]
        self.top = top

    def _columns(self, start: Sequence[int], budget: Budget) -> list[tuple[int, Monomial]]:
        """The bases, and the equations after them, each times monomials that cancel one."""
        every = [*self.bases, *self.equations]
        one = (0,) * self.ring.size
        columns = {(k, one): None for k in start}
        reached: dict[Monomial, None] = {}
        for k in start:
            reached.update((m, None) for m, c in every[k].terms if c > 0)
        for _ in range(ROUNDS):
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
                        if len(columns) >= MOST_COLUMNS:
                            return list(columns)
                        columns[k, factor] = None
                        new.update(
                            (tuple(map(add, m, factor)), None)
                            for m, a in base.terms
                            if free or a > 0
                        )
            reached = {m: None for m in new if m not in reached}
        return list(columns)

    def node(self, start: Sequence[int], budget: Budget) -> Node | None:
        """The node of an identity."""
        columns = sorted(self._columns(start, budget), key=lambda one: one[0] >= len(self.bases))
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
        ring, own, facts = self.ring, self.orthant.own, self.problem.facts
        roots: list[fmpz_mpoly] = []
        terms: list[tuple[tuple[Factors, int], Fraction]] = []
        for (k, monomial), c in used:
            factors = tuple((own[v], e) for v, e in enumerate(monomial) if e and v in own)
            root = ring.one
            for v, e in enumerate(monomial):
                root = root * (ring.gens[v] ** (e // 2) if e and v not in own else 1)
            if k >= 0:
                base = self.bases[k]
                factors, c = merge(factors, base.factors), c * base.scale
                root = root if base.root is None else root * base.root
            if root != ring.one:
                roots.append(root)
            terms.append(((factors, -1 if root == ring.one else len(roots) - 1), c))
        total: dict[MonomialCofactor, Fraction] = {}
        for (k, monomial), c in free:
            place = k - len(self.bases)
            product = prod(
                (
                    (facts[own[v]].poly if v in own else ring.gens[v]) ** e
                    for v, e in enumerate(monomial)
                    if e
                ),
                start=ring.one,
            )
            for m, a in zip(product.monoms(), product.coeffs()):
                key = place, tuple(map(int, m))
                total[key] = total.get(key, Fraction(0)) + (
                    c * int(a) * self.equations[place].scale
                )
        cofactors = [(key, c) for key, c in total.items() if c]
        return lift(self.problem, terms, cofactors, roots)
