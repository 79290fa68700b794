"""Names with their accents and scripts, arguments as TeX delimits them, and tables."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import NoReturn

from proofs.reading.errors import PrintError
from proofs.reading.lexer import Token, lex
from proofs.reading.tree import Array, Cases, Mark, Name, Number, Power, Tree
from proofs.reading.vocabulary import ACCENTS, EXTREMA

_SIGNS = frozenset(("+", "-", "*", r"\circ", r"\cdot"))


class Pieces:
    """A place in the tokens of a print, and the readers of its smallest pieces."""

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
        """Refuse the token that stands here."""
        raise PrintError(self.token.start, f"{problem} {_shown(self.token)}")

    def advance(self) -> Token:
        """The token that stands here, stepping over it."""
        token = self.token
        if token.kind == "stop":
            self.refuse("expected more before")
        self.index += 1
        self.token = self.tokens[self.index]
        return token

    def expect(self, text: str) -> Token:
        """Step over this very token."""
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
        """What TeX takes as one argument: a brace, one letter, one digit, one command."""
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
        """One digit: TeX takes no more than that without a brace, so \\frac12 is a half."""
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
        r"""Steps over \prime or {\prime}, if that is what stands here."""
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
        """Lines `value : condition`, where &, a comma, `if` or `for` may stand for the colon or
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
            return Mark(only.text, at=only.start)
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
