"""Fixed points of a map, by elimination, and the multipliers there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import sympy
from numpy.typing import NDArray

from juggleproof.proofs.stability.given import Expr, Map, expression, holds, symbols, written
from juggleproof.proofs.stability.samples import Arrays, Floats, Point


@dataclass(frozen=True)
class FixedPoint:
    """A fixed point of one piece: where the parameters are such that it is in the space and the
    piece's guard holds there, it is one of the map.
    """

    point: Point
    piece: int
    terms: tuple[Expr, ...]  # the same in SymPy, with roots as such

    def exists(self, system: Map, parameters: Arrays) -> NDArray[np.bool_]:
        """For which parameters it is a fixed point of the map."""
        known = self.point.with_roots(parameters)
        states = dict(zip(system.state, self.point.at(parameters)))
        guard, _ = system.pieces[self.piece]
        with np.errstate(all="ignore"):
            inside = np.logical_and(
                holds(system.space, {**known, **states}), holds(guard, {**known, **states})
            )
        return np.broadcast_to(inside, states[system.state[0]].shape)

    def stable_share(self, system: Map, parameters: Arrays) -> float:
        """The share of the parameters for which it exists, with multipliers of size 1 at most."""
        exists = self.exists(system, parameters)
        return float(np.mean(exists & (self.multiplier(system, parameters) < 1 + 1e-9)))

    def is_at(self, terms: Sequence[str]) -> bool:
        """Whether these terms are the point."""
        given = map(expression, terms)
        return all(sympy.simplify(a - b) == 0 for a, b in zip(self.terms, given))

    def multiplier(self, system: Map, parameters: Arrays) -> Floats:
        """The largest modulus of an eigenvalue of the derivative of its piece there."""
        matrix = sympy.Matrix(system.images[self.piece]).jacobian(symbols(system.state))
        known = self.point.with_roots(parameters)
        states = dict(zip(system.state, self.point.at(parameters)))
        size = len(states[system.state[0]])
        entries = sympy.lambdify(symbols([*known, *states]), list(matrix), "numpy")
        with np.errstate(all="ignore"):
            values = entries(*known.values(), *states.values())
        stack = np.stack([np.broadcast_to(np.asarray(v, float), (size,)) for v in values])
        n = len(system.state)
        square = np.nan_to_num(stack.T.reshape(size, n, n), nan=np.inf, posinf=1e300)
        found: Floats = np.abs(np.linalg.eigvals(np.clip(square, -1e300, 1e300))).max(axis=1)
        return found


def fixed_points(system: Map) -> list[FixedPoint]:
    """The fixed points of all pieces that are written with rational operations and square roots."""
    return list(_found(system))


def _found(system: Map) -> Iterator[FixedPoint]:
    state = symbols(system.state)
    seen = set()
    for k, images in enumerate(system.images):
        equations = [sympy.numer(sympy.together(i - s)) for i, s in zip(images, state)]
        try:
            solutions = sympy.solve(equations, state, dict=True)
        except NotImplementedError:
            continue
        for solution in solutions:
            terms = tuple(sympy.simplify(solution.get(s, s)) for s in state)
            if any(t.free_symbols & set(state) for t in terms) or terms in seen:
                continue
            point = as_point(terms)
            if point is not None:
                seen.add(terms)
                yield FixedPoint(point, k, terms)


def as_point(terms: tuple[Expr, ...]) -> Point | None:
    """The terms as text, with square roots named; None where there are others."""
    roots: list[tuple[str, str]] = []
    names: dict[Expr, str] = {}
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
    try:
        return Point(tuple(written(sympy.factor(t)) for t in terms), tuple(roots))
    except Exception:  # what SymPy solves by other functions is no term
        return None


def _whole(base: Expr) -> set[Expr]:
    return {p for p in base.atoms(sympy.Pow) if p.exp.is_Integer}
