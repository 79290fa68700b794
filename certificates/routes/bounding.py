"""Boxes that hold every solution of some facts: exact interval propagation with ends that may be infinite, rounded outwards."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from math import comb

from certificates.routes.polynomials import Atom, Polynomial

End = tuple[int, Fraction]  # (-1, 0) and (1, 0) are the infinite ends, (0, q) is q: tuples compare as the ends do
Interval = tuple[End, End]
LINE: Interval = ((-1, Fraction(0)), (1, Fraction(0)))
ROUNDS, SHIFTS, GRID, SHORT = 4, 6, 16, 48


def bounding_box(facts: Sequence[Atom], width: int) -> list[Interval] | None:
    """Intervals for all variables, outside which some fact fails; None where the facts contradict each other on the way.

    Formula: p = sum c_k x^k with c_k <= u_k on the box so far; where x >= 0 and the shifted u(x + t) has no positive coefficient, p <= 0
    beyond t.  Source: interval constraint propagation; Descartes' rule of signs for the shift.
    """
    box = [LINE] * width
    sides = [(fact, p) for fact in facts if fact.relation != "!=" for p in _signs(fact)]
    if not _propagate(sides, box):
        return None
    used = {i for fact in facts for i in fact.poly.used}
    if any(_infinite(box[i]) for i in used):
        # the bounds of one variable often need a better lower end of another, such as s >= 1.4 from s^2 > 2
        for i in sorted(used):
            if not _infinite(box[i]) and not _shave(sides, box, i):
                return None
        return box if _propagate(sides, box) else None
    return box


def _infinite(side: Interval) -> bool:
    return bool(side[0][0] or side[1][0])


def _shave(sides: Sequence[tuple[Atom, Polynomial]], box: list[Interval], i: int) -> bool:
    """Cuts slices from both ends of a side on which some fact fails; False where nothing is left."""
    for at_low in (True, False):
        share = Fraction(1, 2)
        while share >= Fraction(1, 8):
            (_, low), (_, high) = box[i]
            cut = rounded(low + (high - low) * share, False) if at_low else rounded(high - (high - low) * share, True)
            if not low < cut < high:
                break
            slice_ = ((0, low), (0, cut)) if at_low else ((0, cut), (0, high))
            trial = [*box[:i], slice_, *box[i + 1:]]
            if any(end < (0, Fraction(0)) or fact.relation == ">" and end == (0, Fraction(0))
                   for fact, p in sides if i in p.used for end in (upper_end(p, trial),)):
                box[i] = ((0, cut), (0, high)) if at_low else ((0, low), (0, cut))
            else:
                share /= 2
    return box[i][0] <= box[i][1]


def _propagate(sides: Sequence[tuple[Atom, Polynomial]], box: list[Interval]) -> bool:
    """Moves ends inwards, in a few rounds, and to finite values where it can; False where an interval becomes empty."""
    for _ in range(ROUNDS):
        changed = False
        for _, p in sides:
            for i in p.used:
                for direction in (1, -1):
                    end = _end_along(p, i, direction, box)
                    if end is None:
                        continue
                    low, high = box[i]
                    end = rounded(end, direction > 0)
                    new = (low, min(high, (0, end))) if direction > 0 else (max(low, (0, end)), high)
                    if new[0] > new[1]:
                        return False
                    if new != box[i] and _worth(box[i], new):
                        box[i], changed = new, True
        if not changed:
            break
    return True


def _signs(fact: Atom) -> list[Polynomial]:
    """The polynomials that the fact makes >= 0."""
    return [fact.poly, fact.poly.minus] if fact.relation == "=" else [fact.poly]


def _worth(old: Interval, new: Interval) -> bool:
    """Whether an end became finite, or the interval lost a sixteenth of its width."""
    if old[0][0] != new[0][0] or old[1][0] != new[1][0]:
        return True
    if _infinite(old):
        return False
    return 16 * (new[1][1] - new[0][1]) < 15 * (old[1][1] - old[0][1])


def _end_along(p: Polynomial, i: int, direction: int, box: list[Interval]) -> Fraction | None:
    """t such that p >= 0 fails for direction * x_i > direction * t, or None where none is found."""
    tops, constant = [Fraction(0)] * (p.degrees[i] + 1), p.degrees[i] == 1
    for k, coefficient in reversed(p.collected(i)):
        low, high = span(coefficient, box)
        top = high if direction > 0 or k % 2 == 0 else (-low[0], -low[1])
        if top[0] > 0:
            return None
        tops[k] = top[1]
        constant = constant and (k != 1 or not coefficient.used)
    while len(tops) > 1 and tops[-1] == 0:
        tops.pop()
    if len(tops) < 2 or tops[-1] > 0:
        return None
    if len(tops) == 2:
        # a line falls everywhere, so its zero bounds x on either side of 0 only where p is one line: c_1 a constant
        zero = -tops[0] / tops[1]
        return direction * (zero if constant else max(zero, Fraction(0)))
    end = 1 + max(max(c, Fraction(0)) for c in tops[:-1]) / -tops[-1]
    low = Fraction(0)
    for _ in range(SHIFTS):  # Cauchy's bound, then the least shift that is seen to be beyond all roots
        middle = rounded((low + end) / 2, up=True)
        if low < middle < end and all(c <= 0 for c in _shifted(tops, middle)):
            end = middle
        else:
            low = middle
    return direction * end


def _shifted(coefficients: Sequence[Fraction], by: Fraction) -> list[Fraction]:
    shifted = list(coefficients)
    for k in range(len(shifted) - 1):
        for j in range(len(shifted) - 2, k - 1, -1):
            shifted[j] += by * shifted[j + 1]
    return shifted


def upper_end(p: Polynomial, box: Sequence[Interval]) -> End:
    """An upper end for the polynomial on the box."""
    return span(p, box)[1]


def span(p: Polynomial, box: Sequence[Interval]) -> Interval:
    """An interval that holds all values of the polynomial on the box.

    Formula: sum c_k x^k for the first unbounded variable x, each c_k bounded first: so 8*a*x - 4*x - 4*a^2*x is seen to be -4*(1 - a)^2*x.
    In one bounded variable, by Bernstein coefficients.
    """
    unbounded = next((i for i in p.used if box[i][0][0] or box[i][1][0]), None)
    if unbounded is not None and len(p.used) > 1:
        total: Interval = ((0, Fraction(0)), (0, Fraction(0)))
        for k, coefficient in p.collected(unbounded):
            inner = span(coefficient, box)
            total = _plus(total, _times(inner, power_span(box[unbounded], k)) if k else inner)
        return total
    if len(p.used) == 1 and len(p.terms) > 1 and unbounded is None:
        (i,) = p.used
        coefficients = {e[i]: c for e, c in p.terms}
        low, high = _bernstein_range(tuple(coefficients.get(k, 0) for k in range(p.degrees[i] + 1)), box[i][0][1], box[i][1][1])
        return (0, low / p.den), (0, high / p.den)
    return _termwise(p, box)


@lru_cache(maxsize=4096)
def _bernstein_range(coefficients: tuple[int, ...], low: Fraction, high: Fraction) -> tuple[Fraction, Fraction]:
    """The least and the largest Bernstein coefficient of a polynomial in one variable on [low, high]: they enclose its values there."""
    shifted = _shifted([Fraction(c) for c in coefficients], low)
    n, scaled = len(shifted) - 1, [c * (high - low) ** k for k, c in enumerate(shifted)]
    bernstein = [sum((scaled[i] * Fraction(comb(j, i), comb(n, i)) for i in range(j + 1)), Fraction(0)) for j in range(n + 1)]
    return min(bernstein), max(bernstein)


def _termwise(p: Polynomial, box: Sequence[Interval]) -> Interval:
    total: Interval = ((0, Fraction(0)), (0, Fraction(0)))
    for exponents, c in p.terms:
        term: Interval = ((0, Fraction(c)), (0, Fraction(c)))
        for i, e in enumerate(exponents):
            if e:
                term = _times(term, power_span(box[i], e))
        total = _plus(total, term)
    return total


def _plus(a: Interval, b: Interval) -> Interval:
    def end(x: End, y: End, side: int) -> End:
        return (side, Fraction(0)) if side in (x[0], y[0]) else (x[0] or y[0], x[1] + y[1])

    return end(a[0], b[0], -1), end(a[1], b[1], 1)


def power_span(span: Interval, exponent: int) -> Interval:
    """The interval of x^exponent: even powers of what holds 0 begin at 0."""
    low, high = (_power(end, exponent) for end in span)
    if exponent % 2:
        return low, high
    if span[0] <= (0, Fraction(0)) <= span[1]:
        return (0, Fraction(0)), max(low, high)
    return min(low, high), max(low, high)


def _power(end: End, exponent: int) -> End:
    return (end[0] ** exponent, Fraction(0)) if end[0] else (0, end[1] ** exponent)


def _times(a: Interval, b: Interval) -> Interval:
    corners = [_product(x, y) for x in a for y in b]
    return min(corners), max(corners)


def _product(a: End, b: End) -> End:
    if not a[0] and not b[0]:
        return (0, a[1] * b[1])
    sign = (a[0] or _sign(a[1])) * (b[0] or _sign(b[1]))  # 0 times an infinite end is 0: the ends are limits of finite ones
    return (sign, Fraction(0))


def _sign(value: Fraction) -> int:
    return (value > 0) - (value < 0)


def rounded(value: Fraction, up: bool) -> Fraction:
    """The value itself where it is short, else a number with few digits beyond it: propagation would make the digits grow without end.

    >>> rounded(Fraction(1, 3), True), rounded(Fraction(10**30 + 1, 3 * 10**30), True)
    (Fraction(1, 3), Fraction(11184811, 33554432))
    """
    size = value.numerator.bit_length() - value.denominator.bit_length()
    if value.denominator.bit_length() + value.numerator.bit_length() <= SHORT:
        return value
    unit = Fraction(2) ** (size - SHORT // 2)
    scaled = value / unit
    return unit * (-(-scaled.numerator // scaled.denominator) if up else scaled.numerator // scaled.denominator)


def dyadic(low: Fraction, high: Fraction) -> tuple[int, int, int]:
    """(m, r, e) with [low, high] inside [(m - r) 2^e, (m + r) 2^e], r below 2^17.

    >>> dyadic(Fraction(0), Fraction(1, 3))
    (21846, 21846, -17)
    """
    e = -GRID
    while (high - low) > (1 << GRID) * Fraction(2) ** e:
        e += 1
    unit = Fraction(2) ** e
    a, b = low / unit, high / unit
    first, last = a.numerator // a.denominator, -(-b.numerator // b.denominator)
    return first + last, last - first, e - 1
