"""The value of our terms and formulas at a rational point, by the definition of each operation."""

from __future__ import annotations

import operator
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

from juggleproof.statements.language import RELATIONS, Formula, Term

COMPARE = {
    "<": operator.lt,
    "<=": operator.le,
    "=": operator.eq,
    "!=": operator.ne,
    ">=": operator.ge,
    ">": operator.gt,
}
COMPUTE = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "^": operator.pow,
}


def value(term: Term, point: Mapping[str, Fraction]) -> Fraction:
    """The value of a term."""
    if term.op == "var":
        return point[term.args[0]]
    if term.op == "num":
        return Fraction(term.args[0])
    if term.op == "neg":
        return -value(term.args[0], point)
    right = term.args[1] if term.op == "^" else value(term.args[1], point)
    return Fraction(COMPUTE[term.op](value(term.args[0], point), right))


def truth(formula: Formula, point: Mapping[str, Fraction]) -> bool:
    """Whether a formula holds."""
    if formula.op in RELATIONS:
        return bool(
            COMPARE[formula.op](value(formula.args[0], point), value(formula.args[1], point))
        )
    if formula.op in ("true", "false"):
        return formula.op == "true"
    parts = [truth(part, point) for part in formula.args]
    return {
        "not": lambda: not parts[0],
        "and": lambda: all(parts),
        "or": lambda: any(parts),
        "implies": lambda: not parts[0] or parts[1],
        "iff": lambda: parts[0] == parts[1],
    }[formula.op]()


def atoms(formula: Formula) -> Iterator[Formula]:
    """The relations in a formula."""
    if formula.op in RELATIONS:
        yield formula
    else:
        for part in formula.args:
            yield from atoms(part)


def differences(formula: Formula, point: Mapping[str, Fraction]) -> set[Any]:
    """left - right of every relation."""
    return {value(one.args[0], point) - value(one.args[1], point) for one in atoms(formula)}
