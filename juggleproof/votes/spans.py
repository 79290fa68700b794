"""Exact intervals whose ends may be infinite, and boxes that hold every solution of some facts.

A half-line is no ball, so Arb does not serve here: ends are rational or infinite, and propagation
rounds them outwards to short ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property, lru_cache

from flint import fmpq, fmpq_poly, fmpz_mpoly

from juggleproof.algebra.numbers import bernstein, exact, fraction, sign
from juggleproof.algebra.polynomials import used_in
from juggleproof.votes import limits
from juggleproof.votes.questions import Atom

# -------------------------------------------------------------------------------------------------
# Intervals, and the values of polynomials on boxes of them.

# (-1, 0) and (1, 0) are the infinite ends, (0, q) is q: tuples compare as the ends do
End = tuple[int, fmpq]
Interval = tuple[End, End]
ZERO: End = (0, fmpq(0))


class Expanded:
    """A polynomial with what bounding asks of it again and again."""

    def __init__(self, poly: fmpz_mpoly) -> None:
        self.poly, self.used = poly, used_in(poly)
        self.degrees = tuple(max(0, int(d)) for d in poly.degrees())
        self._collected: dict[int, tuple[tuple[int, Expanded], ...]] = {}

    @cached_property
    def terms(self) -> list[tuple[tuple[int, ...], int]]:
        """(exponents, coefficient) of every term."""
        return [
            (tuple(map(int, m)), int(c)) for m, c in zip(self.poly.monoms(), self.poly.coeffs())
        ]

    def collected(self, i: int) -> tuple[tuple[int, Expanded], ...]:
        """The pairs (k, c_k) with the polynomial = sum c_k x_i^k, each c_k not 0 and without x_i,
        from k = 0 up.
        """
        if i not in self._collected:
            parts: dict[int, dict[tuple[int, ...], int]] = {}
            for e, c in self.terms:
                parts.setdefault(e[i], {})[(*e[:i], 0, *e[i + 1 :])] = c
            ring = self.poly.context()
            self._collected[i] = tuple(
                (k, Expanded(ring.from_dict(part))) for k, part in sorted(parts.items())
            )
        return self._collected[i]


def upper_end(poly: fmpz_mpoly, box: Sequence[Interval]) -> End:
    """An upper end for the polynomial on the box."""
    return span(Expanded(poly), box)[1]


def span(p: Expanded, box: Sequence[Interval]) -> Interval:
    """An interval that holds all values of the polynomial on the box.

    Formula: sum c_k x^k for the first unbounded variable x, each c_k bounded first: so 8*a*x - 4*x
    - 4*a^2*x is seen to be -4*(1 - a)^2*x. In one bounded variable, by Bernstein coefficients.
    """
    unbounded = next((i for i in p.used if box[i][0][0] or box[i][1][0]), None)
    if unbounded is not None and len(p.used) > 1:
        total: Interval = (ZERO, ZERO)
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
        return (0, low), (0, high)
    return _termwise(p, box)


@lru_cache(maxsize=4096)
def _bernstein_range(coefficients: tuple[int, ...], low: fmpq, high: fmpq) -> tuple[fmpq, fmpq]:
    """The least and the largest Bernstein coefficient of a polynomial in one variable on [low,
    high]: they enclose its values there (the convex hull property).
    """
    enclosing = bernstein(
        fmpq_poly(list(coefficients)), fraction(low), fraction(high), len(coefficients) - 1
    )
    return min(enclosing), max(enclosing)


def _termwise(p: Expanded, box: Sequence[Interval]) -> Interval:
    total: Interval = (ZERO, ZERO)
    for exponents, c in p.terms:
        term: Interval = ((0, fmpq(c)), (0, fmpq(c)))
        for i, e in enumerate(exponents):
            if e:
                term = _times(term, power_span(box[i], e))
        total = _plus(total, term)
    return total


def _plus(a: Interval, b: Interval) -> Interval:
    def end(x: End, y: End, side: int) -> End:
        return (side, fmpq(0)) if side in (x[0], y[0]) else (x[0] or y[0], x[1] + y[1])

    return end(a[0], b[0], -1), end(a[1], b[1], 1)


def power_span(span: Interval, exponent: int) -> Interval:
    """The interval of x^exponent: even powers of what holds 0 begin at 0."""
    low, high = (_power(end, exponent) for end in span)
    if exponent % 2:
        return low, high
    if span[0] <= ZERO <= span[1]:
        return ZERO, max(low, high)
    return min(low, high), max(low, high)


def _power(end: End, exponent: int) -> End:
    return (end[0] ** exponent, end[1]) if end[0] else (0, end[1] ** exponent)


def _times(a: Interval, b: Interval) -> Interval:
    corners = [_product(x, y) for x in a for y in b]
    return min(corners), max(corners)


def _product(a: End, b: End) -> End:
    if not a[0] and not b[0]:
        return (0, a[1] * b[1])
    # 0 times an infinite end is 0: the ends are limits of finite ones
    return ((a[0] or sign(a[1])) * (b[0] or sign(b[1])), fmpq(0))


# -------------------------------------------------------------------------------------------------
# Boxes that hold every solution of some facts: exact propagation of bounds that may be infinite at
# first, rounded outwards.

Bounds = tuple[tuple[int, Fraction], tuple[int, Fraction]]  # as Interval, in Python's rationals


def bounding_box(facts: Sequence[Atom], width: int) -> list[Bounds] | None:
    """Bounds for all variables, outside which some fact fails; None where the facts contradict each
    other on the way.

    Formula: p = sum c_k x^k with c_k <= u_k on the box so far; where x >= 0 and the shifted u(x +
    t) has no positive coefficient, p <= 0 beyond t.  Source: interval constraint propagation;
    Descartes' rule of signs for the shift.
    """
    box: list[Interval] = [((-1, fmpq(0)), (1, fmpq(0)))] * width
    sides = [(fact, p) for fact in facts if fact.relation != "!=" for p in _signs(fact)]
    consistent = _propagate(sides, box)
    used = sorted({i for fact in facts for i in fact.used})
    if consistent and any(_infinite(box[i]) for i in used):
        # the bounds of one variable often need a better lower end of another, such as s >= 1.4 from
        # s^2 > 2
        consistent = all(_infinite(box[i]) or _shave(sides, box, i) for i in used) and _propagate(
            sides, box
        )
    return (
        [((low[0], fraction(low[1])), (high[0], fraction(high[1]))) for low, high in box]
        if consistent
        else None
    )


def intervals(bounds: Sequence[Bounds]) -> list[Interval]:
    """The bounds in flint's rationals."""
    return [((low[0], exact(low[1])), (high[0], exact(high[1]))) for low, high in bounds]


