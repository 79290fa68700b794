"""Positive combinations of polynomials that vanish identically: floating HiGHS for the support,
exact rationals on it.  By Farkas' lemma, linear inequalities without a solution have one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import lcm
from operator import add, ge
from threading import local

import highspy
import numpy as np
from flint import fmpz_mat
from numpy.typing import NDArray

from juggleproof.certificates.algebra.polynomials import Keys
from juggleproof.certificates.work import Budget

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
EXACT = float(1 << 53)
MOST_ENTRIES = 6_000_000
MOST_ITERATIONS = 5000
TINY = 1e-9


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


def solve(program: Program, budget: Budget, iterations: int = MOST_ITERATIONS) -> Solution | None:
    """The positive coefficients of the columns used and the coefficients of the free ones used,
    exactly; None where none were found.

    Raises Exhausted where the budget ends.

    >>> from juggleproof.certificates.algebra.polynomials import Packing, Ring
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
    work = matrix[:, alive]
    work = work[work.any(axis=1)]
    size = np.abs(work).max(axis=0, initial=0.0)
    size[size == 0] = 1.0
    inequality, strict, costs = alive < count, strict[alive], costs[alive]
    budget.spend(100 + work.size // 8)
    for jitter in JITTER:
        vertex = optimum(
            work / size,
            inequality,
            strict,
            costs * (1 + jitter * NOISE[: len(costs)]),
            iterations,
        )
        if vertex is None:
            return None
        values, basic = vertex
        for support in (np.flatnonzero(np.abs(values) > TINY), basic):
            found = exact(
                work[:, support],
                inequality[support],
                strict[support],
                values[support] / size[support],
                budget,
            )
            if found is not None:
                chosen = [(int(alive[k]), c) for k, c in zip(support, found) if c]
                return {k: c for k, c in chosen if k < count}, {
                    k - count: c for k, c in chosen if k >= count
                }
    return None


JITTER = (0.0, 0.7)
DEEPEST = 60  # equations used one after another on one monomial
MOST_COLUMNS = 20_000
NOISE = np.random.default_rng(7).random(MOST_COLUMNS)


def assemble(program: Program, budget: Budget) -> Floats | None:
    """The coefficients as a matrix, one row for each monomial that the equations leave; None if it
    is too large.
    """
    columns, values = program.columns, np.concatenate(program.values)
    keys, inverse = np.unique(np.concatenate(program.keys), return_inverse=True)
    budget.spend(20 + len(values) // 4)
    if len(keys) * columns > MOST_ENTRIES or columns > MOST_COLUMNS:
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
        if len(keys) * columns > MOST_ENTRIES:
            return None
    matrix = np.bincount(inverse * columns + places, values, len(keys) * columns)
    return matrix.astype(np.float64, copy=False).reshape(len(keys), columns)


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
                if tail and depth == DEEPEST:
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


def presolve(matrix: Floats, count: int, strict: Mask, budget: Budget) -> NDArray[np.intp] | None:
    """The columns that may be positive: where all of a row has one sign, its columns are zero.
    None if no strict one is left. Raises Exhausted where the budget ends.

    Shapes, for n columns of which the first `count` are not free: `matrix` (rows, n), `strict`
    (count,).
    """
    signs = np.sign(matrix)
    used = np.abs(signs)
    fixed = used[:, count:].any(axis=1)
    alive = np.ones(matrix.shape[1])
    while True:
        budget.spend(matrix.size // 1000)
        reached = used @ alive
        rows = (reached > 0) & (np.abs(signs @ alive) == reached) & ~fixed
        if not rows.any():
            return np.flatnonzero(alive)
        alive[:count][(rows @ used)[:count] > 0] = 0.0
        if not alive[:count][strict].any():
            return None


def optimum(
    matrix: Floats, inequality: Mask, strict: Mask, costs: Floats, iterations: int
) -> tuple[Floats, Keys] | None:
    """A vertex of {matrix c = 0, sum of strict c = 1, c >= 0 where an inequality} of least cost, in
    floats, and its basic columns; None where HiGHS finds none.

    Shapes, for n columns: `matrix` (rows, n); `inequality`, `strict`, `costs` and the vertex (n,).
    """
    rows, columns = matrix.shape
    whole = np.vstack([matrix, strict.astype(float)])
    model = highspy.HighsLp()
    model.num_col_, model.num_row_ = columns, rows + 1
    model.col_cost_ = costs
    model.col_lower_ = np.where(inequality, 0.0, -highspy.kHighsInf)
    model.col_upper_ = np.full(columns, highspy.kHighsInf)
    right = np.zeros(rows + 1)
    right[rows] = 1.0
    model.row_lower_ = model.row_upper_ = right
    turned = whole.T
    at_column, at_row = np.nonzero(turned)
    model.a_matrix_.format_ = highspy.MatrixFormat.kColwise
    model.a_matrix_.start_ = np.searchsorted(at_column, np.arange(columns + 1)).astype(np.int32)
    model.a_matrix_.index_ = at_row.astype(np.int32)
    model.a_matrix_.value_ = turned[at_column, at_row]
    solver = SOLVER.highs
    solver.setOptionValue("simplex_iteration_limit", iterations)
    solver.passModel(model)
    solver.run()
    solver.setOptionValue("simplex_iteration_limit", MOST_ITERATIONS)
    if solver.getModelStatus() != highspy.HighsModelStatus.kOptimal:
        return None
    status = solver.getBasis().col_status
    basic = [k for k, s in enumerate(status) if s == highspy.HighsBasisStatus.kBasic]
    return np.array(solver.getSolution().col_value), np.array(basic, dtype=np.int64)


# iterations, not seconds, bound a run; one thread and a fixed seed make it the same every time
OPTIONS = (
    ("output_flag", False),
    ("presolve", "off"),
    ("threads", 1),
    ("random_seed", 1),
    ("solver", "simplex"),
    ("simplex_iteration_limit", MOST_ITERATIONS),
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
