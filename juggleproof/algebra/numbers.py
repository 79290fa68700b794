"""Real algebraic numbers, signs of polynomials at them, and polynomials in one variable on an
interval; all of it exact.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import total_ordering
from math import comb, floor
from typing import TypeVar

from flint import arb, fmpq, fmpq_mpoly, fmpq_poly, fmpz, fmpz_mpoly, fmpz_poly

# -------------------------------------------------------------------------------------------------
# Real algebraic numbers: an irreducible polynomial with an isolating interval, compared and
# rounded exactly.


def fraction(value: fmpq) -> Fraction:
    """The same rational as a Fraction."""
    return Fraction(int(value.p), int(value.q))


def exact(value: int | Fraction) -> fmpq:
    """The same rational as an fmpq."""
    value = Fraction(value)
    return fmpq(value.numerator, value.denominator)


def sign(value: fmpq) -> int:
    """-1, 0 or 1."""
    return 0 if not value else 1 if value > 0 else -1


Entry = TypeVar("Entry", fmpq_poly, fmpq_mpoly)


def determinant(rows: Sequence[Sequence[Entry]], one: Entry) -> Entry:
    """The determinant of a small matrix, along its first row.

    >>> x = fmpq_poly([0, 1])
    >>> determinant([[x, x**0], [x**0, x]], x**0)
    x^2 + (-1)
    """
    if not rows:
        return one
    total = one * 0
    first, *rest = rows
    for k, entry in enumerate(first):
        if entry:
            total += entry * determinant([without(row, k) for row in rest], one) * (-1) ** k
    return total


def without(row: Sequence[Entry], k: int) -> list[Entry]:
    """The row without its k-th entry."""
    return [*row[:k], *row[k + 1 :]]


@total_ordering
class AlgebraicNumber:
    """The one root of an irreducible integer polynomial (constant first) between two rationals;
    rational where they agree.  Comparisons and signs are exact: they refine the interval.

    >>> AlgebraicNumber([-2, 0, 1], Fraction(1), Fraction(2)).decimal(12)
    '1.414213562373'
    """

    def __init__(
        self, poly: Sequence[int] | fmpz_poly, low: Fraction | fmpq, high: Fraction | fmpq
    ) -> None:
        self.poly = fmpz_poly(list(poly))
        self._low = low if isinstance(low, fmpq) else exact(low)
        self._high = high if isinstance(high, fmpq) else exact(high)
        self._rising = sign(self._value(self._high))

    @staticmethod
    def rational(value: int | Fraction | fmpq) -> AlgebraicNumber:
        """A rational number as an algebraic one."""
        q = value if isinstance(value, fmpq) else exact(value)
        return AlgebraicNumber(fmpz_poly([-q.p, q.q]), q, q)

    def _value(self, at: fmpq) -> fmpq:
        return fmpq_poly(self.poly)(at)

    @property
    def is_rational(self) -> bool:
        """Whether the polynomial is linear."""
        return int(self.poly.degree()) == 1

    @property
    def low(self) -> Fraction:
        """The lower end of the isolating interval as far as it has been refined."""
        return fraction(self._low)

    @property
    def high(self) -> Fraction:
        """The upper end of the isolating interval as far as it has been refined."""
        return fraction(self._high)

    @property
    def coefficients(self) -> list[int]:
        """The coefficients of the polynomial from the constant up."""
        return [int(c) for c in self.poly.coeffs()]

    def as_fraction(self) -> Fraction:
        """The value of a rational number; raises ValueError for an irrational one."""
        if not self.is_rational:
            raise ValueError("an irrational number has no value as a fraction")
        return Fraction(-int(self.poly[0]), int(self.poly[1]))

    def refine(self) -> None:
        """Halves the isolating interval."""
        middle = (self._low + self._high) / 2
        value = sign(self._value(middle))
        if self.is_rational or value == 0:
            value = exact(self.as_fraction())
            self._low = self._high = value
        elif value == self._rising:
            self._high = middle
        else:
            self._low = middle

    def narrow(self, width: Fraction) -> AlgebraicNumber:
        """The same number, its interval no wider than this."""
        bound = exact(width)
        while self._high - self._low > bound:
            self.refine()
        return self

    def enclosure(self, bits: int) -> tuple[Fraction, Fraction]:
        """The two neighbouring multiples of 2^-bits between which the number lies; both are the
        number where it is rational.

        >>> AlgebraicNumber([-2, 0, 1], Fraction(1), Fraction(2)).enclosure(4)
        (Fraction(11, 8), Fraction(23, 16))
        """
        if self.is_rational:
            return self.as_fraction(), self.as_fraction()
        scale = 1 << bits
        while floor(self.low * scale) != floor(self.high * scale):
            self.refine()
        whole = floor(self.low * scale)
        return Fraction(whole, scale), Fraction(whole + 1, scale)

    def approximation(self) -> fmpq:
        """A rational within 2^-80 of the number."""
        self.narrow(Fraction(1, 1 << 80))
        return (self._low + self._high) / 2

    def sign_of(self, poly: fmpq_poly) -> int:
        """The sign (-1, 0 or 1) of a polynomial at this number: 0 where it is a multiple of the
        number's own, else that of an enclosure.
        """
        if (poly % fmpq_poly(self.poly)) == 0:
            return 0
        while True:
            low, high = enclose(poly, self._low, self._high)
            if low > 0 or high < 0:
                return 1 if low > 0 else -1
            self.refine()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, AlgebraicNumber):  # asked first: that is quick
            if not isinstance(other, (int, Fraction)):
                return False
            other = AlgebraicNumber.rational(other)
        if self.poly != other.poly:
            return False
        low, high = max(self._low, other._low), min(self._high, other._high)
        if low > high:
            return False
        return self.is_rational or sign(self._value(low)) * sign(self._value(high)) < 0

    def __hash__(self) -> int:
        return hash(tuple(self.coefficients))

    def __lt__(self, other: AlgebraicNumber | Fraction | int) -> bool:
        that = other if isinstance(other, AlgebraicNumber) else AlgebraicNumber.rational(other)
        if self == that:
            return False
        while self._low <= that._high and that._low <= self._high:
            self.refine()
            that.refine()
        return bool(self._high < that._low)

    def decimal(self, places: int) -> str:
        """The value rounded to this many decimals, ties to even.

        >>> AlgebraicNumber.rational(Fraction(1, 3)).decimal(4)
        '0.3333'
        """
        scale = 10**places
        if self.is_rational:
            rounded = round(self.as_fraction() * scale)
        else:
            while round(self.low * scale) != round(self.high * scale):
                self.refine()
            rounded = round(self.low * scale)
        digits = str(abs(rounded)).rjust(places + 1, "0")
        text = digits[:-places] + "." + digits[-places:] if places else digits
        return ("-" if rounded < 0 else "") + text

    def polynomial_text(self, name: str) -> str:
        """The polynomial in this name as text, highest power first."""
        return polynomial_text(self.coefficients, name)

    def __repr__(self) -> str:
        if self.is_rational:
            return f"AlgebraicNumber({self.as_fraction()})"
        return f"AlgebraicNumber({self.polynomial_text('x')}, {self.low}, {self.high})"


def polynomial_text(coefficients: Sequence[int], name: str) -> str:
    """An integer polynomial, constant first, as text with the highest power first.

    >>> polynomial_text([-1, 3, 1], "alpha")
    'alpha^2 + 3*alpha - 1'
    """
    text = ""
    for power, c in reversed(list(enumerate(coefficients))):
        if c:
            variable = "" if power == 0 else name if power == 1 else f"{name}^{power}"
            size = "*".join(
                part for part in ("" if abs(c) == 1 and power else str(abs(c)), variable) if part
            )
            text += (
                ("-" if c < 0 else "") + size if not text else (" - " if c < 0 else " + ") + size
            )
    return text or "0"


def enclose(poly: fmpq_poly, low: fmpq, high: fmpq) -> tuple[fmpq, fmpq]:
    """An enclosure of the values of a polynomial on [low, high], by Horner's rule in intervals."""
    bottom = top = fmpq(0)
    for c in reversed(poly.coeffs()):
        products = (bottom * low, bottom * high, top * low, top * high)
        bottom, top = min(products) + c, max(products) + c
    return bottom, top


