"""Values of terms and normal forms of formulas, over polynomials of python-flint."""

from __future__ import annotations

from collections.abc import Mapping
from math import gcd, lcm
from typing import Any, NamedTuple

from flint import Ordering, fmpq, fmpq_mpoly_ctx, fmpq_poly
from flint import fmpq_mpoly as Poly

from tests.certificates.reader.syntax import Rejected, Tree, require

MAX_VARIABLES = 60
RING = fmpq_mpoly_ctx.get([f"x{i}" for i in range(MAX_VARIABLES)], Ordering.lex)
GENERATORS = RING.gens()
ZERO, ONE = RING.constant(0), RING.constant(1)

# True, False, (">" ">=" "=" "!=", p), or ("and" "or", [parts])
Normal = Any


def rational(p: Poly) -> fmpq | None:
    """The number that a polynomial is."""
    if not p.is_constant():
        return None
    return p.leading_coefficient() if p else fmpq(0)


def variables(p: Poly) -> list[int]:
    return [i for i, degree in enumerate(p.degrees()) if degree > 0]


def univariate(p: Poly, variable: int) -> fmpq_poly:
    """The polynomial in one variable, in which alone it is."""
    coefficients = [fmpq(0)] * (p.degrees()[variable] + 1)
    for monomial, c in p.terms():
        coefficients[monomial[variable]] = c
    return fmpq_poly(coefficients)


