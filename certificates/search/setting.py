"""What terms are sought for, as a condition on base and unknown variables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from flint import fmpq_mpoly, fmpq_mpoly_ctx

from certificates import checker

from .budget import Budget, Exhausted
from .condition import Condition, ring_of, to_flint
from .elimination import projected
from .found_terms import Known
from .normal import Normal
from .quotients import SPARE, Choice, Quotient


@dataclass
class Task:
    """What terms are sought for: a statement, the purpose, the variables that are given, and those
    that are unknown.
    """

    statement: checker.Statement
    purpose: str
    base: dict[str, checker.Poly]
    known: Known
    budget: Budget
    sharp: list[Any] | None = None
    effort: int = 2
    hints: Mapping[str, Sequence[Quotient]] = field(default_factory=dict)
    nodes: int = 400
    tries: int = 6


def setting(task: Task, state: checker.State) -> tuple[Condition, dict[str, str], frozenset[str]]:
    """The condition on base and unknowns, the key in the ring of every unknown, and the keys that
    are integers.
    """
    story = checker.Unfolding(
        task.statement, checker.Context(state.context, dict(task.base)), task.sharp
    )
    if task.purpose == "witness":
        formula = story.goal(True)
        needed = story.variables
    else:
        premises = checker.join("and", list(story.premises))
        exists = task.statement.get("exists")
        formula = (
            checker.join("and", [premises, story.goal(False)])
            if task.purpose == "counterexample" and not exists
            else premises
        )
        needed = set(story.universal)
    by_place = {i: key for key, i in story.context.index.items()}
    keys = {}
    order = [
        n for line in (*task.statement.get("forall"), *task.statement.get("exists")) for n in line
    ]
    for name in sorted(
        needed - set(task.base),
        key=lambda n: (n not in ("r", "g"), order.index(n) if n in order else len(order)),
    ):
        (monomial,) = story.context.values[name].terms
        keys[name] = by_place[(monomial.bit_length() - 1) // checker.BITS]
    integers = frozenset(keys[n] for n in story.integers if n in keys) | frozenset(
        state.context.integers
    )
    return (
        Condition.of(story.context, formula, ring_of(story.context, *SPARE)).cleared(),
        keys,
        integers,
    )


def failing_goal(
    task: Task, state: checker.State, condition: Condition, budget: Budget
) -> tuple[Condition | None, list[fmpq_mpoly]]:
    """For a counterexample to what is said to exist: the goals, and the borders of where they can
    be met.
    """
    if task.purpose != "counterexample" or not task.statement.get("exists"):
        return None, []
    story = checker.Unfolding(
        task.statement, checker.Context(state.context, dict(task.base)), task.sharp
    )
    goal = Condition.of(story.context, story.goal(True), condition.ring)
    outer = set(condition.ring.names()) - {
        name for line in task.statement.get("exists") for name in line
    }
    try:
        return goal, projected(goal, outer, budget.part(50_000))
    except Exhausted:
        return goal, []


def margins_of(state: checker.State, condition: Condition, normal: Normal) -> list[fmpq_mpoly]:
    """What the state says to be positive, lowered, as long as it is short, and products: small
    where the state ends.
    """
    size = len(state.context.index)
    keys = list(state.context.index)
    ring = fmpq_mpoly_ctx.get(keys or ["none"], condition.ring.ordering())
    found: list[fmpq_mpoly] = []
    for poly, relation in state.facts:
        if relation in (">", ">="):
            lowered = normal.lower(to_flint(poly, ring, size).project_to_context(condition.ring))
            if (
                not lowered.is_constant()
                and len(lowered) <= 6
                and lowered.total_degree() <= 4
                and lowered not in found
            ):
                found.append(lowered)
    least = sorted(found, key=lambda p: (p.total_degree(), len(p)))[:5]
    return least + [least[0] * q for q in least[1:3]]


def length(choice: Choice) -> int:
    """How long a choice of terms is to read."""
    return sum(sum(q.size()) for q in choice.values.values()) + 20 * len(choice.roots)
