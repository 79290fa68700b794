"""Box trees as tactics: a polynomial is a sum of products of terms that are positive on a box."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import product
from math import comb, lcm, prod
from typing import NamedTuple

from juggleproof.certificates import checker
from juggleproof.coq_store.branch import (
    Branch,
    Factors,
    Weighed,
    contradiction,
    positive_sum,
)
from juggleproof.coq_store.text import NotWritten, atom, polynomial

DEEPEST = 40  # halvings of an interval

Side = tuple[str, Fraction]  # a proof that 0 <= c * (the distance from an end), and c


class VariableBetween(NamedTuple):
    """A variable between two numbers, by its number."""

    place: int
    low: Fraction
    high: Fraction
    below: Side
    above: Side


class BoxHypothesis(NamedTuple):
    """A box, and a hypothesis on it: the numerator of a polynomial is > 0, or >= 0."""

    poly: checker.Poly
    relation: str
    name: str
    axes: list[VariableBetween]

    def coefficients(self) -> list[Fraction]:
        """The Bernstein coefficients of the numerator; the first axis varies slowest."""
        if not self.poly.terms:
            return [Fraction(0)] * prod(n + 1 for n in self.degrees())
        shifts = [(checker.BITS * axis.place, axis.low, axis.high) for axis in self.axes]
        scale = 1
        for n, axis in zip(self.degrees(), self.axes):
            scale *= lcm(*(comb(n, j) for j in range(n + 1)))
            scale *= lcm(axis.low.denominator, axis.high.denominator) ** n
        return [Fraction(c, scale) for c in checker.bernstein(self.poly, shifts)[1]]

    def degrees(self) -> list[int]:
        """The degree of the polynomial in the variable of each axis."""
        mask = (1 << checker.BITS) - 1
        shifts = [checker.BITS * axis.place for axis in self.axes]
        return [max((m >> s & mask for m in self.poly.terms), default=0) for s in shifts]

    def products(self, coefficients: Sequence[Fraction]) -> list[Weighed]:
        """The sum of these multiples of the Bernstein polynomials of the box, without zeros."""
        degrees, weighed = self.degrees(), []
        for places, weight in zip(product(*(range(n + 1) for n in degrees)), coefficients):
            factors: Factors = []
            for j, n, axis in zip(places, degrees, self.axes):
                weight *= comb(n, j) / (axis.high - axis.low) ** n
                for (name, share), e in ((axis.below, j), (axis.above, n - j)):
                    weight /= share**e
                    if e:
                        factors.append((f"(pow_le _ {e} {name})", False))
            if weight:
                weighed.append((weight, factors, False))
        return weighed

    def fact(self) -> Weighed:
        """The hypothesis itself."""
        strict = self.relation == ">"
        return Fraction(1), [(self.name, strict)], strict


def boxes(branch: Branch, index: int, bounds: Sequence[tuple[int, int]], tree: str) -> list[str]:
    """The rule `boxes`."""
    poly, relation = branch.state.facts[index]
    places = sorted(poly.places())
    axes = [axis_of(branch, place, *ends) for place, ends in zip(places, bounds, strict=True)]
    return _closed(branch, BoxHypothesis(poly, relation, branch.facts[index], axes), iter(tree))


def axis_of(branch: Branch, place: int, low: int, high: int) -> VariableBetween:
    """The variable of this number, between the ends that two facts state."""
    ends: list[Fraction] = []
    sides: list[Side] = []
    for index in (low, high):
        poly, relation = branch.state.facts[index]
        slope = poly.terms[1 << (checker.BITS * place)]
        name = branch.facts[index]
        ends.append(Fraction(-poly.terms.get(0, 0), slope))
        sides.append((f"(Rlt_le _ _ {name})" if relation == ">" else name, Fraction(abs(slope))))
    return VariableBetween(place, ends[0], ends[1], sides[0], sides[1])


def _closed(branch: Branch, box: BoxHypothesis, tree: Iterator[str]) -> list[str]:
    letter = next(tree, ".")
    coefficients = box.coefficients()
    if letter == ".":
        if box.relation == ">":
            return contradiction([box.fact(), *box.products([-c for c in coefficients])])
        least = -max(coefficients)
        rest = box.products([-c - least for c in coefficients])
        return contradiction([(least, [], True), box.fact(), *rest])
    to_end = letter <= "Z"
    place = ord(letter) - ord("A" if to_end else "a")
    axis, others = box.axes[place], box.axes[:place] + box.axes[place + 1 :]
    if to_end:
        return _face(branch, box, place, tree)
    first, halves = split(branch, axis)
    rows = [first]
    for half in halves:
        rows += ["{", *_closed(branch, box._replace(axes=[half, *others]), tree), "}"]
    return rows


def split(branch: Branch, axis: VariableBetween) -> tuple[str, list[VariableBetween]]:
    """The tactic that splits an axis into halves, the lower one first; and the halves."""
    middle = (axis.low + axis.high) / 2
    below, above = branch.fresh(), branch.fresh()
    share, work = Fraction(middle.denominator), checker.Work()
    line = checker.variable(axis.place, work) - checker.number(middle, work)
    sides = f"({polynomial(branch.names, line)}) ({polynomial(branch.names, -line)})"
    halves = [
        axis._replace(high=middle, above=(below, share)),
        axis._replace(low=middle, below=(above, share)),
    ]
    return f"destruct (by_half {sides} ltac:(ring)) as [{below}|{above}].", halves


def excluded(branch: Branch, found: Sequence[BoxHypothesis], depth: int = DEEPEST) -> list[str]:
    """The tactics for the goal False.  By hypothesis, several polynomials are all > 0 or >= 0 on a
    box; on each of its parts, which are halves of halves, one of them is not.
    """
    for box in found:
        if max(box.coefficients()) < (box.relation == ">"):
            return _closed(branch, box, iter("."))
    if not depth:
        raise NotWritten("no polynomial is negative on a part of a box")
    axis = max((axis for box in found for axis in box.axes), key=lambda a: a.high - a.low)
    first, halves = split(branch, axis)
    rows = [first]
    for half in halves:
        parts = [
            box._replace(axes=[half if a.place == half.place else a for a in box.axes])
            for box in found
        ]
        rows += ["{", *excluded(branch, parts, depth - 1), "}"]
    return rows


def _face(branch: Branch, box: BoxHypothesis, place: int, tree: Iterator[str]) -> list[str]:
    """The tactics for a face: by coefficients that grow towards it, the polynomial is greatest
    there.
    """
    sizes = [n + 1 for n in box.degrees()]
    indices = list(product(*map(range, sizes)))
    by_index = dict(zip(indices, box.coefficients()))
    steps = [
        by_index[(*i[:place], i[place] + 1, *i[place + 1 :])] - c
        for i, c in by_index.items()
        if i[place] + 1 < sizes[place]
    ]
    grows = max(steps, default=0) > 0
    last, axis = (sizes[place] - 1 if grows else 0), box.axes[place]
    end = checker.number(axis.high if grows else axis.low, box.poly.work)
    shift, mask = checker.BITS * axis.place, (1 << checker.BITS) - 1
    face = checker.number(0, box.poly.work)
    for m, c in box.poly.terms.items():
        e = m >> shift & mask
        rest = checker.Poly({m - (e << shift): c}, 1, box.poly.deg, box.poly.bits, box.poly.work)
        face = face + rest * end**e
    gains = [by_index[(*i[:place], last, *i[place + 1 :])] - by_index[i] for i in indices]
    weighed = [
        (weight * face.den, factors, strict)
        for weight, factors, strict in (box.fact(), *box.products(gains))
    ]
    proof, scale = positive_sum(weighed)
    name, lemma = branch.fresh(), "scale_gt" if box.relation == ">" else "scale_ge"
    others = box.axes[:place] + box.axes[place + 1 :]
    return [
        f"assert ({name} : {atom(polynomial(branch.names, face), box.relation)}).",
        f"{{ refine (proj1 ({lemma} 1 {scale} _ _ Rlt_0_1 (IZR_lt 0 {scale} eq_refl) _) {proof}).",
        "  ring. }",
        *_closed(branch, BoxHypothesis(face, box.relation, name, others), tree),
    ]
