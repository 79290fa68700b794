"""Conditions over polynomials: a checker's formula held as FLINT's polynomials, substituted and
folded; and where its truth can change as a parameter moves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Union

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpq_poly

from juggleproof.algebra import limits, numbers, polynomials, trees
from juggleproof.algebra.numbers import AlgebraicNumber, fraction, real_roots, sign
from juggleproof.algebra.polynomials import monomials
from juggleproof.algebra.trees import HOLDS, OPPOSITE
from juggleproof.certificates import checker
from juggleproof.statements.work import Budget, Exhausted

# -------------------------------------------------------------------------------------------------
# Conditions over polynomials: a checker's formula held as FLINT's polynomials, substituted, folded
# and evaluated fast.

ZERO = fmpq(0)
Relation = tuple[int, str]  # (number of a polynomial, ">", ">=", "=" or "!=")
Tree = Union[bool, Relation, tuple[trees.Op, Sequence["Tree"]]]


def ring_of(context: checker.Context, *more: str) -> fmpq_mpoly_ctx:
    """The polynomial ring in the variables of a context, in their order, and in further ones."""
    return fmpq_mpoly_ctx.get([*context.index, *more] or ["none"], Ordering.lex)


@lru_cache(maxsize=512)
def places(ring: fmpq_mpoly_ctx) -> dict[str, int]:
    """The number of every variable of a ring; FLINT takes numbers far quicker than names."""
    return {name: place for place, name in enumerate(ring.names())}


def valued(poly: fmpq_mpoly, given: Mapping[str, fmpq]) -> fmpq | None:
    """The value of a polynomial at a point; None where it has a variable that the point does not
    give.
    """
    place = places(poly.context())
    if len(given) < len(place):
        degrees = poly.degrees()
        if any(
            degrees[i] > 0 and name not in given for name, i in place.items()
        ):  # the degrees of 0 are -1
            return None
    return poly(*[given.get(name, ZERO) for name in place])


def to_flint(poly: checker.Poly, ring: fmpq_mpoly_ctx, size: int) -> fmpq_mpoly:
    """The checker's polynomial in FLINT's ring, whose first `size` variables are its own."""
    rest, den = (0,) * (ring.nvars() - size), poly.den
    return ring.from_dict({m + rest: fmpq(c, den) for m, c in monomials(poly, size).items()})


def to_text(poly: fmpq_mpoly) -> str:
    """A polynomial as text of the statement language."""
    names = poly.context().names()
    text = ""
    for powers, c in poly.to_dict().items():
        factors = [n if e == 1 else f"{n}^{e}" for n, e in zip(names, powers) if e]
        value = fraction(c)
        size = [str(abs(value))] if abs(value) != 1 or not factors else []
        if len(size) and value.denominator != 1 and factors:
            size = [f"({abs(value)})"]
        part = "*".join(size + factors)
        text += (
            ("-" if value < 0 else "") + part
            if not text
            else (" - " if value < 0 else " + ") + part
        )
    return text or "0"


class Condition:
    """A boolean combination of polynomial relations to 0: the tree names the polynomials by their
    numbers.
    """

    __slots__ = ("ring", "polys", "tree", "_used")

    def __init__(self, ring: fmpq_mpoly_ctx, polys: Sequence[fmpq_mpoly], tree: Tree) -> None:
        self.ring, self.polys, self.tree = ring, list(polys), tree
        self._used: list[int] | None = None

    @staticmethod
    def of(
        context: checker.Context, formula: checker.Formula, ring: fmpq_mpoly_ctx | None = None
    ) -> Condition:
        """The condition that a formula of the checker states."""
        ring = ring or ring_of(context)
        polys: list[fmpq_mpoly] = []
        numbers: dict[frozenset[tuple[int, int]], int] = {}  # of equal polynomials, one
        size = len(context.index)

        def numbered(atom: checker.Atom) -> Relation:
            _, poly, relation = atom
            key = frozenset(poly.terms.items()) | {(-1, poly.den)}
            if key not in numbers:
                numbers[key] = len(polys)
                polys.append(to_flint(poly, ring, size))
            return numbers[key], relation

        return Condition(ring, polys, trees.mapped(formula, numbered))

    def conjoined(self, other: Condition) -> Condition:
        """Both conditions."""
        shift = len(self.polys)
        moved: Tree = trees.mapped(other.tree, lambda one: (one[0] + shift, one[1]))
        both = trees.join("and", [self.tree, moved])
        return Condition(self.ring, self.polys + other.polys, both)

    def negated(self) -> Condition:
        """The negation; the opposites of the polynomials follow them."""
        size = len(self.polys)

        def opposite(one: Relation) -> Relation:
            k, relation = one
            return k + size * (relation in (">", ">=")), OPPOSITE[relation]

        tree: Tree = trees.negated(self.tree, opposite)
        return Condition(self.ring, [*self.polys, *(-p for p in self.polys)], tree)

    def substituted(self, values: Mapping[str, fmpq]) -> Condition:
        """The condition with numbers in place of variables, folded."""
        place, ring = places(self.ring), self.ring
        if len(values) == len(place):
            point = [values[name] for name in place]
            return self.mapped(lambda p: ring.constant(p(*point)))
        given = {place[name]: value for name, value in values.items()}
        return self.mapped(lambda p: p.subs(given))

    def replaced(self, name: str, top: fmpq_mpoly, bottom: fmpq_mpoly | int = 1) -> Condition:
        """The condition with top/bottom in place of a variable, every polynomial times a positive
        power of the bottom.
        """
        return self.mapped(lambda p: replace(p, name, top, bottom))

    def mapped(self, change: Callable[..., fmpq_mpoly]) -> Condition:
        """The condition with polynomials changed by a function that keeps their signs; those that
        no longer matter are left as they are.
        """
        polys, done = list(self.polys), set()

        def changed(k: int) -> fmpq_mpoly:
            if k not in done:
                done.add(k)
                if polys[k].total_degree() > 0:
                    polys[k] = change(polys[k])
            return polys[k]

        tree = fold(self.tree, changed)
        return Condition(self.ring, polys, tree)

    def used(self) -> list[int]:
        """The numbers of the polynomials that still occur in the tree, sorted."""
        if self._used is None:
            self._used = sorted({k for k, _ in trees.leaves(self.tree)})
        return self._used

    def variables(self) -> set[str]:
        """The variables that still occur."""
        names = list(places(self.ring))
        degrees = [self.polys[k].degrees() for k in self.used()]
        return {names[i] for each in degrees for i, e in enumerate(each) if e}

    def facts(self) -> list[tuple[fmpq_mpoly, str]]:
        """The relations that hold on their own: those at top level or in a top-level `and`."""
        return [(self.polys[k], relation) for k, relation in top_atoms(self.tree)]

    def cleared(self) -> Condition:
        """The same condition, its equations without the factors that other facts say not to
        vanish.
        """
        nonzero = [
            p / p.leading_coefficient()
            for p, relation in self.facts()
            if relation in (">", "!=") and len(p) <= 4
        ]
        polys = list(self.polys)
        for k, relation in top_atoms(self.tree):
            if (
                relation == "="
                and 1 < len(polys[k]) <= 400
                and any((polys[k] % q) == 0 for q in nonzero)
            ):
                left = [
                    f for f, _ in polys[k].factor()[1] if f / f.leading_coefficient() not in nonzero
                ]
                whole = self.ring.constant(1)
                for factor in left:
                    whole = whole * factor
                polys[k] = whole
        if len(top_atoms(self.tree)) != len({k for k, _ in top_atoms(self.tree)}) or any(
            polys[k] is not self.polys[k]
            for part in trees.conjuncts(self.tree)
            if trees.is_join(part)
            for k, _ in trees.leaves(part)
        ):
            return self
        return Condition(self.ring, polys, fold(self.tree, polys.__getitem__))

    def univariate_truth(
        self, name: str, at: fmpq | AlgebraicNumber, polys: Mapping[int, fmpq_poly]
    ) -> bool:
        """Whether a condition in one variable holds at a number; `polys` are its polynomials in
        that variable.
        """
        signs = {
            k: at.sign_of(p) if isinstance(at, AlgebraicNumber) else sign(p(at))
            for k, p in polys.items()
        }
        return evaluate(self.tree, signs)

    def in_one_variable(self, name: str) -> dict[int, fmpq_poly]:
        """The polynomials of a condition in one variable."""
        return {k: univariate(self.polys[k], name) for k in self.used()}


def top_atoms(tree: Tree) -> list[Relation]:
    """The relations that a tree asserts on their own."""
    return [
        one
        for part in trees.conjuncts(tree)
        if not trees.is_join(part)
        for one in trees.leaves(part)
    ]


def fold(tree: Tree, poly_of: Callable[[int], fmpq_mpoly]) -> Tree:
    """The tree with relations between constants decided; polynomials are asked for only as long as
    they matter.
    """

    def decided(one: Relation) -> Tree:
        poly = poly_of(one[0])
        if poly.total_degree() > 0:
            return one
        return HOLDS[one[1]](sign(poly.coefficient(0)) if poly else 0)

    return trees.mapped(tree, decided)


def evaluate(tree: Tree, signs: Mapping[int, int]) -> bool:
    """The truth of a tree where the polynomials of these numbers have these signs."""
    return trees.truth(tree, lambda one: HOLDS[one[1]](signs[one[0]])) is True


def univariate(poly: fmpq_mpoly, name: str) -> fmpq_poly:
    """A polynomial in one variable of its ring, as a dense one."""
    return numbers.univariate(poly, places(poly.context())[name])


def multivariate(poly: fmpq_poly, ring: fmpq_mpoly_ctx, name: str) -> fmpq_mpoly:
    """A dense polynomial as one of the ring."""
    place, size = ring.variable_to_index(name), ring.nvars()
    return ring.from_dict(
        {
            tuple(k if i == place else 0 for i in range(size)): c
            for k, c in enumerate(poly.coeffs())
            if c
        }
    )


def coefficients_in(poly: fmpq_mpoly, name: str) -> list[fmpq_mpoly]:
    """The coefficients of a polynomial as one in this variable, from the constant up."""
    return polynomials.coefficients_in(poly, places(poly.context())[name])


def replace(
    poly: fmpq_mpoly, name: str, top: fmpq_mpoly, bottom: fmpq_mpoly | int = 1
) -> fmpq_mpoly:
    """The polynomial at top/bottom, times the least even power of the bottom that clears it."""
    place = places(poly.context())[name]
    if not poly or not poly.degrees()[place]:
        return poly
    if bottom == 1 and top.total_degree() <= 0:
        return poly.subs({place: top.coefficient(0) if top else 0})
    coefficients = coefficients_in(poly, name)
    degree = len(coefficients) - 1
    if bottom == 1:
        result = coefficients[-1]
        for c in reversed(coefficients[:-1]):
            result = result * top + c
        return result
    degree += degree % 2
    powers = [bottom**0]
    for _ in range(degree):
        powers.append(powers[-1] * bottom)
    result, power = poly.context().constant(0), bottom**0
    for k, c in enumerate(coefficients):
        result += c * power * powers[degree - k]
        power *= top
    return result


def constant_of(poly: fmpq_mpoly) -> fmpq | None:
    """The value of a constant polynomial; None for any other."""
    if poly.total_degree() > 0:
        return None
    return poly.coefficient(0) if poly else ZERO


# -------------------------------------------------------------------------------------------------
# Where a condition can change its truth as one parameter moves: candidate numbers from iterated
# resultants and discriminants.
#
# Source: McCallum's projection (An improved projection operation for cylindrical algebraic
# decomposition, 1998), with an equation On projection in CAD-based quantifier elimination with
# equational constraint, ISSAC 1999.  Only candidates come of it: no statement rests on their being
# complete.


def border_polynomials(
    conditions: Sequence[tuple[Condition, Condition | None]],
    parameters: Sequence[str],
    budget: Budget,
) -> list[fmpq_mpoly]:
    """Irreducible polynomials in the parameters on whose roots the projections of the conditions
    can change, in a fixed order.

    A second condition beside one is what further variables, bound in it alone, should meet: it is
    projected first.  Raises Exhausted where the budget ends.
    """
    borders: list[fmpq_mpoly] = []
    for condition, inner in conditions:
        outer: list[fmpq_mpoly] = []
        if inner is not None:
            own = condition.variables() | set(parameters)
            outer = projected(inner, own, budget)
        for poly in projected(condition, set(parameters), budget, outer):
            if poly not in borders:
                borders.append(poly)
    return sorted(borders, key=lambda p: (p.total_degree(), len(p), str(p)))


def candidate_numbers(polys: Iterable[fmpq_mpoly], parameter: str) -> list[AlgebraicNumber]:
    """The real roots of polynomials in the one parameter, in increasing order, each once."""
    numbers: list[AlgebraicNumber] = []
    for poly in polys:
        for root in real_roots(univariate(poly, parameter)):
            if root not in numbers:
                numbers.append(root)
    return sorted(numbers)


def projected(
    condition: Condition, parameters: set[str], budget: Budget, more: Sequence[fmpq_mpoly] = ()
) -> list[fmpq_mpoly]:
    """Irreducible polynomials in the parameters on whose roots the projection of one condition can
    change.  Raises Exhausted where the budget ends.
    """
    condition, borders = without_equations(condition, parameters, budget, more)
    equations = [p for p, relation in condition.facts() if relation == "="]
    polys = _factors([*(condition.polys[k] for k in condition.used()), *borders])
    names = list(condition.ring.names())
    left = [
        n for i, n in enumerate(names) if n not in parameters and any(p.degrees()[i] for p in polys)
    ]
    while left:
        # The variable that is cheapest to eliminate: of least degree, in the fewest polynomials.
        name = min(left, key=lambda n: _cost(polys, names.index(n)))
        left.remove(name)
        polys, equations = _eliminate(polys, equations, name, budget)
    return polys


def _cost(polys: Sequence[fmpq_mpoly], place: int) -> tuple[int, int, int]:
    degrees = [p.degrees()[place] for p in polys if p.degrees()[place]]
    return (max(degrees, default=0), len(degrees), sum(len(p) for p in polys if p.degrees()[place]))


def without_equations(
    condition: Condition, parameters: set[str], budget: Budget, more: Sequence[fmpq_mpoly]
) -> tuple[Condition, list[fmpq_mpoly]]:
    """The condition after every equation that is linear in a variable, over the parameters, is
    solved for it; and polynomials on whose roots that, or `more`, can change.  Raises Exhausted
    where the budget ends.
    """
    borders: list[fmpq_mpoly] = list(more)
    while True:
        best: tuple[tuple[int, int], str, fmpq_mpoly, fmpq_mpoly] | None = None
        names = condition.ring.names()
        for poly, relation in condition.facts():
            if relation != "=":
                continue
            for i, degree in enumerate(poly.degrees()):
                if degree == 1 and names[i] not in parameters:
                    rest, slope = coefficients_in(poly, names[i])
                    others = {names[j] for j, e in enumerate(slope.degrees()) if e}
                    if others <= parameters:
                        size = (len(slope), len(rest))
                        if best is None or size < best[0]:
                            best = size, names[i], -rest, slope
        if best is None:
            return condition, borders
        _, name, top, bottom = best
        budget.spend(500)
        borders = [replace(p, name, top, bottom) for p in borders]
        borders += [] if constant_of(bottom) is not None else [bottom]
        condition = condition.replaced(name, top, bottom)


def _eliminate(
    polys: list[fmpq_mpoly], equations: list[fmpq_mpoly], name: str, budget: Budget
) -> tuple[list[fmpq_mpoly], list[fmpq_mpoly]]:
    """The projection along one variable: coefficients, discriminants and resultants; only those
    with an equation where there is one.
    """
    place = polys[0].context().variable_to_index(name)
    mixed = [p for p in polys if p.degrees()[place]]
    result = [p for p in polys if not p.degrees()[place]]
    pivots = [p for p in mixed if any((e % p) == 0 for e in equations if e != 0)]
    pivot = (
        min(pivots, key=lambda p: (p.degrees()[place], len(p)))
        if len(equations) and pivots
        else None
    )
    owned = [e for e in equations if pivot is not None and (e % pivot) == 0]
    whole = pivot is not None and all(
        sum(1 for f, _ in e.factor()[1] if f.degrees()[place]) == 1 for e in owned[:1]
    )
    fresh: list[fmpq_mpoly] = []
    firsts = [pivot] if whole and pivot is not None else mixed
    for p in firsts:
        parts = coefficients_in(p, name)
        fresh.append(parts[-1])
        if len(parts) > 2:
            _spend(budget, p, p)
            fresh.append(p.discriminant(name))
            fresh += _vanishing(parts)
    if whole and pivot is not None:
        pairs = [(pivot, q) for q in mixed if q is not pivot]
    else:
        pairs = [(p, q) for i, p in enumerate(mixed) for q in mixed[:i]]
    new_equations = [e for e in equations if not e.degrees()[place]]
    for p, q in pairs:
        _spend(budget, p, q)
        resultant = p.resultant(q, name)
        fresh.append(resultant)
        if whole and any((e % q) == 0 for e in equations if e != 0 and e not in owned):
            new_equations.append(resultant)
    return _factors([*result, *fresh]), [e for e in new_equations if e != 0]


def _vanishing(parts: Sequence[fmpq_mpoly]) -> list[fmpq_mpoly]:
    """Lower coefficients, as long as all above can vanish together."""
    vanishing: list[fmpq_mpoly] = []
    for part in reversed(parts[1:]):
        if constant_of(part) is not None and part != 0:
            return vanishing
        if part != 0:
            vanishing.append(part)
    return vanishing


def _spend(budget: Budget, p: fmpq_mpoly, q: fmpq_mpoly) -> None:
    budget.spend(100 + 4 * len(p) * len(q))
    if len(p) * len(q) > limits.MOST_TERMS * limits.MOST_TERMS:
        raise Exhausted


def _factors(polys: Iterable[fmpq_mpoly]) -> list[fmpq_mpoly]:
    """The distinct irreducible factors that are no constants, each with leading coefficient 1; too
    large ones are left out.
    """
    distinct: dict[str, fmpq_mpoly] = {}
    for poly in polys:
        if poly == 0 or poly.is_constant() or len(poly) > limits.MOST_TERMS:
            continue
        for factor, _ in poly.factor()[1]:
            monic = factor / factor.leading_coefficient()
            distinct.setdefault(str(monic), monic)
    return list(distinct.values())
