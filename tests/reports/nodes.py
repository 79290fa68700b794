"""What a text says, as a tree, and its exact value at rational points: common to both readers of
the tests of reports.

Nothing here knows how a text is written; nothing here is shared with what prints or checks
statements.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, fields
from fractions import Fraction
from functools import cache
from math import ceil, floor, isqrt
from typing import Union

LARGEST_EXPONENT = 400


class NotRead(Exception):
    """A text that is not understood completely, or a tree without a value: where, and why."""

    def __init__(self, reason: str, position: int | None = None, source: str = "") -> None:
        where = "" if position is None else f"position {position}: "
        excerpt = (
            f", at {source[position : position + 30]!r}" if position is not None and source else ""
        )
        super().__init__(f"{where}{reason}{excerpt}")
        self.position, self.reason = position, reason


class Node:
    """A part of a text."""


class Term(Node):
    """A part that has a number as its value."""


class Formula(Node):
    """A part that is true or false."""


@dataclass(frozen=True)
class Num(Term):
    number: int


@dataclass(frozen=True)
class Name(Term):
    """A name as it is printed, and the names of the statement language that it may stand for:
    exactly one of them has a value.
    """

    printed: str
    stands_for: tuple[str, ...]


@dataclass(frozen=True)
class Neg(Term):
    of: Term


@dataclass(frozen=True)
class Arithmetic(Term):
    sign: str  # + - * / ^
    left: Term
    right: Term


@dataclass(frozen=True)
class Unary(Term):
    function: str  # sqrt floor ceil
    of: Term


@dataclass(frozen=True)
class Listed(Node):
    """A vector or a comma list; a matrix is a list of its rows."""

    entries: tuple[Node, ...]


@dataclass(frozen=True)
class Related(Formula):
    """left sign right, for a sign of the statement language: < <= > >= = !="""

    left: Term
    sign: str
    right: Term


@dataclass(frozen=True)
class Not(Formula):
    of: Formula


@dataclass(frozen=True)
class Joined(Formula):
    how: str  # and or
    parts: tuple[Formula, ...]


@dataclass(frozen=True)
class Implied(Formula):
    how: str  # implies iff
    left: Formula
    right: Formula


Value = Union[Fraction, bool, tuple["Value", ...]]
Root = Callable[[Fraction], Fraction]
HOLDS: dict[str, Callable[[Fraction, Fraction], bool]] = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "=": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
}


def exact_root(under: Fraction) -> Fraction:
    """The root of a rational square; nothing else has one here."""
    if under >= 0:
        root = Fraction(isqrt(under.numerator), isqrt(under.denominator))
        if root * root == under:
            return root
    raise NotRead(f"{under} is not the square of a rational number")


def chain(sides: list[Term], signs: list[str]) -> Formula:
    """a < b <= c: a < b and b <= c."""
    links = tuple(Related(a, sign, b) for a, sign, b in zip(sides, signs, sides[1:]))
    return links[0] if len(links) == 1 else Joined("and", links)


def children(node: Node) -> Iterator[Node]:
    for field in fields(node):  # type: ignore[arg-type]
        content = getattr(node, field.name)
        for part in content if isinstance(content, tuple) else (content,):
            if isinstance(part, Node):
                yield part


def names_in(node: Node) -> list[Name]:
    """The names in the order in which they are met, each once."""
    found = {node: None} if isinstance(node, Name) else {}
    for child in children(node):
        found |= dict.fromkeys(names_in(child))
    return list(found)


def value(
    node: Node,
    values: Mapping[str, Fraction],
    root: Root = exact_root,
    known: dict[int, Fraction] | None = None,
) -> Value:
    """The value of a tree: a number, a truth value, or a tuple of such.  Every part is evaluated,
    whatever the others say; `known` keeps the numbers that relations compare, by their nodes, for
    further trees at the same values.
    """
    known = {} if known is None else known
    if isinstance(node, Formula):
        return truth(node, values, root, known)
    if isinstance(node, Listed):
        return tuple(value(entry, values, root, known) for entry in node.entries)
    if isinstance(node, Term):
        return side(node, values, root, known)
    raise NotRead(f"not a tree: {node!r}")


def truth(
    node: Formula, values: Mapping[str, Fraction], root: Root, known: dict[int, Fraction]
) -> bool:
    if isinstance(node, Related):
        left, right = (side(one, values, root, known) for one in (node.left, node.right))
        return HOLDS[node.sign](left, right)
    if isinstance(node, Not):
        return not truth(node.of, values, root, known)
    if isinstance(node, Joined):
        parts = [truth(part, values, root, known) for part in node.parts]
        return all(parts) if node.how == "and" else any(parts)
    if isinstance(node, Implied):
        left, right = (truth(one, values, root, known) for one in (node.left, node.right))
        return left == right if node.how == "iff" else right or not left
    raise NotRead(f"not a formula: {node!r}")


def side(
    node: Term, values: Mapping[str, Fraction], root: Root, known: dict[int, Fraction]
) -> Fraction:
    if id(node) not in known:
        known[id(node)] = number(node, values, root)
    return known[id(node)]


def number(node: Term, values: Mapping[str, Fraction], root: Root) -> Fraction:
    if isinstance(node, Arithmetic):
        return operated(
            node.sign, number(node.left, values, root), number(node.right, values, root)
        )
    if isinstance(node, Num):
        return whole(node.number)
    if isinstance(node, Name):
        found = [name for name in node.stands_for if name in values]
        if len(found) != 1:
            count = "several of" if found else "none of"
            raise NotRead(
                f"{node.printed} has no one value: {count} {', '.join(node.stands_for)} is known"
            )
        return values[found[0]]
    if isinstance(node, Neg):
        return -number(node.of, values, root)
    if isinstance(node, Unary):
        under = number(node.of, values, root)
        return (
            root(under)
            if node.function == "sqrt"
            else Fraction({"floor": floor, "ceil": ceil}[node.function](under))
        )
    raise NotRead(f"not a term: {node!r}")


whole = cache(Fraction)  # of the numbers that are written


def operated(sign: str, left: Fraction, right: Fraction) -> Fraction:
    if sign == "+":
        return left + right
    if sign == "-":
        return left - right
    if sign == "*":
        return left * right
    if sign == "/":
        if right == 0:
            raise NotRead("division by zero")
        return left / right
    if sign == "^":
        if right.denominator != 1 or abs(right) > LARGEST_EXPONENT:
            raise NotRead(f"{right} is no exponent")
        if left == 0 and right < 0:
            raise NotRead("division by zero")
        return left ** int(right)
    raise NotRead(f"no operation: {sign}")
