r"""Tokens to the tree of a display, by a Pratt parser; what TeX itself would read differently is
refused.

Formulas and factors are here; names with their scripts, and tables, stand in `pieces`.
"""

from __future__ import annotations

from functools import lru_cache

from proofs.reading.pieces import Pieces
from proofs.reading.tree import (
    HOLE,
    Absolute,
    Binary,
    Chain,
    Component,
    Derivative,
    Extremum,
    ForAll,
    Group,
    Juxtaposition,
    Limit,
    Name,
    Negative,
    Operator,
    Quotient,
    Restriction,
    Root,
    SetBuilder,
    Tree,
)
from proofs.reading.vocabulary import BINARY, BRACKETS, EXTREMA, OPERATORS, RELATIONS, SIGN

_STARTS = (
    frozenset((r"\frac", r"\sqrt", r"\lim", "(", "[", "{", r"\lfloor", r"\lceil"))
    | EXTREMA
    | OPERATORS
)
_SEPARATORS = frozenset((",", ";"))


@lru_cache(maxsize=4096)
def parse(latex: str) -> tuple[Tree, ...]:
    r"""The parts of a display, one tree each.

    >>> [type(part).__name__ for part in parse(r"0 < \alpha < 1 \\ \chi = x - y")]
    ['Chain', 'Chain']
    """
    return Parser(latex).display()


