"""Exact points that meet a statement's premises, counterexamples that break its goals, and
witnesses, as the checker takes them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from certificates import checker

from .algebraic import fraction
from .base_samples import base_samples
from .budget import Budget, Exhausted, accepted
from .closing import search_closing
from .condition import Condition, ring_of
from .families import cover
from .model_points import model_assignments
from .number_closing import Adjoined, close_at_number
from .numeric import near_points
from .sampler import Assignment, Sampler
from .setting import Task
from .solver import ask
from .stories import unfolded
from .towers import DIGITS, Towers
from .towers import as_found as tower_as_found

Found = list[Any]
Known = dict[str, checker.Statement]

# For each effort: rounds of (values tried for a variable, values kept for the last one,
# substitutions in all, irrational ones too).
ROUNDS: tuple[tuple[tuple[int, int, int, bool], ...], ...] = (
    ((3, 1, 40, False),),
    ((3, 1, 60, True), (6, 2, 400, True), (12, 3, 1000, True)),
    ((3, 1, 60, True), (6, 2, 400, True), (12, 3, 3000, True), (24, 6, 8000, True)),
)


def search_points(
    statement: checker.Statement, known: Known, budget: Budget, effort: int = 0
) -> tuple[Found | None, Found | None]:
    """(a point that meets the premises, a counterexample), each as the checker accepts it, or
    None.
    """
    state: checker.State = checker.State(checker.Context())
    counterexample = search_found(
        statement, state, "counterexample", {}, known, budget, effort=effort
    )
    if counterexample is not None:
        return counterexample[:4], counterexample
    return search_found(statement, state, "point", {}, known, budget, effort=effort), None


def search_found(
    statement: checker.Statement,
    state: checker.State,
    purpose: str,
    base: dict[str, checker.Poly],
    known: Known,
    budget: Budget,
    sharp: list[Any] | None = None,
    effort: int = 1,
) -> Found | None:
    """Values as `checker.find` takes them for the purpose "point", "counterexample" or "witness";
    None where none was found.
    """
    if base:
        return _found_terms(Task(statement, purpose, base, known, budget, sharp, effort), state)
    story = unfolded(statement, sharp)
    exists = bool(statement.get("exists"))
    parts = list(story.premises)
    names = list(story.universal)
    if purpose == "witness":
        parts, names = [story.goal(True)], sorted(story.variables)
    elif purpose == "counterexample" and not exists:
        parts.append(story.goal(False))
    whole = checker.join("and", parts)
    if whole is False:
        return None
    condition = Condition.of(story.context, whole, ring_of(story.context))
    goal = (
        Condition.of(story.context, story.goal(True), condition.ring)
        if exists and purpose == "counterexample"
        else None
    )
    if (
        exists
        or purpose == "witness"
        or story.integers
        or sharp
        or not effort
        or not any(r == "=" for _, r in condition.facts())
    ):
        return _sampled(
            statement,
            state,
            condition,
            goal,
            names,
            frozenset(story.integers),
            purpose,
            known,
            budget,
            sharp,
            effort,
        )
    try:
        part = budget.part(budget.left * 6 // 10)
        found = _sampled(
            statement,
            state,
            condition,
            goal,
            names,
            frozenset(),
            purpose,
            known,
            part,
            sharp,
            effort,
        )
    except Exhausted:
        found = None
    return found or _by_towers(statement, state, condition, names, purpose, known, budget, effort)


def _sampled(
    statement: checker.Statement,
    state: checker.State,
    condition: Condition,
    goal: Condition | None,
    names: Sequence[str],
    integers: frozenset[str],
    purpose: str,
    known: Known,
    budget: Budget,
    sharp: list[Any] | None,
    effort: int,
) -> Found | None:
    """A point from samples and models, with one irrational number at most."""
    failures = 0
    for assignment in assignments(condition, names, integers, budget, effort, goal is not None):
        if goal is not None and not _beyond(goal, assignment, names, integers, budget):
            failures += 1
        else:
            found = as_found(
                statement, state, assignment, names, purpose, known, budget, sharp, effort
            )
            if found is not None:
                return found
            failures += 5
        if failures >= 30 * (effort + 1):
            break
    return None


def _by_towers(
    statement: checker.Statement,
    state: checker.State,
    condition: Condition,
    names: Sequence[str],
    purpose: str,
    known: Known,
    budget: Budget,
    effort: int,
) -> Found | None:
    """A point with several irrational values, sought near points in floats."""
    for guide in near_points(condition, names, budget):
        failures = 0
        for tower in Towers(budget, names, guide, 60 * effort, 1).search(condition):
            for digits in DIGITS:
                found = tower_as_found(statement, state, tower, purpose, known, budget, digits)
                if found is not None and accepted(
                    checker.find,
                    state.branch(),
                    found,
                    known,
                    purpose,
                    {statement.name: statement},
                    {},
                    None,
                ):
                    return found
            failures += 1
            if failures >= 2 * effort:
                break
    return None


def _beyond(
    goal: Condition,
    assignment: Assignment,
    names: Sequence[str],
    integers: frozenset[str],
    budget: Budget,
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
    if next(Sampler(budget, integers, *ROUNDS[0][0]).search(there, rest), None) is not None:
        return False  # so simple values that meet the goals need not be asked for
    return ask(there, budget, integers, 200_000).verdict == "unsat"


def _found_terms(task: Task, state: checker.State) -> Found | None:
    """Terms in the base variables, on all of the state."""
    if task.effort == 0:
        task = replace(task, effort=1, nodes=40, tries=2)
    return cover(task, state, base_samples(state, task.budget), depth=(0, 2, 4)[task.effort])


def assignments(
    condition: Condition,
    names: Sequence[str],
    integers: frozenset[str],
    budget: Budget,
    effort: int,
    many: bool = False,
) -> Iterator[Assignment]:
    """Assignments that meet a condition, from wider and wider samples; at last from Z3's models."""
    for width, last, nodes, irrational in ROUNDS[effort]:
        yield from Sampler(budget, integers, width, last + 12 * many, nodes, irrational).search(
            condition, names
        )
        if effort and width == 6:
            # Where Z3 sees that there is nothing, wider samples would be in vain.
            answer = ask(condition, budget, integers, 100_000).verdict
            if answer == "unsat":
                return
            if answer == "sat" and not many:
                yield from model_assignments(condition, names, integers, budget, effort)


