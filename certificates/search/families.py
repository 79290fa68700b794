"""Terms on all of a state: one choice of terms where it serves, and the state split by a sign where
it does not.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice

from flint import fmpq_mpoly

from certificates import checker

from .algebraic import sign
from .budget import accepted
from .closing import search_closing
from .condition import Condition, constant_of, to_text
from .found_terms import Node, Wanted, confirmed
from .line_cover import LineCover
from .normal import Normal
from .quotients import SPARE, Choice, Sample
from .setting import Task, length, margins_of, setting
from .templates import TemplateSearch


def cover(
    task: Task,
    state: checker.State,
    samples: Sequence[Sample],
    depth: int = 3,
    former: Sequence[Choice] = (),
) -> Node | None:
    """A found that serves on the whole state; None where none was found."""
    if state.closed:
        return ["empty", ["close"]]
    line = list(state.context.index)
    if len(line) == 1 and samples:
        return LineCover(task, state, line[0], samples).search()
    condition, keys, integers = setting(task, state)
    unknowns = list(keys.values())
    normal = Normal(state, condition)
    condition = normal.condition(condition)
    base = normal.base([n for n in condition.ring.names() if n not in unknowns and n not in SPARE])
    given = [normal.sample(sample) for sample in samples]
    tried: list[Choice] = list(former)
    if samples:
        margins = margins_of(state, condition, normal)
        search = TemplateSearch(
            base, given, task.budget, integers, task.nodes, None, task.hints, margins
        )
        tried += islice(search.search(condition, unknowns), task.tries)
    else:
        node = search_closing(state, task.known, task.budget, 1)
        if node is not None:
            return ["empty", node]
    for choice in _shortest(tried):
        wanted = Wanted(task.statement, task.purpose, task.base, task.sharp, normal)
        found = confirmed(
            wanted, state, choice, keys, task.known, task.budget, samples, task.effort
        )
        if found is not None:
            return found
    if depth <= 0 or len(samples) < 2:
        return None
    partial = TemplateSearch(base, given, task.budget, integers, task.nodes, 1, task.hints, margins)
    choices = sorted(
        islice(partial.search(condition, unknowns), 60), key=lambda c: (-len(c.serves), length(c))
    )
    for first in choices[:3]:
        for poly in _splitters(condition, first, given, base)[:2]:
            found = _split(task, state, normal.lift(poly), samples, depth, choices[:4])
            if found is not None:
                return found
    return None


def _split(
    task: Task,
    state: checker.State,
    poly: fmpq_mpoly,
    samples: Sequence[Sample],
    depth: int,
    former: Sequence[Choice],
) -> Node | None:
    text = to_text(poly)
    groups: list[list[Sample]] = [[], [], []]
    for sample in samples:
        value = constant_of(poly.subs(dict(sample)))
        if value is None:
            return None
        groups[sign(value) + 1].append(sample)
    founds: list[Node] = []
    for branch, group in zip(state.by_sign(text), groups):
        found = cover(task, branch, group, depth - 1, former if not group else ())
        if found is None:
            return None
        founds.append(found)
    whole = ["sign", text, *founds]
    named = {task.statement.name: task.statement}
    ok = accepted(
        checker.find, state.branch(), whole, task.known, task.purpose, named, task.base, task.sharp
    )
    return whole if ok else None


def _splitters(
    condition: Condition, choice: Choice, samples: Sequence[Sample], base: Sequence[str]
) -> list[fmpq_mpoly]:
    """Polynomials in the base whose sign tells the samples that a choice serves from the others."""
    if choice.roots or len(choice.serves) == len(samples):
        return []
    changed = condition
    for name, value in choice.values.items():
        changed = changed.replaced(name, value.top, value.bottom)
    found: list[tuple[int, fmpq_mpoly]] = []
    for k in sorted(set(range(len(changed.polys)))):
        if changed.polys[k].is_constant():
            continue
        for factor, _ in changed.polys[k].factor()[1]:
            signs = [sign(constant_of(factor.subs(dict(s))) or 0) for s in samples]
            inside = {signs[i] for i in choice.serves}
            outside = {s for i, s in enumerate(signs) if i not in choice.serves}
            if not inside & outside and factor not in [f for _, f in found]:
                found.append((len(factor) + int(factor.total_degree()), factor))
    return [f for _, f in sorted(found, key=lambda pair: pair[0])]


def _shortest(choices: Sequence[Choice]) -> list[Choice]:
    return sorted(choices, key=length)
