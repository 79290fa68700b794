"""Exact sample points of a state: for one parameter over every cell and close to its ends,
otherwise by sampling all variables.
"""

from __future__ import annotations

from itertools import islice

from flint import fmpq

from certificates import checker

from .algebraic import simplest_between
from .budget import Budget
from .candidates import UNITS, Cells, favourites
from .condition import Condition, evaluate, ring_of
from .quotients import Sample
from .sampler import Sampler

CLOSENESS = tuple(
    fmpq(p, q) for p, q in ((1, 2), (1, 4), (3, 4), (1, 20), (19, 20), (1, 1000), (999, 1000))
)


def state_condition(state: checker.State) -> Condition:
    """What a state assumes, as a condition."""
    parts = [("atom", poly, relation) for poly, relation in state.facts] + [
        ("or", list(choice)) for choice in state.choices
    ]
    return Condition.of(
        state.context,
        checker.join("and", [False] if state.closed else parts),
        ring_of(state.context),
    )


def base_samples(state: checker.State, budget: Budget, count: int = 12) -> list[Sample]:
    """Points of the state, in a fixed order."""
    condition = state_condition(state)
    if condition.tree is False:
        return []
    names = list(state.context.index)
    used = condition.variables()
    if len(used) == 1:
        return [
            {**{n: fmpq(1) for n in names}, **s} for s in _on_a_line(condition, next(iter(used)))
        ]
    found: list[Sample] = _close_to_ends(condition, names, used)
    for width, last, nodes in ((4, 3, 300), (9, 3, 3000), (24, 3, 3000)):
        every = list(
            islice(
                Sampler(budget, frozenset(state.context.integers), width, last, nodes).search(
                    condition, names
                ),
                400,
            )
        )
        for assignment in every[:: max(1, len(every) // count)]:
            sample = {name: assignment.rational(name) for name in names}
            if all(v is not None for v in sample.values()) and sample not in found:
                found.append({n: v for n, v in sample.items() if v is not None})
        if len(found) >= count // 2 or found and width >= 9:
            break
    found += [
        s for s in _scattered(condition, names, state.context.integers, count) if s not in found
    ]
    return found + _extreme(
        condition,
        found[:1] + found[len(found) // 2 :][:1],
        sorted(used - UNITS - set(state.context.integers)),
    )


def _close_to_ends(condition: Condition, names: list[str], used: set[str]) -> list[Sample]:
    """Where units aside there is one variable: points all along its line, close to the ends too, in
    units of 1.
    """
    ones = {name: fmpq(1) for name in used & UNITS}
    line = condition.substituted(ones)
    if len(used - UNITS) != 1 or not ones or line.variables() != used - UNITS:
        return []
    return [{**{n: fmpq(1) for n in names}, **s} for s in _on_a_line(line, *(used - UNITS))]


def _extreme(condition: Condition, samples: list[Sample], names: list[str]) -> list[Sample]:
    """The samples with one variable at a time made very small or very large: what serves by chance
    does not serve there.
    """
    found: list[Sample] = []
    for sample in samples:
        for name in names:
            for value in (fmpq(1, 1000), fmpq(1000)):
                moved = {**sample, name: value}
                if moved not in found and condition.substituted(moved).tree is True:
                    found.append(moved)
    return found


def _scattered(
    condition: Condition, names: list[str], integers: set[str], count: int
) -> list[Sample]:
    """Favourite values combined in a fixed pseudo-random order, so that variables are not all tied
    to one another.
    """
    found: list[Sample] = []
    state = 20
    for _ in range(10 * count):
        sample = {}
        for name in names:
            state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
            values = favourites(name, name in integers)[:12]
            sample[name] = values[(state >> 33) % len(values)]
        if sample not in found and condition.substituted(sample).tree is True:
            found.append(sample)
        if len(found) >= count:
            break
    return found


def _on_a_line(condition: Condition, name: str) -> list[Sample]:
    cells = Cells(condition.in_one_variable(name))
    found: list[Sample] = []
    for low, high in cells.intervals():
        if low < high and evaluate(condition.tree, cells.signs(simplest_between(low, high))):
            length = high - low
            for part in CLOSENESS:
                slack = min(part, 1 - part) / 4
                found.append(
                    {
                        name: simplest_between(
                            low + length * (part - slack), low + length * (part + slack)
                        )
                    }
                )
    for root in cells.roots:
        if root.is_rational and evaluate(condition.tree, cells.signs(root)):
            found.append({name: root._low})
    return sorted(found, key=lambda sample: sample[name])
