"""Questions to methods: a supremum on a box, an orbit, an ensemble; their answers; and a point
where the supremum is nearly attained.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import permutations, product
from math import inf, lcm

from juggleproof.algebra.box_trees import Exponents, Terms, simple_points, value_at

# -------------------------------------------------------------------------------------------------
# Questions as plain data, which a process of its own can read without SymPy and NumPy: the least
# upper bound of a fraction of polynomials on a box, orbits, and ensembles.


@dataclass(frozen=True)
class BoundQuestion:
    """The supremum of over/under on the box; under > 0 inside it, and where under = 0 on its
    boundary, over < 0.

    So over/under <= m everywhere if and only if m under - over >= 0 on the closed box.  `sign` is
    -1 if the question is for the infimum of -over/under.  `statement` says the same of the paper's
    set itself, in the checker's language, with {bound} for the bound of the question as it is
    asked; `smt` asks in SMT-LIB for a point of the set that exceeds it.
    """

    name: str
    names: tuple[str, ...]
    box: tuple[tuple[Fraction, Fraction], ...]
    over: Terms
    under: Terms
    sign: int
    statement: str
    smt: str

    def excess(self, bound: Fraction) -> dict[Exponents, Fraction]:
        """bound * under - over, which is >= 0 on the box if and only if the supremum is at most the
        bound.
        """
        total = {exponents: c * bound for exponents, c in self.under.items()}
        for exponents, c in self.over.items():
            total[exponents] = total.get(exponents, Fraction(0)) - c
        return {exponents: c for exponents, c in total.items() if c}

    def at(self, point: Sequence[Fraction]) -> Fraction | None:
        """over/under at a point; None if under is 0."""
        under = value_at(self.under, point)
        return value_at(self.over, point) / under if under else None

    def of_set(self, bound: Fraction) -> str:
        """The statement that nothing in the set exceeds the bound (or is below its negative, if the
        question is for the infimum).
        """
        return self.statement.format(bound=self.sign * bound)

    def asked(self, bound: Fraction) -> str:
        """The question whether something in the set exceeds the bound (is below its negative), in
        SMT-LIB without a check.
        """
        value = self.sign * bound
        size = f"(/ {abs(value.numerator)}.0 {value.denominator}.0)"
        return self.smt.format(bound=size if value >= 0 else f"(- {size})")

    def of_box(self, low: Fraction, high: Fraction) -> str:
        """The statement that over/under is at most `high` at every point of the box where it is at
        least `low`, in the checker's language.

        Its certificate holds a point at which over/under is at least `low`.  So the supremum is at
        least `low`, and at most `high`.
        """
        (a, b), (c, d) = low.as_integer_ratio(), high.as_integer_ratio()
        return self.boxed.format(low=a, below=b, high=c, above=d)

    @cached_property
    def boxed(self) -> str:
        """The text of `of_box`, with the bounds low/below and high/above still to be put in."""
        unit = lcm(*(c.denominator for terms in (self.over, self.under) for c in terms.values()))
        over, under = (
            _shortest({e: c * unit for e, c in terms.items()}, self.names)
            for terms in (self.over, self.under)
        )
        return "\n".join(
            [
                f"statement bench/{self.name}",
                "forall " + " ".join(self.names),
                *(
                    f"given {low} <= {name} <= {high}"
                    for name, (low, high) in zip(self.names, self.box)
                ),
                f"let over = {over}",
                f"let under = {under}",
                "given under > 0",
                "given {below}*over >= {low}*under",
                "show {above}*over <= {high}*under",
                "",
            ]
        )


def _shortest(terms: Terms, names: Sequence[str]) -> str:
    """The polynomial nested by its variables; if they are few, in the order that makes the text
    shortest.
    """
    orders = permutations(range(len(names))) if len(names) < 5 else [tuple(range(len(names)))]
    texts = [
        horner(
            {tuple(e[i] for i in order): c for e, c in terms.items()},
            [names[i] for i in order],
            str,
        )
        for order in orders
    ]
    return min(texts, key=len) or "0"


def horner(terms: Terms, names: Sequence[str], write: Callable[[Fraction], str]) -> str:
    """The polynomial nested by its variables: short, and enclosed by intervals more tightly than a
    sum of monomials; an empty text for 0.

    >>> F = Fraction
    >>> horner({(0, 1): F(2), (2, 0): F(1), (2, 1): F(-3)}, ["x", "y"], str)
    'y*2 + x*(x*(1 + y*(-3)))'
    """
    if not names:
        (value,) = terms.values()
        return write(value)
    rest = {(e[0] - 1, *e[1:]): c for e, c in terms.items() if e[0]}
    without = {e[1:]: c for e, c in terms.items() if not e[0]}
    parts = [horner(without, names[1:], write)] if without else []
    if rest:
        inside = horner(rest, names, write)
        parts.append(f"{names[0]}*{inside}" if inside.isalnum() else f"{names[0]}*({inside})")
    return " + ".join(parts)


@dataclass(frozen=True)
class Start:
    """An orbit: restitution and starting state, in normal form."""

    name: str
    title: str
    alpha: Fraction
    x: Fraction
    w: Fraction


@dataclass(frozen=True)
class OrbitQuestion:
    """Random states for one alpha, all followed for the same number of periods."""

    alpha: Fraction = Fraction(3, 10)


@dataclass(frozen=True)
class Drops:
    """Blocks that fall on the vibrating table, `copies` of each of the known ones."""

    copies: int = 500


Work = BoundQuestion | Start | OrbitQuestion | Drops

# -------------------------------------------------------------------------------------------------
# Answers, and measurements of them.


class GaveUp(Exception):
    """The method ends without the width that was asked for; the message says why."""


@dataclass(frozen=True)
class Answer:
    """low <= supremum <= high by the method; without `high` it is a value and no bound.  `note` is
    printed beside it.
    """

    low: Fraction
    high: Fraction | None = None
    note: str = ""

    def error(self, truth: Fraction) -> Fraction:
        """The width of the enclosure; the distance to the truth if there is none."""
        return abs(truth - self.low) if self.high is None else self.high - self.low

    def wrong(self, truth: Fraction) -> bool:
        """Whether an enclosure does not hold the truth."""
        return self.high is not None and not self.low <= truth <= self.high


@dataclass(frozen=True)
class Strayed:
    """The distance of a state from the exact one, and the method's bound of it, None if it gives
    none.
    """

    distance: Fraction
    bound: Fraction | None
    note: str = ""
    beyond: bool = False  # whether the distance exceeds the bound

    def error(self, truth: Fraction) -> Fraction:
        """The bound, or the distance if there is no bound."""
        return self.distance if self.bound is None else self.bound

    def wrong(self, truth: Fraction) -> bool:
        """Whether the distance exceeds the bound."""
        return self.beyond


@dataclass(frozen=True)
class MeasuredAnswer:
    """One method on one piece of work: its answer with its seconds, or why there is none."""

    method: str
    size: Fraction
    cold: float | None = None
    warm: float | None = None
    answer: Answer | Strayed | None = None
    reason: str = ""

    @property
    def seconds(self) -> float | None:
        """The warm seconds, or the cold ones if there was no time for more."""
        return self.cold if self.warm is None else self.warm


# -------------------------------------------------------------------------------------------------
# A rational point where the fraction of a problem is nearly greatest: by floating point, its value
# computed exactly.
#
# In plain floats, since the problems are small: to load NumPy takes longer than all the rest.

Point = tuple[Fraction, ...]
Floats = list[float]
SHARE = 8  # methods ask for a point to within 1/SHARE of the width, and bound by the rest
AXES = 3  # at a time: 27 places
STEPS, AHEAD = 200, 8
DAMPING, LEAST, MOST, FACTOR = 1e-3, 1e-18, 1e9, 8  # Levenberg's
NOISE = 2.0**-52
CLOSE = 1e-9  # values farther apart than this differ for certain


def best_point(problem: BoundQuestion, slack: Fraction) -> tuple[Point, Fraction]:
    """A point of the box and the value there, which no point tried exceeds by more than `slack`.

    Raises ArithmeticError if the fraction has no value at any of them.
    """
    quotient = _Quotient(problem)
    value, place = quotient.greatest_near(float(slack))
    best: tuple[Point, Fraction] | None = None
    least = value - max(2 * float(slack), CLOSE)
    for point in simple_points(place, problem.box):
        if quotient.at([float(v) for v in point]) < least:
            continue  # too simple
        exact = problem.at(point)
        if exact is not None and (best is None or exact > best[1]):
            best = point, exact
        if best is not None and best[1] >= Fraction(value) - slack:
            break
    if best is None:
        raise ArithmeticError(f"{problem.name}: no point of the box has a value")
    return best


class _Quotient:
    """over/under in floating point, on the box."""

    def __init__(self, problem: BoundQuestion) -> None:
        self.low, self.high = ([float(pair[k]) for pair in problem.box] for k in (0, 1))
        self.monomials = [
            (e, float(problem.over.get(e, 0)), float(problem.under.get(e, 0)))
            for e in dict.fromkeys([*problem.over, *problem.under])
        ]
        self.most = max(max(e) for e, _, _ in self.monomials)

    def greatest_near(self, slack: float) -> tuple[float, Floats]:
        """(value, place) where the value no longer rises by much of the slack, from a start among
        the box's corners and middles.

        At a place where over/under = m, a damped Newton step for m under - over, kept in the box,
        leads to a greater value: Dinkelbach's iteration, a step at a time.  Source: Dinkelbach, On
        nonlinear fractional programming, Management Science 13 (1967).
        """
        value, x = self.start()
        damping, before = DAMPING, 0.0
        for _ in range(STEPS):
            slope, bend, noise = self.excess(x, value)
            free = [
                i
                for i, s in enumerate(slope)
                if s < 0 and x[i] < self.high[i] or s > 0 and x[i] > self.low[i]
            ]
            scale, gained = max(max(map(abs, row)) for row in bend) or 1.0, 0.0
            while free and damping < MOST and not gained > 0:
                step = solved(
                    [
                        [bend[i][j] + (damping * scale if i == j else 0.0) for j in free]
                        for i in free
                    ],
                    [slope[i] for i in free],
                )
                if step is not None:
                    moved = x[:]
                    for i, change in zip(free, step):
                        moved[i] = min(max(x[i] - change, self.low[i]), self.high[i])
                    after = self.at(moved)
                    gained = after - value
                    if (
                        not gained > 0
                        and sum(slope[i] * change for i, change in zip(free, step)) <= noise
                    ):
                        break  # a shorter step would gain even less
                damping = max(damping / FACTOR, LEAST) if gained > 0 else damping * FACTOR
            if not gained > 0:
                break
            x, value = moved, after
            if before and gained * min(gained / before, 1.0) <= slack / AHEAD:
                break  # gains go down at least this fast
            before = gained
        return value, x

    def start(self) -> tuple[float, Floats]:
        """(value, place): the search begins at the middle of the box, and takes the best of all
        ends and middles of few axes at a time, until nothing is gained.
        """
        ends = list(
            zip(self.low, [(low + high) / 2 for low, high in zip(self.low, self.high)], self.high)
        )
        best, place, gained = -inf, [middle for _, middle, _ in ends], True
        while gained:
            gained = False
            for k in range(0, len(ends), AXES):
                few = ends[k : k + AXES]
                value, moved = max(
                    (self.at(moved), moved)
                    for moved in (
                        [*place[:k], *chosen, *place[k + len(few) :]] for chosen in product(*few)
                    )
                )
                if value > best:
                    best, place, gained = value, moved, len(ends) > AXES
        return best, place

    def at(self, x: Sequence[float]) -> float:
        """The value at a place; -infinity if under is not positive."""
        over = under = 0.0
        for exponents, c, d in self.monomials:
            part = 1.0
            for v, e in zip(x, exponents):
                if e:
                    part *= v**e
            over += c * part
            under += d * part
        return over / under if under > 0 else -inf

    def excess(self, x: Floats, value: float) -> tuple[Floats, list[Floats], float]:
        """Gradient and Hessian of value * under - over at a place, and a bound of its rounding."""
        axes = range(len(x))
        powers = [[v**e for e in range(self.most + 1)] for v in x]
        slope, bend, noise = [0.0 for _ in axes], [[0.0 for _ in axes] for _ in axes], 0.0
        for exponents, c, d in self.monomials:
            factors = [table[e] for table, e in zip(powers, exponents)]
            noise += (abs(value * d) + abs(c)) * abs(_product(factors, 1.0))
            for i in axes:
                e = exponents[i]
                if not e:
                    continue
                others = factors[:]
                others[i] = e * powers[i][e - 1]
                slope[i] += _product(others, value * d - c)
                for j in range(i + 1, len(x)):
                    f = exponents[j]
                    if f:
                        kept, others[j] = others[j], f * powers[j][f - 1]
                        bend[i][j] += _product(others, value * d - c)
                        others[j] = kept
                if e > 1:
                    others[i] = e * (e - 1) * powers[i][e - 2]
                    bend[i][i] += _product(others, value * d - c)
        for i in axes:
            for j in range(i):
                bend[i][j] = bend[j][i]
        return slope, bend, NOISE * noise


def _product(factors: Floats, total: float) -> float:
    for factor in factors:
        total *= factor
    return total


def solved(matrix: list[Floats], right: Floats) -> Floats | None:
    """The solution of a symmetric system by Cholesky's method without roots; None if the matrix is
    not positive definite.

    >>> solved([[4.0, 2.0], [2.0, 3.0]], [8.0, 8.0])
    [1.0, 2.0]
    >>> solved([[1.0, 2.0], [2.0, 1.0]], [1.0, 1.0])
    """
    size, rows, found = len(right), [row[:] for row in matrix], right[:]
    for k in range(size):
        if not rows[k][k] > 0:
            return None
        for i in range(k + 1, size):
            factor = rows[i][k] / rows[k][k]
            for j in range(k, size):
                rows[i][j] -= factor * rows[k][j]
            found[i] -= factor * found[k]
    for k in reversed(range(size)):
        found[k] = (found[k] - sum(rows[k][j] * found[j] for j in range(k + 1, size))) / rows[k][k]
    return found
