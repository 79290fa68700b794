"""The votes of the routes named, on one statement."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from juggleproof.certificates import checker
from juggleproof.statements.vote import Vote, VoteBudget, compare
from juggleproof.votes import boxes, z3
from juggleproof.votes.questions import questions

ROUTES = {"z3": z3, "boxes": boxes}


def cast_votes(
    statement: checker.Statement,
    outcome: str,
    routes: Sequence[str] = tuple(ROUTES),
    budget: VoteBudget | None = None,
    earlier: Mapping[str, checker.Statement] | None = None,
) -> tuple[Vote, ...]:
    """One vote for each of the routes named that casts any ("z3", "boxes"), on a statement of the
    checker with its checked outcome.

    `earlier` gives the statements that a sharp range names.  Raises Disagreement where a vote
    contradicts the outcome or another vote.
    """
    asked = questions(statement, earlier)
    votes = tuple(
        ROUTES[route].vote(statement, earlier, budget, asked) for route in routes if route in ROUTES
    )
    compare(statement.name, outcome, votes)
    return votes
