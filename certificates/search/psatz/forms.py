"""Quadratic forms with parameters in a box: products of the parameters' bounds times squares of
linear forms.

A goal Q(p, z) >= 0, of degree 2 in z, is Q = sum_k B_k(p) Q_k(z) with the Bernstein polynomials B_k
of a box of parameters p.  Where each Q_k is a sum of squares and of products of facts that are
linear in z, this is one `psatz` node; else the degree is raised, or the box halved.

Sources: Farouki, The Bernstein polynomial basis, Computer Aided Geometric Design 29 (2012);
products of linear facts are the S-procedure: Johansson and Rantzer, Computation of piecewise
quadratic Lyapunov functions for hybrid systems, IEEE Trans. Automatic Control 43 (1998).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import combinations
from itertools import product as choices
from math import comb, gcd, lcm, prod

from flint import fmpq_poly, fmpz_mpoly

from juggleproof.certificates.algebra.numbers import bernstein, fraction
from juggleproof.certificates.algebra.polynomials import (
    Monomial,
    Ring,
    constant_of,
    degree_in,
    total_degree,
)
from juggleproof.certificates.algebra.semidefinite import Floats, LinearEquations, as_squares
from juggleproof.certificates.nodes import Node
from juggleproof.certificates.search.psatz.facts import Factors, merge
from juggleproof.certificates.search.psatz.lifting import MonomialCofactor, lift
from juggleproof.certificates.search.psatz.problem import Problem
from juggleproof.certificates.search.psatz.sums_of_squares import (
    FactBlock,
    Square,
    SquaresProgram,
    search_squares,
)
from juggleproof.certificates.states import State
from juggleproof.certificates.work import Budget

MOST_PARAMETERS = 8
MOST_PARTS = 100  # Bernstein polynomials of one box
MOST_COUPLED = 40  # the same, where all are parts of one program
MOST_GUARDS = 6  # facts that are linear in z
HALVINGS = 3  # of a box, one inside another
MOST_GOALS = 3
RAISED = 3
FINE = (1, 4, 12, 1 << 6, 1 << 8, 1 << 12, 1 << 18)
INNER = ((1e-4, 1e-5), (1e-6, 1e-6))

Form = dict[Monomial, Fraction]  # exponents of all variables: coefficient
Found = tuple[list[Square], list[fmpz_mpoly]]  # with the roots


@dataclass(frozen=True)
class Axis:
    """A parameter with the numbers of the facts low <= parameter, parameter <= high; one of them
    may be missing.
    """

    variable: int
    low: int | None
    high: int | None

    def factors(self, k: int, degree: int) -> Factors:
        """The k-th of the products of powers of the bounds: a basis of the polynomials of at most
        this degree.
        """
        powers = [(self.low, k), (self.high, degree - k if self.low is not None else k)]
        return tuple((fact, e) for fact, e in powers if fact is not None and e)

    def row(self, problem: Problem, exponent: int, degree: int) -> list[Fraction]:
        """The coefficients of parameter^exponent in this basis."""
        size = {
            fact: abs(constant_of(problem.facts[fact].poly.derivative(self.variable)) or 1)
            for fact in (self.low, self.high)
            if fact is not None
        }
        if self.low is not None and self.high is not None:
            low, high = (problem.facts[k].end(self.variable) for k in (self.low, self.high))
            values = bernstein(fmpq_poly([0] * exponent + [1]), low, high, degree)
            return [
                fraction(b)
                * comb(degree, k)
                / (high - low) ** degree
                / size[self.low] ** k
                / size[self.high] ** (degree - k)
                for k, b in enumerate(values)
            ]
        (fact,) = size
        end, sign = problem.facts[fact].end(self.variable), 1 if self.high is None else -1
        return [
            comb(exponent, k) * end ** (exponent - k) * Fraction(sign, size[fact]) ** k
            if k <= exponent
            else Fraction(0)
            for k in range(degree + 1)
        ]


def bounds(problem: Problem) -> dict[int, Axis]:
    """The variables that facts in them alone bound, with the tightest bounds."""
    low: dict[int, int] = {}
    high: dict[int, int] = {}
    for k, fact in enumerate(problem.facts):
        degrees = [int(d) for d in fact.poly.degrees()]
        if sum(degrees) != 1:
            continue
        v = degrees.index(1)
        above = (constant_of(fact.poly.derivative(v)) or 0) > 0
        side = low if above else high
        if v not in side or (fact.end(v) > problem.facts[side[v]].end(v)) == above:
            side[v] = k
    for v in low.keys() & high.keys():
        if problem.facts[low[v]].end(v) >= problem.facts[high[v]].end(v):
            del high[v]  # one value or none: no interval to write polynomials on
    return {v: Axis(v, low.get(v), high.get(v)) for v in sorted({*low, *high})}


def degree_in_all(poly: fmpz_mpoly, variables: Sequence[int]) -> int:
    """The total degree in some of the variables."""
    return max((sum(int(m[v]) for v in variables) for m in poly.monoms()), default=0)


def split_variables(
    problem: Problem, goal: fmpz_mpoly, axes: dict[int, Axis]
) -> tuple[list[int], list[int]] | None:
    """(parameters, others), so that the goal is of degree 2 at most in the others, if possible of
    degree 2 in each term; None where there are none.
    """
    degrees = [int(d) for d in goal.degrees()]
    used = {v for poly in problem.polys() for v, d in enumerate(poly.degrees()) if d}
    both = {v for v, axis in axes.items() if axis.low is not None and axis.high is not None}
    fixed = [v for v in sorted(used) if not degrees[v] and v in both]
    open_ = [v for v in axes if degrees[v]]
    if len(open_) > 2 * MOST_PARAMETERS:
        return None
    monomials = [[int(e) for e in m] for m in goal.monoms()]
    best: tuple[tuple[int, bool, int], tuple[int, ...]] | None = None
    for count in range(min(len(open_), MOST_PARAMETERS) + 1):
        for chosen in combinations(open_, count):
            rest = [v for v in range(len(degrees)) if v not in chosen]
            heights = {sum(m[v] for v in rest) for m in monomials}
            rank = sum(v not in both for v in chosen), heights != {2}, count
            if max(heights) <= 2 and (best is None or rank < best[0]):
                best = rank, chosen
    if best is None:
        return None
    parameters = sorted({*best[1], *fixed})
    return parameters, [v for v in sorted(used) if v not in parameters]


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

    def __init__(self, problem: Problem, goal: int) -> None:
        self.problem, self.ring, self.goal = problem, problem.ring, goal
        self.halving = ""  # a polynomial in one parameter by whose sign the box is to be halved
        self.bounds = bounds(problem)
        self.unit: tuple[fmpz_mpoly, int] | None = None
        self.parameters, self.others = list[int](), list[int]()
        self.fits = False
        found = split_variables(problem, problem.facts[goal].poly, self.bounds)
        if found is None:
            return
        self.parameters, self.others = found
        self.equations = self._equations()
        self.form = self._guard(goal)
        self.fits = degree_in_all(self.form.poly, self.others) in (1, 2)
        self.own = self._used(self.form)
        self.guards: dict[int, list[Guard]] = {0: [], 1: [], 2: []}  # by their degrees in z
        for k, fact in enumerate(problem.facts):
            one = self._guard(k)
            height = degree_in_all(one.poly, self.others)
            axis = sum(map(int, fact.poly.degrees())) == 1 and not height
            if k != goal and height <= 2 and not axis:
                self.guards[height].append(one)

    def _equations(self) -> list[int]:
        """The places of equations left that are linear in z, without the one that gives 1."""
        kept = []
        for place, equation in enumerate(self.problem.reduction.left):
            parts = self._by_height(equation.poly)
            if set(parts) <= {0, 1} and 1 in parts:
                constant = constant_of(parts.get(0, self.ring.zero))
                if constant and self.unit is None:
                    sign = -1 if constant > 0 else 1
                    self.unit = parts[1] * sign, abs(constant)
                else:
                    kept.append(place)
        return kept

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
        """The node of the whole box; where None was found, `halving` may say how to halve it."""
        if not self.fits:
            return None
        for linear, quadratic in self._choices(True):
            node = self._apart(linear, quadratic, budget)
            if node is not None:
                return node
        for more in range(RAISED):
            for linear, quadratic in self._choices(False):
                node = self._coupled(linear, quadratic, more, budget)
                if node is not None:
                    return node
        return None

    def _choices(self, free: bool) -> Iterator[tuple[list[Guard], list[Guard]]]:
        """Facts of degree 1 and 2 in z, `free` of parameters or all: forms in the goal's variables
        first.
        """
        tried: list[list[int]] = []
        for alone, forms in choices((True, False), (True, False)):
            linear, quadratic = (
                [
                    one
                    for one in self.guards[height]
                    if not (forms and not one.homogeneous)
                    and not (alone and self._used(one) - self.own)
                    and not (free and self._used(one) & set(self.parameters))
                ]
                for height in (1, 2)
            )
            key = [one.fact for one in (*linear, *quadratic)]
            if key not in tried and len(key) <= MOST_GUARDS:
                tried.append(key)
                yield linear, quadratic

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
        for more in range(RAISED + 1):
            degrees = [degree_in(self.form.poly, axis.variable) + more for axis in axes]
            if more and (not axes or prod(n + 1 for n in degrees) > MOST_PARTS):
                break
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
        self.halving = self._halving(axes)
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
            rows = {e: axis.row(self.problem, e, degree) for e in {m[v] for m in terms}}
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
        squares = as_squares(gram)
        if squares is None:
            return None
        roots = [
            sum((b * c for b, c in zip(basis, row) if c), self.ring.zero) for _, row in squares
        ]
        return [(((), k), weight) for k, (weight, _) in enumerate(squares)], roots

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
        budget.spend(20)
        if not blocks or not form:
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

        def completed(used: list[Square], roots: list[fmpz_mpoly], left: Form) -> Node | None:
            found = self._squares(left, basis)
            if found is None:
                return None
            used, roots = joined((used, roots), found)
            return kept(used, [], roots)

        inside = InnerProgram(
            self.ring, [goal, squares, *blocks], [], kept, total, count=1, completed=completed
        )
        search_squares(
            [inside, SquaresProgram(self.ring, [goal, squares, *blocks], [], kept, total)], budget
        )
        return result[0] if result else None

    def _halving(self, axes: Sequence[Axis]) -> str:
        """The middle of the parameter along which Q is bent most."""
        best, text = Fraction(0), ""
        ends = {
            axis.variable: [
                self.problem.facts[k].end(axis.variable)
                for k in (axis.low, axis.high)
                if k is not None
            ]
            for axis in axes
        }
        for v, both in ends.items():
            if len(both) < 2:
                continue
            bend = Fraction(0)
            for m, c in zip(self.form.poly.monoms(), self.form.poly.coeffs()):
                size = prod(max(map(abs, end)) ** int(m[w]) for w, end in ends.items() if w != v)
                size *= max(map(abs, both)) ** max(0, int(m[v]) - 2)
                bend += abs(int(c)) * int(m[v]) * (int(m[v]) - 1) * size
            bend *= (both[1] - both[0]) ** 2
            if bend > best:
                middle = sum(both, Fraction(0)) / 2
                best = bend
                text = f"{middle.denominator}*{self.ring.names[v]} - {middle.numerator}"
        return text.replace("- -", "+ ")

    # -------------------------------------------------------- all coefficients in one program

    def _coupled(
        self, linear: list[Guard], quadratic: list[Guard], more: int, budget: Budget
    ) -> Node | None:
        """The node of a program with facts in which parameters occur."""
        alone = self.guards[0]
        whole = [self.form, *linear, *quadratic]
        if not alone and not self.equations:
            if not any(self._used(g) & set(self.parameters) for g in whole[1:]):
                return None
        products = list(self._products(linear, quadratic))
        axes = self._axes([g.poly for g in (*whole, *alone)])
        polys = [self.form.poly, *(b.poly for b in products), *(g.poly for g in alone)]
        degrees = [max(degree_in(p, a.variable) for p in polys) + more for a in axes]
        if prod(n + 1 for n in degrees) > MOST_COUPLED:
            return None
        one = [self.ring.one]
        basis = self._basis([g.poly for g in whole], not all(g.homogeneous for g in whole))
        goal = FactBlock(self.form.poly, True, one, ((self.goal, 1),), self.form.scale)
        squares = FactBlock(self.ring.one, False, basis, ())
        base = list(self._times_bounds(squares, axes, degrees))
        others = []
        for count in (1, 2):
            for some in combinations(alone, count):
                poly = prod((g.poly for g in some), start=self.ring.one)
                factors = merge(*(((g.fact, 1),) for g in some))
                others.append(FactBlock(poly, False, basis, factors))
        blocks = [goal, *base]
        for block in (*others, *products):
            blocks += self._times_bounds(block, axes, degrees)
        if others:
            gens = (
                [self.ring.gens[a.variable] ** k for k in range(n // 2 + 1)]
                for a, n in zip(axes, degrees)
            )
            bent = [prod(powers, start=z) for *powers, z in choices(*gens, basis)]
            blocks.append(FactBlock(self.ring.one, False, bent, ()))
        cofactors: list[tuple[MonomialCofactor, fmpz_mpoly]] = []
        for place in self.equations:
            poly = self.problem.reduction.left[place].poly
            room = [max(0, n - degree_in(poly, a.variable)) for a, n in zip(axes, degrees)]
            for z in basis if len(self._by_height(poly)) == 1 or self.unit is None else ():
                for powers in choices(*(range(n + 1) for n in room)):
                    parts = (self.ring.gens[a.variable] ** k for a, k in zip(axes, powers))
                    monomial = prod(parts, start=z)
                    exponents = tuple(map(int, monomial.monoms()[0]))
                    cofactors.append(((place, exponents), poly * monomial))
        total = Fraction(1, max(abs(int(c)) for c in self.form.poly.coeffs()))

        def completed(used: list[Square], roots: list[fmpz_mpoly], left: Form) -> Node | None:
            found, _ = self._each(left, axes, degrees, lambda form: self._squares(form, basis))
            if found is None:
                return None
            used, roots = joined((used, roots), found)
            first = (goal.factors, -1), total * goal.scale
            return lift(self.problem, [first, *used], [], roots)

        whole_lift = partial(lift, self.problem)
        inside = InnerProgram(
            self.ring, blocks, cofactors, whole_lift, total, count=len(base), completed=completed
        )
        programs = [inside, SquaresProgram(self.ring, blocks, cofactors, whole_lift, total)]
        return search_squares(programs[: 1 if more else 2], budget)

    def _times_bounds(
        self, block: FactBlock, axes: Sequence[Axis], degrees: Sequence[int]
    ) -> Iterator[FactBlock]:
        """The block times the products of powers of the bounds that keep within the degrees."""
        rooms = [n - degree_in(block.poly, a.variable) for a, n in zip(axes, degrees)]
        for place in choices(*(range(n + 1) for n in rooms)):
            factors = merge(*(a.factors(k, n) for a, k, n in zip(axes, place, rooms)))
            facts = self.problem.facts
            poly = prod((facts[k].poly ** e for k, e in factors), start=block.poly)
            yield FactBlock(poly, False, block.basis, merge(factors, block.factors), block.scale)


def terms_of(poly: fmpz_mpoly, factor: Fraction) -> Form:
    """A polynomial times a rational, term by term."""
    return {tuple(map(int, m)): int(c) * factor for m, c in zip(poly.monoms(), poly.coeffs())}


def joined(one: Found, other: Found) -> Found:
    """All squares of both."""
    moved = [((f, len(one[1]) + k if k >= 0 else -1), weight) for (f, k), weight in other[0]]
    return [*one[0], *moved], [*one[1], *other[1]]


@dataclass
class InnerProgram(SquaresProgram):
    """A program whose matrices are all definite: those of its first `count` blocks after the goal
    are not rounded, but `completed` from what the rounded ones leave.
    """

    goals: Sequence[tuple[float, float]] = INNER
    denominators: Sequence[int] = FINE
    kernels: Sequence[float] = ()
    count: int = 0
    completed: Callable[[list[Square], list[fmpz_mpoly], Form], Node | None] = lambda *_: None

    def _rounded(
        self,
        linear: LinearEquations,
        grams: list[Floats],
        denominators: Sequence[int],
        budget: Budget,
    ) -> Node | None:
        """The node of rational matrices near the floating ones, shorter ones first."""
        for denominator in denominators:
            budget.spend(50 + len(linear.entries))
            used, roots = list[Square](), list[fmpz_mpoly]()
            left = terms_of(self.blocks[0].poly, -self.total)
            for k, block in enumerate(self.blocks[self.count + 1 :], self.count + 1):
                scale, size = linear.scales[k], len(block.basis)
                # a little more than nothing keeps what is singular definite
                gram = [
                    [
                        Fraction(round(float(c) * denominator) + (i == j and size > 1), denominator)
                        / scale
                        for j, c in enumerate(row)
                    ]
                    for i, row in enumerate(grams[k])
                ]
                squares = as_squares(gram)
                if squares is None:
                    break
                for weight, row in squares:
                    root = sum((b * c for b, c in zip(block.basis, row) if c), self.ring.zero)
                    add(left, block.poly * root * root, -weight)
                    number = -1 if root == self.ring.one else len(roots)
                    used.append(((block.factors, number), weight * block.scale))
                    roots += [root] if number >= 0 else []
            else:
                for (_, poly), c in zip(self.cofactors, linear.multipliers):
                    add(left, poly, -Fraction(round(c * denominator), denominator))
                node = self.completed(used, roots, left)
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


def search_forms(state: State, ring: Ring, budget: Budget, halvings: int = HALVINGS) -> Node | None:
    """A node for a state one of whose strict facts is -Q > 0, with a quadratic form Q >= 0 in a box
    of parameters; None where none was found.
    """
    if state.closed:
        return ("close",)
    problem = Problem(state, ring, quotients=False)
    problem.divide()
    goals = [k for k, f in enumerate(problem.facts) if f.strict and total_degree(f.poly) > 1]
    for goal in goals[: -MOST_GOALS - 1 : -1]:
        form = QuadraticForm(problem, goal)
        node = form.node(budget)
        if node is not None:
            return node
        if form.halving and halvings:
            nodes = list[Node]()
            for case in state.by_sign(form.halving):
                part = search_forms(case, ring, budget, halvings - 1)
                if part is None:
                    break
                nodes.append(part)
            else:
                return "sign", form.halving, nodes[0], nodes[1], nodes[2]
    return None
