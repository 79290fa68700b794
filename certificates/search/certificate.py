"""The certificate of one statement: a proof with a point, a counterexample, or the reason why neither was found."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from certificates import checker

from .budget import Budget, Exhausted, accepted
from .closing import Hints, search_closing
from .stories import unfolded

Certificate = dict[str, Any]


def search_certificate(statement: checker.Statement, known: dict[str, checker.Statement], budget: Budget,
                       hints: Hints | None = None) -> Certificate:
    """{"certified": .., "point": ..}, {"refuted": ..} or {"unknown": reason}, each accepted by the checker."""
    try:
        for deep, effort in ((0, 1), (1, 2)):  # of the refutation, and of the proof after it
            refuted = found(statement, "counterexample", known, budget, deep)
            if refuted is not None:
                return {"refuted": refuted}
            proof = search_proof(statement, known, budget, effort=effort, hints=hints)
            if proof is None:
                continue
            if not statement.get("forall"):
                return {"certified": proof}
            for depth in (0, 1, 2):
                point = found(statement, "point", known, budget, depth)
                if point is not None:
                    return {"certified": proof, "point": point}
            return {"unknown": "proved, but no point was found that meets the hypotheses"}
        refuted = found(statement, "counterexample", known, budget, 2)
        if refuted is not None:
            return {"refuted": refuted}
    except Exhausted:
        return {"unknown": "the budget of counted work ran out"}
    return {"unknown": "neither a proof nor a counterexample was found"}


def found(statement: checker.Statement, purpose: str, known: dict[str, checker.Statement], budget: Budget, effort: int) -> list[Any] | None:
    """A point or counterexample of the statement."""
    points = import_module("certificates.search.points")
    result: list[Any] | None = points.search_found(statement, checker.State(checker.Context()), purpose, {}, known, budget, effort=effort)
    return result


def search_proof(statement: checker.Statement, known: dict[str, checker.Statement], budget: Budget, sharp: list[Any] | None = None,
                 effort: int = 2, hints: Hints | None = None) -> list[Any] | None:
    """["proof" | "witness", nodes of the side conditions, last] that the checker accepts, or None."""
    story = unfolded(statement, sharp)
    steps = []
    for count, negation in story.obligations:
        node = search_closing(story.state(count).assume(negation), known, budget, effort, hints, confirm=False)
        if node is None:
            return None
        steps.append(node)
    if statement.get("exists"):
        points = import_module("certificates.search.points")
        base = {name: story.context.values[name] for name in story.universal}
        last = points.search_found(statement, story.state(), "witness", base, known, budget, sharp=sharp, effort=effort)
        proof = ["witness", steps, last]
    else:
        last = search_closing(story.state().assume(story.goal(False)), known, budget, effort, hints, confirm=False)
        proof = ["proof", steps, last]
    return proof if last is not None and accepted(checker.prove, statement, proof, known, sharp) else None
