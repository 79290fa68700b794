"""Samples of parameters and states in floats, and orbits of them: hints for the searches, which
nothing that is proved rests on.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache

import numpy as np
import sympy
from numpy.typing import NDArray

from juggleproof.certificates import checker
from juggleproof.map_stability import limits
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.terms import (
    Expr,
    atoms,
    column,
    conjuncts,
    expression,
    holds,
    symbols,
    value,
    written,
)
from juggleproof.statements.cases import checker_text, conjunction
from juggleproof.statements.definitions import formula_of
from juggleproof.statements.language import bounds_of

Floats = NDArray[np.float64]
Arrays = dict[str, Floats]
Bools = NDArray[np.bool_]

SEED = 1995  # of all samples, so that every run searches in one way


def ends_of(formula: str, name: str) -> tuple[float | None, float | None]:
    """The interval that a formula's conditions on one variable make, as floats."""
    try:
        found = bounds_of(formula, name)
    except checker.Rejected:  # it divides
        found = None
    low, high = found or (None, None)
    return (
        float(Fraction(low[0])) if low else None,
        float(Fraction(high[0])) if high else None,
    )


def drawn(rng: np.random.Generator, low: float | None, high: float | None, count: int) -> Floats:
    """Numbers between the ends, dense towards them; over several powers of ten where an end is
    missing.
    """
    share = rng.random(count)
    side = rng.integers(0, 3, count)
    if low is not None and high is not None:
        part = np.where(side == 0, share, np.where(side == 1, share**4, 1 - share**4))
        return np.asarray(low + (high - low) * part)
    size = 10 ** (limits.SPREAD * (2 * share - 1))
    if low is not None:
        return np.asarray(low + size)
    if high is not None:
        return np.asarray(high - size)
    return np.asarray(np.where(side % 2 == 0, size, -size))


def region(formula: str, names: Sequence[str], count: int, given: Arrays | None = None) -> Arrays:
    """Return points in a region: for each name an array of `count` floats, or of fewer if few are
    found.  `given` has points in other names; each point of the region takes the values of one.
    """
    rng = np.random.default_rng(SEED)
    formula, fixed = without_equations(formula, names)
    ends = {name: ends_of(formula, name) for name in names}
    kept: list[Arrays] = []
    total = 0
    for _ in range(limits.DRAWS):
        point = {name: drawn(rng, *ends[name], count) for name in names}
        if given:
            chosen = rng.integers(0, len(next(iter(given.values()))), count)
            point |= {name: values[chosen] for name, values in given.items()}
        size = count
        for name, gap in fixed.items():
            which, zeros = real_zeros(gap, name, point, count)
            point = {one: values[which] for one, values in point.items()} | {name: zeros}
            size = len(zeros)
        with np.errstate(all="ignore"):
            inside = np.broadcast_to(holds(formula, point), (size,))
        kept.append({name: values[inside] for name, values in point.items()})
        total += int(inside.sum())
        if total >= count:
            break
    names_kept = kept[0].keys()
    return {name: np.concatenate([part[name] for part in kept])[:count] for name in names_kept}


def without_equations(formula: str, names: Sequence[str]) -> tuple[str, dict[str, Expr]]:
    """Return the formula without an equation of polynomials, and the variable with the lowest
    degree in it, with the polynomial that is 0.  A formula without such an equation stays as it is.
    """
    parts = conjuncts(formula)
    for part in parts:
        node = checker.parse(part)
        if not isinstance(node, ast.Compare) or not isinstance(node.ops[0], ast.Eq) or node.ops[1:]:
            continue
        sides = [expression(checker_text(side)) for side in (node.left, *node.comparators)]
        gap = sympy.expand(sympy.numer(sympy.together(sides[0] - sides[1])))
        found = [one for one in symbols(names) if one in gap.free_symbols]
        if found and gap.is_polynomial(*found):
            name = min(found, key=lambda one: sympy.degree(gap, one))
            return conjunction(*(p for p in parts if p != part)), {str(name): gap}
    return formula, {}


def real_zeros(gap: Expr, name: str, point: Arrays, count: int) -> tuple[NDArray[np.int64], Floats]:
    """Return the real zeros of a polynomial in one variable at each of the points, and the number
    of the point of each zero.
    """
    poly = sympy.Poly(gap, *symbols([name]))
    with np.errstate(all="ignore"):
        columns = [column(written(c), point, count) for c in poly.all_coeffs()]
        if poly.degree() == 1:
            return np.arange(count), -columns[1] / columns[0]
    which, found = [], []
    for k, row in enumerate(np.stack(columns, axis=1)):
        zeros = np.roots(row) if np.isfinite(row).all() else np.zeros(0)
        real = zeros.real[np.abs(zeros.imag) <= limits.ROUNDING * np.abs(zeros)]
        which += [k] * len(real)
        found += list(real)
    return np.array(which, dtype=np.int64), np.array(found)


