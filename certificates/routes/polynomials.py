"""Polynomials with integer coefficients over one positive denominator, and formulas over their
signs: what the routes compute with.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import gcd
from typing import Union

Exponents = tuple[int, ...]
OPPOSITE = {">": "<=", ">=": "<", "=": "!=", "!=": "=", "<": ">=", "<=": ">"}


@dataclass(frozen=True)
class Polynomial:
    """sum c * x^e / den over the variables `names`; `terms` holds (exponents, c) from the largest
    exponents down.

    >>> p = Polynomial(("x", "y"), (((2, 0), 1), ((0, 1), -3)), 2)
    >>> str(p), p.at([Fraction(1, 2), Fraction(0)])
    ('1/2*x^2 - 3/2*y', Fraction(1, 8))
    """

    names: tuple[str, ...]
    terms: tuple[tuple[Exponents, int], ...]
    den: int = 1

    @staticmethod
    def of(names: tuple[str, ...], terms: Mapping[Exponents, int], den: int = 1) -> Polynomial:
        """The polynomial with these terms, zeros left out, in the one order that makes equal
        polynomials equal.
        """
        return Polynomial(
            names, tuple(sorted(((e, c) for e, c in terms.items() if c), reverse=True)), den
        )

    @cached_property
    def used(self) -> tuple[int, ...]:
        """The numbers of the variables that occur."""
        return tuple(i for i in range(len(self.names)) if any(e[i] for e, _ in self.terms))

    @cached_property
    def degrees(self) -> Exponents:
        """The degree in each variable."""
        return tuple(max((e[i] for e, _ in self.terms), default=0) for i in range(len(self.names)))

    @cached_property
    def _collections(self) -> dict[int, tuple[tuple[int, Polynomial], ...]]:
        return {}

    def collected(self, i: int) -> tuple[tuple[int, Polynomial], ...]:
        """The pairs (k, c_k) with the polynomial = sum c_k x_i^k / den, each c_k not 0 and without
        x_i, from k = 0 up.
        """
        if i not in self._collections:
            parts: dict[int, dict[Exponents, int]] = {}
            for e, c in self.terms:
                parts.setdefault(e[i], {})[(*e[:i], 0, *e[i + 1 :])] = c
            self._collections[i] = tuple(
                (k, Polynomial.of(self.names, terms)) for k, terms in sorted(parts.items())
            )
        return self._collections[i]

    @cached_property
    def minus(self) -> Polynomial:
        """The negative."""
        return Polynomial(self.names, tuple((e, -c) for e, c in self.terms), self.den)

    def at(self, point: Sequence[Fraction]) -> Fraction:
        """The exact value at a rational point.

        Source: the definition, in integers: every variable is brought to its own denominator once.
        """
        powers = []
        for value, degree in zip(point, self.degrees):
            n, d = value.numerator, value.denominator
            powers.append([n**k * d ** (degree - k) for k in range(degree + 1)])
        total, den = 0, self.den
        for value, degree in zip(point, self.degrees):
            den *= value.denominator**degree
        for exponents, c in self.terms:
            for table, e in zip(powers, exponents):
                c *= table[e]
            total += c
        return Fraction(total, den)

    def derivative(self, i: int) -> Polynomial:
        """The partial derivative by the i-th variable."""
        return Polynomial.of(
            self.names,
            {(*e[:i], e[i] - 1, *e[i + 1 :]): c * e[i] for e, c in self.terms if e[i]},
            self.den,
        )

    def with_value(self, i: int, value: Fraction) -> Polynomial:
        """The polynomial with a rational in place of the i-th variable; it stays a polynomial in
        the same names.
        """
        degree, terms = self.degrees[i], dict[Exponents, int]()
        for e, c in self.terms:
            key = (*e[:i], 0, *e[i + 1 :])
            terms[key] = terms.get(key, 0) + c * value.numerator ** e[i] * value.denominator ** (
                degree - e[i]
            )
        return Polynomial.of(self.names, terms, self.den * value.denominator**degree)

    def __str__(self) -> str:
        text = ""
        for exponents, c in self.terms:
            size = Fraction(abs(c), self.den)
            factors = [n if e == 1 else f"{n}^{e}" for n, e in zip(self.names, exponents) if e]
            factors = ([str(size)] if size != 1 or not factors else []) + factors
            text += (" - " if c < 0 else " + ") + "*".join(factors)
        return (text[3:] if text[:3] == " + " else "-" + text[3:]) if text else "0"


@dataclass(frozen=True)
class Atom:
    """The fact poly > 0, >= 0, = 0 or != 0."""

    poly: Polynomial
    relation: str

    def holds(self, value: Fraction | int) -> bool:
        """Whether the relation holds where the polynomial has this value (or a number of the same
        sign).
        """
        return {">": value > 0, ">=": value >= 0, "=": value == 0, "!=": value != 0}[self.relation]

    def __str__(self) -> str:
        return f"{self.poly} {self.relation} 0"


@dataclass(frozen=True)
class Join:
    """The conjunction ("and") or disjunction ("or") of formulas."""

    op: str
    parts: tuple[Formula, ...]


Formula = Union[bool, Atom, Join]


def conjuncts(formula: Formula) -> tuple[Formula, ...]:
    """The parts of a top-level conjunction; a formula of another kind alone."""
    if formula is True:
        return ()
    return formula.parts if isinstance(formula, Join) and formula.op == "and" else (formula,)


def atoms(formula: Formula) -> Iterator[Atom]:
    """Every atom in the formula, from left to right."""
    if isinstance(formula, Atom):
        yield formula
    elif isinstance(formula, Join):
        for part in formula.parts:
            yield from atoms(part)


def map_atoms(formula: Formula, change: Callable[[Atom], Formula]) -> Formula:
    """The same formula with `change` applied to every atom."""
    if isinstance(formula, Atom):
        return change(formula)
    if isinstance(formula, Join):
        return join(formula.op, [map_atoms(part, change) for part in formula.parts])
    return formula


def join(op: str, formulas: Sequence[Formula]) -> Formula:
    """The conjunction or disjunction, without constants, repetitions and joins of the same kind
    inside.
    """
    flat: list[Formula] = []
    for formula in formulas:
        if isinstance(formula, bool):
            if formula is (op == "or"):
                return formula
            continue
        for part in formula.parts if isinstance(formula, Join) and formula.op == op else (formula,):
            if part not in flat:
                flat.append(part)
    return op == "and" if not flat else flat[0] if len(flat) == 1 else Join(op, tuple(flat))


def atom(poly: Polynomial, relation: str) -> Formula:
    """The atom over coprime integer coefficients, or its truth value where the polynomial is
    constant.
    """
    if not poly.used:
        return Atom(poly, relation).holds(poly.terms[0][1] if poly.terms else 0)
    content = gcd(*(c for _, c in poly.terms))
    if relation in ("=", "!=") and poly.terms[0][1] < 0:
        content = -content
    return Atom(Polynomial(poly.names, tuple((e, c // content) for e, c in poly.terms)), relation)


def truth(formula: Formula, decide: Callable[[Atom], bool | None]) -> bool | None:
    """The truth value of the formula from those of its atoms; None where they do not tell."""
    if isinstance(formula, bool):
        return formula
    if isinstance(formula, Atom):
        return decide(formula)
    decisive, unsure = formula.op == "or", False
    for part in formula.parts:
        value = truth(part, decide)
        if value is decisive:
            return value
        unsure = unsure or value is None
    return None if unsure else not decisive


def branches(formula: Formula, limit: int) -> list[tuple[Atom, ...]] | None:
    """The disjunctive normal form: each branch a conjunction of atoms; None where it has more than
    `limit` branches.

    >>> x = Polynomial(("x",), (((1,), 1),))
    >>> either = Join("or", (Atom(x, ">"), Atom(x, "=")))
    >>> [[str(fact) for fact in b] for b in branches(either, 4) or []]
    [['x > 0'], ['x = 0']]
    """
    if isinstance(formula, bool):
        return [()] if formula else []
    if isinstance(formula, Atom):
        return [(formula,)]
    found: list[tuple[Atom, ...]] = [] if formula.op == "or" else [()]
    for part in formula.parts:
        inner = branches(part, limit)
        if inner is None:
            return None
        if formula.op == "or":
            found += inner
        else:
            found = [merged for a in found for b in inner if (merged := _merge(a, b)) is not None]
        if len(found) > limit:
            return None
    return found


def _merge(first: tuple[Atom, ...], second: tuple[Atom, ...]) -> tuple[Atom, ...] | None:
    facts = dict.fromkeys(first + second)
    # p > 0 and p <= 0 in one branch: it is empty, and dropping it here keeps the normal form small
    if any(f.relation == "=" and Atom(f.poly, r) in facts for f in facts for r in (">", "!=")):
        return None
    for fact in facts:
        if fact.relation == ">" and any(
            Atom(fact.poly.minus, r) in facts for r in (">", ">=", "=")
        ):
            return None
    return tuple(facts)
