"""Quotients proposed for unknowns."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import isqrt

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpq_poly

from juggleproof.algebra import trees
from juggleproof.algebra.conditions import (
    ZERO,
    Condition,
    Relation,
    Tree,
    coefficients_in,
    places,
    top_atoms,
    univariate,
    valued,
)
from juggleproof.algebra.numbers import exact, sign
from juggleproof.algebra.trees import HOLDS
from juggleproof.search import limits

# -------------------------------------------------------------------------------------------------
# Quotients of polynomials in base variables and adjoined roots: the terms that a search proposes
# for unknown variables.

Sample = Mapping[str, fmpq]
KEY_POINT = tuple(fmpq(31 * k + 17, 7 * k + 3) for k in range(80))
SPARE = ("root1", "root2")  # names in the ring for square roots that a search adjoins


@dataclass(frozen=True)
class TermQuotient:
    """top / bottom, polynomials in the base variables and the adjoined ones."""

    top: fmpq_mpoly
    bottom: fmpq_mpoly

    @staticmethod
    def reduced(top: fmpq_mpoly, bottom: fmpq_mpoly) -> TermQuotient:
        """The same quotient without common factors, its bottom with leading coefficient 1."""
        if bottom.total_degree() > 0:
            common = top.gcd(bottom)
            if common.total_degree() > 0:
                top, bottom = top / common, bottom / common
        lead = bottom.leading_coefficient()
        return TermQuotient(top, bottom) if lead == 1 else TermQuotient(top / lead, bottom / lead)

    def at(self, sample: Sample) -> fmpq | None:
        """The value at a sample of the base; None where the bottom vanishes."""
        top = valued(self.top, sample)
        if self.bottom == 1:
            return top
        bottom = valued(self.bottom, sample)
        return None if not bottom or top is None else top / bottom

    @cached_property
    def used(self) -> frozenset[int]:
        """The numbers of the variables that occur."""
        return frozenset(
            i
            for i, d in enumerate(zip(self.top.degrees(), self.bottom.degrees()))
            if d[0] > 0 or d[1] > 0
        )

    def within(self, point: RingPoint) -> fmpq | None:
        """The value at a point; None where the bottom vanishes or a value is missing."""
        if not self.used <= point.known:
            return None
        if self.bottom == 1:
            return self.top(*point.values)
        bottom = self.bottom(*point.values)
        return self.top(*point.values) / bottom if bottom else None

    def plus(self, other: TermQuotient) -> TermQuotient:
        """The sum of two quotients."""
        if other.bottom == 1:
            return TermQuotient.reduced(self.top + other.top * self.bottom, self.bottom)
        return TermQuotient.reduced(
            self.top * other.bottom + other.top * self.bottom, self.bottom * other.bottom
        )

    def key(self) -> tuple[int, ...]:
        """The same for the same quotient, and but by an unlikely chance no other's."""
        point = KEY_POINT[: len(places(self.top.context()))]
        top, bottom = self.top(*point), self.bottom(*point)
        return int(top.p), int(top.q), int(bottom.p), int(bottom.q)

    def size(self) -> tuple[int, int]:
        """How long it is to read."""
        coefficients = [*self.top.coeffs(), *self.bottom.coeffs()]
        return int(self.top.total_degree() + self.bottom.total_degree()), sum(
            int(c.height_bits()) + 2 for c in coefficients
        )


@dataclass(frozen=True)
class RingPoint:
    """Values of all variables of a ring in their order, 0 where none is known, and the numbers of
    those that are.
    """

    values: list[fmpq]
    known: frozenset[int]

    @staticmethod
    def of(ring: fmpq_mpoly_ctx, given: Mapping[str, fmpq]) -> RingPoint:
        """The point that a mapping by names gives."""
        place = places(ring)
        return RingPoint(
            [given.get(name, ZERO) for name in place], frozenset(place[name] for name in given)
        )