# -------------------------------------------------------------------------------------------------
# What is divided by: the checker takes a division where a fact says that its divisor is not 0.


def with_licences(system: Map) -> Map:
    """The map whose images are quotients of polynomials, and whose domain and guards say of each
    divisor that it is > 0.
    """
    domain, pieces = system.domain, []
    for guard, images in system.pieces:
        terms = []
        known = conjunction(domain, system.space)
        every = {one: licence(one, known) for one in divisors_of(guard, system.state)}
        needed = {divisor: fact for divisor, fact in every.items() if fact}
        if needed:
            guard = conjunction(*needed.values(), multiplied_out(guard, needed))
        for image in images:
            above, below = sympy.fraction(sympy.together(expression(image)))
            _, divisors = sympy.factor_list(below)
            if len(divisors) > 1:  # each divisor is licensed by itself
                below = sympy.factor(below)
            terms.append(written(sympy.factor(above) / below) if divides(image) else image)
            for divisor, _ in divisors:
                if divisor.free_symbols & set(symbols(system.state)):
                    facts = conjunction(domain, system.space, guard)
                    guard = conjunction(guard, licence(divisor, facts))
                else:
                    domain = conjunction(domain, licence(divisor, domain))
        pieces.append((guard, tuple(terms)))
    return replace(system, domain=domain, pieces=tuple(pieces))


def divisors_of(formula: str, state: Sequence[str]) -> list[Expr]:
    """The factors with a variable of the state of all that a formula divides by."""
    found = []
    for node in ast.walk(checker.parse(formula)):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
            below = sympy.numer(sympy.together(expression(checker_text(node.right))))
            found += [one for one, _ in sympy.factor_list(below)[1]]
    return [one for one in dict.fromkeys(found) if one.free_symbols & set(symbols(state))]


def multiplied_out(formula: str, facts: Mapping[Expr, str]) -> str:
    """Return the formula with each comparison multiplied by its divisors.  The fact of a divisor
    says that it is > 0 or < 0; a divisor whose fact says that it is not 0 is squared.

    >>> x = sympy.Symbol("x", real=True)
    >>> multiplied_out("not 4*x/(1 + x) <= 2", {x + 1: "x + 1 > 0"})
    'not 2*x - 2 <= 0'
    >>> multiplied_out("1/x > 1", {x: "x != 0"})
    'x*(1 - x) > 0'
    """

    class Put(ast.NodeTransformer):
        def visit_Compare(self, node: ast.Compare) -> ast.AST:
            sides = [expression(checker_text(side)) for side in (node.left, *node.comparators)]
            parts: list[ast.expr] = []
            for op, left, right in zip(node.ops, sides, sides[1:]):
                term = sympy.together(left - right)
                for divisor, power in sympy.factor_list(sympy.denom(term))[1]:
                    positive, strict, _ = facts.get(divisor, "").rpartition(" > ")
                    if strict:
                        term *= expression(positive) ** power
                    elif divisor in facts:
                        term *= divisor ** (power + power % 2)
                above = checker.parse(written(sympy.cancel(term)))
                parts.append(ast.Compare(above, [op], [ast.Constant(0)]))
            return parts[0] if len(parts) == 1 else ast.BoolOp(ast.And(), parts)

    return str(formula_of(Put().visit(checker.parse(formula))))


def divides(term: str) -> bool:
    """Return whether the term divides by more than numbers."""
    return any(
        isinstance(node, ast.BinOp)
        and isinstance(node.op, ast.Div)
        and checker.names_in(checker_text(node.right))
        for node in ast.walk(checker.parse(term))
    )


@lru_cache(1024)
def licence(divisor: Expr, facts: str) -> str:
    """Return the fact that the divisor is > 0, < 0 or not 0, as samples have it; an empty text if a
    fact says so already.
    """
    for fact, strict in atoms(facts):
        ratio = sympy.cancel(fact / divisor)
        if strict and ratio.is_Rational and ratio != 0:
            return ""
    names = sorted(checker.names_in(facts) | {str(symbol) for symbol in divisor.free_symbols})
    at = value(written(divisor), region(facts, names, limits.STATES_MANY))
    if (at > 0).all():
        return f"{written(divisor)} > 0"
    return f"{written(-divisor)} > 0" if (at < 0).all() else f"{written(divisor)} != 0"


def _count(parameters: Mapping[str, Floats]) -> int:
    """Return the number of samples of the parameters: 1 if there are no parameters."""
    return len(next(iter(parameters.values()))) if parameters else 1


