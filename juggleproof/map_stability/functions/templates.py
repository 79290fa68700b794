"""Candidates for Lyapunov functions: sums of terms with coefficients by linear programs on samples,
rounded to simple rationals.

Everything here is in floats and believed by nobody.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

import highspy
import numpy as np

from juggleproof.map_stability import limits
from juggleproof.map_stability.maps import Map, bounds
from juggleproof.map_stability.samples import Arrays, Floats, after
from juggleproof.map_stability.terms import as_factor, column, expression, holds, value, written
from juggleproof.search.psatz.linear_program import Solver


@dataclass(frozen=True)
class Function:
    """V: the greatest of the terms whose guard holds; without guards, the greatest of all."""

    terms: tuple[str, ...]
    guards: tuple[str, ...] = ()
    divisor: str = "1"

    def at(self, points: Arrays, count: int) -> Floats:
        """Return its values at `count` states."""
        parts = [column(t, points, count) for t in self.terms]
        if self.guards:
            inside = [np.broadcast_to(holds(g, points), (count,)) for g in self.guards]
            parts = [np.where(mask, v, -np.inf) for mask, v in zip(inside, parts)]
        found: Floats = np.max(parts, axis=0)
        return found

    def along(self, system: Map, points: Arrays, count: int) -> tuple[Floats, Floats]:
        """Return its values at `count` states, and at the next states."""
        with np.errstate(all="ignore"):
            return self.at(points, count), self.at(after(system, points), count)

    def lines(self) -> list[tuple[str, str]]:
        """The lines `value`."""
        guards = self.guards or ("",) * len(self.terms)
        return [("value", f"{g} -> {t}" if g else t) for g, t in zip(guards, self.terms)]


@dataclass(frozen=True)
class Template:
    """A function V = (sum of a_i b_i)/divisor with unknown a_i; `basis` has the b_i as text.  If V
    has a part for each piece, `parts` has the guards, and `bases` the b_i of each part.
    """

    basis: tuple[str, ...]
    divisor: str = "1"
    parts: tuple[str, ...] = ()  # guards
    bases: tuple[tuple[str, ...], ...] = ()

    def columns(self, point: Arrays) -> Floats:
        """The terms at each state, shape (states, unknowns)."""
        size = len(next(iter(point.values())))
        below = column(self.divisor, point, size)
        blocks = []
        guards = self.parts or ("0 < 1",)
        for guard, basis in zip(guards, self.bases or (self.basis,) * len(guards)):
            inside = np.broadcast_to(holds(guard, point), (size,))
            for b in basis:
                blocks.append(np.where(inside, column(b, point, size) / below, 0.0))
        return np.stack(blocks, axis=1)

    def every_term(self) -> list[str]:
        """The b_i of all parts."""
        return [b for basis in self.bases or (self.basis,) * max(1, len(self.parts)) for b in basis]

    def terms(self, numbers: Sequence[Fraction]) -> list[str]:
        """V as text, one term or one for each part."""
        texts = []
        start = 0
        for basis in self.bases or (self.basis,):
            parts = [
                f"{signed(c)}*{b}" if c != 1 else b
                for c, b in zip(numbers[start : start + len(basis)], basis)
                if c
            ]
            start += len(basis)
            total = " + ".join(parts) or "0"
            texts.append(total if self.divisor == "1" else f"({total})/({self.divisor})")
        return texts


@dataclass(frozen=True)
class SizesOfForms:
    """A sum with unknown weights of the terms |form| times factor, for all forms and factors;
    unless it is `even`, the positive and the negative part of each form have weights of their own.
    """

    forms: tuple[str, ...]
    factors: tuple[str, ...]
    even: bool

    def columns(self, point: Arrays) -> Floats:
        """The terms at each state, shape (states, unknowns)."""
        size = len(next(iter(point.values())))
        by = [np.asarray(value(factor, point), float) for factor in self.factors]
        found = []
        for form in self.forms:
            at = np.asarray(value(form, point), float)
            for side in (np.abs(at),) if self.even else (np.maximum(at, 0), np.maximum(-at, 0)):
                found += [np.broadcast_to(side * factor, (size,)) for factor in by]
        return np.stack(found, axis=1)

    def every_term(self) -> list[str]:
        """Return a text for each of the terms; none of them is a square."""
        return [""] * (len(self.forms) * len(self.factors) * (1 if self.even else 2))

    def function(self, numbers: Sequence[Fraction]) -> Function:
        """The sum, as the greatest of linear forms, one for each choice of signs.  They are equal
        if no weight is negative.  So written, premises have no cases.
        """
        size = len(self.factors)
        products = [
            expression(f"({c})*{f}") for c, f in zip(numbers, itertools.cycle(self.factors))
        ]
        weights = [sum(products[k : k + size]) for k in range(0, len(numbers), size)]
        if self.even:
            weights = [one for one in weights for _ in range(2)]
        terms = []
        for signs in itertools.product((0, 1), repeat=len(self.forms)):
            total = sum(
                (1 - 2 * sign) * weights[2 * k + sign] * expression(form)
                for k, (form, sign) in enumerate(zip(self.forms, signs))
            )
            terms.append(written(total))
        return Function(tuple(terms))


def squares_of(system: Map) -> list[str]:
    """The squares of the distances to the point."""
    return [f"{name}_gap^2" for name in system.state]


def signed(number: Fraction) -> str:
    return f"({number})" if number < 0 or number.denominator > 1 else str(number)


def products_of_gaps(system: Map) -> tuple[str, ...]:
    """The products of two distances to the point."""
    gaps = [name + "_gap" for name in system.state]
    pairs = itertools.combinations_with_replacement(gaps, 2)
    return tuple(f"{a}^2" if a == b else f"{a}*{b}" for a, b in pairs)


def quadratic_templates(system: Map, piece: int, positive: Sequence[str]) -> Iterator[Template]:
    """Yield quadratic forms in the distances to the point: with constant coefficients, divided by
    terms that are positive, with coefficients linear in the parameters, and with a part for each
    piece.  piece: the number of the piece that the point is in.
    """
    gaps = [name + "_gap" for name in system.state]
    squares = products_of_gaps(system)
    moving = tuple(f"{name}*{square}" for name in system.parameters for square in squares)
    yield Template(squares)
    for divisor in positive:
        yield Template(squares, divisor)
    if moving:
        yield Template((*squares, *moving))
    if len(system.pieces) > 1:
        guards = tuple(guard for guard, _ in system.pieces)
        whole = (*squares, *gaps, "1")
        bases = tuple(squares if k == piece else whole for k in range(len(guards)))
        yield Template(squares, "1", guards, (squares,) * len(guards))
        yield Template(squares, "1", guards, bases)
        if moving:
            more = (*whole, *(f"{name}*{one}" for name in system.parameters for one in whole))
            both = (*squares, *moving)
            bases = tuple(both if k == piece else more for k in range(len(guards)))
            yield Template(squares, "1", guards, bases)
    quartic = tuple("*".join(parts) for parts in itertools.combinations_with_replacement(gaps, 4))
    cubic = tuple("*".join(parts) for parts in itertools.combinations_with_replacement(gaps, 3))
    if len(gaps) <= 2:
        yield Template((*squares, *cubic, *quartic))
        if moving and len(gaps) == 1:
            more = tuple(f"{n}*{b}" for n in system.parameters for b in (*cubic, *quartic))
            yield Template((*squares, *cubic, *quartic, *moving, *more))


def sum_of_quotients(system: Map) -> Iterator[Template]:
    """Quadratic forms in the distances to the point, plus such forms over the distance of each
    state variable to its lower bound.
    """
    low, _ = bounds(system)
    if not 1 < len(low) <= 2:
        return
    under = [as_factor(text) for text in low.values()]
    below = "*".join(under)
    yield Template(
        tuple(f"{form}*{by}" for form in products_of_gaps(system) for by in (*under, below)),
        f"({below})",
    )


# -------------------------------------------------------------------------------------------------
# The linear program.


def margins(
    template: Template | SizesOfForms, system: Map, states: Arrays, scale: str = "1"
) -> tuple[Floats, Floats]:
    """The rows of the conditions V(s) - V(f(s)) > 0 and V(s) > 0, scaled to length 1, and the
    number of the state of each row.  Rows of the former are divided by the scale, which is small
    at states at which V can fall by little only.
    """
    with np.errstate(all="ignore"):
        here = template.columns(states)
        there = template.columns(after(system, states))
        rows = np.concatenate([here - there, here])
        length = np.linalg.norm(rows, axis=1)
        rows = rows / length[:, None]
        rows[: len(here)] /= column(scale, states, len(here))[:, None]
    fits = np.isfinite(rows).all(axis=1) & (length > 1e-30)
    return rows[fits], np.tile(np.arange(len(here)), 2)[fits]


def best_weights(rows: Floats, simple: bool = True) -> Floats | None:
    """Return weights between -1 and 1 with the greatest least margin; if `simple`, then the weights
    of least sum that keep a quarter of this margin.  None if no margin is positive.
    """
    count, unknowns = rows.shape
    found = program(
        np.hstack([rows, -np.ones((count, 1))]),
        np.zeros(count),
        np.array([-1.0] * unknowns + [-1.0]),
        np.array([1.0] * (unknowns + 1)),
        np.array([0.0] * unknowns + [-1.0]),
    )
    if found is None or found[-1] < limits.PROGRAM_TOLERANCE:
        return None
    if not simple:
        return found[:-1]
    sizes = np.block(
        [
            [rows, np.zeros_like(rows)],
            [np.eye(unknowns), np.eye(unknowns)],
            [-np.eye(unknowns), np.eye(unknowns)],
        ]
    )
    least = np.concatenate([np.full(count, found[-1] / 4), np.zeros(2 * unknowns)])
    sparse = program(
        sizes,
        least,
        np.array([-1.0] * unknowns + [0.0] * unknowns),
        np.ones(2 * unknowns),
        np.array([0.0] * unknowns + [1.0] * unknowns),
    )
    return found[:-1] if sparse is None else sparse[:unknowns]


SOLVER = Solver((("output_flag", False), ("threads", 1), ("random_seed", 1)))


def program(
    matrix: Floats, least: Floats, low: Floats, high: Floats, costs: Floats
) -> Floats | None:
    """The point x of least cost with matrix x >= least between the bounds.  Few of many rows
    decide: the program begins with a part of them, and the rows that its solution breaks are added.
    """
    rows = len(matrix)
    asked = np.zeros(rows, bool)
    asked[:: max(rows // limits.PROGRAM_ROWS, 1)] = True
    while True:
        found = _program(matrix[asked], least[asked], low, high, costs)
        if found is None:
            return None
        broken = np.flatnonzero(~asked & (matrix @ found < least - limits.PROGRAM_TOLERANCE))
        if not len(broken):
            return found
        by = (matrix[broken] @ found - least[broken]).argsort(kind="stable")
        asked[broken[by[: limits.PROGRAM_ROWS]]] = True


def _program(
    matrix: Floats, least: Floats, low: Floats, high: Floats, costs: Floats
) -> Floats | None:
    rows, columns = matrix.shape
    model = highspy.HighsLp()
    model.num_col_, model.num_row_ = columns, rows
    model.col_cost_, model.col_lower_, model.col_upper_ = costs, low, high
    model.row_lower_, model.row_upper_ = least, np.full(rows, highspy.kHighsInf)
    at_row, at_column = np.nonzero(matrix)
    model.a_matrix_.format_ = highspy.MatrixFormat.kRowwise
    model.a_matrix_.start_ = np.searchsorted(at_row, np.arange(rows + 1)).astype(np.int32)
    model.a_matrix_.index_ = at_column.astype(np.int32)
    model.a_matrix_.value_ = matrix[at_row, at_column]
    solver = SOLVER.highs
    solver.passModel(model)
    solver.run()
    if solver.getModelStatus() != highspy.HighsModelStatus.kOptimal:
        return None
    return np.array(solver.getSolution().col_value)


def rounded(weights: Floats, rows: Floats) -> Iterator[list[Fraction]]:
    """The weights as rationals, the simplest first, that keep every margin positive."""
    largest = np.abs(weights).max()
    seen = set()
    for denominator in limits.DENOMINATORS:
        numbers = [Fraction(round(w / largest * denominator), denominator) for w in weights]
        floats = np.array([float(n) for n in numbers])
        if tuple(numbers) not in seen and (rows @ floats > 0).all():
            seen.add(tuple(numbers))
            yield numbers


def lyapunov_functions(
    template: Template | SizesOfForms, system: Map, states: Arrays, tests: Arrays, scale: str = "1"
) -> Iterator[list[Fraction]]:
    """Coefficients of candidates for V that fall at all samples but the point; simplest first."""
    chosen, _ = margins(template, system, states, scale)
    every, _ = margins(template, system, tests, scale)
    if not len(chosen) or not len(every):
        return
    plain = np.array([float(b in squares_of(system)) for b in template.every_term()])
    if (every @ plain > 0).all() and (chosen @ plain > 0).all():
        yield [Fraction(int(one)) for one in plain]
        return
    for _ in range(limits.TURNS):
        weights = best_weights(chosen)
        if weights is None:
            return
        missed = every @ weights <= 0
        if not missed.any():
            break
        chosen = np.concatenate([chosen, every[missed][:200]])
    else:
        return
    yield from itertools.islice(rounded(weights, every), limits.TRIED)
