"""Fixed points of a map, by elimination, and the multipliers there."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import sympy
from numpy.typing import NDArray

from juggleproof.map_stability import limits
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.samples import (
    Arrays,
    Floats,
    SamplePoint,
    at_samples,
    region,
    without_equations,
)
from juggleproof.map_stability.terms import Expr, expression, holds, symbols, value, written


@dataclass(frozen=True)
class FixedPoint:
    """A fixed point of one piece.  It is a fixed point of the map at parameters at which it is in
    the space and the piece's guard holds.
    """

    point: SamplePoint
    piece: int
    terms: tuple[Expr, ...]  # the same in SymPy, with roots as such

    def exists(self, system: Map, parameters: Arrays) -> NDArray[np.bool_]:
        """Return for which parameters it is a fixed point of the map."""
        known = self.point.with_roots(parameters)
        states = dict(zip(system.state, self.point.at(parameters)))
        guard, images = system.pieces[self.piece]
        with np.errstate(all="ignore"):
            inside = np.logical_and(
                holds(system.space, {**known, **states}), holds(guard, {**known, **states})
            )
            for name, image in zip(system.state, images):
                gap = np.abs(np.asarray(value(image, {**known, **states}), float) - states[name])
                inside = inside & (gap <= limits.NEARLY_FIXED * (1 + np.abs(states[name])))
        return np.broadcast_to(inside, states[system.state[0]].shape)

    def stable_share(self, system: Map, parameters: Arrays) -> float:
        """The share of the parameters for which it exists, with multipliers of size 1 at most."""
        exists = self.exists(system, parameters)
        return float(np.mean(exists & (self.multiplier(system, parameters) < 1 + 1e-9)))

    def multiplier(self, system: Map, parameters: Arrays) -> Floats:
        """The largest modulus of an eigenvalue of the derivative of its piece there."""
        known = self.point.with_roots(parameters)
        states = dict(zip(system.state, self.point.at(parameters)))
        with np.errstate(all="ignore"):
            size = len(states[system.state[0]])
            values = at_samples(system.derivatives[self.piece], known | states, size)
        square = np.nan_to_num(values, nan=np.inf, posinf=1e300)
        found: Floats = np.abs(np.linalg.eigvals(np.clip(square, -1e300, 1e300))).max(axis=1)
        return found


def fixed_points(system: Map) -> list[FixedPoint]:
    """The fixed points of all pieces that are written with rational operations and square roots.
    If the map names its point, it is the only one.
    """
    return list(dict.fromkeys(_named(system) if system.point else _found(system)))


def _named(system: Map) -> Iterator[FixedPoint]:
    terms = tuple(map(expression, system.point))
    point, put = as_point(terms), dict(zip(symbols(system.state), terms))
    for k, images in enumerate(system.images):
        gaps = [i.subs(put, simultaneous=True) - t for i, t in zip(images, terms)]
        if point is not None and all(is_zero(gap, system) for gap in gaps):
            yield FixedPoint(point, k, terms)


def is_zero(term: Expr, system: Map) -> bool:
    """Return whether the term is 0 wherever the equation of the domain holds, if it has one."""
    _, fixed = without_equations(system.domain, system.parameters)
    above = sympy.numer(sympy.together(term))
    for name, gap in fixed.items():
        above = sympy.prem(above, gap, *symbols([name])) if above != 0 else above
    return bool(sympy.expand(above) == 0)


def _found(system: Map) -> Iterator[FixedPoint]:
    state = symbols(system.state)
    parameters = region(system.domain, system.parameters, limits.PARAMETERS)
    for k, images in enumerate(system.images):
        equations = [sympy.numer(sympy.together(i - s)) for i, s in zip(images, state)]
        for every in solutions(equations, state):
            points = ((as_point(terms), terms) for terms in every)
            found = (FixedPoint(point, k, terms) for point, terms in points if point is not None)
            there = (one for one in found if one.exists(system, parameters).any())
            yield from itertools.islice(there, 1)


def solutions(equations: Sequence[Expr], state: Sequence[Expr]) -> Iterator[list[tuple[Expr, ...]]]:
    """Yield lists of states that solve the equations: an isolated state is alone in its list; a
    continuum has a list of states whose free variables have rational values.
    """
    try:
        equations = [one for one in map(sympy.expand, equations) if one != 0]
        if any(one.free_symbols.isdisjoint(state) for one in equations):
            return  # which `solve` would leave out
        if len(state) == 1 and equations:
            yield from ([(root,)] for root in roots_of(equations[0], state[0]))
            return
        # samples tell which of them solve, faster than SymPy
        found = sympy.solve(equations, state, dict=True, check=False) if equations else [{}]
    except NotImplementedError:
        return
    for solution in found:
        terms = [sympy.simplify(solution.get(s, s)) for s in state]
        free = [s for s in state if any(s in t.free_symbols for t in terms)]
        values = itertools.product(map(sympy.Rational, limits.FREE_VALUES), repeat=len(free))
        yield [
            tuple(sympy.cancel(t.subs(dict(zip(free, chosen)))) if free else t for t in terms)
            for chosen in itertools.islice(values, limits.MOST_POINTS)
        ]


def roots_of(equation: Expr, variable: Expr) -> Iterator[Expr]:
    """The zeros of a polynomial's irreducible factors of degree 1 and 2."""
    for factor, _ in sympy.factor_list(equation)[1]:
        coefficients = sympy.Poly(factor, variable).all_coeffs()
        if len(coefficients) == 2:
            yield sympy.cancel(-coefficients[1] / coefficients[0])
        elif len(coefficients) == 3:
            a, b, c = coefficients
            number, factors = sympy.factor_list(b**2 - 4 * a * c)
            outer, inner = sympy.sqrt(abs(number)).as_coeff_Mul()
            outer *= sympy.prod(one ** (power // 2) for one, power in factors)
            under = sympy.sign(number) * inner**2 * sympy.prod(p for p, n in factors if n % 2)
            root = outer * sympy.sqrt(sympy.expand(under))
            yield from (sympy.together((-b + sign * root) / (2 * a)) for sign in (-1, 1))


def as_point(terms: tuple[Expr, ...]) -> SamplePoint | None:
    """Return the terms as text, with names for square roots; None if there are other roots."""
    roots: list[tuple[str, str]] = []
    names: dict[Expr, str] = {}
    terms = tuple(  # what is under a root is written in one way
        t.replace(
            lambda e: e.is_Pow and not e.exp.is_Integer, lambda e: sympy.expand(e.base) ** e.exp
        )
        for t in terms
    )
    for root in sorted(set().union(*(t.atoms(sympy.Pow) for t in terms)), key=str):
        if root.exp.is_Integer:
            continue
        if (2 * root.exp).is_Integer and not root.base.atoms(sympy.Pow) - _whole(root.base):
            name = names.setdefault(root.base, f"root_{len(names) + 1}")
        else:
            return None
        roots += [(name, written(root.base))] if name not in dict(roots) else []
    free = {base: sympy.Symbol(name, real=True) for base, name in names.items()}
    for base, symbol in free.items():
        terms = tuple(
            t.replace(
                lambda e, b=base: (
                    e.is_Pow and e.base == b and (2 * e.exp).is_Integer and not e.exp.is_Integer
                ),
                lambda e, s=symbol: s ** (2 * e.exp),
            )
            for t in terms
        )
    for base, symbol in free.items():
        terms = tuple(without_root_below(t, symbol, base) for t in terms)
    try:
        return SamplePoint(tuple(written(sympy.factor(t)) for t in terms), tuple(roots))
    except Exception:  # what SymPy solves by other functions is no term
        return None


def without_root_below(term: Expr, root: Expr, under: Expr) -> Expr:
    """The same term with a denominator without the root, whose square is `under`.  The domain has
    to say that a divisor is not 0, and it cannot name roots.
    """
    above, below = sympy.fraction(sympy.together(term))
    if root not in below.free_symbols:
        return term
    above, below = (sympy.rem(part, root**2 - under, root) for part in (above, below))
    conjugate = below.subs(root, -root)
    return sympy.cancel(
        sympy.rem(sympy.expand(above * conjugate), root**2 - under, root)
        / sympy.rem(sympy.expand(below * conjugate), root**2 - under, root)
    )


def _whole(base: Expr) -> set[Expr]:
    return {p for p in base.atoms(sympy.Pow) if p.exp.is_Integer}
