"""Quadratic forms with parameters in a box: products of the parameters' bounds times squares of
linear forms.

A goal Q(p, z) >= 0, of degree 2 in z, is Q = sum_k B_k(p) Q_k(z) with the Bernstein polynomials B_k
of a box of parameters p.  Where each Q_k is a sum of squares and of products of facts that are
linear in z, this is one `psatz` node; else the degree is raised.

Sources: Farouki, The Bernstein polynomial basis, Computer Aided Geometric Design 29 (2012);
products of linear facts are the S-procedure: Johansson and Rantzer, Computation of piecewise
quadratic Lyapunov functions for hybrid systems, IEEE Trans. Automatic Control 43 (1998).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from math import gcd, lcm, prod

import numpy as np
from flint import fmpq_poly, fmpz_mpoly

from juggleproof.algebra.polynomials import (
    Monomial,
    Ring,
    constant_of,
    degree_in,
    total_degree,
)
from juggleproof.algebra.semidefinite import Floats, LinearEquations, as_squares
from juggleproof.search import limits
from juggleproof.search.psatz.facts import Axis, merge
from juggleproof.search.psatz.lifting import lift
from juggleproof.search.psatz.parameters import (
    bounds,
    degree_in_all,
    split_variables,
)
from juggleproof.search.psatz.problem import LeafProblem
from juggleproof.search.psatz.sums_of_squares import (
    FactBlock,
    Square,
    SquaresProgram,
)
from juggleproof.statements.nodes import Node
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted

Form = dict[Monomial, Fraction]  # exponents of all variables: coefficient
Found = tuple[list[Square], list[fmpz_mpoly]]  # with the roots


@dataclass(frozen=True)
class Guard:
    """A fact as a form in z: number, polynomial = scale * fact, whether all its terms are of one
    degree in z.
    """

    fact: int
    poly: fmpz_mpoly
    scale: Fraction
    homogeneous: bool


class QuadraticForm:
    """A strict fact -Q > 0 of a problem, Q of degree 2 in z, and the facts that may bound z.

    An equation 1 = u, where u is linear in z, makes forms of what has lower degree: 1 stands for u.
    """

    def __init__(self, problem: LeafProblem, goal: int) -> None:
        self.problem, self.ring, self.goal = problem, problem.ring, goal
        self.bounds = bounds(problem)
        self.unit: tuple[fmpz_mpoly, int] | None = None
        self.parameters, self.others = list[int](), list[int]()
        self.fits = False
        found = split_variables(problem, problem.facts[goal].poly, self.bounds)
        if found is None:
            return
        self.parameters, self.others = found
        self._find_unit()
        self.form = self._guard(goal)
        self.fits = degree_in_all(self.form.poly, self.others) in (1, 2)
        self.own = self._used(self.form)
        self.guards: dict[int, list[Guard]] = {1: [], 2: []}  # by their degrees in z
        for k in range(len(problem.facts)):
            one = self._guard(k)
            height = degree_in_all(one.poly, self.others)
            if k != goal and height in self.guards:
                self.guards[height].append(one)

    def _find_unit(self) -> None:
        """Finds the equation left that gives 1 as what is linear in z."""
        for equation in self.problem.reduction.left:
            parts = self._by_height(equation.poly)
            constant = constant_of(parts.get(0, self.ring.zero))
            if set(parts) == {0, 1} and constant:
                sign = -1 if constant > 0 else 1
                self.unit = parts[1] * sign, abs(constant)
                return

    def _by_height(self, poly: fmpz_mpoly) -> dict[int, fmpz_mpoly]:
        """The terms by their degrees in z."""
        parts: dict[int, dict[Monomial, int]] = {}
        for m, c in zip(poly.monoms(), poly.coeffs()):
            parts.setdefault(sum(int(m[v]) for v in self.others), {})[tuple(map(int, m))] = int(c)
        return {height: self.ring.ctx.from_dict(part) for height, part in parts.items()}

    def _homogeneous(self, poly: fmpz_mpoly) -> tuple[fmpz_mpoly, int]:
        """(p, c), p = c * poly modulo the equation that gives 1."""
        if self.unit is None:
            return poly, 1
        parts, (unit, constant) = self._by_height(poly), self.unit
        top = max(parts, default=0)
        terms = (p * unit ** (top - h) * constant**h for h, p in parts.items())
        return sum(terms, self.ring.zero), constant**top

    def _guard(self, k: int) -> Guard:
        poly, scale = self._homogeneous(self.problem.facts[k].poly)
        return Guard(k, poly, Fraction(scale), len(self._by_height(poly)) == 1)

    # -------------------------------------------------------- nodes

    def node(self, budget: Budget) -> Node | None:
        """The node of the whole box."""
        if not self.fits:
            return None
        for linear, quadratic in self._choices():
            node = self._apart(linear, quadratic, budget)
            if node is not None:
                return node
        return None

    def _choices(self) -> Iterator[tuple[list[Guard], list[Guard]]]:
        """Facts of degree 1 and 2 in z, free of parameters: forms alone, then all; where they are
        many, those in the goal's variables.
        """
        for forms in (True, False) if self.form.homogeneous else (False,):
            for alone in (False, True):
                linear, quadratic = (
                    [
                        one
                        for one in self.guards[height]
                        if not (forms and not one.homogeneous)
                        and not (alone and self._used(one) - self.own)
                        and not self._used(one) & set(self.parameters)
                    ]
                    for height in (1, 2)
                )
                if len(linear) + len(quadratic) <= limits.FORM_GUARDS:
                    yield linear, quadratic
                    break

    @staticmethod
    def _used(one: Guard) -> set[int]:
        return {v for v, d in enumerate(one.poly.degrees()) if d}

    def _axes(self, polys: Sequence[fmpz_mpoly]) -> list[Axis]:
        """The axes of the parameters that occur."""
        used = [v for v in self.parameters if any(degree_in(p, v) for p in polys)]
        return [self.bounds[v] for v in used]

    def _basis(self, polys: Sequence[fmpz_mpoly], affine: bool) -> list[fmpz_mpoly]:
        """The variables z that occur, and 1 where not everything is a form."""
        used = [v for v in self.others if any(degree_in(p, v) for p in polys)]
        return [*([self.ring.one] if affine else []), *(self.ring.gens[v] for v in used)]

    # -------------------------------------------------------- each Bernstein coefficient apart

    def _apart(self, linear: list[Guard], quadratic: list[Guard], budget: Budget) -> Node | None:
        """The node that has squares, and products of facts without parameters, for every
        coefficient.
        """
        whole = [self.form, *linear, *quadratic]
        axes = self._axes([self.form.poly])
        basis = self._basis([g.poly for g in whole], not all(g.homogeneous for g in whole))
        blocks = list(self._products(linear, quadratic))
        for more in range(limits.FORM_RAISED + 1):
            degrees = [degree_in(self.form.poly, axis.variable) + more for axis in axes]
            count = prod(n + 1 for n in degrees)
            if more and not axes or count > limits.FORM_PARTS:
                break
            budget.spend(count * len(basis))
            found, at_vertex = self._each(
                terms_of(self.form.poly, Fraction(-1)),
                axes,
                degrees,
                lambda form: (
                    self._squares(form, basis) or self._guarded(form, basis, blocks, budget)
                ),
            )
            if found is not None:
                used = [((((self.goal, 1),), -1), self.form.scale), *found[0]]
                return lift(self.problem, used, [], found[1])
            if at_vertex:
                return None
        return None

    def _each(
        self,
        form: Form,
        axes: Sequence[Axis],
        degrees: Sequence[int],
        squares: Callable[[Form], Found | None],
    ) -> tuple[Found | None, bool]:
        """All Bernstein coefficients of a form as squares; without them, whether one at a vertex
        has none.
        """
        used, roots = list[Square](), list[fmpz_mpoly]()
        parts = self._parts(form, axes, degrees)
        for place in sorted(parts, key=lambda p: not is_vertex(p, degrees)):
            found = squares(parts[place])
            if found is None:
                return None, is_vertex(place, degrees)
            factors = merge(*(a.factors(k, n) for a, k, n in zip(axes, place, degrees)))
            for (own, root), weight in found[0]:
                number = len(roots) + root if root >= 0 else -1
                used.append(((merge(own, factors), number), weight))
            roots += found[1]
        return (used, roots), False

    def _parts(
        self, terms: Form, axes: Sequence[Axis], degrees: Sequence[int]
    ) -> dict[tuple[int, ...], Form]:
        """Q_k of Q = sum_k Q_k * product of powers of the bounds."""
        for axis, degree in zip(axes, degrees):
            v, moved = axis.variable, Form()
            rows = {
                e: axis.coefficients(self.problem.facts, fmpq_poly([0] * e + [1]), degree)
                for e in {m[v] for m in terms}
            }
            for m, c in terms.items():
                for k, value in enumerate(rows[m[v]]):
                    key = (*m[:v], k, *m[v + 1 :])
                    moved[key] = moved.get(key, Fraction(0)) + c * value
            terms = moved
        parts: dict[tuple[int, ...], Form] = {}
        variables = [axis.variable for axis in axes]
        for m, c in terms.items():
            rest = tuple(0 if v in variables else e for v, e in enumerate(m))
            part = parts.setdefault(tuple(m[v] for v in variables), {})
            if c:
                part[rest] = c
        return parts

    def _squares(self, form: Form, basis: Sequence[fmpz_mpoly]) -> Found | None:
        """The form as squares alone, with their roots."""
        exponents = [tuple(map(int, b.monoms()[0])) for b in basis]
        gram = [
            [
                form.get(tuple(map(sum, zip(one, other))), Fraction(0)) / (1 if one == other else 2)
                for other in exponents
            ]
            for one in exponents
        ]
        top = max((abs(c) for row in gram for c in row), default=Fraction(0)) or Fraction(1)
        squares = as_squares([[c / top for c in row] for row in gram])  # which fit into floats
        if squares is None:
            return None
        roots = [
            sum((b * c for b, c in zip(basis, row) if c), self.ring.zero) for _, row in squares
        ]
        return [(((), k), weight * top) for k, (weight, _) in enumerate(squares)], roots

    def _products(self, linear: list[Guard], quadratic: list[Guard]) -> Iterator[FactBlock]:
        """Products of two facts that are linear in z, and facts of degree 2, or of degree 1 where
        there is a constant.
        """
        one = [self.ring.one]
        for g in [*([] if all(g.homogeneous for g in linear) else linear), *quadratic]:
            yield FactBlock(g.poly, False, one, ((g.fact, 1),), g.scale)
        for g, h in combinations(linear, 2):
            factors = merge(((g.fact, 1),), ((h.fact, 1),))
            yield FactBlock(g.poly * h.poly, False, one, factors, g.scale * h.scale)

    def _guarded(
        self,
        form: Form,
        basis: list[fmpz_mpoly],
        blocks: Sequence[FactBlock],
        budget: Budget,
    ) -> Found | None:
        """A form without parameters as squares and products of facts, with the roots."""
        budget.spend(100)
        if not blocks or not form or is_negative(form, basis, blocks):
            return None
        below = lcm(*(c.denominator for c in form.values()))
        whole = {m: int(c * below) for m, c in form.items()}
        content, top = gcd(*whole.values()), max(map(abs, whole.values()))
        poly = self.ring.ctx.from_dict({m: -c // content for m, c in whole.items()})
        size, result = Fraction(top, below), list[Found]()

        def kept(used: list[Square], _: object, roots: list[fmpz_mpoly]) -> Node:
            scaled = [(one, weight * size) for one, weight in used if one[0] != goal.factors]
            result.append((scaled, roots))
            return ("close",)

        goal = FactBlock(poly, True, [self.ring.one], ((self.goal, 1),))
        squares = FactBlock(self.ring.one, False, basis, ())
        total = Fraction(content, top)

        def completed(used: list[Square], left: Form) -> Node | None:
            found = self._squares(left, basis)
            return None if found is None else kept([*used, *found[0]], [], found[1])

        inside = InnerProgram(self.ring, [goal, squares, *blocks], [], kept, total)
        inside.completed = completed
        part = budget.part(limits.COEFFICIENT_WORK)
        try:
            if inside.node(part) is None and inside.solved:
                SquaresProgram(self.ring, inside.blocks, [], kept, total).node(part)
        except Exhausted:
            pass
        return result[0] if result else None


def terms_of(poly: fmpz_mpoly, factor: Fraction) -> Form:
    """A polynomial times a rational, term by term."""
    return {tuple(map(int, m)): int(c) * factor for m, c in zip(poly.monoms(), poly.coeffs())}


def is_negative(form: Form, basis: Sequence[fmpz_mpoly], blocks: Sequence[FactBlock]) -> bool:
    """Whether floats see a point at which no product of facts is negative, but the form is: then no
    program leads to squares.
    """
    exponents = [tuple(map(int, b.monoms()[0])) for b in basis]
    place = {
        tuple(map(sum, zip(exponents[i], exponents[j]))): (i, j)
        for i in range(len(basis))
        for j in range(i + 1)
    }
    random, size = np.random.default_rng(11), (limits.FORM_POINTS, len(basis))
    points = random.normal(size=size) * np.exp(random.normal(size=size))
    points /= np.abs(points).max(axis=1, keepdims=True)
    if basis[0] == 1:
        points[:, 0] = np.abs(points[:, 0])
    kept = np.ones(limits.FORM_POINTS, dtype=bool)
    for terms in (*(terms_of(block.poly, Fraction(1)) for block in blocks), form):
        top, values = max(map(abs, terms.values())), np.zeros(limits.FORM_POINTS)
        for m, c in terms.items():
            i, j = place[m]
            values += float(c / top) * points[:, i] * points[:, j]
        kept &= values >= 0 if terms is not form else values < -limits.FORM_MARGIN
    return bool(kept.any())


@dataclass
class InnerProgram(SquaresProgram):
    """A program whose matrices are all definite: those of the products of facts are numbers, which
    are rounded; the squares, its second block, are `completed` from what these leave.
    """

    goals: Sequence[tuple[float, float]] = limits.FORM_GOALS
    denominators: Sequence[int] = limits.FORM_DENOMINATORS
    kernels: Sequence[float] = ()
    completed: Callable[[list[Square], Form], Node | None] = lambda *_: None
    solved: bool = False  # whether there are floating matrices

    def _rounded(
        self,
        linear: LinearEquations,
        grams: list[Floats],
        denominators: Sequence[int],
        budget: Budget,
    ) -> Node | None:
        """The node of rational numbers near the floating ones, shorter ones first."""
        self.solved = True
        for denominator in denominators:
            budget.spend(50 + len(linear.entries))
            used, left = list[Square](), terms_of(self.blocks[0].poly, -self.total)
            for block, gram, scale in zip(self.blocks[2:], grams[2:], linear.scales[2:]):
                weight = Fraction(round(float(gram[0, 0]) * denominator), denominator) / scale
                if weight < 0:
                    break
                if weight:
                    add(left, block.poly, -weight)
                    used.append(((block.factors, -1), weight * block.scale))
            else:
                node = self.completed(used, left)
                if node is not None:
                    return node
        return None


def add(total: Form, poly: fmpz_mpoly, factor: Fraction) -> None:
    """Adds a polynomial times a rational."""
    for m, c in terms_of(poly, factor).items():
        total[m] = total.get(m, Fraction(0)) + c


def is_vertex(place: Sequence[int], degrees: Sequence[int]) -> bool:
    """Whether a Bernstein coefficient is the value at a vertex of the box."""
    return all(k in (0, n) for k, n in zip(place, degrees))


def search_forms(state: SearchState, ring: Ring, budget: Budget) -> Node | None:
    """A node for a state whose last strict fact is -Q > 0, with a quadratic form Q >= 0 in a box of
    parameters; None where none was found.

    Raises Exhausted where the budget ends.
    """
    if state.closed:
        return ("close",)
    problem = LeafProblem(state, ring, quotients=False)
    problem.divide()
    last = len(problem.facts) - 1
    strict = [
        k
        for k, fact in enumerate(problem.facts)
        if fact.strict and (k == last or total_degree(fact.poly) > 1)
    ]
    return QuadraticForm(problem, strict[-1]).node(budget) if strict else None
