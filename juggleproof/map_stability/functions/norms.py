"""Polytope norms that every piece of a piecewise affine map contracts: max |l_i (s - e)| over rows
l_i, found by carrying rows back through the pieces (Brayton and Tong 1979), in floats, and rounded.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from fractions import Fraction

import highspy
import numpy as np

from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import CandidateProof
from juggleproof.map_stability.functions.candidates import Setting, derivatives
from juggleproof.map_stability.functions.templates import (
    Function,
    program,
    signed,
)
from juggleproof.map_stability.samples import SEED, Arrays, Floats, after, matrices_of
from juggleproof.map_stability.terms import holds


def corners(setting: Setting) -> Arrays:
    """The samples of the parameters that lie farthest out in some direction."""
    names = setting.system.parameters
    if not names:
        return {}
    values = np.stack([setting.parameters[name] for name in names])
    scaled = (values.T - values.mean(axis=1)) / (values.std(axis=1) + 1e-12)
    signs = np.array(list(itertools.product((-1.0, 0.3, 1.0), repeat=len(names))))[
        : 4 * limits.CORNERS
    ]
    chosen = sorted({int(np.argmax(scaled @ sign)) for sign in signs})[: limits.CORNERS]
    return {name: setting.parameters[name][chosen] for name in names}


def gauge(row: Floats, rows: Floats) -> float:
    """The least sum of |c_i| with sum c_i l_i = row; infinite where there is none."""
    count, n = rows.shape
    matrix = np.hstack([rows.T, -rows.T])
    found = program(
        np.vstack([matrix, -matrix]),
        np.concatenate([row, -row]) - 1e-12,
        np.zeros(2 * count),
        np.full(2 * count, highspy.kHighsInf),
        np.ones(2 * count),
    )
    return np.inf if found is None else float(found.sum())


def first_rows(matrix: Floats) -> Iterator[Floats]:
    """Rows to begin with: the coordinates, and those in which the matrix is block diagonal, pairs
    of complex eigenvalues turned through several angles.
    """
    n = len(matrix)
    yield np.eye(n)
    values, vectors = np.linalg.eig(matrix.T)
    for turns in (2, 3, 4):
        rows: list[Floats] = []
        for k, number in enumerate(values):
            vector = vectors[:, k]
            if abs(number.imag) < 1e-9:
                rows.append(vector.real)
            elif number.imag > 0:
                for j in range(turns):
                    rows.append((vector * np.exp(1j * np.pi * j / turns)).real)
        stacked = np.array([row / np.abs(row).max() for row in rows])
        if np.linalg.matrix_rank(stacked, 1e-6) == n:
            yield stacked


def invariant_rows(matrices: Floats, start: Floats, rate: float) -> Floats | None:
    """Rows with |l_i A| <= rate times the norm for all matrices; None if there are too many."""
    rows = start
    frontier = list(start)
    while frontier:
        row = frontier.pop(0)
        for matrix in matrices:
            image = row @ matrix / rate
            if np.abs(image).max() < 1e-9 or gauge(image, rows) <= 1 + 1e-9:
                continue
            rows = np.vstack([rows, image])
            frontier.append(image)
            if len(rows) > limits.MOST_ROWS:
                return None
    kept = list(range(len(rows)))
    for k in list(kept):
        rest = [j for j in kept if j != k]
        if len(rest) >= rows.shape[1] and gauge(rows[k], rows[rest]) <= 1 + 1e-9:
            kept = rest
    return rows[kept]


def rounded_rows(rows: Floats, matrices: Floats) -> Iterator[tuple[list[list[Fraction]], Fraction]]:
    """The rows as rationals, the simplest first, with a rate below 1 at the matrices."""
    scaled = rows / np.abs(rows).max()
    seen = set()
    for denominator in limits.ROW_DENOMINATORS:
        exact: list[list[Fraction]] = []
        for row in scaled:
            fractions = [Fraction(round(x * denominator), denominator) for x in row]
            if fractions not in exact and [-x for x in fractions] not in exact:
                exact.append(fractions)
        key = tuple(map(tuple, exact))
        floats = np.array([[float(x) for x in row] for row in exact])
        if key in seen or np.linalg.matrix_rank(floats) < rows.shape[1]:
            continue
        seen.add(key)
        worst = max(gauge(row @ matrix, floats) for row in floats for matrix in matrices)
        if worst < 1 - 1e-6:
            yield exact, _simple_above(worst)


def _simple_above(number: float) -> Fraction:
    """A simple fraction above the number and below 1."""
    denominator = 2
    while True:
        found = Fraction(int(number * denominator) + 1, denominator)
        if found < 1:
            return found
        denominator *= 2


def linear_form(row: Sequence[Fraction], names: Sequence[str]) -> str:
    """A linear form as text."""
    parts = [
        name if c == 1 else f"-{name}" if c == -1 else f"{signed(c)}*{name}"
        for c, name in zip(row, names)
        if c
    ]
    return " + ".join(parts).replace("+ -", "- ")


def norms(matrices: Floats) -> Iterator[tuple[list[list[Fraction]], Fraction]]:
    """Rows of norms that all these matrices contract, with a rate, the simplest first."""
    radius = max(float(np.abs(np.linalg.eigvals(matrix)).max()) for matrix in matrices)
    if radius >= 1:
        return
    for share in limits.RATE_SHARES:
        rate = max(radius + share * (1 - radius), 1e-3)
        for start in first_rows(matrices[0]):
            rows = invariant_rows(matrices, start, rate)
            if rows is not None:
                found = itertools.islice(rounded_rows(rows, matrices), 1)
                yield from (one for one in found if 1 - one[1] > limits.SLOWEST)


def norm_candidate(
    setting: Setting, rows: Sequence[Sequence[Fraction]], rate: Fraction, size: Fraction
) -> CandidateProof:
    """The candidate whose function is the norm of these rows: on the whole space, or where the norm
    is at most `size`, if that is not 0.
    """
    gaps = [f"{one}_gap" for one in setting.system.state]
    floats = np.array([[float(x) for x in row] for row in rows])
    # |gap_j| <= V times the gauge of the j-th coordinate
    most = max(gauge(unit, floats) for unit in np.eye(len(gaps)))
    least = Fraction(1, int(most * float(1 / (1 - rate))) + 1)
    upper = max(sum(abs(x) for x in row) for row in rows)
    forms = [linear_form(row, gaps) for row in rows]
    forms += [linear_form([-x for x in row], gaps) for row in rows]
    inside = " and ".join(f"{form} <= {size}" for form in forms) if size else ""
    ball = str(size / upper) if size else "1", str(upper)
    loss, far = f"({1 - rate})*value", f"({least})*distance"
    return setting.candidate(Function(tuple(forms)), loss, far, ball, inside)


def norm_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """The candidates whose function is a norm that all pieces contract."""
    far = corners(setting)
    count = len(next(iter(far.values()))) if far else 1
    found = norms(matrices_of(setting.system, far, count))
    for rows, rate in itertools.islice(found, limits.TRIED_OF_FAMILY):
        yield norm_candidate(setting, rows, rate, Fraction(0))


# -------------------------------------------------------------------------------------------------
# Near the point only: a norm that the derivative there contracts, and a set on which the map does.


def local_norm_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """The candidates whose function is a norm, on the set where it is at most a number.  The
    largest number that samples allow comes first.
    """
    system = setting.system
    n = len(system.state)
    matrices = derivatives(setting)
    chosen = np.linspace(0, setting.count - 1, min(setting.count, limits.CORNERS)).astype(int)
    rng = np.random.default_rng(SEED)
    which = rng.integers(0, setting.count, limits.NORM_STATES)
    known = {one: values[which] for one, values in setting.constants.items()}
    for rows, rate in itertools.islice(norms(matrices[chosen]), limits.TRIED_OF_FAMILY):
        floats = np.array([[float(x) for x in row] for row in rows])
        slower = (1 + rate) / 2
        if 1 - slower < limits.SLOWEST:
            continue
        gaps = rng.uniform(-1, 1, (len(which), n))
        gaps /= np.abs(gaps @ floats.T).max(axis=1)[:, None]  # of norm 1
        for power in range(limits.LOCAL_HALVINGS):
            size = Fraction(1, 2**power)
            points = dict(known)
            for j, one in enumerate(system.state):
                gap = gaps[:, j] * float(size) * rng.uniform(0.05, 1, len(which))
                points[f"{one}_gap"] = gap
                points[one] = points[f"{one}_point"] + gap
            with np.errstate(all="ignore"):
                inside = np.broadcast_to(holds(system.space, points), (len(which),))
                here = np.stack([points[f"{one}_gap"] for one in system.state], axis=1)
                there = after(system, points)
                moved = np.stack([there[f"{one}_gap"] for one in system.state], axis=1)
                before = np.abs(here @ floats.T).max(axis=1)
                fits = np.abs(moved @ floats.T).max(axis=1) <= float(slower) * before
            if fits[inside].all():
                for share in limits.LOCAL_SHARES:
                    yield norm_candidate(setting, rows, slower, size * share)
                break