def integer_polynomial(poly: fmpq_poly) -> fmpz_poly:
    """The primitive integer polynomial with positive leading coefficient that has the same
    roots.
    """
    numerator = poly.numer()
    content = numerator.content()
    numerator = fmpz_poly([c // content for c in numerator.coeffs()])
    return -numerator if numerator.leading_coefficient() < 0 else numerator


def real_roots(poly: fmpq_poly) -> list[AlgebraicNumber]:
    """The distinct real roots of a polynomial that is not 0, in increasing order: those of its
    irreducible factors, isolated by FLINT's balls.

    >>> real_roots(fmpq_poly([0, -2, 0, 1]))[1]
    AlgebraicNumber(0)
    """
    roots: list[AlgebraicNumber] = []
    if poly.degree() > 0:
        for factor, _ in integer_polynomial(poly).factor()[1]:
            roots += _roots_of_irreducible(integer_polynomial(fmpq_poly(factor)))
    return sorted(roots)


def root_number(coefficients: Sequence[int], number: int) -> AlgebraicNumber:
    """The number-th distinct real root of an integer polynomial (constant first), from the smallest
    up and counted from 1.  Raises ValueError where it has fewer.

    >>> root_number([0, -2, 0, 1], 3).decimal(3)
    '1.414'
    """
    roots = real_roots(fmpq_poly(list(coefficients)))
    if not 1 <= number <= len(roots):
        raise ValueError("the polynomial has no such real root")
    return roots[number - 1]


def _roots_of_irreducible(poly: fmpz_poly) -> list[AlgebraicNumber]:
    if poly.degree() == 1:
        return [AlgebraicNumber.rational(fmpq(-poly[0], poly[1]))]
    if poly.degree() == 2 and poly[1] ** 2 - 4 * poly[0] * poly[2] < 0:
        return []
    roots = []
    for root, _ in poly.complex_roots():
        if root.imag == 0:
            middle, radius = _dyadic(root.real.mid()), _dyadic(root.real.rad())
            # The ball isolates its root; a little more than its radius moves both ends off the
            # root.
            roots.append(AlgebraicNumber(poly, middle - radius * 2, middle + radius * 2))
    return roots


def _dyadic(ball: arb) -> fmpq:
    man, exp = ball.man_exp()
    man, exp = int(man), int(exp)
    return fmpq(man << exp, 1) if exp >= 0 else fmpq(man, 1 << -exp)


def simplest_between(low: fmpq, high: fmpq) -> fmpq:
    """The rational of least denominator, then of least size, strictly between two rationals.

    Source: the Stern-Brocot tree (Graham, Knuth, Patashnik, Concrete Mathematics, 4.5).

    >>> simplest_between(fmpq(1, 3), fmpq(1, 2))
    2/5
    """
    if low < 0 < high:
        return fmpq(0)
    if high <= 0:
        return -simplest_between(-high, -low)
    whole = fmpz(low.floor())
    if whole + 1 < high:
        return fmpq(whole + 1)
    if low == whole:
        # Between whole and at most whole + 1: whole + 1/n with the least n that fits.
        return fmpq(whole) + 1 / fmpq(fmpz((1 / (high - whole)).floor()) + 1)
    return fmpq(whole) + 1 / simplest_between(1 / (high - whole), 1 / (low - whole))


# -------------------------------------------------------------------------------------------------
# Polynomials in one variable on an interval: Bernstein's coefficients.


def univariate(poly: fmpq_mpoly | fmpz_mpoly, variable: int) -> fmpq_poly:
    """A polynomial in one variable of its ring, as a dense one."""
    if len(poly) == poly.total_degree() + 1:  # no power is missing, so they stand in falling order
        return fmpq_poly(poly.coeffs()[::-1])
    by_power = {int(m[variable]): c for m, c in zip(poly.monoms(), poly.coeffs())}
    return fmpq_poly([by_power.get(k, 0) for k in range(max(by_power, default=0) + 1)])


def bernstein(poly: fmpq_poly, low: Fraction, high: Fraction, degree: int) -> list[fmpq]:
    """The coefficients b_0 .. b_n with poly = sum b_k comb(n, k) (z - low)^k (high - z)^(n - k) /
    (high - low)^n, where n is the degree given, at least that of the polynomial.

    Source: Farouki, The Bernstein polynomial basis, Computer Aided Geometric Design 29 (2012).

    >>> [str(b) for b in bernstein(fmpq_poly([0, 1]), Fraction(0), Fraction(1), 2)]
    ['0', '1/2', '1']
    """
    start, width = (
        fmpq(low.numerator, low.denominator),
        fmpq((high - low).numerator, (high - low).denominator),
    )
    moved = poly(fmpq_poly([start, width])).coeffs()
    return [
        sum((c * fmpq(comb(k, j), comb(degree, j)) for j, c in enumerate(moved[: k + 1])), fmpq(0))
        for k in range(degree + 1)
    ]


End = tuple[Fraction, Fraction]  # where a fact linear in a variable is 0, and the size of its slope


def by_ends(poly: fmpq_poly, degree: int, low: End | None, high: End | None) -> list[Fraction]:
    """The coefficients c_k with poly = sum c_k l^k h^(n - k), where l = s (z - low), h = t (high -
    z) and n is the degree given; with one of the ends, poly = sum c_k l^k, or sum c_k h^k.

    >>> end = Fraction(1), Fraction(2)
    >>> by_ends(fmpq_poly([0, 1]), 1, end, None)
    [Fraction(1, 1), Fraction(1, 2)]
    >>> by_ends(fmpq_poly([0, 1]), 1, end, (Fraction(3), Fraction(1)))
    [Fraction(1, 2), Fraction(3, 4)]
    """
    if low is not None and high is not None:
        width = high[0] - low[0]
        return [
            fraction(b) * comb(degree, k) / width**degree / low[1] ** k / high[1] ** (degree - k)
            for k, b in enumerate(bernstein(poly, low[0], high[0], degree))
        ]
    end = low or high
    if end is None:
        raise ValueError("no end is given")
    moved = poly(fmpq_poly([exact(end[0]), 1 if low else -1]))
    return [fraction(moved[k]) / end[1] ** k for k in range(degree + 1)]


def with_one_change(poly: fmpq_poly, low: Fraction, high: Fraction) -> tuple[Fraction, Fraction]:
    """Ends around the only root of a polynomial between two numbers at which its signs differ, so
    close that its Bernstein coefficients change their sign once.

    >>> with_one_change(fmpq_poly([-2, 0, 1]) * fmpq_poly([8, -5, 1]), Fraction(0), Fraction(3))
    (Fraction(0, 1), Fraction(3, 2))
    """
    while True:
        signs = [b > 0 for b in bernstein(poly, low, high, poly.degree()) if b]
        if sum(one != other for one, other in zip(signs, signs[1:])) == 1:
            return low, high
        middle = (low + high) / 2
        if (poly(fmpq(middle.numerator, middle.denominator)) > 0) == signs[0]:
            low = middle
        else:
            high = middle
