"""Facts made simpler before boxes are cut: equations solved for a variable, factors of known sign
divided out, contradictions seen.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from certificates.routes.bounding import Bounds, intervals
from certificates.routes.polynomials import Atom, Exponents, Polynomial, atom
from certificates.routes.spans import Interval, upper_end, zero_end


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
