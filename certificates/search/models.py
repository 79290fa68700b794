"""Hints from floats and from Z3."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import lcm
from weakref import WeakKeyDictionary

import numpy as np
import z3
from flint import fmpq, fmpq_mpoly, fmpq_poly, fmpz_poly
from numpy.typing import NDArray

from juggleproof.certificates.algebra.conditions import Condition, Tree, places
from juggleproof.certificates.algebra.numbers import AlgebraicNumber, exact, simplest_between
from juggleproof.certificates.language import Roles
from juggleproof.certificates.search.candidates import Value, trials
from juggleproof.certificates.search.samples import Assignment, Sampler
from juggleproof.certificates.work import Budget

# -------------------------------------------------------------------------------------------------
# Asking Z3: a vote on whether a condition can be met, and a model of it.  No answer of Z3
# is believed.

RESOURCES = 200_000  # Z3's own unit of work; about a tenth of a second where numbers are rational


@dataclass
class Answer:
    """The answer "sat", "unsat" or "unknown", with a value of every variable that occurs where it
    is "sat".
    """

    verdict: str
    model: dict[str, Value] = field(default_factory=dict)


def ask(
    condition: Condition,
    budget: Budget,
    integers: Iterable[str] = (),
    resources: int = RESOURCES,
    model: bool = False,
    unreachable: tuple[Condition, Sequence[str]] | None = None,
) -> Answer:
    """Z3's answer within a fixed amount of its own work.

    `unreachable`, a condition with some of its variables, asks besides that no values of these meet
    it.
    """
    if condition.tree is False or condition.tree is True and unreachable is None:
        return Answer("sat" if condition.tree else "unsat")
    names = [name for name in condition.ring.names() if name in condition.variables()]
    whole = frozenset(integers) & set(names)
    session = _session(budget)
    solver = (
        z3.Solver(ctx=session.context)
        if whole
        else z3.Tactic("nlqsat" if unreachable else "qfnra-nlsat", ctx=session.context).solver()
    )
    solver.set("rlimit", resources)
    rows = [f"(declare-const |{name}| {_sort(name, whole)})" for name in names]
    rows.append(f"(assert {_formula(condition, condition.tree, whole)})")
    if unreachable is not None:
        goal = unreachable[0]
        inner = goal.variables()
        bound = [f"(|{name}| {_sort(name, whole)})" for name in unreachable[1] if name in inner]
        rows += [
            f"(declare-const |{name}| {_sort(name, whole)})"
            for name in sorted(inner - set(names) - set(unreachable[1]))
        ]
        text = f"(not {_formula(goal, goal.tree, whole)})"
        rows.append(
            f"(assert (forall ({' '.join(bound)}) {text}))" if bound else f"(assert {text})"
        )
    solver.from_string("\n".join(rows))
    result = str(solver.check())
    budget.spend(5000 + min(session.work(solver, resources), resources))
    if result != "sat" or not model:
        return Answer(result if result in ("sat", "unsat") else "unknown")
    values = solver.model()
    found = {declared.name(): values[declared] for declared in values.decls()}
    return Answer(
        result, {name: _value(found[name]) if name in found else fmpq(0) for name in names}
    )


class _Session:
    """A context of Z3 that the questions of one search share, since it takes longer to make one
    than to answer most of them.
    """

    def __init__(self) -> None:
        self.context, self.before = (
            z3.Context(),
            0,
        )  # the context's counter goes on from question to question

    def work(self, solver: z3.Solver, resources: int) -> int:
        """What Z3 has spent since it was asked for the last time."""
        statistics = solver.statistics()
        total = next(
            (int(statistics.get_key_value(k)) for k in statistics.keys() if k == "rlimit count"),
            None,
        )
        if total is None:
            return resources // 10
        spent, self.before = total - self.before, total
        return max(0, spent)


_sessions: WeakKeyDictionary[Budget, _Session] = WeakKeyDictionary()


def _session(budget: Budget) -> _Session:
    """The session of the whole search that a budget belongs to."""
    whole = budget
    while whole.whole is not None:
        whole = whole.whole
    if whole not in _sessions:
        _sessions[whole] = _Session()
    return _sessions[whole]


def _sort(name: str, integers: frozenset[str]) -> str:
    return "Int" if name in integers else "Real"


def _formula(condition: Condition, tree: Tree, integers: frozenset[str]) -> str:
    """A condition as an s-expression."""
    if isinstance(tree, bool):
        return "true" if tree else "false"
    if isinstance(tree[0], int):
        text = (
            f"({'=' if tree[1] == '!=' else tree[1]} {_term(condition.polys[tree[0]], integers)}"
            " 0.0)"
        )
        return f"(not {text})" if tree[1] == "!=" else text
    return f"({tree[0]} {' '.join(_formula(condition, part, integers) for part in tree[1])})"


def _term(poly: fmpq_mpoly, integers: frozenset[str]) -> str:
    """A polynomial times its denominator; a relation to 0 is the same for it."""
    names = [
        f"(to_real |{name}|)" if name in integers else f"|{name}|"
        for name in poly.context().names()
    ]
    scale = lcm(1, *(int(c.q) for c in poly.coeffs()))
    total = []
    for powers, c in zip(poly.monoms(), poly.coeffs()):
        number = int(c * scale)
        factors = [
            f"{number}.0" if number >= 0 else f"(- {-number}.0)",
            *(name for name, e in zip(names, powers) for _ in range(e)),
        ]
        total.append(f"(* {' '.join(factors)})" if len(factors) > 1 else factors[0])
    return f"(+ {' '.join(total)})" if len(total) > 1 else total[0] if total else "0.0"


def _value(value: z3.ExprRef) -> Value:
    if z3.is_algebraic_value(value):
        coefficients = [int(str(c)) for c in value.poly()]
        # Z3's polynomial need not be irreducible: the factor that changes its sign on the enclosure
        # is the one of the root.
        for precision in (10, 40, 160):
            decimal = value.approx(precision)
            middle = Fraction(decimal.numerator_as_long(), decimal.denominator_as_long())
            radius = Fraction(2, 10**precision)
            low, high = exact(middle - radius), exact(middle + radius)
            hits = [
                f
                for f, _ in fmpz_poly(coefficients).factor()[1]
                if fmpq_poly(f)(low) * fmpq_poly(f)(high) < 0
            ]
            if len(hits) == 1:
                factor = hits[0] if hits[0].leading_coefficient() > 0 else -hits[0]
                return AlgebraicNumber(factor, low, high)
        raise ValueError("an algebraic value without an isolating interval")
    if z3.is_int_value(value):
        return fmpq(value.as_long())
    return fmpq(value.numerator_as_long(), value.denominator_as_long())


# -------------------------------------------------------------------------------------------------
# Points where sampling fails: a model of Z3, its values pinned one after another to the simplest
# that leave the rest possible.

WINDOWS = tuple(fmpq(1, 4**k) for k in range(6))


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
    for window in WINDOWS:
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
STARTS, STEPS = 12, 40
MARGINS = (0.2, 0.02, 0.001)  # by how much inequalities are to be met, ever less


class Residual:
    """What a polynomial misses of its relation, with the gradient."""

    def __init__(self, poly: fmpq_mpoly, relation: str, variables: Sequence[int]) -> None:
        self.relation = relation
        self.powers = np.array(
            [[m[v] for v in variables] for m in poly.monoms()], dtype=np.int64
        ).reshape(-1, len(variables))
        values = [float(int(c.p) / int(c.q)) for c in poly.coeffs()]
        self.values = np.array(values) / max(map(abs, values), default=1.0)

    def at(self, point: Array, margin: float) -> tuple[float, Array]:
        """The residual at a point (n,), and its gradient (n,)."""
        table = point[None, :] ** self.powers
        whole = table.prod(axis=1) @ self.values
        gradient = np.array(
            [
                (
                    self.values
                    * self.powers[:, v]
                    * point[v] ** np.maximum(self.powers[:, v] - 1, 0)
                    * np.delete(table, v, axis=1).prod(axis=1)
                ).sum()
                for v in range(len(point))
            ]
        )
        if self.relation == "=":
            return float(whole), gradient
        if self.relation == "!=":
            return 0.0, np.zeros(len(point))
        short = margin - float(whole)
        return (short, -gradient) if short > 0 else (0.0, np.zeros(len(point)))


def approximate_points(
    condition: Condition, names: Sequence[str], budget: Budget
) -> Iterator[dict[str, fmpq]]:
    """Points near which the condition may be met, as rationals; other alternatives of `or` are
    taken from start to start.
    """
    variables = [name for name in names if name in condition.variables()]
    at = [places(condition.ring)[name] for name in variables]
    random = np.random.default_rng(11)
    for _ in range(STARTS if variables else 0):
        atoms = list(_alternative(condition.tree, random))
        residuals = [Residual(condition.polys[k], relation, at) for k, relation in atoms]
        start = random.normal(0.0, 1.5, len(variables))
        for margin in MARGINS:
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


def _descended(
    residuals: Sequence[Residual], point: Array, margin: float, budget: Budget
) -> Array | None:
    """The point to which the steps lead, if all residuals vanish there."""
    damping = 1e-2
    with np.errstate(all="ignore"):
        value, jacobian = _all(residuals, point, margin)
        for _ in range(STEPS):
            budget.spend(10 + 6 * len(residuals) * (1 + len(point) // 3))
            size = float(value @ value)
            if not np.isfinite(size):
                return None
            if size < 1e-20:
                return point
            step = np.linalg.solve(
                jacobian.T @ jacobian + damping * np.eye(len(point)), -jacobian.T @ value
            )
            there, slope = _all(residuals, point + step, margin)
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


def _all(residuals: Sequence[Residual], point: Array, margin: float) -> tuple[Array, Array]:
    pairs = [residual.at(point, margin) for residual in residuals]
    return np.array([value for value, _ in pairs]), np.array(
        [gradient for _, gradient in pairs]
    ).reshape(len(pairs), len(point))
