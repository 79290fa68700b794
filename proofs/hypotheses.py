"""What the hypotheses of a statement say: nothing, where they contradict one another; the whole
range of alpha, or a part of it."""

from __future__ import annotations

import ast
from dataclasses import replace
from functools import cache
from typing import Any

from certificates import checker
from certificates.search.budget import Budget, Exhausted
from certificates.statements import Statement
from certificates.terms import ClaimError, Formula, disjunction


def read(text: str, name: str) -> checker.Statement:
    """The statement as the checker reads it."""
    statement: checker.Statement = checker.read_statements(text)[name]
    return statement


def refuse_what_says_nothing(
    statement: Statement, outcome: str, known: dict[str, checker.Statement], budget: int
) -> None:
    """Raises ClaimError where the hypotheses of a statement contradict one another, or do not keep
    a denominator from vanishing."""
    from certificates.search.certificate import search_certificate
    from certificates.search.closing import search_closing

    def settles(part: Statement, outcome: str) -> bool:
        try:
            return outcome in search_certificate(
                read(part.text(), part.name), known, Budget(budget)
            )
        except Exhausted:
            return False

    for index, (keyword, said) in enumerate(statement.lines):
        if keyword == "have" and isinstance(said, Formula):
            before = Statement(
                statement.name, statement.forall, statement.lines[:index], said, statement.integer
            )
            if settles(before, "refuted"):
                raise ClaimError(
                    f"{statement.name}: division by what may vanish ({said} does not follow); "
                    "add a given that keeps it from 0"
                )
    if outcome == "refuted":
        return
    impossible = Statement(
        statement.name, statement.forall, statement.lines, disjunction([]), statement.integer
    )
    story = checker.Unfolding(read(impossible.text(), impossible.name), checker.Context())
    try:
        impossible_for_all = search_closing(checker.state_of(story), known, Budget(budget)) is not None
    except Exhausted:
        impossible_for_all = False
    if impossible_for_all:
        raise ClaimError(
            f"{statement.name}: its hypotheses contradict one another, so it would say nothing;"
            " drop or mend a given"
        )


def speaks_of_range(statement: Statement) -> bool:
    """Whether a statement is about a range of alpha: by range lines, or by givens that say 0 <
    alpha < 1."""
    if any(keyword == "range" for keyword, _ in statement.lines):
        return True
    given = [
        ("range", said)
        for keyword, said in statement.lines
        if keyword == "given" and _names_of(str(said)) == {"alpha"}
    ]
    return bool(given) and has_whole_range(replace(statement, lines=tuple(given)))


def has_whole_range(statement: Statement) -> bool:
    """Whether the range lines say 0 < alpha < 1 and nothing else, however they are written."""
    return _is_whole_range(
        statement.forall,
        tuple(str(formula) for keyword, formula in statement.lines if keyword == "range"),
    )


@cache
def _names_of(text: str) -> set[str]:
    return {node.id for node in ast.walk(checker.parse(text)) if isinstance(node, ast.Name)}


@cache
def _is_whole_range(variables: tuple[str, ...], said: tuple[str, ...]) -> bool:
    context = checker.Context()
    for name in variables:
        context.declare(name)
    whole = ["alpha > 0", "alpha < 1"] if "alpha" in variables else []
    return _atoms(context, [checker.parse(text) for text in said]) == _atoms(
        context, [checker.parse(text) for text in whole]
    )


def _atoms(context: checker.Context, trees: list[Any]) -> set[Any]:
    """The atoms of a conjunction, each as its primitive polynomial and relation; anything else as
    itself."""
    joined = checker.join("and", [context.formula(tree) for tree in trees])
    parts = [joined] if isinstance(joined, bool) or joined[0] != "and" else joined[1]
    found: set[Any] = set()
    for part in parts:
        if isinstance(part, bool) or part[0] != "atom":
            found.add(repr(part))
        else:
            content, primitive = part[1].primitive()
            found.add((tuple(sorted(primitive.terms.items())), content > 0, part[2]))
    return found