@dataclass
class AdjoinedRoot:
    """An adjoined root: the variable that stands for it, and its polynomial."""

    name: str
    poly: fmpq_mpoly


@dataclass
class TermChoice:
    """Values of all unknowns, the roots adjoined for them, and the samples on which they serve."""

    values: dict[str, TermQuotient]
    roots: list[AdjoinedRoot]
    serves: list[int]
    ring: fmpq_mpoly_ctx


def root_values(roots: Sequence[AdjoinedRoot], sample: Sample) -> dict[str, fmpq]:
    """Rational values close to the adjoined roots at a sample; the larger root of each equation."""
    values: dict[str, fmpq] = {}
    for root in roots:
        given = {**sample, **values}
        at = [valued(c, given) for c in coefficients_in(root.poly, root.name)]
        parts = [c for c in at if c is not None]
        if len(parts) != 3:
            return values
        half = -parts[1] / 2
        under = half * half - parts[0]
        if under < 0:
            return values
        scaled = under * (fmpq(4) ** 200)
        values[root.name] = half + fmpq(isqrt(int(scaled.floor())), 1) / (fmpq(2) ** 200)
    return values


def reduced_by(root: AdjoinedRoot, poly: fmpq_mpoly) -> fmpq_mpoly:
    """The polynomial modulo the equation of an adjoined root: linear in it."""
    lower, parts = coefficients_in(root.poly, root.name), coefficients_in(poly, root.name)
    while len(parts) > 2:
        lead = parts.pop()
        parts[-1] = parts[-1] - lead * lower[1]
        parts[-2] = parts[-2] - lead * lower[0]
    gen = poly.context().gen(poly.context().variable_to_index(root.name))
    return parts[0] + parts[1] * gen if len(parts) == 2 else parts[0]


