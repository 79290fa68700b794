"""Values of terms and formulas at rational points, and the simple values that are tried first for a
counterexample; no proof rests on this file.
"""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from math import isqrt

from juggleproof.certificates import checker
from juggleproof.judging import limits
from juggleproof.statements.language import Statement, Term, equal, names_in, real, term
from juggleproof.statements.nodes import Counterexample

Point = Mapping[str, Fraction]
Ends = tuple[Fraction, Fraction]  # the ends of an interval; an exact number is both ends
ARITHMETIC: Mapping[type, Callable[[Fraction, Fraction], Fraction]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}
RELATIONS: Mapping[type, tuple[str, Callable[[Fraction, Fraction], bool]]] = {
    ast.Lt: ("<", operator.lt),
    ast.LtE: ("<=", operator.le),
    ast.Gt: (">", operator.gt),
    ast.GtE: (">=", operator.ge),
    ast.Eq: ("=", operator.eq),
    ast.NotEq: ("!=", operator.ne),
}


def value_at(text: str, point: Point) -> Fraction | None:
    """The value of a term, or None where a name has no value, or a divisor is 0.

    >>> str(value_at("alpha^2/(1 - beta)", {"alpha": Fraction(1, 2), "beta": Fraction(0)}))
    '1/4'
    """
    try:
        return _value(checker.parse(text), point)
    except (KeyError, ZeroDivisionError):
        return None


def is_true_at(text: str, point: Point) -> bool | None:
    """Whether a formula is true, or None where a name has no value, or a divisor is 0.

    >>> is_true_at("a > 0 and iff(a < 1, a^2 < a)", {"a": Fraction(1, 2)})
    True
    """
    try:
        return _is_true(checker.parse(text), point)
    except (KeyError, ZeroDivisionError):
        return None


def numbers_at(text: str, point: Point) -> str:
    """The numbers that make a formula false at the point: in the first part that fails, or on both
    sides of an implication or equivalence; empty where they cannot be computed.

    >>> point = {"a": Fraction(1, 2)}
    >>> numbers_at("a > 0 and a^2 >= a", point), numbers_at("iff(a < 1, a < 0)", point)
    ('1/4 >= 1/2', '1/2 < 1 is true, and 1/2 < 0 false')
    """
    try:
        return _numbers(checker.parse(text), point)
    except (KeyError, ZeroDivisionError):
        return ""


def _value(node: ast.AST, point: Point) -> Fraction:
    if isinstance(node, ast.Name):
        return point[node.id]
    if isinstance(node, ast.Constant):
        return Fraction(str(node.value))
    if isinstance(node, ast.UnaryOp):
        return -_value(node.operand, point)
    if not isinstance(node, ast.BinOp):
        raise KeyError(ast.dump(node))
    left, right = _value(node.left, point), _value(node.right, point)
    if isinstance(node.op, ast.Pow):
        return Fraction(left ** int(right))
    return ARITHMETIC[type(node.op)](left, right)


def _is_true(node: ast.AST, point: Point) -> bool:
    if isinstance(node, ast.Compare):
        sides = [_value(side, point) for side in (node.left, *node.comparators)]
        signs = [RELATIONS[type(sign)][1] for sign in node.ops]
        return all(sign(a, b) for sign, a, b in zip(signs, sides, sides[1:]))
    if isinstance(node, ast.BoolOp):
        parts = [_is_true(part, point) for part in node.values]
        return all(parts) if isinstance(node.op, ast.And) else any(parts)
    if isinstance(node, ast.UnaryOp):
        return not _is_true(node.operand, point)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        first, second = (_is_true(part, point) for part in node.args)
        return first == second if node.func.id == "iff" else not first or second
    raise KeyError(ast.dump(node))


def _numbers(node: ast.AST, point: Point) -> str:
    if isinstance(node, ast.Compare):
        shown = str(_value(node.left, point))
        for sign, side in zip(node.ops, node.comparators):
            shown += f" {RELATIONS[type(sign)][0]} {_value(side, point)}"
        return shown
    if isinstance(node, ast.BoolOp):
        failing = [part for part in node.values if not _is_true(part, point)]
        shown_parts = [_numbers(part, point) for part in failing]
        return shown_parts[0] if isinstance(node.op, ast.And) else " or ".join(shown_parts)
    if isinstance(node, ast.Call):
        first, second = node.args
        if _is_true(first, point) == _is_true(second, point):
            raise KeyError("not false there")
        words = ["true" if _is_true(part, point) else "false" for part in (first, second)]
        return (
            f"{_all_numbers(first, point)} is {words[0]}, and {_all_numbers(second, point)}"
            f" {words[1]}"
        )
    if isinstance(node, ast.UnaryOp):
        return f"yet {_all_numbers(node.operand, point)}"
    raise KeyError(ast.dump(node))


