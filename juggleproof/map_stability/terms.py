"""Terms and formulas as text, evaluated in arrays of floats, in exact rationals, or in SymPy."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from functools import lru_cache, reduce
from typing import Any

import numpy as np
import sympy
from numpy.typing import NDArray

from juggleproof.certificates import checker
from juggleproof.encoding import from_sympy
from juggleproof.statements.cases import checker_text
from juggleproof.statements.definitions import formula_of
from juggleproof.statements.language import ClaimError

Expr = Any  # of SymPy, which has no types
Value = Any  # a float array, a Fraction or an Expr: whatever a text is evaluated in
Point = Mapping[str, Value]

OPERATORS: Mapping[type, Callable[[Value, Value], Value]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}


NEGATED: Mapping[type, str] = {ast.Lt: ">=", ast.LtE: ">", ast.Gt: "<=", ast.GtE: "<"}


unparsed = lru_cache(4096)(ast.unparse)


def value(text: str, point: Point) -> Value:
    """The value of a term."""
    return term_value(checker.parse(text), point, Fraction)


def column(term: str, points: Point, count: int) -> NDArray[np.float64]:
    """Return the values of a term at `count` points."""
    return np.broadcast_to(np.asarray(value(term, points), float), (count,))


def holds(text: str, point: Point) -> Value:
    """Return whether a formula holds, for each state of an array."""
    return formula_holds(checker.parse(text), point, {})


def expression(text: str) -> Expr:
    """A term in SymPy, with real symbols."""
    names = {name: sympy.Symbol(name, real=True) for name in checker.names_in(text)}
    return term_value(checker.parse(text), names, sympy.Integer)


@lru_cache(4096)
def written(term: Expr) -> str:
    """A rational SymPy expression as text, one quotient at most."""
    above, below = sympy.fraction(sympy.factor_terms(sympy.together(term)))
    if below.could_extract_minus_sign():
        above, below = -above, -below
    quotient = from_sympy(above) / from_sympy(below) if below != 1 else from_sympy(above)
    return str(quotient)


def term_value(node: ast.expr, point: Point, number: Callable[[int], Value]) -> Value:
    if isinstance(node, ast.Name):
        return point[node.id]
    if isinstance(node, ast.Constant):
        return number(int(str(node.value)))
    if isinstance(node, ast.UnaryOp):
        return -term_value(node.operand, point, number)
    if not isinstance(node, ast.BinOp):
        raise ClaimError(f"{ast.unparse(node)} is no rational term")
    left = term_value(node.left, point, number)
    if isinstance(node.op, ast.Pow):
        return left ** int(ast.literal_eval(node.right))
    right = term_value(node.right, point, number)
    if isinstance(left, np.ndarray) or isinstance(right, np.ndarray):
        left, right = (float(v) if isinstance(v, Fraction) else v for v in (left, right))
    return OPERATORS[type(node.op)](left, right)


def formula_holds(node: ast.expr, point: Point, known: dict[str, Value]) -> Value:
    """Return whether a formula holds; the values of its comparisons are kept in `known`."""
    if isinstance(node, ast.Compare):
        text = unparsed(node)
        if text not in known:
            known[text] = _compared(node, point)
        return known[text]
    if isinstance(node, ast.BoolOp):
        join = operator.and_ if isinstance(node.op, ast.And) else operator.or_
        return reduce(join, (formula_holds(part, point, known) for part in node.values))
    if isinstance(node, ast.UnaryOp):
        return np.logical_not(formula_holds(node.operand, point, known))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        first, second = (formula_holds(part, point, known) for part in node.args)
        if node.func.id == "iff":
            return np.equal(first, second)
        return np.logical_or(np.logical_not(first), second)
    raise ClaimError(f"{ast.unparse(node)} is no formula")


def _compared(node: ast.Compare, point: Point) -> Value:
    sides = [term_value(side, point, Fraction) for side in (node.left, *node.comparators)]
    if _floats(point):
        sides = [float(side) if isinstance(side, Fraction) else side for side in sides]
    parts = [OPERATORS[type(op)](a, b) for op, a, b in zip(node.ops, sides, sides[1:])]
    return reduce(operator.and_, parts)


def _floats(point: Point) -> bool:
    return any(isinstance(v, np.ndarray) for v in point.values())


def atoms(text: str) -> list[tuple[Expr, bool]]:
    """The polynomials or quotients that a conjunction says to be >= 0, each with whether it says
    > 0.  Parts that are no inequalities are left out.
    """
    return list(_atoms(checker.parse(text)))


def _atoms(node: ast.expr) -> Iterable[tuple[Expr, bool]]:
    if isinstance(node, ast.BoolOp) and isinstance(node.op, ast.And):
        for part in node.values:
            yield from _atoms(part)
    elif isinstance(node, ast.Compare):
        sides = [expression(checker_text(side)) for side in (node.left, *node.comparators)]
        for op, left, right in zip(node.ops, sides, sides[1:]):
            if isinstance(op, (ast.Lt, ast.LtE)):
                yield sympy.expand(right - left), isinstance(op, ast.Lt)
            elif isinstance(op, (ast.Gt, ast.GtE)):
                yield sympy.expand(left - right), isinstance(op, ast.Gt)


def conjuncts(text: str) -> list[str]:
    """The parts of a conjunction, or the formula itself."""
    node = checker.parse(text)
    if isinstance(node, ast.BoolOp) and isinstance(node.op, ast.And):
        return [inner for part in node.values for inner in conjuncts(checker_text(part))]
    return [str(formula_of(node))]


def as_factor(text: str) -> str:
    """The term as a factor."""
    return text if text.isidentifier() else f"({text})"


def negation(text: str) -> str:
    """Return the formula's negation; that of one inequality is an inequality.

    >>> negation("3 - a >= 0"), negation("a > 0 and a < 1")
    ('3 - a < 0', 'not (a > 0 and a < 1)')
    """
    node = checker.parse(text)
    if isinstance(node, ast.Compare) and len(node.ops) == 1 and type(node.ops[0]) in NEGATED:
        (op,), (right,) = node.ops, node.comparators
        return f"{checker_text(node.left)} {NEGATED[type(op)]} {checker_text(right)}"
    return f"not ({text})"


renamed = checker.put  # the text with other names in place of some


def symbols(names: Iterable[str]) -> list[Expr]:
    """The names as SymPy's real symbols."""
    return [sympy.Symbol(name, real=True) for name in names]
