"""Sums of squares: one SDP, one rounding, one LDL^T."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations_with_replacement
from itertools import product as choices
from math import comb, lcm, prod
from typing import Any, Protocol

import numpy as np
from flint import fmpz_mat, fmpz_mpoly, nmod_mat

from juggleproof.certificates.algebra.polynomials import total_degree
from juggleproof.certificates.algebra.semidefinite import (
    Block,
    Floats,
    Matrix,
    Polynomial,
    as_squares,
    feasible,
    inner,
    product,
    rational_image,
    rounded,
    squares,
)
from juggleproof.certificates.search.facts import Factors
from juggleproof.certificates.search.linear import lift, powers_of
from juggleproof.certificates.search.problem import Problem
from juggleproof.certificates.search.small_boxes import Box, Exponents, Terms
from juggleproof.certificates.work import Budget

# -------------------------------------------------------------------------------------------------
# The linear equations on the entries of Gram matrices: solved in floats, rounded, and met
# exactly.

Monomial = tuple[int, ...]
Entry = tuple[int, int, int]  # block, row, column
PRIME = (1 << 61) - 1


class Sized(Protocol):
    """What the equations need of a block: its product, whether it is strict, and its basis."""

    poly: fmpz_mpoly
    strict: bool
    basis: list[fmpz_mpoly]


class LinearEquations:
    """The equations on the entries of the blocks' Gram matrices, and on the multiples of the
    cofactors.

    There is one for each monomial, and one that sets the sum of the strict terms to 1.
    """

    def __init__(self, blocks: Sequence[Sized], cofactors: Sequence[fmpz_mpoly]) -> None:
        self.blocks, more = blocks, list(cofactors)
        self.entries = [
            (k, i, j)
            for k, block in enumerate(blocks)
            for i in range(len(block.basis))
            for j in range(i + 1)
        ]
        polys = [
            blocks[k].poly * blocks[k].basis[i] * blocks[k].basis[j] * (1 if i == j else 2)
            for k, i, j in self.entries
        ]
        self.count = len(polys)
        rows: dict[Monomial, int] = {}
        self.terms: list[dict[int, int]] = []
        for poly in (*polys, *more):
            self.terms.append(
                {
                    rows.setdefault(m, len(rows)): int(c)
                    for m, c in zip(poly.monoms(), poly.coeffs())
                }
            )
        self.rows = len(rows) + 1
        self.multipliers = [0.0] * len(more)  # of the equations, in floats, when it has been solved
        for (k, _, _), column in zip(self.entries, self.terms):
            if blocks[k].strict:
                column[len(rows)] = 1
        self.size = self.rows * sum(len(block.basis) ** 2 for block in blocks)

    def solve(self, budget: Budget, trace: float, last: float) -> list[Floats] | None:
        """Gram matrices in floats."""
        blocks = [
            np.zeros((self.rows, len(block.basis), len(block.basis))) for block in self.blocks
        ]
        for (k, i, j), column in zip(self.entries, self.terms):
            scale = self.scale(k)
            for row, c in column.items():
                blocks[k][row, i, j] += c / scale / (1 if i == j else 2)
                if i != j:
                    blocks[k][row, j, i] += c / scale / 2
        free = np.zeros((self.rows, len(self.terms) - self.count))
        for at, column in enumerate(self.terms[self.count :]):
            size = max(map(abs, column.values()))
            for row, c in column.items():
                free[row, at] = c / size
        right = np.zeros(self.rows)
        right[-1] = 1.0
        found = feasible(blocks, free, right, budget, trace, last)
        if found is None:
            return None
        if free.shape[1]:
            rest = right - sum(
                (block.reshape(self.rows, -1) @ gram.ravel() for block, gram in zip(blocks, found)),
                np.zeros(self.rows),
            )
            sizes = [max(map(abs, column.values())) for column in self.terms[self.count :]]
            self.multipliers = (np.linalg.lstsq(free, rest, rcond=None)[0] / sizes).tolist()
        return [gram / self.scale(k) for k, gram in enumerate(found)]

    def scale(self, block: int) -> float:
        """The largest coefficient of a block's product; strict ones are not scaled, so that their
        sum is 1.
        """
        one = self.blocks[block]
        return 1.0 if one.strict else float(max(abs(int(c)) for c in one.poly.coeffs()))

    def rounded(
        self, grams: list[Floats], denominator: int
    ) -> tuple[dict[Entry, Fraction], list[Fraction]] | None:
        """Exact entries near the floating ones that meet all equations, and multipliers of the
        equations; None where there are none.

        The entries are rounded, and corrected by the shortest vector in their columns that makes up
        for what is missing.
        """
        start = [
            Fraction(round(float(grams[k][i, j]) * denominator), denominator)
            for k, i, j in self.entries
        ]
        start += [Fraction(round(m * denominator), denominator) for m in self.multipliers]
        missing = [Fraction(0)] * self.rows
        missing[-1] = Fraction(1)
        for value, column in zip(start, self.terms):
            for row, c in column.items() if value else ():
                missing[row] -= c * value
        if any(missing):
            correction = self.correction(missing)
            if correction is None:
                return None
            start = [a + b for a, b in zip(start, correction)]
        return dict(zip(self.entries, start)), start[self.count :]

    def correction(self, missing: list[Fraction]) -> list[Fraction] | None:
        """The shortest vector whose combination of the columns is what is missing."""
        pivots, kept, square = self.independent
        scale = lcm(*(m.denominator for m in missing))
        try:
            above, below = _solved(
                square, fmpz_mat([[int(missing[row] * scale)] for row in pivots])
            )
        except ZeroDivisionError:
            return None
        result = kept.transpose() * above
        found = [Fraction(int(result[k, 0]), below * scale) for k in range(len(self.terms))]
        left = list(missing)
        for value, column in zip(found, self.terms):
            for row, c in column.items() if value else ():
                left[row] -= c * value
        return None if any(left) else found

    @cached_property
    def independent(self) -> tuple[list[int], fmpz_mat, fmpz_mat]:
        """Rows of which no one follows from the others, the matrix of these, and it times its
        transpose.
        """
        table = [[0] * len(self.terms) for _ in range(self.rows)]
        for at, column in enumerate(self.terms):
            for row, c in column.items():
                table[row][at] = c
        reduced, rank = nmod_mat(fmpz_mat(table).transpose(), PRIME).rref()
        pivots, at = list[int](), 0
        for row in range(rank):
            while not int(reduced[row, at]):
                at += 1
            pivots.append(at)
        kept = fmpz_mat([table[row] for row in pivots])
        return pivots, kept, kept * kept.transpose()


def _solved(matrix: fmpz_mat, right: fmpz_mat) -> tuple[fmpz_mat, int]:
    """(n, d) with matrix * n = d * right."""
    solution = matrix.solve(right)
    common = lcm(*(int(solution[k, 0].q) for k in range(solution.nrows())))
    return fmpz_mat([[int(solution[k, 0] * common)] for k in range(solution.nrows())]), common


# -------------------------------------------------------------------------------------------------
# Coordinates around a point in which a polynomial that is least there shows where its Hessian is
# singular; exact.

LinearForm = list[Fraction]


def unit(size: int, i: int) -> Exponents:
    """The exponents of the i-th variable."""
    return tuple(int(k == i) for k in range(size))


def substituted(terms: Terms, values: Sequence[Polynomial]) -> Polynomial:
    """The polynomial with a polynomial in place of each variable."""
    total: Polynomial = {}
    powers: dict[tuple[int, int], Polynomial] = {}
    for exponents, c in terms.items():
        part: Polynomial = {(0,) * len(values): c}
        for i, e in enumerate(exponents):
            if e and (i, e) not in powers:
                power = values[i]
                for _ in range(e - 1):
                    power = product(power, values[i])
                powers[i, e] = power
            part = product(part, powers[i, e]) if e else part
        for monomial, value in part.items():
            total[monomial] = total.get(monomial, Fraction(0)) + value
    return {e: c for e, c in total.items() if c}


def adapted_forms(
    p: Polynomial, free: Sequence[int], size: int
) -> tuple[list[LinearForm], list[int]]:
    """Linear forms that serve as coordinates, and the numbers of those that only complete the range
    of the Hessian of the free variables.
    """
    units = [[Fraction(int(i == k)) for k in range(size)] for i in range(size)]
    rows = [
        [_second(p, i, j, size) if j in free else Fraction(0) for j in range(size)] for i in free
    ]
    if _rank(rows) == len(free):
        return units, []
    forms: list[LinearForm] = []
    kernel: list[int] = []
    for k, row in enumerate([*rows, *units]):
        if _rank([*forms, row]) > len(forms):
            if k >= len(rows) and k - len(rows) in free:
                kernel.append(len(forms))
            scale = next(c for c in row if c)
            forms.append([c / scale for c in row])
    return forms, kernel


def _second(p: Polynomial, i: int, j: int, size: int) -> Fraction:
    exponents = tuple(a + b for a, b in zip(unit(size, i), unit(size, j)))
    return p.get(exponents, Fraction(0)) * (2 if i == j else 1)


def _rank(rows: Sequence[LinearForm]) -> int:
    rest, rank = [list(row) for row in rows], 0
    for k in range(len(rest[0]) if rest else 0):
        pivot = next((i for i in range(rank, len(rest)) if rest[i][k]), None)
        if pivot is not None:
            rest[rank], rest[pivot] = rest[pivot], rest[rank]
            for i in range(rank + 1, len(rest)):
                rest[i] = [x - rest[i][k] / rest[rank][k] * y for x, y in zip(rest[i], rest[rank])]
            rank += 1
    return rank


def inverse(rows: Sequence[LinearForm]) -> list[LinearForm]:
    """The inverse of a matrix that has one, by elimination."""
    size = len(rows)
    rest = [[*row, *(Fraction(int(i == k)) for k in range(size))] for i, row in enumerate(rows)]
    for k in range(size):
        pivot = next(i for i in range(k, size) if rest[i][k])
        rest[k], rest[pivot] = rest[pivot], rest[k]
        rest[k] = [c / rest[k][k] for c in rest[k]]
        for i in range(size):
            if i != k and rest[i][k]:
                rest[i] = [x - rest[i][k] * y for x, y in zip(rest[i], rest[k])]
    return [row[size:] for row in rest]


# -------------------------------------------------------------------------------------------------
# p - p(x*) as squares plus products of squares with the sides of a box, by Gram matrices: proofs
# where halving boxes leads nowhere.
#
# p is written in coordinates around the point x*, where every summand vanishes: so a square has no
# constant, and where the Hessian is singular, no linear part along its kernel.  Without these two
# steps no matrix is definite, and none could be rounded.  What is more degenerate is not found.
# With
# a gap, p - p(x*) + gap, squares have constants, scaled by the root of the gap, and x* need only be
# near the minimum. Source: Putinar, Positive polynomials on compact semialgebraic sets (1993);
# Peyrl
# and Parrilo, Theoretical Computer Science 409 (2008).

MOST_VARIABLES, MOST_BASIS = 6, 28
FactorLists = list[list[int]]  # of a product: facts with exponents


class Around:
    """A polynomial around a point of a box: the part of a sum of squares that is to be found, block
    by block.
    """

    def __init__(
        self,
        terms: Terms,
        box: Box,
        point: Sequence[Fraction],
        facts: list[list[int]],
        gap: Fraction,
    ) -> None:
        self.gap = gap
        self.size, self.box, self.point, self.facts = len(box), box, point, facts
        self.one = (0,) * self.size
        self.half = (max(map(sum, terms)) + 1) // 2
        shifted = substituted(
            terms, [{unit(self.size, i): Fraction(1), self.one: at} for i, at in enumerate(point)]
        )
        shifted.pop(self.one, None)
        if gap:
            shifted[self.one] = gap
        self.slopes = [shifted.get(unit(self.size, i), Fraction(0)) for i in range(self.size)]
        self.forms, kernel = adapted_forms(
            shifted, [i for i, slope in enumerate(self.slopes) if not slope and not gap], self.size
        )
        self.steps = inverse(self.forms)  # x - x* in the coordinates
        self.p = substituted(shifted, [self._linear(step) for step in self.steps])
        self.lines = [unit(self.size, k) for k in range(self.size) if k not in kernel]
        self.blocks: list[Block] = []
        self.factors: list[FactorLists] = []
        self.held: list[int] = []  # the blocks of sides where the point is held
        self._add(
            {self.one: Fraction(1)},
            [],
            [*([self.one] if gap else []), *self.lines, *self._monomials(2, self.half)],
        )
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

    def _linear(self, coefficients: LinearForm, constant: Fraction = Fraction(0)) -> Polynomial:
        parts = {unit(self.size, k): c for k, c in enumerate(coefficients) if c}
        return {**parts, self.one: constant} if constant else parts

    def _monomials(self, first: int, last: int) -> list[Exponents]:
        return [
            tuple(sum(k == i for k in chosen) for i in range(self.size))
            for degree in range(first, last + 1)
            for chosen in combinations_with_replacement(range(self.size), degree)
        ]

    def _add(self, multiplier: Polynomial, factors: FactorLists, basis: list[Exponents]) -> None:
        small = _dyadic_root(self.gap) if self.gap else Fraction(1)
        self.blocks.append(
            Block(
                multiplier,
                tuple(basis),
                tuple(small if monomial == self.one else Fraction(1) for monomial in basis),
            )
        )
        self.factors.append(factors)

    def _add_sides(self, i: int, low: Fraction, high: Fraction) -> None:
        """Squares times (x - low)(high - x), and times the one side where the point is held."""
        above = self._linear(self.steps[i], self.point[i] - low)
        below = self._linear([-c for c in self.steps[i]], high - self.point[i])
        first, last = self.facts[i]
        rest = [*self.lines, *self._monomials(2, self.half - 1)] if self.half > 1 else []
        held = self.slopes[i] and self.point[i] == (low if self.slopes[i] > 0 else high)
        constant = [self.one] if held or self.gap else []
        if constant or rest:
            self._add(product(above, below), [[first, 1], [last, 1]], [*constant, *rest])
        if held:
            self.held.append(len(self.blocks))
            side, fact = (above, first) if self.slopes[i] > 0 else (below, last)
            self._add(side, [[fact, 1]], [self.one, *rest])

    def grams(self) -> list[Matrix] | None:
        """Exact positive definite matrices whose sum is p, where some are found."""
        try:
            found = inner(self.p, self.blocks)
            return None if found is None else rounded(self.p, self.blocks, found, self.held)
        except np.linalg.LinAlgError:
            return None

    def coordinates(self, names: Sequence[str]) -> list[str]:
        """The coordinates as text in the variables."""
        moved = [
            f"({name} {'-' if at > 0 else '+'} {abs(at)})" if at else name
            for name, at in zip(names, self.point)
        ]
        texts = [_text(self._linear(form), moved) for form in self.forms]
        return [text if text in moved else f"({text})" for text in texts]


def search_squares(
    terms: Terms,
    box: Box,
    point: Sequence[Fraction],
    names: Sequence[str],
    facts: list[list[int]],
    goal: int,
    gap: Fraction = Fraction(0),
) -> list[Any] | None:
    """A Positivstellensatz node that closes fact `goal`, p(x*) - gap - p > 0; None where none is
    found.

    `facts` numbers what says low <= x and x <= high, for each variable.
    """
    around = Around(terms, box, point, facts, gap) if len(box) <= MOST_VARIABLES else None
    if around is None or not around.is_stationary() or len(around.blocks[0].basis) > MOST_BASIS:
        return None
    grams = around.grams()
    if grams is None:
        return None
    coordinates, products = around.coordinates(names), [[1, [[goal, 1]], "1"]]
    for block, factors, gram in zip(around.blocks, around.factors, grams):
        for weight, row in squares(gram) or []:
            root = {
                monomial: c * scale
                for monomial, c, scale in zip(block.basis, row, block.scales)
                if c
            }
            products.append([str(weight), factors, _text(root, coordinates)])
    return ["psatz", products, []]


def _dyadic_root(value: Fraction) -> Fraction:
    """A power of 2 near the square root."""
    return Fraction(2) ** ((value.numerator.bit_length() - value.denominator.bit_length()) // 2)


def _text(p: Polynomial, coordinates: Sequence[str]) -> str:
    parts = []
    for exponents, c in p.items():
        factors = [
            text if e == 1 else f"{text}^{e}" for text, e in zip(coordinates, exponents) if e
        ]
        parts.append("*".join([*([str(c)] if c != 1 or not factors else []), *factors]))
    return " + ".join(parts).replace("+ -", "- ")


# -------------------------------------------------------------------------------------------------
# Positive combinations with sums of squares as multipliers: sum s_k * product of facts + sum m_j *
# equation = 0, every s_k a sum of squares.
#
# A semidefinite program in floats hints at Gram matrices (Parrilo 2000).  Where they are singular,
# as
# at every point of equality, their kernel is read off as rationals and the squares are confined to
# its complement, so that what is left can be rounded (Peyrl and Parrilo 2008; Monniaux and
# Corbineau
# 2011).  The result is exact, and the checker confirms it.

Node = list[Any]
Solved = tuple[LinearEquations, list[Floats]]
MOST_ENTRIES = 2_000_000
MOST_FOR_PAIRS = 12  # facts
MOST_BITS = 6000  # of a coefficient
MOST_MONOMIALS = 70  # in one block
DENOMINATORS = (1, 2, 12, 60, 1 << 8, 1 << 14, 1 << 20, 1 << 28)
ROUNDS = 6
GOALS = (
    (1e-4, 1e-9),
    (1e-5, 1e-8),
    (1e-6, 1e-7),
)  # what the trace costs, and where to stop: from simple solutions to the middle of all
KERNELS = (1e-3, 1e-5, 1e-2, 1e-7)


@dataclass
class GramBlock:
    """A product of facts that is multiplied by a sum of squares of combinations of the basis."""

    factors: Factors
    poly: fmpz_mpoly
    strict: bool
    basis: list[fmpz_mpoly]


class Squares:
    """One program: the blocks, and the equations with the monomials that multiply them."""

    def __init__(
        self, problem: Problem, count: int, degree: int, only: Sequence[int], budget: Budget
    ) -> None:
        self.problem, self.ring, self.degree, self.only = problem, problem.ring, degree, only
        polys = [
            *(equation.poly for equation in problem.reduction.left),
            *(problem.facts[k].poly for k in only),
        ]
        self.used = [v for v in range(self.ring.size) if any(p.degrees()[v] for p in polys)]
        self.flips = self._flips(polys)
        self.leading = [equation.poly.monoms()[0] for equation in problem.reduction.basis()]
        self.blocks = list(self._blocks(count, budget))
        self.cofactors = [
            (place, monomial)
            for place, equation in enumerate(problem.reduction.left)
            for monomial in self._monomials(degree - total_degree(equation.poly))
            if self._class(monomial) == self._class(equation.poly.monoms()[0])
        ]
        products = sum(len(block.basis) ** 2 * len(block.poly) for block in self.blocks) // 2
        if products > MOST_ENTRIES:
            self.blocks = []
        budget.spend(products // 4)
        self._prune()

    # ------------------------------------------------------------ what is in the program

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

    def _blocks(self, count: int, budget: Budget) -> Iterator[GramBlock]:
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
                    yield GramBlock(powers_of(chosen), poly, False, basis)
                if all(facts[k].strict for k in chosen):
                    yield GramBlock(powers_of(chosen), poly, True, [self.ring.one])
                if number == 1 and facts[chosen[0]].strict:
                    for power in range(2, self.degree // max(1, total_degree(poly)) + 1):
                        yield GramBlock(((chosen[0], power),), poly**power, True, [self.ring.one])

    def _prune(self) -> None:
        """Drops squares that nothing can cancel: of a monomial that only squares reach, and all
        with one sign.
        """
        while True:
            fixed, signs = set[Monomial](), dict[Monomial, set[int]]()
            owners: dict[Monomial, list[tuple[int, int]]] = {}
            for place, monomial in self.cofactors:
                fixed |= {
                    tuple(int(a) + b for a, b in zip(m, monomial))
                    for m in self.problem.reduction.left[place].poly.monoms()
                }
            for k, block in enumerate(self.blocks):
                exponents = [tuple(map(int, b.monoms()[0])) for b in block.basis]
                terms = [
                    (tuple(map(int, m)), 1 if int(c) > 0 else -1)
                    for m, c in zip(block.poly.monoms(), block.poly.coeffs())
                ]
                for i, one in enumerate(exponents):
                    for j in range(i + 1):
                        for m, sign in terms:
                            whole = tuple(map(sum, zip(one, exponents[j], m)))
                            if i != j:
                                fixed.add(whole)
                            else:
                                signs.setdefault(whole, set()).add(sign)
                                owners.setdefault(whole, []).append((k, i))
            dead = {
                place
                for whole, found in signs.items()
                if len(found) == 1 and whole not in fixed
                for place in owners[whole]
            }
            if not dead:
                break
            for k, block in enumerate(self.blocks):
                block.basis = [b for i, b in enumerate(block.basis) if (k, i) not in dead]
            self.blocks = [block for block in self.blocks if block.basis]

    # ------------------------------------------------------------ solutions

    def node(self, budget: Budget) -> Node | None:
        """The node of an identity that the program leads to."""
        blocks = self.blocks
        for goal in GOALS:
            self.blocks, tried = blocks, set[tuple[int, ...]]()
            first = self._solved(budget, goal)
            node = self._rounded(*first, DENOMINATORS[:4], budget) if first else None
            if node is not None or not first and goal == GOALS[0]:
                return node
            for threshold in KERNELS if first else ():
                node = self._followed(blocks, first, threshold, goal, tried, budget)
                if node is not None:
                    return node
        return None

    def _followed(
        self,
        blocks: list[GramBlock],
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
        for _ in range(ROUNDS):
            confined = self._confined(solved[1], threshold) if solved else []
            sizes = tuple(len(block.basis) for block in confined)
            if not solved or not any(block.strict for block in confined):
                return None
            if sizes == tuple(len(block.basis) for block in self.blocks):
                return self._rounded(*solved, DENOMINATORS, budget)
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
            or max(len(block.basis) for block in self.blocks) > MOST_MONOMIALS
        ):
            return None
        left = self.problem.reduction.left
        linear = LinearEquations(
            self.blocks,
            [left[place].poly * self.ring.ctx.from_dict({m: 1}) for place, m in self.cofactors],
        )
        return linear if linear.size <= MOST_ENTRIES else None

    def _confined(self, grams: list[Floats], threshold: float) -> list[GramBlock]:
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
                kept.append(GramBlock(block.factors, block.poly, block.strict, basis))
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
            exact = linear.rounded(grams, denominator)
            node = None if exact is None else self._lifted(*exact)
            if node is not None:
                return node
        return None

    def _lifted(self, entries: dict[Entry, Fraction], multipliers: list[Fraction]) -> Node | None:
        """The node of exact Gram matrices, if all of them are positive semidefinite."""
        used: list[tuple[tuple[Factors, int], Fraction]] = []
        roots: list[fmpz_mpoly] = []
        for k, block in enumerate(self.blocks):
            size = len(block.basis)
            gram = [[entries[(k, max(i, j), min(i, j))] for j in range(size)] for i in range(size)]
            squares = as_squares(gram)
            if squares is None or any(
                c.bit_length() > MOST_BITS
                for weight, row in squares
                for c in (*weight.as_integer_ratio(), *row)
            ):
                return None
            for weight, row in squares:
                root = sum((b * int(c) for b, c in zip(block.basis, row) if c), self.ring.zero)
                if root == self.ring.one:
                    used.append(((block.factors, -1), weight))
                else:
                    used.append(((block.factors, len(roots)), weight))
                    roots.append(root)
        cofactors = [(one, c) for one, c in zip(self.cofactors, multipliers) if c]
        try:
            return lift(self.problem, used, cofactors, roots)
        except ValueError:  # a number too long to be written
            return None


# (facts in a product at most, degree beyond that of the facts, whether bounds and signs of single
# variables are left out)
STAGES = (
    (1, 0, True),
    (1, 0, False),
    (2, 0, False),
    (1, 2, True),
    (1, 2, False),
    (2, 2, False),
    (1, 4, True),
    (1, 4, False),
)


def search_squares_of_facts(
    problem: Problem, budget: Budget, stages: Sequence[tuple[int, int, bool]] = STAGES
) -> Node | None:
    """The node of the first program that leads to an identity.

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
            and len(only) > MOST_FOR_PAIRS
        ):
            continue
        node = Squares(problem, count, top + top % 2 + more, only, budget).node(budget)
        if node is not None:
            return node
    return None
