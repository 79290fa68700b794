"""Terms and formulas of the statement language, read by a parser of their own: nothing is shared
with the checker or its tests.

    formula   a or b; a and b; not a; implies(a, b); iff(a, b); terms joined by < <= = != >= >,
    chained as in 0 <= x < w term      a + b, a - b; a*b, a/b from left to right; -a; a^2 for an
    integer from 0 up; sqrt(a) on lines that name a root list      a, b or (a, b)

A sign binds weaker than a power and stronger than a product: -x^2*y is (-(x^2))*y.  `or` binds
weakest, then `and`, `not`, relations.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable, Mapping
from fractions import Fraction

from tests.reports.nodes import (
    Arithmetic,
    Formula,
    Implied,
    Joined,
    Listed,
    Name,
    Neg,
    Node,
    Not,
    NotRead,
    Num,
    Root,
    Term,
    Unary,
    Value,
    chain,
    exact_root,
    value,
)

TOKEN = re.compile(
    r"\s*(?:(?P<number>\d+)|(?P<word>[A-Za-z][A-Za-z0-9_]*)|(?P<sign><=|>=|!=|[-+*/^()<>=,]))",
    re.ASCII,
)
RELATIONS = ("<", "<=", ">", ">=", "=", "!=")
CONNECTIVES = ("and", "or", "not", "implies", "iff")


def evaluate_statement_text(
    text: str, values: Mapping[str, Fraction], root: Root = exact_root
) -> Value:
    """The value of a term or formula of the statement language."""
    return value(read_statement_text(text), values, root)


def read_statement_text(text: str) -> Node:
    try:
        return _Reading(text).whole()
    except RecursionError:
        raise NotRead("too deep") from None


class _Reading:
    def __init__(self, text: str) -> None:
        self.text, self.at, self.tokens = text, 0, []
        end = 0
        body = text.rstrip()
        while end < len(body):
            found = TOKEN.match(body, end)
            if not found:
                raise NotRead("not in the language", end, text)
            self.tokens.append((found[0].strip(), found.start(found.lastgroup or 0), found.end()))
            end = found.end()
        for (token, start, stop), following in zip(
            self.tokens, [*[start for _, start, _ in self.tokens[1:]], -1]
        ):
            joined = token[0].isdigit() and following == stop and text[stop].isalpha()
            if joined or re.fullmatch(r"0\d+", token):
                raise NotRead("a number that is none", start, text)

    def next(self) -> str:
        return self.tokens[self.at][0] if self.at < len(self.tokens) else ""

    def position(self) -> int:
        return self.tokens[self.at][1] if self.at < len(self.tokens) else len(self.text)

    def fail(self, reason: str) -> NotRead:
        return NotRead(reason, self.position(), self.text)

    def took(self, *wanted: str) -> str:
        """The next token, and past it, where it is one of these; nothing otherwise."""
        found = self.next()
        if found and found in wanted:
            self.at += 1
            return found
        return ""

    def expect(self, wanted: str) -> None:
        if not self.took(wanted):
            raise self.fail(f"expected {wanted}")

    def whole(self) -> Node:
        found = self.listed()
        if self.next():
            raise self.fail("something is left over")
        return found

    def listed(self) -> Node:
        entries = [self.disjunction()]
        while self.took(","):
            entries.append(self.disjunction())
        return entries[0] if len(entries) == 1 else Listed(tuple(entries))

    def disjunction(self) -> Node:
        return self.joined("or", lambda: self.joined("and", self.negation))

    def joined(self, how: str, part: Callable[[], Node]) -> Node:
        parts = [part()]
        while self.took(how):
            parts.append(part())
        return parts[0] if len(parts) == 1 else Joined(how, tuple(self.formula(p) for p in parts))

    def negation(self) -> Node:
        return Not(self.formula(self.negation())) if self.took("not") else self.relation()

    def relation(self) -> Node:
        sides, signs = [self.sum()], []
        while sign := self.took(*RELATIONS):
            signs.append(sign)
            sides.append(self.sum())
        return chain([self.term(side) for side in sides], signs) if signs else sides[0]

    def sum(self) -> Node:
        return self.left_to_right(("+", "-"), self.product)

    def product(self) -> Node:
        return self.left_to_right(("*", "/"), self.signed)

    def left_to_right(self, signs: tuple[str, ...], part: Callable[[], Node]) -> Node:
        left = part()
        while sign := self.took(*signs):
            left = Arithmetic(sign, self.term(left), self.term(part()))
        return left

    def signed(self) -> Node:
        return Neg(self.term(self.signed())) if self.took("-") else self.power()

    def power(self) -> Node:
        base = self.atom()
        if not self.took("^"):
            return base
        exponent = self.atom()
        if not isinstance(exponent, Num) or self.next() == "^":
            raise self.fail("an exponent is one integer")
        return Arithmetic("^", self.term(base), exponent)

    def atom(self) -> Node:
        token = self.next()
        if self.took("("):
            found = self.listed()
            self.expect(")")
            return found
        if token.isdigit():
            self.at += 1
            return Num(int(token))
        if token in ("implies", "iff") and self.took(token):
            self.expect("(")
            left = self.formula(self.disjunction())
            self.expect(",")
            right = self.formula(self.disjunction())
            self.expect(")")
            return Implied(token, left, right)
        if not token or not token[0].isalpha() or token in CONNECTIVES or keyword.iskeyword(token):
            raise self.fail("expected a term or a formula")
        self.at += 1
        if self.next() != "(":
            return Name(token, (token,))
        if token != "sqrt":
            raise self.fail("no such function")
        self.expect("(")
        under = self.term(self.disjunction())
        self.expect(")")
        return Unary("sqrt", under)

    def term(self, node: Node) -> Term:
        if not isinstance(node, Term):
            raise self.fail("a formula or list stands where a term is expected")
        return node

    def formula(self, node: Node) -> Formula:
        if not isinstance(node, Formula):
            raise self.fail("a term or list stands where a formula is expected")
        return node
