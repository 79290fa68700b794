"""Sharp ranges of alpha, read from the text that tells them into intervals that can be drawn."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from scenes.figures.ranges import Interval, Row

WITHOUT_ALPHA = "no alpha"
NUMBERS_SHOWN = (2, 3)  # what is put for K or n, where the range depends on one
_READING = re.compile(r"([A-Za-z][\w-]*): (.*)", re.DOTALL)
_END = re.compile(r"(c\d+) = (-?\d+\.\d+)\.\.\., a root of .*", re.DOTALL)
_POINT = re.compile(r"alpha = (.+)")
_BETWEEN = re.compile(r"(.+?) (<=?) alpha (<=?) (.+)")
_WHOLE_NUMBER = re.compile(r"(.*) for a whole number ([A-Za-z]\w*)")


def rows(entries: Iterable[Any]) -> list[Row]:
    """A row for each range of each claim that speaks of alpha; entries as `contents` gathers
    them.
    """
    return [
        (f"{entry.claim.id} ({label})" if label else entry.claim.id, entry.verdict, intervals)
        for entry in entries
        if entry.sharp != WITHOUT_ALPHA
        for label, intervals in read(entry.sharp)
    ]


def without_alpha(entries: Iterable[Any]) -> int:
    """The number of claims in which alpha does not occur."""
    return sum(entry.sharp == WITHOUT_ALPHA for entry in entries)


def read(text: str) -> list[tuple[str, list[Interval] | None]]:
    """Each reading's intervals, with its label; one for each number put for K or n; None where the
    range cannot be drawn.

    >>> read("0 < alpha < 1/3")
    [('', [(Fraction(0, 1), Fraction(1, 3), False, False)])]
    >>> several = read("K/(K + 2) <= alpha < 1; as-in-11: nowhere")
    >>> [(label, [str(one[1]) for one in intervals]) for label, intervals in several]
    [('K = 2', ['1']), ('K = 3', ['1']), ('as-in-11', [])]
    >>> read("sampled: not found")
    [('sampled', None)]
    """
    told: list[tuple[str, str, dict[str, Fraction]]] = []
    for piece in text.split("; "):
        end, reading = _END.fullmatch(piece), _READING.fullmatch(piece)
        if end and told:
            told[-1][2][end[1]] = Fraction(end[2])
        else:
            told.append((reading[1], reading[2], {}) if reading else ("", piece, {}))
    return [
        (", ".join(part for part in (label, name) if part), intervals)
        for label, said, ends in told
        for name, intervals in _for_each_number(said, ends)
    ]


def _for_each_number(
    said: str, ends: Mapping[str, Fraction]
) -> list[tuple[str, list[Interval] | None]]:
    stated = _WHOLE_NUMBER.fullmatch(said)
    said, number = (stated[1], stated[2]) if stated else (said, "K")
    if not re.search(rf"\b{number}\b", said):
        return [("", _intervals(said, ends))]
    return [
        (f"{number} = {one}", _intervals(said, {**ends, number: Fraction(one)}))
        for one in NUMBERS_SHOWN
    ]


def _intervals(said: str, values: Mapping[str, Fraction]) -> list[Interval] | None:
    if said == "nowhere":
        return []
    found = []
    for piece in said.split(" or "):
        point, between = _POINT.fullmatch(piece), _BETWEEN.fullmatch(piece)
        try:
            if point:
                number = _value(point[1], values)
                found.append((number, number, True, True))
            elif between:
                found.append(
                    (
                        _value(between[1], values),
                        _value(between[4], values),
                        between[2] == "<=",
                        between[3] == "<=",
                    )
                )
            else:
                return None
        except (SyntaxError, LookupError, ZeroDivisionError):
            return None
    return found


def _value(text: str, values: Mapping[str, Fraction]) -> Fraction:
    """The value of an end: whole numbers, names, + - * / and parentheses, walked as a tree;
    LookupError for anything else.
    """
    return _walk(ast.parse(text, mode="eval").body, values)


def _walk(node: ast.expr, values: Mapping[str, Fraction]) -> Fraction:
    if isinstance(node, ast.Constant) and type(node.value) is int:
        return Fraction(node.value)
    if isinstance(node, ast.Name):
        return values[node.id]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -_walk(node.operand, values)
    if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub, ast.Mult, ast.Div)):
        left, right = _walk(node.left, values), _walk(node.right, values)
        kind = type(node.op)
        return (
            left + right
            if kind is ast.Add
            else (
                left - right
                if kind is ast.Sub
                else left * right
                if kind is ast.Mult
                else left / right
            )
        )
    raise LookupError(ast.dump(node))