@dataclass(frozen=True)
class SamplePoint:
    """A point that moves with the parameters: terms as text, with the roots in them."""

    terms: tuple[str, ...]
    roots: tuple[tuple[str, str], ...] = ()  # (name, what is under the root)

    def at(self, parameters: Mapping[str, Floats]) -> list[Floats]:
        """The point for arrays of parameters."""
        known: Arrays = self.with_roots(parameters)
        size = _count(parameters)
        return [column(t, known, size) for t in self.terms]

    def with_roots(self, parameters: Mapping[str, Floats]) -> Arrays:
        """The parameters with the values of the roots."""
        known: Arrays = dict(parameters)
        for name, under in self.roots:
            with np.errstate(all="ignore"):
                root = np.sqrt(np.asarray(value(under, known), float))
            known[name] = np.broadcast_to(root, (_count(parameters),))
        return known


def with_point_licences(domain: str, point: SamplePoint) -> str:
    """The domain, with the facts that license the divisors of the point's terms."""
    for text in (*point.terms, *(under for _, under in point.roots)):
        _, below = sympy.fraction(sympy.together(expression(text)))
        for divisor, _ in sympy.factor_list(below)[1]:
            domain = conjunction(domain, licence(divisor, domain))
    return domain


@dataclass(frozen=True)
class Samples:
    """States with parameters, roots, the point (NAME_point) and the distances to it (NAME_gap), as
    an array of floats for each name.  `which`: the number of each state's sample of the parameters.
    """

    points: Arrays
    which: NDArray[np.int64]

    def least(self, values: Floats, count: int) -> Floats:
        """The least of the values at each of the parameters, (count,); infinite where there is
        none.
        """
        found = np.full(count, np.inf)
        np.minimum.at(found, self.which, values)
        return found

    def where(self, mask: NDArray[np.bool_]) -> Samples:
        """The samples at which the mask is true."""
        return Samples({name: v[mask] for name, v in self.points.items()}, self.which[mask])


def around(
    system: Map, point: SamplePoint, parameters: Arrays, count: int, within: str = ""
) -> Samples:
    """Return some `count` states of the space for each of the parameters.  Half of them are at
    distances of many sizes from the point, half in the whole space, or in the set `within`.
    """
    rng = np.random.default_rng(SEED + 1)
    space = within or system.space
    size = _count(parameters)
    which = np.repeat(np.arange(size), count)
    known = point.with_roots(parameters)
    picked = {name: values[which] for name, values in known.items()}
    middle = [np.broadcast_to(e, (size,))[which] for e in point.at(parameters)]
    direction = rng.uniform(-1, 1, (len(system.state), len(which)))
    direction /= np.abs(direction).max(axis=0)
    reach = 10 ** rng.uniform(-3, limits.SPREAD - 0.5, len(which))
    ends = {name: ends_of(space, name) for name in system.state}
    everywhere = rng.random(len(which)) < 0.5
    states: Arrays = dict(picked)
    for k, name in enumerate(system.state):
        close = middle[k] + reach * direction[k]
        far = drawn(rng, *ends[name], len(which))
        states[name] = np.where(everywhere, far, close)
        states[name + "_point"] = middle[k]
        states[name + "_gap"] = states[name] - middle[k]
    with np.errstate(all="ignore"):
        inside = np.broadcast_to(holds(space, states), (len(which),))
    return Samples(states, which).where(inside)


def after(system: Map, points: Arrays) -> Arrays:
    """The next states, with their distances to the point."""
    found = dict(points)
    for name, values in zip(system.state, system.next({n: points[n] for n in system.names})):
        found[name] = values
        found[name + "_gap"] = values - points[name + "_point"]
    return found


def orbit_ends(system: Map, points: Arrays, steps: int) -> Arrays:
    """Return the states after this many steps."""
    now = dict(points)
    with np.errstate(all="ignore"):
        for _ in range(steps):
            now = after(system, now)
    return now


def strays(system: Map, states: Arrays, least: float) -> Bools:
    """Return whether the distance of each state to the point, relative to 1 + the point's size,
    is more than this; also where the orbit has left all pieces.
    """
    gaps = [np.abs(states[n + "_gap"]) / (1 + np.abs(states[n + "_point"])) for n in system.state]
    worst: Floats = np.max(gaps, axis=0)
    return np.logical_not(worst <= least)


def at_samples(matrix: Expr, known: Arrays, count: int) -> Floats:
    """Return the values of a square matrix at `count` samples of its names, (count, n, n)."""
    numbers = sympy.lambdify(symbols(known), list(matrix), "numpy")(*known.values())
    stack = [np.broadcast_to(np.asarray(one, float), (count,)) for one in numbers]
    return np.stack(stack, axis=1).reshape(count, *matrix.shape)


def matrices_of(system: Map, parameters: Arrays, count: int) -> Floats:
    """The matrices of all pieces at all parameters, (pieces times parameters, n, n)."""
    return np.concatenate([at_samples(one, parameters, count) for one in system.derivatives])
