"""Polynomials between the checker, python-flint and NumPy: everything that computes with them in
FLINT reads them here.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from functools import lru_cache
from math import lcm, prod
from typing import TypeVar

import numpy as np
from flint import Ordering, fmpq_mpoly, fmpq_mpoly_ctx, fmpz_mpoly, fmpz_mpoly_ctx
from numpy.typing import NDArray

from juggleproof.algebra.numbers import fraction
from juggleproof.certificates import checker
from juggleproof.statements.formulas import Formula, Term, real, term

# -------------------------------------------------------------------------------------------------
# Polynomials of a state as python-flint polynomials, and as arrays of monomial keys and
# coefficients for linear programs.

Monomial = tuple[int, ...]  # the exponent of each variable
Mpoly = TypeVar("Mpoly", fmpq_mpoly, fmpz_mpoly)
Keys = NDArray[np.int64]
Row = tuple[Keys, NDArray[np.float64]]  # the keys of a polynomial's monomials, its coefficients
# scales, weights of the variables, values of the scales, and gradings: a `Scaling`
Gradings = tuple[tuple[int, ...], list[tuple[int, ...]], dict[int, int], list[list[int]]]

# With many variables: one odd number for each, a monomial's key being the sum of exponent times
# number, modulo 2^64.  Two monomials share a key with negligible probability, and then an exact
# solution fails its check and is dropped.
WEIGHTS = (
    np.random.default_rng(20).integers(-(1 << 62), 1 << 62, checker.MAX_VARIABLES, dtype=np.int64)
    | 1
)


def monomials(poly: checker.Poly, size: int) -> dict[Monomial, int]:
    """The numerator of a polynomial of the checker as {exponents of its first `size` variables:
    coefficient}; it has no others, or OverflowError is raised.

    >>> x = checker.Poly({1: 1}, 2, 1, 0, checker.Work())
    >>> monomials(x, 2)
    {(1, 0): 1}
    """
    unpack, width = _unpacker(size), 2 * size
    return {unpack(m.to_bytes(width, "little")): c for m, c in poly.terms.items()}


@lru_cache(maxsize=64)
def _unpacker(size: int) -> Callable[[bytes], Monomial]:
    return struct.Struct(f"<{size}H").unpack  # the checker packs an exponent into 16 bits


class Ring:
    """The integer polynomials in the variables of a context.

    >>> ring = Ring(("x", "y"))
    >>> str(ring.gens[0] ** 2 - 3 * ring.gens[1])
    'x^2 - 3*y'
    """

    def __init__(self, names: tuple[str, ...], ordering: Ordering = Ordering.degrevlex) -> None:
        self.names = names
        self.ctx = fmpz_mpoly_ctx.get(names or ("none",), ordering)
        self.gens = self.ctx.gens()
        self.size = max(1, len(names))
        self.seen: dict[int, tuple[checker.Poly, fmpz_mpoly]] = {}
        # what a `Scaling` keeps for all states of a search: by the id of a polynomial, which is
        # held so that its id is not used again, and by differences of exponents
        self.differences: dict[int, tuple[fmpz_mpoly, frozenset[Monomial]]] = {}
        self.lowered: dict[tuple[int, tuple[int, ...]], tuple[fmpz_mpoly, fmpz_mpoly]] = {}
        self.scalings: dict[tuple[frozenset[Monomial], tuple[int, ...]], Gradings] = {}
        self.factored: dict[str, list[tuple[fmpz_mpoly, int]]] = {}
        self.one = self.ctx.constant(1)
        self.zero = self.ctx.constant(0)

    def read(self, poly: checker.Poly) -> fmpz_mpoly:
        """The numerator of a polynomial of the checker."""
        known = self.seen.get(id(poly))
        if known is not None:
            return known[1]
        result = self.ctx.from_dict(monomials(poly, self.size)) if poly.terms else self.zero
        # holding the polynomial keeps its id from being used again
        self.seen[id(poly)] = poly, result
        return result

    def factors(self, poly: fmpz_mpoly) -> list[tuple[fmpz_mpoly, int]]:
        """The irreducible factors with their exponents; none of a constant."""
        if not poly or poly.is_constant():
            return []
        key = str(poly)  # the same polynomial comes back in most states of a search
        if key not in self.factored:
            self.factored[key] = factorization(poly)[1]
        return self.factored[key]


def factorization(poly: fmpz_mpoly) -> tuple[int, list[tuple[fmpz_mpoly, int]]]:
    """The constant and the irreducible factors over the integers, each with its exponent.

    >>> x, y = Ring(("x", "y")).gens
    >>> factorization(2**40 * (2**40 * x + y) * (2**40 * x - y))[1]
    [(1099511627776*x - y, 1), (1099511627776*x + y, 1)]
    """
    try:
        constant, factors = poly.factor()
    except OverflowError:  # python-flint sorts integer factors by coefficients of 32 bits only
        ring = poly.context()
        rational = fmpq_mpoly_ctx.get(ring.names(), ring.ordering())
        _, found = rational.from_dict(poly.to_dict()).factor()
        factors = []
        for factor, power in found:
            whole = factor * lcm(*(int(c.q) for c in factor.coeffs()))
            terms = {monomial: int(c.p) for monomial, c in whole.to_dict().items()}
            factors.append((ring.from_dict(terms), power))
        constant = poly.leading_coefficient()
        for factor, power in factors:
            constant //= factor.leading_coefficient() ** power
    return int(constant), [(factor, int(power)) for factor, power in factors]


class Packing:
    """Monomials in some of a ring's variables as integers that add where monomials multiply.

    >>> ring = Ring(("x", "y"))
    >>> x, y = ring.gens
    >>> packing = Packing(ring, [x**2 + y])
    >>> packing.exponents(packing.row(x**2 * y - 1)[0]).tolist()
    [[2, 1], [0, 0]]
    """

    def __init__(self, ring: Ring, polys: Iterable[fmpz_mpoly]) -> None:
        degrees = [poly.degrees() for poly in polys if poly]
        self.used = [v for v in range(ring.size) if any(d[v] for d in degrees)]
        self.bits = 62 // max(1, len(self.used))
        # else keys tell monomials apart with all but certainty, yet do not give the exponents back
        self.exact = self.bits >= 6
        self.weights = np.zeros(ring.size, np.int64) if self.exact else WEIGHTS[: ring.size]
        for place, v in enumerate(self.used if self.exact else ()):
            self.weights[v] = 1 << (self.bits * place)

    def row(self, poly: fmpz_mpoly) -> Row:
        """The polynomial as keys and float coefficients, both of shape (terms,)."""
        if not poly:
            return np.zeros(0, np.int64), np.zeros(0)
        return np.array(poly.monoms(), dtype=np.int64) @ self.weights, np.array(
            [int(c) for c in poly.coeffs()], dtype=np.float64
        )

    def keys(self, monomials: list[Monomial]) -> Keys:
        """The keys, of shape (monomials,), of monomials given by the exponents of all variables."""
        return (
            np.array(monomials, dtype=np.int64).reshape(len(monomials), len(self.weights))
            @ self.weights
        )

    def exponents(self, keys: Keys) -> Keys:
        """The exponents of the used variables, of shape (keys, used); only where `exact`."""
        shifts = np.arange(len(self.used), dtype=np.int64) * self.bits
        return (keys[:, None] >> shifts) & ((1 << self.bits) - 1)


def multiply(a: Row, b: Row) -> Row:
    """The product of two polynomials as arrays of shape (terms of a * terms of b,); equal monomials
    are left apart.
    """
    if len(a[0]) == 1 and len(b[0]) == 1 and a[0][0] == 0 and a[1][0] == 1:
        return b
    return (a[0][:, None] + b[0][None, :]).ravel(), (a[1][:, None] * b[1][None, :]).ravel()


def collect(a: Row) -> Row:
    """The same polynomial with equal monomials added, sorted by keys."""
    keys, inverse = np.unique(a[0], return_inverse=True)
    sums = np.bincount(inverse, a[1], len(keys))
    kept = sums != 0
    return keys[kept], sums[kept]


def constant_of(poly: fmpz_mpoly) -> int | None:
    """The value of a constant polynomial; None for any other."""
    if not poly:
        return 0
    return int(poly.leading_coefficient()) if poly.is_constant() else None


def used_in(poly: fmpz_mpoly) -> tuple[int, ...]:
    """The numbers of the variables that occur."""
    return tuple(i for i, degree in enumerate(poly.degrees()) if degree > 0)


def degree_in(poly: fmpz_mpoly, variable: int) -> int:
    """The degree in one variable; 0 for the zero polynomial."""
    return int(poly.degrees()[variable]) if poly else 0


def coefficients_in(poly: Mpoly, variable: int) -> list[Mpoly]:
    """The coefficients of the powers of one variable, from the constant up, by Taylor's formula.

    >>> x, y = Ring(("x", "y")).gens
    >>> [str(c) for c in coefficients_in(x**2 * y + 3 * x - y, 0)]
    ['-y', '3', 'y']
    """
    degree = int(poly.degrees()[variable]) if poly else 0
    coefficients, rest, factorial = [], poly, 1
    for k in range(degree + 1):
        if k:
            rest, factorial = rest.derivative(variable), factorial * k
        c = rest if k == degree else rest.subs({variable: 0})
        coefficients.append(c / factorial if factorial > 1 and c else c)
    return coefficients


def pseudo_divide(
    poly: fmpz_mpoly, variable: int, gen: fmpz_mpoly, lead: fmpz_mpoly, rest: fmpz_mpoly
) -> tuple[int, fmpz_mpoly, fmpz_mpoly]:
    """(n, q, r) with lead^n * poly = q * (lead * gen - rest) + r, where gen occurs in none of lead,
    rest and r.

    Source: Knuth, The Art of Computer Programming 2, 4.6.1.
    """
    coefficients = coefficients_in(poly, variable)
    degree = len(coefficients) - 1
    if degree == 0:
        return 0, poly * 0, poly
    value, power = coefficients[degree], None
    for c in reversed(coefficients[:degree]):
        power = lead if power is None else power * lead
        value = value * rest + c * power
    scaled = poly * lead**degree
    return degree, (scaled - value) / (lead * gen - rest), value


def with_value(poly: fmpz_mpoly, variable: int, value: Fraction) -> fmpz_mpoly:
    """The polynomial with a rational p/q in place of one variable, times q^degree: a polynomial of
    the same ring with the same sign.
    """
    p, q = value.numerator, value.denominator
    if q == 1:
        return poly.subs({variable: p})
    degree, terms = degree_in(poly, variable), dict[Monomial, int]()
    for m, c in zip(poly.monoms(), poly.coeffs()):
        key = (*m[:variable], 0, *m[variable + 1 :])
        terms[key] = terms.get(key, 0) + int(c) * p ** m[variable] * q ** (degree - m[variable])
    return poly.context().from_dict({m: c for m, c in terms.items() if c})


def value_at(poly: fmpz_mpoly, point: Sequence[Fraction]) -> Fraction:
    """The exact value at a rational point: every variable is brought to its own denominator once.

    >>> x, y = Ring(("x", "y")).gens
    >>> value_at(x**2 - 3 * y, [Fraction(1, 2), Fraction(1, 3)])
    Fraction(-3, 4)
    """
    powers, den = [], 1
    for value, degree in zip(point, map(int, poly.degrees())):
        n, d = value.numerator, value.denominator
        powers.append([n**k * d ** (degree - k) for k in range(degree + 1)])
        den *= d ** max(degree, 0)
    total = 0
    for exponents, coefficient in zip(poly.monoms(), poly.coeffs()):
        c = int(coefficient)
        for table, e in zip(powers, exponents):
            c *= table[e]
        total += c
    return Fraction(total, den)


def total_degree(poly: fmpz_mpoly) -> int:
    """The total degree; 0 for the zero polynomial."""
    return int(poly.total_degree()) if poly else 0


# -------------------------------------------------------------------------------------------------
# Polynomials of a search as terms and formulas of the language of statements.


def relation_of(poly: fmpq_mpoly, relation: str) -> Formula:
    """The formula "polynomial relation 0", coefficients made whole."""
    return Formula(relation, term_of(poly), term(0))


def term_of(poly: fmpq_mpoly) -> Term:
    """A polynomial, times the least number that makes its coefficients whole, as a term."""
    names = poly.context().names()
    scale = lcm(*(int(c.q) for c in poly.coeffs()))
    total: Term | None = None
    for powers, c in (poly * scale).to_dict().items():
        value = fraction(c)
        factors = [real(n) if e == 1 else real(n) ** int(e) for n, e in zip(names, powers) if e]
        size = prod(factors[1:], start=factors[0]) if factors else term(abs(value))
        if factors and abs(value) != 1:
            size = abs(value) * size
        if total is None:
            total = size if value > 0 else -size
        else:
            total = total + size if value > 0 else total - size
    return term(0) if total is None else total