def _infinite(side: Interval) -> bool:
    return bool(side[0][0] or side[1][0])


def _signs(fact: Atom) -> list[Expanded]:
    """The polynomials that the fact makes >= 0."""
    return (
        [Expanded(fact.poly), Expanded(-fact.poly)]
        if fact.relation == "="
        else [Expanded(fact.poly)]
    )


def _shave(sides: Sequence[tuple[Atom, Expanded]], box: list[Interval], i: int) -> bool:
    """Cuts slices from both ends of a bounded side on which some fact fails; False where nothing is
    left.
    """
    mine = [(fact, p) for fact, p in sides if i in p.used]
    for at_low in (True, False):
        pieces = 2
        for _ in range(limits.SLICES):  # a solution at the far end could be neared for ever
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


def _fails(fact: Atom, p: Expanded, box: Sequence[Interval]) -> bool:
    """Whether p >= 0, or p > 0 for a strict fact, fails everywhere on the box."""
    end = span(p, box)[1]
    return end < ZERO or fact.relation == ">" and end == ZERO


def _propagate(sides: Sequence[tuple[Atom, Expanded]], box: list[Interval]) -> bool:
    """Moves ends inwards, in a few rounds, and to finite values where it can; False where an
    interval becomes empty.
    """
    known: dict[tuple[int, int], tuple[tuple[Interval, ...], tuple[fmpq | None, fmpq | None]]] = {}
    for _ in range(limits.ROUNDS):
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


def _ends_along(p: Expanded, i: int, box: list[Interval]) -> tuple[fmpq | None, fmpq | None]:
    """(t, s) such that p >= 0 fails for x_i > t and for x_i < s; None where none is known."""
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
) -> fmpq | None:
    """t such that p >= 0 fails for direction * x > t, from what the coefficients of the powers of x
    lie between.
    """
    none = fmpq(0)
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
    # Cauchy's bound, then the least shift that is seen to be beyond all roots
    for _ in range(limits.SHIFTS):
        middle = rounded((low + end) / 2, up=True)
        if low < middle < end and all(
            c <= 0 for c in fmpq_poly(tops)(fmpq_poly([middle, 1])).coeffs()
        ):
            end = middle
        else:
            low = middle
    return end


def rounded(value: fmpq, up: bool) -> fmpq:
    """The value itself where it is short, else a number with few digits beyond it: propagation
    would make the digits grow without end.

    >>> third, near = Fraction(1, 3), Fraction(10**30 + 1, 3 * 10**30)
    >>> fraction(rounded(exact(third), True)), fraction(rounded(exact(near), True))
    (Fraction(1, 3), Fraction(11184811, 33554432))
    """
    p, q = int(value.p), int(value.q)
    if p.bit_length() + q.bit_length() <= limits.SHORT:
        return value
    unit = Fraction(2) ** (p.bit_length() - q.bit_length() - limits.SHORT // 2)
    scaled = Fraction(p, q) / unit
    down = scaled.numerator // scaled.denominator
    return exact(unit * (-(-scaled.numerator // scaled.denominator) if up else down))


def dyadic(low: Fraction, high: Fraction) -> tuple[int, int, int]:
    """(m, r, e) with [low, high] inside [(m - r) 2^e, (m + r) 2^e], r below 2^17.

    >>> dyadic(Fraction(0), Fraction(1, 3))
    (21846, 21846, -17)
    """
    e = -limits.GRID
    while (high - low) > (1 << limits.GRID) * Fraction(2) ** e:
        e += 1
    unit = Fraction(2) ** e
    a, b = low / unit, high / unit
    first, last = a.numerator // a.denominator, -(-b.numerator // b.denominator)
    return first + last, last - first, e - 1
