"""Exact arithmetic: polynomials, formulas over them, Bernstein coefficients, and limits.

This file knows of no statement and no proof.  Numbers are integers and fractions of integers; there
is no float.  It begins with what all files share: why something is rejected (`Kind`, `Rejected`,
`require`, `at`), and the meter of one check (`Work`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from enum import Enum
from fractions import Fraction
from functools import partial, reduce
from math import comb, gcd, lcm, prod
from typing import Any, Literal, TypeVar, Union

MAX_DEGREE = 4000
MAX_VARIABLES = 400
MAX_TERMS = 10**5
MAX_BITS = 40000
MAX_WORK = 2 * 10**7
MAX_KEPT = 4 * 10**6  # units of what is kept, each some 100 bytes
LEAST_KEPT = 50  # units of each
BITS = 16  # of one exponent inside a packed monomial; MAX_DEGREE < 2**BITS keeps exponents apart
MASK = (1 << BITS) - 1
T = TypeVar("T")

Rational = Union[int, Fraction]
Terms = dict[int, int]  # {packed exponents: integer other than 0}
Licence = tuple["Poly", bool]  # a polynomial other than 0, and whether it is > 0
Key = frozenset[tuple[int, int]]  # of a licence: its primitive polynomial
Under = dict[Licence, int]  # {licence: exponent}
Monomial = tuple[int, int, int, int]  # packed exponents, upper and lower part of a factor, degree


# ------------------------------------------------------------ what is rejected, and why


class Kind(Enum):
    """Why something is rejected: one kind for each guard, and what the guard says."""

    # arithmetic
    WORK = "too much work"
    SIZE = "a polynomial is too large"
    EXPONENT = "an exponent is too large"
    MONOTONE = "not monotone along an axis"
    # text
    TEXT = "unreadable text"
    LINE = "an unknown kind of line, or one before the first statement"
    LINE_SHAPE = "a line of the wrong shape"
    CALL = "expected another call"
    ORDER = "the lines of a statement are missing or out of order"
    STATEMENT_NAME = "a statement's name is not ID/part, or stands twice"
    NAME = "a name is declared twice, or is none"
    UNDECLARED = "an undeclared name"
    VARIABLES = "too many variables"
    VARIABLE_TWICE = "a variable is declared twice"
    NO_VARIABLE = "an integer, or a value, for what is not a variable"
    TERM = "not a term"
    FORMULA = "not a formula"
    POLYNOMIAL = "expected a polynomial"
    ONE_VARIABLE = "expected a polynomial in one variable alone"
    RATIONAL = "expected an exact rational"
    NO_NUMBER = "an end of a number is not a rational number"
    DIVISION = "division by what may vanish; no strict line before it makes this nonzero"
    ZERO_DIVISION = "division by zero"
    # definitions
    DEFINITION = "not a definition"
    REDEFINED = "a definition with a name that is taken"
    SHADOWS = "a variable or parameter with the name of a definition"
    LOOSE = "a definition names what is neither its own nor defined before it"
    UNUSED = "a definition does not use what it names"
    ARGUMENTS = "a definition is used with the wrong number of arguments"
    OVER = "a definition is used where what it is over is not declared"
    # proof rules
    RULE = "an unknown rule"
    INDEX = "nothing has this number"
    NOTHING_FALSE = "nothing false is assumed"
    COEFFICIENT = "a coefficient is not positive"
    FACTOR = "a factor of unknown sign"
    EQUATION = "not an equation"
    SUM = "the certificate's sum is not zero"
    STRICT = "no term of the certificate is strictly positive"
    CASES = "a disjunction needs one node for each alternative"
    BOUND = "not a bound of the right sense"
    BOX_FACT = "a box tree is a text about a fact p > 0 or p >= 0"
    BOX_SIGN = "a Bernstein coefficient of a leaf has the wrong sign"
    BOX_LONG = "a box tree is too long"
    BOX_SHORT = "a box tree is too short"
    INTEGRAL = "not a strict fact with integer coefficients in integers"
    LEMMA = "no earlier certified statement of this name"
    FRESH = "only what exists is named afresh"
    VALUES = "every variable needs one value, an integer one an integer"
    # statement rules
    WAY = "a statement with exists needs a witness, any other a proof"
    WITNESS = "a witness of the wrong shape, or for another statement"
    SHARP = "a sharp range proves each of its earlier statements"
    SHARP_INTEGERS = "a parameter is an integer in one statement of a sharp range, not in another"
    SHARP_OVER = "a sharp range is over what is not for all in one of its statements"
    ONE_ROOT = "not one root, with a change of sign, between the ends of a number"
    # rules for orbits
    ITERATES_SHAPE = "a map names its variables first, an image for each, and one integer apart"
    ITERATES_COUNT = "a map that is iterated cannot depend on the number of iterations"
    ITERATES_NAME = "an undeclared name in a map"
    PIECE = "a piece gives one term in parameters and state for each state variable"
    STAGE_INPUT = "a stage names an input, which has another value at each step"
    VALUE = "terms in parameters and state are expected, as many on each line, or a guard and such"
    STATE_TERMS = "one term in the parameters for each state variable is expected"
    EARLIER = "no earlier certified statement of this kind and name"
    OTHER_MAP = "two statements about different maps are joined"
    WORD = "a word has at least one piece"
    WORDS = "words of every length hold none of these"
    WORD_EACH = "a word for each piece of the other map is expected"
    PREMISES = "the premises of a rule are missing or left over"
    # certificates and files
    KEYS = "a certificate with missing or left over keys"
    MALFORMED = "malformed certificate"
    NO_CERTIFICATE = "no certificate"
    LEFT_OVER = "a certificate without a statement"
    KEY_TWICE = "a key stands twice"
    INEXACT = "not an exact integer"
    CERTIFICATE_LINE = "not a line of certificates"
    CERTIFICATE_ORDER = "a line of certificates is out of order"
    CERTIFICATE_TWICE = "a line of certificates for a statement that has one"
    FILE = "a file cannot be read"
    CHARACTERS = "a file is too large, or holds other characters than printable ASCII"


class Rejected(Exception):
    """A certificate does not prove its statement, or a statement says nothing.

    kind: which guard refused; offender: what it refused, as text, or a function that writes it;
    place: where, for a part of something else.  The message is one line of at most 300 characters
    for the offender.
    """

    def __init__(self, kind: Kind, offender: object = "", place: str = "") -> None:
        self.kind = kind
        self.offender = str(offender() if callable(offender) else offender)
        self.place = place
        # ascii: a certificate's text cannot write a line of its own
        shown = ascii(f": {self.offender}"[:300])[1:-1] if self.offender else ""
        super().__init__((f"{place}: " if place else "") + kind.value + shown)

    def within(self, place: str) -> Rejected:
        """The same, for a part of something that has a name."""
        return Rejected(self.kind, self.offender, f"{place}: {self.place}" if self.place else place)

    def __reduce__(self) -> tuple[type[Rejected], tuple[Kind, str, str]]:
        return Rejected, (self.kind, self.offender, self.place)


def require(holds: object, kind: Kind, offender: object = "") -> None:
    """A check on which soundness rests: unlike `assert`, it cannot be switched off.  An offender
    that is long to write is a function.
    """
    if not holds:
        raise Rejected(kind, offender)


def at(sequence: Sequence[T], index: Any) -> T:
    """An entry by its number: True is no number, and -1 is not the last one."""
    require(type(index) is int and 0 <= index < len(sequence), Kind.INDEX, index)
    entry: T = sequence[index]
    return entry


class Work:
    """The elementary products that one check may still spend.

    Each polynomial holds the meter of its check, so that nothing has to be passed on or put back:
    two checks at once, or one inside another, cannot spend what is the other's.

    dear: the units of one product of short coefficients.  A packed monomial of many variables is a
    long number: one of 400 takes seven times as long to add and to look up as one of three.

    kept: {key: (what was worked out, its cost)}, see `once`; room: the units still free for it.
    """

    __slots__ = ("left", "dear", "room", "kept")

    def __init__(self, limit: int = MAX_WORK) -> None:
        self.kept: dict[object, tuple[Any, int]] = {}
        self.room = MAX_KEPT
        self.refill(limit)

    def refill(self, limit: int) -> None:
        """Begins another check, which finds what the checks before it have kept."""
        if self.room < MAX_KEPT // 2:
            self.kept, self.room = {}, MAX_KEPT
        self.left = limit
        self.dear = 1

    def spend(self, amount: int) -> None:
        """Counts work before it is done, so that a hostile file ends as a rejection, no hang."""
        self.left -= amount
        if self.left < 0:
            raise Rejected(Kind.WORK)

    def once(self, key: object, make: Callable[[], T], fits: Callable[[T], object] = id) -> T:
        """What `make` returns, which depends on the key alone, or on what `fits` asks for as well:
        anything has an id.  To find it again is counted as to make it: so a check may do as much,
        whatever was checked before it.

        A key holds trees and polynomials, each equal to itself alone: nothing else can take its
        place while it is kept.  Within a check nothing is dropped: so what is kept, and what it was
        made from, were made once.
        """
        if key in self.kept:
            found: T
            found, cost = self.kept[key]
            if fits(found):
                self.spend(cost)
                return found
        before = self.left
        value = make()
        if self.room > 0:
            cost = before - self.left
            self.room -= cost + LEAST_KEPT  # a result has fewer terms than it took work
            self.kept[key] = value, cost
        return value


# ------------------------------------ polynomials: {packed exponents: integer} over one denominator


class Poly:
    """terms / den / product of `under`: a polynomial with rational coefficients, over polynomials
    that are known to be nonzero.

    terms: {packed exponents: integer other than 0}; deg, bits: bounds, their degree is at most deg,
    and the sum of their absolute coefficients at most 2^bits; work: the meter of the check; under:
    {licence: exponent}, where a licence is (polynomial other than 0, whether it is > 0).  Only a
    term that divides has an `under`: facts and cofactors are polynomials.
    """

    __slots__ = ("terms", "den", "deg", "bits", "work", "under")

    def __init__(
        self, terms: Terms, den: int, deg: int, bits: int, work: Work, under: Under | None = None
    ) -> None:
        # a degree beyond the limit would carry into the exponent of the next variable; work alone
        # does not bound memory, so neither the terms nor their coefficients grow without limit
        if deg > MAX_DEGREE or bits > MAX_BITS:
            raise Rejected(Kind.SIZE, f"degree {deg}, {bits} bits")
        self.terms = terms
        self.den = den
        self.deg = deg
        self.bits = bits
        self.work = work
        self.under = under or {}

    def over(self, under: Under) -> Poly:
        """The same terms, over other polynomials."""
        return Poly(self.terms, self.den, self.deg, self.bits, self.work, under)

    def numerator(self, under: Under) -> Poly:
        """The numerator over a denominator that is a multiple of the present one."""
        missing = ((key[0], e - self.under.get(key, 0)) for key, e in under.items())
        return prod((poly**e for poly, e in missing if e), start=self.over({}))

    def plus(self, other: Poly, factor: Rational = 1) -> Poly:
        """self + factor * other."""
        if not (other.terms or other.under):
            return self
        if not (self.under or other.under):
            return sum_of_products([(1, self, ONE), (factor, other, ONE)], self.work)
        self.work.spend(len(self.under) + len(other.under))
        under = merged(max, self.under, other.under)
        return self.numerator(under).plus(other.numerator(under), factor).over(under)

    __add__ = plus

    def __sub__(self, other: Poly) -> Poly:
        return self.plus(other, -1)

    def __neg__(self) -> Poly:
        self.work.spend(len(self.terms) * self.work.dear)
        negative = {m: -c for m, c in self.terms.items()}
        return Poly(negative, self.den, self.deg, self.bits, self.work, self.under)

    def __mul__(self, other: Poly) -> Poly:
        product = sum_of_products([(1, self, other)], self.work)
        if not (self.under or other.under):
            return product
        self.work.spend(len(self.under) + len(other.under))
        return product.over(merged(sum, self.under, other.under))

    def __pow__(self, exponent: int) -> Poly:
        if exponent == 1:
            return self
        # asked for before the first product: x^(10^9) must not begin
        require(exponent * max(self.deg, 1) <= MAX_DEGREE, Kind.EXPONENT, exponent)
        if exponent == 0:
            return number(1, self.work)
        if len(self.terms) == 1 and not self.under:
            ((m, c),) = self.terms.items()
            if c == self.den == 1:  # a product of variables: so nearly every power
                return Poly({m * exponent: 1}, 1, self.deg * exponent, 0, self.work)
        power = self
        for e in range(2, exponent + 1):
            power = self.work.once((self, e), partial(power.__mul__, self))
        return power

    def constant(self) -> Fraction | None:
        """The value of a constant; None for anything else."""
        if self.under or not self.terms.keys() <= {0}:
            return None
        return Fraction(self.terms.get(0, 0), self.den)

    def primitive(self) -> tuple[int, Poly]:
        """(c, p) with terms = c * p, where p has coprime integer coefficients, that of the largest
        monomial positive.
        """
        self.work.spend(len(self.terms) * self.work.dear)
        content = gcd(*self.terms.values())
        if self.terms[max(self.terms)] < 0:
            content = -content
        terms = {m: c // content for m, c in self.terms.items()}
        return content, Poly(terms, 1, self.deg, self.bits, self.work)

    def places(self) -> set[int]:
        """The numbers of the variables that occur."""
        together = 0
        for m in self.terms:
            together |= m
        last = together.bit_length() // BITS
        self.work.spend(len(self.terms) + last)
        return {i for i in range(last + 1) if together >> (BITS * i) & MASK}


def sum_of_products(products: Sequence[tuple[Rational, Poly, Poly]], work: Work) -> Poly:
    """sum of factor * p * q, for numerators p and q: all arithmetic of polynomials is such a sum,
    or one of monomials, and is counted and limited in these two.
    """
    den = 1
    for factor, p, q in products:
        below = factor.denominator * p.den * q.den
        if below != 1:
            den = common(den, below, work)
    terms: Terms = {}
    deg = bits = 0
    for factor, p, q in products:
        scale = factor.numerator
        if den != 1:
            scale *= den // (factor.denominator * p.den * q.den)
        few, many = p.terms, q.terms
        if len(many) < len(few):
            few, many = many, few
        size = bits_of(scale) + p.bits + q.bits
        work.spend(8 + len(few) * len(many) * (work.dear + (size * size >> 16)))
        if size > MAX_BITS:
            raise Rejected(Kind.SIZE, f"{size} bits")
        deg, bits = max(deg, p.deg + q.deg), max(bits, size)
        for m, c in few.items():
            c *= scale
            if terms:
                for n, d in many.items():
                    n += m
                    terms[n] = terms.get(n, 0) + c * d
            elif m or c != 1:
                terms = {m + n: c * d for n, d in many.items()}
            else:
                terms = many.copy()
            if len(terms) > MAX_TERMS:
                raise Rejected(Kind.SIZE, "too many terms")
    if 0 in terms.values():
        terms = {m: c for m, c in terms.items() if c}
    return Poly(terms, den, deg, bits + bits_of(len(products)), work)


def sum_of_monomials(monomials: Sequence[Monomial], work: Work) -> Poly:
    """The sum of monomials, counted and limited as that of their products with 1 would be."""
    work.spend(len(monomials) * (8 + work.dear))
    require(len(monomials) <= MAX_TERMS, Kind.SIZE, "too many terms")
    den = 1
    for _, _, lower, _ in monomials:
        if lower != 1:
            den = common(den, lower, work)
    terms: Terms = {}
    deg = bits = 0
    for m, upper, lower, degree in monomials:
        upper *= den // lower
        size = bits_of(upper)
        work.spend(size * size >> 16)
        deg = max(deg, degree)
        bits = max(bits, size)
        terms[m] = terms.get(m, 0) + upper
    if 0 in terms.values():
        terms = {m: c for m, c in terms.items() if c}
    # a degree beyond the limit, which may have carried into another exponent, is refused here
    return Poly(terms, den, deg, bits + bits_of(len(monomials)), work)


def common(one: int, other: int, work: Work) -> int:
    """The common denominator of two."""
    work.spend(one.bit_length() * other.bit_length() >> 16)
    den = lcm(one, other)
    require(den.bit_length() <= MAX_BITS, Kind.SIZE, "a denominator")
    return den


def bits_of(value: int) -> int:
    """The least k with |value| <= 2^k, at least 0."""
    return (abs(value) - 1).bit_length() if value else 0


def merged(rule: Callable[[tuple[int, int]], int], one: Under, other: Under) -> Under:
    """Exponents of licences, brought together by a rule: max or sum."""
    return {x: rule((one.get(x, 0), other.get(x, 0))) for x in {**one, **other}}


def licence_of(poly: Poly, positive: bool) -> tuple[Key, Licence]:
    """The key and the licence of a strict line, one thing for all lines that say the same."""
    content, poly = poly.primitive()
    work = poly.work
    work.spend(len(poly.terms) * work.dear)
    key = frozenset(poly.terms.items())
    licence = poly if content > 0 else -poly, positive
    return key, work.once((key, content > 0, positive, poly.deg, poly.bits), lambda: licence)


def number(value: Rational, work: Work) -> Poly:
    """A rational number as a polynomial."""
    upper = value.numerator
    return Poly({0: upper} if upper else {}, value.denominator, 0, bits_of(upper), work)


def variable(place: int, work: Work) -> Poly:
    """The variable of this number as a polynomial."""
    work.dear = max(work.dear, 1 + place // 32)
    return work.once(place, lambda: Poly({1 << (BITS * place): 1}, 1, 1, 0, work))


ONE = number(1, Work(0))  # a factor of sums of products, which spend from a meter of their own


# ------------------------------------------------------------ formulas over polynomials

Op = Literal["and", "or"]
Atom = tuple[Literal["atom"], Poly, str]
Join = tuple[Op, list[Union[Atom, "Join"]]]  # constants are folded away
Formula = Union[bool, Atom, Join]

OPPOSITE = {">": ">=", ">=": ">", "=": "!=", "!=": "="}  # not p > 0 is -p >= 0


def fold(poly: Poly, relation: str) -> Formula:
    """The atom poly relation 0; True or False where the polynomial is constant."""
    if not poly.terms.keys() <= {0}:
        return ("atom", poly, relation)
    value = poly.terms.get(0, 0)
    return {">": value > 0, ">=": value >= 0, "=": value == 0, "!=": value != 0}[relation]


def join(op: Op, formulas: Sequence[Formula]) -> Formula:
    """The conjunction or disjunction, without constants and without joins of the same kind
    inside.
    """
    if any(formula is (op == "or") for formula in formulas):
        return op == "or"
    flat: list[Atom | Join] = []
    for formula in formulas:
        if not isinstance(formula, bool):
            flat += formula[1] if formula[0] == op else [formula]
    if not flat:
        return op == "and"
    # equivalences of equivalences double: counted where they are joined
    work_of(flat[0]).spend(20 * len(flat) + 100)
    return flat[0] if len(flat) == 1 else (op, flat)


def work_of(formula: Atom | Join) -> Work:
    """The meter of the polynomials in a formula."""
    while formula[0] != "atom":
        formula = formula[1][0]
    return formula[1].work


def negate(formula: Formula) -> Formula:
    """The negation, with `not` driven down to atoms."""
    if isinstance(formula, bool):
        return not formula
    if formula[0] == "atom":
        _, poly, relation = formula
        return ("atom", poly if relation in ("=", "!=") else -poly, OPPOSITE[relation])
    return join("or" if formula[0] == "and" else "and", [negate(part) for part in formula[1]])


def conjuncts(formula: Formula) -> Sequence[Formula]:
    """The parts of a conjunction; else the formula alone."""
    return formula[1] if not isinstance(formula, bool) and formula[0] == "and" else [formula]


# ------------------------------------------------------------ Bernstein coefficients on a box


def sign_changes(values: Sequence[int]) -> int:
    """How often the sign changes in a sequence, zeros left out."""
    signs = [value > 0 for value in values if value]
    return sum(one != other for one, other in zip(signs, signs[1:]))


def times(p: list[int], factor: tuple[int, int]) -> list[int]:
    """p times first + last T, where (first, last) is the factor."""
    first, last = factor
    return [first * x + last * y for x, y in zip([*p, 0], [0, *p])]


def bernstein(
    poly: Poly, axes: Sequence[tuple[int, Fraction, Fraction]]
) -> tuple[list[int], list[int]]:
    """(sizes, coefficients): the Bernstein coefficients of poly on a box, up to one positive
    factor, the first axis varying slowest.

    An axis is (shift, low, high).  x = (a + b T) / (d + d T), where a/d = low and b/d = high, takes
    [low, high] to T >= 0; in degree n, the coefficient of T^j in (d + d T)^n poly is d^n C(n, j)
    times the j-th Bernstein coefficient.
    """
    sizes: list[int] = []
    parts = {m: [c] for m, c in poly.terms.items()}
    bits = max(map(int.bit_length, poly.terms.values()))
    # parts: by what is left of a monomial, the coefficients along the axes that are done
    for shift, low, high in reversed(axes):
        n = max((m >> shift) & MASK for m in poly.terms)
        d = lcm(low.denominator, high.denominator)
        a = int(low * d)
        b = int(high * d)
        count = sum(map(len, parts.values()))
        sizes.insert(0, n + 1)
        # the longest coefficient at most, as (n + 1) * whole <= 8^n for the `whole` below
        bits += n * (3 + max(map(int.bit_length, (a, b, d))))
        # before the binomials and the products: a degree of 4000 must not begin
        poly.work.spend((8 * (n + 1) ** 3 + (n + 1) * count) * (1 + (bits * bits >> 16)))
        fits = bits <= MAX_BITS and (n + 1) * count <= MAX_TERMS
        require(fits, Kind.SIZE, f"{bits} bits")
        whole = lcm(*(comb(n, j) for j in range(n + 1)))
        columns = []
        for e in range(n + 1):
            power = reduce(times, [(a, b)] * e + [(d, d)] * (n - e), [1])
            columns.append([whole // comb(n, j) * x for j, x in enumerate(power)])
        done, parts = parts, {}
        for m, c in done.items():
            e = (m >> shift) & MASK
            rest = m - (e << shift)
            image = [factor * x for factor in columns[e] for x in c]
            if rest in parts:
                image = [x + y for x, y in zip(parts[rest], image)]
            parts[rest] = image
    (coefficients,) = parts.values()
    return sizes, coefficients


def halved(c: list[int], size: int) -> tuple[list[int], list[int]]:
    """The Bernstein coefficients on the lower and the upper half of the first axis, along which
    they come in blocks of this size, by de Casteljau's triangle, up to one positive factor.
    """
    levels = [c]  # with sums for means: so level k is 2^k times too large
    while len(levels[-1]) > size:
        levels.append([x + y for x, y in zip(levels[-1], levels[-1][size:])])
    last = len(levels) - 1
    lower = [x << (last - k) for k, level in enumerate(levels) for x in level[:size]]
    upper = [x << k for k, level in enumerate(reversed(levels)) for x in level[-size:]]
    return lower, upper


def axis_first(sizes: list[int], c: list[int], place: int) -> list[int]:
    """The same coefficients with the axis at `place` varying slowest."""
    step = prod(sizes[place + 1 :])
    jump = sizes[place] * step
    moved = []
    for j in range(0, jump, step):
        for k in range(j, len(c), jump):
            moved += c[k : k + step]
    return moved
