"""Periodic orbits by the lengths of their flights: their states, and for which alpha they exist and
attract.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import product
from typing import TypeVar

from flint import fmpq
from sympy import Expr, Poly, Rational, cancel, factor_list, fraction, refine_root
from sympy import intervals as isolating

from juggleproof.scenes.errors import SceneError
from juggleproof.scenes.juggler.compiled_map import Number, brief, counted, formulas, restitution
from juggleproof.scenes.juggler.exact import flight, impact, strikes
from juggleproof.symbolic import normal_f1, normal_flight_power, normal_margin, solution_of
from juggleproof.symbolic.algebra import K, alpha, w, x

# -------------------------------------------------------------------------------------------------
# Conditions on alpha.
#
# For which alpha in (0, 1) polynomial conditions hold, exactly: isolated real roots, and signs
# between and at them.


@dataclass(frozen=True)
class IsolatedRoot:
    """The only root of an irreducible polynomial in [low, high]; rational where low = high."""

    polynomial: Poly
    low: Fraction
    high: Fraction

    def refined(self, width: Fraction) -> IsolatedRoot:
        """The same root between ends that are at most `width` apart."""
        if self.high - self.low <= width:
            return self
        ends = refine_root(
            self.polynomial.as_expr(),
            _rational(self.low),
            _rational(self.high),
            eps=_rational(width),
        )
        return IsolatedRoot(self.polynomial, *(Fraction(int(end.p), int(end.q)) for end in ends))

    def __str__(self) -> str:
        if self.low == self.high:
            return str(self.low)
        low = self.refined(Fraction(1, 10**9)).low
        return f"{float(low):.6f} (root of {self.polynomial.as_expr()})".replace("**", "^")


@dataclass(frozen=True)
class AlphaRange:
    """The alpha between two ends, each with whether it belongs to the range."""

    low: IsolatedRoot
    high: IsolatedRoot
    low_in: bool
    high_in: bool

    def __str__(self) -> str:
        if self.low == self.high:
            return f"alpha = {self.low}"
        return (
            f"{self.low} {'<=' if self.low_in else '<'} alpha {'<=' if self.high_in else '<'}"
            f" {self.high}"
        )


def _rational(value: Fraction) -> Rational:
    return Rational(value.numerator, value.denominator)


def irreducible(polynomials: Sequence[Expr]) -> list[Poly]:
    """The irreducible factors of the polynomials, each once."""
    factors = {
        Poly(factor, alpha).monic(): None
        for one in polynomials
        for factor, _ in factor_list(one, alpha)[1]
    }
    return [Poly(one.clear_denoms()[1], alpha) for one in factors]


def roots_between(polynomials: Sequence[Expr]) -> list[IsolatedRoot]:
    """The real roots of the polynomials strictly between 0 and 1, in order, between ends that hold
    no other root, and apart from each other.

    >>> [str(root) for root in roots_between([3 * alpha - 1, alpha**2 - 2, 2 * alpha**2 - 1])]
    ['1/3', '0.707107 (root of 2*alpha^2 - 1)']
    """
    factors = irreducible([*polynomials, alpha, alpha - 1])
    if not factors:
        return []
    roots = []
    for (low, high), owners in isolating([one.as_expr() for one in factors], strict=True):
        factor, ends = factors[next(iter(owners))], [low, high]
        if factor.degree() == 1:  # a rational root, as it is
            ends = [-factor.nth(0) / factor.nth(1)] * 2
        roots.append(IsolatedRoot(factor, *(Fraction(int(end.p), int(end.q)) for end in ends)))
    return [
        root
        for root in roots
        if root.low >= 0 and root.high <= 1 and root.polynomial.as_expr() not in (alpha, alpha - 1)
    ]


def _sign_at(polynomial: Poly, at: Fraction) -> int:
    value = Poly(polynomial, alpha).eval(_rational(at))
    return int(bool(value > 0)) - int(bool(value < 0))


def sign_at_root(polynomial: Expr, root: IsolatedRoot) -> int:
    """The sign of a polynomial, of those whose roots were isolated, at one of these roots.

    >>> roots = roots_between([2 * alpha**2 - 1, alpha - 1])
    >>> sign_at_root(alpha - 1, roots[0]), sign_at_root((2 * alpha**2 - 1) * alpha, roots[0])
    (-1, 0)
    """
    if Poly(polynomial, alpha).rem(root.polynomial).is_zero:
        return 0
    return _sign_at(polynomial, (root.low + root.high) / 2)  # between the ends it has no root


def where(nonnegative: Sequence[Expr], positive: Sequence[Expr] = ()) -> list[AlphaRange]:
    """All alpha in (0, 1) at which polynomials of the one list are >= 0 and those of the other > 0.

    >>> [str(one) for one in where([3 * alpha - 1, 1 - 2 * alpha])]
    ['1/3 <= alpha <= 1/2']
    >>> [str(one) for one in where([], [(alpha - 1) * alpha])]
    []
    >>> [str(one) for one in where([-((2 * alpha - 1) ** 2)])]
    ['alpha = 1/2']
    >>> [str(one) for one in where([], [(2 * alpha - 1) ** 2])]
    ['0 < alpha < 1/2', '1/2 < alpha < 1']
    """
    zero, one = (
        IsolatedRoot(Poly(alpha, alpha), Fraction(0), Fraction(0)),
        IsolatedRoot(Poly(alpha - 1, alpha), Fraction(1), Fraction(1)),
    )
    roots = [zero, *roots_between([*nonnegative, *positive]), one]
    conditions = [(Poly(part, alpha), False) for part in nonnegative] + [
        (Poly(part, alpha), True) for part in positive
    ]

    def holds(signs: Sequence[int]) -> bool:
        return all(
            sign > 0 or (sign == 0 and not strict) for sign, (_, strict) in zip(signs, conditions)
        )

    # Cells in order: root, between, root, ...; 0 and 1 do not belong to the domain.
    cells = []
    for left, right in zip(roots, roots[1:]):
        cells.append(
            left not in (zero, one) and holds([sign_at_root(part, left) for part, _ in conditions])
        )
        cells.append(holds([_sign_at(part, (left.high + right.low) / 2) for part, _ in conditions]))
    cells.append(False)
    ranges, begun = [], None
    for place, inside in enumerate([*cells, False]):
        if inside and begun is None:
            begun = place
        elif not inside and begun is not None:
            low, last = begun, place - 1
            ranges.append(
                AlphaRange(roots[low // 2], roots[(last + 1) // 2], low % 2 == 0, last % 2 == 0)
            )
            begun = None
    return ranges


# -------------------------------------------------------------------------------------------------
# Periodic orbits.
#
# Periodic orbits by the lengths of their flights: where they are, for which alpha they exist, and
# whether they attract.
#
# A word (K_1, .., K_m) means: an impact, then K_1 - 1 periods without one, an impact, and so on, m
# impacts in K_1 + .. + K_m periods, and the state is back. From impact to impact the map is affine
# with the matrix -alpha A^K, A unipotent; so the word's matrix is (-alpha)^m A^(K_1 + .. + K_m),
# with the eigenvalue (-alpha)^m twice, and for every alpha < 1 exactly one state comes back.  It is
# an orbit of f where it is one of the word: each x >= 0, each impact at x < w, each period between
# at x >= w.  Along a flight w - x is a convex parabola of time: first and last period suffice.
# Inside (no state on x = w) f is that affine map near the orbit, whose spectral radius is alpha^m <
# 1: the orbit attracts a neighbourhood.
#
# Words that exist have no flight longer than (1 + alpha)/(1 - alpha): the flight K' after a flight
# K has K' - 1 <= alpha (K + 1) (claim `theorem-flights`), and the longest of a word follows one
# that is not longer.  So for one alpha and one number of impacts the search is complete.

# numbers that divide; python-flint has no types, so that floats with bounds pass as its numbers
F = TypeVar("F", Fraction, float, fmpq)
Word = tuple[int, ...]
Place = tuple[Fraction, Fraction]
LONGEST_WORD, LONGEST_FLIGHT, MOST_WORDS = 12, 10**6, 10**5


@dataclass(frozen=True)
class Orbit:
    """A periodic orbit at one alpha: its states at the impacts, one for each flight of its word;
    whether no state lies on x = w.
    """

    word: Word
    alpha: Fraction
    impacts: tuple[Place, ...]
    inside: bool

    @property
    def attracts(self) -> bool | None:
        """True where it attracts a neighbourhood; None where it lies on x = w, where the affine map
        does not decide it.
        """
        return True if self.inside else None

    @property
    def radius(self) -> Fraction:
        """The spectral radius of its affine map: alpha^m."""
        return self.alpha ** len(self.word)


def valid_word(word: Sequence[int]) -> Word:
    """The word: flights of at least one period each; raises SceneError for others."""
    if isinstance(word, str) or not isinstance(word, Sequence):
        raise SceneError(f"{brief(word)} is no word; give the lengths of flights, such as (1, 2)")
    if not 1 <= len(word) <= LONGEST_WORD:
        raise SceneError(f"a word of {len(word)} flights; give from 1 to {LONGEST_WORD}")
    return tuple(counted(periods, "a flight", 1, LONGEST_FLIGHT) for periods in word)


def _onwards(at: Fraction, place: Place, periods: int) -> Place:
    """From one impact to the next: f1, then periods - 1 times f2."""
    return flight(*impact(at, *place), periods - 1)


def orbit_of(word: Sequence[int], alpha: Number) -> Orbit | None:
    """The orbit with this word at this alpha, or None where the state that comes back is no orbit
    of f.

    >>> orbit_of((2,), Fraction(1, 2)).impacts
    ((Fraction(4, 9), Fraction(8, 3)),)
    >>> orbit_of((2,), Fraction(1, 4)) is None, orbit_of((2,), Fraction(1, 3)).inside
    (True, False)
    """
    at, lengths = restitution(alpha), valid_word(word)
    start = returning_state(at, lengths, Fraction(0))
    impacts, edge, place = [], False, start
    for periods in lengths:
        if place[0] < 0 or not strikes(*place):
            return None
        impacts.append(place)
        struck = impact(at, *place)
        for k in {0, periods - 2} if periods > 1 else ():
            here = flight(*struck, k)
            if strikes(*here):
                return None
            edge = edge or here[0] == here[1]
        place = _onwards(at, place, periods)
    if place != start:
        raise SceneError(f"the orbit of {lengths} does not come back")
    return Orbit(lengths, at, tuple(impacts), not edge)


def returning_state(at: F, word: Sequence[F] | Sequence[int], zero: F) -> tuple[F, F]:
    """The only state that the word's affine map keeps, by the images of three states; 0 is of the
    kind of alpha.

    >>> returning_state(Fraction(1, 2), (2,), Fraction(0))
    (Fraction(4, 9), Fraction(8, 3))
    """
    map_, one = formulas(), zero + 1

    def image(place: tuple[F, F]) -> tuple[F, F]:
        for periods in word:
            place = map_.flight(*map_.impact(at, *place), periods - 1)
        return place

    (c, d), (a, _), (b, e) = (image(place) for place in ((zero, zero), (one, zero), (zero, one)))
    # x' = a x + b w + c, w' = e w + d: closing speeds do not depend on heights
    a, b, e = a - c, b - c, e - d
    speed = d / (1 - e)
    return (b * speed + c) / (1 - a), speed


def family(word: Sequence[int]) -> tuple[tuple[Expr, Expr], ...]:
    """The states at the impacts of the word as rational functions of alpha.

    >>> family((1,))[0][1]
    2/(alpha + 1)
    """
    return _family(valid_word(word))


@cache
def _family(word: Word) -> tuple[tuple[Expr, Expr], ...]:
    def onwards(place: tuple[Expr, Expr], periods: int) -> tuple[Expr, Expr]:
        struck = [part.xreplace({x: place[0], w: place[1]}) for part in normal_f1()]
        flown = [
            part.xreplace({K: periods - 1}).xreplace({x: struck[0], w: struck[1]})
            for part in normal_flight_power()
        ]
        return cancel(flown[0]), cancel(flown[1])

    end = (x, w)
    for periods in word:
        end = onwards(end, periods)
    start = solution_of([end[0] - x, end[1] - w], [x, w])
    places = [(start[0], start[1])]
    for periods in word[:-1]:
        places.append(onwards(places[-1], periods))
    return tuple(places)


def exists_for(word: Sequence[int]) -> tuple[AlphaRange, ...]:
    """All alpha in (0, 1) for which the orbit of the word exists, exactly.

    >>> [[str(one) for one in exists_for((length,))] for length in (1, 2, 3)]
    [['0 < alpha < 1'], ['1/3 <= alpha < 1'], ['1/2 <= alpha < 1']]
    """
    heights, margins, gaps = _conditions(valid_word(word))
    return tuple(where([*heights, *gaps], margins))


def attracts_for(word: Sequence[int]) -> tuple[AlphaRange, ...]:
    """All alpha in (0, 1) for which the orbit of the word exists with no state on x = w: there it
    attracts a neighbourhood.

    >>> [str(one) for one in attracts_for((1,))], [str(one) for one in attracts_for((2,))]
    (['0 < alpha < 1'], ['1/3 < alpha < 1'])
    """
    heights, margins, gaps = _conditions(valid_word(word))
    return tuple(where(heights, [*margins, *gaps]))


@cache
def _conditions(word: Word) -> tuple[list[Expr], list[Expr], list[Expr]]:
    """Polynomials in alpha: heights, which are to be >= 0; margins at impacts, to be > 0; and their
    negatives at the ends of flights, to be >= 0.
    """
    heights, margins, gaps = [], [], []
    for place, periods in zip(_family(word), word):
        at = {x: place[0], w: place[1]}
        heights.append(_sign_of(place[0]))
        margins.append(_sign_of(normal_margin().xreplace(at)))
        struck = [part.xreplace(at) for part in normal_f1()]
        for k in {0, periods - 2} if periods > 1 else ():
            here = [
                part.xreplace({K: k}).xreplace({x: struck[0], w: struck[1]})
                for part in normal_flight_power()
            ]
            gaps.append(_sign_of(-normal_margin().xreplace({x: here[0], w: here[1]})))
    return heights, margins, gaps


def _sign_of(expression: Expr) -> Expr:
    """A polynomial in alpha with the sign of the rational function: numerator times denominator."""
    top, bottom = fraction(cancel(expression))
    return (top * bottom).expand() + 0 * alpha


def words(longest: int, most: int) -> Iterator[Word]:
    """The words of at most `longest` flights of at most `most` periods each: one of each cycle, and
    no repetition of a shorter one.

    >>> list(words(2, 2)), len(list(words(4, 3)))
    ([(1,), (2,), (1, 2)], 32)
    """
    for length in range(1, longest + 1):
        for word in product(range(1, most + 1), repeat=length):
            if all(word < word[k:] + word[:k] for k in range(1, length)):
                yield word


def longest_flight(at: Fraction) -> int:
    """The longest flight that an orbit with a word can have: floor((1 + alpha)/(1 - alpha)).

    >>> longest_flight(Fraction(1, 2)), longest_flight(Fraction(33, 100))
    (3, 1)
    """
    return int((1 + at) / (1 - at) // 1)


def search_words(alpha: Number, longest: int, flight: int | None = None) -> list[Orbit]:
    """All periodic orbits at this alpha with at most `longest` impacts; their flights have at most
    `flight` periods, or are as long as they can be.

    >>> [orbit.word for orbit in search_words(Fraction(1, 4), 4)]
    [(1,)]
    >>> [orbit.word for orbit in search_words(Fraction(1, 2), 2)]
    [(1,), (2,), (3,)]
    """
    at = restitution(alpha)
    counted(longest, "longest", 1, LONGEST_WORD)
    most = (
        longest_flight(at)
        if flight is None
        else min(counted(flight, "flight", 1, LONGEST_FLIGHT), longest_flight(at))
    )
    if sum(most**length for length in range(1, longest + 1)) > MOST_WORDS:
        raise SceneError(
            f"up to {longest} flights of up to {most} periods are more than {MOST_WORDS} words;"
            " give a smaller --longest or --flight"
        )
    return [one for word in words(longest, most) if (one := orbit_of(word, at)) is not None]
