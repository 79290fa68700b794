"""Positive combinations of polynomials that vanish identically: floating HiGHS for the support,
exact rationals on it.  By Farkas' lemma, linear inequalities without a solution have one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import lcm
from operator import add, ge
from threading import local

import highspy
import numpy as np
from flint import fmpz_mat
from numpy.typing import NDArray

from juggleproof.algebra.polynomials import Keys
from juggleproof.search import limits
from juggleproof.statements.work import Budget

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
EXACT = float(1 << 53)


def _no_exponents(keys: Keys) -> Keys:
    raise ValueError("monomials are not rewritten without their exponents")


class Program:
    """Find c >= 0 for the columns and any m for the free ones with sum c * column + sum m * free =
    0, and a strict c > 0.
    """

    def __init__(self) -> None:
        # of every block of columns an array each: the columns, monomials and values of its entries
        self.places: list[Keys] = []
        self.keys: list[Keys] = []
        self.values: list[Floats] = []
        self.strict: list[Mask] = []  # an array for every block
        self.costs: list[Floats] = []
        self.rewritings: list[tuple[Keys, Keys, Floats]] = []
        self.exponents: Callable[[Keys], Keys] = _no_exponents
        self.count = 0  # of the columns that are not free; they come first
        self.columns = 0

    def add(self, places: Keys, keys: Keys, values: Floats, strict: Mask, costs: Floats) -> None:
        """n columns that may be used with positive coefficients, with N entries in all.

        Shapes: `places` (the entry's column, counted from the first of these), `keys` (its
        monomial) and `values` (N,); `strict` and `costs` (n,).
        """
        self._entries(places, keys, values)
        self.strict.append(strict)
        self.costs.append(costs)
        self.count += len(strict)
        self.columns += len(strict)

    def add_free(self, count: int, keys: Keys, values: Floats) -> None:
        """`count` columns that may be used with any coefficients, with the same number of entries,
        one column's after another's in `keys` and `values` (N,); these come last.
        """
        self._entries(np.repeat(np.arange(count), len(keys) // max(1, count)), keys, values)
        self.columns += count

    def _entries(self, places: Keys, keys: Keys, values: Floats) -> None:
        self.places.append(places + self.columns)
        self.keys.append(keys)
        self.values.append(values)

    def add_rewriting(self, leading: Keys, keys: Keys, values: Floats) -> None:
        """An equation, its leading monomial first: columns are compared after its multiples are
        taken off.

        Shapes, for v variables and n terms: `leading` (v,), exponents; `keys` and `values` (n,).
        """
        self.rewritings.append((leading, keys, values))


Solution = tuple[dict[int, Fraction], dict[int, Fraction]]


def solve(
    program: Program, budget: Budget, iterations: int = limits.MOST_ITERATIONS
) -> Solution | None:
    """The positive coefficients of the columns used and the coefficients of the free ones used,
    exactly; None where none were found.

    Raises Exhausted where the budget ends.

    >>> from juggleproof.algebra.polynomials import Packing, Ring
    >>> ring = Ring(("x",))
    >>> x, = ring.gens
    >>> packing = Packing(ring, [x])
    >>> program = Program()
    >>> for p, strict in ((x - 2, False), (1 - x, False), (ring.one, True)):
    ...     keys, values = packing.row(p)
    ...     program.add(0 * keys, keys, values, np.array([strict]), np.ones(1))
    >>> solve(program, Budget(1000))
    ({0: Fraction(1, 1), 1: Fraction(1, 1), 2: Fraction(1, 1)}, {})
    """
    count, columns = program.count, program.columns
    matrix = assemble(program, budget)
    if matrix is None:
        return None
    strict = np.zeros(columns, dtype=bool)
    strict[:count] = np.concatenate(program.strict) if count else ()
    costs = np.zeros(columns)
    costs[:count] = np.concatenate(program.costs) if count else ()
    alive = presolve(matrix, count, strict[:count], budget)
    if alive is None:
        return None
    work = matrix.of_columns(alive)
    size = work.sizes()
    inequality, strict, costs = alive < count, strict[alive], costs[alive]
    budget.spend(100 + work.rows * work.columns // 8)
    for jitter in limits.JITTER:
        values = optimum(
            replace(work, values=work.values / size[work.at_column]),
            inequality,
            strict,
            costs * (1 + jitter * NOISE[: len(costs)]),
            iterations,
        )
        if values is None:
            return None
        for chosen in supports(values):
            found = exact(
                work.of_columns(chosen).dense(),
                inequality[chosen],
                strict[chosen],
                values[chosen] / size[chosen],
                budget,
            )
            if found is not None:
                used = [(int(alive[k]), c) for k, c in zip(chosen, found) if c]
                return {k: c for k, c in used if k < count}, {
                    k - count: c for k, c in used if k >= count
                }
    return None


@dataclass(frozen=True)
class SparseMatrix:
    """A matrix by its entries that are not 0, one column's after another's, and those by rows.

    Shapes, for N entries: `at_row`, `at_column` and `values` (N,).
    """

    rows: int
    columns: int
    at_row: Keys
    at_column: Keys
    values: Floats

    @staticmethod
    def of(turned: Floats) -> SparseMatrix:
        """The transpose of an array.

        >>> SparseMatrix.of(np.array([[0.0, 2.0], [0.0, 0.0], [1.0, 0.0]])).dense().tolist()
        [[0.0, 0.0, 1.0], [2.0, 0.0, 0.0]]
        """
        columns, rows = turned.shape
        places = np.flatnonzero(turned != 0)
        at_column, at_row = np.divmod(places, rows or 1)
        return SparseMatrix(rows, columns, at_row, at_column, turned.ravel()[places])

    def of_columns(self, chosen: Keys) -> SparseMatrix:
        """Some of the columns, given in ascending order, without the rows that are 0 in them."""
        place = np.full(self.columns, -1)
        place[chosen] = np.arange(len(chosen))
        kept = place[self.at_column] >= 0
        rows, at_row = np.unique(self.at_row[kept], return_inverse=True)
        return SparseMatrix(
            len(rows), len(chosen), at_row, place[self.at_column[kept]], self.values[kept]
        )

    def sizes(self) -> Floats:
        """The largest absolute value of each column; 1 where it is 0."""
        largest = np.zeros(self.columns)
        np.maximum.at(largest, self.at_column, np.abs(self.values))
        largest[largest == 0] = 1.0
        return largest

    def dense(self) -> Floats:
        """The matrix as an array."""
        array = np.zeros((self.rows, self.columns))
        array[self.at_row, self.at_column] = self.values
        return array


NOISE = np.random.default_rng(7).random(limits.MOST_COLUMNS)


def assemble(program: Program, budget: Budget) -> SparseMatrix | None:
    """The coefficients as a matrix, one row for each monomial that the equations leave; None if it
    is too large.
    """
    columns, values = program.columns, np.concatenate(program.values)
    keys, inverse = np.unique(np.concatenate(program.keys), return_inverse=True)
    budget.spend(20 + len(values) // 4)
    if len(keys) * columns > limits.MOST_ENTRIES or columns > limits.MOST_COLUMNS:
        return None
    budget.spend(len(keys) * columns // 50)
    places = np.concatenate(program.places)
    if program.rewritings:
        try:
            forms = normal_forms(keys, program, budget)
        except RecursionError:
            return None
        lengths = np.array([len(form) for form in forms])
        starts, whole = np.cumsum(lengths) - lengths, lengths[inverse]
        budget.spend(20 + int(whole.sum()) // 4)
        entry = np.repeat(np.arange(len(values)), whole)
        part = starts[inverse[entry]] + counted(whole)
        keys, inverse = np.unique([key for form in forms for key in form], return_inverse=True)
        try:
            coefficients = np.array([c for form in forms for c in form.values()], dtype=np.float64)
        except OverflowError:  # beyond 10^308
            return None
        values, places = values[entry] * coefficients[part], places[entry]
        inverse = inverse[part]
        if len(keys) * columns > limits.MOST_ENTRIES:
            return None
    turned = np.bincount(places * len(keys) + inverse, values, columns * len(keys))
    return SparseMatrix.of(turned.astype(np.float64, copy=False).reshape(columns, len(keys)))


def counted(counts: Keys) -> Keys:
    """0, 1, .., c - 1 for every count c in turn.

    >>> counted(np.array([2, 0, 3])).tolist()
    [0, 1, 0, 1, 2]
    """
    return np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)


Form = dict[int, int]  # the key of a monomial -> its coefficient


def normal_forms(keys: Keys, program: Program, budget: Budget) -> list[Form]:
    """The monomials modulo the equations, all times one positive number.

    Raises RecursionError where too many equations are used one after another, and Exhausted where
    the budget ends.
    """
    rules = []
    for leading, own, values in program.rewritings:
        exponents = program.exponents(own)
        sign = 1 if values[0] > 0 else -1
        tail = zip(
            (own - own[0]).tolist()[1:],
            (exponents - exponents[0]).tolist()[1:],
            [-sign * int(c) for c in values[1:]],
        )
        rules.append((leading.tolist(), sign * int(values[0]), list(tail)))
    done: dict[int, tuple[int, Form]] = {}

    def reduce(key: int, exponents: list[int], depth: int) -> None:
        """Puts a positive number, and the monomial times it, into `done`."""
        done[key] = 1, {key: 1}
        for leading, lead, tail in rules:
            if all(map(ge, exponents, leading)):
                if tail and depth == limits.MOST_EQUATIONS_ON_A_MONOMIAL:
                    raise RecursionError
                parts = []
                for move, moves, c in tail:
                    other = key + move
                    if other not in done:
                        reduce(other, list(map(add, exponents, moves)), depth + 1)
                    parts.append((*done[other], c))
                scale = lcm(*(own for own, _, _ in parts))
                size = sum(len(form) for _, form, _ in parts)
                budget.spend(size * (1 + scale.bit_length() // 64) // 8)
                total: Form = {}
                for own, form, c in parts:
                    multiple = scale // own * c
                    for k, value in form.items():
                        total[k] = total.get(k, 0) + multiple * value
                done[key] = lead * scale, total
                break

    own_keys = keys.tolist()
    for key, exponents in zip(own_keys, program.exponents(keys).tolist()):
        if key not in done:
            reduce(key, exponents, 0)
    found = [done[key] for key in own_keys]
    common = lcm(*(scale for scale, _ in found))
    return [{k: common // scale * c for k, c in form.items()} for scale, form in found]


def presolve(matrix: SparseMatrix, count: int, strict: Mask, budget: Budget) -> Keys | None:
    """The columns that may be positive: where all of a row has one sign, its columns are zero.
    None if no strict one is left. Raises Exhausted where the budget ends.

    Shapes: `strict` (count,), for n columns; the first `count` are not free.
    """
    free = matrix.at_column >= count
    fixed = np.bincount(matrix.at_row[free], minlength=matrix.rows) > 0
    own = ~free & ~fixed[matrix.at_row]
    at_row, at_column, up = matrix.at_row[own], matrix.at_column[own], matrix.values[own] > 0
    alive = np.ones(matrix.columns, dtype=bool)
    while True:
        budget.spend(matrix.rows * matrix.columns // 1000)
        rising = np.bincount(at_row[up], minlength=matrix.rows) > 0
        falling = np.bincount(at_row[~up], minlength=matrix.rows) > 0
        one_sign = (rising != falling)[at_row]
        if not one_sign.any():
            return np.flatnonzero(alive)
        alive[at_column[one_sign]] = False
        if not alive[:count][strict].any():
            return None
        left = alive[at_column]
        at_row, at_column, up = at_row[left], at_column[left], up[left]


def optimum(
    matrix: SparseMatrix, inequality: Mask, strict: Mask, costs: Floats, iterations: int
) -> Floats | None:
    """A vertex of {matrix c = 0, sum of strict c = 1, c >= 0 where an inequality} of least cost, in
    floats; None where HiGHS finds none.

    Shapes, for n columns: `inequality`, `strict`, `costs` and the vertex (n,).
    """
    rows, columns = matrix.rows, matrix.columns
    starts = np.searchsorted(matrix.at_column, np.arange(columns + 1))
    last = starts[1:][strict]  # the sum of strict ones is the last row
    before: Keys = np.cumsum(strict) - strict
    model = highspy.HighsLp()
    model.num_col_, model.num_row_ = columns, rows + 1
    model.col_cost_ = costs
    model.col_lower_ = np.where(inequality, 0.0, -highspy.kHighsInf)
    model.col_upper_ = np.full(columns, highspy.kHighsInf)
    right = np.zeros(rows + 1)
    right[rows] = 1.0
    model.row_lower_ = model.row_upper_ = right
    model.a_matrix_.format_ = highspy.MatrixFormat.kColwise
    model.a_matrix_.start_ = (starts + np.append(before, strict.sum())).astype(np.int32)
    model.a_matrix_.index_ = np.insert(matrix.at_row, last, rows).astype(np.int32)
    model.a_matrix_.value_ = np.insert(matrix.values, last, 1.0)
    solver = SOLVER.highs
    solver.setOptionValue("simplex_iteration_limit", iterations)
    solver.passModel(model)
    solver.run()
    solver.setOptionValue("simplex_iteration_limit", limits.MOST_ITERATIONS)
    if solver.getModelStatus() != highspy.HighsModelStatus.kOptimal:
        return None
    return np.array(solver.getSolution().col_value)


def supports(values: Floats) -> Iterator[Keys]:
    """The columns that are used at the vertex that was found last, then its basic columns."""
    yield np.flatnonzero(np.abs(values) > limits.NONZERO)
    basic = highspy.HighsBasisStatus.kBasic
    statuses = SOLVER.highs.getBasis().col_status
    yield np.array([k for k, status in enumerate(statuses) if status == basic], dtype=np.int64)


# iterations, not seconds, bound a run; one thread and a fixed seed make it the same every time
OPTIONS = (
    ("output_flag", False),
    ("presolve", "off"),
    ("threads", 1),
    ("random_seed", 1),
    ("solver", "simplex"),
    ("simplex_iteration_limit", limits.MOST_ITERATIONS),
    ("primal_feasibility_tolerance", 1e-10),
)


class Solver(local):
    """One HiGHS for each thread, which is dear to make; a new model clears it of the last one."""

    def __init__(self, options: Sequence[tuple[str, object]]) -> None:
        self.highs = highspy.Highs()
        for option, value in options:
            self.highs.setOptionValue(option, value)


SOLVER = Solver(OPTIONS)


def exact(
    matrix: Floats, inequality: Mask, strict: Mask, floats: Floats, budget: Budget
) -> list[Fraction] | None:
    """Exact coefficients of the columns near the floating ones, or None where the columns allow
    none.

    Shapes, for n columns: `matrix` (rows, n), `inequality`, `strict` and `floats` (n,).
    """
    count = matrix.shape[1]
    kept = matrix[matrix.any(axis=1)]
    if not count or kept.size and np.abs(kept).max() >= EXACT or not strict.any():
        return None
    budget.spend(20 + kept.shape[0] * count * min(kept.shape[0], count) // 30)
    ints = np.hstack([kept, np.zeros((len(kept), 1))]).astype(np.int64).tolist()
    ints.append([*strict.astype(int).tolist(), 1])
    reduced, den, rank = fmpz_mat(ints).rref()
    den = int(den)
    table, pivots = reduced.tolist()[:rank], []
    for line in table:
        pivots.append(next(k for k, c in enumerate(line) if c))
    if pivots and pivots[-1] == count:
        return None
    values = [
        Fraction(float(v)).limit_denominator(64) if k not in pivots else Fraction(0)
        for k, v in enumerate(floats)
    ]
    values = [max(v, Fraction(0)) if inequality[k] else v for k, v in enumerate(values)]
    free = [k for k in range(count) if k not in pivots and values[k]]
    for pivot, line in zip(pivots, table):
        values[pivot] = (
            Fraction(int(line[count])) - sum(int(line[k]) * values[k] for k in free)
        ) / den
    if any(v < 0 for v, needed in zip(values, inequality) if needed) or not any(
        v for v, s in zip(values, strict) if s
    ):
        return None
    return values
