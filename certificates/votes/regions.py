"""Facts made simple (to go: the search has these)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from importlib import import_module
from itertools import islice, product
from math import prod
from typing import Any, Union

from juggleproof.certificates.algebra.intervals import Box
from juggleproof.certificates.votes.questions import (
    Atom,
    Denial,
    Exponents,
    Formula,
    Polynomial,
    Question,
    atom,
    atoms,
    branches,
    flat,
    map_atoms,
    truth,
)
from juggleproof.certificates.votes.spans import (
    Bounds,
    Interval,
    bounding_box,
    dyadic,
    intervals,
    upper_end,
    zero_end,
)

# -------------------------------------------------------------------------------------------------
# Real algebraic numbers by polynomial and isolating interval, and exact signs of polynomials at
# them: for models that solvers return.

MOST_BITS = 1 << 14


@dataclass(frozen=True)
class Root:
    """The only root of the squarefree polynomial sum c_k x^k (integers, constant first) with low <
    root < high; no end is a root.

    >>> root_number([-2, 0, 1], 2)
    Root(coefficients=(-2, 0, 1), low=Fraction(0, 1), high=Fraction(4, 1))
    """

    coefficients: tuple[int, ...]
    low: Fraction
    high: Fraction

    def to(self, bits: int) -> tuple[Fraction, Fraction]:
        """An enclosure of width at most 2^-bits, by bisection on the change of sign."""
        low, high = self.low, self.high
        rising = _value(self.coefficients, high) > 0
        while (high - low) * (1 << bits) > 1:
            middle = (low + high) / 2
            value = _value(self.coefficients, middle)
            if value == 0:
                return middle, middle
            low, high = (low, middle) if (value > 0) == rising else (middle, high)
        return low, high

    def __str__(self) -> str:
        poly = Polynomial(
            ("z",),
            tuple(((k,), c) for k, c in sorted(enumerate(self.coefficients), reverse=True) if c),
        )
        low, high = self.to(12)
        return f"the root of {poly} in [{low}, {high}]"


Exact = Union[Fraction, Root]


def root_number(coefficients: Sequence[int], number: int) -> Exact:
    """The number-th real root, from the smallest up and counted from 1; a Fraction where bisection
    meets it.

    Source: Sturm's theorem.  Raises ValueError where the polynomial has a multiple root or too few
    real roots.
    """
    chain = _sturm([Fraction(c) for c in coefficients])
    if len(chain[-1]) != 1:
        raise ValueError("the polynomial has a multiple root")
    bound = Fraction(1)
    while bound <= 1 + max(abs(Fraction(c, coefficients[-1])) for c in coefficients[:-1]):
        bound *= 2
    low, high = -bound, bound
    left = _changes(chain, low)
    if not 1 <= number <= left - _changes(chain, high):
        raise ValueError("the polynomial has no such real root")
    while True:
        # between low and high lie the roots first + 1 .. last, and `number` is among them
        first, last = left - _changes(chain, low), left - _changes(chain, high)
        if last - first == 1 and low * high >= 0:
            return Root(tuple(coefficients), low, high)
        middle = (low + high) / 2
        below = left - _changes(chain, middle)  # roots in (-bound, middle]
        if _value(coefficients, middle) == 0:
            if below == number:
                return middle
            middle = _beside(chain, coefficients, middle, high if below < number else low)
            below = left - _changes(chain, middle)
        low, high = (low, middle) if below >= number else (middle, high)


def _beside(
    chain: list[list[Fraction]], coefficients: Sequence[int], root: Fraction, end: Fraction
) -> Fraction:
    """A point between a rational root and the end with no other root in between."""
    step = (end - root) / 2
    while (
        abs(_changes(chain, root) - _changes(chain, root + step)) > int(step < 0)
        or _value(coefficients, root + step) == 0
    ):
        step /= 2
    return root + step


def _value(coefficients: Sequence[int], at: Fraction) -> int:
    """The polynomial's value times a positive number: its sign."""
    n, d, total, scale = at.numerator, at.denominator, 0, 1
    for c in reversed(coefficients):
        total = total * n + c * scale
        scale *= d
    return total


def _sturm(p: list[Fraction]) -> list[list[Fraction]]:
    chain = [p, [k * c for k, c in enumerate(p)][1:]]
    while len(chain[-1]) > 1:
        rest, q = list(chain[-2]), chain[-1]
        while len(rest) >= len(q):
            factor, shift = rest[-1] / q[-1], len(rest) - len(q)
            rest = [c - factor * q[k - shift] if k >= shift else c for k, c in enumerate(rest)][:-1]
            while rest and rest[-1] == 0:
                rest.pop()
        if not rest:
            break
        chain.append([-c for c in rest])
    return chain


