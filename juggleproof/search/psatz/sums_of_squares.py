"""Sums of squares: identities sum s_k * product of facts + sum m_j * equation = 0 with sums of
squares s_k, one of the strict ones not 0.

A semidefinite program in floats hints at Gram matrices of the s_k.  Source: Parrilo, Structured
semidefinite programs and semialgebraic geometry methods in robustness and optimization (2000).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import combinations_with_replacement
from itertools import product as choices
from math import comb, prod
from typing import Any

import numpy as np
from flint import fmpz_mpoly
from numpy.typing import NDArray

from juggleproof.algebra.polynomials import Monomial, Ring, total_degree
from juggleproof.algebra.semidefinite import (
    Entry,
    Floats,
    GramBlock,
    LinearEquations,
    as_squares,
    rational_image,
)
from juggleproof.search import limits
from juggleproof.search.psatz.facts import Factors
from juggleproof.search.psatz.lifting import MonomialCofactor, lift, powers_of
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.statements.nodes import Node
from juggleproof.statements.work import Budget

# -------------------------------------------------------------------------------------------------
# Programs, and the identities that they lead to.
#
# Where Gram matrices are singular, as at every point of equality, their kernel is read off as
# rationals and the squares are confined to its complement, so that what is left can be rounded
# (Peyrl and Parrilo 2008; Monniaux and Corbineau 2011).  The result is exact, and the checker
# confirms it.

Solved = tuple[LinearEquations, list[Floats]]
Square = tuple[tuple[Factors, int], Fraction]  # (factors, number of a root or -1 for 1), weight
Lift = Callable[
    [list[Square], list[tuple[MonomialCofactor, Fraction]], list[fmpz_mpoly]], Node | None
]


@dataclass
class FactBlock(GramBlock):
    """A block of a product of facts: poly = scale * product of facts^exponents, scale > 0."""

    factors: Factors
    scale: Fraction = Fraction(1)


@dataclass
class SquaresProgram:
    """Blocks and cofactors, each with the product that it stands for; a combination of these is to
    be 0; `lift` makes the node of an identity between the facts.

    The strict terms sum to `total`.  `goals`, `denominators` and `kernels` are tried in turn.
    """

    ring: Ring
    blocks: list[FactBlock]
    cofactors: list[tuple[MonomialCofactor, fmpz_mpoly]]
    lift: Lift
    total: Fraction = Fraction(1)
    goals: Sequence[tuple[float, float]] = limits.SQUARES_GOALS
    denominators: Sequence[int] = limits.SQUARES_DENOMINATORS[:4]
    kernels: Sequence[float] = limits.KERNELS

    def node(self, budget: Budget) -> Node | None:
        """The node of an identity that the program leads to."""
        blocks = self.blocks
        for goal in self.goals:
            self.blocks, tried = blocks, set[tuple[int, ...]]()
            first = self._solved(budget, goal)
            node = self._rounded(*first, self.denominators, budget) if first else None
            if node is not None or not first and goal == self.goals[0]:
                return node
            for threshold in self.kernels if first else ():
                node = self._followed(blocks, first, threshold, goal, tried, budget)
                if node is not None:
                    return node
        return None

    def _followed(
        self,
        blocks: list[FactBlock],
        solved: Solved | None,
        threshold: float,
        goal: tuple[float, float],
        tried: set[tuple[int, ...]],
        budget: Budget,
    ) -> Node | None:
        """The node of a solution inside of the cone that is left when kernels are taken off, as
        long as there are any.
        """
        self.blocks = blocks
        for _ in range(limits.SQUARES_ROUNDS):
            confined = self._confined(solved[1], threshold) if solved else []
            sizes = tuple(len(block.basis) for block in confined)
            if not solved or not any(block.strict for block in confined):
                return None
            if sizes == tuple(len(block.basis) for block in self.blocks):
                return self._rounded(*solved, limits.SQUARES_DENOMINATORS, budget)
            if sizes in tried:
                return None
            tried.add(sizes)
            self.blocks = confined
            solved = self._solved(budget, goal)
        return None

    def _solved(self, budget: Budget, goal: tuple[float, float]) -> Solved | None:
        """The equations with matrices that meet them nearly."""
        linear = self._linear()
        budget.spend(100 + (sum(map(len, linear.terms)) // 2 if linear else 0))
        grams = linear.solve(budget, *goal) if linear else None
        return (linear, grams) if linear and grams else None

    def _linear(self) -> LinearEquations | None:
        """The equations, where there are any that could be met, and they are not too many."""
        if (
            not any(block.strict for block in self.blocks)
            or max(len(block.basis) for block in self.blocks) > limits.SQUARES_MONOMIALS
        ):
            return None
        linear = LinearEquations(self.blocks, [poly for _, poly in self.cofactors], self.total)
        return linear if linear.size <= limits.SQUARES_ENTRIES else None

    def _confined(self, grams: list[Floats], threshold: float) -> list[FactBlock]:
        """The blocks, each confined to the complement of its matrix's kernel, where that is a
        simple rational space.
        """
        kept = []
        top = max(float(np.abs(gram).max()) for gram in grams)
        for block, gram in zip(self.blocks, grams):
            values, vectors = np.linalg.eigh(gram)
            small = values < threshold * max(top, 1e-12)
            image = rational_image(vectors[:, ~small]) if small.any() else None
            if image is None:
                kept.append(block)
            elif image:
                basis = [
                    sum((b * c for b, c in zip(block.basis, row) if c), self.ring.zero)
                    for row in image
                ]
                kept.append(replace(block, basis=basis))
        return kept

    def _rounded(
        self,
        linear: LinearEquations,
        grams: list[Floats],
        denominators: Sequence[int],
        budget: Budget,
    ) -> Node | None:
        """The node of exact matrices near the floating ones."""
        for denominator in denominators:
            budget.spend(50 + linear.rows**2 * len(linear.terms) // 4000)
            budget.spend(sum(len(block.basis) ** 3 for block in linear.blocks))
            for entries, multipliers in linear.rounded(grams, denominator):
                node = self._lifted(entries, multipliers)
                if node is not None:
                    return node
        return None

    def _lifted(self, entries: dict[Entry, Fraction], multipliers: list[Fraction]) -> Node | None:
        """The node of exact Gram matrices, if all of them are positive semidefinite."""
        used, roots = list[Square](), list[fmpz_mpoly]()
        for k, block in enumerate(self.blocks):
            size = len(block.basis)
            gram = [[entries[(k, max(i, j), min(i, j))] for j in range(size)] for i in range(size)]
            squares = as_squares(gram)
            if squares is None or any(
                c.bit_length() > limits.SQUARES_BITS
                for weight, row in squares
                for c in (*weight.as_integer_ratio(), *row)
            ):
                return None
            for weight, row in squares:
                root = sum((b * int(c) for b, c in zip(block.basis, row) if c), self.ring.zero)
                if root == self.ring.one:
                    used.append(((block.factors, -1), weight * block.scale))
                else:
                    used.append(((block.factors, len(roots)), weight * block.scale))
                    roots.append(root)
        cofactors = [(place, c) for (place, _), c in zip(self.cofactors, multipliers) if c]
        try:
            return self.lift(used, cofactors, roots)
        except ValueError:  # a number too long to be written
            return None


def search_squares(programs: Iterable[SquaresProgram], budget: Budget) -> Node | None:
    """The node of the first program that leads to an identity; None where none does.

    Raises Exhausted where the budget ends.
    """
    for program in programs:
        node = program.node(budget)
        if node is not None:
            return node
    return None


# -------------------------------------------------------------------------------------------------
# Programs of products of a problem's facts.


def programs_of_facts(
    problem: LeafProblem,
    budget: Budget,
    stages: Sequence[tuple[int, int, bool]] = limits.SQUARES_STAGES,
) -> Iterator[SquaresProgram]:
    """The programs of the stages, smaller ones first.

    Without the signs of variables more changes of signs leave everything as it is, and programs are
    smaller and their kernels rational.
    """
    everything = list(range(len(problem.facts)))
    bare = [
        k
        for k in everything
        if total_degree(problem.facts[k].poly) > 1
        or sum(map(bool, problem.facts[k].poly.degrees())) > 1
    ]
    top = max(map(total_degree, problem.polys()), default=0)
    for count, more, without in stages:
        only = bare if without else everything
        if (
            not top
            or without
            and len(bare) == len(everything)
            or count > 1
            and len(only) > limits.MOST_FACTS_IN_SQUARES
        ):
            continue
        found = ProductsOfFacts(problem, count, top + top % 2 + more, only, budget)
        yield SquaresProgram(problem.ring, found.blocks, found.cofactors, partial(lift, problem))


class ProductsOfFacts:
    """The blocks and cofactors of a program of products of a problem's facts."""

    def __init__(
        self, problem: LeafProblem, count: int, degree: int, only: Sequence[int], budget: Budget
    ) -> None:
        self.problem, self.ring, self.degree, self.only = problem, problem.ring, degree, only
        polys = [
            *(equation.poly for equation in problem.reduction.left),
            *(problem.facts[k].poly for k in only),
        ]
        self.used = [v for v in range(self.ring.size) if any(p.degrees()[v] for p in polys)]
        self.flips = self._flips(polys)
        self.leading = [equation.poly.monoms()[0] for equation in problem.reduction.basis()]
        self.blocks = [] if self._is_too_large() else list(self._blocks(count, budget))
        equations = [equation.poly for equation in problem.reduction.left]
        rooms = [degree - total_degree(poly) for poly in equations]
        budget.spend(sum(comb(len(self.used) + room, room) for room in rooms if room > 0))
        self.cofactors = [
            ((place, monomial), poly * self.ring.ctx.from_dict({monomial: 1}))
            for place, poly in enumerate(equations)
            for monomial in self._monomials(degree - total_degree(poly))
            if self._class(monomial) == self._class(poly.monoms()[0])
        ]
        products = sum(len(block.basis) ** 2 * len(block.poly) for block in self.blocks) // 2
        if products > limits.SQUARES_ENTRIES:
            self.blocks = []
        budget.spend(products // 4)
        self.blocks = pruned(self.blocks, [poly for _, poly in self.cofactors])

    def _is_too_large(self) -> bool:
        """Whether the squares alone have too many products of monomials, as a count of these tells
        where no equation leaves some out.
        """
        monomials = comb(len(self.used) + self.degree // 2, self.degree // 2)
        return not self.leading and monomials**2 > 2 * limits.SQUARES_ENTRIES << len(self.flips)

    def _flips(self, polys: Sequence[fmpz_mpoly]) -> list[Monomial]:
        """The sets of variables whose signs can be changed without changing any fact or equation,
        but for an equation's own sign.
        """
        odd = [[tuple(e % 2 for e in m) for m in p.monoms()] for p in polys]
        found = []
        for signs in choices((0, 1), repeat=len(self.used)) if len(self.used) <= 9 else ():
            flip = [0] * self.ring.size
            for v, sign in zip(self.used, signs):
                flip[v] = sign
            parities = [{sum(a * b for a, b in zip(m, flip)) % 2 for m in p} for p in odd]
            count = len(self.problem.reduction.left)
            if (
                any(signs)
                and all(len(one) == 1 for one in parities[:count])
                and all(one <= {0} for one in parities[count:])
            ):
                found.append(tuple(flip))
        return found

    def _class(self, monomial: Monomial) -> Monomial:
        return tuple(sum(a * b for a, b in zip(monomial, flip)) % 2 for flip in self.flips)

    def _monomials(self, degree: int) -> list[Monomial]:
        found = []
        for total in range(degree + 1):
            for chosen in combinations_with_replacement(self.used, total):
                exponents = [0] * self.ring.size
                for v in chosen:
                    exponents[v] += 1
                found.append(tuple(exponents))
        return found

    def _blocks(self, count: int, budget: Budget) -> Iterator[FactBlock]:
        facts = self.problem.facts
        for number in range(count + 1):
            for chosen in combinations_with_replacement(self.only, number):
                if len(set(chosen)) < number:
                    continue  # a square already
                poly = prod((facts[k].poly for k in chosen), start=self.ring.one)
                room = (self.degree - total_degree(poly)) // 2
                if room < 0:
                    continue
                budget.spend(comb(len(self.used) + room, room))
                parts: dict[Monomial, list[fmpz_mpoly]] = {}
                for monomial in self._monomials(room):
                    if any(
                        all(a >= b for a, b in zip(monomial, leading)) for leading in self.leading
                    ):
                        continue  # modulo the equations it is a combination of others
                    parts.setdefault(self._class(monomial), []).append(
                        self.ring.ctx.from_dict({monomial: 1})
                    )
                for basis in parts.values():
                    yield FactBlock(poly, False, basis, powers_of(chosen))
                if all(facts[k].strict for k in chosen):
                    yield FactBlock(poly, True, [self.ring.one], powers_of(chosen))
                if number == 1 and facts[chosen[0]].strict:
                    for power in range(2, self.degree // max(1, total_degree(poly)) + 1):
                        factors = ((chosen[0], power),)
                        yield FactBlock(poly**power, True, [self.ring.one], factors)


def pruned(blocks: list[FactBlock], cofactors: Sequence[fmpz_mpoly]) -> list[FactBlock]:
    """The blocks without squares that nothing can cancel: of a monomial that only squares reach,
    and all with one sign.
    """
    if not blocks:
        return []
    degrees = [b.poly.total_degree() + 2 * max(map(total_degree, b.basis)) for b in blocks]
    base = 1 + max([*degrees, *(poly.total_degree() for poly in cofactors)])
    size = len(blocks[0].poly.degrees())
    kind: type = np.int64 if base**size < 2**62 else object
    weights = [base**v for v in range(size)]

    def keys(polys: Sequence[fmpz_mpoly]) -> NDArray[Any]:  # of Python's integers, where large
        """The monomials as numbers that add as exponents do."""
        monomials = (m for poly in polys for m in poly.monoms())
        return np.array([sum(int(e) * w for e, w in zip(m, weights)) for m in monomials], kind)

    terms = [keys([block.poly]) for block in blocks]
    signs = [np.array([int(c) > 0 for c in block.poly.coeffs()]) for block in blocks]
    roots = [keys(block.basis) for block in blocks]
    owed = keys(cofactors)
    alive = [np.ones(len(one), dtype=bool) for one in roots]
    fixed: list[NDArray[Any]] = [
        owed[:0] for _ in blocks
    ]  # what squares of each cannot reach alone
    changed = set(range(len(blocks)))
    while True:
        squares, positive, owners = [], [], []
        for k, (term, sign) in enumerate(zip(terms, signs)):
            root = roots[k][alive[k]]
            if k in changed and len(roots[k]) > 1:
                pairs = np.unique((root[:, None] + root)[np.triu_indices(len(root), 1)])
                fixed[k] = np.unique(pairs[:, None] + term)
            squares.append((2 * root[:, None] + term).ravel())
            positive.append(np.tile(sign, len(root)))
            places = np.flatnonzero(alive[k])
            owners += [(k, i) for i in places for _ in term]
        whole, where = np.unique(np.concatenate(squares), return_inverse=True)
        above = np.zeros(len(whole), dtype=int)
        np.add.at(above, where, np.concatenate(positive))
        one_sign = (above == 0) | (above == np.bincount(where, minlength=len(whole)))
        dead = (one_sign & ~np.isin(whole, np.concatenate([owed, *fixed])))[where]
        if not dead.any():
            break
        changed = set()
        for place in np.flatnonzero(dead):
            k, i = owners[place]
            alive[k][i] = False
            changed.add(k)
    for block, kept in zip(blocks, alive):
        block.basis = [b for b, is_kept in zip(block.basis, kept) if is_kept]
    return [block for block in blocks if block.basis]
