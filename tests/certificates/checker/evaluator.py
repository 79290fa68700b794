"""A second reading of statements, sharing nothing with the checker: its own parser, values at
rational points as Fractions.

`holds_at(rows, point)` says whether a statement holds at one point; `None` says that the point
tells nothing (a premise fails there, or a root is no rational number).
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from fractions import Fraction

Point = Mapping[str, Fraction]
TOKEN = re.compile(r"\s*(<=|>=|!=|[-+*/^()<>=,]|\d+|[A-Za-z]\w*)")
RELATIONS = ("<=", ">=", "!=", "<", ">", "=")


class Reader:
    """Recursive descent straight to values: or < and < not < relations < sums < products < minus <
    powers.
    """

    def __init__(self, text: str, point: Point) -> None:
        self.tokens, self.point, self.place = TOKEN.findall(text), point, 0
        if "".join(self.tokens) != text.replace(" ", ""):
            raise ValueError(f"cannot read {text!r}")

    def peek(self) -> str:
        return str(self.tokens[self.place]) if self.place < len(self.tokens) else ""

    def take(self, *wanted: str) -> str:
        token = self.peek()
        if not token or wanted and token not in wanted:
            raise ValueError(f"expected {wanted}, got {token!r}")
        self.place += 1
        return token

    def formula(self) -> bool:
        value = self.conjunction()
        while self.peek() == "or":
            self.take()
            value = self.conjunction() or value
        return value

    def conjunction(self) -> bool:
        value = self.negation()
        while self.peek() == "and":
            self.take()
            value = self.negation() and value
        return value

    def negation(self) -> bool:
        if self.peek() == "not":
            self.take()
            return not self.negation()
        start = self.place
        try:
            return self.relations()
        except ValueError:
            self.place = start
        if self.peek() in ("implies", "iff"):
            word = self.take()
            self.take("(")
            left = self.formula()
            self.take(",")
            right = self.formula()
            self.take(")")
            return (not left or right) if word == "implies" else left == right
        self.take("(")
        value = self.formula()
        self.take(")")
        return value

    def relations(self) -> bool:
        left, value = self.term(), True
        if self.peek() not in RELATIONS:
            raise ValueError("no relation")
        while self.peek() in RELATIONS:
            relation, right = self.take(), self.term()
            sign = (left > right) - (left < right)
            value = (
                value
                and sign
                in {"<": (-1,), "<=": (-1, 0), "=": (0,), "!=": (-1, 1), ">=": (0, 1), ">": (1,)}[
                    relation
                ]
            )
            left = right
        return value

    def term(self) -> Fraction:
        value = self.product()
        while self.peek() in ("+", "-"):
            value = value + self.product() if self.take() == "+" else value - self.product()
        return value

    def product(self) -> Fraction:
        value = self.signed()
        while self.peek() in ("*", "/"):
            value = value * self.signed() if self.take() == "*" else value / self.signed()
        return value

    def signed(self) -> Fraction:
        if self.peek() == "-":
            self.take()
            return -self.signed()
        value = self.atom()
        if self.peek() == "^":
            self.take()
            value = value ** int(self.take())
        return value

    def atom(self) -> Fraction:
        token = self.take()
        if token == "(":
            value = self.term()
            self.take(")")
            return value
        return Fraction(int(token)) if token.isdigit() else self.name(token)

    def name(self, token: str) -> Fraction:
        if token not in self.point:
            raise ValueError(f"no value for {token!r}")
        return self.point[token]


def term_at(text: str, point: Point) -> Fraction:
    """The value of a term."""
    reader = Reader(text, point)
    value = reader.term()
    if reader.peek():
        raise ValueError(f"left over: {reader.peek()!r}")
    return value


def formula_at(text: str, point: Point) -> bool:
    """The truth of a formula."""
    reader = Reader(text, point)
    value = reader.formula()
    if reader.peek():
        raise ValueError(f"left over: {reader.peek()!r}")
    return value


def rational_root(value: Fraction) -> Fraction | None:
    """The square root, where it is rational."""
    root = (
        Fraction(math.isqrt(value.numerator), math.isqrt(value.denominator)) if value >= 0 else None
    )
    return root if root is not None and root * root == value else None


def holds_at(rows: list[str], point: Point) -> bool | None:
    """Whether the lines of a statement hold at a point of its variables; those that `exists` names
    are to be among them.
    """
    values = dict(point)
    for row in rows:
        keyword, _, rest = row.partition(" ")
        if keyword in ("range", "given") and not formula_at(rest, values):
            return None
        if keyword == "have" and not formula_at(rest, values):
            return False
        if keyword in ("with", "show") and not formula_at(rest, values):
            return False
        if keyword == "let":
            name, _, said = rest.partition(" = ")
            values[name] = term_at(said, values)
        if keyword == "root":
            name, _, said = rest.partition(" = ")
            square = term_at(said.removeprefix("sqrt"), values)
            if square < 0:
                return False
            root = rational_root(square)
            if root is None:
                return None
            values[name] = root
    return True
