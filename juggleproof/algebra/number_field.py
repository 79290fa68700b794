"""Several algebraic numbers as polynomials in one of them, so that one adjoined number gives a
point all its values.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from flint import fmpq, fmpq_mat, fmpq_mpoly, fmpq_poly, fmpz_mpoly

from juggleproof.algebra import limits
from juggleproof.algebra.numbers import AlgebraicNumber, exact, real_roots
from juggleproof.statements.work import Budget

GENERATOR = fmpq_poly([0, 1])


def common_field(
    values: Mapping[str, fmpq | AlgebraicNumber], budget: Budget
) -> tuple[dict[str, fmpq_poly], AlgebraicNumber | None] | None:
    """The values as polynomials in one number, which is None where all are rational; None where
    that number would have too high a degree.

    >>> roots = real_roots(fmpq_poly([-2, 0, 1])), real_roots(fmpq_poly([-8, 0, 1]))
    >>> field = common_field({"x": roots[0][1], "y": roots[1][0]}, Budget(10**6))
    >>> field[0], field[1].decimal(3)
    ({'x': x, 'y': (-2)*x}, '1.414')
    """
    number: AlgebraicNumber | None = None
    found: dict[str, fmpq_poly] = {}
    for name, value in sorted(values.items(), key=lambda item: degree(item[1])):
        if isinstance(value, AlgebraicNumber) and value.is_rational:
            value = value.approximation()
        if isinstance(value, fmpq):
            found[name] = fmpq_poly([value])
        elif number is None:
            number, found[name] = value, GENERATOR
        else:
            extended = adjoined(number, value, budget)
            if extended is None:
                return None
            before, number, old, new = number, *extended
            if number is not before:
                modulus = fmpq_poly(number.poly)
                found = {other: composed(poly, old, modulus) for other, poly in found.items()}
            found[name] = new
    return {name: found[name] for name in values}, number


def degree(value: fmpq | AlgebraicNumber) -> int:
    """The degree of a number over the rationals."""
    return int(value.poly.degree()) if isinstance(value, AlgebraicNumber) else 1


def adjoined(
    first: AlgebraicNumber, second: AlgebraicNumber, budget: Budget
) -> tuple[AlgebraicNumber, fmpq_poly, fmpq_poly] | None:
    """A number in whose field two others lie, and each of these as a polynomial in it; None where
    the product of their degrees is too large.

    Formula: t = a + c b, where the powers of t are a basis of Q[a, b] modulo both polynomials; its
    minimal polynomial has an irreducible factor that vanishes at t.  Where a or b alone spans the
    field, t is that one.  Source: Cohen, A Course in Computational Algebraic Number Theory, 4.5.1.
    """
    size = degree(first) * degree(second)
    if size > limits.MOST_FIELD_DEGREE:
        return None
    for multiple in limits.MULTIPLES:
        budget.spend(100 + size**3 // 10)
        powers = basis_of_powers(first, second, multiple)
        if powers is None:
            continue
        characteristic, one, other = powers
        number = root_near(characteristic, first, second, multiple)
        modulus = fmpq_poly(number.poly)
        one, other = one % modulus, other % modulus
        if degree(number) == degree(first):
            inside = expressed(other, one, modulus)
            return (first, GENERATOR, inside) if inside is not None else None
        if degree(number) == degree(second):
            inside = expressed(one, other, modulus)
            return (second, inside, GENERATOR) if inside is not None else None
        return number, one, other
    return None


def basis_of_powers(
    first: AlgebraicNumber, second: AlgebraicNumber, multiple: int
) -> tuple[fmpq_poly, fmpq_poly, fmpq_poly] | None:
    """The characteristic polynomial of t = a + c b, and a and b as polynomials in t modulo it; None
    where the powers of t are no basis.
    """
    rows, columns = degree(first), degree(second)
    size = rows * columns
    one, other = (fmpq_poly(number.poly) for number in (first, second))

    def times(element: list[fmpq_poly]) -> list[fmpq_poly]:
        """An element, as polynomials in a for each power of b, times t."""
        by_first = [part * GENERATOR % one for part in element]
        shifted = [fmpq_poly(), *element]
        top = shifted.pop() / other[columns]
        by_second = [part - top * other[k] for k, part in enumerate(shifted)]
        return [x + y * multiple for x, y in zip(by_first, by_second)]

    element = [fmpq_poly([1]), *[fmpq_poly()] * (columns - 1)]
    powers = []
    for _ in range(size + 1):
        powers.append([part[k] for part in element for k in range(rows)])
        element = times(element)
    matrix = fmpq_mat(size, size, [powers[k][i] for i in range(size) for k in range(size)])
    wanted = [powers[size], coordinates(size, 1), coordinates(size, rows)]
    sides = fmpq_mat(size, 3, [wanted[k][i] for i in range(size) for k in range(3)])
    try:
        solved = matrix.solve(sides)
    except ZeroDivisionError:
        return None
    last, a, b = (fmpq_poly([solved[i, k] for i in range(size)]) for k in range(3))
    return fmpq_poly([0] * size + [1]) - last, a, b


def coordinates(size: int, place: int) -> list[fmpq]:
    """A vector of the standard basis."""
    return [fmpq(int(k == place)) for k in range(size)]


def root_near(
    poly: fmpq_poly, first: AlgebraicNumber, second: AlgebraicNumber, multiple: int
) -> AlgebraicNumber:
    """The root of a polynomial that a + c b is."""
    roots = real_roots(poly)
    while True:
        ends = sorted((second._low * multiple, second._high * multiple))
        low, high = first._low + ends[0], first._high + ends[1]
        near = [root for root in roots if root._low <= high and low <= root._high]
        if len(near) == 1:
            return near[0]
        for number in (*near, first, second):
            number.refine()


def expressed(value: fmpq_poly, generator: fmpq_poly, modulus: fmpq_poly) -> fmpq_poly | None:
    """An element of a field as a polynomial in another one; None where the powers of that one are
    no basis.
    """
    size = modulus.degree()
    powers = [fmpq_poly([1])]
    while len(powers) < size:
        powers.append(powers[-1] * generator % modulus)
    matrix = fmpq_mat(size, size, [powers[k][i] for i in range(size) for k in range(size)])
    try:
        solved = matrix.solve(fmpq_mat(size, 1, [value[i] for i in range(size)]))
    except ZeroDivisionError:
        return None
    return fmpq_poly([solved[i, 0] for i in range(size)])


def composed(poly: fmpq_poly, inner: fmpq_poly, modulus: fmpq_poly) -> fmpq_poly:
    """A polynomial at an element of a field."""
    result = fmpq_poly()
    for c in reversed(poly.coeffs()):
        result = (result * inner + c) % modulus
    return result


def at_elements(
    poly: fmpq_mpoly | fmpz_mpoly, values: Sequence[fmpq_poly], modulus: fmpq_poly
) -> fmpq_poly:
    """A polynomial in several variables at elements of a field."""
    total = fmpq_poly()
    for powers, c in zip(poly.monoms(), poly.coeffs()):
        term = fmpq_poly([c])
        for value, e in zip(values, powers):
            for _ in range(e):
                term = term * value % modulus
        total += term
    return total % modulus


def sign_at(poly: fmpz_mpoly, point: Sequence[Fraction | AlgebraicNumber]) -> int | None:
    """The sign (-1, 0 or 1) of a polynomial at a point of rational and algebraic numbers; None
    where one number with all of them in its field would have too high a degree.
    """
    values = {
        str(k): exact(value) if isinstance(value, Fraction) else value
        for k, value in enumerate(point)
    }
    field = common_field(values, Budget(limits.FIELD_WORK))
    if field is None:
        return None
    number = field[1] or AlgebraicNumber.rational(0)
    return number.sign_of(at_elements(poly, [*field[0].values()], fmpq_poly(number.poly)))
