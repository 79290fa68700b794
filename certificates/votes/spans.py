"""Exact intervals whose ends may be infinite, and the values of polynomials on boxes of them."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from importlib import import_module
from math import comb
from typing import Any

from juggleproof.certificates.votes.questions import Atom, Polynomial

# -------------------------------------------------------------------------------------------------
# Exact intervals whose ends may be infinite, and the values of polynomials on boxes of them.
#
# The numbers are flint's rationals, which are exact too and far quicker than Fraction: regions are
# bounded with many of them.

Rational = Any  # flint.fmpq
End = tuple[
    int, Rational
]  # (-1, 0) and (1, 0) are the infinite ends, (0, q) is q: tuples compare as the ends do
Interval = tuple[End, End]


@lru_cache(maxsize=1)
def _fmpq() -> Any:
    return import_module("flint").fmpq


def rational(value: int | Fraction) -> Rational:
    """The same number for flint."""
    return _fmpq()(value.numerator, value.denominator)


def fraction(value: Rational) -> Fraction:
    """The same number for Python."""
    return Fraction(int(value.p), int(value.q))


def zero_end() -> End:
    """The end 0."""
    return (0, _fmpq()(0))


def upper_end(p: Polynomial, box: Sequence[Interval]) -> End:
    """An upper end for the polynomial on the box."""
    return span(p, box)[1]


def span(p: Polynomial, box: Sequence[Interval]) -> Interval:
    """An interval that holds all values of the polynomial on the box.

    Formula: sum c_k x^k for the first unbounded variable x, each c_k bounded first: so 8*a*x - 4*x
    - 4*a^2*x is seen to be -4*(1 - a)^2*x. In one bounded variable, by Bernstein coefficients.
    """
    unbounded = next((i for i in p.used if box[i][0][0] or box[i][1][0]), None)
    if unbounded is not None and len(p.used) > 1:
        total: Interval = (zero_end(), zero_end())
        for k, coefficient in p.collected(unbounded):
            inner = span(coefficient, box)
            total = _plus(total, _times(inner, power_span(box[unbounded], k)) if k else inner)
        return total
    if len(p.used) == 1 and len(p.terms) > 1 and unbounded is None:
        (i,) = p.used
        coefficients = {e[i]: c for e, c in p.terms}
        low, high = _bernstein_range(
            tuple(coefficients.get(k, 0) for k in range(p.degrees[i] + 1)),
            box[i][0][1],
            box[i][1][1],
        )
        return (0, low / p.den), (0, high / p.den)
    return _termwise(p, box)


@lru_cache(maxsize=4096)
def _bernstein_range(
    coefficients: tuple[int, ...], low: Rational, high: Rational
) -> tuple[Rational, Rational]:
    """The least and the largest Bernstein coefficient of a polynomial in one variable on [low,
    high]: they enclose its values there.
    """
    moved = shifted([rational(c) for c in coefficients], low)
    n, scaled = len(moved) - 1, [c * (high - low) ** k for k, c in enumerate(moved)]
    bernstein = [
        sum(
            (scaled[i] * rational(Fraction(comb(j, i), comb(n, i))) for i in range(j + 1)),
            rational(0),
        )
        for j in range(n + 1)
    ]
    return min(bernstein), max(bernstein)


def _termwise(p: Polynomial, box: Sequence[Interval]) -> Interval:
    total: Interval = (zero_end(), zero_end())
    for exponents, c in p.terms:
        term: Interval = ((0, rational(c)), (0, rational(c)))
        for i, e in enumerate(exponents):
            if e:
                term = _times(term, power_span(box[i], e))
        total = _plus(total, term)
    return total


def _plus(a: Interval, b: Interval) -> Interval:
    def end(x: End, y: End, side: int) -> End:
        return (side, rational(0)) if side in (x[0], y[0]) else (x[0] or y[0], x[1] + y[1])

    return end(a[0], b[0], -1), end(a[1], b[1], 1)


def power_span(span: Interval, exponent: int) -> Interval:
    """The interval of x^exponent: even powers of what holds 0 begin at 0."""
    low, high = (_power(end, exponent) for end in span)
    if exponent % 2:
        return low, high
    if span[0] <= zero_end() <= span[1]:
        return zero_end(), max(low, high)
    return min(low, high), max(low, high)


def _power(end: End, exponent: int) -> End:
    return (end[0] ** exponent, end[1]) if end[0] else (0, end[1] ** exponent)


def _times(a: Interval, b: Interval) -> Interval:
    corners = [_product(x, y) for x in a for y in b]
    return min(corners), max(corners)


def _product(a: End, b: End) -> End:
    if not a[0] and not b[0]:
        return (0, a[1] * b[1])
    sign = (a[0] or _sign(a[1])) * (
        b[0] or _sign(b[1])
    )  # 0 times an infinite end is 0: the ends are limits of finite ones
    return (sign, rational(0))


def _sign(value: Rational) -> int:
    return int(value > 0) - int(value < 0)


def shifted(coefficients: Sequence[Rational], by: Rational) -> list[Rational]:
    """The coefficients of u(x + by), constant first."""
    moved = list(coefficients)
    for k in range(len(moved) - 1):
        for j in range(len(moved) - 2, k - 1, -1):
            moved[j] += by * moved[j + 1]
    return moved


# -------------------------------------------------------------------------------------------------
# Boxes that hold every solution of some facts: exact propagation of bounds that may be infinite at
# first, rounded outwards.

Bounds = tuple[tuple[int, Fraction], tuple[int, Fraction]]  # as Interval, in Python's rationals
ROUNDS, SHIFTS, SLICES, GRID, SHORT = 4, 6, 12, 16, 48


def bounding_box(facts: Sequence[Atom], width: int) -> list[Bounds] | None:
    """Bounds for all variables, outside which some fact fails; None where the facts contradict each
    other on the way.

    Formula: p = sum c_k x^k with c_k <= u_k on the box so far; where x >= 0 and the shifted u(x +
    t) has no positive coefficient, p <= 0 beyond t.  Source: interval constraint propagation;
    Descartes' rule of signs for the shift.
    """
    box: list[Interval] = [((-1, rational(0)), (1, rational(0)))] * width
    sides = [(fact, p) for fact in facts if fact.relation != "!=" for p in _signs(fact)]
    found = _propagate(sides, box)
    used = sorted({i for fact in facts for i in fact.poly.used})
    if found and any(_infinite(box[i]) for i in used):
        # the bounds of one variable often need a better lower end of another, such as s >= 1.4 from
        # s^2 > 2
        found = all(_infinite(box[i]) or _shave(sides, box, i) for i in used) and _propagate(
            sides, box
        )
    return (
        [((low[0], fraction(low[1])), (high[0], fraction(high[1]))) for low, high in box]
        if found
        else None
    )


def intervals(bounds: Sequence[Bounds]) -> list[Interval]:
    """The bounds in flint's rationals."""
    return [((low[0], rational(low[1])), (high[0], rational(high[1]))) for low, high in bounds]


