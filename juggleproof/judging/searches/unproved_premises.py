"""The reason why a premise of a map rule has no proof: values where it is false, or Z3's answer."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from fractions import Fraction

from juggleproof.algebra.numbers import AlgebraicNumber
from juggleproof.certificates import checker
from juggleproof.judging.conclusions import meaning
from juggleproof.judging.evaluating import Ends, ends_of, is_surely
from juggleproof.statements.definitions import formula_of
from juggleproof.statements.vote import Vote
from juggleproof.votes.z3 import Model

LONGEST, LONGEST_NUMBER = 80, 24  # characters of a formula, and of a number, in a line
BITS, PLACES = 64, 6  # bits of the enclosure of an irrational value, and its decimals in a line
MORE = 10  # the factor by which a larger budget is proposed


def why(
    kind: str,
    name: str,
    premise: checker.Statement,
    answer: tuple[Vote, Model | None],
    budget: int,
    cut: bool = True,
) -> str:
    """A line on a premise for which no proof was found within the budget, from Z3's answer; `cut`
    says whether the budget ended the search.
    """
    vote, model = answer
    about = f"{name}, {meaning(kind, name)}:"
    if model is not None:
        # a root that is not known to exist has no value
        names = model.point if model.part == "goal" else premise.get("forall")[0]
        values = ", ".join(f"{one} = {_value(model.point[one])}" for one in names)
        numbers = _numbers(premise, model)
        parts = ["false", f" at {values}" * bool(values), f", where {numbers}" * bool(numbers)]
        return f"{about} {''.join(parts)}"
    if vote.answer == "fails":
        return f"{about} Z3 says that it is false"
    says = "Z3 says that it holds" if vote.answer == "holds" else "Z3 gives no answer"
    if not cut:
        return f"{about} {says}; no certificate was found, and not for want of budget"
    return (
        f"{about} {says}; no certificate was found within the budget: try --budget"
        f" {MORE * budget}, or a lemma"
    )


def _value(value: Fraction | AlgebraicNumber) -> str:
    if isinstance(value, Fraction):
        return str(value)
    return f"about {value.decimal(PLACES)} (a root of {value.polynomial_text('z')})"


def _numbers(premise: checker.Statement, model: Model) -> str:
    """The relation that is false at the values, with the numbers on its two sides; empty where that
    is 0 = 1, or where the enclosures of irrational values do not decide it.
    """
    point = {
        name: (value, value) if isinstance(value, Fraction) else value.enclosure(BITS)
        for name, value in model.point.items()
    }
    obligations = 0
    try:
        for keyword, line in premise.lines:
            if keyword == "let":
                point[line[0]] = ends_of(line[1], point)
            elif keyword == "show":
                return _false_part(line, point)
            elif keyword in ("have", "root"):
                obligations += 1
                if model.part != f"obligation {obligations}":
                    continue
                if keyword == "have":
                    return _false_part(line, point)
                name, (under,) = line
                defined = ast.Compare(under, [ast.GtE()], [ast.Constant(0)])
                return f"under the root {name}, {_false_part(defined, point)}"
    except ZeroDivisionError:  # the enclosures are not narrow enough
        return ""
    return ""


def _false_part(node: ast.expr, point: Mapping[str, Ends]) -> str:
    """The first false part of a conjunction, or all parts of a false disjunction."""
    if not is_surely(False, node, point):
        return ""
    if isinstance(node, ast.BoolOp):
        parts = list(filter(None, (_false_part(part, point) for part in node.values)))
        return ", ".join(parts if isinstance(node.op, ast.Or) else parts[:1])
    if not isinstance(node, ast.Compare):
        return f"{formula_of(node)} is false"
    sides = [node.left, *node.comparators]
    pairs = (
        ast.Compare(left, [sign], [right]) for left, sign, right in zip(sides, node.ops, sides[1:])
    )
    pair = next(one for one in pairs if is_surely(False, one, point))
    relation = formula_of(pair)
    if not checker.names_in(str(relation)):
        return "" if str(relation) == "0 = 1" else f"{relation} is false"
    left, right = (_number(ends_of(side, point)) for side in (pair.left, *pair.comparators))
    numbers = f"{left} {relation.op} {right}"
    return f"{relation} comes to {numbers}" if len(str(relation)) <= LONGEST else numbers


def _number(ends: Ends) -> str:
    if ends[0] == ends[1] and len(str(ends[0])) <= LONGEST_NUMBER:
        return str(ends[0])
    return f"about {AlgebraicNumber.rational(ends[0]).decimal(PLACES)}"
