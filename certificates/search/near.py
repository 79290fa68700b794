"""Values known up to the accuracy of roots, and quotients between others."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from flint import fmpq, fmpq_mpoly, fmpq_poly

from .algebraic import sign
from .condition import HOLDS, ZERO, Condition, Tree, places, top_atoms, univariate
from .quotients import Quotient, Sample

NEGLIGIBLE = fmpq(1, 2**100)  # of values that come from rational approximations of roots


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
        self.tree: Tree = None

    def fails(self, value: fmpq, nearly: bool = False) -> bool:
        """Whether the condition cannot be met with this value of the variable, as far as folding
        shows.
        """
        if self.tree is None:
            self._prepare()
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

        return _decided(self.tree, sign_of) is False

    def _prepare(self) -> None:
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
        if top:
            left = [part for part in whole[1] if part not in top] if whole[0] == "and" else []
            whole = ("and", left) if left else True
        self.tree = self._ordered(whole, open_ones)

    def _ordered(self, tree: Tree, open_ones: set[int]) -> Tree:
        """The tree with (None, relation) for what stays open, and what is quickly decided first."""
        if isinstance(tree, bool):
            return tree
        if isinstance(tree[0], int):
            return (None, tree[1]) if tree[0] in open_ones else tree
        parts = [self._ordered(part, open_ones) for part in tree[1]]
        return (tree[0], sorted(parts, key=self._cost))

    def _cost(self, tree: Tree) -> int:
        return (
            3
            if tree[0] is None
            else 2
            if isinstance(tree[0], str)
            else int(self.alone[tree[0]] is None)
        )


def _decided(tree: Tree, sign_of: Any) -> bool | None:
    """The truth of a tree where the signs tell it; None where they do not."""
    if isinstance(tree, bool):
        return tree
    if tree[0] is None:
        return None
    if isinstance(tree[0], int):
        found = sign_of(tree[0])
        return None if found is None else bool(HOLDS[tree[1]](found))
    whole: bool | None = tree[0] == "and"
    for part in tree[1]:
        truth = _decided(part, sign_of)
        if truth is not None and truth == (tree[0] == "or"):
            return truth
        whole = None if truth is None else whole
    return whole


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


def among(ordered: Sequence[Quotient]) -> Iterator[Quotient]:
    """Averages of neighbours, and what lies one below the least and one above the largest."""
    for left, right in zip(ordered, ordered[1:]):
        for weight in (fmpq(1, 2), fmpq(1, 4), fmpq(3, 4)):
            top = left.top * right.bottom * (1 - weight) + right.top * left.bottom * weight
            yield Quotient.reduced(top, left.bottom * right.bottom)
    for end, shift in ((ordered[:1], -1), (ordered[-1:], 1)):
        yield from (Quotient.reduced(q.top + shift * q.bottom, q.bottom) for q in end)


def between(lines: Sequence[Quotient]) -> list[Quotient]:
    """For three of them, low + (a - low)*(b - low)/((a - low) + (b - low)): above low, and below a
    and b where both are above it.
    """
    found = []
    for k, low in enumerate(lines[:3]):
        above = [
            Quotient(q.top * low.bottom - low.top * q.bottom, q.bottom * low.bottom)
            for j, q in enumerate(lines[:5])
            if j != k
        ]
        for i, a in enumerate(above):
            for b in above[:i]:
                total = a.top * b.bottom + b.top * a.bottom
                if total != 0:
                    found.append(
                        Quotient.reduced(
                            low.top * total + low.bottom * a.top * b.top, low.bottom * total
                        )
                    )
    return found