def _infinite(side: Interval) -> bool:
    return bool(side[0][0] or side[1][0])


def _signs(fact: Atom) -> list[Polynomial]:
    """The polynomials that the fact makes >= 0."""
    return [fact.poly, fact.poly.minus] if fact.relation == "=" else [fact.poly]


def _shave(sides: Sequence[tuple[Atom, Polynomial]], box: list[Interval], i: int) -> bool:
    """Cuts slices from both ends of a bounded side on which some fact fails; False where nothing is
    left.
    """
    mine = [(fact, p) for fact, p in sides if i in p.used]
    for at_low in (True, False):
        pieces = 2
        for _ in range(SLICES):  # a solution at the far end could be neared for ever
            (_, low), (_, high) = box[i]
            step = (high - low) / pieces
            cut = rounded(low + step, up=False) if at_low else rounded(high - step, up=True)
            if not low < cut < high:
                break
            trial = [
                *box[:i],
                ((0, low), (0, cut)) if at_low else ((0, cut), (0, high)),
                *box[i + 1 :],
            ]
            if any(_fails(fact, p, trial) for fact, p in mine):
                box[i] = ((0, cut), (0, high)) if at_low else ((0, low), (0, cut))
            elif pieces == 8:
                break
            else:
                pieces *= 2
    return box[i][0] <= box[i][1]


def _fails(fact: Atom, p: Polynomial, box: Sequence[Interval]) -> bool:
    """Whether p >= 0, or p > 0 for a strict fact, fails everywhere on the box."""
    end = upper_end(p, box)
    return end < zero_end() or fact.relation == ">" and end == zero_end()