def square_roots(
    factor: fmpq_mpoly, name: str, roots: Sequence[AdjoinedRoot]
) -> tuple[list[TermQuotient], AdjoinedRoot | None]:
    """Both zeros of a polynomial of degree 2 in a variable, and the square root to be adjoined for
    them, if none at hand serves.
    """
    c, b, a = coefficients_in(factor, name)
    ring = factor.context()
    scale, factors = (b * b - 4 * a * c).factor()
    outer, inner = ring.constant(1), ring.constant(1)
    for part, power in factors:
        outer, inner = outer * part ** (power // 2), inner * part ** (power % 2)
    # scale * inner is what stands under the root; its square factors go outside.
    top, bottom = int(scale.p), int(scale.q)
    square = next(
        (
            k
            for k in range(min(isqrt(abs(top * bottom)), 1000), 0, -1)
            if (top * bottom) % (k * k) == 0
        ),
        1,
    )
    outer, inner = outer * fmpq(square, bottom), inner * fmpq(top * bottom // (square * square))
    taken = [root for root in roots if coefficients_in(root.poly, root.name)[0] == -inner]
    free = [spare for spare in SPARE if spare not in [root.name for root in roots]]
    if not taken and not free:
        return [], None
    if taken:
        root, fresh = taken[0], None
    else:
        gen = ring.gen(ring.variable_to_index(free[0]))
        root = fresh = AdjoinedRoot(free[0], gen * gen - inner)
    gen = ring.gen(ring.variable_to_index(root.name))
    return [TermQuotient.reduced(-b + sign * outer * gen, 2 * a) for sign in (1, -1)], fresh


def insert(value: TermQuotient, name: str, known: TermQuotient) -> TermQuotient:
    """The quotient with another in place of a variable."""
    tops, bottoms = coefficients_in(value.top, name), coefficients_in(value.bottom, name)
    degree = max(len(tops), len(bottoms)) - 1
    if degree == 0:
        return value

    def cleared(parts: list[fmpq_mpoly]) -> fmpq_mpoly:
        total = value.top.context().constant(0)
        for k, c in enumerate(parts):
            total += c * known.top**k * known.bottom ** (degree - k)
        return total

    return TermQuotient(cleared(tops), cleared(bottoms))


# -------------------------------------------------------------------------------------------------
# Values known up to the accuracy of roots, and quotients between others.

NEGLIGIBLE = exact(limits.NEGLIGIBLE)
OPEN = -1  # in place of the number of a polynomial that the variable does not decide


class Trial:
    """A condition at a sample, made ready to try many values of one variable.

    >>> from flint import Ordering, fmpq_mpoly_ctx
    >>> ring = fmpq_mpoly_ctx.get(["x", "y"], Ordering.lex)
    >>> x, y = ring.gens()
    >>> trial = Trial(Condition(ring, [x - 1, x * y], ("and", [(0, ">="), (1, ">")])), "x")
    >>> trial.fails(fmpq(0)), trial.fails(fmpq(2))
    (True, False)
    """

    def __init__(self, condition: Condition, name: str) -> None:
        self.condition, self.name, self.size = condition, name, len(condition.polys)
        self.place = places(condition.ring)[name]
        self.alone: dict[
            int, fmpq_poly | None
        ] = {}  # polynomials in the variable alone; None: others occur as well
        self.direct: list[
            tuple[fmpq_poly, str]
        ] = []  # relations in the variable alone that have to hold
        self.tree: Tree | None = None

    def fails(self, value: fmpq, nearly: bool = False) -> bool:
        """Whether the condition cannot be met with this value of the variable, as far as folding
        shows.
        """
        if self.tree is None:
            self.tree = self._prepared()
        for place, (poly, relation) in enumerate(self.direct):
            at = poly(value)
            if not HOLDS[relation](0 if nearly and abs(at) < NEGLIGIBLE else sign(at)):
                if place:  # what fails once will often fail again
                    self.direct.insert(0, self.direct.pop(place))
                return True
        signs: dict[int, int | None] = {}

        def sign_of(k: int) -> int | None:
            if k not in signs:
                dense = self.alone[k]
                if dense is not None:
                    number = dense(value)
                else:
                    poly = self.condition.polys[k].subs({self.place: value})
                    poly = rounded(poly) if nearly else poly
                    number = (
                        None if poly.total_degree() > 0 else poly.coefficient(0) if poly else ZERO
                    )
                signs[k] = (
                    None
                    if number is None
                    else 0
                    if nearly and abs(number) < NEGLIGIBLE
                    else sign(number)
                )
            return signs[k]

        def decide(one: Relation) -> bool | None:
            found = None if one[0] == OPEN else sign_of(one[0])
            return None if found is None else HOLDS[one[1]](found)

        return trees.truth(self.tree, decide) is False

    def _prepared(self) -> Tree:
        """Sets apart the polynomials that the variable decides; what does not speak of it is left
        open.
        """
        condition, place = self.condition, self.place
        open_ones = set()
        for k in condition.used():
            degrees = condition.polys[k].degrees()
            if not degrees[place]:
                open_ones.add(k)
            else:
                alone = not any(d for i, d in enumerate(degrees) if i != place)
                self.alone[k] = univariate(condition.polys[k], self.name) if alone else None
        top = [atom for atom in top_atoms(condition.tree) if self.alone.get(atom[0]) is not None]
        self.direct = [
            (dense, relation)
            for k, relation in top_atoms(condition.tree)
            if (dense := self.alone.get(k)) is not None
        ]
        whole = condition.tree
        if top and not isinstance(whole, bool):
            left = [part for part in whole[1] if part not in top] if whole[0] == "and" else []
            whole = ("and", left) if left else True
        return self._ordered(whole, open_ones)

    def _ordered(self, tree: Tree, open_ones: set[int]) -> Tree:
        """The tree with (OPEN, relation) for what stays open, and what is quickly decided first."""
        if isinstance(tree, bool):
            return tree
        if isinstance(tree[0], int):
            return (OPEN, tree[1]) if tree[0] in open_ones else tree
        parts = [self._ordered(part, open_ones) for part in tree[1]]
        return (tree[0], sorted(parts, key=self._cost))

    def _cost(self, tree: Tree) -> int:
        if isinstance(tree, bool) or isinstance(tree[0], str):
            return 2
        return 3 if tree[0] == OPEN else int(self.alone[tree[0]] is None)


def partly(poly: fmpq_mpoly, given: Sample) -> fmpq_mpoly:
    """The polynomial with numbers in place of the variables that are given."""
    place = places(poly.context())
    if len(given) == len(place):
        return poly.context().constant(poly(*[given[name] for name in place]))
    degrees = poly.degrees()
    used = {place[name]: value for name, value in given.items() if degrees[place[name]]}
    return poly.subs(used) if used else poly


def rounded(poly: fmpq_mpoly) -> fmpq_mpoly:
    """The polynomial without the coefficients that are 0 but for the accuracy of roots."""
    if all(abs(c) >= NEGLIGIBLE for c in poly.coeffs()):
        return poly
    return poly.context().from_dict(
        {powers: c for powers, c in poly.to_dict().items() if abs(c) >= NEGLIGIBLE}
    )


def ring_names(poly: fmpq_mpoly) -> set[str]:
    """The variables that occur in a polynomial."""
    return {name for name, e in zip(poly.context().names(), poly.degrees()) if e}


def among(ordered: Sequence[TermQuotient]) -> Iterator[TermQuotient]:
    """Averages of neighbours, and what lies one below the least and one above the largest."""
    for left, right in zip(ordered, ordered[1:]):
        for weight in (fmpq(1, 2), fmpq(1, 4), fmpq(3, 4)):
            top = left.top * right.bottom * (1 - weight) + right.top * left.bottom * weight
            yield TermQuotient.reduced(top, left.bottom * right.bottom)
    for end, shift in ((ordered[:1], -1), (ordered[-1:], 1)):
        yield from (TermQuotient.reduced(q.top + shift * q.bottom, q.bottom) for q in end)


def between(lines: Sequence[TermQuotient]) -> list[TermQuotient]:
    """For three of them, low + (a - low)*(b - low)/((a - low) + (b - low)): above low, and below a
    and b where both are above it.
    """
    found = []
    for k, low in enumerate(lines[:3]):
        above = [
            TermQuotient(q.top * low.bottom - low.top * q.bottom, q.bottom * low.bottom)
            for j, q in enumerate(lines[:5])
            if j != k
        ]
        for i, a in enumerate(above):
            for b in above[:i]:
                total = a.top * b.bottom + b.top * a.bottom
                if total != 0:
                    found.append(
                        TermQuotient.reduced(
                            low.top * total + low.bottom * a.top * b.top, low.bottom * total
                        )
                    )
    return found


# -------------------------------------------------------------------------------------------------
# A condition on its way to terms: what was decided so far, and what is left, at every sample and
# in symbols.


@dataclass
class Partial:
    """A condition on its way: at every sample, and symbolic, which is made only where it is asked
    for.
    """

    make: Callable[[], Condition]
    sampled: list[Condition]
    steps: list[tuple[str, fmpq_mpoly, fmpq_mpoly]] = field(default_factory=list)
    roots: list[AdjoinedRoot] = field(default_factory=list)

    @cached_property
    def condition(self) -> Condition:
        """The condition on base and unknowns."""
        return self.make()

    def with_root(self, root: AdjoinedRoot | None) -> Partial:
        """The same with one more adjoined root, if one is given."""
        return replace(self, roots=[*self.roots, root]) if root else self

    def trials(self, name: str) -> list[Trial | None]:
        """At each sample the condition, ready to try values of a variable; None where it fails."""
        return [Trial(one, name) if one.tree is not False else None for one in self.sampled]
