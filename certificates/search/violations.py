"""What a point at which a statement fails meets, and Z3's verdict on whether there is one at a
value of a parameter.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from flint import fmpq, fmpq_poly

from certificates import checker

from .algebraic import AlgebraicNumber
from .budget import Budget
from .candidates import UNITS
from .condition import Condition, multivariate, ring_of
from .solver import RESOURCES, ask


@dataclass(frozen=True)
class Violation:
    """What a point at which a statement fails meets: the premises, and no values of the bound
    variables that meet the goals.
    """

    name: str
    condition: Condition
    goal: Condition | None
    bound: tuple[str, ...]
    integers: tuple[str, ...]

    @staticmethod
    def of(statement: checker.Statement, domain: Any, units: bool) -> Violation:
        """The violations of a statement in a domain, in units of r and g unless told otherwise."""
        story = checker.Unfolding(statement, checker.Context(), [domain])
        premises = list(story.premises)
        ones = {name: fmpq(1) for name in UNITS & story.variables} if units else {}
        ring = ring_of(story.context)
        exists = tuple(sorted(story.variables - set(story.universal)))
        whole = premises if exists else [*premises, story.goal(False)]
        condition = Condition.of(story.context, checker.join("and", whole), ring).substituted(ones)
        goal = (
            Condition.of(story.context, story.goal(True), ring).substituted(ones)
            if exists
            else None
        )
        return Violation(statement.name, condition, goal, exists, tuple(sorted(story.integers)))

    def absent(
        self, parameter: str, at: fmpq | AlgebraicNumber, budget: Budget, resources: int = RESOURCES
    ) -> bool | None:
        """Z3's verdict at one value of the parameter: True where there is no violation, None where
        it has none.
        """
        condition, goal = self.condition, self.goal
        if isinstance(at, AlgebraicNumber) and at.is_rational:
            at = at._low
        if isinstance(at, AlgebraicNumber):
            ring = condition.ring
            gen = ring.gen(ring.variable_to_index(parameter))
            modulus = multivariate(fmpq_poly(at.poly), ring, parameter)
            here = Condition(
                ring,
                [modulus, gen - at._low, at._high - gen],
                ("and", [(0, "="), (1, ">"), (2, ">")]),
            )
            condition = condition.conjoined(here)
        else:
            condition = condition.substituted({parameter: at})
            goal = goal.substituted({parameter: at}) if goal is not None else None
        unreachable = (goal, self.bound) if goal is not None else None
        verdict = ask(condition, budget, self.integers, resources, unreachable=unreachable).verdict
        return {"sat": False, "unsat": True}.get(verdict)