def _propagate(sides: Sequence[tuple[Atom, Polynomial]], box: list[Interval]) -> bool:
    """Moves ends inwards, in a few rounds, and to finite values where it can; False where an
    interval becomes empty.
    """
    known: dict[
        tuple[int, int], tuple[tuple[Interval, ...], tuple[Rational | None, Rational | None]]
    ] = {}
    for _ in range(ROUNDS):
        changed = False
        for number, (_, p) in enumerate(sides):
            for i in p.used:
                others = tuple(box[j] for j in p.used if j != i)
                if (number, i) not in known or known[number, i][0] != others:
                    known[number, i] = others, _ends_along(p, i, box)
                for direction, end in zip((1, -1), known[number, i][1]):
                    if end is None:
                        continue
                    low, high = box[i]
                    end = rounded(end, up=direction > 0)
                    new = (
                        (low, min(high, (0, end))) if direction > 0 else (max(low, (0, end)), high)
                    )
                    if new[0] > new[1]:
                        return False
                    if new != box[i] and _worth(box[i], new):
                        box[i], changed = new, True
        if not changed:
            break
    return True


def _worth(old: Interval, new: Interval) -> bool:
    """Whether an end became finite, or the interval lost a sixteenth of its width."""
    if old[0][0] != new[0][0] or old[1][0] != new[1][0]:
        return True
    return not _infinite(old) and bool(16 * (new[1][1] - new[0][1]) < 15 * (old[1][1] - old[0][1]))


def _ends_along(
    p: Polynomial, i: int, box: list[Interval]
) -> tuple[Rational | None, Rational | None]:
    """(t, s) such that p >= 0 fails for x_i > t and for x_i < s; None where none is found."""
    spans = [
        (k, span(coefficient, box), bool(coefficient.used))
        for k, coefficient in reversed(p.collected(i))
    ]
    constant = p.degrees[i] == 1 and not any(k == 1 and varies for k, _, varies in spans)
    up = _end(spans, p.degrees[i], 1, constant)
    down = _end(spans, p.degrees[i], -1, constant)
    return up, None if down is None else -down


def _end(
    spans: Sequence[tuple[int, Interval, bool]], degree: int, direction: int, constant: bool
) -> Rational | None:
    """t such that p >= 0 fails for direction * x > t, from what the coefficients of the powers of x
    lie between.
    """
    none = rational(0)
    tops = [none] * (degree + 1)
    for k, (least, most), _ in spans:
        top = most if direction > 0 or k % 2 == 0 else (-least[0], -least[1])
        if top[0] > 0:
            return None
        tops[k] = top[1]
    while len(tops) > 1 and tops[-1] == 0:
        tops.pop()
    if len(tops) < 2 or tops[-1] > 0:
        return None
    if len(tops) == 2:
        # a line falls everywhere, so its zero bounds x on either side of 0 only where p is one
        # line: c_1 a constant
        zero = -tops[0] / tops[1]
        return zero if constant else max(zero, none)
    end = 1 + max(max(c, none) for c in tops[:-1]) / -tops[-1]
    low = none
    for _ in range(
        SHIFTS
    ):  # Cauchy's bound, then the least shift that is seen to be beyond all roots
        middle = rounded((low + end) / 2, up=True)
        if low < middle < end and all(c <= 0 for c in shifted(tops, middle)):
            end = middle
        else:
            low = middle
    return end


def rounded(value: Rational, up: bool) -> Rational:
    """The value itself where it is short, else a number with few digits beyond it: propagation
    would make the digits grow without end.

    >>> third, near = Fraction(1, 3), Fraction(10**30 + 1, 3 * 10**30)
    >>> fraction(rounded(rational(third), True)), fraction(rounded(rational(near), True))
    (Fraction(1, 3), Fraction(11184811, 33554432))
    """
    p, q = int(value.p), int(value.q)
    if p.bit_length() + q.bit_length() <= SHORT:
        return value
    unit = Fraction(2) ** (p.bit_length() - q.bit_length() - SHORT // 2)
    scaled = Fraction(p, q) / unit
    return rational(
        unit
        * (
            -(-scaled.numerator // scaled.denominator)
            if up
            else scaled.numerator // scaled.denominator
        )
    )


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