class Parser(Pieces):
    """A reader of one print: `display` reads all of it."""

    def display(self) -> tuple[Tree, ...]:
        """All parts: separated by line ends, commas, semicolons or the word `and`; a last full stop
        is dropped.
        """
        parts: list[Tree] = []
        while True:
            while self.token.kind == "line" or self.token.text in _SEPARATORS and parts:
                self.advance()
            if self.token.kind == "stop":
                break
            parts.append(self.statement())
            if self.token.text == "." and self.tokens[self.index + 1].kind in ("stop", "line"):
                self.advance()
            if self.token.kind == "text" and self.token.text in ("and", "so that", "where"):
                self.advance()
            elif self.token.kind not in ("line", "stop") and self.token.text not in _SEPARATORS:
                self.refuse("unexpected")
        if not parts:
            self.refuse("a print without a formula:")
        return tuple(parts)

    def statement(self) -> Tree:
        """A chain of relations, or one under a quantifier."""
        start = self.token
        if start.text != r"\forall":
            return self.chain()
        self.advance()
        head = self.chain()
        if self.token.text in (",", ":"):
            self.advance()
        return ForAll(head, self.chain(), at=start.start)

    def chain(self) -> Tree:
        """An expression, and the relations that go on from it."""
        first = self.expression(0)
        if self.token.text not in RELATIONS:
            return first
        rest = []
        while self.token.text in RELATIONS:
            sign = self.advance().text
            rest.append((sign, self.expression(0)))
        return Chain(first, tuple(rest), at=first.at)

    def expression(self, level: int) -> Tree:
        """What binds more tightly than `level`, from here on."""
        start = self.token
        left: Tree
        if start.text in ("-", "+"):
            self.advance()
            operand = self.expression(SIGN)
            left = Negative(operand, at=start.start) if start.text == "-" else operand
        elif start.text == r"\cdot":  # the place of an argument, in the key of an environment
            self.advance()
            left = HOLE
        else:
            left = self.juxtaposition()
        while (binds := BINARY.get(self.token.text, 0)) > level:
            sign = self.advance()
            right = self.expression(binds)
            if sign.text == "/":
                left = Quotient(left, right, True, at=sign.start)
            else:
                left = Binary(sign.text, left, right, at=sign.start)
        return left

    def juxtaposition(self) -> Tree:
        """One factor, or several side by side."""
        factors = [self.factor()]
        while self.starts_a_factor():
            factors.append(self.factor())
        return factors[0] if len(factors) == 1 else Juxtaposition(tuple(factors), at=factors[0].at)

    def starts_a_factor(self) -> bool:
        """Whether the next token can go on with a product."""
        token = self.token
        if token.kind == "number":
            self.refuse("a numeral after a factor:")
        if token.text == "|":
            return not self.bar_closes
        return (
            token.kind in ("letter", "accent", "begin")
            or token.text in _STARTS
            or token.text == r"\{"
            and self.is_cases()
        )

    def factor(self) -> Tree:
        """A primary with its scripts and restrictions."""
        tree = self.primary()
        while True:
            text = self.token.text
            if text in ("^", "_", "'"):
                tree = self.scripts(tree)
            elif text == "|" and self.tokens[self.index + 1].text == "_":
                self.advance()
                self.advance()
                tree = Restriction(tree, self.script()[0], at=tree.at)
            else:
                return tree

    def primary(self) -> Tree:
        """What a factor starts with."""
        token = self.token
        text, kind, at = token.text, token.kind, token.start
        if kind == "number":
            return self.numeral()
        if kind == "letter":
            return self.differential() if text == "D" else self.letter()
        if kind == "accent":
            return self.accented()
        if kind == "begin":
            return self.table()
        if text == "{":
            return self.braced()
        if text in BRACKETS:
            return self.bracketed()
        if text == r"\frac":
            self.advance()
            top, bottom = self.argument(), self.argument()
            if (
                isinstance(top, Operator)
                and isinstance(bottom, Operator)
                and top.sign == bottom.sign == r"\partial"
            ):
                return Derivative(top.operand, bottom.operand, at=at)
            return Quotient(top, bottom, at=at)
        if text == r"\sqrt":
            self.advance()
            if self.token.text == "[":
                self.refuse("only square roots are read, not")
            return Root(self.argument(), at=at)
        if text in OPERATORS:
            return self.operator()
        if text == r"\lim" or text in EXTREMA:
            return self.extremum()
        if text == r"\{":
            return self.cases_in_brace() if self.is_cases() else self.set_builder()
        if text == "|":
            self.advance()
            content = self.enclosed(True)
            self.expect("|")
            return Absolute(content, at=at)
        self.refuse("expected a formula instead of")

    def enclosed(self, bar_closes: bool) -> Tree:
        """A chain inside a delimiter; a bar inside ends it only if `bar_closes`."""
        before, self.bar_closes = self.bar_closes, bar_closes
        content = self.chain()
        self.bar_closes = before
        return content

    def braced(self) -> Tree:
        """TeX's own braces, which say nothing."""
        self.expect("{")
        content = self.enclosed(False)
        self.expect("}")
        return content

    def bracketed(self) -> Tree:
        """Brackets around items; [..]_1 is a component."""
        start = self.advance()
        items = [self.enclosed(False)]
        while self.token.text == ",":
            self.advance()
            items.append(self.enclosed(False))
        self.expect(BRACKETS[start.text])
        if start.text == "[" and self.token.text == "_":
            self.advance()
            inner = items[0] if len(items) == 1 else Group("(", tuple(items), at=start.start)
            return Component(inner, self.script()[0], at=start.start)
        return Group(start.text, tuple(items), at=start.start)

    def set_builder(self) -> Tree:
        """{element | conditions}."""
        start = self.advance()
        element = self.enclosed(True)
        if self.token.text not in ("|", ":"):
            self.refuse("a set needs a bar and a condition before")
        self.advance()
        conditions = [self.enclosed(False)]
        while self.token.text == ",":
            self.advance()
            conditions.append(self.enclosed(False))
        self.expect(r"\}")
        return SetBuilder(element, tuple(conditions), at=start.start)

    def operator(self) -> Tree:
        r"""\Delta, \partial, \nabla or D with its subscript, before the name or bracket that it
        acts on.
        """
        start = self.advance()
        subscripts: tuple[Tree, ...] = ()
        if self.token.text == "_":
            self.advance()
            subscripts = self.script()
        return Operator(start.text, subscripts, self.operand(), at=start.start)

    def differential(self) -> Tree:
        """D before something that it can act on is the derivative; alone it is a letter."""
        after = self.tokens[self.index + 1]
        acts = (
            after.kind in ("letter", "accent")
            or after.text in OPERATORS
            or after.text in ("_", "(", r"\cdot")
        )
        return self.operator() if acts else self.letter()

    def operand(self) -> Tree:
        """The name (with its subscripts) or the bracket that an operator acts on."""
        token = self.token
        if token.text in OPERATORS:
            return self.operator()
        if token.text == "(":
            return self.bracketed()
        if token.text == r"\cdot":
            self.advance()
            return HOLE
        if token.kind not in ("letter", "accent"):
            self.refuse("an operator needs a name before")
        name = self.accented() if token.kind == "accent" else self.letter()
        while self.token.text in ("_", "'") and isinstance(name, Name):
            name = self.scripts(name)
        return name

    def extremum(self) -> Tree:
        r"""\lim, \max, \min, \sup or \inf with the condition under it, before a product."""
        start = self.advance()
        condition: Tree | None = None
        if self.token.text == "_":
            self.advance()
            condition = self.script()[0]
        body = self.expression(BINARY[r"\cdot"])
        if start.text != r"\lim":
            return Extremum(start.text, condition, body, at=start.start)
        if condition is None:
            self.refuse("a limit needs a condition before")
        return Limit(condition, body, at=start.start)


def parse_name(latex: str) -> Tree:
    """The tree of a key: one expression, in which `\\cdot` may stand for an argument."""
    parser = Parser(latex)
    tree = parser.expression(0)
    if parser.token.kind != "stop":
        parser.refuse("a key is one expression; unexpected")
    return tree
