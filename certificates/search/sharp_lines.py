"""On which values of one parameter statements hold: candidate end points by elimination, verdicts
by Z3 between them and at them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from flint import fmpq

from certificates import checker

from .algebraic import AlgebraicNumber, simplest_between
from .budget import Budget
from .candidates import FAVOURITE_PARAMETERS, separate
from .condition import Condition
from .elimination import border_polynomials, candidate_numbers
from .ranges import Line
from .violations import Violation

QUICK = 100_000  # Z3's work where a guess will do
Verdicts = dict[str, tuple[bool, ...]]


class Undecided(Exception):
    """Why there is no line of verdicts."""


@dataclass
class Verdict:
    """One statement's verdicts on the cells and at the numbers between them; None where Z3 has
    none.
    """

    violation: Violation
    cells: list[bool]
    numbers: list[bool | None]


class Lines:
    """The verdicts of all statements along a domain that is one interval of one parameter.

    Raises Undecided where Z3 has no verdict on an open cell, or the domain is not such.
    """

    def __init__(
        self,
        violations: Sequence[Violation],
        parameter: str,
        domain: Any,
        budget: Budget,
        more: Sequence[AlgebraicNumber] = (),
    ) -> None:
        self.parameter, self.budget = parameter, budget
        context = checker.Context()
        context.declare(parameter)
        allowed = Condition.of(context, context.formula(domain))
        if isinstance(allowed.tree, bool):
            raise Undecided("the domain says nothing about the parameter")
        borders = border_polynomials(
            [(v.condition, v.goal) for v in violations], [parameter], budget
        )
        cells = allowed.in_one_variable(parameter)
        numbers = candidate_numbers(
            [*(p.project_to_context(allowed.ring) for p in borders), *allowed.polys], parameter
        )
        numbers = sorted([*numbers, *(n for n in more if n not in numbers)])
        separate(numbers)
        self.inner = [n for n in numbers if allowed.univariate_truth(parameter, n, cells)]
        samples = _cell_samples(numbers, len(self.inner) + 1, allowed, parameter, cells)
        if samples is None:
            raise Undecided("the domain is not one interval")
        self.each = [self._verdict(violation, samples) for violation in violations]

    def _verdict(self, violation: Violation, samples: Sequence[fmpq]) -> Verdict:
        cells = []
        for sample in samples:
            verdict = violation.absent(self.parameter, sample, self.budget)
            if verdict is None:
                raise Undecided(f"no verdict on {violation.name} at {self.parameter} = {sample}")
            cells.append(verdict)
        numbers = [
            self._at(violation, number, before, after)
            for number, before, after in zip(self.inner, cells, cells[1:])
        ]
        return Verdict(violation, cells, numbers)

    def _at(
        self, violation: Violation, number: AlgebraicNumber, before: bool, after: bool
    ) -> bool | None:
        """The verdict at a number between two cells; theirs if they agree and the number is hard
        for Z3.
        """
        if before == after and not number.is_rational:
            verdict = (
                violation.absent(self.parameter, number, self.budget, QUICK)
                if number.poly.degree() <= 2
                else None
            )
            return before if verdict is None else verdict
        return violation.absent(self.parameter, number, self.budget)

    def guesses(self) -> Iterator[tuple[Line, Verdicts]]:
        """The lines to try: undecided numbers held to be in, then out; then with Z3 asked at every
        number; each line once.
        """
        seen: list[Verdicts] = []
        for thorough in (False, True):
            if thorough:
                self.each = [replace(one, numbers=self._asked_again(one)) for one in self.each]
            for doubtful in (True, False):
                verdicts = {one.violation.name: _joined(one, doubtful) for one in self.each}
                if verdicts not in seen:
                    seen.append(verdicts)
                    yield (
                        Line(tuple(self.inner), tuple(all(v) for v in zip(*verdicts.values()))),
                        verdicts,
                    )

    def _asked_again(self, one: Verdict) -> list[bool | None]:
        found = []
        for number, before, after, verdict in zip(
            self.inner, one.cells, one.cells[1:], one.numbers
        ):
            if before == after == verdict and number.poly.degree() > 2:
                verdict = one.violation.absent(self.parameter, number, self.budget, QUICK)
                verdict = before if verdict is None else verdict
            found.append(verdict)
        return found


def _joined(one: Verdict, doubtful: bool) -> tuple[bool, ...]:
    joined = [one.cells[0]]
    for at, after in zip(one.numbers, one.cells[1:]):
        joined += [doubtful if at is None else at, after]
    return tuple(joined)


def _cell_samples(
    numbers: Sequence[AlgebraicNumber], count: int, allowed: Condition, parameter: str, cells: Any
) -> list[fmpq] | None:
    """A simple rational in every open cell of the domain, which has to be one interval."""
    borders = [(left._high, right._low) for left, right in zip(numbers, numbers[1:])]
    if numbers:
        borders = [
            (numbers[0]._low - 2, numbers[0]._low),
            *borders,
            (numbers[-1]._high, numbers[-1]._high + 2),
        ]
    samples = []
    for bottom, top in borders or [(fmpq(-2), fmpq(2))]:
        nice = [v for v in FAVOURITE_PARAMETERS if bottom < v < top]
        value = nice[0] if nice else simplest_between(bottom, top)
        if allowed.univariate_truth(parameter, value, cells):
            samples.append(value)
    return samples if len(samples) == count else None