def _all_numbers(node: ast.AST, point: Point) -> str:
    """The formula with each side of a relation replaced by its value."""
    if isinstance(node, ast.BoolOp):
        word = " and " if isinstance(node.op, ast.And) else " or "
        return word.join(_all_numbers(part, point) for part in node.values)
    if not isinstance(node, ast.Compare):
        raise KeyError(ast.dump(node))
    return _numbers(node, point)


# -------------------------------------------------------------------------------------------------
# Terms at values that are known only between rational ends, such as roots.


def ends_of(node: ast.AST, point: Mapping[str, Ends]) -> Ends:
    """The ends between which a term lies, by interval arithmetic; both are its value where its
    names have exact values.  Raises KeyError for a name without ends, ZeroDivisionError for a
    divisor that may be 0.

    >>> root_of_2 = {"z": (Fraction(7, 5), Fraction(3, 2))}
    >>> [str(end) for end in ends_of(checker.parse("1 - z^2"), root_of_2)]
    ['-5/4', '-24/25']
    """
    if isinstance(node, ast.Name):
        return point[node.id]
    if isinstance(node, ast.UnaryOp):
        low, high = ends_of(node.operand, point)
        return -high, -low
    if not isinstance(node, ast.BinOp):
        value = _value(node, {})
        return value, value
    left = ends_of(node.left, point)
    if isinstance(node.op, ast.Pow):
        power = ast.literal_eval(node.right)
        inner = [Fraction(0)] if left[0] < 0 < left[1] else []
        values = [Fraction(end**power) for end in (*left, *inner)]
        return min(values), max(values)
    right = ends_of(node.right, point)
    if isinstance(node.op, ast.Div) and right[0] <= 0 <= right[1]:
        raise ZeroDivisionError
    values = [ARITHMETIC[type(node.op)](a, b) for a in left for b in right]
    return min(values), max(values)


def is_surely(truth: bool, node: ast.AST, point: Mapping[str, Ends]) -> bool:
    """Whether a formula of relations, `and`, `or` and `not` has this truth value for all values
    between these ends.

    >>> root_of_2 = {"z": (Fraction(7, 5), Fraction(3, 2))}
    >>> formula = checker.parse("z^2 <= 1 or not z < 2")
    >>> is_surely(False, formula, root_of_2), is_surely(False, checker.parse("z^2 < 2"), root_of_2)
    (True, False)
    """
    if isinstance(node, ast.BoolOp):
        each = (is_surely(truth, part, point) for part in node.values)
        return all(each) if truth == isinstance(node.op, ast.And) else any(each)
    if isinstance(node, ast.UnaryOp):
        return is_surely(not truth, node.operand, point)
    if not isinstance(node, ast.Compare):
        return False
    ends = [ends_of(side, point) for side in (node.left, *node.comparators)]
    each = (
        _is_surely_related(truth, type(sign), a, b) for sign, a, b in zip(node.ops, ends, ends[1:])
    )
    return all(each) if truth else any(each)


def _is_surely_related(truth: bool, sign: type, left: Ends, right: Ends) -> bool:
    if sign in (ast.Eq, ast.NotEq):
        apart = left[1] < right[0] or right[1] < left[0]
        return apart if truth == (sign is ast.NotEq) else len({*left, *right}) == 1
    return all(RELATIONS[sign][1](a, b) == truth for a in left for b in right)


# -------------------------------------------------------------------------------------------------
# Counterexamples in simple rationals: the parameter first gets simple values at which the roots of
# the statement are rational too.


def is_simple(found: Counterexample) -> bool:
    """Whether all values of the counterexample are rationals of small height."""
    numbers = [int(digits) for text in found.terms.values() for digits in re.findall(r"\d+", text)]
    return not found.adjoined and max(numbers, default=0) <= limits.PLAIN


def at_simple_values(
    statement: Statement, parameter: str, roots: Iterable[Term]
) -> Iterator[Statement]:
    """The statement with one more given, parameter = value, for simple values, the simplest first,
    at which the square roots of those terms that are in the parameter alone are rational.
    """
    under = [str(one) for one in roots if names_in(one) == {parameter}]
    values = sorted(
        {Fraction(p, q) for q in range(2, limits.TRIAL_DENOMINATOR + 1) for p in range(1, q)},
        key=_size,
    )
    tried = 0
    for value in values:
        squares = [value_at(text, {parameter: value}) for text in under]
        if tried < limits.TRIAL_VALUES and all(
            square is None or _is_square(square) for square in squares
        ):
            tried += 1
            given = ("given", equal(real(parameter), term(value)))
            yield replace(statement, lines=(*statement.lines, given))


def _size(value: Fraction) -> tuple[int, int]:
    return value.denominator, value.numerator


def _is_square(value: Fraction) -> bool:
    return value >= 0 and all(isqrt(n) ** 2 == n for n in value.as_integer_ratio())
