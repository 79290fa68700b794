"""Exact points that meet a statement's premises, counterexamples that break its goals, and
witnesses, as the checker takes them.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import islice

from juggleproof.algebra.conditions import Condition, ring_of
from juggleproof.algebra.numbers import fraction
from juggleproof.certificates import checker
from juggleproof.search import limits
from juggleproof.search.at_one_number import AdjoinedNumber, close_at_number
from juggleproof.search.closing import search_closing
from juggleproof.search.families import cover
from juggleproof.search.hints.asking import ask
from juggleproof.search.hints.isolated import isolated_points
from juggleproof.search.hints.models import (
    approximate_points,
    model_assignments,
    whole_models,
)
from juggleproof.search.samples import Assignment, Sampler, base_samples
from juggleproof.search.scales import with_scales
from juggleproof.search.towers_of_roots import Towers, values_of_tower
from juggleproof.search.witness_terms import Known, TermTask, nodes_at
from juggleproof.statements.language import NO_ROLES, Roles
from juggleproof.statements.nodes import Node, Values, values_at
from juggleproof.statements.states import SearchState
from juggleproof.statements.work import Budget, Exhausted, unfolded


def search_values(
    statement: checker.Statement,
    state: SearchState,
    purpose: str,
    base: dict[str, checker.Poly],
    known: Known,
    budget: Budget,
    sharp: list[ast.expr] | None = None,
    effort: int = 1,
    roles: Roles = NO_ROLES,
) -> Values | None:
    """Values as `states.finds` takes them for the purpose "point", "counterexample" or "witness";
    None where none were found.

    `base` has the values of variables that are given, in which a witness is sought as terms.
    Raises Exhausted where the budget ends.
    """
    unfolding = unfolded(statement, sharp)
    roles = with_scales(roles, unfolding)
    task = TermTask(statement, purpose, base, known, budget, sharp, effort, roles=roles)
    if base:
        return _terms_on_state(task, state)
    exists = bool(statement.get("exists"))
    parts = list(unfolding.premises)
    names = list(unfolding.universal)
    if purpose == "witness":
        parts, names = [unfolding.goal(True)], sorted(unfolding.variables)
    elif purpose == "counterexample" and not exists:
        parts.append(unfolding.goal(False))
    whole = checker.join("and", parts)
    if whole is False:
        return None
    condition = Condition.of(unfolding.context, whole, ring_of(unfolding.context))
    goal = (
        Condition.of(unfolding.context, unfolding.goal(True), condition.ring)
        if exists and purpose == "counterexample"
        else None
    )
    integers = frozenset(unfolding.integers)
    if (
        exists
        or purpose == "witness"
        or integers
        or sharp
        or not effort
        or not any(r == "=" for _, r in condition.facts())
    ):
        return _sampled(task, state, condition, goal, names, integers)
    try:
        less = replace(task, budget=budget.part(budget.left * 6 // 10))
        values = _sampled(less, state, condition, goal, names, integers)
    except Exhausted:
        values = None
    return values or _by_towers(task, state, condition, names)


def _sampled(
    task: TermTask,
    state: SearchState,
    condition: Condition,
    goal: Condition | None,
    names: Sequence[str],
    integers: frozenset[str],
) -> Values | None:
    """A point from samples and models, with one irrational number at most."""
    failures, many, budget, roles = 0, goal is not None, task.budget, task.roles
    for assignment in assignments(condition, names, integers, budget, task.effort, many, roles):
        if goal is not None and not _beyond(goal, assignment, names, integers, budget, roles):
            failures += 1
        else:
            values = values_of_assignment(task, state, assignment, names)
            if values is not None:
                return values
            failures += 5
        if failures >= 30 * (task.effort + 1):
            break
    return None


def _by_towers(
    task: TermTask, state: SearchState, condition: Condition, names: Sequence[str]
) -> Values | None:
    """A point with several irrational values, guided by points in floats."""
    for guide in approximate_points(condition, names, task.budget):
        search = Towers(task.budget, names, guide, 60 * task.effort, 1, task.roles)
        for tower in islice(search.search(condition), 2 * task.effort):
            for digits in limits.TOWER_DIGITS:
                values = values_of_tower(task, state, tower, digits)
                if values is not None and _served(task, state, values):
                    return values
    return None


def _beyond(
    goal: Condition,
    assignment: Assignment,
    names: Sequence[str],
    integers: frozenset[str],
    budget: Budget,
    roles: Roles,
) -> bool:
    """Whether Z3 thinks that no values of the `exists` variables meet the goals at a rational
    point.
    """
    values = {name: assignment.rational(name) for name in names}
    exact = {name: value for name, value in values.items() if value is not None}
    if len(exact) < len(names):
        return False
    there = goal.substituted(exact)
    rest = sorted(there.variables())
    sampler = Sampler(budget, integers, *limits.SAMPLER_ROUNDS[0][0], roles=roles)
    if next(sampler.search(there, rest), None) is not None:
        return False  # so simple values that meet the goals need not be asked for
    return ask(there, budget, integers, 200_000).verdict == "unsat"


def _terms_on_state(task: TermTask, state: SearchState) -> Values | None:
    """Terms in the base variables, on all of the state."""
    if task.effort == 0:
        task = replace(task, effort=1, nodes=40, tries=2)
    return cover(
        task, state, base_samples(state, task.budget, task.roles), depth=(0, 2, 4)[task.effort]
    )


def assignments(
    condition: Condition,
    names: Sequence[str],
    integers: frozenset[str],
    budget: Budget,
    effort: int,
    many: bool = False,
    roles: Roles = NO_ROLES,
) -> Iterator[Assignment]:
    """Assignments that meet a condition, from wider and wider samples; at last from Z3's models."""
    if not many and (
        len(condition.variables()) >= limits.MANY_VARIABLES
        or disjunctions(condition) >= limits.MANY_VARIABLES
    ):
        # Sampling would try a small part of the values: models are asked for first.
        yield from whole_models(condition, names, integers, budget, roles, limits.Z3_GUESS_WORK)
    for width, last, nodes, irrational in limits.SAMPLER_ROUNDS[effort]:
        yield from Sampler(
            budget, integers, width, last + 12 * many, nodes, irrational, roles=roles
        ).search(condition, names)
        if effort and width == 6:
            # Where Z3 sees that there is nothing, wider samples would be in vain.
            answer = ask(condition, budget, integers, limits.Z3_GUESS_WORK).verdict
            if answer == "unsat":
                return
            if answer == "sat" and not many:
                yield from model_assignments(condition, names, integers, budget, effort, roles)
            if not (many or integers):
                yield from isolated_points(condition, names, budget)
            if not many:
                resources = limits.Z3_GUESS_WORK if answer == "sat" else 0
                yield from whole_models(condition, names, integers, budget, roles, resources)


