"""Where boxes cannot decide, because equality is attained: enclosures of the infimum of what is
shown to be positive.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from certificates.routes.polynomials import Atom, Formula, Polynomial, atom, join
from certificates.routes.questions import Question
from certificates.routes.reduction import insert
from certificates.routes.regions import Region, regions
from certificates.routes.search_boxes import enclose_infimum
from certificates.routes.votes import Enclosure


@dataclass(frozen=True)
class GoalBound:
    """Enclosures of inf p for each part p > 0 or p >= 0 of the goal; `positive` where they show the
    goal, `point` where one refutes it.
    """

    enclosures: tuple[Enclosure, ...]
    positive: bool
    confirmed: bool
    boxes: int
    point: list[Fraction] | None = None

    @property
    def narrow(self) -> bool:
        """Whether every enclosure has the width that was wanted."""
        return all(e.high - e.low <= e.wanted for e in self.enclosures)

    @property
    def room(self) -> bool:
        """Whether the goal may hold with room to spare, so that more boxes may decide it."""
        return not self.narrow and all(e.high > e.wanted for e in self.enclosures)

    def opinions(self) -> tuple[tuple[str, str], ...]:
        """What each arithmetic found."""
        return (
            ("arb", "encloses"),
            (
                "mpmath.iv",
                "agrees on the lowest box" if self.confirmed else "undecided on the lowest box",
            ),
        )


def enclose_goal(question: Question, width: Fraction, allowance: int) -> GoalBound | None:
    """The enclosures, for a goal that is a conjunction of inequalities; None for any other, or
    where nothing bounds the region.

    Formula: the infimum is taken over all points that meet the premises.
    """
    formula = join("or", [denial.formula for denial in question.denials])
    parts = (
        (formula,)
        if isinstance(formula, Atom)
        else ()
        if isinstance(formula, bool) or formula.op == "and"
        else formula.parts
    )
    denied = [part for part in parts if isinstance(part, Atom) and part.relation in (">", ">=")]
    if not denied or len(denied) < len(parts):
        return None
    assumed, enclosures, boxes, positive, confirmed = (
        join("and", question.assumed),
        [],
        0,
        True,
        True,
    )
    for part in denied:
        poly = Polynomial.of(part.poly.names, {e: -c for e, c in part.poly.terms}, part.poly.den)
        found = _infimum(assumed, poly, width, allowance // len(denied))
        if found is None:
            return None
        boxes += found.boxes
        enclosure = Enclosure(
            str(poly), _short(found.low, up=False), _short(found.high, up=True), width
        )
        if part.holds(-found.high):
            return GoalBound((enclosure,), False, found.confirmed, boxes, found.point)
        enclosures.append(enclosure)
        confirmed = confirmed and found.confirmed
        positive = positive and not part.holds(-found.low)
    return GoalBound(tuple(enclosures), positive, confirmed, boxes)


def _short(value: Fraction, up: bool) -> Fraction:
    """The next multiple of 2^-20: an enclosure with readable ends."""
    scaled = value * (1 << 20)
    return Fraction(
        (
            -(-scaled.numerator // scaled.denominator)
            if up
            else scaled.numerator // scaled.denominator
        ),
        1 << 20,
    )


@dataclass
class Found:
    """low <= inf <= high, the latter attained at the point."""

    low: Fraction
    high: Fraction
    point: list[Fraction]
    boxes: int
    confirmed: bool


def _infimum(assumed: Formula, poly: Polynomial, width: Fraction, allowance: int) -> Found | None:
    """The infimum of the polynomial where the formula holds.

    It is not above a value that is attained, so only the part of the region at or below that value
    matters, and that part may be bounded.
    """
    start = _attained(assumed, poly)
    if start is None:
        return None
    level, point = start
    parts = regions(poly.names, join("and", [assumed, atom(_less(poly, level), ">=")]))
    if parts is None or any(region.unbounded() for region in parts):
        return None
    found = Found(level, level, point, 0, True)
    for region in parts:
        aim = poly
        for step in region.solved:
            aim = insert(aim, step)
        inner = enclose_infimum(
            aim,
            region.facts,
            region.box(),
            found.high,
            width,
            allowance // len(parts),
            region.test(assumed),
        )
        if inner is None:
            return None
        found.boxes += inner.boxes
        if inner.point is not None:
            found.high, found.point = inner.high, region.complete(inner.point)
        found.low, found.confirmed = (
            min(found.low, inner.low, found.high),
            found.confirmed and inner.confirmed,
        )
    return found


def _less(poly: Polynomial, level: Fraction) -> Polynomial:
    """level - poly, times a positive number."""
    terms = {e: -c * level.denominator for e, c in poly.terms}
    constant = (0,) * len(poly.names)
    terms[constant] = terms.get(constant, 0) + level.numerator * poly.den
    return Polynomial.of(poly.names, terms)


def _attained(assumed: Formula, poly: Polynomial) -> tuple[Fraction, list[Fraction]] | None:
    """The least value of the polynomial at a few exact points of the region, with its point; None
    where none is met.
    """
    parts: list[Region] = regions(poly.names, assumed) or []
    met = [(poly.at(point), point) for region in parts for point in region.samples(assumed)]
    return min(met, key=lambda pair: pair[0]) if met else None