def as_found(
    statement: checker.Statement,
    state: checker.State,
    assignment: Assignment,
    names: Sequence[str],
    purpose: str,
    known: Known,
    budget: Budget,
    sharp: list[Any] | None,
    effort: int,
) -> Found | None:
    """The assignment in the checker's form, with its nodes, confirmed by the checker; None where it
    does not serve.
    """
    named = {statement.name: statement}
    nodes = [["close"]] * (2 if purpose == "counterexample" else 1)
    if assignment.number is None:
        values = {name: str(fraction(assignment.values[name][0])) for name in names}
        found = [statement.name, [], values, *nodes]
        if purpose == "counterexample" and statement.get("exists"):
            node = _goal_node(statement, state, found, known, budget, sharp, effort)
            if node is None:
                return None
            found[4] = node
        return (
            found
            if accepted(checker.find, state.branch(), found, known, purpose, named, {}, sharp)
            else None
        )
    for digits in (1, 2, 3, 4, 6, 9, 14, 20, 40):
        adjoined = Adjoined.of(assignment.number, digits, _fresh("theta", statement))
        values = {name: adjoined.text(assignment.values[name]) for name in names}
        found = [statement.name, [adjoined.entry()], values, *nodes]
        if _with_nodes(statement, state, found, adjoined, sharp, purpose) and accepted(
            checker.find, state.branch(), found, known, purpose, named, {}, sharp
        ):
            return found
    return None


def _story(
    statement: checker.Statement, state: checker.State, found: Found, sharp: list[Any] | None
) -> tuple[checker.State, checker.Unfolding]:
    """The state and the unfolding that the checker has when it comes to the nodes of a found
    without a base.
    """
    state = state.branch()
    for entry in found[1]:
        checker.adjoin(state, {}, *entry)
    values = {name: state.context.value(checker.parse(text)) for name, text in found[2].items()}
    return state, checker.Unfolding(statement, checker.Context(state.context, values), sharp)


def _goal_node(
    statement: checker.Statement,
    state: checker.State,
    found: Found,
    known: Known,
    budget: Budget,
    sharp: list[Any] | None,
    effort: int,
) -> list[Any] | None:
    state, story = _story(statement, state, found, sharp)
    return search_closing(
        state.branch(story.goal(True), story.context), known, budget, min(effort, 1)
    )


def _with_nodes(
    statement: checker.Statement,
    state: checker.State,
    found: Found,
    adjoined: Adjoined,
    sharp: list[Any] | None,
    purpose: str,
) -> bool:
    """Fills in the nodes at an adjoined number; whether that went well."""
    try:
        state, story = _story(statement, state, found, sharp)
        branches = [
            state.branch(
                checker.negate(
                    checker.join("and", story.goals if purpose == "witness" else story.premises)
                )
            )
        ]
        if purpose == "counterexample":
            branches.append(state.branch(story.goal(True), story.context))
        for k, branch in enumerate(branches):
            node = close_at_number(branch, adjoined)
            if node is None:
                return False
            found[3 + k] = node
    except checker.Rejected:
        return False
    return True


def _fresh(name: str, statement: checker.Statement) -> str:
    kinds = ("forall", "exists", "let", "root")
    taken = {
        n
        for kind in kinds
        for said in statement.get(kind)
        for n in (said if isinstance(said, list) else [said[0]])
    }
    while name in taken:
        name += "_"
    return name
