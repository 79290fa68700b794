"""How strong a counterexample is: whether it lies within what its section assumes, and whether a
strict inequality fails strictly there.

The checker takes any values at which a statement fails.  A reader is convinced by those that meet
what the section assumes, and by 1 < 0 rather than by 0 < 0.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from juggleproof.certificates import checker
from juggleproof.judging.evaluating import Point, is_true_at
from juggleproof.statements.definitions import formula_of
from juggleproof.statements.formulas import Formula, names_in
from juggleproof.statements.language import Statement

LOOSE, TIGHT = {"<": "<=", ">": ">="}, {"<=": "<", ">=": ">"}


class Strength(NamedTuple):
    """The strength of a counterexample; a stronger one compares as greater."""

    within: bool
    strict: bool


UNSEEN = Strength(True, False)  # where no rational point tells
STRENGTHS = (Strength(True, True), Strength(True, False), Strength(False, True))  # strongest first


def loosened(goal: Formula) -> Formula:
    """The goal with `<=` for `<`, which follows from it: where this fails too, the goal fails
    strictly.  A premise and an equivalence stay as they are.

    >>> from juggleproof.statements.language import reals
    >>> x, y = reals("x y")
    >>> print(loosened((x < y) & ~(y <= 0)))
    x <= y and not y < 0
    """
    return _with_relations(goal, LOOSE, TIGHT)


def _with_relations(
    formula: Formula, relations: dict[str, str], under_not: dict[str, str]
) -> Formula:
    match formula.op:
        case "not":
            return Formula("not", _with_relations(formula.parts[0], under_not, relations))
        case "and" | "or":
            parts = (_with_relations(part, relations, under_not) for part in formula.parts)
            return Formula(formula.op, *parts)
        case "implies":
            premise, conclusion = formula.parts
            return Formula("implies", premise, _with_relations(conclusion, relations, under_not))
    return Formula(relations.get(formula.op, formula.op), *formula.args)


def strength_of(text: str, point: Point, assumed: Sequence[Formula]) -> Strength:
    """The strength of a point at which the statement of this text fails, in a section that assumes
    these formulas.

    >>> from fractions import Fraction
    >>> text = "statement demo/falls\\nforall x\\nshow x^2 < x"
    >>> strength_of(text, {"x": Fraction(1)}, ())
    Strength(within=True, strict=False)
    """
    lines = [line.partition(" ")[::2] for line in text.splitlines()]
    goals = (formula_of(checker.parse(one)) for word, one in lines if word == "show")
    return Strength(
        all(is_true_at(str(one), point) is not False for one in assumed),
        any(is_true_at(str(loosened(one)), point) is False for one in goals),
    )


def refuted_more_strongly(
    statement: Statement, assumed: Sequence[Formula], than: Strength
) -> Iterator[Statement]:
    """Statements whose counterexamples refute this statement too, and are stronger than this
    strength: what the section assumes is given, or the goal is loosened, or both.
    """
    given = tuple(("given", one) for one in assumed if names_in(one) <= {*statement.forall})
    for strength in STRENGTHS:
        if strength > than:
            yield replace(
                statement,
                lines=(*statement.lines, *(given if strength.within else ())),
                show=loosened(statement.show) if strength.strict else statement.show,
            )
