"""Bernstein coefficients of polynomials on a box."""

from __future__ import annotations

from math import comb

from flint import fmpq, fmpq_poly

Tensor = dict[tuple[int, ...], fmpq]  # Bernstein coefficients by their places


class Patch:
    """The Bernstein coefficients of a polynomial on a box, one number for each place."""

    def __init__(self, degrees: tuple[int, ...], at: Tensor) -> None:
        self.degrees = degrees
        self.at = at

    @classmethod
    def on_box(
        cls, monomials: Tensor, degrees: tuple[int, ...], box: list[tuple[fmpq, fmpq]]
    ) -> Patch:
        """Of the polynomial with these coefficients of monomials, on the box."""
        patch = cls(degrees, monomials)
        for axis, (low, high) in enumerate(box):
            n = degrees[axis]
            x = fmpq_poly([low, high - low])
            powers = [x**k for k in range(n + 1)]
            # t^j = sum over i >= j of C(i, j)/C(n, j) times the i-th Bernstein polynomial
            rows = [
                [
                    sum((power[j] * fmpq(comb(i, j), comb(n, j)) for j in range(i + 1)), fmpq(0))
                    for i in range(n + 1)
                ]
                for power in powers
            ]
            new: Tensor = {}
            for place, c in patch.at.items():
                for i in range(n + 1):
                    there = (*place[:axis], i, *place[axis + 1 :])
                    new[there] = new.get(there, fmpq(0)) + c * rows[place[axis]][i]
            patch = cls(degrees, new)
        return patch

    def lines(self, axis: int) -> dict[tuple[int, ...], list[fmpq]]:
        """The coefficients along an axis, by the places on the other axes."""
        found: dict[tuple[int, ...], list[fmpq]] = {}
        for place in sorted(self.at):
            rest = (*place[:axis], *place[axis + 1 :])
            found.setdefault(rest, []).append(self.at[place])
        return found

    def halves(self, axis: int) -> tuple[Patch, Patch]:
        """De Casteljau; the axis is the first one of both halves."""
        degrees = (self.degrees[axis], *self.degrees[:axis], *self.degrees[axis + 1 :])
        lower: Tensor = {}
        upper: Tensor = {}
        for rest, row in self.lines(axis).items():
            last = len(row) - 1
            for k in range(len(row)):
                lower[(k, *rest)] = row[0]
                upper[(last - k, *rest)] = row[-1]
                row = [(a + b) / 2 for a, b in zip(row, row[1:])]
        return Patch(degrees, lower), Patch(degrees, upper)

    def face(self, axis: int) -> Patch | None:
        """The face on which the polynomial is largest, where no coefficient along the axis is less
        than the one before, or none is greater; else nothing.
        """
        lines = self.lines(axis)
        degrees = (*self.degrees[:axis], *self.degrees[axis + 1 :])
        steps = [b - a for row in lines.values() for a, b in zip(row, row[1:])]
        if all(step >= 0 for step in steps):
            return Patch(degrees, {rest: row[-1] for rest, row in lines.items()})
        if all(step <= 0 for step in steps):
            return Patch(degrees, {rest: row[0] for rest, row in lines.items()})
        return None
