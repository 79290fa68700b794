"""A Pratt parser from the tokens of a print to a tree: first names, scripts and tables, then
factors and formulas.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from typing import NoReturn

from juggleproof.reading.lexer import (
    ACCENTS,
    BINARY,
    BRACKETS,
    EXTREMA,
    OPERATORS,
    RELATIONS,
    SIGN,
    PrintError,
    Token,
    lex,
)
from juggleproof.reading.tree import (
    HOLE,
    Absolute,
    Array,
    Binary,
    Cases,
    Chain,
    Component,
    Derivative,
    ForAll,
    Group,
    Juxtaposition,
    Limit,
    Name,
    Negative,
    Number,
    Operator,
    Power,
    PrintedExtremum,
    Quotient,
    Restriction,
    Root,
    SetBuilder,
    Sign,
    Tree,
)

# -------------------------------------------------------------------------------------------------
# Names with their accents and scripts, arguments as delimited by TeX, and tables.

_SIGNS = frozenset(("+", "-", "*", r"\circ", r"\cdot"))


class Pieces:
    """A reader of the smallest pieces of a print, with its position in the tokens."""

    def __init__(self, latex: str) -> None:
        self.tokens = lex(latex)
        self.index = 0
        self.token = self.tokens[0]
        self.bar_closes = False

    def chain(self) -> Tree:
        raise NotImplementedError

    def primary(self) -> Tree:
        raise NotImplementedError

    def braced(self) -> Tree:
        raise NotImplementedError

    def enclosed(self, bar_closes: bool) -> Tree:
        raise NotImplementedError

    def refuse(self, problem: str) -> NoReturn:
        """Raises PrintError at the present token."""
        raise PrintError(self.token.start, f"{problem} {_shown(self.token)}")

    def advance(self) -> Token:
        """Returns the present token, and steps over it."""
        token = self.token
        if token.kind == "stop":
            self.refuse("expected more before")
        self.index += 1
        self.token = self.tokens[self.index]
        return token

    def expect(self, text: str) -> Token:
        """Steps over a token with this text; raises PrintError for any other."""
        if self.token.text != text:
            self.refuse(f"expected {text} before")
        return self.advance()

    def numeral(self) -> Number:
        """A numeral; decimals are exact."""
        token = self.advance()
        return Number(
            Fraction(token.text) if "." in token.text else int(token.text), at=token.start
        )

    def letter(self) -> Name:
        """A single letter."""
        token = self.advance()
        return Name(token.text, at=token.start)

    def accented(self) -> Tree:
        """An accent or a script font, over a name."""
        token = self.advance()
        name = self.argument()
        if not isinstance(name, Name):
            raise PrintError(token.start, f"{token.text} stands over something that is not a name")
        return replace(
            name, accents=tuple(sorted(name.accents + ACCENTS[token.text])), at=token.start
        )

    def argument(self) -> Tree:
        """The argument that TeX would take: a brace, one letter, one digit, one command."""
        token = self.token
        if token.text == "{":
            return self.braced()
        if token.kind == "number":
            return self.digit()
        if token.kind == "letter":
            return self.letter()
        if token.kind == "accent":
            return self.accented()
        if token.text in (r"\frac", r"\sqrt"):
            return self.primary()
        self.refuse("expected an argument instead of")

    def digit(self) -> Number:
        """One digit: without a brace TeX takes no more, so \\frac12 is a half."""
        token = self.token
        if len(token.text) == 1:
            return self.numeral()
        if "." in token.text:
            self.refuse("put braces around")
        rest = Token("number", token.text[1:], token.start + 1, token.end)
        self.tokens = (*self.tokens[: self.index], rest, *self.tokens[self.index + 1 :])
        self.token = rest
        return Number(int(token.text[0]), at=token.start)

    def scripts(self, tree: Tree) -> Tree:
        """The tree with the sub- or superscript or prime that follows it."""
        sign = self.advance()
        if sign.text == "'":
            return self.primed(tree, sign)
        if sign.text == "^":
            if self.is_prime():
                return self.primed(tree, sign)
            if isinstance(tree, Power):
                raise PrintError(sign.start, "a second superscript ^")
            exponents = self.script()
            if len(exponents) > 1:
                raise PrintError(sign.start, "a superscript with a comma ^")
            return Power(tree, exponents[0], at=tree.at)
        power = tree if isinstance(tree, Power) else None
        name = power.base if power is not None else tree
        if not isinstance(name, Name):
            raise PrintError(sign.start, "a subscript under something that is not a name: _")
        if name.subscripts:
            raise PrintError(sign.start, "a second subscript _")
        name = replace(name, subscripts=self.script())
        return name if power is None else replace(power, base=name)

    def primed(self, tree: Tree, sign: Token) -> Tree:
        if isinstance(tree, Power) and isinstance(tree.base, Name):
            return replace(tree, base=replace(tree.base, primes=tree.base.primes + 1))
        if not isinstance(tree, Name):
            raise PrintError(sign.start, "a prime on something that is not a name: '")
        return replace(tree, primes=tree.primes + 1)

    def is_prime(self) -> bool:
        r"""Steps over \prime or {\prime}, if one comes next; returns whether it does."""
        texts = [token.text for token in self.tokens[self.index : self.index + 3]]
        steps = 1 if texts[:1] == [r"\prime"] else 3 if texts == ["{", r"\prime", "}"] else 0
        for _ in range(steps):
            self.advance()
        return steps > 0

    def script(self) -> tuple[Tree, ...]:
        """The items of a sub- or superscript; several lower-case letters in a row are one word."""
        token = self.token
        if token.text != "{":
            return (self.bare_script(),)
        first = self.index
        while self.tokens[first].text == "{":  # E_{\mathrm{max}} has a brace within a brace
            first += 1
        braces, last = first - self.index, first
        while self.tokens[last].text not in ("}", "{") and self.tokens[last].kind != "stop":
            last += 1
        closed = all(token.text == "}" for token in self.tokens[last : last + braces])
        if closed and (word := _word(self.tokens[first:last])):
            for _ in range(last + braces - self.index):
                self.advance()
            return (word,)
        self.advance()
        items = [self.enclosed(False)]
        while self.token.text == ",":
            self.advance()
            items.append(self.enclosed(False))
        self.expect("}")
        return tuple(items)

    def bare_script(self) -> Tree:
        word = _word((self.token,))
        if word is None:
            return self.argument()
        self.advance()
        return word

    def is_cases(self) -> bool:
        """Whether an opening brace stands before an array, which makes it a list of cases."""
        after = self.tokens[self.index + 1]
        return after.kind == "begin" and after.text == "array"

    def cases_in_brace(self) -> Tree:
        self.advance()
        return self.cases(self.advance())

    def table(self) -> Tree:
        """A matrix, a vector or cases."""
        begin = self.advance()
        if begin.text == "cases":
            return self.cases(begin)
        rows: list[tuple[Tree, ...]] = []
        while True:
            while self.token.kind == "line":
                self.advance()
            if self.token.kind == "end":
                break
            row = [self.enclosed(False)]
            while self.token.text == "&":
                self.advance()
                row.append(self.enclosed(False))
            if self.token.kind not in ("line", "end"):
                self.refuse("unexpected in a matrix:")
            rows.append(tuple(row))
        self.advance()
        if not rows or len({len(row) for row in rows}) > 1:
            raise PrintError(begin.start, f"the rows of this {begin.text} are not equally long")
        return Array(tuple(rows), at=begin.start)

    def cases(self, begin: Token) -> Tree:
        """Lines `value : condition`, where &, a comma, `if` or `for` may replace the colon or stand
        beside it.
        """
        pieces: list[tuple[Tree, Tree]] = []
        while True:
            while self.token.kind == "line":
                self.advance()
            if self.token.kind == "end":
                break
            value = self.enclosed(False)
            first = self.index
            while (
                self.token.text in ("&", ":", ",")
                or self.token.kind == "text"
                and self.token.text in ("if", "for")
            ):
                self.advance()
            if self.index == first:
                self.refuse("expected a condition before")
            pieces.append((value, self.enclosed(False)))
            if self.token.kind not in ("line", "end"):
                self.refuse("unexpected after a condition:")
        self.advance()
        if not pieces:
            raise PrintError(begin.start, f"this {begin.text} is empty")
        return Cases(tuple(pieces), at=begin.start)


def _word(tokens: tuple[Token, ...]) -> Tree | None:
    """A script that is a word (max, eq, th) or a bare sign, or None."""
    if len(tokens) == 1:
        only = tokens[0]
        if only.text in _SIGNS:
            return Sign(only.text, at=only.start)
        if only.kind == "text" or only.text in EXTREMA:
            return Name(only.text.lstrip("\\"), at=only.start)
        return None
    together = all(left.end == right.start for left, right in zip(tokens, tokens[1:], strict=False))
    if (
        len(tokens) > 1
        and together
        and all(
            token.kind == "letter" and token.text.islower() and len(token.text) == 1
            for token in tokens
        )
    ):
        return Name("".join(token.text for token in tokens), at=tokens[0].start)
    return None


def _shown(token: Token) -> str:
    if token.kind in ("begin", "end"):
        return rf"\{token.kind}{{{token.text}}}"
    return r"\\" if token.kind == "line" else token.text


# -------------------------------------------------------------------------------------------------
# The Pratt parser for formulas and factors; a print that TeX itself would read differently is
# refused.

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
        """All parts, which are separated by line ends, commas, semicolons or the word `and`; a full
        stop at the end is dropped.
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
        """An expression, with the relations that follow it."""
        first = self.expression(0)
        if self.token.text not in RELATIONS:
            return first
        rest = []
        while self.token.text in RELATIONS:
            sign = self.advance().text
            rest.append((sign, self.expression(0)))
        return Chain(first, tuple(rest), at=first.at)

    def expression(self, level: int) -> Tree:
        """The longest expression from here on whose operators bind more tightly than `level`."""
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
        """Whether a product can continue with the next token."""
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
        """The beginning of a factor, without scripts and restrictions."""
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
        """The content of TeX's own braces, which have no meaning."""
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
            return PrintedExtremum(start.text, condition, body, at=start.start)
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
