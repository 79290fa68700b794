"""Sets of one parameter as intervals with exact ends, and as conditions that the language of statements can say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq, fmpq_poly

from certificates.terms import Formula, Term, conjunction, disjunction, equal, real, term

from .algebraic import AlgebraicNumber, enclose, fraction, real_roots, simplest_between

MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "=": "="}


@dataclass(frozen=True)
class Interval:
    """The numbers between two ends; None is where the domain itself ends."""

    low: AlgebraicNumber | None
    low_closed: bool
    high: AlgebraicNumber | None
    high_closed: bool


@dataclass(frozen=True)
class Line:
    """The domain cut at numbers: the verdicts on its open cells and at the numbers, in order: cell, number, cell, ..., cell."""

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
    >>> str(condition_of(Line((AlgebraicNumber.rational(Fraction(1, 3)),), (True, False, False)), "alpha", a > 0))
    '3*alpha < 1'
    """
    inside = line.intervals(True)
    if not line.intervals(False):
        return domain
    if len(line.intervals(False)) == 1 and len(inside) == 2 and line.intervals(False)[0].low is line.intervals(False)[0].high:
        number = line.intervals(False)[0].low
        if number is not None and number.is_rational:
            return Formula("!=", *_rational_sides(number.as_fraction(), parameter))
    return disjunction([_interval_formula(i, line.numbers, parameter) for i in inside])


def _interval_formula(interval: Interval, numbers: Sequence[AlgebraicNumber], parameter: str) -> Formula:
    if interval.low is not None and interval.low is interval.high:
        return _bound(interval.low, "=", numbers, parameter)
    parts = []
    if interval.low is not None:
        parts.append(_bound(interval.low, ">=" if interval.low_closed else ">", numbers, parameter))
    if interval.high is not None:
        parts.append(_bound(interval.high, "<=" if interval.high_closed else "<", numbers, parameter))
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
            total = (size if c > 0 else -size) if total is None else total + size if c > 0 else total - size
    return term(0) if total is None else total


def _bound(number: AlgebraicNumber, relation: str, numbers: Sequence[AlgebraicNumber], parameter: str) -> Formula:
    """parameter relation number, exact everywhere: by the sign of the polynomial between separators, by the separators beyond."""
    if number.is_rational:
        return Formula(relation, *_rational_sides(number.as_fraction(), parameter))
    rising = number.sign_of(fmpq_poly(number.poly).derivative()) > 0
    poly, name = polynomial_term(number.coefficients, parameter), real(parameter)
    low, high = separators(number)
    near = conjunction([name > low, name < high])
    if relation == "=":
        return conjunction([equal(poly, 0), name > low, name < high])
    own = Formula(relation if rising else MIRRORED[relation], poly, term(0))
    if single_in_unit(number):
        return own
    if relation in ("<", "<="):
        return disjunction([name <= low, conjunction([near, own])])
    return disjunction([name >= high, conjunction([near, own])])


def single_in_unit(number: AlgebraicNumber) -> bool:
    """Whether the polynomial of a number in (0, 1) has no other root there."""
    return sum(0 < root < 1 for root in real_roots(fmpq_poly(number.poly))) == 1


def separators(number: AlgebraicNumber) -> tuple[Fraction, Fraction]:
    """Simple rationals on both sides of a number, with its polynomial rising or falling all the way between them."""
    slope = fmpq_poly(number.poly).derivative()
    while True:
        low, high = enclose(slope, number._low, number._high)
        if low > 0 or high < 0:
            break
        number.refine()
    # Widen to short fractions as long as the slope keeps its sign, so that the root stays the only one.
    width = number._high - number._low
    for power in range(1, 40):
        room = fmpq(1, 2**power)
        if room < width / 2:
            break
        below = simplest_between(number._low - room, number._low)
        above = simplest_between(number._high, number._high + room)
        least, most = enclose(slope, below, above)
        if (least > 0 or most < 0) and below >= 0 and above <= 1:
            return fraction(below), fraction(above)
    return number.low, number.high