def primitive(p: Poly) -> Poly:
    """The positive multiple with integer coefficients that have no common divisor."""
    under = lcm(*(int(c.q) for c in p.coeffs()))
    return p * fmpq(under, gcd(*(int(c.p) * under // int(c.q) for c in p.coeffs())))


class Licences:
    """Polynomials that are known to be nonzero, and whether they are known to be positive.

    All of a check stand in one list, and a value names them by their numbers there; `numbers` are
    those that hold here.
    """

    def __init__(self, all: list[tuple[Poly, bool]], numbers: list[int]) -> None:
        self.all = all
        self.numbers = numbers

    def copy(self) -> Licences:
        return Licences(self.all, list(self.numbers))

    def add(self, relation: str, p: Poly) -> None:
        if relation not in (">", "!="):
            return
        licence = primitive(p), relation == ">"
        found = self.find(p)
        if found is not None:
            number, _ = found
            if self.all[number][1] or not licence[1]:
                return
            self.numbers.remove(number)
        if licence not in self.all:
            self.all.append(licence)
        self.numbers.append(self.all.index(licence))

    def find(self, p: Poly) -> tuple[int, fmpq] | None:
        """The licence and the factor c with p = c * licence."""
        for number in self.numbers:
            other, _ = self.all[number]
            if p and other * (c := p.leading_coefficient() / other.leading_coefficient()) == p:
                return number, c
        return None


class Value(NamedTuple):
    """A numerator over powers of licensed polynomials."""

    top: Poly
    under: Mapping[int, int] = {}


class Reader:
    """Reads terms and formulas where names have values and polynomials are licensed."""

    def __init__(self, names: Mapping[str, Value], licences: Licences) -> None:
        self.names = dict(names)
        self.licences = licences

    def value(self, tree: Tree) -> Value:
        tag = tree[0]
        if tag == "name":
            require(tree[1] in self.names, f"{tree[1]} is unknown")
            return self.names[tree[1]]
        if tag == "number":
            return Value(RING.constant(tree[1]))
        if tag == "-" and len(tree) == 2:
            top, under = self.value(tree[1])
            return Value(-top, under)
        if tag == "^":
            top, under = self.value(tree[1])
            return Value(top ** tree[2], {k: e * tree[2] for k, e in under.items() if tree[2]})
        left = self.value(tree[1])
        if tag == "/":
            return self.divide(left, tree[2])
        right = self.value(tree[2])
        if tag == "*":
            return Value(left.top * right.top, _added(left.under, right.under))
        if tag == "-":
            right = Value(-right.top, right.under)
        under = {
            k: max(left.under.get(k, 0), right.under.get(k, 0)) for k in (*left.under, *right.under)
        }
        return Value(self._over(left, under) + self._over(right, under), under)

    def _over(self, value: Value, under: Mapping[int, int]) -> Poly:
        top = value.top
        for k, e in under.items():
            if more := e - value.under.get(k, 0):
                top *= self.licences.all[k][0] ** more
        return top

    def divide(self, value: Value, tree: Tree) -> Value:
        divisor = self.value(tree)
        top = value.top
        for k, e in divisor.under.items():
            top *= self.licences.all[k][0] ** e
        number = rational(divisor.top)
        if number is not None and number != 0:
            return Value(top / number, value.under)
        found = self.licences.find(divisor.top)
        if found is not None:
            k, c = found
            return Value(top / c, _added(value.under, {k: 1}))
        if tree[0] == "*":
            return self.divide(self.divide(value, tree[1]), tree[2])
        if tree[0] == "^" and tree[2] > 0:
            for _ in range(tree[2]):
                value = self.divide(value, tree[1])
            return value
        raise Rejected(f"division by {divisor.top}, which may be 0")

    def polynomial(self, tree: Tree) -> Poly:
        top, under = self.value(tree)
        require(not under, "a polynomial was expected")
        return top

    def atom(self, relation: str, left: Tree, right: Tree) -> Normal:
        if relation in ("<", "<="):
            relation, left, right = relation.replace("<", ">"), right, left
        top, under = self.value(("-", left, right))
        if relation in (">", ">="):
            for k, e in under.items():
                licence, positive = self.licences.all[k]
                top *= licence if e % 2 and not positive else 1
        return atom(relation, top)

    def formula(self, tree: Tree, holds: bool = True) -> Normal:
        """The normal form of a formula, or of its negation."""
        tag = tree[0]
        if tag == "not":
            return self.formula(tree[1], not holds)
        if tag in ("and", "or"):
            parts = [self.formula(part, holds) for part in tree[1:]]
            return join(tag if holds else "or" if tag == "and" else "and", parts)
        normal = self.atom(*tree)
        return normal if holds else negation(normal)

    def license(self, normal: Normal) -> None:
        """What the atoms of a line at top level license for the lines after it."""
        for part in conjuncts(normal):
            if isinstance(part, tuple) and part[0] != "or":
                self.licences.add(*part)


def _added(left: Mapping[int, int], right: Mapping[int, int]) -> dict[int, int]:
    return {k: left.get(k, 0) + right.get(k, 0) for k in (*left, *right)}


def atom(relation: str, p: Poly) -> Normal:
    """p > 0, p >= 0, p = 0 or p != 0; true or false where p is a number."""
    number = rational(p)
    if number is None:
        return relation, p
    if relation == ">":
        return number > 0
    if relation == ">=":
        return number >= 0
    return (number == 0) == (relation == "=")


def join(tag: str, parts: list[Normal]) -> Normal:
    """The conjunction or disjunction of normal forms, flattened."""
    neutral = tag == "and"
    flat: list[Normal] = []
    for part in parts:
        if part is (not neutral):
            return part
        if part is neutral:
            continue
        flat += part[1] if part[0] == tag else [part]
    if not flat:
        return neutral
    return flat[0] if len(flat) == 1 else (tag, flat)


def conjuncts(normal: Normal) -> list[Normal]:
    if isinstance(normal, tuple) and normal[0] == "and":
        return list(normal[1])
    return [normal]


def negation(normal: Normal) -> Normal:
    if isinstance(normal, bool):
        return not normal
    tag, what = normal
    if tag in ("and", "or"):
        return join("or" if tag == "and" else "and", [negation(part) for part in what])
    if tag == ">":
        return ">=", -what
    if tag == ">=":
        return ">", -what
    return ("!=" if tag == "=" else "="), what
