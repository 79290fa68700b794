"""Points where sampling fails: a model of Z3, its values pinned one after another to the simplest
that leave the rest possible.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from flint import fmpq, fmpq_poly

from .algebraic import AlgebraicNumber, simplest_between
from .budget import Budget
from .candidates import Value, trials
from .condition import Condition
from .sampler import Assignment, Sampler
from .solver import ask

WINDOWS = tuple(fmpq(1, 4**k) for k in range(6))


def model_assignments(
    condition: Condition,
    names: Sequence[str],
    integers: frozenset[str],
    budget: Budget,
    effort: int,
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
        for value in _near(here, name, model.get(name, fmpq(0)), name in integers):
            answer = ask(here.substituted({name: value}), budget, integers, resources, model=True)
            if answer.verdict == "sat":
                pinned[name] = value
                model = answer.model
                break
    rest = condition.substituted(pinned)
    sampler = Sampler(budget, integers, 6, 2, 400, True)
    for assignment in sampler.search(rest, [n for n in names if n not in pinned]):
        for name, pin in pinned.items():
            assignment.values[name] = _constant(pin)
        yield assignment


def _near(condition: Condition, name: str, value: Value, integral: bool) -> list[fmpq]:
    """Values to try in place of a model's: favourites that meet what is said of the variable alone,
    then simple ones ever nearer.
    """
    found = list(trials(condition, name, integral, 4))
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
