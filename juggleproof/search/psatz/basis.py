"""The last basis of a linear program, as floats see it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import highspy
import numpy as np

from juggleproof.search.psatz.linear_program import SOLVER
from juggleproof.statements.work import Budget


def last_basis(
    entries: Sequence[Mapping[int, int]], relations: Sequence[str], t: int, budget: Budget
) -> tuple[list[int], list[int]]:
    """Of rows >= 0 or = 0 and a last column t <= 1 that is maximised: the rows that hold with
    equality, and the basic columns, where HiGHS ends; none where it has no basis.
    """
    sizes = [max(map(abs, entry.values())) for entry in entries]
    by_column: list[list[tuple[int, float]]] = [[] for _ in range(t + 1)]
    for r, (entry, size) in enumerate(zip(entries, sizes)):
        for k, c in entry.items():
            by_column[k].append((r, c / size))
    model = highspy.HighsLp()
    infinity = highspy.kHighsInf
    model.num_col_, model.num_row_ = t + 1, len(entries)
    model.col_cost_ = np.array([0.0] * t + [-1.0])
    model.col_lower_ = np.full(t + 1, -infinity)
    model.col_upper_ = np.array([infinity] * t + [1.0])
    model.row_lower_ = np.zeros(len(entries))
    model.row_upper_ = np.array([0.0 if one == "=" else infinity for one in relations])
    model.a_matrix_.format_ = highspy.MatrixFormat.kColwise
    starts = np.cumsum([0, *map(len, by_column)])
    model.a_matrix_.start_ = starts.astype(np.int32)
    pairs = [pair for one in by_column for pair in one]
    model.a_matrix_.index_ = np.array([r for r, _ in pairs], dtype=np.int32)
    model.a_matrix_.value_ = np.array([c for _, c in pairs], dtype=np.float64)
    solver = SOLVER.highs
    solver.passModel(model)
    solver.run()
    budget.charge(int(solver.getInfo().simplex_iteration_count) * len(entries) // 50)
    basis, is_basic = solver.getBasis(), highspy.HighsBasisStatus.kBasic
    return (
        [r for r, status in enumerate(basis.row_status) if status != is_basic],
        [k for k, status in enumerate(basis.col_status) if status == is_basic],
    )