def disjunctions(condition: Condition) -> int:
    """How many disjunctions stand at top level."""
    tree = condition.tree
    if isinstance(tree, bool) or tree[0] != "and":
        return 0
    return sum(not isinstance(part, bool) and part[0] == "or" for part in tree[1])


def values_of_assignment(
    task: TermTask, state: SearchState, assignment: Assignment, names: Sequence[str]
) -> Values | None:
    """The assignment in the checker's form, with its nodes, confirmed by the checker; None where it
    does not serve.
    """
    nodes: list[Node] = [("close",)] * (2 if task.purpose == "counterexample" else 1)
    if assignment.number is None:
        terms = {name: str(fraction(assignment.values[name][0])) for name in names}
        if task.purpose == "counterexample" and task.statement.get("exists"):
            own = state.branch()
            values = {n: own.context.value(checker.parse(text)) for n, text in terms.items()}
            context = checker.Context(own.context, values)
            unfolding = checker.Unfolding(task.statement, context, task.sharp)
            aim = own.branch(unfolding.goal(True), unfolding.context)
            node = search_closing(aim, task.known, task.budget, min(task.effort, 1))
            if node is None:
                return None
            nodes[1] = node
        return _served(task, state, values_at(task.statement.name, [], terms, nodes))
    for digits in (1, 2, 3, 4, 6, 9, 14, 20, 40):
        adjoined = AdjoinedNumber.of(assignment.number, digits, _fresh("theta", task.statement))
        terms = {name: adjoined.text(assignment.values[name]) for name in names}
        entry, own = adjoined.entry(), state.branch()
        try:
            own.adjoin(*entry[:4])
        except checker.Rejected:
            continue
        closed = nodes_at(task, own, terms, partial(close_at_number, adjoined=adjoined))
        if closed is not None:
            found = values_at(task.statement.name, [entry], terms, closed)
            if _served(task, state, found):
                return found
    return None


def _served(task: TermTask, state: SearchState, values: Values) -> Values | None:
    """The values, where the checker accepts them."""
    ok = state.is_served_by(values, task.known, task.purpose, task.statement, sharp=task.sharp)
    return values if ok else None


def _fresh(name: str, statement: checker.Statement) -> str:
    kinds = ("forall", "exists", "let", "root")
    taken = {
        n
        for kind in kinds
        for line in statement.get(kind)
        for n in (line if isinstance(line, list) else [line[0]])
    }
    while name in taken:
        name += "_"
    return name
