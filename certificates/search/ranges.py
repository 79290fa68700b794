"""Sets of one parameter as intervals with exact ends, and as conditions that the language of
statements can say.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import fmpq_poly

from certificates import checker
from certificates.terms import Formula, Term, conjunction, disjunction, equal, real, term

from .algebraic import AlgebraicNumber, fraction, real_roots, simplest_between
from .candidates import separate
from .condition import HOLDS, Condition, univariate

MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "=": "=", "!=": "!="}


@dataclass(frozen=True)
class Interval:
    """The numbers between two ends; None is where the domain itself ends."""

    low: AlgebraicNumber | None
    low_closed: bool
    high: AlgebraicNumber | None
    high_closed: bool


@dataclass(frozen=True)
class Line:
    """The domain cut at numbers: the verdicts on its open cells and at the numbers, in order: cell,
    number, cell, ..., cell.
    """

    numbers: tuple[AlgebraicNumber, ...]
    verdicts: tuple[bool, ...]

    def simplified(self) -> Line:
        """The same set, cut only where the verdict changes."""
        numbers: list[AlgebraicNumber] = []
        verdicts = [self.verdicts[0]]
        for k, number in enumerate(self.numbers):
            at, after = self.verdicts[2 * k + 1], self.verdicts[2 * k + 2]
            if not verdicts[-1] == at == after:
                numbers.append(number)
                verdicts += [at, after]
        return Line(tuple(numbers), tuple(verdicts))

    def intervals(self, verdict: bool) -> list[Interval]:
        """The maximal intervals of one verdict, in order."""
        found: list[Interval] = []
        start: tuple[AlgebraicNumber | None, bool] | None = None
        for k, own in enumerate(self.verdicts):
            here = self.numbers[k // 2] if k % 2 else None
            if own == verdict and start is None:
                start = (here, True) if here else (self.numbers[k // 2 - 1] if k else None, False)
            if start is not None and own != verdict:
                end = (here, False) if here else (self.numbers[k // 2 - 1], True)
                found.append(Interval(*start, *end))
                start = None
        return [*found, Interval(*start, None, False)] if start is not None else found


def condition_of(line: Line, parameter: str, domain: Formula) -> Formula:
    """A condition that holds, within the domain, on the cells and numbers of verdict True.

    >>> from certificates.terms import reals
    >>> (a,) = reals("alpha")
    >>> line = Line((AlgebraicNumber.rational(Fraction(1, 3)),), (True, False, False))
    >>> str(condition_of(line, "alpha", a > 0))
    '3*alpha < 1'
    """
    inside = line.intervals(True)
    if not line.intervals(False):
        return domain
    if (
        len(line.intervals(False)) == 1
        and len(inside) == 2
        and line.intervals(False)[0].low is line.intervals(False)[0].high
    ):
        number = line.intervals(False)[0].low
        if number is not None and number.is_rational:
            return Formula("!=", *_rational_sides(number.as_fraction(), parameter))
    single = one_relation(line, parameter, domain)
    return (
        single
        if single is not None
        else disjunction([_interval_formula(i, domain, parameter) for i in inside])
    )


def one_relation(line: Line, parameter: str, domain: Formula) -> Formula | None:
    """p relation 0 for the one irreducible polynomial p of all the ends, where that says the same
    on the domain.

    >>> from certificates.terms import reals
    >>> (a,) = reals("alpha")
    >>> ends = real_roots(fmpq_poly([-1, 10, -20, 10]))[:2]
    >>> line = Line(tuple(ends), (False, False, True, False, False))
    >>> str(one_relation(line, "alpha", (a > 0) & (a < 1)))
    '10*alpha^3 - 20*alpha^2 + 10*alpha - 1 > 0'
    """
    poly = tuple(line.numbers[0].coefficients) if line.numbers else ()
    if len(poly) <= 2 or any(tuple(number.coefficients) != poly for number in line.numbers):
        return None
    if len(isolated(poly, domain, parameter)) != len(line.numbers):
        return None
    rising = line.numbers[0].sign_of(fmpq_poly(line.numbers[0].poly).derivative()) > 0
    signs = [
        0 if k % 2 else 1 if (k // 2 % 2 == 1) == rising else -1 for k in range(len(line.verdicts))
    ]
    relation = next((r for r in HOLDS if [HOLDS[r](s) for s in signs] == list(line.verdicts)), None)
    if relation is None:
        relation = next(
            (MIRRORED[r] for r in HOLDS if [HOLDS[r](-s) for s in signs] == list(line.verdicts)),
            None,
        )
    return Formula(relation, polynomial_term(poly, parameter), term(0)) if relation else None


def _interval_formula(interval: Interval, domain: Formula, parameter: str) -> Formula:
    if interval.low is not None and interval.low is interval.high:
        return _bound(interval.low, "=", domain, parameter)
    parts = []
    if interval.low is not None:
        parts.append(_bound(interval.low, ">=" if interval.low_closed else ">", domain, parameter))
    if interval.high is not None:
        parts.append(
            _bound(interval.high, "<=" if interval.high_closed else "<", domain, parameter)
        )
    return conjunction(parts)


def _rational_sides(value: Fraction, parameter: str) -> tuple[Term, Term]:
    name = real(parameter)
    return (name if value.denominator == 1 else value.denominator * name), term(value.numerator)


def polynomial_term(coefficients: Sequence[int], parameter: str) -> Term:
    """An integer polynomial, constant first, as a term with the highest power first."""
    name, total = real(parameter), None
    for power, c in reversed(list(enumerate(coefficients))):
        if c:
            size: Term = term(abs(c)) if power == 0 else name if power == 1 else name**power
            if power and abs(c) != 1:
                size = abs(c) * size
            total = (
                (size if c > 0 else -size)
                if total is None
                else total + size
                if c > 0
                else total - size
            )
    return term(0) if total is None else total


def _bound(number: AlgebraicNumber, relation: str, domain: Formula, parameter: str) -> Formula:
    """parameter relation number, exact on the domain: by the sign of the polynomial on the interval
    on which this is its only root.
    """
    if number.is_rational:
        return Formula(relation, *_rational_sides(number.as_fraction(), parameter))
    rising = number.sign_of(fmpq_poly(number.poly).derivative()) > 0
    poly, name = polynomial_term(number.coefficients, parameter), real(parameter)
    intervals = isolated(number.coefficients, domain, parameter)
    low, high = next(pair for pair in intervals if pair[0] < number < pair[1])
    parts = [name > low] * (low != intervals[0][0]) + [name < high] * (high != intervals[-1][1])
    if relation == "=":
        return conjunction([equal(poly, 0), *parts])
    own = Formula(relation if rising else MIRRORED[relation], poly, term(0))
    below = [name <= low] * (low != intervals[0][0])
    above = [name >= high] * (high != intervals[-1][1])
    return disjunction([*(below if relation in ("<", "<=") else above), conjunction([*parts, own])])


def isolated(
    coefficients: Sequence[int], domain: Formula, parameter: str
) -> list[tuple[Fraction, Fraction]]:
    """Intervals that fill the domain (or what holds all roots, where it has no ends), each with one
    root of an irreducible polynomial.

    >>> a = real("alpha")
    >>> isolated([-1, 10, -20, 10], (a > 0) & (a < 1), "alpha")
    [(Fraction(0, 1), Fraction(1, 2)), (Fraction(1, 2), Fraction(1, 1))]
    """
    bottom, top = ends_of(checker.parse(str(domain)), parameter)
    roots = [
        r
        for r in real_roots(fmpq_poly(list(coefficients)))
        if (bottom is None or r > bottom) and (top is None or r < top)
    ]
    separate(roots)
    low = fraction(roots[0]._low) - 1 if bottom is None else bottom
    high = fraction(roots[-1]._high) + 1 if top is None else top
    cuts = [
        low,
        *(
            fraction(simplest_between(left._high, right._low))
            for left, right in zip(roots, roots[1:])
        ),
        high,
    ]
    return list(zip(cuts, cuts[1:]))


def ends_of(domain: Any, parameter: str) -> tuple[Fraction | None, Fraction | None]:
    """The rational ends of a domain, as the checker parses it, that bounds the parameter by
    relations linear in it; None where it has no such end.
    """
    context = checker.Context()
    context.declare(parameter)
    bounds: dict[bool, list[Fraction]] = {True: [], False: []}
    for poly, relation in Condition.of(context, context.formula(domain)).facts():
        line = univariate(poly, parameter)
        if line.degree() == 1 and relation in (">", ">="):
            bounds[bool(line[1] > 0)].append(fraction(-line[0] / line[1]))
    return max(bounds[True], default=None), min(bounds[False], default=None)
