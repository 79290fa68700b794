"""Points near models of Z3, and points in floats."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from flint import fmpq, fmpq_mpoly, fmpq_poly
from numpy.typing import NDArray

from juggleproof.algebra.conditions import Condition, Tree, places
from juggleproof.algebra.number_field import common_field
from juggleproof.algebra.numbers import AlgebraicNumber, exact, simplest_between
from juggleproof.search import limits
from juggleproof.search.candidates import Value, trials
from juggleproof.search.hints.asking import ask
from juggleproof.search.hints.few_values import point_by_few_values
from juggleproof.search.samples import Assignment, Sampler
from juggleproof.statements.language import Roles
from juggleproof.statements.work import Budget

# -------------------------------------------------------------------------------------------------
# Points where sampling fails: a model of Z3, its values pinned one after another to the simplest
# that leave the rest possible.


def model_assignments(
    condition: Condition,
    names: Sequence[str],
    integers: frozenset[str],
    budget: Budget,
    effort: int,
    roles: Roles,
) -> Iterator[Assignment]:
    """Assignments that meet the condition, near a model of it; none where Z3 finds no model."""
    resources = 300_000 * 10 ** (effort - 1)
    answer = ask(condition, budget, integers, resources, model=True)
    if answer.verdict != "sat":
        return
    pinned: dict[str, fmpq] = {}
    model = answer.model
    for name in names:
        here = condition.substituted(pinned)
        if name not in here.variables():
            continue
        for value in _simple_values(here, name, model.get(name, fmpq(0)), name in integers, roles):
            answer = ask(here.substituted({name: value}), budget, integers, resources, model=True)
            if answer.verdict == "sat":
                pinned[name] = value
                model = answer.model
                break
    rest = condition.substituted(pinned)
    sampler = Sampler(budget, integers, 6, 2, 400, True, roles=roles)
    for assignment in sampler.search(rest, [n for n in names if n not in pinned]):
        for name, pin in pinned.items():
            assignment.values[name] = _constant(pin)
        yield assignment


def whole_models(
    condition: Condition,
    names: Sequence[str],
    integers: frozenset[str],
    budget: Budget,
    roles: Roles,
    resources: int,
) -> Iterator[Assignment]:
    """A point where some variables have few values, or else Z3's model as it is, all of its values
    in one number field; none where Z3 sees none.

    The first is quick at any number of variables; Z3 counts the work of the second badly, which is
    done within `resources` of it, or not at all.
    """
    point = None if integers else point_by_few_values(condition, budget, roles)
    if point is not None:
        yield Assignment({name: _constant(point.get(name, fmpq(1))) for name in names})
    answer = ask(condition, budget, integers, resources, model=True) if resources else None
    if answer is not None and answer.verdict == "sat":
        field = common_field({name: answer.model.get(name, fmpq(1)) for name in names}, budget)
        if field is not None:
            yield Assignment(*field)


def _simple_values(
    condition: Condition, name: str, value: Value, integral: bool, roles: Roles
) -> list[fmpq]:
    """Values to try in place of a model's: favourites that meet the relations about the variable
    alone, then simple ones ever nearer.
    """
    found = list(trials(condition, name, integral, 4, roles))
    if isinstance(value, AlgebraicNumber):
        centre = value.approximation()
    else:
        centre = value
    if integral:
        return [*found, centre] if centre.q == 1 else found
    for window in map(exact, limits.WINDOWS):
        simple = simplest_between(centre - window, centre + window)
        if simple not in found:
            found.append(simple)
    if not isinstance(value, AlgebraicNumber) and value not in found:
        found.append(value)
    return found


def _constant(value: fmpq) -> fmpq_poly:
    return fmpq_poly([value])


# -------------------------------------------------------------------------------------------------
# Points in floats that nearly meet a condition, by damped Gauss-Newton steps from counted starts:
# a guide to exact ones, and no more.

Array = NDArray[np.float64]


class Residuals:
    """What polynomials miss of their relations, with the gradients; all of them at once.

    Shapes, for M monomials of R polynomials in n variables: `powers` (M, n), `values` (M,) and
    `starts` (R,), the place of each polynomial's first monomial.
    """

    def __init__(self, facts: Sequence[tuple[fmpq_mpoly, str]], variables: Sequence[int]) -> None:
        powers, values, starts = list[list[int]](), list[float](), list[int]()
        for poly, _ in facts:
            starts.append(len(values))
            own = [float(int(c.p) / int(c.q)) for c in poly.coeffs()]
            most = max(map(abs, own), default=1.0)
            powers += [[m[v] for v in variables] for m in poly.monoms()] or [[0] * len(variables)]
            values += [c / most for c in own] or [0.0]
        self.powers = np.array(powers, dtype=np.int64).reshape(-1, len(variables))
        self.below = np.maximum(self.powers - 1, 0)
        self.values, self.starts = np.array(values), np.array(starts, dtype=np.int64)
        self.ladder = np.arange(self.powers.max(initial=0) + 1)[:, None]
        self.equal = np.array([relation == "=" for _, relation in facts], dtype=bool)
        self.bound = np.array([relation in (">", ">=") for _, relation in facts], dtype=bool)

    def at(self, point: Array, margin: float) -> tuple[Array, Array]:
        """The residuals (R,) at a point (n,), and their gradients (R, n)."""
        along, powers = np.arange(len(point)), point**self.ladder
        table = powers[self.powers, along]
        before, after = np.ones_like(table), np.ones_like(table)
        np.cumprod(table[:, :-1], axis=1, out=before[:, 1:])
        np.cumprod(table[:, :0:-1], axis=1, out=after[:, -2::-1])
        slopes = self.values[:, None] * self.powers * powers[self.below, along] * before * after
        whole = np.add.reduceat(self.values * table.prod(axis=1), self.starts)
        gradients = np.add.reduceat(slopes, self.starts, axis=0)
        short = self.bound & (margin - whole > 0)
        sign = np.where(self.equal, 1.0, np.where(short, -1.0, 0.0))
        missed = np.where(self.equal, whole, np.where(short, margin - whole, 0.0))
        return missed, np.where(sign[:, None] == 0, 0.0, sign[:, None] * gradients)


def approximate_points(
    condition: Condition, names: Sequence[str], budget: Budget
) -> Iterator[dict[str, fmpq]]:
    """Points near which the condition may be met, as rationals; other alternatives of `or` are
    taken from start to start.
    """
    variables = [name for name in names if name in condition.variables()]
    at = [places(condition.ring)[name] for name in variables]
    random = np.random.default_rng(11)
    for _ in range(limits.STARTS if variables else 0):
        atoms = list(_alternative(condition.tree, random))
        residuals = Residuals([(condition.polys[k], relation) for k, relation in atoms], at)
        start = random.normal(0.0, 1.5, len(variables))
        for margin in limits.START_MARGINS:
            point = _descended(residuals, start, margin, budget)
            if point is not None:
                yield {
                    name: fmpq(round(float(value) * 2**40), 2**40)
                    for name, value in zip(variables, point)
                }
                break


def _alternative(tree: Tree, random: np.random.Generator) -> Iterator[tuple[int, str]]:
    if isinstance(tree, bool):
        return
    if isinstance(tree[0], int):
        yield tree
    elif tree[0] == "and":
        for part in tree[1]:
            yield from _alternative(part, random)
    else:
        yield from _alternative(tree[1][int(random.integers(len(tree[1])))], random)


def _descended(residuals: Residuals, point: Array, margin: float, budget: Budget) -> Array | None:
    """The point to which the steps lead, if all residuals vanish there."""
    damping = 1e-2
    with np.errstate(all="ignore"):
        value, jacobian = residuals.at(point, margin)
        for _ in range(limits.STEPS):
            budget.spend(10 + 6 * len(residuals.starts) * (1 + len(point) // 3))
            size = float(value @ value)
            if not np.isfinite(size):
                return None
            if size < 1e-20:
                return point
            step = np.linalg.solve(
                jacobian.T @ jacobian + damping * np.eye(len(point)), -jacobian.T @ value
            )
            there, slope = residuals.at(point + step, margin)
            if float(there @ there) < size:
                point, value, jacobian, damping = (
                    point + step,
                    there,
                    slope,
                    max(damping / 5, 1e-12),
                )
            else:
                damping *= 6
            if damping > 1e8:
                return None
    return None