def _changes(chain: list[list[Fraction]], at: Fraction) -> int:
    signs = []
    for p in chain:
        value = Fraction(0)
        for c in reversed(p):
            value = value * at + c
        if value:
            signs.append(value > 0)
    return sum(a != b for a, b in zip(signs, signs[1:]))


def sign_at(poly: Polynomial, point: Sequence[Exact]) -> int | None:
    """The sign (-1, 0 or 1) of the polynomial at a point of rational and algebraic numbers; None
    where that takes too many bits.

    Formula: with integer coefficients, L = prod lead_i^deg_i and M >= |P| at all conjugates, D the
    product of the degrees:
    P(a) = 0 or |P(a)| >= (L M)^(1 - D) / L, because L P(a) is an algebraic integer of degree at
    most D.
    """
    for i, value in enumerate(point):
        if isinstance(value, Fraction) and i in poly.used:
            poly = poly.with_value(i, value)
    roots = {i: root for i in poly.used if isinstance(root := point[i], Root)}
    if not roots:
        total = sum(c for _, c in poly.terms)
        return (total > 0) - (total < 0)
    if not poly.terms:
        return 0
    cauchy = {
        i: 1 + max(-(-abs(c) // abs(r.coefficients[-1])) for c in r.coefficients[:-1])
        for i, r in roots.items()
    }
    size = sum(abs(c) * prod(cauchy[i] ** e[i] for i in roots) for e, c in poly.terms)
    lead = prod(abs(r.coefficients[-1]) ** poly.degrees[i] for i, r in roots.items())
    degree = prod(len(r.coefficients) - 1 for r in roots.values())
    bits, enough = 32, (lead * size).bit_length() * (degree - 1) + lead.bit_length() + 1
    while bits <= MOST_BITS:
        low, high = _range(poly, {i: r.to(bits) for i, r in roots.items()})
        if low > 0 or high < 0:
            return 1 if low > 0 else -1
        if max(high, -low) * (1 << enough) < 1:
            return 0
        bits *= 2
    return None


def _range(
    poly: Polynomial, ends: dict[int, tuple[Fraction, Fraction]]
) -> tuple[Fraction, Fraction]:
    low = high = Fraction(0)
    for exponents, c in poly.terms:
        a = b = Fraction(c)
        for i, (below, above) in ends.items():
            for _ in range(exponents[i]):
                corners = (a * below, a * above, b * below, b * above)
                a, b = min(corners), max(corners)
        low, high = low + a, high + b
    return low, high


def truth_at(formula: Formula, point: Sequence[Exact]) -> bool | None:
    """The exact truth value of the formula at the point; None where a sign takes too many bits."""

    def decide(fact: Atom) -> bool | None:
        sign = sign_at(fact.poly, point)
        return None if sign is None else fact.holds(sign)

    return truth(formula, decide)


# -------------------------------------------------------------------------------------------------
# Facts made simpler before boxes are cut: equations solved for a variable, factors of known sign
# divided out, contradictions seen.


@dataclass(frozen=True)
class Solved:
    """The i-th variable equals the polynomial, by one of the facts."""

    i: int
    value: Polynomial


def solve_equations(facts: Sequence[Atom]) -> tuple[list[Atom], list[Solved]] | None:
    """The facts with variables eliminated that an equation gives as a polynomial in the others;
    None where a fact becomes false.

    An equation serves where a variable stands in it once, alone, with a rational coefficient.
    """
    left, solved = list(facts), list[Solved]()
    while True:
        found = next(
            (s for fact in left if fact.relation == "=" if (s := _solution(fact.poly)) is not None),
            None,
        )
        if found is None:
            return left, solved
        solved.append(found)
        changed: list[Atom] = []
        for fact in left:
            new = atom(insert(fact.poly, found), fact.relation)
            if new is False:
                return None
            if isinstance(new, Atom) and new not in changed:
                changed.append(new)
        left = changed


def _solution(poly: Polynomial) -> Solved | None:
    for i in poly.used:
        mine = [(e, c) for e, c in poly.terms if e[i]]
        if len(mine) == 1 and sum(mine[0][0]) == 1:
            c = mine[0][1]
            rest = {e: -d * (1 if c > 0 else -1) for e, d in poly.terms if not e[i]}
            return Solved(i, Polynomial.of(poly.names, rest, abs(c)))
    return None


def insert(poly: Polynomial, solved: Solved) -> Polynomial:
    """The polynomial with the solved variable replaced by its value, times a positive number where
    that clears denominators.
    """
    degree = poly.degrees[solved.i]
    if not degree:
        return poly
    width = len(poly.names)
    powers: list[dict[Exponents, int]] = [{(0,) * width: 1}]
    for _ in range(degree):
        powers.append(_multiply(powers[-1], dict(solved.value.terms)))
    total: dict[Exponents, int] = {}
    for e, c in poly.terms:
        scale = c * solved.value.den ** (degree - e[solved.i])
        rest = (*e[: solved.i], 0, *e[solved.i + 1 :])
        for f, d in powers[e[solved.i]].items():
            key = tuple(a + b for a, b in zip(rest, f))
            total[key] = total.get(key, 0) + scale * d
    return Polynomial.of(poly.names, total, poly.den * solved.value.den**degree)


def _multiply(a: dict[Exponents, int], b: dict[Exponents, int]) -> dict[Exponents, int]:
    product: dict[Exponents, int] = {}
    for e, c in a.items():
        for f, d in b.items():
            key = tuple(x + y for x, y in zip(e, f))
            product[key] = product.get(key, 0) + c * d
    return product


def reduce_factors(
    facts: Sequence[Atom], bounds: Sequence[Bounds] | None = None
) -> list[Atom] | None:
    """Facts that follow from the given ones and are simpler; None where they contradict each other.

    Formula: p = f q > 0 with f > 0 or f >= 0 among the facts (or on the box) gives q > 0; p = f q
    >= 0 with f > 0 gives q >= 0; p = f^2 q > 0 gives q > 0.  Source: flint's factorization over the
    integers.
    """
    current, box = list(dict.fromkeys(facts)), intervals(bounds) if bounds is not None else None
    for _ in range(4):
        signs = {fact.poly: fact.relation for fact in current if fact.relation in (">", ">=")}
        new: list[Atom] = []
        for fact in current:
            simpler = _simplified(fact, signs, box)
            if simpler is False:
                return None
            if isinstance(simpler, Atom) and simpler not in new:
                new.append(simpler)
        if _contradict(new):
            return None
        if new == current:
            break
        current = new
    return current


def _simplified(
    fact: Atom, signs: dict[Polynomial, str], box: Sequence[Interval] | None
) -> Atom | bool:
    if fact.relation not in (">", ">="):
        return fact
    names = fact.poly.names
    constant, factors = factorization(fact.poly)
    if len(factors) < 2 and factors and factors[0][1] == 1:
        return fact
    positive, kept = constant > 0, list[tuple[Polynomial, int]]()
    for factor, exponent in factors:
        sign = _known_sign(factor, signs, box, fact.relation)
        if sign:
            positive = positive == (sign > 0 or exponent % 2 == 0)
        elif fact.relation == ">":
            kept += [(factor, 1)] if exponent % 2 else []
        else:
            kept.append((factor, 2 - exponent % 2))
    if fact.relation == ">=" and not positive and all(exponent == 2 for _, exponent in kept):
        kept, relation = [(factor, 1) for factor, _ in kept], "="  # -q^2 >= 0
    else:
        relation = fact.relation
    product = {(0,) * len(names): 1 if positive else -1}
    for factor, exponent in kept:
        for _ in range(exponent):
            product = _multiply(product, dict(factor.terms))
    new = atom(Polynomial.of(names, product), relation)
    return (
        fact if new is not False and new == fact else new if isinstance(new, (bool, Atom)) else fact
    )


def _known_sign(
    factor: Polynomial, signs: dict[Polynomial, str], box: Sequence[Interval] | None, relation: str
) -> int:
    """1 or -1 where the factor is known to be > 0 or < 0; for a strict product >= 0 or <= 0
    suffice.
    """
    enough = (">", ">=") if relation == ">" else (">",)
    minus = factor.minus
    if signs.get(factor) in enough:
        return 1
    if signs.get(minus) in enough:
        return -1
    if box is not None:
        for poly, sign in ((factor, -1), (minus, 1)):
            end = upper_end(poly, box)
            if end < zero_end() or relation == ">" and end == zero_end():
                return sign
    return 0


def _contradict(facts: Sequence[Atom]) -> bool:
    seen = {fact.poly: fact.relation for fact in facts if fact.relation in (">", ">=")}
    for fact in facts:
        minus = fact.poly.minus
        if fact.relation == ">" and minus in seen:
            return True
        if fact.relation == "=" and ">" in (seen.get(fact.poly), seen.get(minus)):
            return True
    return False


def factorization(poly: Polynomial) -> tuple[int, list[tuple[Polynomial, int]]]:
    """The constant and the irreducible factors over the integers, each with its exponent."""
    flint: Any = import_module("flint")
    context = flint.fmpz_mpoly_ctx.get(poly.names, flint.Ordering.lex)
    constant, factors = context.from_dict(dict(poly.terms)).factor()
    found = [
        (
            Polynomial.of(poly.names, {tuple(map(int, e)): int(c) for e, c in f.to_dict().items()}),
            int(k),
        )
        for f, k in factors
    ]
    return int(constant), sorted(found, key=lambda pair: (pair[0].terms, pair[1]))


# -------------------------------------------------------------------------------------------------
# The region of a question, branch by branch: facts made simple, a box that holds it, and exact
# points of it.

MOST_BRANCHES, MOST_SAMPLES, ENOUGH_SAMPLES = 64, 128, 8
TRIAL_SIDE = Fraction(8)
SAMPLES = [
    Fraction(n, d)
    for n, d in (
        (1, 4),
        (1, 1),
        (1, 8),
        (0, 1),
        (2, 1),
        (1, 2),
        (3, 2),
        (-1, 1),
        (3, 1),
        (7, 1),
        (5, 4),
        (-3, 1),
    )
]


@dataclass(frozen=True)
class Region:
    """One branch, ready for boxes; variables that an equation gives are `solved` and no longer
    occur in the facts.
    """

    names: tuple[str, ...]
    facts: tuple[Atom, ...]
    solved: tuple[Solved, ...]
    bounds: tuple[Bounds, ...]

    def used(self) -> list[int]:
        """The numbers of the variables that still occur."""
        return sorted({i for fact in self.facts for i in fact.poly.used})

    def unbounded(self) -> list[str]:
        """The variables that still occur and that nothing bounds."""
        return [self.names[i] for i in self.used() if self.bounds[i][0][0] or self.bounds[i][1][0]]

    def box(self) -> Box:
        """Dyadic sides around the intervals; infinite ones are cut, and variables that no longer
        occur stay at one value.
        """
        used, sides = self.used(), []
        for i, (low, high) in enumerate(self.bounds):
            a = (
                low[1]
                if not low[0]
                else min(-TRIAL_SIDE, high[1] - 2 * TRIAL_SIDE)
                if not high[0]
                else -TRIAL_SIDE
            )
            b = high[1] if not high[0] else max(TRIAL_SIDE, a + 2 * TRIAL_SIDE)
            sides.append(dyadic(a, b) if i in used else dyadic((a + b) / 2, (a + b) / 2))
        return tuple(sides)

    def complete(self, point: Sequence[Fraction]) -> list[Fraction]:
        """The point with the solved variables computed from the others."""
        values = list(point)
        for step in reversed(self.solved):
            values[step.i] = step.value.at(values)
        return values

    def test(self, formula: Formula) -> Callable[[list[Fraction]], bool]:
        """The exact test whether the completed point meets the formula."""
        return lambda point: holds_at(formula, self.complete(point))

    def samples(self, formula: Formula) -> Iterator[list[Fraction]]:
        """A few exact points of the region that meet the formula, from small numbers."""
        used, found = self.used(), 0
        sides = [self.bounds[i] for i in used]
        choices = [
            [v for v in SAMPLES if side[0] <= (0, v) <= side[1]] or [_inside(side)]
            for side in sides
        ]
        for values in islice(product(*choices), MOST_SAMPLES):
            point = [Fraction(0)] * len(self.names)
            for i, value in zip(used, values):
                point[i] = value
            point = self.complete(point)
            if holds_at(formula, point):
                yield point
                found += 1
                if found == ENOUGH_SAMPLES:
                    return


def holds_at(formula: Formula, point: Sequence[Fraction]) -> bool:
    """The exact truth value of the formula at a rational point."""
    return truth(formula, lambda fact: fact.holds(fact.poly.at(point))) is True


def regions(names: tuple[str, ...], formula: Formula) -> list[Region] | None:
    """The branches of the formula that are not seen to be empty at once; None where there are too
    many.
    """
    parts = branches(formula, MOST_BRANCHES)
    if parts is None:
        return None
    found = (_region(names, facts) for facts in parts)
    return [region for region in found if region is not None]


def _region(names: tuple[str, ...], facts: Sequence[Atom]) -> Region | None:
    """The branch as a region; None where its facts contradict each other on the way.

    Factors may turn into equations and bounds may give factors a sign, so both are gone through
    twice.
    """
    current, solved = list(facts), list[Solved]()
    bounds: list[Bounds] | None = None
    for _ in range(2):
        solution = solve_equations(current)
        reduced = reduce_factors(solution[0], bounds) if solution is not None else None
        if solution is None or reduced is None:
            return None
        solved += solution[1]
        if bounds is None or reduced != current:
            bounds = bounding_box(reduced, len(names))
        if bounds is None:
            return None
        current = reduced
    return Region(names, tuple(current), tuple(solved), tuple(bounds or ()))


def _inside(bounds: Bounds) -> Fraction:
    (low_kind, low), (high_kind, high) = bounds
    return (
        (low + high) / 2
        if not low_kind and not high_kind
        else low + 1
        if not low_kind
        else high - 1
    )


# -------------------------------------------------------------------------------------------------
# Units: which positive variables may be set to 1, because every fact is homogeneous in some
# grading of the variables.


def fixed_by_units(question: Question) -> tuple[str, ...]:
    """The variables that may be set to 1 without loss.

    Formula: if every fact is homogeneous for the weights W_i of a grading, then x_i -> t^(W_i) x_i
    keeps all signs for every t > 0. Positive variables whose columns of W are independent can so be
    brought to 1 together, whatever the others are. Source: the quotient of the positive torus by
    its action on the solutions (dimensional analysis).
    """
    positive = [
        next(iter(f.poly.used))
        for f in question.assumed
        if isinstance(f, Atom) and f.relation == ">" and _is_variable(f)
    ]
    free = [
        i
        for i in dict.fromkeys(positive)
        if question.names[i] not in question.bound | question.integers
    ]
    if not free:
        return ()
    chosen: list[int] = []
    basis = _gradings(question)
    for i in sorted(free):
        if _rank([[row[j] for j in [*chosen, i]] for row in basis]) == len(chosen) + 1:
            chosen.append(i)
    return tuple(question.names[i] for i in sorted(chosen))


def at_unit_values(question: Question, names: tuple[str, ...]) -> Question:
    """The question with 1 in place of the named variables."""
    places = [question.names.index(name) for name in names]

    def change(fact: Atom) -> Formula:
        poly = fact.poly
        for i in places:
            poly = poly.with_value(i, Fraction(1))
        return atom(poly, fact.relation)

    assumed = flat([map_atoms(formula, change) for formula in question.assumed])
    return replace(
        question,
        assumed=assumed,
        denials=tuple(Denial(d.bound, map_atoms(d.formula, change)) for d in question.denials),
    )


def _is_variable(fact: Atom) -> bool:
    (exponents, c), *rest = fact.poly.terms
    return not rest and c > 0 and sum(exponents) == 1


def _gradings(question: Question) -> list[list[Fraction]]:
    """A basis of the weights for which every polynomial of the question is homogeneous: the null
    space of all differences of exponents.

    Integers have weight 0: they keep their values.
    """
    differences: dict[tuple[int, ...], None] = {}
    for formula in (*question.assumed, *(denial.formula for denial in question.denials)):
        for fact in atoms(formula):
            first = fact.poly.terms[0][0]
            differences.update(
                dict.fromkeys(
                    tuple(a - b for a, b in zip(e, first)) for e, _ in fact.poly.terms[1:]
                )
            )
    loose, width = [], len(question.names)
    whole = [
        [Fraction(int(i == j)) for j in range(width)]
        for i, name in enumerate(question.names)
        if name in question.integers
    ]
    rows, pivots = _reduced([*whole, *([Fraction(x) for x in row] for row in differences)])
    for free in (i for i in range(width) if i not in pivots):
        vector = [Fraction(int(i == free)) for i in range(width)]
        for row, pivot in zip(rows, pivots):
            vector[pivot] = -row[free]
        loose.append(vector)
    return loose


def _reduced(rows: list[list[Fraction]]) -> tuple[list[list[Fraction]], list[int]]:
    """The nonzero rows of the reduced echelon form, and the columns of their leading ones."""
    kept: list[list[Fraction]] = []
    pivots: list[int] = []
    for row in rows:
        for done, pivot in zip(kept, pivots):
            if row[pivot]:
                row = [a - row[pivot] * b for a, b in zip(row, done)]
        lead = next((i for i, a in enumerate(row) if a), None)
        if lead is None:
            continue
        row = [a / row[lead] for a in row]
        kept = [[a - done[lead] * b for a, b in zip(done, row)] for done in kept]
        kept.append(row)
        pivots.append(lead)
    return kept, pivots


def _rank(rows: list[list[Fraction]]) -> int:
    return len(_reduced([list(row) for row in rows])[1])
