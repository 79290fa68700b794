"""Votes on a statement by routes other than the certificate, and the error that is raised when one
of them contradicts the checker.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

AGREES = {"certified": "holds", "refuted": "fails"}
ANSWERS = ("holds", "fails", "unknown", "enclosed", "not applicable")


@dataclass(frozen=True)
class VoteBudget:
    """Counted work for one statement: Z3's resource units, boxes, and the width to which a bound is
    enclosed.

    The statements of this subject take Z3 under 20,000 units each (a few ms).  Above 500,000 a
    single unit can hide a resultant that takes minutes, which no count interrupts, so more is not
    better.
    """

    rlimit: int = 300_000
    boxes: int = 3_000
    width: Fraction = Fraction(1, 16)

    def times(self, factor: int) -> VoteBudget:
        """The budget with `factor` times as much work.

        >>> VoteBudget().times(3).boxes
        9000
        """
        return VoteBudget(self.rlimit * factor, self.boxes * factor, self.width)


@dataclass(frozen=True)
class VoteEnclosure:
    """low <= inf of the polynomial over the region <= high, both exact; `wanted` is the width that
    was asked for.
    """

    polynomial: str
    low: Fraction
    high: Fraction
    wanted: Fraction

    def __str__(self) -> str:
        return (
            f"{self.low} <= inf({self.polynomial}) <= {self.high} (width {self.high - self.low},"
            f" wanted {self.wanted})"
        )


@dataclass(frozen=True)
class Vote:
    """The answer of one route about one statement: `holds` or `fails` decide it; `unknown`,
    `enclosed` and `not applicable` do not.

    `model` is an exact point (name, value) at which the statement fails.
    """

    route: str
    answer: str
    detail: str
    work: int = 0
    model: tuple[tuple[str, str], ...] = ()
    enclosures: tuple[VoteEnclosure, ...] = ()

    @property
    def decided(self) -> bool:
        """Whether the answer is that the statement holds, or that it fails."""
        return self.answer in ("holds", "fails")

    def __str__(self) -> str:
        details = "; ".join([self.detail, *map(str, self.enclosures)])
        at = (
            " at " + ", ".join(f"{name} = {value}" for name, value in self.model)
            if self.model
            else ""
        )
        return f"{self.route} says {self.answer}{at} ({details})"


class Disagreement(Exception):
    """Two routes contradict each other about one statement; the message is one line with both
    sides.
    """

    def __init__(self, statement: str, first: str, second: str) -> None:
        super().__init__(f"{statement}: {first}, but {second}")
        self.statement, self.first, self.second = statement, first, second

    def __reduce__(self) -> tuple[type[Disagreement], tuple[str, str, str]]:
        return Disagreement, (self.statement, self.first, self.second)


def agree(statement: str, outcome: str, votes: Sequence[Vote]) -> bool:
    """Whether no vote contradicts the checked outcome or another vote."""
    try:
        compare(statement, outcome, votes)
    except Disagreement:
        return False
    return True


def compare(statement: str, outcome: str, votes: Sequence[Vote]) -> None:
    """Raises Disagreement where a vote contradicts the checked outcome or another vote.

    Formula: `holds` contradicts `refuted` and `fails`; `fails` contradicts `certified` and `holds`;
    nothing else contradicts.
    """
    checked = AGREES.get(outcome)
    sides = [(checked, f"the checked certificate says {outcome}")] if checked else []
    for vote in votes:
        if vote.decided:
            for answer, source in sides:
                if answer != vote.answer:
                    raise Disagreement(statement, source, str(vote))
            sides.append((vote.answer, str(vote)))
