"""A condition on its way to terms: what was decided so far, and what is left, at every sample and
in symbols.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

from flint import fmpq_mpoly

from .condition import Condition
from .quotients import Root


@dataclass
class Partial:
    """A condition on its way: at every sample, and symbolic, which is made only where it is asked
    for.
    """

    make: Callable[[], Condition]
    sampled: list[Condition]
    steps: list[tuple[str, fmpq_mpoly, fmpq_mpoly]] = field(default_factory=list)
    roots: list[Root] = field(default_factory=list)

    @cached_property
    def condition(self) -> Condition:
        """The condition on base and unknowns."""
        return self.make()
